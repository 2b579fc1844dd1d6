//! Value specialisation of factors: what is multiplied by one of a few numbers is compared with
//! other numbers instead.
//!
//! A chequered floor is lit by h (0.5 p + 0.3) where p is 0 or 1. That such a shade
//! is below a threshold t is h < t / 0.3 or h < t / 0.8, and these are known before
//! the pixel is: any function of a value that takes few values is a choice between
//! what it is for each of them (Shannon's expansion, as in [`crate::passes::branches::unswitch`]), and in each
//! the factor is a constant, which goes over to the side of the comparison that is
//! the same for the whole pass.
//!
//! Over the reals nothing changes. At least one product at a pixel is gone for one
//! product with a constant on the other side, so no more roundings meet in the
//! comparison than before. Fixed point and logarithms keep their comparisons, since a
//! threshold may leave their range, but where each value has its own point.
//!
//! The choice copies what stands between the factor and the value that is chosen, so it
//! is for the plan to find out which of the ways pays, if any.

mod arm;
#[cfg(test)]
mod tests;

use crate::analysis::range::Ranges;
use crate::analysis::rate::{Rates, rates};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use arm::Arm;
use slowlight_routine::{Format, Op, Runtime, Type, Value};

/// How many values a switch may take.
const FEW: usize = 3;

/// How many ways are tried.
const WAYS: usize = 16;

/// How many values may stand between a factor and what is chosen.
const BETWEEN: usize = 32;

/// The graph with a factor's switch asked sooner, for each of the ways to do that: the
/// widest choice of each factor first.
pub fn specialise_factors(
    graph: &Graph,
    ranges: &Ranges,
    runtime: &Runtime,
) -> impl Iterator<Item = Graph> + use<> {
    let site = Site::new(graph, ranges, runtime);
    let ways = site.ways();
    let made = ways.into_iter().filter_map(|way| site.chosen_by(way));
    made.collect::<Vec<_>>().into_iter()
}

/// A way to ask a switch sooner.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Way {
    switch: NodeId,
    /// What is chosen by it.
    chosen: NodeId,
}

/// What a value is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Of {
    /// Constants alone.
    Nothing,
    /// Those and one value that takes few values.
    Switch(NodeId),
    More,
}

struct Site<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    rates: Rates,
    of: Vec<Of>,
    /// Whether a constant factor may go over to a comparison's other side.
    moves: bool,
}

