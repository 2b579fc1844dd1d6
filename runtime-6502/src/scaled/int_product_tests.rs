//! Products of short ints on the processor, which are ints of 32 bits.

#![allow(clippy::unwrap_used)]

use super::kinds::SHORT;
use crate::model::{bits, int};
use crate::tests::bench::{Bench, Random, Setting};
use slowlight_routine::Range;

#[test]
fn short_ints_have_products_of_32_bits() {
    let setting = Setting {
        sizes: 4,
        ..SHORT.setting
    };
    let routine = SHORT.routine("int_mul_16");
    let mut bench = Bench::of(setting, routine, &[], 0);
    let mut all = SHORT.edges();
    all.push(-32768);
    let (mut cycles, mut checked) = (0, 0u32);
    for a in &all {
        for b in &all {
            let (found, taken) = bench.run(&[*a, *b]);
            assert_eq!(found, a * b, "{a} * {b}");
            let held = [*a, *b].map(bits);
            assert_eq!(int((routine.model)(&held)), a * b);
            (cycles, checked) = (cycles + taken, checked + 1);
        }
    }
    let mean = cycles as f64 / f64::from(checked);
    assert!(
        (mean - f64::from(routine.cycles)).abs() < 20.0,
        "{mean} cycles"
    );
}

/// Of all that is held in two bytes and not below 0, where the product is an int.
#[test]
fn short_ints_that_are_not_below_0_have_products() {
    let setting = Setting {
        sizes: 4,
        ..SHORT.setting
    };
    let routine = SHORT.routine("int_mul_plus");
    let mut bench = Bench::of(setting, routine, &[], 0);
    let mut random = Random(5);
    let mut all: Vec<i32> = SHORT.edges().into_iter().filter(|a| *a >= 0).collect();
    all.extend([32768, 40000, 65280, 65534, 65535]);
    all.extend((0..60).map(|_| (random.next() & 0xFFFF) as i32));
    let mut checked = 0u32;
    for a in &all {
        for b in &all {
            let wanted = i64::from(*a) * i64::from(*b);
            let ranges = [*a, *b].map(|x| Range::point(f64::from(x)));
            let fits = i32::try_from(wanted).is_ok();
            assert_eq!((routine.domain)(&ranges, Range::point(wanted as f64)), fits);
            if fits {
                assert_eq!(i64::from(bench.run(&[*a, *b]).0), wanted, "{a} * {b}");
                assert_eq!(i64::from(int((routine.model)(&[*a, *b].map(bits)))), wanted);
                checked += 1;
            }
        }
    }
    assert!(checked > 5000, "{checked}");
    for below in [[-1.0, 5.0], [5.0, -1.0]] {
        assert!(!(routine.domain)(
            &below.map(Range::point),
            Range::point(-5.0)
        ));
    }
}
