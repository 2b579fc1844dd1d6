//! Conditions, blocks and loops.
//!
//! A loop's body ends in leaves: a `next` or a result. [`Leaf`] is what a
//! part of the body comes to; conditions merge leaves. What one side does not
//! have is undefined, and the builder drops it.

use super::claims::Claimed;
use super::value::Val;
use super::{Found, Lower};
use crate::ir::graph::NodeId;
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use slowlight_routine::{Type, Value};

/// What a part of a loop's body comes to.
pub(super) struct Leaf {
    /// A bool: whether it ends in `next`.
    pub(super) again: NodeId,
    /// What `next` gives; none where there is no `next`.
    pub(super) next: Option<Vec<Val>>,
    /// The result where there is no `next`.
    pub(super) done: Val,
}

impl<'a> Lower<'a> {
    /// An expression whose ends may be `next`.
    pub(super) fn tail(&mut self, e: &'a Expr) -> Found<Leaf> {
        self.step(e.span)?;
        match &e.kind {
            ExprKind::If { condition, yes, no } => {
                let test = self.expr(condition)?;
                let test = self.node(test, &Ty::Bool, condition.span)?;
                if let Some(known) = self.b.value(test) {
                    return self.deeper(if known.truth() { yes } else { no });
                }
                let yes = self.deeper(yes)?;
                let no = self.deeper(no)?;
                self.merge_leaves(test, yes, no, e.span)
            }
            ExprKind::IfLet {
                local,
                condition,
                yes,
                no,
            } => {
                let found = self.expr(condition)?;
                let (present, value) = match self.force(found)? {
                    Val::Optional { present, value } => (present, (*value).clone()),
                    Val::Undefined => return self.deeper(no),
                    _ => return Err(self.confused(condition.span)),
                };
                let known = self.b.value(present);
                if known == Some(Value::Bool(false)) {
                    return self.deeper(no);
                }
                self.bind(*local, value);
                let taken = self.deeper(yes)?;
                if known.is_some() {
                    return Ok(taken);
                }
                let other = self.deeper(no)?;
                self.merge_leaves(present, taken, other, e.span)
            }
            ExprKind::Block { statements, result } => {
                for statement in statements {
                    self.statement(statement)?;
                }
                self.deeper(result)
            }
            ExprKind::Convert(inner) if is_flow(inner) => {
                let mut leaf = self.deeper(inner)?;
                if inner.ty != Ty::Never {
                    leaf.done = match leaf.done {
                        Val::Undefined => Val::Undefined,
                        value => self.convert(value, &inner.ty, &e.ty, e.span)?,
                    };
                }
                Ok(leaf)
            }
            ExprKind::Next(values) => {
                let values: Found<Vec<Val>> = values.iter().map(|v| self.expr(v)).collect();
                Ok(Leaf {
                    again: self.bool(true, e.span),
                    next: Some(values?),
                    done: Val::Undefined,
                })
            }
            _ => {
                let done = self.expr(e)?;
                Ok(Leaf {
                    again: self.bool(false, e.span),
                    next: None,
                    done,
                })
            }
        }
    }

    fn deeper(&mut self, e: &'a Expr) -> Found<Leaf> {
        if self.depth >= super::DEPTH {
            let error = self.error(e.span, "calls nest too deeply here");
            return Err(Box::new(error));
        }
        self.depth += 1;
        let found = self.tail(e);
        self.depth -= 1;
        found
    }

    pub(super) fn bind(&mut self, local: LocalId, value: Val) {
        if let Some(declared) = self.locals.get(local.0) {
            self.name(&value, &declared.ty, &declared.name);
        }
        if let Some(slot) = self.frame.get_mut(local.0) {
            *slot = value;
        }
    }

    pub(super) fn statement(&mut self, statement: &'a Statement) -> Found<()> {
        match statement {
            Statement::Let {
                claim,
                local,
                value: tree,
            } => {
                let value = self.expr(tree)?;
                self.bind(*local, value.clone());
                if let Some((claim, span)) = claim {
                    let mut nodes = Vec::new();
                    if tree.ty.is_data() {
                        self.flatten(value, &tree.ty, &mut nodes, tree.span)?;
                    }
                    let name = self.locals.get(local.0).map_or("", |l| &l.name);
                    self.claims.push(Claimed {
                        claim: *claim,
                        name: name.to_owned(),
                        span: span.to(tree.span),
                        nodes,
                    });
                }
                Ok(())
            }
            Statement::Spread { span, .. } => Err(self.misplaced_spread(*span)),
        }
    }

    fn merge_leaves(&mut self, test: NodeId, yes: Leaf, no: Leaf, span: Span) -> Found<Leaf> {
        let next = match (yes.next, no.next) {
            (Some(a), Some(b)) => {
                let pairs = a.into_iter().zip(b);
                let merged: Found<Vec<Val>> =
                    pairs.map(|(a, b)| self.merge(test, a, b, span)).collect();
                Some(merged?)
            }
            (Some(one), None) | (None, Some(one)) => Some(one),
            (None, None) => None,
        };
        Ok(Leaf {
            again: self.select(test, yes.again, no.again, span),
            next,
            done: self.merge(test, yes.done, no.done, span)?,
        })
    }

