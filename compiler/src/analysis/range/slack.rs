//! Machine error model: how a machine departs from exact arithmetic, as its routines state it.

use crate::analysis::points::Points;
use crate::ir::graph::NodeId;
use slowlight_routine::{Error, Format, Op, Range, Routine, Runtime, Type, Value};

/// How far an entry that a program works out itself may be off, as a part of it.
pub const ENTRIES: f64 = 1.0 / 4_194_304.0;

/// How a machine departs from exact arithmetic.
pub struct Slack {
    /// How far results may be off, by [`Op`]: every routine's that are not exact.
    errors: Vec<Vec<Error>>,
    /// What a component of a direction is trusted to be, if anything.
    pub(super) direction: Option<Range>,
    /// Whether small values keep their digits, and are never rounded to 0.
    pub(super) relative: bool,
    /// The greatest magnitude of a quotient.
    quotient: f64,
    /// Whether its programs cut rows into segments.
    segments: bool,
    /// How far tables' entries may be off, as a part of the largest.
    entries: f64,
    /// What reals can be.
    reals: Range,
    /// The least real above 0 that is told from 0; 0 where no scene meets it.
    least: f64,
    /// The last place of constants, 0 where they keep their digits or points do not stand.
    last: f64,
    /// What ints can be.
    pub(super) ints: Range,
    /// The greatest magnitude that is expected of each operation's result, if any is.
    expected: Vec<Option<f64>>,
    /// Where each real's point is, in formats that leave that to the plan.
    pub(super) points: Option<Points>,
    /// Whether they have points that are nowhere yet.
    unknown: bool,
    /// What has routines for these.
    runtime: Option<&'static Runtime>,
}

impl Slack {
    /// No departure: the graph's own arithmetic.
    pub fn exact() -> Slack {
        let reals = Range::new(f64::MIN, f64::MAX);
        Slack {
            errors: Vec::new(),
            direction: None,
            relative: false,
            quotient: f64::INFINITY,
            segments: false,
            entries: 0.0,
            reals,
            least: 0.0,
            last: 0.0,
            ints: Range::new(f64::from(i32::MIN), f64::from(i32::MAX)),
            expected: Vec::new(),
            points: None,
            unknown: false,
            runtime: None,
        }
    }

    /// The same with ints that saturate where a runtime's do.
    pub fn exact_with_ints_of(runtime: &Runtime) -> Slack {
        Slack {
            ints: Slack::of(runtime).ints,
            ..Slack::exact()
        }
    }

    /// Exact reals, which are expected to stay within some magnitudes: for planning where
    /// their points shall be.
    pub fn expecting(runtime: &Runtime, expected: Vec<Option<f64>>) -> Slack {
        Slack {
            expected,
            relative: true,
            unknown: false,
            ..Slack::of(runtime)
        }
    }

    /// With each real in the bits that it has.
    pub fn with_points(runtime: &'static Runtime, points: Points) -> Slack {
        Slack {
            points: Some(points),
            unknown: false,
            runtime: Some(runtime),
            ..Slack::of(runtime)
        }
    }

    /// As the routines of a runtime state it.
    pub fn of(runtime: &Runtime) -> Slack {
        let ends = |format: Format| match format {
            Format::Int { .. } => Range::new(-format.most(), format.most() - 1.0),
            Format::Fixed { .. } | Format::Log { .. } => Range::new(-format.most(), format.most()),
            _ => Range::new(f64::MIN, f64::MAX),
        };
        // In a format whose ends are near, a scene that breaks the contract
        // would wrap: there the routines saturate instead.
        let floats = runtime.real.has_mantissa();
        // Units of last places that are nowhere yet say nothing.
        let errors = match runtime.real {
            Format::Scaled { .. } => Vec::new(),
            _ => errors(runtime),
        };
        Slack {
            errors,
            direction: floats.then(|| Range::new(-2.0, 2.0)),
            relative: !runtime.real.is_fixed(),
            quotient: runtime.quotient,
            segments: runtime.segments,
            entries: if runtime.derives { ENTRIES } else { 0.0 },
            reals: ends(runtime.real),
            least: match runtime.real {
                Format::Fixed { .. } => runtime.real.epsilon(),
                Format::Log { .. } => 1.0 / runtime.real.most(),
                _ => 0.0,
            },
            last: match runtime.real {
                Format::Fixed { .. } => runtime.real.epsilon(),
                _ => 0.0,
            },
            ints: ends(runtime.int),
            expected: Vec::new(),
            points: None,
            unknown: matches!(runtime.real, Format::Scaled { .. }),
            runtime: None,
        }
    }

    /// An operation's result with what its routines may add, as the node's place holds it.
    pub(super) fn result(&self, id: NodeId, op: Op, args: &[Range], exact: Range) -> Range {
        if op.result() != Type::Real {
            let real = op.args().first() == Some(&Type::Real);
            // A real whose last place is nowhere yet may be rounded to any int's.
            let exact = match op.result() {
                Type::Int if real && self.unknown && op != Op::Sign => self.ints,
                _ => exact,
            };
            return self.rounded(op, args, exact);
        }
        if let Some(points) = &self.points {
            // As the planner takes it.
            let (args, units) = points.in_units(id, op, args, exact);
            let fits =
                |r: &&Routine| r.op == op && points.is_as_wide(id, r) && (r.domain)(&args, units);
            let routine = self.runtime.and_then(|r| r.routines.iter().find(fits));
            let off = routine.map_or(0.0, |routine| routine.error.most(&args, 0.0));
            return points.rounded(id, exact, off);
        }
        self.expected(id, self.rounded(op, args, exact))
    }

