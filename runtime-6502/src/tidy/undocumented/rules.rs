//! What a few instructions become, one rule a line. The tests carry out both sides of each
//! for all bytes.

use super::super::code::{Instruction, Operand};
use super::super::effects::{A, C, NZ, Place, V};
use super::super::rules::Edit;
use super::Straight;
use std::collections::BTreeMap;

/// Some instructions, and what does the same.
///
/// In operands `m` stands for a byte of memory that has a name and `n` for another or for a
/// number; `p` for anything that A and X can be loaded from at once; `#k` for a number, and
/// `#j` for one below 128. What is put may hold `#2k` and `#-k`, worked out.
struct Pattern {
    from: &'static str,
    to: &'static str,
    /// What both leave otherwise, so nobody may read it.
    loses: &'static [Place],
}

const fn pattern(from: &'static str, to: &'static str, loses: &'static [Place]) -> Pattern {
    Pattern { from, to, loses }
}

/// Longer ones first.
#[rustfmt::skip]
const PATTERNS: &[Pattern] = &[
    pattern("lda p|clc|adc #k|tax", "lax p|sbx #-k", &[A, V]),
    pattern("txa|clc|adc #k|tax", "txa|sbx #-k", &[A, V]),
    pattern("txa|sec|sbc #k|tax", "txa|sbx #k", &[A, V]),
    pattern("inc m|lda n|sec|sbc m", "lda n|sec|isc m", &[]),
    // A sum's terms may change places.
    pattern("asl m|lda m|ora n", "lda n|slo m", &[]),
    pattern("rol m|lda m|and n", "lda n|rla m", &[]),
    pattern("lsr m|lda m|eor n", "lda n|sre m", &[]),
    pattern("ror m|lda m|adc n", "lda n|rra m", &[]),
    pattern("dec m|lda n|cmp m", "lda n|dcp m", &[]),
    pattern("txa|and n|sta m", "lda n|sax m", &[A, NZ]),
    pattern("inx|inx|inx", "txa|sbx #$fd", &[A, C]),
    pattern("dex|dex|dex", "txa|sbx #$03", &[A, C]),
    pattern("lda p|tax", "lax p", &[]),
    pattern("ldx m|txa", "lax m", &[]),
    pattern("asl m|ora m", "slo m", &[]),
    pattern("rol m|and m", "rla m", &[]),
    pattern("lsr m|eor m", "sre m", &[]),
    pattern("ror m|adc m", "rra m", &[]),
    pattern("dec m|cmp m", "dcp m", &[]),
    pattern("inc m|sbc m", "isc m", &[]),
    // Together with what changes nothing.
    pattern("asl m|lda m", "lda #$00|slo m", &[]),
    pattern("lsr m|lda m", "lda #$00|sre m", &[]),
    pattern("rol m|lda m", "lda #$ff|rla m", &[]),
    pattern("and #k|lsr", "alr #k", &[]),
    pattern("lsr|and #j", "alr #2k", &[C]),
    pattern("lsr|clc", "alr #$fe", &[]),
    pattern("and #j|clc", "anc #k", &[]),
    pattern("clc|and #j", "anc #k", &[]),
    pattern("lda #$00|clc", "anc #$00", &[]),
    pattern("clc|lda #$00", "anc #$00", &[]),
];

/// A pattern, instruction by instruction.
pub(super) struct Rule {
    pub from: Vec<(&'static str, &'static str)>,
    pub to: Vec<(&'static str, &'static str)>,
    pub loses: &'static [Place],
}

pub(super) fn all() -> Vec<Rule> {
    fn read(text: &'static str) -> Vec<(&'static str, &'static str)> {
        let codes = text.split('|');
        codes
            .map(|c| c.split_once(' ').unwrap_or((c, "")))
            .collect()
    }
    let rule = |pattern: &Pattern| Rule {
        from: read(pattern.from),
        to: read(pattern.to),
        loses: pattern.loses,
    };
    PATTERNS.iter().map(rule).collect()
}

/// What letters stand for.
#[derive(Default)]
pub(super) struct Bound {
    /// `m`, `n` and `p`.
    operands: BTreeMap<char, Operand>,
    number: Option<u8>,
}

