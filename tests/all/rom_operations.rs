//! The cases of `rom_vectors.rs`: operations of BASIC II, and operands that anyone can make again
//! from a generator with a fixed start.

use slowlight_isa::real40::Real40;
use std::path::PathBuf;

/// What goes in: as many as the operation takes.
#[derive(Clone, Debug)]
pub enum Operands {
    Reals(Real40, Real40),
    Ints(i32, i32),
    Text(String),
}

/// What comes out, and how many bytes of the file it takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gives {
    Real,
    Int,
    Text,
}

/// An operation, as BASIC has it: of A, B, A%, B% or the text at &5000 to C, C% or &5100.
pub struct Operation {
    pub name: &'static str,
    pub statement: &'static str,
    pub gives: Gives,
    pub count: usize,
    operands: fn(&mut Random) -> Operands,
}

/// The operations, with how many cases each.
pub const OPERATIONS: &[Operation] = &[
    exact("add", "C=A+B", Gives::Real, 10_000, pair),
    exact("sub", "C=A-B", Gives::Real, 10_000, pair),
    exact("mul", "C=A*B", Gives::Real, 10_000, pair),
    exact("div", "C=A/B", Gives::Real, 10_000, pair),
    exact("sqr", "C=SQRA", Gives::Real, 10_000, pair),
    exact("read", "C=VAL$&5000", Gives::Real, 10_000, decimal),
    exact(
        "print",
        "@%=&0100090A:$&5100=STR$A",
        Gives::Text,
        10_000,
        pair,
    ),
    exact("str", "@%=&90A:$&5100=STR$A", Gives::Text, 2_000, pair),
    exact("int", "C=INTA", Gives::Real, 2_000, near),
    exact("whole", "C%=A", Gives::Int, 2_000, near),
    exact("less", "C%=A<B", Gives::Int, 2_000, close),
    exact("equal", "C%=A=B", Gives::Int, 2_000, close),
    exact("greater_equal", "C%=A>=B", Gives::Int, 2_000, close),
    exact("product", "C%=A%*B%", Gives::Int, 2_000, whole),
    exact("idiv", "C%=A% DIV B%", Gives::Int, 2_000, whole),
    exact("mod", "C%=A% MOD B%", Gives::Int, 2_000, whole),
    exact("and", "C%=A% AND B%", Gives::Int, 2_000, whole),
    exact("or", "C%=A% OR B%", Gives::Int, 2_000, whole),
    exact("eor", "C%=A% EOR B%", Gives::Int, 2_000, whole),
    exact("sin", "C=SINA", Gives::Real, 1_000, angle),
    exact("cos", "C=COSA", Gives::Real, 1_000, angle),
    exact("tan", "C=TANA", Gives::Real, 1_000, angle),
    exact("atn", "C=ATNA", Gives::Real, 1_000, angle),
    exact("exp", "C=EXPA", Gives::Real, 1_000, power),
    exact("ln", "C=LNA", Gives::Real, 1_000, positive),
    exact("pow", "C=A^B", Gives::Real, 1_000, powers),
    exact("asn", "C=ASNA", Gives::Real, 1_000, angle),
    exact("acs", "C=ACSA", Gives::Real, 1_000, angle),
    exact("log", "C=LOGA", Gives::Real, 1_000, positive),
];

const fn exact(
    name: &'static str,
    statement: &'static str,
    gives: Gives,
    count: usize,
    operands: fn(&mut Random) -> Operands,
) -> Operation {
    Operation {
        name,
        statement,
        gives,
        count,
        operands,
    }
}

impl Operation {
    /// The operands of each case.
    pub fn cases(&self) -> Vec<Operands> {
        let seed = self
            .name
            .bytes()
            .fold(7u64, |s, b| s.wrapping_mul(31).wrapping_add(u64::from(b)));
        let mut random = Random(seed);
        (0..self.count)
            .map(|_| (self.operands)(&mut random))
            .collect()
    }

    /// Where its results are kept.
    pub fn file(&self) -> PathBuf {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        root.join("tests/rom").join(self.name).with_extension("bin")
    }
}

/// An error in the place of a result of five or four bytes: no real has exponent 0 and these.
pub fn error_bytes(gives: Gives, number: u8) -> Vec<u8> {
    match gives {
        Gives::Real => vec![0, 0xee, 0xee, 0xee, number],
        Gives::Int => vec![0xee, 0xee, 0xee, number],
        Gives::Text => format!("error {number}").into_bytes(),
    }
}

/// SplitMix64.
pub struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// A real whose exponent byte lies in a range; one in three with a short mantissa.
    fn real(&mut self, from: u8, to: u8) -> Real40 {
        let exponent = u64::from(from) + self.below(u64::from(to - from) + 1);
        let keep = if self.below(3) == 0 {
            self.below(32)
        } else {
            0
        };
        let mantissa = (self.next() as u32) >> keep << keep;
        Real40::from_bits(exponent << 32 | u64::from(mantissa))
    }
}

/// Mostly of like size, some over the whole range, some zero.
fn any(r: &mut Random) -> Real40 {
    match r.below(20) {
        0 => Real40::ZERO,
        1..3 => r.real(1, 255),
        3..6 => Real40::from_i32(r.below(2000) as i32 - 1000),
        6..12 => r.real(126, 131),
        _ => r.real(100, 156),
    }
}

fn pair(r: &mut Random) -> Operands {
    Operands::Reals(any(r), any(r))
}

/// Reals that fit an integer, and some that do not.
fn near(r: &mut Random) -> Operands {
    Operands::Reals(r.real(120, 162), Real40::ZERO)
}

/// Reals that are often equal or differ in the last bits.
fn close(r: &mut Random) -> Operands {
    let a = any(r);
    let b = match r.below(3) {
        0 => a,
        1 => Real40::from_bits(a.to_bits() ^ r.below(4)),
        _ => any(r),
    };
    Operands::Reals(a, b)
}

fn whole(r: &mut Random) -> Operands {
    let mut int = || {
        let bits = r.below(32);
        let n = (r.next() as u32 & ((1u64 << bits) - 1) as u32) as i32;
        if r.below(2) == 0 { n } else { -n }
    };
    Operands::Ints(int(), int())
}

fn angle(r: &mut Random) -> Operands {
    Operands::Reals(r.real(112, 134), Real40::ZERO)
}

fn power(r: &mut Random) -> Operands {
    Operands::Reals(r.real(112, 134), Real40::ZERO)
}

fn positive(r: &mut Random) -> Operands {
    let reach = if r.below(2) == 0 { 1 } else { 28 };
    Operands::Reals(r.real(128 - reach, 128 + reach).abs(), Real40::ZERO)
}

fn powers(r: &mut Random) -> Operands {
    let y = match r.below(2) {
        0 => Real40::from_i32(r.below(24) as i32 - 8),
        _ => r.real(124, 131),
    };
    Operands::Reals(r.real(122, 132).abs(), y)
}

/// A decimal number: 1 to 12 digits, perhaps a point, perhaps a power of ten.
fn decimal(r: &mut Random) -> Operands {
    let length = 1 + r.below(12) as usize;
    let mut text: String = (0..length)
        .map(|_| char::from(b'0' + r.below(10) as u8))
        .collect();
    if r.below(3) > 0 {
        text.insert(r.below(length as u64 + 1) as usize, '.');
    }
    match r.below(4) {
        0 => text += &format!("E{}", r.below(25)),
        1 => text += &format!("E-{}", r.below(28)),
        _ => {}
    }
    Operands::Text(text)
}
