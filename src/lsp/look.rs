//! What is asked of a place: what stands there, where it is declared, where else it is used.

use super::analysis::Analysis;
use super::describe::{builtin, code, told};
use super::names::Kind;
use super::text::{Lines, range_of};
use lsp_types::{DocumentHighlight, Hover, HoverContents, Location, MarkupContent, MarkupKind};
use slowlight_compiler::sema::Ty;
use slowlight_compiler::source::Span;

/// A place in a text of a scene.
#[derive(Clone, Copy)]
pub struct At<'a> {
    /// The scene.
    pub of: &'a Analysis,
    /// The text's number.
    pub file: u16,
    /// The text.
    pub text: &'a str,
    /// The place.
    pub byte: usize,
}

impl At<'_> {
    /// The word around the place, or right before it.
    pub fn word(&self) -> (usize, usize) {
        word(self.text, self.byte)
    }
}

/// The word around a byte of a text, or right before it: where it begins and ends.
pub fn word(text: &str, byte: usize) -> (usize, usize) {
    let bytes = text.as_bytes();
    let inside = |b: &u8| b.is_ascii_alphanumeric() || *b == b'_';
    let mut start = byte.min(bytes.len());
    while start > 0 && bytes.get(start - 1).is_some_and(inside) {
        start -= 1;
    }
    let mut end = byte.min(bytes.len());
    while bytes.get(end).is_some_and(inside) {
        end += 1;
    }
    (start, end)
}

/// What is shown of a place.
pub fn hover(at: At<'_>) -> Option<Hover> {
    let (span, text) = named(at).or_else(|| keyless(at)).or_else(|| typed(at))?;
    Some(Hover {
        contents: HoverContents::Markup(MarkupContent {
            kind: MarkupKind::Markdown,
            value: text,
        }),
        range: Some(range_of(at.text, span)),
    })
}

/// A name that is declared somewhere.
fn named(at: At<'_>) -> Option<(Span, String)> {
    let (span, to) = at.of.names().around(at.file, at.byte)?;
    let first = *to.first()?;
    let def = at.of.names().defs.get(first)?;
    let mut text = told(at.of, first)?.markdown();
    if def.kind.callable() && at.of.types().called.is_empty() && to.len() > 1 {
        text += &format!("\nand {} more of this name\n", to.len() - 1);
    }
    // A call's facts are those of the whole; a local's those of what it is bound to.
    let about = match def.kind {
        Kind::Local => def.value,
        _ => None,
    };
    if let Some(line) = about.and_then(|span| facts(at, span)) {
        text += &format!("\n{line}\n");
    }
    Some((span, text))
}

/// A word of the language itself that is called, or a value of its.
fn keyless(at: At<'_>) -> Option<(Span, String)> {
    let (start, end) = at.word();
    let before = at.text.get(..start)?.trim_end();
    let field = before.ends_with('.');
    let called = at.text.get(end..)?.trim_start().starts_with('(');
    let name = at.text.get(start..end).filter(|name| !name.is_empty())?;
    let comment = at
        .text
        .get(..start)?
        .lines()
        .next_back()
        .is_some_and(|l| l.contains("//"));
    if (field && !called) || comment {
        return None;
    }
    let told = builtin(at.of, name)?;
    Some((Span::new(at.file, start, end), told.markdown()))
}

/// Any other expression, by its type.
fn typed(at: At<'_>) -> Option<(Span, String)> {
    let (span, ty) = at.of.types().around(at.file, at.byte)?;
    if matches!(ty, Ty::Never) {
        return None;
    }
    let mut text = code(&ty.show(&at.of.whole.scene.program));
    if let Some(line) = facts(at, span) {
        text += &format!("\n{line}\n");
    }
    Some((span, text))
}

