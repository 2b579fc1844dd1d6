//! Range analysis of fixed-point values: what the walk does beside where reals have points of
//! their own, and where these are being planned ([`crate::wordlength`]).

use super::Walk;
use crate::analysis::carried::held_by;
use crate::ir::graph::*;
use crate::ir::tree::*;
use slowlight_routine::{Op, Range, Type, Value};
use std::collections::BTreeSet;

impl Walk<'_> {
    /// What a table's entries stay within, as a lookup has them that may read those of such
    /// columns and rows.
    pub(super) fn entries(&self, id: NodeId, table: TableId, [columns, rows]: [Range; 2]) -> Range {
        let table = self.graph.tables.get(table.0 as usize);
        let held = |value: Value| match (&self.slack.points, value) {
            (Some(points), Value::Real(real)) => points.nearest(id, real),
            // As it is held, where all reals have one point.
            _ => self.slack.constant(value),
        };
        let values = table.into_iter().flat_map(|t| {
            let all = t.within((columns.lo, columns.hi), (rows.lo, rows.hi));
            all.map(|at| held(t.entries[at].value()))
        });
        let all = values.reduce(Range::join).unwrap_or(Range::ALL);
        match table.is_some_and(|t| !t.seed.is_empty()) {
            true => self.slack.entry(all),
            false => all,
        }
    }

    /// The ranges of an operation's operands as they are read, and whether both are one value.
    pub(super) fn operands(&self, id: NodeId, op: Op, [a, b]: [NodeId; 2]) -> ([Range; 2], bool) {
        let mut args = [self.read(a), self.read(b)];
        let Some(points) = &self.slack.points else {
            return (args, a == b);
        };
        for (k, arg) in args.iter_mut().enumerate().take(op.arity()) {
            *arg = points.operand(self.graph, id, k, *arg);
        }
        let [to_a, to_b] = points.scales(id).args;
        (args, a == b && to_a == to_b)
    }

    /// The range of what a place is given.
    pub(super) fn given(&self, place: Place, from: Origin, range: Range) -> Range {
        match (&self.slack.points, from) {
            (Some(points), Origin::Node(id)) => points.copied(self.graph, place, id, range),
            (None, _) if self.slack.expects() => match held_by(&self.readers, place) {
                Some(id) => self.slack.expected(id, range),
                None => range,
            },
            _ => range,
        }
    }

    /// Widens what a condition has narrowed, all that was saved but for so many before: it
    /// compares what was rounded.
    pub(super) fn doubted(&mut self, saved: usize, cond: NodeId, holds: bool) {
        let Some(points) = &self.slack.points else {
            return;
        };
        let find = || points.doubt(self.graph, cond, holds);
        let doubt = self.once.doubt((cond, holds), find);
        if doubt == 0.0 {
            return;
        }
        let mut seen = BTreeSet::new();
        let narrowed = self.saved[saved..].iter();
        for (id, before) in narrowed.filter(|(id, _)| seen.insert(*id)) {
            let now = &mut self.now[id.0 as usize];
            let doubt = match self.graph.ty(*id) {
                Type::Int => doubt.ceil(),
                _ => doubt,
            };
            let wide = Range {
                nonzero: now.nonzero,
                ..Range::new(now.lo - doubt, now.hi + doubt)
            };
            *now = before.meet(wide);
        }
    }
}
