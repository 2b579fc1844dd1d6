//! Scenes with the stable form defeated by hand, and scenes without fault.
#![allow(clippy::unwrap_used)]

use super::fragile::fragile;
use super::words::warnings;
use crate::eval::native::Native;
use crate::ir::graph::Graph;
use crate::plan::model::ModelRun;
use crate::plan::{Goal, Plan};
use crate::planner::{plan, plan_as_written};
use crate::scene::{self, Scene};
use crate::sema::Options;
use crate::source::Diagnostic;
use crate::targets::{Target, default_mode, find, in_all_formats};

fn said(target: &str, scene: &Scene) -> Vec<Diagnostic> {
    said_of(find(target).unwrap(), scene)
}

fn said_of(target: &'static Target, scene: &Scene) -> Vec<Diagnostic> {
    let options = Options {
        offset: target.offset,
        ..Options::default()
    };
    let graph = scene.lower(&options).unwrap();
    let plan = plan_as_written(&graph, target, &goal(target, &graph)).unwrap();
    warnings(&plan, &fragile(&plan))
}

fn goal(target: &Target, graph: &Graph) -> Goal {
    Goal {
        name: "test".to_owned(),
        mode: default_mode(target, graph.image.width, graph.image.height).unwrap(),
        rows: None,
        plot: true,
    }
}

/// On how many pixels the model's ink is not the native one.
fn wrong_inks(plan: &Plan, graph: &Graph) -> usize {
    let (mut native, mut model) = (Native::new(graph), ModelRun::new(plan));
    let mut wrong = 0;
    for y in 0..graph.image.height as i32 {
        for x in 0..graph.image.width as i32 {
            wrong += usize::from(native.pixel(x, y).ink != model.pixel(x, y).ink);
        }
    }
    wrong
}

/// The stable forms mend what is warned of where a rule knows it.
#[test]
fn stable_forms_mend_pictures() {
    let cured = ["huge_floor", "far_sphere", "smooth_exp", "sliver"];
    let mut text = String::new();
    for (name, source, targets) in DEFEATED.iter().filter(|d| cured.contains(&d.0)) {
        let scene = scene::check(name, source);
        for target_name in *targets {
            let target = find(target_name).unwrap();
            let options = Options {
                offset: target.offset,
                ..Options::default()
            };
            let graph = scene.lower(&options).unwrap();
            let goal = goal(target, &graph);
            let written = wrong_inks(&plan_as_written(&graph, target, &goal).unwrap(), &graph);
            let stable = wrong_inks(&plan(&graph, target, &goal).unwrap(), &graph);
            text += &format!(
                "{name} on {target_name}: {written} wrong pixels, {stable} with stable forms\n"
            );
            // 16.16 holds neither the square of 1000 nor a direction's small parts.
            let fixed = target.runtime.real.is_fixed();
            let least = if fixed { stable + 1 } else { stable * 4 };
            assert!(least <= written, "{text}");
        }
    }
    insta::assert_snapshot!(text);
}

/// A square beyond all formats whose ends are near, and what is made of it.
#[test]
fn formats_with_near_ends_say_where_a_value_leaves_them() {
    let source = "image 64 x 64 inks black, white;
draw (x, y) = {
  let a = (x + 1.0) * 1000.0;
  let v = a * a / 4000000000.0; // too large, and too small
  threshold(v, bayer(4)[x mod 4, y mod 4])
};";
    let scene = scene::check("ends", source);
    for target in in_all_formats().filter(|t| t.name == "jack") {
        let found = said_of(target, &scene);
        let format = target.runtime.format;
        let ends = ["log10", "fixed16"].contains(&format);
        let leaves = |d: &Diagnostic| {
            let said = d.message.contains("leaves") && d.message.contains(format);
            said && line(&scene, d).contains("too large")
        };
        assert_eq!(found.iter().any(leaves), ends, "{format}: {found:?}");
        assert!(ends || found.is_empty(), "{format}: {found:?}");
    }
}

