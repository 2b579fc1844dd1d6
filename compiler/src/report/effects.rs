//! Which effects there are, what of a program is theirs, and when they run.
//!
//! The lowering notes on behalf of which effect each value is computed
//! ([`crate::source::Span::effect`]), the innermost where one calls another; the
//! passes keep that. So what a machine counted for a program's lines can be told by
//! effects, and the model can be watched for the pixels at which an effect computes
//! anything: call by need leaves it out at the others.

use super::profile::Measured;
use crate::eval::arithmetic::{Exact, Tagged};
use crate::eval::heard::{Heard, Listener};
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::tree::Statement;
use crate::plan::Plan;
use crate::plan::model::Model;
use crate::scene::Scene;
use crate::schedule::statements::schedule;
use crate::sema::FunctionKind;
use crate::source::Span;
use slowlight_routine::{Bits, Op};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// An effect of the scene or the library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Effect {
    /// Its number among the scene's functions.
    pub number: u16,
    /// Its name.
    pub name: String,
    /// Whether it is the library's.
    pub library: bool,
    /// Where its name stands.
    pub span: Span,
    /// How often it was expanded; 0 where nothing calls it.
    pub calls: u32,
}

/// All effects, the scene's first, each in the order of its text; one of the library that
/// the scene hides by its own is left out.
pub fn effects(scene: &Scene, graph: &Graph) -> Vec<Effect> {
    let functions = (0..).zip(&scene.program.functions);
    let all: Vec<Effect> = functions
        .filter(|(_, f)| matches!(f.kind, FunctionKind::Effect { .. }))
        .map(|(number, f)| Effect {
            number,
            name: f.name.clone(),
            library: f.library,
            span: f.span,
            calls: graph
                .effects
                .iter()
                .find(|e| e.name == f.name)
                .map_or(0, |e| e.calls),
        })
        .collect();
    let (library, mut own): (Vec<Effect>, Vec<Effect>) = all.into_iter().partition(|e| e.library);
    let seen = library.into_iter();
    let seen: Vec<Effect> = seen
        .filter(|effect| !own.iter().any(|hiding| hiding.name == effect.name))
        .collect();
    own.extend(seen);
    own
}

/// What of a program is an effect's own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Own {
    /// The machine's cycles, routines included.
    pub cycles: u64,
    /// What its lines take in memory, routines not.
    pub size: u64,
}

/// What a machine counted, by effects' numbers.
pub fn own(measured: Measured<'_>) -> BTreeMap<u16, Own> {
    let mut found: BTreeMap<u16, Own> = BTreeMap::new();
    let effect = |line: super::profile::Line| {
        let document = measured.documents.get(line.document)?;
        document.span(line.line, line.statement)?.effect
    };
    for cost in measured.costs {
        if let Some(effect) = cost.line.and_then(effect) {
            found.entry(effect).or_default().cycles += cost.cycles;
        }
    }
    for (line, size) in measured.sizes {
        if let Some(effect) = effect(*line) {
            found.entry(effect).or_default().size += size;
        }
    }
    found
}

/// How often the loops of an effect go round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Turns {
    /// How often one was begun.
    pub begun: u64,
    /// Turns in all.
    pub turns: u64,
    /// The most turns of one.
    pub most: u32,
    /// The most that the scene allows one.
    pub limit: u32,
}

/// What the model shows of an effect.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Seen {
    /// Cycles that the routines of its own operations take by their means, pixel by pixel:
    /// 0 where it was not needed.
    pub cycles: Vec<u64>,
    /// At how many pixels it computed anything.
    pub ran: usize,
}

/// How many statements may run to watch effects, and how many to count turns.
const MOST: u64 = 100_000_000;

/// Runs the model at some pixels, row by row, and watches the effects. What begins a run of
/// columns is counted at each pixel. Where pixels take more work than is worth it, only the
/// first of them are watched: also how many were.
pub fn watch(plan: &Plan, pixels: &[(i32, i32)]) -> (BTreeMap<u16, Seen>, usize) {
    let watched = Heard {
        arithmetic: Model::of(plan),
        listener: Watched {
            plan,
            log: RefCell::default(),
        },
    };
    let log = &watched.listener.log;
    let mut run = Run::within(&plan.graph, &plan.tree, &watched, MOST);
    let mut found: BTreeMap<u16, Seen> = BTreeMap::new();
    log.borrow_mut().clear();
    let mut done = 0;
    for (x, y) in pixels {
        run.pixel(*x, *y);
        if run.spent() {
            break;
        }
        for (effect, cycles) in std::mem::take(&mut *log.borrow_mut()) {
            let seen = found.entry(effect).or_default();
            seen.cycles.resize(done, 0);
            seen.cycles.push(cycles);
            seen.ran += 1;
        }
        done += 1;
    }
    for seen in found.values_mut() {
        seen.cycles.resize(done, 0);
    }
    (found, done)
}

/// Notes what the operations of effects cost.
struct Watched<'p> {
    plan: &'p Plan,
    /// Cycles of the pixel, by effect.
    log: RefCell<BTreeMap<u16, u64>>,
}

impl Listener<Bits> for Watched<'_> {
    fn applied(&self, id: NodeId, _: Op, _: &[Bits], _: Bits) {
        let routine = self.plan.routine(id);
        let cycles = routine.map_or(0, |routine| u64::from(routine.cycles));
        if let Some(effect) = self.plan.graph.span(id).effect {
            *self.log.borrow_mut().entry(effect).or_default() += cycles;
        }
    }
}

/// How often the loops of effects go round, by effect, in a scene's graph as it is written:
/// a compiled one may have a loop's first turns in front of it, or none left. Loops end early
/// once that has taken more work than is worth it.
pub fn turns(graph: &Graph, pixels: &[(i32, i32)]) -> BTreeMap<u16, Turns> {
    // What earlier pixels send only moves the ink.
    let graph = &Graph {
        diffusion: None,
        refinement: None,
        ..graph.clone()
    };
    let tree = schedule(graph);
    let counted = Heard {
        arithmetic: Exact(graph),
        listener: Rounds {
            graph,
            log: RefCell::default(),
        },
    };
    let mut run = Run::within(graph, &tree, &counted, MOST);
    for (x, y) in pixels {
        run.pixel(*x, *y);
        if run.spent() {
            break;
        }
    }
    counted.listener.log.take()
}

/// Counts the turns of loops.
struct Rounds<'g> {
    graph: &'g Graph,
    log: RefCell<BTreeMap<u16, Turns>>,
}

impl Rounds<'_> {
    fn note(&self, of: LoopId, note: impl FnOnce(&mut Turns)) {
        let written = self.graph.loops.get(of.0 as usize);
        if let Some((effect, max)) = written.and_then(|l| Some((l.span.effect?, l.max))) {
            let mut log = self.log.borrow_mut();
            let turns = log.entry(effect).or_default();
            turns.limit = turns.limit.max(max);
            note(turns);
        }
    }
}

impl Listener<Tagged> for Rounds<'_> {
    fn turn(&self, of: LoopId, turn: u32, _: &[Option<Tagged>]) {
        self.note(of, |turns| {
            turns.turns += 1;
            turns.most = turns.most.max(turn + 1);
        });
    }

    fn step(&self, statement: &Statement) {
        if let Statement::Loop(begun) = statement {
            self.note(begun.of, |turns| {
                turns.begun += 1;
                turns.turns += 1;
                turns.most = turns.most.max(1);
            });
        }
    }
}
