//! What values come to under conditions that they were computed without: forward propagation,
//! once conditions have narrowed what the values are made of. Where a loop goes on only while
//! it is not too far, the distance from there is no longer than from there.

use super::Walk;
use crate::ir::graph::*;
use crate::ir::interval::interval;
use crate::ir::tree::Place;
use slowlight_routine::Range;

/// How many values are computed again for one that is asked for.
const MOST: usize = 300;

/// How many in all: each arm of each turn asks anew.
const IN_ALL: u64 = 60_000;

/// How deep the last of these lie.
const DEEP: u32 = 48;

/// What was computed again since conditions last changed.
#[derive(Default)]
pub(super) struct Fresh {
    /// Values, each with the time at which it was computed.
    of: Vec<(u64, Range)>,
    /// The time: what was computed before is forgotten.
    now: u64,
    /// How many values are known.
    known: usize,
    /// How many were computed in all.
    computed: u64,
    /// The least node that conditions have narrowed: no node before it hangs on one.
    first: Option<NodeId>,
}

impl Fresh {
    /// Forgets all of it.
    pub(super) fn clear(&mut self) {
        if self.first.is_some() {
            self.first = None;
            self.known = 0;
            self.now += 1;
        }
    }

    fn get(&self, id: NodeId) -> Option<Range> {
        let (time, range) = self.of.get(id.0 as usize)?;
        (*time == self.now).then_some(*range)
    }

    fn insert(&mut self, id: NodeId, range: Range) {
        let at = id.0 as usize;
        if self.of.len() <= at {
            self.of.resize(at + 1, (u64::MAX, Range::ALL));
        }
        self.of[at] = (self.now, range);
        self.known += 1;
        self.computed += 1;
    }
}

impl Walk<'_> {
    /// Whether what a place is given is worth computing again: where it makes what a loop
    /// carries grow, or is to narrow it.
    pub(super) fn looks_closely(&self, place: Place, from: NodeId) -> bool {
        let carried = match place {
            _ if self.narrowing || self.growth.is_some() => return true,
            Place::Carried(of, k) | Place::Scratch(of, k) => Some((of, k)),
            Place::Node(id) => self.once.gives(id),
        };
        carried.is_some_and(|(of, k)| {
            let (held, now) = (self.carried_range(of, k), self.read(from));
            !now.within(held.lo, held.hi)
        })
    }

    /// What a value comes to here.
    pub(super) fn fresh(&mut self, id: NodeId) -> Range {
        let done = self.saved.is_empty() || self.fresh.computed > IN_ALL;
        if done || !self.slack.inverts() {
            return self.read(id);
        }
        if self.fresh.first.is_none() {
            self.fresh.first = self.saved.iter().map(|(id, _)| *id).min();
        }
        let most = self.fresh.known + MOST;
        self.computed_again(id, DEEP, most)
    }

    /// Whether several calls of a subroutine compute a value, or give it: by now it may be
    /// another call's than the one that what it is part of was computed from.
    fn is_shared(&self, id: NodeId) -> bool {
        self.shared[id.0 as usize].is_some()
    }

    fn computed_again(&mut self, id: NodeId, deep: u32, most: usize) -> Range {
        let held = self.read(id);
        let known = Some(id) < self.fresh.first || self.is_shared(id);
        if deep == 0 || known || held.lo == held.hi || self.fresh.known > most {
            return held;
        }
        if let Some(range) = self.fresh.get(id) {
            return range;
        }
        let made = match self.graph.node(id) {
            Node::Apply(_, of) if of.iter().any(|id| self.is_shared(*id)) => held,
            Node::Apply(op, operands) => {
                let args = operands.map(|id| self.computed_again(id, deep - 1, most));
                let exact = interval(op, args, operands[0] == operands[1]);
                held.meet(self.slack.rounded(op, &args[..op.arity()], exact))
            }
            Node::Select { yes, no, .. } if self.is_shared(yes) || self.is_shared(no) => held,
            Node::Select { yes, no, .. } => {
                let arms = [yes, no].map(|id| self.computed_again(id, deep - 1, most));
                held.meet(arms[0].join(arms[1]))
            }
            _ => return held,
        };
        self.walked += 1;
        self.fresh.insert(id, made);
        made
    }
}
