//! The native evaluation against the same picture in Rust written by hand:
//! torus.scn at 512 x 256, one thread each. Their ratio is what it costs that a
//! scene is a graph and not compiled.
//!
//! `cargo bench --bench native`

#[path = "../tests/all/renderers/bayer.rs"]
mod bayer;
#[path = "../tests/all/renderers/torus.rs"]
mod torus;
#[path = "../tests/all/renderers/vectors.rs"]
mod vectors;

use bayer::bayer8;
use criterion::{Criterion, criterion_group, criterion_main};
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;
use std::hint::black_box;

const TORUS: &str = include_str!("../examples/torus.scn");
const WIDTH: i32 = 512;
const HEIGHT: i32 = 256;

/// The scene's inks by the native evaluation, made ready anew.
fn evaluated(graph: &Graph) -> Vec<u8> {
    let mut native = Native::new(graph);
    let mut pixels = Vec::new();
    for y in 0..HEIGHT {
        native.pixels(0..WIDTH, y, &mut pixels);
    }
    pixels.iter().map(|p| p.ink).collect()
}

/// The same inks by hand, with the library's limit to a ray's steps.
fn by_hand() -> Vec<u8> {
    let torus = torus::Torus {
        steps: black_box(1024),
    };
    let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    places.map(|(x, y)| u8::from(torus.white(x, y))).collect()
}

fn drawing(criterion: &mut Criterion) {
    let checked = scene::check("torus.scn", TORUS);
    let Ok(graph) = checked.lower(&Options::default()) else {
        panic!("torus.scn is wrong");
    };
    assert!(evaluated(&graph) == by_hand(), "two different pictures");
    let mut group = criterion.benchmark_group("torus 512x256");
    group.sample_size(20);
    group.bench_function("by hand", |b| b.iter(by_hand));
    group.bench_function("native", |b| b.iter(|| evaluated(black_box(&graph))));
    group.finish();
}

criterion_group!(benches, drawing);
criterion_main!(benches);
