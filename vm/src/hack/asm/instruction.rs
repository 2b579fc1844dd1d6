//! The instruction set of the Hack CPU (*The Elements of Computing Systems*,
//! chapter 4): its words, and how they are written.
//!
//! A word below 32,768 is `@value`: A = value. Any other is
//! `dest=comp;jump`, in bits `1xx accccccc dddjjj` without the second `c`:
//! seven bits of computation (`a` chooses M for A), three of destinations
//! (A, D, M) and three of conditions (below, equal to, above zero). The bits
//! marked `x` are 1 in what the assembler makes and nothing to the CPU.

/// The largest value of `@value`.
pub const LARGEST: u16 = 0x7fff;

/// Destinations of a computation, as bits of the word.
pub const DEST_A: u16 = 0b100_000;
/// D.
pub const DEST_D: u16 = 0b010_000;
/// The word at address A, as A was before the instruction.
pub const DEST_M: u16 = 0b001_000;

/// Conditions of a jump, as bits of the word: taken where the result is below zero.
pub const JLT: u16 = 0b100;
/// Taken where it is zero.
pub const JEQ: u16 = 0b010;
/// Taken where it is above zero.
pub const JGT: u16 = 0b001;
/// Always taken.
pub const JMP: u16 = JLT | JEQ | JGT;

/// The bits that every computation has.
pub const COMPUTE: u16 = 0b111 << 13;

/// The seven bits of each computation: of `a` and of the ALU's controls.
#[allow(missing_docs)] // the names are the texts of the table below
pub mod comp {
    pub const ZERO: u16 = 0b0101010;
    pub const ONE: u16 = 0b0111111;
    pub const MINUS_ONE: u16 = 0b0111010;
    pub const D: u16 = 0b0001100;
    pub const A: u16 = 0b0110000;
    pub const M: u16 = 0b1110000;
    pub const NOT_D: u16 = 0b0001101;
    pub const NOT_A: u16 = 0b0110001;
    pub const NOT_M: u16 = 0b1110001;
    pub const NEG_D: u16 = 0b0001111;
    pub const NEG_A: u16 = 0b0110011;
    pub const NEG_M: u16 = 0b1110011;
    pub const D_PLUS_1: u16 = 0b0011111;
    pub const A_PLUS_1: u16 = 0b0110111;
    pub const M_PLUS_1: u16 = 0b1110111;
    pub const D_MINUS_1: u16 = 0b0001110;
    pub const A_MINUS_1: u16 = 0b0110010;
    pub const M_MINUS_1: u16 = 0b1110010;
    pub const D_PLUS_A: u16 = 0b0000010;
    pub const D_PLUS_M: u16 = 0b1000010;
    pub const D_MINUS_A: u16 = 0b0010011;
    pub const D_MINUS_M: u16 = 0b1010011;
    pub const A_MINUS_D: u16 = 0b0000111;
    pub const M_MINUS_D: u16 = 0b1000111;
    pub const D_AND_A: u16 = 0b0000000;
    pub const D_AND_M: u16 = 0b1000000;
    pub const D_OR_A: u16 = 0b0010101;
    pub const D_OR_M: u16 = 0b1010101;
}

/// Computations: how each is written, and its seven bits.
pub const COMPS: [(&str, u16); 28] = [
    ("0", comp::ZERO),
    ("1", comp::ONE),
    ("-1", comp::MINUS_ONE),
    ("D", comp::D),
    ("A", comp::A),
    ("M", comp::M),
    ("!D", comp::NOT_D),
    ("!A", comp::NOT_A),
    ("!M", comp::NOT_M),
    ("-D", comp::NEG_D),
    ("-A", comp::NEG_A),
    ("-M", comp::NEG_M),
    ("D+1", comp::D_PLUS_1),
    ("A+1", comp::A_PLUS_1),
    ("M+1", comp::M_PLUS_1),
    ("D-1", comp::D_MINUS_1),
    ("A-1", comp::A_MINUS_1),
    ("M-1", comp::M_MINUS_1),
    ("D+A", comp::D_PLUS_A),
    ("D+M", comp::D_PLUS_M),
    ("D-A", comp::D_MINUS_A),
    ("D-M", comp::D_MINUS_M),
    ("A-D", comp::A_MINUS_D),
    ("M-D", comp::M_MINUS_D),
    ("D&A", comp::D_AND_A),
    ("D&M", comp::D_AND_M),
    ("D|A", comp::D_OR_A),
    ("D|M", comp::D_OR_M),
];

/// The other order of those that have two.
const TURNED: [(&str, &str); 6] = [
    ("A+D", "D+A"),
    ("M+D", "D+M"),
    ("A&D", "D&A"),
    ("M&D", "D&M"),
    ("A|D", "D|A"),
    ("M|D", "D|M"),
];

/// Jumps, by their three bits.
const JUMPS: [&str; 8] = ["", "JGT", "JEQ", "JGE", "JLT", "JNE", "JLE", "JMP"];

/// The bits of a computation as written without blanks, in its place in the word.
pub fn computation(text: &str) -> Option<u16> {
    let turned = TURNED.iter().find(|(turned, _)| *turned == text);
    let text = turned.map_or(text, |(_, usual)| usual);
    let found = COMPS.iter().find(|(name, _)| *name == text);
    found.map(|(_, bits)| bits << 6)
}

/// The bits of destinations: `A`, `D` and `M`, each once, in any order.
pub fn dest(text: &str) -> Option<u16> {
    let mut bits = 0;
    for c in text.chars() {
        let bit = match c {
            'A' => DEST_A,
            'D' => DEST_D,
            'M' => DEST_M,
            _ => return None,
        };
        if bits & bit != 0 {
            return None;
        }
        bits |= bit;
    }
    (bits != 0).then_some(bits)
}

/// The bits of a jump.
pub fn jump(text: &str) -> Option<u16> {
    let found = JUMPS.iter().skip(1).position(|name| *name == text);
    found.map(|at| at as u16 + 1)
}

/// An instruction as the assembler reads it; `None` for a computation that has
/// no name.
pub fn written(word: u16) -> Option<String> {
    if word <= LARGEST {
        return Some(format!("@{word}"));
    }
    let bits = word >> 6 & 0b111_1111;
    let (name, _) = COMPS.iter().find(|(_, known)| *known == bits)?;
    let mut text = String::new();
    for (bit, name) in [(DEST_A, 'A'), (DEST_D, 'D'), (DEST_M, 'M')] {
        if word & bit != 0 {
            text.push(name);
        }
    }
    if !text.is_empty() {
        text.push('=');
    }
    text.push_str(name);
    if let Some(jump) = JUMPS.get(usize::from(word & JMP)).filter(|j| !j.is_empty()) {
        text.push(';');
        text.push_str(jump);
    }
    Some(text)
}
