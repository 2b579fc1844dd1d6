//! The lanes of the native evaluation held against pixels one at a time: the
//! same bits, by the same number of operations.
#![allow(clippy::unwrap_used)]

use super::native::{Native, Pixel};
use super::random_graphs;
use super::scalar::Scalar;
use crate::analysis::verify::verify;
use crate::ir::graph::*;
use crate::scene::check;
use crate::sema::Options;

fn bits(pixel: &Pixel) -> (u8, u64) {
    (pixel.ink, pixel.shade.to_bits())
}

/// Draws some rows both ways.
fn same(name: &str, graph: &Graph, rows: impl Iterator<Item = i32>) {
    let width = graph.image.width as i32;
    let (mut native, mut scalar) = (Native::new(graph), Scalar::new(graph));
    for y in rows {
        let mut lanes = Vec::new();
        native.pixels(0..width, y, &mut lanes);
        let plain: Vec<Pixel> = (0..width).map(|x| scalar.pixel(x, y)).collect();
        let differ = (0..width as usize).find(|&x| bits(&lanes[x]) != bits(&plain[x]));
        assert_eq!(differ, None, "{name}, row {y}");
        assert_eq!(native.operations(), scalar.operations(), "{name}, row {y}");
    }
}

#[test]
fn lanes_compute_what_pixels_do() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    let mut scenes = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "scn") {
            continue;
        }
        let name = path.display().to_string();
        let scene = check(&name, &std::fs::read_to_string(&path).unwrap());
        let graph = scene.lower(&Options::default()).unwrap();
        verify(&graph).unwrap();
        let height = graph.image.height as i32;
        // Where errors are spread, the rows between are drawn too.
        let step = if graph.diffusion.is_some() { 1 } else { 37 };
        let rows = (0..height).skip(height as usize / 3).step_by(step).take(5);
        same(&name, &graph, rows);
        scenes += 1;
    }
    assert!(scenes >= 16, "{scenes}");
}

#[test]
fn lanes_of_random_graphs_compute_what_pixels_do() {
    let (mut loops, mut unequal) = (0, 0);
    for seed in 0..200 {
        let graph = random_graphs::graph(seed);
        verify(&graph).unwrap();
        same(
            &format!("graph {seed}"),
            &graph,
            0..graph.image.height as i32,
        );
        let reached = graph.reached();
        let kinds = graph.ids().filter(|id| reached[id.0 as usize]);
        loops += kinds
            .filter(|&id| matches!(graph.node(id), Node::Result { .. }))
            .count();
        let mut native = Native::new(&graph);
        let shades = [3, 40, 70].map(|x| native.pixel(x, 3).shade);
        unequal += usize::from(shades.iter().any(|&shade| shade != shades[0]));
    }
    assert!(loops > 400 && unequal > 50, "{loops} {unequal}");
}

#[test]
fn any_columns_in_any_order_are_the_same_pixels() {
    for seed in 0..12 {
        let graph = random_graphs::graph(seed);
        let (mut native, mut scalar) = (Native::new(&graph), Scalar::new(&graph));
        // Parts of rows, back and forth, and outside of the picture.
        for (from, to, y) in [
            (5, 9, 3),
            (60, 80, 1),
            (-3, 2, 2),
            (0, 71, 4),
            (7, 7, 0),
            (9, 10, 9),
        ] {
            let mut lanes = Vec::new();
            native.pixels(from..to, y, &mut lanes);
            let plain: Vec<_> = (from..to).map(|x| bits(&scalar.pixel(x, y))).collect();
            let lanes: Vec<_> = lanes.iter().map(bits).collect();
            assert_eq!(lanes, plain, "graph {seed}, row {y}");
        }
    }
}
