//! `snapshot`: written, held against, changed, missing.

use crate::cli::{directory, json, names, slowlight, success};
use std::path::Path;

const STRIPES: &str = "image 8 x 4 inks black, white;
param wide: real = 2 in 1 .. 4;
draw (x, y) = ink(floor(x / wide) mod 2);
";

const BOTH: [&str; 4] = ["-t", "6502", "-t", "jack"];

fn snapshot<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["snapshot", "stripes.scn"][..], more].concat()
}

/// What a run that must fail says: standard output and standard error.
fn fails(dir: &Path, args: &[&str], status: i32) -> (String, String) {
    let output = slowlight(dir, args);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{args:?}: {said}");
    (text(&output.stdout), said)
}

#[test]
fn a_missing_snapshot_says_how_to_accept_it() {
    let dir = directory(&[("stripes.scn", STRIPES)]);
    let dir = dir.path();
    let (shown, said) = fails(dir, &snapshot(&BOTH), 3);
    assert!(
        shown.contains("missing    snapshots/stripes.jack.snap"),
        "{shown}"
    );
    assert!(said.contains("2 missing"), "{said}");
    let accept = "`slowlight snapshot stripes.scn --target 6502:plain --target jack --accept`";
    assert!(said.contains(accept), "{said}");
    let (_, said) = fails(dir, &snapshot(&[]), 2);
    assert!(said.contains("--accept"), "{said}");
    assert_eq!(names(dir), ["stripes.scn"]);
}

#[test]
fn accepted_snapshots_hold_until_something_changes() {
    let dir = directory(&[("stripes.scn", STRIPES)]);
    let dir = dir.path();
    let accept = [&BOTH[..], &["--accept"]].concat();
    let shown = success(dir, &snapshot(&accept));
    assert!(shown.starts_with("new "), "{shown}");
    let kept = dir.join("snapshots");
    let files = ["stripes.6502-plain.snap", "stripes.jack.snap"];
    assert_eq!(names(&kept), files);
    let read = |name: &str| std::fs::read_to_string(kept.join(name)).expect("a snapshot");
    let first = read(files[0]);
    let run = json(dir, &["run", "stripes.scn", "-t", "6502", "--json"]);
    let digest = run["inks_sha256"].as_str().expect("a digest");
    for line in [
        "scene: stripes.scn".to_owned(),
        "target: 6502:plain".to_owned(),
        format!("inks_sha256: {digest}"),
        format!("cycles: {}", run["cycles"]),
        "differs_from_model: 0".to_owned(),
    ] {
        assert!(first.lines().any(|l| l == line), "{line}: {first}");
    }
    let text = success(
        dir,
        &["build", "stripes.scn", "-t", "6502", "--emit", "text"],
    );
    let bytes = text.len();
    let size = format!("lines: {}, bytes: {bytes}\n", text.lines().count());
    let top: String = text.lines().take(40).map(|l| format!("{l}\n")).collect();
    assert!(first.contains("==> stripes.asm <==\nsha256: "), "{first}");
    assert!(first.contains(&format!("{size}{top}[")), "{first}");
    assert!(!first.contains(&text));
    // What a runtime brings is not the scene's, and the parameter block is shown.
    let jack = read(files[1]);
    assert!(jack.contains("==> Fixed.jack <==\nsha256: "), "{jack}");
    assert!(jack.contains("let wide = 2"), "{jack}");
    assert!(jack.len() < 8000, "{} bytes", jack.len());
    assert!(
        first.ends_with("==> picture <==\n  @@  @@\n  @@  @@\n"),
        "{first}"
    );

    // Without a target: those that are kept.
    let shown = success(dir, &snapshot(&[]));
    assert_eq!(shown.matches("unchanged").count(), 2, "{shown}");
    // A comment changes nothing that counts.
    let path = dir.join("stripes.scn");
    std::fs::write(&path, format!("// stripes\n{STRIPES}")).expect("a file");
    success(dir, &snapshot(&[]));
    assert_eq!(read(files[0]), first);

    std::fs::write(&path, STRIPES.replace("mod 2", "mod 2 + y div 2")).expect("a file");
    let (shown, said) = fails(dir, &snapshot(&BOTH), 3);
    assert!(
        shown.contains("(the scene was edited)\n--- snapshots/"),
        "{shown}"
    );
    assert!(shown.contains("\n-inks_sha256: "), "{shown}");
    assert!(shown.contains("\n+inks_sha256: "), "{shown}");
    assert!(!shown.contains('\x1b'), "no terminal, no colours");
    assert!(said.contains("2 changed"), "{said}");
    assert_eq!(read(files[0]), first);
    let shown = success(dir, &snapshot(&accept));
    assert!(shown.starts_with("accepted "), "{shown}");
    success(dir, &snapshot(&BOTH));
    assert_eq!(names(&kept), files);

    // A snapshot that changed although the scene did not; options that did.
    let edited = read(files[0]).replacen("cycles: ", "cycles: 1", 1);
    std::fs::write(kept.join(files[0]), edited).expect("a file");
    let (shown, _) = fails(dir, &snapshot(&["-t", "6502"]), 3);
    assert!(shown.contains("(the scene is as it was)"), "{shown}");
    let (shown, _) = fails(dir, &snapshot(&["-t", "jack", "--rows", "0..1"]), 3);
    assert!(shown.contains("\n+options: --rows 0..1\n"), "{shown}");
    assert!(
        shown.contains("(kept with no options, now with `--rows 0..1`)"),
        "{shown}"
    );
}

