//! Completion: what may stand at a place, of a text that can seldom be read as it is.
//!
//! The word at the place is replaced by one that can be read, with or without a semicolon,
//! whichever leaves less unread; what is in sight there is what is offered.

use super::analysis::Analysis;
use super::describe::{Told, builtin, told, type_of};
use super::look::At;
use super::names::Kind;
use super::scan::{self, Around};
use lsp_types::{
    CompletionItem, CompletionItemKind, CompletionItemLabelDetails, Documentation, MarkupContent,
    MarkupKind,
};
use slowlight_compiler::sema::colours::COLOURS;
use slowlight_compiler::sema::{Signature, Ty, known, signatures};
use slowlight_compiler::source::Span;
use slowlight_compiler::syntax::{ITEMS, PLACED, WORDS, parse};
use std::collections::BTreeMap;

/// Types that have a name of their own.
pub const TYPES: [&str; 13] = [
    "bool", "int", "real", "angle", "ink", "vec2", "vec3", "ray", "hit", "shape", "scene", "map",
    "fn",
];

/// Makes what is known of another text in the place of this one.
pub type Remake<'r> = &'r dyn Fn(String) -> Analysis;

/// What is offered, by name.
#[derive(Default)]
struct Offers(BTreeMap<String, CompletionItem>);

impl Offers {
    /// Offers a name, unless something nearer has it; the rank is the nearer the lower.
    fn add(&mut self, name: &str, kind: CompletionItemKind, rank: u8, about: Option<&Told>) {
        if let Some(known) = self.0.get_mut(name) {
            if let (Some(detail), Some(about)) = (&mut known.detail, about)
                && !detail.contains(&about.head)
            {
                *detail += &format!("\n{}", about.head);
            }
            return;
        }
        let documentation = about.filter(|told| !told.about.is_empty()).map(|told| {
            Documentation::MarkupContent(MarkupContent {
                kind: MarkupKind::Markdown,
                value: told.about.clone(),
            })
        });
        let item = CompletionItem {
            label: name.to_owned(),
            label_details: about
                .and_then(|told| told.head.split_once(name))
                .map(|(_, rest)| CompletionItemLabelDetails {
                    detail: rest.lines().next().map(str::to_owned),
                    description: None,
                }),
            kind: Some(kind),
            detail: about.map(|told| told.head.clone()),
            documentation,
            sort_text: Some(format!("{rank}{name}")),
            ..CompletionItem::default()
        };
        self.0.insert(name.to_owned(), item);
    }

    fn words(&mut self, words: &[&str], rank: u8) {
        for word in words {
            self.add(word, CompletionItemKind::KEYWORD, rank, None);
        }
    }
}

/// What may stand at a place.
pub fn complete(at: At<'_>, remake: Remake<'_>) -> Vec<CompletionItem> {
    let (start, end) = at.word();
    let around = scan::around(at.text, start);
    let before = at.text.get(..start).unwrap_or("").trim_end();
    let digit = at
        .text
        .as_bytes()
        .get(start)
        .is_some_and(u8::is_ascii_digit);
    let mut offers = Offers::default();
    if around.quoted || digit && start < end {
        return Vec::new();
    }
    let item = at.text.get(around.item..start).unwrap_or("");
    let head = item.split_whitespace().next().unwrap_or("");
    if before.ends_with('.') && !before.ends_with("..") {
        members(at, (before.len() - 1, end), remake, &mut offers);
    } else if around.brackets.is_empty() && without_comments(item).trim().is_empty() {
        offers.words(&ITEMS, 0);
    } else if head == "image" || without_comments(item).trim().starts_with("image") {
        let colours = COLOURS.iter().map(|(name, _)| *name);
        colours.for_each(|name| offers.add(name, CompletionItemKind::COLOR, 0, None));
        offers.words(&PLACED[..1], 1);
    } else {
        let fresh = remake(patched(at.text, (start, end)));
        if before.ends_with("->") || before.ends_with(':') {
            types(&fresh, &mut offers);
        }
        if !before.ends_with("->") {
            values(&fresh, at, start, &around, &mut offers);
        }
    }
    offers.0.into_values().collect()
}

fn without_comments(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<&str>>().join("\n")
}

