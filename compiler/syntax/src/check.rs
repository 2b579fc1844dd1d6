//! What the grammar forbids but its rules would let pass: rules that refuse
//! these things could only say "expected an operator".

use super::tree::{Argument, BinaryOp, Expr, ExprKind, File};
use super::walk;
use crate::source::Diagnostic;

/// Reports chained comparisons and arguments out of order.
pub fn check(file: &File) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    walk::roots(file, &mut |expr| inspect(expr, &mut found));
    found
}

// Recursion is bounded: no tree is deeper than `cut::MAX_DEPTH`.
fn inspect(expr: &Expr, found: &mut Vec<Diagnostic>) {
    match &expr.kind {
        ExprKind::Binary(op, left, _) if compares(*op) => chained(expr, left, found),
        ExprKind::Call { args, .. } | ExprKind::Method { args, .. } => order(args, found),
        _ => {}
    }
    walk::children(expr, &mut |child| inspect(child, found));
}

fn compares(op: BinaryOp) -> bool {
    use BinaryOp::{Eq, Ge, Gt, Le, Lt, Ne};
    matches!(op, Eq | Ne | Lt | Le | Gt | Ge)
}

/// Comparisons group left in the rules. A left part that compares and begins
/// where the whole begins has no parentheses around it.
fn chained(whole: &Expr, left: &Expr, found: &mut Vec<Diagnostic>) {
    if let ExprKind::Binary(op, _, _) = left.kind
        && compares(op)
        && left.span.start == whole.span.start
    {
        found.push(
            Diagnostic::error(whole.span, "comparisons do not chain")
                .also(left.span, "this is already true or false")
                .help("write `a < b and b < c`; to compare truths, set one in parentheses"),
        );
    }
}

fn order(args: &[Argument], found: &mut Vec<Diagnostic>) {
    let named = args.iter().position(|a| a.name.is_some());
    let late = args.iter().rposition(|a| a.name.is_none());
    if let (Some(named), Some(late)) = (named, late)
        && named < late
        && let (Some(first), Some(argument)) = (args.get(named), args.get(late))
    {
        let place = first.name.as_ref().map_or(first.value.span, |n| n.span);
        found.push(
            Diagnostic::error(
                argument.value.span,
                "an argument without a name stands behind one with a name",
            )
            .also(place, "the first with a name")
            .help("move it in front, or name it too"),
        );
    }
}
