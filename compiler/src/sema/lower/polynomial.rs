//! A formula along a ray, collected in powers of the distance.

use super::derive::{Coefficients, Formula};
use super::{Found, Lower};
use crate::ir::graph::{Node, NodeId};
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::Op;

impl Lower<'_> {
    /// The coefficients of 1, t and t^2 of a formula whose markers are
    /// `from + t dir`; none where it is no polynomial of degree 2 at most.
    pub(super) fn polynomial(
        &mut self,
        formula: &Formula,
        from: &[NodeId],
        dir: &[NodeId],
        span: Span,
    ) -> Found<Option<Coefficients>> {
        let Some(nodes) = self.needed(formula, &[formula.root]) else {
            return Ok(None);
        };
        let mut known: FxHashMap<NodeId, Coefficients> = FxHashMap::default();
        for (&marker, (&o, &d)) in formula.markers.iter().zip(from.iter().zip(dir)) {
            known.insert(marker, [Some(o), Some(d), None]);
        }
        for id in nodes {
            self.step(span)?;
            if known.contains_key(&id) {
                continue;
            }
            let node = self.b.node(id);
            if !node.operands().any(|o| known.contains_key(&o)) {
                continue;
            }
            match self.collect(node, &known, span) {
                Some(found) => known.insert(id, found),
                // Whatever needs this is no polynomial either.
                None => return Ok(None),
            };
        }
        let root = formula.root;
        Ok(known.get(&root).copied().or(Some([Some(root), None, None])))
    }

    fn collect(
        &mut self,
        node: Node,
        known: &FxHashMap<NodeId, Coefficients>,
        span: Span,
    ) -> Option<Coefficients> {
        let span = self.at(span);
        let of = |id: NodeId| known.get(&id).copied().unwrap_or([Some(id), None, None]);
        let free = |id: NodeId| !known.contains_key(&id);
        match node {
            Node::Apply(op @ (Op::Add | Op::Sub), [a, b]) => {
                let (a, b) = (of(a), of(b));
                Some([0, 1, 2].map(|k| self.join(op, a[k], b[k], span)))
            }
            Node::Apply(Op::Neg, [a, _]) => {
                Some(of(a).map(|c| c.map(|c| self.b.apply(Op::Neg, &[c], span))))
            }
            Node::Apply(Op::Mul, [a, b]) => {
                let (a, b) = (of(a), of(b));
                let mut found: [Option<NodeId>; 5] = [None; 5];
                for (i, x) in a.iter().enumerate() {
                    for (j, y) in b.iter().enumerate() {
                        if let (Some(x), Some(y)) = (x, y) {
                            let product = self.b.apply(Op::Mul, &[*x, *y], span);
                            found[i + j] = self.join(Op::Add, found[i + j], Some(product), span);
                        }
                    }
                }
                let [c, b, a, rest, more] = found;
                (rest.is_none() && more.is_none()).then_some([c, b, a])
            }
            Node::Apply(Op::Div, [a, b]) if free(b) => {
                Some(of(a).map(|c| c.map(|c| self.b.apply(Op::Div, &[c, b], span))))
            }
            _ => None,
        }
    }

    /// A sum or difference where either side may be 0.
    fn join(&mut self, op: Op, a: Option<NodeId>, b: Option<NodeId>, span: Span) -> Option<NodeId> {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.b.apply(op, &[a, b], span)),
            (a, None) => a,
            (None, Some(b)) if op == Op::Sub => Some(self.b.apply(Op::Neg, &[b], span)),
            (None, b) => b,
        }
    }
}
