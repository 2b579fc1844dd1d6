//! Comparisons of polynomials decided by subdivision of their atoms' ranges: those that come out
//! the same at every pixel.
//!
//! An interval for each side knows nothing of what they have in common. Of the
//! nearer of a quadratic's roots, p - sqrt(n), it does not see that it is above 0
//! wherever p and p² - n are: where a ray starts outside of a sphere and looks
//! towards it, say. The difference of a comparison's sides is a polynomial, or one
//! with a root in it, whose sign is looked for in all boxes of its atoms' ranges
//! ([`super::extent`]). It is decided only where it stays further from 0 than
//! roundings can move it. Where rays may miss a sphere, it need be decided for those
//! alone that do not ([`super::halved`]).

use super::allowance;
use super::extent::{known, negative, surely};
use super::form::Forms;
use super::form::scaled;
use super::halved::Proofs;
use super::number::Number;
use super::poly::{Atom, Poly};
use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Runtime, Value};

/// How many of the format's units roundings may move a sum, as a part of the sum
/// of its terms' sizes: what a value is computed by takes fewer operations.
const UNITS: f64 = 1024.0;

/// What they move it at most, where a unit is large: as far as a hundred and more of them
/// do, and what is decided comes out as over the reals.
const MOST: f64 = 1.0 / 128.0;

/// The graph with comparisons that are decided as constants; nothing where there
/// are none, or where the format has no relative roundings.
pub fn decided(
    graph: &Graph,
    ranges: &Ranges,
    runtime: &Runtime,
    proofs: &Proofs,
) -> Option<Graph> {
    if allowance(runtime) < 1.0 {
        return None;
    }
    let forms = Forms::new(graph, ranges);
    let margin = (UNITS * runtime.real.epsilon()).min(MOST);
    let reached = graph.reached();
    let asked = graph.ids().filter(|id| reached[id.0 as usize]);
    let found: FxHashMap<NodeId, bool> = asked
        .filter_map(|id| Some((id, holds(&forms, id, margin, proofs)?)))
        .collect();
    (!found.is_empty()).then(|| {
        rebuild_old(graph, &mut |builder, _, id, span| {
            let holds = Value::Bool(*found.get(&id)?);
            Some(builder.constant(holds, span))
        })
    })
}

/// Whether a comparison holds, if it does so, or does not, at every pixel.
fn holds(forms: &Forms<'_>, id: NodeId, margin: f64, proofs: &Proofs) -> Option<bool> {
    let less = [Op::Less, Op::LessEqual, Op::IntLess, Op::IntLessEqual];
    match forms.graph.node(id) {
        Node::Apply(op, [a, b]) if less.contains(&op) && forms.pixel(id) => {
            let (a, b) = (forms.get(a)?, forms.get(b)?);
            let difference = forms.sum(b, &scaled(a, Number::whole(-1)))?;
            match difference.parts.as_slice() {
                // Roots are positive factors.
                [part] => above(forms, &part.poly, margin, proofs),
                _ => None,
            }
        }
        _ => None,
    }
}

/// Whether a polynomial with at most one root in it is always above 0; nothing
/// where it is not always above 0 or always below.
fn above(forms: &Forms<'_>, poly: &Poly, margin: f64, proofs: &Proofs) -> Option<bool> {
    let of = |atom: Atom| known(forms, atom);
    let sign = |poly: &Poly| match surely(poly, &of, margin) {
        true => Some(true),
        false => surely(&negative(poly), &of, margin).then_some(false),
    };
    let root = poly.atoms().into_iter().find_map(|atom| {
        let node = forms.other(atom).is_none().then_some(NodeId(atom))?;
        match forms.graph.node(node) {
            Node::Apply(Op::Sqrt, [of, _]) => Some((atom, of)),
            _ => None,
        }
    });
    let Some((atom, argument)) = root else {
        return sign(poly);
    };
    // p + q sqrt(n)
    let parts = poly.by(atom);
    let [p, q] = parts.as_slice() else {
        return None;
    };
    let (p_above, q) = (sign(p), q.value()?);
    if p_above == Some(q.real() > 0.0) {
        return p_above;
    }
    let n = match forms.get(argument)?.parts.as_slice() {
        [part] if part.roots.is_empty() => &part.poly,
        _ => return None,
    };
    let rest = p.mul(p)?.add(&negative(&n.scaled(q.mul(q))))?;
    if let (Some(p_above), Some(rest_above)) = (p_above, sign(&rest)) {
        return Some(rest_above == p_above);
    }
    // A root is taken there only where it has something to be taken of.
    let real = |of: NodeId| {
        forms
            .ranges
            .args
            .get(of.0 as usize)
            .is_some_and(|a| a[0].lo >= 0.0)
    };
    let p_of_less = match q.real() > 0.0 {
        true => negative(p),
        false => p.clone(),
    };
    let holds = real(NodeId(atom)) && proofs.above_where_real([&p_of_less, &rest, n], &of, margin);
    holds.then_some(q.real() < 0.0)
}
