//! Conditional range analysis: ranges of a run of operations under more than is known everywhere.

use super::{Ranges, Slack};
use crate::ir::graph::*;
use crate::ir::interval::interval;
use rustc_hash::FxHashMap;
use slowlight_routine::{Range, Runtime};

/// Between which bounds the arguments of a run of operations stay where some
/// values are known to lie closer than `known` says.
pub fn assuming(
    graph: &Graph,
    runtime: &Runtime,
    known: &Ranges,
    assumed: &[(NodeId, Range)],
    run: &[NodeId],
) -> FxHashMap<NodeId, [Range; 2]> {
    let slack = Slack::of(runtime);
    let mut now: FxHashMap<NodeId, Range> = assumed.iter().copied().collect();
    let mut found = FxHashMap::default();
    for &id in run {
        let at = id.0 as usize;
        let (Node::Apply(op, operands), Some(before)) = (graph.node(id), known.args.get(at)) else {
            continue;
        };
        let closer = |k: usize| match now.get(&operands[k]) {
            Some(range) => before[k].meet(*range),
            None => before[k],
        };
        let args = [closer(0), closer(1)];
        let exact = interval(op, args, operands[0] == operands[1]);
        let result = slack.rounded(op, &args[..op.arity()], exact);
        now.insert(id, result.meet(known.result[at]));
        found.insert(id, args);
    }
    found
}
