//! The keywords of BASIC II, their tokens, and what each does to the rest of the line.
//!
//! A program is stored with one byte, &80 to &FF, for each keyword. The table is in the
//! order in which the machine searches it, which decides what an abbreviation (`P.`) means.
//! Source: *The BBC Microcomputer User Guide* and the *Advanced User Guide* (tokens and flags).

/// Not a keyword where a letter, digit or `_` follows: `ENDING` is a variable, `TIMER` is not.
pub const COND: u8 = 1;
/// What follows is inside a statement: `*` and pseudo-variables on the left are over.
pub const MID: u8 = 2;
/// A statement may start after it (`THEN`, `ELSE`, `ERROR`, `LET`).
pub const START: u8 = 4;
/// A name follows and holds no keywords (`FN`, `PROC`).
pub const NAME: u8 = 8;
/// Line numbers follow, stored in three bytes each after [`LINE_NUMBER`].
pub const LINES: u8 = 16;
/// The rest of the line is not tokenised (`REM`, `DATA`).
pub const REST: u8 = 32;
/// A pseudo-variable: at the start of a statement its token is &40 more (`TIME = 0`).
pub const PSEUDO: u8 = 64;

/// The byte before an encoded line number.
pub const LINE_NUMBER: u8 = 0x8d;

/// One keyword.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keyword {
    /// As it is written.
    pub name: &'static str,
    /// The token.
    pub token: u8,
    /// The flags above.
    pub flags: u8,
}

const fn k(name: &'static str, token: u8, flags: u8) -> Keyword {
    Keyword { name, token, flags }
}

