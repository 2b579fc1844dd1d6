//! What is true of every scene: the checker and the lowering end, with a graph
//! that holds together or with a diagnostic. The short form of `fuzz/`.

use super::{MIRRORS, right};
use crate::analysis::verify::verify;
use crate::eval::native::Native;
use crate::scene::check;
use crate::sema::{Freeze, Options};
use proptest::prelude::*;

const TORUS: &str = include_str!("../../../../examples/torus.scn");
const MAZE: &str = include_str!("../../../../examples/maze.scn");
const GLASS: &str = include_str!("../../../../examples/glass.scn");
const TWIST: &str = include_str!("../../../../examples/twist.scn");
const HELIX: &str = include_str!("../../../syntax/src/tests/scenes/helix.scn");
const SCENES: [&str; 6] = [MIRRORS, TORUS, MAZE, GLASS, TWIST, HELIX];

/// What may stand in the place of a word.
const WORDS: [&str; 42] = [
    "x",
    "y",
    "0",
    "1",
    "0.5",
    "90deg",
    "true",
    "none",
    "inks",
    "p",
    "r",
    "h",
    "eye",
    "world",
    "(1, 2)",
    "(0, 1, 0)",
    "[1, 2; 3, 4]",
    "vec3",
    "real",
    "int",
    "real?",
    "hit",
    "shape",
    "sqrt",
    "sphere",
    "next",
    "loop",
    "each",
    "..",
    "if",
    "let",
    "then",
    "else",
    "max",
    "and",
    "mod",
    "^",
    "-",
    ".",
    ";",
    "{",
    ")",
];

fn frozen() -> Options {
    Options {
        freeze: Freeze::All,
        ..Options::default()
    }
}

/// A text cut where words begin and end.
fn words(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let end = match word(first) {
            true => rest.find(|c| !word(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (head, tail) = rest.split_at(end);
        found.push(head);
        rest = tail;
    }
    found
}

/// A number made of the pixel, a param and whatever gives numbers.
fn number() -> impl Strategy<Value = String> {
    let leaf = prop::sample::select(vec!["x", "y", "k", "n", "0", "3", "0.25", "(-2.5)"]);
    leaf.prop_map(str::to_owned).prop_recursive(4, 40, 4, |inner| {
        let forms = prop::sample::select(vec![
            "(A + B)", "(A - B)", "(A * B)", "(A / B)", "(A mod B)", "(A div B)", "(A ^ 2)",
            "(A ^ B)", "sqrt(A)", "floor(A)", "sign(A)", "abs(A)", "sin(A * 1rad)",
            "max(A, B)", "clamp(A, B, C)", "dot((A, B), (C, D))",
            "(if A < B then C else D)",
            "(if A < B and not C == D then A else B)",
            "{ let q = A; q * B + q - C }",
            "(loop (i = 0, s = A) max 5 { if s > B then s else next(i + 1, s + C) } else s - D)",
            "(loop (i = A) max 3 { next(i + 0.5) } else i)",
            "(if let h = sphere((A, B, 0), 2).hit(ray((x, y, 9), (0, 0, -1))) then h.t + h.normal.x * C else D)",
            "(if let h = w.trace(ray((A, B, 9), (0, 0, -1)), far: C) then h.tag else D)",
            "w.dist((A, B, C))", "[1, 2.5; 3, 4][floor(A), floor(B)]", "m[floor(A), floor(B)]",
            "twice(f, A)", "e(A, b: B)",
        ]);
        (forms, prop::collection::vec(inner, 4)).prop_map(|(form, parts)| {
            let mut out = String::new();
            for c in form.chars() {
                match "ABCD".find(c) {
                    Some(at) => out += &parts[at],
                    None => out.push(c),
                }
            }
            out
        })
    })
}

const AROUND: &str = "image 8 x 8 inks black, grey, white;
param k: real = 1.5 in -9 .. 9;
param n: int = 3 in 0 .. 5;
map m { \"ab\" \"ca\" } where 'a' => 1, 'b' => 0, 'c' => 7;
scene w { sphere((1, 2, 0), 3) is p.x; plane((0, 0, 1), -2) is 0.5; }
fn f(a: real) -> real = a / 2 + k;
fn twice(g: fn(real) -> real, a: real) -> real = g(g(a));
effect e(a: real, b: real = 2) -> real else a = a * b;
";

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_change_of_a_scene_is_refused_or_lowered(
        scene in 0..SCENES.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0..2 * WORDS.len()), 1..4),
    ) {
        let mut text = words(SCENES[scene]);
        for (at, from, word) in changes {
            let new = match WORDS.get(word) {
                Some(word) => word,
                None => text[from.index(text.len())],
            };
            let at = at.index(text.len());
            text[at] = new;
        }
        let scene = check("scene", &text.concat());
        for options in [Options::default(), frozen()] {
            match scene.lower(&options) {
                Ok(graph) => verify(&graph).unwrap(),
                Err(said) => prop_assert!(!said.is_empty()),
            }
        }
    }

    /// Numbers always have a graph, and folding the params changes no pixel.
    /// What is a constant outside an operation's domain is refused.
    #[test]
    fn any_number_can_be_drawn(number in number()) {
        let text = format!("{AROUND}draw (x, y) = ink(floor({number}));");
        let scene = check("scene", &text);
        let domain = ["divides by zero", "square root", "power", "logarithm"];
        for d in &scene.diagnostics {
            prop_assert!(domain.iter().any(|w| d.message.contains(w)), "{text}\n{d:?}");
        }
        if scene.is_right() {
            let graph = right(&text).lower(&Options::default()).unwrap();
            verify(&graph).unwrap();
            if let Ok(folded) = scene.lower(&frozen()) {
                verify(&folded).unwrap();
                let (mut live, mut folded) = (Native::new(&graph), Native::new(&folded));
                for (x, y) in [(0, 0), (3, 5), (7, 7)] {
                    prop_assert_eq!(live.pixel(x, y), folded.pixel(x, y), "{} at ({}, {})", text, x, y);
                }
            }
        }
    }
}
