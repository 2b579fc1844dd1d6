//! Tabulation of integer division: quotients and remainders of an int of few values by a constant
//! become tables.
//!
//! Machines without division take hundreds of cycles for one, whatever is divided. What is divided
//! is often a pixel's column or row, or what is left of one, which has no more values than a table
//! may have entries. (Granlund and Montgomery, Division by Invariant Integers using Multiplication,
//! 1994, is the way where products are cheap.)

use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use slowlight_routine::{Op, Runtime, Type, Value};

/// How many entries a table may have.
const MOST: f64 = 512.0;

/// The graph with such tables; nothing where there are none.
pub fn quotient_tables(graph: &Graph, ranges: &Ranges, _: &Runtime) -> Option<Graph> {
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let Node::Apply(op @ (Op::IntDiv | Op::IntMod), [a, b]) = graph.node(id) else {
            return None;
        };
        // By a power of two machines shift.
        let by = graph
            .constant(b)
            .filter(|by| !by.int().unsigned_abs().is_power_of_two())?;
        let [range, _] = ranges.args.get(id.0 as usize)?;
        let of = made.get(a.0 as usize).copied().flatten()?;
        // From 0 on nothing is to be taken off for its place.
        let first = match range.lo >= 0.0 && range.hi < MOST {
            true => 0.0,
            false => range.lo,
        };
        let few = range.hi - first < MOST;
        if !few || graph.constant(a).is_some() {
            return None;
        }
        done = true;
        let values = first as i32..=range.hi as i32;
        let entries = values.map(|a| Constant::new(op.eval(&[Value::Int(a), by])));
        Some(read(
            builder,
            op,
            entries.collect(),
            (of, first as i32),
            span,
        ))
    });
    done.then_some(next)
}

/// What stands in a table at an int, the first entry being for another.
fn read(
    builder: &mut Builder,
    op: Op,
    entries: Vec<Constant>,
    (of, first): (NodeId, i32),
    span: Span,
) -> NodeId {
    let name = match op {
        Op::IntDiv => "quotient",
        _ => "remainder",
    };
    let table = builder.table(Table {
        name: name.to_owned(),
        width: u32::try_from(entries.len()).unwrap_or(u32::MAX),
        height: 1,
        ty: Type::Int,
        entries,
        seed: Vec::new(),
    });
    let column = match first {
        0 => of,
        _ => {
            let first = builder.constant(Value::Int(first), span);
            builder.apply(Op::IntSub, &[of, first], span)
        }
    };
    let row = builder.constant(Value::Int(0), span);
    builder.lookup(table, column, row, span)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::loops::drawn::{analysed, shades};
    use slowlight_runtime_6502::scaled::FIXED16;

    /// How many entries the tables have that an int is given, and whether it is the same by them.
    fn tables(int: &str) -> Option<Vec<usize>> {
        let source = format!(
            "image 24 x 16 inks black, white; draw (x, y) = threshold(({int}) / 2.0, 0.5);"
        );
        let plain = analysed(&source, &FIXED16);
        let next = quotient_tables(&plain.graph, &plain.ranges, &FIXED16)?;
        assert_eq!(shades(&plain.graph), shades(&next), "{source}");
        Some(
            next.tables
                .iter()
                .map(|table| table.entries.len())
                .collect(),
        )
    }

    #[test]
    fn quotients_of_few_values_are_looked_up() {
        assert_eq!(tables("x div 3"), Some(vec![24]));
        assert_eq!(tables("(x - 100) mod 7"), Some(vec![24]));
        assert_eq!(tables("(x - 9) div -5 + y mod 3"), Some(vec![24, 16]));
        assert_eq!(tables("(x + 5 * y) mod 11"), Some(vec![99]));
    }

    #[test]
    fn others_stay() {
        assert_eq!(tables("(x * y * y) div 7"), None);
        assert_eq!(tables("x div (y + 1)"), None);
        assert_eq!(tables("x div 4"), None);
    }
}
