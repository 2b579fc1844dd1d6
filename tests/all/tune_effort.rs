//! `tune` does so much work and no more, tells what it finds as it comes, and finds the same by
//! any number of threads.

use crate::cli::directory;
use crate::tune::{BALL, planted};
use serde_json::Value;
use slowlight::scene::Changes;
use slowlight::target_args::ScreenArgs;
use slowlight::tune::choice::Base;
use slowlight::tune::explore::Found;
use slowlight::tune::goal::Measure;
use slowlight::tune::rows::Look;
use slowlight::tune::tell::Told;
use slowlight_compiler::targets::find;
use std::path::PathBuf;
use std::process::Command;

/// What `tune` says of the ball on standard error, a line each, and its points.
fn said(threads: &str) -> (Vec<String>, Value) {
    let dir = directory(&[("ball.scn", BALL)]);
    let output = Command::new(env!("CARGO_BIN_EXE_slowlight"))
        .current_dir(dir.path())
        .args("tune ball.scn -t 6502 --json --no-cache --settings 6".split(' '))
        .env("RAYON_NUM_THREADS", threads)
        .output()
        .expect("slowlight runs");
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    let lines = text.lines().map(str::to_owned).collect();
    (lines, serde_json::from_slice(&output.stdout).expect("JSON"))
}

#[test]
fn points_are_said_without_a_terminal_a_coarse_one_first_and_threads_change_nothing() {
    let ((lines, found), other) = (said("1"), said("2"));
    let of = |line: &&String| line.contains("of the pixels in another ink: --");
    let said: Vec<&String> = lines.iter().filter(of).collect();
    assert_eq!(
        said.len(),
        found["points"].as_array().map_or(0, Vec::len),
        "{lines:?}"
    );
    assert!(
        said[0].contains("--block 8x4") || said[0].contains("--block 8"),
        "{said:?}"
    );
    assert_eq!(other.1, found);
}

#[test]
fn what_takes_more_work_than_is_to_be_done_is_left_and_told() {
    let base = Base {
        path: PathBuf::from("planted.scn"),
        changes: Changes::default(),
        target: find("jack").expect("a target"),
        screen: ScreenArgs::default(),
    };
    let look = |cycles| Look {
        cycles,
        before: 0.0,
        error: 0.0,
        pixels: 100.0,
    };
    let found = Found {
        points: vec![planted(2, 40, 20)],
        beyond: vec![(planted(1, 90, 0).choice, look(9e11))],
        ..Found::default()
    };
    let told = Told::new(&base, Measure::Pixels, &found);
    let table = told.table();
    assert!(
        table.contains("beyond --effort: 1, such as --format f316, about"),
        "{table}"
    );
    let left = &told.json(None)["left_for_effort"];
    assert_eq!(left[0]["options"], "--format f316");
}
