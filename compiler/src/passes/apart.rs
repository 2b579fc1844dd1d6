//! Apart: what few ways need is computed on each of them.
//!
//! A value has one place where it is computed, which all its users follow. Where
//! they stand on ways of which a pixel takes one, or none, that place is before
//! the choice, and every pixel pays. Then a copy of the value on each way costs
//! less. The copies are nodes of their own that are alike, so this is the last of
//! the passes on a graph: whoever looks for equal nodes makes one of them again.

use super::arena::Arena;
use crate::flow::graph::*;
use crate::flow::often;
use crate::flow::tree::*;
use std::collections::{BTreeMap, HashMap, HashSet};

/// Whether copies are worth it: of which node, how many times a pixel less it is
/// computed, how many copies there are more.
pub type Worth<'w> = &'w dyn Fn(NodeId, f64, usize) -> bool;

/// The graph with copies; nothing where none is worth it.
pub fn apart(graph: &Graph, tree: &Tree, worth: Worth<'_>) -> Option<Graph> {
    let mut places = Places::default();
    places.block(graph, &tree.pixel, None, 1.0);
    let mut copies = Copies::new();
    for (id, uses) in &places.uses {
        let Some(home) = places.home.get(id) else {
            continue;
        };
        if places.fixed.contains(id) || uses.iter().any(|(_, at)| at == home) {
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

/// Which copy each user of a value has, by the block where the copy stands.
type Copies = BTreeMap<(NodeId, NodeId), usize>;

/// A block of the pixel's statements.
struct Place {
    inside: Option<usize>,
    often: f64,
}

/// Where values are computed and used.
#[derive(Default)]
struct Places {
    blocks: Vec<Place>,
    /// The block where each value is computed.
    home: HashMap<NodeId, usize>,
    /// The values that use each one, and where they do.
    uses: BTreeMap<NodeId, Vec<(NodeId, usize)>>,
    /// What is used otherwise.
    fixed: HashSet<NodeId>,
}

impl Places {
    fn block(&mut self, graph: &Graph, block: &Block, inside: Option<usize>, often: f64) {
        let at = self.blocks.len();
        self.blocks.push(Place { inside, often });
        for statement in block {
            match statement {
                Statement::Let(id) => {
                    self.home.insert(*id, at);
                    for used in graph.node(*id).operands() {
                        self.uses.entry(used).or_default().push((*id, at));
                    }
                }
                Statement::Set { from, .. } => {
                    if let Origin::Node(id) = from {
                        self.fixed.insert(*id);
                    }
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
    fn tops(&self, uses: &[(NodeId, usize)]) -> Vec<usize> {
        let mut all: Vec<usize> = uses.iter().map(|(_, at)| *at).collect();
        all.sort_unstable();
        all.dedup();
        let outer = |at: &usize| !all.iter().any(|top| top != at && self.within(*at, *top));
        all.iter().copied().filter(outer).collect()
    }
}

/// The graph with a copy of a value before the first of the users that have it.
fn copied(graph: &Graph, copies: &Copies) -> Graph {
    let mut out = Arena::new(graph);
    let mut moved: Vec<Option<NodeId>> = Vec::with_capacity(graph.nodes.len());
    let mut made: BTreeMap<(NodeId, usize), NodeId> = BTreeMap::new();
    for id in graph.ids() {
        let mut operands: HashMap<NodeId, NodeId> = HashMap::new();
        let at = |id: NodeId| moved[id.0 as usize].unwrap_or(NodeId(0));
        for used in graph.node(id).operands() {
            let mut now = at(used);
            if let Some(top) = copies.get(&(id, used)) {
                now = *made
                    .entry((used, *top))
                    .or_insert_with(|| out.push(graph.node(used).with(at), used));
            }
            operands.insert(used, now);
        }
        let node = graph.node(id);
        let node = node.with(|a| operands.get(&a).copied().unwrap_or(a));
        moved.push(Some(out.push(node, id)));
    }
    let mut out = out.finish(&moved);
    // A copy is the same as what it is a copy of, so it is claimed of it, too.
    let at = |id: NodeId| moved[id.0 as usize].unwrap_or(NodeId(0));
    for ((id, _), copy) in made {
        if let Some((op, args)) = graph.claims.get(&id) {
            out.claims.insert(copy, (*op, args.map(at)));
        }
    }
    out
}
