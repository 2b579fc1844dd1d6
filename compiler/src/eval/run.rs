//! Interpreter of statement trees, pixel by pixel, in any arithmetic.
//!
//! The same walk serves the tree in `f64` (to hold the passes against the
//! native evaluation) and in the routines' models (to hold the machines
//! against the plan). It also watches the homes: using one that was not
//! written on this path is counted, which a correct schedule never does. To
//! copy one is not to use it: the copy was not written either.

use super::arithmetic::Arithmetic;
use super::diffuse::Pending;
use super::neighbours::Around;
use super::places::{Source, own_places, places, source};
use crate::ir::graph::*;
use crate::ir::ramp;
use crate::ir::tree::*;
use slowlight_routine::{Op, Value};

/// Runs a tree over a graph.
pub struct Run<'t, A: Arithmetic> {
    graph: &'t Graph,
    tree: &'t Tree,
    arithmetic: A,
    /// Where each node is read.
    sources: Vec<Source>,
    /// What is held: by node, then what each loop carries, then its scratch places. Constants
    /// and params are there from the start.
    held: Vec<Option<A::Value>>,
    /// Where what each loop carries begins among them.
    carried: Vec<u32>,
    /// What the row and the pixel block write, to forget between turns.
    row_places: Vec<Place>,
    pixel_places: Vec<Place>,
    /// What each subroutine computes, to forget before it runs.
    own_places: Vec<Vec<Place>>,
    entries: Vec<Vec<A::Value>>,
    position: (i32, i32),
    row: Option<i32>,
    unset: u64,
    /// How many statements may run yet.
    left: u64,
    /// What later pixels will receive, and what this one has received.
    pending: Option<Pending<A::Value>>,
    received: A::Value,
    /// What those around it left.
    around: Around,
}

