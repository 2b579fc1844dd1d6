//! Normal forms: what a value is over the reals, as polynomials and inverse roots.
//!
//! A form is a sum of parts, each a polynomial times whole powers of inverse
//! roots s = 1/sqrt(N), N a polynomial that is known to be above 0. Since s*s*N = 1,
//! powers of s that differ by an even number are brought together, and a factor
//! N goes against s*s. So a form has at most one part for each set of roots to
//! an odd power: a component of a normalised vector is one part with s, its
//! square a part without.
//!
//! Polynomials are in the pixel's place, in params, in what is the same for a
//! whole row, and in ints of two values, whose squares are known.

use super::number::Number;
use super::poly::{Atom, Poly};
use crate::analysis::range::Ranges;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
use slowlight_routine::{Op, Range, Type};

/// Powers of inverse roots, by the root's number, none 0.
pub type Roots = Vec<(usize, i32)>;

/// A polynomial times inverse roots.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    pub roots: Roots,
    pub poly: Poly,
}

/// A sum of parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Form {
    pub parts: Vec<Part>,
}

/// The forms of a graph's values.
#[derive(Clone)]
pub struct Forms<'g> {
    pub graph: &'g Graph,
    pub ranges: &'g Ranges,
    pub rates: Rates,
    of: Vec<Option<Form>>,
    /// N of each root.
    pub roots: Vec<Poly>,
    /// What each atom beyond the nodes is.
    pub others: Vec<Other>,
    /// Whether what is the same for a whole row is not looked into.
    by_row: bool,
}

/// An atom that no node is.
#[derive(Clone, Debug, PartialEq)]
pub enum Other {
    /// 1 divided by a polynomial that is the same for a whole row.
    Inverse(Poly),
    /// 1 where a condition holds, else 0.
    Holds(NodeId),
}

/// An int of two values: which they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Two {
    pub low: i32,
    pub high: i32,
}

