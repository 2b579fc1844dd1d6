//! Analytic hits against roots of each shape's implicit function, bracketed and
//! bisected with sixty digits: rays at random, tangents, and rays that miss or
//! hit by 2^-20 or 2^-40.

use super::gradients::{Big, Point, big, cylinder, plane, sphere};
use super::shades;
use std::fmt::Write;

/// A shape and its implicit function by hand, of degree at most 2.
type Case = (&'static str, fn(&Point) -> Big);

const CASES: [Case; 3] = [
    ("sphere((0.5, -0.25, 0.125), 1)", sphere),
    ("plane((0.6, 0.8, 0), 0.3)", plane),
    (
        "cylinder((0.5, -0.25, 0.125), (0.6, 0.8, 0), 0.7)",
        cylinder,
    ),
];
const RAYS: usize = 1000;

/// Origins and directions: random, and near tangents of the sphere.
fn rays() -> Vec<[f64; 6]> {
    let mut random = super::gradients::random();
    let mut all = Vec::new();
    while all.len() < RAYS {
        let from = [random(), random(), random()];
        let d = [random(), random(), random()];
        let n = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        if n > 0.1 {
            let [x, y, z] = d.map(|c| c / n);
            all.push([from[0], from[1], from[2], x, y, z]);
        }
    }
    // Along -z past the sphere: beside it by nothing, and by a little.
    for beside in [0.0, 20.0, 40.0] {
        for side in [-1.0, 1.0] {
            let off = if beside == 0.0 {
                0.0
            } else {
                side * f64::exp2(-beside)
            };
            all.push([1.5 + off, -0.25, 4.0, 0.0, 0.0, -1.0]);
        }
    }
    all
}

/// The least root above 1e-9 of f along the ray, how steep f is there, and how
/// far f is from having no root or one more.
struct Root {
    t: Option<Big>,
    slope: f64,
    margin: f64,
}

fn bracketed(f: fn(&Point) -> Big, ray: &[f64; 6]) -> Root {
    let along = |t: &Big| f(&[0, 1, 2].map(|k| big(ray[k]) + t * big(ray[k + 3])));
    // The vertex of the parabola parts the two roots.
    let [c, plus, minus] = [0.0, 1.0, -1.0].map(|t| along(&big(t)));
    let a = (&plus + &minus) / big(2.0) - &c;
    let b = (&plus - &minus) / big(2.0);
    let mut borders = vec![big(1e-9), big(1e7)];
    let mut margin = f64::INFINITY;
    if a.to_f64().value().abs() > 1e-30 {
        let vertex = -&b / (big(2.0) * &a);
        margin = along(&vertex).to_f64().value().abs();
        if vertex > borders[0] && vertex < borders[1] {
            borders.insert(1, vertex);
        }
    }
    let outside = |t: &Big| along(t) > big(0.0);
    let found = borders
        .windows(2)
        .find(|w| outside(&w[0]) != outside(&w[1]));
    let Some(pair) = found else {
        return Root {
            t: None,
            slope: 0.0,
            margin,
        };
    };
    let (mut low, mut high) = (pair[0].clone(), pair[1].clone());
    for _ in 0..180 {
        let middle = (&low + &high) / big(2.0);
        if outside(&middle) == outside(&low) {
            low = middle;
        } else {
            high = middle;
        }
    }
    let slope = (big(2.0) * a * &low + b).to_f64().value().abs();
    Root {
        t: Some(low),
        slope,
        margin,
    }
}

#[test]
fn analytic_hits_are_the_roots() {
    let rays = rays();
    let mut table = String::new();
    for (k, [a, b, c, d, e, f]) in rays.iter().enumerate() {
        let end = if k + 1 == rays.len() { "" } else { "; " };
        write!(
            table,
            "{a:.17}, {b:.17}, {c:.17}, {d:.17}, {e:.17}, {f:.17}{end}"
        )
        .unwrap();
    }
    for (shape, by_hand) in CASES {
        let text = format!(
            "image 1 x {} inks black, white;
            const rays = [{table}];
            dither show(v: real, x: int, y: int) -> ink = ink(floor(v));
            draw (x, y) = {{
              let r = ray((rays[0, y], rays[1, y], rays[2, y]), (rays[3, y], rays[4, y], rays[5, y]));
              show(if let h = {shape}.hit(r) then h.t else -1, x, y)
            }};",
            rays.len()
        );
        let (mut hits, mut misses) = (0, 0);
        for (ray, (_, t)) in rays.iter().zip(shades(&text, &[])) {
            let root = bracketed(by_hand, ray);
            match root.t {
                Some(_) if t < 0.0 => assert!(root.margin < 1e-14, "{shape} {ray:?}: missed"),
                Some(exact) => {
                    // What a change of f by the rounding of f64 moves the root by.
                    let error = (exact - big(t)).to_f64().value().abs();
                    assert!(
                        error * root.slope < 1e-12 * (1.0 + t * t),
                        "{shape} {ray:?}: {error}"
                    );
                    hits += 1;
                }
                None if t < 0.0 => misses += 1,
                None => assert!(root.margin < 1e-14, "{shape} {ray:?}: hit at {t}"),
            }
        }
        assert!(hits > 100 && misses > 100, "{shape}: {hits} {misses}");
    }
}
