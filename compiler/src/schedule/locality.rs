//! List scheduling for locality: values stand where they are first read.
//!
//! A schedule computes what is ready before what stands under conditions. So what
//! one formula needs may stand apart, between what others need, and formulas of one
//! shape are no runs of statements of one shape ([`super::outline`]). Here every
//! operation goes down to the first statement of its block that reads it, its
//! operands before it in their order.
//!
//! A value is written once, so what an operation reads is the same further down;
//! what a loop carries is not, so loops stay as they are.

use crate::ir::graph::*;
use crate::ir::tree::*;
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::Op;

/// What only runs of columns read of a pass's ints, if computing one takes no longer
/// than reading it: it stands in front of the first statement that reads it, so that
/// the subroutine that reads it may have it.
pub fn down_to_runs(graph: &Graph, tree: &mut Tree) {
    let mut elsewhere: FxHashSet<NodeId> = FxHashSet::default();
    for block in [
        &tree.frame,
        &tree.column,
        &tree.row,
        &tree.pass,
        &tree.pixel,
    ] {
        for statement in block {
            elsewhere.extend(reads(graph, statement));
        }
    }
    // A choice, an ink say, is read where it is made, wherever that is.
    for id in graph.ids() {
        if !matches!(graph.node(id), Node::Apply(..)) {
            elsewhere.extend(graph.node(id).operands());
        }
    }
    elsewhere.extend(graph.roots());
    let seldom: FxHashSet<NodeId> = (tree.segment.iter())
        .flat_map(|s| reads(graph, s))
        .collect();
    let mut found = Vec::new();
    walk(&tree.pass, &mut |statement| {
        if let Statement::Let(id) = statement
            && seldom.contains(id)
            && !elsewhere.contains(id)
            && is_short(graph, *id)
        {
            found.push(*id);
        }
    });
    for id in found {
        let segment = std::mem::take(&mut tree.segment);
        tree.segment = in_front(graph, segment, id);
        tree.pass = left_out(std::mem::take(&mut tree.pass), id);
    }
}

/// A sum or difference of an int and a constant.
fn is_short(graph: &Graph, id: NodeId) -> bool {
    let Node::Apply(Op::IntAdd | Op::IntSub, args) = graph.node(id) else {
        return false;
    };
    let carried = |id: &NodeId| matches!(graph.node(*id), Node::Carried { .. } | Node::Last { .. });
    args.iter().any(|id| graph.constant(*id).is_some()) && !args.iter().any(carried)
}

/// A block with a value before the first statement that reads it, as deep inside as
/// one arm has all that do.
fn in_front(graph: &Graph, mut block: Block, id: NodeId) -> Block {
    let reading = |s: &Statement| reads(graph, s).contains(&id);
    let all: Vec<usize> = (0..block.len()).filter(|at| reading(&block[*at])).collect();
    let Some(&first) = all.first() else {
        return block;
    };
    if let (1, Statement::If { cond, yes, no }) = (all.len(), &mut block[first])
        && *cond != id
    {
        let inside = [&*yes, &*no].map(|arm| arm.iter().any(reading));
        match inside {
            [true, false] => *yes = in_front(graph, std::mem::take(yes), id),
            [false, true] => *no = in_front(graph, std::mem::take(no), id),
            _ => block.insert(first, Statement::Let(id)),
        }
        return block;
    }
    block.insert(first, Statement::Let(id));
    block
}

/// A block without the statement that computes a value.
fn left_out(block: Block, id: NodeId) -> Block {
    let kept = block.into_iter().filter(|s| *s != Statement::Let(id));
    kept.filter_map(|statement| match statement {
        Statement::If { cond, yes, no } => {
            let (yes, no) = (left_out(yes, id), left_out(no, id));
            (!yes.is_empty() || !no.is_empty()).then_some(Statement::If { cond, yes, no })
        }
        other => Some(other),
    })
    .collect()
}

