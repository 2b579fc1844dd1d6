//! Adjoint sensitivities: what the picture asks of one value at one pixel, and what is asked
//! therefore of the values that an operation made it of.
//!
//! All is counted in pixels that come out otherwise: an ink that changes costs one.
//!
//! A value may be anywhere between two bounds for nothing. What an operation is made of gets
//! bounds of its own such that the result keeps to its bounds whatever all operands do
//! between theirs. Formats end, and a value beyond the end is cut, towards 0: so of what
//! the result may move, an operand gets most in the direction in which cuts move it.

#[cfg(test)]
mod tests;

use slowlight_routine::{Op, Type};

/// What is asked of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked {
    /// What it costs for each unit that the value is off.
    pub gain: f64,
    /// Between which bounds it may be for nothing.
    pub within: Bounds,
    /// What it costs for each unit outside of them.
    pub lost: f64,
}

/// Two bounds, both of which may be reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub lo: f64,
    pub hi: f64,
}

/// What is told from another by less than such a part of it is told so by no format.
const FINEST: f64 = 65536.0;

/// No error costs more for a unit.
const STEEPEST: f64 = 1e9;

/// What is compared must be told from what it is compared with.
const BESIDE: f64 = 1.0 / 64.0;

/// No root is steeper than that of a number so small, nor does any difference from a whole
/// number count as smaller.
const SMALL: f64 = 1.0 / 256.0;

/// What an operand gets of how far a result may move in the direction in which another
/// operand is cut.
const REST: f64 = 1.0 / 8.0;

impl Bounds {
    const ALL: Bounds = Bounds::new(f64::NEG_INFINITY, f64::INFINITY);

    const fn new(lo: f64, hi: f64) -> Bounds {
        Bounds { lo, hi }
    }

    fn point(value: f64) -> Bounds {
        Bounds::new(value, value)
    }

    fn meet(self, other: Bounds) -> Bounds {
        Bounds::new(self.lo.max(other.lo), self.hi.min(other.hi))
    }

    /// Of the negative value.
    fn turned(self) -> Bounds {
        Bounds::new(-self.hi, -self.lo)
    }

    /// With the value between them, whatever roundings did; the value alone
    /// where they are no numbers.
    fn around(self, value: f64) -> Bounds {
        let lo = if self.lo <= value { self.lo } else { value };
        let hi = if self.hi >= value { self.hi } else { value };
        Bounds::new(lo, hi)
    }
}

impl Default for Asked {
    fn default() -> Asked {
        Asked {
            gain: 0.0,
            within: Bounds::ALL,
            lost: 0.0,
        }
    }
}

impl Asked {
    /// All of a value: each unit counts one, and more than one counts no more.
    pub fn whole(value: f64) -> Asked {
        whole_of(value, 1.0)
    }

    /// Whether anything is asked.
    pub fn is_something(&self) -> bool {
        self.gain > 0.0 || self.lost > 0.0 && self.within != Bounds::ALL
    }

    /// What both ask.
    pub fn both(self, other: Asked) -> Asked {
        Asked {
            gain: self.gain.max(other.gain),
            within: self.within.meet(other.within),
            lost: self.lost.max(other.lost),
        }
    }

    /// To what magnitude a value may be cut for nothing.
    pub fn need(&self, value: f64) -> f64 {
        let end = if value > 0.0 {
            self.within.lo
        } else {
            -self.within.hi
        };
        end.clamp(0.0, value.abs())
    }

    /// Of a value, which is within its bounds; costs cut to what can be counted.
    fn held(self, value: f64) -> Asked {
        let cost = |x: f64| if x > 0.0 { x.min(STEEPEST) } else { 0.0 };
        Asked {
            gain: cost(self.gain),
            within: self.within.around(value),
            lost: cost(self.lost),
        }
    }

    /// With costs for units of what the result is so many times as much of.
    fn times(self, by: f64, within: Bounds) -> Asked {
        Asked {
            gain: self.gain * by,
            within,
            lost: self.lost * by,
        }
    }
}

