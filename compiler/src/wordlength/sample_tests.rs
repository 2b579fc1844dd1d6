#![allow(clippy::unwrap_used)]

use super::sample::{DRAFT, seen};
use crate::scene::check;
use crate::schedule::statements::schedule;
use crate::sema::Options;

/// How many pixels are looked at where a loop of so many turns is run once a picture.
fn looked_at(turns: u32) -> f64 {
    let text = format!(
        "image 120 x 56 inks black, white;
draw (x, y) = threshold((loop (v = 0.5) max {turns} {{
  if v > 1000000000 then v else next(v + 0.5)
}} else v - 1) * x, bayer(4)[x mod 4, y mod 4]);"
    );
    let scene = check("test", &text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let graph = scene.lower(&Options::default()).unwrap();
    seen(&graph, &schedule(&graph), 24, DRAFT).pixels()
}

/// What is computed once a picture is followed back from each pixel, and that has an end.
#[test]
fn a_picture_of_one_long_sum_is_looked_at_in_fewer_places() {
    let (short, long) = (looked_at(10), looked_at(10_000));
    assert!(10.0 * long < short, "{long} {short}");
    assert!(long > 0.0);
}
