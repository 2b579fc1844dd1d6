//! What comes out the same either way is found before it is asked which way.
//!
//! Of two tiles of a floor one is lighter, so a pixel's ink is found by comparing its shade
//! with numbers of the one or of the other. In most zones between all of these both tiles
//! have the same ink, and which tile it is takes two floors to find out. So where each way
//! of a choice is told by comparing one value with numbers of known order, it is found
//! first in which zone the value is, by a tree over the numbers of both, and the choice's
//! condition is asked only where the ways differ. Which zones are worth that, and which
//! number is asked for first, is for the plan to find out. (Binary search trees for
//! unequal chances: Knuth, The Art of Computer Programming 3, 6.2.2.)
//!
//! Nothing is computed otherwise than before, so no pixel changes. Numbers are constants or
//! entries at one place of tables, and must be so far apart, where the value may come to
//! them, that no rounding of theirs could change their order. [`super::either`] is for
//! values that are no such steps.

use super::rebuild::rebuild_old;
use crate::flow::build::Builder;
use crate::flow::graph::*;
use crate::range::{ENTRIES, Ranges};
use crate::source::Span;
use slowlight_routine::{Op, Range, Type, Value};

/// How many numbers a value may be compared with.
const BOUNDS: usize = 6;

/// How deep the comparisons of one way may be.
const DEPTH: usize = 8;

/// A comparison of the value with a number.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Test {
    value: NodeId,
    bound: NodeId,
    /// Whether the number itself counts as above.
    strict: bool,
    /// Whether the comparison holds below the number rather than above.
    below: bool,
}

/// A choice between two ways that are steps of one value.
pub struct Choice<'g> {
    graph: &'g Graph,
    id: NodeId,
    /// A comparison with each number, the least number first.
    tests: Vec<(Test, NodeId)>,
}

/// In which zones the condition is not asked, and which number comes first.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    zones: Vec<usize>,
    first: Option<usize>,
}

/// The choices between ints that are the same either way in some zones, and not in all.
pub fn choices<'g>(graph: &'g Graph, ranges: &Ranges) -> Vec<Choice<'g>> {
    let reached = graph.reached();
    let all = graph.ids().filter(|id| reached[id.0 as usize]);
    all.filter_map(|id| Choice::of(graph, ranges, id)).collect()
}

