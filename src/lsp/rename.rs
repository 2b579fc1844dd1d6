//! Renaming what a scene declares.
//!
//! Whether a new name is taken is not looked up but tried: the scene with the new name must
//! have the same uses of the same declarations as before, and no mistake that it had not.

use super::analysis::Analysis;
use super::look::At;
use super::names::{Kind, Names};
use super::text::{Lines, range_of};
use lsp_types::{PrepareRenameResponse, TextEdit, Uri};
use slowlight_compiler::source::Span;
use slowlight_compiler::syntax::is_name;

/// Makes what is known of the scene with other texts in the place of some of its files.
pub type Remake<'r> = &'r dyn Fn(&[(u16, String)]) -> Analysis;

/// What is renamed at a place: where it stands there, and its declaration's number.
///
/// # Errors
/// Why it cannot be.
fn target(at: At<'_>) -> Result<(Span, usize), String> {
    let names = at.of.names();
    let (start, end) = at.word();
    let word = at.text.get(start..end).unwrap_or("");
    let found = names.around(at.file, at.byte);
    let Some((span, to)) = found else {
        return Err(match word.is_empty() {
            true => "there is no name here".to_owned(),
            false => format!("`{word}` belongs to the language, or nothing declares it"),
        });
    };
    let def = to.first().and_then(|k| Some((*k, names.defs.get(*k)?)));
    let Some((number, def)) = def else {
        return Err(format!("nothing declares `{word}`"));
    };
    if def.library {
        return Err(format!("`{}` is the library's", def.name));
    }
    if def.kind == Kind::Point {
        return Err("`p` of a tag belongs to the language".to_owned());
    }
    // Which of several is meant, and what has parts, is known where all types are.
    let by_types = to.len() > 1 || matches!(def.kind, Kind::Field | Kind::Argument);
    let several = names.items(&def.name, false).len() > 1 && def.kind.is_item();
    if (by_types || several) && !at.of.is_checked() {
        let why = "the scene has mistakes, so not all places that mean it are known";
        return Err(format!("`{}` cannot be renamed: {why}", def.name));
    }
    Ok((span, number))
}

/// The name that would be renamed.
///
/// # Errors
/// Why it cannot be.
pub fn prepare(at: At<'_>) -> Result<PrepareRenameResponse, String> {
    let (span, _) = target(at)?;
    Ok(PrepareRenameResponse::RangeWithPlaceholder {
        range: range_of(at.text, span),
        placeholder: at.of.text(span).to_owned(),
    })
}

/// The edits that give what stands at a place another name, by file.
///
/// # Errors
/// Why it cannot have that name.
pub fn rename(
    at: At<'_>,
    name: &str,
    remake: Remake<'_>,
) -> Result<Vec<(Uri, Vec<TextEdit>)>, String> {
    let (_, number) = target(at)?;
    if !is_name(name) {
        return Err(format!(
            "`{name}` is no name: letters, digits and `_`, and no reserved word"
        ));
    }
    let mut places = at.of.names().places(number);
    places.sort_unstable();
    places.dedup();
    let mut edits: Vec<(Uri, Vec<TextEdit>)> = Vec::new();
    let mut texts: Vec<(u16, String)> = Vec::new();
    for (file, found) in (0..).zip(at.of.files()) {
        let here: Vec<Span> = places.iter().copied().filter(|s| s.file == file).collect();
        if here.is_empty() {
            continue;
        }
        let uri = at
            .of
            .uri(file)
            .ok_or("a file of the scene has no address")?;
        let mut text = found.text.clone();
        for span in here.iter().rev() {
            text.replace_range(span.range(), name);
        }
        texts.push((file, text));
        let lines = Lines::new(&found.text);
        let edit = |span: &Span| TextEdit::new(lines.range(&found.text, *span), name.to_owned());
        edits.push((uri, here.iter().map(edit).collect()));
    }
    let after = remake(&texts);
    let errors = |of: &Analysis| {
        let all = of.whole.scene.diagnostics.iter();
        all.filter(|d| d.is_error()).count()
    };
    if errors(&after) > errors(at.of) || meanings(after.names()) != meanings(at.of.names()) {
        return Err(format!(
            "`{name}` means something else in a place that is concerned"
        ));
    }
    Ok(edits)
}

/// Which declaration each use means, both by their order in the texts.
fn meanings(names: &Names) -> Vec<(u16, usize)> {
    let mut order: Vec<(Span, usize)> = names
        .defs
        .iter()
        .enumerate()
        .map(|(k, d)| (d.span, k))
        .collect();
    order.sort_unstable();
    let mut rank = vec![0; order.len()];
    for (at, (_, k)) in order.iter().enumerate() {
        if let Some(place) = rank.get_mut(*k) {
            *place = at;
        }
    }
    let mut uses: Vec<(Span, usize)> = names
        .uses
        .iter()
        .map(|u| {
            (
                u.span,
                u.to.first()
                    .and_then(|k| rank.get(*k))
                    .copied()
                    .unwrap_or(usize::MAX),
            )
        })
        .collect();
    uses.sort_unstable();
    uses.into_iter()
        .map(|(span, def)| (span.file, def))
        .collect()
}
