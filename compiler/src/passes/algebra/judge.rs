//! Whether what algebra puts in the place of a value is worth it: the machine's
//! cycles for a pixel, and what is lost to roundings.
//!
//! Roundings are followed through both formulas at pixels spread over the picture
//! (and params over their ranges), to first order: each operation adds a unit in
//! the last place of its result, exact ones nothing. That is an estimate, not a
//! bound; it is compared with the same estimate for what stands there now.

use super::New;
use crate::flow::build::Builder;
use crate::flow::graph::*;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Runtime, Type, Value};
use std::collections::BTreeMap;

/// Nodes of a graph that is there or being built.
pub trait Nodes {
    fn node(&self, id: NodeId) -> Node;
}

impl Nodes for Graph {
    fn node(&self, id: NodeId) -> Node {
        Graph::node(self, id)
    }
}

impl Nodes for crate::flow::build::Builder {
    fn node(&self, id: NodeId) -> Node {
        crate::flow::build::Builder::node(self, id)
    }
}

/// Cycles a pixel for all that a value needs and that is another in every
/// column, beside what is there anyway; either arm of a choice is taken for half
/// of the pixels.
pub fn cycles(
    nodes: &dyn Nodes,
    root: NodeId,
    runtime: &Runtime,
    there: &dyn Fn(NodeId) -> bool,
) -> u32 {
    let mut varies = FxHashMap::default();
    let stepping = runtime.stepping.filter(|s| s.foreseen);
    // How often each value is needed; users have greater numbers.
    let mut todo: BTreeMap<NodeId, f64> = BTreeMap::from([(root, 1.0)]);
    let mut sum = 0.0;
    while let Some((id, often)) = todo.pop_last() {
        if there(id) || !column(nodes, id, &mut varies, 0) {
            continue;
        }
        let mut needs = |id: NodeId, part: f64| {
            let held = todo.entry(id).or_insert(0.0);
            *held = match part < 1.0 {
                true => (*held + often * part).min(1.0),
                false => held.max(often),
            };
        };
        // The column itself is there anyway.
        if let Some(stepping) = stepping
            && !matches!(nodes.node(id), Node::Axis(_))
            && let Some(degree @ 1..) = degree(nodes, id, &mut varies)
        {
            sum += often * f64::from(degree * stepping.ramp);
            continue;
        }
        match nodes.node(id) {
            Node::Select { cond, yes, no } => {
                needs(cond, 1.0);
                needs(yes, 0.5);
                needs(no, 0.5);
            }
            node => {
                node.operands().for_each(|id| needs(id, 1.0));
                if let Node::Apply(op, _) = node {
                    let found = runtime.usual(op);
                    sum += often * found.map_or(0.0, |r| f64::from(r.cycles));
                }
            }
        }
    }
    sum as u32
}

/// The degree of an int that is a polynomial in the column and could be stepped.
fn degree(nodes: &dyn Nodes, id: NodeId, varies: &mut FxHashMap<NodeId, bool>) -> Option<u32> {
    if !column(nodes, id, varies, 0) {
        return Some(0);
    }
    let mut of = |id| degree(nodes, id, varies);
    let found = match nodes.node(id) {
        Node::Axis(Axis::X) => 1,
        Node::Apply(Op::IntAdd | Op::IntSub, [a, b]) => of(a)?.max(of(b)?),
        Node::Apply(Op::IntMul, [a, b]) => of(a)? + of(b)?,
        Node::Apply(Op::IntNeg, [a, _]) => of(a)?,
        _ => return None,
    };
    (found <= 2).then_some(found)
}

/// Whether a node depends on the column beyond its pass (or on a loop); deep graphs count as such.
fn column(nodes: &dyn Nodes, id: NodeId, known: &mut FxHashMap<NodeId, bool>, deep: u32) -> bool {
    if let Some(&found) = known.get(&id) {
        return found;
    }
    let made = match nodes.node(id) {
        Node::Axis(Axis::X) => true,
        _ if deep > 500 => true,
        Node::Carried { .. } | Node::Last { .. } | Node::Result { .. } | Node::Received => true,
        node => node.operands().any(|a| column(nodes, a, known, deep + 1)),
    };
    known.insert(id, made);
    made
}

/// A pixel and params.
#[derive(Clone, Debug)]
pub struct Sample {
    pub x: f64,
    pub y: f64,
    pub params: Vec<f64>,
}

