//! What one machine offers in one choice of formats.

use crate::scale;
use crate::{Bits, Format, Op, Part, Range, Routine, Type, Value};

/// What statements take beside their routines, in the machine's cycles.
#[derive(Clone, Copy, Debug)]
pub struct Overhead {
    /// `n = n + step` from column to column, as a statement of its own; `None` where programs
    /// do not step ints.
    pub step: Option<u32>,
    /// Reading an int's and a real's variable.
    pub read: [u32; 2],
    /// Taking a real that is written out where it is read.
    pub nested: u32,
    /// Reading each digit of a whole constant.
    pub digit: u32,
    /// Assigning an int and a real, beside what is assigned.
    pub write: [u32; 2],
    /// A test, beside what is tested.
    pub test: u32,
    /// Reading a table, an index, beside reading a variable.
    pub index: u32,
}

impl Overhead {
    /// Statements that take nothing beside their routines, and no steps of columns.
    pub const NONE: Overhead = Overhead {
        step: None,
        read: [0; 2],
        nested: 0,
        digit: 0,
        write: [0; 2],
        test: 0,
        index: 0,
    };
}

/// Reals of fewer bits beside the usual ones.
#[derive(Clone, Copy, Debug)]
pub struct Narrow {
    /// Bits of one.
    pub bits: u8,
    /// Of the pixels that are wrong where all reals have so few bits and right where none has,
    /// one in so many may stay wrong.
    pub wrong: usize,
}

/// All that one machine offers in one choice of formats.
#[derive(Clone, Copy, Debug)]
pub struct Runtime {
    /// Its name in messages and plans: `bbc`, `jack`, `6502`.
    pub name: &'static str,
    /// What `--format` calls this choice: `real40`, `f316`, `fixed16.16`.
    pub format: &'static str,
    /// The format of every real.
    pub real: Format,
    /// In how many bits, fewer than those of `real`, reals may be held as well where that is
    /// enough, each with routines of its own; `None` where all are held alike.
    pub narrow: Option<Narrow>,
    /// The format of every int.
    pub int: Format,
    /// What it can compute, cheap and restricted before dear and total.
    pub routines: &'static [Routine],
    /// The source that the routines need.
    pub parts: &'static [Part],
    /// The bits of a constant, as the generated source will write it: the
    /// nearest value that the format and the source's notation have; saturating.
    pub encode: fn(Value, Format) -> Bits,
    /// What bits stand for.
    pub decode: fn(Bits, Format) -> Value,
    /// An int of so many bits read with so many more fraction bits (or fewer), where each real
    /// has a point of its own: how it is rounded and that it saturates.
    pub shifted: fn(value: i64, by: i32, bits: u8) -> i64,
    /// The greatest magnitude of a division's result; greater quotients, those
    /// by 0 among them, saturate there. A runtime may choose it below its
    /// format's end, so that what is computed from a quotient needs no guard.
    pub quotient: f64,
    /// What statements take beside their routines.
    pub overhead: Overhead,
    /// Whether programs go through a row in runs of columns within which
    /// comparisons of the column with what the row knows do not change, and
    /// compute what depends on these alone once a run.
    pub segments: bool,
    /// Whether quotients by one divisor may be products with its reciprocal, which rounds
    /// twice.
    pub reciprocals: bool,
    /// Whether products of 16 bits by 16 are soonest made where they are eight bits longer than
    /// their result.
    pub middle: bool,
    /// Whether programs work out tables at their start from one another.
    pub derives: bool,
    /// What programs keep of a real result that stays within a range: where that tells
    /// the sign, some keep none.
    pub kept: fn(Bits, Range) -> Bits,
    /// Which results may be smaller than the format's least magnitude, if any.
    pub loose: Option<Loose>,
    /// The greatest magnitude of a real `param`, its range included, that the
    /// generated source can write and the program can take.
    pub param_most: f64,
    /// How a real `param` is written in the generated source: `None` as a
    /// decimal, `Some(d)` as an integer scaled by 10^d. `greatest` is the
    /// magnitude of its value and range, at most [`Runtime::param_most`];
    /// without a range, what it may be changed to is not known.
    pub param_digits: fn(greatest: f64, ranged: bool) -> Option<u8>,
    /// The bits that the generated program makes at its start of a real param
    /// written as the integer `scaled` with `digits` decimal digits.
    pub param_bits: fn(scaled: i64, digits: u8) -> Bits,
}

/// Results that may be smaller than their format's least magnitude, for as long as
/// everything that reads them takes that.
#[derive(Clone, Copy, Debug)]
pub struct Loose {
    /// How small a value is at most that is not loose, in the format's own measure.
    pub held: i32,
    /// The routine that leaves results as small as they come, instead of one that does not.
    pub instead: fn(&Routine) -> Option<&'static Routine>,
    /// How small a routine's result may be if its arguments, of these ranges, may be as
    /// small as that: `None` where it does not take them.
    pub least: fn(&Routine, &[Range], &[i32]) -> Option<i32>,
}

impl Runtime {
    /// The format of a scalar type here.
    pub fn format_of(&self, ty: Type) -> Format {
        match ty {
            Type::Bool => Format::Bool,
            Type::Int => self.int,
            Type::Real => self.real,
        }
    }

    /// Whether it has an operation: one of [`Op::ALL`] it has.
    pub fn has(&self, op: Op) -> bool {
        self.routines.iter().any(|r| r.op == op)
    }

    /// The routine that computes an operation of ordinary operands, if any can: what it
    /// costs where no ranges are known. Of numbers with points of their own the first of a
    /// list may be for one operand alone; of others it is for all.
    pub fn usual(&self, op: Op) -> Option<&'static Routine> {
        let mut all = self.routines.iter().filter(|r| r.op == op);
        let Format::Scaled { bits } = self.real else {
            return all.next();
        };
        let scales = scale::Scales {
            args: [bits as i8 - 2; 2],
            result: bits as i8 - 2,
        };
        // Of so many bits that it is for all.
        let more = f64::from(bits.saturating_sub(16));
        let [some, result] = [100.5 * (1.5 * more).exp2(), 10_000.0 * more.exp2()]
            .map(|most| Range::new(-most, most));
        let number = Range::point(f64::from(scales.number(op)));
        let args: Vec<Range> = std::iter::repeat_n(some, op.arity())
            .chain([number])
            .collect();
        let fits = |r: &&Routine| (r.domain)(&args, result);
        all.clone().find(fits).or_else(|| all.next())
    }

    /// A part by name.
    pub fn part(&self, name: &str) -> Option<&'static Part> {
        self.parts.iter().find(|p| p.name == name)
    }

    /// All parts that the named ones need, themselves included, each once, in
    /// the runtime's own order.
    pub fn closure<'a>(&self, names: impl IntoIterator<Item = &'a str>) -> Vec<&'static Part> {
        let mut wanted: Vec<&str> = names.into_iter().collect();
        let mut seen: Vec<&str> = Vec::new();
        while let Some(name) = wanted.pop() {
            if !seen.contains(&name) {
                seen.push(name);
                wanted.extend(self.part(name).map_or(&[][..], |p| p.needs));
            }
        }
        self.parts
            .iter()
            .filter(|p| seen.contains(&p.name))
            .collect()
    }
}
