//! Search for an identity: which sum of few products a value is.
//!
//! What is looked for is value = d w + c a (u + s v), with constants c, d and s, where
//! w is one of the values at hand, a product of two, or nothing; a is a value,
//! or 1; u is a value, v one, 1 or nothing. What the parentheses can be, but for
//! the factor c, is put into a table; then each d w and a is looked up.

use super::field::*;
use crate::passes::algebra::formula::{Formula, Fraction, Sum};
use rustc_hash::FxHashMap;

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

/// d w: the constant, also as an element, one value, and another unless w is the first alone.
type Product = ((Fraction, u64), usize, Option<usize>);

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

/// All sums u + s v but for a factor, by the ratio of their first two points. They are
/// thousands for each of many values, so what they are kept in is used again and again.
pub struct Sums {
    prints: Vec<Print>,
    factors: Vec<(Fraction, u64)>,
    found: FxHashMap<u64, Sum>,
    /// Which ratios are not among them, by their last bits.
    seen: Vec<u64>,
    sums: Vec<(Ends, Sum)>,
    tries: Vec<(Option<Product>, Ends)>,
    firsts: Vec<u64>,
}

const ONE: Print = [1; POINTS];

/// By how many of their last bits ratios are told apart before they are looked up.
const BITS: u32 = 17;

/// A value at the first two points: there are thousands of sums, of which a few are looked at
/// elsewhere.
type Ends = [u64; 2];

fn ends(print: &Print) -> Ends {
    [print[0], print[1]]
}

/// Where a ratio is seen.
fn bit(ratio: u64) -> (usize, u64) {
    let at = ratio & ((1 << BITS) - 1);
    ((at / 64) as usize, 1 << (at % 64))
}

impl Sums {
    /// Of no values yet.
    pub fn new() -> Sums {
        let element = |f: &Fraction| mul(whole(f.0.into()), inverse(whole(f.1.into())));
        Sums {
            prints: Vec::new(),
            factors: FACTORS.iter().map(|f| (*f, element(f))).collect(),
            found: FxHashMap::default(),
            seen: vec![0; (1 << BITS) / 64],
            sums: Vec::new(),
            tries: Vec::new(),
            firsts: Vec::new(),
        }
    }

    /// Looks at other values.
    pub fn of(&mut self, prints: Vec<Print>) {
        self.prints = prints;
        self.sums.clear();
        for (k, u) in self.prints.iter().map(ends).enumerate() {
            self.sums.push((u, (k, None)));
            let others = self.prints.iter().enumerate().skip(k + 1);
            let others = others.map(|(j, v)| (v, Some(j))).chain([(&ONE, None)]);
            for (v, j) in others {
                for (fraction, factor) in &self.factors {
                    let sum = with(&u, *factor, &ends(v));
                    self.sums.push((sum, (k, Some((*fraction, j)))));
                }
            }
        }
        self.firsts.clear();
        self.firsts.extend(self.sums.iter().map(|(sum, _)| sum[0]));
        inverses(&mut self.firsts);
        self.found.clear();
        self.seen.fill(0);
        for ((sum, what), first) in self.sums.iter().zip(&self.firsts) {
            let ratio = mul(sum[1], *first);
            // The first found is the shortest.
            self.found.entry(ratio).or_insert(*what);
            let (at, bit) = bit(ratio);
            self.seen[at] |= bit;
        }
    }

    /// The formulas of a value, each factor a out of `by`.
    pub fn formulas(&mut self, value: &Print, by: &[usize]) -> Vec<Formula> {
        self.try_all(value);
        let mut all = Vec::new();
        for by in by.iter().copied().map(Some).chain([None]) {
            let a = by.map_or(ONE, |k| self.prints[k]);
            // rest / a: its first two points' ratio.
            self.firsts.clear();
            let firsts = self.tries.iter().map(|(_, rest)| mul(rest[0], a[1]));
            self.firsts.extend(firsts);
            inverses(&mut self.firsts);
            for ((product, rest), first) in self.tries.iter().zip(&self.firsts) {
                let ratio = mul(mul(rest[1], a[0]), *first);
                let Some(sum) = self.sum(ratio) else {
                    continue;
                };
                let rest = self.rest(value, product);
                if let Some(factor) = self.factor(&rest, &a, sum) {
                    all.push(Formula {
                        product: product.map(|((fraction, _), k, j)| (fraction, k, j)),
                        factor,
                        by,
                        sum,
                    });
                }
            }
        }
        all
    }

    /// The sum with a ratio. Most have none: few of them are looked up.
    fn sum(&self, ratio: u64) -> Option<Sum> {
        let (at, bit) = bit(ratio);
        let seen = self.seen[at] & bit != 0;
        seen.then(|| self.found.get(&ratio).copied()).flatten()
    }

    /// What may be taken from a value, and what is left of it at the first two points.
    fn try_all(&mut self, value: &Print) {
        let value = ends(value);
        self.tries.clear();
        self.tries.push((None, value));
        for (k, u) in self.prints.iter().map(ends).enumerate() {
            let second = (k..self.prints.len()).map(Some);
            for j in second.chain([None]) {
                let w = j.map_or(u, |j| times(&u, &ends(&self.prints[j])));
                for factor in &self.factors {
                    let rest = with(&value, sub(0, factor.1), &w);
                    self.tries.push((Some((*factor, k, j)), rest));
                }
            }
        }
    }

    /// What is left of a value without a product, at all points.
    fn rest(&self, value: &Print, product: &Option<Product>) -> Print {
        let Some(((_, factor), k, j)) = *product else {
            return *value;
        };
        let u = self.prints[k];
        let w = j.map_or(u, |j| times(&u, &self.prints[j]));
        with(value, sub(0, factor), &w)
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
fn with<const N: usize>(u: &[u64; N], s: u64, v: &[u64; N]) -> [u64; N] {
    std::array::from_fn(|k| add(u[k], mul(s, v[k])))
}

fn times<const N: usize>(u: &[u64; N], v: &[u64; N]) -> [u64; N] {
    std::array::from_fn(|k| mul(u[k], v[k]))
}
