//! Products written in place, where a program has memory for that: no call, operands read
//! where they are, nothing asked of a sign that is known, and no pointers set again for an
//! operand that the product before had, too. The bits are those of `product16` and `up`.
//!
//! The four products of bytes are those of the subroutine (`asm/scaled/product.asm`): of the
//! lower bytes' only the upper byte, of the others both. The first factor is pointed to, the
//! second one is in Y; a constant is the first, and needs no pointers.

use super::templates as t;
use crate::write::{Place, byte};

/// A product to be written in place.
#[derive(Clone, Copy, Debug)]
pub struct Inline<'a> {
    /// The factors.
    pub args: [&'a Place; 2],
    /// Which of them are known not to be below 0.
    pub positive: [bool; 2],
    /// The symbol of the factor that the quarter squares' pointers still are for.
    pub kept: Option<&'a str>,
    /// The factor that a product behind this one has, too.
    pub again: Option<usize>,
    /// Where the result goes.
    pub to: &'a str,
    /// Must differ at each use in a program.
    pub serial: u32,
}

/// What is done with the upper 24 bits of a product.
enum Tail {
    /// So many bits to the left, then rounded.
    Up(usize),
    /// The same, where the result may not fit.
    Held(usize),
}

fn tail(text: &str) -> Option<Tail> {
    let all = [
        (t::MULTIPLY_16, Tail::Up(0)),
        (t::MULTIPLY_15, Tail::Up(1)),
        (t::MULTIPLY_14, Tail::Up(2)),
        (t::MULTIPLY_13, Tail::Up(3)),
        (t::MULTIPLY_12, Tail::Up(4)),
        (t::MULTIPLY_ANY_14, Tail::Held(2)),
        (t::MULTIPLY_ANY_13, Tail::Held(3)),
        (t::MULTIPLY_ANY_12, Tail::Held(4)),
    ];
    all.into_iter()
        .find(|(known, _)| *known == text)
        .map(|(_, tail)| tail)
}

/// Whether a routine's text can be written in place.
pub fn can(text: &str) -> bool {
    tail(text).is_some()
}

/// What is written for a number times itself: the bits of `square16`. The pointers are for
/// its size then.
pub fn square(text: &str, used: Inline<'_>, lines: &mut Vec<String>) -> Option<()> {
    let tail = tail(text)?;
    let [low, high] = [0, 1].map(|k| byte(used.args[0], k));
    let (n, to) = (used.serial, used.to);
    let size = match used.positive[0] {
        true => String::new(),
        false => format!(
            "cpx #$80 | bcc plus{n} | eor #$ff | clc | adc #1 | tay | txa | eor #$ff | adc #0 | tax | tya | plus{n}:"
        ),
    };
    let mut written = Product {
        used,
        a: used.args[0],
        b: used.args[0],
        positive: used.positive,
        lines,
    };
    written.code(&format!(
        "lda {low} | ldx {high} | {size} | sta sum_hi | tay | lda (sum_hi),y | sta prod+1
        | stx sum1_lo | stx sum1_hi | txa | eor #$ff | sta dif1_lo | sta dif1_hi
        | sec | lda (sum1_lo),y | sbc (dif1_lo),y | sta across | lda (sum1_hi),y | sbc (dif1_hi),y
        | asl across | rol | sta {to} | clc | lda across | adc prod+1 | sta prod+1
        | ldy sum1_lo | lda (sum1_lo),y | adc {to} | sta {to} | lda (sum1_hi),y | adc #0"
    ));
    if matches!(tail, Tail::Held(_)) {
        written.code("tay");
    }
    written.rest(tail);
    Some(())
}

/// Whether a routine's text is one over a number.
pub fn is_one_over(text: &str) -> bool {
    text == t::ONE_OVER
}

/// A power of two over a number that is not below 0: the reciprocal so many bits to the
/// right, less those that the number is shifted; the bits of `one_over`.
pub fn one_over(of: &Place, bits: i32, to: &str, serial: u32, lines: &mut Vec<String>) {
    let [low, high] = [0, 1].map(|k| byte(of, k));
    let n = serial;
    let bits = bits & 0xFF;
    let text = format!(
        "lda {low} | sta arg | lda {high} | sta arg+1 | ora arg | beq most{n} | jsr reciprocal
        | stx prod | lda #{bits} | sec | sbc prod | beq most{n} | bmi most{n} | cmp #17 | bcs none{n}
        | tax | lda prod+5 | bit{n}: | lsr | ror prod+4 | dex | bne bit{n}
        | bcc near{n} | inc prod+4 | bne near{n} | adc #0 | near{n}: | cmp #$80 | bcs most{n}
        | sta {to}+1 | lda prod+4 | sta {to} | bcc over{n}
        | none{n}: | lda #0 | sta {to} | sta {to}+1 | beq over{n}
        | most{n}: | lda #$ff | sta {to} | lda #$7f | sta {to}+1 | over{n}:"
    );
    put(&text, lines);
}

/// Instructions, separated by `|`.
pub(super) fn put(text: &str, lines: &mut Vec<String>) {
    for instruction in text.split('|').map(str::trim).filter(|i| !i.is_empty()) {
        let indent = if instruction.ends_with(':') {
            ""
        } else {
            "        "
        };
        lines.push(format!("{indent}{instruction}"));
    }
}

