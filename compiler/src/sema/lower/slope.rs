//! The rules of differentiation, one operation at a time.

use super::Lower;
use crate::ir::graph::NodeId;
use crate::source::Span;
use slowlight_routine::Op;

impl Lower<'_> {
    /// The rule of differentiation of one operation: `value` is its result,
    /// `da` and `db` its operands' slopes (none: 0).
    pub(super) fn rule(
        &mut self,
        op: Op,
        value: NodeId,
        [a, b]: [NodeId; 2],
        [da, db]: [Option<NodeId>; 2],
        span: Span,
    ) -> Option<NodeId> {
        let mut on = |op: Op, args: &[NodeId]| self.b.apply(op, args, span);
        match op {
            Op::Add | Op::Sub => match (da, db) {
                (Some(x), Some(y)) => Some(on(op, &[x, y])),
                (Some(x), None) => Some(x),
                (None, Some(y)) if op == Op::Add => Some(y),
                (None, y) => y.map(|y| on(Op::Neg, &[y])),
            },
            Op::Neg => da.map(|x| on(Op::Neg, &[x])),
            Op::Mul => {
                let x = da.map(|x| on(Op::Mul, &[x, b]));
                let y = db.map(|y| on(Op::Mul, &[a, y]));
                match (x, y) {
                    (Some(x), Some(y)) => Some(on(Op::Add, &[x, y])),
                    (x, y) => x.or(y),
                }
            }
            Op::Div => {
                let y = db.map(|y| on(Op::Mul, &[value, y]));
                let top = match (da, y) {
                    (Some(x), Some(y)) => Some(on(Op::Sub, &[x, y])),
                    (x, None) => x,
                    (None, y) => y.map(|y| on(Op::Neg, &[y])),
                };
                top.map(|top| on(Op::Div, &[top, b]))
            }
            Op::Sqrt => da.map(|x| {
                let twice = on(Op::Add, &[value, value]);
                on(Op::Div, &[x, twice])
            }),
            Op::Abs => da.map(|x| {
                let sign = on(Op::Sign, &[a]);
                let sign = on(Op::ToReal, &[sign]);
                on(Op::Mul, &[sign, x])
            }),
            Op::Min | Op::Max => {
                // As the operations choose: the second only where it is strictly beyond.
                let second = match op {
                    Op::Min => on(Op::Less, &[b, a]),
                    _ => on(Op::Less, &[a, b]),
                };
                let zero = self.real(0.0, span);
                let (x, y) = (da.unwrap_or(zero), db.unwrap_or(zero));
                Some(self.select(second, y, x, span))
            }
            Op::Sin => da.map(|x| {
                let cos = on(Op::Cos, &[a]);
                on(Op::Mul, &[cos, x])
            }),
            Op::Cos => da.map(|x| {
                let sin = on(Op::Sin, &[a]);
                let product = on(Op::Mul, &[sin, x]);
                on(Op::Neg, &[product])
            }),
            Op::Tan => da.map(|x| {
                let square = on(Op::Mul, &[value, value]);
                let product = on(Op::Mul, &[square, x]);
                on(Op::Add, &[x, product])
            }),
            Op::Asin | Op::Acos => da.map(|x| {
                let one = self.real(1.0, span);
                let mut on = |op: Op, args: &[NodeId]| self.b.apply(op, args, span);
                let square = on(Op::Mul, &[a, a]);
                let rest = on(Op::Sub, &[one, square]);
                let root = on(Op::Sqrt, &[rest]);
                let slope = on(Op::Div, &[x, root]);
                if op == Op::Asin {
                    slope
                } else {
                    on(Op::Neg, &[slope])
                }
            }),
            Op::Atan2 => {
                let x = da.map(|x| on(Op::Mul, &[x, b]));
                let y = db.map(|y| on(Op::Mul, &[a, y]));
                let top = match (x, y) {
                    (Some(x), Some(y)) => Some(on(Op::Sub, &[x, y])),
                    (x, None) => x,
                    (None, y) => y.map(|y| on(Op::Neg, &[y])),
                };
                let (aa, bb) = (on(Op::Mul, &[a, a]), on(Op::Mul, &[b, b]));
                let square = on(Op::Add, &[aa, bb]);
                top.map(|top| on(Op::Div, &[top, square]))
            }
            Op::Exp => da.map(|x| on(Op::Mul, &[value, x])),
            Op::Log => da.map(|x| on(Op::Div, &[x, a])),
            Op::Pow => {
                // a^b (b a'/a + b' log a)
                let x = da.map(|x| {
                    let product = on(Op::Mul, &[b, x]);
                    on(Op::Div, &[product, a])
                });
                let y = db.map(|y| {
                    let log = on(Op::Log, &[a]);
                    on(Op::Mul, &[y, log])
                });
                let sum = match (x, y) {
                    (Some(x), Some(y)) => Some(on(Op::Add, &[x, y])),
                    (x, y) => x.or(y),
                };
                sum.map(|sum| on(Op::Mul, &[value, sum]))
            }
            // a - b floor(a/b): the floor does not change but by leaps.
            Op::Mod => match db {
                None => da,
                Some(y) => {
                    let quotient = on(Op::Div, &[a, b]);
                    let whole = on(Op::Floor, &[quotient]);
                    let whole = on(Op::ToReal, &[whole]);
                    let part = on(Op::Mul, &[whole, y]);
                    Some(match da {
                        Some(x) => on(Op::Sub, &[x, part]),
                        None => on(Op::Neg, &[part]),
                    })
                }
            },
            // Ints and bools change by leaps only.
            _ => None,
        }
    }
}
