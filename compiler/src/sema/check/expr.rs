//! Expressions: literals, names, parts.

use super::names::{Entity, KNOWN, type_of};
use super::{Checker, DEPTH, STEPS};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree::{self, AngleUnit, ExprKind as Tree, UnaryOp};
use std::f64::consts::PI;

impl<'a> Checker<'a> {
    /// Checks an expression; `tail` says whether the innermost loop's `next`
    /// may stand here.
    pub(super) fn expr(&mut self, tree: &tree::Expr, tail: bool) -> Expr {
        self.steps += 1;
        if self.steps > STEPS {
            if self.steps == STEPS + 1 {
                self.error(tree.span, "the scene is too large to check");
            }
            return Expr::error(tree.span);
        }
        if self.depth >= DEPTH {
            self.error(tree.span, "this is nested too deeply");
            return Expr::error(tree.span);
        }
        self.depth += 1;
        let found = self.expr_inner(tree, tail);
        self.depth -= 1;
        if let Some(noted) = &mut self.noted
            && !self.cx.library
        {
            noted.insert(found.span, found.ty.clone());
        }
        found
    }

    fn expr_inner(&mut self, tree: &tree::Expr, tail: bool) -> Expr {
        let span = tree.span;
        let make = |kind, ty| Expr { kind, ty, span };
        match &tree.kind {
            Tree::Error => Expr::error(span),
            Tree::Int(value) => self.int(*value, span),
            Tree::Real(value) => match value.is_finite() {
                true => make(ExprKind::Real(*value), Ty::Real),
                false => {
                    self.error(span, "this number is too large");
                    Expr::error(span)
                }
            },
            Tree::Angle(value, unit) => {
                let turns = match unit {
                    AngleUnit::Deg => value / 360.0,
                    AngleUnit::Turn => *value,
                    AngleUnit::Rad => return make(ExprKind::Real(*value), Ty::Angle),
                };
                make(ExprKind::Real(2.0 * PI * turns), Ty::Angle)
            }
            Tree::Bool(value) => make(ExprKind::Bool(*value), Ty::Bool),
            Tree::None => make(ExprKind::None, Ty::Optional(Box::new(Ty::Never))),
            Tree::Name(name) => self.name(name, span),
            Tree::Tuple(parts) => self.tuple(parts, span),
            Tree::Table(rows) => self.table(rows, span),
            Tree::Unary(UnaryOp::Neg, of) if matches!(of.kind, Tree::Int(v) if v == 2f64.powi(31)) => {
                make(ExprKind::Int(i32::MIN), Ty::Int)
            }
            Tree::Unary(op, of) => self.unary(*op, of, span),
            Tree::Binary(op, left, right) => self.binary(*op, left, right, span),
            Tree::Call { name, args } => self.call(name, None, args, span),
            Tree::Method {
                receiver,
                name,
                args,
            } => self.call(name, Some(receiver), args, span),
            Tree::Field { base, name } => self.field(base, name, span),
            Tree::Index { base, indices } => self.index(base, indices, span),
            Tree::If {
                binding,
                condition,
                yes,
                no,
            } => self.condition(binding.as_ref(), condition, yes, no, tail, span),
            Tree::Loop {
                carried,
                max,
                body,
                otherwise,
            } => self.loop_(carried, max, body, otherwise, span),
            Tree::Each(each) => self.each(each, span),
            Tree::Next(values) => self.next(values, tail, span),
            Tree::Block { statements, result } => self.block(statements, result, tail, span),
        }
    }

    fn int(&mut self, value: f64, span: Span) -> Expr {
        if value > f64::from(i32::MAX) {
            let error = Diagnostic::error(span, "this number does not fit in an int");
            self.report(error.help(format!(
                "ints are 32 bits, at most {}; write `.0` after it for a real",
                i32::MAX
            )));
            return Expr::error(span);
        }
        Expr {
            kind: ExprKind::Int(value as i32),
            ty: Ty::Int,
            span,
        }
    }

