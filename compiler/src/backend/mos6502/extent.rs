//! How long a program is, counted from its lines as they were written: to assemble the text
//! takes much longer, and programs are written by the dozen to find out which of them fits.
//!
//! What is counted is what the assembler makes of it: an operand is in the zero page where
//! its value is known by then and below 256.

use rustc_hash::FxHashMap;
use slowlight_isa::opcodes::{self, Mode};

/// Where a program is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Extent {
    /// The address of its first byte.
    pub origin: u32,
    /// The address of a label in it, if it has that.
    pub label: Option<u32>,
    /// The address behind its last byte, which may be beyond 64K.
    pub end: u32,
}

/// Where a program is, and a label in it; nothing where a line is none of those that are counted
/// here.
pub(super) fn extent<'l>(lines: impl Iterator<Item = &'l str>, label: &str) -> Option<Extent> {
    let mut counted = Counted::default();
    for line in lines {
        let code = line.split(';').next().unwrap_or(line).trim_end();
        counted.line(code)?;
    }
    let origin = counted.origin?;
    let label = counted.symbols.get(label);
    Some(Extent {
        origin,
        label: label.and_then(|at| u32::try_from(*at).ok()),
        end: u32::try_from(counted.here).ok()?,
    })
}

/// A program so far.
#[derive(Default)]
struct Counted<'l> {
    /// What names stand for, of those that are known by now.
    symbols: FxHashMap<&'l str, i64>,
    origin: Option<u32>,
    /// The address of the next byte.
    here: i64,
}

impl<'l> Counted<'l> {
    fn line(&mut self, code: &'l str) -> Option<()> {
        let body = code.trim_start();
        if body.is_empty() {
            return Some(());
        }
        if body.len() < code.len() {
            self.origin?;
            self.here += i64::from(self.bytes(body)?);
            return Some(());
        }
        if let Some(label) = code.strip_suffix(':') {
            return self.define(label, Some(self.here));
        }
        let (name, value) = code.split_once(" = ")?;
        if name != "*" {
            return self.define(name, self.value(value)?);
        }
        self.here = self.value(value)??;
        match self.origin.replace(u32::try_from(self.here).ok()?) {
            None => Some(()),
            Some(_) => None,
        }
    }

    fn define(&mut self, name: &'l str, value: Option<i64>) -> Option<()> {
        let before = value.and_then(|value| self.symbols.insert(name, value));
        before.is_none().then_some(())
    }

    /// What a sum of names and numbers comes to, where that is known by now; nothing of what
    /// is no such sum.
    fn value(&self, text: &str) -> Option<Option<i64>> {
        let mut sum = Some(0);
        let mut rest = text.trim();
        let mut sign = 1;
        if let Some(behind) = rest.strip_prefix('-') {
            (sign, rest) = (-1, behind);
        }
        loop {
            let end = rest.find(['+', '-']).unwrap_or(rest.len());
            let (term, behind) = rest.split_at(end);
            let value = self.term(term.trim())?;
            sum = sum.zip(value).map(|(sum, value)| sum + sign * value);
            sign = match behind.chars().next() {
                None => return Some(sum),
                Some('-') => -1,
                Some(_) => 1,
            };
            rest = behind.get(1..)?;
        }
    }

    fn term(&self, text: &str) -> Option<Option<i64>> {
        let known = |number: Result<u32, _>| number.ok().map(|n| Some(i64::from(n)));
        if let Some(digits) = text.strip_prefix('$') {
            return known(u32::from_str_radix(digits, 16));
        }
        if text.starts_with(|c: char| c.is_ascii_digit()) {
            return known(text.parse());
        }
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let name = !text.is_empty() && text.chars().all(plain);
        name.then(|| self.symbols.get(text).copied())
    }

