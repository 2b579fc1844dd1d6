//! Scenes compiled for the plain 6502, assembled, run and held against the model.
#![allow(clippy::unwrap_used)]

use slowlight::scene::Precision;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::planner::plan;
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;
use slowlight_compiler::targets::{default_mode, find};
use slowlight_vm::Stop;
use slowlight_vm::mos6502::{Plain, Run, assemble};

const MIRRORS: &str = include_str!("../../examples/mirrors.scn");

/// A scene's plan for the target, and its graph for the native evaluation.
fn planned(source: &str, set: &[f64], rows: Option<(u32, u32)>) -> PlannedScene {
    let target = find("6502:plain").unwrap();
    let scene = scene::check("test", source);
    assert!(scene.is_right(), "{:?}\n{source}", scene.diagnostics);
    let set = if set.is_empty() {
        Vec::new()
    } else {
        vec![("eye".to_owned(), set.to_vec())]
    };
    let graph = scene
        .lower(&Precision::of(target).options(Options {
            set,
            ..Options::default()
        }))
        .unwrap();
    let mode = default_mode(target, graph.image.width, graph.image.height).unwrap();
    plan(
        &graph,
        target,
        &Goal {
            name: "test".to_owned(),
            mode,
            rows,
            plot: true,
        },
    )
    .unwrap()
}

fn text(plan: &PlannedScene) -> String {
    slowlight_compiler::backend::emit(plan).remove(0).text
}

fn run(text: &str) -> Run {
    let program = assemble(text).unwrap_or_else(|faults| panic!("{}\n{text}", faults[0]));
    let mut machine = Plain::new();
    machine.load(&program.image()).unwrap();
    machine.run(2_000_000_000, &mut |_| true)
}

/// Pixels of the plan's rows in which the machine and the model differ.
fn differences(plan: &PlannedScene, run: &Run) -> u32 {
    let screen = run.screen.as_ref().unwrap();
    let mut model = ModelRun::new(plan);
    let mut different = 0;
    for y in plan.rows.0..=plan.rows.1 {
        for x in 0..screen.width {
            let drawn = screen.pixels[(y * screen.width + x) as usize];
            different += u32::from(drawn != model.pixel(x as i32, y as i32).ink);
        }
    }
    assert_eq!(model.unset_reads(), 0);
    different
}

#[test]
fn two_mirrors_are_drawn_as_the_model_says() {
    for (set, rows) in [
        (&[][..], (60, 63)),
        (&[], (118, 121)),
        (&[0.35, 0.25, 3.6], (128, 131)),
    ] {
        let plan = planned(MIRRORS, set, Some(rows));
        let run = run(&text(&plan));
        assert_eq!(run.stop, Stop::Ended);
        assert_eq!(differences(&plan, &run), 0);
        let screen = run.screen.unwrap();
        let mut native = Native::new(&plan.graph);
        let mut off = 0;
        for y in (rows.0..=rows.1).filter(|y| *y != 129) {
            for x in 0..320 {
                off += u32::from(
                    screen.pixels[(y * 320 + x) as usize] != native.pixel(x as i32, y as i32).ink,
                );
            }
        }
        assert!(off <= 25, "{off} pixels of rows {rows:?} are not native's");
    }
}

#[test]
fn a_pixel_costs_what_it_cost() {
    let run = run(&text(&planned(MIRRORS, &[], Some((120, 120)))));
    insta::assert_snapshot!(run.cycles / 320);
}

#[test]
fn the_parameter_block_is_live_and_checked() {
    let rows = Some((70, 71));
    let original = text(&planned(MIRRORS, &[], rows));
    let edit = |name: &str, from: &str, to: &str| {
        let line = format!("{name} = {from} ");
        assert_eq!(original.matches(&line).count(), 1, "{line}");
        original.replacen(&line, &format!("{name} = {to} "), 1)
    };
    let edited = edit("eye_x", "0", "350")
        .replace("eye_y = -100 ", "eye_y = 250 ")
        .replace("eye_z = 3000 ", "eye_z = 3600 ");
    let plan = planned(MIRRORS, &[0.35, 0.25, 3.6], rows);
    assert_eq!(differences(&plan, &run(&edited)), 0);

    let ended = |text: &str| match run(text).stop {
        Stop::Fault(fault) => fault.message,
        other => format!("{other:?}"),
    };
    for (name, from, to, number) in [
        ("eye_x", "0", "3001", 1),
        ("eye_x", "0", "-3001", 1),
        ("eye_y", "-100", "2147483647", 2),
        ("eye_z", "3000", "-2147483648", 3),
        ("first_row", "70", "-1", 4),
        ("last_row", "71", "240", 5),
    ] {
        assert_eq!(
            ended(&edit(name, from, to)),
            format!("the program ended with status {number}")
        );
    }
    assert_eq!(
        ended(&edit("eye_x", "0", "3000").replace("last_row = 71 ", "last_row = 70 ")),
        "Ended"
    );
}

