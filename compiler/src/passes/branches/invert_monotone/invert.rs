//! Inversion of a chain of monotone functions, by bisection: the steps from a shade to an ink.

use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use slowlight_routine::{Op, Range, Type, Value};

/// What the thresholds depend on, beside constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Selector {
    /// An entry of a constant table.
    Entry {
        of: TableId,
        column: NodeId,
        row: NodeId,
    },
    /// An int of few values, from `low` on.
    Int {
        node: NodeId,
        low: i32,
        count: usize,
    },
}

/// The steps from a value to what is monotone in it.
#[derive(Clone, Debug)]
pub struct Chain {
    /// The value.
    pub value: NodeId,
    /// The steps, the last one first.
    pub steps: Vec<NodeId>,
    /// Whether the result grows with the value.
    pub rising: bool,
    /// What else the steps depend on.
    pub selector: Option<Selector>,
    /// The selector's node.
    cell: Option<NodeId>,
    /// Whether the result grows with each step's result.
    slopes: Vec<bool>,
}

/// How a step moves with the argument that is followed.
fn slope(op: Op, first: bool, other: Option<Range>) -> Option<bool> {
    let sign = || match other {
        Some(r) if r.lo >= 0.0 => Some(true),
        Some(r) if r.hi <= 0.0 => Some(false),
        _ => None,
    };
    match op {
        Op::Add | Op::Min | Op::Max | Op::Sqrt | Op::Floor | Op::Round | Op::Sign => Some(true),
        Op::ToReal | Op::IntAdd | Op::IntMin | Op::IntMax | Op::IntSign => Some(true),
        Op::Sub | Op::IntSub => Some(first),
        Op::Neg | Op::IntNeg => Some(false),
        Op::Mul | Op::IntMul => sign(),
        Op::Div | Op::IntDiv if first => sign(),
        _ => None,
    }
}

impl Chain {
    /// The longest chain of monotone steps that ends in a node.
    pub fn find(graph: &Graph, ranges: &Ranges, end: NodeId) -> Option<Chain> {
        let mut chain = Chain {
            value: end,
            steps: Vec::new(),
            rising: true,
            selector: None,
            cell: None,
            slopes: Vec::new(),
        };
        while chain.step(graph, ranges).is_some() {}
        // What is compared is a real.
        while graph.ty(chain.value) != Type::Real {
            (chain.value, chain.rising) = (chain.steps.pop()?, chain.slopes.pop()?);
        }
        (!chain.steps.is_empty()).then_some(chain)
    }

    fn step(&mut self, graph: &Graph, ranges: &Ranges) -> Option<()> {
        let Node::Apply(op, [a, b]) = graph.node(self.value) else {
            return None;
        };
        let (next, other) = if op.arity() == 1 {
            (a, None)
        } else if self.tabulates(graph, ranges, b) && graph.constant(a).is_none() {
            (a, Some(b))
        } else if self.tabulates(graph, ranges, a) {
            (b, Some(a))
        } else {
            return None;
        };
        if graph.ty(next) == Type::Bool || self.tabulates(graph, ranges, next) {
            return None;
        }
        let span = match other {
            Some(other) => Some(self.span_of(graph, other)?),
            None => None,
        };
        let rises = slope(op, next == a, span)?;
        self.steps.push(self.value);
        self.slopes.push(self.rising);
        self.rising ^= !rises;
        self.value = next;
        Some(())
    }

    /// Whether a node depends on constants and the selector alone; the first
    /// selector that is met is taken.
    fn tabulates(&mut self, graph: &Graph, ranges: &Ranges, id: NodeId) -> bool {
        let mut tried = self.clone();
        let fits = tried.follows(graph, ranges, id, 12);
        if fits {
            (self.selector, self.cell) = (tried.selector, tried.cell);
        }
        fits
    }

