//! A survey as GNU parallel runs it, by the very commands of docs/tune.md: its parts make the
//! document of one run.

use crate::cli::directory;
use std::path::Path;
use std::process::{Command, Stdio};

/// Seconds that the commands may take.
const LIMIT: &str = "300";

const DISC: &str = "image 16 x 16 inks black, white;
draw (x, y) = threshold(if (x - 7.5)^2 + (y - 7.5)^2 < 20 then 0.9 else x / 32, bayer(2)[x mod 2, y mod 2]);
";

/// The block of commands that stands behind some words.
fn block<'d>(document: &'d str, words: &str) -> &'d str {
    let (_, behind) = document.split_once(words).expect("the words");
    let (_, block) = behind.split_once("```\n").expect("a block");
    block.split_once("```").expect("its end").0
}

fn shell(dir: &Path, commands: &str) {
    let binary = Path::new(env!("CARGO_BIN_EXE_slowlight"));
    let folder = binary.parent().expect("a folder").to_str().expect("a path");
    let path = format!("{folder}:{}", std::env::var("PATH").expect("a path"));
    let output = Command::new("timeout")
        .args([LIMIT, "bash", "-ec", commands])
        .current_dir(dir)
        .env("PATH", path)
        // Nobody is asked to cite anything, and nothing is kept for the next time.
        .env("HOME", dir)
        .env("XDG_CACHE_HOME", dir.join("cache"))
        .stdin(Stdio::null())
        .output()
        .expect("it runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{commands}: {said}");
}

#[test]
fn parts_by_gnu_parallel_make_the_document_of_one_run() {
    let other = DISC.replace("20", "40");
    let dir = directory(&[]);
    let dir = dir.path();
    let scenes = dir.join("scenes");
    std::fs::create_dir(&scenes).expect("a folder");
    for (name, text) in [("disc.scn", DISC), ("other.scn", &other)] {
        std::fs::write(scenes.join(name), text).expect("a scene");
    }
    let there = Command::new("parallel").arg("--version").output();
    assert!(there.is_ok(), "no GNU parallel: run tests/peers/setup");
    let document = include_str!("../../docs/tune.md");
    shell(dir, block(document, "With [GNU parallel]"));
    let joined = std::fs::read(dir.join("survey.md")).expect("a document");
    std::fs::remove_dir_all(dir.join("cache")).ok();
    shell(
        dir,
        "slowlight survey scenes/*.scn -t jack -t bbc -o survey.md --pictures plots",
    );
    let whole = std::fs::read(dir.join("survey.md")).expect("a document");
    assert!(joined == whole, "joined parts are another document");
}
