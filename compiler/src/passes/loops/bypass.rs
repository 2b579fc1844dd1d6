//! Zero-trip bypass: a loop that ends in its first turn is not started.
//!
//! A loop behind a guard ([`super::guard`]) carries a bool that says whether its
//! first turn ends it, which is known before the loop; and what is done with its
//! values where it ends may stand in it, as one of its results. Here, behind the
//! passes that rewrite formulas, the loop only gives its values, and where the
//! bool holds it is left out: then they are what it would start with. So what few
//! pixels look at of those is computed for them alone ([`crate::passes::rematerialise`]), rather
//! than for the loop's start by all.

use super::peel::{alone, before, body, cone};
use crate::analysis::rate::{Dependence, rates};
use crate::ir::graph::*;
use crate::passes::rewrite::arena::Arena;
use slowlight_routine::Value;

/// The graph with no loop started that its first turn is known to end; nothing
/// where there is none.
pub fn skip(graph: &Graph) -> Option<Graph> {
    let loops = (0..graph.loops.len() as u32).map(LoopId);
    let found = loops.filter_map(|of| Some((of, ends(graph, of)?)));
    found
        .into_iter()
        .find_map(|(of, ends)| Surgery::new(graph, of)?.done(ends))
}

/// The carried bool that ends a loop in its first turn or never.
fn ends(graph: &Graph, of: LoopId) -> Option<u32> {
    let turns = graph.loops.get(of.0 as usize)?;
    let never = |id| graph.constant(id) == Some(Value::Bool(false));
    let Node::Select { cond, yes, .. } = graph.node(turns.again) else {
        return None;
    };
    let Node::Carried { of: l, index } = graph.node(cond) else {
        return None;
    };
    let next = *turns.next.get(index as usize)?;
    (l == of && never(yes) && never(next)).then_some(index)
}

struct Surgery<'g> {
    graph: &'g Graph,
    of: LoopId,
    out: Arena<'g>,
    /// What the turns compute, operands first.
    body: Vec<NodeId>,
    /// What of that the turns need for themselves.
    own: Vec<NodeId>,
    /// What of that the results are made of, and those of it that the loop gives.
    wanted: Vec<NodeId>,
    given: Vec<NodeId>,
    /// The new id of each old node.
    moved: Vec<Option<NodeId>>,
    /// The new id of each old node as it is in the first turn.
    first: Vec<Option<NodeId>>,
    /// The new id of each old node of a turn as it is behind the loop.
    behind: Vec<Option<NodeId>>,
}

impl<'g> Surgery<'g> {
    /// Nothing where another loop stands in this one or around it, or where what
    /// its last turn gives is more than what is known before it.
    fn new(graph: &'g Graph, of: LoopId) -> Option<Surgery<'g>> {
        let rates = rates(graph);
        let body = body(graph, &rates, of);
        let turns = &graph.loops[of.0 as usize];
        let last = |id: &NodeId| rates.depends(*id, Dependence::Last(of));
        if !alone(graph, &rates, of, &body) || turns.otherwise.iter().any(last) {
            return None;
        }
        let mut roots = vec![turns.again];
        roots.extend(&turns.next);
        let own = cone(graph, &roots, &body);
        let wanted = cone(graph, &turns.done, &body);
        let given = given(graph, of, &own, &wanted);
        let mut made = Surgery {
            graph,
            of,
            out: Arena::new(graph),
            body,
            own,
            wanted,
            given,
            moved: vec![None; graph.nodes.len()],
            first: vec![None; graph.nodes.len()],
            behind: vec![None; graph.nodes.len()],
        };
        let before = before(graph, &rates, of);
        before.into_iter().for_each(|id| made.keep(id));
        Some(made)
    }

    fn turns(&self) -> &'g Loop {
        &self.graph.loops[self.of.0 as usize]
    }

    fn at(&self, id: NodeId) -> NodeId {
        self.moved[id.0 as usize].unwrap_or(NodeId(0))
    }

    fn keep(&mut self, id: NodeId) {
        if self.moved[id.0 as usize].is_none() {
            let node = self.graph.node(id).with(|a| self.at(a));
            self.moved[id.0 as usize] = Some(self.out.push(node, id));
        }
    }

    fn bool(&mut self, value: bool) -> NodeId {
        let node = Node::Const(Constant::new(Value::Bool(value)));
        self.out.push(node, self.turns().again)
    }

