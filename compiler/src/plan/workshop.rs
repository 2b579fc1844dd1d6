//! What was made of a scene's graph so far.
//!
//! A program that does not fit is planned again with less memory spent. What a
//! rewrite makes of a graph does not depend on that, nor do its schedule, its
//! ranges and its cycles: only what is kept of it does. So a plan that is made
//! again finds most of what it tries here.

use super::cheaper::Rewrite;
use super::settled::{Settled, scheduled};
use crate::flow::graph::*;
use crate::passes::algebra::Proofs;
use crate::passes::fold::fold;
use crate::passes::narrow::narrow;
use crate::range::Slack;
use rustc_hash::{FxHashMap, FxHasher};
use slowlight_routine::Runtime;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A graph with a rewrite, and where that was: nothing where there is none to do.
pub type Rewritten = Option<(Settled, Vec<NodeId>)>;

/// Graphs made of one scene's for one machine.
pub struct Workshop {
    /// What is planned.
    pub origin: Graph,
    pub runtime: &'static Runtime,
    pub slack: Slack,
    /// What was proved about its values.
    pub proofs: Proofs,
    /// Whether shades are computed in full even where the ink is known without.
    pub every_shade: bool,
    /// Those that were scheduled, by a hash of their nodes.
    scheduled: Mutex<FxHashMap<u64, Vec<Settled>>>,
    /// What was rewritten is known by its address, since it is kept above.
    rewritten: Mutex<FxHashMap<Asked, Rewritten>>,
    /// Whether a plan has a second condition of a shortcut.
    beside: AtomicBool,
}

/// What was rewritten, how, and the sites left out.
type Asked = (usize, Rewrite, Vec<NodeId>);

impl Workshop {
    /// Nothing made yet.
    pub fn new(origin: Graph, runtime: &'static Runtime) -> Workshop {
        Workshop {
            origin,
            runtime,
            proofs: Proofs::default(),
            every_shade: false,
            slack: Slack::of(runtime),
            scheduled: Mutex::default(),
            rewritten: Mutex::default(),
            beside: AtomicBool::new(false),
        }
    }

    /// Whether a second condition of a shortcut was taken: plans without are others then.
    pub fn has_beside(&self) -> bool {
        self.beside.load(Ordering::Relaxed)
    }

    /// Notes that one was.
    pub fn note_beside(&self) {
        self.beside.store(true, Ordering::Relaxed);
    }

    /// A graph as it is, scheduled, with its ranges; the same graph is scheduled once.
    pub fn scheduled(&self, graph: Graph) -> Settled {
        let mut hasher = FxHasher::default();
        graph.nodes.hash(&mut hasher);
        let hash = hasher.finish();
        let same = |all: &Vec<Settled>| all.iter().find(|known| known.graph == graph).cloned();
        if let Some(known) = held(&self.scheduled).get(&hash).and_then(same) {
            return known;
        }
        let made = scheduled(graph, &self.slack);
        let mut all = held(&self.scheduled);
        let alike = all.entry(hash).or_default();
        // Made by somebody else meanwhile: one of the two is that graph from now on.
        match alike.iter().find(|known| known.graph == made.graph) {
            Some(known) => known.clone(),
            None => {
                alike.push(made.clone());
                made
            }
        }
    }

    /// What is equal by algebra or decided by the ranges is folded. What the
    /// ranges decide may let more be folded; a few rounds settle it.
    pub fn settle(&self, graph: &Graph) -> Settled {
        let mut now = self.scheduled(fold(graph));
        for _ in 0..3 {
            let next = fold(&narrow(&now.graph, &now.ranges));
            if next.nodes == now.graph.nodes {
                break;
            }
            now = self.scheduled(next);
        }
        now
    }

    /// A graph of this workshop rewritten but at some sites, made where it was not yet.
    pub fn rewritten(
        &self,
        plain: &Settled,
        rewrite: Rewrite,
        without: &[NodeId],
        make: impl FnOnce() -> Rewritten,
    ) -> Rewritten {
        let mut without = without.to_vec();
        without.sort_unstable();
        let key = (plain.address(), rewrite, without);
        if let Some(known) = held(&self.rewritten).get(&key) {
            return known.clone();
        }
        let made = make();
        held(&self.rewritten).entry(key).or_insert(made).clone()
    }
}

/// What a thread that panicked has left is whole: entries are made before they are put in.
fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl fmt::Debug for Workshop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Workshop")
            .field("origin", &self.origin)
            .finish_non_exhaustive()
    }
}
