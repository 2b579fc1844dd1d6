//! The walk over a file with the local names in sight, innermost last.

use super::{Def, Kind, Names, Types, Use, place};
use slowlight_compiler::sema::Ty;
use slowlight_compiler::source::Span;
use slowlight_compiler::syntax::tree::*;

/// What an item declares at the top.
pub struct Head<'t> {
    pub name: &'t Name,
    pub kind: Kind,
    pub bindings: &'t [Binding],
    pub value: Option<Span>,
    pub ty: Option<Span>,
}

/// An item's name, as what, and its parameters or fields.
pub fn head(item: &Item) -> Option<Head<'_>> {
    let function = |f: &'_ Function, kind| (kind, None, Some(f.result.span));
    let (name, bindings, (kind, value, ty)) = match &item.kind {
        ItemKind::Fn(f) => (&f.name, &f.params[..], function(f, Kind::Function)),
        ItemKind::Dither(f) => (&f.name, &f.params[..], function(f, Kind::Dither)),
        ItemKind::Effect { function: f, .. } => (&f.name, &f.params[..], function(f, Kind::Effect)),
        ItemKind::Shape { name, params, .. } => (name, &params[..], (Kind::Shape, None, None)),
        ItemKind::Record { name, fields } => (name, &fields[..], (Kind::Record, None, None)),
        ItemKind::Param(p) => {
            let ty = Some(p.ty.span);
            let kind = p.next.as_ref().map_or(Kind::Param, |_| Kind::State);
            (&p.name, &[][..], (kind, Some(p.value.span), ty))
        }
        ItemKind::Const { name, value } => (name, &[][..], (Kind::Const, Some(value.span), None)),
        ItemKind::Scene { name, .. } => (name, &[][..], (Kind::Scene, None, None)),
        ItemKind::Map { name, .. } => (name, &[][..], (Kind::Map, None, None)),
        ItemKind::Image(_) | ItemKind::Draw { .. } | ItemKind::Use { .. } => return None,
    };
    Some(Head {
        name,
        kind,
        bindings,
        value,
        ty,
    })
}

/// Resolves the names of a file.
pub fn file(names: &mut Names, types: &Types, file: &File, library: bool) {
    let mut walk = Walk {
        names,
        types,
        library,
        scope: Vec::new(),
    };
    for item in &file.items {
        walk.item(item);
        walk.scope.clear();
    }
}

/// Where a local's type comes from.
enum Of {
    /// The expression that it is bound to.
    Value(Span),
    /// The language.
    Type(&'static str),
}

struct Walk<'w> {
    names: &'w mut Names,
    types: &'w Types,
    library: bool,
    /// The locals in sight.
    scope: Vec<usize>,
}

