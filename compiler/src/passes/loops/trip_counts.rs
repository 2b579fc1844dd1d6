//! Trip counts: a loop that its own counter ends has as many turns as that says.
//!
//! `loop (k = 0, s = 0.0) max 9 { if k == 4 then s else next(k + 1, ..) } else 0` asks at each
//! turn what the machine's own count of turns knows. It goes on in all of four turns, and its
//! result is then what it would end with in the fifth, of which nothing else is computed.
//! (Known as the replacement of a loop's exit test by its trip count: Muchnick, Advanced
//! compiler design and implementation, 14.1.4.)

use super::induction_tables::counted;
use super::peel::cone;
use crate::analysis::range::Ranges;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
use crate::passes::rewrite::arena::Arena;
use slowlight_routine::{Runtime, Value};

/// How many nodes a loop's results may have that stand behind it then.
const MOST: usize = 60;

/// The graph with such loops without their tests; nothing where it has none.
pub fn trip_counts(graph: &Graph, _: &Ranges, _: &Runtime) -> Option<Graph> {
    let next = |graph: &Graph| {
        let rates = rates(graph);
        let mut all = counted(graph).into_iter();
        all.find_map(|(of, going)| ended(graph, &rates, of, going))
    };
    let mut best = next(graph)?;
    while let Some(graph) = next(&best) {
        best = graph;
    }
    Some(best)
}

/// The graph with a loop that ends after so many turns that go on.
fn ended(graph: &Graph, rates: &Rates, of: LoopId, going: usize) -> Option<Graph> {
    let turns = graph.loops.get(of.0 as usize)?;
    if going == 0 || going >= turns.max as usize {
        return None;
    }
    let inside = |id: &NodeId| rates.depends(*id, Dependence::Loop(of));
    let body: Vec<NodeId> = graph.ids().filter(inside).collect();
    let last = cone(graph, &turns.done, &body);
    let other = |id: &NodeId| matches!(graph.node(*id), Node::Result { .. });
    if last.len() > MOST || last.iter().any(other) {
        return None;
    }
    let mut out = Arena::new(graph);
    let mut moved: Vec<Option<NodeId>> = vec![None; graph.nodes.len()];
    let mut ends: Option<(NodeId, Vec<NodeId>)> = None;
    let at = |moved: &[Option<NodeId>], id: NodeId| moved[id.0 as usize].unwrap_or(NodeId(0));
    for id in graph.ids() {
        if ends.is_none() && matches!(graph.node(id), Node::Result { of: l, .. } if l == of) {
            // What the turn after them would end with.
            let mut copied = moved.clone();
            for id in &last {
                let node = match graph.node(*id) {
                    Node::Carried { index, .. } => Node::Last { of, index },
                    node => node.with(|id| at(&copied, id)),
                };
                copied[id.0 as usize] = Some(out.push(node, *id));
            }
            let goes_on = Node::Const(Constant::new(Value::Bool(true)));
            let otherwise = turns.done.iter().map(|id| at(&copied, *id)).collect();
            ends = Some((out.push(goes_on, turns.again), otherwise));
        }
        let node = graph.node(id).with(|id| at(&moved, id));
        moved[id.0 as usize] = Some(out.push(node, id));
    }
    let (again, otherwise) = ends?;
    let mut made = out.finish(&moved);
    let turns = &mut made.loops[of.0 as usize];
    turns.max = going as u32;
    (turns.again, turns.otherwise) = (again, otherwise);
    Some(made)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::eval::drawn::assert_same;
    use crate::passes::simplify::fold::fold;
    use crate::planner::context::Context;
    use crate::scene;
    use crate::schedule::statements::schedule;
    use crate::sema::Options;
    use crate::targets::bbc::MICRO;

    /// A scene's graph with trip counts, which draws the same picture.
    fn counted_out(turns: &str) -> Option<Graph> {
        let source = format!(
            "image 7 x 5 inks black, white; param p: real = 1 in 0 .. 4;
             draw (x, y) = threshold({turns}, 0.5);"
        );
        let checked = scene::check("test", &source);
        assert!(checked.is_right(), "{source}: {:?}", checked.diagnostics);
        let graph = fold(&checked.lower(&Options::default()).ok()?);
        let plain = Context::new(graph.clone(), MICRO.runtime).simplified(&graph);
        let next = fold(&trip_counts(&plain.graph, &plain.ranges, MICRO.runtime)?);
        assert_same((&plain.graph, &plain.tree), (&next, &schedule(&next)), 0);
        Some(next)
    }

    #[test]
    fn a_counter_that_ends_a_loop_is_its_number_of_turns() {
        let made = counted_out(
            "loop (k = 0, s = 0.1) max 9 { if k == 4 then s + k / 100 else next(k + 1, s * p + x / 50) } else 0",
        );
        let made = made.unwrap();
        let always = made.loops.iter().map(|l| made.constant(l.again));
        assert_eq!(made.loops.iter().map(|l| l.max).collect::<Vec<_>>(), [4]);
        assert_eq!(always.collect::<Vec<_>>(), [Some(Value::Bool(true))]);
    }

    #[test]
    fn a_loop_that_ends_otherwise_is_left_alone() {
        let turns = "loop (k = 0, s = 0.1) max 9 {
            if k == 4 or s > 1 then s else next(k + 1, s * p + x / 50) } else 0";
        assert!(counted_out(turns).is_none());
        let turns = "loop (k = 0, s = 0.1) max 9 { next(k + 1, s * p + x / 50) } else s";
        assert!(counted_out(turns).is_none());
    }
}
