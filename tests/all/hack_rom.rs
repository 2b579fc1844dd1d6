//! Scenes that ship, from the ROM of the Hack's processor: the same pictures as on
//! the VM with its own operating system, and on it with ours.

use crate::cli::{directory, json, success};
use std::path::{Path, PathBuf};

fn example(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join("examples").join(format!("{name}.scn"))
}

/// Runs an example on all three; answers cycles a VM command and words of ROM.
fn same(name: &str, options: &[&str]) -> (f64, u64) {
    let path = example(name);
    scene_is_the_same(
        path.to_str().expect("a path"),
        directory(&[]).path(),
        options,
    )
}

/// The same of any scene.
fn scene_is_the_same(scene: &str, dir: &Path, options: &[&str]) -> (f64, u64) {
    let run = |more: &[&str]| {
        let args = ["run", scene, "-t", "jack", "--json"];
        json(dir, &[&args[..], options, more].concat())
    };
    let native = run(&[]);
    let rom = run(&["--os", "jack"]);
    assert_eq!(rom["differs_from_model"], 0, "{scene} {options:?}");
    for key in ["inks_sha256", "differs_from_native", "rmse"] {
        assert_eq!(rom[key], native[key], "{scene} {options:?}: {key}");
    }
    // On the VM with our system, the whole screen.
    let build = ["build", scene, "-t", "jack", "--os", "jack", "-o", "out"];
    success(dir, &[&build[..], options].concat());
    let screen = |args: &[&str]| json(dir, &[args, &["--json"]].concat());
    let vm = screen(&["vm", "jack", "out"]);
    assert_eq!(vm["stopped"], "ended");
    let cpu = screen(&["vm", "hack", "out/Main.hack"]);
    assert_eq!(cpu["inks_sha256"], vm["inks_sha256"], "{scene} {options:?}");
    assert_eq!(cpu["cycles"], rom["cycles"]);
    let number = |key: &str| rom[key].as_u64().expect("a number");
    let share = number("cycles") as f64 / number("vm_instructions") as f64;
    (share, number("rom_words"))
}

#[test]
fn a_torus_in_floats() {
    let floats = |options: &[&str]| same("torus", &[options, &["--format", "f316"]].concat());
    let (share, words) = floats(&["--rows", "150..151", "--freeze", "all"]);
    assert!(share < 2.5 && words < 20_000, "{share} {words}");
    let (share, words) = floats(&["--rows", "90", "--set", "eye=0.5,1.75,3.5"]);
    assert!(share < 2.5 && words < 24_000, "{share} {words}");
}

#[test]
fn a_torus_in_logarithms() {
    for rows in ["90..93", "200"] {
        let options = ["--rows", rows, "--freeze", "all", "--format", "log10"];
        let (share, words) = same("torus", &options);
        assert!(share < 2.0 && words < 20_000, "{share} {words}");
    }
}

#[test]
fn a_torus_in_fixed_point() {
    let options = ["--rows", "90..91", "--freeze", "all", "--format", "fixed16"];
    let (share, words) = same("torus", &options);
    assert!(share < 2.0 && words < 20_000, "{share} {words}");
}

#[test]
fn powers_logarithms_and_arcs_in_fixed_point() {
    let source = "image 64 x 12 inks black, white; param k: real = 0.7 in 0 .. 2;
        draw (x, y) = {
          let far = exp(-y / 4) * log(1 + x / 9) * (1 + x) ^ (-k);
          let angle = tan(x / 50 * 1rad) + (asin(x / 64) - acos(y / 12)) / 1rad;
          threshold(far * angle + atan2(y - 6, x - 30) / 4rad, bayer(4)[x mod 4, y mod 4])
        };";
    let dir = directory(&[("all.scn", source)]);
    let (share, words) = scene_is_the_same("all.scn", dir.path(), &["--format", "fixed16"]);
    assert!(share < 2.5 && words < 20_000, "{share} {words}");
}

#[test]
fn a_maze_and_what_diffuses_errors() {
    same("maze", &["--rows", "10..14"]);
    same("primitives", &["--rows", "0..3"]);
    for (name, rows) in [
        ("mirrors", "120..123"),
        ("maze", "10..14"),
        ("primitives", "0..3"),
    ] {
        same(name, &["--rows", rows, "--format", "log10"]);
    }
    same("mirrors", &["--rows", "120..123", "--format", "fixed16"]);
}

/// Words of the screen are written whole; pictures begin and end within them, too.
#[test]
fn pictures_that_begin_within_a_word() {
    let places = [
        (33, 5),
        (1, 3),
        (16, 2),
        (482, 4),
        (31, 256),
        (520, 3),
        (30, 260),
        // Far below the screen's first row there are none to draw.
        (16, 4096),
    ];
    for (width, height) in places {
        let source = format!(
            "image {width} x {height} inks black, white;
             draw (x, y) = ink((x * 5 + y * 3) mod 7 mod 2);"
        );
        let dir = directory(&[("dots.scn", &source)]);
        let run = |more: &[&str]| {
            let middle = format!("{}..{}", height / 2 - 1, height / 2);
            let rows = if height > 256 {
                middle
            } else {
                format!("0..{}", height - 1)
            };
            let args = ["run", "dots.scn", "-t", "jack", "--json", "--rows", &rows];
            json(dir.path(), &[&args[..], more].concat())
        };
        let rom = run(&["--os", "jack"]);
        assert_eq!(rom["differs_from_native"], 0, "{width} x {height}");
        assert_eq!(rom["inks_sha256"], run(&[])["inks_sha256"]);
        let build = [
            "build", "dots.scn", "-t", "jack", "--os", "jack", "-o", "out",
        ];
        success(dir.path(), &build);
        let code = std::fs::read_dir(dir.path().join("out")).expect("a directory");
        let code = code.filter_map(|file| std::fs::read_to_string(file.ok()?.path()).ok());
        assert!(!code.collect::<String>().contains("Screen.drawPixel"));
    }
}

#[test]
fn what_is_read_later_keeps_its_variable_where_these_are_scarce() {
    // A channel's level is a minimum of what its variable has, written where it is read.
    same("colours", &["--rows", "40", "--format", "log10"]);
    same("colours", &["--rows", "41", "--format", "f316"]);
}
