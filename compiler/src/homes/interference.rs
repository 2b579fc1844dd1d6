//! Interference graph: which values may share a variable, for targets where a copy costs much.
//!
//! Two places interfere where one is written while the other is alive
//! ([`crate::homes::liveness`]), unless it is written as a copy of the other; places between
//! which a value is copied become one where they do not interfere (Chaitin,
//! Register Allocation and Spilling via Graph Coloring, SIGPLAN 1982). So a value is
//! computed where it would be copied to, and the copy is none.

use crate::analysis::region::{Fact, implied};
use crate::homes::liveness::{Flow, Set, Step};
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use crate::targets::Language;
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::{Format, Op};

/// The variables of places.
#[derive(Clone, Debug, Default)]
pub struct Homes {
    /// For each place, the number of its variable, among those of its format.
    pub number: FxHashMap<Place, usize>,
    /// The places that are one because of a copy: for each, the first of them that the scene has
    /// a name for, or else the first.
    pub one: FxHashMap<Place, Place>,
}

/// Where a result may be written where an operand is read.
#[derive(Clone, Copy)]
pub enum InPlace<'w> {
    /// Where one is a copy of the other: an expression is computed before it is assigned.
    Copies,
    /// Where what computes a value reads all of its first operand, and of its second, that it
    /// reads behind what it has written of the result.
    Where(&'w dyn Fn(NodeId) -> [bool; 2]),
}

/// The variables of a plan's places, as few as are easily found.
pub fn homes(plan: &Plan, in_place: InPlace<'_>) -> Homes {
    let flow = Flow::of(plan);
    let places = flow.places.len();
    let mut meets = flow.meets();
    // What may not share a variable beside: operands are read before a result is
    // written, but not all of a statement's text is that careful.
    let mut close = Interference::new(places);
    let copied = flow.copied();
    for step in &flow.steps {
        let Some(written) = step.writes else { continue };
        let mut safe = None;
        for &read in &step.reads {
            if read == written || step.copies == Some(read) {
                continue;
            }
            let both = copied.has(read) && copied.has(written);
            let is_safe = both && {
                let safe = safe.get_or_insert_with(|| flow.safe(step, in_place));
                safe.contains(&read)
            };
            if !is_safe {
                close.add(written, read);
            }
        }
    }
    let mut classes = Classes::new(places, matches!(in_place, InPlace::Copies));
    for step in flow.by_frequency() {
        if let (Some(to), Some(from)) = (step.writes, step.copies) {
            let formats = [to, from].map(|place| flow.format(place));
            if formats[0] == formats[1] {
                classes.join(to, from, [&mut meets, &mut close]);
            }
        }
    }
    // The smaller of two is the first of them, unless the other is.
    for step in &flow.steps {
        let Some(to) = step.writes else { continue };
        for from in flow.of_extreme(to).into_iter().flatten() {
            if flow.format(to) == flow.format(from) {
                classes.join(to, from, [&mut meets, &mut close]);
            }
        }
    }
    flow.coloured(&mut classes, &meets, &close)
}

