//! Building a graph, node by node.
//!
//! The builder keeps one node for each distinct value (hash-consing), and
//! computes what is known: an operation on constants is a constant, a select
//! on a constant is its arm. Both leave every value as it was, so the native
//! evaluation may start from what the builder makes. Whatever could change a
//! rounding is a pass.

mod loops;

use super::graph::*;
use crate::source::Span;
use rustc_hash::{FxBuildHasher, FxHashMap};
use slowlight_routine::{Op, Type, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A graph under construction.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    nodes: Vec<Node>,
    types: Vec<Type>,
    spans: Vec<Span>,
    pub(super) names: FxHashMap<NodeId, Arc<str>>,
    known: FxHashMap<Node, NodeId>,
    params: Vec<Param>,
    tables: Vec<Table>,
    loops: Vec<Loop>,
    pub(super) effects: Vec<EffectUse>,
    pub(super) directions: BTreeMap<NodeId, f64>,
    diffusion: Option<Diffusion>,
    refinement: Option<Refinement>,
    reports: Vec<NodeId>,
    pub(super) claims: BTreeMap<NodeId, (Op, [NodeId; 2])>,
    early: BTreeSet<NodeId>,
}

impl Builder {
    /// An empty graph.
    pub fn new() -> Builder {
        Builder::default()
    }

    /// The same with room for so many nodes.
    pub fn with_room(nodes: usize) -> Builder {
        Builder {
            nodes: Vec::with_capacity(nodes),
            types: Vec::with_capacity(nodes),
            spans: Vec::with_capacity(nodes),
            known: FxHashMap::with_capacity_and_hasher(nodes, FxBuildHasher),
            ..Builder::default()
        }
    }

