//! Reading at other scales, and whole parts, held against the models on the machine.
#![allow(clippy::unwrap_used)]

use super::kinds::{BYTE, Kind, LONG, SHORT};
use super::{FIXED16, Pace, Read, floor, model, read};
use crate::tests::bench::{Bench, Random};
use crate::write::{Place, Shape};
use slowlight_routine::scale::most;

/// Whether a number is known to fit, and what is spent for what.
const WAYS: [(bool, Pace); 5] = [
    (false, Pace::Usual),
    (false, Pace::Quick),
    (false, Pace::Short),
    (true, Pace::Usual),
    (true, Pace::Short),
];

#[test]
fn numbers_are_read_at_other_scales() {
    for kind in [BYTE, SHORT, LONG] {
        for bytes in 1..=kind.setting.sizes {
            reads(&kind, bytes);
        }
    }
}

/// All numbers of so many bytes.
fn reads(kind: &Kind, held: u8) {
    let (bits, bytes) = (kind.bits, kind.setting.sizes);
    let fits_in = |a: &i32| i64::from(*a).abs() <= most(8 * held);
    let edges: Vec<i32> = kind.edges().into_iter().filter(fits_in).collect();
    for by in -30..=25 {
        for (fits, pace) in WAYS {
            let held = Place::Held("first_operand".into(), Shape::whole(held));
            let write = |lines: &mut Vec<String>| {
                let what = Read {
                    from: &held,
                    by,
                    fits,
                    to: "result",
                    bytes,
                    serial: 1,
                    pace,
                };
                read(what, lines).into_iter().collect()
            };
            let mut bench = Bench::written(&FIXED16, &write);
            for a in &edges {
                let wanted = model::shifted(i64::from(*a), by, bits);
                let free = i64::from(*a) << by.max(0);
                if fits && free.abs() > most(bits) {
                    continue;
                }
                let (found, _) = bench.run(&[*a]);
                assert_eq!(kind.read(found), wanted, "{a} by {by}, {fits}");
            }
        }
    }
}

/// Ints of three and four bytes, and of two without a sign.
#[test]
fn wide_ints_are_read_at_other_scales() {
    for kind in [BYTE, SHORT, LONG] {
        reads_wide(&kind);
    }
}

fn reads_wide(kind: &Kind) {
    let (bits, own) = (kind.bits, kind.setting.sizes);
    let unsigned = Shape {
        signed: false,
        ..Shape::whole(own)
    };
    let shapes = [Shape::whole(4), Shape::whole(3), unsigned];
    for (shape, (fits, pace)) in shapes.into_iter().flat_map(|s| WAYS.map(|way| (s, way))) {
        let held = Place::Held("first_operand".into(), shape);
        // Further to the left hardly any number fits.
        for by in -20..=9.min(i32::from(bits) - 4) {
            let write = |lines: &mut Vec<String>| {
                let what = Read {
                    from: &held,
                    by,
                    fits,
                    to: "result",
                    bytes: own,
                    serial: 1,
                    pace,
                };
                read(what, lines).into_iter().collect()
            };
            let mut bench = Bench::written(&FIXED16, &write);
            let mut random = Random(7);
            let mut checked = 0;
            let drawn = (0..400).map(|k| match k {
                0..40 => (1 << (k / 2)) - 1 + k % 2,
                40..80 => -(1 << ((k - 40) / 2)) + k % 2,
                _ => random.next() as i32 >> (k % 32),
            });
            for a in drawn {
                let held = 8 * u32::from(shape.bytes);
                let has = match shape.signed {
                    true => i64::from(a) == (i64::from(a) << (64 - held)) >> (64 - held),
                    false => (0..1i64 << held).contains(&i64::from(a)),
                };
                let exact = f64::from(a) * f64::from(by).exp2();
                if !has || fits && exact.abs() > most(bits) as f64 {
                    continue;
                }
                checked += 1;
                let wanted = model::shifted(i64::from(a), by, bits);
                let (found, _) = bench.run(&[a]);
                assert_eq!(kind.read(found), wanted, "{a} by {by}, {shape:?}");
            }
            assert!(checked > 20, "{by} {shape:?}");
        }
    }
}

#[test]
fn whole_parts_are_floored() {
    for kind in [BYTE, SHORT, LONG] {
        floors(&kind);
    }
}

fn floors(kind: &Kind) {
    let (edges, of) = (kind.edges(), kind.setting.sizes);
    for n in 0..=i32::from(kind.bits) - 2 {
        for bytes in [1, 2, 4] {
            let held = Place::Held("first_operand".into(), Shape::whole(of));
            let write = |lines: &mut Vec<String>| {
                floor((&held, of), n, ("result", bytes), lines);
                Vec::new()
            };
            let mut bench = Bench::written(&FIXED16, &write);
            for a in &edges {
                let (found, _) = bench.run(&[*a]);
                let part = |n: i32| n & ((1i64 << (8 * bytes)) - 1) as i32;
                assert_eq!(part(found), part(a >> n), "{a} {n} {bytes}");
            }
        }
    }
}
