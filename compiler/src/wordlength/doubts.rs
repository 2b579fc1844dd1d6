//! Error margins of expected ranges: what is expected of values, raised by what a machine's may
//! be off.

use crate::analysis::points::Points;
use crate::ir::graph::*;
use slowlight_routine::scale::{self, fitting};
use slowlight_routine::{Op, Type};

/// How many last places the operands of a sum may be off by what has gathered in them.
const DOUBT: f64 = 256.0;

impl Points {
    /// Raises what values are expected to stay within where they have fewer fraction bits
    /// than that leaves room for, so that they end later: to that end or to all that they
    /// were seen to be, and what may be off.
    pub(super) fn ends(&self, graph: &Graph, expected: &mut [Option<f64>], all: &[f64]) {
        let doubt = self.doubts(graph);
        for (at, (expected, own)) in (0..).zip(expected.iter_mut().zip(&self.own)) {
            let bits = self.widths.value(NodeId(at));
            if let Some(end) = expected
                && *own < fitting(*end, bits)
            {
                let later = Points::unit(*own) * scale::most(bits) as f64;
                let [all, doubt] = [all, &doubt].map(|each| each[at as usize]);
                *end = end.max(later.min(all.max(doubt)));
            }
        }
    }

    /// How far the machine's value may be from what pixels show exactly, where these are
    /// nearly equal and subtracted: what is left is then all error.
    fn doubts(&self, graph: &Graph) -> Vec<f64> {
        let mut all = vec![0f64; graph.nodes.len()];
        for id in graph.ids().filter(|id| graph.ty(*id) == Type::Real) {
            let Node::Apply(op, [a, b]) = graph.node(id) else {
                continue;
            };
            let of = |arg: NodeId| all[arg.0 as usize];
            let last = |arg: NodeId| match graph.constant(arg) {
                Some(_) => 0.0,
                None => Points::unit(self.own(arg)),
            };
            all[id.0 as usize] = match op {
                Op::Add | Op::Sub => (DOUBT * last(a).max(last(b))).max(of(a)).max(of(b)),
                Op::Min | Op::Max => of(a).max(of(b)),
                Op::Neg | Op::Abs => of(a),
                _ => 0.0,
            };
        }
        all
    }
}
