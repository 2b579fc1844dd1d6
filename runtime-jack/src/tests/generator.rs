//! The operands that the harness's Jack makes and the sums that it forms, a second time.

use crate::model::{Float, int, int_bits, wrap};
use crate::wide::model::Wide;
use slowlight_routine::{Bits, Format};

/// The generator: what `Main.random` does. The lower half of its state comes back after
/// 65,536 draws; [`Generator::stir`] changes the upper, which is added to what is drawn.
pub struct Generator(pub i32);

/// Stirs the generator in Jack. Without that, it would draw four thousand pairs of
/// Floats, again and again: enough for counting commands, which goes without.
pub const STIR: &str = "let block = block + 9973;";

impl Generator {
    pub fn next(&mut self) -> i32 {
        let seed = wrap((self.0 & 0xFFFF).wrapping_mul(25173).wrapping_add(13849));
        self.0 = self.0 >> 16 << 16 | seed & 0xFFFF;
        (seed + (self.0 >> 16)) & 32767
    }

    /// What [`STIR`] does, before every thousand pairs.
    pub fn stir(&mut self) {
        self.0 = wrap((self.0 >> 16) + 9973) << 16 | self.0 & 0xFFFF;
    }

    /// Sign, exponent and mantissa, with so many words behind its first.
    fn float(&mut self, lower: usize) -> (Float, i32) {
        let kind = self.next() / 4096;
        let e = match kind {
            0 => (self.next() - 8000).min(8000),
            _ => 117 + self.next() / 1638,
        };
        let s = self.next() / 16384;
        let m = 8192 + self.next() / 4;
        let l = (0..lower).fold(0, |_, _| self.next() / 2);
        if kind == 7 && self.next() < 4096 {
            (Float { s, e: 0, m: 0 }, 0)
        } else {
            (Float { s, e, m }, l)
        }
    }

    fn int(&mut self) -> i32 {
        let kind = self.next() / 8192;
        let whole = self.next();
        match kind {
            0 => (whole - 16384) * 2 + self.next() / 16384,
            1 => whole / 64 - 256,
            _ => whole / 2048 - 8,
        }
    }

    pub fn bits(&mut self, format: Format) -> Bits {
        match format {
            Format::Bool => Bits::from(self.next() < 16384),
            Format::Float316 { .. } => self.float(0).0.bits(),
            Format::Float416 => {
                let (Float { s, e, m }, l) = self.float(1);
                let m = i64::from(m << 14 | l);
                Wide { s, e, m }.bits()
            }
            _ => int_bits(self.int()),
        }
    }
}

/// What does something for all pairs of these ints, in the order of the model's loops; it
/// uses the variables `k`, `l` and `edges` of the harness's `main`.
pub fn all_pairs(edges: &[i32], [a, b]: [&str; 2], step: &str) -> String {
    if edges.is_empty() {
        return String::new();
    }
    let count = edges.len();
    let mut text = format!("let edges = Array.new({count});\n");
    for (k, edge) in edges.iter().enumerate() {
        // Jack has no -32768.
        let int = match edge {
            -32768 => "(-32767) - 1".to_owned(),
            _ => edge.to_string(),
        };
        text += &format!("let edges[{k}] = {int};\n");
    }
    text += &format!(
        "let k = 0;\nwhile (k < {count}) {{\nlet l = 0;\nwhile (l < {count}) {{\n\
         let {a} = edges[k];\nlet {b} = edges[l];\n{step}let l = l + 1; }}\nlet k = k + 1; }}\n"
    );
    text
}

/// The two sums over results.
#[derive(Debug, Default, PartialEq)]
pub struct Sums(pub i32, pub i32);

impl Sums {
    pub fn note(&mut self, word: i32) {
        self.0 = wrap(self.0.wrapping_mul(31).wrapping_add(word));
        self.1 = wrap(
            (self.1.wrapping_add(word))
                .wrapping_mul(25173)
                .wrapping_add(1),
        );
    }

    pub fn result(&mut self, bits: Bits, format: Format) {
        match format {
            Format::Bool => self.note(if bits == 0 { 0 } else { -1 }),
            format if format.is_object() => {
                let words = crate::words(bits, format);
                words.into_iter().for_each(|word| self.note(word));
            }
            _ => self.note(int(bits)),
        }
    }
}

#[test]
fn pairs_are_hardly_ever_drawn_twice() {
    let mut generator = Generator(1);
    let mut pairs: Vec<[Bits; 2]> = Vec::new();
    for k in 0..1_000_000 {
        if k % 1000 == 0 {
            generator.stir();
        }
        pairs.push([FLOAT, FLOAT].map(|format| generator.bits(format)));
    }
    pairs.sort_unstable();
    pairs.dedup();
    assert!(pairs.len() > 980_000, "{}", pairs.len());
}

const FLOAT: Format = Format::Float316 { rounded: false };
