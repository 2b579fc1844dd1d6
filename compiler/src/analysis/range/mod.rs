//! Ranges: between which bounds every value of a scheduled graph stays.
//!
//! The statement tree is run once with intervals for values: arms refine what
//! their condition compares, loops are walked turn by turn until nothing grows
//! or `max` is reached (in long loops, bounds that keep growing are widened to
//! the format's ends; see [`loops`]). What a machine computes is
//! not exact, so every operation's interval is enlarged by the error that the
//! machine's routines may make, and cut to what its formats can hold.

mod accelerate;
mod around;
mod assuming;
mod contract;
mod correlated;
mod ended;
mod fresh;
#[cfg(test)]
mod hold_tests;
mod known;
mod loops;
#[cfg(test)]
mod nest_tests;
mod once;
mod parity;
mod pointed;
pub(crate) mod refine;
mod slack;
mod trust;

use crate::ir::graph::*;
use crate::ir::interval::interval;
use crate::ir::ramp;
use crate::ir::tree::*;

use crate::analysis::carried::{Readers, readers};
use crate::analysis::region::Fact;
use accelerate::Growth;
use around::Around;
pub use assuming::assuming;
use ended::Left;
use fresh::Fresh;
use known::known;
pub(crate) use known::shared;
#[cfg(test)]
use loops::STATEMENTS;
use once::Once;
use refine::{Conditions, Known, restore};
pub use slack::{ENTRIES, Slack};
use slowlight_routine::{Op, Range, Type};

/// What the ranges of a scene are, on one machine. Side tables by node.
#[derive(Clone, Debug, Default)]
pub struct Ranges {
    /// What each node's value stays within, once computed.
    pub result: Vec<Range>,
    /// What each operation's exact result stays within, before the format cuts it.
    pub exact: Vec<Range>,
    /// What each operation's arguments, and each lookup's column and row, stay within where it
    /// is computed.
    pub args: Vec<[Range; 2]>,
}

/// The ranges of a scheduled graph.
pub fn ranges(graph: &Graph, tree: &Tree, slack: &Slack) -> Ranges {
    ranges_counted(graph, tree, slack).0
}

