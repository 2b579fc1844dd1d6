//! Scenes that move: walks by a script, on the machine against the model, natively into films;
//! what is refused.

use crate::cli::{directory, json, slowlight, success};
use slowlight::draw::Window;
use slowlight::moving::hands::Hands;
use slowlight::moving::walk::{next, set, states, walk};
use slowlight::scene::{Changes, Precision, Scene};
use slowlight_compiler::ir::graph::Graph;
use std::path::{Path, PathBuf};

/// Formats of the targets that move, each by its own way of holding reals.
const FORMATS: [(&str, &str); 9] = [
    ("jack", "fixed16"),
    ("jack", "log10"),
    ("jack", "f316"),
    ("jack", "f416"),
    ("6502:plain", "fixed16"),
    ("6502:plain", "fixed24"),
    ("6502:plain", "fixed16.16"),
    ("6502:plain", "log10"),
    ("6502:plain", "real40"),
];

/// States that change places, that nothing reads but others, of every type.
const ODD: &str = "image 16 x 16 inks black, white;
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
    let count = pictures.to_string();
    let args = [
        "run",
        scene,
        "-t",
        target,
        "--format",
        format,
        "--pictures",
        &count,
        "--keys",
        "up*4 right*3 fire left*2 wait 1 down",
        "--json",
    ];
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
    let dir = directory(&[("odd.scn", ODD)]);
    let dir = dir.path();
    for target in ["bbc:micro", "6502:bbc", "6502:c64"] {
        let output = slowlight(dir, &["build", "odd.scn", "-t", target, "-o", "out"]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{target}: {said}");
        assert!(said.contains("the scene moves"), "{target}: {said}");
        assert!(said.contains("jack"), "{target}: {said}");
        assert!(!dir.join("out").exists());
        // Its first picture is as any.
        success(
            dir,
            &["build", "odd.scn", "-t", target, "--still", "-o", "still"],
        );
        let run = json(dir, &["run", "odd.scn", "-t", target, "--json"]);
        assert_eq!(run["differs_from_model"], 0, "{target}");
    }
    let run = ["run", "odd.scn", "-t", "jack", "--pictures", "2"];
    for more in ["--no-plot", "--os=jack", "--refine=2"] {
        let output = slowlight(dir, &[&run[..], &[more]].concat());
        assert!(matches!(output.status.code(), Some(1 | 2)), "{more}");
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
        let film = ["--pictures", "5", "--keys", "wait 2 fire", "--json"];
        let native = json(dir.path(), &[&["render", "own.scn"], &film[..]].concat());
        for target in ["jack", "6502:plain"] {
            let run = ["run", "own.scn", "--outlined", "-t", target];
            let found = json(dir.path(), &[&run, &film[..]].concat());
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
