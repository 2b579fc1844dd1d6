//! Which effects there are, what of a program is theirs, and when they run.
//!
//! The lowering notes on behalf of which effect each value is computed
//! ([`crate::source::Span::effect`]), the innermost where one calls another; the
//! passes keep that. So what a machine counted for a program's lines can be told by
//! effects, and the model can be watched for the pixels at which an effect computes
//! anything: call by need leaves it out at the others.

use super::profile::Measured;
use crate::eval::arithmetic::Arithmetic;
use crate::eval::model::Model;
use crate::eval::run::Run;
use crate::flow::graph::*;
use crate::flow::tree::{Place, Statement};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::sema::FunctionKind;
use crate::source::Span;
use slowlight_routine::{Bits, Op, Value};
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
    /// Its loops.
    pub turns: Turns,
}

/// Runs the model at some pixels, in the order of the scan, and watches the effects.
/// What begins a row or a run of columns is counted at each pixel.
pub fn watch(plan: &Plan, pixels: &[(i32, i32)]) -> BTreeMap<u16, Seen> {
    let watched = Watched {
        model: Model(plan),
        log: RefCell::default(),
    };
    let mut run = Run::new(&plan.graph, &plan.tree, &watched);
    let mut found: BTreeMap<u16, Seen> = BTreeMap::new();
    watched.log.borrow_mut().clear();
    for (done, (x, y)) in pixels.iter().enumerate() {
        run.pixel(*x, *y);
        for (effect, here) in std::mem::take(&mut *watched.log.borrow_mut()) {
            let seen = found.entry(effect).or_default();
            seen.cycles.resize(done, 0);
            seen.cycles.push(here.cycles);
            seen.ran += 1;
            seen.turns.begun += here.turns.begun;
            seen.turns.turns += here.turns.turns;
            seen.turns.most = seen.turns.most.max(here.turns.most);
            seen.turns.limit = seen.turns.limit.max(here.turns.limit);
        }
    }
    for seen in found.values_mut() {
        seen.cycles.resize(pixels.len(), 0);
    }
    found
}

/// What an effect did at a pixel.
#[derive(Clone, Copy, Default)]
struct Here {
    cycles: u64,
    turns: Turns,
}

/// The model, watched.
struct Watched<'p> {
    model: Model<'p>,
    log: RefCell<BTreeMap<u16, Here>>,
}

impl Watched<'_> {
    fn graph(&self) -> &Graph {
        &self.model.0.graph
    }

    fn note(&self, span: Span, note: impl FnOnce(&mut Here)) {
        if let Some(effect) = span.effect {
            note(self.log.borrow_mut().entry(effect).or_default());
        }
    }
}

impl Arithmetic for &Watched<'_> {
    type Value = Bits;

    fn constant(&self, value: Value) -> Bits {
        self.model.constant(value)
    }

    fn entry(&self, table: TableId, at: usize, value: Value) -> Bits {
        self.model.entry(table, at, value)
    }

    fn param(&self, id: ParamId) -> Bits {
        self.model.param(id)
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Bits]) -> Bits {
        let routine = self.model.0.routine(id);
        let cycles = routine.map_or(0, |routine| u64::from(routine.cycles));
        self.note(self.graph().span(id), |here| here.cycles += cycles);
        self.model.apply(id, op, args)
    }

    fn copied(&self, place: Place, from: NodeId, value: Bits) -> Bits {
        self.model.copied(place, from, value)
    }

    fn sent(&self, from: NodeId, value: Bits) -> Bits {
        self.model.sent(from, value)
    }

    fn gather(&self, received: Bits, sent: Bits) -> Bits {
        self.model.gather(received, sent)
    }

    fn truth(&self, value: Bits) -> bool {
        self.model.truth(value)
    }

    fn int(&self, value: Bits) -> i32 {
        self.model.int(value)
    }

    fn turn(&self, of: LoopId, turn: u32, _: &[Option<Bits>]) {
        if let Some(l) = self.graph().loops.get(of.0 as usize) {
            self.note(l.span, |here| {
                here.turns.turns += 1;
                here.turns.most = here.turns.most.max(turn + 1);
            });
        }
    }

    fn step(&self, statement: &Statement) {
        if let Statement::Loop(turns) = statement
            && let Some(l) = self.graph().loops.get(turns.of.0 as usize)
        {
            self.note(l.span, |here| {
                here.turns.begun += 1;
                here.turns.turns += 1;
                here.turns.most = here.turns.most.max(1);
                here.turns.limit = here.turns.limit.max(l.max);
            });
        }
    }
}
