//! Which values may be smaller than the format's least magnitude.
//!
//! A product is the sum of two logarithms; where both are small it lies below the least
//! one, and a test brings it back. That costs more than the product. But the square of a
//! small value is mostly added to something larger, and a sum does not mind how small its
//! summand is, as long as the distance between the two is an int. So such products are
//! left as they come where everything that reads them takes that.

use super::model::{LEAST, MOST, OCTAVE};
use crate::{Op, Range, Routine};

/// The routine of a runtime's that leaves results as small as they come, instead of one that
/// does not.
pub fn instead(routine: &Routine, all: &'static [Routine]) -> Option<&'static Routine> {
    let name = match routine.name {
        "low_mul" => "loose_mul",
        "low_div" => "loose_div",
        _ => return None,
    };
    all.iter().find(|r| r.name == name)
}

/// The greatest logarithm of a value in a range.
fn most(range: &Range) -> i32 {
    let log = range.magnitude().log2() * f64::from(OCTAVE);
    (log.ceil() as i32).clamp(LEAST, MOST)
}

/// The least logarithm of one, rounding aside: of what is loose, where 0 is in it.
fn fewest(range: &Range) -> i32 {
    let least = range.lo.max(-range.hi).max(0.0);
    let log = least.log2() * f64::from(OCTAVE);
    (log.floor() as i32).saturating_sub(1)
}

/// How small a routine's result may be if its arguments may be as small as that: routines
/// are known by their operations and names, which all runtimes share.
pub fn least(routine: &Routine, args: &[Range], lows: &[i32]) -> Option<i32> {
    let bottom = |k: usize| args.get(k).map_or(LEAST, fewest);
    let low = |k: usize| lows.get(k).map_or(LEAST, |low| bottom(k).max(*low));
    let high = |k: usize| args.get(k).map_or(MOST, most);
    let loose = (0..lows.len()).any(|k| low(k) < LEAST);
    let whole = |x: i32| i16::try_from(x).is_ok();
    let apart = whole(high(0) - low(1)) && whole(high(1) - low(0));
    let greater = low(0).max(low(1));
    match (routine.op, routine.name) {
        (_, "mul" | "div") if !loose => Some(LEAST),
        (Op::Mul, "mul" | "loose_mul") => Some(low(0) + low(1)).filter(|x| whole(*x)),
        (Op::Mul, _) => whole(low(0) + low(1)).then_some(LEAST),
        (Op::Div, "div" | "loose_div") if low(1) >= LEAST => {
            Some(low(0) - high(1)).filter(|x| whole(*x))
        }
        (Op::Div, "low_div" | "any_div") if low(1) >= LEAST => {
            whole(low(0) - high(1)).then_some(LEAST)
        }
        (Op::Add | Op::Sub, _) if !apart => None,
        // Of two that are smaller a sum is, too.
        (Op::Add | Op::Sub, "any_add" | "any_sub" | "any_sum") => {
            (greater >= LEAST).then_some(LEAST)
        }
        (Op::Add | Op::Sub, "sum" | "minus_sum" | "difference_sum" | "minus_difference_sum") => {
            Some(greater)
        }
        // What is left of a difference is held; where the signs are the same, it is a sum.
        (Op::Add | Op::Sub, _) => Some(greater.min(LEAST)),
        // 1 - a is an int.
        (Op::Sqrt, _) => (low(0) > -32767).then(|| low(0).div_euclid(2).min(LEAST)),
        // 0 is not raised to what is smaller.
        (Op::Max, "max_zero" | "zero_max") => (!loose).then_some(LEAST),
        (Op::Min | Op::Max, _) => apart.then(|| low(0).min(low(1))),
        (Op::Equal, "is_zero") => Some(LEAST),
        (Op::Less | Op::LessEqual, _) => apart.then_some(LEAST),
        (Op::Neg | Op::Abs, _) => Some(low(0)),
        _ => (!loose).then_some(LEAST),
    }
}
