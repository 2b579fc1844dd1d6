//! Expressions: literals, names, parts, indices.

use super::value::{Table, Val};
use super::{DEPTH, Found, Lower};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use std::rc::Rc;

impl<'a> Lower<'a> {
    /// The value of an expression.
    pub(super) fn expr(&mut self, e: &'a Expr) -> Found<Val> {
        self.step(e.span)?;
        if self.depth >= DEPTH {
            let error = self.error(e.span, "calls nest too deeply here");
            return Err(Box::new(error));
        }
        self.depth += 1;
        let found = self.evaluate(e);
        self.depth -= 1;
        found
    }

    fn evaluate(&mut self, e: &'a Expr) -> Found<Val> {
        let span = e.span;
        match &e.kind {
            ExprKind::Error => Err(self.confused(span)),
            ExprKind::Int(i) => Ok(Val::Node(self.int(*i, span))),
            ExprKind::Real(r) => Ok(Val::Node(self.real(*r, span))),
            ExprKind::Bool(v) => Ok(Val::Node(self.bool(*v, span))),
            ExprKind::None => Ok(Val::Optional {
                present: self.bool(false, span),
                value: Rc::new(Val::Undefined),
            }),
            ExprKind::Local(id) => Ok(match self.frame.get(id.0) {
                Some(&Val::Number(number)) => Val::Node(self.int(number, span)),
                value => value.cloned().unwrap_or(Val::Undefined),
            }),
            ExprKind::Param(id) => match self.params.get(id.0) {
                Some(value) => Ok(value.clone()),
                None => {
                    let param = self.program.params.get(id.0);
                    let (what, name) = param.map_or(("param", ""), |p| (p.what(), &p.name));
                    let message = format!("a constant cannot depend on the {what} `{name}`");
                    Err(Box::new(self.error(span, message)))
                }
            },
            ExprKind::Const(id) => self.constant_item(*id, span),
            ExprKind::Map(id) => Ok(Val::Map(*id)),
            ExprKind::Scene(id) => Ok(Val::Scene(*id)),
            ExprKind::Known(known) => Ok(Val::Node(match known {
                Known::Picture => return self.picture_number(span),
                Known::Input => return self.input(span),
                Known::Inks => self.int(self.image.palette.len() as i32, span),
                Known::Width => self.int(self.image.width as i32, span),
                Known::Height => self.int(self.image.height as i32, span),
                Known::Offset => self.real(self.options.offset, span),
                Known::Floats => self.bool(self.options.floats, span),
                Known::Mantissas => self.bool(self.options.mantissas, span),
                Known::Epsilon => self.real(self.options.epsilon, span),
                Known::Samples => {
                    let most = self.options.ways.samples.unwrap_or(u32::MAX);
                    self.int(i32::try_from(most).unwrap_or(i32::MAX), span)
                }
            })),
            ExprKind::Function(callee) => Ok(Val::Function(callee.clone())),
            ExprKind::Tuple(parts) => {
                let parts: Found<Vec<Val>> = parts.iter().map(|p| self.expr(p)).collect();
                Ok(Val::parts(parts?))
            }
            ExprKind::Table { width, entries } => {
                let entries: Found<Vec<Val>> = entries.iter().map(|p| self.expr(p)).collect();
                Ok(Val::Table(Rc::new(Table {
                    name: "table".into(),
                    width: *width,
                    entries: entries?,
                })))
            }
            ExprKind::Convert(inner) => {
                let value = self.expr(inner)?;
                self.convert(value, &inner.ty, &e.ty, span)
            }
            ExprKind::Unary(op, of) => self.unary(*op, of, span),
            ExprKind::Binary(op, a, b) => self.binary(*op, a, b, span),
            ExprKind::Call { callee, args } => self.call(callee, args, &e.ty, span),
            ExprKind::Part(base, at) if base.kind == ExprKind::Known(Known::Input) => {
                Ok(Val::Node(self.held(*at, span)?))
            }
            ExprKind::Part(base, at) => {
                let base = self.expr(base)?;
                self.part(base, *at, span)
            }
            ExprKind::Swizzle(base, places) => {
                let base = self.expr(base)?;
                if let [at] = places[..] {
                    return self.part(base, at, span);
                }
                let places = places.iter();
                let parts: Found<Vec<Val>> = places
                    .map(|&at| self.part(base.clone(), at, span))
                    .collect();
                Ok(Val::parts(parts?))
            }
            ExprKind::Index(base, indices) => self.index(base, indices, span),
            ExprKind::If { .. } | ExprKind::IfLet { .. } | ExprKind::Block { .. } => {
                let leaf = self.tail(e)?;
                Ok(leaf.done)
            }
            ExprKind::Loop {
                carried,
                max,
                body,
                otherwise,
            } => self.loop_(carried, max, body, otherwise, &e.ty, span),
            ExprKind::Each(each) => self.joined_each(each, span),
            ExprKind::Next(_) => Err(self.confused(span)),
        }
    }

    /// A constant, evaluated once.
    pub(super) fn constant_item(&mut self, id: ConstId, span: crate::source::Span) -> Found<Val> {
        if let Some(value) = self.consts.get(&id) {
            return Ok(value.clone());
        }
        let Some(item) = self.program.consts.get(id.0) else {
            return Err(self.confused(span));
        };
        let value = self.constant_body(&item.body)?;
        if !self.is_constant(&value)? {
            let message = format!("`{}` is not constant", item.name);
            let error = self.error(item.body.value.span, message);
            return Err(Box::new(error.help("make it a function")));
        }
        let value = match value {
            Val::Table(table) => Val::Table(Rc::new(Table {
                name: item.name.clone(),
                width: table.width,
                entries: table.entries.clone(),
            })),
            other => other,
        };
        self.consts.insert(id, value.clone());
        Ok(value)
    }

    /// A body that stands outside of every function.
    pub(super) fn constant_body(&mut self, body: &'a Body) -> Found<Val> {
        self.constant += 1;
        let place = self.place.take();
        let found = self.enter(body, Vec::new(), |l| {
            let value = l.expr(&body.value)?;
            l.force(value)
        });
        self.place = place;
        self.constant -= 1;
        found
    }

    /// The int that an expression must be when compiling.
    pub(super) fn known_int(&mut self, e: &'a Expr, what: &str) -> Found<i32> {
        let value = self.expr(e)?;
        let node = self.node(value, &Ty::Int, e.span)?;
        match self.b.value(node) {
            Some(value) => Ok(value.int()),
            None => {
                let error = self.error(e.span, format!("{what} must be constant"));
                let help = "it may use numbers, `const`s and functions of these, but no param and \
                            nothing of the pixel";
                Err(Box::new(error.help(help)))
            }
        }
    }
}