/// Every keyword, in the order of the search.
#[rustfmt::skip]
pub const KEYWORDS: &[Keyword] = &[
    k("AND", 0x80, 0),
    k("ABS", 0x94, 0),
    k("ACS", 0x95, 0),
    k("ADVAL", 0x96, 0),
    k("ASC", 0x97, 0),
    k("ASN", 0x98, 0),
    k("ATN", 0x99, 0),
    k("AUTO", 0xc6, LINES),
    k("BGET", 0x9a, COND),
    k("BPUT", 0xd5, COND | MID),
    k("COLOUR", 0xfb, MID),
    k("CALL", 0xd6, MID),
    k("CHAIN", 0xd7, MID),
    k("CHR$", 0xbd, 0),
    k("CLEAR", 0xd8, COND),
    k("CLOSE", 0xd9, COND | MID),
    k("CLG", 0xda, COND),
    k("CLS", 0xdb, COND),
    k("COS", 0x9b, 0),
    k("COUNT", 0x9c, COND),
    k("DATA", 0xdc, REST),
    k("DEG", 0x9d, 0),
    k("DEF", 0xdd, 0),
    k("DELETE", 0xc7, LINES),
    k("DIV", 0x81, 0),
    k("DIM", 0xde, MID),
    k("DRAW", 0xdf, MID),
    k("ENDPROC", 0xe1, COND),
    k("END", 0xe0, COND),
    k("ENVELOPE", 0xe2, MID),
    k("ELSE", 0x8b, START | LINES),
    k("EVAL", 0xa0, 0),
    k("ERL", 0x9e, COND),
    k("ERROR", 0x85, START),
    k("EOF", 0xc5, COND),
    k("EOR", 0x82, 0),
    k("ERR", 0x9f, COND),
    k("EXP", 0xa1, 0),
    k("EXT", 0xa2, COND),
    k("FOR", 0xe3, MID),
    k("FALSE", 0xa3, COND),
    k("FN", 0xa4, NAME),
    k("GOTO", 0xe5, MID | LINES),
    k("GET$", 0xbe, 0),
    k("GET", 0xa5, 0),
    k("GOSUB", 0xe4, MID | LINES),
    k("GCOL", 0xe6, MID),
    k("HIMEM", 0x93, COND | MID | PSEUDO),
    k("INPUT", 0xe8, MID),
    k("IF", 0xe7, MID),
    k("INKEY$", 0xbf, 0),
    k("INKEY", 0xa6, 0),
    k("INT", 0xa8, 0),
    k("INSTR(", 0xa7, 0),
    k("LIST", 0xc9, LINES),
    k("LINE", 0x86, 0),
    k("LOAD", 0xc8, MID),
    k("LOMEM", 0x92, COND | MID | PSEUDO),
    k("LOCAL", 0xea, MID),
    k("LEFT$(", 0xc0, 0),
    k("LEN", 0xa9, 0),
    k("LET", 0xe9, START),
    k("LOG", 0xab, 0),
    k("LN", 0xaa, 0),
    k("MID$(", 0xc1, 0),
    k("MODE", 0xeb, MID),
    k("MOD", 0x83, 0),
    k("MOVE", 0xec, MID),
    k("NEXT", 0xed, MID),
    k("NEW", 0xca, COND),
    k("NOT", 0xac, 0),
    k("OLD", 0xcb, COND),
    k("ON", 0xee, MID),
    k("OFF", 0x87, 0),
    k("OR", 0x84, 0),
    k("OPENIN", 0x8e, 0),
    k("OPENOUT", 0xae, 0),
    k("OPENUP", 0xad, 0),
    k("OSCLI", 0xff, MID),
    k("PRINT", 0xf1, MID),
    k("PAGE", 0x90, COND | MID | PSEUDO),
    k("PTR", 0x8f, COND | MID | PSEUDO),
    k("PI", 0xaf, COND),
    k("PLOT", 0xf0, MID),
    k("POINT(", 0xb0, 0),
    k("PROC", 0xf2, MID | NAME),
    k("POS", 0xb1, COND),
    k("RETURN", 0xf8, COND),
    k("REPEAT", 0xf5, 0),
    k("REPORT", 0xf6, COND),
    k("READ", 0xf3, MID),
    k("REM", 0xf4, REST),
    k("RUN", 0xf9, COND),
    k("RAD", 0xb2, 0),
    k("RESTORE", 0xf7, MID | LINES),
    k("RIGHT$(", 0xc2, 0),
    k("RND", 0xb3, COND),
    k("RENUMBER", 0xcc, LINES),
    k("STEP", 0x88, 0),
    k("SAVE", 0xcd, MID),
    k("SGN", 0xb4, 0),
    k("SIN", 0xb5, 0),
    k("SQR", 0xb6, 0),
    k("SPC", 0x89, 0),
    k("STR$", 0xc3, 0),
    k("STRING$(", 0xc4, 0),
    k("SOUND", 0xd4, MID),
    k("STOP", 0xfa, COND),
    k("TAN", 0xb7, 0),
    k("THEN", 0x8c, START | LINES),
    k("TO", 0xb8, 0),
    k("TAB(", 0x8a, 0),
    k("TRACE", 0xfc, MID | LINES),
    k("TIME", 0x91, COND | MID | PSEUDO),
    k("TRUE", 0xb9, COND),
    k("UNTIL", 0xfd, MID),
    k("USR", 0xba, 0),
    k("VDU", 0xef, MID),
    k("VAL", 0xbb, 0),
    k("VPOS", 0xbc, COND),
    k("WIDTH", 0xfe, MID),
];

