//! Derived normals against numerical derivatives with 60 digits: central
//! differences over 1e-15, so wrong by about 1e-30, of each shape's definition
//! written a second time.
#![allow(clippy::unwrap_used)]

use super::shades;
use dashu_float::FBig;
use dashu_float::ops::SquareRoot;
use std::fmt::Write;

/// A number of 200 bits.
pub type Big = FBig;
pub type Point = [Big; 3];

pub fn big(v: f64) -> Big {
    Big::try_from(v).unwrap().with_precision(200).value()
}

fn minus(a: &Point, b: [f64; 3]) -> Point {
    [0, 1, 2].map(|k| &a[k] - big(b[k]))
}

fn dot(a: &Point, b: &Point) -> Big {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn length(a: &Point) -> Big {
    dot(a, a).sqrt()
}

/// Across the axis (0.6, 0.8, 0) through the centre: what is left without the part along it.
fn across(q: &Point) -> Point {
    let axis = [0.6, 0.8, 0.0].map(big);
    let along = dot(q, &axis);
    [0, 1, 2].map(|k| &q[k] - &along * &axis[k])
}

const CENTRE: [f64; 3] = [0.5, -0.25, 0.125];

/// The implicit functions of shapes round `CENTRE`.
pub fn sphere(p: &Point) -> Big {
    let q = minus(p, CENTRE);
    dot(&q, &q) - big(1.0)
}

pub fn plane(p: &Point) -> Big {
    dot(p, &[0.6, 0.8, 0.0].map(big)) - big(0.3)
}

pub fn cylinder(p: &Point) -> Big {
    let q = across(&minus(p, CENTRE));
    dot(&q, &q) - big(0.7) * big(0.7)
}

/// A shape in the language, the facet that is differentiated, and the same by hand.
type Case = (&'static str, &'static str, fn(&Point) -> Big);

const CASES: [Case; 9] = [
    ("sphere((0.5, -0.25, 0.125), 1)", "f", |p| {
        let q = minus(p, CENTRE);
        dot(&q, &q)
    }),
    ("sphere((0.5, -0.25, 0.125), 1)", "dist", |p| {
        length(&minus(p, CENTRE))
    }),
    ("plane((0.6, 0.8, 0), 0.3)", "f", |p| {
        dot(p, &[0.6, 0.8, 0.0].map(big))
    }),
    (
        "cylinder((0.5, -0.25, 0.125), (0.6, 0.8, 0), 0.7)",
        "f",
        |p| {
            let q = across(&minus(p, CENTRE));
            dot(&q, &q)
        },
    ),
    (
        "cylinder((0.5, -0.25, 0.125), (0.6, 0.8, 0), 0.7)",
        "dist",
        |p| length(&across(&minus(p, CENTRE))),
    ),
    (
        "cone((0.5, -0.25, 0.125), (0.6, 0.8, 0), 60deg)",
        "f",
        |p| {
            let q = minus(p, CENTRE);
            length(&q) * big(0.5) - dot(&q, &[0.6, 0.8, 0.0].map(big))
        },
    ),
    ("torus((0.5, -0.25, 0.125), 1, 0.25)", "dist", |p| {
        let [x, y, z] = minus(p, CENTRE);
        let out = (&x * &x + &z * &z).sqrt() - big(1.0);
        (&out * &out + &y * &y).sqrt()
    }),
    ("box((-0.5, -1, -0.75), (0.25, 0.5, 1))", "dist", |p| {
        let (low, high) = ([-0.5, -1.0, -0.75], [0.25, 0.5, 1.0]);
        let q = [0, 1, 2].map(|k| (big(low[k]) - &p[k]).max(&p[k] - big(high[k])));
        let most = q.iter().max().unwrap().clone();
        if most <= big(0.0) {
            return most;
        }
        length(&q.map(|c| c.max(big(0.0))))
    }),
    (
        "sphere((0, 0, 0), 1).union(torus((0.5, -0.25, 0.125), 1, 0.25))",
        "dist",
        |p| {
            let [x, y, z] = minus(p, CENTRE);
            let out = (&x * &x + &z * &z).sqrt() - big(1.0);
            let torus = (&out * &out + &y * &y).sqrt() - big(0.25);
            (length(p) - big(1.0)).min(torus)
        },
    ),
];

const POINTS: usize = 1000;

/// Multiples of 1/4096 from -2 to 2.
pub fn random() -> impl FnMut() -> f64 {
    let mut state = 1u64;
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 50) as f64 / 4096.0 - 2.0
    }
}

fn points() -> Vec<[f64; 3]> {
    let mut next = random();
    (0..POINTS).map(|_| [next(), next(), next()]).collect()
}

#[test]
fn derived_normals_are_the_gradients() {
    let points = points();
    let mut table = String::new();
    for (k, [x, y, z]) in points.iter().enumerate() {
        let end = if k + 1 == POINTS { "" } else { "; " };
        write!(table, "{x:?}, {y:?}, {z:?}{end}").unwrap();
    }
    for (shape, facet, by_hand) in CASES {
        // A shape with nothing but this facet, so that its normal is derived.
        let text = format!(
            "image 3 x {POINTS} inks black, white;
            const points = [{table}];
            shape bare() {{ {facet}(p) = {shape}.{facet}(p); }}
            dither show(v: real, x: int, y: int) -> ink = ink(floor(v));
            draw (x, y) = {{
              let n = bare().normal((points[0, y], points[1, y], points[2, y]));
              show(if x == 0 then n.x else if x == 1 then n.y else n.z, x, y)
            }};"
        );
        let found = shades(&text, &[]);
        let step = big(1e-15);
        for (point, normal) in points.iter().zip(found.chunks(3)) {
            let at = point.map(big);
            let gradient = [0, 1, 2].map(|k| {
                let (mut low, mut high) = (at.clone(), at.clone());
                low[k] = &low[k] - &step;
                high[k] = &high[k] + &step;
                by_hand(&high) - by_hand(&low)
            });
            let size = length(&gradient);
            for (slope, (_, component)) in gradient.iter().zip(normal) {
                let error = (slope / &size).to_f64().value() - component;
                assert!(error.abs() < 1e-11, "{shape} {facet} {point:?}: {error}");
            }
        }
    }
}
