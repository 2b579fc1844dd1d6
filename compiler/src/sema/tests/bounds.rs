//! Derived bounding boxes: they hold all of their shapes, closely, and nothing that a ray meets
//! is lost by them.

use super::right;
use crate::eval::native::Native;
use crate::ir::extent::Extent;
use crate::scene::{Scene, check};
use crate::sema::lower::extents;
use crate::sema::{Options, Ways};

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
    let head = format!("image 160 x 160 inks black, white;\n{OWN}");
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

/// The points of a cuboid that a scene of 160 x 160 pixels asks for, one a pixel: evenly across,
/// in the third direction by the golden ratio.
fn at(low: [f64; 3], high: [f64; 3], (x, y): (i32, i32)) -> [f64; 3] {
    let third = (f64::from(160 * y + x) * 0.618_033_988_75).fract();
    let part = [
        (f64::from(x) + 0.5) / 160.0,
        (f64::from(y) + 0.5) / 160.0,
        third,
    ];
    [0, 1, 2].map(|k| low[k] + (high[k] - low[k]) * part[k])
}

#[test]
fn boxes_hold_their_shapes_and_hold_them_closely() {
    let (mut widths, mut unknown) = (Vec::new(), 0);
    for shape in SHAPES {
        let Some(of) = box_of(shape).filter(Extent::is_finite) else {
            unknown += 1;
            continue;
        };
        // Half as wide again to each side.
        let more = [0, 1, 2].map(|k| (of.high[k] - of.low[k]) / 2.0);
        let low = [0, 1, 2].map(|k| of.low[k] - more[k]);
        let high = [0, 1, 2].map(|k| of.high[k] + more[k]);
        let [a, b, c] = [0, 1, 2].map(|k| (low[k], high[k] - low[k]));
        let place = format!(
            "(({}) + {} * (x + 0.5) / 160, ({}) + {} * (y + 0.5) / 160, ({}) + {} * ((160 * y + x) * 0.61803398875 mod 1))",
            a.0, a.1, b.0, b.1, c.0, c.1
        );
        let inside = format!("if {shape}.f({place}) <= 0 then ink(1) else ink(0)");
        let graph = scene_of(shape, &inside).lower(&Options::default());
        let graph = graph.expect(shape);
        let mut native = Native::new(&graph);
        let mut seen = [(f64::INFINITY, f64::NEG_INFINITY); 3];
        for (x, y) in (0..160).flat_map(|y| (0..160).map(move |x| (x, y))) {
            if native.pixel(x, y).ink == 0 {
                continue;
            }
            let point = at(low, high, (x, y));
            for k in 0..3 {
                assert!(
                    (of.low[k]..=of.high[k]).contains(&point[k]),
                    "{shape} at {point:?} is not in {of:?}"
                );
                seen[k] = (seen[k].0.min(point[k]), seen[k].1.max(point[k]));
            }
        }
        // What is seen is less than what is there, by what lies between points.
        widths.extend((0..3).map(|k| {
            let width = of.high[k] - of.low[k];
            (width / (seen[k].1 - seen[k].0), shape, k)
        }));
    }
    widths.sort_by(|a, b| a.0.total_cmp(&b.0));
    let wide = widths.iter().filter(|w| w.0 > 1.5).count();
    assert!(10 * wide <= widths.len(), "{widths:?}");
    assert!(10 * unknown <= SHAPES.len(), "{unknown} have no box");
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

#[test]
fn nothing_is_lost_by_boxes() {
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
    for shape in SHAPES {
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
    // Two are out of sight.
    assert!(pictures > 75 && unseen.len() <= 6, "{pictures} {unseen:?}");
}
