//! The tests of the syntax, by what they ask.
#![allow(clippy::unwrap_used)]

mod each;
mod formatted;
mod good;
mod hard;
mod words;
mod wrong;

use super::parse;
use crate::source::{Diagnostic, SourceFile, Sources};

const MIRRORS: &str = include_str!("../../../../examples/mirrors.scn");
const TORUS: &str = include_str!("scenes/torus.scn");
const MAZE: &str = include_str!("scenes/maze.scn");
const PRIMITIVES: &str = include_str!("scenes/primitives.scn");
const HELIX: &str = include_str!("scenes/helix.scn");
const SCENES: [&str; 5] = [MIRRORS, TORUS, MAZE, PRIMITIVES, HELIX];

/// Diagnostics as plain text: place, message, label, help.
fn plain(text: &str, diagnostics: &[Diagnostic]) -> String {
    let mut sources = Sources::default();
    sources.add(SourceFile {
        name: "scene".into(),
        text: text.into(),
        library: false,
    });
    let mut out = String::new();
    for diagnostic in diagnostics {
        let (line, column) = sources.line_column(diagnostic.span);
        out += &format!("{line}:{column} {}", diagnostic.message);
        if !sources.text(diagnostic.span).is_empty() {
            out += &format!(" [{}]", sources.text(diagnostic.span).escape_debug());
        }
        if !diagnostic.label.is_empty() {
            out += &format!(" ({})", diagnostic.label);
        }
        for other in &diagnostic.others {
            let (line, column) = sources.line_column(other.span);
            out += &format!("\n     {line}:{column} {}", other.text);
        }
        if let Some(help) = &diagnostic.help {
            out += &format!("\n     help: {help}");
        }
        out.push('\n');
    }
    out
}

/// Compares with the file of that name; `INSTA_UPDATE=always` rewrites it.
fn snapshot(name: &str, text: &str) {
    insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
        insta::assert_snapshot!(name, text);
    });
}
