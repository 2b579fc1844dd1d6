//! Every primitive of the lecture: shades before the dither. Quadrics by the
//! roots of a parabola through three values, the polygon (a parallelogram) by
//! its sides, the hills by steps that the slope bounds.

use super::vectors::V;

const AHEAD: f64 = 1e-9;
const HILLS: f64 = 0.25;
const TIP: V = V(3.0, 2.0, -1.0);
const SADDLE: V = V(0.5, 1.5, -5.0);
const BALL: V = V(0.3, 1.2, 2.5);

fn cone(p: V) -> f64 {
    let q = p - TIP;
    let slope = 20f64.to_radians().tan();
    q.0 * q.0 + q.2 * q.2 - slope * slope * q.1 * q.1
}

fn cylinder(p: V) -> f64 {
    (p.0 + 2.0) * (p.0 + 2.0) + p.2 * p.2 - 0.36
}

fn saddle(p: V) -> f64 {
    let q = p - SADDLE;
    2.0 * q.1 - q.0 * q.0 + q.2 * q.2
}

fn ball(p: V) -> f64 {
    (p - BALL).dot(p - BALL) - 0.81
}

fn hills(p: V) -> f64 {
    p.1 - HILLS * p.0.sin() * p.2.cos()
}

fn between(p: V, low: V, high: V) -> bool {
    low.0 <= p.0 && p.0 <= high.0 && low.1 <= p.1 && p.1 <= high.1 && low.2 <= p.2 && p.2 <= high.2
}

/// The nearest root ahead where `inside` holds, of an `f` quadratic in t.
fn quadric(f: impl Fn(V) -> f64, from: V, dir: V, inside: impl Fn(V) -> bool) -> Option<f64> {
    let [c, plus, minus] = [0.0, 1.0, -1.0].map(|t| f(from + t * dir));
    let (a, b) = ((plus + minus) / 2.0 - c, (plus - minus) / 2.0);
    let d = b * b - 4.0 * a * c;
    if d < 0.0 {
        return None;
    }
    let q = -(b + b.signum() * d.sqrt()) / 2.0;
    let (u, v) = (q / a, c / q);
    let roots = [u.min(v), u.max(v)].into_iter();
    roots
        .filter(|&t| t > AHEAD && t.is_finite())
        .find(|&t| inside(from + t * dir))
}

/// The parallelogram of sides (2, 0, -1) and (0, 3, 0) from (-5, 0, -2).
fn polygon(from: V, dir: V) -> Option<f64> {
    let (o, n) = (V(-5.0, 0.0, -2.0), V(1.0, 0.0, 2.0));
    let t = (o - from).dot(n) / dir.dot(n);
    let q = from + t * dir - o;
    let (s, r) = (q.0 / 2.0, q.1 / 3.0);
    let within = (0.0..1.0).contains(&s) && (0.0..1.0).contains(&r);
    (t > AHEAD && within).then_some(t)
}

/// By steps too short to pass a root.
fn hit_hills(from: V, dir: V) -> Option<f64> {
    // Where the ray is in the bound: 20 to each side, as high as the hills.
    let (mut near, mut far) = (0f64, f64::INFINITY);
    for (from, dir, half) in [
        (from.0, dir.0, 20.0),
        (from.1, dir.1, HILLS),
        (from.2, dir.2, 20.0),
    ] {
        let (a, b) = ((-half - from) / dir, (half - from) / dir);
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    let steepest = (1.0 + HILLS * HILLS).sqrt();
    let mut t = near;
    while t < far {
        let f = hills(from + t * dir);
        if f < 1e-11 {
            return Some(t);
        }
        t += f / steepest;
    }
    None
}

/// The nearest hit: how far, which shape.
fn nearest(from: V, dir: V) -> Option<(f64, usize)> {
    let slab = |p: V| (0.0..=2.0).contains(&p.1);
    let cut = |p: V| between(p, V(-1.5, 0.0, -7.0), V(2.5, 3.0, -3.0));
    let hits = [
        polygon(from, dir),
        quadric(cone, from, dir, slab),
        quadric(cylinder, from, dir, slab),
        quadric(saddle, from, dir, cut),
        quadric(ball, from, dir, |_| true),
        hit_hills(from, dir),
    ];
    let found = hits.into_iter().enumerate();
    let found = found.filter_map(|(k, t)| t.map(|t| (t, k)));
    found
        .filter(|h| h.0 <= 40.0)
        .min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The shade, and which shapes the pixel's ray met (bit k for shape k).
pub fn shade(x: i32, y: i32) -> (f64, u8) {
    let eye = V(0.0, 2.0, 8.0);
    let back = (eye - V(0.0, 1.0, 0.0)).unit();
    let right = V(0.0, 1.0, 0.0).cross(back).unit();
    let up = back.cross(right);
    let wide = 30f64.to_radians().tan();
    let across = (f64::from(x) + 0.5 - 160.0) / 160.0 * wide;
    let upward = (128.0 - 0.5 - f64::from(y)) / 160.0 * wide;
    let dir = (across * right + upward * up - back).unit();
    let (mut from, mut seen, mut weight, mut met) = (eye, 0.0, 1.0, 0);
    for _ in 0..4 {
        let Some((t, which)) = nearest(from, dir) else {
            return (seen + weight * 0.8, met);
        };
        met |= 1 << which;
        let p = from + t * dir;
        let light = V(1.0, 2.0, 1.0).unit();
        let facing = normal(which, p).dot(light).max(0.1);
        let albedo = [0.7, 0.9, 0.8, 0.6, 0.1, 0.5][which];
        if which != 4 {
            return (seen + weight * albedo * facing, met);
        }
        seen += weight * 0.2 * albedo * facing;
        weight *= 0.8;
        from = p;
    }
    (seen, met)
}

fn normal(which: usize, p: V) -> V {
    let n = match which {
        0 => V(1.0, 0.0, 2.0),
        1 => {
            // Out from the axis, and up by the tangent of the half-angle.
            let out = V(p.0 - TIP.0, 0.0, p.2 - TIP.2).unit();
            out + 20f64.to_radians().tan() * V(0.0, 1.0, 0.0)
        }
        2 => V(p.0 + 2.0, 0.0, p.2),
        3 => V(-2.0 * (p.0 - SADDLE.0), 2.0, 2.0 * (p.2 - SADDLE.2)),
        4 => p - BALL,
        _ => V(
            -HILLS * p.0.cos() * p.2.cos(),
            1.0,
            HILLS * p.0.sin() * p.2.sin(),
        ),
    };
    n.unit()
}

/// What Floyd and Steinberg's dither sends on, a row at a time.
pub struct Error {
    row: [f64; 322],
    below: [f64; 322],
}

impl Default for Error {
    fn default() -> Error {
        Error {
            row: [0.0; 322],
            below: [0.0; 322],
        }
    }
}

impl Error {
    /// The ink of four for a shade and what it received; pixels in order.
    pub fn dither(&mut self, x: usize, shade: f64) -> u8 {
        if x == 0 {
            self.row = std::mem::replace(&mut self.below, [0.0; 322]);
        }
        let v = shade + self.row[x + 1];
        let q = (v * 3.0).round().clamp(0.0, 3.0);
        let error = v - q / 3.0;
        self.row[x + 2] += error * (7.0 / 16.0);
        self.below[x] += error * (3.0 / 16.0);
        self.below[x + 1] += error * (5.0 / 16.0);
        self.below[x + 2] += error * (1.0 / 16.0);
        q as u8
    }
}