    /// The graph, the carried bool `ends` asked before the loop.
    fn done(mut self, ends: u32) -> Option<Graph> {
        let (graph, turns) = (self.graph, self.turns());
        let Node::Select { no: again, .. } = graph.node(turns.again) else {
            return None;
        };
        let skipped = self.at(*turns.init.get(ends as usize)?);
        let [never, ever] = [false, true].map(|value| self.bool(value));
        self.first_turn();
        for id in self.body.clone() {
            match carried(graph, self.of, id) {
                // In the turns that are left it does not hold.
                Some(index) if index == ends => self.moved[id.0 as usize] = Some(never),
                Some(_) => self.keep(id),
                None if self.own.binary_search(&id).is_ok() => self.keep(id),
                None => {}
            }
        }
        let given = self.given.clone();
        let mut otherwise: Vec<NodeId> = given.iter().map(|id| self.last(*id)).collect();
        otherwise.push(ever);
        let exhausted = self.results(skipped, never);
        for id in self.wanted.clone() {
            if self.behind[id.0 as usize].is_none() && self.own.binary_search(&id).is_err() {
                let node = graph.node(id).with(|a| self.behind(a));
                self.behind[id.0 as usize] = Some(self.out.push(node, id));
            }
        }
        self.rest(exhausted);
        let again = self.at(again);
        let mut done: Vec<NodeId> = given.iter().map(|id| self.at(*id)).collect();
        done.push(never);
        let mut out = self.out.finish(&self.moved);
        let turns = &mut out.loops[self.of.0 as usize];
        (turns.again, turns.done, turns.otherwise) = (again, done, otherwise);
        Some(out)
    }

    /// Copies what the loop gives as it is in the first turn.
    fn first_turn(&mut self) {
        for id in cone(self.graph, &self.given, &self.body) {
            let made = match carried(self.graph, self.of, id) {
                Some(index) => {
                    let init = self.turns().init.get(index as usize);
                    init.map_or(NodeId(0), |init| self.at(*init))
                }
                None => {
                    let at = |a: NodeId| self.first[a.0 as usize].unwrap_or(self.at(a));
                    let node = self.graph.node(id).with(at);
                    self.out.push(node, id)
                }
            };
            self.first[id.0 as usize] = Some(made);
        }
    }

    /// Appends the loop's results, which stand together, and what chooses between
    /// them and the first turn's; answers the bool that the loop ran all its turns.
    fn results(&mut self, skipped: NodeId, never: NodeId) -> NodeId {
        let (of, graph) = (self.of, self.graph);
        let count = self.given.len() as u32;
        let result = |index| Node::Result { of, index };
        let given = self.given.clone();
        let made: Vec<NodeId> = (given.iter().enumerate())
            .map(|(k, id)| self.out.push(result(k as u32), *id))
            .collect();
        let ran = self.out.push(result(count), self.turns().again);
        for (id, no) in given.into_iter().zip(made) {
            let yes = self.first[id.0 as usize].unwrap_or(no);
            let choice = Node::Select {
                cond: skipped,
                yes,
                no,
            };
            self.behind[id.0 as usize] = Some(self.out.push(choice, id));
        }
        let choice = Node::Select {
            cond: skipped,
            yes: never,
            no: ran,
        };
        self.out.push(choice, graph.loops[of.0 as usize].again)
    }

    /// A value that the loop gives where its last turn went on.
    fn last(&mut self, id: NodeId) -> NodeId {
        let node = match carried(self.graph, self.of, id) {
            Some(index) => Node::Last { of: self.of, index },
            None => Node::Undefined(self.graph.ty(id)),
        };
        self.out.push(node, id)
    }

    fn behind(&self, id: NodeId) -> NodeId {
        self.behind[id.0 as usize].unwrap_or(self.at(id))
    }

    /// Everything behind the loop.
    fn rest(&mut self, exhausted: NodeId) {
        let (graph, turns) = (self.graph, self.turns());
        for id in graph.ids() {
            match graph.node(id) {
                Node::Result { of, index } if of == self.of => {
                    let part = |all: &[NodeId]| all.get(index as usize).copied().unwrap_or(id);
                    let choice = Node::Select {
                        cond: exhausted,
                        yes: self.at(part(&turns.otherwise)),
                        no: self.behind(part(&turns.done)),
                    };
                    self.moved[id.0 as usize] = Some(self.out.push(choice, id));
                }
                _ if self.body.binary_search(&id).is_err() => self.keep(id),
                _ => {}
            }
        }
    }
}

/// Which of a loop's carried values a node is.
fn carried(graph: &Graph, of: LoopId, id: NodeId) -> Option<u32> {
    match graph.node(id) {
        Node::Carried { of: l, index } if l == of => Some(index),
        _ => None,
    }
}

/// What the loop must give so that the rest of what is wanted can be computed
/// behind it: carried values, and what its turns need, too.
fn given(graph: &Graph, of: LoopId, own: &[NodeId], wanted: &[NodeId]) -> Vec<NodeId> {
    let mut used: Vec<NodeId> = graph.loops[of.0 as usize].done.clone();
    for id in wanted.iter().filter(|id| own.binary_search(id).is_err()) {
        used.extend(graph.node(*id).operands());
    }
    let fits = |id: &&NodeId| {
        let ours = own.binary_search(id).is_ok() || carried(graph, of, **id).is_some();
        ours && used.contains(id)
    };
    wanted.iter().filter(fits).copied().collect()
}