#[test]
fn large_tables_long_loops_and_wide_pictures() {
    let entries: Vec<String> = (0..300)
        .map(|n| ((n * 7919) % 256 - 128).to_string())
        .collect();
    let rows: Vec<String> = entries.chunks(20).map(|row| row.join(", ")).collect();
    let source = format!(
        "image 300 x 5 inks black, red, yellow, white;
         const big = [{}];
         const small = [0.5, -1, 2; 3, 4.25, -5];
         draw (x, y) = {{
           let far = big[x - 5, y * 4 - 2] + small[x - 298, y - 1] + small[y, 3 - x];
           let turned = loop (n = 0, sum = far) max 300 {{
             if sum < 900 then next(n + 1, sum + small[n mod 3, n div 150]) else n
           }} else 7;
           ink(abs(floor(turned * 0.37)) mod 4)
         }};",
        rows.join("; ")
    );
    let plan = planned(&source, &[], None);
    let run = run(&text(&plan));
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(differences(&plan, &run), 0);
}

/// Up to 512 entries in a row are in one of two pages; what is beyond an end is the end.
#[test]
fn rows_of_two_pages_are_read_at_both_ends_and_beyond() {
    for entries in [257, 300, 511, 512] {
        let row: Vec<String> = (0..entries)
            .map(|n| ((n * 7919) % 4001 - 2000).to_string())
            .collect();
        let source = format!(
            "image 270 x 2 inks black, red, yellow, white;
             const row = [{}];
             draw (x, y) = {{
               let inside = row[x];
               let below = row[2 * x - 30 - 40 * y];
               let above = row[{} + x * y];
               ink(abs(inside + 3 * below + 5 * above) div 7 mod 4)
             }};",
            row.join(", "),
            entries - 200
        );
        let plan = planned(&source, &[], None);
        let run = run(&text(&plan));
        assert_eq!(run.stop, Stop::Ended, "{entries}");
        assert_eq!(differences(&plan, &run), 0, "{entries}");
    }
}

/// Scenes of random expressions over everything that the target computes.
pub(crate) struct Scribe(pub(crate) u64);

