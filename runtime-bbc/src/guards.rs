//! What lets a function be left out.
//!
//! A function `FN...` takes any argument, and five to fifteen thousand cycles more than the
//! expression inside it. Where the ranges do not prove that the expression is right, a test does:
//! under [`Guarded::when`] the routine [`Guarded::cheap`] computes the same bits. Programs that
//! are to be quick test first, and call the function for the rest.

use slowlight_routine::Range;

/// What one argument must satisfy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Test {
    /// Its size is below this.
    Below(f64),
    /// Its size is above this.
    Above(f64),
    /// It is no less than this.
    Least(f64),
    /// It is greater than this.
    More(f64),
}

impl Test {
    /// Whether a range proves it.
    pub fn proved(self, range: Range) -> bool {
        match self {
            Test::Below(most) => range.lo > -most && range.hi < most,
            Test::Above(least) => range.lo > least || range.hi < -least,
            Test::Least(least) => range.lo >= least,
            Test::More(least) => range.lo > least,
        }
    }

    /// Whether a value passes it.
    pub fn holds(self, x: f64) -> bool {
        match self {
            Test::Below(most) => x.abs() < most,
            Test::Above(least) => x.abs() > least,
            Test::Least(least) => x >= least,
            Test::More(least) => x > least,
        }
    }
}

/// A routine, and the one that does the same under tests of its arguments.
#[derive(Clone, Copy, Debug)]
pub struct Guarded {
    /// The routine that is right everywhere.
    pub name: &'static str,
    /// The routine that is right under the tests.
    pub cheap: &'static str,
    /// An argument's place and its test.
    pub when: &'static [(usize, Test)],
    /// What its result's size stays below then, where that is known.
    pub below: Option<f64>,
    /// What it is where the tests fail, if that is always the same.
    pub otherwise: Option<&'static str>,
}

/// Whole numbers of this size may be added without wrapping.
const HALF_WORD: f64 = 1e9;

macro_rules! guarded {
    ($name:literal $cheap:literal [$(($at:literal $test:expr)),*] $below:expr) => {
        guarded!($name $cheap [$(($at $test)),*] $below, None)
    };
    ($name:literal $cheap:literal [$(($at:literal $test:expr)),*] $below:expr, $otherwise:expr) => {
        Guarded {
            name: $name,
            cheap: $cheap,
            when: &[$(($at, $test)),*],
            below: $below,
            otherwise: $otherwise,
        }
    };
}

use Test::{Above, Below, Least, More};

/// All of them.
#[rustfmt::skip]
pub static GUARDED: &[Guarded] = &[
    guarded!("FNadd" "add" [(0 Below(HALF_WORD)), (1 Below(HALF_WORD))] Some(2.0 * HALF_WORD)),
    guarded!("FNsub" "sub" [(0 Below(HALF_WORD)), (1 Below(HALF_WORD))] Some(2.0 * HALF_WORD)),
    guarded!("FNmul" "mul" [(0 Below(1e18)), (1 Below(1e18))] Some(1.1e36)),
    guarded!("FNdiv" "div" [(0 Below(1e18)), (1 Above(1e-15))] None),
    guarded!("FNsqr" "sqr" [(0 Least(0.0))] Some(2e19), Some("0")),
    guarded!("FNsin" "sin" [(0 Below(1e5))] Some(1.1)),
    guarded!("FNcos" "cos" [(0 Below(1e5))] Some(1.1)),
    guarded!("FNasn" "asn" [(0 Below(1.0))] Some(2.0)),
    guarded!("FNacs" "acs" [(0 Below(1.0))] Some(4.0)),
    guarded!("FNexp" "exp" [(0 Below(80.0))] Some(1e36)),
    guarded!("FNln" "ln" [(0 More(1e-37))] Some(90.0)),
    guarded!("FNfloor" "floor" [(0 Below(HALF_WORD))] Some(HALF_WORD + 2.0)),
    guarded!("FNround" "round" [(0 Below(HALF_WORD))] Some(HALF_WORD + 2.0)),
    guarded!("FNmod_1" "fract" [(0 Below(HALF_WORD))] Some(1.1)),
    guarded!("FNmod_2" "above_1" [(0 Below(HALF_WORD))] Some(2.1)),
    guarded!("FNmod_4" "above_3" [(0 Below(HALF_WORD))] Some(4.1)),
    guarded!("FNmod_8" "above_7" [(0 Below(HALF_WORD))] Some(8.1)),
    guarded!("FNmod_16" "above_15" [(0 Below(HALF_WORD))] Some(16.1)),
    guarded!("FNmod_whole" "whole_rem" [(0 Below(HALF_WORD))] Some(65_536.0)),
    guarded!("FNmod_binary" "rem" [(0 Below(30_000.0)), (0 Above(1e-15))] Some(32_769.0)),
    guarded!("FNrem" "rem" [(0 Above(1e-15))] None),
    guarded!("FNiadd" "int_add" [(0 Below(HALF_WORD + 4.0)), (1 Below(HALF_WORD + 4.0))] Some(2.1e9)),
    guarded!("FNisub" "int_sub" [(0 Below(HALF_WORD + 4.0)), (1 Below(HALF_WORD + 4.0))] Some(2.1e9)),
    guarded!("FNimul" "int_mul" [(0 Below(40_000.0)), (1 Below(40_000.0))] Some(1.7e9)),
    guarded!("FNineg" "int_neg" [(0 Below(HALF_WORD + 4.0))] Some(HALF_WORD + 4.0)),
    guarded!("FNidiv" "int_div" [(0 Least(0.0)), (1 More(0.0))] None),
    guarded!("FNimod" "int_mod" [(0 Least(0.0)), (1 More(0.0))] None),
];

/// The guard of a routine, by its name.
pub fn guard(name: &str) -> Option<&'static Guarded> {
    GUARDED.iter().find(|g| g.name == name)
}
