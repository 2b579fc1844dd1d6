//! What a plan could not do at a line, in words.

use super::{Kind, Tried};
use crate::explain::Explained;
use slowlight_compiler::report::missed::{Done, Missed};
use slowlight_compiler::source::Span;
use slowlight_routine::Range;

/// How long a piece of the source is that is repeated, at most.
const LONG: usize = 40;

/// The first half of a sentence.
pub fn could_not(found: &Explained, tried: &Tried<'_>, missed: Missed) -> String {
    let format = tried.plan.runtime.format;
    match (tried.way.kind, missed) {
        (Kind::Formats, _) if format != found.plan.runtime.format => format!(
            "not held in {format}, which is quicker than {}",
            found.plan.runtime.format
        ),
        (Kind::Bound, _) => "rays that pass by are followed all the way".to_owned(),
        (Kind::Far, _) => "rays that meet nothing near are followed on".to_owned(),
        (Kind::Turns, _) if tried.plan.graph.loops.len() < found.plan.graph.loops.len() => {
            "not unrolled".to_owned()
        }
        (_, Missed::Cheaper(done)) => {
            let [now, then] = *done;
            cheaper(found, &now, &then)
        }
        (Kind::Constant, Missed::Fewer { left_out, of }) => {
            format!("{} not worked out beforehand", operations(left_out, of))
        }
        (_, Missed::Fewer { left_out, of }) => {
            format!("{} not left out", operations(left_out, of))
        }
        (Kind::Constant, Missed::Elsewhere) => "not worked out beforehand".to_owned(),
        (_, Missed::Elsewhere) => "not arranged more cheaply".to_owned(),
    }
}

/// `1.5 of 12 operations a pixel`.
fn operations(some: f64, of: f64) -> String {
    let short = |n: f64| match n {
        n if n < 9.95 => format!("{n:.1}").trim_end_matches(".0").to_owned(),
        n => format!("{n:.0}"),
    };
    format!("{} of {} operations a pixel", short(some), short(of))
}

/// A routine that was out of the question, and for want of what.
fn cheaper(found: &Explained, now: &Done, then: &Done) -> String {
    let place = written(found, now.span);
    let what = place.map_or(String::new(), |text| format!(" in `{text}`"));
    let would = |who: &str, now: Range, then: Range| {
        format!(": {who} may be {} and would be {}", range(now), range(then))
    };
    let gap = (0..now.op.arity()).find(|&k| wider(now.args[k], then.args[k]));
    let wide = match gap {
        Some(k) => {
            let operand = match written(found, now.operands[k]) {
                Some(text) if now.operands[k] != now.span => format!("`{text}`"),
                _ => "an operand".to_owned(),
            };
            would(&operand, now.args[k], then.args[k])
        }
        None if wider(now.exact, then.exact) => would("its result", now.exact, then.exact),
        None => String::new(),
    };
    format!(
        "`{}`{what} not done by the cheaper routine ({:.0} {} a time, not {:.0}{wide})",
        now.op.name(),
        then.cycles,
        found.unit(),
        now.cycles
    )
}

/// Whether a range is wider than another by more than roundings.
fn wider(one: Range, other: Range) -> bool {
    let much = |range: Range| range.hi - range.lo;
    much(one) > 1.05 * much(other) || other.nonzero && !one.nonzero
}

fn range(range: Range) -> String {
    let short = |n: f64| match n {
        n if n == f64::INFINITY => "any size".to_owned(),
        n if n == f64::NEG_INFINITY => "any size below 0".to_owned(),
        n if n != 0.0 && !(1e-3..1e6).contains(&n.abs()) => format!("{n:.1e}"),
        n => format!("{n:.3}")
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned(),
    };
    format!("{} .. {}", short(range.lo), short(range.hi))
}

/// The scene's own text at a place, if it is short and an expression's.
fn written(found: &Explained, span: Span) -> Option<&str> {
    let file = found
        .scene
        .checked
        .sources
        .files
        .get(usize::from(span.file))?;
    let text = file
        .text
        .get(span.range())
        .filter(|_| !file.library)?
        .trim();
    let fits = !text.is_empty() && text.len() <= LONG && !text.contains(['\n', '`']);
    fits.then_some(text)
}
