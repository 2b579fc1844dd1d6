//! Small scenes on the 6502 in both of its formats: the machine draws what the model says.

use crate::cli::{directory, json};

/// Runs a scene of 24 x 16 pixels in a format; how many pixels are not the native's.
fn off(draw: &str, format: &str) -> u64 {
    let text = format!("image 24 x 16 inks black, white;\n{draw}");
    let dir = directory(&[("small.scn", &text)]);
    let args = [
        "run",
        "small.scn",
        "-t",
        "6502",
        "--json",
        "--format",
        format,
    ];
    let run = json(dir.path(), &args);
    assert_eq!(run["differs_from_model"], 0, "{draw} in {format}");
    run["differs_from_native"].as_u64().expect("a number")
}

/// What waits for a pixel is read after what is added to it has been moved to its scale.
#[test]
fn large_errors_are_sent_as_the_model_sends_them() {
    let draw = "draw (x, y) = floyd(if x < 6 then x * 3.1 + y * 0.1 else 0, x, y);";
    assert_eq!(off(draw, "fixed16.16"), 0);
    off(draw, "fixed16");
}

/// Dividends that are one power of two by their range, and no constants.
#[test]
fn quotients_of_what_can_be_one_value_only_are_right() {
    for draw in [
        "param p: int = 4 in 4 .. 4;
        draw (x, y) = threshold(p / (x + 1), bayer(2)[x mod 2, y mod 2]);",
        "draw (x, y) = threshold((y - y mod 16 + 8) / (x + 9), bayer(2)[x mod 2, y mod 2]);",
    ] {
        let (usual, own) = (off(draw, "fixed16.16"), off(draw, "fixed16"));
        assert!(own <= usual + 2, "{draw}: {own}, {usual}");
    }
}

/// A constant of less than half a last place is 0, and the ranges know it.
#[test]
fn tiny_constants_do_not_make_inks_that_are_none() {
    let draw = "draw (x, y) = threshold(0.000001, bayer(2)[x mod 2, y mod 2]);";
    assert_eq!(off(draw, "fixed16.16") + off(draw, "fixed16"), 0);
}
