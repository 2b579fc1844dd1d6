//! Items' bodies.

use super::names::Entity;
use super::{Checker, Context, Pending, State};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree::{self, ItemKind};

impl<'a> Checker<'a> {
    /// Checks every body.
    pub(super) fn bodies(&mut self) {
        for k in 0..self.consts.len() {
            self.constant(ConstId(k));
        }
        for k in 0..self.scenes.len() {
            self.scene(SceneId(k));
        }
        for (library, work) in std::mem::take(&mut self.pending) {
            match work {
                Pending::Function(id, tree, otherwise) => {
                    self.function_body(id, tree, otherwise, library);
                }
                Pending::Shape(id, params, facets) => self.shape(id, params, facets, library),
                Pending::Record(id, fields) => {
                    let defaults = self.defaults(Entity::Record(id), fields, library);
                    for (k, default) in defaults {
                        self.program.records[id.0].fields[k].default = Some(default);
                    }
                }
                Pending::Param(id, tree) => self.param(id, tree, library),
                Pending::Draw(x, y, body, span) => self.draw(x, y, body, span),
            }
        }
    }

    pub(super) fn context(item: Entity, library: bool) -> Context {
        Context {
            item: Some(item),
            library,
            ..Context::default()
        }
    }

    /// A body of a known type with the given locals.
    pub(super) fn body(
        &mut self,
        cx: Context,
        locals: &[(String, Ty)],
        tree: &tree::Expr,
        want: Option<(&Ty, &str)>,
    ) -> Body {
        let (value, locals) = self.within(cx, |c| {
            for (name, ty) in locals {
                c.local(name, ty.clone());
            }
            let value = c.expr(tree, false);
            match want {
                Some((ty, what)) => c.coerce(value, ty, what),
                None => value,
            }
        });
        Body { locals, value }
    }

    /// A constant's type, found on demand.
    pub(super) fn constant(&mut self, id: ConstId) -> Ty {
        if let State::Todo(tree) = self.consts[id.0] {
            self.consts[id.0] = State::Busy;
            let library = self.program.consts[id.0].library;
            let before = (
                std::mem::take(&mut self.diagnostics),
                std::mem::take(&mut self.mentions),
            );
            let body = self.body(Self::context(Entity::Const(id), library), &[], tree, None);
            self.settle(before.0, before.1);
            self.program.consts[id.0].body = body;
            self.consts[id.0] = State::Done;
        }
        match self.consts[id.0] {
            State::Done => self.program.consts[id.0].body.value.ty.clone(),
            _ => Ty::Error,
        }
    }

    /// The defaults that bindings give, by place.
    fn defaults(
        &mut self,
        item: Entity,
        bindings: &[tree::Binding],
        library: bool,
    ) -> Vec<(usize, Body)> {
        let mut found = Vec::new();
        for (k, binding) in bindings.iter().enumerate() {
            let Some(tree) = &binding.default else {
                continue;
            };
            let ty = self
                .params_of(item)
                .get(k)
                .map_or(Ty::Error, |p| p.ty.clone());
            let what = format!("the default of `{}`", binding.name.text);
            let cx = Self::context(item, library);
            found.push((k, self.body(cx, &[], tree, Some((&ty, &what)))));
        }
        found
    }

    fn locals_of(&self, item: Entity) -> Vec<(String, Ty)> {
        let params = self.params_of(item).iter();
        params.map(|p| (p.name.clone(), p.ty.clone())).collect()
    }

    fn function_body(
        &mut self,
        id: FunctionId,
        tree: &tree::Function,
        otherwise: Option<&tree::Expr>,
        library: bool,
    ) {
        let item = Entity::Function(id);
        for (k, default) in self.defaults(item, &tree.params, library) {
            self.program.functions[id.0].params[k].default = Some(default);
        }
        let locals = self.locals_of(item);
        let result = self.program.functions[id.0].result.clone();
        let what = format!("the result of `{}`", tree.name.text);
        let mut cx = Self::context(item, library);
        cx.dither = self.program.functions[id.0].kind == FunctionKind::Dither;
        let body = self.body(cx, &locals, &tree.body, Some((&result, &what)));
        self.program.functions[id.0].body = body;
        if let Some(otherwise) = otherwise {
            let what = format!("what replaces `{}`", tree.name.text);
            let cx = Self::context(item, library);
            let otherwise = self.body(cx, &locals, otherwise, Some((&result, &what)));
            self.program.functions[id.0].kind = FunctionKind::Effect { otherwise };
        }
    }

