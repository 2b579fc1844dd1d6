//! Abstract interpretation of a plan over a tile, with error forms.

use super::form::{Form, Source};
use super::rules::{inherited, leaves_ints};
use super::{Bound, Bounds, Tile, Value};
use crate::analysis::range::refine::{Conditions, Known, restore};
use crate::analysis::range::{Slack, shared};
use crate::ir::graph::*;
use crate::ir::interval::interval;
use crate::ir::ramp;
use crate::ir::tree::*;
use crate::plan::Plan;
use slowlight_routine::{Op, Range, Type};

/// How many turns of loops a tile is worth.
const PATIENCE: u32 = 5000;

/// How many statements, however few the turns.
const STATEMENTS: u64 = 5_000_000;

/// What the native evaluation itself may round, relative to the result.
const NATIVE: f64 = f64::EPSILON;

pub fn walk(plan: &Plan, tile: &Tile) -> Bounds {
    let graph = &plan.graph;
    let start: Vec<Value> = graph.ids().map(|id| known(plan, tile, id)).collect();
    let slots = |l: &Loop| vec![unknown(); l.types.len()];
    let mut walk = Walk {
        plan,
        graph,
        ranges: start.iter().map(|v| v.range).collect(),
        conditions: Conditions::new(graph),
        slack: Slack::exact(),
        shared: shared(graph, &plan.tree),
        saved: Vec::new(),
        errors: start.into_iter().map(|v| v.error).collect(),
        carried: graph.loops.iter().map(slots).collect(),
        scratch: graph.loops.iter().map(slots).collect(),
        sources: 0,
        turns: 0,
        columns: tile.columns,
        out: Bounds {
            values: vec![None; graph.nodes.len()],
            ..Bounds::default()
        },
    };
    for block in plan.tree.outer() {
        walk.block(block);
    }
    walk.out.operations = walk.sources;
    walk.out
}

fn unknown() -> Value {
    Value {
        range: Range::ALL,
        error: Form::unbounded(),
    }
}

/// What is known of a value that needs no computing. Constants and params come
/// with the error of being written in the machine's format.
fn known(plan: &Plan, tile: &Tile, id: NodeId) -> Value {
    let graph = &plan.graph;
    let point = |value| Value::exact(Range::point(value));
    match graph.node(id) {
        Node::Const(c) => {
            let exact = c.value();
            // It is rounded where it is read.
            if plan.points().is_some() {
                return point(exact.real());
            }
            let format = plan.runtime.format_of(exact.ty());
            let made = (plan.runtime.decode)(plan.bits(exact), format).real();
            Value {
                range: Range::point(exact.real()),
                error: Form::within((made - exact.real()).abs()),
            }
        }
        // Each param has a rounding of its own.
        Node::Param(p) => (tile.params.get(p.0 as usize)).map_or_else(unknown, |param| Value {
            range: param.0,
            error: Form::rounding(u32::MAX - p.0, param.1),
        }),
        Node::Axis(axis) => {
            let (first, last) = match axis {
                Axis::X | Axis::Run => tile.columns,
                Axis::Y => tile.rows,
                Axis::Pass(passes) => (0, passes.saturating_sub(1)),
            };
            Value::exact(Range::new(f64::from(first), f64::from(last.max(first))))
        }
        // Where errors are spread, what comes from other pixels is not known.
        Node::Received if graph.diffusion.is_none() => point(0.0),
        Node::Neighbour(which) if graph.refinement.is_none() => point(which.alone().into()),
        _ => unknown(),
    }
}

pub(super) struct Walk<'p> {
    pub(super) plan: &'p Plan,
    pub(super) graph: &'p Graph,
    /// What each node's exact value lies within here, refined by the conditions around.
    ranges: Vec<Range>,
    conditions: Conditions<'p>,
    slack: Slack,
    /// What calls of subroutines share.
    shared: Vec<Option<bool>>,
    /// What conditions around have narrowed, and what it was.
    saved: Vec<(NodeId, Range)>,
    errors: Vec<Form>,
    carried: Vec<Vec<Value>>,
    scratch: Vec<Vec<Value>>,
    /// How many roundings there were.
    pub(super) sources: Source,
    turns: u32,
    columns: (u32, u32),
    out: Bounds,
}

impl<'p> Walk<'p> {
    fn block(&mut self, block: &'p [Statement]) {
        for statement in block {
            self.out.walked += 1;
            match statement {
                Statement::Let(id) => {
                    let value = self.compute(*id);
                    self.write(Place::Node(*id), value);
                }
                Statement::Set { place, from } => {
                    let value = match *from {
                        Origin::Node(id) => self.copied(*place, id),
                        Origin::Scratch(l, k) => self.scratch[l.0 as usize][k as usize].clone(),
                    };
                    self.write(*place, value);
                }
                Statement::If { cond, yes, no } => self.choice(*cond, yes, no),
                Statement::Loop(turns) => self.run_loop(turns),
                Statement::Call(id) => self.block(self.plan.tree.body(*id)),
            }
        }
    }

