//! What is fragile, in words.

use super::fragile::{Found, Fragile, Weakness};
use crate::ir::graph::*;
use crate::plan::Plan;
use crate::source::Diagnostic;
use slowlight_routine::{Format, Op, scale};
use std::collections::BTreeSet;

/// What happens on less than one pixel in so many is no more than rounding does.
const RARE: usize = 200;

/// What lies close to a border on less than one pixel in so many may be an outline.
const OUTLINE: usize = 50;

/// Warnings for the weak places of a plan, the worst first; one for each place
/// in the scene.
pub fn warnings(plan: &Plan, found: &Found) -> Vec<Diagnostic> {
    let often = |f: &&Fragile| {
        let rare = match f.weakness {
            Weakness::Close => OUTLINE,
            _ => RARE,
        };
        f.pixels * rare >= found.looked || !f.rows.is_empty()
    };
    let mut worst: Vec<&Fragile> = found.fragile.iter().filter(often).collect();
    worst.sort_by_key(|f| (std::cmp::Reverse(f.pixels), f.node));
    let mut places = BTreeSet::new();
    let first = worst
        .into_iter()
        .filter(|f| places.insert((plan.graph.span(f.node), f.weakness)));
    first.map(|f| warning(plan, found, f)).collect()
}

fn warning(plan: &Plan, found: &Found, f: &Fragile) -> Diagnostic {
    let graph = &plan.graph;
    let format = plan.runtime.format;
    let share = share(f.pixels, found.looked);
    // A call of the library's stands for what that computes.
    let here = match graph.span(f.node).called() {
        Some(_) => "here, in the library's code",
        None => "here",
    };
    let (message, help) = match f.weakness {
        Weakness::Grows => (
            format!("in {format} {} {here}, on {share}", lost(plan, f)),
            way_out(graph, f.node),
        ),
        Weakness::Gradual => (
            format!(
                "in {format} an error has grown bit by bit to {} {here}, on {share}",
                units(f.units)
            ),
            "fewer turns of the loop, a shorter chain, or a finer `--format`",
        ),
        Weakness::NoMeaning => (
            format!("0/0 {here}, on {share}"),
            "it counts as 0; choose another way where both are 0",
        ),
        Weakness::Coarse => (
            format!(
                "in {format} neighbouring values are {:.2} apart {here}, on {share}: too far for whole steps",
                f.units
            ),
            "fade to the mean colour before that distance, or choose a finer `--format`",
        ),
        Weakness::Tie => (
            format!("a tie on {share}: the exact value lies on the border itself"),
            "any format may go either way; move the border or the eye a little",
        ),
        Weakness::Close => (
            format!(
                "in {format} the border is too close {here}, on {share}: the exact value lies within {} of it",
                units(f.units.ceil())
            ),
            "keep clear of the border by several `epsilon` of the largest value, or choose a finer `--format`",
        ),
    };
    let made = Diagnostic::warning(graph.span(f.node), message).help(help);
    let made = match rows(&f.rows) {
        Some(text) => made.label(text),
        None => made,
    };
    match f.flips.filter(|&id| id != f.node) {
        Some(id) => made.also(graph.span(id), turns(graph, id)),
        None => made,
    }
}

fn share(pixels: usize, of: usize) -> String {
    format!(
        "{:.1} % of the pixels looked at",
        100.0 * pixels as f64 / of.max(1) as f64
    )
}

fn rows(rows: &[u32]) -> Option<String> {
    match rows {
        [] => None,
        [one] => Some(format!("on row {one}")),
        [first, .., last] => Some(format!("on {} rows from {first} to {last}", rows.len())),
    }
}

fn units(units: f64) -> String {
    match units {
        u if u >= 1e6 => "more than a million units in the last place".to_owned(),
        u if u <= 1.0 => "a unit in the last place".to_owned(),
        u => format!("{u:.0} units in the last place"),
    }
}

/// How much of a result is lost.
fn lost(plan: &Plan, f: &Fragile) -> String {
    match plan.runtime.real {
        Format::Fixed { .. } if f.units > 1e6 => "the value leaves the range".to_owned(),
        Format::Scaled { bits } if f.units >= scale::most(bits) as f64 => {
            "the value leaves the range that it has".to_owned()
        }
        Format::Fixed { .. } | Format::Scaled { .. } => {
            format!("the result is off by up to {}", units(f.units))
        }
        real => {
            let bits = (-real.epsilon().log2()).round();
            let left = (bits - f.units.log2()).floor();
            match left >= 1.0 {
                true => format!("as few as {left} of {bits} bits are left"),
                false if real.most() < 1e9 => {
                    "the result loses all of its bits, or leaves the format's range".to_owned()
                }
                false => "the result may lose all of its bits".to_owned(),
            }
        }
    }
}

fn way_out(graph: &Graph, id: NodeId) -> &'static str {
    match graph.node(id) {
        Node::Apply(Op::Add | Op::Sub, _) => {
            "nearly equal values are subtracted: rearrange so that what cancels cancels first \
             (`(a - b) * (a + b)` for `a * a - b * b`), or use the library's shape"
        }
        Node::Apply(Op::Exp | Op::Log | Op::Pow, _) => {
            "shift the exponents by the least before, or bound them"
        }
        Node::Apply(Op::Div, _) => {
            "the divisor comes near 0: bound it, or the way that it is used for"
        }
        Node::Apply(Op::Mul, _) => "scale the factors before, so that the product stays small",
        _ => "choose a finer `--format`",
    }
}

/// What goes the other way.
fn turns(graph: &Graph, id: NodeId) -> String {
    match graph.node(id) {
        Node::Apply(Op::Floor | Op::Round | Op::Mod, _) => "this may take another step".to_owned(),
        _ => "this may go the other way".to_owned(),
    }
}
