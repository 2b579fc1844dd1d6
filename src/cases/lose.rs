//! Exact arithmetic that loses only what the places of a plan's values cannot hold.
//!
//! Where every value has a point of its own, an operation whose result is beyond its place's end
//! is seen as it happens ([`super::watch`]). Much else is lost there all the time, and mostly
//! matters no more than any rounding: what is read or copied in a place that ends below it, or
//! is no more than half of a last place and vanishes. A wrong result may be excused by that
//! only if nothing else is needed to make it wrong: so the plan's statements are run with exact
//! reals that are not rounded, and lost where the plan loses them. What such a run gets right
//! the machine has to get right, too.

use slowlight_compiler::analysis::points::Points;
use slowlight_compiler::eval::arithmetic::Arithmetic;
use slowlight_compiler::eval::run::Run;
use slowlight_compiler::ir::graph::{Graph, NodeId, ParamId};
use slowlight_compiler::ir::tree::Place;
use slowlight_compiler::plan::Plan;
use slowlight_routine::scale::{concerns, most};
use slowlight_routine::{Format, Op, Type, Value};
use std::cell::RefCell;

/// What a plan's statements come to with exact reals, and the first that was lost, in words.
pub struct Lost {
    /// What the graph reports.
    pub reports: Vec<Value>,
    /// None where nothing was.
    pub first: Option<String>,
}

struct Losing<'p> {
    plan: &'p Plan,
    points: &'p Points,
    first: RefCell<Option<String>>,
    /// A param that is rounded, which is said only where nothing else is lost.
    rounded: RefCell<Option<String>>,
}

/// What becomes of a real in a place: all of it, nothing, or the place's end.
fn held(x: f64, place: Format) -> f64 {
    let Format::Fixed { bits, frac } = place else {
        return x;
    };
    let last = f64::from(-frac).exp2();
    match x.abs() {
        // Not every routine rounds a half up.
        size if size <= last / 2.0 => 0.0,
        // What is nearer to the end than a last place is rounded like all else.
        size if size < place.most() => x,
        _ => most(bits) as f64 * last * x.signum(),
    }
}

impl Losing<'_> {
    fn graph(&self) -> &Graph {
        &self.plan.graph
    }

    /// A value brought to a place; where it is lost, that is said of what it is brought to.
    fn brought(&self, x: f64, place: Format, what: impl Fn() -> String) -> f64 {
        let held = held(x, place);
        if held != x {
            let why = match held == 0.0 {
                true => "is below the last place",
                false => "is beyond the end",
            };
            let format = self.plan.runtime.format;
            let mut first = self.first.borrow_mut();
            first.get_or_insert_with(|| format!("{x:.6e} {why} of {} in {format}", what()));
        }
        held
    }

    /// An operation's operand, as it is read.
    fn operand(&self, id: NodeId, op: Op, k: usize, x: f64) -> f64 {
        let (scales, bits) = (self.points.scales(id), self.points.widths().operands(id));
        let place = Format::Fixed {
            bits,
            frac: scales.args[k],
        };
        let of = self.graph().node(id).operands().nth(k);
        let constant = of.is_some_and(|of| self.graph().constant(of).is_some());
        // A threshold or a bound above all that is told from it ends where that does.
        let aside = constant || matches!(op, Op::Min | Op::Max) || op.result() == Type::Bool;
        let held = held(x, place);
        match aside && held != 0.0 {
            true => held,
            false => self.brought(x, place, || format!("an operand of {}", op.name())),
        }
    }
}

impl Arithmetic for &Losing<'_> {
    type Value = Value;

    fn constant(&self, value: Value) -> Value {
        value
    }

    fn param(&self, id: ParamId) -> Value {
        let at = id.0 as usize;
        let bits = self.plan.params.get(at).map_or(0, |p| p.bits);
        let held = (self.plan.runtime.decode)(bits, self.plan.param_format(id));
        if let (Some(param), Value::Real(held)) = (self.graph().params.get(at), held)
            && param.value != held
        {
            let (name, format) = (param.label(), self.plan.runtime.format);
            let mut rounded = self.rounded.borrow_mut();
            rounded
                .get_or_insert_with(|| format!("{name} = {} is {held} in {format}", param.value));
        }
        held
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Value]) -> Value {
        let mut read = [Value::Int(0); 2];
        for (k, (to, from)) in read.iter_mut().zip(args).enumerate() {
            *to = match *from {
                Value::Real(x) if concerns(op) => Value::Real(self.operand(id, op, k, x)),
                other => other,
            };
        }
        match op.eval(&read[..args.len().min(2)]) {
            Value::Real(x) => {
                let what = || format!("{}'s result", op.name());
                Value::Real(self.brought(x, self.plan.format(id), what))
            }
            other => other,
        }
    }

    fn copied(&self, place: Place, from: NodeId, value: Value) -> Value {
        match value {
            Value::Real(x) if self.graph().ty(from) == Type::Real => {
                let place = self.points.place_format(place);
                Value::Real(self.brought(x, place, || "what it is carried in".to_owned()))
            }
            other => other,
        }
    }

    fn gather(&self, received: Value, sent: Value) -> Value {
        Op::Add.eval(&[received, sent])
    }

    fn truth(&self, value: Value) -> bool {
        value.truth()
    }

    fn int(&self, value: Value) -> i32 {
        value.int()
    }
}

/// Runs a plan's statements so; nothing where points are not the plan's affair.
pub fn lost(plan: &Plan) -> Option<Lost> {
    let losing = Losing {
        plan,
        points: plan.points()?,
        first: RefCell::default(),
        rounded: RefCell::default(),
    };
    let reports = {
        let mut run = Run::new(&plan.graph, &plan.tree, &losing);
        run.pixel(0, 0);
        run.reports()
    };
    Some(Lost {
        reports,
        first: losing.first.into_inner().or(losing.rounded.into_inner()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_holds_what_is_rounded_and_neither_more_nor_less() {
        let place = Format::Fixed { bits: 8, frac: 5 };
        for (x, wanted) in [
            (0.0, 0.0),
            (1.0 / 64.0, 0.0),
            (-1.0 / 63.0, -1.0 / 63.0),
            (0.3, 0.3),
            (3.99, 3.99),
            (4.0, 127.0 / 32.0),
            (-100.0, -127.0 / 32.0),
        ] {
            assert_eq!(held(x, place), wanted, "{x}");
        }
    }
}
