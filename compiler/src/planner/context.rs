//! Planning context of a scene (a memo of graphs): what was made of its graph so far.
//!
//! A program that does not fit is planned again with less memory spent. What a
//! rewrite makes of a graph does not depend on that, nor do its schedule, its
//! ranges and its cycles: only what is kept of it does. So a plan that is made
//! again finds most of what it tries here, as far as there is room to keep it.

use super::pass_manager::Pipeline;
use super::pipeline::Pass;
use crate::analysis::range::{Slack, ranges_counted};
use crate::cost::pixels::Pixels;
use crate::cost::price::Price;
use crate::cost::size_budget::SizeBudget;
use crate::fuel::Fuel;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::Proofs;
use crate::passes::branches::early_exit::without;
use crate::passes::simplify::fold::fold;
use crate::passes::simplify::range_folding::fold_by_ranges;
use crate::schedule::analysed::{Analysed, scheduled};
use crate::wordlength::precision::MODELLED;
use crate::wordlength::sample;
use rustc_hash::{FxHashMap, FxHasher};
use slowlight_routine::Runtime;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// A graph with a rewrite, and where that was: nothing where there is none to do.
pub type Rewritten = Option<(Analysed, Vec<NodeId>)>;

/// How many nodes all graphs together may have that are kept: some 400 bytes each. Beyond
/// that they are dropped, and made anew where they are asked for again.
const KEPT: usize = 2_000_000;

/// Units of work for each node of a graph that is rewritten.
const REWRITTEN: u64 = 100;

/// The same for each node of one in which something is looked for.
const LOOKED_AT: u64 = 10;

/// Graphs made of one scene's for one machine, and how much more work may be done for a plan.
pub struct Context {
    /// What is planned.
    pub origin: Arc<Graph>,
    pub runtime: &'static Runtime,
    /// What was proved about its values.
    pub proofs: Arc<Proofs>,
    /// Whether shades are computed in full even where the ink is known without.
    pub every_shade: bool,
    /// Whether plans are only judged, not run: less is looked at to place their points.
    pub draft: bool,
    /// Whether memory for tables is cheap: a cartridge has more of it than of anything else.
    pub tables: bool,
    /// What searches for a plan may do yet.
    pub fuel: Fuel,
    /// How many statements may run in the routines' models to find the widths of values.
    pub modelled: u64,
    /// How many ran, for all plans of the scene.
    pub ran: Arc<AtomicU64>,
    /// Fuel that was burnt beside, to make its program fit.
    pub burnt: Arc<AtomicU64>,
    /// What runs the passes.
    pub pipeline: Pipeline,
    slack: Arc<Slack>,
    memo: Arc<Memo>,
}

/// What was made so far, for all plans of the scene.
#[derive(Default)]
struct Memo {
    kept: Mutex<Kept>,
    /// The pixels by which plans are priced.
    pixels: OnceLock<Arc<Pixels>>,
}

#[derive(Default)]
struct Kept {
    /// Those that were scheduled, by a hash of their nodes.
    scheduled: FxHashMap<u64, Vec<Analysed>>,
    /// With the units of work that it took.
    rewritten: FxHashMap<Asked, (Rewritten, u64)>,
    /// How many nodes they have, all together.
    nodes: usize,
}

impl Kept {
    /// Makes room for so many nodes.
    fn room(&mut self, nodes: usize) {
        if self.nodes + nodes > KEPT {
            *self = Kept::default();
        }
        self.nodes += nodes;
    }
}

/// What was rewritten, by its number, how, and the sites left out.
type Asked = (u64, Rewrite, Vec<NodeId>);

impl Context {
    /// Nothing made yet, and no end of fuel.
    pub fn new(origin: Graph, runtime: &'static Runtime) -> Context {
        Context {
            origin: Arc::new(origin),
            runtime,
            proofs: Arc::default(),
            every_shade: false,
            draft: false,
            tables: false,
            fuel: Fuel::new(u64::MAX),
            modelled: MODELLED,
            ran: Arc::default(),
            burnt: Arc::default(),
            pipeline: Pipeline::default(),
            slack: Arc::new(Slack::of(runtime)),
            memo: Arc::default(),
        }
    }

    /// The same context with other fuel.
    pub fn with(&self, fuel: Fuel) -> Context {
        Context {
            origin: self.origin.clone(),
            runtime: self.runtime,
            proofs: self.proofs.clone(),
            every_shade: self.every_shade,
            draft: self.draft,
            tables: self.tables,
            fuel,
            modelled: self.modelled,
            ran: self.ran.clone(),
            burnt: self.burnt.clone(),
            pipeline: self.pipeline.clone(),
            slack: self.slack.clone(),
            memo: self.memo.clone(),
        }
    }

    /// How many statements may run yet in the routines' models: where a plan is one among many,
    /// all ways to make it fit have them together.
    pub fn may_model(&self) -> u64 {
        match self.modelled < MODELLED {
            true => (self.modelled).saturating_sub(self.ran.load(Ordering::Relaxed)),
            false => MODELLED,
        }
    }

