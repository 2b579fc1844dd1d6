//! Derived bounding boxes: they hold all of their shapes, closely, and nothing that a ray meets
//! is lost by them.

use super::compositions::compositions;
use super::right;
use crate::eval::native::Native;
use crate::ir::extent::Extent;
use crate::scene::{Scene, check};
use crate::sema::lower::extents;
use crate::sema::{Instancing, Options, Ways};

const SHAPES: &[&str] = &[
    "sphere((0.3, 0.1, 0.2), 0.9)",
    "sphere((400, 30, -20), 0.5)",
    "box((-0.5, -0.6, -0.7), (0.6, 0.4, 0.8))",
    "torus((0.4, 0, 0), 1, 0.3)",
    "spindle((0, 0.2, 0), 0.5, 0.7)",
    "clip(cylinder((0, 0, 0), (0, 1, 0), 0.5), slab(-1, 1))",
    "clip(cone((0, 1, 0), (0, -1, 0), 30deg), slab(-1, 1))",
    "quadric((0, 0.5, 0), (1, 4, 0.5))",
    "superquadric((0, 0, 0), (1, 2, 0.5), 4)",
    "union(sphere((-1, 0, 0), 0.5), box((0, 0, 0), (1, 1, 1)))",
    "smooth_union(sphere((-0.4, 0, 0), 0.5), sphere((0.4, 0, 0), 0.5), 0.2)",
    "smooth_difference(sphere((0, 0, 0), 1), sphere((1, 0, 0), 0.7), 0.1)",
    "smooth_intersection(sphere((0, 0, 0), 1), box((0, 0, 0), (1, 1, 1)), 0.1)",
    "difference(sphere((0, 0, 0), 1), sphere((1, 0, 0), 0.7))",
    "intersection(sphere((0, 0, 0), 1), box((0, 0, 0), (1, 1, 1)))",
    "box((-1, -1, -1), (1, 1, 1)).rotation((0, 1, 0), 28deg)",
    "box((-1, -0.2, -0.3), (1, 0.2, 0.3)).rotation((0.6, 0.48, 0.64), 50deg)",
    "sphere((0, 0, 0), 0.5).translation((3, -2, 1))",
    "box((-1, -1, -1), (1, 2, 1)).scaling(3)",
    "sphere((0, 0, 0), 0.5).repetition((2, 2, 2), 1)",
    "onion(sphere((0, 0, 0), 1), 0.1)",
    "twist(box((-0.5, -1, -0.7), (0.6, 1, 0.8)), 90deg, 1.1)",
    "mine()",
    "bumpy()",
    "turned(turns)",
    "julia()",
    "pieces()",
    "blob()",
    "tower()",
    "lens()",
];

const OWN: &str = "
param turns: real = 0.3 in 0 .. 1;
shape mine() { dist(p) = { let q = abs(p - (1, 2, 3)) - (1, 0.5, 0.25); length(max(q, (0, 0, 0))) + min(max(q.x, max(q.y, q.z)), 0) - 0.1 }; }
shape bumpy() { dist(p) = (length(p) - 1 - 0.1 * sin(p.x * 5rad) * sin(p.y * 5rad) * sin(p.z * 5rad)) / 2; }
shape turned(by: real) { dist(p) = { let c = cos(by * 1rad); let s = sin(by * 1rad); let q = (c * p.x - s * p.z, p.y, s * p.x + c * p.z); max(abs(q.x) - 1, max(abs(q.y) - 0.5, abs(q.z) - 0.7)) }; }
shape julia() { f(p) = (loop (q = p, k = 0) max 4 { if k == 3 or dot(q, q) > 16 then dot(q, q) - 4 else next((q.x * q.x - q.y * q.y - q.z * q.z - 0.2, 2 * q.x * q.y, 2 * q.x * q.z + 0.1), k + 1) } else 0); }
shape pieces() { dist(p) = (loop (k = 0, d = 9.0) max 5 { if k == 4 then d else next(k + 1, min(d, length(p - (k - 1.5, 0.2 * k, 0)) - 0.3)) } else 9); }
shape hollow() { dist(p) = 1 - length(p); }
shape blob() { f(p) = 1 - 0.3 / dot(p, p) - 0.2 / dot(p - (1, 0, 0), p - (1, 0, 0)); }
shape tower() { dist(p) = max(length(p.xz) - 0.4 - 0.2 * p.y ^ 2, abs(p.y) - 1); }
shape lens() { f(p) = max(length(p - (0.5, 0, 0)) - 1, length(p + (0.5, 0, 0)) - 1); }
";

