//! Every routine on the processor against its model, its error bound and its costs.

#![allow(clippy::unwrap_used)]

use super::routines::{ELEVEN, TEN};
use super::{LOG10, LOG11, tables, with_whole_tables};
use crate::model;
use crate::tests::bench::{Bench, Random, Setting};
use crate::write::{Goal, Place, Use, instructions};
use slowlight_routine::log::model::Logarithm;
use slowlight_routine::{Bits, Error, Form, Format, Range, Routine, Runtime, Value};

mod figures;

type L<const FRAC: u8> = Logarithm<FRAC, true>;

const LEAST: i32 = L::<10>::LEAST;
const MOST: i32 = L::<10>::MOST;

fn runtime<const FRAC: u8>() -> &'static Runtime {
    if FRAC == 10 { &LOG10 } else { &LOG11 }
}

fn of_reals<const FRAC: u8>() -> &'static [Routine] {
    if FRAC == 10 { TEN } else { ELEVEN }
}

fn setting<const FRAC: u8>() -> Setting {
    Setting {
        runtime: runtime::<FRAC>(),
        sizes: 3,
    }
}

/// Random operands for each routine.
const PAIRS: u32 = 20_000;

/// Logarithms at which something changes.
fn edges<const FRAC: u8>() -> Vec<i32> {
    let near = [
        0, 1, 2, 255, 256, 257, 667, 1023, 1024, 1025, 1302, 1303, 2303, 2304, 2560, 2816, 5632,
        5633, 6143, 6144, 6145, 6182, 6183, 8192, 9215, 9216, 9217,
    ];
    let octaves = [2, 5, 6, 8, 9, 12, 15].map(|octaves| octaves * L::<FRAC>::OCTAVE);
    let far = [
        10182,
        11805,
        11806,
        16383,
        16384,
        25599,
        25600,
        MOST - 1,
        MOST,
    ];
    let far = octaves.iter().flat_map(|n| [n - 1, *n, n + 1]).chain(far);
    let mut all: Vec<i32> = near.into_iter().chain(far).collect();
    all.extend(all.clone().iter().map(|log| -log));
    all.push(LEAST);
    all.retain(|log| *log >= LEAST);
    all.sort_unstable();
    all.dedup();
    all
}

fn within(random: &mut Random, least: i32, most: i32) -> i32 {
    least + (random.next() % (most - least + 1) as u32) as i32
}

/// An operand of a format: a logarithm anywhere, near 1, or near another.
fn draw<const FRAC: u8>(format: Format, random: &mut Random, other: i32) -> Bits {
    let kind = random.next() % 4;
    match format {
        Format::Log { .. } => {
            let log = match kind {
                0 => within(random, LEAST, MOST),
                1 => within(random, -1024, 2048),
                2 => other + within(random, -4, 4),
                _ => other + within(random, -1024, 1024),
            };
            let plus = random.next() & 1 == 0;
            let log = log.clamp(LEAST, MOST);
            L::<FRAC> { plus, log }.bits()
        }
        _ if kind == 0 => model::bits(random.next() as i32 >> (random.next() % 20)),
        _ => model::bits(within(random, -70_000, 70_000) >> (random.next() % 12)),
    }
}

/// The operands' ranges, known exactly, and the exact result.
fn ranges<const FRAC: u8>(routine: &Routine, args: &[Bits]) -> (Vec<Range>, f64) {
    let values: Vec<Value> = (args.iter().zip(routine.args))
        .map(|(bits, format)| (runtime::<FRAC>().decode)(*bits, *format))
        .collect();
    let ranges = values.iter().map(|v| Range::point(v.real())).collect();
    (ranges, routine.op.eval(&values).real())
}

/// Whether a routine is right for such operands: those of constants for 0, which no value is,
/// and those that leave small results as they come for what fits two bytes.
fn may<const FRAC: u8>(routine: &Routine, args: &[Bits]) -> bool {
    let log = |k: usize| L::<FRAC>::from_bits(args[k]).log;
    match routine.name {
        "loose_mul" => (-32768..=MOST).contains(&(log(0) + log(1))),
        "loose_div" => log(0) - log(1) <= MOST,
        "negative" | "not_positive" | "max_zero" | "is_zero" => args[1] == L::<FRAC>::ZERO.bits(),
        "positive" | "not_negative" | "zero_max" => args[0] == L::<FRAC>::ZERO.bits(),
        _ => {
            let (ranges, exact) = ranges::<FRAC>(routine, args);
            (routine.domain)(&ranges, Range::point(exact))
        }
    }
}

/// Operands that [`may`] asks for by value.
fn fixed<const FRAC: u8>(routine: &Routine, args: &mut [Bits]) {
    match routine.name {
        "negative" | "not_positive" | "max_zero" | "is_zero" => args[1] = L::<FRAC>::ZERO.bits(),
        "positive" | "not_negative" | "zero_max" => args[0] = L::<FRAC>::ZERO.bits(),
        _ => {}
    }
}

