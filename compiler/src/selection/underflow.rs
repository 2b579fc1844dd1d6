//! Flush-to-zero analysis: results that may be smaller than their format's least magnitude
//! ([`slowlight_routine::Loose`]): all that may be, less those that a reader minds.

use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use slowlight_routine::{Loose, Op, Routine};

/// Puts routines that leave small results as they come in the place of those that do not,
/// where everything that reads a result takes that.
pub(crate) fn loosen(
    graph: &Graph,
    ranges: &Ranges,
    loose: &Loose,
    chosen: &mut [Option<&'static Routine>],
) {
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
        lows: vec![loose.held; graph.nodes.len()],
    };
    let mut from = Some(0);
    while let Some(at) = from {
        from = search.held_back(chosen, at);
    }
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
    /// How small each may be, as far as that is known.
    lows: Vec<i32>,
}

impl Search<'_> {
    /// Takes back what the first reader minds that does; from which node on all may be
    /// otherwise then, if there is one. Up to `from` nothing has changed.
    fn held_back(&mut self, chosen: &[Option<&'static Routine>], from: usize) -> Option<usize> {
        let mut lows = std::mem::take(&mut self.lows);
        let minded = self.minded(chosen, from, &mut lows);
        let taken = self.take_back(minded, &lows);
        self.lows = lows;
        taken
    }

    /// What the first reader minds that does, or what leaves the graph.
    fn minded(
        &self,
        chosen: &[Option<&'static Routine>],
        from: usize,
        lows: &mut [i32],
    ) -> Vec<NodeId> {
        let later = self.graph.ids().skip(from);
        for id in later.filter(|id| self.reached[id.0 as usize]) {
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
                None => return self.graph.node(id).operands().collect(),
            }
        }
        let loops = self.graph.loops.iter();
        let ends = loops.flat_map(|l| [&l.init, &l.next, &l.done, &l.otherwise].into_iter());
        ends.flatten()
            .copied()
            .chain(self.graph.outputs())
            .collect()
    }

    /// Takes back those of these that are loose, or what makes them so; the first of them. A
    /// sum is as small as the greater of its summands, so that one need be held.
    fn take_back(&mut self, mut minded: Vec<NodeId>, lows: &[i32]) -> Option<usize> {
        let loose = |id: &NodeId| lows[id.0 as usize] < self.loose.held;
        minded.retain(loose);
        let mut first = None;
        while let Some(id) = minded.pop() {
            let at = id.0 as usize;
            if self.instead[at].take().is_some() {
                first = Some(first.unwrap_or(at).min(at));
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
        first
    }
}