    /// The bytes of an instruction, or of data.
    fn bytes(&self, body: &str) -> Option<u32> {
        let (word, operand) = body.split_once(' ').unwrap_or((body, ""));
        let operand = operand.trim();
        let elements = || match operand.contains(['"', '\'']) || operand.is_empty() {
            true => None,
            false => u32::try_from(operand.split(',').count()).ok(),
        };
        match word {
            ".byte" => elements(),
            ".word" => Some(2 * elements()?),
            _ => self.mode(word, operand).map(|mode| u32::from(mode.bytes())),
        }
    }

    /// Where an instruction's operand is.
    fn mode(&self, name: &str, operand: &str) -> Option<Mode> {
        let has = |mode: &Mode| opcodes::find(name, *mode).is_some();
        let one = |mode: Mode| Some(mode).filter(has);
        if operand.is_empty() {
            return one(Mode::Implied).or_else(|| one(Mode::Accumulator));
        }
        if operand.starts_with('#') {
            return one(Mode::Immediate);
        }
        if operand.starts_with('(') {
            return match operand {
                _ if operand.ends_with("),y") => one(Mode::IndirectY),
                _ if operand.ends_with(",x)") => one(Mode::IndirectX),
                _ if operand.ends_with(')') => one(Mode::Indirect),
                _ => None,
            };
        }
        let (address, near, far) = match operand.split_once(',') {
            None => (operand, Mode::ZeroPage, Mode::Absolute),
            Some((address, "x")) => (address, Mode::ZeroPageX, Mode::AbsoluteX),
            Some((address, "y")) => (address, Mode::ZeroPageY, Mode::AbsoluteY),
            Some(_) => return None,
        };
        if address.eq_ignore_ascii_case("a") {
            return None;
        }
        if near == Mode::ZeroPage && has(&Mode::Relative) {
            return Some(Mode::Relative);
        }
        let value = self.value(address)?;
        match value.is_some_and(|value| (0..256).contains(&value)) {
            true => one(near).or_else(|| one(far)),
            false => one(far).or_else(|| one(near)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::extent;

    fn counted(text: &str) -> Option<(u32, u32)> {
        let extent = extent(text.lines(), "there")?;
        Some((extent.origin, extent.end))
    }

    #[test]
    fn operands_are_as_long_as_the_assembler_has_them() {
        let head = "near = $80 ; a byte\nfar = $0400\nwidth = -3\nalso = near+2\n* = $0a00\n";
        let long = |code: &str| {
            let (origin, end) = counted(&format!("{head}        {code}"))?;
            Some(end - origin)
        };
        for (code, bytes) in [
            ("rts", 1),
            ("asl", 1),
            ("lda #<(width)", 2),
            ("lda also", 2),
            ("lda near+1+2 ; a remark", 2),
            ("lda near+128", 3),
            ("lda far", 3),
            ("lda far-$0380", 2),
            ("sta near,x", 2),
            ("sta near,y", 3),
            ("ldx near,y", 2),
            ("lda later-1,x", 3),
            ("lda (near),y", 2),
            ("jmp (far)", 3),
            ("jmp near", 3),
            ("bne later", 2),
            ("lax near", 2),
            (".byte <(far), >(far), $10, 4", 4),
            (".word far, near", 4),
        ] {
            assert_eq!(long(code), Some(bytes), "{code}");
        }
        for code in [
            "lda near*2",
            ".byte \"a,b\"",
            ".res 4",
            "lda far,z",
            "xyz near",
        ] {
            assert_eq!(long(code), None, "{code}");
        }
    }

    #[test]
    fn what_is_named_behind_its_use_is_not_near() {
        let text = "* = $0010\n        lda there\nthere:\n        lda there\n";
        assert_eq!(counted(text), Some((0x10, 0x15)));
        let there = extent(text.lines(), "there").and_then(|extent| extent.label);
        assert_eq!(there, Some(0x13));
        assert_eq!(counted("a = 1\na = 2\n* = $0800"), None);
        assert_eq!(counted("        rts"), None);
        assert_eq!(counted("* = $0800\n* = $0900"), None);
    }
}
