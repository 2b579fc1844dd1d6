//! Roots of ints of 32 bits on the processor, against their model and the operation.

#![allow(clippy::unwrap_used)]

use super::FIXED16;
use crate::model::{bits, int};
use crate::tests::bench::{Bench, Random, Setting};
use slowlight_routine::scale::most;
use slowlight_routine::{Op, Routine};

fn routine() -> &'static Routine {
    let mut all = FIXED16.routines.iter();
    all.find(|r| r.op == Op::IntRoot).unwrap()
}

/// All that is beside a power of two, and others of all magnitudes.
fn operands() -> Vec<i32> {
    let mut all = vec![i32::MIN, -1, 0, i32::MAX];
    for k in 0..31 {
        all.extend([(1 << k) - 1, 1 << k, (1 << k) + 1, 3 << k >> 1, -1 << k]);
    }
    let mut random = Random(7);
    all.extend((0..600).map(|k| (random.next() >> (k % 32)) as i32));
    all
}

#[test]
fn machine_and_model_agree_bit_for_bit() {
    let routine = routine();
    let setting = Setting {
        runtime: &FIXED16,
        sizes: 2,
    };
    let (mut cycles, mut counted) = (0, 0);
    for frac in -15..=30 {
        let mut bench = Bench::of(setting, routine, &[], frac);
        for a in operands() {
            let wanted = int((routine.model)(&[bits(a), i64::from(frac) as u64]));
            let (found, taken) = bench.run(&[a]);
            assert_eq!(found, wanted, "root of {a}, {frac}: machine, model");
            // What discriminants are like.
            if frac == 3 && a >= 1 << 16 {
                (cycles, counted) = (cycles + taken, counted + 1);
            }
        }
    }
    let mean = cycles / counted;
    println!("{mean} cycles");
    assert!(mean.abs_diff(u64::from(routine.cycles)) < 20, "{mean}");
}

/// At both ends of each pair of bits all that the table has, and what is cut below.
#[test]
fn roots_of_ints_are_within_their_bound() {
    let routine = routine();
    let end = most(super::BITS) as f64;
    let mut worst = 0.0f64;
    for shift in 0..16 {
        for upper in 0..=65535 {
            for lower in [0, 0x7FFF] {
                let a = (upper << 15 | lower) >> shift;
                for frac in [-15, -2, 0, 3, 7, 14, 30] {
                    let exact = f64::from(a).sqrt() * f64::from(frac).exp2();
                    let found = int((routine.model)(&[bits(a), i64::from(frac) as u64]));
                    worst = worst.max((f64::from(found) - exact.min(end)).abs());
                }
            }
        }
    }
    let bound = routine.error.most(&[], 1.0);
    println!("{worst} of {bound}");
    assert!(worst <= bound && worst > 0.5, "{worst} of {bound}");
}
