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
use std::rc::Rc;
use std::sync::{Mutex, PoisonError};

/// How many boxes are looked at, and how many numbers a polynomial may have.
const BOXES: usize = 1 << 15;
const NUMBERS: usize = 1 << 12;

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
        let mut widths = vec![0.0; atoms.len()];
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

/// Which number is of which monomial.
struct Layout {
    /// How many powers each place has, and how far apart the numbers of two stand.
    powers: Vec<(usize, usize)>,
    /// Which places each monomial has in it, and whether it is never below 0.
    monomials: Vec<(Vec<usize>, bool)>,
}

impl Layout {
    fn new(powers: Vec<(usize, usize)>, count: usize) -> Layout {
        let monomial = |at: usize| {
            let power = |k: &usize| at / powers[*k].1 % powers[*k].0;
            let places: Vec<usize> = (0..powers.len()).filter(|k| power(k) > 0).collect();
            let even = places.iter().all(|k| power(k) % 2 == 0);
            (places, even)
        };
        Layout {
            monomials: (0..count).map(monomial).collect(),
            powers,
        }
    }
}

impl Local {
    /// Nothing where an atom has no bounds, or where it has too many numbers.
    fn new(poly: &Poly, atoms: &[Atom], sides: &[Range], margin: f64) -> Option<Local> {
        let mut powers = Vec::new();
        let mut count = 1_usize;
        for atom in atoms {
            let of = |(a, power): &(Atom, u32)| (a == atom).then_some(*power as usize);
            let most = poly
                .terms
                .keys()
                .flat_map(|m| m.iter().filter_map(of))
                .max();
            let many = most.unwrap_or(0) + 1;
            powers.push((many, count));
            count = count.checked_mul(many).filter(|count| *count <= NUMBERS)?;
        }
        let mut made = Local {
            numbers: vec![0.0; count],
            layout: Rc::new(Layout::new(powers, count)),
            off: 0.0,
        };
        for (monomial, number) in &poly.terms {
            let (mut at, mut size) = (0, number.real().abs());
            for (atom, power) in monomial {
                let k = atoms.iter().position(|a| a == atom)?;
                at += made.layout.powers[k].1 * *power as usize;
                size *= sides[k].magnitude().powi(*power as i32);
            }
            made.numbers[at] += number.real();
            made.off += margin * size;
        }
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
        let (many, step) = self.layout.powers[k];
        for start in 0..self.numbers.len() {
            if start / step % many != 0 {
                continue;
            }
            let at = |power: usize| start + power * step;
            // Horner's scheme about a, then each power of b.
            for low in 0..many {
                for power in (low..many - 1).rev() {
                    self.numbers[at(power)] += a * self.numbers[at(power + 1)];
                }
            }
            let mut factor = 1.0;
            for power in 0..many {
                self.numbers[at(power)] *= factor;
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
