//! The worst error of each operation in each format, as docs/jack.md has it:
//! `cargo test --release -p slowlight-runtime-jack worst_errors -- --ignored --nocapture`.

use super::Random;
use crate::log::LOG10;
use crate::model::Float;
use crate::{F316, F316R};
use slowlight_routine::log::model::Log;
use slowlight_routine::{Bits, Format, Op, Range, Routine, Runtime};

/// What an error is held against.
#[derive(Clone, Copy, PartialEq)]
enum Against {
    Result,
    /// The greater of the operands.
    Operand,
    /// 1: the error itself.
    One,
}
use Against::{One, Operand, Result};

/// A row: its name, what is computed of which operands, and what the facts on the
/// original's arithmetic say of it.
struct Row {
    name: &'static str,
    op: Op,
    /// Whether two operands have the same sign; unary ones are above 0 where they have.
    alike: bool,
    /// Their binary exponents.
    exponents: (i32, i32),
    against: Against,
    facts: &'static str,
}

#[rustfmt::skip]
const ROWS: &[Row] = &[
    Row { name: "product", op: Op::Mul, alike: true, exponents: (0, 0), against: Result, facts: "2^-11.08, mean 2^-13.49; with the low product 2^-12.03" },
    Row { name: "quotient", op: Op::Div, alike: true, exponents: (0, 0), against: Result, facts: "" },
    Row { name: "root", op: Op::Sqrt, alike: true, exponents: (-6, 6), against: Result, facts: "0.17 %" },
    Row { name: "sum of two above 0", op: Op::Add, alike: true, exponents: (-8, 8), against: Result, facts: "" },
    Row { name: "difference of two above 0, of the result", op: Op::Sub, alike: true, exponents: (-1, 1), against: Result, facts: "100 %; a guard bit cures it" },
    Row { name: "the same, of the larger", op: Op::Sub, alike: true, exponents: (0, 8), against: Operand, facts: "" },
    Row { name: "sine, absolute", op: Op::Sin, alike: false, exponents: (-6, 6), against: One, facts: "" },
    Row { name: "cosine, absolute", op: Op::Cos, alike: false, exponents: (-6, 6), against: One, facts: "" },
    Row { name: "tangent up to 1", op: Op::Tan, alike: false, exponents: (-6, -1), against: Result, facts: "" },
    Row { name: "arc sine", op: Op::Asin, alike: false, exponents: (-6, -1), against: Result, facts: "" },
    Row { name: "arc cosine, absolute", op: Op::Acos, alike: false, exponents: (-6, -1), against: One, facts: "" },
    Row { name: "arc tangent of two", op: Op::Atan2, alike: false, exponents: (-6, 6), against: Result, facts: "" },
    Row { name: "exponential", op: Op::Exp, alike: false, exponents: (-6, 2), against: Result, facts: "" },
    Row { name: "logarithm, absolute", op: Op::Log, alike: true, exponents: (-6, 6), against: One, facts: "" },
    Row { name: "power, exponent up to 8", op: Op::Pow, alike: true, exponents: (-2, 2), against: Result, facts: "" },
];

/// Every positive real of a format with these exponents.
fn reals(format: Format, (least, most): (i32, i32)) -> Vec<Bits> {
    match format {
        Format::Log { frac, .. } => {
            let one = 1 << frac;
            let logs = least * one..(most + 1) * one;
            logs.map(|log| Log { plus: true, log }.bits()).collect()
        }
        _ => (least..=most)
            .flat_map(|e| {
                (8192..16384).map(move |m| {
                    Float {
                        s: 0,
                        e: 127 + e,
                        m,
                    }
                    .bits()
                })
            })
            .collect(),
    }
}

fn negative(format: Format, bits: Bits) -> Bits {
    match format {
        Format::Log { .. } => {
            let Log { log, .. } = Log::from_bits(bits);
            Log { plus: false, log }.bits()
        }
        _ => Float::from_bits(bits).neg().bits(),
    }
}

