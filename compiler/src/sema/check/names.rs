//! What names stand for, and what an author may have meant.

use super::Checker;
use crate::sema::colours::colour;
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use std::collections::BTreeMap;

/// What a name at the top level stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Entity {
    Function(FunctionId),
    Const(ConstId),
    Param(ParamId),
    Shape(ShapeId),
    Scene(SceneId),
    Record(RecordId),
    Map(MapId),
    /// `inks`, `width`, `epsilon` and the others, by place in [`KNOWN`].
    Known(usize),
    /// An index into the checker's signatures.
    Builtin(usize),
    /// The picture.
    Draw,
}

impl Entity {
    /// Whether a call may name it.
    pub(super) fn callable(self) -> bool {
        matches!(
            self,
            Entity::Function(_) | Entity::Shape(_) | Entity::Record(_) | Entity::Builtin(_)
        )
    }

    /// What to call its kind in a message.
    pub(super) fn kind(self) -> &'static str {
        match self {
            Entity::Function(_) | Entity::Builtin(_) => "function",
            Entity::Const(_) | Entity::Known(_) => "constant",
            Entity::Param(_) => "param",
            Entity::Shape(_) => "shape",
            Entity::Scene(_) => "scene",
            Entity::Record(_) => "record",
            Entity::Map(_) => "map",
            Entity::Draw => "draw",
        }
    }
}

/// Values that the language knows by name.
pub(super) const KNOWN: [(&str, Known); 10] = [
    ("inks", Known::Inks),
    ("width", Known::Width),
    ("height", Known::Height),
    ("offset", Known::Offset),
    ("epsilon", Known::Epsilon),
    ("floats", Known::Floats),
    ("mantissas", Known::Mantissas),
    ("samples", Known::Samples),
    ("picture", Known::Picture),
    ("input", Known::Input),
];

/// The names of the values that the language knows, with their types.
pub fn known(program: &Program) -> impl Iterator<Item = (&'static str, Ty)> {
    let ty = |known| type_of(known, program);
    KNOWN.iter().map(move |(name, known)| (*name, ty(*known)))
}

/// The library's record of what a player holds.
const HELD: &str = "held";

/// The type of a value that the language knows by name.
pub(super) fn type_of(known: Known, program: &Program) -> Ty {
    match known {
        Known::Offset | Known::Epsilon => Ty::Real,
        Known::Floats | Known::Mantissas => Ty::Bool,
        Known::Inks | Known::Width | Known::Height | Known::Samples | Known::Picture => Ty::Int,
        Known::Input => {
            let mut records = program.records.iter();
            let held = records.position(|r| r.library && r.name == HELD);
            held.map_or(Ty::Error, |k| Ty::Record(RecordId(k)))
        }
    }
}

/// Functions that other languages have, and what stands for them in this one.
const FOREIGN: [(&[&str], &str); 18] = [
    (&["fract", "frac"], "write `a mod 1`"),
    (&["fmod", "modulo", "rem"], "write `a mod b`"),
    (&["pow"], "write `a ^ b`"),
    (&["sqr", "square"], "write `a ^ 2`"),
    (
        &["normalize", "normalise", "normalized"],
        "did you mean `unit`?",
    ),
    (&["norm", "magnitude", "len"], "did you mean `length`?"),
    (&["distance"], "write `length(a - b)`"),
    (&["lerp"], "did you mean `mix`?"),
    (&["saturate"], "write `clamp(a, 0, 1)`"),
    (&["step"], "write `if a < edge then 0 else 1`"),
    (&["xor"], "two bools differ where `a != b`"),
    (
        &["bool"],
        "a number is no bool: write a comparison, `a != 0`",
    ),
    (
        &["int", "trunc"],
        "an int is made by `floor(a)`, `round(a)` or `ceil(a)`",
    ),
    (
        &["real", "float"],
        "an int is a real wherever one is wanted; `a * 1.0` is one",
    ),
    (&["ln"], "did you mean `log`?"),
    (
        &["log10", "log2"],
        "write `log(a) / log(10)`, and so on: `log` is the natural one",
    ),
    (
        &["rand", "random"],
        "there is no chance: `hash(x, y)` or `white_noise(x, y)` look like it",
    ),
    (
        &["radians", "degrees"],
        "angles carry their unit: `a * 1deg`, `angle / 1deg`",
    ),
];

/// What stands for a function of other languages.
fn foreign(name: &str) -> Option<&'static str> {
    let found = FOREIGN.iter().find(|(names, _)| names.contains(&name));
    found.map(|(_, help)| *help)
}

/// The library's names and the user's, sorted so that suggestions never vary.
#[derive(Default)]
pub(super) struct Layers {
    pub(super) library: BTreeMap<String, Vec<Entity>>,
    pub(super) user: BTreeMap<String, Vec<Entity>>,
}

