//! Values that share a variable never meet: statements are walked along random
//! ways, and what a variable holds is compared with what was written to the place
//! that is read.
#![allow(clippy::unwrap_used)]

use crate::eval::random::Random;
use crate::eval::random_graphs;
use crate::homes::interference::{InPlace, homes};
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::passes::simplify::fold::fold;
use crate::plan::Goal;
use crate::planner::PlannedScene;
use crate::planner::plan;
use crate::scene::check;
use crate::schedule::outline::Extent;
use crate::schedule::statements::schedule_together;
use crate::sema::Options;
use crate::targets::Sizes;
use crate::targets::bbc;
use rustc_hash::FxHashMap;
use slowlight_routine::Format;

/// What is written: a number of its own for each writing that is no copy.
type Mark = u64;

struct Walk<'p> {
    plan: &'p PlannedScene,
    number: &'p FxHashMap<Place, usize>,
    random: Random,
    next: Mark,
    /// What was written to each place, as far as a way says.
    places: FxHashMap<Place, Mark>,
    variables: FxHashMap<(Format, usize), Mark>,
    /// How conditions came out, by what they were; those that nothing computes, too.
    answers: FxHashMap<Result<Mark, NodeId>, bool>,
    reads: u32,
}

impl Walk<'_> {
    fn variable(&self, place: Place) -> (Format, usize) {
        (self.plan.place_format(place), self.number[&place])
    }

    fn read(&mut self, id: NodeId) -> Option<Mark> {
        let place = self.plan.place(id)?;
        let written = *self.places.get(&place)?;
        let held = self.variables.get(&self.variable(place));
        assert_eq!(held, Some(&written), "{place} at {id}\n{}", self.plan.tree);
        self.reads += 1;
        Some(written)
    }

    fn write(&mut self, place: Place, mark: Option<Mark>) {
        match mark {
            Some(mark) => {
                self.places.insert(place, mark);
                self.variables.insert(self.variable(place), mark);
            }
            None => {
                self.places.remove(&place);
                self.variables.remove(&self.variable(place));
            }
        }
    }

    fn holds(&mut self, cond: NodeId) -> bool {
        let random = self.random.below(2) == 0;
        let asked = match (self.read(cond), self.plan.place(cond)) {
            (Some(mark), _) => Ok(mark),
            (None, None) => Err(cond),
            (None, Some(_)) => return random,
        };
        *self.answers.entry(asked).or_insert(random)
    }

    /// Forgets what a block writes: nothing is known of another time. What is stepped
    /// is kept from pixel to pixel.
    fn forget(&mut self, block: &Block) {
        walk(block, &mut |statement| match statement {
            Statement::Let(id) => {
                self.places.remove(&Place::Node(*id));
            }
            Statement::Set {
                place: place @ Place::Node(_),
                ..
            } => {
                self.places.remove(place);
            }
            _ => {}
        });
    }

    fn block(&mut self, block: &Block) {
        for statement in block {
            match statement {
                Statement::Let(id) => {
                    let operands: Vec<NodeId> = self.plan.graph.node(*id).operands().collect();
                    operands.into_iter().for_each(|id| {
                        self.read(id);
                    });
                    self.next += 1;
                    self.write(Place::of(&self.plan.graph, *id), Some(self.next));
                }
                Statement::Set { place, from } => {
                    let mark = match *from {
                        Origin::Node(id) if self.plan.place(id).is_none() => {
                            self.next += 1;
                            Some(self.next)
                        }
                        Origin::Node(id) => self.read(id),
                        Origin::Scratch(l, k) => self.places.get(&Place::Scratch(l, k)).copied(),
                    };
                    // A copy of what was not written on this way says nothing.
                    let same = match *from {
                        Origin::Node(id) => self.plan.place(id).map(|p| self.variable(p)),
                        Origin::Scratch(l, k) => Some(self.variable(Place::Scratch(l, k))),
                    };
                    match mark {
                        None if same == Some(self.variable(*place)) => {
                            self.places.remove(place);
                        }
                        mark => self.write(*place, mark),
                    }
                }
                Statement::If { cond, yes, no } => {
                    let way = if self.holds(*cond) { yes } else { no };
                    self.block(way);
                }
                Statement::Loop(turns) => self.turns(turns),
                Statement::Call(id) => {
                    let body = self.plan.tree.body(*id).to_vec();
                    self.forget(&body);
                    self.block(&body);
                }
            }
        }
    }

    fn turns(&mut self, turns: &Turns) {
        self.block(&turns.start);
        for _ in 0..3 {
            self.forget(&turns.body);
            self.forget(&turns.next);
            self.block(&turns.body);
            if !self.holds(turns.again) {
                return self.block(&turns.done);
            }
            self.block(&turns.next);
        }
        self.block(&turns.otherwise);
    }
}

