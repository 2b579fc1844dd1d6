//! Demand-driven evaluation: a stack of what is to be computed next, and in which lanes.

use super::lanes::{Lanes, Mask};
use super::plan::{Move, Source, Task};
use super::{ALL, Native};
use crate::analysis::rate::Dependence;
use crate::ir::graph::*;
use crate::ir::ramp;
use slowlight_routine::{Type, Value};

impl Native<'_> {
    /// Computes a node in the lanes of the mask.
    pub(super) fn need(&mut self, root: u32, mask: Mask) {
        let base = self.stack.len();
        self.stack.push((root, mask));
        while self.stack.len() > base {
            let Some(&(id, want)) = self.stack.last() else {
                return;
            };
            let Some(&step) = self.plan.steps.get(id as usize) else {
                self.stack.pop();
                continue;
            };
            let mut todo = want & !self.known[id as usize];
            if step.uniform {
                todo = Mask::from(todo != 0);
            }
            if todo == 0 {
                self.stack.pop();
            } else if self.step(&step.task, step.ty, step.slot, todo) {
                self.known[id as usize] |= todo;
                if step.uniform {
                    self.lanes.spread(step.ty, step.slot);
                    self.known[id as usize] = ALL;
                }
                self.stack.pop();
            }
        }
    }

    /// Whether a value is known in the lanes of the mask; else it is to be
    /// computed next.
    fn ask(&mut self, source: Source, mask: Mask) -> bool {
        let missing = mask & !self.known[source.node as usize];
        if missing != 0 {
            self.stack.push((source.node, missing));
        }
        missing == 0
    }

    /// Computes some lanes of a node if all that they need is known; else what
    /// they need is pushed on the stack.
    fn step(&mut self, task: &Task, ty: Type, slot: u32, mask: Mask) -> bool {
        match *task {
            Task::Given => {}
            Task::Apply { op, args: [a, b] } => {
                if !(self.ask(a, mask) & self.ask(b, mask)) {
                    return false;
                }
                self.lanes.apply(op, [a.slot, b.slot], slot, mask);
                self.operations += u64::from(mask.count_ones());
            }
            Task::Select { cond, yes, no } => {
                if !self.ask(cond, mask) {
                    return false;
                }
                let holds = self.lanes.truth(cond.slot);
                if !self.choose(holds, [yes, no], (ty, slot), mask) {
                    return false;
                }
                self.operations += u64::from(mask.count_ones());
            }
            Task::Lookup { table, column, row } => {
                if !(self.ask(column, mask) & self.ask(row, mask)) {
                    return false;
                }
                self.look_up(table, [column.slot, row.slot], (ty, slot), mask);
                self.operations += u64::from(mask.count_ones());
            }
            Task::Ramp(number) => {
                if !self.ask_ramp(number, mask) {
                    return false;
                }
                self.ramp(number, slot, mask);
                self.operations += u64::from(mask.count_ones());
            }
            Task::Result {
                of,
                done,
                otherwise,
            } => {
                let missing = mask & !self.known[self.plan.ran(of)];
                if missing != 0 {
                    if !self.ask_start(of, missing) {
                        return false;
                    }
                    self.run(of, missing);
                }
                let ended = self.done[of as usize];
                return self.choose(ended, [done, otherwise], (ty, slot), mask);
            }
        }
        true
    }

    /// One value where a bool holds, another where it does not.
    fn choose(
        &mut self,
        holds: Mask,
        [yes, no]: [Source; 2],
        (ty, slot): (Type, u32),
        mask: Mask,
    ) -> bool {
        if !(self.ask(yes, mask & holds) & self.ask(no, mask & !holds)) {
            return false;
        }
        self.lanes.copy(ty, yes.slot, slot, mask & holds);
        self.lanes.copy(ty, no.slot, slot, mask & !holds);
        true
    }

    fn look_up(
        &mut self,
        table: u32,
        [column, row]: [u32; 2],
        (ty, slot): (Type, u32),
        mask: Mask,
    ) {
        let Some(table) = self.graph.tables.get(table as usize) else {
            return;
        };
        let mut rest = mask;
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize;
            let at = [column, row].map(|slot| self.lanes.get(Type::Int, slot, lane).int());
            self.lanes.set(ty, slot, lane, table.at(at[0], at[1]));
            rest &= rest - 1;
        }
    }

    /// Whether all that a ramp depends on is known; else it is to be computed next.
    fn ask_ramp(&mut self, number: u32, mask: Mask) -> bool {
        let mut known = true;
        for k in 0..self.plan.ramps[number as usize].parts.len() {
            let part = self.plan.ramps[number as usize].parts[k];
            known &= self.ask(part, mask);
        }
        known
    }

    fn ramp(&mut self, number: u32, slot: u32, mask: Mask) {
        let mut rest = mask;
        while rest != 0 {
            let lane = rest.trailing_zeros();
            let ramp = &self.plan.ramps[number as usize];
            let parts: Vec<i32> = (ramp.parts.iter())
                .map(|part| self.lanes.get(Type::Int, part.slot, lane as usize).int())
                .collect();
            let column = self.columns[lane as usize];
            let value = ramp::at(column.div_euclid(ramp.stride), &parts);
            self.lanes
                .set(Type::Int, slot, lane as usize, Value::Int(value));
            rest &= rest - 1;
        }
    }

    /// Whether a loop's start values are known; else they are to be computed next.
    fn ask_start(&mut self, of: u32, mask: Mask) -> bool {
        let Native {
            plan, known, stack, ..
        } = self;
        let before = stack.len();
        for &node in &plan.loops[of as usize].init {
            let missing = mask & !known[node as usize];
            if missing != 0 {
                stack.push((node, missing));
            }
        }
        stack.len() == before
    }

    /// Runs a loop to its end in the lanes of the mask, its start values being
    /// known; its carried values stay as each lane's last turn has them.
    fn run(&mut self, of: u32, mask: Mask) {
        let at = of as usize;
        let (uniform, max) = (self.plan.loops[at].uniform, self.plan.loops[at].max);
        let again = self.plan.loops[at].again;
        let lanes = if uniform { ALL } else { mask };
        let mut active = lanes;
        self.done[at] &= !lanes;
        carry(&mut self.lanes, &self.plan.loops[at].start, active);
        for _ in 0..max {
            self.forget(Dependence::Loop(LoopId(of)), active);
            self.operations += if uniform {
                1
            } else {
                u64::from(active.count_ones())
            };
            self.need(again.node, active);
            let goes_on = active & self.lanes.truth(again.slot);
            self.done[at] |= active & !goes_on;
            active = goes_on;
            if active == 0 {
                break;
            }
            for k in 0..self.plan.loops[at].next.len() {
                let node = self.plan.loops[at].next[k];
                self.need(node, active);
            }
            carry(&mut self.lanes, &self.plan.loops[at].shift, active);
            if self.spent() {
                break;
            }
        }
        if active != 0 {
            self.forget(Dependence::Last(LoopId(of)), active);
        }
        let ran = self.plan.ran(of);
        self.known[ran] |= lanes;
    }
}

/// Gives a loop's carried values other ones, all at once.
fn carry(lanes: &mut Lanes, moves: &[Move], mask: Mask) {
    for m in moves {
        if let Some(via) = m.via {
            lanes.copy(m.ty, m.from, via, mask);
        }
    }
    for m in moves {
        lanes.copy(m.ty, m.via.unwrap_or(m.from), m.to, mask);
    }
}
