//! Affine error forms: how far a value is off, to first order and with proof.

use crate::ir::interval::product;
use slowlight_routine::Range;

/// A rounding that was made once, on the way to a value.
pub type Source = u32;

/// How many roundings a form tells apart; the least of more are added up.
const APART: usize = 96;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Term {
    source: Source,
    /// Between which bounds this rounding's part lies where it errs upwards as
    /// far as it may; 0 lies wherever it does not err.
    lo: f64,
    hi: f64,
}

impl Term {
    fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }
}

/// What a machine's value is more than the exact one: for each rounding e made
/// on the way, from -1 to 1 of the most that it may be, a part c e with c
/// within bounds, and a rest of unknown sign. Roundings that two values share
/// cancel where the values are subtracted, as in affine arithmetic (Stolfi and
/// de Figueiredo, Self-Validated Numerical Methods and Applications, 1997).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Form {
    /// By source, each once.
    terms: Vec<Term>,
    rest: f64,
}

impl Form {
    /// No error.
    pub const EXACT: Form = Form {
        terms: Vec::new(),
        rest: 0.0,
    };

    /// An error of which nothing is known.
    pub fn unbounded() -> Form {
        Form::within(f64::INFINITY)
    }

    /// An error of at most so much, related to no other.
    pub fn within(rest: f64) -> Form {
        Form {
            terms: Vec::new(),
            rest,
        }
    }

    /// One rounding, of at most so much.
    pub fn rounding(source: Source, most: f64) -> Form {
        if most == 0.0 {
            return Form::EXACT;
        }
        Form {
            terms: vec![Term {
                source,
                lo: most,
                hi: most,
            }],
            rest: 0.0,
        }
    }

    /// The most that it can be; infinite where nothing is proved.
    pub fn bound(&self) -> f64 {
        let sum = self.terms.iter().map(|t| t.magnitude()).sum::<f64>() + self.rest;
        if sum.is_nan() { f64::INFINITY } else { sum }
    }

    /// Whether there is none.
    pub fn is_exact(&self) -> bool {
        self.terms.is_empty() && self.rest == 0.0
    }

    /// The sum of two errors.
    pub fn plus(&self, other: &Form) -> Form {
        self.merge(other, self.rest + other.rest, |a, b| (a.0 + b.0, a.1 + b.1))
    }

    /// The difference of two errors.
    pub fn minus(&self, other: &Form) -> Form {
        self.merge(other, self.rest + other.rest, |a, b| (a.0 - b.1, a.1 - b.0))
    }

    /// What lies between the one and the other: their weighted means.
    pub fn hull(&self, other: &Form) -> Form {
        self.merge(other, self.rest.max(other.rest), |a, b| {
            (a.0.min(b.0), a.1.max(b.1))
        })
    }

    /// The error times something that lies within a range.
    pub fn scaled(&self, by: Range) -> Form {
        if by.constant() == Some(0.0) || self.is_exact() {
            return Form::EXACT;
        }
        let scale = |t: &Term| {
            let made = product(Range::new(t.lo, t.hi), by);
            Term {
                source: t.source,
                lo: made.lo,
                hi: made.hi,
            }
        };
        Form {
            terms: self.terms.iter().map(scale).collect(),
            rest: if self.rest == 0.0 {
                0.0
            } else {
                self.rest * by.magnitude()
            },
        }
    }

    fn merge(
        &self,
        other: &Form,
        rest: f64,
        join: impl Fn((f64, f64), (f64, f64)) -> (f64, f64),
    ) -> Form {
        let mut terms = Vec::with_capacity(self.terms.len() + other.terms.len());
        let (mut left, mut right) = (self.terms.iter().peekable(), other.terms.iter().peekable());
        loop {
            let source = match (left.peek(), right.peek()) {
                (Some(a), Some(b)) => a.source.min(b.source),
                (Some(a), None) => a.source,
                (None, Some(b)) => b.source,
                (None, None) => break,
            };
            let part = |t: Option<&Term>| t.map_or((0.0, 0.0), |t| (t.lo, t.hi));
            let a = part(left.next_if(|t| t.source == source));
            let b = part(right.next_if(|t| t.source == source));
            let (lo, hi) = join(a, b);
            if lo != 0.0 || hi != 0.0 {
                terms.push(Term { source, lo, hi });
            }
        }
        let mut made = Form { terms, rest };
        made.condense();
        made
    }

    /// Adds the least terms up where there are too many.
    fn condense(&mut self) {
        if self.terms.len() <= APART {
            return;
        }
        let mut sizes: Vec<f64> = self.terms.iter().map(|t| t.magnitude()).collect();
        sizes.sort_by(|a, b| b.total_cmp(a));
        let least = sizes.get(APART / 2).copied().unwrap_or(0.0);
        let mut rest = self.rest;
        self.terms.retain(|t| {
            let keep = t.magnitude() > least;
            if !keep {
                rest += t.magnitude();
            }
            keep
        });
        self.rest = rest;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shared_roundings_cancel_and_others_add() {
        let (a, b) = (Form::rounding(1, 0.5), Form::rounding(2, 0.25));
        assert_eq!(a.minus(&a).bound(), 0.0);
        assert_eq!(a.plus(&b).bound(), 0.75);
        assert_eq!(a.plus(&b).minus(&a).bound(), 0.25);
        assert_eq!(a.hull(&b).bound(), 0.75);
        assert_eq!(a.scaled(Range::new(-3.0, 2.0)).bound(), 1.5);
    }

    #[test]
    fn many_terms_are_added_up_without_loss() {
        let all = (0..1000).map(|k| Form::rounding(k, 1.0));
        let sum = all.fold(Form::EXACT, |a, b| a.plus(&b));
        assert_eq!(sum.bound(), 1000.0);
        assert!(sum.terms.len() <= APART);
    }
}
