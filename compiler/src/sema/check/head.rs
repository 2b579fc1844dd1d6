//! Items' heads: their names and the types that are written.

use super::names::Entity;
use super::{Checker, Context, Pending, SHARERS, State};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree::{self, ItemKind};
use std::collections::BTreeMap;

impl<'a> Checker<'a> {
    /// Declares every item of every file.
    pub(super) fn heads(&mut self, files: &'a [(tree::File, bool)]) {
        for (number, (_, library)) in files.iter().enumerate() {
            if *library && let Ok(number) = u16::try_from(number) {
                self.program.library_files.push(number);
            }
        }
        let mut declared: Vec<(Entity, &'a tree::Item, bool)> = Vec::new();
        for (file, library) in files {
            for item in &file.items {
                if let Some((entity, name)) = self.declare(item, *library) {
                    let layer = match library {
                        true => &mut self.layers.library,
                        false => &mut self.layers.user,
                    };
                    layer.entry(name.clone()).or_default().push(entity);
                    if !library {
                        self.told_of_hiding(entity, &name);
                    }
                    declared.push((entity, item, *library));
                }
            }
        }
        for (entity, item, library) in declared {
            self.cx.library = library;
            self.cx.item = Some(entity);
            self.signature(entity, item, library);
        }
        self.cx = Context::default();
        for library in [true, false] {
            self.duplicates(library);
        }
        let once = |wanted: fn(&ItemKind) -> bool, what: &str, checker: &mut Self| {
            let all = files.iter().flat_map(|(f, _)| &f.items);
            let mut spans = all.filter(|i| wanted(&i.kind)).map(|i| i.span);
            if let Some(first) = spans.next() {
                for span in spans {
                    let error = Diagnostic::error(span, format!("a scene has one `{what}`"));
                    checker.report(error.also(first, "the first is here"));
                }
            }
        };
        once(|k| matches!(k, ItemKind::Image(_)), "image", self);
        once(|k| matches!(k, ItemKind::Draw { .. }), "draw", self);
        for (file, library) in files {
            for item in &file.items {
                match &item.kind {
                    ItemKind::Image(image) if self.program.image.is_none() => {
                        self.cx.library = *library;
                        self.image(image, item.span);
                    }
                    ItemKind::Draw { x, y, body } => {
                        let draw = Pending::Draw(x, y, body, item.span);
                        self.pending.push((*library, draw));
                    }
                    _ => {}
                }
            }
        }
    }

    /// What a scene that moves asks by name is told of where an item hides it.
    fn told_of_hiding(&mut self, entity: Entity, name: &str) {
        let what = match name {
            "picture" => "the number of the picture",
            "input" => "what a player holds",
            _ => return,
        };
        if let Some(span) = self.span_of(entity) {
            let message = format!("this hides the language's own `{name}`, {what}");
            let warning = Diagnostic::warning(span, message);
            self.report(warning.help("give it another name, if that is not what you want"));
        }
    }

    /// Gives an item its number.
    fn declare(&mut self, item: &'a tree::Item, library: bool) -> Option<(Entity, String)> {
        let program = &mut self.program;
        let empty = || Body {
            locals: Vec::new(),
            value: Expr::error(item.span),
        };
        Some(match &item.kind {
            ItemKind::Param(param) => {
                program.params.push(Param {
                    name: param.name.text.clone(),
                    ty: Ty::Error,
                    value: empty(),
                    range: None,
                    next: param.next.is_some().then(empty),
                    span: param.name.span,
                });
                let id = ParamId(program.params.len() - 1);
                (Entity::Param(id), param.name.text.clone())
            }
            ItemKind::Const { name, value } => {
                program.consts.push(Const {
                    name: name.text.clone(),
                    library,
                    body: empty(),
                    span: name.span,
                });
                self.consts.push(State::Todo(value));
                let id = ConstId(program.consts.len() - 1);
                (Entity::Const(id), name.text.clone())
            }
            ItemKind::Fn(function) | ItemKind::Dither(function) => {
                self.function(item, function, library)
            }
            ItemKind::Effect { function, .. } => self.function(item, function, library),
            ItemKind::Shape { name, .. } => {
                program.shapes.push(Shape {
                    name: name.text.clone(),
                    library,
                    params: Vec::new(),
                    facets: Vec::new(),
                    span: name.span,
                });
                let id = ShapeId(program.shapes.len() - 1);
                (Entity::Shape(id), name.text.clone())
            }
            ItemKind::Scene { name, members } => {
                program.scenes.push(Scene {
                    name: name.text.clone(),
                    tag: None,
                    members: Vec::new(),
                    span: name.span,
                });
                self.scenes.push(State::Todo(members));
                let id = SceneId(program.scenes.len() - 1);
                (Entity::Scene(id), name.text.clone())
            }
            ItemKind::Record { name, .. } => {
                program.records.push(Record {
                    name: name.text.clone(),
                    library,
                    fields: Vec::new(),
                    span: name.span,
                });
                let id = RecordId(program.records.len() - 1);
                (Entity::Record(id), name.text.clone())
            }
            ItemKind::Map { name, .. } => {
                program.maps.push(Map {
                    name: name.text.clone(),
                    width: 1,
                    height: 1,
                    cells: vec![0],
                    span: name.span,
                });
                let id = MapId(program.maps.len() - 1);
                (Entity::Map(id), name.text.clone())
            }
            ItemKind::Image(_) | ItemKind::Draw { .. } | ItemKind::Use { .. } => return None,
        })
    }

    fn function(
        &mut self,
        item: &tree::Item,
        function: &tree::Function,
        library: bool,
    ) -> (Entity, String) {
        let empty = || Body {
            locals: Vec::new(),
            value: Expr::error(function.name.span),
        };
        let kind = match &item.kind {
            ItemKind::Dither(_) => FunctionKind::Dither,
            ItemKind::Effect { .. } => FunctionKind::Effect { otherwise: empty() },
            _ => FunctionKind::Plain,
        };
        self.program.functions.push(Function {
            name: function.name.text.clone(),
            library,
            kind,
            params: Vec::new(),
            result: Ty::Error,
            body: empty(),
            span: function.name.span,
        });
        let id = FunctionId(self.program.functions.len() - 1);
        (Entity::Function(id), function.name.text.clone())
    }

    /// Finds the written types of an item, and queues its bodies.
    fn signature(&mut self, entity: Entity, item: &'a tree::Item, library: bool) {
        let work = match (&item.kind, entity) {
            (ItemKind::Fn(f) | ItemKind::Dither(f), Entity::Function(id)) => {
                self.function_signature(id, f);
                if matches!(item.kind, ItemKind::Dither(_)) {
                    self.dither_signature(id, f);
                }
                Pending::Function(id, f, None)
            }
            (
                ItemKind::Effect {
                    function,
                    otherwise,
                },
                Entity::Function(id),
            ) => {
                self.function_signature(id, function);
                Pending::Function(id, function, Some(otherwise))
            }
            (ItemKind::Shape { params, facets, .. }, Entity::Shape(id)) => {
                let found = self.parameters(params);
                self.program.shapes[id.0].params = found;
                Pending::Shape(id, params, facets)
            }
            (ItemKind::Record { fields, .. }, Entity::Record(id)) => {
                let found = self.parameters(fields);
                for (field, binding) in found.iter().zip(fields) {
                    if !field.ty.is_data() {
                        let a = self.a(&field.ty);
                        self.error(binding.ty.span, format!("a record cannot hold {a}"));
                    }
                }
                self.program.records[id.0].fields = found;
                Pending::Record(id, fields)
            }
            (ItemKind::Param(param), Entity::Param(id)) => {
                let ty = self.ty(&param.ty);
                let allowed = matches!(
                    ty,
                    Ty::Bool | Ty::Int | Ty::Real | Ty::Angle | Ty::Vector(_) | Ty::Error
                );
                if !allowed {
                    let a = self.a(&ty);
                    let what = self.program.params[id.0].what();
                    let message = format!("a {what} cannot be {a}");
                    let error = Diagnostic::error(param.ty.span, message);
                    let help = format!("{what}s are bool, int, real, angle, vec2 or vec3");
                    self.report(error.help(help));
                }
                self.program.params[id.0].ty = if allowed { ty } else { Ty::Error };
                Pending::Param(id, param)
            }
            (ItemKind::Map { rows, cells, .. }, Entity::Map(id)) => {
                self.map(id, rows, cells, item.span);
                return;
            }
            _ => return,
        };
        self.pending.push((library, work));
    }

    fn function_signature(&mut self, id: FunctionId, function: &'a tree::Function) {
        let params = self.parameters(&function.params);
        let result = self.ty(&function.result);
        let found = &mut self.program.functions[id.0];
        (found.params, found.result) = (params, result);
    }

    /// A dither takes a shade and the pixel, and gives an ink.
    fn dither_signature(&mut self, id: FunctionId, tree: &tree::Function) {
        let found = &self.program.functions[id.0];
        let types: Vec<&Ty> = found.params.iter().map(|p| &p.ty).collect();
        let right = types == [&Ty::Real, &Ty::Int, &Ty::Int] && found.result == Ty::Ink;
        if !right && !types.contains(&&Ty::Error) && found.result != Ty::Error {
            let error = Diagnostic::error(
                tree.name.span,
                "a dither takes a shade and the pixel, and gives an ink",
            );
            let form = format!("dither {}(v: real, x: int, y: int) -> ink = ..", found.name);
            self.report(error.help(format!("write `{form}`")));
        }
    }

    /// Parameters with their types; defaults are checked later. Twice the same
    /// name is an error.
    fn parameters(&mut self, bindings: &[tree::Binding]) -> Vec<Parameter> {
        let mut seen: BTreeMap<&str, Span> = BTreeMap::new();
        let mut found = Vec::new();
        for binding in bindings {
            let name = binding.name.text.as_str();
            if let Some(&first) = seen.get(name) {
                let message = format!("two parameters are called `{name}`");
                let error = Diagnostic::error(binding.name.span, message);
                self.report(error.also(first, "the first is here"));
            }
            seen.entry(name).or_insert(binding.name.span);
            found.push(Parameter {
                name: name.to_owned(),
                ty: self.ty(&binding.ty),
                optional: binding.default.is_some(),
                default: None,
            });
        }
        found
    }

    /// Two items of one file with one name: only functions may, if their first
    /// arguments differ in type.
    fn duplicates(&mut self, library: bool) {
        let layer = match library {
            true => &self.layers.library,
            false => &self.layers.user,
        };
        let mut found = Vec::new();
        for (name, entities) in layer {
            for (k, &later) in entities.iter().enumerate() {
                let clash = |&&earlier: &&Entity| {
                    !(earlier.callable() && later.callable())
                        || self.first_type(earlier) == self.first_type(later)
                };
                if matches!(later, Entity::Builtin(_)) {
                    continue;
                }
                if let Some(&earlier) = entities[..k].iter().take(16).find(clash) {
                    found.push((name.clone(), earlier, later));
                }
            }
        }
        let many = |(name, list): (&String, &Vec<Entity>)| {
            let first = list.get(SHARERS).filter(|_| !library)?;
            Some((name.clone(), self.span_of(*first)?))
        };
        let crowds: Vec<(String, Span)> = layer.iter().filter_map(many).collect();
        for (name, span) in crowds {
            let message = format!("more than {SHARERS} items are called `{name}`");
            self.error(span, message);
        }
        for (name, earlier, later) in found {
            let (Some(first), Some(span)) = (self.span_of(earlier), self.span_of(later)) else {
                continue;
            };
            let error = Diagnostic::error(span, format!("two items are called `{name}`"));
            self.report(error.also(first, "the first is here").help(
                "rename one; functions may share a name if their first arguments differ in type",
            ));
        }
    }

    fn first_type(&self, entity: Entity) -> Option<Ty> {
        match entity {
            Entity::Builtin(k) => self.signatures.get(k)?.params.first().map(|p| p.1.clone()),
            _ => self.params_of(entity).first().map(|p| p.ty.clone()),
        }
    }

    /// The parameters of what can be called.
    pub(super) fn params_of(&self, entity: Entity) -> &[Parameter] {
        match entity {
            Entity::Function(id) => &self.program.functions[id.0].params,
            Entity::Shape(id) => &self.program.shapes[id.0].params,
            Entity::Record(id) => &self.program.records[id.0].fields,
            _ => &[],
        }
    }

    /// Where an item's name is written.
    pub(super) fn span_of(&self, entity: Entity) -> Option<Span> {
        let program = &self.program;
        Some(match entity {
            Entity::Function(id) => program.functions[id.0].span,
            Entity::Const(id) => program.consts[id.0].span,
            Entity::Param(id) => program.params[id.0].span,
            Entity::Shape(id) => program.shapes[id.0].span,
            Entity::Scene(id) => program.scenes[id.0].span,
            Entity::Record(id) => program.records[id.0].span,
            Entity::Map(id) => program.maps[id.0].span,
            Entity::Known(_) | Entity::Builtin(_) | Entity::Draw => return None,
        })
    }
}
