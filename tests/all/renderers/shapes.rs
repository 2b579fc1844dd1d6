//! Every shape of the library against its own definition with sixty digits.
//!
//! The cases are `shape_cases`'.

use super::exact::Exact;
use super::gradients::{Big, Point, big, random};
use super::shades;
use super::shape_cases::{Case, cases, lines};
use rayon::prelude::*;
use std::fmt::Write;

/// What the table's shapes are made of.
const ITEMS: &str = "
    const axis = (0.6, 0.48, 0.64);
    const middle = (0.5, -0.25, 0.125);
    const tiny = 0.000000001;
    fn near(a: vec3, b: vec3) -> bool = length(a - b) < tiny;
    shape bowl(c: vec3, k: real) { f(p) = k * (p.y - c.y) - (p.x - c.x)^2 + (p.z - c.z)^2; }
    fn waves(p: vec2) -> real = loop (k = 0, q = p, high = 0.5, sum = 0.0) max 3 {
      next(k + 1, 2 * (q.y, -q.x), high / 2, sum + high * sin(q.x * 1rad) * cos(q.y * 1rad))
    } else sum;";

const POINTS: usize = 1000;
/// Samples along a ray, `STEP` apart: past everything that is within 2 of (0, 0, 0).
const SAMPLES: usize = 97;
const STEP: f64 = 1.0 / 12.0;

fn table(rows: &[Vec<f64>]) -> String {
    let mut out = String::new();
    for (k, row) in rows.iter().enumerate() {
        let row: Vec<String> = row.iter().map(|v| format!("{v:.20}")).collect();
        let end = if k + 1 == rows.len() { "" } else { "; " };
        write!(out, "{}{end}", row.join(", ")).unwrap();
    }
    out
}

/// What `expression` comes to for each column of each row of a table `rows`.
fn rows(items: &str, rows: &[Vec<f64>], columns: usize, expression: &str) -> Vec<Vec<f64>> {
    let text = format!(
        "image {columns} x {} inks black, white; {ITEMS} {items}
        const rows = [{}];
        dither show(v: real, x: int, y: int) -> ink = ink(floor(v));
        draw (x, y) = {{
          let from = (rows[0, y], rows[1, y], rows[2, y]);
          let dir = (rows[3, y], rows[4, y], rows[5, y]);
          show({expression}, x, y)
        }};",
        rows.len(),
        table(rows)
    );
    let found: Vec<f64> = shades(&text, &[]).iter().map(|p| p.1).collect();
    found.chunks(columns).map(<[f64]>::to_vec).collect()
}

/// Rays at random, each an origin and a direction of length 1.
fn random_rays(count: usize) -> Vec<Vec<f64>> {
    let mut random = random();
    let mut all = Vec::new();
    while all.len() < count {
        let mut ray: Vec<f64> = (0..6).map(|_| random()).collect();
        let size = ray[3..].iter().map(|c| c * c).sum::<f64>().sqrt();
        if size > 0.1 {
            ray[3..].iter_mut().for_each(|c| *c /= size);
            all.push(ray);
        }
    }
    all
}

/// Directions between a ray that hits and one that misses, closed in upon.
fn tangents(case: &Case, rays: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let items = format!(
        "fn met(from: vec3, dir: vec3) -> bool = if let h = {}.hit(ray(from, unit(dir))) then true else false;",
        case.shape
    );
    let expression = "{
        let other = (rows[3, y + 1], rows[4, y + 1], rows[5, y + 1]);
        let hits = met(from, dir);
        let edge = if hits == met(from, other) then dir else
          loop (lo = dir, hi = other) max 40 {
            let m = (lo + hi) / 2;
            if met(from, m) == hits then next(m, hi) else next(lo, m)
          } else unit(if y mod 2 == 0 then lo else hi);
        if x == 0 then edge.x else if x == 1 then edge.y else edge.z
      }";
    let found = rows(&items, &rays[..case.kind.tangents], 3, expression);
    let pairs = rays.iter().zip(found);
    pairs.map(|(ray, dir)| [&ray[..3], &dir].concat()).collect()
}

fn gradient(f: &Exact, at: &Point) -> Option<[f64; 3]> {
    let step = big(1e-15);
    let middle = f.at(at);
    let slopes = [0, 1, 2].map(|k| {
        let beside = |off: &Big| {
            let mut p = at.clone();
            p[k] = &p[k] + off;
            f.at(&p)
        };
        let (low, high) = (beside(&-&step), beside(&step));
        let kink = ((&high + &low - big(2.0) * &middle) / &step)
            .to_f64()
            .value();
        let slope = ((high - low) / (big(2.0) * &step)).to_f64().value();
        (slope, kink)
    });
    if slopes.iter().any(|s| s.1.abs() > 1e-6) {
        return None;
    }
    let g = slopes.map(|s| s.0);
    let size = g.iter().map(|c| c * c).sum::<f64>().sqrt();
    Some(g.map(|c| c / size))
}

