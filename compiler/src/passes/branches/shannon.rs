//! Shannon expansion of comparisons: what comes out the same either way is not asked for.
//!
//! Whether a point lies in the shadow takes a second ray to find out, and often does not
//! matter: where a pixel is darker than its threshold lit, it is dark in any case. So what
//! is made of a choice and then compared, or made an int, is worked out for both of its
//! arms; only where these differ is the choice's condition asked. It is Shannon's expansion
//! of the comparison, so nothing needs to be proved, and no pixel changes, in any arithmetic:
//! each arm's way is what it was.
//!
//! It doubles what lies between the choice and the comparison, so it is for the plan to find
//! out whether that pays.

use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use slowlight_routine::{Op, Type};
use std::collections::{BTreeMap, BTreeSet};

/// How many conditions are looked at, and how many more that no loop's turns change: what is
/// found by loops is made of many choices, each of which all of the loop is computed for.
const CONDITIONS: usize = 4;
const OUTSIDE: usize = 2;

/// The conditions of choices, those first that most is computed for.
pub fn conditions(graph: &Graph) -> Vec<NodeId> {
    let reached = graph.reached();
    let rates = rates(graph);
    let mut all: BTreeSet<NodeId> = BTreeSet::new();
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        if let Node::Select { cond, yes, no } = graph.node(id)
            && (graph.ty(id) == Type::Real || loops_alone((graph, &rates), cond, [yes, no]))
        {
            all.insert(cond);
        }
    }
    let mut all: Vec<(usize, NodeId)> = all
        .into_iter()
        .filter(|cond| !bares_directions(graph, *cond))
        .map(|cond| (reached_from(graph, cond), cond))
        .collect();
    all.sort_by_key(|(count, cond)| (std::cmp::Reverse(*count), *cond));
    let mut all = all.into_iter().map(|(_, cond)| cond);
    let mut found: Vec<NodeId> = all.by_ref().take(CONDITIONS).collect();
    let in_turns = |by: &Dependence| matches!(by, Dependence::Loop(_));
    let is_outside = |cond: &NodeId| !rates.rate(*cond).iter().any(in_turns);
    let more = OUTSIDE.saturating_sub(found.iter().filter(|cond| is_outside(cond)).count());
    found.extend(all.filter(is_outside).take(more));
    found
}

/// Whether an arm of a choice is made of a direction that the condition is not: where the other
/// arm holds there may be no such direction, a missed surface's normal, say, and it has not the
/// length that is trusted.
fn bares_directions(graph: &Graph, by: NodeId) -> bool {
    let asked = reached_by(graph, &[by]);
    graph.ids().any(|id| match graph.node(id) {
        Node::Select { cond, yes, no } if cond == by => {
            let arms = reached_by(graph, &[yes, no]);
            graph
                .directions
                .keys()
                .any(|id| arms[id.0 as usize] && !asked[id.0 as usize])
        }
        _ => false,
    })
}

/// Whether what has been compared already chooses by what a loop finds at each pixel that it is
/// not made of itself: then it is cheap beside. Constants differ.
fn loops_alone(of: (&Graph, &Rates), cond: NodeId, arms: [NodeId; 2]) -> bool {
    if arms.iter().all(|&arm| of.0.constant(arm).is_some()) {
        return false;
    }
    let beside = loops_of(of, &arms);
    loops_of(of, &[cond]).difference(&beside).next().is_some()
}

/// The loops that values are made of, of those that each pixel runs.
fn loops_of((graph, rates): (&Graph, &Rates), ids: &[NodeId]) -> BTreeSet<LoopId> {
    let reached = reached_by(graph, ids);
    let each_pixel =
        |id: NodeId| rates.depends(id, Dependence::Row) && rates.depends(id, Dependence::Column);
    let loops = graph.ids().filter_map(|id| match graph.node(id) {
        Node::Result { of, .. } if reached[id.0 as usize] && each_pixel(id) => Some(of),
        _ => None,
    });
    loops.collect()
}