    /// The arm that is taken, or both and what lies between.
    fn choice(&mut self, cond: NodeId, yes: &'p Block, no: &'p Block) {
        match self.ranges[cond.0 as usize].constant() {
            Some(0.0) => return self.block(no),
            Some(_) => return self.block(yes),
            None => {}
        }
        let before = self.arm(cond, true, yes);
        let after = self.arm(cond, false, no);
        for (place, value) in before {
            if let Some((_, other)) = after.iter().find(|(p, _)| *p == place) {
                self.write(place, value.join(other));
            } else {
                self.write(place, value);
            }
        }
    }

    /// Walks an arm under its condition; answers what it sets, and to what.
    fn arm(&mut self, cond: NodeId, holds: bool, block: &'p Block) -> Vec<(Place, Value)> {
        let before = self.saved.len();
        let known = Known {
            slack: &self.slack,
            shared: &self.shared,
        };
        (self.conditions).refine(known, &mut self.ranges, &mut self.saved, (cond, holds));
        self.block(block);
        restore(&mut self.ranges, &mut self.saved, before);
        let places = block.iter().filter_map(|s| match s {
            Statement::Set { place, .. } => Some(*place),
            _ => None,
        });
        places.map(|place| (place, self.held(place))).collect()
    }

    /// Turn by turn. The results are what lies between those of all turns that
    /// may be the last.
    fn run_loop(&mut self, turns: &'p Turns) {
        self.block(&turns.start);
        let max = self
            .graph
            .loops
            .get(turns.of.0 as usize)
            .map_or(1, |l| l.max);
        let mut ends: Vec<(Place, Value)> = Vec::new();
        let mut open = true;
        for _ in 0..max {
            self.turns += 1;
            if self.is_over() {
                break;
            }
            self.show_carried(turns.of);
            self.block(&turns.body);
            let again = self.ranges[turns.again.0 as usize].constant();
            if again.is_none_or(|v| v == 0.0) {
                let set = self.arm(turns.again, false, &turns.done);
                merge(&mut ends, set);
            }
            if again == Some(0.0) {
                open = false;
                break;
            }
            self.arm(turns.again, true, &turns.next);
        }
        if open {
            if self.is_over() {
                self.carried[turns.of.0 as usize].fill(unknown());
            }
            self.show_carried(turns.of);
            self.block(&turns.otherwise);
            let places = turns.otherwise.iter().filter_map(|s| match s {
                Statement::Set { place, .. } => Some((*place, self.held(*place))),
                _ => None,
            });
            let set: Vec<(Place, Value)> = places.collect();
            merge(&mut ends, set);
        }
        for (place, value) in ends {
            self.write(place, value);
        }
    }

    /// Whether the tile has had all that it is worth.
    fn is_over(&self) -> bool {
        self.turns > PATIENCE || self.out.walked > STATEMENTS
    }

    /// The carried values as the nodes that read them have them.
    fn show_carried(&mut self, of: LoopId) {
        for id in self.graph.ids() {
            if let Node::Carried { of: l, index } | Node::Last { of: l, index } =
                self.graph.node(id)
                && l == of
            {
                let value = self.carried[of.0 as usize][index as usize].clone();
                self.put(id, value);
            }
        }
    }

    fn held(&self, place: Place) -> Value {
        match place {
            Place::Node(id) => self.read(id),
            Place::Carried(l, k) => self.carried[l.0 as usize][k as usize].clone(),
            Place::Scratch(l, k) => self.scratch[l.0 as usize][k as usize].clone(),
        }
    }

    pub(super) fn read(&self, id: NodeId) -> Value {
        Value {
            range: self.ranges[id.0 as usize],
            error: self.errors[id.0 as usize].clone(),
        }
    }

    fn put(&mut self, id: NodeId, value: Value) {
        self.ranges[id.0 as usize] = value.range;
        self.errors[id.0 as usize] = value.error;
    }

    fn write(&mut self, place: Place, value: Value) {
        match place {
            Place::Node(id) => {
                self.note(id, &value);
                self.put(id, value);
            }
            Place::Carried(l, k) => self.carried[l.0 as usize][k as usize] = value,
            Place::Scratch(l, k) => self.scratch[l.0 as usize][k as usize] = value,
        }
    }

    fn note(&mut self, id: NodeId, value: &Value) {
        let found = &mut self.out.values[id.0 as usize];
        let error = value.error.bound();
        *found = Some(match *found {
            Some(old) => Bound {
                exact: old.exact.join(value.range),
                error: old.error.max(error),
            },
            None => Bound {
                exact: value.range,
                error,
            },
        });
    }

