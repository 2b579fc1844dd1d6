//! Every routine on the processor against its model, its error bound and its costs.

#![allow(clippy::unwrap_used)]

use super::routines::{ALL, OF_REALS};
use super::{LOG10, PARTS, tables};
use crate::model;
use crate::tests::bench::{Bench, Random, Setting, part_bytes};
use crate::write::{Goal, Place, Use, instructions};
use slowlight_routine::log::LOG;
use slowlight_routine::log::model::{LEAST, Log, MOST};
use slowlight_routine::log::tables::tables as words;
use slowlight_routine::{Bits, Error, Format, Op, Range, Routine, Value};

const SETTING: Setting = Setting {
    runtime: &LOG10,
    sizes: 3,
};

/// Random operands for each routine.
const PAIRS: u32 = 20_000;

/// Logarithms at which something changes.
fn edges() -> Vec<i32> {
    let near = [
        0, 1, 2, 255, 256, 257, 667, 1023, 1024, 1025, 1302, 1303, 2303, 2304, 2560, 2816, 5632,
        5633, 6143, 6144, 6145, 6182, 6183, 8192, 9215, 9216, 9217,
    ];
    let far = [10182, 11805, 11806, 15359, 15360, MOST - 1, MOST];
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
fn draw(format: Format, random: &mut Random, other: i32) -> Bits {
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
            Log { plus, log }.bits()
        }
        _ if kind == 0 => model::bits(random.next() as i32 >> (random.next() % 20)),
        _ => model::bits(within(random, -70_000, 70_000) >> (random.next() % 12)),
    }
}

/// The operands' ranges, known exactly, and the exact result.
fn ranges(routine: &Routine, args: &[Bits]) -> (Vec<Range>, f64) {
    let values: Vec<Value> = (args.iter().zip(routine.args))
        .map(|(bits, format)| (LOG10.decode)(*bits, *format))
        .collect();
    let ranges = values.iter().map(|v| Range::point(v.real())).collect();
    (ranges, routine.op.eval(&values).real())
}

/// Whether a routine is right for such operands: those of constants for 0, which no value is,
/// and those that leave small results as they come for what fits two bytes.
fn may(routine: &Routine, args: &[Bits]) -> bool {
    let log = |k: usize| Log::from_bits(args[k]).log;
    match routine.name {
        "loose_mul" => (-32768..=MOST).contains(&(log(0) + log(1))),
        "loose_div" => log(0) - log(1) <= MOST,
        "negative" | "not_positive" | "max_zero" | "is_zero" => args[1] == Log::ZERO.bits(),
        "positive" | "not_negative" | "zero_max" => args[0] == Log::ZERO.bits(),
        _ => {
            let (ranges, exact) = ranges(routine, args);
            (routine.domain)(&ranges, Range::point(exact))
        }
    }
}

/// Operands that [`may`] asks for by value.
fn fixed(routine: &Routine, args: &mut [Bits]) {
    match routine.name {
        "negative" | "not_positive" | "max_zero" | "is_zero" => args[1] = Log::ZERO.bits(),
        "positive" | "not_negative" | "zero_max" => args[0] = Log::ZERO.bits(),
        _ => {}
    }
}

