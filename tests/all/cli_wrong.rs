//! The command line, run as its user runs it: wrong uses and wrong files.
//! Each ends with the exit status that says whose mistake it is, and leaves nothing behind.

#[cfg(unix)]
use crate::cli::{LONG, interrupted};
use crate::cli::{STEPS, directory, names, slowlight};

fn fails(args: &[&str], status: i32, part: &str) {
    let dir = directory(&[("steps.scn", STEPS)]);
    let output = slowlight(dir.path(), args);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{args:?}: {said}");
    assert!(said.contains(part), "{args:?}: {said}");
    assert_eq!(names(dir.path()), ["steps.scn"], "{args:?}");
}

#[test]
fn wrong_usage_is_status_2() {
    fails(&[], 2, "Usage");
    fails(&["rendre", "steps.scn"], 2, "render");
    fails(&["render"], 2, "SCENE");
    fails(&["render", "steps.scn", "-o", "x.jpg"], 2, ".png");
    fails(
        &["render", "steps.scn", "--set", "shfit=1"],
        2,
        "did you mean `shift`?",
    );
    fails(&["render", "steps.scn", "--set", "shift"], 2, "param=value");
    fails(&["render", "steps.scn", "--set", "shift=one"], 2, "numbers");
    fails(
        &["render", "steps.scn", "--freeze", "q"],
        2,
        "no param `q`; there is shift",
    );
    fails(
        &["render", "steps.scn", "--without", "brigt"],
        2,
        "did you mean `bright`?",
    );
    fails(&["render", "steps.scn", "--rows", "0..3"], 2, "rows 0..2");
    fails(&["render", "steps.scn", "--rows", "2..1"], 2, "below");
    fails(&["run", "steps.scn"], 2, "--target");
    fails(
        &["run", "steps.scn", "--target", "zx81"],
        2,
        "no target `zx81`",
    );
    fails(
        &["build", "steps.scn", "--target", "zx81"],
        2,
        "no target `zx81`",
    );
    fails(&["build", "steps.scn", "--emit", "plan"], 2, "--target");
    fails(&["build", "steps.scn", "--emit", "planets"], 2, "plan");
    fails(
        &["build", "steps.scn", "-t", "6502", "--syntax", "beebas"],
        2,
        "did you mean `beebasm`?",
    );
    fails(
        &["build", "steps.scn", "-t", "bbc", "--syntax", "beebasm"],
        2,
        "--syntax is the 6502's; bbc:micro has none",
    );
    fails(
        &["vm", "bbc", "steps.scn", "--syntax", "beebasm"],
        2,
        "--syntax is the 6502's",
    );
    fails(
        &["vm", "6502", "steps.scn", "--syntax", "acme"],
        2,
        "beebasm",
    );
    fails(
        &["run", "steps.scn", "-t", "6502", "--os", "native"],
        2,
        "Jack",
    );
    fails(
        &["run", "steps.scn", "-t", "jack", "--format", "log9"],
        2,
        "it has f316, f316r, log10, fixed16",
    );
    fails(
        &["vm", "hack", "steps.scn", "--page", "E00"],
        2,
        "--page is the BBC Micro's",
    );
    fails(
        &["run", "steps.scn", "-t", "6502", "--mode", "7"],
        2,
        "one mode",
    );
    fails(&["vm", "z80", "steps.scn"], 2, "6502");
    fails(&["vm", "6502", "steps.scn", "steps.scn"], 2, "one file");
    fails(&["compare", "steps.scn", "-o", "x.pgm"], 2, ".png");
}

#[test]
fn wrong_values_and_files_are_status_1() {
    fails(
        &["render", "steps.scn", "-o", "x.png", "--set", "shift=5"],
        1,
        "outside its range",
    );
    fails(
        &["render", "steps.scn", "-o", "x.png", "--set", "shift=1,2"],
        1,
        "shift",
    );
    fails(&["render", "nowhere.scn", "-o", "x.png"], 1, "nowhere.scn");
    fails(&["render", ".", "-o", "x.png"], 1, "directory");
    fails(
        &["render", "steps.scn", "-o", "no/such/dir/x.png"],
        1,
        "x.png",
    );
    fails(&["vm", "bbc", "nowhere.bas"], 1, "nowhere.bas");
}

/// A wrong file: status 1, a place, no picture.
fn wrong_file(bytes: &[u8], place: &str) {
    let dir = directory(&[]);
    let dir = dir.path();
    std::fs::write(dir.join("wrong.scn"), bytes).expect("a file");
    let output = slowlight(dir, &["render", "wrong.scn", "-o", "x.png"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains(place), "{said}");
    assert!(said.len() < 100_000, "{} bytes of diagnostics", said.len());
    assert_eq!(names(dir), ["wrong.scn"]);
}

#[test]
fn files_that_are_no_scenes_have_a_diagnostic() {
    wrong_file(b"", "wrong.scn:1:1");
    wrong_file(b"\n\n", "wrong.scn:");
    wrong_file(&[0xFF, 0xFE, 0, 1], "wrong.scn:1:1");
    wrong_file(
        b"image 2 x 2 inks black, white;\ndraw (x, y) = \xE9;",
        "wrong.scn:2:15",
    );
    wrong_file(&[0; 1000], "wrong.scn:1:1");
    wrong_file(
        "draw (x, y) = ink(0);\u{feff}\u{202e}".as_bytes(),
        "wrong.scn:",
    );
    for bracket in ["(", "{", "[", "}", ")("] {
        let text = bracket.repeat(1_000_000 / bracket.len());
        wrong_file(text.as_bytes(), "wrong.scn:1:");
    }
    wrong_file(&vec![b'('; (1 << 20) + 1], "longer than 1 MB");
    wrong_file("draw (x, y) = ".as_bytes(), "wrong.scn:1:");
    wrong_file("-".repeat(500_000).as_bytes(), "wrong.scn:1:");
}

/// A picture that takes hours, interrupted: neither the file nor a piece of it.
#[cfg(unix)]
#[test]
fn an_interruption_leaves_nothing() {
    let dir = directory(&[("long.scn", LONG)]);
    interrupted(dir.path(), &["render", "long.scn", "-o", "x.png"]);
    assert_eq!(names(dir.path()), ["long.scn"]);
}
