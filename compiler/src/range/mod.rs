//! Ranges: between which bounds every value of a scheduled graph stays.
//!
//! The statement tree is run once with intervals for values: arms refine what
//! their condition compares, loops are walked turn by turn until nothing grows
//! or `max` is reached (in long loops, bounds that keep growing are widened to
//! the format's ends; see [`loops`]). What a machine computes is
//! not exact, so every operation's interval is enlarged by the error that the
//! machine's routines may make, and cut to what its formats can hold.

mod assuming;
pub mod error;
mod interval;
mod known;
mod loops;
#[cfg(test)]
mod nest_tests;
mod parity;
mod pointed;
mod refine;
mod slack;
mod trust;

use crate::flow::graph::*;
use crate::flow::ramp;
use crate::flow::tree::*;

use crate::plan::points::sample::{Readers, readers};
pub use assuming::assuming;
use interval::interval;
use known::known;
#[cfg(test)]
use loops::STATEMENTS;
use parity::whole;
pub use slack::{ENTRIES, Slack};
use slowlight_routine::{Op, Range, Type};
use std::collections::BTreeSet;

/// What the ranges of a scene are, on one machine. Side tables by node.
#[derive(Clone, Debug, Default)]
pub struct Ranges {
    /// What each node's value stays within, once computed.
    pub result: Vec<Range>,
    /// What each operation's exact result stays within, before the format cuts it.
    pub exact: Vec<Range>,
    /// What each operation's arguments stay within where it is computed.
    pub args: Vec<[Range; 2]>,
}

/// The ranges of a scheduled graph.
pub fn ranges(graph: &Graph, tree: &Tree, slack: &Slack) -> Ranges {
    ranges_counted(graph, tree, slack).0
}

/// The same, and how many statements were walked: what it took.
pub fn ranges_counted(graph: &Graph, tree: &Tree, slack: &Slack) -> (Ranges, u64) {
    let mut walk = Walk {
        graph,
        slack,
        now: graph.ids().map(|id| known(graph, slack, id)).collect(),
        carried: graph
            .loops
            .iter()
            .map(|l| vec![None; l.types.len()])
            .collect(),
        assumed: Vec::new(),
        measured: trust::measured(graph),
        readers: match slack.expects() {
            true => readers(graph),
            false => Readers::default(),
        },
        turns: 0,
        walked: 0,
        out: Ranges {
            result: graph.ids().map(|id| known(graph, slack, id)).collect(),
            exact: vec![Range::ALL; graph.nodes.len()],
            args: vec![[Range::ALL; 2]; graph.nodes.len()],
        },
        tree,
        shared: shared(graph, tree),
    };
    walk.block(&tree.frame);
    walk.block(&tree.column);
    walk.block(&tree.row);
    walk.block(&tree.pass);
    walk.block(&tree.segment);
    walk.block(&tree.pixel);
    (walk.out, walk.walked)
}

pub(crate) struct Walk<'g> {
    graph: &'g Graph,
    slack: &'g Slack,
    /// Each node's range here: refined by the conditions around.
    now: Vec<Range>,
    carried: Vec<Vec<Option<Range>>>,
    /// What values that are computed here are known to stay within.
    assumed: Vec<(NodeId, Range)>,
    /// Values whose lengths are asked for, which are trusted to be no directions.
    measured: BTreeSet<NodeId>,
    /// By whom carried values are read, where something is expected of them.
    readers: Readers,
    /// How many turns of loops have been walked.
    turns: u32,
    /// How many statements.
    walked: u64,
    out: Ranges,
    tree: &'g Tree,
    /// Each node that several calls of a subroutine compute or give it:
    /// whether one was walked already.
    shared: Vec<Option<bool>>,
}

/// Nodes that belong to subroutines, none of them written yet.
fn shared(graph: &Graph, tree: &Tree) -> Vec<Option<bool>> {
    let mut shared: Vec<Option<bool>> = (graph.nodes.iter())
        .map(|node| matches!(node, Node::Slot(_)).then_some(false))
        .collect();
    let mut loops = vec![false; graph.loops.len()];
    for subroutine in &tree.subroutines {
        walk(&subroutine.body, &mut |statement| match statement {
            Statement::Let(id)
            | Statement::Set {
                place: Place::Node(id),
                ..
            } => shared[id.0 as usize] = Some(false),
            Statement::Loop(turns) => loops[turns.of.0 as usize] = true,
            _ => {}
        });
    }
    for id in graph.ids() {
        if let Node::Carried { of, .. } | Node::Last { of, .. } = graph.node(id)
            && loops.get(of.0 as usize) == Some(&true)
        {
            shared[id.0 as usize] = Some(false);
        }
    }
    shared
}