/// What the graph says of an expression, in a line.
fn facts(at: At<'_>, span: Span) -> Option<String> {
    let graph = at.of.graph()?;
    let known = at.of.facts()?.of(graph, span)?;
    let changes = match known.rate.is_empty() {
        true => "constant".to_owned(),
        false => format!("changes with: {}", known.rate.join(", ")),
    };
    let number = at
        .of
        .types()
        .ty(span)
        .is_some_and(|ty| matches!(ty, Ty::Int | Ty::Real | Ty::Angle | Ty::Ink));
    let range = if number {
        bounds(known.range)
    } else {
        String::new()
    };
    Some(changes + &range)
}

/// Between which bounds a value stays, as far as they say anything.
fn bounds((low, high): (f64, f64)) -> String {
    // What comes from the end of a format is no bound that anybody meant.
    let told = |bound: f64| bound.abs() < 1e30;
    match (told(low), told(high)) {
        (true, true) if low == high => format!("; is {}", shown(low)),
        (true, true) => format!("; {} to {}", shown(low), shown(high)),
        (true, false) => format!("; at least {}", shown(low)),
        (false, true) => format!("; at most {}", shown(high)),
        (false, false) => String::new(),
    }
}

/// A bound to a few digits.
fn shown(value: f64) -> String {
    let rounded = format!("{value:.4}");
    let plain = rounded.trim_end_matches('0').trim_end_matches('.');
    match value != 0.0 && (value.abs() < 0.001 || value.abs() >= 1e9) {
        true => format!("{value:.3e}"),
        false => if plain == "-0" { "0" } else { plain }.to_owned(),
    }
}

/// Where what stands there is declared: of several that may be meant all.
pub fn definition(at: At<'_>) -> Vec<Location> {
    if let Some(file) = used_file(at) {
        return at.of.location(Span::new(file, 0, 0)).into_iter().collect();
    }
    let Some((_, to)) = at.of.names().around(at.file, at.byte) else {
        return Vec::new();
    };
    // Where the checker came so far it chose one.
    let certain = at.of.is_checked();
    let wanted = if certain { 1 } else { to.len() };
    let defs = to
        .iter()
        .take(wanted)
        .filter_map(|k| at.of.names().defs.get(*k));
    let defs = defs.filter(|def| def.kind != Kind::Point);
    defs.filter_map(|def| at.of.location(def.span)).collect()
}

/// The text that a `use` at a place names.
fn used_file(at: At<'_>) -> Option<u16> {
    use slowlight_compiler::syntax::tree::ItemKind;
    let (tree, _) = at.of.whole.trees.get(usize::from(at.file))?;
    let path = tree.items.iter().find_map(|item| match &item.kind {
        ItemKind::Use { path, path_span } => path_span.range().contains(&at.byte).then_some(path),
        _ => None,
    })?;
    let from = std::path::Path::new(&at.of.files().get(usize::from(at.file))?.name);
    let full = super::text::full(&from.parent()?.join(path))
        .display()
        .to_string();
    let number = at
        .of
        .files()
        .iter()
        .position(|f| !f.library && f.name == full)?;
    u16::try_from(number).ok()
}

/// All places of the name that stands there, its declaration last where it is asked for.
pub fn references(at: At<'_>, declared: bool) -> Vec<Location> {
    let Some((_, to)) = at.of.names().around(at.file, at.byte) else {
        return Vec::new();
    };
    let Some(def) = to.first() else {
        return Vec::new();
    };
    let own = at.of.names().defs.get(*def).map(|def| def.span);
    let places = at.of.names().places(*def).into_iter();
    let places = places.filter(|span| declared || Some(*span) != own);
    places.filter_map(|span| at.of.location(span)).collect()
}

/// The same in this text alone.
pub fn highlights(at: At<'_>) -> Vec<DocumentHighlight> {
    let Some((_, to)) = at.of.names().around(at.file, at.byte) else {
        return Vec::new();
    };
    let places = to
        .first()
        .map_or(Vec::new(), |def| at.of.names().places(*def));
    let here = places.into_iter().filter(|span| span.file == at.file);
    let lines = Lines::new(at.text);
    let highlight = |span| DocumentHighlight {
        range: lines.range(at.text, span),
        kind: None,
    };
    here.map(highlight).collect()
}
