//! Pictures of scenes that spread their dither's error, and parts of them.

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
