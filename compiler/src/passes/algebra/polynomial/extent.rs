//! Range of a polynomial over a box: between which bounds it stays where its atoms do.
//!
//! An interval for each monomial knows nothing of how they go together: of
//! -4 y² + 8 y - 4 z² it does not see that it is always below 0 where z is not
//! small. So the atoms' ranges are cut into pieces, and the bounds are those of
//! all boxes of pieces: what is too wide shrinks with the pieces' width.

use super::form::Forms;
use super::number::Number;
use super::poly::{Atom, Poly};
use crate::ir::graph::NodeId;
use slowlight_routine::Range;
use std::sync::{Mutex, PoisonError};

/// How many boxes are looked at.
const BOXES: usize = 4096;

/// The bounds of polynomials that were asked for, of one graph's forms: spans ask the
/// same again wherever others are left out.
#[derive(Default)]
pub struct Extents {
    bounds: Mutex<Vec<(Poly, Range)>>,
    ratios: Mutex<Vec<([Poly; 2], f64)>>,
}

impl Extents {
    /// See [`extent`].
    pub fn extent(&self, rows: &Forms<'_>, full: &Forms<'_>, poly: &Poly) -> Range {
        once(&self.bounds, poly, || extent(rows, full, poly))
    }

    /// See [`ratio`].
    pub fn ratio(&self, rows: &Forms<'_>, full: &Forms<'_>, b: &Poly, a: &Poly) -> f64 {
        let pair = [b.clone(), a.clone()];
        once(&self.ratios, &pair, || ratio(rows, full, b, a))
    }
}

/// What was found for a key before, or is found now.
fn once<K: PartialEq + Clone, V: Copy>(
    known: &Mutex<Vec<(K, V)>>,
    key: &K,
    find: impl FnOnce() -> V,
) -> V {
    let held = || known.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, found)) = held().iter().find(|(k, _)| k == key) {
        return *found;
    }
    let found = find();
    held().push((key.clone(), found));
    found
}

/// The bounds of a polynomial by what is the same for a whole row (`rows`),
/// which has a form itself (`full`).
fn extent(rows: &Forms<'_>, full: &Forms<'_>, poly: &Poly) -> Range {
    let of = |atom: Atom| {
        let known = known(rows, atom);
        let parts = full.get(NodeId(atom)).map(|form| form.parts.as_slice());
        match parts {
            Some([part]) if part.roots.is_empty() => {
                known.meet(bounds(&part.poly, &|atom| self::known(full, atom)))
            }
            _ => known,
        }
    };
    bounds(poly, &of)
}

/// The greatest size of b / a, both by what is the same for a whole row, where a
/// is never 0. Both are looked at in the same boxes: params that make one large
/// may make the other so.
fn ratio(rows: &Forms<'_>, full: &Forms<'_>, b: &Poly, a: &Poly) -> f64 {
    let apart = || {
        let least = extent(rows, full, a);
        extent(rows, full, b).magnitude() / least.lo.abs().min(least.hi.abs())
    };
    let (Some(over), Some(under)) = (expanded(full, b), expanded(full, a)) else {
        return apart();
    };
    let mut atoms = over.atoms();
    atoms.extend(under.atoms());
    atoms.sort_unstable();
    atoms.dedup();
    let of = |atom: Atom| known(full, atom);
    let mut most: f64 = 0.0;
    let [over, under] = [over, under].map(|poly| Sum::new(&poly, &atoms));
    for sides in boxes(&atoms, &of) {
        let divisor = under.within(&sides);
        if divisor.contains(0.0) {
            return apart();
        }
        let least = divisor.lo.abs().min(divisor.hi.abs());
        most = most.max(over.within(&sides).magnitude() / least);
    }
    most.min(apart())
}

/// A polynomial by what is the same for a whole row, by what that is made of.
fn expanded(full: &Forms<'_>, poly: &Poly) -> Option<Poly> {
    let mut out = Poly::default();
    for (monomial, number) in &poly.terms {
        let mut product = Poly::constant(*number);
        for (atom, power) in monomial {
            let form = full.get(NodeId(*atom))?;
            let [part] = form.parts.as_slice() else {
                return None;
            };
            if !part.roots.is_empty() {
                return None;
            }
            for _ in 0..*power {
                product = product.mul(&part.poly)?;
            }
        }
        out = out.add(&product)?;
    }
    Some(out)
}

/// Between which bounds an atom stays by itself.
pub fn known(forms: &Forms<'_>, atom: Atom) -> Range {
    match forms.inverse(atom) {
        Some(_) => Range::ALL,
        None => (forms.ranges.result.get(atom as usize)).map_or(Range::ALL, |r| *r),
    }
}

/// The bounds of a polynomial, its atoms' ranges cut into pieces.
pub fn bounds(poly: &Poly, of: &dyn Fn(Atom) -> Range) -> Range {
    let atoms = poly.atoms();
    let sum = Sum::new(poly, &atoms);
    let each = boxes(&atoms, of).map(|sides| sum.within(&sides));
    each.reduce(Range::join).unwrap_or(Range::ALL)
}

