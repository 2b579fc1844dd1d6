//! Candidates for strength reduction along runs: ints that are polynomials there, and reals that
//! have such as a part.

use super::{Degrees, Part, may_be_read};
use crate::analysis::needed::needed;
use crate::analysis::range::Ranges;
use crate::analysis::rate::rates;
use crate::ir::graph::*;
use crate::schedule::segment::by_segment;
use slowlight_routine::{Op, Type};

/// A polynomial in the column by its coefficients, the constant one first, or a
/// choice between such by a condition that is the same for a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Whole {
    Polynomial(Vec<Part>),
    Choice(NodeId, Box<[Whole; 2]>),
}

impl Whole {
    pub fn degree(&self) -> usize {
        match self {
            Whole::Polynomial(parts) => {
                let zero = |part: &Part| part.1.constant() == Some(0.0);
                parts.iter().rposition(|part| !zero(part)).unwrap_or(0)
            }
            Whole::Choice(_, ways) => ways[0].degree().max(ways[1].degree()),
        }
    }

    pub fn choices(&self) -> usize {
        match self {
            Whole::Polynomial(_) => 1,
            Whole::Choice(_, ways) => ways[0].choices() + ways[1].choices(),
        }
    }
}

pub struct Find<'g> {
    pub graph: &'g Graph,
    pub ranges: &'g Ranges,
    /// What is the same for a whole run.
    still: Vec<bool>,
    /// Degrees of ints, and of such that conditions choose between.
    pub plain: Degrees,
    pub ints: Degrees,
    /// Of reals: what a sum has beside ints, and the degree of these.
    pub reals: Vec<Option<(Option<NodeId>, usize)>>,
}

impl<'g> Find<'g> {
    pub fn of(graph: &'g Graph, ranges: &'g Ranges) -> Find<'g> {
        let rates = rates(graph);
        let runs = by_segment(graph, &rates, &needed(graph));
        let still = graph
            .ids()
            .map(|id| rates.is_still(id) || runs[id.0 as usize]);
        let still: Vec<bool> = still.collect();
        let same = |id: NodeId| still[id.0 as usize];
        let mut find = Find {
            plain: Degrees::by(graph, ranges, &same, &|_| false),
            ints: Degrees::by(graph, ranges, &same, &same),
            reals: Vec::with_capacity(graph.nodes.len()),
            graph,
            ranges,
            still,
        };
        for id in graph.ids() {
            let parts = find.parts(id);
            find.reals.push(parts);
        }
        find
    }

    pub fn is_still(&self, id: NodeId) -> bool {
        self.still[id.0 as usize]
    }

    /// What a real is made of, if an int is a part of it.
    fn parts(&self, id: NodeId) -> Option<(Option<NodeId>, usize)> {
        let of = |id: NodeId| self.reals[id.0 as usize].unwrap_or((Some(id), 0));
        match self.graph.node(id) {
            _ if self.graph.ty(id) != Type::Real => None,
            Node::Apply(Op::ToReal, [a, _]) => Some((None, self.ints.at(a)?)),
            Node::Apply(op @ (Op::Add | Op::Sub), [a, b]) => {
                let (a, b) = (of(a), of(b));
                let rest = match (a.0, b.0) {
                    (Some(_), Some(_)) => return None,
                    (None, Some(_)) if op == Op::Sub => return None,
                    (a, b) => a.or(b),
                };
                Some((rest, a.1.max(b.1)))
            }
            Node::Apply(Op::Neg, [a, _]) => Some(of(a)).filter(|a| a.0.is_none()),
            Node::Select { cond, yes, no } if self.is_still(cond) => {
                let (yes, no) = (of(yes), of(no));
                (yes.0 == no.0).then_some((yes.0, yes.1.max(no.1)))
            }
            _ => None,
        }
    }

    pub fn may_step(&self, id: NodeId) -> bool {
        let degree = match self.graph.ty(id) {
            Type::Int => self.ints.at(id),
            _ => self.reals[id.0 as usize].map(|parts| parts.1),
        };
        let turned = matches!(self.graph.node(id), Node::Apply(Op::ToReal, _));
        let fits = !turned && may_be_read(self.graph, id);
        fits && degree.is_some_and(|degree| degree > 0)
    }
}