impl<'t, A: Arithmetic> Run<'t, A> {
    /// Runs the frame's block.
    pub fn new(graph: &'t Graph, tree: &'t Tree, arithmetic: A) -> Run<'t, A> {
        Run::within(graph, tree, arithmetic, u64::MAX)
    }

    /// The same where no more than so many statements are worth running: once they have,
    /// loops end as if they had no turns left, so that a pixel ends however many turns the
    /// scene allows it. See [`Run::spent`].
    pub fn within(graph: &'t Graph, tree: &'t Tree, arithmetic: A, most: u64) -> Run<'t, A> {
        let mut carried = Vec::with_capacity(graph.loops.len());
        let mut held: Vec<Option<A::Value>> = (graph.ids())
            .map(|id| match graph.node(id) {
                Node::Const(c) => Some(arithmetic.constant(c.value())),
                Node::Param(p) => Some(arithmetic.param(p)),
                _ => None,
            })
            .collect();
        for one in &graph.loops {
            carried.push(held.len() as u32);
            held.resize(held.len() + 2 * one.types.len(), None);
        }
        let entries = graph.tables.iter().zip(0..).map(|(t, k)| {
            let each = t.entries.iter().enumerate();
            each.map(|(at, e)| arithmetic.entry(TableId(k), at, e.value()))
                .collect()
        });
        let zero = arithmetic.constant(Value::Real(0.0));
        let mut run = Run {
            pending: Pending::new(graph, zero),
            received: zero,
            around: Around::new(graph),
            sources: graph.ids().map(|id| source(graph, &carried, id)).collect(),
            held,
            carried,
            row_places: places(tree, &tree.row),
            pixel_places: [&tree.column, &tree.pass, &tree.segment, &tree.pixel]
                .into_iter()
                .flat_map(|block| places(tree, block))
                .collect(),
            own_places: own_places(graph, tree),
            entries: entries.collect(),
            position: (0, 0),
            row: None,
            unset: 0,
            left: most,
            graph,
            tree,
            arithmetic,
        };
        run.block(&tree.frame);
        run
    }

    /// The same with each pixel by itself: none receives what others send, and what they leave
    /// is made up ([`Around::alone`]).
    #[must_use]
    pub fn alone(self) -> Run<'t, A> {
        Run {
            pending: None,
            around: self.around.alone(),
            ..self
        }
    }

    /// Whether all statements that were allowed have run: the last pixel is of no use then.
    pub fn spent(&self) -> bool {
        self.left == 0
    }

    /// How many statements are worth running yet.
    pub fn left(&self) -> u64 {
        self.left
    }

    /// How often a home was read that nothing had written on this path.
    pub fn unset_reads(&self) -> u64 {
        self.unset
    }

    /// Runs what stands before the pixel at column `x`, row `y`: the row's own statements, if it
    /// is another row, and the pass's.
    pub fn begin(&mut self, x: i32, y: i32) {
        self.pass(x, y);
    }

    /// Runs the pixel at column `x`, row `y`; answers its ink. Where it hangs on others,
    /// these run too, if they have not.
    pub fn pixel(&mut self, x: i32, y: i32) -> A::Value {
        let due = self.pending.as_mut().map_or(0..0, |p| p.due(x, y));
        for number in due {
            if let Some((x, y)) = self.pending.as_ref().map(|p| p.place(number)) {
                self.next(x, y);
            }
        }
        for (x, y) in self.around.due(x, y) {
            self.next(x, y);
        }
        let ink = self.next(x, y);
        self.around.count(self.graph, y);
        ink
    }

    /// How many of the pixels that were asked for were traced ([`Around::traced`]).
    pub fn traced(&self) -> u64 {
        self.around.traced()
    }

    /// Runs a pixel, the next in order where that matters.
    fn next(&mut self, x: i32, y: i32) -> A::Value {
        if let Some(pending) = &mut self.pending {
            self.received = pending.receive(x, y);
        }
        self.around.come(self.graph, x, y);
        let ink = self.plain(x, y);
        if let Some(Refinement { kept, .. }) = self.graph.refinement {
            let kept = self.read(kept);
            self.around.keep(x, y, self.arithmetic.int(kept));
        }
        for share in self.graph.shares() {
            let sent = self.read(share.node);
            let sent = self.arithmetic.sent(share.node, sent);
            let arithmetic = &self.arithmetic;
            if let Some(pending) = &mut self.pending {
                pending.send(x, y, share, sent, |a, b| arithmetic.gather(a, b));
            }
        }
        ink
    }

    fn plain(&mut self, x: i32, y: i32) -> A::Value {
        self.pass(x, y);
        self.block(&self.tree.segment);
        self.block(&self.tree.pixel);
        self.read(self.graph.ink)
    }

    /// Runs what begins the row, if it is another, and the pass of a pixel.
    fn pass(&mut self, x: i32, y: i32) {
        let tree = self.tree;
        self.position = (x, y);
        if self.row != Some(y) {
            self.forget(true);
            self.row = Some(y);
            self.block(&tree.row);
        }
        self.forget(false);
        // What hangs on the column alone is at every pixel what it was before the rows.
        self.block(&tree.column);
        self.block(&tree.pass);
    }

    /// Runs what begins a run of columns as if one began at a pixel, of the same pass as the
    /// last unless `first`; answers which of some bools it computed there, and what they are.
    pub fn segment(
        &mut self,
        (x, y): (i32, i32),
        first: bool,
        bools: &[NodeId],
    ) -> Vec<(NodeId, bool)> {
        if first {
            self.pass(x, y);
        }
        self.position = (x, y);
        for id in bools {
            self.held[id.0 as usize] = None;
        }
        self.block(&self.tree.segment);
        let held = |id: &NodeId| {
            let value = self.held.get(id.0 as usize).copied().flatten()?;
            Some((*id, self.arithmetic.truth(value)))
        };
        bools.iter().filter_map(held).collect()
    }

    /// A node's value after the last pixel, if the tree computed it.
    pub fn last(&self, id: NodeId) -> Option<A::Value> {
        self.held.get(id.0 as usize).copied().flatten()
    }

    /// What the graph reports, behind the picture.
    pub fn reports(&mut self) -> Vec<A::Value> {
        self.block(&self.tree.step);
        let reports = self.graph.reports.iter();
        reports.map(|&id| self.read(id)).collect()
    }

    fn forget(&mut self, row: bool) {
        let of = |run: &mut Self, places| match row {
            true => std::mem::replace(&mut run.row_places, places),
            false => std::mem::replace(&mut run.pixel_places, places),
        };
        let places = of(self, Vec::new());
        for &place in &places {
            *self.slot(place) = None;
        }
        of(self, places);
    }

    fn at(&self, place: Place) -> usize {
        let carried = |l: LoopId| self.carried[l.0 as usize] as usize;
        match place {
            Place::Node(id) => id.0 as usize,
            Place::Carried(l, k) => carried(l) + k as usize,
            Place::Scratch(l, k) => {
                carried(l) + self.graph.loops[l.0 as usize].types.len() + k as usize
            }
        }
    }

    fn slot(&mut self, place: Place) -> &mut Option<A::Value> {
        let at = self.at(place);
        &mut self.held[at]
    }

    fn checked(&mut self, found: Option<A::Value>) -> A::Value {
        found.unwrap_or_else(|| {
            self.unset += 1;
            self.arithmetic.constant(Value::Int(0))
        })
    }

    fn read(&mut self, id: NodeId) -> A::Value {
        let int = match self.sources[id.0 as usize] {
            Source::Held(at) => return self.checked(self.held[at as usize]),
            Source::Column => self.position.0,
            Source::Row => self.position.1,
            Source::Pass(n) => self.position.0.rem_euclid(n),
            Source::Received => return self.received,
            Source::Neighbour(which) => self.around.left[which as usize],
            Source::Ramp => return self.ramp(id),
        };
        self.arithmetic.constant(Value::Int(int))
    }

    /// Whether nothing was written here that could be copied: what a search leaves
    /// that has found nothing, say. Who copies it has as little; who uses it is
    /// counted.
    fn is_unset(&self, id: NodeId) -> bool {
        match self.sources[id.0 as usize] {
            Source::Held(at) => {
                self.held[at as usize].is_none() && !matches!(self.graph.node(id), Node::Slot(_))
            }
            _ => false,
        }
    }

    /// A ramp here: set where the row or pass began, stepped at the end of each pixel.
    fn ramp(&mut self, id: NodeId) -> A::Value {
        self.checked(self.held[id.0 as usize]);
        let parts = ramp::coefficients(self.graph, id);
        let parts: Vec<A::Value> = parts.into_iter().map(|part| self.read(part)).collect();
        let stride = ramp::stride(self.graph, id) as i32;
        self.arithmetic
            .ramp(self.position.0.div_euclid(stride), &parts)
    }

    fn compute(&mut self, id: NodeId) -> A::Value {
        match self.graph.node(id) {
            Node::Apply(op, [a, b]) => {
                let a = self.read(a);
                let b = if op.arity() > 1 { self.read(b) } else { a };
                self.arithmetic.apply(id, op, &[a, b][..op.arity()])
            }
            Node::Lookup { table, column, row } => {
                let (column, row) = (self.read(column), self.read(row));
                let (column, row) = (self.arithmetic.int(column), self.arithmetic.int(row));
                let at = self
                    .graph
                    .tables
                    .get(table.0 as usize)
                    .map_or(0, |t| t.index(column, row));
                let found = self.entries[table.0 as usize].get(at).copied();
                self.checked(found)
            }
            Node::Ramp { first, .. } => self.read(first),
            Node::Stepped { first, step } => {
                let both = [first, step].map(|id| {
                    let value = self.read(id);
                    Value::Int(self.arithmetic.int(value))
                });
                self.arithmetic.constant(Op::IntAdd.eval(&both))
            }
            _ => self.read(id),
        }
    }

    /// Runs a subroutine. What it left behind when it ran before is forgotten.
    fn call(&mut self, id: SubroutineId) {
        let at = id.0 as usize;
        let own = self.own_places.get_mut(at).map(std::mem::take);
        for &place in own.iter().flatten() {
            *self.slot(place) = None;
        }
        if let (Some(held), Some(own)) = (self.own_places.get_mut(at), own) {
            *held = own;
        }
        self.block(self.tree.body(id));
    }

    fn block(&mut self, block: &'t [Statement]) {
        for statement in block {
            self.arithmetic.step(statement);
            self.left = self.left.saturating_sub(1);
            match statement {
                Statement::Let(id) => {
                    let value = self.compute(*id);
                    self.held[id.0 as usize] = Some(value);
                }
                Statement::Set { place, from } => {
                    *self.slot(*place) = match *from {
                        Origin::Node(id) if self.is_unset(id) => None,
                        Origin::Node(id) => {
                            let value = self.read(id);
                            Some(self.arithmetic.copied(*place, id, value))
                        }
                        Origin::Scratch(l, k) => self.held[self.at(Place::Scratch(l, k))],
                    };
                }
                Statement::If { cond, yes, no } => {
                    let cond = self.read(*cond);
                    self.block(if self.arithmetic.truth(cond) { yes } else { no });
                }
                Statement::Loop(turns) => self.turns(turns),
                Statement::Call(id) => self.call(*id),
            }
        }
    }

    fn turns(&mut self, turns: &'t Turns) {
        self.block(&turns.start);
        let found = self.graph.loops.get(turns.of.0 as usize);
        let max = found.map_or(1, |l| l.max);
        let mut taken = 0;
        loop {
            self.block(&turns.body);
            let again = self.read(turns.again);
            if !self.arithmetic.truth(again) {
                return self.block(&turns.done);
            }
            self.block(&turns.next);
            taken += 1;
            if let Some(of) = found {
                let from = self.carried[turns.of.0 as usize] as usize;
                let carried = &self.held[from..from + of.types.len()];
                self.arithmetic.turn(turns.of, taken, carried);
            }
            if taken == max || self.spent() {
                return self.block(&turns.otherwise);
            }
        }
    }
}
