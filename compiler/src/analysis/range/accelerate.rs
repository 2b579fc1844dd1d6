//! Acceleration of loops: where a turn adds to a carried value what stays between bounds, `max`
//! turns add no more than `max` times as much (Gonnord and Halbwachs, Combining widening and
//! acceleration in linear relation analysis, SAS 2006). The bounds that follow are assumed and
//! one turn is walked with them; they hold if no turn then adds more, or gives a value anew
//! that lies outside of what was given before. Turns walked with bounds that hold narrow them.

use super::Walk;
use crate::ir::graph::*;
use crate::ir::interval::interval;
use crate::ir::tree::*;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Range, Type};

/// How often bounds are assumed before the walk goes on turn by turn.
const TRIES: u32 = 5;

/// How many turns are walked to narrow bounds that hold.
const NARROWING: u32 = 2;

/// How many sums and choices are looked through for what a turn adds.
const DEEP: u32 = 6;

/// A loop's carried values, each as far as it is known.
pub(super) type Carried = Vec<Option<Range>>;

/// What a turn gives to a carried value.
#[derive(Clone, Copy, Default)]
struct Given {
    /// What is given anew.
    anew: Option<Range>,
    /// What is added to what it was.
    added: Option<Range>,
}

/// What a turn of a loop gives to its carried values, while it is walked.
pub(super) struct Growth {
    of: LoopId,
    /// Bounds by carried value: what leaves these is looked at as a sum, if it is one.
    base: Carried,
    given: Vec<Given>,
    /// The choices that a carried value's next one is made by, and which value's.
    choices: FxHashMap<NodeId, Vec<usize>>,
    /// Those whose arms were met in this turn.
    met: Vec<NodeId>,
}

pub(super) fn join(all: Option<Range>, more: Option<Range>) -> Option<Range> {
    match (all, more) {
        (Some(a), Some(b)) => Some(a.join(b)),
        (a, b) => a.or(b),
    }
}

/// Whether what is known holds what comes after.
pub(super) fn contains(known: Option<Range>, next: Option<Range>) -> bool {
    match (known, next) {
        (Some(known), Some(next)) => {
            next.within(known.lo, known.hi) && (next.nonzero || !known.nonzero)
        }
        (_, next) => next.is_none(),
    }
}

impl Growth {
    fn new(graph: &Graph, of: LoopId, base: Carried) -> Growth {
        let mut choices: FxHashMap<NodeId, Vec<usize>> = FxHashMap::default();
        for (k, &next) in graph.loops[of.0 as usize].next.iter().enumerate() {
            let mut todo = vec![next];
            while let Some(id) = todo.pop() {
                if let Node::Select { yes, no, .. } = graph.node(id) {
                    let of = choices.entry(id).or_default();
                    if !of.contains(&k) {
                        of.push(k);
                        todo.extend([yes, no]);
                    }
                }
            }
        }
        Growth {
            of,
            given: vec![Given::default(); base.len()],
            base,
            choices,
            met: Vec::new(),
        }
    }
}

