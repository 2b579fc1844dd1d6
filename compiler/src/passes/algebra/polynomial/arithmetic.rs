//! Arithmetic of normal forms: their sums and products.

use super::form::{Form, Forms, Part, Roots, Two};
use super::number::Number;
use super::poly::Poly;

/// How many parts a form may have.
const PARTS: usize = 2;

impl Forms<'_> {
    /// The sum of two forms.
    pub fn sum(&self, a: &Form, b: &Form) -> Option<Form> {
        let mut sum = a.clone();
        for part in &b.parts {
            match sum
                .parts
                .iter()
                .position(|p| together(&p.roots, &part.roots))
            {
                Some(at) => {
                    let both = self.joined(&sum.parts[at], part)?;
                    sum.parts[at] = both;
                }
                None => sum.parts.push(part.clone()),
            }
        }
        sum.parts.retain(|p| !p.poly.is_zero());
        (sum.parts.len() <= PARTS).then_some(sum)
    }

    /// Two parts whose roots differ by even powers, as one.
    fn joined(&self, a: &Part, b: &Part) -> Option<Part> {
        let mut roots = Roots::new();
        let mut polys = [a.poly.clone(), b.poly.clone()];
        for root in 0..self.roots.len() {
            let powers = [power(&a.roots, root), power(&b.roots, root)];
            let most = powers[0].max(powers[1]);
            for (poly, power) in polys.iter_mut().zip(powers) {
                // s^power = s^most N^((most - power) / 2)
                for _ in 0..(most - power) / 2 {
                    *poly = poly.mul(&self.roots[root])?;
                }
            }
            if most != 0 {
                roots.push((root, most));
            }
        }
        let poly = polys[0].add(&polys[1])?;
        self.reduced(Part { roots, poly })
    }

    /// The product of two forms.
    pub fn product(&self, a: &Form, b: &Form) -> Option<Form> {
        let mut sum = Form::default();
        for x in &a.parts {
            for y in &b.parts {
                let part = self.reduced(Part {
                    roots: multiplied(&x.roots, &y.roots),
                    poly: x.poly.mul(&y.poly)?,
                })?;
                sum = self.sum(&sum, &Form { parts: vec![part] })?;
            }
        }
        Some(sum)
    }

    /// A part with what its atoms and roots imply applied.
    fn reduced(&self, mut part: Part) -> Option<Part> {
        for atom in part.poly.atoms() {
            if let Some(Two { low, high }) = self.two(atom) {
                let (one, two) = match (low, high) {
                    (-1, 1) => (Poly::atom(atom), Poly::constant(Number::ONE)),
                    (0, 1) => (Poly::atom(atom), Poly::atom(atom)),
                    _ => continue,
                };
                part.poly = part.poly.with_powers(atom, &one, &two)?;
            }
        }
        for k in 0..part.roots.len() {
            let (root, _) = part.roots[k];
            let n = &self.roots[root];
            let Some(main) = n.atoms().into_iter().find(|a| self.varies(*a)) else {
                continue;
            };
            while part.roots[k].1 >= 2 {
                let Some(less) = part.poly.divided(n, main) else {
                    break;
                };
                part.poly = less;
                part.roots[k].1 -= 2;
            }
        }
        part.roots.retain(|(_, power)| *power != 0);
        Some(part)
    }
}

fn power(roots: &Roots, root: usize) -> i32 {
    roots
        .iter()
        .find(|(r, _)| *r == root)
        .map_or(0, |(_, k)| *k)
}

/// Whether the powers of all roots differ by even numbers.
fn together(a: &Roots, b: &Roots) -> bool {
    multiplied(a, b).iter().all(|(_, k)| k % 2 == 0)
}

/// The powers of a product.
pub fn multiplied(a: &Roots, b: &Roots) -> Roots {
    let mut all: Roots = a.clone();
    for (root, k) in b {
        match all.iter_mut().find(|(r, _)| r == root) {
            Some(held) => held.1 += k,
            None => all.push((*root, *k)),
        }
    }
    all.retain(|(_, k)| *k != 0);
    all.sort_unstable();
    all
}
