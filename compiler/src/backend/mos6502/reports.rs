//! What a graph reports beside its picture, through the machine's port for bytes.

use super::Text;
use super::homes::Homes;
use crate::plan::Plan;
use slowlight_routine::{Format, Type};
use slowlight_runtime_6502::write::{self, Place as Operand};

/// How many bytes of a value are reported.
fn reported(format: Format) -> usize {
    usize::from(write::size(format)).max(4)
}

/// Gives out what the graph reports through the one port for bytes that there
/// is: as a picture of one row, an ink a byte ([`reported`]), low byte first.
pub(super) fn reports(plan: &Plan, homes: &Homes, text: &mut Text) {
    if plan.graph.reports.is_empty() || plan.plot {
        return;
    }
    let reports = plan.graph.reports.iter();
    let all: usize = reports.map(|id| reported(plan.format(*id))).sum();
    let [lo, hi, ..] = all.to_le_bytes();
    text.code(&format!(
        "lda #{lo} | sta width_port | lda #{hi} | sta width_port+1"
    ));
    text.code("lda #1 | sta height_port | lda #0 | sta height_port+1 | sta inks_port");
    for &id in &plan.graph.reports {
        let mut value = homes.operand(plan, id);
        if let (Some(points), Some(constant)) = (plan.points(), plan.graph.constant(id)) {
            let real = plan.graph.ty(id) == Type::Real;
            let bits = (plan.runtime.encode)(constant, plan.format(id));
            value = Operand::Constant(if real {
                points.read(
                    &plan.graph,
                    id,
                    bits,
                    (points.own(id), points.widths().value(id)),
                )
            } else {
                bits
            });
        }
        if let Operand::Held(..) = value {
            let mut lines = Vec::new();
            write::copy_bytes(&value, "acc", 4, &mut lines);
            lines.iter().for_each(|line| text.line(line));
            value = Operand::At("acc".to_owned());
        }
        let bytes = match plan.format(id) {
            Format::Bool => 1,
            Format::Log { .. } => 3,
            format => write::size(format).max(4),
        };
        for k in 0..reported(plan.format(id)) as u8 {
            let byte = match k < bytes {
                true => write::byte(&value, k),
                false => "#0".to_owned(),
            };
            text.code(&format!("lda {byte} | sta ink_port"));
        }
    }
}
