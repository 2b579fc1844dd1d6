//! The scenes of the language page drawn a second time, by hand, in plain Rust
//! and 64-bit floats, without the compiler: where the arithmetic is the same no
//! pixel differs, and every other difference has a count and a cause.
#![allow(clippy::unwrap_used)]

mod bayer;
mod exact;
mod gradients;
mod hits;
mod maze;
mod mirrors;
mod original;
mod primitives;
mod shape_cases;
mod shapes;
mod torus;
mod vectors;

use bayer::bayer8;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;

/// The native picture's inks and shades, row after row, for other values of params
/// (angles in radians).
fn shades(text: &str, set: &[(&str, &[f64])]) -> Vec<(u8, f64)> {
    let scene = scene::check("test", text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let set = set.iter().map(|(name, v)| ((*name).to_owned(), v.to_vec()));
    let options = Options {
        set: set.collect(),
        ..Options::default()
    };
    let graph = scene.lower(&options).unwrap();
    let mut native = Native::new(&graph);
    let (width, height) = (graph.image.width as i32, graph.image.height as i32);
    let mut pixels = Vec::new();
    for y in 0..height {
        pixels.extend((0..width).map(|x| native.pixel(x, y)));
    }
    pixels.iter().map(|p| (p.ink, p.shade)).collect()
}

/// The inks alone.
fn native(text: &str, set: &[(&str, &[f64])]) -> Vec<u8> {
    shades(text, set).iter().map(|p| p.0).collect()
}

/// The pixels of the rows in which two pictures of one width differ.
fn differ(a: &[u8], b: &[u8], width: usize) -> Vec<(usize, usize)> {
    assert_eq!(a.len(), b.len());
    let at = (0..a.len()).filter(|&k| a[k] != b[k]);
    at.map(|k| (k % width, k / width)).collect()
}

/// Two inks of a P4 picture of 512 x 256: 1 is white.
fn bitmap(file: &[u8]) -> Vec<u8> {
    let bits = &file[file.len() - 512 * 256 / 8..];
    let of = |byte: &u8| {
        (0..8)
            .map(|k| 1 - (byte >> (7 - k) & 1))
            .collect::<Vec<_>>()
    };
    bits.iter().flat_map(of).collect()
}

const FLOAT: &[u8] = include_bytes!("../../reference/torus-float.pbm");
const FLOAT316: &[u8] = include_bytes!("../../reference/torus-float316.pbm");

/// A picture drawn pixel by pixel.
fn plain(draw: impl Fn(i32, i32) -> u8, width: i32, height: i32) -> Vec<u8> {
    let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    rows.map(|(x, y)| draw(x, y)).collect()
}

#[test]
fn the_original_in_rust_and_in_the_language() {
    let reference = bitmap(FLOAT);
    let rust = plain(|x, y| u8::from(original::white(x, y)), 512, 256);
    assert_eq!(differ(&rust, &reference, 512), []);
    let scene = native(include_str!("../../../examples/torus-original.scn"), &[]);
    assert_eq!(differ(&scene, &reference, 512), []);
    // The original's own arithmetic, as the facts count it.
    assert_eq!(differ(&bitmap(FLOAT316), &reference, 512).len(), 613);
}

#[test]
fn mirrors_by_hand() {
    let text = include_str!("../../../examples/mirrors.scn");
    for eye in [[0.0, -0.1, 3.0], [0.35, 0.25, 3.6], [-2.0, 1.5, 5.0]] {
        let rust = plain(|x, y| mirrors::ink(x, y, eye), 320, 240);
        assert_eq!(
            differ(&rust, &native(text, &[("eye", &eye)]), 320),
            [],
            "{eye:?}"
        );
    }
}

#[test]
fn maze_by_hand() {
    let text = include_str!("../../../examples/maze.scn");
    for (pos, heading) in [
        ([8.5, 9.5], 0.125),
        ([3.3, 3.7], 0.61),
        ([13.6, 13.2], 0.84),
    ] {
        let rust = plain(|x, y| maze::ink(x, y, pos, heading), 32, 32);
        let radians = heading * std::f64::consts::TAU;
        let set: [(&str, &[f64]); 2] = [("pos", &pos), ("heading", &[radians])];
        assert_eq!(
            differ(&rust, &native(text, &set), 32),
            [],
            "{pos:?} {heading}"
        );
    }
}

/// The library solves a quartic; this goes by steps, for as long as it takes.
#[test]
fn torus_by_hand() {
    let scene = native(include_str!("../../../examples/torus.scn"), &[]);
    let torus = torus::Torus { steps: u32::MAX };
    let rust = plain(|x, y| u8::from(torus.white(x, y)), 512, 256);
    assert_eq!(differ(&rust, &scene, 512), []);
}

/// Shades and inks, which Floyd and Steinberg's dither makes depend on all
/// pixels before. The hills are met by steps that no root is shorter than.
#[test]
fn primitives_by_hand() {
    let text = include_str!("../../../examples/primitives.scn");
    let scene = shades(text, &[]);
    let mut visible = [0; 6];
    let mut error = primitives::Error::default();
    let mut wrong = Vec::new();
    for (k, &(ink, shade)) in scene.iter().enumerate() {
        let (x, y) = (k as i32 % 320, k as i32 / 320);
        let (own, met) = primitives::shade(x, y);
        let expected = error.dither(x as usize, own);
        if (shade - own).abs() > 1e-6 || ink != expected {
            wrong.push((x, y));
        }
        for (shape, count) in visible.iter_mut().enumerate() {
            *count += i32::from(met >> shape & 1);
        }
    }
    assert_eq!(wrong, []);
    assert!(visible.iter().all(|&count| count > 1000), "{visible:?}");
}
