//! Scenes compiled to BBC BASIC, tokenised, run and held against the model.
#![allow(clippy::unwrap_used)]

use crate::mos6502::Scribe;
use slowlight::scene::Precision;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::planner::plan;
use slowlight_compiler::scene;
use slowlight_compiler::sema::{Freeze, Options};
use slowlight_compiler::targets::{default_mode, find};
use slowlight_vm::Stop;
use slowlight_vm::bbc::{Config, Dialect, Machine, Run};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

const MIRRORS: &str = include_str!("../../examples/mirrors.scn");

/// A target, and the eye of mirrors where it is another.
type Asked = (&'static str, Vec<u64>);

/// Rows of mirrors, of one program for the whole picture: it takes long to plan.
fn mirrors(target: &'static str, eye: &[f64], rows: (u32, u32)) -> PlannedScene {
    static PLANS: Mutex<BTreeMap<Asked, Arc<OnceLock<PlannedScene>>>> = Mutex::new(BTreeMap::new());
    let asked = (target, eye.iter().map(|x| x.to_bits()).collect());
    let known = PLANS.lock().unwrap().entry(asked).or_default().clone();
    let mut plan = known
        .get_or_init(|| planned(target, MIRRORS, eye, None))
        .clone();
    plan.rows = rows;
    plan
}

/// A scene's plan for a target.
fn planned(target: &str, source: &str, set: &[f64], rows: Option<(u32, u32)>) -> PlannedScene {
    let target = find(target).unwrap();
    let scene = scene::check("test", source);
    assert!(scene.is_right(), "{:?}\n{source}", scene.diagnostics);
    let set = match set.is_empty() {
        true => Vec::new(),
        false => vec![("eye".to_owned(), set.to_vec())],
    };
    let (width, height) = (320, 240);
    let mode = default_mode(target, width, height).unwrap();
    let graph = scene
        .lower(&Precision::of(target).options(Options {
            set,
            ..Options::default()
        }))
        .unwrap();
    let goal = Goal {
        name: "test".to_owned(),
        mode,
        rows,
        plot: true,
    };
    fitting(plan(&graph, target, &goal).unwrap())
}

/// The plan, or the next one that spends less memory on speed, that fits.
fn fitting(plan: PlannedScene) -> PlannedScene {
    slowlight::fit::fit(vec![plan.mode], &|_, _| Ok(plan.clone()), &|_| None)
        .unwrap_or_else(|e| panic!("{e:?}"))
}

pub fn text(plan: &PlannedScene) -> String {
    slowlight_compiler::backend::emit(plan).remove(0).text
}

pub fn run(dialect: Dialect, text: &str) -> Run {
    run_at(0x1900, dialect, text)
}

/// The same where programs begin at another page.
pub fn run_at(page: u16, dialect: Dialect, text: &str) -> Run {
    let mut machine = Machine::new(Config { dialect, page });
    machine
        .load_text(text)
        .unwrap_or_else(|fault| panic!("{fault}\n{text}"));
    machine.run(100_000_000_000, &mut |_| true)
}

/// The ink that stands where a pixel of the picture belongs.
fn ink(plan: &PlannedScene, run: &Run, x: u32, y: u32) -> u8 {
    let (x, y) = (x as i32 + plan.offset.0, y as i32 + plan.offset.1);
    run.screen.pixels[(y * run.screen.width as i32 + x) as usize]
}

/// Pixels of the plan's rows in which the machine and the model differ.
pub fn differences(plan: &PlannedScene, run: &Run) -> u32 {
    let mut model = ModelRun::new(plan);
    let mut different = 0;
    for y in plan.rows.0..=plan.rows.1 {
        for x in plan.columns.0..=plan.columns.1 {
            let modelled = model.pixel(x as i32, y as i32).ink;
            different += u32::from(ink(plan, run, x, y) != modelled);
        }
    }
    assert_eq!(model.unset_reads(), 0);
    different
}

const MACHINES: [(&str, Dialect); 3] = [
    ("bbc:micro", Dialect::Micro),
    ("bbc:agon", Dialect::Agon),
    ("bbc:basicv", Dialect::BasicV),
];

#[test]
fn two_mirrors_are_drawn_as_the_model_says() {
    for (set, rows) in [
        (&[][..], (60, 62)),
        (&[], (118, 121)),
        (&[0.35, 0.25, 3.6], (128, 131)),
    ] {
        for (target, dialect) in MACHINES {
            let plan = mirrors(target, set, rows);
            let run = run(dialect, &text(&plan));
            assert_eq!(run.stop, Stop::Ended);
            assert_eq!(differences(&plan, &run), 0);
            let mut native = Native::new(&plan.graph);
            let mut off = 0;
            for y in (rows.0..=rows.1).filter(|y| *y != 129) {
                for x in 0..320 {
                    off +=
                        u32::from(ink(&plan, &run, x, y) != native.pixel(x as i32, y as i32).ink);
                }
            }
            assert!(off <= 1, "{off} pixels of rows {rows:?} are not native's");
        }
    }
}

#[test]
fn two_mirrors_fit_a_disc_micro() {
    let plan = mirrors("bbc:micro", &[], (120, 120));
    let run = run(Dialect::Micro, &text(&plan));
    assert_eq!(run.stop, Stop::Ended);
    // MODE 1 leaves 5,888 bytes at PAGE &1900.
    assert!(run.program_bytes + run.ram_bytes <= 5_888);
    insta::assert_snapshot!(format!(
        "{} bytes of program, {} of variables and stack, {} cycles a pixel of row 120",
        run.program_bytes,
        run.ram_bytes,
        run.cycles / 320
    ));
}

/// A scene's plan for a mode of the Micro, its params folded.
fn folded(source: &str, mode: &str, rows: (u32, u32), plot: bool) -> PlannedScene {
    let target = find("bbc:micro").unwrap();
    let mode = *target.modes.iter().find(|m| m.name == mode).unwrap();
    // As the command line has it.
    let options = Precision::of(target).options(Options {
        inks: Some(mode.inks),
        freeze: Freeze::All,
        ..Options::default()
    });
    let graph = scene::check("test", source).lower(&options).unwrap();
    let goal = Goal {
        name: "test".to_owned(),
        mode,
        rows: Some(rows),
        plot,
    };
    fitting(plan(&graph, target, &goal).unwrap())
}

#[test]
fn cycles_of_sampled_rows_are_known() {
    let mut said = String::new();
    let plans = [false, true].map(|plot| folded(MIRRORS, "1", (0, 239), plot));
    for row in [20, 60, 100, 150, 200] {
        let [traced, drawn] = plans.clone().map(|mut plan| {
            plan.rows = (row, row);
            let run = run(Dialect::Micro, &text(&plan));
            assert_eq!(run.stop, Stop::Ended);
            if plan.plot {
                assert_eq!(differences(&plan, &run), 0);
            }
            run.cycles / 320
        });
        // Each is another plan: what draws has less memory for tables.
        said.push_str(&format!("row {row}: {traced} a pixel, drawn {drawn}\n"));
    }
    insta::assert_snapshot!(said);
}

#[test]
fn every_mode_of_the_micro_is_drawn_as_the_model_says() {
    for (mode, width) in [("0", 640), ("1", 320), ("2", 160), ("4", 320), ("5", 160)] {
        // Once at whole bytes, and once not: then it plots.
        for width in [width, 151] {
            let source = format!(
                "image {width} x 20 inks black, red, green, yellow, blue, magenta, cyan, white;
                 draw (x, y) = ink((x * 5 + y * 3 + x * y) mod 8);"
            );
            let plan = folded(&source, mode, (3, 17), true);
            let text = text(&plan);
            assert_eq!(text.contains("PLOT"), width == 151);
            let run = run(Dialect::Micro, &text);
            assert_eq!(run.stop, Stop::Ended);
            assert_eq!(differences(&plan, &run), 0, "mode {mode}, {width} columns");
            // Nothing stands outside the rows asked for.
            let above = (plan.offset.1 + 2) as usize * run.screen.width as usize;
            assert!(run.screen.pixels[..above].iter().all(|ink| *ink == 0));
        }
    }
}

#[test]
fn runs_in_two_versions_compute_the_same() {
    // What grows threefold a turn is beyond every limit after some columns.
    let source = "image 32 x 4 inks black, red, yellow, white;
        draw (x, y) = {
          let far = loop (t = 0.5, n = 0) max 40 {
            if n < x then next(t * 3 - y, n + 1) else t
          } else t;
          let a = far * far + y;
          let b = far * a - x + a * 0.37;
          ink(abs(floor(b / 7)) mod 4)
        };";
    let plan = folded(source, "1", (0, 3), true);
    let text = text(&plan);
    let mut machine = Machine::new(Config::default());
    machine.load_text(&text).unwrap();
    let (run, lines) = machine.profile(100_000_000_000, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(differences(&plan, &run), 0);
    // The version for the rest ends in a jump back, and stands behind END.
    let (_, rest) = text.split_once(":END\n").unwrap();
    let rare = rest
        .lines()
        .find(|l| l.contains("FNmul(") && l.contains("GOTO"));
    let number = rare.unwrap_or_else(|| panic!("{text}"));
    let number: u16 = number[..3].parse().unwrap();
    let times = lines.iter().find(|l| l.line == number).unwrap().times;
    assert!(times > 20 && times < 32 * 4 - 20, "{times}\n{text}");
}

#[test]
fn a_listing_computes_the_same() {
    let mut plan = mirrors("bbc:micro", &[], (60, 61));
    plan.listing = true;
    // A listing takes more memory than the quick program.
    let plan = fitting(plan);
    let run = run(Dialect::Micro, &text(&plan));
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(differences(&plan, &run), 0);
}

#[test]
fn a_small_program_computes_the_same() {
    let mut plan = mirrors("bbc:micro", &[], (60, 61));
    plan.tight = true;
    let run = run(Dialect::Micro, &text(&plan));
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(differences(&plan, &run), 0);
}

#[test]
fn the_parameter_block_is_live_and_checked() {
    let rows = (70, 71);
    let original = text(&mirrors("bbc:micro", &[], rows));
    let edit = |name: &str, from: &str, to: &str| {
        let line = format!("{name}={from}");
        assert_eq!(original.matches(&line).count(), 1, "{line}\n{original}");
        original.replacen(&line, &format!("{name}={to}"), 1)
    };
    let edited = edit("eye_x", "0", "0.35")
        .replace("eye_y=-0.1", "eye_y=0.25")
        .replace("eye_z=3", "eye_z=3.6");
    let plan = mirrors("bbc:micro", &[0.35, 0.25, 3.6], rows);
    assert_eq!(differences(&plan, &run(Dialect::Micro, &edited)), 0);
    // It is short of memory, and says so in few words.
    for (name, from, to, says) in [
        ("eye_x", "0", "3.1", "eye_x: -3 to 3\n"),
        ("eye_y", "-0.1", "-2", "eye_y: -1.5 to 2\n"),
        ("eye_z", "3", "1E30", "eye_z: 1.5 to 6\n"),
        ("first%", "70", "-1", "rows: 0 to 239\n"),
        ("last%", "71", "69", "rows: 0 to 239\n"),
    ] {
        let text = if name == "last%" {
            original.replace("last%=71", "last%=69")
        } else {
            edit(name, from, to)
        };
        let run = run(Dialect::Micro, &text);
        assert_eq!((run.stop, run.text.as_str()), (Stop::Ended, says));
    }
}

#[test]
fn tables_loops_and_pictures_of_other_sizes() {
    let entries: Vec<String> = (0..60)
        .map(|n| ((n * 79) % 256 - 128).to_string())
        .collect();
    let rows: Vec<String> = entries.chunks(20).map(|row| row.join(", ")).collect();
    let source = format!(
        "image 330 x 5 inks black, #0000ff, #fe02fe, white;
         const big = [{}];
         const small = [0.5, -1, 2; 3, 4.25, -5];
         const line = [1, 0, 3];
         draw (x, y) = {{
           let far = big[x - 5, y * 4 - 2] + small[x - 298, y - 1] + small[y, 3 - x] + line[x mod 3, 0];
           let turned = loop (n = 0, sum = far) max 40 {{
             if sum < 30 then next(n + 1, sum + small[n mod 3, n div 20]) else n
           }} else 7;
           ink(abs(floor(turned * 0.37)) mod 4)
         }};",
        rows.join("; ")
    );
    for (target, dialect) in MACHINES {
        let plan = planned(target, &source, &[], None);
        let run = run(dialect, &text(&plan));
        assert_eq!(run.stop, Stop::Ended);
        assert_eq!(differences(&plan, &run), 0, "{target}");
        assert_eq!(run.screen.palette[1], [0, 0, 255]);
        // BASIC V's machine alone has it.
        let pink = if dialect == Dialect::BasicV {
            [254, 2, 254]
        } else {
            [255, 0, 255]
        };
        assert_eq!(run.screen.palette[2], pink);
    }
}

#[test]
fn every_function_is_computed_as_the_model_says() {
    let source = "image 24 x 16 inks black, red, yellow, white;
        param k: real = 0.7 in -2 .. 2;
        draw (x, y) = {
          let u = (x - 11.5) / 5;
          let v = (y - 7.3) * k;
          let a = sin(u * 1rad) + cos(v * 40rad) * tan(u * 0.2rad) + exp(u) - log(abs(v)) + u ^ 3 + abs(v) ^ 1.5;
          let b = asin(u / 3) / 1rad + acos(v) / 1rad + atan2(u, v) / 1rad + v mod u + round(u * 7) + sign(v);
          ink(abs(floor(a + b)) mod 4)
        };";
    let plan = planned("bbc:micro", source, &[], None);
    let run = run(Dialect::Micro, &text(&plan));
    assert_eq!(run.stop, Stop::Ended);
    assert_eq!(differences(&plan, &run), 0);
}

#[test]
fn names_of_scenes_never_meet_those_of_the_program() {
    let names = [
        "first", "last", "turn", "fnadd", "print", "to", "c0_5", "i", "r", "a", "b", "big", "sub",
        "pi",
    ];
    let lets: String = names
        .iter()
        .map(|n| format!("let {n} = x * 0.5 + y * 0.25 + {};\n", n.len()))
        .collect();
    let sum = names.join(" + ");
    let source = format!(
        "image 9 x 4 inks black, white;\nparam turns: int = 3 in 1 .. 5;\nparam on: bool = true;\n
         draw (x, y) = {{ {lets} let t = loop (first = x, turn = y) max 9 {{ if first < turns + 8 then next(first + 1, turn) else first + turn }} else 0;
         ink((floor({sum}) + floor({sum}) * t) mod 2) }};"
    );
    let checked = scene::check("test", &source);
    // What the language itself refuses as a name is no concern of the target.
    if checked.is_right() {
        let plan = planned("bbc:micro", &source, &[], None);
        let run = run(Dialect::Micro, &text(&plan));
        assert_eq!(run.stop, Stop::Ended);
        assert_eq!(differences(&plan, &run), 0);
    } else {
        panic!("{:?}", checked.diagnostics);
    }
}

#[test]
fn random_scenes_are_drawn_as_the_model_says() {
    let mut scribe = Scribe(7);
    let mut run_to_the_end = 0;
    for _ in 0..60 {
        let source = scribe.scene();
        let plan = planned("bbc:micro", &source, &[], None);
        let text = text(&plan);
        assert!(text.lines().all(|l| l.len() < 250), "{text}");
        let run = run(Dialect::Micro, &text);
        match &run.stop {
            Stop::Ended => {
                run_to_the_end += 1;
                assert_eq!(differences(&plan, &run), 0, "{source}\n{text}");
            }
            // Some are too long for the machine; nothing else may go wrong.
            Stop::Fault(fault) => assert!(
                fault.message.contains("No room") || fault.message == "Bad MODE",
                "{fault}\n{source}\n{text}"
            ),
            other => panic!("{other:?}\n{source}\n{text}"),
        }
    }
    assert!(run_to_the_end >= 40, "{run_to_the_end}");
}
