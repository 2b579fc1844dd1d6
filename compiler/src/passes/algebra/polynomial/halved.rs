//! Implied inequalities, proved by bisection: what holds wherever a root has something to be
//! taken of.
//!
//! That the nearer end of a sphere lies ahead holds for rays that meet it only, and
//! intervals for five or six values that wander (the column, the row, where the eye
//! is) say little about both. So boxes of the values are halved until each is one
//! where the root's argument is below 0 or one where what is asked holds; how many
//! that takes depends on how far apart the two are, and only near them. In each box
//! polynomials are of the places in it, from -1 to 1, so bounds get sharp quickly.

use super::poly::{Atom, Poly};
use slowlight_routine::Range;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::{Mutex, PoisonError};

/// How many boxes are looked at, and how many numbers a polynomial may have.
const BOXES: usize = 1 << 15;
const NUMBERS: usize = 1 << 10;

/// What was asked for, with the atoms' bounds, and whether it holds: plans of one scene
/// ask the same.
#[derive(Default)]
pub struct Proofs(Mutex<Vec<Proof>>);

/// The polynomials, the bounds of their atoms, and what was found.
struct Proof {
    polys: [Poly; 3],
    sides: Vec<Range>,
    holds: bool,
}

impl Proofs {
    /// Whether p - sqrt(n) is above 0 wherever n is not below 0: p is, and p² - n
    /// (`rest`) is. Roundings may move each by `margin`, a number of the format's,
    /// times the sizes that its terms sum up to.
    pub fn above_where_real(
        &self,
        polys: [&Poly; 3],
        of: &dyn Fn(Atom) -> Range,
        margin: f64,
    ) -> bool {
        let mut atoms: Vec<Atom> = polys.iter().flat_map(|poly| poly.atoms()).collect();
        atoms.sort_unstable();
        atoms.dedup();
        let sides: Vec<Range> = atoms.iter().map(|atom| of(*atom)).collect();
        let held = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let same = |known: &&Proof| known.polys.iter().eq(polys) && known.sides == sides;
        let known = held().iter().find(same).map(|known| known.holds);
        known.unwrap_or_else(|| {
            let holds = above(polys, &atoms, &sides, margin);
            let polys = polys.map(Poly::clone);
            held().push(Proof {
                polys,
                sides,
                holds,
            });
            holds
        })
    }
}

fn above([p, rest, n]: [&Poly; 3], atoms: &[Atom], sides: &[Range], margin: f64) -> bool {
    let all = [n, p, rest].map(|poly| Local::new(poly, atoms, sides, margin));
    let [Some(n), Some(p), Some(rest)] = all else {
        return false;
    };
    // Of p and the rest what is not above 0 in all of the box yet: what is stays so in its
    // halves.
    let mut open = vec![(n, vec![p, rest])];
    let mut widths = vec![0.0; atoms.len()];
    for _ in 0..BOXES {
        let Some((n, mut asked)) = open.pop() else {
            return true;
        };
        if n.bounds().1 < -n.off {
            continue;
        }
        asked.retain(|poly| poly.bounds().0 <= poly.off);
        if asked.is_empty() {
            continue;
        }
        // Its middle is a point of it.
        if n.middle() >= -n.off && asked.iter().any(|poly| poly.middle() <= poly.off) {
            return false;
        }
        widths.fill(0.0);
        for poly in asked.iter().chain([&n]) {
            poly.add_shares(&mut widths);
        }
        let widest = (0..atoms.len()).max_by(|&a, &b| widths[a].total_cmp(&widths[b]));
        let Some(widest) = widest else {
            return false;
        };
        for side in [-1.0, 1.0] {
            let halves = asked.iter().map(|poly| poly.half(widest, side));
            open.push((n.half(widest, side), halves.collect()));
        }
    }
    false
}

/// A polynomial of places from -1 to 1: a number for each monomial.
#[derive(Clone)]
struct Local {
    numbers: Vec<f64>,
    layout: Rc<Layout>,
    /// How far roundings may move it.
    off: f64,
}

/// The power of each place in a monomial.
type Powers = Vec<u32>;

/// Which number is of which monomial: those of a polynomial and what divides them, as these are
/// what comes of other places in it.
struct Layout {
    /// Which places each monomial has in it, and whether it is never below 0; the first is 1.
    monomials: Vec<(Vec<usize>, bool)>,
    /// For each place the monomials that differ in its power alone, from power 0 on.
    chains: Vec<Vec<Vec<usize>>>,
}

