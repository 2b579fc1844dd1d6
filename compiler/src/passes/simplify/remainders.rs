//! Remainders of reals by a constant as what they are: `a mod b` becomes `a - b * floor(a / b)`.
//!
//! A routine for remainders is given any divisor and sees to it that what is left is below it. By
//! a constant the quotient is one product, the whole part is often an int of few values that
//! something else has, too, and the sum joins with the sums around it (`(x + c / 2) mod c - c / 2`,
//! by which people repeat a shape, is `x - c * floor(x / c + 1 / 2)`).
//!
//! The whole part is an int: what is divided must be proved to be so small that it fits one. What
//! is made may be a rounding below 0, or as large as the divisor: remainders that are made ints,
//! by themselves or times a constant, stay, since those may be places in tables. Where each value
//! has its own point, which its range decides, all of them do.

use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use slowlight_routine::{Format, Op, Runtime, Value};

/// The graph with such differences; nothing where there are none.
pub fn remainders(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    let real = runtime.real;
    let relative = real.has_mantissa() || matches!(real, Format::Log { .. });
    if !relative {
        return None;
    }
    let whole = made_whole(graph);
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let Node::Apply(Op::Mod, [a, b]) = graph.node(id) else {
            return None;
        };
        let divisor = graph.constant(b).filter(|_| !whole[id.0 as usize])?;
        let Value::Real(by) = divisor else {
            return None;
        };
        let of = made.get(a.0 as usize).copied().flatten();
        let range = ranges.result.get(a.0 as usize)?;
        let fits = range.magnitude() / by < runtime.int.most() - 2.0;
        let of = of.filter(|_| by.is_normal() && by > 0.0 && fits)?;
        done = true;
        let by = builder.constant(divisor, span);
        let quotient = builder.apply(Op::Div, &[of, by], span);
        let turns = builder.apply(Op::Floor, &[quotient], span);
        let turns = builder.apply(Op::ToReal, &[turns], span);
        let less = builder.apply(Op::Mul, &[turns, by], span);
        Some(builder.apply(Op::Sub, &[of, less], span))
    });
    done.then_some(next)
}

/// Which values are made ints, by themselves or after sums, products and quotients with constants.
fn made_whole(graph: &Graph) -> Vec<bool> {
    let mut whole = vec![false; graph.nodes.len()];
    for id in graph.ids().rev() {
        match graph.node(id) {
            Node::Apply(Op::Floor | Op::Round, [of, _]) => whole[of.0 as usize] = true,
            Node::Apply(Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Neg, [a, b])
                if whole[id.0 as usize] =>
            {
                let known = |id: NodeId| graph.constant(id).is_some();
                whole[a.0 as usize] |= a == b || known(b);
                whole[b.0 as usize] |= a == b || known(a);
            }
            _ => {}
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planner::context::Context;
    use crate::scene;
    use crate::sema::Options;
    use slowlight_runtime_6502::log::LOG10;
    use slowlight_runtime_6502::scaled::FIXED16;
    use slowlight_runtime_jack::wide::F416;

    /// How many remainders are left, if any is made something else.
    fn left(runtime: &'static Runtime, shade: &str) -> Option<usize> {
        let source = format!(
            "image 8 x 8 inks black, white; param a: real = 1 in 1 .. 4;
             draw (x, y) = threshold({shade}, 0.5);"
        );
        let checked = scene::check("test", &source);
        assert!(checked.is_right(), "{source}: {:?}", checked.diagnostics);
        let graph = checked.lower(&Options::default()).ok()?;
        let plain = Context::new(graph.clone(), runtime).simplified(&graph);
        let next = remainders(&plain.graph, &plain.ranges, runtime)?;
        let reached = next.reached();
        let is_one = |id: &NodeId| {
            reached[id.0 as usize] && matches!(next.node(*id), Node::Apply(Op::Mod, _))
        };
        Some(next.ids().filter(is_one).count())
    }

    #[test]
    fn a_remainder_by_a_constant_is_a_difference() {
        assert_eq!(left(&LOG10, "(a * x) mod 0.7"), Some(0));
        assert_eq!(left(&LOG10, "(a * x) mod 0.7 + x mod (0.3 * a)"), Some(1));
    }

    #[test]
    fn others_stay() {
        assert_eq!(left(&LOG10, "x / 3 mod a"), None);
        assert_eq!(left(&LOG10, "floor((a * x) mod 2) / 2"), None);
        assert_eq!(left(&LOG10, "floor(((a * x) mod 0.7) * 5 + 1) / 2"), None);
        // A whole part of what is as large is no int of Jack's.
        assert_eq!(left(&F416, "(a * x * 5000.3) mod 1"), None);
        assert_eq!(left(&F416, "(a * x * 500.3) mod 1"), Some(0));
        assert_eq!(left(&FIXED16, "(a * x) mod 0.7"), None);
    }
}
