//! Constant factors of products and quotients by constants, one after the other, as one product.
//!
//! A camera's column is (x - 80) / 120 . 0.577: one product with 0.577 / 120. That is one
//! rounding less, where a format's roundings are relative; in a fixed point such a factor would
//! have few bits.

use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use slowlight_routine::{Format, Op, Runtime, Value};

/// The graph with such products; nothing where there are none.
pub fn constant_factors(graph: &Graph, _: &Ranges, runtime: &Runtime) -> Option<Graph> {
    let real = runtime.real;
    let relative = real.has_mantissa() || matches!(real, Format::Log { .. });
    if !relative {
        return None;
    }
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let (inner, factor) = scaled(graph, id)?;
        let (of, before) = scaled(graph, inner)?;
        let (of, all) = match scaled(graph, of) {
            Some((of, first)) => (of, factor * before * first),
            None => (of, factor * before),
        };
        let of = made.get(of.0 as usize).copied().flatten();
        let of = of.filter(|_| all.is_normal())?;
        done = true;
        let all = builder.constant(Value::Real(all), span);
        Some(builder.apply(Op::Mul, &[of, all], span))
    });
    done.then_some(next)
}

/// What a value is a product of with a constant, and that.
fn scaled(graph: &Graph, id: NodeId) -> Option<(NodeId, f64)> {
    let Node::Apply(op @ (Op::Mul | Op::Div), [a, b]) = graph.node(id) else {
        return None;
    };
    let [left, right] = [a, b].map(|of| graph.constant(of).map(Value::real));
    match (op, left, right) {
        (_, Some(_), Some(_)) => None,
        (Op::Mul, Some(factor), None) => Some((b, factor)),
        (Op::Mul, None, Some(factor)) => Some((a, factor)),
        (Op::Div, None, Some(by)) => Some((a, 1.0 / by)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planner::context::Context;
    use crate::scene;
    use crate::sema::Options;
    use slowlight_runtime_6502::FIXED16_16 as FIXED;
    use slowlight_runtime_bbc::RUNTIME as MICRO;

    /// How many products and quotients are left, if anything is joined.
    fn products(runtime: &'static Runtime, shade: &str) -> Option<usize> {
        let source = format!(
            "image 8 x 8 inks black, white; param a: real = 1 in 1 .. 4;
             draw (x, y) = threshold({shade}, 0.5);"
        );
        let checked = scene::check("test", &source);
        assert!(checked.is_right(), "{source}: {:?}", checked.diagnostics);
        let graph = checked.lower(&Options::default()).ok()?;
        let plain = Context::new(graph.clone(), runtime).simplified(&graph);
        let next = constant_factors(&plain.graph, &plain.ranges, runtime)?;
        let reached = next.reached();
        let is_product = |id: &NodeId| {
            let node = next.node(*id);
            reached[id.0 as usize] && matches!(node, Node::Apply(Op::Mul | Op::Div, _))
        };
        Some(next.ids().filter(is_product).count())
    }

    #[test]
    fn constants_one_after_the_other_are_one() {
        assert_eq!(products(&MICRO, "a / 7 * 0.3"), Some(1));
        assert_eq!(products(&MICRO, "0.3 * (a * 5 / 7)"), Some(1));
        assert_eq!(products(&MICRO, "a * 0.3"), None);
        assert_eq!(products(&MICRO, "3 / a * a"), None);
    }

    #[test]
    fn a_fixed_point_keeps_both() {
        assert_eq!(products(&FIXED, "a / 7 * 0.3"), None);
    }
}
