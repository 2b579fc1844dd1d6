//! Scenes that move: walks by a script, on the machine against the model.

use crate::cli::{directory, json, success};
use slowlight::draw::Window;
use slowlight::moving::hands::Hands;
use slowlight::moving::walk::{next, set, states, walk};
use slowlight::scene::{Changes, Precision, Scene};
use slowlight_compiler::ir::graph::Graph;
use std::path::{Path, PathBuf};

/// Formats of the targets, each by its own way of holding reals.
const FORMATS: [(&str, &str); 16] = [
    ("jack", "fixed16"),
    ("jack", "log10"),
    ("jack", "f316"),
    ("jack", "f416"),
    ("6502:plain", "fixed16"),
    ("6502:plain", "fixed24"),
    ("6502:plain", "fixed16.16"),
    ("6502:plain", "log10"),
    ("6502:plain", "real40"),
    ("6502:c64", "fixed16"),
    ("6502:c64", "real40"),
    ("6502:bbc", "fixed16"),
    ("6502:bbc", "log10"),
    ("bbc:micro", "real40"),
    ("bbc:agon", "real40"),
    ("bbc:basicv", "real40"),
];

/// States that change places, that nothing reads but others, of every type.
pub const ODD: &str = "image 16 x 16 inks black, white;
state a: int = 3 in 0 .. 15 -> b;
state b: int = 5 in 0 .. 15 -> a;
state c: int = 0 in 0 .. 15 -> c + input.x;
state hit: bool = false -> input.fire == 1;
state was: bool = false -> hit;
state r: real = 0.5 in -4 .. 15 -> s;
state s: real = 2 in -4 .. 15 -> r;
state t: real = 0 in 0 .. 3 -> t + 0.375;
state v: vec2 = (1, 2) in (0, 0) .. (4, 4) -> (v.y, t - 1);
draw (x, y) = ink(
  if x == a and y == b or x == c or was and x == y or y < s - r and x > v.x + v.y then 1
  else if (x + picture) mod 4 == 0 and y == 9 then 1 else 0);
";

fn example(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join("examples/moving").join(format!("{name}.scn"))
}

/// Holds a walk on the machine against the model.
fn held(
    dir: &Path,
    scene: &str,
    (target, format): (&str, &str),
    pictures: usize,
) -> serde_json::Value {
    held_with(dir, scene, (target, format), pictures, &[])
}

fn held_with(
    dir: &Path,
    scene: &str,
    (target, format): (&str, &str),
    pictures: usize,
    more: &[&str],
) -> serde_json::Value {
    let count = pictures.to_string();
    let mut args = vec![
        "run",
        scene,
        "-t",
        target,
        "--format",
        format,
        "--pictures",
        &count,
        "--json",
    ];
    args.extend(more);
    let text = std::fs::read_to_string(dir.join(scene)).expect("a scene");
    if text.contains("input.") {
        args.extend(["--keys", "up*4 right*3 fire left*2 wait 1 down"]);
    }
    let found = json(dir, &args);
    assert_eq!(found["differs_from_model"], 0, "{scene} {target} {format}");
    assert_eq!(found["states_differ"], 0, "{scene} {target} {format}");
    let all = found["pictures"].as_array().expect("pictures");
    assert_eq!(all.len(), pictures, "{scene} {target} {format}");
    found
}

#[test]
fn machine_and_model_walk_alike() {
    let dir = directory(&[("odd.scn", ODD)]);
    let dir = dir.path();
    for format in FORMATS {
        let found = held(dir, "odd.scn", format, 14);
        let states = |at: usize| found["pictures"][at]["states"].clone();
        for (at, a, b, picture) in [(0, 3, 5, 0), (1, 5, 3, 1), (12, 3, 5, 12)] {
            let states = states(at);
            assert_eq!(states["a"], f64::from(a), "{format:?} {at}");
            assert_eq!(states["b"], f64::from(b), "{format:?} {at}");
            assert_eq!(states["picture"], f64::from(picture), "{format:?} {at}");
        }
        // Three to the right, two to the left again and no further than its range.
        assert_eq!(states(8)["c"], 3.0, "{format:?}");
        assert_eq!(states(13)["c"], 1.0, "{format:?}");
        // Held after picture 9; a state that another is given is one picture behind it.
        let hit: Vec<bool> = (9..13).map(|at| states(at)["hit"] == 1.0).collect();
        let was: Vec<bool> = (9..13).map(|at| states(at)["was"] == 1.0).collect();
        assert_eq!(hit, [false, true, false, false], "{format:?}");
        assert_eq!(was, [false, false, true, false], "{format:?}");
        // No further than its range, whose end is not exact in every format.
        let t = states(13)["t"].as_f64().expect("a number");
        assert!((t - 3.0).abs() < 0.01, "{format:?}: {t}");
    }
}

