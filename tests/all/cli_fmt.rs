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

/// A scene that cannot be read does not keep the others from being formatted.
#[test]
fn fmt_formats_what_is_good() {
    let dir = directory(&[("loose.scn", LOOSE), ("wrong.scn", WRONG)]);
    let dir = dir.path();
    let tidy = "image 4 x 3 inks black, white;  // small\ndraw (x, y) = ink(x div 2);\n";
    for args in [["wrong.scn", "loose.scn"], ["loose.scn", "wrong.scn"]] {
        std::fs::write(dir.join("loose.scn"), LOOSE).expect("a file");
        let output = slowlight(dir, &["fmt", args[0], args[1]]);
        assert_eq!(output.status.code(), Some(1));
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(said.contains("wrong.scn:2:"), "{said}");
        assert!(
            said.contains("not formatted: wrong.scn; the others are"),
            "{said}"
        );
        let text = std::fs::read_to_string(dir.join("loose.scn")).expect("a text");
        assert_eq!(text, tidy);
    }
    let output = slowlight(
        dir,
        &["fmt", "--check", "wrong.scn", "nowhere.scn", "loose.scn"],
    );
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        said.contains("not looked at: wrong.scn, nowhere.scn"),
        "{said}"
    );
    let text = std::fs::read_to_string(dir.join("wrong.scn")).expect("a text");
    assert_eq!(text, WRONG);
    let output = slowlight(dir, &["fmt"]);
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

#[test]
fn a_picture_without_a_file_is_shown() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let shown = success(dir.path(), &["render", "steps.scn"]);
    assert_eq!(shown, "  @@\n  @@\nsteps: 4 x 3 pixels, 2 inks\n");
    let shown = success(dir.path(), &["render", "steps.scn", "-o", "x.png"]);
    assert_eq!(shown, "steps: 4 x 3 pixels, 2 inks\n");
}
