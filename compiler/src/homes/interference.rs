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
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::{Format, Op};

/// The variables of places.
#[derive(Clone, Debug, Default)]
pub struct Homes {
    /// For each place, the number of its variable, among those of its format.
    pub number: FxHashMap<Place, usize>,
    /// The places that are one because of a copy: for each, the first of them.
    pub one: FxHashMap<Place, Place>,
}

/// The variables of a plan's places, as few as are easily found.
pub fn quick_homes(plan: &Plan) -> Homes {
    let flow = Flow::of(plan);
    let places = flow.places.len();
    let mut meets = flow.meets();
    // What may not share a variable beside: operands are read before a result is
    // written, but not all of a statement's text is that careful.
    let mut close = Interference::new(places);
    for step in &flow.steps {
        let Some(written) = step.writes else { continue };
        for &read in &step.reads {
            if read != written && step.copies != Some(read) {
                close.add(written, read);
            }
        }
    }
    let mut classes = Classes::new(places);
    for step in flow.by_frequency() {
        if let (Some(to), Some(from)) = (step.writes, step.copies) {
            let formats = [to, from].map(|place| flow.format(place));
            if formats[0] == formats[1] {
                classes.join(to, from, &mut [&mut meets, &mut close]);
            }
        }
    }
    // The smaller of two is the first of them, unless the other is.
    for step in &flow.steps {
        if let Some(to) = step.writes
            && let Some(from) = flow.first_of_extreme(to)
            && flow.format(to) == flow.format(from)
        {
            classes.join(to, from, &mut [&mut meets, &mut close]);
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

    /// The place of the first operand of what is the smaller or larger of two.
    fn first_of_extreme(&self, place: usize) -> Option<usize> {
        let Place::Node(id) = self.places[place] else {
            return None;
        };
        let Node::Apply(Op::Min | Op::Max | Op::IntMin | Op::IntMax, [first, _]) =
            self.plan.graph.node(id)
        else {
            return None;
        };
        self.known(self.plan.place(first)?)
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
        let mut given: Vec<Option<usize>> = vec![None; self.places.len()];
        let formats: Vec<Format> = (0..given.len()).map(|place| self.format(place)).collect();
        for place in order {
            let one = classes.of(place);
            homes.one.insert(self.places[place], self.places[one]);
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
struct Classes(Vec<usize>);

impl Classes {
    fn new(places: usize) -> Classes {
        Classes((0..places).collect())
    }

    fn of(&self, mut place: usize) -> usize {
        while self.0[place] != place {
            place = self.0[place];
        }
        place
    }

    /// Makes one class of two, if the first of what they have says that they do
    /// not interfere.
    fn join(&mut self, a: usize, b: usize, all: &mut [&mut Interference]) {
        let (a, b) = (self.of(a), self.of(b));
        let (one, other) = (a.min(b), a.max(b));
        if one == other || all[0].between(one, other) {
            return;
        }
        self.0[other] = one;
        all.iter_mut().for_each(|meets| meets.join(one, other));
    }
}