    fn follows(&mut self, graph: &Graph, ranges: &Ranges, id: NodeId, deep: u32) -> bool {
        if graph.constant(id).is_some() || self.cell == Some(id) {
            return true;
        }
        let selector = match graph.node(id) {
            _ if deep == 0 => return false,
            Node::Apply(_, args) => {
                let held = self.clone();
                let arity = graph.node(id).operands().count();
                let follow = |a: &NodeId| self.follows(graph, ranges, *a, deep - 1);
                if args[..arity].iter().all(follow) {
                    return true;
                }
                *self = held;
                few(graph, ranges, id)
            }
            Node::Lookup { table, column, row } => {
                let cells = graph.tables.get(table.0 as usize).map(|t| t.entries.len());
                cells
                    .filter(|n| *n <= super::CELLS)
                    .map(|_| Selector::Entry {
                        of: table,
                        column,
                        row,
                    })
            }
            _ => few(graph, ranges, id),
        };
        match (selector, self.cell) {
            (Some(selector), None) => {
                (self.selector, self.cell) = (Some(selector), Some(id));
                true
            }
            _ => false,
        }
    }

    /// The selector's values.
    fn cells(&self, graph: &Graph) -> Vec<Value> {
        match self.selector {
            None => vec![Value::Int(0)],
            Some(Selector::Entry { of, .. }) => {
                let table = graph.tables.get(of.0 as usize);
                let entries = table.into_iter().flat_map(|t| &t.entries);
                entries.map(|e| e.value()).collect()
            }
            Some(Selector::Int { low, count, .. }) => {
                (0..count as i32).map(|k| Value::Int(low + k)).collect()
            }
        }
    }

    /// What a node that depends on the selector stays within.
    fn span_of(&self, graph: &Graph, id: NodeId) -> Option<Range> {
        let all = self.cells(graph).into_iter();
        let ranges = all.map(|cell| Range::point(self.eval(graph, id, cell).real()));
        ranges.reduce(Range::join)
    }

    /// The value of a node that depends on constants and the selector alone.
    fn eval(&self, graph: &Graph, id: NodeId, cell: Value) -> Value {
        if self.cell == Some(id) {
            return cell;
        }
        match graph.node(id) {
            Node::Const(c) => c.value(),
            Node::Apply(op, args) if op.arity() == 1 => op.eval(&[self.eval(graph, args[0], cell)]),
            Node::Apply(op, args) => op.eval(&args.map(|a| self.eval(graph, a, cell))),
            _ => Value::Int(0),
        }
    }

    /// The steps, the first one first, where the selector has a value: what they combine the
    /// chain's values with is computed once for all of these.
    fn steps_with(&self, graph: &Graph, cell: Value) -> Vec<Step> {
        let mut followed = self.value;
        let steps = self.steps.iter().rev().filter_map(|&id| {
            let Node::Apply(op, [a, b]) = graph.node(id) else {
                return None;
            };
            let first = a == followed;
            followed = id;
            let other = (op.arity() > 1).then(|| self.eval(graph, if first { b } else { a }, cell));
            Some(Step { op, first, other })
        });
        steps.collect()
    }

    /// For each result above the lowest, what the value is compared with, by
    /// the selector's values.
    pub fn thresholds(
        &self,
        graph: &Graph,
        ranges: &Ranges,
        low: i32,
        high: i32,
    ) -> Option<Thresholds> {
        if self.steps.is_empty() {
            return None;
        }
        let range = ranges.result.get(self.value.0 as usize)?;
        // Where no value reaches a result, any number beyond them all will do.
        let beyond = (range.magnitude() * 2.0 + 1.0).min(1e30);
        let cells = self.cells(graph);
        let cells: Vec<Vec<Step>> = (cells.into_iter())
            .map(|cell| self.steps_with(graph, cell))
            .collect();
        let find = |ink: i32, steps: &Vec<Step>| {
            let above = |x: f64| result(steps, x).int() >= ink;
            least(|x| above(x) == self.rising)
        };
        let inks = low + 1..=high;
        let from: Vec<Vec<f64>> = inks
            .map(|ink| cells.iter().map(|steps| find(ink, steps)).collect())
            .collect();
        let passed = |t: f64| t.next_down() + 0.0;
        let steps = from.iter().flatten().filter(|t| t.abs() < beyond);
        let sides = steps.filter_map(|t| side_of_short(*t, range.magnitude()));
        let strict = sides.map(|behind| if behind { 1 } else { -1 }).sum::<i32>() > 0;
        let kept = |t: f64| if strict { passed(t) } else { t }.clamp(-beyond, beyond);
        let by_ink = from
            .into_iter()
            .map(|entries| entries.into_iter().map(kept).collect())
            .collect();
        Some(Thresholds { by_ink, strict })
    }
}

