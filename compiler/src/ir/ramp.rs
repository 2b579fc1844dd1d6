//! Induction variables over columns, ramps: ints that are stepped from column to column
//! ([`Node::Ramp`]).
//!
//! What a ramp is at column x is its first value plus its steps over the columns
//! before x, in ints of 32 bits that wrap. With steps that are the same for the
//! whole row that is c0 + c1 x; a step that is a ramp itself gives
//! c0 + c1 x + c2 x(x-1)/2, and so on: Newton's forward differences (Knuth, The
//! Art of Computer Programming, volume 2, 4.6.4, "Tabulating polynomial values").
//! So a ramp means something at every column, whatever was drawn before; a
//! machine that draws a row from left to right needs one addition a column. Where
//! it draws every nth column in a pass, x above is the column's number in its pass.

use super::graph::*;
use slowlight_routine::Range;

/// How many ramps may step each other.
pub const DEGREE: usize = 3;

/// What a ramp's value depends on: its first value, its step's first value, and
/// so on to the step that is no ramp. Empty for what is no ramp.
pub fn coefficients(graph: &Graph, id: NodeId) -> Vec<NodeId> {
    let mut all = Vec::new();
    let mut at = id;
    while let Node::Ramp { first, step, .. } = graph.node(at)
        && step < at
    {
        all.push(first);
        if !matches!(graph.node(step), Node::Ramp { .. }) {
            all.push(step);
        }
        at = step;
    }
    all
}

/// x (x-1) .. (x-k+1) / k!: how often the coefficient number k counts at a column.
fn times(x: i32, k: usize) -> i128 {
    (0..k as i128).fold(1, |all, n| all * (i128::from(x) - n) / (n + 1))
}

/// A ramp at a column, by its number in its pass.
pub fn at(x: i32, coefficients: &[i32]) -> i32 {
    let each = coefficients.iter().enumerate();
    each.fold(0i32, |sum, (k, &c)| {
        sum.wrapping_add(c.wrapping_mul(times(x, k) as i32))
    })
}

/// How far apart the columns are from one of which to the next a ramp grows by
/// its step.
pub fn stride(graph: &Graph, id: NodeId) -> u32 {
    match graph.node(id) {
        Node::Ramp { stride, .. } => stride.max(1),
        _ => 1,
    }
}

/// Between which bounds a ramp would stay over some columns if it did not wrap.
pub fn within(columns: std::ops::RangeInclusive<i32>, coefficients: &[Range]) -> Range {
    let at = |x: i32| {
        let each = coefficients.iter().enumerate();
        each.fold((0.0, 0.0), |(lo, hi), (k, c)| {
            // Columns count from 0, so this is no negative.
            let n = times(x, k) as f64;
            (lo + c.lo * n, hi + c.hi * n)
        })
    };
    let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
    for x in columns {
        let (low, high) = at(x);
        (lo, hi) = (lo.min(low), hi.max(high));
    }
    Range::new(lo, hi)
}

/// The same for a ramp of a graph, where each node stays within `known`.
pub fn range(
    graph: &Graph,
    id: NodeId,
    columns: std::ops::RangeInclusive<i32>,
    known: impl Fn(NodeId) -> Range,
) -> Range {
    let each: Vec<Range> = coefficients(graph, id).into_iter().map(known).collect();
    let stride = stride(graph, id) as i32;
    within(columns.start() / stride..=columns.end() / stride, &each)
}

/// The ramps among some values in the order in which they are to be stepped:
/// what reads another as its step goes before it.
pub fn in_steps(graph: &Graph, among: impl IntoIterator<Item = NodeId>) -> Vec<(NodeId, NodeId)> {
    let mut found: Vec<(NodeId, NodeId)> = among
        .into_iter()
        .filter_map(|id| match graph.node(id) {
            Node::Ramp { step, .. } => Some((id, step)),
            _ => None,
        })
        .collect();
    found.sort_unstable_by(|a, b| b.cmp(a));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_what_stepping_makes() {
        let coefficients = [-7, 2_000_000_000, 12345, -3];
        let mut stepped = coefficients;
        for x in 0..2000 {
            for k in 0..coefficients.len() {
                let shown = at(x, &coefficients[k..]);
                assert_eq!(stepped[k], shown, "degree {} at {x}", 3 - k);
            }
            for k in 0..3 {
                stepped[k] = stepped[k].wrapping_add(stepped[k + 1]);
            }
        }
    }

    #[test]
    fn bounds_are_those_of_the_polynomial_where_all_is_known() {
        // (2x - 9)² = 81 - 32 x + 8 x(x-1)/2
        let known = [81.0, -32.0, 8.0].map(Range::point);
        let range = within(0..=9, &known);
        assert_eq!((range.lo, range.hi), (1.0, 81.0));
        let loose = [Range::new(-1.0, 1.0), Range::new(0.0, 2.0)];
        let range = within(0..=10, &loose);
        assert_eq!((range.lo, range.hi), (-1.0, 21.0));
    }
}