impl<'g> Site<'g> {
    fn new(graph: &'g Graph, ranges: &'g Ranges, runtime: &Runtime) -> Site<'g> {
        let mut site = Site {
            graph,
            ranges,
            rates: rates(graph),
            of: Vec::with_capacity(graph.nodes.len()),
            moves: match runtime.real {
                // Each threshold has a point of its own.
                Format::Scaled { .. } => true,
                Format::Log { .. } => false,
                real => !real.is_fixed(),
            },
        };
        for id in graph.ids() {
            let of = site.made_of(id);
            site.of.push(of);
        }
        site
    }

    fn of(&self, id: NodeId) -> Of {
        self.of.get(id.0 as usize).copied().unwrap_or(Of::More)
    }

    fn made_of(&self, id: NodeId) -> Of {
        let node = self.graph.node(id);
        match node {
            Node::Const(_) => return Of::Nothing,
            Node::Apply(..) => {
                let operands = node.operands().map(|a| self.of(a));
                let joined = operands.reduce(|a, b| match (a, b) {
                    (Of::Nothing, one) | (one, Of::Nothing) => one,
                    (a, b) if a == b => a,
                    _ => Of::More,
                });
                if let Some(found @ (Of::Nothing | Of::Switch(_))) = joined {
                    return found;
                }
            }
            _ => {}
        }
        match self.values(id).is_empty() {
            true => Of::More,
            false => Of::Switch(id),
        }
    }

    /// The values that a switch takes, in order; none if it is not one.
    fn values(&self, id: NodeId) -> Vec<Value> {
        if self.rates.is_still(id) {
            return Vec::new();
        }
        match self.graph.node(id) {
            Node::Select { yes, no, .. } if self.graph.ty(id) != Type::Bool => {
                let all = [no, yes].map(|arm| self.graph.constant(arm));
                all.into_iter().collect::<Option<_>>().unwrap_or_default()
            }
            Node::Apply(..) if self.graph.ty(id) == Type::Int => {
                let Some(range) = self.ranges.result.get(id.0 as usize) else {
                    return Vec::new();
                };
                let count = range.hi - range.lo + 1.0;
                let taken = |n: &i32| *n != 0 || !range.nonzero;
                match count >= 2.0 && count <= FEW as f64 {
                    true => (range.lo as i32..=range.hi as i32)
                        .filter(taken)
                        .map(Value::Int)
                        .collect(),
                    false => Vec::new(),
                }
            }
            _ => Vec::new(),
        }
    }

    /// Every switch with a value that may be chosen by it, the first so many.
    fn ways(&self) -> Vec<Way> {
        let reached = self.graph.reached();
        let mut ways: Vec<Way> = Vec::new();
        for product in self.graph.ids().filter(|id| reached[id.0 as usize]) {
            let Some((switch, factor)) = self.factor(product) else {
                continue;
            };
            let mut add = |chosen| {
                let way = Way { switch, chosen };
                if ways.len() < WAYS && !ways.contains(&way) {
                    ways.push(way);
                }
            };
            if let Some(chosen) = self.compared(factor) {
                add(chosen);
            }
            add(product);
            // A choice between numbers is one already.
            if factor != switch {
                add(factor);
            }
        }
        ways
    }

    /// The graph with a choice.
    fn chosen_by(&self, way: Way) -> Option<Graph> {
        let mut done = false;
        let next = rebuild_old(self.graph, &mut |builder, made, id, span| {
            if id != way.chosen {
                return None;
            }
            let choice = self.choice(builder, made, way, span)?;
            done = true;
            Some(choice)
        });
        done.then_some(next)
    }

    /// The factor of few values of a product, or quotient, of something else, and its switch.
    fn factor(&self, product: NodeId) -> Option<(NodeId, NodeId)> {
        let Node::Apply(Op::Mul | Op::Div, [a, b]) = self.graph.node(product) else {
            return None;
        };
        match (self.of(a), self.of(b), self.of(product)) {
            (_, _, Of::Switch(_)) => None,
            (Of::Switch(switch), _, _) => Some((switch, a)),
            (_, Of::Switch(switch), _) => Some((switch, b)),
            _ => None,
        }
    }

    /// The first value that is no real and has all that is made of a factor.
    fn compared(&self, factor: NodeId) -> Option<NodeId> {
        let mut above = vec![false; self.graph.nodes.len()];
        above[factor.0 as usize] = true;
        let made = |id: &NodeId| {
            let mut operands = self.graph.node(*id).operands();
            above[id.0 as usize] |= operands.any(|a| above[a.0 as usize]);
            above[id.0 as usize] && *id != factor
        };
        let all: Vec<NodeId> = self.graph.ids().filter(made).take(BETWEEN).collect();
        let fits = |id: &NodeId| self.graph.ty(*id) != Type::Real && self.closes(factor, *id);
        all.into_iter().find(fits)
    }

    /// Whether nothing that a pixel needs is made of a value but through another.
    fn closes(&self, value: NodeId, through: NodeId) -> bool {
        let mut seen = vec![false; self.graph.nodes.len()];
        let mut todo: Vec<NodeId> = self.graph.roots().collect();
        while let Some(id) = todo.pop() {
            if id == value {
                return false;
            }
            // What a value is made of stands before it.
            let open = id != through && id > value && !seen[id.0 as usize];
            seen[id.0 as usize] = true;
            if open {
                todo.extend(self.graph.references(id));
            }
        }
        true
    }

    /// A value chosen by a switch.
    fn choice(
        &self,
        builder: &mut Builder,
        made: &[Option<NodeId>],
        way: Way,
        span: Span,
    ) -> Option<NodeId> {
        let switch = way.switch;
        let values = self.values(switch);
        let mut arms = Vec::new();
        for value in &values {
            let value = builder.constant(*value, span);
            arms.push(Arm::new(self, made, switch, value).value(builder, way, span)?);
        }
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        if let Node::Select { cond, .. } = self.graph.node(switch) {
            return Some(builder.select(new(cond)?, *arms.get(1)?, *arms.first()?, span));
        }
        let asked = new(switch)?;
        let mut all = values.iter().zip(arms);
        let (low, first) = all.next()?;
        let chosen = all.try_fold((*low, first), |(low, less), (value, arm)| {
            let low = builder.constant(low, span);
            let more = builder.apply(Op::IntLess, &[low, asked], span);
            Some((*value, builder.select(more, arm, less, span)))
        });
        chosen.map(|(_, choice)| choice)
    }
}
