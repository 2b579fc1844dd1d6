//! The command line, run as its user runs it: wrong uses and wrong files.
//! Each ends with the exit status that says whose mistake it is, and leaves nothing behind.

#[cfg(unix)]
use crate::cli::interrupted;
use crate::cli::{LONG, STEPS, directory, names, slowlight};

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
    let part = "did you mean `6502:c64`?";
    fails(&["run", "steps.scn", "-t", "c64"], 2, part);
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
        "it has f316, f316r, log10, fixed16, f416",
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
    let build = ["build", "steps.scn", "-t", "jack", "-o"];
    fails(&[&build[..], &["x.asm"]].concat(), 2, "name a directory");
    for command in ["snapshot", "survey"] {
        let args = [command, "-", "-t", "jack", "-o", "x.md"];
        let used = if command == "survey" { 6 } else { 4 };
        fails(&args[..used], 2, "not standard input");
    }
}

/// Values that a param cannot have are the user's mistake, of whatever kind, for every
/// command.
#[test]
fn values_that_no_param_has_are_status_2() {
    for (value, part) in [
        ("shift=5", "`shift` is 5, outside its range 0 .. 4"),
        ("shift=-1", "`shift` is -1, outside its range 0 .. 4"),
        ("shift=1,2", "`shift` has 1 number, not 2"),
        ("shift=abc", "numbers"),
        ("shift=1e400", "numbers"),
    ] {
        fails(
            &["render", "steps.scn", "-o", "x.png", "--set", value],
            2,
            part,
        );
        fails(&["check", "steps.scn", "--set", value], 2, part);
        fails(&["run", "steps.scn", "-t", "6502", "--set", value], 2, part);
        fails(
            &["build", "steps.scn", "-t", "bbc", "--set", value],
            2,
            part,
        );
    }
}

/// Without a machine, the machines are named.
#[test]
fn a_missing_target_lists_the_targets() {
    for command in ["run", "explain", "effects", "tune"] {
        fails(
            &[command, "steps.scn"],
            2,
            "targets: jack, bbc:micro, bbc:agon",
        );
    }
    fails(&["build", "steps.scn"], 2, "6502:c64");
}

#[test]
fn wrong_values_and_files_are_status_1() {
    fails(&["render", "nowhere.scn", "-o", "x.png"], 1, "nowhere.scn");
    fails(&["render", ".", "-o", "x.png"], 1, "directory");
    fails(
        &["render", "steps.scn", "-o", "no/such/dir/x.png"],
        1,
        "x.png",
    );
    fails(&["vm", "bbc", "nowhere.bas"], 1, "nowhere.bas");
}

/// A path that cannot be written is told before the work that would be lost: this scene
/// takes hours.
#[test]
fn paths_are_tried_before_the_work() {
    let dir = directory(&[("long.scn", LONG)]);
    let dir = dir.path();
    std::fs::create_dir(dir.join("full.png")).expect("a directory");
    let run = ["run", "long.scn", "-t", "6502"];
    let explain = ["explain", "long.scn", "-t", "6502"];
    let tune = ["tune", "long.scn", "-t", "6502"];
    let build = ["build", "long.scn", "-t", "6502"];
    let survey = ["survey", "long.scn", "-t", "6502"];
    let compare = ["compare", "long.scn", "-t", "6502"];
    let cases: [(&[&str], &[&str], &str); 11] = [
        (&run, &["-o", "no/x.png"], "cannot write no/x.png"),
        (
            &run,
            &["-o", "long.scn/x.png"],
            "cannot write long.scn/x.png",
        ),
        (&run, &["-o", "full.png"], "full.png is a directory"),
        (
            &["render", "long.scn"],
            &["-o", "no/x.png"],
            "cannot write no/x.png",
        ),
        (&explain, &["--html", "no/x.html"], "cannot write no/x.html"),
        (&explain, &["--svg", "no/x.svg"], "cannot write no/x.svg"),
        (
            &["effects", "long.scn", "-t", "6502"],
            &["--svg", "full.png"],
            "is a directory",
        ),
        (&tune, &["--html", "no/x.html"], "cannot write no/x.html"),
        (&build, &["-o", "long.scn"], "long.scn is no directory"),
        (
            &survey,
            &["-o", "long.scn/x.md"],
            "long.scn is no directory",
        ),
        (&compare, &["-o", "no/x.png"], "cannot write no/x.png"),
    ];
    for (command, output, part) in cases {
        let output = slowlight(dir, &[command, output].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{command:?}: {said}");
        assert!(said.contains(part), "{command:?}: {said}");
        assert_eq!(names(dir), ["full.png", "long.scn"], "{command:?}");
    }
}

/// What cannot be printed is an error, and a reader that has gone away is none.
#[cfg(target_os = "linux")]
#[test]
fn what_cannot_be_printed_is_an_error() {
    use std::process::{Command, Stdio};
    let dir = directory(&[("steps.scn", STEPS)]);
    let started = |args: &[&str], out: Stdio, err: Stdio| {
        Command::new(env!("CARGO_BIN_EXE_slowlight"))
            .args(args)
            .current_dir(dir.path())
            .stdout(out)
            .stderr(err)
            .spawn()
            .expect("the binary runs")
    };
    let full = || {
        let file = std::fs::OpenOptions::new().write(true).open("/dev/full");
        Stdio::from(file.expect("a device"))
    };
    let snapshot = ["snapshot", "steps.scn", "-t", "6502", "--accept"];
    slowlight(dir.path(), &snapshot);
    let commands: [&[&str]; 14] = [
        &["targets"],
        &["targets", "--json"],
        &["--help"],
        &["--version"],
        &["render", "steps.scn"],
        &["render", "steps.scn", "--json"],
        &["check", "steps.scn", "--quick"],
        &["check", "steps.scn", "--quick", "--json"],
        &["build", "steps.scn", "-t", "6502", "--emit", "text"],
        &["run", "steps.scn", "-t", "6502"],
        &["run", "steps.scn", "-t", "6502", "--json"],
        &["explain", "steps.scn", "-t", "6502"],
        &["effects", "steps.scn", "-t", "6502", "--json"],
        &snapshot[..4],
    ];
    for args in commands {
        let child = started(args, full(), Stdio::piped()).wait_with_output();
        let output = child.expect("it ends");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{args:?}: {said}");
        assert!(
            said.contains("cannot write to standard output"),
            "{args:?}: {said}"
        );
        let mut gone = started(args, Stdio::piped(), Stdio::null());
        drop(gone.stdout.take());
        let status = gone.wait().expect("it ends");
        assert_eq!(status.code(), Some(0), "{args:?}");
    }
    // Nobody can be told, and nothing else goes wrong.
    let status = started(&["render", "nowhere.scn"], Stdio::null(), full()).wait();
    assert_eq!(status.expect("it ends").code(), Some(1));
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