impl Flow<'_> {
    /// Which places interfere. What is asked of a pixel more than once comes out the
    /// same each time: places that meet on neither of the two ways do not, if they are
    /// the pixel's own. At the next pixel it may come out in another way.
    fn meets(&self) -> Interference {
        let mut all = self.meet_where(&[Vec::new()]);
        let mut own = Set::new(self.places.len());
        let inside = |place: &usize| self.span[*place].0 >= self.pixel;
        (0..self.places.len())
            .filter(inside)
            .for_each(|place| own.add(place));
        for cond in self.asked_again() {
            let ways = [true, false].map(|holds| implied(&self.plan.graph, cond, holds));
            all.keep(&self.meet_where(&ways), &own);
        }
        all
    }

    /// The places that are copied, or copies.
    fn copied(&self) -> Set {
        let mut all = Set::new(self.places.len());
        for step in &self.steps {
            if let (Some(to), Some(from)) = (step.writes, step.copies) {
                all.add(to);
                all.add(from);
            }
        }
        all
    }

    /// The places that a step reads of which none is read behind a part of its result: those
    /// that it reads once, as its operands.
    fn safe(&self, step: &Step, in_place: InPlace<'_>) -> Vec<usize> {
        let (InPlace::Where(is_safe), Some(id)) = (in_place, step.computes) else {
            return Vec::new();
        };
        let Node::Apply(op, args) = self.plan.graph.node(id) else {
            return Vec::new();
        };
        let operands = args.iter().zip(is_safe(id)).take(op.arity());
        let places = operands.map(|(arg, safe)| {
            let place = self.plan.place(*arg).and_then(|place| self.known(place));
            (place, safe)
        });
        let places: Vec<(Option<usize>, bool)> = places.collect();
        let safe = |place: usize| places.iter().all(|(p, safe)| *p != Some(place) || *safe);
        let own = |place: usize| {
            let times = places.iter().filter(|(p, _)| *p == Some(place)).count();
            step.reads.iter().filter(|read| **read == place).count() == times
        };
        let all = places.iter().filter_map(|(place, _)| *place);
        all.filter(|place| safe(*place) && own(*place)).collect()
    }

    /// The steps, those first that are carried out most often as far as loops and choices
    /// around them tell: a loop is taken for eight choices.
    fn by_frequency(&self) -> impl Iterator<Item = &Step> {
        let often = |(at, step): (usize, &Step)| {
            let around = self
                .loops
                .iter()
                .filter(|(first, last)| (*first..=*last).contains(&at));
            8 * around.count() as i64 - i64::from(step.choices)
        };
        let mut order: Vec<(i64, &Step)> = (self.steps.iter().enumerate())
            .map(|(at, step)| (often((at, step)), step))
            .collect();
        order.sort_by_key(|(often, _)| std::cmp::Reverse(*often));
        order.into_iter().map(|(_, step)| step)
    }

    /// The places of what a value is the smaller or larger of: in BASIC of both, as either may
    /// be written over, if the first is no expression.
    fn of_extreme(&self, place: usize) -> [Option<usize>; 2] {
        let Place::Node(id) = self.places[place] else {
            return [None; 2];
        };
        let Node::Apply(Op::Min | Op::Max | Op::IntMin | Op::IntMax, [first, second]) =
            self.plan.graph.node(id)
        else {
            return [None; 2];
        };
        let known = |id: NodeId| self.known(self.plan.place(id)?);
        let either = self.plan.target.system.language() == Language::Basic
            && (self.plan.graph.constant(first).is_some() || !self.plan.folded(first));
        [known(first), known(second).filter(|_| either)]
    }

    /// Which places interfere in one of some cases.
    fn meet_where(&self, cases: &[Vec<Fact>]) -> Interference {
        let mut meets = Interference::new(self.places.len());
        for case in cases {
            let (alive, reached) = (self.alive(case), self.reached(case));
            // What no step writes that is come to is read by none either, whatever it looks
            // like: that takes other conditions, which follow from this one.
            let mut set = Set::new(self.places.len());
            let steps = self.steps.iter().zip(&reached);
            let steps = steps.filter_map(|(step, reached)| step.writes.filter(|_| *reached));
            steps.for_each(|place| set.add(place));
            let steps = self.steps.iter().zip(alive).zip(reached);
            for ((step, mut others), _) in steps.filter(|(_, reached)| *reached) {
                let Some(written) = step.writes else { continue };
                others.keep_all(&set);
                others.remove(written);
                step.copies.iter().for_each(|from| others.remove(*from));
                meets.0[written].add_all(&others);
            }
        }
        meets.both_ways();
        meets
    }

    /// Whether the scene has a name for what a place holds.
    fn is_named(&self, place: usize) -> bool {
        match self.places[place] {
            Place::Node(id) => self.plan.graph.names.contains_key(&id),
            Place::Carried(..) => true,
            Place::Scratch(..) => false,
        }
    }

    /// A variable for each class of places: the first that none has with which
    /// one of its places interferes.
    fn coloured(&self, classes: &mut Classes, meets: &Interference, close: &Interference) -> Homes {
        let mut order: Vec<usize> = (0..self.places.len()).collect();
        // Stable: places that begin together stay in the order of their writing.
        // What is likely to be written where it is read comes last.
        let folded = |place: usize| match self.places[place] {
            Place::Node(id) => self.plan.folded(id),
            _ => false,
        };
        order.sort_by_key(|place| (folded(*place), self.span[*place].0));
        let mut homes = Homes::default();
        let mut named: FxHashMap<usize, Place> = FxHashMap::default();
        for place in &order {
            if self.is_named(*place) {
                let one = classes.of(*place);
                named.entry(one).or_insert(self.places[*place]);
            }
        }
        let mut given: Vec<Option<usize>> = vec![None; self.places.len()];
        let formats: Vec<Format> = (0..given.len()).map(|place| self.format(place)).collect();
        for place in order {
            let one = classes.of(place);
            let of_class = named.get(&one).copied().unwrap_or(self.places[one]);
            homes.one.insert(self.places[place], of_class);
            let number = given[one].unwrap_or_else(|| {
                let taken: FxHashSet<usize> = (meets.0[one].iter().chain(close.0[one].iter()))
                    .filter(|class| formats[*class] == formats[one])
                    .filter_map(|class| given[class])
                    .collect();
                (0..).find(|number| !taken.contains(number)).unwrap_or(0)
            });
            given[one] = Some(number);
            homes.number.insert(self.places[place], number);
        }
        homes
    }
}

