//! Entries of tables.

use super::code::Code;
use super::expression::Expression;
use crate::ir::graph::*;
use slowlight_routine::Range;
use slowlight_runtime_jack::{SUM, TERM};

impl Code<'_> {
    /// An entry of a table, its indices clamped where the ranges do not prove them inside.
    pub fn entry(&mut self, lookup: NodeId, id: TableId, [column, row]: [NodeId; 2]) -> Expression {
        let [columns, rows] = self.plan.ranges.args[lookup.0 as usize];
        let Some(table) = self.plan.graph.tables.get(id.0 as usize) else {
            return Expression::term("0");
        };
        let (width, height) = (table.width, table.height);
        let name = self.names.table(self.plan, id);
        let column = self.index(column, columns, width);
        let at = match (width, height) {
            (_, 1) => column,
            (1, _) => self.index(row, rows, height),
            _ => {
                let row = self.index(row, rows, height).at(TERM);
                let text = format!("({row} * {width}) + {}", column.at(TERM));
                Expression { text, level: SUM }
            }
        };
        Expression::term(format!("{name}[{}]", at.text))
    }

    fn index(&mut self, id: NodeId, range: Range, n: u32) -> Expression {
        let index = self.read(id);
        if range.within(0.0, f64::from(n) - 1.0) {
            return index;
        }
        let last = n.saturating_sub(1);
        Expression::term(format!("Math.max(0, Math.min({last}, {}))", index.text))
    }
}
