//! Squares: a comparison with a table whose squares are there already is made
//! with those, so that one table serves.
//!
//! What is no negative is less than a number exactly where its square is less
//! than the number's square with its sign, a|a|.

use super::rebuild::rebuild_old;
use crate::flow::graph::*;
use crate::range::Ranges;
use slowlight_routine::Op;

/// The graph with such comparisons; nothing where there are none.
pub fn squares(graph: &Graph, ranges: &Ranges) -> Option<Graph> {
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let Node::Apply(Op::Less, sides) = graph.node(id) else {
            return None;
        };
        let lookup = |k: &usize| matches!(graph.node(sides[*k]), Node::Lookup { .. });
        let at = [1, 0].into_iter().find(lookup)?;
        let (value, entry) = (sides[1 - at], sides[at]);
        let Node::Lookup { table, column, row } = graph.node(entry) else {
            return None;
        };
        let range = ranges.result.get(value.0 as usize)?;
        // Squares of what is large or tiny would leave a format.
        if range.lo < 0.0 || range.hi > 1000.0 {
            return None;
        }
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let squared = builder.table(squared(graph, table)?.clone());
        let (value, column, row) = (new(value)?, new(column)?, new(row)?);
        let square = builder.apply(Op::Mul, &[value, value], span);
        let entry = builder.lookup(squared, column, row, span);
        done = true;
        let mut sides = [square; 2];
        sides[at] = entry;
        Some(builder.apply(Op::Less, &sides, span))
    });
    done.then_some(next)
}

/// The table of a table's squares, signs kept.
fn squared(graph: &Graph, of: TableId) -> Option<&Table> {
    let table = graph.tables.get(of.0 as usize)?;
    let near = |a: &Constant, b: &Constant| {
        let (a, b) = (a.value().real(), b.value().real());
        let a = a * a.abs();
        (a - b).abs() <= 4.0 * f64::EPSILON * a.abs()
    };
    graph.tables.iter().find(|other| {
        let shape = |t: &Table| (t.width, t.height, t.ty);
        let mut pairs = table.entries.iter().zip(&other.entries);
        !std::ptr::eq(*other, table)
            && shape(other) == shape(table)
            && pairs.all(|(a, b)| near(a, b))
    })
}
