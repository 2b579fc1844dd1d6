//! Pictures of scenes that spread their dither's error, and parts of them.

use crate::cli::{directory, json};
use slowlight::draw::{Window, native};
use slowlight_compiler::scene::check;
use slowlight_compiler::sema::Options;

/// The rows asked for are the rows of the whole picture, whatever is drawn
/// beside them: errors come from the rows above.
#[test]
fn a_part_of_a_picture_is_a_part_of_the_whole() {
    let scene = check(
        "scene",
        "image 50 x 30 inks black, grey, white;
        draw (x, y) = atkinson(0.5 + 0.4 * sin(x * 0.2rad) * cos(y * 0.3rad), x, y);",
    );
    assert_eq!(scene.diagnostics, []);
    let graph = scene.lower(&Options::default()).expect("a graph");
    let whole = native(&graph, Window::whole(50, 30)).expect("a picture");
    let window = Window {
        columns: (7, 31),
        rows: (11, 28),
    };
    let part = native(&graph, window).expect("a picture");
    let expected = window.places().map(|(x, y)| (y * 50 + x) as usize);
    let expected: Vec<_> = expected.filter_map(|k| whole.pixels.get(k)).collect();
    assert_eq!(part.pixels.iter().collect::<Vec<_>>(), expected);
    let inks = |ink| whole.pixels.iter().filter(|p| p.ink == ink).count();
    assert!(inks(0) > 100 && inks(1) > 100 && inks(2) > 100);
}

/// A pixel sends far to all sides; the ring has four rows.
const FAR: &str = "dither far(v: real, x: int, y: int) -> ink = {
  let q = clamp(round(v * (inks - 1)), 0, inks - 1);
  spread v - q / (inks - 1) to
    { (8, 0): 1/4, (-8, 3): 1/4, (-2, 1): 1/8, (0, 2): 1/8, (3, 1): 1/8, (1, 0): 1/8 };
  ink(q)
};
";

/// Every machine draws what its model does, whole and in part, in a screen that
/// holds the picture and in one that crops it on all sides.
#[test]
fn every_machine_spreads_errors_as_its_model_does() {
    let shade = "(x + tilt * y) / 120, x, y); param tilt: real = 1.5 in 1 .. 2;";
    let scenes = ["floyd", "atkinson", "far"].map(|dither| {
        let text =
            format!("image 40 x 12 inks black, grey, white; {FAR} draw (x, y) = {dither}({shade}");
        (format!("{dither}.scn"), text)
    });
    let cropped = format!(
        "image 176 x 5 inks black, white; {FAR} draw (x, y) = far((x + 20 * y) / 400, x, y);"
    );
    let mut files: Vec<(&str, &str)> = vec![("cropped.scn", &cropped)];
    files.extend(scenes.iter().map(|(n, t)| (n.as_str(), t.as_str())));
    let dir = directory(&files);
    let mut cases: Vec<Vec<&str>> = vec![vec!["cropped.scn", "-t", "bbc:micro", "--mode", "5"]];
    for (name, _) in &scenes {
        for target in ["bbc:micro", "jack", "6502:plain"] {
            cases.push(vec![name, "-t", target]);
        }
    }
    for case in cases {
        for rows in ["0..4", "3..4"] {
            let mut args = vec!["run", "--json", "--rows", rows];
            args.extend(&case);
            let said = json(dir.path(), &args);
            assert_eq!(said["differs_from_model"], 0, "{args:?}");
            // Formats differ by little, and an ink that flips flips others.
            let pixels = said["pixels"].as_u64().expect("a count");
            let differ = said["differs_from_native"].as_u64().expect("a count");
            assert!(differ * 20 <= pixels, "{args:?}: {differ} of {pixels}");
        }
    }
}
