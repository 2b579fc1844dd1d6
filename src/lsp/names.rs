//! Name resolution over the syntax tree: which names are declared where, where each may be
//! seen, and which declaration a use means.
//!
//! What holds of a text with mistakes, too. Of several functions of one name the checker
//! chooses by types; where it came so far, what it says stands ([`Types::called`]).

mod walk;

use super::types::{Place, Types, place};
use rustc_hash::FxHashMap;
use slowlight_compiler::source::Span;
use slowlight_compiler::syntax::tree::{File, Item};

/// What a name is declared as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Function,
    Effect,
    Dither,
    Const,
    Param,
    /// What a param is, and what it is in the next picture.
    State,
    Shape,
    Scene,
    Record,
    Map,
    /// A part of a record.
    Field,
    /// A parameter of a function, an effect, a dither or a shape.
    Argument,
    /// What a `let`, an `if let`, a loop or a facet binds, and the pixel of `draw`.
    Local,
    /// What an `each` counts.
    Counter,
    /// `p` of a tag: nobody declares it.
    Point,
}

impl Kind {
    /// How a sentence names it.
    pub fn text(self) -> &'static str {
        match self {
            Kind::Function => "function",
            Kind::Effect => "effect",
            Kind::Dither => "dither",
            Kind::Const => "constant",
            Kind::Param => "param",
            Kind::State => "state",
            Kind::Shape => "shape",
            Kind::Scene => "scene",
            Kind::Record => "record",
            Kind::Map => "map",
            Kind::Field => "field",
            Kind::Argument => "parameter",
            Kind::Local => "local",
            Kind::Counter => "counter",
            Kind::Point => "point hit",
        }
    }

    /// Whether a call may name it.
    pub fn callable(self) -> bool {
        matches!(
            self,
            Kind::Function | Kind::Effect | Kind::Dither | Kind::Shape | Kind::Record
        )
    }

    /// Whether it is an item's.
    pub fn is_item(self) -> bool {
        self.callable()
            || matches!(
                self,
                Kind::Const | Kind::Param | Kind::State | Kind::Scene | Kind::Map
            )
    }
}

/// A declaration.
#[derive(Clone, Debug)]
pub struct Def {
    /// The name.
    pub name: String,
    /// Where it stands.
    pub span: Span,
    /// As what.
    pub kind: Kind,
    /// The declaration that it is a part of: of parameters and fields.
    pub of: Option<usize>,
    /// Where it may be seen: of an item its own place, as it is seen everywhere.
    pub seen: Span,
    /// The expression that it is bound to, where there is one.
    pub value: Option<Span>,
    /// Its type as it is written.
    pub ty: Option<Span>,
    /// Its type where the language fixes it; else empty.
    pub fixed: &'static str,
    /// Whether the library declares it.
    pub library: bool,
}

/// A place that uses a name.
#[derive(Clone, Debug)]
pub struct Use {
    /// Where.
    pub span: Span,
    /// What it may mean, the likeliest first.
    pub to: Vec<usize>,
}

/// The names of some files.
#[derive(Debug, Default)]
pub struct Names {
    /// Declarations, items first.
    pub defs: Vec<Def>,
    /// Uses, in no order.
    pub uses: Vec<Use>,
    /// Declarations by where they stand.
    at: FxHashMap<Place, usize>,
    /// Items by name: the scene's, and the library's.
    user: FxHashMap<String, Vec<usize>>,
    library: FxHashMap<String, Vec<usize>>,
    /// Parts by what they are of.
    parts: FxHashMap<usize, Vec<usize>>,
}

impl Names {
    /// Of files that may see each other, and whether they are the library's; of the library's
    /// only declarations, unless all is asked for.
    pub fn new(files: &[(File, bool)], types: &Types, all: bool) -> Names {
        let mut names = Names::default();
        for (file, library) in files {
            file.items
                .iter()
                .for_each(|item| names.item(item, *library));
        }
        for (file, library) in files {
            if all || !library {
                walk::file(&mut names, types, file, *library);
            }
        }
        names
    }

    /// Takes a declaration in.
    fn declare(&mut self, def: Def) -> usize {
        let number = self.defs.len();
        self.at.insert(place(def.span), number);
        if let Some(of) = def.of {
            self.parts.entry(of).or_default().push(number);
        }
        if def.kind.is_item() {
            let layer = match def.library {
                true => &mut self.library,
                false => &mut self.user,
            };
            layer.entry(def.name.clone()).or_default().push(number);
        }
        self.defs.push(def);
        number
    }

    fn item(&mut self, item: &Item, library: bool) {
        let Some(head) = walk::head(item) else {
            return;
        };
        let number = self.declare(Def {
            name: head.name.text.clone(),
            span: head.name.span,
            kind: head.kind,
            of: None,
            seen: item.span,
            value: head.value,
            ty: head.ty,
            fixed: "",
            library,
        });
        let kind = match head.kind {
            Kind::Record => Kind::Field,
            _ => Kind::Argument,
        };
        for binding in head.bindings {
            self.declare(Def {
                name: binding.name.text.clone(),
                span: binding.name.span,
                kind,
                of: Some(number),
                seen: item.span,
                value: binding.default.as_ref().map(|value| value.span),
                ty: Some(binding.ty.span),
                fixed: "",
                library,
            });
        }
    }

    /// The items of a name, the scene's first where it may be asked for from a scene.
    pub fn items(&self, name: &str, library: bool) -> Vec<usize> {
        let user = self.user.get(name).filter(|_| !library);
        let all = user.into_iter().chain(self.library.get(name));
        all.flatten().copied().collect()
    }

    /// Parameters and fields of a declaration, in their order.
    pub fn parts(&self, of: usize) -> &[usize] {
        self.parts.get(&of).map_or(&[], Vec::as_slice)
    }

    /// The declaration at a place.
    pub fn def_at(&self, span: Span) -> Option<usize> {
        self.at.get(&place(span)).copied()
    }

    /// The name around a byte, or right before it: where it stands, and what it may mean.
    pub fn around(&self, file: u16, byte: usize) -> Option<(Span, Vec<usize>)> {
        let near = |span: Span| {
            span.file == file && span.start as usize <= byte && byte <= span.end as usize
        };
        let own = self.defs.iter().enumerate();
        let own = own.filter(|(_, d)| near(d.span) && d.kind != Kind::Point);
        let own = own.map(|(k, d)| (d.span, vec![k]));
        let uses = self.uses.iter().filter(|u| near(u.span));
        let found = uses.map(|u| (u.span, u.to.clone())).chain(own);
        // Of two that touch, the one that goes on.
        found.max_by_key(|(span, _)| span.start)
    }

    /// All places of a declaration's name, its own first.
    pub fn places(&self, of: usize) -> Vec<Span> {
        let own = self.defs.get(of).filter(|d| d.kind != Kind::Point);
        let uses = self.uses.iter().filter(|u| u.to.first() == Some(&of));
        let all = own.map(|d| d.span).into_iter().chain(uses.map(|u| u.span));
        all.collect()
    }
}
