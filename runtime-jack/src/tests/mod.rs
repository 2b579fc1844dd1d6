#![allow(clippy::unwrap_used)]
//! The models against the facts, and the Jack source against the models.

mod errors;
mod facts;
mod functions;
pub mod generator;
pub mod machine;
mod os;
mod starts;
mod table;

use crate::model::{BOTTOM, Float, TOP, int_bits};
use crate::wide::F416;
use crate::wide::model::Wide;
use crate::{F316, F316R};
use slowlight_routine::{Bits, Format};

/// A generator of test values (xorshift).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    pub fn below(&mut self, n: u64) -> i32 {
        (self.next() >> 11).checked_rem(n).unwrap_or(0) as i32
    }

    /// A Float near 1 mostly, of any exponent now and then.
    pub fn float(&mut self) -> Float {
        let e = match self.below(8) {
            0 => BOTTOM + self.below(16001),
            1 => 127,
            _ => 117 + self.below(20),
        };
        let s = self.below(2);
        let m = 8192 + self.below(8192);
        if self.below(50) == 0 {
            Float { s, ..Float::ZERO }
        } else {
            Float { s, e, m }
        }
    }

    /// The same with more bits, of which the last are often alike.
    pub fn wide(&mut self) -> Wide {
        let Float { s, e, m } = self.float();
        let l = match self.below(6) {
            0 => 0,
            1 => 16383 - self.below(3),
            _ => self.below(16384),
        };
        let l = if m == 0 { 0 } else { l };
        let m = i64::from(m << 14 | l);
        Wide { s, e, m }
    }

    pub fn int(&mut self) -> i32 {
        let wide = self.below(65536) - 32768;
        match self.below(3) {
            0 => wide,
            1 => wide / 64,
            _ => wide / 4096,
        }
    }

    pub fn bits(&mut self, format: Format) -> Bits {
        match format {
            Format::Bool => self.next() & 1,
            Format::Float316 { .. } => self.float().bits(),
            Format::Float416 => self.wide().bits(),
            _ => int_bits(self.int()),
        }
    }
}

pub const EXPONENTS: &[i32] = &[
    BOTTOM,
    BOTTOM + 1,
    -1,
    0,
    1,
    113,
    114,
    126,
    127,
    128,
    139,
    140,
    141,
    142,
    143,
    TOP - 1,
    TOP,
];
pub const MANTISSAS: &[i32] = &[8192, 8193, 12288, 16382, 16383];
/// The lower words that mantissas of wide Floats have at the edges.
pub const LOWER: &[i32] = &[0, 16383, 8192, 0, 16383];

/// Floats at every edge: zeros, ends, powers of two and their neighbours.
pub fn float_edges() -> Vec<Float> {
    let mut all = vec![
        Float::ZERO,
        Float {
            s: 1,
            ..Float::ZERO
        },
    ];
    for &e in EXPONENTS {
        for &m in MANTISSAS {
            all.extend([Float { s: 0, e, m }, Float { s: 1, e, m }]);
        }
    }
    all
}

/// The same with lower words.
pub fn wide_edges() -> Vec<Wide> {
    let lower = |m| {
        let at = MANTISSAS.iter().position(|other| *other == m);
        at.map_or(0, |at| LOWER[at])
    };
    let wide = |Float { s, e, m }| Wide {
        s,
        e,
        m: i64::from(m << 14 | lower(m)),
    };
    float_edges().into_iter().map(wide).collect()
}

pub fn int_edges() -> Vec<i32> {
    vec![
        -32768, -32767, -32766, -16385, -16384, -16383, -256, -128, -127, -3, -2, -1, 0, 1, 2, 3,
        7, 8, 127, 128, 181, 182, 255, 16383, 16384, 16385, 32766, 32767,
    ]
}

/// Every edge operand of a format.
pub fn edges(format: Format) -> Vec<Bits> {
    match format {
        Format::Bool => vec![0, 1],
        Format::Float316 { .. } => float_edges().into_iter().map(Float::bits).collect(),
        Format::Float416 => wide_edges().into_iter().map(Wide::bits).collect(),
        _ => int_edges().into_iter().map(int_bits).collect(),
    }
}

#[test]
fn bits_go_there_and_back() {
    for f in float_edges() {
        assert_eq!(Float::from_bits(f.bits()), f);
    }
    assert_eq!(Float::from_bits(u64::MAX).m, 0, "no value of the format");
    for f in wide_edges() {
        assert_eq!(Wide::from_bits(f.bits()), f);
        let words = crate::words(f.bits(), F416.real);
        assert_eq!(words.len(), usize::from(F416.real.words()));
    }
    assert_eq!(Wide::from_bits(u64::MAX).m, 0, "no value of the format");
}

#[test]
fn names_are_unique_and_needs_exist() {
    for runtime in [&F316, &F316R, &F416] {
        let routines = runtime.routines.iter();
        let mut names: Vec<&str> = routines.clone().map(|r| r.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), runtime.routines.len());
        let parts = runtime.parts.iter().flat_map(|p| p.needs);
        for need in routines.flat_map(|r| r.needs).chain(parts) {
            assert!(runtime.part(need).is_some(), "{need}");
        }
    }
}

#[test]
fn a_class_holds_what_is_needed_and_no_more() {
    let text = |need| {
        let classes = crate::classes(&F316.closure([need]));
        assert_eq!(classes.len(), 1);
        classes[0].1.clone()
    };
    let mul = text("Float.mul");
    assert!(
        mul.starts_with("class Float {\n    field int s, e, m;\n"),
        "{mul}"
    );
    assert!(
        !mul.contains("powers") && !mul.contains("init") && !mul.contains(" add("),
        "{mul}"
    );
    let sqrt = text("Float.sqrt");
    for wanted in [
        "void add(",
        "void ratio(",
        "do Float.makePowers();",
        "static Array powers;",
    ] {
        assert!(sqrt.contains(wanted), "{wanted} in {sqrt}");
    }
    assert!(!text("Int.mod").contains("Int.less"));
}

#[test]
fn params_have_as_many_digits_as_an_int_holds() {
    let digits = |greatest| (F316.param_digits)(greatest, true);
    assert_eq!(digits(3.0), Some(4));
    assert_eq!(digits(3.5), Some(3));
    assert_eq!(digits(327.67), Some(2));
    assert_eq!(digits(F316.param_most), Some(0));
    assert_eq!((F316.param_digits)(0.5, false), Some(3));
    assert_eq!((F316.param_digits)(100.0, false), Some(2));
    let value = Float::from_bits((F316.param_bits)(-100, 3)).value();
    assert!((value + 0.1).abs() < 0.1 / 4096.0, "{value}");
    assert_eq!((F316.param_bits)(1_000_000, 0), (F316.param_bits)(32767, 0));
    let value = Float::from_bits((F316R.param_bits)(-100, 3)).value();
    assert!((value + 0.1).abs() < 0.1 / 16384.0, "{value}");
    let value = Wide::from_bits((F416.param_bits)(-100, 3)).value();
    assert!((value + 0.1).abs() < 0.1 / 2e8, "{value}");
}

#[test]
fn every_operation_has_a_total_routine() {
    use slowlight_routine::{Op, Range};
    for op in Op::ALL {
        let total = |r: &&slowlight_routine::Routine| {
            r.op == *op && (r.domain)(&[Range::ALL, Range::ALL], Range::ALL)
        };
        for runtime in [&F316, &F316R, &F416] {
            assert!(runtime.routines.iter().any(|r| total(&r)), "{op:?}");
        }
    }
}
