//! Planning ends: random scenes with deep nests, long loops and many objects, planned for
//! machines within the work that a search may do, which is counted, not timed.
//!
//! A few run with the other tests. As many as are wanted are planned, with times and memory, by
//! ```text
//! SCENES=2000 TARGET=jack cargo test --release --test all planning::many -- --ignored --nocapture
//! ```

use crate::ramps::random::Random;
use slowlight::fit::FIT;
use slowlight::scene::Scene;
use slowlight::target_args::ScreenArgs;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::target::{TARGETS, find};
use std::fmt::Write;
use std::time::Instant;

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

/// A scene by its number.
fn scene(seed: u64) -> String {
    let mut random = Random::new(seed);
    let (wide, high) = (8 * (1 + random.below(20)), 8 * (1 + random.below(15)));
    let mut text = format!("image {wide} x {high} inks black, grey, white;\n");
    let value = match random.below(5) {
        0 => nested(&mut random, 4),
        1 => {
            let deep = 1 + random.below(6);
            looped(&mut random, deep)
        }
        kind => {
            text += "scene world {\n  plane((0, 1, 0), -1) is checker(p.xz, 0.8, 0.4);\n";
            // Many objects, or one of many parts.
            let many = 1 + random.below(if kind == 2 { 40 } else { 8 });
            for _ in 0..many {
                let parts = match kind {
                    3 => 1 + random.below(6),
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
fn planned(seed: u64, target: &str) -> Option<Plan> {
    let text = scene(seed);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("random.scn");
    std::fs::write(&path, &text).expect("a file");
    let args = slowlight::scene::SceneArgs {
        scene: path,
        changes: Default::default(),
    };
    let scene = Scene::load(&args).unwrap_or_else(|f| panic!("{text}\n{f:?}"));
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
    for (k, target) in (0..).zip(TARGETS.iter()) {
        for seed in 2 * k..2 * k + 2 {
            if let Some(plan) = planned(seed, target.name) {
                assert!(
                    plan.work() < 2 * FIT,
                    "{} units: {}",
                    plan.work(),
                    scene(seed)
                );
            }
        }
    }
}

/// Loops inside each other multiply; so do the walks over them.
#[test]
fn a_deep_nest_of_long_loops_is_planned() {
    let mut value = "x".to_owned();
    for k in 0..6 {
        value = format!(
            "loop (i{k} = 0) max 65535 {{ if i{k} > 9000 + x then i{k} else next(i{k} + 1 + {value}) }} else 0"
        );
    }
    let text = format!("image 16 x 16 inks black, white;\ndraw (x, y) = ink({value});\n");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("nest.scn");
    std::fs::write(&path, &text).expect("a file");
    let args = slowlight::scene::SceneArgs {
        scene: path,
        changes: Default::default(),
    };
    let scene = Scene::load(&args).expect("a scene");
    for target in ["jack", "bbc:micro", "6502:plain"] {
        let target = find(target).expect("a target");
        let plan = ScreenArgs::default().plan(&scene, target, &[]);
        assert!(plan.expect("a plan").work() < FIT);
    }
}

/// The largest that the process was since it was asked last, in MB; nothing where the system
/// does not say.
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let found = line.split_whitespace().nth(1)?.parse::<u64>().ok()? / 1024;
    // Begins anew.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    Some(found)
}

#[test]
#[ignore = "plans as many scenes as the environment says, and tells how long each took"]
fn many() {
    let of = |name: &str| std::env::var(name).ok();
    let count: u64 = of("SCENES").and_then(|n| n.parse().ok()).unwrap_or(20);
    let first: u64 = of("FIRST").and_then(|n| n.parse().ok()).unwrap_or(0);
    let target = of("TARGET").unwrap_or("jack".to_owned());
    let (mut longest, mut largest, mut fits) = ((0.0, 0), (0, 0), 0);
    peak();
    for seed in first..first + count {
        let begun = Instant::now();
        fits += u64::from(planned(seed, &target).is_some());
        let took = begun.elapsed().as_secs_f64();
        if took > longest.0 {
            longest = (took, seed);
        }
        largest = largest.max((peak().unwrap_or(0), seed));
        if took > 5.0 {
            println!("{target} {seed}: {took:.1} s");
        }
    }
    println!(
        "{target}: {count} scenes, {fits} fit; longest {:.1} s ({}), largest {} MB ({})",
        longest.0, longest.1, largest.0, largest.1
    );
}