    fn name(&mut self, name: &str, span: Span) -> Expr {
        if let Some(id) = self.find_local(name) {
            let ty = self.cx.locals[id.0].ty.clone();
            let kind = ExprKind::Local(id);
            return Expr { kind, ty, span };
        }
        let entities = self.entities(name);
        let value = entities.iter().copied().find(|e| !e.callable());
        let Some(entity) = value else {
            return self.function_value(name, &entities, span);
        };
        self.mention(entity, span);
        let (kind, ty) = match entity {
            Entity::Const(id) => (ExprKind::Const(id), self.constant(id)),
            Entity::Param(id) => {
                if let Some(Entity::Const(_)) = self.cx.item {
                    let what = self.program.params[id.0].what();
                    let error = Diagnostic::error(
                        span,
                        format!("a constant cannot depend on the {what} `{name}`"),
                    );
                    self.report(error.help("make it a function, or a `let` in `draw`"));
                }
                (ExprKind::Param(id), self.program.params[id.0].ty.clone())
            }
            Entity::Scene(id) => (ExprKind::Scene(id), self.scene(id)),
            Entity::Map(id) => (ExprKind::Map(id), Ty::Map),
            Entity::Known(k) => match KNOWN.get(k) {
                Some((_, Known::Picture | Known::Input)) if self.in_constant() => {
                    self.no_constant(name, span);
                    (ExprKind::Error, Ty::Error)
                }
                Some((_, known)) => (ExprKind::Known(*known), type_of(*known, &self.program)),
                None => (ExprKind::Error, Ty::Error),
            },
            _ => (ExprKind::Error, Ty::Error),
        };
        Expr { kind, ty, span }
    }

    fn in_constant(&self) -> bool {
        matches!(self.cx.item, Some(Entity::Const(_) | Entity::Param(_)))
    }

    fn no_constant(&mut self, name: &str, span: Span) {
        let message = format!("a constant cannot depend on `{name}`");
        let error = Diagnostic::error(span, message);
        self.report(error.help("make it a function, or a `let` in `draw`"));
    }

    /// A function's name as a value.
    fn function_value(&mut self, name: &str, entities: &[Entity], span: Span) -> Expr {
        let mut functions = entities.iter().copied().filter_map(|e| match e {
            Entity::Function(id) => Some((e, id)),
            _ => None,
        });
        let (first, second) = (functions.next(), functions.next());
        match (first, second) {
            (Some((entity, id)), None) => {
                self.mention(entity, span);
                let function = &self.program.functions[id.0];
                let args = function.params.iter().map(|p| p.ty.clone()).collect();
                let ty = Ty::Function(args, Box::new(function.result.clone()));
                let kind = ExprKind::Function(Callee::Function(id));
                Expr { kind, ty, span }
            }
            (Some(_), Some(_)) => {
                let message = format!("several functions are called `{name}`");
                let error = Diagnostic::error(span, message);
                self.report(error.help("wrap the one that you mean in a function of its own"));
                Expr::error(span)
            }
            _ => {
                self.unknown_value(name, span);
                Expr::error(span)
            }
        }
    }

    fn tuple(&mut self, parts: &[tree::Expr], span: Span) -> Expr {
        let mut found = Vec::new();
        for part in parts {
            let value = self.expr(part, false);
            found.push(self.coerce(value, &Ty::Real, "a vector's component"));
        }
        let ty = match found.len() {
            2 => Ty::Vector(2),
            3 => Ty::Vector(3),
            n => {
                let error = Diagnostic::error(span, format!("no vector has {n} components"));
                self.report(error.help("vectors have 2 or 3"));
                return Expr::error(span);
            }
        };
        let kind = ExprKind::Tuple(found);
        Expr { kind, ty, span }
    }

    fn table(&mut self, rows: &[Vec<tree::Expr>], span: Span) -> Expr {
        let width = rows.first().map_or(0, Vec::len);
        if width == 0 {
            self.error(span, "a table has at least one entry");
            return Expr::error(span);
        }
        let mut entries = Vec::new();
        let mut joined = Ty::Never;
        for row in rows {
            if row.len() != width {
                let place = row.first().map_or(span, |e| e.span);
                let message = format!(
                    "this row has {}, the first has {width}",
                    super::call::entries(row.len())
                );
                self.error(place, message);
                return Expr::error(span);
            }
            for tree in row {
                let value = self.expr(tree, false);
                match joined.join(&value.ty) {
                    Some(ty) => joined = ty,
                    None => {
                        let message = format!(
                            "this entry is {}, an earlier one {}",
                            self.a(&value.ty),
                            self.a(&joined)
                        );
                        self.error(value.span, message);
                        joined = Ty::Error;
                    }
                }
                entries.push(value);
            }
        }
        let entries = entries.into_iter();
        let entries = entries.map(|e| super::widen(e, &joined)).collect();
        Expr {
            kind: ExprKind::Table { width, entries },
            ty: match joined {
                Ty::Error => Ty::Error,
                joined => Ty::Table(Box::new(joined)),
            },
            span,
        }
    }

