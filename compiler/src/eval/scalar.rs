//! The native evaluation's meaning, written as plainly as it can be: a graph in
//! `f64`, by need, one pixel at a time. The tests hold the lanes of
//! [`super::native`] against it, in what they compute and in how much.
//!
//! A value is computed when it is first needed and remembered until something
//! that it depends on changes (its rate says what that is).

use super::diffuse::Pending;
use super::native::{Pixel, param_value};
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
use crate::ir::ramp;
use slowlight_routine::{Op, Value};

/// How a loop's last run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    Done,
    Otherwise,
}

/// Evaluates one graph, pixel by pixel, in any order of pixels (row by row is
/// cheapest). Where a graph spreads its error, a pixel needs those before it in
/// the picture: they are evaluated too, each once if pixels are asked for in order.
pub struct Scalar<'g> {
    graph: &'g Graph,
    rates: Rates,
    /// The sets that each dependence is in, by dependence number.
    members: Vec<Vec<u32>>,
    /// When each set last changed.
    changed: Vec<u64>,
    values: Vec<Value>,
    /// When each value was computed; 0 never.
    computed: Vec<u64>,
    clock: u64,
    carried: Vec<Vec<Value>>,
    ends: Vec<End>,
    /// When each loop was run; 0 never.
    ran: Vec<u64>,
    /// For each loop, the set of its results.
    loop_sets: Vec<u32>,
    position: Option<(i32, i32)>,
    operations: u64,
    /// What later pixels will receive, and what this one has received.
    pending: Option<Pending<Value>>,
    received: Value,
}

fn number(d: Dependence) -> usize {
    match d {
        Dependence::Frame => 0,
        Dependence::Row => 1,
        Dependence::Column | Dependence::Pass => 2,
        Dependence::Loop(l) => 3 + 2 * l.0 as usize,
        Dependence::Last(l) => 4 + 2 * l.0 as usize,
    }
}

