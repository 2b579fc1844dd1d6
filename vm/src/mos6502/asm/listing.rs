//! The program beside its bytes and its cycles.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::{Assembly, LineSpan};
use slowlight_isa::opcodes::{Mode, OPCODES};

/// Bytes shown on a line; the rest of a long one is left out.
const SHOWN: usize = 8;

/// What an instruction takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Taken {
    /// Cycles at least.
    pub cycles: u8,
    /// Whether it may be more: a branch that is taken, an index that crosses a page.
    pub more: bool,
}

impl Assembly {
    /// The source with the address, the bytes and the cycles of every line before it. A
    /// `+` behind the cycles says that there may be one more, or two where a branch goes
    /// to another page.
    pub fn listing(&self, source: &str) -> String {
        let mut text = String::new();
        for (left, line) in self.columns(source).zip(source.lines()) {
            let _ = writeln!(text, "{}", format!("{left}{line}").trim_end());
        }
        text
    }

    /// What a listing has left of each line of the source: 36 characters.
    pub fn columns(&self, source: &str) -> impl Iterator<Item = String> {
        let by_line: BTreeMap<u32, &LineSpan> =
            self.lines.iter().map(|span| (span.line, span)).collect();
        (1u32..).zip(source.lines()).map(move |(line, _)| {
            by_line
                .get(&line)
                .map_or_else(empty, |span| self.left_of(span))
        })
    }

    fn left_of(&self, span: &LineSpan) -> String {
        let start = usize::from(span.address - self.origin);
        let bytes = self.bytes.iter().skip(start).take(span.length as usize);
        let mut left = format!("{:04X} ", span.address);
        for byte in bytes.take(SHOWN) {
            let _ = write!(left, " {byte:02X}");
        }
        if span.length as usize > SHOWN {
            left.push_str(" +");
        }
        let cycles = self.taken(span).map_or_else(String::new, |taken| {
            format!("{}{}", taken.cycles, if taken.more { "+" } else { "" })
        });
        format!("{left:<32}{cycles:<4}")
    }

    /// What the instruction of a line takes; none for data.
    pub fn taken(&self, span: &LineSpan) -> Option<Taken> {
        let at = usize::from(span.address.checked_sub(self.origin)?);
        let opcode = &OPCODES[usize::from(*self.bytes.get(at).filter(|_| span.code)?)];
        Some(Taken {
            cycles: opcode.cycles,
            more: opcode.page_cycle() || opcode.mode == Mode::Relative,
        })
    }
}

fn empty() -> String {
    format!("{:36}", "")
}
