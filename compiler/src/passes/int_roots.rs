//! Roots of ints as they are.
//!
//! A polynomial that is stepped from column to column is an int of 32 bits, and where reals
//! have 16 its discriminant's root would be that of its upper half: near a sphere's outline
//! hardly any of that is left. Runtimes that have a root of ints take all of it
//! ([`Op::IntRoot`]).
//!
//! This changes nodes in place and comes after all passes, since these know roots of reals.

use crate::flow::graph::*;
use crate::flow::tree::*;
use crate::range::Ranges;
use slowlight_routine::Op;
use std::collections::HashMap;

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
        if let Some(left) = uses.get_mut(&real) {
            *left -= 1;
            if *left == 0 {
                unread.push(real);
            }
        }
    }
    for block in blocks(tree) {
        leave_out(block, &unread);
    }
}

/// Whether an int is there for as long as what is made of it: what a loop carries is
/// another one when its turn is over, and what a call is given in the next.
fn lasts(graph: &Graph, whole: NodeId) -> bool {
    matches!(
        graph.node(whole),
        Node::Apply(..) | Node::Ramp { .. } | Node::Stepped { .. } | Node::Select { .. }
    )
}

/// Makes a node another operation, of one operand.
fn put(graph: &mut Graph, id: NodeId, op: Op, of: NodeId) {
    let at = id.0 as usize;
    if let (Some(node), Some(ty)) = (graph.nodes.get_mut(at), graph.types.get_mut(at)) {
        *node = Node::Apply(op, [of; 2]);
        *ty = op.result();
    }
}

/// How often statements read each value.
fn uses(graph: &Graph, tree: &Tree) -> HashMap<NodeId, u32> {
    let mut uses = HashMap::new();
    let mut read = |id: NodeId| *uses.entry(id).or_insert(0) += 1;
    for block in tree.blocks() {
        walk(block, &mut |statement| match statement {
            Statement::Let(id) => graph.node(*id).operands().for_each(&mut read),
            Statement::Set {
                from: Origin::Node(from),
                ..
            } => read(*from),
            Statement::If { cond, .. } => read(*cond),
            Statement::Loop(turns) => read(turns.again),
            _ => {}
        });
    }
    graph.outputs().for_each(&mut read);
    uses
}

fn each_let(tree: &Tree, found: &mut dyn FnMut(NodeId)) {
    for block in tree.blocks() {
        walk(block, &mut |statement| {
            if let Statement::Let(id) = statement {
                found(*id);
            }
        });
    }
}

fn blocks(tree: &mut Tree) -> impl Iterator<Item = &mut Block> {
    let Tree {
        frame,
        column,
        row,
        pass,
        segment,
        pixel,
        subroutines,
    } = tree;
    [frame, column, row, pass, segment, pixel]
        .into_iter()
        .chain(subroutines.iter_mut().map(|s| &mut s.body))
}

/// Leaves out the statements that compute what nobody reads.
fn leave_out(block: &mut Block, unread: &[NodeId]) {
    block.retain(|statement| !matches!(statement, Statement::Let(id) if unread.contains(id)));
    for statement in block {
        match statement {
            Statement::If { yes, no, .. } => [yes, no]
                .into_iter()
                .for_each(|block| leave_out(block, unread)),
            Statement::Loop(Turns {
                start,
                body,
                next,
                done,
                otherwise,
                ..
            }) => [start, body, next, done, otherwise]
                .into_iter()
                .for_each(|block| leave_out(block, unread)),
            Statement::Let(_) | Statement::Set { .. } | Statement::Call(_) => {}
        }
    }
}