impl Scribe {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }

    fn real(&mut self, depth: u32) -> String {
        let leaf = [
            "eye.x", "eye.y", "eye.z", "real_of", "0.7", "-3.25", "100.5", "0.01", "2", "0.5",
            "held",
        ];
        if depth == 0 {
            return match leaf[self.below(leaf.len() as u64) as usize] {
                "real_of" => ["(x - 3)", "(2 - y)"][self.below(2) as usize].to_owned(),
                other => other.to_owned(),
            };
        }
        let (a, b) = (self.real(depth - 1), self.real(depth - 1));
        match self.below(16) {
            0 | 1 => format!("({a} + {b})"),
            2 | 3 => format!("({a} - {b})"),
            4 | 5 => format!("({a} * {b})"),
            6 => format!("({a} / {b})"),
            7 => format!("sqrt({a})"),
            8 => format!("min({a}, {b})"),
            9 => format!("max({a}, {b})"),
            10 => format!("abs({a})"),
            11 => format!("(-{a})"),
            12 => format!("({a} mod {b})"),
            13 => format!("(0.0 + {})", self.int(depth - 1)),
            14 => format!("steps[{}, {}]", self.int(depth - 1), self.int(depth - 1)),
            _ => format!("(if {} then {a} else {b})", self.condition(depth - 1)),
        }
    }

    fn int(&mut self, depth: u32) -> String {
        let leaf = ["x", "y", "3", "(-7)", "16", "1000", "k"];
        if depth == 0 {
            return leaf[self.below(leaf.len() as u64) as usize].to_owned();
        }
        let (a, b) = (self.int(depth - 1), self.int(depth - 1));
        let power = ["2", "4", "8", "16", "64"][self.below(5) as usize];
        match self.below(13) {
            0 => format!("({a} + {b})"),
            1 => format!("({a} - {b})"),
            2 => format!("({a} * {b})"),
            3 => format!("({a} div {b})"),
            4 => format!("({a} mod {b})"),
            5 => format!("({a} div {power})"),
            6 => format!("({a} mod {power})"),
            7 => format!("floor({})", self.real(depth - 1)),
            8 => format!("round({})", self.real(depth - 1)),
            9 => format!("sign({})", self.real(depth - 1)),
            10 => format!("abs({a})"),
            11 => format!("max({a}, {b})"),
            _ => format!("(if {} then {a} else {b})", self.condition(depth - 1)),
        }
    }

    fn condition(&mut self, depth: u32) -> String {
        let reals = (self.real(depth), self.real(depth));
        let ints = (self.int(depth), self.int(depth));
        match self.below(8) {
            0 => format!("{} < {}", reals.0, reals.1),
            1 => format!("{} >= {}", reals.0, reals.1),
            2 => format!("{} == 0", ints.0),
            3 => format!("{} <= {}", ints.0, ints.1),
            4 => format!("{} > 0", reals.0),
            5 => format!("not ({} < {})", ints.0, ints.1),
            6 => format!("{} < 1 and {} < {}", reals.0, ints.0, ints.1),
            _ => format!("{} < 1 or {} != {}", reals.0, ints.0, ints.1),
        }
    }

    /// A scene without mistakes: a constant outside an operation's domain is one.
    pub(crate) fn scene(&mut self) -> String {
        loop {
            let source = self.any_scene();
            if scene::check("random", &source).is_right() {
                return source;
            }
        }
    }

    fn any_scene(&mut self) -> String {
        let (start, next, test) = (self.real(1), self.real(2), self.condition(1));
        let (count, end, left) = (self.int(1), self.real(2), self.int(2));
        format!(
            "image 7 x 5 inks black, red, yellow, white;
             param eye: vec3 = (0.5, -1.25, 7.5) in (-2, -3, 0) .. (2, 3, 90);
             const steps = [0.5, -1, 2; 3, 4.25, -500];
             draw (x, y) = {{
               let k = x * 5 - y;
               let u = loop (held = {start}, k = {count}) max 6 {{
                 if {test} then next({next}, {left}) else {end}
               }} else held - k;
               ink(floor(u * 3) mod 4)
             }};",
            start = start.replace("held", "0.3"),
            count = count.replace("held", "0.3"),
        )
    }
}

#[test]
fn random_scenes_are_drawn_as_the_model_says() {
    let mut scribe = Scribe(2);
    let mut varied = 0;
    for _ in 0..120 {
        let source = scribe.scene();
        let plan = planned(&source, &[], None);
        let run = run(&text(&plan));
        assert_eq!(run.stop, Stop::Ended, "{source}");
        assert_eq!(differences(&plan, &run), 0, "{source}");
        let pixels = run.screen.unwrap().pixels;
        varied += u32::from(pixels.iter().any(|ink| *ink != pixels[0]));
    }
    assert!(varied >= 40, "only {varied} pictures show anything");
}

#[cfg(feature = "peers")]
mod peers {
    use super::*;
    use std::process::Command;

    /// The bytes that ca65 and ld65 make of a text.
    fn ca65(text: &str) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("program.s"), text).unwrap();
        let tool = |command: &mut Command| {
            let done = command
                .output()
                .expect("cc65 is installed: see tests/peers/setup");
            assert!(
                done.status.success(),
                "{}",
                String::from_utf8_lossy(&done.stderr)
            );
        };
        tool(
            Command::new("ca65")
                .args(["--feature", "pc_assignment", "-o"])
                .arg(at("program.o"))
                .arg(at("program.s")),
        );
        tool(
            Command::new("ld65")
                .args(["-t", "none", "-o"])
                .arg(at("program"))
                .arg(at("program.o")),
        );
        std::fs::read(at("program")).unwrap()
    }

    #[test]
    fn ca65_makes_the_same_bytes() {
        let mut scribe = Scribe(3);
        let random: Vec<String> = (0..10).map(|_| scribe.scene()).collect();
        for source in random.iter().map(String::as_str).chain([MIRRORS]) {
            let text = text(&planned(source, &[], None));
            assert!(assemble(&text).unwrap().bytes == ca65(&text), "{source}");
        }
    }
}
