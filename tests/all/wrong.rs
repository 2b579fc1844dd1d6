//! A hundred wrong scenes, and files that are no scenes at all: each gets a
//! diagnostic with its place and exit status 1, and leaves no output behind.

use std::fmt::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Runs `slowlight render` on a file; a run that hangs is killed and fails.
fn render(scene: &Path, picture: &Path) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_slowlight"))
        .arg("render")
        .arg(scene.file_name().expect("a file"))
        .arg("-o")
        .arg(picture)
        .current_dir(scene.parent().expect("a folder"))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("slowlight starts");
    let start = Instant::now();
    while child.try_wait().expect("a child").is_none() {
        if start.elapsed() > Duration::from_secs(60) {
            child.kill().expect("a child");
            panic!("{} hangs", scene.display());
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    child.wait_with_output().expect("output")
}

/// What is said of a wrong file, after checking how it is said.
fn refused(folder: &Path, name: &str, bytes: &[u8]) -> String {
    let (scene, picture) = (folder.join("wrong.scn"), folder.join("picture.png"));
    std::fs::write(&scene, bytes).expect("a file");
    let output = render(&scene, &picture);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{name}: {said}");
    assert!(said.contains("error"), "{name}: {said}");
    assert!(said.contains("wrong.scn"), "{name} has no place: {said}");
    assert!(!said.contains("panicked"), "{name}: {said}");
    let left: Vec<_> = std::fs::read_dir(folder)
        .expect("a folder")
        .flatten()
        .collect();
    assert_eq!(left.len(), 1, "{name} leaves files behind: {left:?}");
    said
}

#[test]
fn a_hundred_wrong_scenes_are_refused_with_a_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = include_str!("../wrong/scenes.txt");
    let mut report = String::new();
    let mut count = 0;
    for part in text.split("\n=== ").skip(1) {
        let (name, scene) = part.split_once('\n').unwrap_or((part, ""));
        let said = refused(folder.path(), name, scene.as_bytes());
        let _ = writeln!(report, "=== {name}\n{}\n", said.trim_end());
        count += 1;
    }
    assert!(count >= 100, "only {count}");
    crate::snapshots::check("wrong_scenes", &report);
}

#[test]
fn files_that_are_no_scenes_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let valid = include_str!("../../examples/mirrors.scn");
    let binary: Vec<u8> = (0..4096u32)
        .map(|k| (k.wrapping_mul(2_654_435_761) >> 13) as u8)
        .collect();
    let brackets = "(".repeat(1 << 20);
    let nested = format!(
        "image 8 x 8 inks black, white;\ndraw (x, y) = {}1{};",
        "(".repeat(400),
        ")".repeat(400)
    );
    let minus = format!(
        "image 8 x 8 inks black, white;\ndraw (x, y) = {}1;",
        "-".repeat(100_000)
    );
    let long = format!(
        "image 8 x 8 inks black, white;\ndraw (x, y) = ink(0{});",
        " + 1".repeat(100_000)
    );
    let large = format!("{valid}\n{}", "// more\n".repeat(1 << 17));
    let files: [(&str, &[u8]); 9] = [
        ("binary", &binary),
        ("zeros", &[0; 1000]),
        ("half of mirrors", &valid.as_bytes()[..valid.len() / 2]),
        ("a megabyte of brackets", brackets.as_bytes()),
        ("deep nesting", nested.as_bytes()),
        ("minus after minus", minus.as_bytes()),
        ("a long sum", long.as_bytes()),
        ("over a megabyte", large.as_bytes()),
        (
            "not UTF-8",
            b"image 8 x 8 inks black, white; // caf\xe9\ndraw (x, y) = ink(0)",
        ),
    ];
    for (name, bytes) in files {
        refused(folder.path(), name, bytes);
    }
}
