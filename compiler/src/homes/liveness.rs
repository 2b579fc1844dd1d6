//! Liveness analysis: what is still to be read behind each of a plan's statements.
//!
//! The statements are laid out as a graph of control flow, rows, passes and runs
//! as the loops that they are, and it is found out by iteration which places hold
//! what is still to be read (Aho, Lam, Sethi and Ullman, Compilers, 2nd edition,
//! 9.2.5).
//!
//! What is written under a condition and read under one that implies it would be
//! alive on ways that never come about, round and round; so a place counts
//! as alive only between its first writing and its last reading in the text,
//! as far as it does not go round a loop.

use crate::analysis::region::Fact;
use crate::homes::single_use::is_kept;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use rustc_hash::FxHashMap;
use slowlight_routine::Format;

/// How many conditions are looked at both ways, at most: each only sets more apart. Of a large
/// program as many as so many pairs of a step and a place allow.
const CASES: usize = 24;
const PAIRS: usize = 300_000_000;

/// One statement, or a part of one.
#[derive(Default)]
pub struct Step {
    pub reads: Vec<usize>,
    pub writes: Option<usize>,
    /// The place that it copies.
    pub copies: Option<usize>,
    /// The value that it computes.
    pub computes: Option<NodeId>,
    /// Where control goes on beside the next step.
    jumps: Vec<usize>,
    /// Whether it does not go on to the next step.
    ends: bool,
    /// The condition by which it goes on to the next step, or jumps.
    asks: Option<NodeId>,
    /// How many choices it stands in.
    pub choices: u32,
}

/// A plan's statements as a graph of control flow.
pub struct Flow<'p> {
    pub plan: &'p Plan,
    pub places: Vec<Place>,
    numbers: FxHashMap<Place, usize>,
    pub steps: Vec<Step>,
    /// The steps of each loop, from its first to its last, inner ones first.
    pub loops: Vec<(usize, usize)>,
    /// How many choices the step that is made stands in.
    choices: u32,
    /// The first step of a pixel.
    pub pixel: usize,
    /// The first writing of each place and its last reading.
    pub span: Vec<(usize, usize)>,
}

