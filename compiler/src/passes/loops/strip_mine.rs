//! Strip-mining of rows: a row drawn in passes, each over every nth column.
//!
//! An ordered dither has a matrix entry for the column modulo its width, so with
//! n such columns everything that depends on the column through that remainder
//! alone is the same for a whole pass over every nth column: the entry, the
//! thresholds made from it, and where along the row a shade crosses them. In the
//! graph the remainder is an axis of its own ([`Axis::Pass`]); what depends on it
//! and not on the column is computed once a pass.

use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild;
use slowlight_routine::{Op, Value};

/// How many passes a row may have: each has a cost of its own.
const MOST: u32 = 16;

/// How many passes a graph's rows are drawn in; 1 where all columns are drawn in order.
pub fn passes(graph: &Graph) -> u32 {
    let pass = |node: &Node| match node {
        Node::Axis(Axis::Pass(passes)) => Some((*passes).max(1)),
        _ => None,
    };
    graph.nodes.iter().find_map(pass).unwrap_or(1)
}

/// The graph with remainders of the column as passes, a whole number of times
/// `multiple`; nothing where it has none, or such that would take too many.
/// Pixels that send something to others are drawn in order.
pub fn strip_mined(graph: &Graph, multiple: u32) -> Option<Graph> {
    // What is stepped already is stepped from each column to the next.
    let stepped = graph
        .nodes
        .iter()
        .any(|node| matches!(node, Node::Ramp { .. }));
    let reports = !graph.reports.is_empty() && !graph.is_moving();
    if graph.is_in_order() || reports || stepped {
        return None;
    }
    let reached = graph.reached();
    let ids = graph.ids().filter(|id| reached[id.0 as usize]);
    let moduli: Vec<u32> = ids.filter_map(|id| modulus(graph, id)).collect();
    if moduli.is_empty() {
        return None;
    }
    let count = moduli.into_iter().chain([multiple.max(1)]);
    let count = count.fold(1, |all, n| all / gcd(all, n) * n);
    if !(2..=MOST).contains(&count) || count * 4 > graph.image.width {
        return None;
    }
    Some(rebuild(graph, &mut |b, id, _, span| {
        let of = modulus(graph, id)?;
        let pass = b.axis(Axis::Pass(count), span);
        if of == count {
            return Some(pass);
        }
        let of = b.constant(Value::Int(of as i32), span);
        Some(b.apply(Op::IntMod, &[pass, of], span))
    }))
}

/// What a node is the remainder of the column by, if it is that.
fn modulus(graph: &Graph, id: NodeId) -> Option<u32> {
    let Node::Apply(op, [column, by]) = graph.node(id) else {
        return None;
    };
    if graph.node(column) != Node::Axis(Axis::X) {
        return None;
    }
    let by = match graph.constant(by)? {
        Value::Int(n) => u32::try_from(n).ok()?,
        _ => return None,
    };
    let found = match op {
        Op::IntMod => by,
        // Columns are not negative.
        Op::BitAnd if (by + 1).is_power_of_two() => by + 1,
        _ => return None,
    };
    (2..=MOST).contains(&found).then_some(found)
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