/// Enough pictures that a program which took memory for each would run out of it.
#[test]
fn the_examples_walk_on_the_machine_as_in_the_model() {
    let dir = directory(&[]);
    for (name, format, pictures) in [
        ("walk", ("jack", "fixed16"), 60),
        ("walk", ("jack", "f316"), 8),
        ("walk", ("6502:plain", "fixed16"), 20),
        ("bounce", ("jack", "log10"), 5),
        ("bounce", ("6502:plain", "fixed24"), 5),
        ("plasma", ("jack", "f316"), 4),
        ("plasma", ("6502:plain", "fixed16"), 4),
        ("walk", ("6502:c64", "fixed16"), 12),
        ("walk", ("6502:bbc", "fixed16"), 12),
        ("walk", ("bbc:micro", "real40"), 6),
        ("bounce", ("6502:c64", "fixed16"), 4),
        ("bounce", ("6502:bbc", "fixed24"), 4),
        ("plasma", ("6502:bbc", "fixed16"), 3),
        ("plasma", ("bbc:micro", "real40"), 2),
    ] {
        let path = example(name);
        held(dir.path(), &path.to_string_lossy(), format, pictures);
    }
}

#[test]
fn no_memory_is_taken_from_picture_to_picture() {
    let text = "image 200 x 2 inks black, white;
        draw (x, y) = { column let a = sin(x * 9deg + picture * 3deg);
          if a + y * sin(x * 2deg) > 0.5 then ink(1) else ink(0) };";
    let dir = directory(&[("wide.scn", text)]);
    for format in FORMATS.into_iter().filter(|(target, _)| *target == "jack") {
        held(dir.path(), "wide.scn", format, 80);
    }
}

/// Programs in BASIC put pixels into memory byte by byte, in passes, or plot them; what is ink 0
/// in one picture and was not in the one before is seen in each. In few words and for reading
/// they are written otherwise.
#[test]
fn basic_moves_however_it_draws() {
    let scene = |width: u32| {
        format!(
            "image {width} x 12 inks black, red, white;
             state at: int = 0 in 0 .. 40 -> (at + 3) mod 12;
             state other: int = 5 in 0 .. 40 -> at + 1;
             state third: real = 1 in 0 .. 40 -> other + third / 4;
             draw (x, y) = {{ column let a = sin(x * 9deg) * 4;
               if y == at or x == other then ink(2)
               else threshold(0.5 + (a - y + third) / 20, bayer(4)[x mod 4, y mod 4]) }};"
        )
    };
    let dir = directory(&[("whole.scn", &scene(16)), ("odd.scn", &scene(13))]);
    let dir = dir.path();
    for name in ["whole.scn", "odd.scn"] {
        for (target, more) in [
            ("bbc:micro", &[][..]),
            ("bbc:micro", &["--thrift", "6"]),
            ("bbc:micro", &["--style", "listing"]),
            ("bbc:micro", &["--outlined"]),
            ("bbc:micro", &["--block", "2"]),
            ("bbc:agon", &[]),
            ("bbc:basicv", &[]),
            ("6502:bbc", &[]),
            ("6502:bbc", &["--block", "2x2"]),
            ("6502:c64", &[]),
            ("6502:c64", &["--mode", "hires", "--block", "2"]),
        ] {
            let format = if target.starts_with("bbc") {
                "real40"
            } else {
                "fixed16"
            };
            // Blocks are whole.
            if name == "whole.scn" || !more.contains(&"--block") {
                held_with(dir, name, (target, format), 5, more);
            }
        }
    }
}

fn graph(path: &Path) -> Graph {
    let scene = Scene::open(path, &Changes::default());
    let scene = scene.unwrap_or_else(|e| panic!("{}", e.reason()));
    let graph = scene.moving().graph(None, Precision::NATIVE);
    graph.unwrap_or_else(|e| panic!("{}", e.reason()))
}

/// The maze of a scene, row by row.
fn maze(text: &str) -> Vec<Vec<u8>> {
    let rows = text.split('"').skip(1).step_by(2);
    rows.filter(|row| row.len() == 16)
        .map(|row| row.as_bytes().to_vec())
        .collect()
}

