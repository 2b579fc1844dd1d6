//! Pictures of which not every pixel is traced: every machine draws what its model does, in
//! whatever order and part, and fewer pixels are traced where most are alike.

use crate::cli::{directory, json, slowlight};
use serde_json::Value;
use slowlight::forecast::{Forecast, forecast};
use slowlight::scene::{Changes, Scene};
use slowlight::target_args::{Refining, ScreenArgs};
use slowlight::trial;
use slowlight_compiler::targets::find;
use std::path::Path;

/// A disc with a shade of its own before a gradient: edges, flat parts and slopes.
pub fn disc(width: u32, height: u32) -> String {
    format!(
        "image {width} x {height} inks black, red, yellow, white;
        param big: real = 0.3 in 0.1 .. 0.5;
        draw (x, y) = {{
          let p = ((x - width / 2) / height, (y - height / 2) / height);
          let q = dot(p, p) / (big * big);
          let v = if q < 1 then sqrt(1 - q) else 0.2 + y / (4 * height);
          threshold(v, bayer(4)[x mod 4, y mod 4])
        }};"
    )
}

/// A ball with its shadow on a floor.
const BALL: &str = "image 96 x 64 inks black, red, yellow, white;
scene world {
  sphere((0, 1, 0), 1) is 0.9;
  plane((0, 1, 0), 0) is 0.6;
}
draw (x, y) = {
  let r = pinhole((0, 2, 5), at: (0, 0.7, 0), field: 54deg).through(x, y);
  let v = if let h = world.trace(r, far: 30)
    then h.tag * (0.2 + 0.8 * lambert(h, (0.48, 0.64, 0.6))
      * hard_shadow(world, h, h.point + 9 * (0.48, 0.64, 0.6)))
    else 0.7;
  threshold(v, bayer(4)[x mod 4, y mod 4])
};
";

fn run(dir: &Path, args: &[&str]) -> Value {
    json(dir, &[&["run", "--json"], args].concat())
}

fn number(said: &Value, name: &str) -> u64 {
    said[name].as_u64().expect("a count")
}

