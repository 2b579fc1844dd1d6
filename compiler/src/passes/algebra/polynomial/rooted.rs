//! Emission of polynomials with roots: a form's value and its signed squares.

use super::form::{Form, Part};
use super::number::Number;
use super::number::isqrt;
use super::poly::{Atom, Poly};
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::emit::{Out, Put, real};
use slowlight_routine::{Op, Type, Value};

impl Put<'_, '_> {
    /// A form's value.
    pub fn value(&mut self, form: &Form) -> Option<NodeId> {
        let mut sum: Option<NodeId> = None;
        for part in &form.parts {
            let part = self.part(part)?;
            sum = Some(match sum {
                Some(sum) => self.builder.apply(Op::Add, &[sum, part], self.span),
                None => part,
            });
        }
        sum
    }

    fn part(&mut self, part: &Part) -> Option<NodeId> {
        let mut poly = part.poly.clone();
        for (root, power) in &part.roots {
            poly = poly.scaled(self.root_factor(*root, *power)?);
        }
        let varies = poly.atoms().into_iter().any(|a| self.forms.varies(a));
        let value = match varies {
            true => {
                let negative = poly.lead().real() < 0.0;
                let turned = poly.scaled(Number::whole(if negative { -1 } else { 1 }));
                let (out, factor) = self.scaled_in(&turned)?;
                let out = self.real(out);
                let factor = if negative { factor.neg() } else { factor };
                self.product(out, factor.real())
            }
            false => {
                let out = self.poly(&poly)?;
                self.real(out)
            }
        };
        self.rooted(value, &part.roots)
    }

    /// A polynomial but for a factor above 0, and that factor: 1 for what a root is of,
    /// where that is whole itself, since what else needs it has it so.
    fn scaled_in(&mut self, poly: &Poly) -> Option<(Out, Number)> {
        let (whole, factor) = self.whole(poly)?;
        if matches!(factor, Number::Exact(n, 1) if n > 1) && self.forms.roots.contains(poly) {
            let out = self.poly(&whole.scaled(factor))?;
            if out.whole {
                return Some((out, Number::ONE));
            }
        }
        self.sized(poly)
    }

    fn product(&mut self, node: NodeId, by: f64) -> NodeId {
        if by == 1.0 {
            return node;
        }
        if by == -1.0 {
            return self.builder.apply(Op::Neg, &[node], self.span);
        }
        let by = self.builder.constant(Value::Real(by), self.span);
        self.builder.apply(Op::Mul, &[node, by], self.span)
    }

    /// N of a root but for a factor above 0, and that factor.
    fn root_poly(&self, root: usize) -> Option<(Poly, Number)> {
        let (whole, factor) = self.whole(self.forms.roots.get(root)?)?;
        Some(match factor {
            // It is whole itself: what else needs it has it so.
            Number::Exact(n, 1) if n > 1 => (whole.scaled(factor), Number::ONE),
            _ => (whole, factor),
        })
    }

    /// What a power of a root leaves as a factor beside N's own.
    fn root_factor(&self, root: usize, power: i32) -> Option<Number> {
        let (_, factor) = self.root_poly(root)?;
        let base = match power % 2 {
            0 => (factor, power / 2),
            _ => {
                // A root of a fraction of squares is a fraction.
                let root = match factor {
                    Number::Exact(n, d) => match (isqrt(n), isqrt(d)) {
                        (Some(n), Some(d)) => Number::whole(n).mul(Number::whole(d).inverse()?),
                        _ => Number::Near(factor.real().sqrt()),
                    },
                    Number::Near(x) => Number::Near(x.sqrt()),
                };
                (root, power)
            }
        };
        let one = if base.1 > 0 {
            base.0.inverse()?
        } else {
            base.0
        };
        let ones = (0..base.1.abs()).map(|_| one);
        Some(ones.fold(Number::ONE, Number::mul))
    }

    /// A value times powers of inverse roots, factors apart.
    pub fn rooted(&mut self, mut value: NodeId, roots: &[(usize, i32)]) -> Option<NodeId> {
        for (root, power) in roots {
            let (n, _) = self.root_poly(*root)?;
            let n = self.poly(&n)?;
            let n = self.real(n);
            let op = if *power > 0 { Op::Div } else { Op::Mul };
            for _ in 0..power.abs() / 2 {
                value = self.builder.apply(op, &[value, n], self.span);
            }
            if power % 2 != 0 {
                let root = self.builder.apply(Op::Sqrt, &[n], self.span);
                value = self.builder.apply(op, &[value, root], self.span);
            }
        }
        Some(value)
    }

    /// The square of a part, with the part's sign: a|a|.
    pub fn signed_square(&mut self, part: &Part) -> Option<NodeId> {
        let roots: Vec<(usize, i32)> = part.roots.iter().map(|(r, k)| (*r, 2 * k)).collect();
        let mut factor = Number::ONE;
        for (root, power) in &roots {
            factor = factor.mul(self.root_factor(*root, *power)?);
        }
        let square = self.square_of(&part.poly, factor.real())?;
        let square = self.real(square);
        self.rooted(square, &roots)
    }

    /// p|p| times a factor above 0.
    fn square_of(&mut self, poly: &Poly, factor: f64) -> Option<Out> {
        if let Some(atom) = self.choice(poly) {
            return self.chosen(poly, atom, |put, poly| put.square_of(poly, factor));
        }
        let square = |x: f64| x * x.abs() * factor;
        if let Some(number) = poly.value() {
            return Some(self.constant(Number::Near(square(number.real()))));
        }
        if let [atom] = poly.atoms().as_slice()
            && let Node::Lookup { table, column, row } = self.forms.graph.node(NodeId(*atom))
        {
            return self.tabulated(poly, *atom, table, [column, row], square);
        }
        let out = self.poly(poly)?;
        let node = self.real(out);
        let size = self.builder.apply(Op::Abs, &[node], self.span);
        let square = self.builder.apply(Op::Mul, &[node, size], self.span);
        Some(real(self.product(square, factor)))
    }

    /// A function of a polynomial in an entry of a table, as a table.
    fn tabulated(
        &mut self,
        poly: &Poly,
        atom: Atom,
        table: TableId,
        place: [NodeId; 2],
        of: impl Fn(f64) -> f64,
    ) -> Option<Out> {
        let cells = self.forms.graph.tables.get(table.0 as usize)?;
        let entry = |x: f64| {
            let parts = poly.by(atom);
            let values = parts
                .iter()
                .rev()
                .map(|p| p.value().map_or(0.0, Number::real));
            of(values.fold(0.0, |sum, c| sum * x + c))
        };
        let reals = cells.entries.iter().map(|e| entry(e.value().real()));
        let made = Table {
            ty: Type::Real,
            entries: reals.map(|x| Constant::new(Value::Real(x))).collect(),
            ..cells.clone()
        };
        let table = self.builder.table(made);
        let [column, row] = place;
        let (column, row) = ((self.new)(column)?, (self.new)(row)?);
        Some(real(self.builder.lookup(table, column, row, self.span)))
    }
}
