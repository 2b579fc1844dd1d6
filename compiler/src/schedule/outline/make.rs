//! Function extraction: a subroutine made of several runs, and calls where they stood.

use super::forest::Forest;
use super::runs::{Given, Group, Run};
use super::runs::{candidates, group};
use super::step::{BlockId, Step};
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::source::Span;
use crate::targets::Sizes;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BinaryHeap;

/// Adds nodes and subroutines.
pub(super) struct Maker<'g> {
    pub graph: &'g mut Graph,
    /// The bytes of each node's routine.
    pub bytes: &'g mut Vec<u32>,
    pub sizes: &'g Sizes,
    pub name: &'g dyn Fn(Span) -> Option<String>,
}

impl Maker<'_> {
    /// A node like another, named like it.
    fn node(&mut self, node: Node, like: NodeId) -> NodeId {
        let id = NodeId(self.graph.nodes.len() as u32);
        let (ty, span) = (self.graph.ty(like), self.graph.span(like));
        self.graph.nodes.push(node);
        self.graph.types.push(ty);
        self.graph.spans.push(span);
        let bytes = self.bytes.get(like.0 as usize).copied().unwrap_or(0);
        self.bytes.push(bytes);
        if let Some(name) = self.graph.names.get(&like).cloned() {
            self.graph.names.insert(id, name);
        }
        id
    }

    /// Makes a subroutine of the first run, and calls of all.
    pub fn make(&mut self, forest: &mut Forest, group: &Group) {
        let (Some(&run), Some(outside), Some(own)) =
            (group.runs.first(), group.outside.first(), group.own.first())
        else {
            return;
        };
        let slots = self.slots(group, outside);
        let mut copy = Copy {
            given: (group.given.iter())
                .map(|given| match *given {
                    Given::Alike(id) => id,
                    Given::Slot(k) => slots[k],
                })
                .collect(),
            next: 0,
            own: self.own_nodes(group, own),
            defined: FxHashSet::default(),
            loops: FxHashMap::default(),
            carried: FxHashMap::default(),
            owner: forest.owner[run.block],
            maker: self,
            forest,
        };
        let body = copy.run(run);
        let made = copy.own;
        let spans = own.iter().chain(outside).map(|id| self.graph.span(*id));
        let span = spans.clone().next().unwrap_or_default();
        let name = spans.clone().find_map(|span| (self.name)(span));
        let id = forest.add(name.unwrap_or_default(), span, body);
        for (k, run) in group.runs.iter().enumerate() {
            let call = self.call(group, k, id, &slots, &made);
            forest.touch(run.block, run.from..run.to);
            for at in run.from..run.to {
                forest.blocks[run.block][at].clear();
            }
            forest.blocks[run.block][run.from] = call;
        }
    }

    fn slots(&mut self, group: &Group, outside: &[NodeId]) -> Vec<NodeId> {
        let mut slots = Vec::new();
        for (k, &ty) in group.slots.iter().enumerate() {
            let at = group.given.iter().position(|g| *g == Given::Slot(k));
            let like = at.and_then(|at| outside.get(at)).copied();
            let slot = self.node(Node::Slot(ty), like.unwrap_or(NodeId(0)));
            slots.push(slot);
        }
        slots
    }

    /// The subroutine's nodes for what the first run computes, in the graph's
    /// order; what each is becomes known as its statement is copied.
    fn own_nodes(&mut self, group: &Group, own: &[NodeId]) -> FxHashMap<NodeId, NodeId> {
        let mut numbers: Vec<usize> = (0..own.len()).collect();
        numbers.sort_unstable_by_key(|&k| own[k]);
        let mut made = FxHashMap::default();
        for k in numbers {
            let ty = self.graph.ty(own[k]);
            let node = self.node(Node::Slot(ty), own[k]);
            made.insert(own[k], node);
            let all = group.own.iter().filter_map(|own| own.get(k));
            let lengths = all.map(|id| self.graph.directions.get(id).copied());
            if let Some(lengths) = lengths.collect::<Option<Vec<f64>>>() {
                let longest = lengths.into_iter().fold(0.0, f64::max);
                self.graph.directions.insert(node, longest);
            }
        }
        made
    }

    /// What stands for a run: its slots set, the call, what is left of it copied.
    fn call(
        &self,
        group: &Group,
        k: usize,
        id: SubroutineId,
        slots: &[NodeId],
        made: &FxHashMap<NodeId, NodeId>,
    ) -> Vec<Step> {
        let mut steps = Vec::new();
        let set = |to: NodeId, from: NodeId| Step::Set {
            place: Place::Node(to),
            from: Origin::Node(from),
        };
        for (number, &slot) in slots.iter().enumerate() {
            let at = group.given.iter().position(|g| *g == Given::Slot(number));
            if let Some(&from) = at.and_then(|at| group.outside[k].get(at)) {
                steps.push(set(slot, from));
            }
        }
        steps.push(Step::Call(id));
        for &number in &group.left[k] {
            let (first, here) = (&group.own[0], &group.own[k]);
            let from = first.get(number as usize).and_then(|id| made.get(id));
            if let (Some(&from), Some(&to)) = (from, here.get(number as usize)) {
                steps.push(set(to, from));
            }
        }
        steps
    }
}

