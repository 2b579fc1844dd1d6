//! Selection of reciprocal square roots: one over a root becomes one operation
//! ([`Op::ReciprocalRoot`]), for runtimes that have it: a table of its own takes little longer
//! than that of roots, and a root that was rounded is not divided by.
//!
//! The root goes where nobody else reads it. This changes nodes in place and comes after all
//! passes, which know roots and quotients.

use super::in_place::{each_let, lasts, leave_out, put, read_less, uses};
use crate::ir::graph::*;
use crate::ir::tree::*;
use slowlight_routine::Op;

/// Puts such operations in the places of quotients, and leaves out the roots that only these
/// read.
pub fn reciprocal_roots(graph: &mut Graph, tree: &mut Tree) {
    let mut uses = uses(graph, tree);
    let (mut quotients, mut unread) = (Vec::new(), Vec::new());
    each_let(tree, &mut |id| {
        if let Node::Apply(Op::Div, [one, root]) = graph.node(id)
            && graph.constant(one).is_some_and(|one| one.real() == 1.0)
            && let Node::Apply(Op::Sqrt, [of, _]) = graph.node(root)
            && lasts(graph, of)
        {
            quotients.push((id, root, of));
        }
    });
    for (quotient, root, of) in quotients {
        put(graph, quotient, Op::ReciprocalRoot, of);
        read_less(&mut uses, root, &mut unread);
    }
    leave_out(tree, &unread);
}
