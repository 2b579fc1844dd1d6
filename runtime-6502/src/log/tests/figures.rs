//! What the routines cost, and what their tables and numbers are.

use super::*;
use crate::tests::bench::part_bytes;
use slowlight_routine::log::tables::tables as words;
use slowlight_routine::{Op, Part, Source};
use slowlight_vm::mos6502::assemble;

/// Operands as they occur in scenes: magnitudes from an eighth to eight.
fn typical<const FRAC: u8>(format: Format, random: &mut Random) -> Bits {
    match format {
        Format::Log { .. } => {
            let plus = random.next() & 1 == 0;
            let log = within(random, -3072, 3072);
            L::<FRAC> { plus, log }.bits()
        }
        _ => model::bits(within(random, -1000, 1000)),
    }
}

#[test]
fn costs_are_as_measured() {
    let moved = moved_costs::<10>() + &moved_costs::<11>();
    assert!(
        moved.is_empty(),
        "costs that moved (cycles, bytes):\n{moved}"
    );
}

fn moved_costs<const FRAC: u8>() -> String {
    let mut moved = String::new();
    for routine in of_reals::<FRAC>() {
        let mut bench = Bench::of(setting::<FRAC>(), routine, &[], 0);
        let mut random = Random(7);
        let (mut cycles, mut count) = (0, 0);
        while count < 4000 {
            let mut args: Vec<Bits> = routine
                .args
                .iter()
                .map(|f| typical::<FRAC>(*f, &mut random))
                .collect();
            fixed::<FRAC>(routine, &mut args);
            if may::<FRAC>(routine, &args) {
                let ints: Vec<i32> = args.iter().map(|a| *a as u32 as i32).collect();
                cycles += bench.run(&ints).1;
                count += 1;
            }
        }
        let mean = (cycles + count / 2) / count;
        if (mean, bench.bytes) != (u64::from(routine.cycles), routine.bytes) {
            moved += &format!("{FRAC} {} {mean} {}\n", routine.name, bench.bytes);
        }
    }
    let own = |part: &&Part| part.name.starts_with("log_");
    for runtime in [runtime::<FRAC>(), with_whole_tables(runtime::<FRAC>())] {
        for part in runtime.parts.iter().filter(own) {
            let bytes = part_bytes(runtime, part.name);
            if bytes != part.bytes {
                moved += &format!("{FRAC} part {} {bytes}\n", part.name);
            }
        }
    }
    moved
}

#[test]
fn every_operation_has_a_total_routine() {
    every_operation_has_a_total_routine_of::<10>();
    every_operation_has_a_total_routine_of::<11>();
}

fn every_operation_has_a_total_routine_of<const FRAC: u8>() {
    for op in Op::ALL {
        let total = |r: &&Routine| r.op == *op && (r.domain)(&[Range::ALL, Range::ALL], Range::ALL);
        assert!(
            runtime::<FRAC>().routines.iter().any(|r| total(&r)),
            "{op:?}"
        );
    }
}

#[test]
fn bytes_beyond_the_pages_are_what_the_source_takes_them_for() {
    bytes_beyond_the_pages_are_what_the_source_takes_them_for_of::<10>();
    bytes_beyond_the_pages_are_what_the_source_takes_them_for_of::<11>();
}

fn bytes_beyond_the_pages_are_what_the_source_takes_them_for_of<const FRAC: u8>() {
    let tables = words(FRAC);
    let (_, sums, lost) = tables::pages(FRAC);
    let (sums, lost) = (sums * 256, lost * 256);
    assert!(
        tables.sums.entries[sums..]
            .iter()
            .all(|k| (0..256).contains(k))
    );
    assert!(
        tables.differences.entries[lost..]
            .iter()
            .all(|k| (1..=256).contains(k))
    );
}

/// What the source calls by name is what the model counts with.
#[test]
fn numbers_by_name_are_the_models() {
    numbers_by_name_are_the_models_of::<10>();
    numbers_by_name_are_the_models_of::<11>();
}

fn numbers_by_name_are_the_models_of<const FRAC: u8>() {
    let page = runtime::<FRAC>().part("log_page").unwrap();
    let Source::Text(page) = page.source else {
        panic!("a text");
    };
    let symbols = assemble(&format!("* = $0a00\n{page}\n nop"))
        .unwrap()
        .symbols;
    let of = L::<FRAC>::CONSTANTS;
    for (name, n) in [
        ("log_of_quarter", of.quarter),
        ("log_of_half_turn", of.half_turn),
        ("log_of_natural", of.units),
        ("log_octave", L::<FRAC>::OCTAVE / 256),
        ("log_unit_of_ten", L::<FRAC>::OCTAVE / 1024),
    ] {
        assert_eq!(symbols[name], i64::from(n as u16), "{name}");
    }
}

/// Tables of eleven bits are of `f64`: no entry hangs on its last places.
#[test]
fn no_entry_is_near_a_half() {
    let octave = f64::from(L::<11>::OCTAVE);
    let near = |x: f64| ((x - x.floor()) - 0.5).abs() < 1e-7;
    for d in 1..2 * 25_600 {
        let ratio = (-f64::from(d) / 2.0 / octave).exp2();
        assert!(!near(octave * (1.0 + ratio).log2()), "{d}");
        assert!(!near(octave * (1.0 - ratio).log2()), "{d}");
    }
    assert!((3..513).all(|n: i32| n.count_ones() == 1 || !near(octave * f64::from(n).log2())));
}

#[test]
fn params_are_ratios_of_ints() {
    params_are_ratios_of_ints_of::<10>();
    params_are_ratios_of_ints_of::<11>();
}

fn params_are_ratios_of_ints_of<const FRAC: u8>() {
    for (scaled, digits, expected) in [(350, 3, 0.35), (-15, 1, -1.5), (40_000, 0, 40_000.0)] {
        let found = (runtime::<FRAC>().decode)(
            (runtime::<FRAC>().param_bits)(scaled, digits),
            L::<FRAC>::FORMAT,
        )
        .real();
        assert!((found / expected - 1.0).abs() < 1.5e-3, "{found}");
    }
}