/// Names for the tokens that an interpreter meets.
#[rustfmt::skip]
pub mod token {
    #![allow(missing_docs)]
    pub const AND: u8 = 0x80;
    pub const ABS: u8 = 0x94;
    pub const ACS: u8 = 0x95;
    pub const ADVAL: u8 = 0x96;
    pub const ASC: u8 = 0x97;
    pub const ASN: u8 = 0x98;
    pub const ATN: u8 = 0x99;
    pub const AUTO: u8 = 0xc6;
    pub const BGET: u8 = 0x9a;
    pub const BPUT: u8 = 0xd5;
    pub const COLOUR: u8 = 0xfb;
    pub const CALL: u8 = 0xd6;
    pub const CHAIN: u8 = 0xd7;
    pub const CHR_STR: u8 = 0xbd;
    pub const CLEAR: u8 = 0xd8;
    pub const CLOSE: u8 = 0xd9;
    pub const CLG: u8 = 0xda;
    pub const CLS: u8 = 0xdb;
    pub const COS: u8 = 0x9b;
    pub const COUNT: u8 = 0x9c;
    pub const DATA: u8 = 0xdc;
    pub const DEG: u8 = 0x9d;
    pub const DEF: u8 = 0xdd;
    pub const DELETE: u8 = 0xc7;
    pub const DIV: u8 = 0x81;
    pub const DIM: u8 = 0xde;
    pub const DRAW: u8 = 0xdf;
    pub const ENDPROC: u8 = 0xe1;
    pub const END: u8 = 0xe0;
    pub const ENVELOPE: u8 = 0xe2;
    pub const ELSE: u8 = 0x8b;
    pub const EVAL: u8 = 0xa0;
    pub const ERL: u8 = 0x9e;
    pub const ERROR: u8 = 0x85;
    pub const EOF: u8 = 0xc5;
    pub const EOR: u8 = 0x82;
    pub const ERR: u8 = 0x9f;
    pub const EXP: u8 = 0xa1;
    pub const EXT: u8 = 0xa2;
    pub const FOR: u8 = 0xe3;
    pub const FALSE: u8 = 0xa3;
    pub const FN: u8 = 0xa4;
    pub const GOTO: u8 = 0xe5;
    pub const GET_STR: u8 = 0xbe;
    pub const GET: u8 = 0xa5;
    pub const GOSUB: u8 = 0xe4;
    pub const GCOL: u8 = 0xe6;
    pub const HIMEM: u8 = 0x93;
    pub const INPUT: u8 = 0xe8;
    pub const IF: u8 = 0xe7;
    pub const INKEY_STR: u8 = 0xbf;
    pub const INKEY: u8 = 0xa6;
    pub const INT: u8 = 0xa8;
    pub const INSTR: u8 = 0xa7;
    pub const LIST: u8 = 0xc9;
    pub const LINE: u8 = 0x86;
    pub const LOAD: u8 = 0xc8;
    pub const LOMEM: u8 = 0x92;
    pub const LOCAL: u8 = 0xea;
    pub const LEFT_STR: u8 = 0xc0;
    pub const LEN: u8 = 0xa9;
    pub const LET: u8 = 0xe9;
    pub const LOG: u8 = 0xab;
    pub const LN: u8 = 0xaa;
    pub const MID_STR: u8 = 0xc1;
    pub const MODE: u8 = 0xeb;
    pub const MOD: u8 = 0x83;
    pub const MOVE: u8 = 0xec;
    pub const NEXT: u8 = 0xed;
    pub const NEW: u8 = 0xca;
    pub const NOT: u8 = 0xac;
    pub const OLD: u8 = 0xcb;
    pub const ON: u8 = 0xee;
    pub const OFF: u8 = 0x87;
    pub const OR: u8 = 0x84;
    pub const OPENIN: u8 = 0x8e;
    pub const OPENOUT: u8 = 0xae;
    pub const OPENUP: u8 = 0xad;
    pub const OSCLI: u8 = 0xff;
    pub const PRINT: u8 = 0xf1;
    pub const PAGE: u8 = 0x90;
    pub const PTR: u8 = 0x8f;
    pub const PI: u8 = 0xaf;
    pub const PLOT: u8 = 0xf0;
    pub const POINT: u8 = 0xb0;
    pub const PROC: u8 = 0xf2;
    pub const POS: u8 = 0xb1;
    pub const RETURN: u8 = 0xf8;
    pub const REPEAT: u8 = 0xf5;
    pub const REPORT: u8 = 0xf6;
    pub const READ: u8 = 0xf3;
    pub const REM: u8 = 0xf4;
    pub const RUN: u8 = 0xf9;
    pub const RAD: u8 = 0xb2;
    pub const RESTORE: u8 = 0xf7;
    pub const RIGHT_STR: u8 = 0xc2;
    pub const RND: u8 = 0xb3;
    pub const RENUMBER: u8 = 0xcc;
    pub const STEP: u8 = 0x88;
    pub const SAVE: u8 = 0xcd;
    pub const SGN: u8 = 0xb4;
    pub const SIN: u8 = 0xb5;
    pub const SQR: u8 = 0xb6;
    pub const SPC: u8 = 0x89;
    pub const STR_STR: u8 = 0xc3;
    pub const STRING_STR: u8 = 0xc4;
    pub const SOUND: u8 = 0xd4;
    pub const STOP: u8 = 0xfa;
    pub const TAN: u8 = 0xb7;
    pub const THEN: u8 = 0x8c;
    pub const TO: u8 = 0xb8;
    pub const TAB: u8 = 0x8a;
    pub const TRACE: u8 = 0xfc;
    pub const TIME: u8 = 0x91;
    pub const TRUE: u8 = 0xb9;
    pub const UNTIL: u8 = 0xfd;
    pub const USR: u8 = 0xba;
    pub const VDU: u8 = 0xef;
    pub const VAL: u8 = 0xbb;
    pub const VPOS: u8 = 0xbc;
    pub const WIDTH: u8 = 0xfe;
    pub const SET_PTR: u8 = 0xcf;
    pub const SET_PAGE: u8 = 0xd0;
    pub const SET_TIME: u8 = 0xd1;
    pub const SET_LOMEM: u8 = 0xd2;
    pub const SET_HIMEM: u8 = 0xd3;
}