    /// How many nodes there are, for limits.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are none yet.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    fn add(&mut self, node: Node, ty: Type, span: Span) -> NodeId {
        if let Some(&id) = self.known.get(&node) {
            return id;
        }
        let id = NodeId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        self.nodes.push(node);
        self.types.push(ty);
        self.spans.push(span);
        self.known.insert(node, id);
        id
    }

    /// The node behind an id.
    pub fn node(&self, id: NodeId) -> Node {
        self.nodes
            .get(id.0 as usize)
            .copied()
            .unwrap_or(Node::Undefined(Type::Real))
    }

    /// Where a node stands, if there is such a one.
    pub fn find(&self, node: &Node) -> Option<NodeId> {
        self.known.get(node).copied()
    }

    /// A live param's scalar.
    pub fn param_of(&self, id: ParamId) -> Option<&Param> {
        self.params.get(id.0 as usize)
    }

    /// The param that a node is.
    pub fn param_at(&self, node: NodeId) -> Option<&Param> {
        match self.nodes.get(node.0 as usize) {
            Some(Node::Param(id)) => self.param_of(*id),
            _ => None,
        }
    }

    /// A loop, which is whole once it is closed.
    pub fn loop_of(&self, id: LoopId) -> Option<&Loop> {
        self.loops.get(id.0 as usize)
    }

    /// A table.
    pub fn table_of(&self, id: TableId) -> Option<&Table> {
        self.tables.get(id.0 as usize)
    }

    /// The type of a node.
    pub fn ty(&self, id: NodeId) -> Type {
        self.types.get(id.0 as usize).copied().unwrap_or(Type::Real)
    }

    /// The value of a node that is a constant.
    pub fn value(&self, id: NodeId) -> Option<Value> {
        match self.node(id) {
            Node::Const(c) => Some(c.value()),
            _ => None,
        }
    }

    fn undefined_type(&self, id: NodeId) -> bool {
        matches!(self.node(id), Node::Undefined(_))
    }

    /// A constant that is a node of its own: it stands where it is written, and is not the
    /// equal one that was written before.
    pub fn constant_apart(&mut self, value: Value, span: Span) -> NodeId {
        self.known.remove(&Node::Const(Constant::new(value)));
        self.constant(value, span)
    }

    /// A constant.
    pub fn constant(&mut self, value: Value, span: Span) -> NodeId {
        let value = match value {
            Value::Real(r) if r.is_nan() => Value::Real(0.0),
            Value::Real(r) => Value::Real(r.clamp(f64::MIN, f64::MAX)),
            other => other,
        };
        self.add(Node::Const(Constant::new(value)), value.ty(), span)
    }

    /// The pixel's column or row.
    pub fn axis(&mut self, axis: Axis, span: Span) -> NodeId {
        self.add(Node::Axis(axis), Type::Int, span)
    }

    /// What earlier pixels sent to this one.
    pub fn received(&mut self, span: Span) -> NodeId {
        self.add(Node::Received, Type::Real, span)
    }

    /// What a neighbour left.
    pub fn neighbour(&mut self, which: Neighbour, span: Span) -> NodeId {
        self.add(Node::Neighbour(which), Type::Int, span)
    }

    /// Leaves an int to the pixels that are drawn later.
    pub fn keep(&mut self, refinement: Refinement) {
        self.refinement = Some(refinement);
    }

    /// Sends shares to later pixels, after those that are sent already.
    pub fn spread(&mut self, shares: &[Share], span: Span) {
        let none = || Diffusion {
            shares: Vec::new(),
            span,
        };
        let diffusion = self.diffusion.get_or_insert_with(none);
        diffusion.shares.extend_from_slice(shares);
    }

    /// Reports a value, after those that are reported already.
    pub fn report(&mut self, node: NodeId) {
        self.reports.push(node);
    }

    /// Declares a live param's scalar.
    pub fn param(&mut self, param: Param) -> NodeId {
        let (ty, span) = (param.ty, param.span);
        let id = ParamId(u32::try_from(self.params.len()).unwrap_or(u32::MAX));
        self.params.push(param);
        self.add(Node::Param(id), ty, span)
    }

    /// Declares a table; the same table twice is one.
    pub fn table(&mut self, table: Table) -> TableId {
        let at = self
            .tables
            .iter()
            .position(|t| *t == table)
            .unwrap_or_else(|| {
                self.tables.push(table);
                self.tables.len() - 1
            });
        TableId(u32::try_from(at).unwrap_or(u32::MAX))
    }

    /// What is never needed.
    pub fn undefined(&mut self, ty: Type) -> NodeId {
        self.add(Node::Undefined(ty), ty, Span::default())
    }

    /// An operation. An int where the operation wants a real is widened.
    pub fn apply(&mut self, op: Op, args: &[NodeId], span: Span) -> NodeId {
        let mut wide = [NodeId(0); 2];
        let mut count = 0;
        for (&arg, &want) in args.iter().zip(op.args()) {
            wide[count] = match want == Type::Real && self.ty(arg) == Type::Int {
                true => self.apply(Op::ToReal, &[arg], span),
                false => arg,
            };
            count += 1;
        }
        let wide = &wide[..count];
        if wide.iter().any(|&a| self.undefined_type(a)) || wide.is_empty() {
            return self.undefined(op.result());
        }
        if let Some(value) = self.applied(op, wide) {
            return self.constant(value, span);
        }
        let first = wide[0];
        let second = wide.get(1).copied().unwrap_or(first);
        if let Some(known) = self.same(op, [first, second], span) {
            return known;
        }
        self.add(Node::Apply(op, [first, second]), op.result(), span)
    }

    /// An operation's value where it is there in another form: with its operands the other way
    /// round, as derivatives of products have it, or a product but for its sign, as the two
    /// faces of a slab have it.
    fn same(&mut self, op: Op, [a, b]: [NodeId; 2], span: Span) -> Option<NodeId> {
        if !op.commutes() {
            return None;
        }
        let either = |own: &Builder, a, b| {
            let known = own.find(&Node::Apply(op, [a, b]));
            known.or_else(|| own.find(&Node::Apply(op, [b, a])))
        };
        if let Some(known) = either(self, a, b) {
            return Some(known);
        }
        if op != Op::Mul {
            return None;
        }
        let opposite = |own: &Builder, id| match own.node(id) {
            Node::Apply(Op::Neg, [of, _]) => Some(of),
            _ => own.find(&Node::Apply(Op::Neg, [id, id])),
        };
        let other = |own: &Builder, a, b| either(own, a, opposite(own, b)?);
        let known = other(self, a, b).or_else(|| other(self, b, a))?;
        Some(self.apply(Op::Neg, &[known], span))
    }

    /// The value of an operation on constants.
    fn applied(&self, op: Op, args: &[NodeId]) -> Option<Value> {
        let mut values = [Value::Bool(false); 2];
        for (value, &arg) in values.iter_mut().zip(args) {
            *value = self.value(arg)?;
        }
        Some(op.eval(&values[..args.len()]))
    }

    /// A choice. Both arms have one type (an int arm beside a real one is widened).
    pub fn select(&mut self, cond: NodeId, yes: NodeId, no: NodeId, span: Span) -> NodeId {
        if self.undefined_type(yes) {
            return no;
        }
        if self.undefined_type(no) || yes == no {
            return yes;
        }
        let (yes, no) = match (self.ty(yes), self.ty(no)) {
            (Type::Int, Type::Real) => (self.apply(Op::ToReal, &[yes], span), no),
            (Type::Real, Type::Int) => (yes, self.apply(Op::ToReal, &[no], span)),
            _ => (yes, no),
        };
        match self.value(cond) {
            Some(value) if value.truth() => yes,
            Some(_) => no,
            None if yes == no => yes,
            None => self.add(Node::Select { cond, yes, no }, self.ty(yes), span),
        }
    }

    /// An entry of a table, by int column and row (clamped).
    pub fn lookup(&mut self, table: TableId, column: NodeId, row: NodeId, span: Span) -> NodeId {
        let Some(found) = self.tables.get(table.0 as usize) else {
            return self.undefined(Type::Int);
        };
        let ty = found.ty;
        if self.undefined_type(column) || self.undefined_type(row) {
            return self.undefined(ty);
        }
        if let (Some(c), Some(r)) = (self.value(column), self.value(row)) {
            let value = found.at(c.int(), r.int());
            return self.constant(value, span);
        }
        self.add(Node::Lookup { table, column, row }, ty, span)
    }

    /// An int that grows by `step` from each column to the one `stride` further.
    pub fn ramp(&mut self, first: NodeId, step: NodeId, stride: u32, span: Span) -> NodeId {
        if self.undefined_type(first) || self.undefined_type(step) {
            return self.undefined(Type::Int);
        }
        match self.value(step) {
            Some(Value::Int(0)) => first,
            _ => {
                let ramp = Node::Ramp {
                    first,
                    step,
                    stride,
                };
                self.add(ramp, Type::Int, span)
            }
        }
    }

    /// An int that is stepped along a run of columns.
    pub fn stepped(&mut self, first: NodeId, step: NodeId, span: Span) -> NodeId {
        if self.undefined_type(first) || self.undefined_type(step) {
            return self.undefined(Type::Int);
        }
        self.add(Node::Stepped { first, step }, Type::Int, span)
    }

    /// A value out of its array by columns; a constant needs none.
    pub fn tabulated(&mut self, value: NodeId, span: Span) -> NodeId {
        match self.undefined_type(value) || self.value(value).is_some() {
            true => value,
            false => self.add(Node::Tabulated(value), self.ty(value), span),
        }
    }

    /// A bool that may be taken for false where that costs less.
    pub fn early(&mut self, cond: NodeId, span: Span) -> NodeId {
        if self.value(cond).is_some() || self.undefined_type(cond) {
            return cond;
        }
        let [yes, no] = [true, false].map(|t| self.constant(Value::Bool(t), span));
        let made = self.add(Node::Select { cond, yes, no }, Type::Bool, span);
        self.early.insert(made);
        made
    }

    /// The finished graph.
    pub fn finish(mut self, image: Image, ink: NodeId, shade: Option<NodeId>) -> Graph {
        self.effects.sort_by(|a, b| a.name.cmp(&b.name));
        Graph {
            image,
            params: self.params,
            tables: self.tables,
            loops: self.loops,
            nodes: self.nodes,
            types: self.types,
            spans: self.spans,
            names: self.names,
            directions: self.directions,
            ink,
            shade,
            diffusion: self.diffusion,
            refinement: self.refinement,
            effects: self.effects,
            reports: self.reports,
            claims: self.claims,
            early: self.early,
            hoisted: Default::default(),
        }
    }
}