impl Walk<'_> {
    fn block(&mut self, block: &[Statement]) {
        for (k, statement) in block.iter().enumerate() {
            self.statement(statement);
            if let Statement::Let(id) = *statement {
                self.trust_back(id, &block[..k]);
            }
        }
    }

    fn statement(&mut self, statement: &Statement) {
        self.walked += 1;
        match statement {
            Statement::Let(id) => self.compute(*id),
            Statement::Set { place, from } => {
                let range = match *from {
                    Origin::Node(id) => self.read(id),
                    Origin::Scratch(l, k) => self.carried_range(l, k),
                };
                let range = self.given(*place, *from, range);
                let range = match *place {
                    // What a subroutine left is still what it was computed for.
                    Place::Node(id) => self.trust(id, range),
                    _ => range,
                };
                self.write(*place, range);
            }
            Statement::If { cond, yes, no } => {
                let before = self.arm(*cond, true, yes);
                let after = self.arm(*cond, false, no);
                for (place, range) in before {
                    if after.iter().any(|(p, _)| *p == place) {
                        let both = self.place_range(place).join(range);
                        self.write(place, both);
                    }
                }
            }
            Statement::Loop(turns) => self.run_loop(turns),
            // In the ranges that its values have here.
            Statement::Call(id) => self.block(self.tree.body(*id)),
        }
    }

    /// Walks an arm under its condition; answers what it sets, and to what.
    fn arm(&mut self, cond: NodeId, holds: bool, block: &Block) -> Vec<(Place, Range)> {
        let saved = refine::refine(self.graph, &mut self.now, cond, holds);
        self.doubted(&saved, cond, holds);
        let assumed = self.assumed.len();
        self.assumed
            .extend(refine::claimed(self.graph, cond, holds));
        self.block(block);
        self.assumed.truncate(assumed);
        for (id, range) in saved.into_iter().rev() {
            self.now[id.0 as usize] = range;
        }
        self.sets(block)
    }

    fn sets(&self, block: &Block) -> Vec<(Place, Range)> {
        let places = block.iter().filter_map(|s| match s {
            Statement::Set { place, .. } => Some(*place),
            _ => None,
        });
        places
            .map(|place| (place, self.place_range(place)))
            .collect()
    }

    fn carried_range(&self, of: LoopId, index: u32) -> Range {
        let found = self.carried[of.0 as usize]
            .get(index as usize)
            .copied()
            .flatten();
        let ty = self.graph.loops[of.0 as usize]
            .types
            .get(index as usize)
            .copied();
        found.unwrap_or_else(|| self.slack.cut(ty.unwrap_or(Type::Real), Range::ALL))
    }

    fn place_range(&self, place: Place) -> Range {
        match place {
            Place::Node(id) => self.now[id.0 as usize],
            Place::Carried(l, k) | Place::Scratch(l, k) => self.carried_range(l, k),
        }
    }

    fn read(&self, id: NodeId) -> Range {
        self.now[id.0 as usize]
    }

    fn write(&mut self, place: Place, range: Range) {
        match place {
            Place::Node(id) => {
                let at = id.0 as usize;
                let mut claims = self.assumed.iter().filter(|(of, _)| *of == id);
                let range = match claims.next() {
                    Some((_, claim)) => range.meet(*claim),
                    None => range,
                };
                self.now[at] = range;
                self.out.result[at] = match &mut self.shared[at] {
                    // What is recorded holds for every call.
                    Some(true) => self.out.result[at].join(range),
                    shared => {
                        *shared = shared.map(|_| true);
                        range
                    }
                };
            }
            Place::Carried(l, k) => self.carried[l.0 as usize][k as usize] = Some(range),
            Place::Scratch(..) => {}
        }
    }

    fn compute(&mut self, id: NodeId) {
        let at = id.0 as usize;
        let range = match self.graph.node(id) {
            Node::Apply(op, [a, b]) => {
                let (args, same) = self.operands(id, op, [a, b]);
                let exact = whole(self.graph, id, args, interval(op, args, same));
                let exact = self.part_of_length(id, exact);
                if self.shared[at] == Some(true) {
                    let [a, b] = self.out.args[at];
                    self.out.args[at] = [a.join(args[0]), b.join(args[1])];
                    self.out.exact[at] = self.out.exact[at].join(exact);
                } else {
                    self.out.args[at] = args;
                    self.out.exact[at] = exact;
                }
                self.slack.result(id, op, &args[..op.arity()], exact)
            }
            Node::Ramp { .. } => {
                let last = self.graph.image.width.saturating_sub(1) as i32;
                let all = ramp::range(self.graph, id, 0..=last, |part| self.read(part));
                let range = match all.within(self.slack.ints.lo, self.slack.ints.hi) {
                    true => all,
                    // It may wrap.
                    false => self.slack.ints,
                };
                whole(self.graph, id, [Range::ALL; 2], range)
            }
            // As the column's block has left it.
            Node::Tabulated(_) => self.read(id),
            Node::Stepped { first, step } => {
                let args = [self.read(first), self.read(step)];
                let exact = whole(self.graph, id, args, interval(Op::IntAdd, args, false));
                self.out.exact[at] = exact;
                self.slack.cut(Type::Int, exact)
            }
            Node::Lookup { table, .. } => {
                let entries = self
                    .graph
                    .tables
                    .get(table.0 as usize)
                    .into_iter()
                    .flat_map(|t| &t.entries);
                let values = entries.map(|e| Range::point(e.value().real()));
                let all = values.reduce(Range::join).unwrap_or(Range::ALL);
                let seeded = self.graph.tables.get(table.0 as usize);
                let all = match (&self.slack.points, self.graph.ty(id)) {
                    (Some(points), Type::Real) => points.rounded(id, all, 0.5),
                    _ => all,
                };
                match seeded.is_some_and(|t| !t.seed.is_empty()) {
                    true => self.slack.entry(all),
                    false => all,
                }
            }
            _ => Range::ALL,
        };
        let range = self.trust(id, range);
        self.write(Place::Node(id), range);
    }
}
