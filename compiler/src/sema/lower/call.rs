//! Calls: a function's body stands where it is called.

use super::value::{Instances, Shape, Val};
use super::{Found, Lower};
use crate::ir::graph::{Node, NodeId};
use crate::sema::builtins::Builtin;
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use slowlight_routine::Op;
use std::rc::Rc;

impl<'a> Lower<'a> {
    pub(super) fn call(
        &mut self,
        callee: &'a Callee,
        args: &'a [Option<Expr>],
        ty: &Ty,
        span: Span,
    ) -> Found<Val> {
        let callee = match callee {
            Callee::Local(id) => match self.frame.get(id.0).cloned() {
                Some(Val::Function(callee)) => callee,
                Some(Val::Rows(of)) => return self.call_row(&of, args, span),
                _ => return Err(self.confused(span)),
            },
            other => other.clone(),
        };
        match callee {
            Callee::Function(id) => {
                let Some(function) = self.program.functions.get(id.0) else {
                    return Err(self.confused(span));
                };
                let args = self.arguments(&function.params, args, span)?;
                match self.walk_inside(function, &args, span)? {
                    Some(wall) => Ok(wall),
                    None => self.expand(function, args, span),
                }
            }
            Callee::Shape(id) => {
                let params = self.program.shapes.get(id.0).map_or(&[][..], |s| &s.params);
                let args = self.arguments(params, args, span)?;
                self.not_empty(id, &args, span)?;
                Ok(Val::Shape(Rc::new(Shape { id, args })))
            }
            Callee::Record(id) => {
                let params = self
                    .program
                    .records
                    .get(id.0)
                    .map_or(&[][..], |r| &r.fields);
                Ok(Val::parts(self.arguments(params, args, span)?))
            }
            Callee::Builtin(builtin) => self.builtin(builtin, args, ty, span),
            Callee::Local(_) => Err(self.confused(span)),
        }
    }

    /// A shape of the library between two corners, or heights, of which one is known to be on
    /// the wrong side of the other: nothing would ever be hit.
    fn not_empty(&self, id: ShapeId, args: &[Val], span: Span) -> Found<()> {
        let Some(shape) = self.program.shapes.get(id.0).filter(|s| s.library) else {
            return Ok(());
        };
        let named = |name: &str| {
            let at = shape.params.iter().position(|p| p.name == name)?;
            Some(match args.get(at)? {
                Val::Parts(parts) => parts.to_vec(),
                other => vec![other.clone()],
            })
        };
        let (Some(lows), Some(highs)) = (named("low"), named("high")) else {
            return Ok(());
        };
        let number = |value: &Val| match value {
            Val::Node(id) => self.b.value(*id).map(|v| v.real()),
            Val::Number(k) => Some(f64::from(*k)),
            _ => None,
        };
        let parts = match lows.len() {
            1 => [""; 3],
            _ => [".x", ".y", ".z"],
        };
        for ((low, high), part) in lows.iter().zip(&highs).zip(parts) {
            if let (Some(low), Some(high)) = (number(low), number(high))
                && low > high
            {
                let message = format!(
                    "nothing is in this `{}`: `low{part}` is {low}, above `high{part}`, which is {high}",
                    shape.name
                );
                let help = "`low` has the lesser value of each coordinate, `high` the greater";
                return Err(Box::new(self.error(span, message).help(help)));
            }
        }
        Ok(())
    }

    fn call_row(&mut self, of: &Instances, args: &'a [Option<Expr>], span: Span) -> Found<Val> {
        let Some(Some(row)) = args.first() else {
            return Err(self.confused(span));
        };
        let row = self.expr(row)?;
        let row = self.node(row, &Ty::Int, span)?;
        Ok(Val::Shape(self.instance(of, row, span)?))
    }

    /// The arguments' values; what is left out is its parameter's default.
    pub(super) fn arguments(
        &mut self,
        params: &'a [Parameter],
        args: &'a [Option<Expr>],
        span: Span,
    ) -> Found<Vec<Val>> {
        let mut found = Vec::new();
        for (k, param) in params.iter().enumerate() {
            found.push(match (args.get(k), &param.default) {
                (Some(Some(value)), _) => self.expr(value)?,
                (_, Some(default)) => self.constant_body_or_param(default)?,
                _ => return Err(self.confused(span)),
            });
        }
        Ok(found)
    }

    /// A default may use params, so it is not bound to be constant.
    fn constant_body_or_param(&mut self, body: &'a Body) -> Found<Val> {
        self.enter(body, Vec::new(), |l| l.expr(&body.value))
    }

    /// A function's body with its arguments.
    pub(super) fn expand(
        &mut self,
        function: &'a Function,
        args: Vec<Val>,
        span: Span,
    ) -> Found<Val> {
        let mut body = &function.body;
        let outer = self.effect;
        if let FunctionKind::Effect { otherwise } = &function.kind {
            match self.options.without.contains(&function.name) {
                true => body = otherwise,
                false => {
                    self.b.effect(&function.name);
                    let mut all = self.program.functions.iter();
                    let number = all.position(|f| std::ptr::eq(f, function));
                    self.effect = number.and_then(|number| u16::try_from(number).ok());
                }
            }
        }
        for (arg, param) in args.iter().zip(&function.params) {
            self.name(arg, &param.ty, &param.name);
        }
        let result = self.inside(function.library, span, |l| {
            l.enter(body, args, |l| {
                let value = l.expr(&body.value)?;
                l.force(value)
            })
        });
        self.effect = outer;
        result
    }

