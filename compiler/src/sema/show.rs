//! Types as messages name them.

use super::program::Program;
use super::ty::Ty;

impl Ty {
    /// How the language writes it.
    pub fn show(&self, program: &Program) -> String {
        match self {
            Ty::Bool => "bool".into(),
            Ty::Int => "int".into(),
            Ty::Real => "real".into(),
            Ty::Angle => "angle".into(),
            Ty::Ink => "ink".into(),
            Ty::Vector(n) => format!("vec{n}"),
            Ty::Ray => "ray".into(),
            Ty::Hit(_) => "hit".into(),
            Ty::Shape => "shape".into(),
            Ty::Scene(_) => "scene".into(),
            Ty::Map => "map".into(),
            Ty::Table(of) => format!("[{}]", of.show(program)),
            Ty::Function(args, result) => {
                let args: Vec<String> = args.iter().map(|a| a.show(program)).collect();
                format!("fn({}) -> {}", args.join(", "), result.show(program))
            }
            Ty::Record(id) => program
                .records
                .get(id.0)
                .map_or_else(|| "record".into(), |r| r.name.clone()),
            Ty::Optional(inner) if **inner == Ty::Never => "none".into(),
            Ty::Optional(inner) => format!("{}?", inner.show(program)),
            Ty::Never => "next".into(),
            Ty::Error => "?".into(),
        }
    }

    /// The type as it stands in a sentence: `an int`, `a vec3`.
    pub fn a(&self, program: &Program) -> String {
        let text = self.show(program);
        match self {
            Ty::Optional(inner) if **inner == Ty::Never => "none".into(),
            Ty::Int | Ty::Angle | Ty::Ink => format!("an {text}"),
            Ty::Table(_) => format!("a table {text}"),
            Ty::Function(..) => format!("a function {text}"),
            _ => format!("a {text}"),
        }
    }
}
