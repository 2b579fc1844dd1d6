//! Where values leave a format: an operation whose exact result does not fit,
//! and which therefore saturates, or vanishes.
//!
//! A machine goes on with what is left; whoever judges its result has to know.

use slowlight_compiler::eval::arithmetic::Arithmetic;
use slowlight_compiler::eval::run::Run;
use slowlight_compiler::flow::graph::{Graph, NodeId, ParamId};
use slowlight_compiler::passes::schedule::schedule;
use slowlight_compiler::plan::Plan;
use slowlight_routine::{Bits, Format, Op, Value};
use std::cell::RefCell;

/// The greatest magnitude of a real in a format.
fn most(format: Format) -> f64 {
    match format {
        Format::Real40 => 1.7e38,
        Format::Fixed { bits, frac } => 2f64.powi(i32::from(bits) - 1 - i32::from(frac)),
        _ => f64::MAX,
    }
}

/// Whether an operation's result left what the format holds.
fn leaves(op: Op, args: &[Value], got: Value, most: f64) -> bool {
    let exact = match (op, args) {
        (Op::Floor, [a]) => a.real().floor(),
        (Op::Round, [a]) => a.real().round(),
        _ => op.eval(args).real(),
    };
    match got {
        Value::Real(got) => exact.abs() >= most || (exact != 0.0 && got == 0.0),
        Value::Int(got) => (exact - f64::from(got)).abs() > exact.abs() / 2.0 + 1.0,
        Value::Bool(_) => false,
    }
}

/// The models, watched.
struct Models<'p> {
    plan: &'p Plan,
    left: &'p RefCell<Option<String>>,
}

impl Arithmetic for Models<'_> {
    type Value = Bits;

    fn constant(&self, value: Value) -> Bits {
        self.plan.bits(value)
    }

    fn param(&self, id: ParamId) -> Bits {
        self.plan.params.get(id.0 as usize).map_or(0, |p| p.bits)
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Bits]) -> Bits {
        let Some(routine) = self.plan.routine(id) else {
            return 0;
        };
        let runtime = self.plan.runtime;
        let result = (routine.model)(args);
        let formats = routine.args.iter().zip(args);
        let values: Vec<Value> = formats.map(|(f, a)| (runtime.decode)(*a, *f)).collect();
        let got = (runtime.decode)(result, routine.result);
        if leaves(op, &values, got, most(runtime.real)) {
            note(self.left, op, &values, runtime.format);
        }
        result
    }

    fn gather(&self, received: Bits, _: Bits) -> Bits {
        received
    }

    fn truth(&self, value: Bits) -> bool {
        (self.plan.runtime.decode)(value, Format::Bool).truth()
    }

    fn int(&self, value: Bits) -> i32 {
        (self.plan.runtime.decode)(value, self.plan.runtime.int).int()
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
    let left = RefCell::new(None);
    let models = Models { plan, left: &left };
    Run::new(&plan.graph, &plan.tree, models).pixel(0, 0);
    left.into_inner()
}

/// The graph in `f64`, watched.
struct Natively<'g> {
    graph: &'g Graph,
    left: &'g RefCell<Option<String>>,
}

impl Arithmetic for Natively<'_> {
    type Value = Value;

    fn constant(&self, value: Value) -> Value {
        value
    }

    fn param(&self, id: ParamId) -> Value {
        slowlight_compiler::eval::native::param_value(self.graph, id)
    }

    fn apply(&self, _: NodeId, op: Op, args: &[Value]) -> Value {
        let result = op.eval(args);
        let vanished = matches!(op, Op::Mul | Op::Div)
            && result.real() == 0.0
            && args.first().is_some_and(|a| a.real() != 0.0)
            && (op == Op::Div || args.iter().all(|a| a.real() != 0.0));
        if leaves(op, args, result, f64::MAX) || vanished {
            note(self.left, op, args, "f64");
        }
        result
    }

    fn gather(&self, received: Value, _: Value) -> Value {
        received
    }

    fn truth(&self, value: Value) -> bool {
        value.truth()
    }

    fn int(&self, value: Value) -> i32 {
        value.int()
    }
}

/// The first operation of the native evaluation that leaves `f64`, in words.
pub fn native(graph: &Graph) -> Option<String> {
    let left = RefCell::new(None);
    let tree = schedule(graph);
    let watched = Natively { graph, left: &left };
    Run::new(graph, &tree, watched).pixel(0, 0);
    left.into_inner()
}