    /// Works in the library's or the scene's text: inside the library, nodes
    /// belong to the line of the scene that called into it.
    pub(super) fn inside<T>(
        &mut self,
        library: bool,
        span: Span,
        work: impl FnOnce(&mut Self) -> Found<T>,
    ) -> Found<T> {
        let outer = self.place;
        self.place = match library {
            true => Some(self.at(span)),
            false => None,
        };
        let result = work(self);
        self.place = outer;
        result
    }

    fn builtin(
        &mut self,
        builtin: Builtin,
        args: &'a [Option<Expr>],
        ty: &Ty,
        span: Span,
    ) -> Found<Val> {
        let Some(Some(first)) = args.first() else {
            return Err(self.confused(span));
        };
        match builtin {
            Builtin::Bayer => return self.bayer(first, span),
            Builtin::NearestInks => return self.nearest_inks(first, span),
            Builtin::InkStep => return self.ink_step(first, span),
            _ => {}
        }
        let value = self.expr(first)?;
        let mut rest: Vec<Option<(&'a Expr, Val)>> = Vec::new();
        for arg in args.iter().skip(1) {
            rest.push(match arg {
                Some(e) => Some((e, self.expr(e)?)),
                None => None,
            });
        }
        let second = rest.first().cloned().flatten();
        match builtin {
            Builtin::Op(op) => {
                let mut nodes = vec![self.node(value, &first.ty, span)?];
                if let Some((e, value)) = second {
                    nodes.push(self.node(value, &e.ty, span)?);
                }
                self.operation(op, &nodes, span)
            }
            Builtin::Ink => {
                let i = self.node(value, &first.ty, span)?;
                let last = match self.options.all_inks {
                    true => i32::MAX,
                    false => self.image.palette.len() as i32 - 1,
                };
                let last = self.int(last, span);
                let least = self.int(0, span);
                let below = self.apply(Op::IntMin, &[i, last], span)?;
                let ink = self.apply(Op::IntMax, &[below, least], span)?;
                // Who looks for ink numbers wants the place of each.
                Ok(Val::Node(match self.b.value(ink) {
                    Some(value) if self.options.all_inks => {
                        self.b.constant_apart(value, self.at(span))
                    }
                    _ => ink,
                }))
            }
            Builtin::Early => {
                let c = self.node(value, &first.ty, span)?;
                Ok(Val::Node(self.b.early(c, span)))
            }
            Builtin::Ray => match second {
                Some((_, dir)) => {
                    let dir = self.direction(dir, span)?;
                    Ok(Val::parts(vec![value, dir]))
                }
                None => Err(self.confused(span)),
            },
            Builtin::Hit => match (second, rest.get(1).cloned().flatten()) {
                (Some((_, normal)), Some((_, t))) => {
                    let normal = self.direction(normal, span)?;
                    Ok(Val::parts(vec![value, normal, t]))
                }
                _ => Err(self.confused(span)),
            },
            Builtin::Count => match self.force(value)? {
                Val::Table(table) if table.height() == 1 => {
                    Ok(Val::Node(self.int(table.width as i32, span)))
                }
                Val::Table(_) => {
                    let error = self.error(span, "a table of several rows has no single count");
                    Err(Box::new(error))
                }
                _ => Err(self.confused(span)),
            },
            Builtin::Bayer | Builtin::NearestInks | Builtin::InkStep => Err(self.confused(span)),
            Builtin::ShapeHit
            | Builtin::ShapeCrossing
            | Builtin::ShapeNormal
            | Builtin::ShapeDist
            | Builtin::ShapeImplicit => match (self.force(value)?, second) {
                (Val::Shape(shape), Some((_, arg))) => self.ask(builtin, &shape, arg, span),
                _ => Err(self.confused(span)),
            },
            Builtin::Trace
            | Builtin::Blocked
            | Builtin::March
            | Builtin::SceneDist
            | Builtin::SceneTag => match (self.force(value)?, second) {
                (Val::Scene(scene), Some((_, arg))) => {
                    let more = rest
                        .into_iter()
                        .skip(1)
                        .map(|a| a.map(|(_, v)| v))
                        .collect();
                    self.ask_scene(builtin, scene, arg, more, ty, span)
                }
                _ => Err(self.confused(span)),
            },
        }
    }

    /// An operation; what is whole already need not be rounded.
    fn operation(&mut self, op: Op, nodes: &[NodeId], span: Span) -> Found<Val> {
        if let (Op::Floor | Op::Round, [one]) = (op, nodes)
            && let Node::Apply(Op::ToReal, [whole, _]) = self.b.node(*one)
        {
            return Ok(Val::Node(whole));
        }
        Ok(Val::Node(self.apply(op, nodes, span)?))
    }
}
