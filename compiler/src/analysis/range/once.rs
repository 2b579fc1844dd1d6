//! Memoisation of the abstract interpretation: what the walk finds out once, however often it
//! comes by: loops are walked turn by turn, and in most turns most values are what they were in
//! the turn before.

use super::correlated::interpolation;
use super::parity::is_odd;
use super::{Ranges, Walk, trust};
use crate::ir::graph::*;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Range};

/// What does not change while statements are walked, by node.
pub(super) struct Once {
    /// The lengths of directions that are trusted.
    lengths: Vec<Option<f64>>,
    /// Whether an int's last bits are known not to be all 0, where that was asked for.
    odd: Vec<Option<bool>>,
    /// What was computed last: an operation's operands and its exact result stand beside it
    /// in the answer.
    computed: Vec<Option<Range>>,
    /// By loop, who reads its carried values.
    carried: Vec<Vec<(NodeId, u32)>>,
    /// By choice, which carried value it gives on, or is part of a choice that does.
    gives: FxHashMap<NodeId, (LoopId, u32)>,
    /// What carried ints are compared with.
    compared: FxHashMap<(LoopId, u32), Vec<f64>>,
    /// How far what conditions say may be off.
    doubts: FxHashMap<(NodeId, bool), f64>,
}

impl Once {
    /// Of a graph, whose directions are trusted or not.
    pub(super) fn new(graph: &Graph, trusts: bool) -> Once {
        let mut carried = vec![Vec::new(); graph.loops.len()];
        for id in graph.ids() {
            if let Node::Carried { of, index } | Node::Last { of, index } = graph.node(id)
                && let Some(all) = carried.get_mut(of.0 as usize)
            {
                all.push((id, index));
            }
        }
        Once {
            lengths: match trusts {
                true => trust::lengths(graph),
                false => vec![None; graph.nodes.len()],
            },
            odd: vec![None; graph.nodes.len()],
            computed: vec![None; graph.nodes.len()],
            carried,
            gives: gives(graph),
            compared: compared(graph),
            doubts: FxHashMap::default(),
        }
    }

    /// The length of a direction that is trusted.
    pub(super) fn length(&self, id: NodeId) -> Option<f64> {
        self.lengths[id.0 as usize]
    }

    /// Whether an int's last bits are known not to be all 0.
    pub(super) fn odd(&mut self, graph: &Graph, id: NodeId) -> bool {
        *self.odd[id.0 as usize].get_or_insert_with(|| is_odd(graph, id))
    }

    /// The nodes that read a loop's carried values, and which.
    pub(super) fn carried(&self, of: LoopId) -> &[(NodeId, u32)] {
        &self.carried[of.0 as usize]
    }

    /// The carried value that a choice, or one that it is part of, gives on.
    pub(super) fn gives(&self, choice: NodeId) -> Option<(LoopId, u32)> {
        self.gives.get(&choice).copied()
    }

    /// Bounds that a carried int may have because it is compared with them: of a range, the
    /// next ones around it, itself included.
    pub(super) fn thresholds(&self, carried: (LoopId, u32), range: Range) -> Range {
        let all = self.compared.get(&carried).map_or(&[][..], Vec::as_slice);
        let above = all.iter().copied().filter(|x| *x >= range.hi);
        let below = all.iter().copied().filter(|x| *x <= range.lo);
        let hi = above.reduce(f64::min).unwrap_or(range.hi);
        let lo = below.reduce(f64::max).unwrap_or(range.lo);
        range.join(Range::new(lo, hi))
    }

    /// How far what a condition says may be off, found out where it was not yet.
    pub(super) fn doubt(&mut self, fact: (NodeId, bool), find: impl FnOnce() -> f64) -> f64 {
        *self.doubts.entry(fact).or_insert_with(find)
    }

    /// What was computed for a node when the walk last came by.
    pub(super) fn computed(&self, id: NodeId) -> Option<Range> {
        self.computed[id.0 as usize]
    }

    /// What was computed so far, to be put back later.
    pub(super) fn found(&self) -> Vec<Option<Range>> {
        self.computed.clone()
    }