/// The normals that the compiler derives from one facet alone.
fn derived_normals(case: &Case, facet: &str) {
    let mut random = random();
    let points: Vec<Vec<f64>> = (0..POINTS)
        .map(|_| (0..6).map(|_| random()).collect())
        .collect();
    let items = format!("shape bare() {{ {facet}(p) = {}.{facet}(p); }}", case.shape);
    let expression =
        "{ let n = bare().normal(from); if x == 0 then n.x else if x == 1 then n.y else n.z }";
    let normals = rows(&items, &points, 3, expression);
    let f = Exact::new(ITEMS, &format!("{}.{facet}(p)", case.shape));
    let mut held = 0;
    for (p, normal) in points.iter().zip(normals) {
        let Some(slopes) = gradient(&f, &[0, 1, 2].map(|k| big(p[k]))) else {
            continue;
        };
        for (slope, component) in slopes.iter().zip(&normal) {
            let error = (slope - component).abs();
            assert!(error < 1e-11, "{} {facet} {p:?}: {error}", case.shape);
        }
        held += 1;
    }
    assert!(held > POINTS - 10, "{} {facet}: {held} points", case.shape);
}

/// A case on its way along rays.
struct Checked<'c> {
    case: &'c Case,
    root: Exact,
    region: Option<Exact>,
}