    /// A node's range, as far as it is expected.
    pub(super) fn expected(&self, id: NodeId, range: Range) -> Range {
        match self.expected.get(id.0 as usize).copied().flatten() {
            // What is beyond ends there.
            Some(most) if range.magnitude() > most => Range {
                nonzero: range.nonzero,
                ..Range::new(range.lo.clamp(-most, most), range.hi.clamp(-most, most))
            },
            _ => range,
        }
    }

    /// Whether ranges are for planning where points shall be.
    pub(super) fn expects(&self) -> bool {
        !self.expected.is_empty()
    }

    /// Whether what depends on spans of columns is computed once a segment.
    pub fn segments(&self) -> bool {
        self.segments
    }

    /// The greatest real that can be held: what reaches it has no known bound.
    pub fn most(&self) -> f64 {
        self.reals.magnitude()
    }

    /// The least real above 0, or a little less; 0 where it is beyond what any scene meets.
    pub fn least(&self) -> f64 {
        self.least
    }

    /// A range with what the routines of an operation may add to it.
    pub(super) fn enlarge(&self, op: Op, args: &[Range], range: Range) -> Range {
        let all = self.errors.get(op as usize).map_or(&[][..], Vec::as_slice);
        if all.is_empty() {
            return range;
        }
        let worst = |x: f64| {
            let off = all.iter().map(|error| error.most(args, x));
            off.fold(0.0, f64::max)
        };
        let (low, high) = (worst(range.lo), worst(range.hi));
        if low == 0.0 && high == 0.0 {
            return range;
        }
        let (mut lo, mut hi) = (range.lo - low, range.hi + high);
        // Only an absolute error leads across 0.
        if !all.iter().any(|e| matches!(e, Error::Absolute(_))) {
            lo = if range.lo >= 0.0 { lo.max(0.0) } else { lo };
            hi = if range.hi <= 0.0 { hi.min(0.0) } else { hi };
        }
        let mut wide = Range::new(lo, hi);
        // What is off by a part of itself keeps its sign.
        wide.nonzero |= range.nonzero && worst(0.0) == 0.0;
        wide
    }

    /// Whether what a result is known to be says something of the operands: neither where
    /// reals are read at other points than they are kept at, nor where what is beyond an
    /// expected size counts as that size.
    pub(super) fn inverts(&self) -> bool {
        self.points.is_none() && !self.expects() && !self.unknown
    }

    /// Whether reals have no points, or it does not matter yet where these are.
    pub(super) fn is_placed(&self) -> bool {
        self.points.is_none() && !self.unknown
    }

    /// Whether an operation rounds nothing in a range, nor leaves what ints are.
    pub(super) fn is_exact(&self, op: Op, range: Range) -> bool {
        range.within(self.ints.lo, self.ints.hi) && self.enlarge(op, &[range], range) == range
    }

    /// What an operation's exact result stays within, given what the machine has of it: what
    /// ends where the format does may be anything beyond.
    pub(super) fn before(&self, op: Op, args: &[Range], result: Range) -> Range {
        let twice = self.enlarge(op, args, self.enlarge(op, args, result));
        let end = (self.most() / 2.0).min(1e37);
        let end = if op == Op::Div {
            end.min(self.quotient / 2.0)
        } else {
            end
        };
        let lo = if twice.lo < -end {
            f64::NEG_INFINITY
        } else {
            twice.lo
        };
        let hi = if twice.hi > end {
            f64::INFINITY
        } else {
            twice.hi
        };
        Range::new(lo, hi)
    }

    /// What an operation's result stays within, given its exact range.
    pub(super) fn rounded(&self, op: Op, args: &[Range], exact: Range) -> Range {
        let exact = match op {
            Op::Div if self.quotient.is_finite() => {
                let held = |x: f64| x.clamp(-self.quotient, self.quotient);
                Range {
                    nonzero: exact.nonzero,
                    ..Range::new(held(exact.lo), held(exact.hi))
                }
            }
            _ => exact,
        };
        self.cut(op.result(), self.enlarge(op, args, exact))
    }

    /// A constant as it is held: one that is below half a last place is 0.
    pub(super) fn constant(&self, value: Value) -> Range {
        let exact = value.real();
        let held = match value {
            Value::Real(_) if self.last > 0.0 => (exact / self.last).round() * self.last,
            _ => exact,
        };
        self.cut(value.ty(), Range::point(held))
    }

    pub(super) fn cut(&self, ty: Type, range: Range) -> Range {
        let ends = match ty {
            Type::Bool => Range::new(0.0, 1.0),
            Type::Int => self.ints,
            Type::Real => self.reals,
        };
        let clamp = |x: f64| x.clamp(ends.lo, ends.hi);
        Range {
            nonzero: range.nonzero,
            ..Range::new(clamp(range.lo), clamp(range.hi))
        }
    }

    /// The range of a table's entries that the program works out itself.
    pub(super) fn entry(&self, exact: Range) -> Range {
        widened(exact, self.entries)
    }
}

/// A range of what may be off by a part of itself.
fn widened(range: Range, part: f64) -> Range {
    Range {
        nonzero: range.nonzero,
        ..Range::new(
            range.lo - part * range.lo.abs(),
            range.hi + part * range.hi.abs(),
        )
    }
}

/// How far a runtime's results may be off, by [`Op`].
fn errors(runtime: &Runtime) -> Vec<Vec<Error>> {
    let mut errors = vec![Vec::new(); Op::EVERY.len()];
    for routine in runtime.routines {
        let own: &mut Vec<Error> = &mut errors[routine.op as usize];
        if routine.error != Error::Exact && !own.contains(&routine.error) {
            own.push(routine.error);
        }
    }
    errors
}
