//! Initial abstract state: what is known of values before anything is computed, and which of them
//! several calls share.

use super::Slack;
use crate::ir::graph::*;
use crate::ir::refinement::LEVELS;
use crate::ir::tree::*;
use slowlight_routine::{Op, Range, Type};

/// What is known of a value that needs no computing.
pub(super) fn known(graph: &Graph, slack: &Slack, id: NodeId) -> Range {
    let plain = slack.points.as_ref().filter(|_| graph.ty(id) == Type::Real);
    match graph.node(id) {
        // A constant is rounded where it is read.
        Node::Const(c) if plain.is_some() => Range::point(c.value().real()),
        Node::Param(p) if let Some(points) = plain => {
            let param = graph.params.get(p.0 as usize);
            let range = param.and_then(|p| p.range).unwrap_or(Range::ALL);
            points.rounded(id, range, 1.0)
        }
        // Nobody looks at it.
        Node::Undefined(ty) if ty != Type::Bool => Range::point(0.0),
        _ if let Some(points) = plain => points.rounded(id, Range::ALL, 0.0),
        Node::Const(c) => {
            let held = slack.constant(c.value());
            slack.expected(id, held)
        }
        Node::Param(p) => {
            let range = graph
                .params
                .get(p.0 as usize)
                .and_then(|p| p.range)
                .unwrap_or(Range::ALL);
            let held = slack.cut(graph.ty(id), slack.enlarge(Op::Mul, &[], range));
            slack.expected(id, held)
        }
        Node::Axis(Axis::X | Axis::Run) => {
            Range::new(0.0, f64::from(graph.image.width.saturating_sub(1)))
        }
        Node::Axis(Axis::Pass(n)) => Range::new(0.0, f64::from(n.saturating_sub(1))),
        Node::Axis(Axis::Y) => Range::new(0.0, f64::from(graph.image.height.saturating_sub(1))),
        Node::Neighbour(_) => Range::new(0.0, f64::from(LEVELS)),
        _ => slack.cut(graph.ty(id), Range::ALL),
    }
}

/// Nodes that belong to subroutines, none of them written yet.
pub(crate) fn shared(graph: &Graph, tree: &Tree) -> Vec<Option<bool>> {
    let mut shared: Vec<Option<bool>> = (graph.nodes.iter())
        .map(|node| matches!(node, Node::Slot(_)).then_some(false))
        .collect();
    let mut loops = vec![false; graph.loops.len()];
    for subroutine in &tree.subroutines {
        walk(&subroutine.body, &mut |statement| match statement {
            Statement::Let(id)
            | Statement::Set {
                place: Place::Node(id),
                ..
            } => shared[id.0 as usize] = Some(false),
            Statement::Loop(turns) => loops[turns.of.0 as usize] = true,
            _ => {}
        });
    }
    for id in graph.ids() {
        if let Node::Carried { of, .. } | Node::Last { of, .. } = graph.node(id)
            && loops.get(of.0 as usize) == Some(&true)
        {
            shared[id.0 as usize] = Some(false);
        }
    }
    shared
}
