//! How far functions are from the exact results, and what routines cost.

use super::*;

/// Operands as they occur in scenes: reals from -8 to 8, ints from -1000 to 1000.
fn typical(format: Format, random: &mut Random) -> Bits {
    let part = f64::from(random.next()) / 2f64.powi(31) - 1.0;
    match format {
        Format::Real40 => Real::nearest(8.0 * part).bits(),
        _ => model::bits((1000.0 * part) as i32),
    }
}

#[test]
fn costs_are_as_measured() {
    let mut moved = String::new();
    for routine in REALS {
        let mut bench = Bench::of(SETTING, routine, &[], 0);
        let mut random = Random(7);
        let (mut cycles, mut count) = (0, 0);
        while count < 1000 {
            let mut args: Vec<Bits> = routine
                .args
                .iter()
                .map(|f| typical(*f, &mut random))
                .collect();
            fixed(routine, &mut args, &mut random);
            if matches!(routine.op, Op::Sqrt | Op::Log | Op::Pow) {
                args[0] = Real::from_bits(args[0]).abs().bits();
            }
            if matches!(routine.op, Op::Asin | Op::Acos) {
                args[0] = Real::from_bits(args[0]).mul(Real::nearest(0.125)).bits();
            }
            if in_domain(routine, &args) {
                cycles += bench.run_bits(&args).1;
                count += 1;
            }
        }
        let mean = (cycles + count / 2) / count;
        if (mean, bench.bytes) != (u64::from(routine.cycles), routine.bytes) {
            moved += &format!("{} {mean} {}\n", routine.name, bench.bytes);
        }
    }
    for part in RUNTIME.parts.iter().filter(|p| p.name.starts_with("float")) {
        let bytes = part_bytes(&RUNTIME, part.name);
        if bytes != part.bytes {
            moved += &format!("part {} {bytes}\n", part.name);
        }
    }
    assert!(
        moved.is_empty(),
        "costs that moved (cycles, bytes):\n{moved}"
    );
}

/// The greatest error over such operands, as a power of two of what `unit` says.
fn worst(
    op: Op,
    model: fn(Real) -> Real,
    (lo, hi): (f64, f64),
    unit: fn(f64, f64) -> f64,
) -> String {
    let mut random = Random(11);
    let mut worst = 0f64;
    for _ in 0..200_000 {
        let part = f64::from(random.next()) / 2f64.powi(32);
        let x = Real::nearest(lo + (hi - lo) * part);
        let exact = op.eval(&[Value::Real(x.value())]).real();
        let off = (model(x).value() - exact).abs();
        worst = worst.max(off / unit(x.value(), exact));
    }
    format!("2^{:.1}", worst.log2())
}

#[test]
fn functions_err_as_stated() {
    let absolute = |_, _| 1.0;
    let relative = |_, exact: f64| exact.abs();
    let found = [
        worst(Op::Sin, Real::sin, (-1.5, 1.5), relative),
        worst(Op::Sin, Real::sin, (-16.0, 16.0), absolute),
        worst(Op::Cos, Real::cos, (-16.0, 16.0), absolute),
        worst(Op::Sin, Real::sin, (-2048.0, 2048.0), absolute),
        worst(Op::Tan, Real::tan, (-1.5, 1.5), relative),
        worst(Op::Asin, Real::asin, (-1.0, 1.0), absolute),
        worst(Op::Acos, Real::acos, (-1.0, 1.0), absolute),
        worst(Op::Exp, Real::exp, (-1.0, 1.0), relative),
        worst(Op::Exp, Real::exp, (-8.0, 8.0), relative),
        worst(Op::Exp, Real::exp, (-80.0, 80.0), relative),
        worst(Op::Log, Real::log, (0.0, 8.0), relative),
        worst(Op::Log, Real::log, (0.99, 1.01), relative),
        worst(Op::Log, Real::log, (0.0, 1e9), relative),
        worst(Op::Sqrt, Real::sqrt, (0.0, 8.0), relative),
    ];
    let stated = [
        "2^-29.8", "2^-29.0", "2^-29.2", "2^-22.0", "2^-28.3", "2^-28.7", "2^-28.6", "2^-29.1",
        "2^-28.6", "2^-26.5", "2^-30.0", "2^-29.7", "2^-30.9", "2^-32.0",
    ];
    assert_eq!(found, stated);
}