/// What is asked of operand `k`, given what is of the result. An operation of one operand has
/// the other at 0.
pub fn of_operand(op: Op, k: usize, args: [f64; 2], result: f64, asked: Asked) -> Asked {
    let (own, other) = match k {
        0 => (args[0], args[1]),
        _ => (args[1], args[0]),
    };
    let made = match op {
        // Nothing is rounded: who is asked whether it is as it is gives that on.
        _ if op.args().first() != Some(&Type::Real) => Asked {
            within: Bounds::point(own),
            ..asked
        },
        Op::Less | Op::LessEqual | Op::Equal => compared(own, other, asked),
        Op::Sign => compared(own, 0.0, asked),
        Op::Floor | Op::Round => {
            let border = if op == Op::Floor { own } else { own + 0.5 };
            let far = (border - border.round()).abs().max(SMALL);
            let cost = asked.gain.min(1.0);
            Asked {
                gain: cost / far,
                within: Bounds::point(own),
                lost: cost,
            }
        }
        _ => of_real(op, k, [own, other], result, asked),
    };
    made.held(own)
}

/// Of what is compared with another: on which side of it it is. What is compared with its
/// equal gets what that asks from no format, so it asks nothing: what both are by agreement
/// is cut alike, and they stay equal.
fn compared(own: f64, other: f64, asked: Asked) -> Asked {
    let apart = (own - other).abs();
    if apart * FINEST <= own.abs().max(other.abs()) {
        return Asked::default();
    }
    let cost = asked.gain.min(1.0);
    let gain = cost / apart;
    let within = match own.partial_cmp(&other) {
        Some(std::cmp::Ordering::Greater) => above(own, other),
        Some(std::cmp::Ordering::Less) => above(-own, -other).turned(),
        _ => Bounds::ALL,
    };
    Asked {
        gain,
        within,
        lost: cost * STEEPEST,
    }
}

/// Of what is compared with less. Of two of one sign the nearer to 0 stays about where it
/// is, so that the other one may be cut to it; what differs in sign still does.
fn above(own: f64, other: f64) -> Bounds {
    let apart = own - other;
    let least = if own <= 0.0 {
        own - (apart / 4.0).min(-own * BESIDE / 2.0)
    } else if other > 0.0 {
        other + (apart / 2.0).min(other * BESIDE)
    } else if other == 0.0 {
        own.min(1.0) * BESIDE
    } else if own < -other {
        own / -8.0
    } else {
        // At least as large, and the other one's bound is nearer to 0.
        other / -4.0
    };
    Bounds::new(least, f64::INFINITY)
}

/// Of an operand of which a real was made.
fn of_real(op: Op, k: usize, [own, other]: [f64; 2], result: f64, asked: Asked) -> Asked {
    let (gain, within) = (asked.gain, asked.within);
    match (op, k) {
        (Op::Add, _) => asked.times(1.0, summand(own, other, within)),
        (Op::Sub, 0) => asked.times(1.0, summand(own, -other, within)),
        (Op::Sub, _) => asked.times(1.0, summand(-own, other, within).turned()),
        (Op::Neg, _) => asked.times(1.0, within.turned()),
        (Op::Abs, _) if own < 0.0 => asked.times(1.0, magnitude(within).turned()),
        (Op::Abs, _) => asked.times(1.0, magnitude(within)),
        (Op::Max, _) => of_greatest(own, other, asked),
        (Op::Min, _) => {
            let turned = asked.times(1.0, within.turned());
            let made = of_greatest(-own, -other, turned);
            made.times(1.0, made.within.turned())
        }
        (Op::Mul, _) => asked.times(other.abs(), factor(k, own, other, within)),
        (Op::Div, _) if own == 0.0 && k == 1 || other == 0.0 && k == 0 => Asked::default(),
        (Op::Div, 0) => asked.times(1.0 / other.abs(), dividend(own, other, within)),
        (Op::Div, _) => asked.times(result.abs() / own.abs(), divisor(own, other, within)),
        (Op::Sqrt, _) => {
            let lo = match within.lo {
                lo if lo > 0.0 => lo * lo,
                _ => f64::NEG_INFINITY,
            };
            let within = Bounds::new(lo, within.hi.max(0.0) * within.hi);
            asked.times(0.5 / result.max(SMALL), within)
        }
        (Op::ReciprocalRoot, _) if own <= 0.0 => Asked::default(),
        (Op::ReciprocalRoot, _) => {
            let [lo, hi] = [within.hi, within.lo].map(|y| y.max(0.0).powi(-2));
            asked.times(0.5 * result / own, Bounds::new(lo, hi))
        }
        (Op::Mod, 1) => whole_of(own, gain * (other / own).floor().abs()),
        (Op::Mod, _) => whole_of(own, gain),
        _ => {
            let step = (own.abs() * 1e-6).max(1e-9);
            let at = |x: f64| match k {
                0 => op.eval_real(x, other).real(),
                _ => op.eval_real(other, x).real(),
            };
            let steep = ((at(own + step) - at(own - step)) / (2.0 * step)).abs();
            whole_of(own, gain * steep)
        }
    }
}

