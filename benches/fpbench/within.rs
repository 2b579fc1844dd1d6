//! Preconditions: the ends of inputs, and whether a box of inputs may meet what is asked of them.

use super::reader::Form;
use slowlight_routine::Range;

/// A decimal number or a fraction.
pub fn number(word: &str) -> Option<f64> {
    match word.split_once('/') {
        Some((over, under)) => Some(over.parse::<f64>().ok()? / under.parse::<f64>().ok()?),
        None => word.parse().ok().filter(|v: &f64| v.is_finite()),
    }
}

/// Between which numbers an input stays, as far as its precondition says so by numbers.
pub fn ends(pre: &Form, name: &str) -> [f64; 2] {
    let parts = pre.list();
    let (mut lo, mut hi) = (f64::NEG_INFINITY, f64::INFINITY);
    let [head, args @ ..] = parts else {
        return [lo, hi];
    };
    let rising: Vec<&Form> = match head.word() {
        "<" | "<=" => args.iter().collect(),
        ">" | ">=" => args.iter().rev().collect(),
        "and" => {
            for arg in args {
                let [a, b] = ends(arg, name);
                (lo, hi) = (lo.max(a), hi.min(b));
            }
            return [lo, hi];
        }
        "let" | "let*" => return args.last().map_or([lo, hi], |body| ends(body, name)),
        _ => return [lo, hi],
    };
    let Some(at) = rising.iter().position(|f| f.word() == name) else {
        return [lo, hi];
    };
    for (k, form) in rising.iter().enumerate() {
        match number(form.word()) {
            Some(v) if k < at => lo = lo.max(v),
            Some(v) if k > at => hi = hi.min(v),
            _ => {}
        }
    }
    [lo, hi]
}

/// Whether a precondition may hold somewhere in a box; in a box of one point, whether it does.
pub fn may_hold(pre: &Form, known: &[(String, Range)]) -> bool {
    let [head, args @ ..] = pre.list() else {
        return pre.word() != "FALSE";
    };
    let below = |a: Range, b: Range, strict: bool| match strict {
        true => a.lo < b.hi,
        false => a.lo <= b.hi,
    };
    let values = || args.iter().map(|arg| range(arg, known)).collect();
    match head.word() {
        "and" => args.iter().all(|arg| may_hold(arg, known)),
        "or" => args.iter().any(|arg| may_hold(arg, known)),
        "let" | "let*" => match args {
            [bound, body] => {
                let mut inner = known.to_vec();
                for pair in bound.list() {
                    if let [name, value] = pair.list() {
                        let value = range(value, &inner);
                        inner.push((name.word().to_owned(), value));
                    }
                }
                may_hold(body, &inner)
            }
            _ => true,
        },
        sign @ ("<" | "<=") => {
            let all: Vec<Range> = values();
            all.windows(2).all(|w| below(w[0], w[1], sign == "<"))
        }
        sign @ (">" | ">=") => {
            let all: Vec<Range> = values();
            all.windows(2).all(|w| below(w[1], w[0], sign == ">"))
        }
        _ => true,
    }
}

/// What an expression of a precondition stays within; all numbers where it is none of sums
/// and products.
fn range(form: &Form, known: &[(String, Range)]) -> Range {
    if let Form::Word(word) = form {
        let found = known.iter().rev().find(|(name, _)| name == word);
        let value = || match word.as_str() {
            "PI" => Some(std::f64::consts::PI),
            _ => number(word),
        };
        return match (found, value()) {
            (Some((_, range)), _) => *range,
            (None, Some(value)) => Range::point(value),
            _ => Range::ALL,
        };
    }
    let [head, args @ ..] = form.list() else {
        return Range::ALL;
    };
    let values: Vec<Range> = args.iter().map(|arg| range(arg, known)).collect();
    match (head.word(), values.as_slice()) {
        ("-", [a]) => Range::new(-a.hi, -a.lo),
        ("+", [a, b]) => Range::new(a.lo + b.lo, a.hi + b.hi),
        ("-", [a, b]) => Range::new(a.lo - b.hi, a.hi - b.lo),
        ("*", [a, b]) => product(*a, *b),
        _ => Range::ALL,
    }
}

fn product(a: Range, b: Range) -> Range {
    let corners = [a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi];
    match corners.iter().any(|c| c.is_nan()) {
        true => Range::ALL,
        false => Range::new(
            corners.into_iter().fold(f64::INFINITY, f64::min),
            corners.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ),
    }
}
