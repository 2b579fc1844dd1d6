//! Rematerialisation: what few ways need is computed on each of them.
//!
//! A value has one place where it is computed, which all its users follow. Where
//! they stand on ways of which a pixel takes one, or none, that place is before
//! the choice, and every pixel pays. Then a copy of the value on each way costs
//! less. The copies are nodes of their own that are alike, so this is the last of
//! the passes on a graph: whoever looks for equal nodes makes one of them again.

use crate::ir::graph::*;
use crate::ir::often;
use crate::ir::tree::*;
use crate::passes::rewrite::arena::Arena;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;

/// Whether copies are worth it: of which node, how many times a pixel less it is
/// computed, how many copies there are more.
pub type Worth<'w> = &'w dyn Fn(NodeId, f64, usize) -> bool;

/// The graph with copies; nothing where none is worth it.
pub fn rematerialise(graph: &Graph, tree: &Tree, worth: Worth<'_>) -> Option<Graph> {
    let mut places = Places::default();
    places.block(graph, &tree.pixel, None, 1.0);
    let mut copies = Copies::new();
    for (id, uses) in &places.uses {
        let Some(home) = places.home.get(id) else {
            continue;
        };
        // What is stepped is stepped once a pixel.
        let stepped = matches!(graph.node(*id), Node::Stepped { .. });
        if stepped || places.fixed.contains(id) || uses.iter().any(|(_, at)| at == home) {
            continue;
        }
        let tops = places.tops(uses);
        let often: f64 = tops.iter().map(|at| places.blocks[*at].often).sum();
        let less = places.blocks[*home].often - often;
        if less > 0.0 && worth(*id, less, tops.len() - 1) {
            for (user, at) in uses {
                let top = tops.iter().copied().find(|top| places.within(*at, *top))?;
                copies.insert((*user, *id), top);
            }
        }
    }
    (!copies.is_empty()).then(|| copied(graph, &copies))
}

/// What uses a value: another, or what a loop starts with, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum User {
    Node(NodeId),
    Start(LoopId, u32),
}

/// Which copy each user of a value has, by the block where the copy stands.
type Copies = BTreeMap<(User, NodeId), usize>;

/// A block of the pixel's statements.
struct Part {
    inside: Option<usize>,
    often: f64,
}

/// Where values are computed and used.
#[derive(Default)]
struct Places {
    blocks: Vec<Part>,
    /// The block where each value is computed.
    home: FxHashMap<NodeId, usize>,
    /// What uses each value, and where.
    uses: BTreeMap<NodeId, Vec<(User, usize)>>,
    /// What is used otherwise.
    fixed: FxHashSet<NodeId>,
}

impl Places {
    fn block(&mut self, graph: &Graph, block: &Block, inside: Option<usize>, often: f64) {
        let at = self.blocks.len();
        self.blocks.push(Part { inside, often });
        for statement in block {
            match statement {
                Statement::Let(id) => {
                    self.home.insert(*id, at);
                    for used in graph.node(*id).operands() {
                        let user = User::Node(*id);
                        self.uses.entry(used).or_default().push((user, at));
                    }
                }
                Statement::Set { place, from } => {
                    let Origin::Node(id) = *from else { continue };
                    let user = match *place {
                        Place::Node(to) if is_choice(graph, to, id) => User::Node(to),
                        Place::Carried(of, k) if is_start(graph, of, k, id) => User::Start(of, k),
                        _ => {
                            self.fixed.insert(id);
                            continue;
                        }
                    };
                    self.uses.entry(id).or_default().push((user, at));
                }
                Statement::If { cond, yes, no } => {
                    self.fixed.insert(*cond);
                    let likely = often::likely(yes, no);
                    self.block(graph, yes, Some(at), often * likely);
                    self.block(graph, no, Some(at), often * (1.0 - likely));
                }
                Statement::Loop(turns) => {
                    self.fixed.insert(turns.again);
                    for (inner, times) in often::turns(turns) {
                        self.block(graph, inner, Some(at), often * times);
                    }
                }
                Statement::Call(_) => {}
            }
        }
    }

    /// Whether a block is another or stands in it.
    fn within(&self, mut at: usize, outer: usize) -> bool {
        loop {
            if at == outer {
                return true;
            }
            match self.blocks[at].inside {
                Some(next) => at = next,
                None => return false,
            }
        }
    }

    /// The outermost of the blocks that use a value.
    fn tops(&self, uses: &[(User, usize)]) -> Vec<usize> {
        let mut all: Vec<usize> = uses.iter().map(|(_, at)| *at).collect();
        all.sort_unstable();
        all.dedup();
        let outer = |at: &usize| !all.iter().any(|top| top != at && self.within(*at, *top));
        all.iter().copied().filter(outer).collect()
    }
}

/// Whether a value is a choice that has another in one of its arms.
fn is_choice(graph: &Graph, to: NodeId, arm: NodeId) -> bool {
    matches!(graph.node(to), Node::Select { cond, yes, no }
        if cond != arm && (yes == arm) != (no == arm))
}

/// Whether a value is what a loop starts with, and not what it goes on with.
fn is_start(graph: &Graph, of: LoopId, index: u32, id: NodeId) -> bool {
    let turns = graph.loops.get(of.0 as usize);
    let has = |all: &[NodeId]| all.get(index as usize) == Some(&id);
    turns.is_some_and(|turns| has(&turns.init) && !has(&turns.next))
}

/// The graph with a copy of a value before the first of the users that have it.
fn copied(graph: &Graph, copies: &Copies) -> Graph {
    let mut out = Arena::new(graph);
    let mut moved: Vec<Option<NodeId>> = Vec::with_capacity(graph.nodes.len());
    let mut made: BTreeMap<(NodeId, usize), NodeId> = BTreeMap::new();
    for id in graph.ids() {
        let mut operands: FxHashMap<NodeId, NodeId> = FxHashMap::default();
        let at = |id: NodeId| moved[id.0 as usize].unwrap_or(NodeId(0));
        for used in graph.node(id).operands() {
            let mut now = at(used);
            if let Some(top) = copies.get(&(User::Node(id), used)) {
                now = *made
                    .entry((used, *top))
                    .or_insert_with(|| out.push(graph.node(used).with(at), used));
            }
            operands.insert(used, now);
        }
        let node = graph.node(id);
        let node = node.with(|a| operands.get(&a).copied().unwrap_or(a));
        moved.push(Some(out.push(node, id)));
        let start = |of: usize, k: usize| (User::Start(LoopId(of as u32), k as u32), id);
        for (of, turns) in graph.loops.iter().enumerate() {
            for top in (0..turns.init.len()).filter_map(|k| copies.get(&start(of, k))) {
                made.entry((id, *top)).or_insert_with(|| {
                    let at = |id: NodeId| moved[id.0 as usize].unwrap_or(NodeId(0));
                    out.push(graph.node(id).with(at), id)
                });
            }
        }
    }
    let mut out = out.finish(&moved);
    for ((user, used), top) in copies {
        if let (User::Start(of, k), Some(copy)) = (user, made.get(&(*used, *top))) {
            out.loops[of.0 as usize].init[*k as usize] = *copy;
        }
    }
    // A copy is the same as what it is a copy of, so it is claimed of it, too.
    let at = |id: NodeId| moved[id.0 as usize].unwrap_or(NodeId(0));
    for ((id, _), copy) in made {
        if let Some((op, args)) = graph.claims.get(&id) {
            out.claims.insert(copy, (*op, args.map(at)));
        }
    }
    out
}
