//! Polynomials in several atoms, with a bounded number of terms.

use super::number::{Number, common};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// What a polynomial is in: a node's number, or an inverse's beyond those.
pub type Atom = u32;

/// Atoms and their powers, sorted, none 0.
pub type Monomial = Vec<(Atom, u32)>;

/// How many terms and what degree a polynomial may have.
const TERMS: usize = 160;
const DEGREE: u32 = 8;

/// A sum of monomials with coefficients that are not 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Poly {
    pub terms: BTreeMap<Monomial, Number>,
}

impl Poly {
    pub fn constant(number: Number) -> Poly {
        let mut made = Poly::default();
        made.accrue(Vec::new(), number);
        made
    }

    pub fn atom(atom: Atom) -> Poly {
        let mut made = Poly::default();
        made.accrue(vec![(atom, 1)], Number::ONE);
        made
    }

    fn accrue(&mut self, monomial: Monomial, number: Number) {
        match self.terms.entry(monomial) {
            Entry::Occupied(mut held) => {
                let sum = held.get().add(number);
                if sum.is_zero() {
                    held.remove();
                } else {
                    held.insert(sum);
                }
            }
            Entry::Vacant(place) if !number.is_zero() => {
                place.insert(number);
            }
            Entry::Vacant(_) => {}
        }
    }

    /// Of monomials that are all different.
    fn of(terms: impl Iterator<Item = (Monomial, Number)>) -> Poly {
        Poly {
            terms: terms.filter(|(_, number)| !number.is_zero()).collect(),
        }
    }

    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Its value, if it is a constant.
    pub fn value(&self) -> Option<Number> {
        match self.terms.len() {
            0 => Some(Number::ZERO),
            1 => self.terms.get(&Vec::new()).copied(),
            _ => None,
        }
    }

    pub fn add(&self, other: &Poly) -> Option<Poly> {
        let mut sum = self.clone();
        for (monomial, number) in &other.terms {
            sum.accrue(monomial.clone(), *number);
        }
        (sum.terms.len() <= TERMS).then_some(sum)
    }

    pub fn scaled(&self, by: Number) -> Poly {
        let each = self.terms.iter();
        Poly::of(each.map(|(monomial, number)| (monomial.clone(), number.mul(by))))
    }

    pub fn mul(&self, other: &Poly) -> Option<Poly> {
        if self.terms.len() * other.terms.len() > TERMS * 8 {
            return None;
        }
        let degree = |p: &Poly| p.terms.keys().map(degree).max().unwrap_or(0);
        if !self.is_zero() && !other.is_zero() && degree(self) + degree(other) > DEGREE {
            return None;
        }
        let pairs =
            |(a, x): (&Monomial, &Number), (b, y): (&Monomial, &Number)| (product(a, b), x.mul(*y));
        let out = match (self.terms.len(), other.terms.len()) {
            // Products with one monomial are as different as what it is multiplied by.
            (1, _) | (_, 1) => Poly::of(
                (self.terms.iter()).flat_map(|a| other.terms.iter().map(move |b| pairs(a, b))),
            ),
            _ => {
                let mut out = Poly::default();
                for a in &self.terms {
                    for b in &other.terms {
                        let (monomial, number) = pairs(a, b);
                        out.accrue(monomial, number);
                    }
                }
                out
            }
        };
        (out.terms.len() <= TERMS).then_some(out)
    }

