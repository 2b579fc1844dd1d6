//! Scalar expansion along the column: what hangs on the column alone is computed once a column,
//! before the first row, and kept in an array ([`Node::Tabulated`]).
//!
//! Rows are drawn one after the other, so a value that changes with the column only would
//! be computed again in each of them: the walls of a maze seen from inside, say, one ray a
//! column. Here such values that others use become entries of an array; what they are made
//! of, loops included, belongs to the column's own block.
//!
//! What the pixel needs as well stands twice, in nodes that are alike: no pass may rebuild
//! the graph by equal nodes after this one, as with [`crate::passes::rematerialise`]. Loops do not: where
//! anything of such a loop is wanted by pixels, it is tabulated.

use crate::analysis::needed::needed;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
use crate::passes::rewrite::arena::Arena;
use std::collections::BTreeSet;

/// The values that hang on the column alone and that others use: all, and those of them
/// that must be tabulated if any is, since loops make them.
pub struct Columns {
    pub all: Vec<NodeId>,
    pub made_in_loops: BTreeSet<NodeId>,
}

/// The values that could be tabulated; none where there are none that take computing.
pub fn columns(graph: &Graph) -> Option<Columns> {
    let world = World::of(graph);
    let needed = needed(graph);
    let mut used = BTreeSet::new();
    for id in graph.ids().filter(|id| needed[id.0 as usize]) {
        if !world.is_column(id) {
            used.extend(graph.node(id).operands());
        }
    }
    for (of, turns) in graph.loops.iter().enumerate() {
        if !world.loops[of] {
            used.extend(turns.roots());
        }
    }
    used.extend(graph.outputs());
    let all: Vec<NodeId> = (used.into_iter())
        .filter(|id| needed[id.0 as usize] && world.is_value(graph, *id))
        .collect();
    let made_in_loops = (graph.ids())
        .filter(|id| needed[id.0 as usize] && world.is_value(graph, *id))
        .filter(|id| matches!(graph.node(*id), Node::Result { .. }))
        .collect();
    (!all.is_empty()).then_some(Columns { all, made_in_loops })
}

/// The graph with some of these tabulated.
pub fn tabulated(graph: &Graph, columns: &Columns, chosen: &BTreeSet<NodeId>) -> Graph {
    let world = World::of(graph);
    let kept = |id: NodeId| chosen.contains(&id) || columns.made_in_loops.contains(&id);
    let wanted = Wanted::of(graph, &world, &kept);
    let mut out = Arena::new(graph);
    let none = || vec![None; graph.nodes.len()];
    let (mut by_column, mut by_pixel): (Vec<Option<NodeId>>, Vec<Option<NodeId>>) =
        (none(), none());
    // Results of a loop stand together, so what is read of them stands behind the last.
    let mut behind = Vec::new();
    for id in graph.ids() {
        let at = id.0 as usize;
        let node = graph.node(id);
        let together = |first: &NodeId| made_by(graph, *first) == made_by(graph, id);
        if !behind.first().is_some_and(together) {
            entries(&mut behind, &by_column, &mut by_pixel, &mut out);
        }
        if !world.is_column(id) {
            let made = out.push(among(node, &by_pixel), id);
            (by_column[at], by_pixel[at]) = (Some(made), Some(made));
            continue;
        }
        if wanted.column[at] {
            by_column[at] = Some(out.push(among(node, &by_column), id));
        }
        if wanted.pixel[at] && kept(id) {
            behind.push(id);
            if made_by(graph, id).is_none() {
                entries(&mut behind, &by_column, &mut by_pixel, &mut out);
            }
        } else if wanted.pixel[at] {
            by_pixel[at] = Some(out.push(among(node, &by_pixel), id));
        }
    }
    entries(&mut behind, &by_column, &mut by_pixel, &mut out);
    let moved: Vec<Option<NodeId>> = (by_pixel.iter().zip(&by_column))
        .map(|(pixel, column)| pixel.or(*column))
        .collect();
    let mut out = out.finish(&moved);
    let at = |id: NodeId| by_column[id.0 as usize].unwrap_or(NodeId(0));
    for (of, turns) in graph
        .loops
        .iter()
        .enumerate()
        .filter(|(of, _)| world.loops[*of])
    {
        let lists = |turns: &Loop| {
            [&turns.init, &turns.next, &turns.done, &turns.otherwise]
                .map(|list| list.iter().map(|id| at(*id)).collect())
        };
        let made = &mut out.loops[of];
        [made.init, made.next, made.done, made.otherwise] = lists(turns);
        made.again = at(turns.again);
    }
    out
}

/// The loop that a node is a result of.
fn made_by(graph: &Graph, id: NodeId) -> Option<LoopId> {
    match graph.node(id) {
        Node::Result { of, .. } => Some(of),
        _ => None,
    }
}