impl<'g> Choice<'g> {
    fn of(graph: &'g Graph, ranges: &Ranges, id: NodeId) -> Option<Choice<'g>> {
        let Node::Select { yes, no, .. } = graph.node(id) else {
            return None;
        };
        let mut found = Vec::new();
        if graph.ty(id) != Type::Int
            || !tests(graph, yes, DEPTH, &mut found)
            || !tests(graph, no, DEPTH, &mut found)
        {
            return None;
        }
        let value = found.first()?.0.value;
        let values = ranges.result[value.0 as usize];
        let mut choice = Choice {
            graph,
            id,
            tests: Vec::new(),
        };
        for (test, node) in found {
            choice
                .add(values, test, node)
                .filter(|_| test.value == value)?;
        }
        let same = |zone: &usize| choice.same(*zone).is_some();
        let count = (0..=choice.tests.len()).filter(same).count();
        (count > 0 && count <= choice.tests.len()).then_some(choice)
    }

    /// Puts a comparison in its place; nothing where that is not known.
    fn add(&mut self, values: Range, test: Test, node: NodeId) -> Option<()> {
        let same =
            |(other, _): &(Test, NodeId)| (other.bound, other.strict) == (test.bound, test.strict);
        if self.tests.iter().any(same) {
            return Some(());
        }
        let implies = |one: NodeId, other| implies(self.graph, values, one, other);
        let less = |(other, _): &&(Test, NodeId)| implies(other.bound, test.bound);
        let more = |(other, _): &(Test, NodeId)| implies(test.bound, other.bound);
        let at = self.tests.iter().take_while(less).count();
        if self.tests.len() == BOUNDS || !self.tests.iter().skip(at).all(more) {
            return None;
        }
        self.tests.insert(at, (test, node));
        Some(())
    }

    fn ways(&self) -> [NodeId; 2] {
        match self.graph.node(self.id) {
            Node::Select { yes, no, .. } => [yes, no],
            _ => [self.id; 2],
        }
    }

    /// The first of the zones' numbers that a comparison is with.
    fn at(&self, cond: NodeId) -> Option<(usize, Test)> {
        let test = test(self.graph, cond)?;
        let same =
            |(other, _): &(Test, NodeId)| (other.bound, other.strict) == (test.bound, test.strict);
        Some((self.tests.iter().position(same)?, test))
    }

    /// What a way is in a zone.
    fn within(&self, mut way: NodeId, zone: usize) -> NodeId {
        while let Node::Select { cond, yes, no } = self.graph.node(way)
            && let Some((at, test)) = self.at(cond)
        {
            way = if (zone <= at) == test.below { yes } else { no };
        }
        way
    }

    /// What both ways are in a zone, if it is the same.
    fn same(&self, zone: usize) -> Option<NodeId> {
        let [yes, no] = self.ways().map(|way| self.within(way, zone));
        (yes == no).then_some(yes)
    }

    /// All zones in which the ways are the same.
    pub fn all(&self) -> Way {
        let zones = 0..=self.tests.len();
        Way {
            zones: zones.filter(|zone| self.same(*zone).is_some()).collect(),
            first: None,
        }
    }

    /// The same without one of its zones, or with another number first.
    pub fn others(&self, way: &Way) -> Vec<Way> {
        let few = way.zones.iter().filter(|_| way.zones.len() > 1);
        let fewer = few.map(|zone| Way {
            zones: way.zones.iter().copied().filter(|z| z != zone).collect(),
            first: None,
        });
        let bounds = self.bounds(&|zone| Some(way.zones.contains(&zone)), &[]);
        let rooted = bounds.into_iter().map(|bound| Way {
            first: Some(bound),
            ..way.clone()
        });
        fewer.chain(rooted).filter(|other| other != way).collect()
    }

    /// The numbers that tell zones of unlike kinds apart, those rather that are asked for
    /// anyway. Of what kind a zone is without one is no matter.
    fn bounds<K: PartialEq>(
        &self,
        kind: &dyn Fn(usize) -> Option<K>,
        asked: &[usize],
    ) -> Vec<usize> {
        let kinds = (0..=self.tests.len()).filter_map(|zone| Some((zone, kind(zone)?)));
        let kinds: Vec<(usize, K)> = kinds.collect();
        let unlike = kinds.windows(2).filter(|pair| pair[0].1 != pair[1].1);
        unlike
            .map(|pair| {
                let mut between = pair[0].0..pair[1].0;
                between
                    .find(|bound| asked.contains(bound))
                    .unwrap_or(pair[0].0)
            })
            .collect()
    }

    /// The graph with the condition asked only where it matters.
    pub fn put(&self, way: &Way) -> Graph {
        rebuild_old(self.graph, &mut |builder, made, id, span| {
            let put = Put {
                of: self,
                way,
                made,
                span,
            };
            if id == self.id {
                put.choice(builder)
            } else {
                None
            }
        })
    }
}

/// Where a choice is put.
struct Put<'p, 'g> {
    of: &'p Choice<'g>,
    way: &'p Way,
    made: &'p [Option<NodeId>],
    span: Span,
}

impl Put<'_, '_> {
    fn made(&self, id: NodeId) -> Option<NodeId> {
        self.made.get(id.0 as usize).copied().flatten()
    }

    fn choice(&self, b: &mut Builder) -> Option<NodeId> {
        let Node::Select { cond, yes, no } = self.of.graph.node(self.of.id) else {
            return None;
        };
        let settled = |zone: usize| self.way.zones.contains(&zone);
        let asked = self.of.bounds(&|zone| Some(settled(zone)), &[]);
        let truths = [false, true].map(|truth| b.constant(Value::Bool(truth), self.span));
        let truth = |zone| Some(truths[usize::from(settled(zone))]);
        let known = self.told(b, &truth, &asked)?;
        let same = |zone| self.made(self.of.same(zone)?).filter(|_| settled(zone));
        let same = self.told(b, &same, &asked)?;
        let [yes, no] = [yes, no].map(|way| {
            let ink = |zone| {
                self.made(self.of.within(way, zone))
                    .filter(|_| !settled(zone))
            };
            self.told(b, &ink, &asked)
        });
        let other = b.select(self.made(cond)?, yes?, no?, self.span);
        Some(b.select(known, same, other, self.span))
    }

