//! First-order rounding errors at samples: values at pixels spread over the picture (and params
//! over their ranges), with how far roundings may have moved them: each operation adds a unit in
//! the last place of its result, exact ones nothing.

use crate::ir::graph::*;
use slowlight_routine::{Op, Type, Value};

/// Nodes of a graph that is there or being built.
pub trait Nodes {
    fn node(&self, id: NodeId) -> Node;
}

impl Nodes for Graph {
    fn node(&self, id: NodeId) -> Node {
        Graph::node(self, id)
    }
}

impl Nodes for crate::ir::build::Builder {
    fn node(&self, id: NodeId) -> Node {
        crate::ir::build::Builder::node(self, id)
    }
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
    turn: u32,
}

impl Known {
    pub fn get(&self, id: NodeId) -> Option<Rounded> {
        let found = self.values.get(id.0 as usize);
        found.filter(|v| v.0 == self.turn + 1).map(|v| v.1)
    }

    pub fn insert(&mut self, id: NodeId, value: Rounded) {
        let place = id.0 as usize;
        if place >= self.values.len() {
            self.values.resize(place + 1, (0, Rounded::exact(0.0)));
        }
        self.values[place] = (self.turn + 1, value);
    }

    fn forget(&mut self) {
        self.turn += 1;
    }
}

/// A value at a sample; nothing where it depends on a loop.
pub struct Follow<'n, N> {
    pub nodes: &'n N,
    pub tables: &'n dyn Fn(TableId) -> Option<&'n Table>,
    pub sample: &'n Sample,
    pub known: Known,
    /// The greatest magnitude of a real that was computed here.
    most: f64,
    /// Whether a root was taken of what is below 0.
    misses_root: bool,
}

impl<'n, N: Nodes> Follow<'n, N> {
    pub fn new(
        nodes: &'n N,
        tables: &'n dyn Fn(TableId) -> Option<&'n Table>,
        sample: &'n Sample,
    ) -> Follow<'n, N> {
        Follow {
            nodes,
            tables,
            sample,
            known: Known::default(),
            most: 0.0,
            misses_root: false,
        }
    }

    /// Goes on to another sample, of which nothing is known.
    pub fn to(&mut self, sample: &'n Sample) {
        self.known.forget();
        (self.most, self.misses_root) = (0.0, false);
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
                let made = applied(op, a, b);
                if op.result() == Type::Real {
                    self.most = self.most.max(made.value.abs());
                    self.misses_root |= op == Op::Sqrt && a.value < 0.0;
                }
                made
            }
            _ => return None,
        };
        self.known.insert(id, made);
        Some(made)
    }
}

impl<N> Follow<'_, N> {
    /// The greatest magnitude of a real that an operation came to.
    pub fn most(&self) -> f64 {
        self.most
    }

    /// Whether a root was taken of what is below 0.
    pub fn misses_root(&self) -> bool {
        self.misses_root
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