impl Checked<'_> {
    /// Whether a place is in the region, with that to spare.
    fn within(&self, ray: &[f64; 6], t: &Big, spare: f64) -> bool {
        let found = self.region.as_ref().map(|r| r.along(ray, t));
        found.is_none_or(|v| v <= big(-spare))
    }

    /// How fast `f` changes before and after a place.
    fn slopes(&self, ray: &[f64; 6], t: f64) -> [f64; 2] {
        let f = |t: f64| self.root.along(ray, &big(t));
        let (before, here, after) = (f(t - 1e-7), f(t), f(t + 1e-7));
        [&here - before, after - &here].map(|d| d.to_f64().value() / 1e-7)
    }

    /// The change of sign between two places, to 2^-60 of their distance.
    fn bisected(&self, ray: &[f64; 6], low: f64, high: f64) -> Big {
        let (mut low, mut high) = (big(low), big(high));
        let outside = self.root.along(ray, &low) > big(0.0);
        for _ in 0..60 {
            let middle = (&low + &high) / big(2.0);
            if (self.root.along(ray, &middle) > big(0.0)) == outside {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// How far `f` goes to the other side in a dip between two places; 0 or
    /// less where it does not.
    fn depth(&self, ray: &[f64; 6], low: f64, high: f64, sign: f64) -> (f64, Big) {
        let golden = big(0.6180339887498949);
        let (mut a, mut b) = (big(low), big(high));
        let f = |t: &Big| self.root.along(ray, t) * big(sign);
        for _ in 0..60 {
            let (c, d) = (&b - (&b - &a) * &golden, &a + (&b - &a) * &golden);
            if f(&c) < f(&d) {
                b = d;
            } else {
                a = c;
            }
        }
        (-f(&a).to_f64().value(), a)
    }

    /// Nothing is met before `end`.
    fn nothing_before(&self, ray: &[f64; 6], samples: &[f64], end: f64) {
        let (shape, kind) = (&self.case.shape, self.case.kind);
        let at = |k: usize| k as f64 * STEP;
        for k in 1..SAMPLES {
            if at(k) >= end {
                return;
            }
            let (before, here) = (samples[k - 1], samples[k]);
            if (before > 0.0) != (here > 0.0) {
                let t = self.bisected(ray, at(k - 1), at(k));
                let [slope, _] = self.slopes(ray, t.to_f64().value());
                let there = self.within(ray, &t, kind.tolerance);
                if there && slope.abs() <= kind.grazing {
                    return;
                }
                assert!(!there, "{shape} {ray:?}: missed at {t}, slope {slope}");
                continue;
            }
            let Some(&after) = samples.get(k + 1).filter(|_| at(k + 1) < end) else {
                continue;
            };
            let sizes = [before, here, after].map(f64::abs);
            let dips = sizes[1] <= sizes[0]
                && sizes[1] <= sizes[2]
                && 3.0 * sizes[1] <= sizes[0] + sizes[2]
                && (after > 0.0) == (here > 0.0);
            if dips {
                let (depth, t) = self.depth(ray, at(k - 1), at(k + 1), here.signum());
                let missed = depth > kind.depth && self.within(ray, &t, kind.tolerance);
                assert!(!missed, "{shape} {ray:?}: missed by {depth} at {t}");
            }
        }
    }

    /// The sign changes about `t`; how steep f is there.
    fn changes(&self, ray: &[f64; 6], t: f64) {
        let f = |t: f64| self.root.along(ray, &big(t));
        let shape = &self.case.shape;
        let scale = self.case.kind.tolerance * (1.0 + t * t);
        let size = f(t).to_f64().value().abs();
        assert!(size < scale, "{shape} {ray:?}: f is {size} at {t}");
        let [before, after] = self.slopes(ray, t);
        // A tangent or an edge touches; what is crossed changes its sign nearby.
        let slope = before.abs().min(after.abs());
        if before * after > 0.0 && slope > 1e-3 {
            let off = 2.0 * scale / slope;
            let (low, high) = (f(t - off) > big(0.0), f(t + off) > big(0.0));
            assert!(low != high, "{shape} {ray:?}: no root within {off} of {t}");
        }
        let place = big(t);
        let spare = -self.case.kind.tolerance;
        assert!(
            self.within(ray, &place, spare),
            "{shape} {ray:?}: outside at {t}"
        );
    }
}

fn hits(case: &Case) -> (usize, usize) {
    let mut rays = random_rays(case.kind.rays);
    rays.extend(tangents(case, &rays));
    let expression = format!(
        "if x < 7 then (if let h = {}.hit(ray(from, dir)) then
            (if x == 0 then h.t else if x == 1 then h.point.x else if x == 2 then h.point.y
             else if x == 3 then h.point.z else if x == 4 then h.normal.x
             else if x == 5 then h.normal.y else h.normal.z)
          else -1)
        else {}.f(from + (x - 7) / 12 * dir)",
        case.shape, case.root
    );
    let found = rows("", &rays, 7 + SAMPLES, &expression);
    let f = |shape: &str| Exact::new(ITEMS, &format!("{shape}.f(p)"));
    let checked = Checked {
        case,
        root: f(&case.root),
        region: case.region.as_deref().map(f),
    };
    let (mut met, mut kinks) = (0, 0);
    for (ray, found) in rays.iter().zip(&found) {
        let ray: [f64; 6] = ray[..].try_into().unwrap();
        let (head, samples) = found.split_at(7);
        let t = head[0];
        if t < 0.0 {
            checked.nothing_before(&ray, samples, f64::INFINITY);
            continue;
        }
        met += 1;
        checked.nothing_before(&ray, samples, t);
        checked.changes(&ray, t);
        let point = [1, 2, 3].map(|k| big(head[k]));
        match gradient(&checked.root, &point) {
            Some(slopes) => {
                for (slope, component) in slopes.iter().zip(&head[4..]) {
                    let error = (slope - component).abs();
                    let shape = &case.shape;
                    assert!(error < 1e-8, "{shape} {ray:?}: the normal is {error} off");
                }
            }
            None => kinks += 1,
        }
    }
    assert!(kinks * 20 <= met, "{}: {kinks} hits of edges", case.shape);
    (met, rays.len() - met)
}

#[test]
fn hits_and_normals_of_every_shape() {
    let cases = cases();
    cases.par_iter().for_each(|case| {
        for facet in &case.facets {
            derived_normals(case, facet);
        }
        let (met, missed) = hits(case);
        let least = case.kind.rays / 25;
        assert!(met > least, "{}: {met} hits", case.shape);
        assert!(missed > least, "{}: {missed} misses", case.shape);
    });
    assert!(cases.len() >= 20, "{} shapes", cases.len());
}

#[test]
fn claims_about_shapes() {
    for line in lines() {
        let Some(claim) = line.strip_prefix("claim |") else {
            continue;
        };
        let text = format!(
            "image 16 x 16 inks black, white; {ITEMS}
            draw (x, y) = {{
              let p = ((x - 7.4) / 5, (y - 7.6) / 6, (x * y mod 13) / 6 - 1);
              if {claim} then ink(1) else ink(0)
            }};"
        );
        let inks = super::native(&text, &[]);
        let wrong = inks.iter().filter(|&&i| i != 1).count();
        assert_eq!(wrong, 0, "{claim}");
    }
}