/// A value as it is.
fn whole_of(own: f64, gain: f64) -> Asked {
    Asked {
        gain,
        within: Bounds::point(own),
        lost: gain,
    }
}

/// Of what a sum that keeps to bounds is made of. What is 0 counts as of the other sign.
fn summand(own: f64, other: f64, within: Bounds) -> Bounds {
    if own < 0.0 || own == 0.0 && other > 0.0 {
        return summand(-own, -other, within.turned()).turned();
    }
    let sum = own + other;
    let (down, up) = (sum - within.lo, within.hi - sum);
    if other <= 0.0 {
        // Cut, one makes the sum smaller and the other one larger.
        let rest = if own == other { 0.5 } else { REST };
        return Bounds::new(own - down * (1.0 - rest), own + up * rest);
    }
    // One that has as much is enough, and else both are as they are.
    let lo = match within.lo {
        lo if lo <= 0.0 => lo / 2.0,
        lo => lo.min(own),
    };
    Bounds::new(lo, own + up / 2.0)
}

/// Of a value of which the magnitude keeps to bounds, and which is not below 0.
fn magnitude(within: Bounds) -> Bounds {
    match within.lo > 0.0 {
        true => within,
        false => Bounds::new(-within.hi, within.hi),
    }
}

/// How far magnitudes may go whose product or quotient keeps to bounds: by how many times
/// that may become less, and more.
fn times(result: f64, within: Bounds) -> [f64; 2] {
    let Bounds { lo, hi } = if result < 0.0 {
        within.turned()
    } else {
        within
    };
    let size = result.abs();
    if size == 0.0 {
        return [1.0, 1.0];
    }
    [(lo / size).clamp(0.0, 1.0), (hi / size).max(1.0)]
}

/// A value by so many times less or more.
fn between(own: f64, [less, more]: [f64; 2]) -> Bounds {
    match own {
        0.0 => Bounds::point(0.0),
        own if own < 0.0 => Bounds::new(own * more, own * less),
        own => Bounds::new(own * less, own * more),
    }
}

/// The power [`REST`] of what is not below 0.
fn rest(of: f64) -> f64 {
    of.sqrt().sqrt().sqrt()
}

/// The power 1 - [`REST`].
fn but_rest(of: f64) -> f64 {
    let half = of.sqrt();
    let quarter = half.sqrt();
    half * quarter * quarter.sqrt()
}

/// Of a factor of a product that keeps to bounds. The larger may be cut to a few times what
/// both may be; the smaller to half of itself.
fn factor(k: usize, own: f64, other: f64, within: Bounds) -> Bounds {
    let [less, more] = times(own * other, within);
    let larger = own.abs() > other.abs() || own.abs() == other.abs() && k == 0;
    let of_smaller = match less > 0.0 {
        true => rest(less).max(0.5),
        false => 0.0,
    };
    let less = match (larger, less > 0.0) {
        (false, _) => of_smaller,
        (true, true) => less / of_smaller,
        (true, false) => 0.0,
    };
    between(own, [less, more.sqrt()])
}

/// Of what is divided, where the quotient keeps to bounds: cut, it makes it smaller.
fn dividend(own: f64, other: f64, within: Bounds) -> Bounds {
    let [less, more] = times(own / other, within);
    between(own, [but_rest(less), rest(more)])
}

/// Of what divides: cut, it makes the quotient larger.
fn divisor(own: f64, other: f64, within: Bounds) -> Bounds {
    let [less, more] = times(other / own, within);
    between(own, [but_rest(more).recip(), rest(less).recip()])
}

/// Of one of two, the greater of which is the result.
fn of_greatest(own: f64, other: f64, asked: Asked) -> Asked {
    match own >= other {
        true => asked,
        false => Asked {
            gain: 0.0,
            within: Bounds::new(f64::NEG_INFINITY, asked.within.hi),
            ..asked
        },
    }
}

/// Of both operands of a product or a sum of a value with itself.
pub fn of_both(op: Op, own: f64, asked: Asked) -> Option<Asked> {
    let Bounds { lo, hi } = asked.within;
    let made = match op {
        Op::Add => asked.times(2.0, Bounds::new(lo / 2.0, hi / 2.0)),
        Op::Mul => {
            let sizes = magnitude(Bounds::new(lo.max(0.0).sqrt(), hi.max(0.0).sqrt()));
            let within = if own < 0.0 { sizes.turned() } else { sizes };
            asked.times(2.0 * own.abs(), within)
        }
        _ => return None,
    };
    Some(made.held(own))
}
