//! Operations pushed into the arms of selects: what is made of a choice that has a constant in
//! one arm is made in each arm by itself.
//!
//! A floor's normal is (0, 1, 0): a product with it is 0 or the other factor, and a
//! reflection at it turns one sign. Behind the choice between the floor's normal and a
//! torus's nobody knows that any more. So an operation on such choices becomes a choice
//! between two operations, where one of them is none: it is a constant, an operand, or an
//! operand's negative; and so does what lies between. The other arm computes what it did,
//! so no pixel computes more.
//!
//! Rules are [`crate::passes::simplify::fold`]'s, which keep values bit for bit, and d (c / d) = c and
//! d t / t = d in an arm that knows that what is divided by is not 0: a point of a floor has
//! the floor's height, and the way back from it is the ray's direction. Fewer roundings.

mod arm;

use self::arm::Arm;
use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};

/// How many conditions are looked at.
const CONDITIONS: usize = 6;

/// The conditions whose choices have constants in an arm, those of most of them first.
pub fn conditions(graph: &Graph) -> Vec<NodeId> {
    let reached = graph.reached();
    let mut choices: BTreeMap<NodeId, usize> = BTreeMap::new();
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        let Node::Select { cond, yes, no } = graph.node(id) else {
            continue;
        };
        let shortcut = graph.early.contains(&id);
        if !shortcut && (graph.constant(yes).is_some() || graph.constant(no).is_some()) {
            *choices.entry(cond).or_default() += 1;
        }
    }
    let mut all: Vec<(NodeId, usize)> = choices.into_iter().collect();
    all.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    all.into_iter().take(CONDITIONS).map(|(id, _)| id).collect()
}

/// The graph with what is made of choices by a condition made in their arms, where that
/// leaves operations out; nothing where it does not.
pub fn push_into_select(graph: &Graph, ranges: &Ranges, cond: NodeId) -> Option<Graph> {
    let all = before_dither(graph);
    let (_, shorter) = apart((graph, ranges), cond, &all);
    if !shorter.contains(&true) {
        return None;
    }
    // What is left out, and of what lies before that no more than it takes.
    let mut these = shorter.clone();
    loop {
        let (next, now) = apart((graph, ranges), cond, &these);
        let missed = |id: &NodeId| shorter[id.0 as usize] && !now[id.0 as usize];
        let missed: Vec<NodeId> = graph.ids().filter(missed).collect();
        if !grow(graph, &mut these, missed) {
            return Some(next);
        }
    }
}

/// Which nodes are not made of the shade: a dither is looked at as a whole.
fn before_dither(graph: &Graph) -> Vec<bool> {
    let mut before = vec![true; graph.nodes.len()];
    for id in graph.ids() {
        let made = |arg: NodeId| Some(arg) == graph.shade || !before[arg.0 as usize];
        before[id.0 as usize] = !graph.node(id).operands().any(made);
    }
    before
}

/// Adds the next nodes that these are made of, behind those that were added before;
/// whether there are any.
fn grow(graph: &Graph, these: &mut [bool], from: Vec<NodeId>) -> bool {
    let (mut todo, mut seen, mut any) = (from, BTreeSet::new(), false);
    while let Some(id) = todo.pop() {
        let Node::Apply(op, args) = graph.node(id) else {
            continue;
        };
        for &arg in &args[..op.arity()] {
            if !matches!(graph.node(arg), Node::Apply(..)) || !seen.insert(arg) {
                continue;
            }
            match std::mem::replace(&mut these[arg.0 as usize], true) {
                true => todo.push(arg),
                false => any = true,
            }
        }
    }
    any
}

/// What a value is in the two arms, in the new graph.
#[derive(Clone, Copy)]
struct Pair {
    yes: NodeId,
    no: NodeId,
}

