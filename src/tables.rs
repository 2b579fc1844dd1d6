//! What tables take of a machine's memory.

use slowlight_compiler::ir::graph::{Node, TableId};
use slowlight_compiler::ir::tree::Place;
use slowlight_compiler::plan::Plan;
use slowlight_routine::Format;
use std::collections::BTreeSet;

/// Bytes of the tables that a plan looks into, as its machine holds them.
pub fn table_bytes(plan: &Plan) -> u64 {
    let bytes = |format: Format| match format {
        Format::Real40 => 5,
        // An object of three words or four.
        Format::Float316 { .. } | Format::Float416 => 2 * u64::from(format.words()),
        // A logarithm and a sign.
        Format::Log { .. } => 4,
        Format::Int { bits } | Format::Fixed { bits, .. } | Format::Scaled { bits } => {
            u64::from(bits.div_ceil(8))
        }
        Format::Bool => match plan.runtime.int {
            Format::Int { bits } => u64::from(bits.div_ceil(8)),
            _ => 1,
        },
    };
    let graph = &plan.graph;
    let used: BTreeSet<TableId> = plan
        .places()
        .into_iter()
        .filter_map(|(place, _)| match place {
            Place::Node(id) => match graph.node(id) {
                Node::Lookup { table, .. } => Some(table),
                _ => None,
            },
            _ => None,
        })
        .collect();
    used.into_iter()
        .filter_map(|t| graph.tables.get(t.0 as usize))
        .map(|t| t.entries.len() as u64 * bytes(plan.runtime.format_of(t.ty)))
        .sum()
}