/// The text with something that can be read in the place of a word.
fn patched(text: &str, (start, end): (usize, usize)) -> String {
    let (before, behind) = (
        text.get(..start).unwrap_or(""),
        text.get(end..).unwrap_or(""),
    );
    let ways = ["zz", "zz;", "zz,", "", ";", "zz: zz", "zz = zz;", "zz; zz"];
    let mut best: Option<((usize, usize), String)> = None;
    for way in ways {
        let text = format!("{before}{way}{behind}");
        // Items that are gone take their names along.
        let (tree, said) = parse(&text, 0);
        let unread = (said.len(), usize::MAX - tree.items.len());
        if best.as_ref().is_none_or(|(least, _)| unread < *least) {
            best = Some((unread, text));
        }
        if unread.0 == 0 {
            break;
        }
    }
    best.map_or(String::new(), |(_, text)| text)
}

fn types(of: &Analysis, offers: &mut Offers) {
    for name in TYPES {
        offers.add(name, CompletionItemKind::CLASS, 0, None);
    }
    let all = of.names().defs.iter().enumerate();
    for (k, def) in all.filter(|(_, def)| def.kind == Kind::Record) {
        let rank = if def.library { 2 } else { 1 };
        offers.add(
            &def.name,
            CompletionItemKind::STRUCT,
            rank,
            told(of, k).as_ref(),
        );
    }
}

/// Everything that an expression may begin with.
fn values(of: &Analysis, at: At<'_>, byte: usize, around: &Around, offers: &mut Offers) {
    let names = of.names();
    let call = scan::call(at.text, around);
    let called = call
        .as_ref()
        .map_or(Vec::new(), |call| names.items(call.name, false));
    let ways = signatures();
    let ways = ways
        .iter()
        .filter(|s| call.as_ref().is_some_and(|call| call.name == s.name));
    for param in ways.flat_map(|s| &s.params).filter(|p| p.0 != "self") {
        let label = format!("{}:", param.0);
        offers.add(&label, CompletionItemKind::PROPERTY, 1, None);
    }
    for part in called.iter().flat_map(|k| names.parts(*k)) {
        if let (Some(def), Some(about)) = (names.defs.get(*part), told(of, *part)) {
            let label = format!("{}:", def.name);
            offers.add(&label, CompletionItemKind::PROPERTY, 1, Some(&about));
        }
    }
    let sees = |seen: Span| {
        seen.file == at.file && (seen.start as usize..=seen.end as usize + 3).contains(&byte)
    };
    // Inner names hide outer ones.
    let mut locals: Vec<(usize, Span)> = names
        .defs
        .iter()
        .enumerate()
        .filter(|(_, def)| !def.kind.is_item() && def.kind != Kind::Field && sees(def.seen))
        .map(|(k, def)| (k, def.seen))
        .collect();
    locals.sort_by_key(|(_, seen)| std::cmp::Reverse(seen.start));
    for (k, _) in locals {
        if let Some(def) = names.defs.get(k) {
            let told = told(of, k);
            offers.add(&def.name, CompletionItemKind::VARIABLE, 0, told.as_ref());
        }
    }
    for library in [false, true] {
        let rank = if library { 3 } else { 2 };
        for (k, def) in names.defs.iter().enumerate() {
            if def.library == library && def.kind.is_item() && offered(of, def.span.file) {
                offers.add(&def.name, symbol(def.kind), rank, told(of, k).as_ref());
            }
        }
    }
    for signature in signatures() {
        let told = builtin(of, signature.name);
        let method = signature.params.first().is_some_and(|p| p.0 == "self");
        if !method {
            offers.add(
                signature.name,
                CompletionItemKind::FUNCTION,
                3,
                told.as_ref(),
            );
        }
    }
    for (name, _) in known(&of.whole.scene.program) {
        offers.add(
            name,
            CompletionItemKind::CONSTANT,
            3,
            builtin(of, name).as_ref(),
        );
    }
    offers.words(&WORDS, 4);
    offers.words(&PLACED, 5);
}

/// Whether scenes have to do with a file: not with those that only the compiler calls.
fn offered(of: &Analysis, file: u16) -> bool {
    let found = of.files().get(usize::from(file));
    found.is_some_and(|f| !f.library || !crate::library::is_inner(&f.name))
}