/// Copies a run's statements, its nodes replaced by the subroutine's.
struct Copy<'c, 'g> {
    maker: &'c mut Maker<'g>,
    forest: &'c mut Forest,
    /// What stands for each outside position.
    given: Vec<NodeId>,
    /// The next of these, in the order of the tokens.
    next: usize,
    own: FxHashMap<NodeId, NodeId>,
    /// Those of the run's nodes that a statement so far has written.
    defined: FxHashSet<NodeId>,
    loops: FxHashMap<LoopId, LoopId>,
    carried: FxHashMap<NodeId, NodeId>,
    /// The subroutine that the run stands in.
    owner: Option<SubroutineId>,
}

/// What an arm sets directly: the node, and from what.
type Sets = Vec<(NodeId, NodeId)>;

impl Copy<'_, '_> {
    fn run(&mut self, run: Run) -> Vec<Step> {
        let steps = self.forest.blocks[run.block][run.from..run.to].iter();
        let steps: Vec<Step> = steps.flatten().cloned().collect();
        steps.iter().map(|step| self.step(step)).collect()
    }

    fn block(&mut self, block: BlockId) -> (BlockId, Sets) {
        let to = self.forest.blocks[block].len();
        let steps = self.run(Run { block, from: 0, to });
        let sets = steps.iter().filter_map(|step| match step {
            Step::Set {
                place: Place::Node(id),
                from: Origin::Node(from),
            } => Some((*id, *from)),
            _ => None,
        });
        let sets = sets.collect();
        (self.forest.add_block(steps), sets)
    }

    fn is_fixed(&self, id: NodeId) -> bool {
        self.forest.is_fixed(self.maker.graph, id, self.owner)
    }

    /// What the subroutine reads where the run reads a node.
    fn read(&mut self, id: NodeId) -> NodeId {
        if self.defined.contains(&id) {
            return self.own.get(&id).copied().unwrap_or(id);
        }
        if let node @ (Node::Carried { of, index } | Node::Last { of, index }) =
            self.maker.graph.node(id)
            && let Some(&of) = self.loops.get(&of)
        {
            if let Some(&made) = self.carried.get(&id) {
                return made;
            }
            let node = match node {
                Node::Last { .. } => Node::Last { of, index },
                _ => Node::Carried { of, index },
            };
            let made = self.maker.node(node, id);
            self.carried.insert(id, made);
            return made;
        }
        if self.is_fixed(id) {
            return id;
        }
        let given = self.given.get(self.next).copied().unwrap_or(id);
        self.next += 1;
        given
    }

    fn written(&mut self, id: NodeId) -> NodeId {
        if self.is_fixed(id) {
            return id;
        }
        self.defined.insert(id);
        self.own.get(&id).copied().unwrap_or(id)
    }

    fn place(&mut self, place: Place) -> Place {
        let of = |l: LoopId| self.loops.get(&l).copied().unwrap_or(l);
        match place {
            Place::Carried(l, k) => Place::Carried(of(l), k),
            Place::Scratch(l, k) => Place::Scratch(of(l), k),
            Place::Node(id) => Place::Node(self.written(id)),
        }
    }

