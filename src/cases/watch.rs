//! Where values leave a format: an operation whose exact result does not fit,
//! and which therefore saturates, or vanishes.
//!
//! A machine goes on with what is left; whoever judges its result has to know.

use super::format::worth;
use slowlight_compiler::eval::arithmetic::{Exact, Tagged};
use slowlight_compiler::eval::heard::{Heard, Listener};
use slowlight_compiler::eval::run::Run;
use slowlight_compiler::ir::graph::{Graph, NodeId};
use slowlight_compiler::plan::Plan;
use slowlight_compiler::plan::model::Model;
use slowlight_compiler::schedule::statements::schedule;
use slowlight_routine::scale::finest;
use slowlight_routine::{Bits, Format, Op, Type, Value};
use std::cell::RefCell;

/// The greatest magnitude of a real in a format.
fn most(format: Format) -> f64 {
    match format {
        Format::Real40 => 1.7e38,
        // The greatest logarithm is a last place below that.
        Format::Log { .. } => format.most() * 0.9996,
        Format::Fixed { bits, frac } => 2f64.powi(i32::from(bits) - 1 - i32::from(frac)),
        _ => f64::MAX,
    }
}

/// An operation's exact result, whatever an int can hold.
fn exactly(op: Op, args: &[Value]) -> f64 {
    match (op, args) {
        (Op::Floor, [a]) => a.real().floor(),
        (Op::Round, [a]) => a.real().round(),
        _ => op.eval(args).real(),
    }
}

/// Whether an operation's result left what the format holds.
fn leaves(op: Op, args: &[Value], got: Value, most: f64) -> bool {
    let exact = exactly(op, args);
    match got {
        // A factor of 0 that is held as something else makes something of the other.
        Value::Real(got) => {
            let made = op == Op::Mul && exact == 0.0;
            exact.abs() >= most || (exact != 0.0 && got == 0.0) || (made && got != 0.0)
        }
        Value::Int(got) => (exact - f64::from(got)).abs() > exact.abs() / 2.0 + 1.0,
        Value::Bool(_) => false,
    }
}

/// Looks at what the models make of their arguments.
struct Models<'p> {
    plan: &'p Plan,
    left: RefCell<Option<String>>,
}

impl Models<'_> {
    /// Looks at an operation whose values have places of their own. What is smaller than a
    /// last place there is no more off than any rounding, but where no place is finer.
    fn placed(&self, id: NodeId, op: Op, args: &[Bits], result: Bits) {
        let (graph, runtime) = (&self.plan.graph, self.plan.runtime);
        let operands = graph.node(id).operands().zip(args);
        let values: Vec<Value> = operands
            .map(|(of, bits)| {
                let held = (runtime.decode)(*bits, self.plan.format(of));
                graph.constant(of).unwrap_or(held)
            })
            .collect();
        let place = self.plan.format(id);
        let exact = exactly(op, &values);
        let last = matches!(place, Format::Fixed { bits, frac } if frac == finest(bits));
        let gone = last && result == 0 && exact != 0.0;
        if op.result() == Type::Real && (gone || exact.abs() >= place.most()) {
            note(&self.left, op, &values, runtime.format);
        }
    }
}

impl Listener<Bits> for Models<'_> {
    fn applied(&self, id: NodeId, op: Op, args: &[Bits], result: Bits) {
        let Some(routine) = self.plan.routine(id) else {
            return;
        };
        if self.plan.points().is_some() {
            return self.placed(id, op, args, result);
        }
        let runtime = self.plan.runtime;
        let decoded = |bits, format| match (runtime.decode)(bits, format) {
            Value::Real(x) => Value::Real(worth(format, x)),
            other => other,
        };
        let formats = routine.args.iter().zip(args);
        let values: Vec<Value> = formats.map(|(f, a)| decoded(*a, *f)).collect();
        let got = decoded(result, routine.result);
        if leaves(op, &values, got, most(runtime.real)) {
            note(&self.left, op, &values, runtime.format);
        }
    }
}

fn note(left: &RefCell<Option<String>>, op: Op, args: &[Value], format: &str) {
    let mut left = left.borrow_mut();
    if left.is_none() {
        let args: Vec<String> = args.iter().map(|a| format!("{:.6e}", a.real())).collect();
        let op = op.name();
        *left = Some(format!("{op} of {} does not fit {format}", args.join(", ")));
    }
}

/// The first operation of a plan's run that leaves its format, in words.
pub fn plan(plan: &Plan) -> Option<String> {
    let heard = Heard {
        arithmetic: Model::of(plan),
        listener: Models {
            plan,
            left: RefCell::new(None),
        },
    };
    Run::new(&plan.graph, &plan.tree, &heard).pixel(0, 0);
    heard.listener.left.into_inner()
}

/// Looks at what is computed in `f64`.
#[derive(Default)]
struct Natively {
    left: RefCell<Option<String>>,
}

impl Listener<Tagged> for Natively {
    fn applied(&self, _: NodeId, op: Op, args: &[Tagged], result: Tagged) {
        let args: Vec<Value> = args.iter().map(|tagged| Value::from(*tagged)).collect();
        let (args, result) = (args.as_slice(), Value::from(result));
        let vanished = matches!(op, Op::Mul | Op::Div)
            && result.real() == 0.0
            && args.first().is_some_and(|a| a.real() != 0.0)
            && (op == Op::Div || args.iter().all(|a| a.real() != 0.0));
        if leaves(op, args, result, f64::MAX) || vanished {
            note(&self.left, op, args, "f64");
        }
    }
}

/// The first operation of the native evaluation that leaves `f64`, in words.
pub fn native(graph: &Graph) -> Option<String> {
    let tree = schedule(graph);
    let heard = Heard {
        arithmetic: Exact(graph),
        listener: Natively::default(),
    };
    Run::new(graph, &tree, &heard).pixel(0, 0);
    heard.listener.left.into_inner()
}
