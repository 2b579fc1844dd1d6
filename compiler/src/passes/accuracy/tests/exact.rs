//! A graph's shade with 66 digits, for one pixel and given params.

use crate::ir::graph::*;
use dashu_float::FBig;
use dashu_float::ops::{Abs, SquareRoot};
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Value};

pub type Big = FBig;

/// A number with 220 bits.
pub fn big(v: f64) -> Big {
    Big::try_from(v).unwrap().with_precision(220).value()
}

#[derive(Clone, Debug)]
enum Exact {
    Real(Big),
    Bool(bool),
}

/// The shade of pixel (0, 0), the params by number.
pub fn shade(graph: &Graph, params: &[f64]) -> Big {
    let mut run = Exactly {
        graph,
        params,
        known: FxHashMap::default(),
    };
    run.real(graph.shade.unwrap())
}

struct Exactly<'g> {
    graph: &'g Graph,
    params: &'g [f64],
    known: FxHashMap<NodeId, Exact>,
}

impl Exactly<'_> {
    fn real(&mut self, id: NodeId) -> Big {
        match self.value(id) {
            Exact::Real(x) => x,
            Exact::Bool(_) => panic!("{id:?} is a truth"),
        }
    }

    fn value(&mut self, id: NodeId) -> Exact {
        if let Some(found) = self.known.get(&id) {
            return found.clone();
        }
        let value = match self.graph.node(id) {
            Node::Const(c) => match c.value() {
                Value::Bool(b) => Exact::Bool(b),
                other => Exact::Real(big(other.real())),
            },
            Node::Param(p) => Exact::Real(big(self.params[p.0 as usize])),
            Node::Select { cond, yes, no } => match self.value(cond) {
                Exact::Bool(true) => self.value(yes),
                _ => self.value(no),
            },
            Node::Apply(Op::Not, [a, _]) => match self.value(a) {
                Exact::Bool(b) => Exact::Bool(!b),
                Exact::Real(_) => panic!("{a:?} is no truth"),
            },
            Node::Apply(op, args) => {
                let [a, b] = args.map(|id| self.real(id));
                apply(op, a, b)
            }
            other => panic!("no {other:?} here"),
        };
        self.known.insert(id, value.clone());
        value
    }
}

fn apply(op: Op, a: Big, b: Big) -> Exact {
    let zero = big(0.0);
    Exact::Real(match op {
        Op::Add => a + b,
        Op::Sub => a - b,
        Op::Mul => a * b,
        Op::Div if a == zero && b == zero => zero,
        Op::Div => a / b,
        Op::Neg => -a,
        Op::Abs => a.abs(),
        Op::Min => a.min(b),
        Op::Max => a.max(b),
        Op::Sqrt if a <= zero => zero,
        Op::Sqrt => a.sqrt(),
        Op::Exp => a.exp(),
        Op::Log => a.ln(),
        Op::Sin => sine(a),
        Op::Cos => cosine(a),
        Op::Less => return Exact::Bool(a < b),
        Op::LessEqual => return Exact::Bool(a <= b),
        other => panic!("no {other:?} here"),
    })
}

/// By its series; the arguments are no more than a few turns.
fn sine(x: Big) -> Big {
    series(x.clone(), &x, 1)
}

fn cosine(x: Big) -> Big {
    series(big(1.0), &x, 0)
}

fn series(first: Big, x: &Big, start: u32) -> Big {
    let square = x * x;
    let (mut sum, mut term) = (first.clone(), first);
    for k in 0..90 {
        let n = f64::from(start + 2 * k);
        term = -(term * &square) / big((n + 1.0) * (n + 2.0));
        sum += &term;
    }
    sum
}