impl<'p> Flow<'p> {
    pub fn of(plan: &'p Plan) -> Flow<'p> {
        let mut flow = Flow {
            plan,
            places: Vec::new(),
            numbers: FxHashMap::default(),
            steps: Vec::new(),
            loops: Vec::new(),
            choices: 0,
            pixel: 0,
            span: Vec::new(),
        };
        let tree = &plan.tree;
        flow.block(&tree.frame);
        let column = flow.step();
        flow.block(&tree.column);
        let next = flow.step();
        flow.steps[next].jumps.push(column);
        flow.loops.push((column, next));
        let mut tops = Vec::new();
        for block in [&tree.row, &tree.pass, &tree.segment] {
            tops.push(flow.step());
            flow.block(block);
        }
        let asked = flow.step();
        let still = plan.still.iter().flat_map(|still| still.reads(&plan.graph));
        still.for_each(|id| flow.reads(asked, id));
        flow.pixel = flow.step();
        flow.block(&tree.pixel);
        let graph = &plan.graph;
        let last = flow.step();
        graph.roots().for_each(|id| flow.reads(last, id));
        let stepped = flow.step();
        flow.steps[asked].jumps.push(stepped);
        flow.ramps();
        let end = flow.step();
        for top in [flow.pixel].into_iter().chain(tops.into_iter().rev()) {
            flow.steps[end].jumps.push(top);
            flow.loops.push((top, end));
        }
        // Behind the picture.
        if !tree.step.is_empty() {
            flow.block(&tree.step);
            let last = flow.step();
            (graph.reports.iter()).for_each(|&id| flow.reads(last, id));
        }
        flow.spans();
        flow
    }

    fn step(&mut self) -> usize {
        self.steps.push(Step {
            choices: self.choices,
            ..Step::default()
        });
        self.steps.len() - 1
    }

    fn number(&mut self, place: Place) -> usize {
        let places = &mut self.places;
        *self.numbers.entry(place).or_insert_with(|| {
            places.push(place);
            places.len() - 1
        })
    }

    /// The number of a place that is read or written.
    pub fn known(&self, place: Place) -> Option<usize> {
        self.numbers.get(&place).copied()
    }

    pub fn format(&self, place: usize) -> Format {
        self.plan.place_format(self.places[place])
    }

    /// Reads a value; what it is written from too, where it may be written here.
    fn reads(&mut self, at: usize, id: NodeId) {
        let Some(place) = self.plan.place(id) else {
            return;
        };
        let place = self.number(place);
        self.steps[at].reads.push(place);
        if self.plan.folded(id) && !is_kept(self.plan, id) {
            let operands = self.plan.graph.node(id).inputs();
            operands.for_each(|operand| self.reads(at, operand));
        }
    }

    fn block(&mut self, block: &'p [Statement]) {
        for statement in block {
            let at = self.step();
            match statement {
                Statement::Let(id) => {
                    let operands = self.plan.graph.node(*id).inputs();
                    operands.for_each(|operand| self.reads(at, operand));
                    let place = Place::of(&self.plan.graph, *id);
                    self.steps[at].writes = Some(self.number(place));
                    self.steps[at].computes = Some(*id);
                }
                Statement::Set { place, from } => {
                    match *from {
                        Origin::Node(id) => self.reads(at, id),
                        Origin::Scratch(l, k) => {
                            let scratch = self.number(Place::Scratch(l, k));
                            self.steps[at].reads.push(scratch);
                        }
                    }
                    let step = &self.steps[at];
                    let copies = (step.reads.len() == 1).then(|| step.reads[0]);
                    self.steps[at].copies = copies;
                    self.steps[at].writes = Some(self.number(*place));
                }
                Statement::If { cond, yes, no } => {
                    self.reads(at, *cond);
                    self.steps[at].asks = Some(*cond);
                    self.choices += 1;
                    self.block(yes);
                    let behind = self.step();
                    self.steps[behind].ends = true;
                    let other = self.step();
                    self.steps[at].jumps.push(other);
                    self.block(no);
                    self.choices -= 1;
                    let join = self.step();
                    self.steps[behind].jumps.push(join);
                }
                Statement::Loop(turns) => self.turns(turns, at),
                Statement::Call(id) => self.block(self.plan.tree.body(*id)),
            }
        }
    }

    fn turns(&mut self, turns: &'p Turns, top: usize) {
        self.block(&turns.start);
        let first = self.step();
        debug_assert!(top < first);
        self.block(&turns.body);
        let asked = self.step();
        self.reads(asked, turns.again);
        self.block(&turns.next);
        let last = self.step();
        self.steps[last].jumps.push(first);
        self.loops.push((first, last));
        self.block(&turns.otherwise);
        let behind = self.step();
        self.steps[behind].ends = true;
        let done = self.step();
        self.steps[asked].jumps.push(done);
        self.block(&turns.done);
        let end = self.step();
        self.steps[behind].jumps.push(end);
    }

    /// Ramps are stepped at the end of every pixel, read or not.
    fn ramps(&mut self) {
        for (id, by) in self.plan.ramps() {
            let at = self.step();
            self.reads(at, by);
            let place = self.number(Place::Node(id));
            self.steps[at].reads.push(place);
            self.steps[at].writes = Some(place);
        }
    }

    /// Between which steps each place may hold something.
    fn spans(&mut self) {
        let mut span = vec![(usize::MAX, 0); self.places.len()];
        for (at, step) in self.steps.iter().enumerate() {
            for place in step.reads.iter().chain(&step.writes).copied() {
                let (from, to) = span[place];
                span[place] = (from.min(at), to.max(at));
            }
        }
        // What enters a loop alive, or is set for its next turn, stays so.
        for (from, to) in &mut span {
            for (first, last) in &self.loops {
                if *from < *first && *to >= *first {
                    *to = (*to).max(*last);
                }
            }
        }
        self.span = span;
    }

    /// Conditions of a pixel, computed in no loop, that are asked more than once.
    /// None where pixels call subroutines: what they ask is another thing in each call.
    pub fn asked_again(&self) -> Vec<NodeId> {
        if self.plan.calls_at_pixels() {
            return Vec::new();
        }
        let (mut asked, mut again) = (Vec::new(), Vec::new());
        for step in &self.steps[self.pixel..] {
            match step.asks {
                Some(cond) if again.contains(&cond) => {}
                Some(cond) if asked.contains(&cond) => again.push(cond),
                Some(cond) => asked.push(cond),
                None => {}
            }
        }
        let inside = |at: usize| {
            self.loops
                .iter()
                .any(|(from, to)| *from > self.pixel && (*from..=*to).contains(&at))
        };
        again.retain(|cond| {
            let place = self
                .plan
                .place(*cond)
                .and_then(|place| self.numbers.get(&place));
            let writes = |step: &Step| step.writes.as_ref() == place;
            let at = |at: usize| place.is_some() && writes(&self.steps[at]) && inside(at);
            !(0..self.steps.len()).any(at)
        });
        let pairs = self.steps.len() * self.places.len();
        again.truncate(CASES.min(PAIRS / pairs.max(1)));
        again
    }

    /// The steps behind a step, where conditions hold or do not.
    fn next(&self, at: usize, case: &[Fact]) -> impl Iterator<Item = usize> {
        let step = &self.steps[at];
        let known = case.iter().find(|(cond, _)| step.asks == Some(*cond));
        let known = known.map(|(_, holds)| *holds);
        let falls = !step.ends && at + 1 < self.steps.len();
        let falls = falls && known.is_none_or(|holds| holds);
        let jumps = known.is_none_or(|holds| !holds);
        let jumps = step.jumps.iter().copied().filter(move |_| jumps);
        jumps.chain(falls.then_some(at + 1))
    }

    /// The steps that are come to.
    pub fn reached(&self, case: &[Fact]) -> Vec<bool> {
        let mut reached = vec![false; self.steps.len()];
        let mut todo = vec![0];
        while let Some(at) = todo.pop() {
            if !std::mem::replace(&mut reached[at], true) {
                todo.extend(self.next(at, case));
            }
        }
        reached
    }

    /// The places that are still to be read behind each step.
    pub fn alive(&self, case: &[Fact]) -> Vec<Set> {
        let (steps, places) = (self.steps.len(), self.places.len());
        let mut before = vec![Set::new(places); steps];
        let mut behind = vec![Set::new(places); steps];
        let mut all = Set::new(places);
        let mut changed = true;
        while changed {
            changed = false;
            for at in (0..steps).rev() {
                let (step, behind) = (&self.steps[at], &mut behind[at]);
                self.next(at, case)
                    .for_each(|to| behind.add_all(&before[to]));
                all.0.copy_from_slice(&behind.0);
                if let Some(place) = step.writes {
                    all.remove(place);
                }
                step.reads.iter().for_each(|place| all.add(*place));
                if all != before[at] {
                    std::mem::swap(&mut all, &mut before[at]);
                    changed = true;
                }
            }
        }
        self.keep_spans(&mut behind);
        behind
    }

    /// Leaves of the places behind each step those that may hold something there.
    fn keep_spans(&self, behind: &mut [Set]) {
        let mut begins: Vec<Vec<usize>> = vec![Vec::new(); behind.len()];
        let mut ends = begins.clone();
        for (place, (from, to)) in self.span.iter().enumerate() {
            if from < to {
                begins[*from].push(place);
                ends[*to].push(place);
            }
        }
        let mut open = Set::new(self.places.len());
        for (at, set) in behind.iter_mut().enumerate() {
            begins[at].iter().for_each(|place| open.add(*place));
            ends[at].iter().for_each(|place| open.remove(*place));
            set.keep_all(&open);
        }
    }
}

/// A set of places.
#[derive(Clone, Debug, PartialEq)]
pub struct Set(Vec<u64>);

impl Set {
    pub fn new(places: usize) -> Set {
        Set(vec![0; places.div_ceil(64)])
    }