fn symbol(kind: Kind) -> CompletionItemKind {
    match kind {
        Kind::Const | Kind::Map => CompletionItemKind::CONSTANT,
        Kind::Param | Kind::State => CompletionItemKind::VARIABLE,
        Kind::Shape | Kind::Record => CompletionItemKind::CONSTRUCTOR,
        Kind::Scene => CompletionItemKind::MODULE,
        _ => CompletionItemKind::FUNCTION,
    }
}

/// What may stand behind a point.
fn members(at: At<'_>, (point, end): (usize, usize), remake: Remake<'_>, offers: &mut Offers) {
    // The value alone can be read.
    let text = patched_value(at.text, (point, end));
    let fresh = remake(text);
    let of = point
        - at.text
            .get(..point)
            .map_or(0, |t| t.len() - t.trim_end().len());
    let Some(start) = scan::receiver(at.text, of) else {
        return;
    };
    let Some(ty) = value_type(&fresh, at, (start, of)) else {
        return;
    };
    for name in parts(&fresh, &ty) {
        offers.add(&name, CompletionItemKind::FIELD, 0, None);
    }
    let names = fresh.names();
    for (k, def) in names
        .defs
        .iter()
        .enumerate()
        .filter(|(_, d)| d.kind.callable())
    {
        let first = names
            .parts(k)
            .first()
            .and_then(|first| names.defs.get(*first));
        let written = first.and_then(|first| type_of(&fresh, first));
        if written.is_some_and(|want| accepts(&fresh, &ty, &want)) && offered(&fresh, def.span.file)
        {
            let rank = if def.library { 2 } else { 1 };
            let told = told(&fresh, k);
            offers.add(&def.name, CompletionItemKind::METHOD, rank, told.as_ref());
        }
    }
    let fits = |s: &&Signature| {
        s.params
            .first()
            .is_some_and(|p| ty.fits(&p.1) && p.1 != Ty::Error)
    };
    for signature in signatures().iter().filter(fits) {
        let told = builtin(&fresh, signature.name);
        offers.add(signature.name, CompletionItemKind::METHOD, 1, told.as_ref());
    }
}

/// The type of a value that stands somewhere; brackets around it are no part of it.
fn value_type(fresh: &Analysis, at: At<'_>, (mut start, mut end): (usize, usize)) -> Option<Ty> {
    loop {
        if let Some(ty) = fresh.types().ty(Span::new(at.file, start, end)) {
            return Some(ty.clone());
        }
        let inner = at
            .text
            .get(start..end)?
            .strip_prefix('(')?
            .strip_suffix(')')?;
        start += 1 + inner.len() - inner.trim_start().len();
        end -= 1 + inner.len() - inner.trim_end().len();
    }
}

/// The text without what stands behind a point, and the point.
fn patched_value(text: &str, (point, end): (usize, usize)) -> String {
    let (before, behind) = (
        text.get(..point).unwrap_or(""),
        text.get(end..).unwrap_or(""),
    );
    let ways = [
        format!("{before}{behind}"),
        format!("{before};{behind}"),
        format!("{before}; zz {behind}"),
    ];
    let best = ways.into_iter().min_by_key(|text| parse(text, 0).1.len());
    best.unwrap_or_default()
}

/// Whether a value of a type may be the argument of a parameter whose type is written so.
fn accepts(of: &Analysis, ty: &Ty, want: &str) -> bool {
    let program = &of.whole.scene.program;
    let have = ty.show(program);
    have == want || format!("{have}?") == want || have == "int" && matches!(want, "real" | "real?")
}

/// The parts of a value of a type.
fn parts(of: &Analysis, ty: &Ty) -> Vec<String> {
    let listed = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    match ty {
        Ty::Vector(2) => listed(&["x", "y"]),
        Ty::Vector(_) => listed(&["x", "y", "z", "xy", "xz", "yz"]),
        Ty::Ray => listed(&["from", "dir"]),
        Ty::Hit(Some(_)) => listed(&["point", "normal", "t", "tag"]),
        Ty::Hit(None) => listed(&["point", "normal", "t"]),
        Ty::Record(id) => {
            let record = of.whole.scene.program.records.get(id.0);
            let fields = record.map_or(&[][..], |record| &record.fields);
            fields.iter().map(|field| field.name.clone()).collect()
        }
        _ => Vec::new(),
    }
}
