//! Routine selection: the first in the runtime's list whose domain the ranges prove, for each
//! operation.

use crate::analysis::points::Points;
use crate::analysis::points::widths::Widths;
use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::selection::underflow::loosen;
use crate::source::Diagnostic;
use crate::targets::{TARGETS, Target};
use slowlight_routine::{Format, Op, Routine, Runtime};

/// Which targets can compute an operation.
fn elsewhere(op: Op) -> String {
    let can = |t: &&&Target| t.runtime.routines.iter().any(|r| r.op == op);
    let names: Vec<&str> = TARGETS.iter().filter(can).map(|t| t.name).collect();
    match names.is_empty() {
        true => "no target can yet".to_owned(),
        false => format!("these can: {}", names.join(", ")),
    }
}

/// In which format, where it is not the machine's usual one.
fn among_others(runtime: &'static Runtime) -> String {
    match TARGETS.iter().any(|t| std::ptr::eq(t.runtime, runtime)) {
        true => String::new(),
        false => format!(" in {}", runtime.format),
    }
}

pub(crate) type Chosen = Vec<Option<&'static Routine>>;

/// The first routine in the runtime's list, for each operation, whose domain
/// the ranges prove.
pub(crate) fn choose(
    graph: &Graph,
    tree: &Tree,
    ranges: &Ranges,
    runtime: &'static Runtime,
    points: Option<&Points>,
) -> Result<Chosen, Vec<Diagnostic>> {
    let mut chosen: Chosen = vec![None; graph.nodes.len()];
    let mut missing = Vec::new();
    // Of plans that are only priced it is enough to know about where points would be.
    let about = match (points, runtime.real) {
        (None, Format::Scaled { bits }) => {
            let widths = Widths::uniform(bits);
            Some(Points::new((graph, tree), ranges, runtime, (&widths, &[])))
        }
        _ => None,
    };
    let points = points.or(about.as_ref());
    for block in tree.blocks() {
        walk(block, &mut |statement| {
            let Statement::Let(id) = *statement else {
                return;
            };
            let Node::Apply(op, _) = graph.node(id) else {
                if matches!(graph.node(id), Node::Ramp { .. } | Node::Stepped { .. })
                    && runtime.overhead.step.is_none()
                {
                    let message = format!("{} cannot step ints along a row", runtime.name);
                    missing.push(Diagnostic::error(graph.span(id), message));
                }
                return;
            };
            let at = id.0 as usize;
            let args = &ranges.args[at][..op.arity()];
            let seen = points.map(|points| points.in_units(id, op, args, ranges.exact[at]));
            let (args, exact) = match &seen {
                Some((args, exact)) => (args.as_slice(), *exact),
                None => (args, ranges.exact[at]),
            };
            let as_wide = |r: &Routine| points.is_none_or(|points| points.is_as_wide(id, r));
            let fits = |r: &&Routine| r.op == op && as_wide(r) && (r.domain)(args, exact);
            match runtime.routines.iter().find(fits) {
                Some(routine) => chosen[at] = Some(routine),
                None => missing.push(
                    Diagnostic::error(
                        graph.span(id),
                        format!(
                            "{} cannot compute `{}`{} yet",
                            runtime.name,
                            op.name(),
                            among_others(runtime)
                        ),
                    )
                    .help(elsewhere(op)),
                ),
            }
        });
    }
    if let Some(loose) = &runtime.loose {
        loosen(graph, ranges, loose, &mut chosen);
    }
    if missing.is_empty() {
        Ok(chosen)
    } else {
        Err(missing)
    }
}
