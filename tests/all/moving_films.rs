//! Scenes that move, natively into films; what is said of them, and what is refused.

use crate::cli::{directory, json, slowlight, success};
use crate::moving::ODD;

#[test]
fn films_have_every_picture() {
    let dir = directory(&[("odd.scn", ODD)]);
    let dir = dir.path();
    let film = |name: &str, more: &[&str]| {
        let args = ["render", "odd.scn", "--pictures", "7", "-o", name];
        success(dir, &[&args[..], more].concat())
    };
    assert!(film("walk.gif", &["--keys", "right*3"]).contains("7 pictures"));
    film("walk.png", &["--fps", "10"]);
    let gif = std::fs::File::open(dir.join("walk.gif")).expect("a film");
    let mut gif = gif::DecodeOptions::new().read_info(gif).expect("a GIF");
    let mut frames = 0;
    while gif.read_next_frame().expect("a frame").is_some() {
        frames += 1;
    }
    assert_eq!(frames, 7);
    let args = [
        "render",
        "odd.scn",
        "--pictures",
        "7",
        "--json",
        "--keys",
        "right*3",
    ];
    let told = json(dir, &args);
    assert_eq!(told["pictures"][4]["states"]["c"], 3.0);
    // The first picture is the still one.
    let still = json(dir, &["render", "odd.scn", "--json"]);
    assert_eq!(still["inks_sha256"], told["pictures"][0]["inks_sha256"]);
    // The machine's film, of what its states were.
    let run = [
        "run",
        "odd.scn",
        "-t",
        "jack",
        "--pictures",
        "3",
        "-o",
        "machine.gif",
        "--format",
        "f316",
    ];
    let said = success(dir, &run);
    assert!(said.contains("states unlike the model's"), "{said}");
    assert!(dir.join("machine.gif").exists());
}

#[test]
fn a_param_goes_from_value_to_value() {
    let text = "image 8 x 1 inks black, white;
        param at: vec2 = (1, 0) in (0, 0) .. (7, 0);
        draw (x, y) = ink(if x == round(at.x) then 1 else 0);";
    let dir = directory(&[("at.scn", text)]);
    let dir = dir.path();
    let args = [
        "render",
        "at.scn",
        "--pictures",
        "8",
        "--json",
        "--set",
        "at=0,0..7,0",
    ];
    let film = json(dir, &args);
    for at in [0, 3, 7] {
        let set = format!("at={at},0");
        let still = json(dir, &["render", "at.scn", "--json", "--set", &set]);
        let digest = &film["pictures"][at]["inks_sha256"];
        assert_eq!(*digest, still["inks_sha256"], "{at}");
    }
    let fails = |args: &[&str], part: &str| {
        let output = slowlight(dir, &[&["render", "at.scn"], args].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {said}");
        assert!(said.contains(part), "{args:?}: {said}");
    };
    fails(&["--set", "at=0,0..7,0"], "over how many pictures?");
    fails(&["--pictures", "2", "--json"], "nothing moves");
    let out = ["--pictures", "2", "-o", "a.gif"];
    let with = |more: &[&'static str]| [&out[..], more].concat();
    fails(&with(&["--set", "at=0,0..8,0"]), "outside its range");
    fails(&with(&["--set", "at=0,0.."]), "first..last");
    fails(&with(&["--set", "at=0,0..7,0", "--freeze", "at"]), "folded");
    fails(&["--pictures", "2", "--set", "at=0,0..7,0"], "where to?");
    fails(&["--pictures", "2", "-o", "a.pgm"], "no film's name");
    fails(&with(&["--keys", "sideways"]), "nothing a player holds");
    assert!(!dir.join("a.gif").exists());
}

#[test]
fn what_cannot_move_yet_says_so() {
    let spread = "image 16 x 16 inks black, white;
        state a: int = 3 in 0 .. 15 -> a + 1;
        draw (x, y) = floyd((x + a) / 30, x, y);";
    let dir = directory(&[("odd.scn", ODD), ("spread.scn", spread)]);
    let dir = dir.path();
    for target in ["jack", "bbc:micro", "6502:bbc", "6502:c64"] {
        let output = slowlight(dir, &["build", "spread.scn", "-t", target, "-o", "out"]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{target}: {said}");
        assert!(said.contains("the scene moves"), "{target}: {said}");
        assert!(!dir.join("out").exists());
        // The first picture is as any.
        for scene in ["odd.scn", "spread.scn"] {
            success(
                dir,
                &["build", scene, "-t", target, "--still", "-o", "still"],
            );
            let run = json(dir, &["run", scene, "-t", target, "--json"]);
            assert_eq!(run["differs_from_model"], 0, "{target}");
        }
    }
    let run = ["run", "odd.scn", "-t", "jack", "--pictures", "2"];
    for more in ["--no-plot", "--os=jack", "--refine=2"] {
        let output = slowlight(dir, &[&run[..], &[more]].concat());
        assert!(matches!(output.status.code(), Some(1 | 2)), "{more}");
    }
}

/// What is said of pictures, states and keys is in their words.
#[test]
fn what_is_said_is_of_states() {
    let text = "image 8 x 4 inks black, white;
        state on: bool = true -> not on;
        state turn: angle = 45deg in 0deg .. 90deg -> turn + 1deg;
        draw (x, y) = ink(if on and turn > 50deg then 1 else 0);";
    let dir = directory(&[("s.scn", text), ("odd.scn", ODD)]);
    let dir = dir.path();
    let fails = |args: &[&str], part: &str| {
        let output = slowlight(dir, args);
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(
            matches!(output.status.code(), Some(1 | 2)),
            "{args:?}: {said}"
        );
        assert!(said.contains(part), "{args:?}: {said}");
    };
    fails(&["render", "s.scn", "--set", "q=1"], "no state `q`");
    fails(&["render", "s.scn", "--freeze", "q"], "no state `q`");
    fails(
        &["render", "s.scn", "--set", "turn=100deg"],
        "`turn` is 100deg, outside its range 0deg .. 90deg",
    );
    let run = ["run", "s.scn", "-t", "jack", "--pictures"];
    let render = ["render", "s.scn", "-o", "a.gif", "--pictures"];
    let with = |args: &[&'static str], more: &[&'static str]| [args, more].concat();
    fails(
        &with(&run, &["2", "--keys", "up"]),
        "no state of this scene asks",
    );
    fails(
        &with(&render, &["2", "--keys", "up"]),
        "no state of this scene asks",
    );
    fails(&with(&run, &["1001"]), "followed for 1,000 at most");
    fails(&with(&render, &["10001"]), "a film has 10,000 at most");
    let said = success(dir, &with(&render, &["1"]));
    assert!(said.contains("1 picture of"), "{said}");
    let said = success(dir, &with(&run, &["3"]));
    let found = said.lines().find(|line| line.starts_with("turn at last"));
    assert!(found.is_some_and(|line| line.ends_with("deg")), "{said}");
    assert!(
        said.contains("ints and bools unlike the native step's"),
        "{said}"
    );
}
