//! What `build` says of a picture's time is what the whole takes, though it runs some rows.

use crate::cli::{directory, json};
use slowlight::forecast::{Forecast, forecast};
use slowlight::scene::{Changes, Scene};
use slowlight::target_args::ScreenArgs;
use slowlight::trial;
use slowlight_compiler::targets::find;
use std::path::Path;

/// The forecast of an example, and the cycles of the whole.
fn both(scene: &str, target: &str, block: u32) -> (Forecast, f64) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let scene = path.join(scene).with_extension("scn");
    let scene = Scene::open(&scene, &Changes::default()).expect("a scene");
    let screen = ScreenArgs {
        block: Some((block, block)),
        ..ScreenArgs::default()
    };
    let target = find(target).expect("a target");
    let plan = screen.plan(&scene, target, &[]).expect("a plan");
    let machine = screen.machine(target);
    let told =
        forecast((&plan, &slowlight_compiler::backend::emit(&plan)), machine).expect("a forecast");
    let mut loaded = trial::build(&plan).expect("a program").loaded;
    let run = loaded.run(trial::LIMIT, &mut |_| {}).expect("it runs");
    (told, run.cycles as f64)
}

#[test]
fn some_rows_say_what_all_take() {
    for (scene, target, block) in [
        ("mirrors", "jack", 1),
        ("mirrors", "6502:plain", 1),
        ("masks", "bbc:micro", 1),
        // Its errors go from row to row.
        ("primitives", "6502:plain", 8),
    ] {
        let (told, cycles) = both(scene, target, block);
        assert!(matches!(told, Forecast::Rows(..)), "{scene}: {told:?}");
        let told = told.cycles().expect("cycles");
        let off = (told / cycles - 1.0).abs();
        assert!(off < 0.3, "{scene} on {target}: {told:e}, not {cycles:e}");
    }
}

/// Little is run whole, so nothing is guessed; on the Hack's processor, too.
#[test]
fn what_is_quick_is_known_to_the_cycle() {
    let scene = "image 64 x 24 inks black, white;
draw (x, y) = threshold(0.1 + x / 80, bayer(4)[x mod 4, y mod 4]);\n";
    let dir = directory(&[("ramp.scn", scene)]);
    for more in [
        &["-t", "6502:plain"][..],
        &["-t", "bbc:micro"],
        &["-t", "jack"],
        &["-t", "jack", "--os", "jack"],
    ] {
        let of = |command: &str| {
            json(
                dir.path(),
                &[&[command, "ramp.scn", "--json"], more].concat(),
            )
        };
        let (built, run) = (of("build"), of("run"));
        for figure in ["cycles", "machine_seconds"] {
            let told = [&built, &run].map(|json| json[figure].as_f64().expect(figure));
            assert_eq!(told[0], told[1], "{more:?}: {figure}");
        }
        assert!(built["rows_run"].is_null(), "{more:?}");
    }
}