/// Pairs of operands that a routine takes.
fn operands(routine: &Routine) -> Vec<Vec<Bits>> {
    let reals = || {
        let of = |log: i32| [true, false].map(|plus| Log { plus, log }.bits());
        edges().into_iter().flat_map(of)
    };
    let ints = [
        0, 1, 5, 63, 64, 255, 256, 511, 512, 513, 1024, 32767, 32768, 65535, 65536,
    ];
    let list = |k: usize| -> Vec<Bits> {
        match routine.args.get(k) {
            None => vec![0],
            Some(Format::Log { .. }) if routine.args.len() == 1 => (LEAST..=MOST)
                .flat_map(|log| [true, false].map(|plus| Log { plus, log }.bits()))
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
        let a = draw(routine.args[0], &mut random, 17);
        let b = routine.args.get(1).map(|format| {
            let near = Log::from_bits(a).log;
            draw(*format, &mut random, near)
        });
        let mut args: Vec<Bits> = [a].into_iter().chain(b).collect();
        fixed(routine, &mut args);
        all.push(args);
    }
    all.retain(|args| may(routine, args));
    all
}

/// The model against the operation.
fn holds(routine: &Routine, args: &[Bits]) {
    if routine.name.starts_with("loose") {
        return;
    }
    let most = (LOG10.decode)(
        Log {
            plus: true,
            log: MOST,
        }
        .bits(),
        LOG,
    )
    .real();
    let (ranges, exact) = ranges(routine, args);
    let exact = match routine.result {
        Format::Log { .. } => exact.clamp(-most, most),
        _ => exact,
    };
    let made = (LOG10.decode)((routine.model)(args), routine.result).real();
    // 0 is held as the least magnitude.
    let zero = routine.result == Format::Bool && args.contains(&Log::ZERO.bits());
    let bound = match routine.error {
        Error::Exact if routine.result == LOG => 1e-9 * exact.abs(),
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
    for routine in OF_REALS {
        let mut bench = Bench::of(SETTING, routine, &[], 0);
        let all = operands(routine);
        assert!(all.len() > 20, "{} takes few operands", routine.name);
        for args in &all {
            let ints: Vec<i32> = args.iter().map(|a| *a as u32 as i32).collect();
            let expected = (routine.model)(args) as u32 as i32;
            let (found, _) = bench.run(&ints);
            assert_eq!(
                found,
                expected,
                "{}{:?} ({ints:x?}): machine {:?}, model {:?}",
                routine.name,
                args.iter().map(|a| Log::from_bits(*a)).collect::<Vec<_>>(),
                Log::from_bits(found as Bits),
                Log::from_bits(expected as Bits)
            );
            holds(routine, args);
        }
    }
}

/// The first operand in place of both.
#[test]
fn one_value_as_both_operands_gives_the_same() {
    let place = || Place::At("first_operand".into());
    for routine in OF_REALS.iter().filter(|r| r.args.len() == 2) {
        let mut bench = Bench::of(SETTING, routine, &[place(), place()], 0);
        for log in edges().into_iter().chain(-3000..3000) {
            for plus in [true, false] {
                let a = Log { plus, log }.bits();
                if may(routine, &[a, a]) {
                    let expected = (routine.model)(&[a, a]) as i32;
                    assert_eq!(bench.run(&[a as i32]).0, expected, "{} {log}", routine.name);
                }
            }
        }
    }
}

/// Signs that are known are neither read nor written.
#[test]
fn known_signs_give_the_same_logarithms() {
    let mut random = Random(5);
    for routine in OF_REALS.iter().filter(|r| r.args[0] == LOG) {
        for signs in [[true, true], [true, false], [false, true], [false, false]] {
            let names = ["first_operand", "second_operand_value"];
            let place = |k: usize| Place::Signed(names[k].into(), signs[k]);
            let places: Vec<Place> = (0..routine.args.len()).map(place).collect();
            let mut bench = bench_of(routine, &places);
            for _ in 0..300 {
                let mut args: Vec<Bits> = Vec::new();
                for (k, format) in routine.args.iter().enumerate() {
                    let other = args.first().map_or(17, |a| Log::from_bits(*a).log);
                    let log = Log::from_bits(draw(*format, &mut random, other)).log;
                    args.push(
                        Log {
                            plus: signs[k],
                            log,
                        }
                        .bits(),
                    );
                }
                if !may(routine, &args) {
                    continue;
                }
                // What lies where signs would is something else.
                let dirty: Vec<i32> = args
                    .iter()
                    .map(|a| (*a as i32 & 0xFFFF) | 0x55_0000)
                    .collect();
                let (found, expected) = (bench.run(&dirty).0, (routine.model)(&args) as i32);
                let mask = if routine.result == LOG { 0xFFFF } else { !0 };
                assert_eq!(found & mask, expected & mask, "{} {args:x?}", routine.name);
            }
        }
    }
}

/// A use whose result keeps no sign.
fn bench_of(routine: &'static Routine, places: &[Place]) -> Bench {
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
        };
        let mut needs = routine.needs.to_vec();
        needs.extend(instructions(used, lines));
        needs
    };
    Bench::written(&LOG10, &write).sized(match routine.result {
        Format::Bool => 1,
        Format::Log { .. } => 3,
        _ => 4,
    })
}

/// Operands as they occur in scenes: magnitudes from an eighth to eight.
fn typical(format: Format, random: &mut Random) -> Bits {
    match format {
        Format::Log { .. } => {
            let plus = random.next() & 1 == 0;
            let log = within(random, -3072, 3072);
            Log { plus, log }.bits()
        }
        _ => model::bits(within(random, -1000, 1000)),
    }
}

#[test]
fn costs_are_as_measured() {
    let mut moved = String::new();
    for routine in OF_REALS {
        let mut bench = Bench::of(SETTING, routine, &[], 0);
        let mut random = Random(7);
        let (mut cycles, mut count) = (0, 0);
        while count < 4000 {
            let mut args: Vec<Bits> = routine
                .args
                .iter()
                .map(|f| typical(*f, &mut random))
                .collect();
            fixed(routine, &mut args);
            if may(routine, &args) {
                let ints: Vec<i32> = args.iter().map(|a| *a as u32 as i32).collect();
                cycles += bench.run(&ints).1;
                count += 1;
            }
        }
        let mean = (cycles + count / 2) / count;
        if (mean, bench.bytes) != (u64::from(routine.cycles), routine.bytes) {
            moved += &format!("{} {mean} {}\n", routine.name, bench.bytes);
        }
    }
    for part in PARTS {
        let bytes = part_bytes(part.name);
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
        let total = |r: &&Routine| r.op == *op && (r.domain)(&[Range::ALL, Range::ALL], Range::ALL);
        assert!(ALL.iter().any(|r| total(&r)), "{op:?}");
    }
}

#[test]
fn bytes_beyond_the_pages_are_what_the_source_takes_them_for() {
    let (sums, lost) = (&words().sums, &words().differences);
    assert!(
        sums[tables::SUM_PAGES * 256..]
            .iter()
            .all(|k| (0..256).contains(k))
    );
    assert!(
        lost[tables::LOST_PAGES * 256..]
            .iter()
            .all(|k| (1..=256).contains(k))
    );
}

#[test]
fn params_are_ratios_of_ints() {
    for (scaled, digits, expected) in [(350, 3, 0.35), (-15, 1, -1.5), (40_000, 0, 40_000.0)] {
        let found = (LOG10.decode)((LOG10.param_bits)(scaled, digits), LOG).real();
        assert!((found / expected - 1.0).abs() < 1.5e-3, "{found}");
    }
}
