//! Comparisons, left in the carry, and where those of a column end a run.

use super::code::Code;
use super::shapes::by_range;
use super::slots::Slot;
use crate::ir::graph::*;
use slowlight_routine::{Op, Routine};
use slowlight_runtime_6502::write::{self, Goal, Place as Operand};

impl Code<'_> {
    /// Ends the run before a comparison with the column changes, if the node is one.
    pub(super) fn end_run(&mut self, id: NodeId) {
        if !self.in_run || !self.homes.bounds.contains(&id) {
            return;
        }
        let Node::Apply(op, [a, b]) = self.plan.graph.node(id) else {
            return;
        };
        let first = self.plan.graph.node(a) == Node::Axis(Axis::X);
        let read = |id| self.homes.operand(self.plan, id);
        let (x, column) = match first {
            true => (read(a), read(b)),
            false => (read(b), read(a)),
        };
        // x < c and c <= x change at c, the others behind it.
        let before = (op == Op::IntLess) == first;
        let end = self.homes.name(Slot::RunEnd).to_owned();
        let held = match by_range(self.plan) {
            true => self.homes.run_end(self.plan),
            false => Operand::At(end.clone()),
        };
        let n = self.text.next_serial();
        let orders = match before {
            true => [Op::IntLess, Op::IntLessEqual],
            false => [Op::IntLessEqual, Op::IntLess],
        };
        let pairs = [[x, column.clone()], [column.clone(), held]];
        for (op, pair) in orders.into_iter().zip(pairs) {
            self.ordered(op, &pair);
            self.text.code(&format!("bcc run{n}"));
        }
        let [lo, hi] = [0, 1].map(|k| write::byte(&column, k));
        self.text.code(&match before {
            true => {
                format!("lda {lo} | sec | sbc #1 | sta {end} | lda {hi} | sbc #0 | sta {end}+1")
            }
            false => format!("lda {lo} | sta {end} | lda {hi} | sta {end}+1"),
        });
        self.text.label(&format!("run{n}"));
    }

    /// A comparison of any ints, left in the carry.
    fn ordered(&mut self, op: Op, args: &[Operand]) {
        let general = |r: &&Routine| {
            let all = slowlight_routine::Range::ALL;
            r.op == op && (r.domain)(&[all, all], all)
        };
        if let Some(routine) = self.plan.runtime.routines.iter().find(general) {
            self.use_of(routine, args, &Goal::Carry, 0);
        }
    }

    /// A comparison, left in the carry.
    pub(super) fn compare(&mut self, id: NodeId) {
        if let (Node::Apply(_, args), Some(routine)) =
            (self.plan.graph.node(id), self.plan.routine(id))
        {
            let args = self.read_all(id, args);
            let args = args.get(..routine.args.len()).unwrap_or_default();
            self.use_of(routine, args, &Goal::Carry, 0);
        }
    }
}
