//! Small scenes to programs and graphs; wrong scenes to diagnostics.
#![allow(clippy::unwrap_used)]

use crate::flow::verify::verify;
use crate::scene::{Scene, check};
use crate::sema::Options;
use crate::source::{Diagnostic, Sources};

const MIRRORS: &str = include_str!("../../../../examples/mirrors.scn");

fn plain(sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    let mut out = String::new();
    let place = |span| {
        let (line, column) = sources.line_column(span);
        let file = sources.files.get(span.file as usize);
        match file {
            Some(f) if f.library => format!("{}:{line}:{column}", f.name),
            _ => format!("{line}:{column}"),
        }
    };
    for d in diagnostics {
        out += &format!(
            "{} {} [{}]",
            place(d.span),
            d.message,
            sources.text(d.span).escape_debug()
        );
        for other in &d.others {
            out += &format!("\n     {} {}", place(other.span), other.text);
        }
        if let Some(help) = &d.help {
            out += &format!("\n     help: {help}");
        }
        out.push('\n');
    }
    out
}

fn right(text: &str) -> Scene {
    let scene = check("scene", text);
    assert!(
        scene.is_right(),
        "{}",
        plain(&scene.sources, &scene.diagnostics)
    );
    scene
}

/// Compares with the file of that name; `INSTA_UPDATE=always` rewrites it.
fn snapshot(name: &str, text: &str) {
    insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
        insta::assert_snapshot!(name, text);
    });
}

#[test]
fn mirrors_becomes_a_graph() {
    let graph = right(MIRRORS).lower(&Options::default()).unwrap();
    verify(&graph).unwrap();
    snapshot("mirrors", &format!("{MIRRORS}\n---\n{graph}"));
}
