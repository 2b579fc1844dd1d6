//! Colours in the inks that there are.

use crate::cli::{directory, json};
use rayon::prelude::*;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;

/// The mean colour of a square of 32 x 32 pixels that are painted in one colour.
fn mean(inks: &str, colour: [f64; 3]) -> [f64; 3] {
    let [r, g, b] = colour;
    let text =
        format!("image 32 x 32 inks {inks}; draw (x, y) = paint(({r:.3}, {g:.3}, {b:.3}), x, y);");
    let scene = scene::check("paint", &text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let graph = scene.lower(&Options::default()).expect("a graph");
    let palette = graph.image.palette.clone();
    let mut native = Native::new(&graph);
    let mut sum = [0.0; 3];
    for (x, y) in (0..32).flat_map(|y| (0..32).map(move |x| (x, y))) {
        let rgb = palette[usize::from(native.pixel(x, y).ink)];
        for (part, of) in sum.iter_mut().zip(rgb) {
            *part += f64::from(of) / 255.0 / 1024.0;
        }
    }
    sum
}

fn off(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

#[test]
fn the_mean_is_the_colour_where_inks_lie_evenly() {
    let two = "black, white";
    let greys = "black, #808080, white";
    let eight = "black, red, green, blue, yellow, magenta, cyan, white";
    for grey in [0.0, 0.1, 0.25, 0.4, 0.5, 0.77, 0.9, 1.0] {
        for inks in [two, greys, eight] {
            let found = mean(inks, [grey; 3]);
            assert!(off(found, [grey; 3]) < 0.04, "{inks} {grey}: {found:?}");
        }
    }
    for colour in [[0.2, 0.0, 0.0], [0.5, 0.3, 0.9], [0.8, 1.0, 0.1]] {
        let found = mean(eight, colour);
        assert!(off(found, colour) < 0.04, "{colour:?}: {found:?}");
    }
    // An ink by itself has no grain, and what is beyond the ends is the end.
    assert_eq!(mean(eight, [1.0, 1.0, 0.0]), [1.0, 1.0, 0.0]);
    assert_eq!(mean(eight, [-3.0, 7.0, 0.0]), [0.0, 1.0, 0.0]);
    // What no inks mix is nearer than the nearest of them alone would be.
    let found = mean(two, [1.0, 0.0, 0.0]);
    assert!(found[0] > 0.1 && found[0] < 0.7, "{found:?}");
}

#[test]
fn machines_paint_as_the_model() {
    let text = "image 24 x 16 inks black, red, green, white;
        draw (x, y) = paint((x / 23, y / 15, 0.25), x, y);";
    let dir = directory(&[("paint.scn", text)]);
    let targets = ["jack", "bbc:micro", "6502:plain", "6502:bbc", "6502:c64"];
    targets.par_iter().for_each(|target| {
        let found = json(dir.path(), &["run", "paint.scn", "-t", target, "--json"]);
        assert_eq!(found["differs_from_model"], 0, "{target}");
        let native = found["differs_from_native"].as_u64().expect("a count");
        assert!(native <= 16, "{target}: {native}");
    });
}
