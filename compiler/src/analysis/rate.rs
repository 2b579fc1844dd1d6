//! Invariance analysis: the set of axes that a value changes with, its rate.
//!
//! A value's rate is the set of axes that it depends on: the params, the row,
//! the pass over the row, the column, and each loop that it stands in. The join is the union; the
//! empty set is a constant. A value can be computed as far out as its set
//! allows. Sets are interned, since a graph has many values and few sets.

use crate::ir::graph::*;
use rustc_hash::FxHashMap;
use std::fmt;

/// Something that a value may depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Dependence {
    /// The params: changes once a picture.
    Frame,
    /// y.
    Row,
    /// x modulo the number of passes over a row.
    Pass,
    /// x.
    Column,
    /// A loop's carried values.
    Loop(LoopId),
    /// What a loop's last `next` gave.
    Last(LoopId),
}

impl fmt::Display for Dependence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Dependence::Frame => f.write_str("frame"),
            Dependence::Row => f.write_str("row"),
            Dependence::Pass => f.write_str("pass"),
            Dependence::Column => f.write_str("column"),
            Dependence::Loop(l) => write!(f, "loop {}", l.0),
            Dependence::Last(l) => write!(f, "end of loop {}", l.0),
        }
    }
}

/// Which set; an index into [`Rates::sets`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SetId(pub u32);

/// Every node's rate.
#[derive(Clone, Debug, Default)]
pub struct Rates {
    /// The distinct sets, each sorted. The first is empty.
    pub sets: Vec<Vec<Dependence>>,
    /// Each node's set.
    pub of: Vec<SetId>,
}

impl Dependence {
    /// Whether it changes between the pixels of a pass over a row.
    pub fn within_pass(self) -> bool {
        !matches!(self, Dependence::Frame | Dependence::Row | Dependence::Pass)
    }
}

impl Rates {
    /// A node's rate.
    pub fn rate(&self, id: NodeId) -> &[Dependence] {
        self.sets
            .get(self.set(id).0 as usize)
            .map_or(&[], Vec::as_slice)
    }

    /// A node's set.
    pub fn set(&self, id: NodeId) -> SetId {
        self.of.get(id.0 as usize).copied().unwrap_or(SetId(0))
    }

    /// Whether a node is the same for a whole pass over a row.
    pub fn is_still(&self, id: NodeId) -> bool {
        !self.rate(id).iter().any(|d| d.within_pass())
    }

    /// Whether a node depends on something.
    pub fn depends(&self, id: NodeId, on: Dependence) -> bool {
        self.rate(id).binary_search(&on).is_ok()
    }
}

struct Interner {
    sets: Vec<Vec<Dependence>>,
    known: FxHashMap<Vec<Dependence>, SetId>,
    unions: FxHashMap<(SetId, SetId), SetId>,
}

impl Interner {
    fn new() -> Interner {
        let mut made = Interner {
            sets: Vec::new(),
            known: FxHashMap::default(),
            unions: FxHashMap::default(),
        };
        made.intern(Vec::new());
        made
    }

    fn intern(&mut self, set: Vec<Dependence>) -> SetId {
        if let Some(&id) = self.known.get(&set) {
            return id;
        }
        let id = SetId(self.sets.len() as u32);
        self.sets.push(set.clone());
        self.known.insert(set, id);
        id
    }

    fn union(&mut self, a: SetId, b: SetId) -> SetId {
        let key = (SetId(a.0.min(b.0)), SetId(a.0.max(b.0)));
        if a == b || key.0.0 == 0 {
            return key.1;
        }
        if let Some(&id) = self.unions.get(&key) {
            return id;
        }
        let mut both = self.sets[a.0 as usize].clone();
        both.extend(&self.sets[b.0 as usize]);
        both.sort_unstable();
        both.dedup();
        let id = self.intern(both);
        self.unions.insert(key, id);
        id
    }

