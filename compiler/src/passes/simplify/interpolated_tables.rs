//! Table lookup with linear interpolation, of sines and cosines.
//!
//! A table of [`PARTS`] of a period with lines between its entries is off by at most an eighth of
//! the square of a part, 0.0012; without them one of four times as many is off by 0.012.
//! It takes two products, two lookups and a floor. Where that is cheaper than the function, and no
//! table without lines ([`super::function_tables`]) took its place, it may be looked up so;
//! whether a picture takes it is looked at when it is planned.

use super::function_tables::{NAME, periodic};
use crate::analysis::range::Ranges;
use crate::analysis::rate::rates;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use slowlight_routine::{Op, Runtime, Type, Value};
use std::f64::consts::TAU;

/// Into how many parts a period is cut.
const PARTS: u32 = 64;

/// The graph with such tables; nothing where it has no sines that are worth one.
pub fn interpolated_tables(graph: &Graph, _: &Ranges, _: &Runtime) -> Option<Graph> {
    let rates = rates(graph);
    let is_angle = |id| periodic::angle(graph, &rates, id).is_some();
    if !graph.ids().any(is_angle) {
        return None;
    }
    Some(rebuild_old(graph, &mut |builder, made, id, span| {
        let (op, angle) = periodic::angle(graph, &rates, id)?;
        let new = made.get(angle.0 as usize).copied().flatten()?;
        let place = periodic::place(builder, PARTS, new, span);
        let whole = builder.apply(Op::Floor, &[place], span);
        let last = builder.constant(Value::Int(PARTS as i32 - 1), span);
        let index = builder.apply(Op::BitAnd, &[whole, last], span);
        let whole = builder.apply(Op::ToReal, &[whole], span);
        let rest = builder.apply(Op::Sub, &[place, whole], span);
        let row = builder.constant(Value::Int(0), span);
        let [first, step] = entries(op).map(|entries| {
            let entries = entries.into_iter().map(|x| Constant::new(Value::Real(x)));
            let table = builder.table(Table {
                name: NAME.to_owned(),
                width: PARTS,
                height: 1,
                ty: Type::Real,
                entries: entries.collect(),
                seed: Vec::new(),
            });
            builder.lookup(table, index, row, span)
        });
        let line = builder.apply(Op::Mul, &[rest, step], span);
        Some(builder.apply(Op::Add, &[first, line], span))
    }))
}

/// What a function is at the beginning of each part, and how much it grows within it.
fn entries(op: Op) -> [Vec<f64>; 2] {
    let at = |k: u32| {
        let angle = f64::from(k) / f64::from(PARTS) * TAU;
        op.eval_real(angle, 0.0).real()
    };
    let first = (0..PARTS).map(at);
    let step = (0..PARTS).map(|k| at(k + 1) - at(k));
    [first.collect(), step.collect()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::loops::drawn::{analysed, shades};
    use slowlight_runtime_6502::float::REAL40;

    #[test]
    fn lines_between_entries_are_as_near_as_they_say() {
        let source = "image 24 x 16 inks black, white;
             draw (x, y) = {
               let a = x * 1.137 - y * 2.071;
               threshold(0.5 + 0.2 * sin(a * 1rad) + 0.2 * cos(a * 0.3rad), 0.5)
             };";
        let plain = analysed(source, &REAL40);
        let next = interpolated_tables(&plain.graph, &plain.ranges, &REAL40).expect("two sines");
        let mut most = 0.0_f64;
        for (old, new) in shades(&plain.graph).into_iter().zip(shades(&next)) {
            most = most.max((old - new).abs());
        }
        assert!(most > 0.0 && most < 0.4 * 0.00121, "{most}");
    }
}
