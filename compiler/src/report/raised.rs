//! What each line of a scene adds to the error of a plan's picture: the plan run in
//! its routines' models, but for the values of one line, which are computed in `f64`
//! from what the machine has, and rounded only where others read them.
//!
//! What the error loses by that is the line's share. Shares need not add up to the
//! whole: errors may cancel, and a line may pass on what another began.

use super::profile::lines_of;
use crate::eval::arithmetic::Arithmetic;
use crate::eval::native::Pixel;
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::tree::Place as Home;
use crate::plan::Plan;
use crate::scene::Scene;
use slowlight_routine::{Bits, Format, Op, Type, Value};
use std::collections::BTreeMap;

/// A value as the machine has it, and as the line that is raised has it.
#[derive(Clone, Copy, Debug)]
pub struct Held {
    bits: Bits,
    value: Value,
    raised: bool,
}

/// A plan's arithmetic with some nodes in `f64`.
pub struct Raised<'p> {
    plan: &'p Plan,
    nodes: Vec<bool>,
}

impl Raised<'_> {
    fn held(&self, bits: Bits, format: Format) -> Held {
        Held {
            bits,
            value: (self.plan.runtime.decode)(bits, format),
            raised: false,
        }
    }
}

impl Arithmetic for Raised<'_> {
    type Value = Held;

    fn constant(&self, value: Value) -> Held {
        let format = self.plan.runtime.format_of(value.ty());
        let held = self.held(self.plan.bits(value), format);
        match (value.ty(), self.plan.points()) {
            // It is rounded where it is read.
            (Type::Real, Some(_)) => Held { value, ..held },
            _ => held,
        }
    }

    fn entry(&self, table: TableId, at: usize, _: Value) -> Held {
        self.held(self.plan.entry(table, at), self.plan.entry_format(table))
    }

    fn param(&self, id: ParamId) -> Held {
        let bits = self.plan.params.get(id.0 as usize).map_or(0, |p| p.bits);
        self.held(bits, self.plan.param_format(id))
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Held]) -> Held {
        let list = |k: usize| args.get(k).copied();
        let format = self.plan.format(id);
        if self.nodes.get(id.0 as usize) == Some(&true) {
            let values = [list(0), list(1)].map(|a| a.map_or(Value::Int(0), |a| a.value));
            let value = op.eval(values.get(..args.len()).unwrap_or(&values));
            return Held {
                bits: (self.plan.runtime.encode)(value, format),
                value,
                raised: true,
            };
        }
        let bits = [list(0), list(1)].map(|a| a.map_or(0, |a| a.bits));
        let bits = self
            .plan
            .computed(id, bits.get(..args.len()).unwrap_or(&bits));
        self.held(bits, format)
    }

    fn copied(&self, place: Home, from: NodeId, value: Held) -> Held {
        let bits = self.plan.copied(place, from, value.bits);
        match bits == value.bits || value.raised {
            true => Held { bits, ..value },
            false => self.held(bits, self.plan.place_format(place)),
        }
    }

    fn sent(&self, from: NodeId, value: Held) -> Held {
        Held {
            bits: self.plan.sent(from, value.bits),
            ..value
        }
    }

    fn gather(&self, received: Held, sent: Held) -> Held {
        Held {
            bits: self.plan.gathered(received.bits, sent.bits),
            value: Op::Add.eval(&[received.value, sent.value]),
            raised: false,
        }
    }

    fn truth(&self, value: Held) -> bool {
        value.value.truth()
    }

    fn int(&self, value: Held) -> i32 {
        value.value.int()
    }
}

/// Evaluates a plan with some nodes in `f64`, pixel by pixel.
pub struct RaisedRun<'p> {
    plan: &'p Plan,
    run: Run<'p, Raised<'p>>,
}

impl<'p> RaisedRun<'p> {
    /// `nodes`: which are raised, by their numbers; no more than so many statements are worth
    /// running ([`Run::within`]).
    pub fn within(plan: &'p Plan, nodes: Vec<bool>, most: u64) -> RaisedRun<'p> {
        let arithmetic = Raised { plan, nodes };
        RaisedRun {
            plan,
            run: Run::within(&plan.graph, &plan.tree, arithmetic, most),
        }
    }

    /// Whether all of them have run.
    pub fn spent(&self) -> bool {
        self.run.spent()
    }

    /// The ink and shade of the picture's column `x`, row `y`; where the plan does not
    /// compute the shade, it is ink/(inks - 1).
    pub fn pixel(&mut self, x: i32, y: i32) -> Pixel {
        let graph = &self.plan.graph;
        let top = graph.image.palette.len().saturating_sub(1).max(1) as i32;
        let ink = self.run.pixel(x, y).value.int().clamp(0, top);
        let shade = graph.shade.and_then(|id| self.run.last(id));
        Pixel {
            ink: ink as u8,
            shade: shade.map_or(f64::from(ink) / f64::from(top), |held| held.value.real()),
        }
    }
}

/// For each line of the scene's files (number, line from 1) whose values the plan
/// computes in reals: which nodes those are.
pub fn raisable(scene: &Scene, plan: &Plan) -> BTreeMap<(u16, usize), Vec<bool>> {
    let lines = lines_of(scene);
    let mut found: BTreeMap<(u16, usize), Vec<bool>> = BTreeMap::new();
    for (place, _) in plan.places() {
        let Home::Node(id) = place else {
            continue;
        };
        let real = |op: Op| op.result() == Type::Real || op.args().contains(&Type::Real);
        if matches!(plan.graph.node(id), Node::Apply(op, _) if real(op)) {
            let none = || vec![false; plan.graph.nodes.len()];
            let nodes = found.entry(lines.place(plan.graph.span(id)));
            if let Some(flag) = nodes.or_insert_with(none).get_mut(id.0 as usize) {
                *flag = true;
            }
        }
    }
    found
}
