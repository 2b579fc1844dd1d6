//! Matching of accuracy rules: where one may apply, what is known there, and the side conditions.

use super::form::Bound;
use crate::analysis::range::{Ranges, Slack};
use crate::ir::graph::*;
use slowlight_routine::{Op, Range, Value};

/// A result less than this part of what it is the difference of has lost bits
/// that matter: four of them.
pub const LOST: f64 = 16.0;

/// A graph with what the passes know of it.
pub struct Known<'g> {
    pub graph: &'g Graph,
    pub ranges: &'g Ranges,
    /// The greatest real of the format: what reaches it has no known bound.
    pub most: f64,
    /// The least real above 0 that it tells from 0; 0 where there is hardly an end.
    pub least: f64,
    /// How often each node is referred to.
    pub uses: Vec<u32>,
}

impl<'g> Known<'g> {
    pub fn new(graph: &'g Graph, ranges: &'g Ranges, slack: &Slack) -> Known<'g> {
        let mut uses = vec![0; graph.nodes.len()];
        let reached = graph.reached();
        let ids = graph.ids().filter(|id| reached[id.0 as usize]);
        let inside = ids.flat_map(|id| match graph.node(id) {
            // Each of a loop's results names the same roots.
            Node::Result { index, .. } if index > 0 => Vec::new(),
            _ => graph.references(id),
        });
        for id in inside.chain(graph.outputs()) {
            if let Some(count) = uses.get_mut(id.0 as usize) {
                *count += 1;
            }
        }
        Known {
            graph,
            ranges,
            most: slack.most(),
            least: slack.least(),
            uses,
        }
    }

    /// What a node's value stays within.
    pub fn range(&self, id: NodeId) -> Range {
        let found = self.ranges.result.get(id.0 as usize);
        found.copied().unwrap_or(Range::ALL)
    }

    /// Whether one operation alone uses a node.
    pub fn once(&self, id: NodeId) -> bool {
        self.uses.get(id.0 as usize) == Some(&1)
    }

    /// What an operation's first argument stays within where it is computed.
    pub fn argument(&self, id: NodeId) -> Range {
        let found = self.ranges.args.get(id.0 as usize);
        found.map_or(Range::ALL, |args| args[0])
    }
}

/// Whether the difference of two values may be much less than both.
pub fn may_cancel(a: Range, b: Range) -> bool {
    let gap = (a.lo - b.hi).max(b.lo - a.hi).max(0.0);
    gap * LOST <= a.magnitude().min(b.magnitude())
}

/// The least magnitude.
fn least(range: Range) -> f64 {
    range.lo.max(-range.hi).max(0.0)
}

/// A place where a form fits.
pub struct Site<'k> {
    pub known: &'k Known<'k>,
    pub bound: &'k Bound,
}

impl Site<'_> {
    /// What a letter's value stays within.
    pub fn range(&self, letter: &str) -> Range {
        let id = self.bound.get(letter);
        id.map_or(Range::ALL, |id| self.known.range(id))
    }

    /// A letter's value, if it is a constant.
    pub fn constant(&self, letter: &str) -> Option<f64> {
        let id = self.bound.get(letter)?;
        self.known.graph.constant(id).map(Value::real)
    }

    /// Whether nothing else uses a letter's value.
    pub fn once(&self, letter: &str) -> bool {
        self.bound.get(letter).is_some_and(|id| self.known.once(id))
    }

    /// Whether a root's argument is proved to be no negative.
    pub fn rooted(&self, root: &str) -> bool {
        let id = self.bound.get(root);
        id.is_some_and(|id| self.known.argument(id).lo >= 0.0)
    }

    /// Whether `a` may be much greater than every value of `b`.
    pub fn outweighs(&self, a: &str, b: &str) -> bool {
        self.range(a).magnitude() > LOST * self.range(b).magnitude()
    }

    /// Whether `a` may be much less than `b`.
    pub fn may_vanish(&self, a: &str, b: &str) -> bool {
        least(self.range(a)) * LOST <= self.range(b).magnitude()
    }

    /// Whether three letters are a vector of length 1, or of length 0.
    pub fn unit(&self, letters: [&str; 3]) -> bool {
        let [Some(x), Some(y), Some(z)] = letters.map(|l| self.bound.get(l)) else {
            return false;
        };
        let vector = [x, y, z];
        let graph = self.known.graph;
        normalised(graph, vector) || carried(graph, vector)
    }
}

/// Whether a vector is another, divided by its length.
fn normalised(graph: &Graph, vector: [NodeId; 3]) -> bool {
    let [Some((x, l)), Some((y, m)), Some((z, n))] = vector.map(|id| match graph.node(id) {
        Node::Apply(Op::Div, [v, length]) => Some((v, length)),
        _ => None,
    }) else {
        return false;
    };
    let Node::Apply(Op::Sqrt, [sum, _]) = graph.node(l) else {
        return false;
    };
    l == m && m == n && squares(graph, sum) == sorted([x, y, z].map(|v| square_of(graph, v)))
}

/// A square: of a node, or a constant's.
type Square = (Option<NodeId>, u64);

fn square_of(graph: &Graph, v: NodeId) -> Square {
    match graph.constant(v) {
        Some(value) => (None, (value.real() * value.real()).to_bits()),
        None => (Some(v), 0),
    }
}

fn sorted(mut squares: [Square; 3]) -> Option<[Square; 3]> {
    squares.sort_unstable();
    Some(squares)
}

/// The three squares that a sum is made of, sorted.
fn squares(graph: &Graph, sum: NodeId) -> Option<[Square; 3]> {
    let Node::Apply(Op::Add, [both, third]) = graph.node(sum) else {
        return None;
    };
    let Node::Apply(Op::Add, [first, second]) = graph.node(both) else {
        return None;
    };
    let square = |id: NodeId| match graph.node(id) {
        Node::Apply(Op::Mul, [a, b]) if a == b => Some((Some(a), 0)),
        Node::Const(_) => Some((None, graph.constant(id)?.real().to_bits())),
        _ => None,
    };
    sorted([square(first)?, square(second)?, square(third)?])
}

/// Whether a vector is carried by a loop that starts with a direction and goes
/// on with directions: those of rays, which have length 1 by contract.
fn carried(graph: &Graph, vector: [NodeId; 3]) -> bool {
    let place = |id| match graph.node(id) {
        Node::Carried { of, index } => Some((of, index as usize)),
        _ => None,
    };
    let Some((of, first)) = place(vector[0]) else {
        return false;
    };
    let follow = |k: usize| place(vector[k]) == Some((of, first + k));
    let Some(turns) = graph.loops.get(of.0 as usize) else {
        return false;
    };
    let three =
        |list: &[NodeId]| -> Option<[NodeId; 3]> { list.get(first..first + 3)?.try_into().ok() };
    let contract = |list: &[NodeId]| {
        three(list).is_some_and(|v| {
            normalised(graph, v) || v.iter().all(|id| graph.directions.get(id) == Some(&1.0))
        })
    };
    follow(1) && follow(2) && contract(&turns.init) && contract(&turns.next)
}
