//! Whether a result passes.

use super::exact::{Exact, dot};
use super::file::{Predicate, Wanted};
use super::format::Arithmetic;
use serde_json::Value as Json;

/// What a kernel gave.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Got {
    /// Whether there is a result.
    pub there: bool,
    /// Its scalars, in the order of the entry's outputs, or cell by cell.
    pub values: Vec<f64>,
    /// Where values left the format, in words; what such a result is worth.
    pub left: Option<String>,
    /// What exact arithmetic makes of it that loses nothing else, where it is not known that
    /// this matters: if that is right, nothing is excused by what left.
    pub lossy: Option<Box<Got>>,
}

/// What a judgement comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Whether it passes.
    pub passed: bool,
    /// Of what was measured, the greatest error over its bound.
    pub worst: f64,
    /// That bound; none where nothing was measured.
    pub bound: Option<f64>,
    /// Whether it passes only because leaving the format was allowed, and said.
    pub refused: bool,
}

impl Verdict {
    fn plain(passed: bool) -> Verdict {
        Verdict {
            passed,
            worst: 0.0,
            bound: None,
            refused: false,
        }
    }

    fn measured(error: f64, bound: f64) -> Verdict {
        let worst = if error == 0.0 { 0.0 } else { error / bound };
        Verdict {
            passed: error <= bound,
            worst,
            bound: Some(bound),
            refused: false,
        }
    }

    /// Both pass; the worse measure counts.
    fn and(self, other: Verdict) -> Verdict {
        let worse = self.bound.is_none() || (other.bound.is_some() && other.worst > self.worst);
        let (worst, bound) = match worse {
            true => (other.worst, other.bound),
            false => (self.worst, self.bound),
        };
        Verdict {
            passed: self.passed && other.passed,
            worst,
            bound,
            refused: self.refused || other.refused,
        }
    }
}

/// A result to be judged.
pub struct Judge<'j> {
    /// The arithmetic that it was computed in.
    pub arithmetic: Arithmetic,
    /// The outputs' names.
    pub outputs: &'j [String],
    /// The result.
    pub got: &'j Got,
    /// What is wanted.
    pub wanted: &'j Wanted,
}