impl Bound {
    /// Whether an operand is what stands in a pattern; what its letter stands for is kept.
    fn takes(&mut self, wanted: &str, operand: &Operand) -> bool {
        let number = match operand {
            Operand::Immediate(_, number) => *number,
            _ => None,
        };
        let is = match wanted {
            "" => return *operand == Operand::None,
            "#k" | "#j" => {
                self.number = number;
                // With 0 a carry would be lost.
                return number.is_some_and(|n| n > 0 && (wanted == "#k" || n < 128));
            }
            "#$00" => return number == Some(0),
            "m" => matches!(operand, Operand::Cell(..)),
            "n" => matches!(operand, Operand::Cell(..) | Operand::Immediate(..)),
            _ => super::twice::has_both(operand),
        };
        let Some(letter) = wanted.chars().next().filter(|_| is) else {
            return false;
        };
        *(self.operands.entry(letter)).or_insert_with(|| operand.clone()) == *operand
    }

    /// Whether one byte has two letters.
    fn is_mixed(&self) -> bool {
        let of = |letter| match self.operands.get(&letter) {
            Some(Operand::Cell(at, _)) => Some(*at),
            _ => None,
        };
        of('m').is_some() && of('m') == of('n')
    }

    /// What is put for an operand of a pattern.
    fn put(&self, wanted: &str) -> String {
        let number = self.number.unwrap_or_default();
        match wanted {
            "#k" | "#j" => format!("#${number:02x}"),
            "#2k" => format!("#${:02x}", number << 1),
            "#-k" => format!("#${:02x}", number.wrapping_neg()),
            "m" | "n" | "p" => {
                let letter = wanted.chars().next().unwrap_or_default();
                let bound = self.operands.get(&letter);
                bound.map_or_else(String::new, |operand| operand.text().to_owned())
            }
            _ => wanted.to_owned(),
        }
    }

    #[cfg(test)]
    pub fn sample(number: u8) -> Bound {
        let operands = [('m', 0x10), ('n', 0x11), ('p', 0x10)];
        let cell = |at: u16| Operand::Cell(at, format!("${at:02x}"));
        Bound {
            operands: operands.map(|(letter, at)| (letter, cell(at))).into(),
            number: Some(number),
        }
    }

    /// A side of a rule as it is written.
    pub fn written(&self, side: &[(&str, &str)]) -> Vec<String> {
        let texts = side.iter();
        let text = |(name, wanted): &(&str, &str)| format!("{name} {}", self.put(wanted));
        texts.map(|code| text(code).trim_end().to_owned()).collect()
    }
}

impl Rule {
    /// What stands for the letters, if the instructions from the `k`th of a block on are the
    /// rule's and nobody reads what it loses.
    fn matches(&self, block: &Straight, k: usize) -> Option<Bound> {
        let code: &[&Instruction] = block.code.get(k..k + self.from.len())?;
        let mut bound = Bound::default();
        let alike = |(code, (name, wanted)): (&&Instruction, &(&str, &str))| {
            code.name == *name && bound.takes(wanted, &code.operand)
        };
        let last = k + self.from.len() - 1;
        (code.iter().zip(&self.from).all(alike)
            && !bound.is_mixed()
            && self.loses.iter().all(|place| block.is_dead(last, *place)))
        .then_some(bound)
    }
}

/// Adds what rules make of instructions that are left as they are so far.
pub(super) fn add(block: &Straight, rules: &[Rule], edits: &mut BTreeMap<usize, Edit>) {
    let mut k = 0;
    while k < block.code.len() {
        let found = rules.iter().find_map(|rule| {
            let free = edits.range(k..k + rule.from.len()).next().is_none();
            Some((rule, free.then(|| rule.matches(block, k))??))
        });
        let Some((rule, bound)) = found else {
            k += 1;
            continue;
        };
        let mut written = bound.written(&rule.to).into_iter();
        for at in k..k + rule.from.len() {
            edits.insert(at, written.next().map_or(Edit::Gone, Edit::Instead));
        }
        k += rule.from.len();
    }
}
