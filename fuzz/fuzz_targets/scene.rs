//! Any bytes as a scene: decoded, parsed, checked and lowered to the graph, and
//! formatted twice where they can be read.
//!
//! What is held is what the product promises of every input: no panic, no hang
//! (`-timeout`), no unbounded memory (`-rss_limit_mb`), diagnostics that lie in
//! the text, graphs that the verifier accepts, and a formatter that has no
//! second thoughts. The library is parsed once; it is checked with every scene.
#![no_main]

mod library;

use libfuzzer_sys::fuzz_target;
use library::with_library;
use slowlight_compiler::analysis::verify::verify;
use slowlight_compiler::sema::{self, Freeze, Options, Program};
use slowlight_compiler::source::Diagnostic;
use slowlight_compiler::syntax::{self, format::format};

fuzz_target!(|bytes: &[u8]| {
    let (text, said) = syntax::decode(bytes, 0);
    lies_in(&text, &said);
    let (tree, said) = syntax::parse(&text, 0);
    lies_in(&text, &said);
    // Where items could not be read, what refers to them would be called
    // unknown: the product does not show what the checker says then, but the
    // checker must stand it.
    let readable = !said.iter().any(Diagnostic::is_error);
    if readable {
        formats_once(&text);
    }
    with_library(tree, |files| {
        let (program, said) = sema::check(files);
        lies_in(&text, &said);
        if readable && !said.iter().any(Diagnostic::is_error) {
            lowers(&text, &program);
        }
    });
});

/// Every place in the scene that is spoken of is there.
fn lies_in(text: &str, said: &[Diagnostic]) {
    for diagnostic in said {
        let others = diagnostic.others.iter().map(|o| o.span);
        for span in others.chain([diagnostic.span]) {
            let inside = span.file != 0 || text.get(span.range()).is_some();
            assert!(inside, "{diagnostic:?}");
        }
    }
}

fn formats_once(text: &str) {
    let once = format(text, 0).expect("what parses can be formatted");
    let twice = format(&once, 0).expect("what was formatted can be formatted");
    assert_eq!(once, twice);
}

/// As it is, and as far as it can be worked out beforehand.
fn lowers(text: &str, program: &Program) {
    let frozen = Options {
        inks: Some(2),
        freeze: Freeze::All,
        ..Options::default()
    };
    for options in [Options::default(), frozen] {
        match sema::lower(program, &options) {
            Ok(graph) => verify(&graph).expect("a graph that holds together"),
            Err(said) => lies_in(text, &said),
        }
    }
}