    /// Puts back what was computed by then.
    pub(super) fn put_back(&mut self, found: Vec<Option<Range>>) {
        self.computed = found;
    }

    /// The same of a node.
    pub(super) fn put_back_of(&mut self, found: &[Option<Range>], id: NodeId) {
        let at = id.0 as usize;
        self.computed[at] = found[at];
    }

    /// Keeps what is computed for a node.
    pub(super) fn keep(&mut self, id: NodeId, range: Range) -> Range {
        self.computed[id.0 as usize] = Some(range);
        range
    }
}

/// The choices between what loops give on.
fn gives(graph: &Graph) -> FxHashMap<NodeId, (LoopId, u32)> {
    let mut all = FxHashMap::default();
    for (of, turns) in graph.loops.iter().enumerate() {
        let next = turns.next.iter().enumerate();
        let mut todo: Vec<_> = next
            .map(|(k, &id)| (id, (LoopId(of as u32), k as u32)))
            .collect();
        while let Some((id, carried)) = todo.pop() {
            if let Node::Select { yes, no, .. } = graph.node(id)
                && all.insert(id, carried).is_none()
            {
                todo.extend([(yes, carried), (no, carried)]);
            }
        }
    }
    all
}

/// What ints that loops carry are compared with: constants.
fn compared(graph: &Graph) -> FxHashMap<(LoopId, u32), Vec<f64>> {
    let mut all: FxHashMap<(LoopId, u32), Vec<f64>> = FxHashMap::default();
    for id in graph.ids() {
        let Node::Apply(Op::IntEqual | Op::IntLess | Op::IntLessEqual, [a, b]) = graph.node(id)
        else {
            continue;
        };
        for (of, with) in [(a, b), (b, a)] {
            if let (Node::Carried { of, index }, Some(bound)) =
                (graph.node(of), graph.constant(with))
            {
                all.entry((of, index)).or_default().push(bound.real());
            }
        }
    }
    all
}

impl Ranges {
    /// Takes over what others say of a node.
    pub(super) fn copy(&mut self, from: &Ranges, id: NodeId) {
        let at = id.0 as usize;
        self.result[at] = from.result[at];
        self.exact[at] = from.exact[at];
        self.args[at] = from.args[at];
    }
}

impl Walk<'_> {
    /// What an operation came to when the walk last came by, where that hangs on nothing but
    /// its operands and these are what they were.
    pub(super) fn as_before(&self, id: NodeId, args: [&Range; 2]) -> Option<Range> {
        let at = id.0 as usize;
        let before = self.once.computed(id)?;
        let [a, b] = &self.out.args[at];
        // What is recorded of subroutines is of all their calls.
        let same = self.shared[at].is_none() && alike(a, args[0]) && alike(b, args[1]);
        (same && !self.reads_more(id)).then_some(before)
    }

    /// Whether what is known of an operation may follow from other ranges than its
    /// operands' ([`Walk::part_of_length`]).
    fn reads_more(&self, id: NodeId) -> bool {
        let op_of = |id: NodeId| match self.graph.node(id) {
            Node::Apply(op, _) => Some(op),
            _ => None,
        };
        match self.graph.node(id) {
            Node::Apply(Op::Div, [a, b]) => {
                let by_length = op_of(b) == Some(Op::Sqrt);
                by_length || matches!(op_of(a), Some(Op::Mul | Op::Neg | Op::Abs))
            }
            Node::Apply(Op::Mul, [a, b]) if self.slack.direction.is_none() => {
                [a, b].map(op_of).contains(&Some(Op::Sub))
            }
            Node::Apply(Op::Add, operands) => interpolation(self.graph, operands).is_some(),
            _ => false,
        }
    }
}

/// Whether ranges are the same to the bit: 0 and -0 are not.
fn alike(a: &Range, b: &Range) -> bool {
    let bits = |r: &Range| (r.lo.to_bits(), r.hi.to_bits(), r.nonzero);
    bits(a) == bits(b)
}