/// Reads some values' entries from here on.
fn entries(
    some: &mut Vec<NodeId>,
    by_column: &[Option<NodeId>],
    by_pixel: &mut [Option<NodeId>],
    out: &mut Arena<'_>,
) {
    for id in some.drain(..) {
        let value = by_column[id.0 as usize].unwrap_or(NodeId(0));
        by_pixel[id.0 as usize] = Some(out.push(Node::Tabulated(value), id));
    }
}

/// A node with those of some that stand for its operands.
fn among(node: Node, all: &[Option<NodeId>]) -> Node {
    node.with(|used| all[used.0 as usize].unwrap_or(NodeId(0)))
}

/// What is computed by column alone.
struct World {
    rates: Rates,
    /// For each node whether it is computed by nothing that belongs to pixels.
    plain: Vec<bool>,
    /// For each loop whether all of it hangs on the column and the params.
    loops: Vec<bool>,
}

impl World {
    fn of(graph: &Graph) -> World {
        let rates = rates(graph);
        let mut world = World {
            plain: vec![false; graph.nodes.len()],
            loops: vec![false; graph.loops.len()],
            rates,
        };
        for id in graph.ids() {
            world.plain[id.0 as usize] = match graph.node(id) {
                Node::Axis(axis) => axis == Axis::X,
                Node::Ramp { .. } | Node::Stepped { .. } | Node::Tabulated(_) => false,
                Node::Received | Node::Neighbour(_) | Node::Slot(_) => false,
                Node::Result { of, .. } => {
                    let mut roots = graph.loops[of.0 as usize].roots();
                    roots.all(|root| world.plain[root.0 as usize])
                }
                node => node.operands().all(|used| world.plain[used.0 as usize]),
            };
        }
        // A loop in such a loop is one, too.
        while let Some(of) = graph.ids().find_map(|id| world.found(graph, id)) {
            world.loops[of.0 as usize] = true;
        }
        world
    }

    /// The loop of a result that belongs to the columns, if that is not known yet.
    fn found(&self, graph: &Graph, id: NodeId) -> Option<LoopId> {
        match graph.node(id) {
            Node::Result { of, .. } if !self.loops[of.0 as usize] && self.is_column(id) => Some(of),
            _ => None,
        }
    }

    /// Whether a node belongs to the columns: it hangs on the column, or stands in a loop
    /// that does.
    fn is_column(&self, id: NodeId) -> bool {
        let rate = self.rates.rate(id);
        let own = |d: &Dependence| match d {
            Dependence::Frame | Dependence::Column => true,
            Dependence::Loop(of) | Dependence::Last(of) => self.loops[of.0 as usize],
            Dependence::Row | Dependence::Pass => false,
        };
        let moves = |d: &Dependence| *d != Dependence::Frame;
        self.plain[id.0 as usize] && rate.iter().all(own) && rate.iter().any(moves)
    }

    /// Whether a node is a value of the column that takes computing.
    fn is_value(&self, graph: &Graph, id: NodeId) -> bool {
        let rate = self.rates.rate(id);
        let outside = |d: &Dependence| matches!(d, Dependence::Frame | Dependence::Column);
        let leaf = matches!(graph.node(id), Node::Axis(_) | Node::Undefined(_));
        self.is_column(id) && !leaf && rate.iter().all(outside)
    }
}

/// Which nodes are computed for columns, and which for pixels.
struct Wanted {
    column: Vec<bool>,
    pixel: Vec<bool>,
}

impl Wanted {
    fn of(graph: &Graph, world: &World, kept: &dyn Fn(NodeId) -> bool) -> Wanted {
        let mut wanted = Wanted {
            column: vec![false; graph.nodes.len()],
            pixel: vec![false; graph.nodes.len()],
        };
        for root in graph.outputs() {
            wanted.pixel[root.0 as usize] = true;
        }
        for (of, turns) in graph.loops.iter().enumerate() {
            for root in turns.roots() {
                match world.loops[of] {
                    true => wanted.column[root.0 as usize] = true,
                    false => wanted.pixel[root.0 as usize] = true,
                }
            }
        }
        for id in graph.ids().rev() {
            let at = id.0 as usize;
            if !world.is_column(id) {
                for used in graph.node(id).operands() {
                    wanted.pixel[used.0 as usize] = true;
                }
                continue;
            }
            if wanted.pixel[at] && kept(id) {
                wanted.column[at] = true;
            } else if wanted.pixel[at] {
                for used in graph.node(id).operands() {
                    wanted.pixel[used.0 as usize] = true;
                }
            }
            if wanted.column[at] {
                for used in graph.node(id).operands() {
                    wanted.column[used.0 as usize] = true;
                }
            }
        }
        wanted
    }
}

#[cfg(test)]
mod tests;
