//! The command line: what is said in place of what would mislead.

use crate::cli::{directory, json, slowlight};
use serde_json::Value;
use std::path::Path;

fn said(dir: &Path, args: &[&str]) -> String {
    let output = slowlight(dir, args);
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Ints of 32 bits in the language, of 16 on the Hack.
#[test]
fn ints_that_leave_a_machines_are_told() {
    let scene = "image 320 x 256 inks black, white;
draw (x, y) = ink(if (x * x + y * y) div 1000 mod 2 == 0 then 1 else 0);
";
    let small = scene.replace("320 x 256", "120 x 100");
    let dir = directory(&[("far.scn", scene), ("near.scn", &small)]);
    let found = json(dir.path(), &["check", "far.scn", "-t", "jack", "--json"]);
    let found = &found["diagnostics"][0];
    let message = found["message"].as_str().expect("a message");
    let wanted = "`x * x` lies in [0, 101761], and an int of jack has 16 bits: it stops at -32768 \
                  and 32767";
    assert_eq!(message, wanted);
    assert_eq!(found["line"], 2);
    assert_eq!(found["others"].as_array().map(Vec::len), Some(1), "{found}");
    let rows = ["--rows", "0..1", "-o", "out"];
    let run = |scene: &str, target: &str| {
        let args = ["build", scene, "-t", target];
        said(dir.path(), &[&args[..], &rows].concat())
    };
    assert!(run("far.scn", "jack").contains(wanted));
    assert!(!run("near.scn", "jack").contains("an int of"));
    assert!(!run("far.scn", "6502").contains("an int of"));
}

#[test]
fn a_table_that_does_not_begin_again_is_told() {
    let scene = "image 16 x 16 inks black, white;
draw (x, y) = threshold(x / 16, bayer(8)[x, y]);
";
    let right = scene.replace("[x, y]", "[x mod 8, y mod 8]");
    let dir = directory(&[("wrong.scn", scene), ("right.scn", &right)]);
    let wrong = said(dir.path(), &["check", "wrong.scn", "--quick"]);
    assert!(wrong.contains("this table has 8 columns, and x goes up to 15"));
    assert!(wrong.contains("`x mod 8`"), "{wrong}");
    assert_eq!(said(dir.path(), &["check", "right.scn", "--quick"]), "");
}

/// Errors that are spread come from all rows above: the program runs them, too.
#[test]
fn cycles_a_pixel_are_of_the_pixels_that_run() {
    let scene = "image 16 x 16 inks black, white;
draw (x, y) = floyd(x / 16, x, y);
";
    let dir = directory(&[("spread.scn", scene)]);
    let run = |more: &[&str]| -> Value {
        let args = ["run", "spread.scn", "-t", "6502:plain", "--json"];
        json(dir.path(), &[&args[..], more].concat())
    };
    let (whole, last) = (run(&[]), run(&["--rows", "15"]));
    let each = |run: &Value| run["cycles_per_pixel"].as_f64().expect("a number");
    assert!(each(&last) < 1.1 * each(&whole), "{whole} {last}");
    let args = ["run", "spread.scn", "-t", "6502:plain", "--rows", "15"];
    let told = String::from_utf8(slowlight(dir.path(), &args).stdout).expect("a text");
    assert!(
        told.contains("256, as errors come from all rows above"),
        "{told}"
    );
}

#[test]
fn colours_are_listed() {
    let scene = "image 8 x 8 inks black, turquoise;
draw (x, y) = ink(0);
";
    let dir = directory(&[("c.scn", scene)]);
    let told = said(dir.path(), &["check", "c.scn", "--quick"]);
    assert!(told.contains("one of: black, red, green, yellow"), "{told}");
}

/// What a scene that moves asks by name, hidden by an item; a box in which nothing is; what is
/// no file.
#[test]
fn what_a_scene_does_not_mean_is_told() {
    let begin = "image 8 x 8 inks black, white;\n";
    let hidden = format!(
        "{begin}state picture: int = 0 in 0 .. 9 -> picture + 1;\ndraw (x, y) = ink(picture mod 2);\n"
    );
    let swapped = format!(
        "{begin}scene w {{ box((0, 1, 0), (1, 0, 1)) is 1; }}
draw (x, y) = ink(if let h = w.trace(ray((x, y, 9), (0, 0, -1)), far: 20) then h.tag else 0);\n"
    );
    let nowhere = format!("use \".\";\n{begin}draw (x, y) = ink(0);\n");
    let ranged =
        format!("{begin}state a: bool = true in 0 .. 1 -> not a;\ndraw (x, y) = ink(0);\n");
    let cases = [
        (hidden, "this hides the language's own `picture`", 0),
        (
            swapped,
            "nothing is in this `box`: `low.y` is 1, above `high.y`, which is 0",
            1,
        ),
        (nowhere, "is a directory, not a file", 1),
        (ranged, "the state `a` is a bool, which has no range", 1),
    ];
    for (scene, wanted, status) in cases {
        let dir = directory(&[("s.scn", &scene)]);
        let output = slowlight(dir.path(), &["check", "s.scn", "--quick"]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.contains(wanted), "{told}");
        assert_eq!(output.status.code(), Some(status), "{told}");
        assert!(!told.contains("errors"), "{told}");
    }
}