/// Pixels spread over the picture, params over their ranges.
pub fn samples(graph: &Graph) -> Vec<Sample> {
    let places = |n: u32, count: u32| {
        let last = n.saturating_sub(1);
        (0..count).map(move |k| f64::from(last * k / (count - 1)))
    };
    let kinds = if graph.params.is_empty() { 1 } else { 5 };
    let params = (0..kinds).map(|kind| {
        let each = graph.params.iter().enumerate().map(|(k, p)| {
            let (lo, hi) = p.range.map_or((p.value, p.value), |r| (r.lo, r.hi));
            match kind {
                0 => p.value,
                1 => lo,
                2 => hi,
                n if (k + n).is_multiple_of(2) => lo + (hi - lo) * 0.27,
                _ => lo + (hi - lo) * 0.81,
            }
        });
        each.collect::<Vec<f64>>()
    });
    let params: Vec<Vec<f64>> = params.collect();
    let mut all = Vec::new();
    for y in places(graph.image.height, 6) {
        for x in places(graph.image.width, 7) {
            let of = |params: &Vec<f64>| Sample {
                x,
                y,
                params: params.clone(),
            };
            all.extend(params.iter().map(of));
        }
    }
    all
}

/// A value and how far roundings may have moved it, in units of the format's.
#[derive(Clone, Copy, Debug)]
pub struct Rounded {
    pub value: f64,
    pub off: f64,
}

impl Rounded {
    fn exact(value: f64) -> Rounded {
        Rounded { value, off: 0.0 }
    }
}

/// Values by node, all forgotten at once: there is a sample after the other.
#[derive(Debug, Default)]
pub struct Known {
    /// By node, what is known, and the turn that it is known of.
    values: Vec<(u32, Rounded)>,
    nodes: Vec<NodeId>,
    turn: u32,
}

impl Known {
    fn get(&self, id: NodeId) -> Option<Rounded> {
        let found = self.values.get(id.0 as usize);
        found.filter(|v| v.0 == self.turn + 1).map(|v| v.1)
    }

    fn insert(&mut self, id: NodeId, value: Rounded) {
        let place = id.0 as usize;
        if place >= self.values.len() {
            self.values.resize(place + 1, (0, Rounded::exact(0.0)));
        }
        self.values[place] = (self.turn + 1, value);
        self.nodes.push(id);
    }

    fn forget(&mut self) {
        self.nodes.clear();
        self.turn += 1;
    }

    fn iter(&self) -> impl Iterator<Item = (NodeId, Rounded)> {
        let known = |id: &NodeId| Some((*id, self.get(*id)?));
        self.nodes.iter().filter_map(known)
    }
}

/// A value at a sample; nothing where it depends on a loop.
pub struct Follow<'n> {
    pub nodes: &'n dyn Nodes,
    pub tables: &'n dyn Fn(TableId) -> Option<&'n Table>,
    pub sample: &'n Sample,
    known: Known,
}

impl<'n> Follow<'n> {
    pub fn new(
        nodes: &'n dyn Nodes,
        tables: &'n dyn Fn(TableId) -> Option<&'n Table>,
        sample: &'n Sample,
    ) -> Follow<'n> {
        Follow {
            nodes,
            tables,
            sample,
            known: Known::default(),
        }
    }

    /// Goes on to another sample, of which nothing is known.
    fn to(&mut self, sample: &'n Sample) {
        self.known.forget();
        self.sample = sample;
    }

    pub fn value(&mut self, id: NodeId, deep: u32) -> Option<Rounded> {
        if let Some(found) = self.known.get(id) {
            return Some(found);
        }
        if deep > 500 {
            return None;
        }
        let made = match self.nodes.node(id) {
            Node::Const(c) => constant(c.value()),
            Node::Param(p) => Rounded::exact(*self.sample.params.get(p.0 as usize)?),
            Node::Axis(Axis::X | Axis::Run) => Rounded::exact(self.sample.x),
            Node::Axis(Axis::Y) => Rounded::exact(self.sample.y),
            Node::Axis(Axis::Pass(n)) => {
                Rounded::exact(self.sample.x.rem_euclid(f64::from(n.max(1))))
            }
            Node::Select { cond, yes, no } => {
                let cond = self.value(cond, deep + 1)?.value != 0.0;
                self.value(if cond { yes } else { no }, deep + 1)?
            }
            Node::Lookup { table, column, row } => {
                let place = [column, row].map(|id| self.value(id, deep + 1));
                let [Some(column), Some(row)] = place else {
                    return None;
                };
                let table = (self.tables)(table)?;
                constant(table.at(column.value as i32, row.value as i32))
            }
            Node::Apply(op, [a, b]) => {
                let a = self.value(a, deep + 1)?;
                let b = match op.arity() {
                    1 => a,
                    _ => self.value(b, deep + 1)?,
                };
                applied(op, a, b)
            }
            _ => return None,
        };
        self.known.insert(id, made);
        Some(made)
    }
}

impl Follow<'_> {
    /// Whether a root was taken of what is below 0.
    fn misses_root(&self) -> bool {
        let below = |id: NodeId| self.known.get(id).is_some_and(|a| a.value < 0.0);
        let mut ids = self.known.nodes.iter();
        ids.any(|id| matches!(self.nodes.node(*id), Node::Apply(Op::Sqrt, [a, _]) if below(a)))
    }
}

