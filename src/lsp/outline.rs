//! A text as a whole: its outline, and its form.

use super::text::Lines;
use lsp_types::{DocumentSymbol, Position, Range, SymbolKind, TextEdit};
use slowlight_compiler::source::Span;
use slowlight_compiler::syntax::format::format;
use slowlight_compiler::syntax::tree::{File, Item, ItemKind, Name};

/// A text and its lines.
type Text<'t> = (&'t Lines, &'t str);

/// The items of a file, with their parts.
pub fn symbols(file: &File, text: &str) -> Vec<DocumentSymbol> {
    let text = (&Lines::new(text), text);
    let all = file.items.iter().filter_map(|item| symbol(item, text));
    all.collect()
}

// A field that the protocol has given up must be filled in.
#[allow(deprecated)]
fn one(
    name: &str,
    kind: SymbolKind,
    (whole, own): (Span, Span),
    (lines, text): Text<'_>,
) -> DocumentSymbol {
    let range = |span: Span| lines.range(text, span);
    DocumentSymbol {
        name: name.to_owned(),
        detail: None,
        kind,
        tags: None,
        deprecated: None,
        range: range(whole),
        selection_range: range(own),
        children: None,
    }
}

fn symbol(item: &Item, text: Text<'_>) -> Option<DocumentSymbol> {
    let named = |name: &Name, kind| one(&name.text, kind, (item.span, name.span), text);
    let bare = |name: &str, kind, own: Span| one(name, kind, (item.span, own), text);
    let part = |name: &Name, whole: Span, kind| {
        one(&name.text, kind, (name.span.to(whole), name.span), text)
    };
    Some(match &item.kind {
        ItemKind::Image(_) => bare("image", SymbolKind::FILE, item.span),
        ItemKind::Draw { x, .. } => bare("draw", SymbolKind::EVENT, x.span),
        ItemKind::Use { path, path_span } => bare(path, SymbolKind::FILE, *path_span),
        ItemKind::Param(param) => named(&param.name, SymbolKind::VARIABLE),
        ItemKind::Const { name, .. } => named(name, SymbolKind::CONSTANT),
        ItemKind::Map { name, .. } => named(name, SymbolKind::ARRAY),
        ItemKind::Scene { name, .. } => named(name, SymbolKind::MODULE),
        ItemKind::Fn(f) | ItemKind::Dither(f) => named(&f.name, SymbolKind::FUNCTION),
        ItemKind::Effect { function, .. } => named(&function.name, SymbolKind::OPERATOR),
        ItemKind::Shape { name, facets, .. } => {
            let facets = facets.iter();
            let facets = facets.map(|f| part(&f.name, f.body.span, SymbolKind::METHOD));
            DocumentSymbol {
                children: Some(facets.collect()),
                ..named(name, SymbolKind::CLASS)
            }
        }
        ItemKind::Record { name, fields } => {
            let fields = fields.iter();
            let fields = fields.map(|f| part(&f.name, f.ty.span, SymbolKind::FIELD));
            DocumentSymbol {
                children: Some(fields.collect()),
                ..named(name, SymbolKind::STRUCT)
            }
        }
    })
}

/// The edit that makes a text look as `slowlight fmt` has it; none where it does, and where
/// it cannot be read.
pub fn formatted(text: &str) -> Option<TextEdit> {
    let new = format(text, 0).ok()?;
    if new == text {
        return None;
    }
    // Lines that stay at both ends are left alone, so that places in them stay.
    let (old_lines, new_lines): (Vec<&str>, Vec<&str>) = (
        text.split_inclusive('\n').collect(),
        new.split_inclusive('\n').collect(),
    );
    let same = old_lines.iter().zip(&new_lines);
    let first = same.take_while(|(a, b)| a == b).count();
    let rest = (&old_lines[first..], &new_lines[first..]);
    let same = rest.0.iter().rev().zip(rest.1.iter().rev());
    let last = same.take_while(|(a, b)| a == b).count();
    let bytes = |lines: &[&str]| lines.iter().map(|line| line.len()).sum::<usize>();
    let start = bytes(&old_lines[..first]);
    let end = text.len() - bytes(&old_lines[old_lines.len() - last..]);
    let lines = Lines::new(text);
    let (from, to): (Position, Position) = (lines.position(text, start), lines.position(text, end));
    let put = new_lines[first..new_lines.len() - last].concat();
    Some(TextEdit::new(Range::new(from, to), put))
}