impl Walk<'_> {
    /// Declares a local that is seen in a place from here on.
    fn local(&mut self, name: &Name, kind: Kind, seen: Span, of: Of) {
        let (value, fixed) = match of {
            Of::Value(span) => (Some(span), ""),
            Of::Type(fixed) => (None, fixed),
        };
        let number = self.names.declare(Def {
            name: name.text.clone(),
            span: name.span,
            kind,
            of: None,
            seen,
            value,
            ty: None,
            fixed,
            library: self.library,
        });
        self.scope.push(number);
    }

    fn mention(&mut self, span: Span, to: Vec<usize>) {
        if !to.is_empty() {
            self.names.uses.push(Use { span, to });
        }
    }

    fn find(&self, name: &str) -> Option<usize> {
        let known = |k: &&usize| self.names.defs.get(**k).is_some_and(|d| d.name == name);
        self.scope.iter().rev().find(known).copied()
    }

    fn items(&self, name: &str, wanted: impl Fn(Kind) -> bool) -> Vec<usize> {
        let mut all = self.names.items(name, self.library);
        all.retain(|k| self.names.defs.get(*k).is_some_and(|d| wanted(d.kind)));
        all
    }

    /// Items of a name, that first which the checker chose for the expression; none where it
    /// chose what the language itself has.
    fn chosen(&self, mut all: Vec<usize>, expr: Span) -> Vec<usize> {
        match self.types.called.get(&place(expr)) {
            Some(None) => all.clear(),
            Some(Some(span)) => {
                if let Some(found) = self.names.def_at(*span) {
                    all.retain(|k| *k != found);
                    all.insert(0, found);
                }
            }
            None => {}
        }
        all
    }

    fn ty(&mut self, ty: &Type) {
        match &ty.kind {
            TypeKind::Name(name) => {
                let records = self.items(name, |kind| kind == Kind::Record);
                self.mention(ty.span, records);
            }
            TypeKind::Table(of) | TypeKind::Optional(of) => self.ty(of),
            TypeKind::Function(args, result) => {
                args.iter().for_each(|a| self.ty(a));
                self.ty(result);
            }
            TypeKind::Error => {}
        }
    }

    fn item(&mut self, item: &Item) {
        if let Some(head) = head(item) {
            for binding in head.bindings {
                self.ty(&binding.ty);
                // What stands in does not see the other parameters.
                binding.default.iter().for_each(|value| self.expr(value));
            }
            if let Some(def) = self.names.def_at(head.name.span)
                && head.kind != Kind::Record
            {
                self.scope.extend_from_slice(self.names.parts(def));
            }
        }
        match &item.kind {
            ItemKind::Image(image) => {
                self.expr(&image.width);
                self.expr(&image.height);
            }
            ItemKind::Param(param) => {
                self.ty(&param.ty);
                self.expr(&param.value);
                if let Some((low, high)) = &param.range {
                    self.expr(low);
                    self.expr(high);
                }
                param.next.iter().for_each(|next| self.expr(next));
            }
            ItemKind::Const { value, .. } => self.expr(value),
            ItemKind::Fn(function) | ItemKind::Dither(function) => {
                self.ty(&function.result);
                self.expr(&function.body);
            }
            ItemKind::Effect {
                function,
                otherwise,
            } => {
                self.ty(&function.result);
                self.expr(otherwise);
                self.expr(&function.body);
            }
            ItemKind::Shape { facets, .. } => {
                for facet in facets {
                    let before = self.scope.len();
                    if let Some(name) = &facet.argument {
                        let ty = match facet.name.text.as_str() {
                            "hit" => "ray",
                            _ => "vec3",
                        };
                        self.local(name, Kind::Local, facet.body.span, Of::Type(ty));
                    }
                    self.expr(&facet.body);
                    self.scope.truncate(before);
                }
            }
            ItemKind::Scene { members, .. } => self.members(members, item.span),
            ItemKind::Map { cells, .. } => cells.iter().for_each(|(_, value)| self.expr(value)),
            ItemKind::Draw { x, y, body } => {
                self.local(x, Kind::Local, body.span, Of::Type("int"));
                self.local(y, Kind::Local, body.span, Of::Type("int"));
                self.expr(body);
            }
            ItemKind::Record { .. } | ItemKind::Use { .. } => {}
        }
    }

    fn members(&mut self, members: &[Member], around: Span) {
        for member in members {
            match member {
                Member::One { shape, tag } => {
                    self.expr(shape);
                    let Some(tag) = tag else {
                        continue;
                    };
                    let before = self.scope.len();
                    // It stands before the counters, which may hide it.
                    let point = Name {
                        text: "p".to_owned(),
                        span: Span::new(
                            tag.span.file,
                            tag.span.start as usize,
                            tag.span.start as usize,
                        ),
                    };
                    self.local(&point, Kind::Point, tag.span, Of::Type("vec3"));
                    self.scope.rotate_right(1);
                    self.expr(tag);
                    self.scope.remove(0);
                    self.scope.truncate(before);
                }
                Member::Each { counter, members } => {
                    self.expr(&counter.low);
                    self.expr(&counter.high);
                    let before = self.scope.len();
                    let last = members.last().map_or(counter.span, |m| match m {
                        Member::One { shape, tag } => tag.as_ref().map_or(shape.span, |t| t.span),
                        Member::Each { .. } => around,
                    });
                    self.local(
                        &counter.name,
                        Kind::Counter,
                        counter.span.to(last),
                        Of::Type("int"),
                    );
                    self.members(members, around);
                    self.scope.truncate(before);
                }
            }
        }
    }

    /// Names of arguments, of what a call is believed to call.
    fn args(&mut self, args: &[Argument], to: &[usize]) {
        for argument in args {
            if let Some(name) = &argument.name {
                let parts = to.iter().flat_map(|k| self.names.parts(*k));
                let named = |k: &&usize| {
                    self.names
                        .defs
                        .get(**k)
                        .is_some_and(|d| d.name == name.text)
                };
                let found: Vec<usize> = parts.filter(named).copied().collect();
                self.mention(name.span, found);
            }
            self.expr(&argument.value);
        }
    }

    /// The parts of a record's value with a name.
    fn field(&self, base: &Expr, name: &str) -> Vec<usize> {
        let records = match self.types.ty(base.span) {
            Some(Ty::Record(id)) => self.types.records.get(id.0).copied(),
            _ => None,
        };
        let record = records.and_then(|span| self.names.def_at(span));
        let parts = record.map_or(&[][..], |k| self.names.parts(k));
        let named = |k: &&usize| self.names.defs.get(**k).is_some_and(|d| d.name == name);
        parts.iter().filter(named).copied().collect()
    }

    fn expr(&mut self, expr: &Expr) {
        let before = self.scope.len();
        match &expr.kind {
            ExprKind::Name(name) => {
                let to = match self.find(name) {
                    Some(local) => vec![local],
                    None => {
                        let values = self.items(name, |kind| !kind.callable());
                        let calls = || self.items(name, Kind::callable);
                        match values.is_empty() {
                            true => self.chosen(calls(), expr.span),
                            false => values,
                        }
                    }
                };
                self.mention(expr.span, to);
            }
            ExprKind::Call { name, args } => {
                let called = self.types.called.contains_key(&place(expr.span));
                let local = self.find(&name.text).filter(|_| !called);
                let to = match local {
                    Some(local) => vec![local],
                    None => self.chosen(self.items(&name.text, Kind::callable), expr.span),
                };
                self.mention(name.span, to.clone());
                self.args(args, &to);
            }
            ExprKind::Method {
                receiver,
                name,
                args,
            } => {
                self.expr(receiver);
                let to = self.chosen(self.items(&name.text, Kind::callable), expr.span);
                self.mention(name.span, to.clone());
                self.args(args, &to);
            }
            ExprKind::Field { base, name } => {
                self.expr(base);
                let to = self.field(base, &name.text);
                self.mention(name.span, to);
            }
            ExprKind::If {
                binding,
                condition,
                yes,
                no,
            } => {
                self.expr(condition);
                if let Some(name) = binding {
                    self.local(name, Kind::Local, yes.span, Of::Value(condition.span));
                }
                self.expr(yes);
                self.scope.truncate(before);
                self.expr(no);
            }
            ExprKind::Loop {
                carried,
                max,
                body,
                otherwise,
            } => {
                carried.iter().for_each(|(_, start)| self.expr(start));
                self.expr(max);
                for (name, start) in carried {
                    let seen = body.span.to(otherwise.span);
                    self.local(name, Kind::Local, seen, Of::Value(start.span));
                }
                self.expr(body);
                self.expr(otherwise);
            }
            ExprKind::Each(each) => {
                let to = self.chosen(self.items(&each.name.text, Kind::callable), expr.span);
                let called = self.types.called.contains_key(&place(expr.span));
                let local = self.find(&each.name.text).filter(|_| !called);
                let to = local.map_or(to, |local| vec![local]);
                self.mention(each.name.span, to.clone());
                self.args(&each.args, &to);
                self.expr(&each.counter.low);
                self.expr(&each.counter.high);
                self.local(
                    &each.counter.name,
                    Kind::Counter,
                    each.body.span,
                    Of::Type("int"),
                );
                self.expr(&each.body);
            }
            ExprKind::Block { statements, result } => {
                for statement in statements {
                    match statement {
                        Statement::Let { name, value, .. } => {
                            self.expr(value);
                            let end = Span::new(
                                value.span.file,
                                value.span.end as usize,
                                expr.span.end as usize,
                            );
                            self.local(name, Kind::Local, end, Of::Value(value.span));
                        }
                        Statement::Spread { value, to, .. } => {
                            self.expr(value);
                            to.iter().for_each(|(at, weight)| {
                                self.expr(at);
                                self.expr(weight);
                            });
                        }
                    }
                }
                self.expr(result);
            }
            _ => slowlight_compiler::syntax::walk::children(expr, &mut |inner| self.expr(inner)),
        }
        self.scope.truncate(before);
    }
}