    fn shape(
        &mut self,
        id: ShapeId,
        params: &[tree::Binding],
        trees: &[tree::Facet],
        library: bool,
    ) {
        let item = Entity::Shape(id);
        for (k, default) in self.defaults(item, params, library) {
            self.program.shapes[id.0].params[k].default = Some(default);
        }
        let mut facets: Vec<Facet> = Vec::new();
        for tree in trees {
            let (kind, argument, result) = match tree.name.text.as_str() {
                "dist" => (FacetKind::Dist, Some(Ty::Vector(3)), Ty::Real),
                "f" => (FacetKind::Implicit, Some(Ty::Vector(3)), Ty::Real),
                "hit" => (FacetKind::Hit, Some(Ty::Ray), Ty::Real.optional()),
                "crossing" => (FacetKind::Crossing, Some(Ty::Ray), Ty::Real.optional()),
                "normal" => (FacetKind::Normal, Some(Ty::Vector(3)), Ty::Vector(3)),
                "bound" => (FacetKind::Bound, None, Ty::Shape),
                "steps" => (FacetKind::Steps, None, Ty::Int),
                other => {
                    let names = ["dist", "f", "hit", "crossing", "normal", "bound", "steps"];
                    let message = format!("a shape has no facet `{other}`");
                    let help = self.among(other, names.into_iter());
                    let help = help.or(Some(
                        "facets are dist, f, hit, crossing, normal, bound and steps".into(),
                    ));
                    let mut error = Diagnostic::error(tree.name.span, message);
                    error.help = help;
                    self.report(error);
                    continue;
                }
            };
            if let Some(first) = facets.iter().find(|f| f.kind == kind) {
                let message = format!("two facets are called `{}`", kind.name());
                let error = Diagnostic::error(tree.name.span, message);
                let error = error.also(first.span, "the first is here");
                self.report(error);
                continue;
            }
            if argument.is_some() != tree.argument.is_some() {
                let form = match kind {
                    FacetKind::Hit => "hit(r) = ..",
                    FacetKind::Crossing => "crossing(r) = ..",
                    FacetKind::Bound => "bound = ..",
                    FacetKind::Steps => "steps = ..",
                    _ => "dist(p), f(p) and normal(p) take a point",
                };
                let message = format!("`{}` is not written like this", kind.name());
                self.report(Diagnostic::error(tree.name.span, message).help(form));
                continue;
            }
            let mut locals = self.locals_of(item);
            if let (Some(ty), Some(name)) = (argument, &tree.argument) {
                locals.push((name.text.clone(), ty));
            }
            let what = format!("`{}`", kind.name());
            let cx = Self::context(item, library);
            let mut body = self.body(cx, &locals, &tree.body, None);
            let result = match kind {
                // A solution may know the point and the normal too.
                FacetKind::Hit if is_hit(&body.value.ty) => Ty::Hit(None).optional(),
                _ => result,
            };
            body.value = self.coerce(body.value, &result, &what);
            facets.push(Facet {
                kind,
                body,
                span: tree.name.span,
            });
        }
        let surface = |f: &Facet| {
            matches!(
                f.kind,
                FacetKind::Dist | FacetKind::Implicit | FacetKind::Hit
            )
        };
        if !facets.iter().any(surface) && facets.len() == trees.len() {
            let span = self.program.shapes[id.0].span;
            let error = Diagnostic::error(span, "this shape has no surface");
            self.report(error.help("give it `dist(p)`, `f(p)` or `hit(r)`"));
        }
        self.program.shapes[id.0].facets = facets;
    }

    fn param(&mut self, id: ParamId, tree: &tree::Param, library: bool) {
        let item = Entity::Param(id);
        let ty = self.program.params[id.0].ty.clone();
        let name = &tree.name.text;
        let mut body = |tree: &tree::Expr, what: &str| {
            let cx = Self::context(item, library);
            let what = format!("the {what} of `{name}`");
            self.body(cx, &[], tree, Some((&ty, &what)))
        };
        let value = body(&tree.value, "value");
        // A bool has none: what stands there is not looked at.
        let range = tree.range.as_ref().filter(|_| ty != Ty::Bool);
        let range = range.map(|(lo, hi)| (body(lo, "least value"), body(hi, "greatest value")));
        // A state is made of others and of itself: that is no cycle, as it is of the picture
        // before.
        let next = tree.next.as_ref().map(|next| {
            let cx = Self::context(Entity::Draw, library);
            let what = format!("the next value of `{name}`");
            self.body(cx, &[], next, Some((&ty, &what)))
        });
        if next.is_some() && range.is_none() && !matches!(ty, Ty::Bool | Ty::Error) {
            let message = format!("the state `{name}` has no range");
            let error = Diagnostic::error(tree.name.span, message);
            self.report(
                error.help("say how far it may go: `.. = start in least .. greatest -> next;`"),
            );
        }
        if let (Ty::Bool, Some((least, _))) = (&ty, &tree.range) {
            let what = self.program.params[id.0].what();
            let message = format!("the {what} `{name}` is a bool, which has no range");
            let error = Diagnostic::error(least.span, message);
            self.report(error.help("leave the `in` and its range out"));
        }
        let param = &mut self.program.params[id.0];
        (param.value, param.range, param.next) = (value, range, next);
    }

    fn draw(&mut self, x: &tree::Name, y: &tree::Name, tree: &tree::Expr, span: Span) {
        if x.text == y.text {
            let error = Diagnostic::error(y.span, "the column and the row have one name");
            self.report(error.also(x.span, "the first is here"));
        }
        let locals = [(x.text.clone(), Ty::Int), (y.text.clone(), Ty::Int)];
        let cx = Self::context(Entity::Draw, false);
        let want = Some((&Ty::Ink, "what `draw` draws"));
        let body = self.body(cx, &locals, tree, want);
        if self.program.draw.is_none() {
            self.program.draw = Some(Draw { body, span });
        }
    }

    /// A scene needs an image and a picture.
    pub(super) fn complete(&mut self, files: &[(tree::File, bool)]) {
        let number = files.iter().position(|(_, library)| !library).unwrap_or(0);
        let place = Span::new(u16::try_from(number).unwrap_or(0), 0, 0);
        let user = || files.iter().filter(|f| !f.1).flat_map(|f| &f.0.items);
        if !user().any(|i| matches!(i.kind, ItemKind::Image(_))) {
            let error = Diagnostic::error(place, "the scene has no `image`");
            self.report(error.help("add `image 320 x 256 inks black, white;`"));
        }
        if !user().any(|i| matches!(i.kind, ItemKind::Draw { .. })) {
            let error = Diagnostic::error(place, "the scene has no `draw`");
            self.report(error.help("add `draw (x, y) = ink(0);`"));
        }
    }
}

/// Whether a value is a hit, present or not.
fn is_hit(ty: &Ty) -> bool {
    match ty {
        Ty::Optional(inner) => is_hit(inner),
        other => matches!(other, Ty::Hit(_)),
    }
}
