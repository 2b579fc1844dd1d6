//! Full unrolling of innermost loops whose turns are counted.
//!
//! Where a counter that starts at a constant decides when a loop ends, its turns may stand one
//! after the other: what hangs on the counter alone is a constant then, what hangs on it and on
//! the params is computed once a picture, on the pixel once a pixel, and nothing is counted,
//! compared or carried. Whether that is worth its memory is for the caller to judge.
//! (Muchnick, Advanced compiler design and implementation, 17.4.3.)

use super::induction_tables::counted;
use super::peel::body;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
use crate::passes::rewrite::arena::Arena;
use slowlight_routine::Op;
use std::collections::BTreeMap;

/// How many turns a loop may have, how many nodes these may have together that are computed more
/// than once a picture, and how many in all.
const TURNS: usize = 32;
const NODES: usize = 600;
const ALL: usize = 3000;

/// The graph with such loops unrolled; nothing where it has none.
pub fn unroll(graph: &Graph) -> Option<Graph> {
    let rates = rates(graph);
    let fits = |(of, going): (LoopId, usize)| {
        let body = body(graph, &rates, of);
        let own = [
            Dependence::Frame,
            Dependence::Loop(of),
            Dependence::Last(of),
        ];
        let again = |id: &&NodeId| rates.rate(**id).iter().any(|d| !own.contains(d));
        let times = going + 1;
        let short = going <= TURNS
            && times * body.iter().filter(again).count() <= NODES
            && times * body.len() <= ALL;
        let result = |id: &NodeId| matches!(graph.node(*id), Node::Result { .. });
        let innermost = !body.iter().any(result);
        (short && innermost).then_some((of, Turns { body, going }))
    };
    let loops: BTreeMap<LoopId, Turns> = counted(graph).into_iter().filter_map(fits).collect();
    (!loops.is_empty()).then(|| Unroller::new(graph, loops, rates).done())
}

/// A loop that is unrolled.
struct Turns {
    /// What is computed in each turn, operands first.
    body: Vec<NodeId>,
    /// How many turns go on.
    going: usize,
}

struct Unroller<'g> {
    graph: &'g Graph,
    loops: BTreeMap<LoopId, Turns>,
    rates: Rates,
    out: Arena<'g>,
    /// The new id of each old node; of a loop's body in its last turn.
    moved: Vec<Option<NodeId>>,
    /// Of what stands in a loop's turns.
    claims: Vec<(NodeId, (Op, [NodeId; 2]))>,
}

impl<'g> Unroller<'g> {
    fn new(graph: &'g Graph, loops: BTreeMap<LoopId, Turns>, rates: Rates) -> Unroller<'g> {
        Unroller {
            graph,
            loops,
            rates,
            out: Arena::new(graph),
            moved: vec![None; graph.nodes.len()],
            claims: Vec::new(),
        }
    }

    fn done(mut self) -> Graph {
        for id in self.graph.ids() {
            let inside = |d: &Dependence| match d {
                Dependence::Loop(of) | Dependence::Last(of) => self.loops.contains_key(of),
                _ => false,
            };
            let node = self.graph.node(id);
            if self.moved[id.0 as usize].is_some() || self.rates.rate(id).iter().any(inside) {
                continue;
            }
            match node {
                Node::Result { of, .. } if self.loops.contains_key(&of) => self.turns(of),
                node => self.push(node, id),
            }
        }
        let mut out = self.out.finish(&self.moved);
        out.claims.extend(self.claims);
        out
    }

    fn at(&self, id: NodeId) -> NodeId {
        self.moved[id.0 as usize].unwrap_or(NodeId(0))
    }

    fn push(&mut self, node: Node, id: NodeId) {
        let node = node.with(|a| self.at(a));
        self.moved[id.0 as usize] = Some(self.out.push(node, id));
    }

    /// All turns of a loop, and its results.
    fn turns(&mut self, of: LoopId) {
        let graph = self.graph;
        let turns = &graph.loops[of.0 as usize];
        let Some(Turns { body, going }) = self.loops.remove(&of) else {
            return;
        };
        let mut carried: Vec<NodeId> = turns.init.iter().map(|id| self.at(*id)).collect();
        for _ in 0..going {
            self.turn(&body, &carried);
            carried = turns.next.iter().map(|id| self.at(*id)).collect();
        }
        let ends = going < turns.max as usize;
        let after = |id: &NodeId| self.rates.depends(*id, Dependence::Last(of));
        match ends {
            true => self.turn(&body, &carried),
            false => self.turn(&graph.ids().filter(after).collect::<Vec<_>>(), &carried),
        }
        let results = if ends { &turns.done } else { &turns.otherwise };
        for id in graph.ids() {
            if let Node::Result { of: own, index } = graph.node(id)
                && own == of
            {
                self.moved[id.0 as usize] = results.get(index as usize).map(|id| self.at(*id));
            }
        }
    }

    /// What is computed in a turn, or after the last one, with what is carried.
    fn turn(&mut self, nodes: &[NodeId], carried: &[NodeId]) {
        for &id in nodes {
            match self.graph.node(id) {
                Node::Carried { index, .. } | Node::Last { index, .. } => {
                    self.moved[id.0 as usize] = carried.get(index as usize).copied();
                }
                node => self.push(node, id),
            }
            if let Some((op, args)) = self.graph.claims.get(&id) {
                let args = args.map(|id| self.at(id));
                self.claims.push((self.at(id), (*op, args)));
            }
        }
    }
}