impl<'g> Forms<'g> {
    pub fn new(graph: &'g Graph, ranges: &'g Ranges) -> Forms<'g> {
        Forms::looked_into(graph, ranges, false)
    }

    /// The same in terms of the column and of what is the same for a whole row,
    /// as it is computed there.
    pub fn by_row(graph: &'g Graph, ranges: &'g Ranges) -> Forms<'g> {
        Forms::looked_into(graph, ranges, true)
    }

    fn looked_into(graph: &'g Graph, ranges: &'g Ranges, by_row: bool) -> Forms<'g> {
        let mut forms = Forms {
            graph,
            ranges,
            rates: rates(graph),
            of: vec![None; graph.nodes.len()],
            roots: Vec::new(),
            others: Vec::new(),
            by_row,
        };
        for id in graph.ids() {
            forms.of[id.0 as usize] = forms.form(id);
        }
        forms
    }

    /// A value's form, if it has one.
    pub fn get(&self, id: NodeId) -> Option<&Form> {
        self.of.get(id.0 as usize).and_then(Option::as_ref)
    }

    /// Whether a node is another in every column.
    pub fn pixel(&self, id: NodeId) -> bool {
        self.rates.depends(id, Dependence::Column)
    }

    /// Whether an atom is another in every column.
    pub fn varies(&self, atom: Atom) -> bool {
        match self.other(atom) {
            Some(Other::Inverse(of)) => of.atoms().into_iter().any(|a| self.varies(a)),
            Some(Other::Holds(cond)) => self.pixel(*cond),
            None => self.pixel(NodeId(atom)),
        }
    }

    /// What an atom is that no node is.
    pub fn other(&self, atom: Atom) -> Option<&Other> {
        let at = (atom as usize).checked_sub(self.graph.nodes.len())?;
        self.others.get(at)
    }

    /// What an atom is the inverse of, if it is one.
    pub fn inverse(&self, atom: Atom) -> Option<&Poly> {
        match self.other(atom)? {
            Other::Inverse(of) => Some(of),
            Other::Holds(_) => None,
        }
    }

    /// The atom that stands for what no node is.
    fn atom_for(&mut self, other: Other) -> Option<Atom> {
        let at = match self.others.iter().position(|o| *o == other) {
            Some(at) => at,
            None => {
                self.others.push(other);
                self.others.len() - 1
            }
        };
        u32::try_from(self.graph.nodes.len() + at).ok()
    }

    /// The two values of an atom that has no more.
    pub fn two(&self, atom: Atom) -> Option<Two> {
        if let Some(Other::Holds(_)) = self.other(atom) {
            return Some(Two { low: 0, high: 1 });
        }
        let id = NodeId(atom);
        let range = self.ranges.result.get(atom as usize)?;
        let few = range.hi - range.lo <= 2.0 && self.graph.ty(id) == Type::Int;
        if self.inverse(atom).is_some() || !few {
            return None;
        }
        let (low, high) = (range.lo as i32, range.hi as i32);
        // The greater sign is told from the less by whether something is above 0.
        let fits = match self.graph.node(id) {
            Node::Apply(Op::Sign | Op::IntSign, [a, _]) if low == -1 => {
                high == 1 && self.get(a).is_some_and(|f| self.never_zero(f))
            }
            _ => high - low == 1,
        };
        fits.then_some(Two { low, high })
    }

    /// Whether a form is a whole odd number, but for a factor: never 0.
    pub fn never_zero(&self, form: &Form) -> bool {
        let [part] = form.parts.as_slice() else {
            return false;
        };
        let odd = || {
            let content = part.poly.content()?;
            let whole = part.poly.scaled(content.inverse()?);
            let ints = |atom: &Atom| {
                self.other(*atom).is_none() && self.graph.ty(NodeId(*atom)) == Type::Int
            };
            let parity = |n: &Number| matches!(n, Number::Exact(n, 1) if n % 2 != 0);
            let mut terms = whole.terms.iter();
            let fits = whole.atoms().iter().all(ints)
                && terms.all(|(monomial, n)| parity(n) == monomial.is_empty())
                && whole.terms.contains_key(&Vec::new());
            Some(fits)
        };
        odd() == Some(true)
    }

    fn form(&mut self, id: NodeId) -> Option<Form> {
        if self.looped(id) {
            return None;
        }
        match self.graph.node(id) {
            Node::Const(c) if self.graph.ty(id) != Type::Bool => {
                let number = Number::of(c.value().real());
                Some(plain(Poly::constant(number)))
            }
            Node::Param(_) | Node::Axis(_) => Some(plain(Poly::atom(id.0))),
            _ if self.by_row && !self.pixel(id) => self.opaque(id),
            Node::Apply(op, [a, b]) => self.applied(id, op, a, b).or_else(|| self.opaque(id)),
            Node::Select { cond, yes, no } => {
                self.either(id, cond, yes, no).or_else(|| self.opaque(id))
            }
            _ => self.opaque(id),
        }
    }

    /// Whether a value is computed in a loop.
    pub fn looped(&self, id: NodeId) -> bool {
        let inside = |d: &Dependence| matches!(d, Dependence::Loop(_) | Dependence::Last(_));
        self.rates.rate(id).iter().any(inside)
    }

    /// A value of which nothing is known but that it is the same for a whole
    /// row, or one of two.
    fn opaque(&self, id: NodeId) -> Option<Form> {
        let table = matches!(
            self.graph.node(id),
            Node::Lookup { .. } | Node::Apply(Op::Sqrt, _)
        );
        let fits = match self.graph.ty(id) {
            Type::Bool => false,
            Type::Int => !self.pixel(id) || self.two(id.0).is_some(),
            Type::Real => !self.pixel(id) || table,
        };
        fits.then(|| plain(Poly::atom(id.0)))
    }

    /// A choice between forms that differ by one part: no + [cond] (yes - no).
    fn either(&mut self, id: NodeId, cond: NodeId, yes: NodeId, no: NodeId) -> Option<Form> {
        if self.graph.ty(id) != Type::Real || !self.pixel(cond) {
            return None;
        }
        let (yes, no) = (self.get(yes)?.clone(), self.get(no)?.clone());
        let more = self.sum(&yes, &scaled(&no, Number::whole(-1)))?;
        if more.parts.len() != 1 {
            return None;
        }
        let holds = self.atom_for(Other::Holds(cond))?;
        let more = self.product(&plain(Poly::atom(holds)), &more)?;
        self.sum(&no, &more)
    }

    fn applied(&mut self, id: NodeId, op: Op, a: NodeId, b: NodeId) -> Option<Form> {
        let fits = |r: Option<&Range>| r.is_some_and(|r| r.within(-2e9, 2e9));
        let whole = fits(self.ranges.exact.get(id.0 as usize));
        match op {
            Op::IntAdd | Op::IntSub | Op::IntMul | Op::IntNeg if !whole => return None,
            _ => {}
        }
        let x = self.get(a)?.clone();
        let y = match op.arity() {
            1 => Form::default(),
            _ => self.get(b)?.clone(),
        };
        match op {
            Op::ToReal => Some(x),
            Op::Add | Op::IntAdd => self.sum(&x, &y),
            Op::Sub | Op::IntSub => self.sum(&x, &scaled(&y, Number::whole(-1))),
            Op::Neg | Op::IntNeg => Some(scaled(&x, Number::whole(-1))),
            Op::Mul | Op::IntMul => self.product(&x, &y),
            Op::Div => {
                let divisor = self.ranges.args.get(id.0 as usize)?[1];
                let safe = divisor.nonzero || self.never_zero(&y);
                let inverse = safe.then(|| self.inverted(&y, divisor.lo > 0.0))??;
                self.product(&x, &inverse)
            }
            Op::Sqrt => {
                let argument = self.ranges.args.get(id.0 as usize)?[0];
                (argument.lo > 0.0).then(|| self.root(&x))?
            }
            _ => None,
        }
    }

    /// 1 divided by a form of one part, where it is known to be above 0, a
    /// constant or the same for a whole row.
    fn inverted(&mut self, form: &Form, above: bool) -> Option<Form> {
        let [part] = form.parts.as_slice() else {
            return None;
        };
        let roots: Roots = part.roots.iter().map(|(r, k)| (*r, -k)).collect();
        if let Some(number) = part.poly.value() {
            let poly = Poly::constant(number.inverse()?);
            return Some(one(roots, poly));
        }
        if part.poly.atoms().into_iter().any(|a| self.varies(a)) {
            if !above || !roots.is_empty() {
                return None;
            }
            let at = self.root_of(&part.poly);
            return Some(one(vec![(at, 2)], Poly::constant(Number::ONE)));
        }
        let (whole, factor) = primitive(&part.poly)?;
        let atom = self.atom_for(Other::Inverse(whole))?;
        let poly = Poly::atom(atom).scaled(factor.inverse()?);
        Some(one(roots, poly))
    }

    /// The square root of a polynomial above 0, as a root.
    fn root(&mut self, form: &Form) -> Option<Form> {
        let [part] = form.parts.as_slice() else {
            return None;
        };
        if !part.roots.is_empty() || part.poly.value().is_some() {
            return None;
        }
        let at = self.root_of(&part.poly);
        Some(one(vec![(at, -1)], Poly::constant(Number::ONE)))
    }

    /// The number of the root whose N is a polynomial.
    fn root_of(&mut self, poly: &Poly) -> usize {
        match self.roots.iter().position(|p| p == poly) {
            Some(at) => at,
            None => {
                self.roots.push(poly.clone());
                self.roots.len() - 1
            }
        }
    }
}

/// A polynomial divided by a number so that its coefficients are whole without
/// a common divisor, or its last one is 1, and that number; the last
/// coefficient is above 0.
pub fn primitive(poly: &Poly) -> Option<(Poly, Number)> {
    let lead = poly.lead();
    let sign = Number::whole(if lead.real() < 0.0 { -1 } else { 1 });
    let factor = match poly.content() {
        Some(content) => content.mul(sign),
        None => lead,
    };
    Some((poly.scaled(factor.inverse()?), factor))
}

fn plain(poly: Poly) -> Form {
    one(Roots::new(), poly)
}

fn one(roots: Roots, poly: Poly) -> Form {
    let parts = match poly.is_zero() {
        true => Vec::new(),
        false => vec![Part { roots, poly }],
    };
    Form { parts }
}

/// A form times a number.
pub fn scaled(form: &Form, by: Number) -> Form {
    let parts = form.parts.iter().map(|p| Part {
        roots: p.roots.clone(),
        poly: p.poly.scaled(by),
    });
    Form {
        parts: parts.collect(),
    }
}
