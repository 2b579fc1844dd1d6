//! Interval evaluation of a formula in an unfinished graph: what a value stays within where three
//! others stay within a box (the natural interval extension; Moore, Interval Analysis, 1966).
//!
//! Loops are run turn by turn: where it is open whether a turn is the last, what it gives is
//! joined to what later ones give. Conditions narrow nothing. Work is counted in nodes; when
//! [`Enclosure::left`] is spent, everything is possible.

use super::build::Builder;
use super::graph::*;
use super::interval::interval;
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::Range;

/// A formula, ready to be evaluated again and again.
pub struct Enclosure<'b> {
    builder: &'b Builder,
    inputs: [NodeId; 3],
    root: NodeId,
    /// The nodes that each loop's turns change, operands first; under no loop those that none does.
    bodies: FxHashMap<Option<LoopId>, Vec<NodeId>>,
    /// Where each node's range stands.
    places: FxHashMap<NodeId, usize>,
    now: Vec<Range>,
    /// The first of each loop's results that the formula reaches: there it is run.
    first: FxHashMap<LoopId, NodeId>,
    /// How many nodes may yet be evaluated.
    left: u64,
}

impl<'b> Enclosure<'b> {
    /// The formula of `root` in `inputs`, with so many nodes to evaluate in all.
    pub fn new(builder: &'b Builder, inputs: [NodeId; 3], root: NodeId, work: u64) -> Self {
        let mut made = Enclosure {
            builder,
            inputs,
            root,
            bodies: FxHashMap::default(),
            places: FxHashMap::default(),
            now: Vec::new(),
            first: FxHashMap::default(),
            left: work,
        };
        let mut reached = made.reached();
        reached.sort_unstable();
        made.left = made.left.saturating_sub(reached.len() as u64);
        // The innermost loop is the one that was opened last.
        let mut homes: FxHashMap<NodeId, Vec<LoopId>> = FxHashMap::default();
        for &id in &reached {
            let loops = made.loops_of(id, &homes);
            let home = loops.iter().max().copied();
            made.bodies.entry(home).or_default().push(id);
            homes.insert(id, loops);
            if let Node::Result { of, .. } = builder.node(id) {
                made.first.entry(of).or_insert(id);
            }
        }
        made.now = vec![Range::ALL; reached.len()];
        made.places = reached.into_iter().zip(0..).collect();
        made
    }

    /// How many nodes may yet be evaluated.
    pub fn left(&self) -> u64 {
        self.left
    }

    /// The loop that a node is a result, a carried or a last value of.
    fn owner(&self, id: NodeId) -> Option<(LoopId, &'b Loop)> {
        match self.builder.node(id) {
            Node::Carried { of, .. } | Node::Last { of, .. } | Node::Result { of, .. } => {
                Some((of, self.builder.loop_of(of)?))
            }
            _ => None,
        }
    }

    fn reached(&self) -> Vec<NodeId> {
        let mut seen = FxHashSet::default();
        let mut todo = vec![self.root];
        todo.extend(self.inputs);
        while let Some(id) = todo.pop() {
            if !seen.insert(id) || self.inputs.contains(&id) {
                continue;
            }
            todo.extend(self.builder.node(id).operands());
            if let Some((_, owner)) = self.owner(id) {
                todo.extend(owner.roots());
            }
        }
        seen.into_iter().collect()
    }

    /// The loops whose turns change a value.
    fn loops_of(&self, id: NodeId, known: &FxHashMap<NodeId, Vec<LoopId>>) -> Vec<LoopId> {
        let node = self.builder.node(id);
        let mut loops: Vec<LoopId> = Vec::new();
        let of = |id: NodeId| known.get(&id).into_iter().flatten().copied();
        match (node, self.owner(id)) {
            _ if self.inputs.contains(&id) => {}
            (Node::Result { of: own, .. }, Some((_, owner))) => {
                loops.extend(owner.roots().flat_map(of).filter(|l| *l != own));
            }
            (_, Some((own, owner))) => {
                loops.extend(owner.init.iter().copied().flat_map(of));
                loops.push(own);
            }
            _ => loops.extend(node.operands().flat_map(of)),
        }
        loops.sort_unstable();
        loops.dedup();
        loops
    }

