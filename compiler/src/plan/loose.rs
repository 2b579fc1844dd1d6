//! Results that may be smaller than their format's least magnitude
//! ([`slowlight_routine::Loose`]): all that may be, less those that a reader minds.

use super::choose::Chosen;
use crate::flow::graph::*;
use crate::range::Ranges;
use slowlight_routine::{Loose, Op, Routine};

/// Puts routines that leave small results as they come in the place of those that do not,
/// where everything that reads a result takes that.
pub(super) fn loosen(graph: &Graph, ranges: &Ranges, loose: &Loose, chosen: &mut Chosen) {
    // Calls copy what they are given and leave; nobody looks at what reads these.
    if graph
        .ids()
        .any(|id| matches!(graph.node(id), Node::Slot(_)))
    {
        return;
    }
    let instead = chosen
        .iter()
        .map(|routine| routine.and_then(loose.instead))
        .collect();
    let mut search = Search {
        graph,
        ranges,
        loose,
        instead,
        reached: graph.reached(),
    };
    while search.held_back(chosen) {}
    for (routine, instead) in chosen.iter_mut().zip(search.instead) {
        *routine = instead.or(*routine);
    }
}

struct Search<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    loose: &'g Loose,
    /// What leaves each result as small as it comes, where that is wanted still.
    instead: Vec<Option<&'static Routine>>,
    reached: Vec<bool>,
}

impl Search<'_> {
    /// Takes back what the first reader minds that does; whether there is one.
    fn held_back(&mut self, chosen: &Chosen) -> bool {
        let mut lows = vec![self.loose.held; self.graph.nodes.len()];
        for id in self.graph.ids().filter(|id| self.reached[id.0 as usize]) {
            let at = id.0 as usize;
            let least = match (self.graph.node(id), self.instead[at].or(chosen[at])) {
                (Node::Apply(op, args), Some(routine)) => {
                    let args = &args[..op.arity()];
                    let of: Vec<i32> = args.iter().map(|arg| lows[arg.0 as usize]).collect();
                    (self.loose.least)(routine, &self.ranges.args[at][..op.arity()], &of)
                }
                // Copies.
                (Node::Select { yes, no, .. }, _) => {
                    Some(lows[yes.0 as usize].min(lows[no.0 as usize]))
                }
                (node, _) => {
                    let loose = |arg: NodeId| lows[arg.0 as usize] < self.loose.held;
                    (!node.operands().any(loose)).then_some(self.loose.held)
                }
            };
            match least {
                Some(least) => lows[at] = least,
                None => return self.take_back(self.graph.node(id).operands(), &lows),
            }
        }
        let loops = self.graph.loops.iter();
        let ends = loops.flat_map(|l| [&l.init, &l.next, &l.done, &l.otherwise].into_iter());
        let ends: Vec<NodeId> = ends
            .flatten()
            .copied()
            .chain(self.graph.outputs())
            .collect();
        self.take_back(ends.into_iter(), &lows)
    }

    /// Takes back those of these that are loose, or what makes them so; whether any was. A
    /// sum is as small as the greater of its summands, so that one need be held.
    fn take_back(&mut self, these: impl Iterator<Item = NodeId>, lows: &[i32]) -> bool {
        let loose = |id: &NodeId| lows[id.0 as usize] < self.loose.held;
        let mut minded: Vec<NodeId> = these.filter(loose).collect();
        let any = !minded.is_empty();
        while let Some(id) = minded.pop() {
            if self.instead[id.0 as usize].take().is_some() {
                continue;
            }
            if let Node::Select { yes, no, .. } = self.graph.node(id) {
                minded.extend([yes, no].iter().filter(|arg| loose(arg)));
            }
            if let Node::Apply(op, args) = self.graph.node(id) {
                let one = if matches!(op, Op::Add | Op::Sub) {
                    1
                } else {
                    2
                };
                minded.extend(args[..op.arity()].iter().filter(|arg| loose(arg)).take(one));
            }
        }
        any
    }
}