fn text_of(shape: &str, draw: &str) -> String {
    sized(160, shape, draw)
}

fn sized(side: i32, shape: &str, draw: &str) -> String {
    let head = format!("image {side} x {side} inks black, white;\n{OWN}");
    format!("{head}scene s {{ {shape} is 1; }}\ndraw (x, y) = {draw};")
}

fn scene_of(shape: &str, draw: &str) -> Scene {
    right(&text_of(shape, draw))
}

fn box_of(shape: &str) -> Option<Extent> {
    let scene = scene_of(shape, "ink(0)");
    let found = extents(&scene.program, &Options::default()).expect(shape);
    found.first().copied().flatten()
}

/// The points of a cuboid that a scene of so many pixels asks for, one a pixel: evenly across,
/// in the third direction by the golden ratio.
fn at(low: [f64; 3], high: [f64; 3], side: i32, (x, y): (i32, i32)) -> [f64; 3] {
    let third = (f64::from(side * y + x) * 0.618_033_988_75).fract();
    let part = [
        (f64::from(x) + 0.5) / f64::from(side),
        (f64::from(y) + 0.5) / f64::from(side),
        third,
    ];
    [0, 1, 2].map(|k| low[k] + (high[k] - low[k]) * part[k])
}

/// How much wider a shape's box is than what is in it, by `side` times as many points in twice
/// the box, all of which that are in the shape are in its box; nothing where it has no box, or
/// no point is in it.
fn widths(shape: &str, side: i32) -> Option<[f64; 3]> {
    let of = box_of(shape).filter(Extent::is_finite)?;
    // Half as wide again to each side.
    let more = [0, 1, 2].map(|k| (of.high[k] - of.low[k]) / 2.0);
    let low = [0, 1, 2].map(|k| of.low[k] - more[k]);
    let high = [0, 1, 2].map(|k| of.high[k] + more[k]);
    let [a, b, c] = [0, 1, 2].map(|k| (low[k], high[k] - low[k]));
    let place = format!(
        "(({}) + {} * (x + 0.5) / {side}, ({}) + {} * (y + 0.5) / {side}, ({}) + {} * (({side} * y + x) * 0.61803398875 mod 1))",
        a.0, a.1, b.0, b.1, c.0, c.1
    );
    let inside = format!("if {shape}.f({place}) <= 0 then ink(1) else ink(0)");
    let graph = right(&sized(side, shape, &inside)).lower(&Options::default());
    let graph = graph.expect(shape);
    let mut native = Native::new(&graph);
    let mut seen = [(f64::INFINITY, f64::NEG_INFINITY); 3];
    for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
        if native.pixel(x, y).ink == 0 {
            continue;
        }
        let point = at(low, high, side, (x, y));
        for k in 0..3 {
            assert!(
                (of.low[k]..=of.high[k]).contains(&point[k]),
                "{shape} at {point:?} is not in {of:?}"
            );
            seen[k] = (seen[k].0.min(point[k]), seen[k].1.max(point[k]));
        }
    }
    // What is seen is less than what is there, by what lies between points.
    let found = [0, 1, 2].map(|k| (of.high[k] - of.low[k]) / (seen[k].1 - seen[k].0));
    found.iter().all(|w| *w >= 1.0).then_some(found)
}