fn constant(value: Value) -> Rounded {
    let value = value.real();
    let off = if value.fract() == 0.0 {
        0.0
    } else {
        value.abs() / 2.0
    };
    Rounded { value, off }
}

pub fn applied(op: Op, a: Rounded, b: Rounded) -> Rounded {
    let args = [a.value, b.value].map(|x| match op.args().first() {
        Some(Type::Int) => Value::Int(x as i32),
        Some(Type::Bool) => Value::Bool(x != 0.0),
        _ => Value::Real(x),
    });
    let value = op.eval(&args[..op.arity()]).real();
    let carried = match op {
        Op::Add | Op::Sub | Op::IntAdd | Op::IntSub => a.off + b.off,
        Op::Mul | Op::IntMul => a.off * b.value.abs() + b.off * a.value.abs(),
        Op::Div => (a.off + value.abs() * b.off) / b.value.abs().max(1e-300),
        Op::Sqrt => a.off / (2.0 * value).max(1e-300),
        Op::Min | Op::Max => a.off.max(b.off),
        _ => a.off,
    };
    // Whole numbers that are not large are exact.
    let whole = carried == 0.0 && value.abs() < 4e9 && value == value as i64 as f64;
    let own = match op.result() {
        Type::Real if !whole && !matches!(op, Op::Neg | Op::Abs) => value.abs(),
        _ => 0.0,
    };
    Rounded {
        value,
        off: carried + own,
    }
}

/// What decides whether roundings do too much.
pub struct Judge<'g> {
    pub graph: &'g Graph,
    pub samples: &'g [Sample],
    pub allowance: f64,
}

/// By which part two formulas for one value may differ in `f64`.
const APART: f64 = 1e-6;

impl Judge<'_> {
    /// Whether roundings do no more to a value or a comparison than allowed.
    pub fn sound(&self, b: &Builder, new: New<'_>, old: NodeId, made: NodeId) -> bool {
        self.judged(b, new, old, made, false)
    }

    /// The same of formulas that hold where roots are of what is not below 0.
    pub fn equal(&self, b: &Builder, new: New<'_>, old: NodeId, made: NodeId) -> bool {
        self.judged(b, new, old, made, true)
    }

    fn judged(
        &self,
        b: &Builder,
        new: New<'_>,
        old: NodeId,
        made: NodeId,
        where_equal: bool,
    ) -> bool {
        let graph = self.graph;
        let Some(first) = self.samples.first() else {
            return false;
        };
        let now = |t: TableId| graph.tables.get(t.0 as usize);
        let mut was = Follow::new(graph, &now, first);
        let next = |t: TableId| b.table_of(t);
        let mut is = Follow::new(b, &next, first);
        let mut told = 0;
        for sample in self.samples {
            was.to(sample);
            let Some(before) = relative(&mut was, graph, old) else {
                continue;
            };
            let value = was.value(old, 0);
            // There the value is not needed: its roots are of what is not below 0.
            if where_equal && was.misses_root() {
                continue;
            }
            is.to(sample);
            // What both need is the same in both.
            for (id, value) in was.known.iter() {
                let shared =
                    matches!(graph.node(id), Node::Lookup { .. }) || graph.ty(id) == Type::Int;
                if let Some(id) = shared.then(|| new(id)).flatten() {
                    is.known.insert(id, value);
                }
            }
            let Some(after) = relative(&mut is, b, made) else {
                return false;
            };
            told += 1;
            let differs = where_equal && !agree(value, is.value(made, 0));
            if differs || after > self.allowance * before.max(2.0) {
                return false;
            }
        }
        told > 0
    }
}

/// Whether two values are one but for roundings of `f64`.
fn agree(a: Option<Rounded>, b: Option<Rounded>) -> bool {
    let (Some(a), Some(b)) = (a, b) else {
        return false;
    };
    let size = a.value.abs().max(b.value.abs()).max(1.0);
    (a.value - b.value).abs() <= APART * size
}

/// How much of a value, or of a comparison's difference, roundings may change:
/// in units of the format, as a part of it.
fn relative(follow: &mut Follow<'_>, nodes: &dyn Nodes, id: NodeId) -> Option<f64> {
    let part = |r: Rounded| r.off / r.value.abs().max(1e-300);
    match nodes.node(id) {
        Node::Const(_) => Some(0.0),
        Node::Select { cond, yes, no } => {
            let holds = follow.value(cond, 0)?.value != 0.0;
            relative(follow, nodes, if holds { yes } else { no })
        }
        Node::Apply(op, [a, b]) if op.result() == Type::Bool && op.arity() == 2 => {
            let (a, b) = (follow.value(a, 0)?, follow.value(b, 0)?);
            Some(part(Rounded {
                value: a.value - b.value,
                off: a.off + b.off,
            }))
        }
        _ => follow.value(id, 0).map(part),
    }
}
