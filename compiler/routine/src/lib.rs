//! What a scalar operation means, how a value is represented, and what a
//! runtime offers to compute one from the other.
//!
//! Three notions meet here and nowhere else:
//!
//! - [`Op`]: an operation over the reals, the integers or the booleans, with
//!   one canonical definition, [`Op::eval`], in `f64` and `i32`. The native
//!   evaluation and constant folding use it; every routine is held against it.
//! - [`Format`]: how a machine holds a value. A value in a format is a
//!   [`Bits`], whose layout is the runtime's affair.
//! - [`Routine`]: one way to compute an [`Op`] from arguments in given formats
//!   on one machine: how the target writes it, which [`Part`]s of source it
//!   needs, what it costs, where it may be used, and a bit-exact model.
//!
//! A [`Runtime`] is a list of routines and parts. The planner picks, for each
//! operation of a graph, the first routine in the list whose formats match and
//! whose domain the value ranges prove; so runtimes list the cheap, restricted
//! routines first and end with one that is total.

pub mod log;
mod op;
mod range;
mod runtime;
pub mod scale;

pub use op::{Op, Type, Value};
pub use range::Range;
pub use runtime::{Loose, Narrow, Overhead, Runtime};

/// How a machine holds a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// True or false. As [`Bits`]: 1 or 0.
    Bool,
    /// Two's complement of so many bits. As [`Bits`]: sign-extended to 64 bits.
    Int { bits: u8 },
    /// The 40-bit real of BBC BASIC II.
    Real40,
    /// Sign, exponent (bias 127) and 14-bit mantissa of the Jack ray marcher, whose
    /// results are cut; or rounded.
    Float316 { rounded: bool },
    /// The same with 28 bits of mantissa, in two words; rounded.
    Float416,
    /// A sign, and the binary logarithm of the magnitude in 16 bits, `frac` of them after
    /// the point, up to `octaves`; there is no 0.
    Log { frac: u8, octaves: u8 },
    /// Two's complement of `bits` bits, `frac` of them after the point. As [`Bits`]: sign-extended.
    Fixed { bits: u8, frac: i8 },
    /// Of a runtime's reals: [`Format::Fixed`] of so many bits, each value with fraction
    /// bits of its own ([`scale`]).
    Scaled { bits: u8 },
}

impl Format {
    /// The greatest magnitude that it holds, or a little more.
    pub fn most(self) -> f64 {
        match self {
            Format::Bool => 1.0,
            Format::Int { bits } => 2f64.powi(i32::from(bits) - 1),
            Format::Fixed { bits, frac } => 2f64.powi(i32::from(bits) - 1 - i32::from(frac)),
            Format::Real40 => 2f64.powi(127),
            Format::Float316 { .. } | Format::Float416 => f64::MAX,
            Format::Log { octaves, .. } => f64::from(octaves).exp2(),
            Format::Scaled { .. } => f64::MAX,
        }
    }

    /// Whether it has more than 16 bits for a real.
    pub fn is_long(self) -> bool {
        !matches!(self, Format::Log { .. }) && !(1..=16).contains(&self.bits())
    }

    /// The scalar type that it holds.
    pub fn scalar(self) -> Type {
        match self {
            Format::Bool => Type::Bool,
            Format::Int { .. } => Type::Int,
            Format::Real40
            | Format::Float316 { .. }
            | Format::Float416
            | Format::Log { .. }
            | Format::Fixed { .. }
            | Format::Scaled { .. } => Type::Real,
        }
    }

    /// Bits of its ints, or of its reals where they have a fixed point; else 0.
    pub fn bits(self) -> u8 {
        match self {
            Format::Int { bits } | Format::Fixed { bits, .. } | Format::Scaled { bits } => bits,
            _ => 0,
        }
    }

    /// Words of a real that is an object of the Jack class `Float`: sign, exponent, and one or
    /// two of the mantissa; else 0.
    pub fn words(self) -> u8 {
        match self {
            Format::Float316 { .. } => 3,
            Format::Float416 => 4,
            _ => 0,
        }
    }

    /// Whether its reals are objects of the Jack class `Float`.
    pub fn is_object(self) -> bool {
        self.words() > 0
    }

    /// Whether its reals have a mantissa, whose roundings are relative.
    pub fn has_mantissa(self) -> bool {
        self == Format::Real40 || self.is_object()
    }

    /// Whether its reals have a fixed point, all the same or each its own.
    pub fn is_fixed(self) -> bool {
        matches!(self, Format::Fixed { .. } | Format::Scaled { .. })
    }
}

impl Format {
    /// The unit roundoff of its reals: the greatest relative error of one
    /// operation that is rounded (or cut, as in `f316`) once, or the last
    /// place of a fixed-point format. 0 where it holds no reals.
    pub fn epsilon(self) -> f64 {
        match self {
            Format::Bool | Format::Int { .. } => 0.0,
            Format::Real40 => 1.0 / 4_294_967_296.0,
            Format::Float316 { rounded: false } => 1.0 / 8192.0,
            Format::Float316 { rounded: true } => 1.0 / 16384.0,
            Format::Float416 => 1.0 / 268_435_456.0,
            Format::Log { frac, .. } => 0.5f64.powi(i32::from(frac) + 1) * std::f64::consts::LN_2,
            Format::Fixed { frac, .. } => 0.5f64.powi(i32::from(frac)),
            // Of values up to 2, with a sign.
            Format::Scaled { bits } => 0.5f64.powi(i32::from(bits) - 2),
        }
    }
}