    /// What the root stays within where the inputs stay within these.
    pub fn of(&mut self, inputs: [Range; 3]) -> Range {
        for (id, range) in self.inputs.into_iter().zip(inputs) {
            self.set(id, range);
        }
        self.body(None);
        self.get(self.root)
    }

    fn get(&self, id: NodeId) -> Range {
        let place = self.places.get(&id);
        place.map_or(Range::ALL, |at| self.now[*at])
    }

    fn set(&mut self, id: NodeId, range: Range) {
        if let Some(at) = self.places.get(&id) {
            self.now[*at] = range;
        }
    }

    fn body(&mut self, of: Option<LoopId>) {
        // Nothing but this evaluation reads the list meanwhile.
        let Some(nodes) = self.bodies.remove(&of) else {
            return;
        };
        self.left = self.left.saturating_sub(nodes.len() as u64);
        for &id in &nodes {
            self.evaluate(id);
        }
        self.bodies.insert(of, nodes);
    }

    fn evaluate(&mut self, id: NodeId) {
        let range = match self.builder.node(id) {
            _ if self.inputs.contains(&id) => return,
            Node::Const(c) => Range::point(c.value().real()),
            Node::Param(of) => {
                let param = self.builder.param_of(of);
                param.and_then(|p| p.range).unwrap_or(Range::ALL)
            }
            Node::Apply(op, [a, b]) => interval(op, [self.get(a), self.get(b)], a == b),
            Node::Select { cond, yes, no } => match self.truth(cond) {
                Some(true) => self.get(yes),
                Some(false) => self.get(no),
                None => self.get(yes).join(self.get(no)),
            },
            Node::Lookup { table, column, row } => {
                let table = self.builder.table_of(table);
                let [column, row] = [column, row].map(|id| self.builder.value(id));
                let all = table.into_iter().flat_map(|t| {
                    let all = t.candidates(column, row);
                    all.map(|at| Range::point(t.entries[at].value().real()))
                });
                all.reduce(Range::join).unwrap_or(Range::ALL)
            }
            Node::Result { of, .. } => {
                if self.first.get(&of) == Some(&id) {
                    self.run(of);
                }
                return;
            }
            // Set where the loop is run.
            Node::Carried { .. } | Node::Last { .. } => return,
            _ => Range::ALL,
        };
        self.set(id, range);
    }

    fn truth(&self, cond: NodeId) -> Option<bool> {
        let range = self.get(cond);
        match (range.lo >= 1.0, range.hi <= 0.0) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    /// Runs a loop, and leaves its results.
    fn run(&mut self, of: LoopId) {
        let Some(found) = self.builder.loop_of(of) else {
            return;
        };
        let all = |me: &Self, ids: &[NodeId]| ids.iter().map(|id| me.get(*id)).collect::<Vec<_>>();
        let mut carried = all(self, &found.init);
        let mut results: Option<Vec<Range>> = None;
        let mut ended = false;
        for _ in 0..found.max {
            if self.left == 0 {
                results = Some(vec![Range::ALL; found.done.len()]);
                ended = true;
                break;
            }
            for (index, range) in (0..).zip(&carried) {
                self.put(Node::Carried { of, index }, *range);
            }
            self.body(Some(of));
            let again = self.truth(found.again);
            if again != Some(true) {
                results = Some(joined(results, all(self, &found.done)));
            }
            if again == Some(false) {
                ended = true;
                break;
            }
            carried = all(self, &found.next);
        }
        if !ended {
            for (index, range) in (0..).zip(&carried) {
                self.put(Node::Last { of, index }, *range);
            }
            self.body(Some(of));
            results = Some(joined(results, all(self, &found.otherwise)));
        }
        for (index, range) in (0..).zip(results.into_iter().flatten()) {
            self.put(Node::Result { of, index }, range);
        }
    }

    /// Sets what stands in the graph as this node, if the formula reaches it.
    fn put(&mut self, node: Node, range: Range) {
        if let Some(id) = self.builder.find(&node) {
            self.set(id, range);
        }
    }
}

fn joined(known: Option<Vec<Range>>, more: Vec<Range>) -> Vec<Range> {
    match known {
        None => more,
        Some(known) => known
            .into_iter()
            .zip(more)
            .map(|(a, b)| a.join(b))
            .collect(),
    }
}
