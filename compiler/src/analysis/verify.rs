//! Graph verifier: whether a graph keeps the rules that every pass relies on.
//!
//! **Invariants**: operands stand before their users; an operation's operands
//! have its argument types; arms of a select have one type; a ramp's first value
//! and its step are ints and the same for the whole row, or the step is a ramp; what is
//! stepped along a run of columns is made of ints, and what is made of the column where
//! a run begins is seen through what is stepped only; a loop's carried
//! values are used only by what decides, continues or ends that loop, and what
//! the last `next` gave only by its `else`; a loop's results stand together, before
//! what uses any of them (they are placed together); the ink is an int; what a pixel
//! sends is real and goes to pixels that the scan has yet to reach, and only a
//! graph that sends something receives.

use crate::analysis::beginnings::of_beginnings;
use crate::analysis::rate::{Rates, rates};
use crate::ir::graph::*;
use crate::ir::ramp;
use rustc_hash::FxHashMap;
use slowlight_routine::Type;

/// A rule that is broken, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{node}: {rule}")]
pub struct Broken {
    /// The node.
    pub node: NodeId,
    /// The rule.
    pub rule: String,
}

/// Checks every node that the outputs reach. Linear in the graph, except for
/// the scopes, which cost a pass over the graph a loop.
pub fn verify(graph: &Graph) -> Result<(), Broken> {
    let reached = graph.reached();
    let live = |id: &NodeId| reached.get(id.0 as usize) == Some(&true);
    for id in graph.ids().filter(live) {
        node(graph, id)?;
    }
    let ramps = |id: &NodeId| matches!(graph.node(*id), Node::Ramp { .. });
    if graph.ids().any(|id| ramps(&id)) {
        let rates = rates(graph);
        for id in graph.ids().filter(live).filter(ramps) {
            stepped(graph, &rates, id)?;
        }
    }
    let begins = of_beginnings(graph);
    if let Some(node) = graph.outputs().find(|id| begins[id.0 as usize]) {
        let rule = "depends on where a run of columns begins".to_owned();
        return Err(Broken { node, rule });
    }
    together(graph, &reached)?;
    for k in 0..graph.loops.len() as u32 {
        scope(graph, LoopId(k), &reached)?;
    }
    for share in graph.shares() {
        let rule = match share {
            _ if graph.ty(share.node) != Type::Real => "is sent to other pixels, and is not real",
            Share { dx, dy, .. } if dy < 0 || (dy == 0 && dx <= 0) => {
                "is sent to a pixel that is already drawn"
            }
            _ => continue,
        };
        return Err(Broken {
            node: share.node,
            rule: rule.to_owned(),
        });
    }
    if let Some(Refinement { step, kept, .. }) = graph.refinement {
        let rule = match step.is_power_of_two() && step > 1 {
            true if graph.ty(kept) == Type::Int => None,
            true => Some("is left to other pixels, and is no int".to_owned()),
            false => Some(format!("is left every {step} rows, which cannot be halved")),
        };
        if let Some(rule) = rule {
            return Err(Broken { node: kept, rule });
        }
    }
    match graph.ty(graph.ink) {
        Type::Int => Ok(()),
        _ => Err(Broken {
            node: graph.ink,
            rule: "the ink is not an int".to_owned(),
        }),
    }
}

fn node(graph: &Graph, id: NodeId) -> Result<(), Broken> {
    let broken = |rule: String| Err(Broken { node: id, rule });
    for operand in graph.references(id) {
        if operand >= id {
            return broken(format!("{operand} does not stand before it"));
        }
    }
    match graph.node(id) {
        Node::Apply(op, args) => {
            for (&want, arg) in op.args().iter().zip(args) {
                if graph.ty(arg) != want {
                    return broken(format!("{} wants {want:?}, {arg} is not", op.name()));
                }
            }
        }
        Node::Select { cond, yes, no } => {
            if graph.ty(cond) != Type::Bool {
                return broken(format!("its condition {cond} is no bool"));
            }
            if graph.ty(yes) != graph.ty(no) {
                return broken(format!("its arms {yes} and {no} differ in type"));
            }
        }
        Node::Lookup { table, .. } => {
            let Some(t) = graph.tables.get(table.0 as usize) else {
                return broken(format!("there is no table {}", table.0));
            };
            if t.entries.len() as u64 != u64::from(t.width) * u64::from(t.height) {
                return broken(format!("table {} is not full", table.0));
            }
        }
        Node::Stepped { first, step } if [first, step].map(|id| graph.ty(id)) != [Type::Int; 2] => {
            return broken(format!("{first} or {step} is no int"));
        }
        Node::Received if graph.diffusion.is_none() => {
            return broken("receives, but no pixel sends".to_owned());
        }
        Node::Neighbour(_) if graph.refinement.is_none() => {
            return broken("has neighbours, but no pixel leaves anything".to_owned());
        }
        Node::Result { of, index } => {
            let found = graph.loops.get(of.0 as usize);
            if found.is_none_or(|l| index as usize >= l.done.len().min(l.otherwise.len())) {
                return broken(format!("loop {} has no result {index}", of.0));
            }
        }
        _ => {}
    }
    Ok(())
}