/// The options that a snapshot was made with make it again.
#[test]
fn options_are_taken_from_the_snapshot() {
    let dir = directory(&[("stripes.scn", STRIPES)]);
    let dir = dir.path();
    let made = [
        "-t", "6502", "--rows", "1..2", "--format", "fixed16", "--set", "wide= 3", "--freeze",
        "all",
    ];
    success(dir, &snapshot(&[&made[..], &["--accept"]].concat()));
    success(dir, &snapshot(&["-t", "jack", "--full", "--accept"]));
    let kept = dir.join("snapshots/stripes.6502-plain.snap");
    let read = || std::fs::read_to_string(&kept).expect("a snapshot");
    let first = read();
    let options = "--set 'wide= 3' --freeze all --rows 1..2 --format fixed16";
    for line in [
        &format!("options: {options}"),
        "format: fixed16",
        "rows: 1..2",
    ] {
        assert!(first.lines().any(|l| l == line), "{line}: {first}");
    }
    let text = success(
        dir,
        &["build", "stripes.scn", "-t", "jack", "--emit", "text"],
    );
    let jack = std::fs::read_to_string(dir.join("snapshots/stripes.jack.snap"));
    assert!(jack.expect("a snapshot").contains(&text));

    let shown = success(dir, &snapshot(&[]));
    assert_eq!(shown.matches("unchanged").count(), 2, "{shown}");
    success(dir, &snapshot(&made));
    // Others are told, and change nothing unless they are accepted.
    let (shown, said) = fails(dir, &snapshot(&["-t", "6502", "--rows", "0..1"]), 3);
    let differ = format!("(kept with `{options}`, now with `--rows 0..1`)");
    assert!(shown.contains(&differ), "{shown}");
    assert!(
        said.contains("made with those that they are kept with"),
        "{said}"
    );
    assert_eq!(read(), first);
    let (shown, _) = fails(dir, &snapshot(&["-t", "6502", "--anew"]), 3);
    assert!(
        shown.contains(&format!("(kept with `{options}`, now with no options)")),
        "{shown}"
    );
    success(
        dir,
        &snapshot(&["-t", "6502", "--rows", "0..1", "--accept"]),
    );
    assert!(read().contains("\noptions: --rows 0..1\n"));
    success(dir, &snapshot(&["-t", "6502", "--anew", "--accept"]));
    assert!(!read().contains("\noptions: "));

    // Options that nobody knows any more.
    let odd = read().replace("target: ", "options: --rose 1..2\ntarget: ");
    std::fs::write(&kept, odd).expect("a file");
    let (_, said) = fails(dir, &snapshot(&["-t", "6502"]), 1);
    assert!(
        said.contains("was made with `--rose 1..2`: unexpected argument"),
        "{said}"
    );
    assert!(said.contains("`--anew`"), "{said}");
}

#[test]
fn a_wrong_scene_does_not_stop_the_others() {
    let wrong = "image 4 x 4 inks black, white; draw (x, y) = ink(flor(x));";
    let dir = directory(&[("stripes.scn", STRIPES), ("odd.scn", wrong)]);
    let dir = dir.path();
    let args = [
        "snapshot",
        "odd.scn",
        "stripes.scn",
        "-t",
        "6502",
        "--accept",
    ];
    let (shown, said) = fails(dir, &args, 1);
    assert!(
        shown.contains("new        snapshots/stripes.6502-plain.snap"),
        "{shown}"
    );
    assert!(said.contains("flor"), "{said}");
    assert_eq!(names(&dir.join("snapshots")), ["stripes.6502-plain.snap"]);
    let output = slowlight(dir, &[&args[..5], &["--json"]].concat());
    let all: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(all["snapshots"][0]["status"], "failed");
    assert_eq!(all["snapshots"][1]["status"], "unchanged");
    assert_eq!(all["snapshots"][1]["run"]["differs_from_model"], 0);
}