/// What a command says that is to fail with a status.
fn refused(dir: &Path, args: &[&str], status: i32) -> String {
    let output = slowlight(dir, args);
    assert_eq!(output.status.code(), Some(status), "{args:?}");
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Widths that are odd, beyond a page and beyond the screen; rows that begin and end between
/// key rows; blocks.
#[test]
fn every_machine_draws_what_its_model_does() {
    let scenes = [
        ("odd.scn", disc(37, 23)),
        ("wide.scn", disc(330, 30)),
        ("tall.scn", disc(24, 300)),
        ("blocks.scn", disc(48, 48)),
    ];
    let files: Vec<(&str, &str)> = scenes.iter().map(|(n, t)| (*n, t.as_str())).collect();
    let dir = directory(&files);
    let parts = [
        &["odd.scn", "--refine", "8"][..],
        &["odd.scn", "--refine", "16:0.1", "--rows", "7..17"],
        &["odd.scn", "--refine", "2", "--set", "big=0.45"],
        &["wide.scn", "--refine", "4:0", "--rows", "5..14"],
        &["tall.scn", "--refine", "8", "--rows", "150..157"],
        &[
            "blocks.scn",
            "--refine",
            "4",
            "--block",
            "2",
            "--rows",
            "6..41",
        ],
    ];
    for target in [
        &["-t", "jack"][..],
        &["-t", "jack", "--format", "f316", "--os", "jack"],
        &["-t", "bbc:micro", "--mode", "2"],
        &["-t", "bbc:micro", "--mode", "1"],
        &["-t", "bbc:micro", "--mode", "4", "--style", "listing"],
        &["-t", "6502:plain", "--format", "fixed16"],
        &["-t", "6502:plain", "--format", "fixed24"],
        &["-t", "6502:plain", "--format", "fixed16.16"],
        &["-t", "6502:plain", "--format", "log10"],
        &["-t", "6502:bbc", "--mode", "1", "--format", "fixed16"],
        &["-t", "6502:bbc", "--mode", "2", "--format", "fixed16"],
        &["-t", "6502:c64", "--mode", "hires", "--format", "log10"],
        &[
            "-t",
            "6502:c64",
            "--mode",
            "multicolour",
            "--format",
            "fixed16",
        ],
    ] {
        for part in parts {
            let args = [target, part].concat();
            let said = run(dir.path(), &args);
            assert_eq!(number(&said, "differs_from_model"), 0, "{args:?}");
            let (traced, pixels) = (number(&said, "traced"), number(&said, "pixels"));
            assert!(traced <= pixels && traced > 0, "{args:?}");
        }
    }
}

/// What a pixel takes is told of the screen's pixels, blocks or not.
#[test]
fn pixels_of_blocks_are_pixels() {
    let dir = directory(&[("blocks.scn", &disc(48, 48))]);
    for more in [
        &[][..],
        &["--block", "4"],
        &["--block", "2", "--refine", "2"],
    ] {
        let args = [&["blocks.scn", "-t", "jack", "--format", "fixed16"], more].concat();
        let said = run(dir.path(), &args);
        assert_eq!(number(&said, "pixels"), 48 * 48);
        let each = said["cycles_per_pixel"].as_f64().expect("cycles");
        let all = number(&said, "cycles") as f64;
        assert!((each * 2304.0 / all - 1.0).abs() < 1e-9, "{more:?}: {each}");
    }
}

/// What is traced, what that takes and what it loses, beside the same picture as a whole.
#[test]
fn fewer_pixels_take_less_and_lose_little() {
    let dir = directory(&[("ball.scn", BALL)]);
    for (target, format) in [
        ("jack", "log10"),
        ("bbc:micro", "real40"),
        ("6502:plain", "fixed16"),
        ("6502:bbc", "fixed16"),
        ("6502:c64", "log10"),
    ] {
        let machine = ["ball.scn", "-t", target, "--format", format];
        let of = |more: &[&str]| run(dir.path(), &[&machine, more].concat());
        let (whole, refined) = (of(&[]), of(&["--refine", "8"]));
        assert_eq!(whole["traced"], Value::Null);
        let pixels = number(&refined, "pixels");
        let traced = number(&refined, "traced");
        assert!(traced * 2 < pixels, "{target}: {traced} of {pixels}");
        let [before, after] = [&whole, &refined].map(|said| number(said, "cycles"));
        assert!(after < before, "{target}: {after} cycles, not {before}");
        let wrong = number(&refined, "differs_from_native");
        assert!(wrong * 100 < pixels, "{target}: {wrong} of {pixels}");
        // Where nothing may differ, what is not traced is alike all around.
        let exact = number(&of(&["--refine", "8:0"]), "traced");
        assert!(exact > traced, "{target}: {exact}");
    }
}

/// The reason is said, and nothing is written.
#[test]
fn pictures_without_a_shade_of_their_own_are_refused() {
    let ink = "image 16 x 8 inks black, white; draw (x, y) = ink((x + y) mod 2);";
    let choice = "image 16 x 8 inks black, white;
        draw (x, y) = if x < 4 then ink(1) else threshold(x / 20, bayer(2)[x mod 2, y mod 2]);";
    let sent = "image 16 x 8 inks black, white; draw (x, y) = floyd(x / 20, x, y);";
    let files = [("ink.scn", ink), ("choice.scn", choice), ("sent.scn", sent)];
    let dir = directory(&files);
    for (scene, why) in [
        ("ink.scn", "has inks alone"),
        ("choice.scn", "has inks alone"),
        ("sent.scn", "spreads the error of its dither"),
    ] {
        for target in ["jack", "bbc:micro", "6502:plain"] {
            let args = ["build", scene, "-t", target, "--refine", "8", "-o", "out/"];
            let said = refused(dir.path(), &args, 2);
            assert!(said.contains(why), "{said}");
            assert!(!dir.path().join("out").exists());
        }
    }
    let args = ["run", "ink.scn", "-t", "jack", "--refine", "3"];
    let said = refused(dir.path(), &args, 2);
    assert!(said.contains("2, 4, 8 or 16"), "{said}");
}

/// Bands say what all rows take.
#[test]
fn some_bands_say_what_all_rows_take() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/fog.scn");
    let scene = Scene::open(&path, &Changes::default()).expect("a scene");
    let refine = Some(Refining {
        step: 8,
        tolerance: 8,
    });
    let screen = ScreenArgs {
        refine,
        format: Some("log10".to_owned()),
        ..ScreenArgs::default()
    };
    let target = find("6502:plain").expect("a target");
    let plan = screen.plan(&scene, target, &[]).expect("a plan");
    let text = slowlight_compiler::backend::emit(&plan);
    let told = forecast((&plan, &text), screen.machine(target)).expect("a forecast");
    assert!(matches!(told, Forecast::Rows(..)), "{told:?}");
    let mut loaded = trial::build(&plan).expect("a program").loaded;
    let run = loaded.run(trial::LIMIT, &mut |_| {}).expect("it runs");
    let (told, cycles) = (told.cycles().expect("cycles"), run.cycles as f64);
    let off = (told / cycles - 1.0).abs();
    assert!(off < 0.3, "{told:e}, not {cycles:e}");
}
