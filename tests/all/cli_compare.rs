//! `compare` over formats, and `run --against` other pictures.

use crate::cli::{STEPS, directory, json, slowlight, success};

#[test]
fn a_machine_in_each_of_its_formats() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let of = |more: &[&str]| {
        let args = ["compare", "steps.scn", "--json", "-t", "jack", "-t", "6502"];
        let rows = json(dir.path(), &[&args[..], more].concat());
        let name = |row: &serde_json::Value| row["format"].as_str().map(str::to_owned);
        let rows = rows.as_array().expect("rows");
        assert!(rows.iter().all(|row| row["differs_from_model"] == 0));
        rows.iter().filter_map(name).collect::<Vec<_>>()
    };
    assert_eq!(of(&[]), ["f316", "fixed16.16"]);
    // Who has no such format is run in the usual one.
    assert_eq!(of(&["--format", "f316r"]), ["f316r", "fixed16.16"]);
    let all = of(&["--format", "all"]);
    assert!(
        all.len() > 2 && all.contains(&"log10".to_owned()),
        "{all:?}"
    );
    let output = slowlight(dir.path(), &["compare", "steps.scn", "--format", "log12"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("did you mean `log11`"), "{said}");
}

#[test]
fn pixels_unlike_those_of_another_picture_are_counted() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let dir = dir.path();
    for file in ["moved.pbm", "moved.pgm", "moved.png"] {
        success(
            dir,
            &["render", "steps.scn", "--set", "shift=1", "-o", file],
        );
        let args = ["run", "steps.scn", "-t", "jack", "--against", file];
        // One column of three rows.
        let run = json(dir, &[&args[..], &["--json"]].concat());
        assert_eq!(run["differs_from"][file], 3);
        let run = json(dir, &[&args[..], &["--json", "--rows", "1..2"]].concat());
        assert_eq!(run["differs_from"][file], 2);
        let said = success(dir, &args);
        assert!(said.contains(&format!("differs from {file}")), "{said}");
    }
    success(
        dir,
        &["render", "steps.scn", "--rows", "0..1", "-o", "two.pgm"],
    );
    let fails = |file: &str, why: &str| {
        let output = slowlight(dir, &["run", "steps.scn", "-t", "jack", "--against", file]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_ne!(output.status.code(), Some(0), "{file}");
        assert!(said.contains(why), "{file}: {said}");
    };
    fails("two.pgm", "4 x 2");
    fails("steps.scn", "no picture's name");
    std::fs::write(dir.join("cut.pgm"), b"P5\n4 3\n255\n\0").expect("a file");
    fails("cut.pgm", "cut.pgm");
}
