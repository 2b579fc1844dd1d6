//! Powers of e and logarithms over all that they are made for, evenly by their exponents: what
//! they state lets their errors grow with the argument, and with the result.

use super::*;

/// How far a routine's model is off at an argument, in parts of what it states.
fn part(name: &str, x: f64) -> f64 {
    let routine = RUNTIME.routines.iter().find(|r| r.name == name).unwrap();
    let bits = (RUNTIME.encode)(Value::Real(x), REAL);
    let x = value(bits, REAL);
    let exact = routine.op.eval(&[x]).real();
    let off = (value((routine.model)(&[bits]), REAL).real() - exact).abs();
    match routine.error.most(&[Range::point(x.real())], exact) {
        0.0 => off / f64::MIN_POSITIVE,
        most => off / most,
    }
}

/// Numbers evenly over 0 to 1, none of them met by a coarser step.
fn fractions(count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(|k| (f64::from(k) * 0.618_033_988_749_895).fract())
}

#[test]
fn powers_of_e_err_as_stated_and_not_far_less() {
    let worst = |from: f64, to: f64| {
        let each = fractions(50_000).map(|f| part("exp", from + (to - from) * f));
        each.fold(0.0, f64::max)
    };
    for whole in 0..80 {
        for sign in [1.0, -1.0] {
            let near = f64::from(whole) * sign;
            let found = worst(near, near + sign);
            assert!((0.2..=1.0).contains(&found), "about {near}: {found}");
        }
    }
}

#[test]
fn logarithms_err_as_stated() {
    for exponent in -120..120 {
        for f in fractions(20_000) {
            let x = 2f64.powi(exponent) * (1.0 + f);
            let found = part("ln", x);
            assert!(found <= 1.0, "{x}: {found}");
        }
    }
    // About 1, where the logarithm is about 0.
    for exponent in 0..30 {
        for f in fractions(5_000) {
            let x = 1.0 + (2.0 * f - 1.0) * 2f64.powi(-exponent - 1);
            let found = part("ln", x);
            assert!(found <= 1.0, "{x}: {found}");
        }
    }
}