/// Walks a plan's picture along random ways, with results in place where copies are and where
/// all are; how many reads were looked at.
fn looked_at(plan: &PlannedScene, seed: u64, pixels: u32) -> u32 {
    let always = |_| [true; 2];
    let both = [InPlace::Copies, InPlace::Where(&always)];
    both.map(|in_place| looked_at_in(plan, in_place, seed, pixels))
        .iter()
        .sum()
}

fn looked_at_in(plan: &PlannedScene, in_place: InPlace<'_>, seed: u64, pixels: u32) -> u32 {
    let homes = homes(plan, in_place);
    let mut walk = Walk {
        plan,
        number: &homes.number,
        random: Random::new(seed),
        next: 0,
        places: FxHashMap::default(),
        variables: FxHashMap::default(),
        answers: FxHashMap::default(),
        reads: 0,
    };
    let tree = &plan.tree;
    walk.block(&tree.frame);
    for _ in 0..3 {
        for block in [&tree.row, &tree.pass, &tree.segment] {
            walk.forget(block);
            walk.block(block);
        }
        for _ in 0..pixels {
            walk.forget(&tree.pixel);
            walk.block(&tree.pixel);
            walk.read(plan.graph.ink);
        }
    }
    walk.reads
}

fn planned(graph: &Graph) -> PlannedScene {
    let goal = Goal {
        name: "test".to_owned(),
        mode: bbc::MICRO.modes[0],
        rows: None,
        plot: true,
    };
    plan(graph, &bbc::MICRO, &goal).unwrap()
}

#[test]
fn values_that_share_a_variable_never_meet() {
    let mut reads = 0;
    for seed in 0..60 {
        let plan = planned(&fold(&random_graphs::graph(seed)));
        reads += looked_at(&plan, seed, 20);
    }
    let scene = check("mirrors", include_str!("../../../examples/mirrors.scn"));
    let plan = planned(&scene.lower(&Options::default()).unwrap());
    reads += looked_at(&plan, 1, 200);
    assert!(reads > 50_000, "{reads}");
}

/// The same where subroutines are called: by what is done seldom, or anywhere.
#[test]
fn values_that_share_a_variable_with_subroutines_never_meet() {
    let (mut reads, mut plans) = (0, 0);
    let mut look = |plan: Option<PlannedScene>, seed: u64, pixels: u32| {
        if let Some(plan) = plan.filter(|plan| plan.is_outlined()) {
            plans += 1;
            reads += looked_at(&plan, seed, pixels);
        }
    };
    // Sizes with which everything that stands twice is worth a subroutine.
    let eager = Sizes {
        operation: 10,
        copy: 1,
        copy_bool: 1,
        home: 0,
        call: 1,
        around: 1,
        ..bbc::MICRO.sizes
    };
    let called = |plan: &PlannedScene, extent: Extent| {
        let tree = match extent {
            Extent::All => schedule_together(&plan.graph),
            Extent::Rows | Extent::Runs => plan.tree.clone(),
        };
        let (graph, tree) = plan.with_subroutines(tree, (extent, u64::MAX), &eager, &|_| None);
        plan.of(graph, tree).ok()
    };
    for seed in 0..60 {
        let plan = planned(&fold(&random_graphs::graph(seed)));
        look(called(&plan, Extent::Runs), seed, 20);
        let stepped = |node: &Node| matches!(node, Node::Stepped { .. });
        if !plan.graph.nodes.iter().any(stepped) {
            look(called(&plan, Extent::All), seed, 20);
        }
    }
    let scene = check("mirrors", include_str!("../../../examples/mirrors.scn"));
    let plan = planned(&scene.lower(&Options::default()).unwrap());
    for seed in 0..10 {
        look(called(&plan, Extent::Runs), seed, 20);
        look(plan.outlined_where_seldom(false, &|_| None), seed, 20);
        look(plan.outlined_where_seldom(true, &|_| None), seed, 20);
    }
    look(plan.outlined(&|_| None).ok(), 1, 200);
    assert!(plans > 60 && reads > 50_000, "{plans} {reads}");
}

#[test]
fn copies_are_joined() {
    let scene = check("mirrors", include_str!("../../../examples/mirrors.scn"));
    let plan = planned(&scene.lower(&Options::default()).unwrap());
    let homes = homes(&plan, InPlace::Copies).number;
    let (mut left, mut joined) = (0, 0);
    walk(&plan.tree.pixel, &mut |statement| {
        if let Statement::Set {
            place,
            from: Origin::Node(id),
        } = statement
            && let Some(from) = plan.place(*id).filter(|_| !plan.folded(*id))
        {
            let same = homes[place] == homes[&from];
            joined += u32::from(same);
            left += u32::from(!same);
        }
    });
    // Of what the run knows, and of conditions that are asked for themselves, too.
    assert!(
        left < 5 && joined > 20,
        "{left} copies are left of {joined}:\n{}",
        plan.tree
    );
}
