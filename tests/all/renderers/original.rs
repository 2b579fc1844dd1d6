//! The published Jack ray marcher in 64-bit floats, detail by detail.

use super::bayer8;
use super::vectors::V;

const EYE: V = V(0.0, 1.5, 4.0);
const LIGHT: V = V(2.0, 5.0, -1.0);

/// Distance to the nearest surface and its shade; the later object on a tie.
fn world(p: V) -> (f64, f64) {
    let sphere = (p - V(-1.5, 0.0, 0.0)).length() - 1.0;
    let q = p - V(1.5, 0.0, 0.0);
    let out = (q.0 * q.0 + q.2 * q.2).sqrt() - 1.0;
    let torus = (out * out + q.1 * q.1).sqrt() - 0.25;
    let floor = p.1 + 1.0;
    let mut best = (sphere, 0.7);
    if torus <= best.0 {
        best = (torus, 0.7);
    }
    if floor <= best.0 {
        let odd = (p.0.floor() + p.2.floor()).rem_euclid(2.0);
        best = (floor, 1.0 + 0.7 * odd);
    }
    best
}

/// The depth reached and the shade that the last evaluation gave, at the point
/// before the last advance.
fn march(from: V, dir: V, steps: u32) -> (f64, f64) {
    let (mut depth, mut shade) = (0.0, 0.0);
    for _ in 0..steps {
        let (d, s) = world(from + depth * dir);
        shade = s;
        depth += d;
        if d < 0.01 || depth > 12.0 {
            break;
        }
    }
    (depth, shade)
}

/// From the corners of a tetrahedron round `p`.
fn normal(p: V) -> V {
    let corners = [
        V(1.0, -1.0, -1.0),
        V(-1.0, -1.0, 1.0),
        V(-1.0, 1.0, -1.0),
        V(1.0, 1.0, 1.0),
    ];
    let sum = corners
        .iter()
        .fold(V(0.0, 0.0, 0.0), |n, &c| n + world(p + 0.005 * c).0 * c);
    sum.unit()
}

fn lit(p: V, albedo: f64) -> f64 {
    let n = normal(p);
    let l = (LIGHT - p).unit();
    let facing = l.dot(n);
    let mirrored = 2.0 * facing * n - l;
    let glance = mirrored.dot((EYE - p).unit()).clamp(0.0, 1.0);
    let shade = albedo * (0.63 * facing.clamp(0.0, 1.0) + 0.35 * glance.powi(4)) + 0.167;
    let start = p + 0.02 * n;
    // The direction is from the point, the length from the start.
    let (depth, _) = march(start, l, 32);
    if depth < (LIGHT - start).length() {
        0.25 * shade
    } else {
        shade
    }
}

/// Whether the pixel is white.
pub fn white(x: i32, y: i32) -> bool {
    let back = EYE.unit();
    let right = V(0.0, 1.0, 0.0).cross(back).unit();
    let up = back.cross(right);
    let v = V(f64::from(x - 256) / 256.0, f64::from(128 - y) / 256.0, -1.0).unit();
    let dir = v.0 * right + v.1 * up + v.2 * back;
    let (depth, albedo) = march(EYE, dir, 64);
    let shade = if depth > 12.0 {
        0.835
    } else {
        lit(EYE + depth * dir, albedo)
    };
    shade.clamp(0.0, 1.0) + bayer8(x, y) - 0.5 > 0.5
}
