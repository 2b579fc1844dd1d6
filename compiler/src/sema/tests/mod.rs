//! Small scenes to programs and graphs; wrong scenes to diagnostics.
#![allow(clippy::unwrap_used)]

mod any;
mod bounds;
mod compositions;
mod each;
mod hard;
mod instances;
mod normals;
mod pictures;

use crate::analysis::verify::verify;
use crate::eval::native::Native;
use crate::scene::{Scene, check};
use crate::sema::{Freeze, Options};
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
    let scene = right(MIRRORS);
    let graph = scene.lower(&Options::default()).unwrap();
    verify(&graph).unwrap();
    let program = &scene.program;
    snapshot(
        "mirrors",
        &format!("{MIRRORS}\n---\n{program}\n---\n{graph}"),
    );
}

/// The picture that BBC BASIC's demo draws, in `f64`; its first nine rows are
/// not drawn.
#[test]
fn mirrors_is_the_picture_of_the_reference() {
    let graph = right(MIRRORS).lower(&Options::default()).unwrap();
    let file: &[u8] = include_bytes!("../../../../tests/reference/mirrors-f64.pgm");
    let inks = &file[file.len() - 320 * 240..];
    let mut native = Native::new(&graph);
    for y in 9..240 {
        for x in 0..320 {
            let ink = native.pixel(x, y).ink;
            assert_eq!(ink, inks[(y * 320 + x) as usize], "({x}, {y})");
        }
    }
}

/// A mistake a paragraph: `== what`, then the scene. What every scene needs is
/// added where it is missing.
#[test]
fn every_mistake_is_named() {
    let mut out = String::new();
    let mut count = 0;
    for case in include_str!("wrong.txt").split("\n== ") {
        let (what, text) = case.trim_start_matches("== ").split_once('\n').unwrap();
        let mut text = format!("{text}\n");
        if !text.contains("image ") && !text.contains("draw ") {
            text += "image 8 x 8 inks black, white;\ndraw (x, y) = ink(0);\n";
        } else if what == "two images" {
            text += "draw (x, y) = ink(0);\n";
        }
        let scene = check("scene", &text);
        assert!(!scene.is_right(), "{what} passes");
        for d in &scene.diagnostics {
            assert_eq!(d.span.file, 0, "{what}: {d:?} lies in the library");
        }
        out += &format!("== {what}\n{}", plain(&scene.sources, &scene.diagnostics));
        count += 1;
    }
    assert!(count >= 60);
    snapshot("wrong", &out);
}

/// A scene a paragraph: its program and graph, library items left out.
#[test]
fn small_scenes_become_graphs() {
    for case in include_str!("good.txt").split("\n== ") {
        let (name, text) = case.trim_start_matches("== ").split_once('\n').unwrap();
        let mut full = text.to_owned();
        if !full.contains("image ") {
            full += "\nimage 8 x 8 inks black, grey, white;\n";
        }
        let scene = right(&full);
        let graph = scene.lower(&Options::default()).unwrap();
        verify(&graph).unwrap();
        let program = scene.program.to_string();
        let own: Vec<&str> = program
            .lines()
            .take_while(|l| !l.starts_with("library"))
            .collect();
        let own = own.join("\n");
        let name = name.replace(' ', "_");
        snapshot(
            &format!("good_{name}"),
            &format!("{text}\n---\n{own}\n---\n{graph}"),
        );
    }
}

#[test]
fn options_change_the_graph() {
    let scene = right(MIRRORS);
    let mut out = String::new();
    let mut show = |what: &str, options: Options| {
        out += &format!("== {what}\n");
        match scene.lower(&options) {
            Ok(graph) => {
                verify(&graph).unwrap();
                let text = graph.to_string();
                let head = text.lines().take_while(|l| !l.starts_with('%'));
                let tail = text.lines().filter(|l| l.starts_with("effect"));
                for line in head.chain(tail) {
                    out += &format!("{line}\n");
                }
            }
            Err(said) => out += &plain(&scene.sources, &said),
        }
    };
    let set = |name: &str, values: &[f64]| Options {
        set: vec![(name.into(), values.to_vec())],
        ..Options::default()
    };
    let freeze = |freeze| Options {
        freeze,
        ..Options::default()
    };
    let without = |name: &str| Options {
        without: vec![name.into()],
        ..Options::default()
    };
    let inks = |n| Options {
        inks: Some(n),
        ..Options::default()
    };
    show("set", set("eye", &[0.35, 0.25, 3.6]));
    show("set outside the range", set("eye", &[0.35, 0.25, 9.0]));
    show("set too few", set("eye", &[1.0]));
    show("set not a number", set("eye", &[f64::NAN, 0.0, 3.0]));
    show("set unknown", set("eyes", &[1.0]));
    show("freeze all", freeze(Freeze::All));
    show("freeze eye", freeze(Freeze::Some(vec!["eye".into()])));
    show("freeze unknown", freeze(Freeze::Some(vec!["ear".into()])));
    show("without mirrors", without("mirrors"));
    show("without tiles", without("tiles"));
    show("without unknown", without("haze"));
    show("two inks", inks(2));
    show("three inks", inks(3));
    show("sixteen inks", inks(16));
    snapshot("options", &out);
}
