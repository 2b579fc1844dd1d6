//! `new`: scenes to begin with.

use crate::cli::{directory, names, slowlight, success};
use rayon::prelude::*;
use slowlight::examples::EXAMPLES;
use slowlight_compiler::targets::TARGETS;
use std::path::Path;

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).expect("a text")
}

#[test]
fn the_binary_has_all_examples() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut known = EXAMPLES.iter();
    for folder in ["examples", "examples/moving"] {
        let folder = root.join(folder);
        let all = names(&folder);
        let mut scenes: Vec<&str> = all.iter().filter_map(|n| n.strip_suffix(".scn")).collect();
        scenes.sort_unstable();
        assert!(!scenes.is_empty());
        for name in scenes {
            let text = read(&folder.join(format!("{name}.scn")));
            assert_eq!(known.next(), Some(&(name, text.as_str())), "{name}");
        }
    }
    assert_eq!(known.next(), None);
}

#[test]
fn a_new_scene_compiles_everywhere() {
    let dir = directory(&[]);
    let dir = dir.path();
    let said = success(dir, &["new", "ball"]);
    assert_eq!(
        said,
        "ball.scn is written; next:\n  slowlight render ball.scn -o ball.png\n  \
         slowlight run ball.scn --target jack\n  \
         slowlight live ball.scn --target 6502 --open\n"
    );
    assert_eq!(names(dir), ["ball.scn"]);
    // What it says to type works, and there is nothing to remark.
    success(dir, &["render", "ball.scn", "-o", "ball.png"]);
    let said = success(dir, &["check", "ball.scn", "--quick"]);
    assert_eq!(said, "ball.scn: nothing to remark\n");
    assert_eq!(success(dir, &["fmt", "--check", "ball.scn"]), "");
    TARGETS.par_iter().for_each(|target| {
        let out = target.name.replace(':', "-");
        success(dir, &["build", "ball.scn", "-t", target.name, "-o", &out]);
    });
}

#[test]
fn a_new_scene_may_be_an_example_anywhere() {
    let dir = directory(&[]);
    let dir = dir.path();
    std::fs::create_dir(dir.join("my scenes")).expect("a directory");
    let said = success(dir, &["new", "my scenes/a.b.scn", "--from", "glass"]);
    assert!(
        said.contains("render 'my scenes/a.b.scn' -o 'my scenes/a.b.png'"),
        "{said}"
    );
    let glass = EXAMPLES.iter().find(|(name, _)| *name == "glass");
    let (_, glass) = glass.expect("an example");
    assert_eq!(read(&dir.join("my scenes/a.b.scn")), *glass);
    let output = slowlight(dir, &["new", "my scenes/a.b"]);
    assert_eq!(output.status.code(), Some(1));
    success(dir, &["new", "v1.5", "--from", "torus"]);
    assert_eq!(names(dir), ["my scenes", "v1.5.scn"]);
}

#[test]
fn new_overwrites_nothing() {
    let dir = directory(&[("ball.scn", "mine")]);
    let dir = dir.path();
    let cases: [(&[&str], i32, &str); 6] = [
        (&["ball"], 1, "ball.scn is there already"),
        (&["ball.scn", "--from", "csg"], 1, "is there already"),
        (&["no/ball"], 1, "cannot write no/ball.scn"),
        (&["x", "--from", "glas"], 2, "glass"),
        (&["x", "--from", "nothing"], 2, "torus-original"),
        (&["no/.scn"], 2, "names no file"),
    ];
    for (args, status, part) in cases {
        let output = slowlight(dir, &[&["new"], args].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{args:?}: {said}");
        assert!(said.contains(part), "{args:?}: {said}");
        assert_eq!(names(dir), ["ball.scn"], "{args:?}");
    }
    assert_eq!(read(&dir.join("ball.scn")), "mine");
}