/// A block with its values where they are first read, and so with its arms.
pub fn by_first_use(graph: &Graph, block: Block) -> Block {
    let block: Vec<Statement> = block.into_iter().map(|s| inside(graph, s)).collect();
    let mut order = Order {
        movable: movable(graph, &block),
        done: vec![false; block.len()],
        reads: block.iter().map(|s| reads(graph, s)).collect(),
        all: Vec::with_capacity(block.len()),
    };
    let read: FxHashSet<NodeId> = order.reads.iter().flatten().copied().collect();
    for (at, statement) in block.iter().enumerate() {
        let waits = match statement {
            Statement::Let(id) => order.movable.contains_key(id) && read.contains(id),
            _ => false,
        };
        if !waits {
            order.put(at);
        }
    }
    let mut block: Vec<Option<Statement>> = block.into_iter().map(Some).collect();
    let ordered = order.all.into_iter();
    ordered.filter_map(|at| block[at].take()).collect()
}

fn inside(graph: &Graph, statement: Statement) -> Statement {
    match statement {
        Statement::If { cond, yes, no } => Statement::If {
            cond,
            yes: by_first_use(graph, yes),
            no: by_first_use(graph, no),
        },
        other => other,
    }
}

/// The operations of a block that may stand further down, and where they stand.
fn movable(graph: &Graph, block: &[Statement]) -> FxHashMap<NodeId, usize> {
    let steady = |id: NodeId| {
        !matches!(
            graph.node(id),
            Node::Carried { .. } | Node::Last { .. } | Node::Slot(_)
        )
    };
    let all = block.iter().enumerate().filter_map(|(at, s)| match s {
        Statement::Let(id) => Some((*id, at)),
        _ => None,
    });
    all.filter(|(id, _)| {
        let node = graph.node(*id);
        matches!(node, Node::Apply(..) | Node::Lookup { .. }) && node.operands().all(steady)
    })
    .collect()
}

/// What a statement reads, those inside it included, in order.
fn reads(graph: &Graph, statement: &Statement) -> Vec<NodeId> {
    let mut all = Vec::new();
    walk(std::slice::from_ref(statement), &mut |s| match s {
        Statement::Let(id) => all.extend(graph.node(*id).operands()),
        Statement::Set {
            from: Origin::Node(id),
            ..
        } => all.push(*id),
        Statement::If { cond, .. } => all.push(*cond),
        Statement::Loop(turns) => all.push(turns.again),
        Statement::Set { .. } | Statement::Call(_) => {}
    });
    all
}

struct Order {
    movable: FxHashMap<NodeId, usize>,
    done: Vec<bool>,
    reads: Vec<Vec<NodeId>>,
    all: Vec<usize>,
}

impl Order {
    /// Puts a statement, before it what it reads that has waited.
    fn put(&mut self, at: usize) {
        // Which statement, and how many of its reads have been looked at.
        let mut todo = vec![(at, 0)];
        while let Some((at, next)) = todo.pop() {
            match self.reads[at].get(next) {
                Some(id) => {
                    todo.push((at, next + 1));
                    if let Some(&before) = self.movable.get(id)
                        && !self.done[before]
                    {
                        todo.push((before, 0));
                    }
                }
                None if !std::mem::replace(&mut self.done[at], true) => self.all.push(at),
                None => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eval::drawn::{drawn, grid};
    use crate::eval::random_graphs;
    use crate::passes::simplify::fold::fold;
    use crate::schedule::statements::schedule;

    #[test]
    fn random_graphs_draw_the_same_and_compute_all_there_was() {
        let mut moved = 0;
        for seed in 0..300 {
            let graph = fold(&random_graphs::graph(seed));
            let plain = schedule(&graph);
            let mut tree = plain.clone();
            for block in [&mut tree.frame, &mut tree.row, &mut tree.pixel] {
                let ordered = by_first_use(&graph, std::mem::take(block));
                *block = ordered;
            }
            moved += u32::from(tree != plain);
            let places = grid(7, 5, 1);
            assert_eq!(
                drawn(&graph, &plain, &places),
                drawn(&graph, &tree, &places),
                "seed {seed}:\n{tree}"
            );
            assert_eq!(
                tree.to_string().lines().count(),
                plain.to_string().lines().count()
            );
        }
        assert!(moved > 100, "{moved}");
    }
}