    fn compute(&mut self, id: NodeId) -> Value {
        match self.graph.node(id) {
            Node::Apply(op, [a, b]) => {
                let [x, y] = self.operands(id, op, [a, b]);
                let same = a == b && x == y;
                let range = interval(op, [x.range, y.range], a == b);
                if leaves_ints(self.plan.format(id), range) || !self.same_way(op, &x, &y) {
                    self.out.undecided.insert(id);
                }
                let passed = inherited(op, &x, &y, same, range);
                let made = self.own(id, op, [x.machine(), y.machine()], same, range);
                Value {
                    range,
                    error: passed.plus(&made),
                }
            }
            Node::Lookup { table, column, row } => self.entries(table, [column, row]),
            Node::Ramp { .. } => self.ramp(id),
            // As the column's block has left it.
            Node::Tabulated(_) => self.held(Place::Node(id)),
            Node::Stepped { first, step } => {
                let exact = |id: NodeId| self.errors[id.0 as usize].is_exact();
                let (a, b) = (self.read(first).range, self.read(step).range);
                match exact(first) && exact(step) {
                    true => Value::exact(Range::new(a.lo + b.lo, a.hi + b.hi)),
                    false => unknown(),
                }
            }
            _ => unknown(),
        }
    }

    /// A ramp: exact where it is stepped by the exact values and does not wrap.
    fn ramp(&self, id: NodeId) -> Value {
        let (first, last) = self.columns;
        let parts = ramp::coefficients(self.graph, id);
        let exact = |part: &NodeId| self.errors[part.0 as usize].is_exact();
        let all = ramp::range(self.graph, id, first as i32..=last as i32, |part| {
            self.ranges[part.0 as usize]
        });
        match parts.iter().all(exact) && all.within(f64::from(i32::MIN), f64::from(i32::MAX)) {
            true => Value::exact(all),
            false => unknown(),
        }
    }

    /// What lies between the entries of a table.
    fn entries(&self, id: TableId, at: [NodeId; 2]) -> Value {
        let format = self.plan.entry_format(id);
        let [column, row] = at.map(|id| self.graph.constant(id));
        let table = self.graph.tables.get(id.0 as usize);
        let places = table.into_iter().flat_map(|t| t.candidates(column, row));
        let values = places.map(|at| {
            let exact = table.map_or(0.0, |t| t.entries[at].value().real());
            let made = (self.plan.runtime.decode)(self.plan.entry(id, at), format).real();
            Value {
                range: Range::point(exact),
                error: Form::within((made - exact).abs()),
            }
        });
        values.reduce(|a, b| a.join(&b)).unwrap_or_else(unknown)
    }

    /// Whether the machine certainly takes the way of the exact values.
    fn same_way(&self, op: Op, x: &Value, y: &Value) -> bool {
        let (a, b) = (x.machine(), y.machine());
        match op {
            Op::Floor => a.lo.floor() == a.hi.floor(),
            Op::Round => a.lo.round() == a.hi.round(),
            Op::Sign => x.error.is_exact() || !a.contains(0.0),
            Op::Mod => (a.lo / b.lo).floor() == (a.hi / b.lo).floor() && y.error.is_exact(),
            Op::Less | Op::LessEqual | Op::Equal => {
                let off = x.error.minus(&y.error).bound();
                off == 0.0 || a.lo > b.hi || a.hi < b.lo || {
                    let gap = interval(Op::Sub, [x.range, y.range], false);
                    gap.lo > off || gap.hi < -off
                }
            }
            _ => true,
        }
    }

    /// The rounding of an operation itself, on the machine's arguments.
    fn own(&mut self, id: NodeId, op: Op, args: [Range; 2], same: bool, exact: Range) -> Form {
        if op.result() != Type::Real {
            return Form::EXACT;
        }
        let Some(routine) = self.plan.routine(id) else {
            return Form::unbounded();
        };
        let made = interval(op, args, same);
        // Beyond the format's end, a routine saturates.
        let native = exact.magnitude() * NATIVE;
        if made.magnitude() + native > self.plan.format(id).most() {
            return Form::unbounded();
        }
        self.sources += 1;
        let off = self.rounding(routine, id, op, (&args[..op.arity()], made));
        Form::rounding(self.sources, off + native)
    }
}

/// Joins what several ends of a loop set.
fn merge(all: &mut Vec<(Place, Value)>, more: Vec<(Place, Value)>) {
    for (place, value) in more {
        match all.iter_mut().find(|(p, _)| *p == place) {
            Some((_, old)) => *old = old.join(&value),
            None => all.push((place, value)),
        }
    }
}