/// How many nodes a value is made of.
fn reached_from(graph: &Graph, id: NodeId) -> usize {
    reached_by(graph, &[id])
        .into_iter()
        .filter(|&reached| reached)
        .count()
}

/// Of each node whether values are made of it.
fn reached_by(graph: &Graph, ids: &[NodeId]) -> Vec<bool> {
    let (mut seen, mut todo) = (vec![false; graph.nodes.len()], ids.to_vec());
    while let Some(id) = todo.pop() {
        if !std::mem::replace(&mut seen[id.0 as usize], true) {
            todo.extend(graph.references(id));
        }
    }
    seen
}

/// What a value is in the two arms, in the new graph.
#[derive(Clone, Copy)]
struct Pair {
    yes: NodeId,
    no: NodeId,
}

/// The graph in which a condition is asked only where it matters; nothing where no choice by
/// it comes to a comparison. Where errors are sent on, each shade matters.
pub fn shannon(graph: &Graph, by: NodeId) -> Option<Graph> {
    if graph.is_in_order() || bares_directions(graph, by) {
        return None;
    }
    let mut pairs: BTreeMap<NodeId, Pair> = BTreeMap::new();
    let mut some = false;
    let rates = rates(graph);
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let node = graph.node(id);
        let mut arms = |of: fn(&Pair) -> NodeId| -> Option<NodeId> {
            let one = |arg: NodeId| pairs.get(&arg).map(of).or_else(|| new(arg));
            put(builder, node, by, one, span)
        };
        let chosen = matches!(node, Node::Select { cond, .. } if cond == by);
        if !chosen && !node.operands().any(|arg| pairs.contains_key(&arg)) {
            return None;
        }
        let pair = match node {
            // Each arm is one way.
            Node::Select { yes, no, .. } if chosen => Pair {
                yes: pairs.get(&yes).map(|p| p.yes).or_else(|| new(yes))?,
                no: pairs.get(&no).map(|p| p.no).or_else(|| new(no))?,
            },
            _ => Pair {
                yes: arms(|pair| pair.yes)?,
                no: arms(|pair| pair.no)?,
            },
        };
        if graph.ty(id) == Type::Real {
            pairs.insert(id, pair);
            return None;
        }
        if let Node::Select { cond, yes, no } = node
            && chosen
            && !loops_alone((graph, &rates), cond, [yes, no])
        {
            return None;
        }
        some = true;
        let cond = new(by)?;
        let same = same(builder, pair, graph.ty(id), span);
        let asked = builder.select(cond, pair.yes, pair.no, span);
        Some(builder.select(same, pair.no, asked, span))
    });
    some.then_some(next)
}

/// A node with other operands.
fn put(
    builder: &mut Builder,
    node: Node,
    by: NodeId,
    one: impl Fn(NodeId) -> Option<NodeId>,
    span: Span,
) -> Option<NodeId> {
    match node {
        Node::Apply(op, args) => {
            let args: Option<Vec<NodeId>> = args[..op.arity()].iter().map(|a| one(*a)).collect();
            Some(builder.apply(op, &args?, span))
        }
        Node::Select { cond, yes, no } if cond != by => {
            let (cond, yes, no) = (one(cond)?, one(yes)?, one(no)?);
            Some(builder.select(cond, yes, no, span))
        }
        _ => None,
    }
}