impl Judge<'_> {
    /// Judges by the case's own predicate. What the predicate cannot make sense
    /// of does not pass.
    pub fn verdict(&self) -> Verdict {
        self.by(&self.wanted.predicate)
            .unwrap_or(Verdict::plain(false))
    }

    fn by(&self, predicate: &Predicate) -> Option<Verdict> {
        let u = self.arithmetic.epsilon();
        let tiny = self.arithmetic.tiny();
        Some(match predicate {
            Predicate::All { of } => {
                let mut all = Verdict::plain(true);
                for one in of {
                    all = all.and(self.by(one)?);
                }
                all
            }
            Predicate::Present { value } => Verdict::plain(self.got.there == *value),
            Predicate::IfPresent { predicate } => match self.got.there {
                true => self.by(predicate)?,
                false => Verdict::plain(true),
            },
            Predicate::Decided {
                margin,
                k,
                predicate,
            } => match *margin <= k * u {
                true => Verdict::plain(true),
                false => self.by(predicate)?,
            },
            Predicate::RefuseOr { hi, lo, predicate } => {
                let inner = self.by(predicate)?;
                let allowed = self.got.left.is_some() && self.arithmetic.cannot_hold(*hi, *lo);
                match allowed && !inner.passed && self.is_lost(predicate) {
                    true => Verdict {
                        refused: true,
                        ..Verdict::plain(true)
                    },
                    _ => inner,
                }
            }
            _ if !self.got.there => Verdict::plain(false),
            Predicate::Rel {
                output,
                k,
                cond,
                kq,
            } => match (self.want(output)?, cond) {
                (None, _) => Verdict::plain(true),
                (Some(want), _) if self.arithmetic.is_fixed() => {
                    self.within_quanta(output, &want, *kq, 0.0)?
                }
                (_, None) => Verdict::plain(true),
                (Some(want), Some(cond)) => {
                    let bound = tiny + k * u * cond.max(1.0) * want.near().abs();
                    Verdict::measured(self.value(output)?.distance(&want), bound)
                }
            },
            Predicate::Abs {
                output,
                k,
                scale,
                pow,
                slack,
                kq,
            } => match self.want(output)? {
                None => Verdict::plain(true),
                Some(want) if self.arithmetic.is_fixed() => {
                    self.within_quanta(output, &want, *kq, *slack)?
                }
                Some(want) => {
                    let bound = tiny + slack + k * u.powf(*pow) * scale;
                    Verdict::measured(self.value(output)?.distance(&want), bound)
                }
            },
            Predicate::Sign { output, zero } => match self.want(output)? {
                None => Verdict::plain(true),
                Some(want) => {
                    let allowed = zero.as_bool().unwrap_or(zero.as_f64() == Some(1.0));
                    let got = self.value(output)?.sign();
                    Verdict::plain(got == want.sign() || (allowed && got == 0))
                }
            },
            Predicate::Equal { output } => self.equal(output, 0.0)?,
            Predicate::Near { output, by } => self.equal(output, *by)?,
            Predicate::Interval {
                output,
                lo,
                hi,
                k,
                scale,
            } => {
                let slack = k * u * scale;
                let fits = |x: f64| x >= lo - slack && x <= hi + slack;
                Verdict::plain(match output.as_str() {
                    "*" => self.got.values.iter().all(|x| fits(*x)),
                    name => fits(*self.got.values.get(self.place(name)?)?),
                })
            }
            Predicate::UnitVector { outputs, k } => {
                let parts: Option<Vec<Exact>> = outputs.iter().map(|o| self.value(o)).collect();
                let parts = parts?;
                let error = dot(&parts, &parts).distance(&Exact::new(1.0));
                Verdict::measured(error, k * u)
            }
            Predicate::Orthonormal { k } => self.orthonormal(k * u)?,
        })
    }

    /// Whether what left the format alone makes a result wrong, as far as that is known.
    fn is_lost(&self, predicate: &Predicate) -> bool {
        self.got.lossy.as_deref().is_none_or(|got| {
            let exactly = Judge { got, ..*self };
            !exactly.by(predicate).is_some_and(|verdict| verdict.passed)
        })
    }

    fn place(&self, output: &str) -> Option<usize> {
        self.outputs.iter().position(|o| o == output)
    }

    fn value(&self, output: &str) -> Option<Exact> {
        let found = self.got.values.get(self.place(output)?)?;
        Some(Exact::new(*found))
    }

    /// What is wanted of an output; `Some(None)` where nothing is prescribed.
    fn want(&self, output: &str) -> Option<Option<Exact>> {
        match self.wanted.expected.get(output)? {
            Json::Null => Some(None),
            Json::String(text) => Exact::parse(text).map(Some),
            Json::Number(number) => Exact::parse(&number.to_string()).map(Some),
            _ => None,
        }
    }

    /// Fixed point: within so many last places.
    fn within_quanta(
        &self,
        output: &str,
        want: &Exact,
        kq: Option<f64>,
        slack: f64,
    ) -> Option<Verdict> {
        let Some(kq) = kq else {
            return Some(Verdict::plain(true));
        };
        let bound = kq * self.arithmetic.epsilon() + slack;
        Some(Verdict::measured(self.value(output)?.distance(want), bound))
    }

    /// Whole numbers, as wanted but for so much.
    fn equal(&self, output: &str, by: f64) -> Option<Verdict> {
        let want = self.wanted.expected.get(output)?;
        Some(Verdict::plain(match want {
            Json::Null => true,
            Json::Array(cells) => {
                let pairs = cells.iter().filter_map(Json::as_array).flatten();
                let want: Vec<f64> = pairs.filter_map(Json::as_f64).collect();
                let got = self.got.values.get(..want.len());
                let near = |got: &[f64]| got.iter().zip(&want).all(|(a, b)| (a - b).abs() <= by);
                !want.is_empty() && got.is_some_and(near)
            }
            _ => self.value(output)?.distance(&self.want(output)??) <= by,
        }))
    }

    /// Three vectors of length 1, perpendicular to each other, right-handed.
    fn orthonormal(&self, bound: f64) -> Option<Verdict> {
        let all: Vec<Exact> = self.got.values.iter().map(|x| Exact::new(*x)).collect();
        let [x, y, z] = [all.get(0..3)?, all.get(3..6)?, all.get(6..9)?];
        let one = Exact::new(1.0);
        let none = Exact::new(0.0);
        let mut errors = Vec::new();
        for (a, b) in [(x, x), (y, y), (z, z)] {
            errors.push(dot(a, b).distance(&one));
        }
        for (a, b) in [(x, y), (y, z), (z, x)] {
            errors.push(dot(a, b).distance(&none));
        }
        let minor = |i: usize, j: usize| {
            let (a, b) = (y.get(i)?.times(z.get(j)?), y.get(j)?.times(z.get(i)?));
            Some(a.minus(&b))
        };
        let cross = [minor(1, 2)?, minor(2, 0)?, minor(0, 1)?];
        errors.push(dot(x, &cross).distance(&one));
        let measured = errors.iter().map(|e| Verdict::measured(*e, bound));
        measured.reduce(Verdict::and)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use slowlight_routine::Format;

    fn passes(arithmetic: Arithmetic, predicate: &str, want: &str, got: &[f64]) -> bool {
        let text = format!("{{\"expected\": {want}, \"predicate\": {predicate}}}");
        let wanted: Wanted = serde_json::from_str(&text).unwrap();
        let outputs: Vec<String> = ["a", "b", "c"].map(str::to_owned).to_vec();
        let got = Got {
            there: !got.is_empty(),
            values: got.to_vec(),
            ..Got::default()
        };
        let judge = Judge {
            arithmetic,
            outputs: &outputs,
            got: &got,
            wanted: &wanted,
        };
        judge.verdict().passed
    }

    const JACK: Arithmetic = Arithmetic::Of(Format::Float316 { rounded: false });
    const FIXED: Arithmetic = Arithmetic::Of(Format::Fixed { bits: 32, frac: 16 });

    #[test]
    fn errors_are_held_against_their_bounds() {
        let rel = r#"{"kind": "rel", "output": "a", "k": 2, "cond": 1, "kq": 3}"#;
        let third = r#"{"a": "0.333333333333333333333333333333"}"#;
        let near = 1.0 / 3.0;
        assert!(passes(Arithmetic::Native, rel, third, &[near]));
        // One unit is within two roundoffs, two are not.
        assert!(passes(Arithmetic::Native, rel, third, &[near.next_up()]));
        assert!(!passes(
            Arithmetic::Native,
            rel,
            third,
            &[near.next_up().next_up()]
        ));
        assert!(passes(JACK, rel, third, &[near * (1.0 + 1.9 / 8192.0)]));
        assert!(!passes(JACK, rel, third, &[near * (1.0 + 2.1 / 8192.0)]));
        assert!(passes(FIXED, rel, third, &[near + 2.9 / 65536.0]));
        assert!(!passes(FIXED, rel, third, &[near + 3.1 / 65536.0]));
        assert!(!passes(JACK, rel, third, &[]));
    }

    #[test]
    fn other_predicates_say_no_too() {
        let one = r#"{"a": "1", "b": "-2", "c": [[0, 1], [2, 3]]}"#;
        let native = |predicate: &str, got: &[f64]| passes(Arithmetic::Native, predicate, one, got);
        let sign = r#"{"kind": "sign", "output": "b", "zero": 1}"#;
        assert!(native(sign, &[0.0, -1e-300, 0.0]) && native(sign, &[0.0, 0.0, 0.0]));
        assert!(!native(sign, &[0.0, 1e-300, 0.0]));
        let equal = r#"{"kind": "equal", "output": "c"}"#;
        assert!(native(equal, &[0.0, 1.0, 2.0, 3.0, 9.0, 9.0]));
        assert!(!native(equal, &[0.0, 1.0, 2.0, 4.0]));
        let near = r#"{"kind": "near", "output": "c", "by": 1}"#;
        assert!(native(near, &[0.0, 2.0, 2.0, 2.0]) && !native(near, &[0.0, 1.0, 2.0, 5.0]));
        assert!(!native(near, &[0.0, 1.0, 2.0]));
        let decided = r#"{"kind": "decided", "margin": 1e-10, "k": 8, "predicate": {"kind": "present", "value": false}}"#;
        assert!(!native(decided, &[1.0]) && passes(JACK, decided, one, &[1.0]));
        let length = r#"{"kind": "unit_vector", "outputs": ["a", "b"], "k": 4}"#;
        assert!(native(length, &[0.6, 0.8]) && !native(length, &[0.6, 0.80001]));
        let frame = r#"{"kind": "orthonormal", "k": 8}"#;
        let right = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let left = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0];
        assert!(native(frame, &right) && !native(frame, &left) && !native(frame, &[0.0; 9]));
        let unknown = r#"{"kind": "rel", "output": "d", "k": 1, "cond": 1}"#;
        assert!(!native(unknown, &[1.0]));
        let interval =
            r#"{"kind": "interval", "output": "*", "lo": 0, "hi": 1, "k": 0, "scale": 0}"#;
        assert!(native(interval, &[0.0, 1.0]) && !native(interval, &[0.0, 1.1]));
    }

    #[test]
    fn a_refusal_must_be_allowed_and_said() {
        let text = r#"{"expected": {"a": "1"}, "predicate": {"kind": "refuse_or", "hi": 17, "lo": 0,
            "predicate": {"kind": "rel", "output": "a", "k": 1, "cond": 1, "kq": 1}}}"#;
        let wanted: Wanted = serde_json::from_str(text).unwrap();
        let outputs = ["a".to_owned()];
        let said = || Some("mul saturates".to_owned());
        let lossy = |value: f64| {
            Some(Box::new(Got {
                there: true,
                values: vec![value],
                ..Got::default()
            }))
        };
        for (arithmetic, left, lossy, passed) in [
            (FIXED, said(), None, true),
            (FIXED, None, None, false),
            (JACK, said(), None, false),
            // What is lost is enough to make it wrong, or is not.
            (FIXED, said(), lossy(5.0), true),
            (FIXED, said(), lossy(1.0), false),
        ] {
            let got = Got {
                there: true,
                values: vec![5.0],
                left,
                lossy,
            };
            let judge = Judge {
                arithmetic,
                outputs: &outputs,
                got: &got,
                wanted: &wanted,
            };
            assert_eq!(judge.verdict().passed, passed);
        }
    }
}