/// Writes a product; answers the symbol of the factor that the pointers are for then.
pub fn product(text: &str, used: Inline<'_>, lines: &mut Vec<String>) -> Option<String> {
    let tail = tail(text)?;
    let symbol = |place: &Place| match place {
        Place::At(symbol) | Place::Held(symbol, _) => Some(symbol.clone()),
        Place::Constant(_) | Place::Signed(..) => None,
    };
    let [a, b] = used.args.map(symbol);
    let first = match (&a, &b) {
        (None, _) => 0,
        (_, None) => 1,
        _ if used.kept.is_some() && used.kept == a.as_deref() => 0,
        _ if used.kept.is_some() && used.kept == b.as_deref() => 1,
        _ => used.again.unwrap_or(0).min(1),
    };
    let other = 1 - first;
    let mut written = Product {
        used,
        a: used.args[first],
        b: used.args[other],
        positive: [used.positive[first], used.positive[other]],
        lines,
    };
    let pointed = match first {
        0 => a,
        _ => b,
    };
    if pointed.is_some() && pointed.as_deref() != used.kept {
        written.point();
    }
    written.lower();
    written.upper();
    written.signs();
    written.rest(tail);
    pointed.or_else(|| used.kept.map(str::to_owned))
}

struct Product<'a, 'l> {
    used: Inline<'a>,
    a: &'a Place,
    b: &'a Place,
    positive: [bool; 2],
    lines: &'l mut Vec<String>,
}

impl Product<'_, '_> {
    fn code(&mut self, text: &str) {
        put(text, self.lines);
    }

    /// Sets the pointers for both bytes of the first factor.
    fn point(&mut self) {
        for (k, which) in [(0, ""), (1, "1")] {
            let from = byte(self.a, k);
            self.code(&format!(
                "lda {from} | sta sum{which}_lo | sta sum{which}_hi | eor #$ff | sta dif{which}_lo | sta dif{which}_hi"
            ));
        }
    }

    /// Byte `k` of the first factor times Y: its lower or upper byte, in A. The carry must be
    /// what was borrowed below.
    fn times(&mut self, k: u8, half: &str) {
        let which = if k == 0 { "" } else { "1" };
        match self.a {
            Place::Constant(bits) => {
                let at = (bits >> (8 * u32::from(k))) & 255;
                self.code(&format!(
                    "lda sqr_{half}+{at},y | sbc sqd_{half}+{},y",
                    255 - at
                ));
            }
            _ => self.code(&format!(
                "lda (sum{which}_{half}),y | sbc (dif{which}_{half}),y"
            )),
        }
    }

    /// The products with the second factor's lower byte: their sum's lower byte in `prod+1`
    /// and its upper one in X.
    fn lower(&mut self) {
        let n = self.used.serial;
        let low = byte(self.b, 0);
        self.code(&format!("ldy {low} | sec"));
        self.times(1, "lo");
        self.code("sta prod+1");
        self.times(1, "hi");
        // Nothing is borrowed from a whole product.
        self.code("tax");
        self.times(0, "hi");
        self.code(&format!(
            "clc | adc prod+1 | bcc lowest{n} | inx | lowest{n}: | sta prod+1"
        ));
    }

    /// Those with its upper byte, and the sum of all: its lowest byte in `prod+1`, the next
    /// one where the result goes, the upper one in Y.
    fn upper(&mut self) {
        let n = self.used.serial;
        let to = self.used.to;
        let high = byte(self.b, 1);
        self.code(&format!("ldy {high} | sec"));
        self.times(0, "lo");
        self.code("sta prod+2");
        self.times(0, "hi");
        self.code("sta across");
        self.times(1, "lo");
        self.code("sta above");
        self.times(1, "hi");
        self.code(&format!(
            "tay | clc | lda prod+2 | adc prod+1 | sta prod+1 | txa | adc across | bcc across{n} | iny | clc
            | across{n}: | adc above | bcc above{n} | iny | above{n}: | sta {to}"
        ));
    }

    /// A factor below 0 was taken for 65536 more.
    fn signs(&mut self) {
        let n = self.used.serial;
        let to = self.used.to;
        let pairs = [(self.a, self.b, "a", 0), (self.b, self.a, "b", 1)];
        for (factor, other, name, k) in pairs {
            let [low, high] = [0, 1].map(|k| byte(other, k));
            let take = format!("sec | lda {to} | sbc {low} | sta {to} | tya | sbc {high} | tay");
            match factor {
                _ if self.positive[k] => {}
                Place::Constant(bits) if bits >> 15 & 1 == 0 => {}
                Place::Constant(_) => self.code(&take),
                _ => {
                    let sign = byte(factor, 1);
                    self.code(&format!(
                        "lda {sign} | bpl plus{name}{n} | {take} | plus{name}{n}:"
                    ));
                }
            }
        }
        self.code("tya");
    }

    fn rest(&mut self, tail: Tail) {
        let Inline { to, serial: n, .. } = self.used;
        let up = format!("asl prod+1 | rol {to} | rol | ");
        let round =
            format!("ldx prod+1 | bpl rounded{n} | inc {to} | bne rounded{n} | clc | adc #1");
        match tail {
            Tail::Up(bits) => self.code(&format!(
                "{} {round} | rounded{n}: | sta {to}+1",
                up.repeat(bits)
            )),
            Tail::Held(bits) => {
                let end = 0x80u32 >> bits;
                // What is lost above must be the sign; the one number that has no negative
                // is none of ours.
                self.code(&format!(
                    "clc | adc #{end} | cmp #{} | bcs large{n} | tya | {} {round} | bvs most{n}
                    | rounded{n}: | sta {to}+1 | cmp #$80 | bne held{n} | lda {to} | bne held{n} | inc {to} | bne held{n}
                    | large{n}: | tya | bmi least{n}
                    | most{n}: | lda #$ff | sta {to} | lda #$7f | sta {to}+1 | bne held{n}
                    | least{n}: | lda #1 | sta {to} | lda #$80 | sta {to}+1 | held{n}:",
                    2 * end,
                    up.repeat(bits)
                ));
            }
        }
    }
}