/// Which classes of places may not be one, by the first of their places.
struct Interference(Vec<Set>);

impl Interference {
    fn new(places: usize) -> Interference {
        Interference(vec![Set::new(places); places])
    }

    fn add(&mut self, a: usize, b: usize) {
        self.0[a].add(b);
        self.0[b].add(a);
    }

    /// What was noted of one of two for both.
    fn both_ways(&mut self) {
        for place in 0..self.0.len() {
            let others = std::mem::replace(&mut self.0[place], Set::new(0));
            others.iter().for_each(|other| self.0[other].add(place));
            self.0[place] = others;
        }
    }

    fn between(&self, a: usize, b: usize) -> bool {
        self.0[a].has(b)
    }

    /// Keeps between some places what others have, too.
    fn keep(&mut self, other: &Interference, among: &Set) {
        for (place, (set, other)) in self.0.iter_mut().zip(&other.0).enumerate() {
            if among.has(place) {
                set.keep(other, among);
            }
        }
    }

    /// What interferes with one of two interferes with both together.
    fn join(&mut self, one: usize, other: usize) {
        for place in self.0[other].clone().iter() {
            self.add(one, place);
        }
    }
}

/// Places that became one.
struct Classes {
    /// For each place another one of its class, for the first of them itself.
    first: Vec<usize>,
    /// Whether a copy may be one with what it is read with.
    may_be_close: bool,
}

impl Classes {
    fn new(places: usize, may_be_close: bool) -> Classes {
        Classes {
            first: (0..places).collect(),
            may_be_close,
        }
    }

    fn of(&self, mut place: usize) -> usize {
        while self.first[place] != place {
            place = self.first[place];
        }
        place
    }

    /// Makes one class of two, if they do not interfere: the first of `all` says which are
    /// alive together, the second which are read where the other is written.
    fn join(&mut self, a: usize, b: usize, all: [&mut Interference; 2]) {
        let (a, b) = (self.of(a), self.of(b));
        let (one, other) = (a.min(b), a.max(b));
        let apart = all[0].between(one, other) || !self.may_be_close && all[1].between(one, other);
        if one == other || apart {
            return;
        }
        self.first[other] = one;
        all.into_iter().for_each(|meets| meets.join(one, other));
    }
}