/// Whether the two ways come to the same.
fn same(builder: &mut Builder, pair: Pair, ty: Type, span: Span) -> NodeId {
    match ty {
        Type::Bool => {
            let not = builder.apply(Op::Not, &[pair.no], span);
            builder.select(pair.yes, pair.no, not, span)
        }
        _ => builder.apply(Op::IntEqual, &[pair.yes, pair.no], span),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eval::drawn::grid;
    use crate::eval::native::Native;
    use crate::passes::simplify::fold::fold;
    use crate::scene;
    use crate::sema::Options;

    fn lowered(draw: &str) -> Graph {
        let source = format!(
            "image 24 x 16 inks black, grey, white; param p: real = 0.75 in -2 .. 2;
             draw (x, y) = {{
               let dear = loop (v = x * 0.1 + y * 0.07 + p, n = 0) max 40 {{
                 if n < 30 then next(v * 1.1 + 0.01, n + 1) else v > 20
               }} else false;
               {draw}
             }};"
        );
        let options = Options {
            inks: Some(3),
            ..Options::default()
        };
        let checked = scene::check("test", &source);
        fold(&checked.lower(&options).expect(&source))
    }

    /// The inks, and how many operations they took.
    fn inks(graph: &Graph) -> (Vec<u8>, u64) {
        // Nobody asks for the shade.
        let graph = Graph {
            shade: None,
            ..graph.clone()
        };
        let mut native = Native::new(&graph);
        let places = grid(24, 16, 1);
        let inks = places.iter().map(|(x, y)| native.pixel(*x, *y).ink);
        (inks.collect(), native.operations())
    }

    #[test]
    fn a_dear_condition_is_asked_only_where_it_matters() {
        for ink in [
            "threshold((if dear then 0.25 else 1) * (y / 16), bayer(4)[x mod 4, y mod 4])",
            "ink(if (if dear then p else 2) * y < x then 1 else 2)",
            "ink(floor((if dear then y / 20 else y / 10) * 1.5))",
        ] {
            let graph = lowered(ink);
            let (drawn, all) = inks(&graph);
            let found = conditions(&graph).into_iter();
            let found = found.filter_map(|cond| shannon(&graph, cond));
            let found: Vec<_> = found.map(|next| inks(&next)).collect();
            assert!(found.iter().all(|(inks, _)| *inks == drawn), "{ink}");
            // It still matters at some.
            let fewer = |few: u64| few < all * 3 / 4 && few > all / 100;
            let few: Vec<u64> = found.iter().map(|(_, few)| *few).collect();
            assert!(few.iter().any(|few| fewer(*few)), "{ink}: {few:?} of {all}");
        }
    }

    #[test]
    fn arms_that_are_compared_already_may_decide_alone() {
        let lit = "y / 16 > bayer(4)[x mod 4, y mod 4]";
        for (draw, some) in [
            (
                format!("ink(if (if dear then {lit} else y > 12) then 1 else 0)"),
                true,
            ),
            (
                format!("ink(if (if dear then false else {lit}) then 1 else 0)"),
                true,
            ),
            (
                "ink(if (if dear then false else true) then 1 else 0)".to_owned(),
                false,
            ),
        ] {
            let graph = lowered(&draw);
            let (drawn, all) = inks(&graph);
            let found = conditions(&graph).into_iter();
            let found = found.filter_map(|cond| shannon(&graph, cond));
            let found: Vec<_> = found.map(|next| inks(&fold(&next))).collect();
            assert!(found.iter().all(|(inks, _)| *inks == drawn), "{draw}");
            assert_eq!(
                found.iter().any(|(_, few)| *few < all * 3 / 4),
                some,
                "{draw}"
            );
        }
    }

    #[test]
    fn errors_that_are_sent_on_need_every_shade() {
        let source = "image 16 x 8 inks black, white;
            dither send(v: real, x: int, y: int) -> ink = {
              let q = clamp(round(v), 0, 1);
              spread v - q to { (1, 0): 7/16 };
              ink(q)
            };
            draw (x, y) = send((if x * x > 8 then 0.25 else 1) * y / 8, x, y);";
        let graph = scene::check("test", source).lower(&Options::default());
        let graph = graph.expect("a graph");
        assert!(!conditions(&graph).is_empty());
        for cond in conditions(&graph) {
            assert!(shannon(&graph, cond).is_none());
        }
    }
}
