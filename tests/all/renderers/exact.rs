//! A graph's shade with 200 bits, by need: what a facet of a shape comes to at
//! a point, beyond any doubt of rounding. Written for the tests alone, apart
//! from the evaluations of the compiler.

use super::gradients::{Big, Point, big};
use dashu_float::ops::{Abs, SquareRoot};
use slowlight_compiler::ir::graph::{Graph, LoopId, Node, NodeId};
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;
use slowlight_routine::{Op, Value};
use std::collections::HashMap;

#[derive(Clone)]
enum Number {
    Real(Big),
    Other(Value),
}

impl Number {
    fn real(self) -> Big {
        match self {
            Number::Real(r) => r,
            Number::Other(v) => big(v.real()),
        }
    }

    fn other(&self) -> Value {
        match self {
            Number::Real(r) => Value::Real(r.to_f64().value()),
            Number::Other(v) => *v,
        }
    }
}

/// A function of a point.
pub struct Exact {
    graph: Graph,
}

/// One evaluation.
struct Run<'g> {
    graph: &'g Graph,
    point: &'g Point,
    known: Vec<Option<Number>>,
    carried: HashMap<(LoopId, u32), Number>,
}

impl Exact {
    /// From an expression of the language over `p`, and items that it uses.
    pub fn new(items: &str, expression: &str) -> Exact {
        let text = format!(
            "image 1 x 1 inks black, white; {items}
            param p: vec3 = (0, 0, 0) in (-9, -9, -9) .. (9, 9, 9);
            dither show(v: real, x: int, y: int) -> ink = ink(floor(v));
            draw (x, y) = show({expression}, x, y);"
        );
        let scene = scene::check("exact", &text);
        assert!(scene.is_right(), "{expression}: {:?}", scene.diagnostics);
        let graph = scene.lower(&Options::default()).unwrap();
        Exact { graph }
    }

    /// The function's value.
    pub fn at(&self, point: &Point) -> Big {
        let mut run = Run {
            graph: &self.graph,
            point,
            known: vec![None; self.graph.nodes.len()],
            carried: HashMap::new(),
        };
        run.value(self.graph.shade.unwrap()).real()
    }

    /// The value along a ray of origin and direction.
    pub fn along(&self, ray: &[f64; 6], t: &Big) -> Big {
        self.at(&[0, 1, 2].map(|k| big(ray[k]) + t * big(ray[k + 3])))
    }
}

impl Run<'_> {
    fn value(&mut self, id: NodeId) -> Number {
        let at = id.0 as usize;
        if let Some(known) = &self.known[at] {
            return known.clone();
        }
        let found = match self.graph.nodes[at] {
            Node::Const(c) => match c.value() {
                Value::Real(r) => Number::Real(big(r)),
                other => Number::Other(other),
            },
            Node::Param(id) => Number::Real(self.point[id.0 as usize].clone()),
            Node::Axis(_) => Number::Other(Value::Int(0)),
            Node::Apply(op, [a, b]) => {
                let a = self.value(a);
                let b = if op.arity() > 1 {
                    self.value(b)
                } else {
                    a.clone()
                };
                apply(op, a, b)
            }
            Node::Select { cond, yes, no } => {
                let taken = self.value(cond).other().truth();
                self.value(if taken { yes } else { no })
            }
            Node::Lookup { table, column, row } => {
                let (c, r) = (self.value(column).other(), self.value(row).other());
                let found = self.graph.tables[table.0 as usize].at(c.int(), r.int());
                Number::Other(found)
            }
            Node::Carried { of, index } | Node::Last { of, index } => {
                self.carried[&(of, index)].clone()
            }
            Node::Tabulated(value) => self.value(value),
            Node::Result { of, index } => self.run(of, index as usize),
            Node::Ramp { .. }
            | Node::Stepped { .. }
            | Node::Received
            | Node::Neighbour(_)
            | Node::Slot(_)
            | Node::Undefined(_) => {
                panic!("needed: {id:?}")
            }
        };
        self.known[at] = Some(found.clone());
        found
    }

    /// One result of a loop.
    fn run(&mut self, of: LoopId, index: usize) -> Number {
        let l = &self.graph.loops[of.0 as usize];
        let carries = |n: &Node| matches!(n, Node::Carried { of: o, .. } if *o == of);
        let first = self.graph.nodes.iter().position(carries).unwrap();
        let mut values: Vec<Number> = l.init.iter().map(|&n| self.value(n)).collect();
        for _ in 0..l.max {
            self.known[first..].fill(None);
            for (k, v) in values.into_iter().enumerate() {
                self.carried.insert((of, k as u32), v);
            }
            if !self.value(l.again).other().truth() {
                return self.value(l.done[index]);
            }
            values = l.next.iter().map(|&n| self.value(n)).collect();
        }
        self.known[first..].fill(None);
        for (k, v) in values.into_iter().enumerate() {
            self.carried.insert((of, k as u32), v);
        }
        self.value(l.otherwise[index])
    }
}

fn apply(op: Op, a: Number, b: Number) -> Number {
    if op
        .args()
        .iter()
        .any(|t| *t != slowlight_routine::Type::Real)
        && op != Op::ToReal
    {
        let both = [a.other(), b.other()];
        return Number::Other(op.eval(&both[..op.arity()]));
    }
    let (a, b) = (a.real(), b.real());
    let zero = big(0.0);
    let int = |v: Big| Number::Other(Value::Int(v.to_f64().value() as i32));
    let truth = |v: bool| Number::Other(Value::Bool(v));
    Number::Real(match op {
        Op::Add => a + b,
        Op::Sub => a - b,
        Op::Mul => a * b,
        Op::Div if b == zero => big(op
            .eval(&[Value::Real(a.to_f64().value()), Value::Real(0.0)])
            .real()),
        Op::Div => a / b,
        Op::Neg => -a,
        Op::Abs => a.abs(),
        Op::Min => a.min(b),
        Op::Max => a.max(b),
        Op::Sqrt => a.max(zero).sqrt(),
        Op::Mod if b == zero => zero,
        Op::Mod => &a - &b * (&a / &b).floor(),
        Op::Sin => a.sin(),
        Op::Cos => a.cos(),
        Op::Exp => a.exp(),
        Op::Log => a.ln(),
        Op::Pow if a <= zero => big(op
            .eval(&[
                Value::Real(a.to_f64().value()),
                Value::Real(b.to_f64().value()),
            ])
            .real()),
        Op::Pow => (b * a.ln()).exp(),
        Op::ToReal => a,
        Op::Floor => return int(a.floor()),
        Op::Round => return int(a.round()),
        Op::Sign => {
            return int(if a > zero {
                big(1.0)
            } else if a < zero {
                big(-1.0)
            } else {
                zero
            });
        }
        Op::Less => return truth(a < b),
        Op::LessEqual => return truth(a <= b),
        Op::Equal => return truth(a == b),
        _ => panic!("no shape needs {op:?}"),
    })
}
