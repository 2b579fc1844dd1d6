//! Apart: what few ways need is computed on each of them.
//!
//! A value has one place where it is computed, which all its users follow. Where
//! they stand on ways of which a pixel takes one, or none, that place is before
//! the choice, and every pixel pays. Then a copy of the value on each way costs
//! less. The copies are nodes of their own that are alike, so this is the last of
//! the passes on a graph: whoever looks for equal nodes makes one of them again.

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
    let mut out = Graph {
        nodes: Vec::new(),
        types: Vec::new(),
        spans: Vec::new(),
        names: HashMap::new(),
        directions: BTreeMap::new(),
        claims: BTreeMap::new(),
        early: Default::default(),
        ..graph.clone()
    };
    let mut moved: Vec<NodeId> = Vec::with_capacity(graph.nodes.len());
    let mut made: BTreeMap<(NodeId, usize), NodeId> = BTreeMap::new();
    for id in graph.ids() {
        let mut operands: HashMap<NodeId, NodeId> = HashMap::new();
        for used in graph.node(id).operands() {
            let mut now = moved[used.0 as usize];
            if let Some(top) = copies.get(&(id, used)) {
                now = *made.entry((used, *top)).or_insert_with(|| {
                    let node = graph.node(used).with(|a| moved[a.0 as usize]);
                    push(&mut out, graph, used, node)
                });
            }
            operands.insert(used, now);
        }
        let node = graph
            .node(id)
            .with(|a| operands.get(&a).copied().unwrap_or(a));
        moved.push(push(&mut out, graph, id, node));
    }
    let at = |id: NodeId| moved[id.0 as usize];
    for turns in &mut out.loops {
        let lists = [
            &mut turns.init,
            &mut turns.next,
            &mut turns.done,
            &mut turns.otherwise,
        ];
        for id in lists.into_iter().flatten() {
            *id = at(*id);
        }
        turns.again = at(turns.again);
    }
    out.ink = at(graph.ink);
    out.shade = graph.shade.map(at);
    out.reports.iter_mut().for_each(|id| *id = at(*id));
    if let Some(diffusion) = &mut out.diffusion {
        diffusion
            .shares
            .iter_mut()
            .for_each(|s| s.node = at(s.node));
    }
    // A copy is the same as what it is a copy of, so it is claimed of it, too.
    let again = made.iter().map(|((id, _), copy)| (*id, *copy));
    for (old, new) in graph.ids().map(|id| (id, at(id))).chain(again) {
        if let Some((op, args)) = graph.claims.get(&old) {
            out.claims.insert(new, (*op, args.map(at)));
        }
    }
    out
}

/// Appends a node that is like an old one.
fn push(out: &mut Graph, graph: &Graph, like: NodeId, node: Node) -> NodeId {
    let id = NodeId(out.nodes.len() as u32);
    out.nodes.push(node);
    out.types.push(graph.ty(like));
    out.spans.push(graph.span(like));
    if let Some(name) = graph.names.get(&like) {
        out.names.insert(id, name.clone());
    }
    if let Some(length) = graph.directions.get(&like) {
        out.directions.insert(id, *length);
    }
    id
}