impl<'g> Scalar<'g> {
    /// Prepares a graph that [`crate::analysis::verify`] accepts.
    pub fn new(graph: &'g Graph) -> Scalar<'g> {
        let rates = rates(graph);
        let mut members = vec![Vec::new(); 3 + 2 * graph.loops.len()];
        for (k, set) in rates.sets.iter().enumerate() {
            for &d in set {
                members[number(d)].push(k as u32);
            }
        }
        let mut loop_sets = vec![0; graph.loops.len()];
        for id in graph.ids() {
            if let Node::Result { of, .. } = graph.node(id)
                && let Some(set) = loop_sets.get_mut(of.0 as usize)
            {
                *set = rates.set(id).0;
            }
        }
        Scalar {
            members,
            changed: vec![1; rates.sets.len()],
            values: vec![Value::Int(0); graph.nodes.len()],
            computed: vec![0; graph.nodes.len()],
            clock: 1,
            carried: graph
                .loops
                .iter()
                .map(|l| vec![Value::Int(0); l.types.len()])
                .collect(),
            ends: vec![End::Done; graph.loops.len()],
            ran: vec![0; graph.loops.len()],
            loop_sets,
            position: None,
            operations: 0,
            pending: Pending::new(graph, Value::Real(0.0)),
            received: Value::Real(0.0),
            graph,
            rates,
        }
    }

    /// How many operations, selects, lookups and loop turns were computed so far.
    pub fn operations(&self) -> u64 {
        self.operations
    }

    /// The picture's ink and shade at column `x`, row `y`.
    pub fn pixel(&mut self, x: i32, y: i32) -> Pixel {
        if let Some(pending) = &mut self.pending {
            for number in pending.due(x, y) {
                if let Some((x, y)) = self.pending.as_ref().map(|p| p.place(number)) {
                    self.spreading(x, y);
                }
            }
            return self.spreading(x, y);
        }
        self.plain(x, y)
    }

    /// A pixel of a graph that spreads its error, the next in order.
    fn spreading(&mut self, x: i32, y: i32) -> Pixel {
        if let Some(pending) = &mut self.pending {
            self.received = pending.receive(x, y);
        }
        let pixel = self.plain(x, y);
        for share in self.graph.shares() {
            let sent = self.value(share.node);
            if let Some(pending) = &mut self.pending {
                pending.send(x, y, share, sent, |a, b| Op::Add.eval(&[a, b]));
            }
        }
        pixel
    }

    fn plain(&mut self, x: i32, y: i32) -> Pixel {
        let (was_x, was_y) = self
            .position
            .map_or((None, None), |(x, y)| (Some(x), Some(y)));
        if was_y != Some(y) {
            self.change(Dependence::Row);
        }
        if was_x != Some(x) {
            self.change(Dependence::Column);
        }
        self.position = Some((x, y));
        let top = self.graph.image.palette.len().saturating_sub(1) as i32;
        let ink = self.value(self.graph.ink).int().clamp(0, top);
        let shade = match self.graph.shade {
            Some(shade) => self.value(shade).real(),
            None => f64::from(ink) / f64::from(top.max(1)),
        };
        Pixel {
            ink: ink as u8,
            shade,
        }
    }

    fn change(&mut self, what: Dependence) {
        self.clock += 1;
        for &set in &self.members[number(what)] {
            self.changed[set as usize] = self.clock;
        }
    }

    fn known(&self, id: NodeId) -> bool {
        let at = id.0 as usize;
        self.computed[at] >= self.changed[self.rates.of[at].0 as usize]
    }

    /// A node's value here and now.
    fn value(&mut self, root: NodeId) -> Value {
        let mut stack = vec![root];
        while let Some(&id) = stack.last() {
            if self.known(id) {
                stack.pop();
                continue;
            }
            if let Some(value) = self.step(id, &mut stack) {
                self.values[id.0 as usize] = value;
                self.computed[id.0 as usize] = self.clock;
                stack.pop();
            }
        }
        self.values[root.0 as usize]
    }

    /// The node's value if all that it needs is known; else what it needs is
    /// pushed on the stack.
    fn step(&mut self, id: NodeId, stack: &mut Vec<NodeId>) -> Option<Value> {
        let graph = self.graph;
        match graph.node(id) {
            Node::Const(c) => Some(c.value()),
            Node::Param(p) => Some(param_value(graph, p)),
            Node::Axis(axis) => {
                let (x, y) = self.position.unwrap_or_default();
                Some(Value::Int(match axis {
                    Axis::X | Axis::Run => x,
                    Axis::Y => y,
                    Axis::Pass(n) => x.rem_euclid(n.max(1) as i32),
                }))
            }
            Node::Apply(op, [a, b]) => {
                let a = self.get(a, stack);
                let b = if op.arity() > 1 {
                    self.get(b, stack)
                } else {
                    a
                };
                let args = [a?, b?];
                self.operations += 1;
                Some(op.eval(&args[..op.arity()]))
            }
            Node::Select { cond, yes, no } => {
                let arm = if self.get(cond, stack)?.truth() {
                    yes
                } else {
                    no
                };
                let value = self.get(arm, stack)?;
                self.operations += 1;
                Some(value)
            }
            Node::Lookup { table, column, row } => {
                let (column, row) = (self.get(column, stack), self.get(row, stack));
                let (column, row) = (column?.int(), row?.int());
                self.operations += 1;
                Some(graph.tables.get(table.0 as usize)?.at(column, row))
            }
            Node::Tabulated(value) => self.get(value, stack),
            Node::Stepped { first, step } => {
                let (first, step) = (self.get(first, stack), self.get(step, stack));
                self.operations += 1;
                Some(Op::IntAdd.eval(&[first?, step?]))
            }
            Node::Ramp { .. } => {
                let parts = ramp::coefficients(graph, id).into_iter();
                let parts: Vec<_> = parts.map(|part| self.get(part, stack)).collect();
                let parts: Option<Vec<i32>> = parts.iter().map(|v| v.map(Value::int)).collect();
                let parts = parts?;
                self.operations += 1;
                let x = self.position.map_or(0, |(x, _)| x);
                let x = x.div_euclid(ramp::stride(graph, id) as i32);
                Some(Value::Int(ramp::at(x, &parts)))
            }
            Node::Carried { of, index } | Node::Last { of, index } => {
                let found = self
                    .carried
                    .get(of.0 as usize)
                    .and_then(|c| c.get(index as usize));
                Some(found.copied().unwrap_or(Value::Int(0)))
            }
            Node::Result { of, index } => {
                let at = of.0 as usize;
                if self.ran[at] < self.changed[self.loop_sets[at] as usize] {
                    self.run(of);
                }
                let found = &graph.loops[at];
                let list = match self.ends[at] {
                    End::Done => &found.done,
                    End::Otherwise => &found.otherwise,
                };
                let value = list.get(index as usize).map(|&n| self.get(n, stack));
                value.unwrap_or(Some(Value::Int(0)))
            }
            Node::Received => Some(self.received),
            Node::Neighbour(which) => Some(Value::Int(which.alone())),
            Node::Slot(_) | Node::Undefined(_) => Some(Value::Int(0)),
        }
    }

    fn get(&self, id: NodeId, stack: &mut Vec<NodeId>) -> Option<Value> {
        if self.known(id) {
            return Some(self.values[id.0 as usize]);
        }
        stack.push(id);
        None
    }

    /// Runs a loop to its end; its carried values stay as the last turn has them.
    fn run(&mut self, of: LoopId) {
        let graph = self.graph;
        let at = of.0 as usize;
        let found = &graph.loops[at];
        let mut carried: Vec<Value> = found.init.iter().map(|&n| self.value(n)).collect();
        self.ends[at] = End::Otherwise;
        for _ in 0..found.max {
            self.carried[at].clone_from(&carried);
            self.change(Dependence::Loop(of));
            self.operations += 1;
            if !self.value(found.again).truth() {
                self.ends[at] = End::Done;
                break;
            }
            for (slot, &next) in carried.iter_mut().zip(&found.next) {
                *slot = self.value(next);
            }
        }
        if self.ends[at] == End::Otherwise {
            self.carried[at].clone_from(&carried);
            self.change(Dependence::Last(of));
        }
        self.ran[at] = self.clock;
    }
}
