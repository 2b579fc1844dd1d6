//! Every routine on the processor against its model, its error bound and its costs.

#![allow(clippy::unwrap_used)]

use super::REAL40 as RUNTIME;
use super::model::{BIAS, Real};
use super::routines::REALS;
use crate::model;
use crate::tests::bench::{Bench, Random, Setting, part_bytes};
use crate::write::Place;
use slowlight_routine::{Bits, Error, Format, Op, Range, Routine, Value};

mod figures;

const SETTING: Setting = Setting {
    runtime: &RUNTIME,
    sizes: 5,
};

/// Random operands for each routine; fewer where each takes thousands of cycles.
fn pairs(routine: &Routine) -> u32 {
    if routine.cycles > 3000 { 4_000 } else { 30_000 }
}

/// Reals at which something changes.
fn edges() -> Vec<Bits> {
    let mantissas = [
        1 << 31,
        (1 << 31) + 1,
        0xB504_F332,
        0xB504_F333,
        0xC90F_DAA2,
        0xFF00_0000,
        0x8000_00FF,
        u32::MAX - 1,
        u32::MAX,
    ];
    let exps = [
        1, 2, 64, 97, 110, 127, 128, 129, 130, 131, 136, 159, 160, 161, 168, 254, 255,
    ];
    let mut all = vec![0];
    for exp in exps {
        for man in mantissas {
            for negative in [false, true] {
                all.push(Real { negative, exp, man }.bits());
            }
        }
    }
    all
}

/// A random operand: of all magnitudes, near 1, or near another.
fn draw(format: Format, random: &mut Random, other: Real) -> Bits {
    let word = random.next();
    let kind = random.next() % 4;
    if format != Format::Real40 {
        return model::bits(word as i32 >> (random.next() % 32));
    }
    let spread = random.next();
    let real = Real {
        negative: random.next() & 1 == 1,
        exp: match kind {
            0 => 1 + (spread % 255) as i32,
            1 => 118 + (spread % 20) as i32,
            _ => (other.exp + (spread % 7) as i32 - 3).clamp(1, 255),
        },
        man: match random.next() % 4 {
            0 => word & 0xFFF0_0000 | 1 << 31,
            1 => other.man.wrapping_add(word % 5).wrapping_sub(2) | 1 << 31,
            _ => word | 1 << 31,
        },
    };
    real.bits()
}

/// The operands' ranges, known exactly, and the exact result.
fn ranges(routine: &Routine, args: &[Bits]) -> (Vec<Range>, f64) {
    let values: Vec<Value> = (args.iter().zip(routine.args))
        .map(|(bits, format)| (RUNTIME.decode)(*bits, *format))
        .collect();
    let ranges = values.iter().map(|v| Range::point(v.real())).collect();
    (ranges, routine.op.eval(&values).real())
}

fn in_domain(routine: &Routine, args: &[Bits]) -> bool {
    let (ranges, exact) = ranges(routine, args);
    (routine.domain)(&ranges, Range::point(exact))
}

/// Gives a routine for constants one of these.
fn fixed(routine: &Routine, args: &mut [Bits], random: &mut Random) {
    let by = (random.next() % 32) as i32;
    match routine.name {
        "negative" | "not_positive" | "max_zero" | "is_zero" => args[1] = 0,
        "positive" | "not_negative" | "zero_max" => args[0] = 0,
        "lessen" => args[1] = Real::plus(BIAS - by, 1 << 31).bits(),
        "grow" => args[1] = Real::plus(BIAS + 2 + by, 1 << 31).bits(),
        name if name.starts_with("plus") => {
            args.iter_mut()
                .for_each(|a| *a = Real::from_bits(*a).abs().bits());
        }
        _ => {}
    }
}