/// The same, and how many statements were walked: what it took.
pub fn ranges_counted(graph: &Graph, tree: &Tree, slack: &Slack) -> (Ranges, u64) {
    let start: Vec<Range> = graph.ids().map(|id| known(graph, slack, id)).collect();
    let mut walk = Walk {
        graph,
        slack,
        now: start.clone(),
        conditions: Conditions::new(graph),
        saved: Vec::new(),
        once: Once::new(graph, slack.direction.is_some()),
        carried: graph
            .loops
            .iter()
            .map(|l| vec![None; l.types.len()])
            .collect(),
        assumed: Vec::new(),
        readers: match slack.expects() {
            true => readers(graph),
            false => Readers::default(),
        },
        turns: 0,
        walked: 0,
        out: Ranges {
            result: start,
            exact: vec![Range::ALL; graph.nodes.len()],
            args: vec![[Range::ALL; 2]; graph.nodes.len()],
        },
        tree,
        shared: shared(graph, tree),
        growth: None,
        narrowing: false,
        ended: vec![Vec::new(); graph.loops.len()],
        heads: vec![None; graph.loops.len()],
        around: Around::default(),
        fresh: Fresh::default(),
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
    conditions: Conditions<'g>,
    /// What the conditions around have narrowed, and what it was.
    saved: Vec<(NodeId, Range)>,
    once: Once,
    carried: Vec<Vec<Option<Range>>>,
    /// What each loop's carried values stayed within when it was walked last.
    heads: Vec<Option<accelerate::Carried>>,
    /// What values that are computed here are known to stay within.
    assumed: Vec<(NodeId, Range)>,
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
    /// What a turn gives to what its loop carries, where that is looked at.
    growth: Option<Growth>,
    /// Whether turns are walked to narrow bounds that hold.
    narrowing: bool,
    /// What each loop's results were by others of them, when it was walked last.
    ended: Vec<Vec<Left>>,
    /// What is known here.
    around: Around,
    /// What values come to under it.
    fresh: Fresh,
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
                self.note_growth(*place, *from);
                let range = match *from {
                    Origin::Node(id) if self.looks_closely(*place, id) => self.fresh(id),
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
                self.arm(*cond, true, yes);
                let before = self.sets(yes);
                self.arm(*cond, false, no);
                for (place, range) in before {
                    // Arms end with what they set.
                    if set_by(no).rev().any(|p| p == place) {
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

    /// Walks an arm under its condition.
    fn arm(&mut self, cond: NodeId, holds: bool, block: &Block) {
        self.under((cond, holds), |walk| walk.block(block));
    }

    /// Does what is to be done where a condition holds, or does not.
    fn under<T>(&mut self, (cond, holds): Fact, run: impl FnOnce(&mut Self) -> T) -> T {
        let (saved, assumed) = (self.saved.len(), self.assumed.len());
        let known = Known {
            slack: self.slack,
            shared: &self.shared,
        };
        let (before, facts) = self
            .around
            .enter(&mut self.conditions, &self.shared, (cond, holds));
        for fact in facts {
            (self.conditions).refine(known, &mut self.now, &mut self.saved, fact);
        }
        for k in self.around.since(before) {
            self.known_result(self.around.fact(k));
        }
        self.fresh.clear();
        self.doubted(saved, cond, holds);
        (self.assumed).extend_from_slice(self.conditions.claimed(cond, holds));
        let found = run(self);
        self.assumed.truncate(assumed);
        self.around.leave(before);
        self.fresh.clear();
        restore(&mut self.now, &mut self.saved, saved);
        found
    }

    /// What a block sets, and to what.
    fn sets(&self, block: &Block) -> Vec<(Place, Range)> {
        set_by(block)
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
        *self.at(id)
    }

    fn at(&self, id: NodeId) -> &Range {
        &self.now[id.0 as usize]
    }

    fn write(&mut self, place: Place, range: Range) {
        match place {
            Place::Node(id) => self.put(id, range),
            Place::Carried(l, k) => self.carried[l.0 as usize][k as usize] = Some(range),
            Place::Scratch(..) => {}
        }
    }

    /// Notes what a node comes to here.
    fn put(&mut self, id: NodeId, range: Range) {
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

    /// An operation's range with what its being of whole numbers implies.
    fn whole(&mut self, id: NodeId, args: [Range; 2], range: Range) -> Range {
        let (graph, once) = (self.graph, &mut self.once);
        parity::whole(graph, &mut || once.odd(graph, id), id, args, range)
    }

    fn compute(&mut self, id: NodeId) {
        let at = id.0 as usize;
        let range = match self.graph.node(id) {
            Node::Apply(op, operands) => {
                let range = self.apply(id, op, operands);
                return self.put(id, range);
            }
            Node::Ramp { .. } => {
                let last = self.graph.image.width.saturating_sub(1) as i32;
                let all = ramp::range(self.graph, id, 0..=last, |part| self.read(part));
                let range = match all.within(self.slack.ints.lo, self.slack.ints.hi) {
                    true => all,
                    // It may wrap.
                    false => self.slack.ints,
                };
                self.whole(id, [Range::ALL; 2], range)
            }
            // As the column's block has left it.
            Node::Tabulated(_) => self.read(id),
            Node::Stepped { first, step } => {
                let args = [self.read(first), self.read(step)];
                let exact = interval(Op::IntAdd, args, false);
                let exact = self.whole(id, args, exact);
                self.out.exact[at] = exact;
                self.slack.cut(Type::Int, exact)
            }
            Node::Lookup { table, column, row } => {
                let at = [column, row].map(|id| self.read(id));
                match self.as_before(id, at.each_ref()) {
                    Some(range) => range,
                    None => {
                        self.note_args(id, at);
                        let range = self.entries(id, table, at);
                        self.once.keep(id, range)
                    }
                }
            }
            _ => Range::ALL,
        };
        let range = self.trust(id, range);
        self.put(id, range);
    }

    /// What an operation comes to here; its operands and its exact result are noted.
    fn apply(&mut self, id: NodeId, op: Op, operands: [NodeId; 2]) -> Range {
        let at = id.0 as usize;
        // Where operands are read as they are, they are looked at where they stand.
        let plain = self.slack.points.is_none();
        if plain && let Some(range) = self.as_before(id, operands.map(|id| self.at(id))) {
            return range;
        }
        let (args, same) = self.operands(id, op, operands);
        if !plain && let Some(range) = self.as_before(id, args.each_ref()) {
            return range;
        }
        let exact = interval(op, args, same);
        let exact = self.whole(id, args, exact);
        let exact = self.part_of_length(id, exact);
        self.note_args(id, args);
        self.out.exact[at] = match self.shared[at] {
            Some(true) => self.out.exact[at].join(exact),
            _ => exact,
        };
        let range = self.slack.result(id, op, &args[..op.arity()], exact);
        let range = self.trust(id, range);
        self.once.keep(id, range)
    }

    /// Notes what is given to a node here; of subroutines, to any of their calls.
    fn note_args(&mut self, id: NodeId, args: [Range; 2]) {
        let at = id.0 as usize;
        let [a, b] = self.out.args[at];
        self.out.args[at] = match self.shared[at] {
            Some(true) => [a.join(args[0]), b.join(args[1])],
            _ => args,
        };
    }
}

/// The places that a block sets, but for what is set inside its statements.
fn set_by(block: &Block) -> impl DoubleEndedIterator<Item = Place> {
    block.iter().filter_map(|s| match s {
        Statement::Set { place, .. } => Some(*place),
        _ => None,
    })
}