impl Checker<'_> {
    /// Declares what the language itself knows.
    pub(super) fn predefine(&mut self) {
        for (k, (name, _)) in KNOWN.iter().enumerate() {
            let list = self.layers.library.entry((*name).to_owned()).or_default();
            list.push(Entity::Known(k));
        }
        for (k, signature) in self.signatures.iter().enumerate() {
            let name = signature.name.to_owned();
            self.layers
                .library
                .entry(name)
                .or_default()
                .push(Entity::Builtin(k));
        }
    }

    /// Everything that a name may stand for here, the file's own first.
    pub(super) fn entities(&self, name: &str) -> Vec<Entity> {
        let none = Vec::new();
        let user = match self.cx.library {
            true => &none,
            false => self.layers.user.get(name).unwrap_or(&none),
        };
        let library = self.layers.library.get(name).unwrap_or(&none);
        let all = user.iter().take(super::SHARERS).chain(library);
        all.copied().collect()
    }

    /// Remembers that the current item mentions another.
    pub(super) fn mention(&mut self, entity: Entity, span: Span) {
        if let Some(item) = self.cx.item {
            self.mentions.push((item, entity, span));
        }
    }

    /// The local that a name stands for, innermost first.
    pub(super) fn find_local(&self, name: &str) -> Option<LocalId> {
        self.cx.scopes.find(name)
    }

    /// The nearest name that may stand here, and what it is.
    fn nearest(
        &self,
        name: &str,
        want: impl Fn(Entity) -> bool,
        locals: bool,
    ) -> Option<(String, Option<Entity>)> {
        if self.diagnostics.len() > super::SHOWN {
            return None;
        }
        let user = self.layers.user.iter().filter(|_| !self.cx.library);
        let items = user
            .chain(self.layers.library.iter())
            .filter_map(|(n, list)| {
                let entity = list.iter().copied().find(|&e| want(e))?;
                Some((n.clone(), Some(entity)))
            });
        let scopes = self.cx.scopes.names().filter(|_| locals);
        let scopes = scopes.map(|n| (n.to_owned(), None));
        scopes
            .chain(items)
            .filter_map(|(n, e)| Some((near(name, &n)?, n, e)))
            .min_by_key(|(distance, ..)| *distance)
            .map(|(_, n, e)| (n, e))
    }

    /// Reports a name that stands for nothing.
    pub(super) fn unknown_value(&mut self, name: &str, span: Span) {
        let mut error = Diagnostic::error(span, format!("nothing is called `{name}` here"));
        if self.entities(name).iter().any(|e| e.callable()) {
            error.message = format!("`{name}` is a function here, not a value");
            error = error.help(format!("call it: `{name}(..)`"));
        } else if colour(name).is_some() {
            error = error.help("inks are numbers in the order of `image`: the first is `ink(0)`");
        } else if let Some((close, _)) = self.nearest(name, |e| !e.callable(), true) {
            error = error.help(format!("did you mean `{close}`?"));
        }
        self.report(error);
    }

    /// Reports a call of what does not exist.
    pub(super) fn unknown_call(&mut self, name: &str, span: Span) {
        let close = self.nearest(name, Entity::callable, false);
        let kind = match &close {
            Some((_, Some(entity))) => entity.kind(),
            _ => "function",
        };
        let mut error = Diagnostic::error(span, format!("no {kind} `{name}`"));
        if let Some(entity) = self.entities(name).first() {
            let kind = match entity {
                Entity::Param(id) => self.program.params[id.0].what(),
                _ => entity.kind(),
            };
            error.message = format!("`{name}` is a {kind}, it cannot be called");
        } else if self.find_local(name).is_some() {
            error.message = format!("`{name}` is a value, it cannot be called");
        } else if let Some(help) = foreign(name) {
            error.message = format!("no function `{name}`");
            error = error.help(help);
        } else if let Some((close, _)) = close {
            error = error.help(format!("did you mean `{close}`?"));
        } else if let Some(longer) = self.longer(name) {
            error = error.help(format!("did you mean {longer}?"));
        }
        self.report(error);
    }

    /// The library's functions of whose names one is a word.
    fn longer(&self, name: &str) -> Option<String> {
        let has = |longer: &str| longer.split('_').any(|word| word == name);
        let items = self.layers.library.iter();
        let items = items.filter(|(n, list)| has(n) && list.iter().any(|e| e.callable()));
        let mut names: Vec<String> = items.map(|(n, _)| format!("`{n}`")).collect();
        names.sort();
        (!names.is_empty()).then(|| names.join(" or "))
    }

    /// `did you mean` among a few names.
    pub(super) fn among<'n>(
        &self,
        name: &str,
        names: impl Iterator<Item = &'n str>,
    ) -> Option<String> {
        if self.diagnostics.len() > super::SHOWN {
            return None;
        }
        names
            .filter_map(|n| Some((near(name, n)?, n)))
            .min()
            .map(|(_, n)| format!("did you mean `{n}`?"))
    }
}

/// How far two names are apart, if they may be meant for each other: the
/// optimal string alignment distance (insertions, deletions, changes, and
/// swaps of neighbours).
pub(super) fn near(a: &str, b: &str) -> Option<usize> {
    let (a, b): (Vec<char>, Vec<char>) = (
        a.chars().flat_map(char::to_lowercase).collect(),
        b.chars().flat_map(char::to_lowercase).collect(),
    );
    let most = match a.len().max(b.len()) {
        0..=2 => return (a == b).then_some(0),
        3..=5 => 1,
        6..=8 => 2,
        _ => 3,
    };
    if a.len().abs_diff(b.len()) > most || a.len() > 64 {
        return None;
    }
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let change = usize::from(a[i - 1] != b[j - 1]);
            let mut best = (row[j - 1] + 1)
                .min(rows[i - 1][j] + 1)
                .min(rows[i - 1][j - 1] + change);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 1);
            }
            row.push(best);
        }
        rows.push(row);
    }
    let distance = rows[a.len()][b.len()];
    (distance <= most).then_some(distance)
}