/// Operands that a routine takes: edges, and random ones.
fn operands(routine: &Routine) -> Vec<Vec<Bits>> {
    let ints = [0, 1, -1, 255, 256, 65535, 65536, i32::MAX, i32::MIN];
    let list = |k: usize| match routine.args.get(k) {
        None => vec![0],
        Some(Format::Real40) => edges(),
        Some(_) => ints.map(model::bits).to_vec(),
    };
    let mut random = Random(1);
    let mut all = Vec::new();
    let (first, second) = (list(0), list(1));
    // Of pairs a part where each takes long.
    let one_in = match routine.cycles {
        ..100 => 1,
        100..3000 => 5,
        _ => 41,
    };
    for (i, &a) in first.iter().enumerate() {
        for (j, &b) in second.iter().enumerate() {
            if second.len() == 1 || (i + j) % one_in == 0 {
                all.push([a, b][..routine.args.len()].to_vec());
            }
        }
    }
    for _ in 0..pairs(routine) {
        let a = draw(routine.args[0], &mut random, Real::ONE);
        let near = Real::from_bits(a);
        let b = routine
            .args
            .get(1)
            .map(|format| draw(*format, &mut random, near));
        all.push([a].into_iter().chain(b).collect());
    }
    for args in &mut all {
        fixed(routine, args, &mut random);
    }
    all.retain(|args| in_domain(routine, args));
    all
}

/// The model against the operation.
fn holds(routine: &Routine, args: &[Bits], made: Bits) {
    let most = Real::most(false).value();
    let (ranges, exact) = ranges(routine, args);
    let real = routine.result == Format::Real40;
    let exact = if real {
        exact.clamp(-most, most)
    } else {
        exact
    };
    // What is too small becomes 0, and what is made of it.
    let least = if real { 2f64.powi(-126) } else { 0.0 };
    let bound = match routine.error {
        Error::Exact => 1e-12 * exact.abs(),
        error => error.most(&ranges, exact),
    };
    let made = (RUNTIME.decode)(made, routine.result).real();
    let off = (made - exact).abs();
    assert!(
        off <= bound + least,
        "{}{ranges:?}: {made}, not {exact}",
        routine.name
    );
}

#[test]
fn machine_and_model_agree_bit_for_bit() {
    for routine in REALS {
        let mut bench = Bench::of(SETTING, routine, &[], 0);
        let all = operands(routine);
        assert!(all.len() > 200, "{} takes few operands", routine.name);
        for args in &all {
            let expected = (routine.model)(args);
            let found = bench.run_bits(args).0;
            let expected = match routine.result {
                Format::Int { .. } => Bits::from(expected as u32),
                _ => expected,
            };
            assert_eq!(
                found, expected,
                "{}{args:x?}: {found:x}, {expected:x}",
                routine.name
            );
            holds(routine, args, (routine.model)(args));
        }
    }
}

/// The first operand in place of both, and constants.
#[test]
fn one_value_as_both_operands_or_a_constant_gives_the_same() {
    let places = [
        Place::At("first_operand".into()),
        Place::At("first_operand".into()),
    ];
    let mut random = Random(3);
    for routine in REALS.iter().filter(|r| r.args.len() == 2) {
        let mut bench = Bench::of(SETTING, routine, &places, 0);
        for _ in 0..300 {
            let a = draw(Format::Real40, &mut random, Real::ONE);
            if in_domain(routine, &[a, a]) {
                let expected = (routine.model)(&[a, a]);
                assert_eq!(bench.run_bits(&[a]).0, expected, "{} {a:x}", routine.name);
            }
        }
        for args in operands(routine).iter().step_by(501).take(60) {
            let places = [Place::At("first_operand".into()), Place::Constant(args[1])];
            let found = Bench::of(SETTING, routine, &places, 0)
                .run_bits(&args[..1])
                .0;
            assert_eq!(found, (routine.model)(args), "{} {args:x?}", routine.name);
        }
    }
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
}

#[test]
fn values_are_encoded_to_the_nearest_and_back() {
    let encoded = |x| (RUNTIME.encode)(Value::Real(x), Format::Real40);
    assert_eq!(encoded(1.0), 129 << 32);
    assert_eq!(encoded(-1.0), 129 << 32 | 1 << 31);
    assert_eq!(encoded(0.0), 0);
    assert_eq!(encoded(1.0 - 2f64.powi(-40)), 129 << 32);
    assert_eq!(encoded(1e99), 0xFF_7FFF_FFFF);
    assert_eq!(encoded(-1e99), 0xFF_FFFF_FFFF);
    assert_eq!(encoded(1e-99), 0);
    for bits in edges() {
        let value = (RUNTIME.decode)(bits, Format::Real40);
        assert_eq!((RUNTIME.encode)(value, Format::Real40), bits);
    }
    assert_eq!((RUNTIME.param_bits)(-12_500, 4), encoded(-1.25));
    assert_eq!((RUNTIME.param_bits)(3, 1), encoded(0.3));
}