/// Whether a polynomial is above 0 everywhere, by more than `margin` times the sizes
/// that its terms sum up to.
pub fn surely(poly: &Poly, of: &dyn Fn(Atom) -> Range, margin: f64) -> bool {
    let atoms = poly.atoms();
    let sum = Sum::new(poly, &atoms);
    let sides: Vec<Range> = atoms.iter().map(|atom| of(*atom)).collect();
    let least = margin * sum.size(&sides);
    least.is_finite() && boxes(&atoms, of).all(|sides| sum.within(&sides).lo > least)
}

/// The atoms' ranges cut into pieces, every box of them.
fn boxes(atoms: &[Atom], of: &dyn Fn(Atom) -> Range) -> impl Iterator<Item = Vec<Range>> {
    let ranges: Vec<Range> = atoms.iter().map(|atom| of(*atom)).collect();
    let wide = |r: &&Range| r.constant().is_none() && r.magnitude().is_finite();
    let count = ranges.iter().filter(wide).count().max(1);
    let pieces = (BOXES as f64).powf(1.0 / count as f64 + 1e-9) as usize;
    let all: Vec<Vec<Range>> = (ranges.iter())
        .map(|range| cut(*range, if wide(&range) { pieces } else { 1 }))
        .collect();
    let boxes: usize = all.iter().map(Vec::len).product();
    (0..boxes).map(move |mut number| {
        let one = |pieces: &Vec<Range>| {
            let piece = pieces[number % pieces.len()];
            number /= pieces.len();
            piece
        };
        all.iter().map(one).collect()
    })
}

fn cut(range: Range, pieces: usize) -> Vec<Range> {
    let at = |k: usize| range.lo + (range.hi - range.lo) * k as f64 / pieces as f64;
    let piece = |k: usize| match (k, pieces) {
        (_, 1) => range,
        _ => Range::new(at(k), if k + 1 == pieces { range.hi } else { at(k + 1) }),
    };
    (0..pieces).map(piece).collect()
}

/// A polynomial whose bounds in many boxes are asked for.
struct Sum {
    /// Each monomial's coefficient, and its atoms by their places in a list, with
    /// their powers.
    terms: Vec<(f64, Vec<(usize, u32)>)>,
}

impl Sum {
    /// `atoms` are all that are in it, and perhaps more.
    fn new(poly: &Poly, atoms: &[Atom]) -> Sum {
        let place = |atom: &Atom| atoms.iter().position(|a| a == atom).unwrap_or(usize::MAX);
        let terms = poly.terms.iter().map(|(monomial, number)| {
            let factors = monomial.iter().map(|(atom, power)| (place(atom), *power));
            (number.real(), factors.collect())
        });
        Sum {
            terms: terms.collect(),
        }
    }

    /// What the sizes of its terms sum up to at most where the atoms stay within `sides`.
    fn size(&self, sides: &[Range]) -> f64 {
        let side = |place: usize| sides.get(place).map_or(f64::INFINITY, |s| s.magnitude());
        let one = |(factor, factors): &(f64, Vec<(usize, u32)>)| {
            let powers = factors
                .iter()
                .map(|(place, power)| side(*place).powi(*power as i32));
            factor.abs() * powers.product::<f64>()
        };
        self.terms.iter().map(one).sum()
    }

    /// Its bounds where the atoms stay within `sides`, each monomial by itself.
    fn within(&self, sides: &[Range]) -> Range {
        let (mut lo, mut hi) = (0.0, 0.0);
        for (factor, factors) in &self.terms {
            let mut ends = (*factor, *factor);
            for (place, power) in factors {
                let side = sides.get(*place).copied().unwrap_or(Range::ALL);
                ends = times(ends, raised(side, *power));
            }
            (lo, hi) = (lo + ends.0, hi + ends.1);
        }
        Range::new(lo, hi)
    }
}

fn raised(x: Range, power: u32) -> (f64, f64) {
    let [a, b] = [x.lo, x.hi].map(|x| x.powi(power as i32));
    match power % 2 {
        0 if x.lo < 0.0 && x.hi > 0.0 => (0.0, a.max(b)),
        _ => (a.min(b), a.max(b)),
    }
}

fn times(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let product = |x: f64, y: f64| if x == 0.0 || y == 0.0 { 0.0 } else { x * y };
    let all = [
        product(a.0, b.0),
        product(a.0, b.1),
        product(a.1, b.0),
        product(a.1, b.1),
    ];
    let lo = all.into_iter().fold(f64::INFINITY, f64::min);
    (lo, all.into_iter().fold(f64::NEG_INFINITY, f64::max))
}

/// A polynomial's negative.
pub fn negative(poly: &Poly) -> Poly {
    poly.scaled(Number::whole(-1))
}