/// Pairs of operands that a routine takes.
fn operands<const FRAC: u8>(routine: &Routine) -> Vec<Vec<Bits>> {
    let reals = || {
        let of = |log: i32| [true, false].map(|plus| L::<FRAC> { plus, log }.bits());
        edges::<FRAC>().into_iter().flat_map(of)
    };
    let ints = [
        0, 1, 5, 63, 64, 255, 256, 511, 512, 513, 1024, 32767, 32768, 65535, 65536,
    ];
    let list = |k: usize| -> Vec<Bits> {
        match routine.args.get(k) {
            None => vec![0],
            Some(Format::Log { .. }) if routine.args.len() == 1 => (LEAST..=MOST)
                .flat_map(|log| [true, false].map(|plus| L::<FRAC> { plus, log }.bits()))
                .collect(),
            Some(Format::Log { .. }) => reals().collect(),
            Some(_) => (-70_000..70_000)
                .chain(ints.into_iter().flat_map(|n| [n << 8, -n, -n << 12]))
                .chain([i32::MAX, i32::MIN])
                .map(model::bits)
                .collect(),
        }
    };
    let mut all = Vec::new();
    for &a in &list(0) {
        for &b in &list(1) {
            all.push([a, b][..routine.args.len()].to_vec());
        }
    }
    let mut random = Random(1);
    for _ in 0..PAIRS {
        let a = draw::<FRAC>(routine.args[0], &mut random, 17);
        let b = routine.args.get(1).map(|format| {
            let near = L::<FRAC>::from_bits(a).log;
            draw::<FRAC>(*format, &mut random, near)
        });
        let mut args: Vec<Bits> = [a].into_iter().chain(b).collect();
        fixed::<FRAC>(routine, &mut args);
        all.push(args);
    }
    all.retain(|args| may::<FRAC>(routine, args));
    all
}

/// The model against the operation.
fn holds<const FRAC: u8>(routine: &Routine, args: &[Bits]) {
    if routine.name.starts_with("loose") {
        return;
    }
    let most = (runtime::<FRAC>().decode)(
        L::<FRAC> {
            plus: true,
            log: MOST,
        }
        .bits(),
        L::<FRAC>::FORMAT,
    )
    .real();
    let (ranges, exact) = ranges::<FRAC>(routine, args);
    let exact = match routine.result {
        Format::Log { .. } => exact.clamp(-most, most),
        _ => exact,
    };
    let made = (runtime::<FRAC>().decode)((routine.model)(args), routine.result).real();
    // 0 is held as the least magnitude.
    let zero = routine.result == Format::Bool && args.contains(&L::<FRAC>::ZERO.bits());
    let bound = match routine.error {
        Error::Exact if routine.result == L::<FRAC>::FORMAT => 1e-9 * exact.abs(),
        error => error.most(&ranges, exact),
    };
    let off = (made - exact).abs();
    assert!(
        zero || off <= bound,
        "{}{ranges:?}: {made}, not {exact}",
        routine.name
    );
}

#[test]
fn machine_and_model_agree_bit_for_bit() {
    machine_and_model_agree_bit_for_bit_of::<10>();
    machine_and_model_agree_bit_for_bit_of::<11>();
}

fn machine_and_model_agree_bit_for_bit_of<const FRAC: u8>() {
    for routine in of_reals::<FRAC>() {
        let mut bench = Bench::of(setting::<FRAC>(), routine, &[], 0);
        let all = operands::<FRAC>(routine);
        assert!(all.len() > 20, "{} takes few operands", routine.name);
        for args in &all {
            let ints: Vec<i32> = args.iter().map(|a| *a as u32 as i32).collect();
            let expected = (routine.model)(args) as u32 as i32;
            let (found, _) = bench.run(&ints);
            assert_eq!(
                found,
                expected,
                "{}{:?} {FRAC} ({ints:x?}): machine {:?}, model {:?}",
                routine.name,
                args.iter()
                    .map(|a| L::<FRAC>::from_bits(*a))
                    .collect::<Vec<_>>(),
                L::<FRAC>::from_bits(found as Bits),
                L::<FRAC>::from_bits(expected as Bits)
            );
            holds::<FRAC>(routine, args);
        }
    }
}

/// The first operand in place of both.
#[test]
fn one_value_as_both_operands_gives_the_same() {
    one_value_as_both_operands_gives_the_same_of::<10>();
    one_value_as_both_operands_gives_the_same_of::<11>();
}

