//! Reals that pixels read at another scale than their own, and that were known before: read
//! so once, where they are computed, and kept.

use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::{Copies, Plan};
use slowlight_routine::{Type, scale};
use std::collections::BTreeSet;

/// A real and the fraction bits that it is read with.
pub(super) type Moved = (NodeId, i8);

/// The reals that are kept so; none where memory is short.
pub(super) fn moved(plan: &Plan) -> BTreeSet<Moved> {
    let tree = &plan.tree;
    // Of more bytes a home may have fewer than the format.
    let short = plan.copies != Copies::None && plan.runtime.real.bits() == 16;
    let Some(points) = plan.points().filter(|_| short) else {
        return BTreeSet::new();
    };
    let mut known = BTreeSet::new();
    for block in [&tree.frame, &tree.row, &tree.pass, &tree.segment] {
        lets(block, &mut |id| _ = known.insert(id));
    }
    lets(&tree.pixel, &mut |id| _ = known.remove(&id));
    let mut found = BTreeSet::new();
    let mut add = |id: NodeId, to: i8| {
        let real = plan.graph.ty(id) == Type::Real && plan.graph.constant(id).is_none();
        if real && known.contains(&id) && points.own(id) != to {
            found.insert((id, to));
        }
    };
    walk(&tree.pixel, &mut |statement| match statement {
        Statement::Let(id) => each_read(plan, *id, &mut add),
        Statement::Set {
            place,
            from: Origin::Node(from),
        } if points.widths().place(*place) == points.widths().most() => {
            add(*from, points.place(*place));
        }
        _ => {}
    });
    found
}

/// The operands of an operation of reals and the scales that they are read at, in all bits.
pub(super) fn each_read(plan: &Plan, id: NodeId, found: &mut dyn FnMut(NodeId, i8)) {
    if let (Some(points), Node::Apply(op, args)) = (plan.points(), plan.graph.node(id))
        && scale::concerns(op)
        && points.widths().operands(id) == points.widths().most()
    {
        let scales = points.scales(id).args;
        for ((arg, to), ty) in args.into_iter().zip(scales).zip(op.args()) {
            if *ty == Type::Real {
                found(arg, to);
            }
        }
    }
}

fn lets(block: &[Statement], found: &mut dyn FnMut(NodeId)) {
    walk(block, &mut |statement| {
        if let Statement::Let(id) = statement {
            found(*id);
        }
    });
}
