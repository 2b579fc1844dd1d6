//! Types as written.

use super::Checker;
use super::names::Entity;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree::{self, TypeKind};

impl Checker<'_> {
    /// The type that is written.
    pub(super) fn ty(&mut self, written: &tree::Type) -> Ty {
        match &written.kind {
            TypeKind::Error => Ty::Error,
            TypeKind::Table(of) => Ty::Table(Box::new(self.ty(of))),
            TypeKind::Optional(of) => self.ty(of).optional(),
            TypeKind::Function(args, result) => {
                let args = args.iter().map(|a| self.ty(a)).collect();
                Ty::Function(args, Box::new(self.ty(result)))
            }
            TypeKind::Name(name) => self.named_type(name, written.span),
        }
    }

    fn named_type(&mut self, name: &str, span: Span) -> Ty {
        const NAMES: [&str; 11] = [
            "bool", "int", "real", "angle", "ink", "vec2", "vec3", "ray", "hit", "shape", "scene",
        ];
        for entity in self.entities(name) {
            if let Entity::Record(id) = entity {
                self.mention(entity, span);
                return Ty::Record(id);
            }
        }
        match name {
            "bool" => Ty::Bool,
            "int" => Ty::Int,
            "real" => Ty::Real,
            "angle" => Ty::Angle,
            "ink" => Ty::Ink,
            "vec2" => Ty::Vector(2),
            "vec3" => Ty::Vector(3),
            "ray" => Ty::Ray,
            "hit" => Ty::Hit(None),
            "shape" => Ty::Shape,
            "scene" => Ty::Scene(None),
            "map" => Ty::Map,
            _ => {
                let help = match name {
                    "float" | "double" | "number" => Some("did you mean `real`?".to_owned()),
                    _ => {
                        let records = self.program.records.iter().map(|r| r.name.as_str());
                        self.among(name, NAMES.into_iter().chain(["map"]).chain(records))
                    }
                };
                let mut error = Diagnostic::error(span, format!("no type `{name}`"));
                error.help = help;
                self.report(error);
                Ty::Error
            }
        }
    }
}
