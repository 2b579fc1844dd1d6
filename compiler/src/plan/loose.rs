//! Results that may be smaller than their format's least magnitude
//! ([`slowlight_routine::Loose`]): all that may be, less those that a reader minds.

use super::choose::Chosen;
use crate::flow::graph::*;
use crate::range::Ranges;
use slowlight_routine::{Loose, Routine};

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
    /// Takes back what a reader minds; whether there was any.
    fn held_back(&mut self, chosen: &Chosen) -> bool {
        let mut lows = vec![self.loose.held; self.graph.nodes.len()];
        let mut minded: Vec<NodeId> = Vec::new();
        for id in self.graph.ids().filter(|id| self.reached[id.0 as usize]) {
            let at = id.0 as usize;
            let low = |arg: &NodeId| lows[arg.0 as usize];
            let is_loose = |arg: &NodeId| low(arg) < self.loose.held;
            match (self.graph.node(id), self.instead[at].or(chosen[at])) {
                (Node::Apply(op, args), Some(routine)) => {
                    let args = &args[..op.arity()];
                    let of: Vec<i32> = args.iter().map(low).collect();
                    let ranges = &self.ranges.args[at][..op.arity()];
                    match (self.loose.least)(routine, ranges, &of) {
                        Some(least) => lows[at] = least,
                        None => minded.extend(args.iter().filter(|arg| is_loose(arg))),
                    }
                }
                (node, _) => minded.extend(node.operands().filter(is_loose)),
            }
        }
        let loops = self.graph.loops.iter();
        let ends = loops.flat_map(|l| {
            [&l.init, &l.next, &l.done, &l.otherwise]
                .into_iter()
                .flatten()
        });
        let ends = self.graph.outputs().chain(ends.copied());
        minded.extend(ends.filter(|id| lows[id.0 as usize] < self.loose.held));
        let any = !minded.is_empty();
        while let Some(id) = minded.pop() {
            let at = id.0 as usize;
            if self.instead[at].take().is_none()
                && let Node::Apply(op, args) = self.graph.node(id)
            {
                let args = args[..op.arity()].iter();
                minded.extend(args.filter(|arg| lows[arg.0 as usize] < self.loose.held));
            }
        }
        any
    }
}
