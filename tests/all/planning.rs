//! Scenes at random, with deep nests, long loops and many objects, planned for machines within
//! the work that a search may do, which is counted, not timed.
//!
//! Small ones run with the other tests. As many as are wanted, of all sizes, are written into a
//! folder for `benches/planning`, which says how long they take (docs/planning.md).

use crate::ramps::random::Random;
use rayon::prelude::*;
use slowlight::fit::FIT;
use slowlight::need::about;
use slowlight::scene::{Scene, SceneArgs};
use slowlight::target_args::ScreenArgs;
use slowlight_compiler::fuel::Fuel;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{TARGETS, find};
use std::cell::Cell;
use std::fmt::Write;
use std::path::Path;

/// A number from `-most` to `most`, with two decimals.
fn number(random: &mut Random, most: u64) -> f64 {
    (random.below(200 * most + 1) as f64 - 100.0 * most as f64) / 100.0
}

fn point(random: &mut Random, most: u64) -> String {
    let [x, y, z] = [(); 3].map(|()| number(random, most));
    format!("({x}, {y}, {z})")
}

fn solid(random: &mut Random) -> String {
    let at = point(random, 4);
    let size = 0.2 + random.below(80) as f64 / 100.0;
    match random.below(4) {
        0 => format!("cylinder({at}, (0, 1, 0), {size})"),
        1 => {
            let [x, y, z] = [(); 3].map(|()| number(random, 3));
            format!(
                "box(({x}, {y}, {z}), ({:.2}, {:.2}, {:.2}))",
                x + size,
                y + 0.5,
                z + size
            )
        }
        _ => format!("sphere({at}, {size})"),
    }
}

/// Solids put together, so many.
fn joined(random: &mut Random, count: u64) -> String {
    if count <= 1 {
        return solid(random);
    }
    // Now a chain, now a tree.
    let left = match random.below(2) {
        0 => 1,
        _ => count / 2,
    };
    let (a, b) = (joined(random, count - left), joined(random, left));
    let how = ["union", "difference", "intersection"];
    format!("{}({a}, {b})", how[random.below(3) as usize])
}

/// A number of the pixel, nested so deep.
fn nested(random: &mut Random, deep: u64) -> String {
    if deep == 0 {
        return ["x", "y", "0.5", "(x + y)"][random.below(4) as usize].to_owned();
    }
    let inner = nested(random, deep - 1);
    let k = number(random, 9);
    match random.below(6) {
        0 => format!("(if {inner} < {k} then x * {inner} else {k} - y)"),
        1 => format!("sqrt(abs({inner} * {k}))"),
        2 => format!("sin({inner} * 1rad)"),
        3 => format!("({inner} * ({k} + y) - x)"),
        4 => format!("({inner} / ({k} + 20 + y))"),
        _ => format!("max({inner}, {k} * x)"),
    }
}

/// Loops inside each other, so deep, with as many turns as the language allows at times.
fn looped(random: &mut Random, deep: u64) -> String {
    if deep == 0 {
        return nested(random, 2);
    }
    let inner = looped(random, deep - 1);
    let most = [3, 40, 1000, 65_535][random.below(4) as usize];
    let far = 10 + random.below(100_000);
    format!(
        "(loop (v{deep} = 0.25 * {deep}) max {most} {{ if v{deep} > {far} then v{deep} else \
         next(v{deep} * 1.0625 + 0.5 + abs({inner})) }} else v{deep} - 1)"
    )
}

/// How much there may be of things in a scene.
struct Size {
    /// Objects of a scene of many, and of few.
    objects: [u64; 2],
    /// Parts of one object.
    parts: u64,
    /// Loops inside each other.
    loops: u64,
}

const SMALL: Size = Size {
    objects: [6, 2],
    parts: 3,
    loops: 3,
};

const ANY: Size = Size {
    objects: [60, 8],
    parts: 6,
    loops: 6,
};

