//! Call by need, counted: what an effect would cost does not matter on a path
//! that does not demand it.
//!
//! The body of an effect is replaced by the longest loop that the language
//! allows, and the operations of the native evaluation, which computes at first
//! need and remembers, are counted pixel by pixel, each from a fresh start. A
//! pixel demands the effect where its shade changes with the effect's value; in
//! the scenes below a value that is asked for always shows.

use slowlight_compiler::eval::native::Native;
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::prelude::PRELUDE;
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;
use slowlight_compiler::syntax::{self, tree::ItemKind};

/// Bodies by the type of the result: one value, another, the longest loop.
const REAL: [&str; 3] = [
    "0.25",
    "0.75",
    "loop (n = 0, s = 0.0) max 65535 { next(n + 1, s + 0.5) } else s",
];
const BOOL: [&str; 3] = [
    "true",
    "false",
    "loop (n = 0) max 65535 { next(n + 1) } else n > 0",
];

/// A scene's graph with another body for an effect, of its own or of the library.
fn graph(text: &str, effect: &str, body: &str) -> Graph {
    let mut changed = 0;
    let mut with_body = |text: &str| {
        let mut out = text.to_owned();
        for item in syntax::parse(text, 0).0.items {
            if let ItemKind::Effect { function, .. } = item.kind
                && function.name.text == effect
            {
                out.replace_range(function.body.span.range(), body);
                changed += 1;
            }
        }
        out
    };
    let scene = with_body(text);
    let library: Vec<(String, String)> = PRELUDE
        .iter()
        .map(|(name, text)| ((*name).to_owned(), with_body(text)))
        .collect();
    assert_eq!(changed, 1, "{effect}");
    let mut none = |_: &str, _: &str| Err(String::new());
    let scene = scene::load("scene", &scene, Some(&library), &mut none);
    let graph = scene.lower(&Options::default());
    graph.unwrap_or_else(|said| panic!("{effect}: {said:?}"))
}

/// Operations for one pixel and nothing before it.
fn cost(graph: &Graph, (x, y): (i32, i32)) -> u64 {
    let mut native = Native::new(graph);
    native.pixel(x, y);
    native.operations()
}

#[test]
fn an_effect_that_is_not_demanded_costs_nothing() {
    let cases = [
        (include_str!("../../examples/mirrors.scn"), "sky", REAL),
        (include_str!("../../examples/mirrors.scn"), "tiles", REAL),
        (include_str!("../../examples/torus.scn"), "lighting", REAL),
        (include_str!("../../examples/torus.scn"), "shadow", BOOL),
        (include_str!("../../examples/fifty.scn"), "shine", REAL),
        (include_str!("../../examples/terrain.scn"), "slope", REAL),
        // The library's own.
        (
            include_str!("../../examples/shadows.scn"),
            "occlusion",
            REAL,
        ),
        (include_str!("../../examples/fog.scn"), "fog", REAL),
    ];
    for (text, effect, [one, other, longest]) in cases {
        let scene = scene::check("scene", text);
        let own = scene.lower(&Options::default()).expect("a graph");
        let longest = graph(text, effect, longest);
        let (one, other) = (graph(text, effect, one), graph(text, effect, other));
        let (mut a, mut b) = (Native::new(&one), Native::new(&other));
        let (mut spared, mut demanded) = (0, 0);
        let (width, height) = (own.image.width as i32, own.image.height as i32);
        for (column, row) in (0..7).flat_map(|row| (0..9).map(move |column| (column, row))) {
            let at = (width * (2 * column + 1) / 18, height * (2 * row + 1) / 14);
            if a.pixel(at.0, at.1).shade == b.pixel(at.0, at.1).shade {
                assert_eq!(cost(&longest, at), cost(&own, at), "{effect} at {at:?}");
                spared += 1;
            } else if demanded < 4 {
                let paid = cost(&longest, at);
                assert!(paid > 65535, "{effect} at {at:?}: {paid}");
                demanded += 1;
            }
        }
        assert!(spared >= 4, "{effect}: {spared} pixels do without");
        assert!(demanded == 4, "{effect}: {demanded} pixels need it");
    }
}
