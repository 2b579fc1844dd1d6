//! Live intervals: homes shared by values that are never alive together.
//!
//! The statements are numbered as they are written down; a place is alive from
//! its first writing to its last reading. A loop runs its statements again, so
//! what was written before its body and is read inside it stays alive to its
//! end. What the frame or a row computes for others stays alive throughout; what
//! is read only in the block that computes it, to its last reading. Calls count as
//! what they run: a subroutine's own places are alive from its first call to
//! its last, and every other place that is alive during a call keeps clear of them.
//!
//! [`crate::homes::liveness`] does the same with more care.

use crate::homes::coalesce::merged;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use rustc_hash::FxHashMap;
use slowlight_routine::Format;

/// From the first writing to the last reading, as numbers of statements.
#[derive(Clone, Copy, Debug)]
struct Life {
    from: usize,
    to: usize,
}

struct Lives<'p> {
    plan: &'p Plan,
    now: usize,
    lives: FxHashMap<Place, Life>,
    /// For places that are one home for more than their lives: which one.
    merged: FxHashMap<Place, Place>,
    /// Bodies of loops, inner ones first.
    bodies: Vec<Life>,
}

/// For each place, the number of the home that it shares with others of its
/// format; numbers begin at 0 for each format.
pub fn shared_homes(plan: &Plan) -> FxHashMap<Place, usize> {
    let mut lives = Lives {
        plan,
        now: 0,
        lives: FxHashMap::default(),
        merged: merged(plan),
        bodies: Vec::new(),
    };
    lives.block(&plan.tree.frame);
    // The numbers of the last statements of the frame, the column, the row and a pass.
    let frame = lives.now;
    lives.block(&plan.tree.column);
    let column = lives.now;
    lives.block(&plan.tree.row);
    let row = lives.now;
    lives.block(&plan.tree.pass);
    let pass = lives.now;
    lives.block(&plan.tree.segment);
    if let Some(still) = &plan.still {
        lives.now += 1;
        still.reads(&plan.graph).for_each(|id| lives.read(id));
    }
    // The number of the last statement before the pixel's.
    let pixel = lives.now;
    lives.block(&plan.tree.pixel);
    lives.read(plan.graph.ink);
    plan.graph.left_to_others().for_each(|id| lives.read(id));
    lives.block(&plan.tree.step);
    plan.graph.reports.iter().for_each(|&id| lives.read(id));
    lives.steps();
    lives.extend();
    let end = lives.now + 1;
    let mut all: Vec<(Place, Format)> = plan.places();
    all.retain(|(place, _)| !lives.merged.contains_key(place));
    let ends = [(0, frame), (frame, column), (column, row), (row, pass)];
    let life = |place: &Place| match lives.lives.get(place) {
        Some(life) if life.from > pixel => *life,
        // What the frame, the row or a pass computes for itself alone.
        Some(life)
            if ends
                .iter()
                .any(|(from, to)| life.from > *from && life.to <= *to) =>
        {
            *life
        }
        _ => Life { from: 0, to: end },
    };
    // Stable: places that begin together stay in the order of their writing.
    all.sort_by_key(|(place, _)| life(place).from);
    let mut free_from: FxHashMap<Format, Vec<usize>> = FxHashMap::default();
    let mut homes = FxHashMap::default();
    for (place, format) in all {
        let Life { from, to } = life(&place);
        let taken = free_from.entry(format).or_default();
        let free = taken.iter().position(|end| *end < from);
        let at = free.unwrap_or_else(|| {
            taken.push(0);
            taken.len() - 1
        });
        if let Some(end) = taken.get_mut(at) {
            *end = to;
        }
        homes.insert(place, at);
    }
    for (&place, &one) in &lives.merged {
        if let Some(&at) = homes.get(&one) {
            homes.insert(place, at);
        }
    }
    homes
}

impl Lives<'_> {
    fn touch(&mut self, place: Place) {
        let now = self.now;
        let place = self.merged.get(&place).copied().unwrap_or(place);
        let life = self.lives.entry(place);
        life.or_insert(Life { from: now, to: now }).to = now;
    }

    /// Reads a value; what it is written from too, where it may be written here.
    fn read(&mut self, id: NodeId) {
        let Some(place) = self.plan.place(id) else {
            return;
        };
        self.touch(place);
        if self.plan.folded(id) {
            let operands = self.plan.graph.node(id).inputs();
            operands.for_each(|operand| self.read(operand));
        }
    }

    fn block(&mut self, block: &[Statement]) {
        for statement in block {
            self.now += 1;
            match statement {
                Statement::Let(id) => {
                    let operands = self.plan.graph.node(*id).inputs();
                    operands.for_each(|operand| self.read(operand));
                    self.touch(Place::of(&self.plan.graph, *id));
                }
                Statement::Set { place, from } => {
                    match *from {
                        Origin::Node(id) => self.read(id),
                        Origin::Scratch(l, k) => self.touch(Place::Scratch(l, k)),
                    }
                    self.touch(*place);
                }
                Statement::If { cond, yes, no } => {
                    self.read(*cond);
                    self.block(yes);
                    self.block(no);
                }
                Statement::Loop(turns) => self.turns(turns),
                Statement::Call(id) => self.block(self.plan.tree.body(*id)),
            }
        }
    }

    /// Ramps are stepped at the end of every pixel, read or not.
    fn steps(&mut self) {
        for (id, step) in self.plan.ramps() {
            self.touch(Place::Node(id));
            self.read(step);
        }
    }

    fn turns(&mut self, turns: &Turns) {
        self.block(&turns.start);
        self.now += 1;
        let from = self.now;
        self.block(&turns.body);
        self.now += 1;
        self.read(turns.again);
        self.block(&turns.next);
        self.now += 1;
        self.bodies.push(Life { from, to: self.now });
        self.block(&turns.done);
        self.block(&turns.otherwise);
    }

    /// What enters a loop's body alive, or is set for its next turn, stays so
    /// to the body's end.
    fn extend(&mut self) {
        let bodies = &self.bodies;
        for life in self.lives.values_mut() {
            for body in bodies {
                if life.from < body.from && life.to >= body.from {
                    life.to = life.to.max(body.to);
                }
            }
        }
    }
}
