//! Two mirrors: the sphere by the quadratic formula, the bounces in a loop.

use super::vectors::V;

const BAYER4: [[i64; 4]; 4] = [
    [0, 24, 6, 30],
    [36, 12, 42, 18],
    [9, 33, 3, 27],
    [45, 21, 39, 15],
];

fn tiles(from: V, dir: V) -> f64 {
    let t = (from.1 + 2.0) / dir.1;
    let odd = ((from.0 - dir.0 * t).floor() + (from.2 + dir.2 * t).floor()).rem_euclid(2.0);
    -dir.1 * (odd / 2.0 + 0.3) + 0.2
}

/// The ink: 0 black, 1 red, 2 yellow, 3 white.
pub fn ink(x: i32, y: i32, eye: [f64; 3]) -> u8 {
    let across = (f64::from(x) - 159.5) / 160.0;
    let mut from = V(eye[0], eye[1], eye[2]);
    let mut dir = V(across, (119.5 - f64::from(y)) / 160.0, -1.0).unit();
    let mut side = if dir.0 < 0.0 { -1.0 } else { 1.0 };
    let mut bounces = 0;
    let shade = loop {
        if bounces == 12 {
            break 0.0;
        }
        bounces += 1;
        let centre = V(side, side, 0.0);
        let o = from - centre;
        let (b, c) = (o.dot(dir), o.dot(o) - 1.0);
        let d = b * b - c;
        // A ray that leaves a ball never meets that ball: it goes to the other.
        let t = -b - d.max(0.0).sqrt();
        if d < 0.0 || t <= 0.0 {
            break if dir.1 >= 0.0 {
                dir.1
            } else {
                tiles(from, dir)
            };
        }
        from = from + t * dir;
        let n = from - centre;
        dir = dir - 2.0 * dir.dot(n) * n;
        side = -side;
    };
    let dither = BAYER4[(247 - y).rem_euclid(4) as usize][x.rem_euclid(4) as usize];
    let level = (48.0 * shade.sqrt() + dither as f64 / 3.0).floor() as i64;
    (3 - level.div_euclid(16)).clamp(0, 3) as u8
}
