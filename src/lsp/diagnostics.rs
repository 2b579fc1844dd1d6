//! The compiler's diagnostics for an editor, file by file.

use super::analysis::Analysis;
use super::text::range_of;
use lsp_types::{
    Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, DiagnosticTag, Location, Range,
    Uri,
};
use slowlight_compiler::source::{self, Span};
use std::collections::BTreeMap;

/// What is to be said of a scene's files, those with nothing to say included.
pub fn of(analysis: &Analysis) -> BTreeMap<String, (Uri, Vec<Diagnostic>)> {
    let mut all = BTreeMap::new();
    for (number, file) in (0..).zip(analysis.files()) {
        if let Some(uri) = analysis.uri(number).filter(|_| !file.library) {
            all.insert(uri.as_str().to_owned(), (uri, Vec::new()));
        }
    }
    for one in analysis.said() {
        // What goes wrong inside of the library is shown where the scene has to do with it.
        let place = own(analysis, one).unwrap_or_else(|| Span::new(0, 0, 0));
        let uri = analysis.uri(place.file);
        let list = uri.and_then(|uri| all.get_mut(uri.as_str()));
        if let Some((_, list)) = list {
            list.push(diagnostic(analysis, one, place));
        }
    }
    all
}

/// The first of a diagnostic's places that is not the library's.
fn own(analysis: &Analysis, said: &source::Diagnostic) -> Option<Span> {
    let others = said.others.iter().map(|other| other.span);
    let mut all = std::iter::once(said.span).chain(others);
    all.find(|span| {
        let file = analysis.files().get(usize::from(span.file));
        file.is_some_and(|file| !file.library)
    })
}

fn diagnostic(analysis: &Analysis, said: &source::Diagnostic, place: Span) -> Diagnostic {
    let text = analysis.files().get(usize::from(place.file));
    let range = text.map_or(Range::default(), |file| range_of(&file.text, place));
    let mut message = said.message.clone();
    if !said.label.is_empty() {
        message += &format!("\n{}", said.label);
    }
    if let Some(help) = &said.help {
        message += &format!("\nhelp: {help}");
    }
    let elsewhere = (said.span != place).then_some((said.span, "in the library here"));
    let others = said.others.iter().map(|o| (o.span, o.text.as_str()));
    let others = elsewhere
        .into_iter()
        .chain(others)
        .filter_map(|(span, text)| {
            let location: Location = analysis.location(span)?;
            let message = match text.is_empty() {
                true => "here".to_owned(),
                false => text.to_owned(),
            };
            Some(DiagnosticRelatedInformation { location, message })
        });
    let others: Vec<DiagnosticRelatedInformation> = others.collect();
    let unused = said
        .message
        .contains("never used")
        .then(|| vec![DiagnosticTag::UNNECESSARY]);
    Diagnostic {
        range,
        severity: Some(match said.is_error() {
            true => DiagnosticSeverity::ERROR,
            false => DiagnosticSeverity::WARNING,
        }),
        source: Some("slowlight".to_owned()),
        message,
        related_information: (!others.is_empty()).then_some(others),
        tags: unused,
        ..Diagnostic::default()
    }
}
