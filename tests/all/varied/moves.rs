//! How far a result moves when one operation's does, which is what a format with a last
//! place may be off by; and whether what is decided on the way comes out otherwise then.

use super::big::Big;
use super::case::{Inputs, Kernel};
use super::run::{Move, Random, Site, Step, Value};
use slowlight_routine::scale::{FUNCTION, fitting, given};
use slowlight_routine::{Format, Op};
use std::collections::BTreeMap;
use std::rc::Rc;

/// More operations than this are not moved one by one: fixed point is not judged there.
const MOST_MOVED: usize = 300;

/// Up to so many are moved together, at random, so many times, to see what is decided.
const MOST_SHAKEN: usize = 5000;
const SHAKES: u64 = 4;

/// A decision that comes out otherwise when one operation is moved by so many roundings is
/// too close to call: the least that the file's own rules have.
const CLOSE: f64 = 4.0;

/// By what an operation's result is moved.
pub enum Rule<'r> {
    /// The larger of 2^-8 and 2^-16, as the file has it for fixed point.
    Fixed,
    /// The last place of a value of so many bits that has room for all that the operation
    /// is in the cases of one kind.
    Places(&'r Places, u8),
    /// So much of itself: of formats without a 0.
    Logarithms(f64),
    /// It is not.
    Nothing,
}

/// By operation and by output, the most that it is in the cases of one kind.
pub struct Places {
    sites: BTreeMap<Site, f64>,
    outputs: Vec<f64>,
}

/// A value's last place. Functions have a number of fraction bits of their own, 16 at most.
fn last_place(greatest: f64, bits: u8, function: Option<Op>) -> Big {
    let own = fitting(greatest, bits);
    let most = function.map(|op| given(op, bits).unwrap_or(FUNCTION));
    Big::power(-i32::from(own.min(most.unwrap_or(own))))
}

impl Kernel {
    /// Where the stable formula's points would be.
    pub fn places(&self, all: &[Inputs]) -> Places {
        let mut places = Places {
            sites: BTreeMap::new(),
            outputs: vec![0.0; self.outputs.len()],
        };
        for inputs in all {
            let (results, run) = self.results(self.values(inputs), Some(-53), None);
            for step in &run.trail {
                let greatest = places.sites.entry(step.site).or_default();
                *greatest = greatest.max(step.greatest);
            }
            for (greatest, result) in places.outputs.iter_mut().zip(&results) {
                if let Value::Number(x, false) = result {
                    *greatest = greatest.max(x.near().abs());
                }
            }
        }
        places
    }
}

/// A case's exact run, which is gone through again with operations moved.
pub struct Moves<'m> {
    pub kernel: &'m Kernel,
    pub values: &'m BTreeMap<String, Value>,
    pub results: &'m [Value],
    pub trail: &'m [Step],
}