#[test]
fn nobody_walks_through_a_wall() {
    let path = example("walk");
    let maze = maze(&std::fs::read_to_string(&path).expect("the example"));
    assert_eq!(maze.len(), 16);
    let mut graph = graph(&path);
    let mut seed = 12345u32;
    let mut seen = std::collections::BTreeSet::new();
    for _ in 0..4000 {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let script = ["up*9", "up*5", "down", "left", "right", "wait 1"];
        let held = Hands::of(script[(seed >> 24) as usize % script.len()]).expect("a script");
        held.give(0, &mut graph);
        let values = next(&graph);
        set(&mut graph, &values);
        let found = states(&graph);
        let of = |name: &str| found.iter().find(|(n, _)| n == name).expect("a state").1;
        let (x, y) = (of("place.x"), of("place.y"));
        assert_eq!(maze[y as usize][x as usize], b'.', "{x} {y}");
        seen.insert((x as usize, y as usize));
    }
    assert!(seen.len() > 20, "{}", seen.len());
}

/// Along a wall: the part of a step that it lets be is taken.
#[test]
fn one_slides_along_a_wall() {
    let path = example("walk");
    let hands = Hands::of("up*40").expect("a script");
    let steps = walk(&graph(&path), Window::whole(1, 1), 41, &hands, &[]);
    let steps = steps.unwrap_or_else(|e| panic!("{}", e.reason()));
    let places: Vec<(f64, f64)> = (steps.iter())
        .map(|step| (step.states[0].1, step.states[1].1))
        .collect();
    let slid = places.windows(2).any(|pair| {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        (x0 == x1) != (y0 == y1)
    });
    assert!(slid, "{places:?}");
}

/// A small picture is drawn on one of two screens of a BBC Micro, a large one on the only one; what
/// is shown is right on both.
#[test]
fn small_pictures_turn_between_two_screens() {
    let scene = |width: u32, height: u32| {
        format!(
            "image {width} x {height} inks black, white;
             state at: int = 0 in 0 .. 40 -> at + 3;
             draw (x, y) = ink(if x == at or y == at then 1 else 0);"
        )
    };
    let dir = directory(&[
        ("small.scn", &scene(60, 40)),
        ("large.scn", &scene(200, 160)),
    ]);
    let dir = dir.path();
    for (name, turns) in [("small", true), ("large", false)] {
        let file = format!("{name}.scn");
        let args = ["build", &file, "-t", "6502:bbc", "--format", "fixed16"];
        success(dir, &[&args[..], &["-o", name]].concat());
        let text = std::fs::read_to_string(dir.join(name).join(format!("{name}.asm")));
        let text = text.expect("a program");
        assert_eq!(text.contains("hidden"), turns, "{name}");
        held(dir, &file, ("6502:bbc", "fixed16"), 4);
        // Of its first picture alone there is one screen.
        success(dir, &[&args[..], &["--still", "-o", "still"]].concat());
        let still = std::fs::read_to_string(dir.join("still").join(format!("{name}.asm")));
        assert!(!still.expect("a program").contains("hidden"), "{name}");
    }
}

/// A program's own labels are no names of params.
#[test]
fn names_of_states_are_nobody_else_s() {
    let text = "image 8 x 8 inks black, white;
        state screen_shape: int = 1 in 0 .. 9 -> screen_shape + 1;
        state colour: int = 2 in 0 .. 9 -> set_up;
        state set_up: int = 3 in 0 .. 9 -> clear_byte;
        state clear_byte: int = 4 in 0 .. 9 -> colour;
        state next_picture: int = 0 in 0 .. 9 -> colour - screen_shape + hands_port;
        state hands_port: int = 0 in 0 .. 9 -> input.fire;
        draw (x, y) = ink((x + screen_shape * colour + y * next_picture + set_up) mod 2);";
    let dir = directory(&[("s.scn", text)]);
    for target in ["jack", "6502:plain", "6502:bbc", "6502:c64"] {
        let found = held(dir.path(), "s.scn", (target, "fixed16"), 5);
        assert_eq!(found["steps_differ_from_native"], 0, "{target}");
    }
    held(dir.path(), "s.scn", ("bbc:micro", "real40"), 5);
}

