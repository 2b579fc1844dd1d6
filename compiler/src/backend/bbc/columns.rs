//! Arrays by columns: filled before the first row, read in pixels.

use super::code::Code;
use crate::ir::graph::*;
use crate::ir::tree::tabulated;
use crate::plan::Plan;

/// How often a column's statements are carried out, beside those of the picture: about.
const COLUMN: u64 = 8;

/// Makes the arrays.
pub fn make(plan: &Plan, code: &mut Code<'_>) {
    let found = tabulated(&plan.graph, &plan.tree);
    if found.is_empty() {
        return;
    }
    let last = plan.graph.image.width.saturating_sub(1);
    let array = |code: &Code<'_>, id: NodeId| code.values.names.column(id).to_owned();
    let all: Vec<String> = (found.iter())
        .map(|id| format!("{}({last})", array(code, *id)))
        .collect();
    code.statement(format!("DIM {}", all.join(",")));
}

/// Fills them.
pub fn fill(plan: &Plan, code: &mut Code<'_>) {
    if tabulated(&plan.graph, &plan.tree).is_empty() {
        return;
    }
    let weight = std::mem::replace(&mut code.lines.weight, COLUMN);
    let (from, to) = plan.computed_columns();
    code.line(format!("FOR X%={from} TO {to}"));
    code.block(&plan.tree.column);
    code.line("NEXT");
    code.lines.weight = weight;
}