impl Layout {
    /// Nothing where there are too many monomials.
    fn new(terms: &BTreeMap<Powers, f64>, places: usize) -> Option<(Layout, Vec<Powers>)> {
        let mut all = BTreeSet::from([vec![0; places]]);
        let mut open: Vec<Powers> = terms.keys().cloned().collect();
        while let Some(powers) = open.pop() {
            for k in (0..places).filter(|k| powers[*k] > 0) {
                let mut less = powers.clone();
                less[k] -= 1;
                open.extend((!all.contains(&less)).then_some(less));
            }
            all.insert(powers);
            if all.len() > NUMBERS {
                return None;
            }
        }
        let all: Vec<Powers> = all.into_iter().collect();
        let monomial = |powers: &Powers| {
            let places: Vec<usize> = (0..places).filter(|k| powers[*k] > 0).collect();
            (places, powers.iter().all(|power| power % 2 == 0))
        };
        let chains = |k: usize| {
            let chain = |powers: &Powers| {
                let mut of = powers.clone();
                let one_more = |_: &usize| {
                    of[k] += 1;
                    all.binary_search(&of).ok()
                };
                let first = all.binary_search(powers).ok();
                std::iter::successors(first, one_more).collect()
            };
            all.iter().filter(|of| of[k] == 0).map(chain).collect()
        };
        let layout = Layout {
            monomials: all.iter().map(monomial).collect(),
            chains: (0..places).map(chains).collect(),
        };
        Some((layout, all))
    }
}

impl Local {
    /// Nothing where an atom has no bounds, or where it has too many numbers.
    fn new(poly: &Poly, atoms: &[Atom], sides: &[Range], margin: f64) -> Option<Local> {
        let mut terms = BTreeMap::new();
        let mut off = 0.0;
        for (monomial, number) in &poly.terms {
            let mut powers = vec![0; atoms.len()];
            let mut size = number.real().abs();
            for (atom, power) in monomial {
                let k = atoms.iter().position(|a| a == atom)?;
                powers[k] += power;
                size *= sides[k].magnitude().powi(*power as i32);
            }
            *terms.entry(powers).or_insert(0.0) += number.real();
            off += margin * size;
        }
        let (layout, all) = Layout::new(&terms, atoms.len())?;
        let number = |powers| terms.get(powers).copied().unwrap_or(0.0);
        let mut made = Local {
            numbers: all.iter().map(number).collect(),
            layout: Rc::new(layout),
            off,
        };
        for (k, side) in sides.iter().enumerate() {
            made.place(
                k,
                f64::midpoint(side.lo, side.hi),
                (side.hi - side.lo) / 2.0,
            );
        }
        made.off.is_finite().then_some(made)
    }

    /// What it is of a + b x in place of x.
    fn place(&mut self, k: usize, a: f64, b: f64) {
        for chain in &self.layout.chains[k] {
            // Horner's scheme about a, then each power of b.
            for low in 0..chain.len() {
                for pair in chain[low..].windows(2).rev() {
                    self.numbers[pair[0]] += a * self.numbers[pair[1]];
                }
            }
            let mut factor = 1.0;
            for at in chain {
                self.numbers[*at] *= factor;
                factor *= b;
            }
        }
    }

    /// The half of its box at one end of a side.
    fn half(&self, k: usize, side: f64) -> Local {
        let mut half = self.clone();
        half.place(k, side / 2.0, 0.5);
        half
    }

    fn middle(&self) -> f64 {
        self.numbers[0]
    }

    /// The numbers of all monomials that have a place in them.
    fn others(&self) -> impl Iterator<Item = (f64, &(Vec<usize>, bool))> {
        let all = self.numbers.iter().copied().zip(&self.layout.monomials);
        all.skip(1).filter(|(number, _)| *number != 0.0)
    }

    /// The least and the most that it can be.
    fn bounds(&self) -> (f64, f64) {
        let (mut lo, mut hi) = (self.middle(), self.middle());
        for (number, (_, even)) in self.others() {
            lo -= if *even {
                (-number).max(0.0)
            } else {
                number.abs()
            };
            hi += if *even { number.max(0.0) } else { number.abs() };
        }
        (lo, hi)
    }

    /// Adds how much of its width each side makes, as a part of the whole of it.
    fn add_shares(&self, shares: &mut [f64]) {
        let all: f64 = self.others().map(|(number, _)| number.abs()).sum();
        for (number, (places, _)) in self.others() {
            for place in places {
                shares[*place] += number.abs() / all;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::algebra::polynomial::number::Number;

    /// Whether p - sqrt(n) is above 0 wherever n is not below 0, for x from 0 to 5.
    fn holds(p: &Poly, n: &Poly) -> bool {
        let rest = p
            .mul(p)
            .and_then(|square| square.add(&n.scaled(Number::whole(-1))));
        let of = |_| Range::new(0.0, 5.0);
        rest.is_some_and(|rest| Proofs::default().above_where_real([p, &rest, n], &of, 1e-9))
    }

    #[test]
    fn what_has_no_root_need_not_hold() {
        let x = Poly::atom(0);
        let less = |by: i128| x.add(&Poly::constant(Number::whole(-by)));
        let [Some(one), Some(two), Some(four)] = [1, 2, 4].map(less) else {
            panic!("sums of two terms");
        };
        // x - 1 > sqrt(x - 2): below 0 where x < 1, but nothing has a root there.
        assert!(holds(&one, &two));
        // x - 4 is below 0 where x - 2 has a root, and x - 1 is less than sqrt(x) at 1.
        assert!(!holds(&four, &two));
        assert!(!holds(&one, &x));
        assert!(holds(&x, &two));
    }
}
