//! The routines of `f316r`: what rounds, and all that it shares with `f316`.

use super::{ANY_SINE, ARC, Do, INTS, REST, SHARED, SINE, UNKNOWN};
use crate::model::{Float as Real, Rounded, Sums};
use slowlight_routine::{Error, Format, Op, Routine, everywhere, joined};

const R: Format = Format::Float316 { rounded: true };

/// Half a unit in the last place of a mantissa of 8192.
const HALF: Error = Error::Relative(6.103_515_625e-5);

#[rustfmt::skip]
const ROUNDING: &[Routine] = &[
    routine!("add" Add(R, R) -> R, Do("{r}.add({0}, {1})"), ["Float.add"], everywhere, HALF, |a, b| Rounded::add(a, b), 100, 50),
    routine!("sub" Sub(R, R) -> R, Do("{r}.sub({0}, {1})"), ["Float.sub"], everywhere, HALF, |a, b| Rounded::sub(a, b), 102, 50),
    routine!("mul" Mul(R, R) -> R, Do("{r}.product({0}, {1})"), ["Float.product"], everywhere, HALF, |a, b| a.product(b), 109, 50),
    routine!("div" Div(R, R) -> R, Do("{r}.ratio({0}, {1})"), ["Float.ratio"], everywhere, HALF, |a, b| a.ratio(b), 115, 50),
    routine!("sqrt" Sqrt(R) -> R, Do("{r}.sqrt({0})"), ["Float.sqrt"], everywhere, HALF, |a| Rounded::sqrt(a), 102, 43),
];

const FUNCTIONS: &[Routine] = made_of_sums!(Rounded: rest 255, sin 831, cos 1099, tan 2059, asin 549 within 3.1e-4, acos 585, atan2 827, log 933);

/// The routines of rounded Floats, and those of ints.
pub(crate) static ALL: [Routine; REALS.len() + INTS.len()] = joined(&REALS, INTS);

const REALS: [Routine; SHARED.len() + OWN.len()] = joined(&shared(), &OWN);
const OWN: [Routine; ROUNDING.len() + FUNCTIONS.len()] = joined(ROUNDING, FUNCTIONS);

/// What is shared, of this format: its Floats are the same.
const fn shared() -> [Routine; SHARED.len()] {
    let mut all = [SHARED[0]; SHARED.len()];
    let mut k = 0;
    while k < SHARED.len() {
        all[k] = Routine {
            args: match SHARED[k].args {
                [Format::Float316 { .. }, Format::Float316 { .. }] => &[R, R],
                [Format::Float316 { .. }] => &[R],
                others => others,
            },
            result: match SHARED[k].result {
                Format::Float316 { .. } => R,
                other => other,
            },
            ..SHARED[k]
        };
        k += 1;
    }
    all
}
