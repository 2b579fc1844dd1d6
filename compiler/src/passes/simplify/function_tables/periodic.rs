//! Sines and cosines as tables of one period, read at the place where the angle stands in it.
//!
//! A sine takes as long as some twenty products, of which a picture of a few inks shows the first
//! digits. Where every pixel or turn has another angle, a table of [`PARTS`] does:
//! the angle in parts of a turn, rounded down, its last bits the place. An entry is the function
//! in the middle of its part. Whether a picture takes that is looked at when it is planned.

use super::{NAME, PARTS};
use crate::analysis::rate::{Dependence, Rates};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use slowlight_routine::{Op, Type, Value};
use std::f64::consts::TAU;

/// The angle of a sine or cosine that is worth a table: it changes more often than the rows or
/// the columns do, of which there are not many more than a table has entries.
pub fn angle(graph: &Graph, rates: &Rates, id: NodeId) -> Option<(Op, NodeId)> {
    let Node::Apply(op @ (Op::Sin | Op::Cos), [angle, _]) = graph.node(id) else {
        return None;
    };
    let rate = rates.rate(id);
    let looped = (rate.iter()).any(|d| matches!(d, Dependence::Loop(_) | Dependence::Last(_)));
    let pixel = [Dependence::Row, Dependence::Column]
        .iter()
        .all(|d| rate.contains(d));
    (looped || pixel).then_some((op, angle))
}

/// A period of the function in [`PARTS`], and the place of an angle in it.
pub(super) fn looked_up(b: &mut Builder, op: Op, angle: NodeId, span: Span) -> NodeId {
    let place = place(b, PARTS, angle, span);
    let whole = b.apply(Op::Floor, &[place], span);
    let last = b.constant(Value::Int(PARTS as i32 - 1), span);
    let index = b.apply(Op::BitAnd, &[whole, last], span);
    let table = b.table(period(op));
    let row = b.constant(Value::Int(0), span);
    b.lookup(table, index, row, span)
}

/// An angle in so many parts of a turn.
pub fn place(b: &mut Builder, parts: u32, angle: NodeId, span: Span) -> NodeId {
    let parts = f64::from(parts) / TAU;
    // What the angle is multiplied by already is done at once.
    let factor = match b.node(angle) {
        Node::Apply(Op::Mul, args) => {
            let constant = |id: NodeId| b.value(id).map(Value::real);
            match args.map(constant) {
                [Some(c), None] => Some((args[1], c)),
                [None, Some(c)] => Some((args[0], c)),
                _ => None,
            }
        }
        _ => None,
    };
    let (of, by) = factor.map_or((angle, parts), |(of, c)| (of, c * parts));
    let by = b.constant(Value::Real(by), span);
    b.apply(Op::Mul, &[of, by], span)
}

fn period(op: Op) -> Table {
    let entry = |k: u32| {
        let angle = (f64::from(k) + 0.5) / f64::from(PARTS) * TAU;
        Constant::new(Value::Real(op.eval_real(angle, 0.0).real()))
    };
    Table {
        name: NAME.to_owned(),
        width: PARTS,
        height: 1,
        ty: Type::Real,
        entries: (0..PARTS).map(entry).collect(),
        seed: Vec::new(),
    }
}