    fn without(&mut self, a: SetId, of: LoopId) -> SetId {
        let own = [Dependence::Loop(of), Dependence::Last(of)];
        let rest = self.sets[a.0 as usize]
            .iter()
            .copied()
            .filter(|d| !own.contains(d))
            .collect();
        self.intern(rest)
    }
}

/// Every node's rate. Linear in the graph.
pub fn rates(graph: &Graph) -> Rates {
    let mut sets = Interner::new();
    let mut of: Vec<SetId> = Vec::with_capacity(graph.nodes.len());
    let mut ends: FxHashMap<LoopId, SetId> = FxHashMap::default();
    // A carried value also changes with whatever its loop depends on, but the
    // loop's roots come later in the arena: they join in through the results.
    for id in graph.ids() {
        let set = match graph.node(id) {
            Node::Const(_) | Node::Undefined(_) => SetId(0),
            Node::Param(_) => sets.intern(vec![Dependence::Frame]),
            Node::Axis(Axis::Y) => sets.intern(vec![Dependence::Row]),
            Node::Axis(Axis::Pass(_)) => sets.intern(vec![Dependence::Pass]),
            Node::Axis(Axis::X | Axis::Run) => sets.intern(vec![Dependence::Column]),
            // Another value in every pixel: it stands in the pixel's own block.
            Node::Received | Node::Neighbour(_) => {
                sets.intern(vec![Dependence::Row, Dependence::Column])
            }
            Node::Ramp { first, step, .. } => {
                let at = |id: NodeId| of.get(id.0 as usize).copied().unwrap_or(SetId(0));
                let both = sets.union(at(first), at(step));
                let column = sets.intern(vec![Dependence::Column]);
                sets.union(both, column)
            }
            Node::Carried { of, .. } => sets.intern(vec![Dependence::Loop(of)]),
            Node::Last { of, .. } => sets.intern(vec![Dependence::Last(of)]),
            Node::Result { of: l, .. } => *ends.entry(l).or_insert_with(|| {
                let roots = graph
                    .loops
                    .get(l.0 as usize)
                    .into_iter()
                    .flat_map(Loop::roots);
                let all = roots.fold(SetId(0), |all, root| {
                    let set = of.get(root.0 as usize).copied().unwrap_or(SetId(0));
                    sets.union(all, set)
                });
                sets.without(all, l)
            }),
            node => node.operands().fold(SetId(0), |all, operand| {
                let set = of.get(operand.0 as usize).copied().unwrap_or(SetId(0));
                sets.union(all, set)
            }),
        };
        of.push(set);
    }
    Rates {
        sets: sets.sets,
        of,
    }
}
/// Which values somebody reads who changes more often: in a loop, or from pixel to pixel, that
/// they do not change with. Linear in the graph, but for loops in loops.
pub fn invariant_operands(graph: &Graph) -> Vec<bool> {
    let rates = rates(graph);
    let mut inside: FxHashMap<LoopId, &[Dependence]> = FxHashMap::default();
    for id in graph.ids() {
        if let Node::Result { of, .. } = graph.node(id) {
            inside.insert(of, rates.rate(id));
        }
    }
    // Whether a loop that a value changes with stands in another one.
    let nested = |on: &Dependence, around: Dependence| match on {
        Dependence::Loop(of) => (inside.get(of)).is_some_and(|rate| rate.contains(&around)),
        _ => false,
    };
    let mut found = vec![false; graph.nodes.len()];
    for id in graph.ids() {
        let reader = rates.rate(id);
        for of in graph.node(id).operands() {
            let own = rates.rate(of);
            let is_still = |on: &Dependence| {
                matches!(on, Dependence::Loop(_))
                    && !own.contains(on)
                    && !own.iter().any(|own| nested(own, *on))
            };
            let moves = |rate: &[Dependence]| rate.iter().any(|on| on.within_pass());
            found[of.0 as usize] |= reader.iter().any(is_still) || !moves(own) && moves(reader);
        }
    }
    found
}
