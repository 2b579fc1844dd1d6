#![allow(clippy::unwrap_used)]
//! The models against the exact results; the Jack source is held against the models in
//! [`machine`].

mod far;
mod loose;
mod machine;

use super::{LOG10, routines::ALL};
use crate::model::int_bits;
use crate::tests::generator::Generator;
use slowlight_routine::log::LOG;
use slowlight_routine::log::model::{LEAST, Log, MOST, NEAR, OCTAVE};
use slowlight_routine::log::tables::tables;
use slowlight_routine::{Bits, Error, Format, Range, Routine, Value};

fn unit(x: f64) -> f64 {
    x * f64::from(OCTAVE)
}

#[test]
fn tables_are_right_to_what_is_stated() {
    let tables = tables(10);
    let worst = |list: &[i32], from: usize, exact: &dyn Fn(f64) -> f64| {
        let all = list.iter().enumerate().skip(from);
        all.map(|(d, &k)| (f64::from(k) - unit(exact(d as f64))).abs())
            .fold(0.0, f64::max)
    };
    let less = |d: f64| (-d / f64::from(OCTAVE)).exp2();
    let found = [
        worst(&tables.sums.entries, 0, &|d| (1.0 + less(d)).log2()),
        worst(&tables.differences.entries, 256, &|d| {
            -(1.0 - less(d)).log2()
        }),
        worst(&tables.differences.entries[..256], 1, &|d| {
            -(1.0 - less(d)).log2()
        }),
        worst(&tables.logs, 1, &f64::log2),
    ];
    assert_eq!(
        found.map(|worst| format!("{worst:.3}")),
        ["0.540", "0.591", "1.220", "0.540"]
    );
    assert_eq!(tables.sums.entries.len(), NEAR as usize);
}

/// Logarithms at every edge.
fn edges() -> Vec<i32> {
    let near = [
        0, 1, 2, 3, 255, 256, 257, 1023, 1024, 1025, 4607, 4608, 6143, 6144,
    ];
    let far = [9215, 9216, 9217, 15359, 15360, MOST - 1, MOST];
    let mut all: Vec<i32> = near.into_iter().chain(far).collect();
    all.extend(all.clone().iter().map(|log| -log));
    all.push(LEAST);
    all.sort_unstable();
    all.dedup();
    all
}

/// Whether a routine is right for such operands.
fn may(routine: &Routine, args: &[Bits]) -> bool {
    let values: Vec<Value> = (args.iter().zip(routine.args))
        .map(|(bits, format)| (LOG10.decode)(*bits, *format))
        .collect();
    let ranges: Vec<Range> = values.iter().map(|v| Range::point(v.real())).collect();
    let exact = routine.op.eval(&values);
    (routine.domain)(&ranges, Range::point(exact.real()))
}

#[test]
fn routines_keep_within_their_errors() {
    let mut generator = Generator(7);
    let mut logs = edges();
    logs.extend((0..150).map(|_| generator.next() - 16384));
    logs.extend((0..150).map(|_| generator.next() / 32 - 512));
    let reals: Vec<Bits> = [true, false]
        .into_iter()
        .flat_map(|plus| logs.iter().map(move |&log| Log { plus, log }.bits()))
        .collect();
    let every: Vec<Bits> = (LEAST..=MOST)
        .flat_map(|log| [true, false].map(|plus| Log { plus, log }.bits()))
        .collect();
    let ints: Vec<Bits> = (-40..40).map(|k| int_bits(k * k * k / 2)).collect();
    for routine in own() {
        let list = |k: usize| match routine.args.get(k) {
            None => vec![0],
            Some(Format::Log { .. }) if routine.args.len() == 1 => every.clone(),
            Some(Format::Log { .. }) => reals.clone(),
            Some(_) => ints.clone(),
        };
        let mut seen = 0;
        for &a in &list(0) {
            for &b in &list(1) {
                let args = &[a, b][..routine.args.len()];
                if !may(routine, args) {
                    continue;
                }
                seen += 1;
                holds(routine, args);
            }
        }
        // Those of constants are for ranges that hold a 0, which no value is.
        let constant = [
            "negative",
            "positive",
            "not_positive",
            "not_negative",
            "max_zero",
            "loose_mul",
            "loose_div",
            "is_zero",
            "zero_max",
        ];
        assert!(
            seen > 0 || constant.contains(&routine.name),
            "{}",
            routine.name
        );
    }
}

/// The greatest value.
fn most_held() -> f64 {
    let greatest = Log {
        plus: true,
        log: MOST,
    };
    greatest.value()
}

fn holds(routine: &Routine, args: &[Bits]) {
    let values: Vec<Value> = (args.iter().zip(routine.args))
        .map(|(bits, format)| (LOG10.decode)(*bits, *format))
        .collect();
    let ranges: Vec<Range> = values.iter().map(|v| Range::point(v.real())).collect();
    let exact = routine.op.eval(&values).real();
    let made = (LOG10.decode)((routine.model)(args), routine.result).real();
    // Beyond the ends results saturate; so do ints.
    let exact = match routine.result {
        Format::Log { .. } => exact.clamp(-most_held(), most_held()),
        Format::Int { .. } => exact.clamp(-32768.0, 32767.0),
        _ => exact,
    };
    let off = (made - exact).abs();
    let most = match routine.error {
        Error::Exact => 0.0,
        error => error.most(&ranges, exact),
    };
    assert!(
        off <= most,
        "{} {values:?}: {made}, not {exact}",
        routine.name
    );
}

fn own() -> impl Iterator<Item = &'static Routine> {
    ALL.iter()
        .filter(|r| r.args[0] == LOG || r.result == super::LOG)
}
