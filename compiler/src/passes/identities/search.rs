//! Looking for a formula: which sum of few products a value is.
//!
//! What is looked for is value = d w + c a (u + s v), with constants c, d and s, where
//! w is one of the values at hand, a product of two, or nothing; a is a value,
//! or 1; u is a value, v one, 1 or nothing. What the parentheses can be, but for
//! the factor c, is put into a table; then each d w and a is looked up.

use super::field::*;
use std::collections::HashMap;

/// Constants that are tried for d and s, as fractions.
const FACTORS: [(i64, i64); 8] = [
    (1, 1),
    (-1, 1),
    (2, 1),
    (-2, 1),
    (1, 2),
    (-1, 2),
    (4, 1),
    (-4, 1),
];

/// A constant.
pub type Fraction = (i64, i64);

/// u + s v, with v none for 1.
pub type Sum = (usize, Option<(Fraction, Option<usize>)>);

/// d w + c a (u + s v), the values by their place in the list that was looked
/// through; none is 1 for a and v, and for w nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    pub product: Option<(Fraction, usize, Option<usize>)>,
    pub factor: Fraction,
    pub by: Option<usize>,
    pub sum: Sum,
}

impl Formula {
    /// What it is in the field, given the values.
    pub fn value(&self, of: &dyn Fn(usize) -> u64) -> u64 {
        let number = |f: Fraction| mul(whole(f.0.into()), inverse(whole(f.1.into())));
        let maybe = |k: Option<usize>| k.map_or(1, of);
        let (u, other) = self.sum;
        let rest = other.map_or(0, |(s, v)| mul(number(s), maybe(v)));
        let sum = add(of(u), rest);
        let sum = mul(number(self.factor), mul(maybe(self.by), sum));
        let product = self
            .product
            .map_or(0, |(d, a, b)| mul(number(d), mul(of(a), maybe(b))));
        add(sum, product)
    }

    /// The values that it is made of.
    pub fn values(&self) -> impl Iterator<Item = usize> + '_ {
        let product = self.product.iter().flat_map(|(_, a, b)| [Some(*a), *b]);
        let (u, rest) = self.sum;
        let v = rest.and_then(|(_, v)| v);
        product.chain([self.by, Some(u), v]).flatten()
    }
}

/// All sums u + s v but for a factor, by the ratio of their first two points.
pub struct Sums<'p> {
    prints: &'p [Print],
    found: HashMap<u64, Sum>,
    factors: Vec<(Fraction, u64)>,
}

const ONE: Print = [1; POINTS];

impl<'p> Sums<'p> {
    pub fn new(prints: &'p [Print]) -> Sums<'p> {
        let element = |f: &Fraction| mul(whole(f.0.into()), inverse(whole(f.1.into())));
        let factors: Vec<_> = FACTORS.iter().map(|f| (*f, element(f))).collect();
        let mut sums = Vec::new();
        for (k, u) in prints.iter().enumerate() {
            sums.push((*u, (k, None)));
            let others = prints.iter().enumerate().skip(k + 1);
            let others = others.map(|(j, v)| (v, Some(j))).chain([(&ONE, None)]);
            for (v, j) in others {
                for (fraction, factor) in &factors {
                    let sum = with(u, *factor, v);
                    sums.push((sum, (k, Some((*fraction, j)))));
                }
            }
        }
        let mut firsts: Vec<u64> = sums.iter().map(|(sum, _)| sum[0]).collect();
        inverses(&mut firsts);
        let mut found = HashMap::new();
        for ((sum, what), first) in sums.into_iter().zip(firsts) {
            // The first found is the shortest.
            found.entry(mul(sum[1], first)).or_insert(what);
        }
        Sums {
            prints,
            found,
            factors,
        }
    }

    /// The formulas of a value, each factor a out of `by`.
    pub fn formulas(&self, value: &Print, by: &[usize]) -> Vec<Formula> {
        let mut tries = vec![(None, *value)];
        for (k, u) in self.prints.iter().enumerate() {
            let second = (k..self.prints.len()).map(Some);
            for j in second.chain([None]) {
                let w = j.map_or(*u, |j| times(u, &self.prints[j]));
                for (fraction, factor) in &self.factors {
                    let rest = with(value, sub(0, *factor), &w);
                    tries.push((Some((*fraction, k, j)), rest));
                }
            }
        }
        let mut all = Vec::new();
        for by in by.iter().copied().map(Some).chain([None]) {
            let a = by.map_or(ONE, |k| self.prints[k]);
            // rest / a: its first two points' ratio.
            let mut firsts: Vec<u64> = tries.iter().map(|(_, r)| mul(r[0], a[1])).collect();
            inverses(&mut firsts);
            for ((product, rest), first) in tries.iter().zip(firsts) {
                let ratio = mul(mul(rest[1], a[0]), first);
                let Some(&sum) = self.found.get(&ratio) else {
                    continue;
                };
                if let Some(factor) = self.factor(rest, &a, sum) {
                    all.push(Formula {
                        product: *product,
                        factor,
                        by,
                        sum,
                    });
                }
            }
        }
        all
    }

    /// The constant c of rest = c a (u + s v) at all points.
    fn factor(&self, rest: &Print, a: &Print, (u, other): Sum) -> Option<Fraction> {
        let mut sum = self.prints[u];
        if let Some((s, v)) = other {
            let (_, s) = self.factors.iter().find(|(f, _)| *f == s)?;
            sum = with(&sum, *s, &v.map_or(ONE, |v| self.prints[v]));
        }
        let whole = times(a, &sum);
        let factor = mul(rest[0], inverse(whole[0]));
        let fits = (0..POINTS).all(|k| mul(factor, whole[k]) == rest[k]);
        (fits && factor != 0).then(|| fraction(factor))?
    }
}

/// u + s v.
fn with(u: &Print, s: u64, v: &Print) -> Print {
    std::array::from_fn(|k| add(u[k], mul(s, v[k])))
}

fn times(u: &Print, v: &Print) -> Print {
    std::array::from_fn(|k| mul(u[k], v[k]))
}
