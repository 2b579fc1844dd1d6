//! Every routine on the processor against its model, its error bound and its costs.

#![allow(clippy::unwrap_used)]

pub(crate) mod bench;
mod functions;

use bench::{Bench, Random};
use slowlight_routine::{Format, Op, Range, Routine, Value};
use std::collections::BTreeSet;

use crate::squares::{PAGES, TABLES};
use crate::{FIXED16_16 as RUNTIME, model, write::Place};

/// Random pairs of operands for each routine.
const PAIRS: u32 = 100_000;

/// Fewer where each takes thousands of cycles.
fn pairs(routine: &Routine) -> u32 {
    if routine.cycles > 5000 {
        PAIRS / 20
    } else {
        PAIRS
    }
}

/// Operands at which something changes: signs, bytes' and format's ends, powers of two.
fn edges() -> Vec<i32> {
    let mut edges = vec![
        0,
        3,
        10,
        1000,
        0x1_8000,
        0x0001_0001,
        0x7FFF_0000,
        -0x7FFF_0000,
        0x5555_5555,
    ];
    for k in 0..32 {
        let power = 1i32 << k;
        edges.extend([
            power,
            power.wrapping_sub(1),
            power.wrapping_neg(),
            power.wrapping_neg().wrapping_add(1),
        ]);
    }
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// The ranges of operands that are known exactly, and of the exact result.
fn ranges(routine: &Routine, args: &[i32]) -> (Vec<Range>, Range) {
    let values: Vec<Value> = args
        .iter()
        .zip(routine.args)
        .map(|(a, f)| (RUNTIME.decode)(model::bits(*a), *f))
        .collect();
    let result = routine.op.eval(&values).real();
    (
        values.iter().map(|v| Range::point(v.real())).collect(),
        Range::point(result),
    )
}

fn in_domain(routine: &Routine, args: &[i32]) -> bool {
    let (args, result) = ranges(routine, args);
    (routine.domain)(&args, result)
}

/// Holds the machine against the model, and the model against the operation.
fn check(bench: &mut Bench, routine: &Routine, args: &[i32]) {
    let bits: Vec<_> = args.iter().map(|a| model::bits(*a)).collect();
    let expected = (routine.model)(&bits);
    let (found, _) = bench.run(args);
    assert_eq!(
        model::bits(found),
        expected,
        "{}({args:x?}): machine, model",
        routine.name
    );
    let (_, exact) = ranges(routine, args);
    let (least, most) = match routine.result {
        Format::Fixed { .. } => (-32768.0, 32768.0 - 1.0 / 65536.0),
        _ => (f64::from(i32::MIN), f64::from(i32::MAX)),
    };
    let off =
        ((RUNTIME.decode)(expected, routine.result).real() - exact.lo.clamp(least, most)).abs();
    let bound = routine.error.most(&[], exact.lo.clamp(least, most));
    assert!(off <= bound, "{}({args:x?}) is {off} off", routine.name);
}

/// A random operand: half of them edges, of the others some bytes, and some of all magnitudes.
fn draw(format: Format, random: &mut Random, edges: &[i32]) -> i32 {
    match format {
        Format::Bool => (random.next() & 1) as i32,
        _ if random.next() & 1 == 0 => edges[random.next() as usize % edges.len()],
        _ if random.next() & 1 == 0 => (random.next() & 0xFF) as i32,
        _ => (random.next() as i32) >> (random.next() % 32),
    }
}

#[test]
fn machine_and_model_agree_bit_for_bit_on_reals() {
    agree(|routine| matches!(routine.args[0], Format::Fixed { .. }));
}

#[test]
fn machine_and_model_agree_bit_for_bit_on_ints_and_bools() {
    agree(|routine| !matches!(routine.args[0], Format::Fixed { .. }));
}

/// Runs the routines that are wanted over all edges and many random operands.
fn agree(wanted: fn(&Routine) -> bool) {
    let edges = edges();
    for routine in RUNTIME.routines.iter().filter(|r| wanted(r)) {
        let mut bench = Bench::new(routine, &[]);
        // The edges that the domain lets through, for each operand.
        let mut let_through = [BTreeSet::new(), BTreeSet::new()];
        for a in &edges {
            let others = if routine.args.len() == 1 {
                &edges[..1]
            } else {
                &edges[..]
            };
            for b in others {
                let args = &[*a, *b][..routine.args.len()];
                if routine.args[0] != Format::Bool && in_domain(routine, args) {
                    check(&mut bench, routine, args);
                    let_through[0].insert(*a);
                    let_through[1].insert(*b);
                }
            }
        }
        let mut random = Random(1);
        let mut checked = 0;
        let pairs = pairs(routine);
        for _ in 0..8 * pairs {
            // A domain that asks for constants gets them.
            let formats = routine.args.iter().zip(&let_through);
            let operands = formats.map(|(format, few)| match few.len() {
                1..10 => few
                    .iter()
                    .nth(random.next() as usize % few.len())
                    .copied()
                    .unwrap(),
                _ => draw(*format, &mut random, &edges),
            });
            let args: Vec<i32> = operands.collect();
            if in_domain(routine, &args) {
                check(&mut bench, routine, &args);
                checked += 1;
                if checked == pairs {
                    break;
                }
            }
        }
        assert!(
            checked == pairs,
            "{}: only {checked} operands are in its domain",
            routine.name
        );
    }
}

#[test]
fn constants_as_operands_give_the_same() {
    for routine in RUNTIME.routines.iter().filter(|r| r.args.len() == 2) {
        for constant in [
            0,
            1,
            2,
            4,
            16,
            128,
            -3,
            0x8000,
            0x4000,
            0x1_0000,
            0x2_0000,
            0x4_0000,
            0x1234_5678,
        ] {
            for which in [0, 1] {
                let other = 0x3_4567;
                let args = if which == 0 {
                    [constant, other]
                } else {
                    [other, constant]
                };
                if in_domain(routine, &args) {
                    let mut places = [
                        Place::At("first_operand".into()),
                        Place::At("second_operand_value".into()),
                    ];
                    places[which] = Place::Constant(model::bits(constant));
                    check(&mut Bench::new(routine, &places), routine, &args);
                }
            }
        }
    }
}

#[test]
fn one_value_as_both_operands_gives_the_same() {
    let place = || Place::At("first_operand".into());
    let (edges, mut random) = (edges(), Random(11));
    for routine in RUNTIME.routines.iter().filter(|r| r.args.len() == 2) {
        let mut bench = Bench::new(routine, &[place(), place()]);
        let drawn = (0..4000).map(|_| draw(routine.args[0], &mut random, &edges));
        for a in edges.iter().copied().chain(drawn) {
            if routine.args[0] == routine.args[1] && in_domain(routine, &[a, a]) {
                check(&mut bench, routine, &[a, a]);
            }
        }
    }
}

/// Operands as they occur in scenes: reals from -8 to 8, ints from -1000 to 1000.
fn typical(format: Format, random: &mut Random) -> i32 {
    let within = |n: i32, random: &mut Random| (random.next() % (2 * n as u32 + 1)) as i32 - n;
    match format {
        Format::Bool => (random.next() & 1) as i32,
        Format::Fixed { .. } => within(8 << 16, random),
        _ => within(1000, random),
    }
}

#[test]
fn costs_are_as_measured() {
    let specials = [0, 2, 4, 8, 16, 0x4000, 0x8000, 0x2_0000, 0x4_0000];
    let mut moved = String::new();
    for routine in RUNTIME.routines {
        let mut bench = Bench::new(routine, &[]);
        let mut random = Random(7);
        let (mut cycles, mut count) = (0, 0);
        while count < 4000 {
            let mut args: Vec<i32> = routine
                .args
                .iter()
                .map(|f| typical(*f, &mut random))
                .collect();
            if !in_domain(routine, &args) {
                let which = random.next() as usize % args.len();
                args[which] = specials[random.next() as usize % specials.len()];
            }
            if matches!(routine.op, Op::Sqrt | Op::Log | Op::Pow) {
                args[0] = args[0].abs();
            }
            if in_domain(routine, &args) {
                cycles += bench.run(&args).1;
                count += 1;
            }
        }
        let mean = (cycles + count / 2) / count;
        if (mean, bench.bytes) != (u64::from(routine.cycles), routine.bytes) {
            moved += &format!("{} {mean} {}\n", routine.name, bench.bytes);
        }
    }
    for part in RUNTIME.parts {
        let bytes = bench::part_bytes(&crate::FIXED16_16, part.name);
        if bytes != part.bytes {
            moved += &format!("part {} {bytes}\n", part.name);
        }
    }
    assert!(
        moved.is_empty(),
        "costs that moved (cycles, bytes):\n{moved}"
    );
}

#[test]
fn every_operation_has_a_total_routine() {
    for op in Op::ALL {
        let total = RUNTIME
            .routines
            .iter()
            .any(|r| r.op == *op && (r.domain)(&[Range::ALL, Range::ALL], Range::ALL));
        assert!(total, "{op:?}");
    }
    for routine in RUNTIME.routines {
        assert_eq!(routine.args.len(), routine.op.arity(), "{}", routine.name);
        for (format, ty) in routine.args.iter().zip(routine.op.args()) {
            assert_eq!(format.scalar(), *ty, "{}", routine.name);
        }
        assert_eq!(
            routine.result.scalar(),
            routine.op.result(),
            "{}",
            routine.name
        );
    }
}

#[test]
fn quarter_squares_are_exact_for_all_pairs_of_bytes() {
    let multiply = RUNTIME
        .routines
        .iter()
        .find(|r| r.name == "int_mul")
        .unwrap();
    let mut bench = Bench::new(multiply, &[]);
    for a in 0..256 {
        for b in 0..256 {
            assert_eq!(bench.run(&[a, b]).0, a * b);
        }
    }
}

/// What a program makes at its start is what another has in its file.
#[test]
fn quarter_squares_are_made_as_they_are_stored() {
    let squares = |lines: &mut Vec<String>| {
        lines.push(PAGES.to_owned());
        vec!["squares"]
    };
    let bench = Bench::written(&RUNTIME, &squares);
    assert_eq!(bench.bytes, 16);
    let part = RUNTIME.part("squares").unwrap();
    assert_eq!(bench.prepared, u64::from(part.starts));
    for (k, table) in TABLES.iter().enumerate() {
        let made = &bench.memory(0x200 + 0x200 * k)[..511];
        let stored: Vec<u8> = table.bytes().collect();
        assert_eq!(stored.len(), 512);
        assert!(made == &stored[..511], "{}", table.label);
    }
}

#[test]
fn values_are_encoded_to_the_nearest_and_back() {
    let fixed = |x| (RUNTIME.encode)(Value::Real(x), RUNTIME.real);
    assert_eq!(fixed(1.5), 0x1_8000);
    assert_eq!(fixed(-0.1), model::bits(-6554));
    assert_eq!(fixed(1e9), 0x7FFF_FFFF);
    assert_eq!(fixed(-1e9), model::bits(i32::MIN));
    assert_eq!(
        (RUNTIME.decode)(fixed(-2.25), RUNTIME.real),
        Value::Real(-2.25)
    );
    assert_eq!(
        (RUNTIME.decode)(model::bits(-7), RUNTIME.int),
        Value::Int(-7)
    );
    assert_eq!((RUNTIME.encode)(Value::Bool(true), Format::Bool), 1);
    for (scaled, expected) in [(350, 0.35), (-100, -0.1), (3000, 3.0), (1, 0.001)] {
        assert_eq!(
            (RUNTIME.param_bits)(scaled, 3),
            fixed(expected),
            "{scaled} thousandths"
        );
    }
}