    pub fn add(&mut self, place: usize) {
        self.0[place / 64] |= 1 << (place % 64);
    }

    pub fn remove(&mut self, place: usize) {
        self.0[place / 64] &= !(1 << (place % 64));
    }

    pub fn has(&self, place: usize) -> bool {
        self.0[place / 64] >> (place % 64) & 1 == 1
    }

    pub fn add_all(&mut self, other: &Set) {
        for (word, more) in self.0.iter_mut().zip(&other.0) {
            *word |= more;
        }
    }

    /// Keeps what another set has, too.
    pub fn keep_all(&mut self, other: &Set) {
        for (word, other) in self.0.iter_mut().zip(&other.0) {
            *word &= other;
        }
    }

    /// Keeps of some places those that another set has, too.
    pub fn keep(&mut self, other: &Set, among: &Set) {
        for ((word, other), among) in self.0.iter_mut().zip(&other.0).zip(&among.0) {
            *word &= other | !among;
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = usize> {
        let words = self.0.iter().enumerate();
        words.flat_map(|(k, &word)| {
            let rest = std::iter::successors(Some(word), |word| Some(word & word.wrapping_sub(1)));
            let rest = rest.take_while(|word| *word != 0);
            rest.map(move |word| 64 * k + word.trailing_zeros() as usize)
        })
    }
}
