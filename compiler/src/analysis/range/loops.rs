//! Loops in the walk that finds ranges: turn by turn until nothing grows, then by widening
//! (Cousot and Cousot, Abstract interpretation, POPL 1977), then by knowing nothing.

use super::Walk;
use super::accelerate::{Carried, contains, join};
use crate::ir::graph::*;
use crate::ir::tree::*;
use slowlight_routine::{Op, Range, Value};

/// How many turns of loops are walked before bounds that still grow are widened.
const PATIENCE: u32 = 2000;

/// How many statements are walked before that is done whatever the turns.
const SOON: u64 = 100_000;

/// How many statements are walked before loops are walked once, with nothing known of what
/// they carry. Loops inside each other multiply, each walked until its bounds hold: in a nest
/// of six the innermost is walked hundreds of times, however soon bounds are widened.
pub(super) const STATEMENTS: u64 = 4_000_000;

/// How many turns of a loop are walked before what more turns add is looked at.
const FEW: u32 = 4;

/// How many are walked before what is not known to be bounded by then has no bounds.
const MANY: u32 = 64;

impl Walk<'_> {
    pub(super) fn run_loop(&mut self, turns: &Turns) {
        let of = turns.of;
        let at = of.0 as usize;
        self.block(&turns.start);
        let start = self.carried[at].clone();
        if !self.holds_still(turns, &start) {
            self.grow(turns, &start);
        }
        self.heads[at] = Some(self.carried[at].clone());
        self.arm(turns.again, false, &turns.done);
        let ended = self.sets(&turns.done);
        let left = self.left_where(turns);
        self.block(&turns.otherwise);
        self.ended[at] = self.or_used_up(left);
        for (place, range) in ended {
            let both = self.place_range(place).join(range);
            self.write(place, both);
        }
    }

    /// Tries the bounds that held when the loop was walked last, in another turn of a loop
    /// around it: where that grows, these mostly hold again, and loops in each other take
    /// a few turns each instead of many times as many at each depth. Where bounds are narrowed
    /// that would find none that are nearer.
    fn holds_still(&mut self, turns: &Turns, start: &Carried) -> bool {
        let at = turns.of.0 as usize;
        let Some(mut head) = self.heads[at].clone() else {
            return false;
        };
        if self.narrowing || !self.slack.inverts() || self.walked > STATEMENTS {
            return false;
        }
        for (head, start) in head.iter_mut().zip(start) {
            *head = join(*head, *start);
        }
        self.carried[at].clone_from(&head);
        self.turn(turns);
        let holds = (head.iter().zip(&self.carried[at])).all(|(head, now)| contains(*head, *now));
        match holds {
            true => self.narrow(turns, start, head),
            false => self.carried[at].clone_from(start),
        }
        holds
    }

    /// Walks turns until what they carry stays within bounds.
    fn grow(&mut self, turns: &Turns, start: &Carried) {
        let of = turns.of;
        let at = of.0 as usize;
        let max = self.graph.loops[at].max;
        let mut widened = false;
        for turn in 1.. {
            let last = self.walked > STATEMENTS;
            if last {
                self.forget_carried(of);
            }
            let before = self.carried[at].clone();
            self.turn(turns);
            self.join_carried(at, &before);
            if last {
                break;
            }
            // After `max` turns the bounds hold all that the loop can carry,
            // whether or not they would grow in one more.
            if self.carried[at] == before || turn > max {
                if widened {
                    let head = self.carried[at].clone();
                    self.turn(turns);
                    self.narrow(turns, start, head);
                }
                break;
            }
            self.turns += 1;
            let tired = self.turns > PATIENCE || self.walked > SOON;
            let open = tired && !widened || turn == MANY;
            let again = open || turn == FEW;
            if again && turn < max && self.accelerate(turns, start, open) {
                break;
            }
            // What is walked as often as it turns needs no wider bounds.
            if (tired || turn >= MANY) && turn < max {
                self.widen(of, &before);
                widened = true;
            }
        }
    }

    /// Walks one turn, from what is carried now.
    pub(super) fn turn(&mut self, turns: &Turns) {
        let of = turns.of;
        self.fresh.clear();
        for k in 0..self.once.carried(of).len() {
            let (id, index) = self.once.carried(of)[k];
            self.put(id, self.in_turn(of, (id, index)));
        }
        // What it gives on is looked at below, if it is walked twice.
        let nested = self.slack.inverts()
            && turns.body.iter().any(has_loop)
            && !turns.next.iter().any(has_loop);
        let growth = if nested { self.growth.take() } else { None };
        self.block(&turns.body);
        if !nested {
            return self.arm(turns.again, true, &turns.next);
        }
        self.growth = growth;
        let closer = self.closer_where(turns);
        match closer.is_empty() {
            true => self.arm(turns.again, true, &turns.next),
            false => self.turn_that_goes_on(turns, &closer),
        }
    }

    /// What a carried value may be in a turn: one that counts them has not counted the last.
    fn in_turn(&self, of: LoopId, (id, index): (NodeId, u32)) -> Range {
        let all = self.carried_range(of, index);
        let turns = &self.graph.loops[of.0 as usize];
        let int = |id: &NodeId| match self.graph.constant(*id) {
            Some(Value::Int(int)) => Some(f64::from(int)),
            _ => None,
        };
        let step = |next: &NodeId| match self.graph.node(*next) {
            Node::Apply(Op::IntAdd, [now, by]) if now == id => int(&by),
            _ => None,
        };
        let first = turns.init.get(index as usize).and_then(int);
        let step = turns.next.get(index as usize).and_then(step);
        match first.zip(step) {
            Some((first, step)) => {
                let last = first + step * f64::from(turns.max - 1);
                all.meet(Range::new(first.min(last), first.max(last)))
            }
            None => all,
        }
    }

    /// What a turn carries, of those that go on, where that is closer than of all.
    fn closer_where(&mut self, turns: &Turns) -> Vec<(NodeId, Range)> {
        self.under((turns.again, true), |walk| {
            let carried = walk.once.carried(turns.of).iter();
            let closer = carried.filter_map(|&(id, index)| {
                let (all, now) = (walk.in_turn(turns.of, (id, index)), walk.read(id));
                (now != all && now.lo <= now.hi).then_some((id, now))
            });
            closer.collect()
        })
    }

    /// Walks a turn with nothing but what those carry that go on: that tells what loops inside
    /// of it come to there, as they would not be walked again by [`Walk::fresh`]. What was found
    /// of all turns stands as it was.
    fn turn_that_goes_on(&mut self, turns: &Turns, closer: &[(NodeId, Range)]) {
        let now = self.now.clone();
        let found = (self.out.clone(), self.once.found());
        let loops = (self.ended.clone(), self.heads.clone());
        let mut own = Vec::new();
        walk(&turns.next, &mut |statement| match *statement {
            Statement::Let(id)
            | Statement::Set {
                place: Place::Node(id),
                ..
            } => own.push(id),
            _ => {}
        });
        for &(id, range) in closer {
            self.put(id, range);
        }
        self.block(&turns.body);
        self.arm(turns.again, true, &turns.next);
        self.now = now;
        (self.ended, self.heads) = loops;
        // What only turns compute that go on stays as it is.
        let (went_on, memo) = (std::mem::replace(&mut self.out, found.0), self.once.found());
        self.once.put_back(found.1);
        for id in own {
            self.out.copy(&went_on, id);
            self.once.put_back_of(&memo, id);
        }
        self.fresh.clear();
    }

    fn join_carried(&mut self, at: usize, held: &[Option<Range>]) {
        for (now, held) in self.carried[at].iter_mut().zip(held) {
            *now = match (*now, *held) {
                (Some(a), Some(b)) => Some(a.join(b)),
                (a, b) => a.or(b),
            };
        }
    }

    /// Gives what a loop carries the bounds of its format.
    fn forget_carried(&mut self, of: LoopId) {
        let at = of.0 as usize;
        let slack = self.slack;
        let types = self.graph.loops[at].types.iter();
        let all = types.map(|ty| Some(slack.cut(*ty, Range::ALL)));
        self.carried[at] = all.collect();
    }

    /// Moves every bound that still grows to the format's end.
    fn widen(&mut self, of: LoopId, before: &[Option<Range>]) {
        for (k, before) in before.iter().enumerate() {
            let now = self.carried[of.0 as usize][k];
            if before.is_some() {
                self.carried[of.0 as usize][k] = self.opened(of, k, *before, now);
            }
        }
    }
}

/// Whether a statement is a loop or has one, as subroutines may.
fn has_loop(statement: &Statement) -> bool {
    match statement {
        Statement::Loop(_) | Statement::Call(_) => true,
        Statement::If { yes, no, .. } => yes.iter().chain(no).any(has_loop),
        _ => false,
    }
}