    pub(super) fn loop_(
        &mut self,
        carried: &'a [(LocalId, Expr)],
        max: &'a Expr,
        body: &'a Expr,
        otherwise: &'a Expr,
        ty: &Ty,
        span: Span,
    ) -> Found<Val> {
        let count = self.known_int(max, "a loop's `max`")?;
        if !(1..=65535).contains(&count) {
            let message = format!("a loop's `max` is from 1 to 65535, not {count}");
            return Err(Box::new(self.error(max.span, message)));
        }
        let limit = match self.place {
            Some(_) => self.options.max_steps,
            None => self.options.max_turns,
        };
        // Constants are the scene's: nothing that a machine computes.
        let limit = limit.filter(|_| self.constant == 0 && !self.all_turns);
        let count = limit.map_or(count, |most| count.min(most.clamp(1, 65535) as i32));
        let mut inits = Vec::new();
        for (_, init) in carried {
            inits.push(self.expr(init)?);
        }
        if self.constant > 0 {
            return self.run(carried, inits, count, body, otherwise, span);
        }
        let mut list = Vec::new();
        for ((local, _), init) in carried.iter().zip(inits) {
            let Some(declared) = self.locals.get(local.0) else {
                return Err(self.confused(span));
            };
            let layout = self.layout(&declared.ty, &declared.name, span)?;
            let mut nodes = Vec::new();
            self.flatten(init, &declared.ty, &mut nodes, span)?;
            for ((name, ty), node) in layout.into_iter().zip(nodes) {
                list.push((name, ty, self.defined(node, ty, span)));
            }
        }
        let here = self.at(span);
        let id = self.b.open_loop(count as u32, &list, here);
        self.loops = id.0 + 1;
        let scalars: Vec<NodeId> = (0..list.len() as u32)
            .map(|k| self.b.carried(id, k, here))
            .collect();
        self.bind_carried(carried, &scalars);
        let leaf = self.deeper(body)?;
        let mut next = Vec::new();
        if let Some(values) = leaf.next {
            for ((local, _), value) in carried.iter().zip(values) {
                if let Some(declared) = self.locals.get(local.0) {
                    self.flatten(value, &declared.ty, &mut next, span)?;
                }
            }
        }
        // A part that `next` leaves without a value stays as it is.
        let next: Vec<NodeId> = scalars
            .iter()
            .enumerate()
            .map(|(k, &old)| match next.get(k) {
                Some(&new) if !self.is_undefined(new) => new,
                _ => old,
            })
            .collect();
        let mut done = Vec::new();
        self.flatten(leaf.done, ty, &mut done, span)?;
        let last: Vec<NodeId> = (0..list.len() as u32)
            .map(|k| self.b.last(id, k, here))
            .collect();
        self.bind_carried(carried, &last);
        let value = self.expr(otherwise)?;
        let mut elses = Vec::new();
        self.flatten(value, ty, &mut elses, span)?;
        let results = self.b.close_loop(id, leaf.again, &next, &done, &elses);
        Ok(self.unflatten(ty, &mut results.into_iter()))
    }

    fn bind_carried(&mut self, carried: &[(LocalId, Expr)], nodes: &[NodeId]) {
        let mut nodes = nodes.iter().copied();
        for (local, _) in carried {
            let Some(declared) = self.locals.get(local.0) else {
                continue;
            };
            let value = self.unflatten(&declared.ty, &mut nodes);
            self.bind(*local, value);
        }
    }

    fn is_undefined(&self, node: NodeId) -> bool {
        matches!(self.b.node(node), crate::ir::graph::Node::Undefined(_))
    }

    /// A start that is always defined, so that whoever runs the graph may
    /// work out a loop's start whole.
    fn defined(&mut self, node: NodeId, ty: Type, span: Span) -> NodeId {
        if !self.is_undefined(node) {
            return node;
        }
        match ty {
            Type::Bool => self.bool(false, span),
            Type::Int => self.int(0, span),
            Type::Real => self.real(0.0, span),
        }
    }

    /// A loop of a constant: turn by turn, while compiling.
    fn run(
        &mut self,
        carried: &'a [(LocalId, Expr)],
        inits: Vec<Val>,
        count: i32,
        body: &'a Expr,
        otherwise: &'a Expr,
        span: Span,
    ) -> Found<Val> {
        let mut values = inits;
        for _ in 0..count {
            for ((local, _), value) in carried.iter().zip(&values) {
                self.bind(*local, value.clone());
            }
            let leaf = self.deeper(body)?;
            match (self.b.value(leaf.again), leaf.next) {
                (Some(Value::Bool(false)), _) => return Ok(leaf.done),
                (Some(_), Some(next)) => values = next,
                _ => {
                    let error = self.error(span, "this loop's end is not known when compiling");
                    return Err(Box::new(error));
                }
            }
        }
        for ((local, _), value) in carried.iter().zip(values) {
            self.bind(*local, value);
        }
        self.expr(otherwise)
    }
}

/// Whether an expression may hold the loop's `next`.
fn is_flow(e: &Expr) -> bool {
    matches!(
        e.kind,
        ExprKind::If { .. }
            | ExprKind::IfLet { .. }
            | ExprKind::Block { .. }
            | ExprKind::Next(_)
            | ExprKind::Convert(_)
    )
}
