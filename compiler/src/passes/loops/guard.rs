//! Loop guards: what hardly any pixel's loop goes on for is decided before the loop.
//!
//! What a loop's first turn decides needs what the loop starts with, of which
//! more is known before the loop than in its body, which serves every turn: that
//! a ray starts on a sphere, say, and which one. So a part of the condition to go
//! on, without which no turn does, is copied before the loop and has the starting
//! values in it. Where it fails the first turn need not ask at all: the loop
//! carries a bool that says so, and is false from the second turn on.

use super::peel::{alone, before, body, cone};
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
use crate::passes::rewrite::arena::Arena;
use rustc_hash::FxHashMap;
use slowlight_routine::{Type, Value};

/// The graph with a loop behind a guard of at most so many conditions; nothing where
/// the loop stands in another or has one in its body, or where its body has more than
/// `most` nodes.
pub fn guard(graph: &Graph, of: LoopId, conditions: usize, most: usize) -> Option<Graph> {
    let turns = graph.loops.get(of.0 as usize)?;
    let rates = rates(graph);
    let body = body(graph, &rates, of);
    let fits = body.len() <= most
        && alone(graph, &rates, of, &body)
        && rates.depends(turns.again, Dependence::Loop(of));
    fits.then(|| guarded(graph, of, conditions, &rates, &body))
}

/// Values without which a loop's turn does not go on, the first asked first, and
/// whether each must hold: `most` at most.
fn needed(graph: &Graph, again: NodeId, most: usize) -> Vec<(NodeId, bool)> {
    let never = |id| graph.constant(id) == Some(Value::Bool(false));
    let (mut all, mut rest) = (Vec::new(), again);
    while all.len() < most {
        let (cond, next) = match graph.node(rest) {
            Node::Select { cond, yes, no } if never(no) => ((cond, true), yes),
            Node::Select { cond, yes, no } if never(yes) => ((cond, false), no),
            _ => break,
        };
        all.push(cond);
        rest = next;
    }
    if all.is_empty() {
        all.push((again, true));
    }
    all
}

fn guarded(graph: &Graph, of: LoopId, conditions: usize, rates: &Rates, body: &[NodeId]) -> Graph {
    let turns = &graph.loops[of.0 as usize];
    let mut out = Arena::new(graph);
    let mut moved = vec![None; graph.nodes.len()];
    let keep = |out: &mut Arena<'_>, moved: &mut Vec<Option<NodeId>>, id: NodeId| {
        if moved[id.0 as usize].is_none() {
            let at = |a: NodeId| moved[a.0 as usize].unwrap_or(NodeId(0));
            let node = graph.node(id).with(at);
            moved[id.0 as usize] = Some(out.push(node, id));
        }
    };
    for id in before(graph, rates, of) {
        keep(&mut out, &mut moved, id);
    }
    let needed = needed(graph, turns.again, conditions);
    let (fails, never) = asked_first(&mut out, &moved, of, needed, body);
    let index = turns.init.len() as u32;
    let failed = out.push(Node::Carried { of, index }, turns.again);
    for id in body {
        keep(&mut out, &mut moved, *id);
    }
    let again = Node::Select {
        cond: failed,
        yes: never,
        no: moved[turns.again.0 as usize].unwrap_or(never),
    };
    let again = out.push(again, turns.again);
    for id in graph.ids() {
        keep(&mut out, &mut moved, id);
    }
    let mut out = out.finish(&moved);
    let turns = &mut out.loops[of.0 as usize];
    turns.names.push("ends".to_owned());
    turns.types.push(Type::Bool);
    turns.init.push(fails);
    turns.next.push(never);
    turns.again = again;
    out
}

/// Copies what is needed to go on, the starting values in it: whether any of it
/// fails, the first asked first, and the bool that never holds.
fn asked_first(
    out: &mut Arena<'_>,
    moved: &[Option<NodeId>],
    of: LoopId,
    needed: Vec<(NodeId, bool)>,
    body: &[NodeId],
) -> (NodeId, NodeId) {
    let graph = out.graph;
    let turns = &graph.loops[of.0 as usize];
    let at = |id: NodeId| moved[id.0 as usize].unwrap_or(NodeId(0));
    let roots: Vec<NodeId> = needed.iter().map(|(cond, _)| *cond).collect();
    let mut first: FxHashMap<NodeId, NodeId> = FxHashMap::default();
    for id in cone(graph, &roots, body) {
        let made = match graph.node(id) {
            Node::Carried { of: l, index } if l == of => {
                turns.init.get(index as usize).map_or(NodeId(0), |i| at(*i))
            }
            node => {
                let node = node.with(|a| first.get(&a).copied().unwrap_or_else(|| at(a)));
                out.push_taken(node, id)
            }
        };
        first.insert(id, made);
    }
    let [never, ever] = [false, true].map(|t| {
        let node = Node::Const(Constant::new(Value::Bool(t)));
        out.push(node, turns.again)
    });
    let mut fails = never;
    for (cond, holds) in needed.into_iter().rev() {
        let cond = first.get(&cond).copied().unwrap_or_else(|| at(cond));
        let (yes, no) = if holds { (fails, ever) } else { (ever, fails) };
        fails = out.push(Node::Select { cond, yes, no }, turns.again);
    }
    (fails, never)
}
