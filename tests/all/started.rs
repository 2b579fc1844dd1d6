//! What a picture of very few pixels takes is foreseen: most of that is getting ready.

use crate::cli::directory;
use slowlight::estimate;
use slowlight::scene::{Changes, Scene};
use slowlight::target_args::ScreenArgs;
use slowlight::trial;
use slowlight_compiler::targets::{TARGETS, formats};
use slowlight_routine::Format;

/// Tables of the scene's, of a dither's, and of the runtimes'; params that are divided.
const SCENES: [(&str, &str); 5] = [
    (
        "ramp",
        "image 2 x 2 inks black, white;
draw (x, y) = threshold(0.1 + x / 2.5, bayer(8)[x mod 8, y mod 8]);\n",
    ),
    (
        "one",
        "image 1 x 1 inks black, white;
param a: real = 1.3 in 1 .. 2;
draw (x, y) = threshold(a * a + sqrt(a + x) / (a + y) - a, 0.5);\n",
    ),
    (
        "dials",
        "image 3 x 2 inks black, white;
param a: real = 0.35 in 0 .. 1;
param b: vec2 = (0.25, 1.5) in (0, 0) .. (3, 3);
draw (x, y) = if a * x + b.x < b.y then ink(1) else ink(0);\n",
    ),
    (
        "waves",
        "image 2 x 2 inks black, white;
param phase: real = 0.5 in 0 .. 3;
draw (x, y) = if sin((x * 0.3 + phase) * 1rad) < sqrt(y + 0.25) then ink(1) else ink(0);\n",
    ),
    (
        "cells",
        "image 3 x 2 inks black, white;
map cells {
  \"##..##..#..#.#.##..##\" \"#..#..#.#.#.#.#.#..##\" \"#.##.#.#.#.#.#.##...#\" \"#...#..##.##..#...###\"
  \"#.#.##..#..#.#.##..##\" \"#..#..###.#.#.#.#..##\" \"#.##.#.#.#.###.##...#\" \"#...#..##.##..#...###\"
} where '#' => 1, '.' => 0;
draw (x, y) = ink(cells[x * 7, y * 5]);\n",
    ),
];

/// Routines' costs are means over their arguments, and nothing is said of drawing.
const FACTOR: f64 = 1.8;

#[test]
fn few_pixels_take_what_is_foreseen() {
    let scenes = SCENES.map(|(name, text)| (format!("{name}.scn"), text));
    let files: Vec<(&str, &str)> = scenes.iter().map(|(n, t)| (n.as_str(), *t)).collect();
    let dir = directory(&files);
    let mut wrong = Vec::new();
    for (name, _) in files {
        let scene = Scene::open(&dir.path().join(name), &Changes::default())
            .unwrap_or_else(|e| panic!("{name}: {}", e.reason()));
        for target in TARGETS {
            for target in formats(target) {
                let screen = ScreenArgs::default();
                let plan = match screen.plan(&scene, target, &[]) {
                    Ok(plan) => plan,
                    // Tables of logarithms leave a BBC Micro little.
                    Err(said) => {
                        let log = matches!(target.runtime.real, Format::Log { .. });
                        let large = said.reason().contains("does not fit");
                        let known = log && large && target.name == "6502:bbc";
                        assert!(known, "{}", said.reason());
                        continue;
                    }
                };
                let mut loaded = trial::build(&plan).expect("a program").loaded;
                let run = loaded.run(trial::LIMIT, &mut |_| {}).expect("it runs");
                let (foreseen, took) = (estimate::cycles(&plan), run.cycles as f64);
                let ratio = foreseen / took;
                let format = target.runtime.format;
                println!(
                    "{name} {} {format}: {foreseen} of {took}, {ratio:.2}",
                    target.name
                );
                if !(1.0 / FACTOR..FACTOR).contains(&ratio) {
                    wrong.push((name, target.name, format, foreseen, took));
                }
            }
        }
    }
    assert_eq!(wrong, []);
}
