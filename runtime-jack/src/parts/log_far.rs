//! Decision trees over the distance of two summands, where one is so much smaller that
//! what it adds changes seldom: a comparison costs less room there than an entry.

use slowlight_routine::log::model::Log;
use slowlight_routine::log::tables::STEPS;
use std::fmt::Write;

/// From which distance on the class asks a tree instead of its tables.
pub(crate) const FAR: i32 = 4608;

/// Two octaves: a distance that is so much greater is met half as often, about, in the
/// picture of torus.scn.
const HALF_AS_OFTEN: f64 = 2048.0;

/// Distances between which a value is the same; the last goes on for ever.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    first: i32,
    value: i32,
}

pub(crate) fn sum() -> String {
    let about = "What a summand adds whose logarithm is d less, from 4608 on: little.";
    subroutine("farSum", about, Log::added)
}

pub(crate) fn difference() -> String {
    let about = "What it takes away.";
    subroutine("farDifference", about, Log::taken)
}

fn subroutine(name: &str, about: &str, of: fn(i32) -> i32) -> String {
    let mut leaves: Vec<Leaf> = Vec::new();
    for first in FAR..=STEPS[0] + 1 {
        let value = of(first);
        if leaves.last().is_none_or(|leaf| leaf.value != value) {
            leaves.push(Leaf { first, value });
        }
    }
    let mut text = format!("    /** {about} */\n    function int {name}(int d) {{\n");
    tree(&leaves, None, 2, &mut text);
    text.push_str("    }\n");
    text
}

/// How often a distance of at least this is met.
fn often(first: i32) -> f64 {
    (-f64::from(first) / HALF_AS_OFTEN).exp2()
}

/// Writes what answers for these leaves, of which the last ends before `end`: the
/// comparison that halves how often they are met, then each half.
fn tree(leaves: &[Leaf], end: Option<i32>, depth: usize, text: &mut String) {
    let indent = "    ".repeat(depth);
    let (Some(from), Some(last)) = (leaves.first(), leaves.last()) else {
        return;
    };
    if leaves.len() == 1 {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{indent}return {};", from.value);
        return;
    }
    let middle = (often(from.first) + end.map_or(0.0, often)) / 2.0;
    let off = |k: &usize| {
        leaves
            .get(*k)
            .map_or(f64::MAX, |l| (often(l.first) - middle).abs())
    };
    let nearest = (1..leaves.len()).min_by(|a, b| off(a).total_cmp(&off(b)));
    let (near, far) = leaves.split_at(nearest.unwrap_or(1));
    let first = far.first().map_or(last.first, |leaf| leaf.first);
    match far {
        [only] => {
            let _ = writeln!(
                text,
                "{indent}if (d > {}) {{ return {}; }}",
                first - 1,
                only.value
            );
        }
        _ => {
            let _ = writeln!(text, "{indent}if (d > {}) {{", first - 1);
            tree(far, end, depth + 1, text);
            let _ = writeln!(text, "{indent}}}");
        }
    }
    tree(near, Some(first), depth, text);
}