impl std::fmt::Display for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Format::Bool => f.write_str("bool"),
            Format::Int { bits } => write!(f, "int{bits}"),
            Format::Real40 => f.write_str("real40"),
            Format::Float316 { rounded: false } => f.write_str("f316"),
            Format::Float316 { rounded: true } => f.write_str("f316r"),
            Format::Float416 => f.write_str("f416"),
            Format::Log { frac, .. } => write!(f, "log{frac}"),
            Format::Fixed { bits, frac } => {
                write!(f, "fixed{}.{frac}", i32::from(*bits) - i32::from(*frac))
            }
            Format::Scaled { bits } => write!(f, "fixed{bits}"),
        }
    }
}

/// A value in some format, as the machine holds it. The layout belongs to the
/// format: see [`Format`] and the runtime that defines it.
pub type Bits = u64;

/// How a target writes the use of a routine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// An expression with `{0}`, `{1}`, `{2}` for the arguments.
    ///
    /// `level` says how tightly the whole binds and `operands` how tightly each
    /// argument must bind at least (greater binds tighter); the target puts
    /// parentheses around an argument whose level is lower.
    Expression {
        template: &'static str,
        level: u8,
        operands: &'static [u8],
    },
    /// Statements or instructions, in the target's own convention, given as a
    /// template or as the name of what to call; the target's docs say which.
    Statement(&'static str),
}

impl Form {
    /// Whether an expression has an argument in several places: it should be a variable, then.
    pub fn repeats(self, arg: usize) -> bool {
        match self {
            Form::Expression { template, .. } => {
                template.matches(&format!("{{{arg}}}")).nth(1).is_some()
            }
            Form::Statement(_) => false,
        }
    }
}

/// How far a routine's result may be from [`Op::eval`] of its arguments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Error {
    /// Always the exact result (integers, booleans, copies).
    Exact,
    /// At most so many times the magnitude of the exact result.
    Relative(f64),
    /// At most so many times the greatest magnitude among the arguments and
    /// the exact result, and never on the other side of 0: sums in a format
    /// that cuts the smaller summand.
    Larger(f64),
    /// At most so much.
    Absolute(f64),
    /// At most the sum of both: `relative` times the magnitude of the exact
    /// result, and `absolute`. In fixed point, what a function with large
    /// results loses on the way, and the rounding of the last place.
    Mixed { relative: f64, absolute: f64 },
    /// At most `relative`, and `each` for each unit of the argument's magnitude up to `most`,
    /// times the magnitude of the exact result: powers by repeated products.
    Growing { relative: f64, each: f64, most: f64 },
}

impl Error {
    /// The most that a result may be off whose exact value is `exact`, its
    /// arguments as given.
    pub fn most(self, args: &[Range], exact: f64) -> f64 {
        match self {
            Error::Exact => 0.0,
            Error::Relative(part) => part * exact.abs(),
            Error::Absolute(most) => most,
            Error::Mixed { relative, absolute } => relative * exact.abs() + absolute,
            Error::Growing {
                relative,
                each,
                most,
            } => {
                let steps = args.first().map_or(most, |x| x.magnitude().min(most));
                (relative + each * steps) * exact.abs()
            }
            Error::Larger(part) => {
                let most = |m: f64, r: &Range| m.max(r.magnitude());
                part * args.iter().fold(exact.abs(), most)
            }
        }
    }
}

/// Where a routine may be used: given the ranges of its arguments and of its
/// exact result, whether it is right (and cannot trap) throughout.
pub type Domain = fn(args: &[Range], result: Range) -> bool;

/// Everywhere: the domain of a total routine.
pub fn everywhere(_: &[Range], _: Range) -> bool {
    true
}

/// All of a result is kept.
pub fn whole(bits: Bits, _: Range) -> Bits {
    bits
}

/// One way to compute an operation on a machine.
#[derive(Clone, Copy, Debug)]
pub struct Routine {
    /// Unique within its runtime; shown in plans and listings.
    pub name: &'static str,
    /// What it computes.
    pub op: Op,
    /// The formats of its arguments; as many as [`Op::arity`].
    pub args: &'static [Format],
    /// The format of its result.
    pub result: Format,
    /// How it is written.
    pub form: Form,
    /// The parts of source that it needs, by name (each may need more).
    pub needs: &'static [&'static str],
    /// Mean cost in the machine's own cycles, its parts included, its operands' loads not.
    pub cycles: u32,
    /// Bytes (or words) of code at each use.
    pub bytes: u32,
    /// Where it may be used.
    pub domain: Domain,
    /// How far it may be off within its domain.
    pub error: Error,
    /// What it computes, bit for bit, for every pattern of its argument formats.
    pub model: fn(&[Bits]) -> Bits,
}

/// Two lists of routines, one behind the other.
pub const fn joined<const N: usize>(a: &[Routine], b: &[Routine]) -> [Routine; N] {
    let mut all = [a[0]; N];
    let mut k = 0;
    while k < N {
        all[k] = if k < a.len() { a[k] } else { b[k - a.len()] };
        k += 1;
    }
    all
}

/// What a part of a runtime is made of.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// Text in the target's language.
    Text(&'static str),
    /// The same, made from what a table says.
    Made(fn() -> String),
    /// Generated data: a table, as bytes or words.
    Table(fn() -> Vec<i32>),
}

/// A piece of source that routines share: a subroutine, a class, a table.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Unique within its runtime.
    pub name: &'static str,
    /// What it is made of.
    pub source: Source,
    /// Other parts that it needs.
    pub needs: &'static [&'static str],
    /// Bytes (or words) in the machine.
    pub bytes: u32,
    /// Cycles that a program takes for it at its start, to make tables that it keeps; what
    /// parts that it needs take then is theirs.
    pub starts: u32,
}
