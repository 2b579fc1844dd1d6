//! Logarithmic reals: three bytes, or two where the ranges know the sign.

use crate::ir::graph::*;
use crate::ir::tree::Place;
use crate::plan::Plan;
use slowlight_routine::log::known_sign;
use slowlight_routine::{Format, Type};
use slowlight_runtime_6502::write::{Place as Operand, Shape, size};

/// The upper byte of the logarithm that stands for 0; its lower byte is 0.
pub(super) const LEAST: u8 = 0x80;

/// Whether a plan's reals are logarithms.
pub(super) fn are(plan: &Plan) -> bool {
    matches!(plan.runtime.real, Format::Log { .. })
}

/// The sign that the ranges know of a value, true for plus.
fn known(plan: &Plan, id: NodeId) -> Option<bool> {
    let range = plan.ranges.result.get(id.0 as usize)?;
    known_sign(*range)
}

/// How a real's place is kept: one that several values share has a sign.
pub(super) fn shape(plan: &Plan, place: Place) -> Shape {
    let signed = match place {
        Place::Node(id) => known(plan, id).is_none(),
        _ => true,
    };
    Shape {
        bytes: size(plan.runtime.real) - u8::from(!signed),
        signed: false,
        spare: false,
    }
}

/// A real that stands in a home.
pub(super) fn operand(plan: &Plan, id: NodeId, name: String) -> Operand {
    match known(plan, id) {
        Some(plus) => Operand::Signed(name, plus),
        None => Operand::At(name),
    }
}

/// Whether a value is a real that is a logarithm.
pub(super) fn is_one(plan: &Plan, id: NodeId) -> bool {
    are(plan) && plan.graph.ty(id) == Type::Real
}
