//! What the picture asks of one value at one pixel, and what is asked therefore of the
//! values that an operation made it of.
//!
//! All is counted in pixels that come out otherwise: an ink that changes costs one.

use slowlight_routine::{Op, Type, Value};

/// What is asked of a value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Asked {
    /// What it costs for each unit that the value is off.
    pub gain: f64,
    /// To what magnitude it may be cut for nothing. Where that is less than the value, it
    /// may as well be larger than it is.
    pub need: f64,
    /// What it costs for each unit that it is cut below that.
    pub lost: f64,
}

/// No error costs more for a unit.
const STEEPEST: f64 = 1e9;

/// What is compared must be told from what it is compared with.
const BESIDE: f64 = 1.0 + 1.0 / 64.0;

/// No root is steeper than that of a number so small, nor does any difference from a whole
/// number count as smaller.
const SMALL: f64 = 1.0 / 256.0;

impl Asked {
    /// All of a value: each unit counts one, and more than one counts no more.
    pub fn whole(value: f64) -> Asked {
        Asked {
            gain: 1.0,
            need: value.abs(),
            lost: 1.0,
        }
    }

    /// Whether anything is asked.
    pub fn is_something(&self) -> bool {
        self.gain > 0.0 || self.need > 0.0
    }

    /// What both ask.
    pub fn both(self, other: Asked) -> Asked {
        Asked {
            gain: self.gain.max(other.gain),
            need: self.need.max(other.need),
            lost: self.lost.max(other.lost),
        }
    }

    /// Of a value, which needs no more than it has; costs cut to what can be counted.
    fn held(self, value: f64) -> Asked {
        let cost = |x: f64| if x > 0.0 { x.min(STEEPEST) } else { 0.0 };
        let size = value.abs();
        Asked {
            gain: cost(self.gain),
            need: if self.need > 0.0 {
                self.need.min(size)
            } else {
                0.0
            },
            lost: cost(self.lost),
        }
    }
}

/// What is asked of operand `k`, given what is of the result: what operands may be cut to,
/// they may be cut to at once.
pub fn of_operand(op: Op, k: usize, args: &[Value], result: Value, asked: Asked) -> Asked {
    let at = |k: usize| args.get(k).map_or(0.0, |value| value.real());
    let (own, other) = (at(k), at(1 - k.min(1)));
    let made = match op {
        // Nothing is rounded: who is asked whether it is as it is gives that on.
        _ if op.args().first() != Some(&Type::Real) => Asked {
            need: own.abs(),
            ..asked
        },
        Op::Less | Op::LessEqual | Op::Equal => compared(own, other, asked),
        Op::Sign => Asked {
            gain: asked.gain.min(1.0) / own.abs().max(1.0 / STEEPEST),
            ..Asked::default()
        },
        Op::Floor | Op::Round => {
            let border = if op == Op::Floor { own } else { own + 0.5 };
            let far = (border - border.round()).abs().max(SMALL);
            let cost = asked.gain.min(1.0);
            Asked {
                gain: cost / far,
                need: own.abs(),
                lost: cost,
            }
        }
        _ => of_real(op, k, [own, other], result.real(), asked),
    };
    made.held(own)
}

/// Of what is compared with another. The larger may be cut to the smaller, which may be cut
/// to anything.
fn compared(own: f64, other: f64, asked: Asked) -> Asked {
    let cost = asked.gain.min(1.0);
    let beyond = own * other > 0.0 && own.abs() > other.abs();
    Asked {
        gain: cost / (own - other).abs().max(1.0 / STEEPEST),
        need: if beyond { other.abs() * BESIDE } else { 0.0 },
        lost: if beyond { cost * STEEPEST } else { 0.0 },
    }
}

/// Of an operand of which a real was made.
fn of_real(op: Op, k: usize, [own, other]: [f64; 2], result: f64, asked: Asked) -> Asked {
    let Asked { gain, need, lost } = asked;
    // Whether the result is needed as it is.
    let full = need >= result.abs();
    let times = |by: f64, need: f64| Asked {
        gain: gain * by,
        need: if full { own.abs() } else { need },
        lost: lost * by,
    };
    match (op, k) {
        (Op::Add, _) => times(1.0, beside(own, other, result, need)),
        (Op::Sub, 0) => times(1.0, beside(own, -other, result, need)),
        (Op::Sub, _) => times(1.0, beside(-own, other, result, need)),
        (Op::Neg | Op::Abs, _) => asked,
        (Op::Max, _) => of_greatest(own, other, asked),
        (Op::Min, _) => of_greatest(-own, -other, asked),
        (Op::Mul, _) => times(other.abs(), factor(k, own, other, need)),
        (Op::Div, _) if own == 0.0 && k == 1 || other == 0.0 && k == 0 => Asked::default(),
        (Op::Div, 0) => times(1.0 / other.abs(), need * other.abs()),
        // Cut, it makes the quotient larger.
        (Op::Div, _) => times(result.abs() / own.abs(), 0.0),
        (Op::Sqrt, _) => times(0.5 / result.max(SMALL), need * need),
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
        need: own.abs(),
        lost: gain,
    }
}

