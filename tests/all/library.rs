//! The library in the scene language: what its items claim, that items that a
//! scene does not call cost it nothing, and that the example scenes are right.

use slowlight_compiler::eval::native::Native;
use slowlight_compiler::prelude::PRELUDE;
use slowlight_compiler::scene::{self, Scene};
use slowlight_compiler::sema::Options;
use slowlight_compiler::syntax;
use std::collections::BTreeSet;
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

/// The library's files: names and texts.
type Texts = Vec<(String, String)>;

fn library() -> Texts {
    let own = |(name, text): &(&str, &str)| ((*name).to_owned(), (*text).to_owned());
    PRELUDE.iter().map(own).collect()
}

/// The items of a file, from first to last byte.
fn items(text: &str) -> Vec<std::ops::Range<usize>> {
    let items = syntax::parse(text, 0).0.items.into_iter();
    items.map(|item| item.span.range()).collect()
}

/// An item's first line, and the library without it.
fn without_each() -> Vec<(String, Texts)> {
    let whole = library();
    let mut all = Vec::new();
    for (k, (_, text)) in whole.iter().enumerate() {
        for item in items(text) {
            let mut left = whole.clone();
            left[k].1.replace_range(item.clone(), "");
            let head = text[item].lines().next().unwrap_or_default();
            all.push((head.to_owned(), left));
        }
    }
    all
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    let code = text
        .lines()
        .map(|l| l.split("//").next().unwrap_or_default());
    code.flat_map(|l| l.split(|c: char| !c.is_alphanumeric() && c != '_'))
}

/// The library without every item that a scene cannot reach, and how many those
/// are. What the compiler itself calls stays: `solve.scn`, which it says is for that.
fn without_unreached(scene: &str) -> (Texts, usize) {
    let mut whole = library();
    let mut known: BTreeSet<String> = words(scene).map(str::to_owned).collect();
    // What the compiler calls by itself.
    let own = ["solve.scn", "instances.scn", "inside.scn"];
    let own = whole
        .iter()
        .filter(|(name, _)| own.contains(&name.as_str()));
    known.extend(own.flat_map(|(_, text)| words(text).map(str::to_owned)));
    loop {
        let before = known.len();
        for (_, text) in &whole {
            for item in items(text) {
                let text = &text[item];
                if words(text).nth(1).is_some_and(|name| known.contains(name)) {
                    known.extend(words(text).map(str::to_owned));
                }
            }
        }
        if known.len() == before {
            break;
        }
    }
    let mut gone = 0;
    for (_, text) in &mut whole {
        for item in items(text).into_iter().rev() {
            let name = words(&text[item.clone()]).nth(1).map(str::to_owned);
            if name.is_none_or(|name| !known.contains(&name)) {
                text.replace_range(item, "");
                gone += 1;
            }
        }
    }
    (whole, gone)
}

/// A scene with another library; none where the scene needs what that lacks.
fn with(name: &str, text: &str, library: &Texts) -> Option<String> {
    let mut none = |_: &str, _: &str| Err(String::new());
    let scene = scene::load(name, text, Some(library), &mut none);
    printed(&scene)
}

fn printed(scene: &Scene) -> Option<String> {
    scene.lower(&Options::default()).ok().map(|g| g.to_string())
}

/// An item of the library that a scene can do without leaves nothing in its
/// graph: not a node, not a number of a node.
#[test]
fn what_is_not_called_costs_nothing() {
    let each = without_each();
    for (name, text) in [
        ("mirrors", include_str!("../../examples/mirrors.scn")),
        ("torus", include_str!("../../examples/torus.scn")),
        ("maze", include_str!("../../examples/maze.scn")),
        ("primitives", include_str!("../../examples/primitives.scn")),
    ] {
        let whole = printed(&right(name, text)).expect("a graph");
        let mut spared = Vec::new();
        for (item, left) in &each {
            if let Some(graph) = with(name, text, left) {
                assert!(graph == whole, "{name} without {item}");
                spared.push(item);
            }
        }
        // The effects, and the shapes made of shapes, are among them.
        for part in [
            "const pi",
            "effect ",
            "shape quadric",
            "shape twist",
            "fn stripes",
        ] {
            assert!(spared.iter().any(|i| i.starts_with(part)), "{name}: {part}");
        }
        let effects = |all: &[&String]| all.iter().filter(|i| i.starts_with("effect ")).count();
        let all: Vec<&String> = each.iter().map(|(item, _)| item).collect();
        assert_eq!(
            effects(&spared),
            effects(&all),
            "{name}: all effects of the library"
        );
        // Many others serve items that a scene may call, and cannot go alone.
        assert!(spared.len() > each.len() / 3, "{name}: {}", spared.len());
    }
}

/// All that a scene does not reach leaves nothing together, in every scene.
#[test]
fn a_scene_needs_only_what_it_reaches() {
    for (name, text) in scenes() {
        let whole = printed(&right(&name, &text)).expect("a graph");
        let (left, gone) = without_unreached(&text);
        assert!(gone >= 20, "{name}: {gone} items are not reached");
        assert!(with(&name, &text, &left) == Some(whole), "{name}");
    }
}

/// What the two tests above would see, did an item that is not called leave
/// something: a constant that stands in a scene, a function that it calls.
#[test]
fn what_is_called_shows() {
    let text = include_str!("../../examples/mirrors.scn");
    let whole = printed(&right("mirrors", text)).expect("a graph");
    let mut other = library();
    let vectors = other.iter_mut().find(|(name, _)| name == "vectors.scn");
    let (_, vectors) = vectors.expect("vectors");
    *vectors = vectors.replace("d - 2 * dot(d, n) * n", "d - (2 + 0 * pi) * dot(d, n) * n");
    let graph = with("mirrors", text, &other).expect("a graph");
    assert!(graph != whole);
}

/// The example scenes: names and texts.
fn scenes() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("examples") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|e| e == "scn") {
            let text = std::fs::read_to_string(&path).expect("a text");
            found.push((path.display().to_string(), text));
        }
    }
    assert!(found.len() >= 12, "{} examples", found.len());
    found
}

/// Every example checks without a remark and begins with a line that says what it is.
#[test]
fn examples_are_right() {
    for (name, text) in scenes() {
        assert!(text.starts_with("// "), "{name}");
        right(&name, &text)
            .lower(&Options::default())
            .expect("a graph");
    }
}