    /// The atoms in it, sorted.
    pub fn atoms(&self) -> Vec<Atom> {
        let mut all: Vec<Atom> = self.terms.keys().flatten().map(|(atom, _)| *atom).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// As a polynomial in one atom: its coefficients, from power 0 on.
    pub fn by(&self, atom: Atom) -> Vec<Poly> {
        let mut all = vec![Poly::default()];
        for (monomial, number) in &self.terms {
            let power = power_in(monomial, atom);
            let rest = monomial
                .iter()
                .copied()
                .filter(|(a, _)| *a != atom)
                .collect();
            while all.len() <= power as usize {
                all.push(Poly::default());
            }
            all[power as usize].accrue(rest, *number);
        }
        all
    }

    /// With every power of an atom replaced: by `one` where it is odd, by
    /// `two` where it is even (and not 0).
    pub fn with_powers(&self, atom: Atom, one: &Poly, two: &Poly) -> Option<Poly> {
        let mut out = Poly::default();
        for (power, part) in self.by(atom).iter().enumerate() {
            out = out.add(&match power {
                0 => part.clone(),
                p if p % 2 == 1 => part.mul(one)?,
                _ => part.mul(two)?,
            })?;
        }
        Some(out)
    }

    /// The greatest monomial that divides every term.
    pub fn common(&self) -> Monomial {
        let powers = |atom: Atom| self.terms.keys().map(move |m| power_in(m, atom));
        let least = |atom: Atom| powers(atom).min().unwrap_or(0);
        let all = self.atoms().into_iter().map(|atom| (atom, least(atom)));
        all.filter(|(_, power)| *power > 0).collect()
    }

    /// Its terms that a monomial divides, divided by it, and the others.
    pub fn split(&self, by: &Monomial) -> (Poly, Poly) {
        let (mut divided, mut others) = (Poly::default(), Poly::default());
        for (monomial, number) in &self.terms {
            let left = |(atom, power): &(Atom, u32)| {
                let less = by.iter().find(|(a, _)| a == atom).map_or(0, |(_, k)| *k);
                Some((*atom, power.checked_sub(less)?)).filter(|(_, power)| *power > 0)
            };
            let has =
                |(atom, power): &(Atom, u32)| monomial.iter().any(|(a, k)| a == atom && k >= power);
            match by.iter().all(has) {
                true => divided.accrue(monomial.iter().filter_map(left).collect(), *number),
                false => others.accrue(monomial.clone(), *number),
            }
        }
        (divided, others)
    }

    /// With a number in the place of an atom.
    pub fn at(&self, atom: Atom, value: i128) -> Option<Poly> {
        let mut out = Poly::default();
        for (power, part) in self.by(atom).iter().enumerate() {
            let power = Number::whole(value.checked_pow(power as u32)?);
            out = out.add(&part.scaled(power))?;
        }
        Some(out)
    }

    /// The quotient by a polynomial whose highest power of `atom` has a
    /// constant coefficient; nothing where a rest is left.
    /// Long division, with a step for each power of `atom` at most. A step's highest terms
    /// go against each other over the reals: they are left out of the rest, since
    /// coefficients that are no fractions ([`Number::Near`]) would leave roundings of them,
    /// to be divided again without end.
    pub fn divided(&self, by: &Poly, atom: Atom) -> Option<Poly> {
        let divisor = by.by(atom);
        let degree = divisor.len() - 1;
        let inverse = divisor[degree].value()?.inverse()?;
        if degree == 0 {
            return None;
        }
        let (mut rest, mut out) = (self.clone(), Poly::default());
        while !rest.is_zero() {
            let parts = rest.by(atom);
            let highest = parts.len() - 1;
            let over = highest.checked_sub(degree)?;
            let power = Poly {
                terms: BTreeMap::from([(power_of(atom, over as u32), Number::ONE)]),
            };
            let term = parts[highest].scaled(inverse).mul(&power)?;
            out = out.add(&term)?;
            rest = rest.add(&term.mul(by)?.scaled(Number::whole(-1)))?;
            let lower = |monomial: &Monomial| power_in(monomial, atom) < highest as u32;
            rest.terms.retain(|monomial, _| lower(monomial));
        }
        Some(out)
    }

    /// What it must be divided by, above 0, to have whole coefficients without
    /// a common divisor; nothing where they are not all fractions.
    pub fn content(&self) -> Option<Number> {
        let (mut top, mut bottom) = (0i128, 1i128);
        for number in self.terms.values() {
            let Number::Exact(n, d) = *number else {
                return None;
            };
            top = common(n, top);
            bottom = bottom.checked_mul(d / common(bottom, d))?;
        }
        // Fractions in lowest terms: the divisor of the tops over the multiple of the bottoms.
        (!self.is_zero()).then(|| Number::Exact(top, 1).mul(Number::Exact(1, bottom)))
    }

    /// The coefficient of the last monomial, which decides how it is turned.
    pub fn lead(&self) -> Number {
        let last = self.terms.iter().next_back();
        last.map_or(Number::ZERO, |(_, number)| *number)
    }
}

/// The power of an atom in a monomial.
fn power_in(monomial: &Monomial, atom: Atom) -> u32 {
    let found = monomial.iter().find(|(a, _)| *a == atom);
    found.map_or(0, |(_, power)| *power)
}

fn power_of(atom: Atom, power: u32) -> Monomial {
    match power {
        0 => Vec::new(),
        _ => vec![(atom, power)],
    }
}

fn degree(monomial: &Monomial) -> u32 {
    monomial.iter().map(|(_, power)| power).sum()
}

fn product(a: &Monomial, b: &Monomial) -> Monomial {
    let mut both = Vec::with_capacity(a.len() + b.len());
    let (mut a, mut b) = (a.as_slice(), b.as_slice());
    while let ([x, more @ ..], [y, others @ ..]) = (a, b) {
        match x.0.cmp(&y.0) {
            Ordering::Less => {
                both.push(*x);
                a = more;
            }
            Ordering::Greater => {
                both.push(*y);
                b = others;
            }
            Ordering::Equal => {
                both.push((x.0, x.1 + y.1));
                (a, b) = (more, others);
            }
        }
    }
    both.extend(a);
    both.extend(b);
    both
}