/// The gradient of a box's distance next to it is that of a length whose squares
/// are less than a unit in the last place.
#[test]
fn a_boxs_distance_has_a_slope_next_to_it_in_fixed_point() {
    let source = "image 16 x 16 inks black, grey, silver, white;
        shape bent(a: shape) { dist(p) = a.dist(p); }
        draw (x, y) = {
          let n = bent(box((-1, -1, -1), (1, 1, 1))).normal((1 + (y + 1) / 4096, x / 16, 0.5));
          threshold(0.7 * n.x, 0.5)
        };";
    let scene = scene::check("box", source);
    let target = find("6502:plain").unwrap();
    let options = Options {
        offset: target.offset,
        floats: false,
        mantissas: false,
        ..Options::default()
    };
    let graph = scene.lower(&options).unwrap();
    let plan = plan(&graph, target, &goal(target, &graph)).unwrap();
    assert_eq!(wrong_inks(&plan, &graph), 0);
}

/// Dithers whose steps are met exactly by numbers that every format holds: behind 1 - d,
/// at it, and as the shade falls.
#[test]
fn what_is_exact_in_a_format_is_dithered_as_natively() {
    let dithers = [
        "threshold(v, d)",
        "ink(floor(v + d))",
        "ink(1 - floor(v + d))",
        "ink(ceil(v * 3 + d) - 1)",
    ];
    for (dither, v) in dithers
        .into_iter()
        .flat_map(|d| [(d, 0.5), (d, 0.25), (d, 0.875)])
    {
        let source = format!(
            "image 16 x 16 inks black, red, yellow, white;
             param v: real = {v} in 0 .. 1;
             fn dithered(v: real, d: real) -> ink = {dither};
             draw (x, y) = dithered(v, bayer(4)[x mod 4, y mod 4]);"
        )
        .replace(
            "black, red, yellow, white",
            if dither.contains('3') {
                "black, red, yellow, white"
            } else {
                "black, white"
            },
        );
        let scene = scene::check("ties", &source);
        assert!(scene.is_right(), "{:?}", scene.diagnostics);
        for target in in_all_formats().filter(|t| !t.runtime.format.starts_with("log")) {
            let options = Options {
                offset: target.offset,
                ..Options::default()
            };
            let graph = scene.lower(&options).unwrap();
            let plan = plan(&graph, target, &goal(target, &graph)).unwrap();
            let (name, format) = (target.name, target.runtime.format);
            assert_eq!(
                wrong_inks(&plan, &graph),
                0,
                "{dither} of {v}: {name} {format}"
            );
            let shade = ModelRun::new(&plan).pixel(3, 3).shade;
            assert_eq!(shade, v, "{dither} of {v}: {name} {format}");
        }
    }
}

/// The shade that a plan computes for the sake of its error has the range that it takes, and
/// not what its comparison with a threshold needs.
#[test]
fn a_shade_that_no_ink_needs_is_as_the_format_has_it() {
    for (shade, most) in [("v", 1.5), ("v - 2", 2.0), ("3 * v * v - 4", 4.0)] {
        let source = format!(
            "image 24 x 8 inks black, white;
             param k: real = 1 in 0.5 .. 1;
             draw (x, y) = {{
               let v = log(1 + k * (x + 1) / 10) / log(4 - k * x / 25);
               threshold({shade} + 0.001 * y, 40)
             }};"
        );
        let scene = scene::check("shades", &source);
        assert!(scene.is_right(), "{:?}", scene.diagnostics);
        for target in in_all_formats() {
            let options = Options {
                offset: target.offset,
                ..Options::default()
            };
            let graph = scene.lower(&options).unwrap();
            let plan = plan(&graph, target, &goal(target, &graph)).unwrap();
            let shaded = plan.shaded();
            let shaded = shaded.as_ref().unwrap_or(&plan);
            let (mut native, mut model) = (Native::new(&graph), ModelRun::new(shaded));
            // Some places of bytes, which `fixed12` may choose.
            let near = most / 32.0;
            for x in 0..24 {
                let (is, should) = (model.pixel(x, 3).shade, native.pixel(x, 3).shade);
                let format = target.runtime.format;
                assert!(
                    (is - should).abs() < near,
                    "{shade} in {format}: {is} for {should}"
                );
            }
        }
    }
}