    /// [`Pipeline::pass`] by its fuel.
    pub fn pass(
        &self,
        pass: Pass,
        plan: Analysed,
        run: impl FnOnce(&Analysed) -> Option<Analysed>,
    ) -> Analysed {
        self.pipeline.pass(&self.fuel, pass, plan, run)
    }

    /// [`Pipeline::always`] by its fuel.
    pub fn always<T>(&self, pass: Pass, run: impl FnOnce() -> Option<T>) -> Option<T> {
        self.pipeline.always(&self.fuel, pass, run)
    }

    /// The pixels by which plans are priced: chosen by what the scene as it is takes.
    fn pixels(&self) -> Arc<Pixels> {
        let found = self.memo.pixels.get_or_init(|| {
            let plan = self.found_or_scheduled(fold(&without(&self.origin)));
            Arc::new(Pixels::of(&plan, self.runtime))
        });
        found.clone()
    }

    /// Prices for plans of the scene, where memory is as dear as that.
    pub fn price(&self, budget: SizeBudget) -> Price {
        let price = Price::new(self.runtime, self.pixels(), budget);
        match self.pipeline.without.has(Pass::Licm) {
            true => price.without_hoisting(),
            false => price,
        }
    }

    /// How many statements may be run to place points.
    pub(super) fn looks(&self) -> u64 {
        match self.draft {
            true => sample::DRAFT,
            false => sample::PATIENCE,
        }
    }

    /// How far the routines' results may be off.
    pub fn slack(&self) -> &Slack {
        &self.slack
    }

    /// Charges a look at all of a graph; whether there is fuel for one.
    pub fn may_look(&self, graph: &Graph) -> bool {
        self.fuel.burn(LOOKED_AT * graph.nodes.len() as u64);
        !self.fuel.spent()
    }

    /// A graph as it is, scheduled, with its ranges; the same graph is scheduled once.
    pub fn scheduled(&self, graph: Graph) -> Analysed {
        let found = self.found_or_scheduled(graph);
        // As if it were made anew: what others have made hangs on the order of threads.
        self.fuel.burn(found.work);
        found
    }

    fn found_or_scheduled(&self, graph: Graph) -> Analysed {
        let mut hasher = FxHasher::default();
        graph.nodes.hash(&mut hasher);
        let hash = hasher.finish();
        let same = |all: &Vec<Analysed>| all.iter().find(|known| known.graph == graph).cloned();
        if let Some(known) = held(&self.memo.kept).scheduled.get(&hash).and_then(same) {
            return known;
        }
        let made = scheduled(graph, &self.slack);
        let mut kept = held(&self.memo.kept);
        // Made by somebody else meanwhile: one of the two is that graph from now on.
        let alike = kept.scheduled.get(&hash).into_iter().flatten();
        if let Some(known) = alike.into_iter().find(|known| known.graph == made.graph) {
            return known.clone();
        }
        kept.room(made.graph.nodes.len());
        kept.scheduled.entry(hash).or_default().push(made.clone());
        made
    }

    /// What is equal by algebra or decided by the ranges is folded. What the
    /// ranges decide may let more be folded; a few rounds settle it.
    pub fn simplified(&self, graph: &Graph) -> Analysed {
        let mut now = self.scheduled(fold(graph));
        for _ in 0..3 {
            let without_ends = || {
                let (found, walked) = ranges_counted(&now.graph, &now.tree, &Slack::exact());
                self.fuel.burn(walked);
                found
            };
            let next = fold(&fold_by_ranges(&now.graph, &now.ranges, &without_ends));
            if next.nodes == now.graph.nodes {
                break;
            }
            now = self.scheduled(next);
        }
        now
    }

    /// A graph of this context rewritten but at some sites, made where it was not yet.
    pub fn rewritten(
        &self,
        plain: &Analysed,
        rewrite: Rewrite,
        without: &[NodeId],
        make: impl FnOnce() -> Rewritten,
    ) -> Rewritten {
        let mut without = without.to_vec();
        without.sort_unstable();
        let asked = without.len();
        let key = (plain.serial(), rewrite, without);
        let known = held(&self.memo.kept).rewritten.get(&key).cloned();
        if let Some((known, work)) = known {
            self.fuel.burn(work);
            return known;
        }
        let before = self.fuel.burnt();
        self.fuel.burn(REWRITTEN * plain.graph.nodes.len() as u64);
        let made = make();
        let work = self.fuel.burnt() - before;
        let mut kept = held(&self.memo.kept);
        // Numbers of sites are nothing beside a graph.
        kept.room(asked / 64);
        let (made, _) = kept.rewritten.entry(key).or_insert((made, work));
        made.clone()
    }
}

/// What a thread that panicked has left is whole: entries are made before they are put in.
fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl fmt::Debug for Context {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Context")
            .field("origin", &self.origin)
            .finish_non_exhaustive()
    }
}

/// Which of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rewrite {
    Forms,
    Identities,
    Spans,
}

/// How many nodes a graph may have to be looked at by algebra.
pub(super) const NODES: usize = 1000;
