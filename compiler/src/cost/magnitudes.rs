//! Ranges by a sample of executions, for prices only.
//!
//! Where each value has its own point, what its routines take hangs on where that stands: a sine
//! of angles within 64 is read from a table, one of angles within thousands is a function of
//! 16.16 and takes twenty times as long. The ranges prove little of what loops carry, and plans
//! have their points by what values are at pixels ([`crate::wordlength`]). So prices do, too: each
//! value is thought to stay within what it was at the pixels that are looked at, and some more.

use super::meter::Meter;
use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::ir::tree::Statement;
use slowlight_routine::{Range, Type};

/// How much more than at the pixels a value is thought to be.
const MORE: f64 = 1.5;

/// How often what values are is followed through choices and loops.
const ROUNDS: u32 = 4;

/// The ranges of a graph cut to what its values were while they were metered.
pub(crate) fn seen<C: Fn(&Statement) -> f64>(
    graph: &Graph,
    ranges: &Ranges,
    meter: &Meter<'_, C>,
) -> Ranges {
    let largest = meter.largest();
    let start = |id: NodeId| match graph.node(id) {
        Node::Apply(..) => largest.get(id.0 as usize).copied().unwrap_or(0.0),
        Node::Select { .. } | Node::Carried { .. } | Node::Last { .. } | Node::Result { .. } => 0.0,
        _ => ranges.result[id.0 as usize].magnitude(),
    };
    let mut most: Vec<f64> = graph.ids().map(start).collect();
    for _ in 0..ROUNDS {
        for id in graph.ids() {
            let at = |id: &NodeId| most[id.0 as usize];
            let entry = |list: &[NodeId], k: u32| list.get(k as usize).map_or(0.0, at);
            let found = match graph.node(id) {
                Node::Select { yes, no, .. } => at(&yes).max(at(&no)),
                Node::Carried { of, index } | Node::Last { of, index } => {
                    let turns = &graph.loops[of.0 as usize];
                    entry(&turns.init, index).max(entry(&turns.next, index))
                }
                Node::Result { of, index } => {
                    let turns = &graph.loops[of.0 as usize];
                    entry(&turns.done, index).max(entry(&turns.otherwise, index))
                }
                _ => continue,
            };
            most[id.0 as usize] = found;
        }
    }
    let cut = |id: NodeId, range: Range| {
        let most = MORE * most[id.0 as usize];
        match graph.ty(id) == Type::Real && most > 0.0 && range.magnitude() > most {
            true => range.meet(Range::new(-most, most)),
            false => range,
        }
    };
    let all = |ranges: &[Range]| -> Vec<Range> {
        graph
            .ids()
            .zip(ranges)
            .map(|(id, range)| cut(id, *range))
            .collect()
    };
    let args = graph
        .ids()
        .zip(&ranges.args)
        .map(|(id, args)| match graph.node(id) {
            Node::Apply(_, of) => [cut(of[0], args[0]), cut(of[1], args[1])],
            _ => *args,
        });
    Ranges {
        result: all(&ranges.result),
        exact: all(&ranges.exact),
        args: args.collect(),
    }
}