/// A step of a chain where the selector has a value.
struct Step {
    op: Op,
    /// Whether the value that is followed is the first operand.
    first: bool,
    /// The other one, if there is one.
    other: Option<Value>,
}

/// What a chain's steps make of its value.
fn result(steps: &[Step], x: f64) -> Value {
    steps
        .iter()
        .fold(Value::Real(x), |now, step| match (step.other, step.first) {
            (None, _) => step.op.eval(&[now]),
            (Some(other), true) => step.op.eval(&[now, other]),
            (Some(other), false) => step.op.eval(&[other, now]),
        })
}

/// What a value is compared with. Between two neighbours among `f64`s a result
/// changes. Beside them there may be a number that formats hold exactly: `v + d > 1`
/// changes behind 1 - d, `floor(v + d)` at it. Both neighbours are rounded to that number
/// there, so an exact tie goes as it should only if the comparison says on which side it is.
pub struct Thresholds {
    /// For each result above the lowest, by the selector's values.
    pub by_ink: Vec<Vec<f64>>,
    /// Whether the result changes behind the threshold; else from it on.
    pub strict: bool,
}

/// Whether a number of few digits, of which no format of 32 bits tells `step` apart, is
/// below it; none where there is no such number. Values are so large at most.
fn side_of_short(step: f64, most: f64) -> Option<bool> {
    const DIGITS: i32 = 32;
    /// What the steps' own roundings may move it by, in `f64`.
    const NEAR: f64 = 64.0 * f64::EPSILON;
    let size = step.abs().max(most.min(1.0)).max(f64::MIN_POSITIVE);
    let grid = (size.log2().ceil() - f64::from(DIGITS)).exp2();
    let short = (step / grid).round() * grid;
    ((step - short).abs() <= NEAR * size).then_some(short < step)
}

/// An int that can have few values only.
fn few(graph: &Graph, ranges: &Ranges, id: NodeId) -> Option<Selector> {
    let range = ranges.result.get(id.0 as usize)?;
    let count = range.hi - range.lo + 1.0;
    (count <= 16.0 && whole(graph, id, 12)).then_some(Selector::Int {
        node: id,
        low: range.lo as i32,
        count: count as usize,
    })
}

/// Whether a node is made of ints alone: of the pixel's place, say. What is
/// rounded to an int may have few values too, but is what a chain follows.
fn whole(graph: &Graph, id: NodeId, deep: u32) -> bool {
    graph.ty(id) == Type::Int
        && deep > 0
        && match graph.node(id) {
            Node::Const(_) | Node::Param(_) | Node::Axis(_) => true,
            node @ Node::Apply(..) => node.operands().all(|a| whole(graph, a, deep - 1)),
            _ => false,
        }
}

/// The least real for which something holds that holds from there on; the
/// greatest real where it never does.
fn least(holds: impl Fn(f64) -> bool) -> f64 {
    // The reals in order, as integers.
    let real = |k: i64| {
        f64::from_bits(if k < 0 {
            (!k as u64) | (1 << 63)
        } else {
            k as u64
        })
    };
    let top = f64::MAX.to_bits() as i64;
    let (mut under, mut over) = (!top, top);
    while under < over {
        // Their mean, rounded down, without overflow.
        let middle = (under & over) + ((under ^ over) >> 1);
        if holds(real(middle)) {
            over = middle;
        } else {
            under = middle + 1;
        }
    }
    real(over) + 0.0
}