/// The routine that takes any operands.
fn total(runtime: &Runtime, op: Op) -> Option<&'static Routine> {
    let any = [Range::ALL, Range::ALL];
    let mut routines = runtime.routines.iter();
    routines.find(|r| r.op == op && (r.domain)(&any, Range::ALL))
}

/// Whether a result is within the format's ends.
fn holds(format: Format, exact: f64) -> bool {
    match format {
        Format::Log { .. } => (0.5f64.powi(12)..format.most()).contains(&exact.abs()),
        _ => true,
    }
}

/// All pairs of a binade's reals, or ten million pairs of more, and those beside powers
/// of two.
fn pairs(all: &[Bits], binades: usize, mut each: impl FnMut(Bits, Bits)) {
    let many = all.len() / binades;
    let edge = |k: &usize| (k + 2) % many < 4;
    let edges = || (0..all.len()).filter(edge);
    edges().for_each(|a| edges().for_each(|b| each(all[a], all[b])));
    if binades == 1 {
        all.iter()
            .for_each(|a| all.iter().for_each(|b| each(*a, *b)));
        return;
    }
    let mut random = Random(1);
    for _ in 0..10_000_000 {
        let [a, b] = [0; 2].map(|_| all[random.below(all.len() as u64) as usize]);
        each(a, b);
    }
}

/// The worst error, and the mean.
fn errors(runtime: &Runtime, row: &Row) -> Option<(f64, f64)> {
    let routine = total(runtime, row.op)?;
    let value = |bits| (runtime.decode)(bits, runtime.real);
    let (mut worst, mut sum, mut count) = (0f64, 0f64, 0f64);
    let mut look = |args: &[Bits]| {
        let values = [value(args[0]), value(args[args.len() - 1])];
        let exact = row.op.eval(&values[..args.len()]).real();
        let made = value((routine.model)(args)).real();
        let of = match row.against {
            One => 1.0,
            Result => exact.abs(),
            Operand => values[0].real().abs().max(values[1].real().abs()),
        };
        if of > 0.0 && holds(runtime.real, exact) {
            let error = (made - exact).abs() / of;
            worst = worst.max(error);
            sum += error;
            count += 1.0;
        }
    };
    let all = reals(runtime.real, row.exponents);
    let binades = (row.exponents.1 - row.exponents.0 + 1) as usize;
    let signs: &[bool] = if row.alike { &[true] } else { &[true, false] };
    for &plus in signs {
        let signed = |bits| match plus {
            true => bits,
            false => negative(runtime.real, bits),
        };
        match routine.args.len() {
            1 => all.iter().for_each(|a| look(&[signed(*a)])),
            _ => pairs(&all, binades, |a, b| look(&[signed(a), b])),
        }
    }
    Some((worst, sum / count))
}

#[test]
#[ignore = "takes a minute; prints a table of docs/jack.md"]
fn worst_errors() {
    let formats = [&F316, &F316R, &LOG10];
    let mut table = String::from("| |");
    formats
        .iter()
        .for_each(|r| table += &format!(" {} |", r.format));
    table += " facts |\n|---|";
    formats.iter().for_each(|_| table += "---|");
    table += "---|\n";
    for row in ROWS {
        table += &format!("| {} |", row.name);
        for runtime in formats {
            table += &match errors(runtime, row) {
                None => " - |".to_owned(),
                // What f64 makes of it.
                Some((worst, _)) if worst < 1e-12 => " 0 |".to_owned(),
                Some((worst, mean)) => {
                    format!(" {worst:.1e} ({:.2}, {:.2}) |", worst.log2(), mean.log2())
                }
            };
        }
        table += &format!(" {} |\n", row.facts);
    }
    let fixed = crate::fixed::tests::worst::table();
    println!("{table}\n{fixed}");
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/jack.md");
    let page = std::fs::read_to_string(page).unwrap_or_default();
    for table in [table, fixed] {
        assert!(page.contains(&table), "docs/jack.md has another table");
    }
}