/// Of so many shapes, how many axes are how wide, and how many shapes have no box.
fn boxes_hold(shapes: &[String], side: i32) {
    let (mut all, mut unknown) = (Vec::new(), Vec::new());
    for shape in shapes {
        match widths(shape, side) {
            Some(of) => all.extend(of.into_iter().map(|width| (width, shape))),
            None => unknown.push(shape),
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let wide = all.iter().filter(|w| w.0 > 1.5).count();
    let median = all.get(all.len() / 2).map_or(0.0, |w| w.0);
    println!(
        "{} shapes, {side} x {side} points each: {} have no box or nothing in it; of {} axes {wide} are more than 1.5 times as wide as what is seen, the median {median:.2}",
        shapes.len(),
        unknown.len(),
        all.len()
    );
    let widest = &all[all.len() - wide..];
    assert!(10 * wide <= all.len(), "{widest:?}");
    assert!(10 * unknown.len() <= shapes.len(), "{unknown:?}");
}

#[test]
fn boxes_hold_their_shapes_and_hold_them_closely() {
    let shapes: Vec<String> = SHAPES.iter().map(|s| (*s).to_owned()).collect();
    boxes_hold(&shapes, 160);
}

#[test]
fn boxes_hold_random_compositions() {
    boxes_hold(&compositions(40), 100);
}

/// `cargo test --release -p slowlight-compiler --lib a_million_points -- --ignored --nocapture`
#[test]
#[ignore = "takes some minutes"]
fn boxes_hold_a_million_points_of_each_shape() {
    let shapes: Vec<String> = SHAPES.iter().map(|s| (*s).to_owned()).collect();
    boxes_hold(&shapes, 1000);
    boxes_hold(&compositions(200), 1000);
}

#[test]
fn what_has_no_end_has_an_open_box_or_none() {
    let ground = box_of("plane((0, 1, 0), -1)").expect("a face");
    assert_eq!(ground.low, [f64::NEG_INFINITY; 3]);
    assert!((-1.0..-0.9).contains(&ground.high[1]), "{ground:?}");
    assert_eq!(
        (ground.high[0], ground.high[2]),
        (f64::INFINITY, f64::INFINITY)
    );
    assert_eq!(box_of("plane((0.6, 0.48, 0.64), -1)"), None);
    assert_eq!(box_of("hollow()"), None);
}

#[test]
fn params_are_anywhere_in_their_ranges() {
    let of = box_of("sphere((10 * turns, 0, 0), 1)").expect("a box");
    assert!(of.low[0] <= -1.0 && of.high[0] >= 11.0, "{of:?}");
}

/// Draws shapes with and without boxes, whose pictures must be one: how many pictures, and what
/// was not seen in its.
fn nothing_is_lost(shapes: &[String]) -> (usize, Vec<(&String, &'static str)>) {
    // By the last a row and a column of rays are along the axes. Steps that begin at the box may
    // end a part of an offset farther, so that only what is hit is compared there.
    let aside = "pinhole((5, 3, 7), at: (0.2, 0.3, 0), field: 40deg).through(x, y)";
    let along = "pinhole((0.21, 0.13, 7), at: (0.21, 0.13, 0), field: 40deg).through_point(x + 1.5, y + 1.5)";
    let lit = "0.2 + 0.7 * lambert(h, (0.48, 0.64, 0.6))";
    let march = "march(r, steps: 90, near: 0.001, far: 30)";
    let views = [
        (aside, "trace(r, far: 30)", lit, "trace"),
        (aside, march, lit, "march"),
        (along, "trace(r, far: 30)", "1", "trace along axes"),
    ];
    let (mut pictures, mut unseen) = (0, Vec::new());
    for shape in shapes {
        for (ray, find, shade, how) in views {
            let draw = format!(
                "{{ let r = {ray}; \
                 let v = if let h = s.{find} then {shade} else 0; \
                 threshold(v, bayer(4)[x div 2 mod 4, y div 2 mod 4]) }}"
            );
            // Not all have a `dist` to march by.
            let scene = check("scene", &text_of(shape, &draw));
            if !scene.is_right() {
                continue;
            }
            let picture = |unbounded| {
                let options = Options {
                    ways: Ways {
                        unbounded,
                        ..Ways::default()
                    },
                    ..Options::default()
                };
                let graph = scene.lower(&options).expect(shape);
                let mut native = Native::new(&graph);
                let places = (0..80).flat_map(|y| (0..80).map(move |x| (2 * x, 2 * y)));
                places
                    .map(|(x, y)| native.pixel(x, y).ink)
                    .collect::<Vec<_>>()
            };
            let (with, without) = (picture(false), picture(true));
            pictures += 1;
            if !with.contains(&1) {
                unseen.push((shape, how));
            }
            let differ: Vec<(usize, usize)> = (0..with.len())
                .filter(|&k| with[k] != without[k])
                .map(|k| (2 * (k % 80), 2 * (k / 80)))
                .collect();
            assert_eq!(differ, [], "{shape} by {how}");
        }
    }
    (pictures, unseen)
}

#[test]
fn nothing_is_lost_by_boxes() {
    let shapes: Vec<String> = SHAPES.iter().map(|s| (*s).to_owned()).collect();
    let (pictures, unseen) = nothing_is_lost(&shapes);
    // Two are out of sight.
    assert!(pictures > 75 && unseen.len() <= 6, "{pictures} {unseen:?}");
}

/// `cargo test --release -p slowlight-compiler --lib hundreds_of -- --ignored --nocapture`
#[test]
#[ignore = "takes some minutes"]
fn nothing_is_lost_by_boxes_of_hundreds_of_compositions() {
    let shapes = compositions(250);
    let (pictures, unseen) = nothing_is_lost(&shapes);
    println!("{pictures} pictures, {} of nothing", unseen.len());
    assert!(pictures >= 500 && 4 * unseen.len() <= pictures);
}

/// Every so manieth pixel of the scenes of a folder, with boxes and tables and without.
fn nothing_is_lost_in(folder: &str, step: i32) {
    let mut scenes = 0;
    let files = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<_> = files.map(|file| file.unwrap().path()).collect();
    files.sort();
    for file in files
        .iter()
        .filter(|f| f.extension().is_some_and(|e| e == "scn"))
    {
        let scene = check("scene", &std::fs::read_to_string(file).unwrap());
        // One that uses another file is no scene by itself.
        if !scene.is_right() {
            continue;
        }
        let inks = |ways| {
            let options = Options {
                ways,
                ..Options::default()
            };
            let graph = scene.lower(&options).unwrap();
            let mut native = Native::new(&graph);
            let (width, height) = (graph.image.width as i32, graph.image.height as i32);
            let rows = (0..height).step_by(step as usize);
            let places = rows.flat_map(|y| (0..width).step_by(step as usize).map(move |x| (x, y)));
            let inks = places.map(|(x, y)| native.pixel(x, y).ink);
            inks.collect::<Vec<_>>()
        };
        let (with, without) = (
            inks(Ways::default()),
            inks(Ways {
                unbounded: true,
                instancing: Instancing::Separate,
                ..Ways::default()
            }),
        );
        let differ = with.iter().zip(&without).filter(|(a, b)| a != b).count();
        println!("{}: {differ} of {} pixels", file.display(), with.len());
        assert_eq!(differ, 0, "{}", file.display());
        scenes += 1;
    }
    assert!(scenes > 10);
}

#[test]
fn nothing_is_lost_in_the_examples() {
    nothing_is_lost_in("../examples", 16);
}

/// `cargo test --release -p slowlight-compiler --lib hundreds_of -- --ignored --nocapture`;
/// `SCENES=DIR` for the scenes of another folder.
#[test]
#[ignore = "takes some minutes"]
fn nothing_is_lost_in_hundreds_of_thousands_of_pixels() {
    let folder = std::env::var("SCENES");
    nothing_is_lost_in(folder.as_deref().unwrap_or("../examples"), 2);
}
