//! Whole numbers taken out of floors (distributivity over integers): floor(4 + x) = 4 + floor(x).
//!
//! A sum of logarithms is rounded to a part of itself, so a tile's coordinate that is
//! first moved by whole tiles may lie on the other side of the tile's edge then. The
//! floors are equal over the reals, and the second has a rounding less.

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild;
use crate::source::Span;
use slowlight_routine::{Op, Value};

/// Whole numbers beyond this stay where they are: ints hold what is left.
const MOST: f64 = 1000.0;

/// The graph with floors of sums with whole numbers as sums of floors.
pub fn integer_parts(graph: &Graph) -> Graph {
    rebuild(graph, &mut |builder, _, node, span| match node {
        Node::Apply(Op::Floor, [sum, _]) => taken_out(builder, sum, span),
        _ => None,
    })
}

fn taken_out(builder: &mut Builder, sum: NodeId, span: Span) -> Option<NodeId> {
    let whole = |id: NodeId| match builder.value(id) {
        Some(Value::Real(c)) if c.fract() == 0.0 && c.abs() <= MOST => Some(c as i32),
        _ => None,
    };
    let Node::Apply(op, [a, b]) = builder.node(sum) else {
        return None;
    };
    let (rest, minus, whole) = match (op, whole(a), whole(b)) {
        (Op::Add, Some(c), _) => (b, false, c),
        (Op::Add, _, Some(c)) => (a, false, c),
        (Op::Sub, Some(c), _) => (b, true, c),
        (Op::Sub, _, Some(c)) => (a, false, -c),
        _ => return None,
    };
    let rest = match minus {
        true => builder.apply(Op::Neg, &[rest], span),
        false => rest,
    };
    let floor = builder.apply(Op::Floor, &[rest], span);
    let whole = builder.constant(Value::Int(whole), span);
    Some(builder.apply(Op::IntAdd, &[whole, floor], span))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eval::drawn::{grid, picture};
    use crate::passes::simplify::fold::fold;
    use crate::scene;
    use crate::schedule::statements::schedule;
    use crate::sema::Options;

    fn lowered(floors: &str) -> Graph {
        let source = format!(
            "image 24 x 16 inks black, white; param p: real = 0.75 in -2 .. 2;
             draw (x, y) = ink(({floors}) mod 2);"
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

    /// Whether a floor is still asked of a sum.
    fn of_sums(graph: &Graph) -> bool {
        let reached = graph.reached();
        let sum = |id: NodeId| matches!(graph.node(id), Node::Apply(Op::Add | Op::Sub, _));
        graph.ids().any(|id| match graph.node(id) {
            Node::Apply(Op::Floor, [a, _]) => reached[id.0 as usize] && sum(a),
            _ => false,
        })
    }

    #[test]
    fn floors_of_sums_with_whole_numbers_are_sums_of_floors() {
        for (floors, left) in [
            ("floor(4 + x * p / 3) + floor(y * p - 7)", false),
            ("floor(3 - x * p / 5)", false),
            ("floor(0.5 + x * p)", true),
            ("floor(p + x * 0.3)", true),
        ] {
            let graph = lowered(floors);
            let next = integer_parts(&graph);
            let places = grid(24, 16, 1);
            assert!(of_sums(&graph), "{floors}");
            assert_eq!(of_sums(&next), left, "{floors}");
            let plain = picture(&graph, &schedule(&graph), &places);
            assert_eq!(picture(&next, &schedule(&next), &places), plain, "{floors}");
        }
    }
}