    fn field(&mut self, base: &tree::Expr, name: &tree::Name, span: Span) -> Expr {
        let base = self.expr(base, false);
        let wanted = name.text.as_str();
        let place = |names: &[&str]| names.iter().position(|n| *n == wanted);
        let found = match &base.ty {
            Ty::Error => return Expr::error(span),
            Ty::Vector(size) => return self.swizzle(base.clone(), usize::from(*size), name, span),
            Ty::Ray => place(&RAY_PARTS).map(|k| (k, Ty::Vector(3))),
            Ty::Hit(tag) => match (place(&HIT_PARTS), tag) {
                (Some(3), None) => {
                    let error = Diagnostic::error(name.span, "this hit has no tag");
                    self.report(error.help(
                        "hits of a scene have one where the scene is known; pass `h.tag` as an argument",
                    ));
                    return Expr::error(span);
                }
                (Some(3), Some(tag)) => Some((3, (**tag).clone())),
                (Some(2), _) => Some((2, Ty::Real)),
                (Some(k), _) => Some((k, Ty::Vector(3))),
                (None, _) => None,
            },
            Ty::Record(id) => {
                let fields = &self.program.records[id.0].fields;
                let at = fields.iter().position(|f| f.name == wanted);
                at.map(|k| (k, fields[k].ty.clone()))
            }
            _ => None,
        };
        match found {
            Some((k, ty)) => Expr {
                kind: ExprKind::Part(Box::new(base), k),
                ty,
                span,
            },
            None => {
                self.no_part(&base, name);
                Expr::error(span)
            }
        }
    }

    fn no_part(&mut self, base: &Expr, name: &tree::Name) {
        let names: Vec<String> = match &base.ty {
            Ty::Ray => RAY_PARTS.iter().map(|p| (*p).to_owned()).collect(),
            Ty::Hit(_) => HIT_PARTS.iter().map(|p| (*p).to_owned()).collect(),
            Ty::Record(id) => {
                let fields = &self.program.records[id.0].fields;
                fields.iter().map(|f| f.name.clone()).collect()
            }
            _ => Vec::new(),
        };
        let message = format!("{} has no part `{}`", self.a(&base.ty), name.text);
        let mut error = Diagnostic::error(name.span, message);
        error.help = match &base.ty {
            Ty::Optional(_) => Some("take it apart first: `if let v = .. then .. else ..`".into()),
            _ if self.is_method(&name.text, &base.ty) => {
                Some(format!("call it: `.{}(..)`", name.text))
            }
            _ if names.is_empty() => None,
            _ => self
                .among(&name.text, names.iter().map(String::as_str))
                .or_else(|| Some(format!("it has {}", names.join(", ")))),
        };
        self.report(error);
    }

    fn swizzle(&mut self, base: Expr, size: usize, name: &tree::Name, span: Span) -> Expr {
        let letters = ["x", "y", "z"];
        let letters = &letters[..size.min(3)];
        let parts: Option<Vec<usize>> = (name.text.chars())
            .map(|c| letters.iter().position(|l| l.starts_with(c)))
            .collect();
        let ty = match parts.as_ref().map(Vec::len) {
            Some(1) => Ty::Real,
            Some(2) => Ty::Vector(2),
            Some(3) => Ty::Vector(3),
            _ => {
                let message = format!("{} has no part `{}`", self.a(&base.ty), name.text);
                let mut error = Diagnostic::error(name.span, message);
                error.help = Some(match self.is_method(&name.text, &base.ty) {
                    true => format!("call it: `.{}(..)`", name.text),
                    false => format!("it has {}, or several such as `.xy`", letters.join(", ")),
                });
                self.report(error);
                return Expr::error(span);
            }
        };
        let kind = ExprKind::Swizzle(Box::new(base), parts.unwrap_or_default());
        Expr { kind, ty, span }
    }

    fn index(&mut self, base: &tree::Expr, indices: &[tree::Expr], span: Span) -> Expr {
        let base = self.expr(base, false);
        let mut found = Vec::new();
        for index in indices {
            let value = self.expr(index, false);
            found.push(self.coerce(value, &Ty::Int, "an index"));
        }
        let ty = match &base.ty {
            Ty::Error => return Expr::error(span),
            Ty::Table(of) if (1..=2).contains(&found.len()) => (**of).clone(),
            Ty::Map if found.len() == 2 => Ty::Int,
            Ty::Table(_) | Ty::Map => {
                let message = format!("{} indices, where a grid has two", found.len());
                let error = Diagnostic::error(span, message);
                self.report(error.help("tables are indexed `[column, row]`, maps `[x, y]`"));
                return Expr::error(span);
            }
            other => {
                let message = format!("{} cannot be indexed", self.a(other));
                self.error(base.span, message);
                return Expr::error(span);
            }
        };
        let kind = ExprKind::Index(Box::new(base), found);
        Expr { kind, ty, span }
    }
}
