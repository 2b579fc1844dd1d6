//! Formulas that identities are: sums of few products of values.

use crate::ir::graph::NodeId;

/// d w + c a (u + s v), the values by their place in the list that was looked
/// through; none is 1 for a and v, and for w nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    pub product: Option<(Fraction, usize, Option<usize>)>,
    pub factor: Fraction,
    pub by: Option<usize>,
    pub sum: Sum,
}

/// A formula and the values in it.
#[derive(Clone, Debug)]
pub struct Found {
    pub(super) formula: Formula,
    pub(super) values: Vec<NodeId>,
}

/// A constant.
pub type Fraction = (i64, i64);

/// u + s v, with v none for 1.
pub type Sum = (usize, Option<(Fraction, Option<usize>)>);