    /// What a zone tells.
    fn told(
        &self,
        b: &mut Builder,
        kind: &dyn Fn(usize) -> Option<NodeId>,
        asked: &[usize],
    ) -> Option<NodeId> {
        let bounds = self.of.bounds(kind, asked);
        self.tree(b, kind, &bounds, 0, self.of.tests.len())
    }

    fn tree(
        &self,
        b: &mut Builder,
        kind: &dyn Fn(usize) -> Option<NodeId>,
        bounds: &[usize],
        from: usize,
        to: usize,
    ) -> Option<NodeId> {
        if bounds.is_empty() {
            return (from..=to).find_map(kind);
        }
        let first = bounds.iter().position(|at| Some(*at) == self.way.first);
        let middle = first.unwrap_or(bounds.len() / 2);
        let at = bounds[middle];
        let below = self.tree(b, kind, &bounds[..middle], from, at)?;
        let above = self.tree(b, kind, &bounds[middle + 1..], at + 1, to)?;
        let (test, node) = self.of.tests[at];
        let (yes, no) = match test.below {
            true => (below, above),
            false => (above, below),
        };
        Some(b.select(self.made(node)?, yes, no, self.span))
    }
}

/// Collects the comparisons of a way that ends in constants; whether it is one.
fn tests(graph: &Graph, way: NodeId, depth: usize, all: &mut Vec<(Test, NodeId)>) -> bool {
    match graph.node(way) {
        Node::Const(_) => true,
        Node::Select { cond, yes, no } if depth > 0 => {
            let Some(test) = test(graph, cond) else {
                return false;
            };
            all.push((test, cond));
            tests(graph, yes, depth - 1, all) && tests(graph, no, depth - 1, all)
        }
        _ => false,
    }
}

fn test(graph: &Graph, cond: NodeId) -> Option<Test> {
    let Node::Apply(op @ (Op::Less | Op::LessEqual), [a, b]) = graph.node(cond) else {
        return None;
    };
    let number = |id: NodeId| matches!(graph.node(id), Node::Const(_) | Node::Lookup { .. });
    let less = op == Op::Less;
    match (number(a), number(b)) {
        (false, true) => Some(Test {
            value: a,
            bound: b,
            strict: less,
            below: true,
        }),
        // That a number is less than the value is that the value is not below it, or at it.
        (true, false) => Some(Test {
            value: b,
            bound: a,
            strict: !less,
            below: false,
        }),
        _ => None,
    }
}

/// Whether a value that is below one number is below another: in every entry that is so
/// much less that rounding them changes nothing, or the value never is below the one, or
/// always below the other.
fn implies(graph: &Graph, values: Range, one: NodeId, other: NodeId) -> bool {
    let off = |x: f64| 4.0 * ENTRIES * x.abs();
    let fits = |a: f64, b: f64| {
        let never = a <= values.lo - off(values.lo);
        never || b > values.hi + off(values.hi) || b - a > off(a).max(off(b))
    };
    let all = |id: NodeId| match graph.node(id) {
        Node::Const(c) => Some((vec![c.value().real()], None)),
        Node::Lookup { table, column, row } => {
            let table = graph.tables.get(table.0 as usize)?;
            let entries = table.entries.iter().map(|e| e.value().real());
            let place = (column, row, table.width, table.height);
            Some((entries.collect(), Some(place)))
        }
        _ => None,
    };
    let (Some((a, at)), Some((b, there))) = (all(one), all(other)) else {
        return false;
    };
    match at.is_some() && there.is_some() {
        true => at == there && a.iter().zip(&b).all(|(a, b)| fits(*a, *b)),
        false => a.iter().all(|a| b.iter().all(|b| fits(*a, *b))),
    }
}