/// To what one summand may be cut where their sum may be cut to `need`.
fn beside(own: f64, other: f64, sum: f64, need: f64) -> f64 {
    let way = sum.signum();
    match (own * way > 0.0, other * way > 0.0) {
        // One that has as much is enough, and else both are as they are.
        (true, true) => need,
        (true, false) => need + other.abs(),
        // Cut, it makes the sum larger.
        (false, _) => 0.0,
    }
}

/// To what the larger of two factors may be cut where their product may be cut to `need`.
fn factor(k: usize, own: f64, other: f64, need: f64) -> f64 {
    let larger = own.abs() > other.abs() || own.abs() == other.abs() && k == 0;
    if larger {
        need / other.abs()
    } else {
        own.abs()
    }
}

/// Of one of two, the greater of which is the result.
fn of_greatest(own: f64, other: f64, asked: Asked) -> Asked {
    let result = own.max(other);
    match own >= other {
        true => asked,
        // It has to stay below; cut, it is nearer to 0.
        false => Asked {
            gain: 0.0,
            need: if result < 0.0 { asked.need } else { 0.0 },
            lost: asked.lost,
        },
    }
}

/// Of both operands of a product or a sum of a value with itself.
pub fn of_both(op: Op, own: f64, result: f64, asked: Asked) -> Option<Asked> {
    let full = asked.need >= result.abs();
    let (by, need) = match op {
        Op::Add => (2.0, asked.need / 2.0),
        Op::Mul => (2.0 * own.abs(), asked.need.sqrt()),
        _ => return None,
    };
    let made = Asked {
        gain: asked.gain * by,
        need: if full { own.abs() } else { need },
        lost: asked.lost * by,
    };
    Some(made.held(own))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(op: Op, k: usize, args: [f64; 2], asked: Asked) -> Asked {
        let args = args.map(Value::Real);
        let args = &args[..op.arity()];
        of_operand(op, k, args, op.eval(args), asked)
    }

    fn cut(need: f64) -> Asked {
        Asked {
            gain: 0.5,
            need,
            lost: 0.25,
        }
    }

    /// What is asked of operands keeps the result at what is asked of it: each cut to its
    /// need, or to anything above, they leave the result at its need or above.
    #[test]
    fn operands_cut_to_their_needs_keep_the_result_at_its_own() {
        let values = [-1e6, -7.0, -2.5, -0.3, 0.0, 0.2, 0.9, 4.0, 33.0, 1e6];
        let ops = [
            Op::Add,
            Op::Sub,
            Op::Neg,
            Op::Abs,
            Op::Min,
            Op::Max,
            Op::Mul,
            Op::Div,
            Op::Sqrt,
        ];
        let mut tried = 0;
        for op in ops {
            for a in values {
                for b in values {
                    let result = op.eval_real(a, b).real();
                    if result.abs() > 1e300 {
                        continue;
                    }
                    for part in [0.0, 0.01, 0.7, 1.0] {
                        let need = result.abs() * part;
                        let least = [0, 1].map(|k| match k < op.arity() {
                            true => of(op, k, [a, b], cut(need)).need,
                            false => 0.0,
                        });
                        for part in [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [0.3, 0.6]] {
                            let to = |k: usize, own: f64| {
                                let to = least[k] + (own.abs() - least[k]) * part[k];
                                // No format ends at 0.
                                own.clamp(-to.max(1e-7), to.max(1e-7))
                            };
                            let now = op.eval_real(to(0, a), to(1, b)).real();
                            let enough = now * result.signum() >= need * (1.0 - 1e-9) - 1e-6;
                            assert!(enough || result == 0.0, "{op:?}({a}, {b}) to {need}: {now}");
                            tried += 1;
                        }
                    }
                }
            }
        }
        assert!(tried > 1000);
    }

    #[test]
    fn the_larger_of_two_that_are_compared_need_only_stay_so() {
        let asked = of(Op::Less, 0, [1e6, 3.0], Asked::whole(0.0));
        assert!(asked.need < 3.1 && asked.need > 3.0 && asked.gain < 1e-5);
        assert_eq!(of(Op::Less, 1, [1e6, 3.0], Asked::whole(0.0)).need, 0.0);
        assert_eq!(of(Op::Less, 0, [1e6, -3.0], Asked::whole(0.0)).need, 0.0);
        assert_eq!(of(Op::Max, 0, [-1e6, 3.0], cut(3.0)).need, 0.0);
        assert_eq!(of(Op::Max, 0, [-1e6, -3.0], cut(3.0)).need, 3.0);
        assert_eq!(of(Op::Min, 1, [0.5, 1e6], cut(0.5)).need, 0.5);
    }
}