/// A scene by its number.
fn scene(seed: u64, size: &Size) -> String {
    let mut random = Random::new(seed);
    let (wide, high) = (8 * (1 + random.below(20)), 8 * (1 + random.below(15)));
    let mut text = format!("image {wide} x {high} inks black, grey, white;\n");
    let value = match random.below(5) {
        0 => nested(&mut random, 4),
        1 => {
            let deep = 1 + random.below(size.loops);
            looped(&mut random, deep)
        }
        kind => {
            text += "scene world {\n  plane((0, 1, 0), -1) is checker(p.xz, 0.8, 0.4);\n";
            // Many objects, or one of many parts.
            let many = 1 + random.below(size.objects[usize::from(kind != 2)]);
            for _ in 0..many {
                let parts = match kind {
                    3 => 1 + random.below(size.parts),
                    _ => 1,
                };
                let made = joined(&mut random, parts);
                let _ = writeln!(text, "  {made} is {};", 0.3 + random.below(7) as f64 / 10.0);
            }
            text += "}\n";
            let eye = point(&mut random, 3);
            let through = match random.below(2) {
                0 => format!("unit((-1 + 2 * x / {}, 1 - 2 * y / {high}, -1))", wide - 1),
                _ => format!("unit((x / {wide} - 0.5, 0.5 - y / {high}, -1.5))"),
            };
            format!(
                "(if let h = world.trace(ray({eye}, {through}), far: 100) then \
                 h.tag * lambert(h, (0.48, 0.64, 0.6)) else 0.1)"
            )
        }
    };
    let _ = writeln!(
        text,
        "draw (x, y) = threshold({value}, bayer(4)[x mod 4, y mod 4]);"
    );
    text
}

/// The plan of a scene for a target; nothing where it does not fit, which is said.
fn planned(text: &str, target: &str) -> Option<PlannedScene> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("random.scn");
    std::fs::write(&path, text).expect("a file");
    let args = SceneArgs {
        scene: path,
        changes: Default::default(),
    };
    let scene = Scene::load(&args).unwrap_or_else(|f| panic!("{text}\n{}", f.reason()));
    let target = find(target).expect("a target");
    match ScreenArgs::default().plan(&scene, target, &[]) {
        Ok(plan) => Some(plan),
        Err(failure) => {
            let said = failure.reason();
            assert!(said.contains("does not fit"), "{text}\n{said}");
            assert!(said.contains("too many"), "{said}");
            None
        }
    }
}

/// Each target has some, other ones; that they end is what is tested.
#[test]
fn random_scenes_are_planned_within_their_work() {
    let each = 2;
    let targets = (0..).zip(TARGETS.iter());
    let all: Vec<(u64, &str)> = targets
        .flat_map(|(k, target)| (0..each).map(move |n| (each * k + n, target.name)))
        .collect();
    all.into_par_iter().for_each(|(seed, target)| {
        let text = scene(seed, &SMALL);
        if let Some(plan) = planned(&text, target) {
            assert!(plan.work() < FIT, "{} units: {text}", plan.work());
        }
    });
}

/// Loops inside each other multiply; so do the walks over them.
#[test]
fn a_deep_nest_of_long_loops_is_planned() {
    let mut value = "x".to_owned();
    for k in 0..6 {
        value = format!(
            "loop (i{k} = 0) max 65535 {{ if i{k} > 9000 + x then i{k} else next(i{k} + 1 + ({value})) }} else 0"
        );
    }
    let text = format!("image 16 x 16 inks black, white;\ndraw (x, y) = ink({value});\n");
    for target in ["jack", "bbc:micro", "6502:plain"] {
        let plan = planned(&text, target);
        assert!(plan.expect("a plan").work() < FIT);
    }
}

/// What a search is charged hangs on what a program is made of, not on its text: an edited param
/// has other digits, and the search must end where it ended.
#[test]
fn digits_of_a_param_are_no_work() {
    for target in TARGETS {
        let text = |value: &str| {
            format!(
                "image 16 x 16 inks black, white;\nparam a: real = {value} in -9000 .. 9000;\n\
                 draw (x, y) = ink(if x * a > y then 1 else 0);\n"
            )
        };
        let burnt = |value: &str| {
            let plan = planned(&text(value), target.name).expect("a plan");
            let fuel = Fuel::new(FIT);
            about(&plan, &fuel, &Cell::default()).expect("a size");
            fuel.burnt()
        };
        assert_eq!(burnt("1"), burnt("-1234.5678"), "{}", target.name);
    }
}

#[test]
#[ignore = "writes as many scenes as the environment says into a folder of it"]
fn written() {
    let of = |name: &str| std::env::var(name).ok();
    let number = |name: &str, usual| of(name).and_then(|n| n.parse().ok()).unwrap_or(usual);
    let (first, count) = (number("FIRST", 0), number("SCENES", 20));
    let folder = of("FOLDER").expect("a folder");
    for seed in first..first + count {
        let path = Path::new(&folder).join(format!("random{seed}.scn"));
        std::fs::write(path, scene(seed, &ANY)).expect("a file");
    }
}
