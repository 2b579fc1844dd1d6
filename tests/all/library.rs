//! The library in the scene language: what its items claim, that items that a
//! scene does not call cost it nothing, and that the example scenes are right.

use slowlight_compiler::eval::native::Native;
use slowlight_compiler::prelude::PRELUDE;
use slowlight_compiler::scene::{self, Scene};
use slowlight_compiler::sema::Options;
use slowlight_compiler::syntax;
use std::path::Path;

/// What claims speak of: points all around, two shapes, a yard with a ball, a camera.
const GROUND: &str = "image 16 x 16 inks black, white;
const tiny = 0.000000001;
const axis = (0.6, 0.48, 0.64);
scene yard { plane((0, 1, 0), -1) is 1; sphere((0, 0.5, 0), 0.5) is 2; }
fn near(a: vec3, b: vec3) -> bool = length(a - b) < tiny;
fn same(a: shape, b: shape, p: vec3) -> bool = {
  let r = ray(5 * unit(p + (0, 0, 9)), unit(p - 5 * unit(p + (0, 0, 9))));
  if let h = a.hit(r) then (if let k = b.hit(r) then near(h.point, k.point) and near(h.normal, k.normal) else false)
  else if let k = b.hit(r) then false else true
};
fn down(p: vec3) -> ray = ray((p.x, 5, p.z), (0, -1, 0));
fn screw(p: vec3) -> real = twist(box((-0.5, -1, -0.7), (0.6, 1, 0.8)), 90deg, 1.1).dist(p);
fn stretch(by: angle) -> real = { let k = by / 1rad; k / 2 + sqrt(1 + k * k / 4) };
fn tilted(x: real, y: real) -> real = 2 * x - 3 * y + 1;
fn across(r: ray) -> real = r.dir.x + 2 * r.dir.y;
// The same wherever on the plane five ahead of the camera a ray's point is seen from.
fn at_five(r: ray) -> real = r.at((1 - r.from.z) / r.dir.z).x;
draw (x, y) = {
  let p = ((x - 7.4) / 5, (y - 7.6) / 6, (x * y mod 13) / 6 - 1);
  let turn = (5 * x + y) * 4deg;
  let ball = sphere((0.3, 0.1, 0.2), 0.9);
  let brick = box((-0.5, -0.6, -0.7), (0.6, 0.4, 0.8));
  let lens0 = pinhole((0, 0, 6), at: (0, 0, 0));
  if CLAIM then ink(1) else ink(0)
};
";

fn right(name: &str, text: &str) -> Scene {
    let scene = scene::check(name, text);
    assert!(scene.is_right(), "{name}: {:?}", scene.diagnostics);
    scene
}

#[test]
fn every_claim_holds_at_every_pixel() {
    let claims = include_str!("library.txt").lines().skip(1);
    let mut count = 0;
    for claim in claims {
        let scene = right(claim, &GROUND.replace("CLAIM", claim));
        let graph = scene.lower(&Options::default()).expect("a graph");
        let mut native = Native::new(&graph);
        for (x, y) in (0..16).flat_map(|y| (0..16).map(move |x| (x, y))) {
            assert_eq!(native.pixel(x, y).ink, 1, "{claim} at ({x}, {y})");
        }
        count += 1;
    }
    assert!(count >= 50, "{count} claims");
}

/// An item's first line, and the texts of the library without it.
fn without_each() -> Vec<(String, Vec<(String, String)>)> {
    let whole: Vec<(String, String)> = PRELUDE
        .iter()
        .map(|(name, text)| ((*name).to_owned(), (*text).to_owned()))
        .collect();
    let mut all = Vec::new();
    for (k, (_, text)) in whole.iter().enumerate() {
        for item in syntax::parse(text, 0).0.items {
            let (start, end) = (item.span.start as usize, item.span.end as usize);
            // Constants are folded in the graph's own arena, which moves the
            // numbers of the nodes behind them and nothing else.
            if text[start..end].starts_with("const ") {
                continue;
            }
            let mut left = whole.clone();
            left[k].1.replace_range(start..end, "");
            let head = text[start..end].lines().next().unwrap_or_default();
            all.push((head.to_owned(), left));
        }
    }
    all
}

/// An item of the library that a scene can do without leaves nothing in its graph.
#[test]
fn what_is_not_called_costs_nothing() {
    let mut none = |_: &str, _: &str| Err(String::new());
    for (name, text) in [
        ("mirrors", include_str!("../../examples/mirrors.scn")),
        ("torus", include_str!("../../examples/torus.scn")),
        ("maze", include_str!("../../examples/maze.scn")),
    ] {
        let graph = |scene: &Scene| scene.lower(&Options::default()).map(|g| g.to_string());
        let whole = graph(&right(name, text)).expect("a graph");
        let mut spared = Vec::new();
        for (item, left) in without_each() {
            let scene = scene::load(name, text, Some(&left), &mut none);
            if scene.is_right() {
                assert!(graph(&scene) == Ok(whole.clone()), "{name} without {item}");
                spared.push(item);
            }
        }
        // The effects, and the shapes made of shapes, are among them.
        for part in ["effect ", "shape quadric", "shape twist", "fn stripes"] {
            assert!(spared.iter().any(|i| i.starts_with(part)), "{name}: {part}");
        }
        let effects = spared.iter().filter(|i| i.starts_with("effect ")).count();
        assert_eq!(effects, 5, "{name}: all effects of the library");
    }
}

/// Every example checks without a remark and begins with a line that says what it is.
#[test]
fn examples_are_right() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("examples") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|e| e == "scn") {
            let text = std::fs::read_to_string(&path).expect("a text");
            let name = path.display().to_string();
            assert!(text.starts_with("// "), "{name}");
            let scene = right(&name, &text);
            scene.lower(&Options::default()).expect("a graph");
            count += 1;
        }
    }
    assert!(count >= 12, "{count} examples");
}