impl Moves<'_> {
    /// By output, in last places of the format, how far fixed point may be off: the sum of
    /// what every operation moves it by when its own result moves by a last place, half of
    /// that more, and one last place of its own. Not where there are very many.
    pub fn quanta(&self, rule: &Rule) -> BTreeMap<String, f64> {
        let nothing = matches!(rule, Rule::Logarithms(_) | Rule::Nothing);
        if nothing || self.trail.len() > MOST_MOVED {
            return BTreeMap::new();
        }
        let all = match rule {
            Rule::Places(places, bits) => {
                let sums = self.sums(|at| self.last(rule, at));
                let unit = Format::Scaled { bits: *bits }.epsilon();
                let own = places
                    .outputs
                    .iter()
                    .map(|most| last_place(*most, *bits, None));
                let both = sums.iter().zip(own);
                both.map(|(sum, own)| (1.5 * sum + own.near()) / unit)
                    .collect()
            }
            _ => {
                let quanta = [-8, -16].map(|n| (Big::power(n), 2f64.powi(-n)));
                let sums = quanta.map(|(quantum, times)| {
                    let sums = self.sums(|_| quantum.clone());
                    sums.into_iter().map(|sum| sum * times).collect::<Vec<_>>()
                });
                let both = sums[0].iter().zip(&sums[1]);
                both.map(|(a, b)| (1.5 * a.max(*b) + 1.0).ceil())
                    .collect::<Vec<_>>()
            }
        };
        self.kernel.outputs.iter().cloned().zip(all).collect()
    }

    /// By what an operation is moved.
    fn last(&self, rule: &Rule, at: usize) -> Big {
        let step = &self.trail[at];
        match rule {
            Rule::Fixed => Big::power(-16),
            // Inputs may be rounded to a little more than the greatest.
            Rule::Places(places, bits) => {
                let all = places.sites.get(&step.site);
                let greatest = all.copied().unwrap_or_default();
                last_place(greatest.max(step.greatest), *bits, step.function)
            }
            Rule::Logarithms(part) => step.x.magnitude().times(&Big::new(*part)),
            Rule::Nothing => Big::new(0.0),
        }
    }

    /// By output, the sum of the greatest moves.
    fn sums(&self, by: impl Fn(usize) -> Big) -> Vec<f64> {
        let mut sums = vec![0f64; self.results.len()];
        for at in 0..self.trail.len() {
            let mut most = vec![0f64; sums.len()];
            let by = by(at);
            for by in [by.clone(), by.negated()] {
                let moved = self.moved(at, by);
                for (k, (there, here)) in moved.iter().zip(self.results).enumerate() {
                    if let (Value::Number(a, false), Value::Number(b, false)) = (there, here) {
                        most[k] = most[k].max(a.minus(b).magnitude().near());
                    }
                }
            }
            sums.iter_mut()
                .zip(most)
                .for_each(|(sum, most)| *sum += most);
        }
        sums
    }

    /// Whether a result is there, or a whole number is another, when one operation is moved
    /// by a few roundings.
    pub fn undecided(&self, rule: &Rule) -> bool {
        let nothing = matches!(rule, Rule::Fixed | Rule::Nothing);
        if nothing || self.trail.len() > MOST_SHAKEN {
            return false;
        }
        if self.trail.len() > MOST_MOVED {
            return (1..=SHAKES).any(|seed| self.shaken(rule, seed));
        }
        (0..self.trail.len()).any(|at| {
            let by = self.last(rule, at).times(&Big::new(CLOSE));
            [by.clone(), by.negated()].into_iter().any(|by| {
                let moved = self.moved(at, by);
                moved.iter().zip(self.results).any(|(a, b)| otherwise(a, b))
            })
        })
    }

    /// Whether it comes out otherwise where every operation is moved, up or down.
    fn shaken(&self, rule: &Rule, seed: u64) -> bool {
        let steps = self.trail.iter().enumerate();
        let by = steps.map(|(at, step)| {
            let by = self.last(rule, at).times(&Big::new(CLOSE));
            (step.site, by)
        });
        let all = Move::All(Rc::new(by.collect()), Random(seed << 20));
        let values = self.values.clone();
        let (results, run) = self.kernel.results(values, Some(-53), Some(all));
        let both = results.iter().zip(self.results);
        run.senseless || both.into_iter().any(|(a, b)| otherwise(a, b))
    }

    /// The results where an operation's is moved; none where another then has no meaning.
    fn moved(&self, at: usize, by: Big) -> Vec<Value> {
        let values = self.values.clone();
        let (results, run) = self
            .kernel
            .results(values, Some(-53), Some(Move::One(at, by)));
        if run.senseless { Vec::new() } else { results }
    }
}

/// Whether what was decided for two results differs.
fn otherwise(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a, true), Value::Number(b, true)) => !a.minus(b).is_zero(),
        (Value::Number(..), Value::Number(..)) => false,
        (Value::List(a), Value::List(b)) => {
            a.len() != b.len() || a.iter().zip(b).any(|(a, b)| otherwise(a, b))
        }
        (Value::Nothing, Value::Nothing) => false,
        _ => true,
    }
}