/// The keyword that a token stands for; pseudo-variables under both their tokens.
pub fn keyword(token: u8) -> Option<&'static Keyword> {
    KEYWORDS.iter().find(|k| {
        k.token == token || (k.flags & PSEUDO != 0 && k.token.wrapping_add(0x40) == token)
    })
}

/// A line number's three bytes after [`LINE_NUMBER`]: no byte below &40, so that none looks
/// like a quote or an end of line.
pub fn encode_line(line: u16) -> [u8; 3] {
    let [lo, hi] = line.to_le_bytes();
    [
        ((lo & 0xc0) >> 2 | (hi & 0xc0) >> 4) ^ 0x54,
        lo & 0x3f | 0x40,
        hi & 0x3f | 0x40,
    ]
}

/// The line number of three bytes.
pub fn decode_line(bytes: [u8; 3]) -> u16 {
    let top = bytes[0] ^ 0x54;
    let lo = (top << 2) & 0xc0 | bytes[1] & 0x3f;
    let hi = (top << 4) & 0xc0 | bytes[2] & 0x3f;
    u16::from_le_bytes([lo, hi])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_numbers_survive() {
        for n in 0..=u16::MAX {
            assert_eq!(decode_line(encode_line(n)), n);
            assert!(encode_line(n).iter().all(|b| (0x40..0x80).contains(b)));
        }
        // Seen in a program saved by the machine: GOTO 10.
        assert_eq!(encode_line(10), [0x54, 0x4a, 0x40]);
    }

    #[test]
    fn tokens_are_distinct() {
        for (i, a) in KEYWORDS.iter().enumerate() {
            for b in &KEYWORDS[i + 1..] {
                assert_ne!(a.token, b.token, "{} {}", a.name, b.name);
                assert_ne!(a.name, b.name);
            }
        }
        assert_eq!(keyword(token::SET_TIME).map(|k| k.name), Some("TIME"));
        assert_eq!(keyword(LINE_NUMBER), None);
    }
}