/// The graph with the operations among `these` made in both arms, and which of them are
/// none in one.
fn apart((graph, ranges): (&Graph, &Ranges), by: NodeId, these: &[bool]) -> (Graph, Vec<bool>) {
    let arms = [true, false].map(|holds| Arm::new(graph, ranges, by, holds));
    let mut pairs: FxHashMap<NodeId, Pair> = FxHashMap::default();
    let mut shorter = vec![false; graph.nodes.len()];
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let (op, args) = match graph.node(id) {
            Node::Select { cond, yes, no } if cond == by => {
                let (yes, no) = (new(yes)?, new(no)?);
                pairs.insert(id, Pair { yes, no });
                return None;
            }
            Node::Apply(op, args) => (op, args),
            _ => return None,
        };
        let args = &args[..op.arity()];
        if !these[id.0 as usize] || !args.iter().any(|arg| pairs.contains_key(arg)) {
            return None;
        }
        let of = |of: fn(&Pair) -> NodeId| -> Option<Vec<NodeId>> {
            let one = |arg: &NodeId| pairs.get(arg).map(of).or_else(|| new(*arg));
            args.iter().map(one).collect()
        };
        let (yes, no) = (of(|pair| pair.yes)?, of(|pair| pair.no)?);
        let cond = new(by)?;
        let [holds, fails] = &arms;
        let (yes, without) = holds.put((builder, made), (op, &yes), span);
        let (no, or_without) = fails.put((builder, made), (op, &no), span);
        shorter[id.0 as usize] = without || or_without;
        pairs.insert(id, Pair { yes, no });
        Some(builder.select(cond, yes, no, span))
    });
    (next, shorter)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::range::{Slack, ranges};
    use crate::cost::size_budget::SizeBudget;
    use crate::eval::drawn::{grid, picture};
    use crate::passes::simplify::fold::fold;
    use crate::planner::context::Context;
    use crate::scene;
    use crate::schedule::statements::schedule;
    use crate::sema::Options;
    use slowlight_routine::{Op, Value};
    use slowlight_runtime_jack::F316;

    fn lowered(ink: &str) -> Graph {
        let source = format!(
            "image 24 x 16 inks black, white; param p: real = 0.75 in -2 .. 2;
             draw (x, y) = {{
               let l = unit((x - 9, y - 5.5, p + 3));
               let flat = x > y;
               let n = if flat then (0, 1, 0) else unit((y - 3, p - x, 2));
               {ink}
             }};"
        );
        let options = Options {
            inks: Some(2),
            ..Options::default()
        };
        fold(
            &scene::check("test", &source)
                .lower(&options)
                .expect(&source),
        )
    }

    /// The graph with every condition's choices apart, one after the other.
    fn all_apart(graph: &Graph) -> Option<Graph> {
        let mut now = None;
        for k in 0..CONDITIONS {
            let of = now.as_ref().unwrap_or(graph);
            let next = conditions(of)
                .get(k)
                .and_then(|cond| push_into_select(of, &ranged(of), *cond))
                .map(|next| fold(&next));
            now = next.or(now);
        }
        now
    }

    fn ranged(graph: &Graph) -> Ranges {
        ranges(graph, &schedule(graph), &Slack::of(&F316))
    }

    /// What a pixel costs on Jack.
    fn price(graph: &Graph) -> f64 {
        let cx = Context::new(graph.clone(), &F316);
        let plan = cx.simplified(graph);
        cx.price(SizeBudget::default()).of(&plan)
    }

    #[test]
    fn products_with_a_constant_normal_are_left_out() {
        for ink in [
            "ink(if dot(l, n) > 0.2 then 1 else 0)",
            "ink(if dot(reflect(l, n), (0.3, 0.5, p)) > 0.1 then 1 else 0)",
            "ink(if length(reflect(l, n) - p * n) > 1.2 then 1 else 0)",
            "ink(if (if flat then 0 else p) * l.x < (if flat then l.y else 1) * l.z then 1 else 0)",
        ] {
            let graph = lowered(ink);
            let next = all_apart(&graph).expect(ink);
            let places = grid(24, 16, 1);
            assert_eq!(
                picture(&next, &schedule(&next), &places),
                picture(&graph, &schedule(&graph), &places),
                "{ink}"
            );
            assert!(price(&next) < price(&graph), "{ink}");
        }
    }

    #[test]
    fn a_point_of_a_floor_is_at_its_height() {
        let ink = |t: &str| {
            lowered(&format!(
                "let d = unit((x - 9, y - 20, -8)); let down = d.y;
                 let hit = if down == 0 then false else {t} > 0;
                 let t = if hit then {t} else l.z;
                 let p = (0, 3, 1) + t * d;
                 let lit = dot(l, if hit then (0, 1, 0) else l);
                 ink(if p.y * p.z < lit then 1 else 0)"
            ))
        };
        let graph = ink("-3.5 / down");
        let next = all_apart(&graph).expect("arms");
        let places = grid(24, 16, 1);
        assert_eq!(
            picture(&next, &schedule(&next), &places),
            picture(&graph, &schedule(&graph), &places)
        );
        let height = |graph: &Graph| {
            let mut all = graph.ids().filter_map(|id| graph.constant(id));
            all.any(|value| value == Value::Real(-0.5))
        };
        assert!(height(&next) && !height(&graph));
        // Where it may be 0, the product is not known.
        let next = all_apart(&ink("-3.5 / (down + 0.001)")).expect("arms");
        assert!(!height(&next));
    }

    #[test]
    fn a_dither_is_left_as_it_is() {
        let source = "image 24 x 16 inks black, white;
             draw (x, y) = threshold(if x > y then 0 else unit((x, y, 3)).z, bayer(2)[x mod 2, y mod 2]);";
        let graph = fold(
            &scene::check("test", source)
                .lower(&Options::default())
                .expect("a graph"),
        );
        assert!(!conditions(&graph).is_empty());
        for cond in conditions(&graph) {
            assert!(push_into_select(&graph, &ranged(&graph), cond).is_none());
        }
    }

    #[test]
    fn nothing_is_moved_into_arms_where_nothing_is_left_out() {
        for ink in [
            "ink(if (if flat then 0.3 else p) * l.x < 0.1 then 1 else 0)",
            "ink(if min(if flat then 0 else p, l.x) < 0.1 then 1 else 0)",
        ] {
            let graph = lowered(ink);
            let flat = |id: &NodeId| matches!(graph.node(*id), Node::Apply(Op::IntLess, _));
            let cond = conditions(&graph).into_iter().find(flat).expect(ink);
            assert!(
                push_into_select(&graph, &ranged(&graph), cond).is_none(),
                "{ink}"
            );
        }
    }
}