/// Every loop's results.
fn together(graph: &Graph, reached: &[bool]) -> Result<(), Broken> {
    let mut last: FxHashMap<LoopId, NodeId> = FxHashMap::default();
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        let Node::Result { of, .. } = graph.node(id) else {
            continue;
        };
        let apart = |k: u32| {
            let other = !matches!(graph.node(NodeId(k)), Node::Result { of: l, .. } if l == of);
            other && reached[k as usize]
        };
        let before = last.insert(of, id);
        if before.is_some_and(|before| (before.0 + 1..id.0).any(apart)) {
            return Err(Broken {
                node: id,
                rule: format!("stands apart from the other results of loop {}", of.0),
            });
        }
    }
    Ok(())
}

/// A ramp.
fn stepped(graph: &Graph, rates: &Rates, id: NodeId) -> Result<(), Broken> {
    let broken = |rule: String| Err(Broken { node: id, rule });
    let all = ramp::coefficients(graph, id);
    if all.len() > ramp::DEGREE + 1 {
        return broken("too many ramps step each other".to_owned());
    }
    for part in all {
        if graph.ty(part) != Type::Int {
            return broken(format!("steps by {part}, which is no int"));
        }
        if !rates.is_still(part) {
            return broken(format!("steps by {part}, which is not the same for a pass"));
        }
    }
    Ok(())
}

/// Marks what depends on a loop's `Carried` or `Last` and does not pass
/// through its results; the outputs and other loops' ends must not.
fn scope(graph: &Graph, of: LoopId, reached: &[bool]) -> Result<(), Broken> {
    #[derive(Clone, Copy, PartialEq)]
    enum In {
        Outside,
        Body,
        Else,
    }
    let mut state = vec![In::Outside; graph.nodes.len()];
    for id in graph.ids() {
        let at = id.0 as usize;
        if !reached[at] {
            continue;
        }
        let mut here = match graph.node(id) {
            Node::Carried { of: l, .. } if l == of => In::Body,
            Node::Last { of: l, .. } if l == of => In::Else,
            Node::Result { of: l, .. } if l == of => In::Outside,
            _ => {
                let mut here = In::Outside;
                for operand in graph.references(id) {
                    match (here, state[operand.0 as usize]) {
                        (_, In::Outside) => {}
                        (In::Outside, s) => here = s,
                        (h, s) if h == s => {}
                        _ => {
                            let rule = "mixes a loop's body with its else".to_owned();
                            return Err(Broken { node: id, rule });
                        }
                    }
                }
                here
            }
        };
        std::mem::swap(&mut state[at], &mut here);
    }
    let Some(l) = graph.loops.get(of.0 as usize) else {
        return Ok(());
    };
    let body = l.next.iter().chain(&l.done).chain([&l.again]);
    let leaks = (l
        .otherwise
        .iter()
        .filter(|n| state[n.0 as usize] == In::Body))
    .chain(body.filter(|n| state[n.0 as usize] == In::Else))
    .chain(l.init.iter().filter(|n| state[n.0 as usize] != In::Outside))
    .copied()
    .chain(
        graph
            .outputs()
            .filter(|n| state[n.0 as usize] != In::Outside),
    );
    match leaks.into_iter().next() {
        Some(node) => Err(Broken {
            node,
            rule: format!("leaves the scope of loop {}", of.0),
        }),
        None => Ok(()),
    }
}
