//! Sphere, torus and floor by what rays hit, not by marching the whole scene:
//! the quadratic formula for the sphere, and the torus by steps as long as its
//! exact distance, so that no root is stepped over.

use super::bayer8;
use super::vectors::V;

const EYE: V = V(0.0, 1.5, 4.0);
const LIGHT: V = V(2.0, 5.0, -1.0);
const SPHERE: V = V(-1.5, 0.0, 0.0);
const TORUS: V = V(1.5, 0.0, 0.0);

/// How near to the torus a ray must come to hit it.
const NEAR: f64 = 2e-9;

/// The picture, with a limit to the steps towards the torus. A ray that meets
/// it at a grazing angle takes hundreds.
#[derive(Clone, Copy)]
pub struct Torus {
    pub steps: u32,
}

struct Hit {
    point: V,
    normal: V,
    albedo: f64,
}

fn sphere(from: V, dir: V) -> Option<f64> {
    let o = from - SPHERE;
    let b = o.dot(dir);
    let d = b * b - (o.dot(o) - 1.0);
    let t = -b - d.max(0.0).sqrt();
    (d >= 0.0 && t > 0.0).then_some(t)
}

fn floor(from: V, dir: V) -> Option<f64> {
    let t = (-1.0 - from.1) / dir.1;
    (t > 0.0 && t.is_finite()).then_some(t)
}

impl Torus {
    fn hit(self, from: V, dir: V) -> Option<f64> {
        let mut t = 0.0;
        for _ in 0..self.steps {
            if t > 20.0 {
                break;
            }
            let q = from + t * dir - TORUS;
            let out = (q.0 * q.0 + q.2 * q.2).sqrt() - 1.0;
            let d = (out * out + q.1 * q.1).sqrt() - 0.25;
            if d < NEAR {
                return Some(t);
            }
            t += d;
        }
        None
    }

    fn nearest(self, from: V, dir: V) -> Option<Hit> {
        let hits = [sphere(from, dir), self.hit(from, dir), floor(from, dir)];
        let mut best: Option<(usize, f64)> = None;
        for (k, hit) in hits.into_iter().enumerate() {
            match hit {
                Some(t) if t <= best.map_or(12.0, |b| b.1) => best = Some((k, t)),
                _ => (),
            }
        }
        let (which, t) = best?;
        let point = from + t * dir;
        let (normal, albedo) = match which {
            0 => (point - SPHERE, 0.7),
            1 => {
                // Away from the nearest point of the circle within.
                let q = point - TORUS;
                let ring = V(q.0, 0.0, q.2).unit();
                ((q - ring).unit(), 0.7)
            }
            _ => {
                let odd = (point.0.floor() + point.2.floor()).rem_euclid(2.0);
                (V(0.0, 1.0, 0.0), 1.0 + 0.7 * odd)
            }
        };
        Some(Hit {
            point,
            normal,
            albedo,
        })
    }

    fn shadow(self, h: &Hit) -> bool {
        let gap = LIGHT - h.point;
        let (from, dir) = (h.point + 0.02 * h.normal, gap.unit());
        gap.dot(h.normal) <= 0.0
            || [sphere(from, dir), self.hit(from, dir), floor(from, dir)]
                .into_iter()
                .flatten()
                .any(|t| t < gap.length())
    }

    /// Whether the pixel is white.
    pub fn white(self, x: i32, y: i32) -> bool {
        let back = EYE.unit();
        let right = V(0.0, 1.0, 0.0).cross(back).unit();
        let up = back.cross(right);
        let (u, v) = (f64::from(x - 256) / 256.0, f64::from(128 - y) / 256.0);
        let dir = (u * right + v * up - back).unit();
        let shade = match self.nearest(EYE, dir) {
            None => 0.835,
            Some(h) => {
                let l = (LIGHT - h.point).unit();
                let facing = l.dot(h.normal);
                let mirrored = 2.0 * facing * h.normal - l;
                let glance = mirrored.dot((EYE - h.point).unit()).clamp(0.0, 1.0);
                let lit = h.albedo * (0.63 * facing.clamp(0.0, 1.0) + 0.35 * glance.powi(4));
                (lit + 0.167) * if self.shadow(&h) { 0.25 } else { 1.0 }
            }
        };
        shade.clamp(0.0, 1.0) + bayer8(x, y) > 1.0
    }
}
