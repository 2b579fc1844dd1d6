//! Claims of how often a value changes, held against the graph.
//!
//! `row let` says that a value depends on y alone, `column let` on x alone,
//! `frame let` on neither. What a value really depends on is the union over
//! its operands; through a loop, over everything that the loop refers to.

use crate::ir::graph::*;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree::Claim;

const X: u8 = 1;
const Y: u8 = 2;

/// A `let` with a claim.
pub(super) struct Claimed {
    pub(super) claim: Claim,
    pub(super) name: String,
    /// From the claim to the end of the value.
    pub(super) span: Span,
    pub(super) nodes: Vec<NodeId>,
}

/// What each node refers to: loops' starts and steps for what they carry.
fn references(graph: &Graph, id: NodeId) -> Vec<NodeId> {
    match graph.node(id) {
        Node::Carried { of, index } | Node::Last { of, index } => {
            let found = graph.loops.get(of.0 as usize);
            found.map_or(Vec::new(), |l| {
                let lists = [l.init.get(index as usize), l.next.get(index as usize)];
                let mut all: Vec<NodeId> = lists.into_iter().flatten().copied().collect();
                // Which turn it is depends on what ends the loop.
                all.push(l.again);
                all
            })
        }
        _ => graph.references(id),
    }
}

/// The axes that each node depends on. Loops refer back, so it goes round
/// until nothing changes: at most a few times, the sets only grow.
fn axes(graph: &Graph) -> Vec<u8> {
    let mut found = vec![0u8; graph.nodes.len()];
    loop {
        let mut changed = false;
        for id in graph.ids() {
            let mut set = match graph.node(id) {
                Node::Axis(Axis::X) => X,
                Node::Axis(Axis::Y) => Y,
                Node::Received | Node::Neighbour(_) => X | Y,
                _ => 0,
            };
            for operand in references(graph, id) {
                set |= found.get(operand.0 as usize).copied().unwrap_or(0);
            }
            if let Some(old) = found.get_mut(id.0 as usize)
                && *old != set
            {
                *old = set;
                changed = true;
            }
        }
        if !changed || graph.loops.is_empty() {
            return found;
        }
    }
}

/// The claims that are not true.
pub(super) fn check(graph: &Graph, claims: &[Claimed]) -> Vec<Diagnostic> {
    if claims.is_empty() {
        return Vec::new();
    }
    let axes = axes(graph);
    let mut said = Vec::new();
    for claim in claims {
        let (allowed, how) = match claim.claim {
            Claim::Frame => (0, "once a frame"),
            Claim::Row => (Y, "by row"),
            Claim::Column => (X, "by column"),
        };
        for (axis, letter) in [(X, "x"), (Y, "y")] {
            if allowed & axis != 0 {
                continue;
            }
            let of = |id: &&NodeId| axes.get(id.0 as usize).is_some_and(|a| a & axis != 0);
            if let Some(&node) = claim.nodes.iter().find(of) {
                said.push(wrong(graph, &axes, claim, node, axis, letter, how));
                break;
            }
        }
    }
    said
}

fn wrong(
    graph: &Graph,
    axes: &[u8],
    claim: &Claimed,
    node: NodeId,
    axis: u8,
    letter: &str,
    how: &str,
) -> Diagnostic {
    let message = format!(
        "`{}` is said to change {how}, but depends on `{letter}`",
        claim.name
    );
    let mut error = Diagnostic::error(claim.span, message);
    let path = path(graph, axes, node, axis);
    let mut shown: Vec<Span> = vec![claim.span];
    for id in path.iter().rev().skip(1) {
        let span = graph.span(*id);
        let name = graph.names.get(id);
        let itself = shown.len() > 1 && name.is_some_and(|name| **name == *claim.name);
        if !shown.contains(&span) && shown.len() < 4 && !itself {
            shown.push(span);
            let text = match name {
                _ if shown.len() == 2 => format!("`{letter}` comes in here"),
                Some(name) => format!("through `{name}`"),
                None => "through this".to_owned(),
            };
            error = error.also(span, text);
        }
    }
    error.help("leave the claim out: the compiler finds out by itself how often a value changes")
}

/// A shortest way from a node to the axis.
fn path(graph: &Graph, axes: &[u8], from: NodeId, axis: u8) -> Vec<NodeId> {
    let mut before: Vec<Option<NodeId>> = vec![None; graph.nodes.len()];
    let mut queue = std::collections::VecDeque::from([from]);
    while let Some(id) = queue.pop_front() {
        let found = match graph.node(id) {
            Node::Axis(a) => (a == Axis::X) == (axis == X),
            node => matches!(node, Node::Received | Node::Neighbour(_)),
        };
        if found {
            let mut path = vec![id];
            let mut at = id;
            while at != from {
                match before.get(at.0 as usize).copied().flatten() {
                    Some(previous) => at = previous,
                    None => break,
                }
                path.push(at);
            }
            path.reverse();
            return path;
        }
        for operand in references(graph, id) {
            let slot = operand.0 as usize;
            let on_way = axes.get(slot).is_some_and(|a| a & axis != 0);
            if on_way && operand != from && before.get(slot).is_some_and(Option::is_none) {
                before[slot] = Some(id);
                queue.push_back(operand);
            }
        }
    }
    vec![from]
}
