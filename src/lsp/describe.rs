//! What is said of a name: its head as `slowlight doc` prints it, the comment on it, its type.

use super::analysis::Analysis;
use super::names::{Def, Kind};
use crate::library::{self, Comment};
use slowlight_compiler::sema::{Signature, Ty, known, signatures};
use slowlight_compiler::syntax::tree::Item;

/// What is said of a name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Told {
    /// Its head, or how it is declared.
    pub head: String,
    /// The comment on it.
    pub about: String,
    /// Where the library has it: `shapes.scn`; else empty.
    pub place: String,
}

impl Told {
    /// As a page for the editor.
    pub fn markdown(&self) -> String {
        let mut out = code(&self.head);
        if !self.about.is_empty() {
            out += &format!("\n{}\n", self.about);
        }
        if !self.place.is_empty() {
            out += &format!("\n*the library, {}*\n", self.place);
        }
        out
    }
}

/// A text as a block of code.
pub fn code(text: &str) -> String {
    format!("```slowlight\n{text}\n```\n")
}

/// What is said of a declaration.
pub fn told(of: &Analysis, number: usize) -> Option<Told> {
    let def = of.names().defs.get(number)?;
    if def.kind.is_item() {
        return item_told(of, def);
    }
    let ty = type_of(of, def).unwrap_or_default();
    let typed = match ty.is_empty() {
        true => def.name.clone(),
        false => format!("{}: {ty}", def.name),
    };
    let owner = def.of.and_then(|k| of.names().defs.get(k));
    let owner = owner.map_or(String::new(), |o| {
        format!("{} of `{}`", def.kind.text(), o.name)
    });
    let (head, about) = match def.kind {
        Kind::Field | Kind::Argument => {
            let default = def.value.map(|value| format!(" = {}", of.line(value)));
            (typed + &default.unwrap_or_default(), owner)
        }
        Kind::Counter => (typed, "what the `each` counts".to_owned()),
        Kind::Point => (typed, "the point hit, known to tags".to_owned()),
        _ => match def.value {
            Some(_) => (format!("let {typed}"), String::new()),
            None => (typed, String::new()),
        },
    };
    Some(Told {
        head,
        about,
        place: String::new(),
    })
}

fn item_told(of: &Analysis, def: &Def) -> Option<Told> {
    let file = of.files().get(usize::from(def.span.file))?;
    let (tree, _) = of.whole.trees.get(usize::from(def.span.file))?;
    let item = tree.items.iter().find(|item| item.span == def.seen)?;
    let about = match def.library {
        true => {
            let groups = library::groups(tree, &file.text);
            let own = |(_, items): &(Comment, Vec<&Item>)| {
                items.iter().any(|one| std::ptr::eq(*one, item))
            };
            groups.into_iter().find(own).map(|(about, _)| about)
        }
        false => Some(library::comment(&file.text, item)),
    };
    let head = match def.kind {
        Kind::Const => {
            let ty = type_of(of, def).map_or(String::new(), |ty| format!(": {ty}"));
            let value = def.value.map_or(String::new(), |value| of.line(value));
            format!("const {}{ty} = {}", def.name, shortened(&value))
        }
        Kind::Param | Kind::State => of.line(item.span).trim_end_matches(';').to_owned(),
        kind => match library::entry(item, &file.text) {
            Some(entry) => entry.signature,
            None => format!("{} {}", kind.text(), def.name),
        },
    };
    Some(Told {
        head,
        about: about.map_or(String::new(), |about| about.text()),
        place: if def.library {
            file.name.clone()
        } else {
            String::new()
        },
    })
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(80) {
        Some((at, _)) => format!("{} ..", &text[..at]),
        None => text.to_owned(),
    }
}

/// The type of a declared value, as the language writes it.
pub fn type_of(of: &Analysis, def: &Def) -> Option<String> {
    if !def.fixed.is_empty() {
        return Some(def.fixed.to_owned());
    }
    if let Some(span) = def.ty {
        return Some(of.line(span));
    }
    let program = &of.whole.scene.program;
    let value = super::types::place(def.value?);
    let types = of.types();
    let bound = types.bound.get(&value).or_else(|| types.of.get(&value));
    bound
        .filter(|ty| **ty != Ty::Error)
        .map(|ty| ty.show(program))
}

/// A way to call what the language itself has, as a head.
pub fn builtin_head(of: &Analysis, signature: &Signature) -> String {
    let program = &of.whole.scene.program;
    let show = |ty: &Ty| match ty {
        Ty::Error => "T".to_owned(),
        Ty::Table(of) if **of == Ty::Error => "[T]".to_owned(),
        ty => ty.show(program),
    };
    let params = signature.params.iter().map(|p| {
        let default = if p.2 { " = .." } else { "" };
        format!("{}: {}{default}", p.0, show(&p.1))
    });
    let params: Vec<String> = params.collect();
    format!(
        "fn {}({}) -> {}",
        signature.name,
        params.join(", "),
        show(&signature.result)
    )
}

/// What is said of a name of the language itself.
pub fn builtin(of: &Analysis, name: &str) -> Option<Told> {
    let ways = signatures();
    let heads = ways
        .iter()
        .filter(|s| s.name == name)
        .map(|s| builtin_head(of, s));
    let mut heads: Vec<String> = heads.collect();
    let values = known(&of.whole.scene.program).filter(|(known, _)| *known == name);
    heads.extend(values.map(|(name, ty)| format!("{name}: {}", ty.show(&of.whole.scene.program))));
    (!heads.is_empty()).then(|| Told {
        head: heads.join("\n"),
        about: "what the language itself has".to_owned(),
        place: String::new(),
    })
}