fn one_value_as_both_operands_gives_the_same_of<const FRAC: u8>() {
    let place = || Place::At("first_operand".into());
    for routine in of_reals::<FRAC>().iter().filter(|r| r.args.len() == 2) {
        let mut bench = Bench::of(setting::<FRAC>(), routine, &[place(), place()], 0);
        for log in edges::<FRAC>().into_iter().chain(-3000..3000) {
            for plus in [true, false] {
                let a = L::<FRAC> { plus, log }.bits();
                if may::<FRAC>(routine, &[a, a]) {
                    let expected = (routine.model)(&[a, a]) as i32;
                    assert_eq!(
                        bench.run(&[a as i32]).0,
                        expected,
                        "{}{FRAC} {log}",
                        routine.name
                    );
                }
            }
        }
    }
}

/// Signs that are known are neither read nor written.
#[test]
fn known_signs_give_the_same_logarithms() {
    known_signs_give_the_same_logarithms_of::<10>();
    known_signs_give_the_same_logarithms_of::<11>();
}

fn known_signs_give_the_same_logarithms_of<const FRAC: u8>() {
    let mut random = Random(5);
    for routine in of_reals::<FRAC>()
        .iter()
        .filter(|r| r.args[0] == L::<FRAC>::FORMAT)
    {
        for signs in [[true, true], [true, false], [false, true], [false, false]] {
            let names = ["first_operand", "second_operand_value"];
            let place = |k: usize| Place::Signed(names[k].into(), signs[k]);
            let places: Vec<Place> = (0..routine.args.len()).map(place).collect();
            let mut bench = bench_of(runtime::<FRAC>(), routine, &places, false);
            for _ in 0..300 {
                let mut args: Vec<Bits> = Vec::new();
                for (k, format) in routine.args.iter().enumerate() {
                    let other = args.first().map_or(17, |a| L::<FRAC>::from_bits(*a).log);
                    let log = L::<FRAC>::from_bits(draw::<FRAC>(*format, &mut random, other)).log;
                    args.push(
                        L::<FRAC> {
                            plus: signs[k],
                            log,
                        }
                        .bits(),
                    );
                }
                if !may::<FRAC>(routine, &args) {
                    continue;
                }
                // What lies where signs would is something else.
                let dirty: Vec<i32> = args
                    .iter()
                    .map(|a| (*a as i32 & 0xFFFF) | 0x55_0000)
                    .collect();
                let (found, expected) = (bench.run(&dirty).0, (routine.model)(&args) as i32);
                let mask = if routine.result == L::<FRAC>::FORMAT {
                    0xFFFF
                } else {
                    !0
                };
                assert_eq!(found & mask, expected & mask, "{} {args:x?}", routine.name);
            }
        }
    }
}

/// What is written out may be called.
#[test]
fn calls_give_the_same() {
    calls_give_the_same_of::<10>();
    calls_give_the_same_of::<11>();
}

fn calls_give_the_same_of<const FRAC: u8>() {
    sums_give_the_same_of::<FRAC>(runtime::<FRAC>(), true);
}

/// Whole tables have what the others have.
#[test]
fn whole_tables_give_the_same() {
    for calls in [true, false] {
        sums_give_the_same_of::<10>(with_whole_tables(&LOG10), calls);
        sums_give_the_same_of::<11>(with_whole_tables(&LOG11), calls);
    }
}

fn sums_give_the_same_of<const FRAC: u8>(runtime: &'static Runtime, calls: bool) {
    let names = ["first_operand", "second_operand_value"];
    let looks = |r: &&Routine| matches!(r.form, Form::Statement(text) if text.contains("look "));
    let mut random = Random(9);
    for routine in of_reals::<FRAC>().iter().filter(looks) {
        let places = names.map(|name| Place::At(name.into()));
        let mut bench = bench_of(runtime, routine, &places, calls);
        let all = operands::<FRAC>(routine);
        for _ in 0..4000 {
            let args = &all[random.next() as usize % all.len()];
            let ints: Vec<i32> = args.iter().map(|a| *a as u32 as i32).collect();
            let (found, expected) = (bench.run(&ints).0, (routine.model)(args) as i32);
            assert_eq!(
                found & 0xFFFF,
                expected & 0xFFFF,
                "{} {args:x?}",
                routine.name
            );
        }
    }
}

/// A use whose result keeps no sign.
fn bench_of(
    runtime: &'static Runtime,
    routine: &'static Routine,
    places: &[Place],
    calls: bool,
) -> Bench {
    let write = |lines: &mut Vec<String>| {
        let goal = match routine.result {
            Format::Log { .. } => Goal::Held("result", 2),
            _ => Goal::At("result"),
        };
        let used = Use {
            routine,
            args: places,
            goal: &goal,
            serial: 1,
            number: 0,
            calls,
        };
        let mut needs = routine.needs.to_vec();
        needs.extend(instructions(used, lines));
        needs
    };
    Bench::written(runtime, &write).sized(match routine.result {
        Format::Bool => 1,
        Format::Log { .. } => 3,
        _ => 4,
    })
}
