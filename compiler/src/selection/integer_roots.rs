//! Selection of integer square roots: roots of ints as they are.
//!
//! A polynomial that is stepped from column to column is an int of 32 bits, and where reals
//! have 16 its discriminant's root would be that of its upper half: near a sphere's outline
//! hardly any of that is left. Runtimes that have a root of ints take all of it
//! ([`Op::IntRoot`]).
//!
//! This changes nodes in place and comes after all passes, since these know roots of reals.

use super::in_place::{each_let, lasts, leave_out, put, read_less, uses};
use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::ir::tree::*;
use slowlight_routine::Op;

/// Takes the roots of ints that may be larger than `most`, and leaves out the reals that
/// only these read.
pub fn int_roots(graph: &mut Graph, tree: &mut Tree, ranges: &Ranges, most: f64) {
    let mut uses = uses(graph, tree);
    let mut roots = Vec::new();
    each_let(tree, &mut |id| {
        if let Node::Apply(Op::Sqrt, [of, _]) = graph.node(id) {
            roots.push((id, of));
        }
    });
    let large = |whole: NodeId| {
        let range = ranges.result.get(whole.0 as usize);
        range.is_some_and(|range| range.magnitude() > most)
    };
    let mut unread = Vec::new();
    for (root, of) in roots {
        let negative = match graph.node(of) {
            // What others read stays a real.
            Node::Apply(Op::Neg, [real, _]) if uses.get(&of) == Some(&1) => Some(real),
            _ => None,
        };
        let real = negative.unwrap_or(of);
        let Node::Apply(Op::ToReal, [whole, _]) = graph.node(real) else {
            continue;
        };
        if !lasts(graph, whole) || !large(whole) {
            continue;
        }
        let radicand = match negative {
            Some(_) => {
                put(graph, of, Op::IntNeg, whole);
                of
            }
            None => whole,
        };
        put(graph, root, Op::IntRoot, radicand);
        read_less(&mut uses, real, &mut unread);
    }
    leave_out(tree, &unread);
}
