//! The worst error of each routine in last places of its result, as docs/jack.md has it.

use super::{edges, numbers, off, own};
use crate::model::MOST;
use crate::tests::Random;
use slowlight_routine::Routine;

/// A row: its name, the routine, and the fraction bits of its result where they are
/// always the same or the most that it can have.
struct Row(&'static str, &'static str, Option<i32>);

#[rustfmt::skip]
const ROWS: &[Row] = &[
    Row("product with 15 bits more than its result", "mul", None),
    Row("square with as many", "mul", None),
    Row("product with 16 bits more", "half_mul", None),
    Row("with 17 to 31", "small_mul", None),
    Row("with 12 to 14", "wide_mul", None),
    Row("quotient", "div", None),
    Row("root of an odd number of fraction bits", "root", None),
    Row("of an even number", "double_root", None),
    Row("sine up to 4", "sin", Some(14)),
    Row("up to 32", "wide_sin", Some(14)),
    Row("cosine up to 4", "cos", Some(14)),
    Row("up to 32", "wide_cos", Some(14)),
    Row("tangent up to 1", "tan", Some(14)),
    Row("arc sine", "asin", Some(14)),
    Row("arc cosine", "acos", Some(13)),
    Row("arc tangent of two", "atan2", Some(13)),
    Row("exponential up to 4", "exp", None),
    Row("up to 32", "wide_exp", None),
    Row("logarithm", "log", Some(14)),
    Row("power, exponent up to 4", "pow", None),
    Row("up to 32", "wide_pow", None),
    Row("up to 1,024", "far_pow", None),
];

/// The worst error and the mean: of single operands all, of pairs a million, and edges.
fn errors(routine: &Routine, same: bool) -> (f64, f64) {
    let (mut worst, mut sum, mut count) = (0f64, 0f64, 0f64);
    let numbers = numbers(routine);
    let mut look = |a: i32, b: i32, n: i32| {
        if let Some(off) = off(routine, &[a, b][..routine.args.len()], n) {
            worst = worst.max(off);
            sum += off;
            count += 1.0;
        }
    };
    let mut random = Random(1);
    let mut any = || {
        let kind = random.below(4);
        let least = [1, 1, 16, 512][kind as usize];
        (random.below(65535) - MOST) / least
    };
    for &n in &numbers {
        match routine.args.len() {
            1 => (-MOST..=MOST).for_each(|a| look(a, 0, n)),
            _ if same => (-MOST..=MOST).for_each(|a| look(a, a, n)),
            _ => {
                let edges = edges();
                let all = edges
                    .iter()
                    .flat_map(|a| edges.iter().map(move |b| (*a, *b)));
                all.for_each(|(a, b)| look(a, b, n));
                (0..1_000_000 / numbers.len()).for_each(|_| look(any(), any(), n));
            }
        }
    }
    (worst, sum / count)
}

/// The table.
pub fn table() -> String {
    let mut table = String::from("| | worst, mean | absolute |\n|---|---|---|\n");
    for Row(name, of, bits) in ROWS {
        let routine = own().find(|r| r.name == *of).expect("a routine");
        let (worst, mean) = errors(routine, name.starts_with("square"));
        let absolute = bits.map(|bits| format!("{:.1e}", worst * (-f64::from(bits)).exp2()));
        let absolute = absolute.unwrap_or_default();
        table += &format!("| {name} | {worst:.2}, {mean:.2} | {absolute} |\n");
    }
    table
}
