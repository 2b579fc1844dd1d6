//! One over roots on the processor, against their model and the operation.

#![allow(clippy::unwrap_used)]

use super::{FIXED12, byte, model};
use crate::model::{bits, int};
use crate::tests::bench::{Bench, Setting};
use slowlight_routine::scale::most;
use slowlight_routine::{Op, Routine};

/// The routines of 16 bits and of 8, for even numbers and for odd.
fn routines() -> Vec<&'static Routine> {
    let all = FIXED12.routines.iter();
    all.filter(|r| r.op == Op::ReciprocalRoot).collect()
}

/// All operands, wherever the table's last place is the result's, one is cut, and most are.
#[test]
fn machine_and_model_agree_bit_for_bit() {
    let all = routines();
    assert_eq!(all.len(), 4);
    for (k, routine) in all.into_iter().enumerate() {
        let odd = k as i32 & 1;
        let setting = Setting {
            runtime: &FIXED12,
            sizes: if k < 2 { 2 } else { 1 },
        };
        for n in [28, 40, 12, 24].map(|n| n + odd) {
            let mut bench = Bench::of(setting, routine, &[], n);
            let operands = (-32767..=0).step_by(777).chain(0..=32767);
            let (mut cycles, mut counted) = (0, 0);
            for a in operands {
                let wanted = int((routine.model)(&[bits(a), i64::from(n) as u64]));
                let (found, taken) = bench.run(&[a]);
                assert_eq!(found, wanted, "{}({a}), {n}", routine.name);
                // One of two bits in front is set, as where a scale is well chosen.
                if a >= 1 << 13 {
                    (cycles, counted) = (cycles + taken, counted + 1);
                }
            }
            // Where one or two bits of the result are cut, as there.
            if n == odd + if k < 2 { 40 } else { 24 } {
                let mean = cycles / counted;
                println!("{}: {mean} cycles", routine.name);
                assert!(mean.abs_diff(u64::from(routine.cycles)) < 8, "{mean}");
            }
        }
    }
}

/// All operands at all scales that a plan may have.
#[test]
fn they_are_within_their_bounds() {
    for (name, bits) in [("reciprocal_root", 16), ("byte_reciprocal_root", 8)] {
        let routine = routines().into_iter().find(|r| r.name == name).unwrap();
        let of = |a, n| match bits {
            8 => byte::reciprocal_root(a, n),
            _ => model::reciprocal_root(a, n),
        };
        let bound = routine.error.most(&[], 1.0);
        let end = most(bits) as f64;
        let mut worst = 0.0f64;
        for n in -45..=90 {
            for a in 1..=32767 {
                let exact = (f64::from(n) / 2.0).exp2() / f64::from(a).sqrt();
                worst = worst.max((f64::from(of(a, n)) - exact.min(end)).abs());
            }
            assert_eq!((of(0, n), of(-5, n)), (end as i32, end as i32));
        }
        println!("{name}: {worst} of {bound}");
        assert!(worst <= bound && worst > 0.4, "{worst} of {bound}");
    }
}
