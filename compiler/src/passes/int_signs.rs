//! The sign of a whole number needs no real.
//!
//! Where reals have few bits a sign stays an int, so that what it is multiplied with may be
//! stepped from column to column as one. Where an int that is read as a real costs nothing,
//! as in BASIC, the plan's other forms are the better for leaving it: mirrors took a seventh
//! longer with it.

use super::rebuild::rebuild_old;
use crate::flow::graph::*;
use slowlight_routine::Op;

/// The graph with signs of ints as ints' own.
pub fn int_signs(graph: &Graph) -> Graph {
    rebuild_old(graph, &mut |builder, made, id, span| {
        let Node::Apply(Op::Sign, [x, _]) = graph.node(id) else {
            return None;
        };
        let Node::Apply(Op::ToReal, [whole, _]) = graph.node(x) else {
            return None;
        };
        let whole = made.get(whole.0 as usize).copied().flatten()?;
        Some(builder.apply(Op::IntSign, &[whole], span))
    })
}
