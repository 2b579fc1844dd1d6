//! Products in place against the model, on the processor.

#![allow(clippy::unwrap_used)]

use super::inline::{self, Inline};
use super::kinds::edges;
use super::{FIXED16, model};
use crate::tests::bench::{Bench, Random};
use crate::write::Place;
use slowlight_routine::scale::most;
use slowlight_routine::{Form, Routine};

const FIRST: &str = "first_operand";
const SECOND: &str = "second_operand_value";

fn text(name: &str) -> &'static str {
    let named = |r: &&Routine| r.name == name;
    match FIXED16.routines.iter().find(named).unwrap().form {
        Form::Statement(text) => text,
        form => panic!("{form:?}"),
    }
}

/// A product's bench: with the pointers as a product before left them, or not.
fn bench(name: &str, args: [&Place; 2], positive: [bool; 2], before: bool) -> Bench {
    let write = |lines: &mut Vec<String>| {
        let mut used = Inline {
            args,
            positive,
            kept: None,
            again: Some(1),
            to: "third",
            serial: 1,
        };
        let mut kept = None;
        if before {
            kept = inline::product(text(name), used, lines);
            assert_eq!(kept.as_deref(), Some(SECOND));
        }
        used = Inline {
            kept: kept.as_deref(),
            again: None,
            to: "result",
            serial: 2,
            ..used
        };
        inline::product(text(name), used, lines);
        vec!["product"]
    };
    Bench::written(&FIXED16, &write)
}

fn pairs(positive: [bool; 2]) -> Vec<[i32; 2]> {
    let edges = edges();
    let mut random = Random(3);
    let mut all: Vec<[i32; 2]> = edges
        .iter()
        .flat_map(|a| edges.iter().map(|b| [*a, *b]))
        .collect();
    all.extend((0..2000).map(|_| [0; 2].map(|_: i32| (random.next() as i32 >> 16).max(-32767))));
    for pair in &mut all {
        for (value, positive) in pair.iter_mut().zip(positive) {
            *value = if positive { value.abs() } else { *value };
        }
    }
    all
}

/// Every product that can be written in place, with signs known and unknown, with constants,
/// and with pointers that are there already.
#[test]
fn products_in_place_have_the_models_bits() {
    let all = [
        ("mul", 16, false),
        ("double_mul", 15, false),
        ("mul_14", 14, false),
        ("mul_13", 13, false),
        ("mul_12", 12, false),
        ("any_mul_14", 14, true),
        ("any_mul_13", 13, true),
        ("any_mul_12", 12, true),
    ];
    let places = [FIRST, SECOND].map(|name| Place::At(name.into()));
    for (name, n, saturates) in all {
        let check = |bench: &mut Bench, [a, b]: [i32; 2]| {
            let wanted = model::multiply(a, b, n);
            let exact = f64::from(a) * f64::from(b) * f64::from(-n).exp2();
            if saturates || exact.abs() < most(16) as f64 - 1.0 {
                let found = bench.run(&[a, b]).0 as i16;
                assert_eq!(i32::from(found), wanted, "{name} {a} {b}");
            }
        };
        for positive in [[false; 2], [true, false], [false, true], [true; 2]] {
            for before in [false, true] {
                let mut bench = bench(name, [&places[0], &places[1]], positive, before);
                pairs(positive)
                    .into_iter()
                    .for_each(|pair| check(&mut bench, pair));
            }
        }
        for constant in [1, 255, 256, 12345, 32767, -1, -255, -12800, -32767] {
            let held = Place::Constant(i64::from(constant) as u64);
            let mut second = bench(name, [&places[0], &held], [false; 2], false);
            let mut first = bench(name, [&held, &places[1]], [false; 2], false);
            for [a, _] in pairs([false; 2]).into_iter().step_by(7) {
                check(&mut second, [a, constant]);
                check(&mut first, [constant, a]);
            }
        }
    }
}

/// What a step by a known number leaves, byte by byte.
#[test]
fn known_steps_are_added() {
    let edges = edges();
    for by in [
        1,
        2,
        80,
        255,
        256,
        12800,
        65536,
        117_888,
        1 << 24,
        -1,
        -80,
        -256,
        -12800,
        -70000,
    ] {
        for bytes in 1..=4u8 {
            let write = |lines: &mut Vec<String>| {
                crate::write::copy_bytes(&Place::At(FIRST.into()), "result", 4, lines);
                let by = i64::from(by) as u64;
                crate::write::add_constant("result", bytes, by, 1, lines);
                Vec::new()
            };
            let mut bench = Bench::written(&FIXED16, &write);
            for a in edges
                .iter()
                .flat_map(|a| [*a, a << 8, a << 16, a ^ -1 << 15])
            {
                let kept = if bytes == 4 { 0 } else { -1i32 << (8 * bytes) };
                let wanted = (a & kept) | (a.wrapping_add(by) & !kept);
                assert_eq!(bench.run(&[a]).0, wanted, "{a} + {by} in {bytes} bytes");
            }
        }
    }
}

/// Squares, and powers of two over numbers that are not below 0.
#[test]
fn squares_and_reciprocals_in_place_have_the_models_bits() {
    let place = Place::At(FIRST.into());
    for (name, n) in [
        ("mul", 16),
        ("double_mul", 15),
        ("any_mul_14", 14),
        ("any_mul_12", 12),
    ] {
        for positive in [false, true] {
            let write = |lines: &mut Vec<String>| {
                let used = Inline {
                    args: [&place, &place],
                    positive: [positive; 2],
                    kept: None,
                    again: None,
                    to: "result",
                    serial: 1,
                };
                inline::square(text(name), used, lines);
                vec!["product"]
            };
            let mut bench = Bench::written(&FIXED16, &write);
            for a in (-32767..=32767).step_by(3) {
                let a: i32 = if positive { i32::abs(a) } else { a };
                let found = bench.run(&[a]).0 as i16;
                assert_eq!(i32::from(found), model::squared(a, n), "{name} {a}");
            }
        }
    }
    for (one, n) in [(16384, 14), (16384, 0), (1, 20), (4096, 7), (1, 30), (1, 0)] {
        let one_place = Place::Constant(one);
        let write = |lines: &mut Vec<String>| {
            let bits = crate::write::shift_of_one(Some(&one_place), n, 16);
            inline::one_over(&place, bits, "result", 1, lines);
            vec!["reciprocal"]
        };
        let mut bench = Bench::written(&FIXED16, &write);
        for b in 0..=32767 {
            let found = bench.run(&[b]).0 as i16;
            let wanted = model::divide(one as i32, b, n);
            assert_eq!(i32::from(found), wanted, "{one} / {b}, {n}");
        }
    }
}
