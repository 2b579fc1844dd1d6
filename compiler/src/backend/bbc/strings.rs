//! Tables of small whole numbers as strings, whose characters are the entries.

use super::expression::Expressions;
use super::text::Text;
use crate::ir::graph::{Node, NodeId, TableId};
use crate::plan::Plan;
use slowlight_routine::{Range, Type, Value};
use slowlight_runtime_bbc::level::{OPERAND, POWER, PRODUCT, SUM};

/// A string on a line of its own has room for its quotes and what reads it.
const LONGEST: usize = 200;

/// What a string's name begins with until it is written.
pub const NAME: &str = "string_";

/// The bytes that end a line and a string.
const NEVER: [u8; 2] = [13, 34];

/// A table as a string.
pub struct Letters {
    /// A byte an entry.
    pub bytes: Vec<u8>,
    /// An entry is its byte less this, divided by `scale`.
    pub less: u32,
    pub scale: u32,
}

/// How a table is written as a string, if it is.
pub fn string(plan: &Plan, id: TableId) -> Option<Letters> {
    let table = plan.graph.tables.get(id.0 as usize)?;
    // Of some tables others are made.
    let plain = |k: usize| {
        let made = plan.table(TableId(k as u32));
        made.is_none_or(|made| made.recipe.is_none())
    };
    let mut all = 0..plan.graph.tables.len();
    if !plan.toot || !all.all(plain) || table.entries.len() > LONGEST || table.ty == Type::Bool {
        return None;
    }
    let whole = |scale: u32| -> Option<Vec<u32>> {
        let entry = |entry: &crate::ir::graph::Constant| {
            let x = match entry.value() {
                Value::Int(n) => f64::from(n),
                other => other.real(),
            } * f64::from(scale);
            (x.fract() == 0.0 && (0.0..256.0).contains(&x)).then_some(x as u32)
        };
        table.entries.iter().map(entry).collect()
    };
    let scales = match table.ty {
        Type::Real => 0..=6,
        _ => 0..=0,
    };
    let (scale, entries) = scales
        .map(|k| 1u32 << k)
        .find_map(|s| Some((s, whole(s)?)))?;
    let fits = |less: &u32| {
        let byte = |entry: &u32| u8::try_from(entry + less).ok();
        let mut bytes = entries.iter().map(byte);
        bytes.all(|b| b.is_some_and(|b| !NEVER.contains(&b)))
    };
    // A whole unit that is taken away again is exact.
    let less = (0..4).map(|k| k * scale.max(16)).find(fits)?;
    Some(Letters {
        bytes: entries.iter().map(|e| (e + less) as u8).collect(),
        less,
        scale,
    })
}

/// All tables' strings, by their numbers.
pub fn texts(plan: &Plan) -> Vec<Option<Vec<u8>>> {
    let tables = 0..plan.graph.tables.len();
    tables
        .map(|k| Some(string(plan, TableId(k as u32))?.bytes))
        .collect()
}

impl Expressions<'_> {
    /// What reads an entry of a table that is a string.
    pub(super) fn in_string(
        &mut self,
        table: TableId,
        [column, row]: [NodeId; 2],
        inside: [Range; 2],
    ) -> Option<Text> {
        let letters = string(self.plan, table)?;
        let of = self.plan.graph.tables.get(table.0 as usize)?;
        let (width, height) = (of.width, of.height);
        let mut terms = vec!["1".to_owned()];
        if height > 1 {
            let row = self.place(row, inside[1], height, width);
            terms.push(row);
        }
        if width > 1 {
            terms.push(self.place(column, inside[0], width, 1));
        }
        let text = format!("ASC MID$({NAME}{},{})", table.0, terms.join("+"));
        let text = match letters.scale {
            1 => text,
            scale => format!("{text}/{scale}"),
        };
        Some(match (letters.less / letters.scale, letters.scale) {
            (0, 1) => Text::new(text, OPERAND),
            (0, _) => Text::new(text, PRODUCT),
            (less, _) => Text::new(format!("{text}-{less}"), SUM),
        })
    }

    /// How far an index goes in a string.
    fn place(&mut self, id: NodeId, range: Range, length: u32, by: u32) -> String {
        let index = self.index(id, range, length);
        // `column MOD 4` and the like are masks, which bind less than sums.
        match (by, self.plan.graph.node(id)) {
            (1, Node::Axis(_)) => index.text,
            (1, _) => index.at(SUM),
            (by, _) => format!("{by}*{}", index.at(POWER)),
        }
    }
}
