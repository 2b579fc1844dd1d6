//! Semantics of a plan's statements on bits: what its routines, points and ranges make of what
//! places hold. The model ([`crate::plan::model`]) and constant folding evaluate by these.

use super::Plan;
use crate::analysis::points::Points;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use slowlight_routine::{Bits, Op, Range, Type, scale};

/// A plan's operations, looked up once to be computed often.
pub struct Operations<'p> {
    plan: &'p Plan,
    all: Vec<Option<Operation>>,
}

impl<'p> Operations<'p> {
    /// All of a plan's.
    pub fn of(plan: &'p Plan) -> Operations<'p> {
        let all = plan.graph.ids().map(|id| Operation::of(plan, id));
        Operations {
            plan,
            all: all.collect(),
        }
    }

    /// As [`Plan::computed`].
    pub fn computed(&self, id: NodeId, args: &[Bits]) -> Bits {
        let found = self.all.get(id.0 as usize).and_then(Option::as_ref);
        found.map_or(0, |operation| operation.computed(self.plan, args))
    }
}

/// An operation: its routine's model, and what is done to bits before and behind it.
struct Operation {
    model: fn(&[Bits]) -> Bits,
    /// What a scaled format's model is given.
    scaled: Option<Scaled>,
    /// The bounds of its result, where it is a real that is kept within them.
    range: Option<Range>,
}

/// How operands are read at a routine's scales.
#[derive(Default)]
struct Scaled {
    reads: [Read; 2],
    /// What the model is told behind them: its number.
    number: Option<Bits>,
}

#[derive(Clone, Copy, Default)]
enum Read {
    #[default]
    AsItIs,
    /// A constant has its own bits at each scale.
    Constant(Bits),
    Moved {
        from: i8,
        to: i8,
        width: u8,
    },
}

impl Operation {
    fn of(plan: &Plan, id: NodeId) -> Option<Operation> {
        let routine = plan.routine(id)?;
        let range = plan.ranges.result.get(id.0 as usize).copied();
        Some(Operation {
            model: routine.model,
            scaled: plan
                .points
                .as_ref()
                .map(|points| Scaled::of(plan, points, id)),
            range: range.filter(|_| plan.format(id) == plan.runtime.real),
        })
    }

    fn computed(&self, plan: &Plan, args: &[Bits]) -> Bits {
        let bits = match (&self.scaled, &plan.points) {
            (Some(scaled), Some(points)) => {
                let (mut all, count) = ([0; 3], args.len().min(2));
                for (k, bits) in args.iter().take(count).enumerate() {
                    all[k] = scaled.reads[k].bits(points, *bits);
                }
                all[count] = scaled.number.unwrap_or(0);
                (self.model)(&all[..count + usize::from(scaled.number.is_some())])
            }
            _ => (self.model)(args),
        };
        match self.range {
            Some(range) => (plan.runtime.kept)(bits, range),
            None => bits,
        }
    }
}

impl Scaled {
    fn of(plan: &Plan, points: &Points, id: NodeId) -> Scaled {
        let graph = &plan.graph;
        let (op, of) = match graph.node(id) {
            Node::Apply(op, of) if scale::concerns(op) => (op, of),
            _ => return Scaled::default(),
        };
        let scales = points.scales(id);
        let width = points.widths().operands(id);
        let read = |k: usize| match graph.constant(of[k]) {
            // All bits of an int, which may be more than a real has.
            _ if op == Op::IntRoot => Read::AsItIs,
            Some(value) if graph.ty(of[k]) == Type::Real => {
                Read::Constant(scale::nearest(value.real(), scales.args[k], width))
            }
            _ => Read::Moved {
                from: points.own(of[k]),
                to: scales.args[k],
                width,
            },
        };
        Scaled {
            reads: [read(0), read(1)],
            number: Some(i64::from(scales.number(op)) as Bits),
        }
    }
}

impl Read {
    fn bits(self, points: &Points, bits: Bits) -> Bits {
        match self {
            Read::AsItIs => bits,
            Read::Constant(bits) => bits,
            Read::Moved { from, to, width } => points.moved(bits, from, (to, width)),
        }
    }
}

impl Plan {
    /// What an operation's routine makes of its operands' bits, as the node's place keeps it.
    pub fn computed(&self, id: NodeId, args: &[Bits]) -> Bits {
        Operation::of(self, id).map_or(0, |operation| operation.computed(self, args))
    }

    /// What a pixel has received when it is sent more.
    pub fn gathered(&self, received: Bits, sent: Bits) -> Bits {
        match (self.gather(), &self.points) {
            (Some(routine), Some(_)) => (routine.model)(&[received, sent, 0]),
            (Some(routine), None) => (routine.model)(&[received, sent]),
            (None, _) => received,
        }
    }

    /// What a node's bits are when they are sent to another pixel.
    pub fn sent(&self, from: NodeId, bits: Bits) -> Bits {
        match &self.points {
            Some(points) => points.read(
                &self.graph,
                from,
                bits,
                (points.received(), points.widths().most()),
            ),
            None => bits,
        }
    }

    /// What a state holds that is given a node's bits.
    pub fn given(&self, state: ParamId, from: NodeId, bits: Bits) -> Bits {
        match &self.points {
            Some(points) if self.graph.ty(from) == Type::Real => {
                let held = self.param_node(state);
                let held = held.map(|id| (points.own(id), points.widths().place(Place::Node(id))));
                match held {
                    Some(held) => points.read(&self.graph, from, bits, held),
                    None => bits,
                }
            }
            _ => bits,
        }
    }

    /// What a place holds that is given a node's bits.
    pub fn copied(&self, place: Place, from: NodeId, bits: Bits) -> Bits {
        match &self.points {
            Some(points) if self.graph.ty(from) == Type::Real => points.read(
                &self.graph,
                from,
                bits,
                (points.place(place), points.widths().place(place)),
            ),
            _ => bits,
        }
    }
}
