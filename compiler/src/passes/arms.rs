//! Arms: where one arm of a choice is a constant, what is made of it is chosen, too.
//!
//! A scene's hits are joined before they are shaded: the normal of the floor is
//! (0, 1, 0), that of a ball another at each point, and the shade asks for their
//! products with the light's direction. l_x n_x + l_y n_y + l_z n_z is five operations
//! of a choice, or a choice between l_y and five operations. An operation goes into
//! the arms where one of them is simpler for it: 0 times a value, 1 times, 0 and a value.
//! Every step is exact, as [`super::fold`] is, or equal over the reals and a constant:
//! d (k / d), where the choice says that d is not 0.

use super::fold::simpler;
use super::rebuild::rebuild_old;
use super::region::implied;
use crate::flow::build::Builder;
use crate::flow::graph::*;
use slowlight_routine::{Op, Type, Value};
use std::collections::BTreeSet;

/// The bools by which a real is chosen that is a constant on one way.
pub fn chosen_by(graph: &Graph) -> Vec<NodeId> {
    let reached = graph.reached();
    let all: BTreeSet<NodeId> = (graph.ids())
        .filter(|id| reached[id.0 as usize] && graph.ty(*id) == Type::Real)
        .filter_map(|id| match graph.node(id) {
            Node::Select { cond, yes, no } => {
                let either = graph.constant(yes).is_some() || graph.constant(no).is_some();
                either.then_some(cond)
            }
            _ => None,
        })
        .collect();
    all.into_iter().collect()
}

/// The graph with operations in the arms of choices by some bools; nothing where none
/// becomes simpler there, or is there anyway.
pub fn into_arms(graph: &Graph, by: &[NodeId]) -> Option<Graph> {
    let ways: Vec<(NodeId, [Vec<NodeId>; 2])> = (by.iter())
        .map(|&cond| {
            (
                cond,
                [true, false].map(|holds| not_zero(graph, cond, holds)),
            )
        })
        .collect();
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let Node::Apply(op, args) = graph.node(id) else {
            return None;
        };
        // Squares stay: a length is known by them.
        if op.result() != Type::Real || op == Op::Mul && args[0] == args[1] {
            return None;
        }
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let args = [new(args[0])?, new(args[1])?];
        let (cond, some) = args.iter().find_map(|arg| match builder.node(*arg) {
            Node::Select { cond, .. } => {
                let way = ways.iter().find(|(by, _)| new(*by) == Some(cond))?;
                Some((cond, &way.1))
            }
            _ => None,
        })?;
        let ways = [true, false].map(|holds| {
            let args = args.map(|arg| arm(builder, arg, (cond, holds)));
            let some = some[usize::from(!holds)].iter().filter_map(|id| new(*id));
            let simple = back(builder, op, args, &some.collect::<Vec<_>>())
                .or_else(|| simpler(builder, op, args, span));
            simple.map(|id| (id, true)).unwrap_or_else(|| {
                let id = builder.apply(op, &args[..op.arity()], span);
                (id, made.contains(&Some(id)))
            })
        });
        let [(yes, simple), (no, other)] = ways;
        if !simple && !other {
            return None;
        }
        done = true;
        Some(builder.select(cond, yes, no, span))
    });
    done.then_some(next)
}

/// What is known not to be 0 where a bool holds or not.
fn not_zero(graph: &Graph, cond: NodeId, holds: bool) -> Vec<NodeId> {
    let zero = |id| graph.constant(id) == Some(Value::Real(0.0));
    let facts = implied(graph, cond, holds).into_iter();
    let asked = facts.filter_map(|(fact, holds)| match graph.node(fact) {
        Node::Apply(Op::Equal, [a, b]) if !holds && zero(b) => Some(a),
        Node::Apply(Op::Equal, [a, b]) if !holds && zero(a) => Some(b),
        _ => None,
    });
    asked.collect()
}

/// What was divided by what it is multiplied by, which is not 0: a ray that meets a
/// level floor is there at the floor's height.
fn back(builder: &Builder, op: Op, [a, b]: [NodeId; 2], some: &[NodeId]) -> Option<NodeId> {
    let over = |id: NodeId, by: NodeId| match builder.node(id) {
        Node::Apply(Op::Div, [k, of]) if of == by && some.contains(&by) => Some(k),
        _ => None,
    };
    match op {
        Op::Mul => over(a, b).or_else(|| over(b, a)),
        _ => None,
    }
}

/// What a value is where a bool holds or not.
fn arm(builder: &Builder, id: NodeId, (by, holds): (NodeId, bool)) -> NodeId {
    match builder.node(id) {
        Node::Select { cond, yes, no } if cond == by => match holds {
            true => yes,
            false => no,
        },
        _ => id,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eval::drawn::{examples, grid, picture};
    use crate::eval::native::Native;
    use crate::passes::fold::fold;
    use crate::passes::schedule::schedule;
    use crate::scene;
    use crate::sema::Options;

    fn lowered(normal: &str) -> Graph {
        let source = format!(
            "image 8 x 8 inks black, white;
             draw (x, y) = {{
               let l = (x - 3.5, y - 2.5, 2 + 0.1 * y);
               let n = if x > y then {normal} else (x * 0.3, y - 4, 1.5);
               ink(if dot(l, n) > 1 then 1 else 0)
             }};"
        );
        let graph = scene::check("test", &source).lower(&Options::default());
        fold(&graph.expect(&source))
    }

    fn products(graph: &Graph) -> usize {
        let reached = graph.reached();
        let all = graph.ids().filter(|id| reached[id.0 as usize]);
        all.filter(|id| matches!(graph.node(*id), Node::Apply(Op::Mul, _)))
            .count()
    }

    #[test]
    fn a_product_with_a_constant_normal_is_a_component() {
        let graph = lowered("(0, 1, 0)");
        let by = chosen_by(&graph);
        let next = fold(&into_arms(&graph, &by).expect("arms"));
        let places = grid(8, 8, 1);
        let drawn = |graph: &Graph| picture(graph, &schedule(graph), &places);
        assert_eq!(drawn(&next), drawn(&graph));
        // The other arm's three products are in it now, and no sum is before the choice.
        assert_eq!(products(&next), products(&graph));
        let sum = |id: NodeId| matches!(next.node(id), Node::Apply(Op::Add, _));
        let chosen = next.ids().any(|id| match next.node(id) {
            Node::Select { yes, no, .. } => sum(no) && !sum(yes),
            _ => false,
        });
        assert!(chosen);
    }

    #[test]
    fn what_is_no_simpler_stays() {
        let graph = lowered("(0.5, 2.5, 3)");
        let by = chosen_by(&graph);
        assert!(!by.is_empty());
        assert!(into_arms(&graph, &by).is_none());
    }

    #[test]
    fn the_examples_draw_what_they_drew() {
        for (name, graph) in examples() {
            let by = chosen_by(&graph);
            let Some(next) = into_arms(&graph, &by) else {
                continue;
            };
            let next = fold(&next);
            let (mut a, mut b) = (Native::new(&graph), Native::new(&next));
            for (x, y) in grid(graph.image.width, graph.image.height, 37) {
                assert_eq!(a.pixel(x, y).ink, b.pixel(x, y).ink, "{name} at {x}, {y}");
            }
        }
    }
}