    fn step(&mut self, step: &Step) -> Step {
        match *step {
            Step::Let(id) => self.operation(id),
            Step::Set { place, from } => {
                let from = match from {
                    Origin::Node(id) => Origin::Node(self.read(id)),
                    Origin::Scratch(l, k) => {
                        Origin::Scratch(self.loops.get(&l).copied().unwrap_or(l), k)
                    }
                };
                let to = self.place(place);
                self.result(place, to);
                Step::Set { place: to, from }
            }
            Step::Call(id) => Step::Call(id),
            Step::If { cond, arms } => {
                let cond = self.read(cond);
                let [(yes, first), (no, second)] = arms.map(|arm| self.block(arm));
                self.selects(cond, &first, &second);
                Step::If {
                    cond,
                    arms: [yes, no],
                }
            }
            Step::Loop { of, again, parts } => self.turns(of, again, parts),
        }
    }

    fn operation(&mut self, id: NodeId) -> Step {
        let node = match self.maker.graph.node(id) {
            Node::Apply(op, [a, b]) => {
                let first = self.read(a);
                let second = if op.arity() > 1 { self.read(b) } else { first };
                Node::Apply(op, [first, second])
            }
            Node::Lookup { table, column, row } => Node::Lookup {
                table,
                column: self.read(column),
                row: self.read(row),
            },
            node => node,
        };
        let made = self.written(id);
        self.become_node(made, node);
        Step::Let(made)
    }

    fn become_node(&mut self, id: NodeId, node: Node) {
        if let Some(held) = self.maker.graph.nodes.get_mut(id.0 as usize) {
            *held = node;
        }
    }

    /// A loop's result, where the loop is the subroutine's too, is one again.
    fn result(&mut self, from: Place, to: Place) {
        if let (Place::Node(from), Place::Node(to)) = (from, to)
            && from != to
            && let Node::Result { of, index } = self.maker.graph.node(from)
            && let Some(&of) = self.loops.get(&of)
        {
            self.become_node(to, Node::Result { of, index });
        }
    }

    /// What both arms set is a select again: conditions imply others.
    fn selects(&mut self, cond: NodeId, first: &Sets, second: &Sets) {
        for &(id, yes) in first {
            let other = second.iter().find(|(other, _)| *other == id);
            let own = matches!(self.maker.graph.node(id), Node::Slot(_)) && !self.is_fixed(id);
            if let Some(&(_, no)) = other.filter(|_| own) {
                self.become_node(id, Node::Select { cond, yes, no });
            }
        }
    }

    fn turns(&mut self, of: LoopId, again: NodeId, parts: [BlockId; 5]) -> Step {
        let [start, body, next, done, otherwise] = parts;
        let made = LoopId(self.maker.graph.loops.len() as u32);
        if let Some(found) = self.maker.graph.loops.get(of.0 as usize).cloned() {
            self.maker.graph.loops.push(found);
        }
        self.loops.insert(of, made);
        let (start, _) = self.block(start);
        let (body, _) = self.block(body);
        let again = self.read(again);
        let (next, _) = self.block(next);
        let (done, _) = self.block(done);
        let (otherwise, _) = self.block(otherwise);
        if let Some(held) = self.maker.graph.loops.get_mut(made.0 as usize) {
            held.again = again;
        }
        Step::Loop {
            of: made,
            again,
            parts: [start, body, next, done, otherwise],
        }
    }
}

/// Replaces what is worth it, the most first, until so many bytes are saved, of which it takes
/// away what it does; answers how many subroutines were made.
pub(super) fn replace(forest: &mut Forest, maker: &mut Maker<'_>, enough: &mut u64) -> usize {
    let least = maker.sizes.call;
    let all = candidates(maker.graph, forest, least);
    // What each would save at most, and, once looked at, what it does.
    let mut heap: BinaryHeap<(u32, std::cmp::Reverse<usize>, bool)> = BinaryHeap::new();
    for (at, (bound, _)) in all.iter().enumerate() {
        heap.push((*bound, std::cmp::Reverse(at), false));
    }
    let mut made = 0;
    while *enough > 0
        && let Some((_, std::cmp::Reverse(at), looked)) = heap.pop()
    {
        let Some((saved, group)) = group(maker.graph, forest, maker.sizes, &all[at].1) else {
            continue;
        };
        let next = heap.peek().map_or(0, |(bound, ..)| *bound);
        if looked && saved >= next {
            maker.make(forest, &group);
            made += 1;
            *enough = enough.saturating_sub(u64::from(saved));
        } else {
            heap.push((saved, std::cmp::Reverse(at), true));
        }
    }
    made
}
