//! Peephole substitution in a scheduled graph: statements stay where they are, and some are left
//! out.

use crate::ir::graph::*;
use crate::ir::tree::*;
use rustc_hash::FxHashMap;
use slowlight_routine::Op;

/// Whether a value is there for as long as what is made of it: what a loop carries is
/// another one when its turn is over, and what a call is given in the next.
pub fn lasts(graph: &Graph, id: NodeId) -> bool {
    matches!(
        graph.node(id),
        Node::Apply(..) | Node::Ramp { .. } | Node::Stepped { .. } | Node::Select { .. }
    )
}

/// Makes a node another operation, of one operand.
pub fn put(graph: &mut Graph, id: NodeId, op: Op, of: NodeId) {
    let at = id.0 as usize;
    if let (Some(node), Some(ty)) = (graph.nodes.get_mut(at), graph.types.get_mut(at)) {
        *node = Node::Apply(op, [of; 2]);
        *ty = op.result();
    }
}

/// How often statements read each value.
pub fn uses(graph: &Graph, tree: &Tree) -> FxHashMap<NodeId, u32> {
    let mut uses = FxHashMap::default();
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

/// A value that is read once less; where nobody reads it any more, it is unread.
pub fn read_less(uses: &mut FxHashMap<NodeId, u32>, id: NodeId, unread: &mut Vec<NodeId>) {
    if let Some(left) = uses.get_mut(&id) {
        *left -= 1;
        if *left == 0 {
            unread.push(id);
        }
    }
}

/// Tells of each statement that computes a value.
pub fn each_let(tree: &Tree, found: &mut dyn FnMut(NodeId)) {
    for block in tree.blocks() {
        walk(block, &mut |statement| {
            if let Statement::Let(id) = statement {
                found(*id);
            }
        });
    }
}

/// Leaves out the statements that compute what nobody reads.
pub fn leave_out(tree: &mut Tree, unread: &[NodeId]) {
    for block in tree.blocks_mut() {
        leave_out_of(block, unread);
    }
}

fn leave_out_of(block: &mut Block, unread: &[NodeId]) {
    block.retain(|statement| !matches!(statement, Statement::Let(id) if unread.contains(id)));
    for statement in block {
        match statement {
            Statement::If { yes, no, .. } => [yes, no]
                .into_iter()
                .for_each(|block| leave_out_of(block, unread)),
            Statement::Loop(turns) => {
                (turns.blocks_mut().into_iter()).for_each(|block| leave_out_of(block, unread))
            }
            Statement::Let(_) | Statement::Set { .. } | Statement::Call(_) => {}
        }
    }
}