impl Walk<'_> {
    /// Notes what a turn gives to the carried values of a loop that is accelerated.
    pub(super) fn note_growth(&mut self, place: Place, from: Origin) {
        let Some(mut growth) = self.growth.take() else {
            return;
        };
        let slots = match place {
            Place::Carried(of, k) | Place::Scratch(of, k) if of == growth.of => vec![k as usize],
            Place::Node(id) => growth.choices.get(&id).cloned().unwrap_or_default(),
            _ => Vec::new(),
        };
        if let (Place::Node(id), false) = (place, slots.is_empty()) {
            growth.met.push(id);
        }
        if let Origin::Node(id) = from
            && !growth.met.contains(&id)
        {
            for k in slots {
                let anew = self.fresh(id);
                let added = self.increment((growth.of, k as u32), id, DEEP);
                let given = &mut growth.given[k];
                match added {
                    Some(by) if !contains(growth.base[k], Some(anew)) => {
                        given.added = join(given.added, Some(by));
                    }
                    _ => given.anew = join(given.anew, Some(anew)),
                }
            }
        }
        self.growth = Some(growth);
    }

    /// One turn, and what it gives.
    fn growing_turn(&mut self, turns: &Turns, base: &Carried) -> Vec<Given> {
        let around = self.growth.take();
        self.growth = Some(Growth::new(self.graph, turns.of, base.clone()));
        self.turn(turns);
        let found = std::mem::replace(&mut self.growth, around);
        found.map_or_else(Vec::new, |growth| growth.given)
    }

    /// Bounds that hold for what a loop carries in any of its turns, found from what the turns
    /// until now have carried; where `open`, those that nothing bounds have their format's.
    /// Whether there are such; the turn that was walked last had them.
    pub(super) fn accelerate(&mut self, turns: &Turns, start: &Carried, open: bool) -> bool {
        if !self.slack.inverts() {
            return false;
        }
        let at = turns.of.0 as usize;
        let met = self.carried[at].clone();
        let types = &self.graph.loops[at].types;
        let mut base: Carried = (met.iter().enumerate())
            .map(|(k, met)| match (types[k], start[k]) {
                // A counter ends where it is compared with something, or counts all turns.
                (Type::Int, Some(first)) => Some(self.once.thresholds((turns.of, k as u32), first)),
                _ => *met,
            })
            .collect();
        let mut added: Carried = vec![None; base.len()];
        let heads = self.heads.clone();
        for turn in 0..TRIES {
            let head: Option<Carried> = (0..base.len())
                .map(|k| match (base[k], added[k]) {
                    (Some(first), Some(by)) => self.after(turns.of, k, first, by).map(Some),
                    (known, _) => Some(known),
                })
                .collect();
            let Some(head) = head else { break };
            self.carried[at].clone_from(&head);
            let given = self.growing_turn(turns, &base);
            let holds = (given.iter().enumerate())
                .all(|(k, now)| contains(base[k], now.anew) && contains(added[k], now.added));
            if holds {
                self.narrow(turns, start, head);
                return true;
            }
            for (k, now) in given.iter().enumerate() {
                let wider = join(base[k], now.anew);
                base[k] = match open && turn > 0 && wider != base[k] {
                    true => self.opened(turns.of, k, base[k], wider),
                    false => wider,
                };
                added[k] = join(added[k], now.added);
            }
        }
        self.carried[at] = met;
        self.heads = heads;
        false
    }

    /// Walks turns with bounds that hold, each of which may leave less of them.
    pub(super) fn narrow(&mut self, turns: &Turns, start: &Carried, mut head: Carried) {
        let at = turns.of.0 as usize;
        let around = std::mem::replace(&mut self.narrowing, true);
        for _ in 0..NARROWING {
            let after = std::mem::take(&mut self.carried[at]);
            let less: Carried = (0..head.len())
                .map(|k| match (head[k], start[k], after[k]) {
                    (Some(head), Some(first), Some(after)) => Some(head.meet(first.join(after))),
                    (head, ..) => head,
                })
                .collect();
            let same = less == head;
            head.clone_from(&less);
            self.carried[at] = less;
            if same {
                break;
            }
            self.turn(turns);
        }
        self.narrowing = around;
        self.carried[at] = head;
    }

    /// By how much a value is above a loop's carried one, which it is made of by sums.
    fn increment(&mut self, carried: (LoopId, u32), id: NodeId, deep: u32) -> Option<Range> {
        let deep = deep.checked_sub(1)?;
        match self.graph.node(id) {
            Node::Carried { of, index } => ((of, index) == carried).then_some(Range::point(0.0)),
            Node::Apply(op @ (Op::Add | Op::IntAdd), [a, b]) => {
                let (first, by) = match self.increment(carried, a, deep) {
                    Some(first) => (first, b),
                    None => (self.increment(carried, b, deep)?, a),
                };
                Some(interval(op, [first, self.fresh(by)], false))
            }
            Node::Apply(op @ (Op::Sub | Op::IntSub), [a, b]) => {
                let first = self.increment(carried, a, deep)?;
                Some(interval(op, [first, self.fresh(b)], false))
            }
            Node::Select { yes, no, .. } => {
                let yes = self.increment(carried, yes, deep)?;
                Some(yes.join(self.increment(carried, no, deep)?))
            }
            _ => None,
        }
    }

    /// What a carried value stays within where each of all turns adds so much, with what
    /// roundings may add.
    fn after(&self, of: LoopId, k: usize, first: Range, by: Range) -> Option<Range> {
        let turns = &self.graph.loops[of.0 as usize];
        let (ty, times) = (turns.types[k], f64::from(turns.max));
        let lo = first.lo + times * by.lo.min(0.0);
        let hi = first.hi + times * by.hi.max(0.0);
        if !lo.is_finite() || !hi.is_finite() {
            return None;
        }
        let held = match ty {
            Type::Real => self.with_roundings(Range::new(lo, hi), times * f64::from(DEEP))?,
            _ => Range::new(lo, hi),
        };
        let cut = self.slack.cut(ty, held);
        (cut.lo == held.lo && cut.hi == held.hi).then_some(held)
    }

    /// A sum with what so many roundings add to it, each of one that may be twice as large.
    fn with_roundings(&self, sum: Range, times: f64) -> Option<Range> {
        let twice = Range::new(2.0 * sum.lo.min(0.0), 2.0 * sum.hi.max(0.0));
        let wide = self.slack.enlarge(Op::Add, &[twice, twice], twice);
        let off = times * (twice.lo - wide.lo).max(wide.hi - twice.hi);
        if off > sum.magnitude() {
            return None;
        }
        // Roundings that are parts of sums do not lead across 0.
        let parts = Range::new(0.0, 1.0);
        let keeps = self.slack.enlarge(Op::Add, &[parts, parts], parts).lo == 0.0;
        let (lo, hi) = (sum.lo - off, sum.hi + off);
        Some(Range::new(
            if keeps && sum.lo >= 0.0 {
                lo.max(0.0)
            } else {
                lo
            },
            if keeps && sum.hi <= 0.0 {
                hi.min(0.0)
            } else {
                hi
            },
        ))
    }

    /// The format's ends, where a carried value has left its bounds.
    pub(super) fn opened(
        &self,
        of: LoopId,
        k: usize,
        before: Option<Range>,
        now: Option<Range>,
    ) -> Option<Range> {
        let (now, before) = (now?, before.or(now)?);
        let lo = if now.lo < before.lo {
            f64::NEG_INFINITY
        } else {
            now.lo
        };
        let hi = if now.hi > before.hi {
            f64::INFINITY
        } else {
            now.hi
        };
        let ty = self.graph.loops[of.0 as usize].types[k];
        let open = Range {
            nonzero: now.nonzero,
            ..Range::new(lo, hi)
        };
        Some(self.slack.cut(ty, open))
    }
}
