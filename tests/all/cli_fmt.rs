//! Scenes and pictures as text: `fmt`, and `render --ascii`.

use crate::cli::{STEPS, directory, names, slowlight, success};

const LOOSE: &str = "image 4 x 3   inks black,white; // small
draw(x,y)=ink( x  div 2 );
";
const WRONG: &str = "image 4 x 3 inks black, white;\ndraw (x, y) = ink(;\n";

#[test]
fn fmt_writes_what_changes() {
    let dir = directory(&[("loose.scn", LOOSE), ("steps.scn", STEPS)]);
    let dir = dir.path();
    let before = std::fs::metadata(dir.join("steps.scn")).expect("a file");
    assert_eq!(success(dir, &["fmt", "loose.scn", "steps.scn"]), "");
    let text = std::fs::read_to_string(dir.join("loose.scn")).expect("a text");
    assert_eq!(
        text,
        "image 4 x 3 inks black, white;  // small\ndraw (x, y) = ink(x div 2);\n"
    );
    let after = std::fs::metadata(dir.join("steps.scn")).expect("a file");
    assert_eq!(
        before.modified().expect("a time"),
        after.modified().expect("a time")
    );
    assert_eq!(success(dir, &["fmt", "--check", "loose.scn"]), "");
    assert_eq!(names(dir), ["loose.scn", "steps.scn"]);
}

#[test]
fn fmt_check_lists_and_writes_nothing() {
    let dir = directory(&[("loose.scn", LOOSE), ("steps.scn", STEPS)]);
    let output = slowlight(dir.path(), &["fmt", "--check", "steps.scn", "loose.scn"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(output.stdout, b"loose.scn\n");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("1 of 2"), "{said}");
    let text = std::fs::read_to_string(dir.path().join("loose.scn")).expect("a text");
    assert_eq!(text, LOOSE);
}

/// One scene that cannot be read keeps all from being written.
#[test]
fn fmt_is_all_or_nothing() {
    let dir = directory(&[("loose.scn", LOOSE), ("wrong.scn", WRONG)]);
    let output = slowlight(dir.path(), &["fmt", "loose.scn", "wrong.scn"]);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("wrong.scn:2:"), "{said}");
    let text = std::fs::read_to_string(dir.path().join("loose.scn")).expect("a text");
    assert_eq!(text, LOOSE);
    assert_eq!(names(dir.path()), ["loose.scn", "wrong.scn"]);
    let output = slowlight(dir.path(), &["fmt"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn ascii_is_the_picture_as_text() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let shown = success(dir.path(), &["render", "steps.scn", "--ascii"]);
    assert_eq!(shown, "  @@\n  @@\n");
    let shown = success(
        dir.path(),
        &["render", "steps.scn", "--ascii", "--set", "shift=1"],
    );
    assert_eq!(shown, " @@@\n @@@\n");
}