/// The line of a warning, as the scene has it.
fn line<'s>(scene: &'s Scene, said: &Diagnostic) -> &'s str {
    let file = &scene.sources.files[said.span.file as usize];
    let at = said.span.start as usize;
    let from = file.text[..at].rfind('\n').map_or(0, |k| k + 1);
    file.text[from..].lines().next().unwrap_or_default()
}

/// Each scene marks the lines that a warning must fall on.
const DEFEATED: &[(&str, &str, &[&str])] = &[
    (
        "huge_floor",
        include_str!("../../../tests/fragile/huge_floor.scn"),
        &["jack", "6502:plain"],
    ),
    (
        "far_sphere",
        include_str!("../../../tests/fragile/far_sphere.scn"),
        &["jack", "6502:plain"],
    ),
    (
        "horizon",
        include_str!("../../../tests/fragile/horizon.scn"),
        &["jack", "6502:plain"],
    ),
    (
        "facing_mirrors",
        include_str!("../../../tests/fragile/facing_mirrors.scn"),
        &["jack", "6502:plain"],
    ),
    (
        "straight_down",
        include_str!("../../../tests/fragile/straight_down.scn"),
        &["jack", "bbc:micro", "6502:plain"],
    ),
    (
        "smooth_exp",
        include_str!("../../../tests/fragile/smooth_exp.scn"),
        &["bbc:micro"],
    ),
    (
        "sliver",
        include_str!("../../../tests/fragile/sliver.scn"),
        &["jack", "6502:plain"],
    ),
    (
        "tangent_spheres",
        include_str!("../../../tests/fragile/tangent_spheres.scn"),
        &["jack", "6502:plain"],
    ),
    (
        "edge_torus",
        include_str!("../../../tests/fragile/edge_torus.scn"),
        &["jack", "6502:plain"],
    ),
    (
        "axis_maze",
        include_str!("../../../tests/fragile/axis_maze.scn"),
        &["jack", "bbc:micro", "6502:plain"],
    ),
    (
        "axis_walk",
        include_str!("../../../tests/fragile/axis_walk.scn"),
        &["jack"],
    ),
    (
        "near_sines",
        include_str!("../../../tests/fragile/near_sines.scn"),
        &["jack", "6502:plain"],
    ),
    (
        "dither_tie",
        include_str!("../../../tests/fragile/dither_tie.scn"),
        &["bbc:micro", "6502:plain"],
    ),
];

#[test]
fn a_defeated_form_is_found_on_its_line() {
    let mut text = String::new();
    for (name, source, targets) in DEFEATED {
        let scene = scene::check(name, source);
        assert!(scene.is_right(), "{name}: {:?}", scene.diagnostics);
        for target in *targets {
            let all = said(target, &scene);
            let first = all
                .first()
                .unwrap_or_else(|| panic!("{name} on {target}: nothing said"));
            let place = line(&scene, first);
            assert!(
                place.contains("// weak"),
                "{name} on {target}: {} at {place}",
                first.message
            );
            text += &format!("{name} on {target}: {}\n", first.message);
        }
    }
    insta::assert_snapshot!(text);
}

#[test]
fn sound_scenes_get_a_word_on_ties_at_most() {
    let scenes = [
        ("mirrors", include_str!("../../../examples/mirrors.scn")),
        ("torus", include_str!("../../../examples/torus.scn")),
        ("maze", include_str!("../../../examples/maze.scn")),
        (
            "primitives",
            include_str!("../../../examples/primitives.scn"),
        ),
    ];
    for (name, source) in scenes {
        let scene = scene::check(name, source);
        for target in ["jack", "bbc:micro", "6502:plain"] {
            for word in said(target, &scene) {
                assert!(
                    word.message.starts_with("a tie"),
                    "{name} on {target}: {}",
                    word.message
                );
            }
        }
    }
}