/// A state that nothing reads is what it is all the same.
#[test]
fn states_that_nothing_reads_are_told() {
    let text = "image 8 x 4 inks black, white;
        state a: int = 3 in 0 .. 9 -> a + 1;
        state t: real = 1.5 in 0 .. 9 -> 5;
        state v: real = 1.5 in 0 .. 9 -> 2.5 + a;
        draw (x, y) = ink(0);";
    let dir = directory(&[("s.scn", text)]);
    for format in FORMATS {
        let found = held(dir.path(), "s.scn", format, 3);
        for (at, name, should) in [(0, "t", 1.5), (1, "t", 5.0), (2, "v", 6.5)] {
            let is = found["pictures"][at]["states"][name].as_f64();
            let is = is.expect("a number");
            assert!((is - should).abs() < 0.01, "{format:?} {name}: {is}");
        }
    }
}

/// Natively a scene's states are its own: a step that plan, model and machine had all lost would
/// look right to `run`. Parts do not become subroutines either, whatever is asked for.
#[test]
fn states_go_on_as_they_do_natively() {
    let dir = directory(&[]);
    let scenes = [
        // A loop that ends by a state, and whose results the ink is made of.
        "state n: int = 1 in 1 .. 12 -> n + 1;
         draw (x, y) = threshold(loop (a = 0.0, b = 0) max 20 {
           if b < n then next(a + x * 0.02, b + 1) else a } else 0, bayer(2)[x mod 2, y mod 2]);",
        // A bool that chooses between reals of other sizes.
        "state s: bool = true -> floor(if s then 0.50 else 2.51) < input.fire;
         draw (x, y) = if s then ink(x mod 2) else ink(y mod 2);",
        // Bytes of an int that nothing reads.
        "state b: int = 1 in -100 .. 100 -> -b;
         draw (x, y) = if b < 0 then ink(x mod 2) else ink(y mod 2);",
        // A port's name.
        "state held_port: int = 0 in 0 .. 9 -> held_port + 1; draw (x, y) = ink((x + held_port) mod 2);",
        "state z: real = 3 in 1 .. 5 -> 8 - z; draw (x, y) = threshold(z / 6 + x / 100, 0.5);",
    ];
    for scene in scenes {
        let text = format!("image 8 x 6 inks black, white; {scene}");
        std::fs::write(dir.path().join("own.scn"), text).expect("a file");
        let mut film = vec!["--pictures", "5", "--json"];
        if scene.contains("input.") {
            film.extend(["--keys", "wait 2 fire"]);
        }
        let native = json(dir.path(), &[&["render", "own.scn"], &film[..]].concat());
        let targets = ["jack", "6502:plain", "6502:c64", "6502:bbc", "bbc:micro"];
        let usual = targets.map(|target| (target, "--outlined"));
        // No pixel says how many digits a state needs.
        for (target, option) in usual
            .into_iter()
            .chain([("6502:plain", "--format=fixed20")])
        {
            let run = ["run", "own.scn", option, "-t", target];
            let found = json(dir.path(), &[&run, &film[..]].concat());
            assert_eq!(found["steps_differ_from_native"], 0, "{target} {scene}");
            for k in 0..5 {
                let [is, should] = [&found, &native].map(|film| &film["pictures"][k]["states"]);
                let all = should.as_object().expect("states");
                assert!(!all.is_empty());
                for (name, value) in all {
                    let [is, should] = [&is[name], value].map(|v| v.as_f64().expect("a number"));
                    let near = (is - should).abs() <= 0.01 * should.abs();
                    assert!(near, "{target} {name} {k}: {is}, not {should}\n{scene}");
                }
            }
        }
    }
}

/// What moves is nothing to a scene that does not: its programs stay the same to the byte.
#[test]
fn a_scene_without_states_has_the_programs_that_it_had() {
    let text = "image 16 x 8 inks black, white;
        param at: real = 3 in 0 .. 7;
        draw (x, y) = ink(if x * x + y > at * at then 1 else 0);";
    let dir = directory(&[("still.scn", text)]);
    let dir = dir.path();
    for (target, file) in [
        ("jack", "Still.jack"),
        ("bbc:micro", "still.bas"),
        ("6502:plain", "still.asm"),
    ] {
        let built = |out: &str, more: &[&str]| {
            let args = ["build", "still.scn", "-t", target, "-o", out];
            success(dir, &[&args[..], more].concat());
            std::fs::read(dir.join(out).join(file)).expect("a program")
        };
        assert_eq!(built("a", &[]), built("b", &["--still"]), "{target}");
    }
}
