//! Normals of distances whose length is 0 on the surface: no noise, natively and in fixed point.

use crate::eval::native::Native;
use crate::ir::graph::*;
use crate::plan::Goal;
use crate::plan::model::ModelRun;
use crate::planner::plan;
use crate::scene;
use crate::sema::Options;
use crate::targets::{default_mode, find};
use slowlight_routine::Value;

/// A wall as boxes have it, a prism by the distance to its outline, a capped cylinder.
const SHAPES: [&str; 3] = [
    "dist(p) = length((max(p.x, 0), 0)) + min(p.x, 0);",
    "dist(p) = { let d = (abs(p.x) - 0.7, abs(p.y) - 0.6, abs(p.z) - 0.8);
        min(max(d.x, max(d.y, d.z)), 0) + length((max(d.x, 0), max(d.y, 0), max(d.z, 0))) };",
    "dist(p) = { let d = length((p.x, 0, p.z)) - 0.6; let h = abs(p.y) - 0.7;
        min(max(d, h), 0) + length((max(d, 0), max(h, 0), 0)) };",
];

fn text(shape: &str, shade: &str) -> String {
    format!(
        "image 48 x 48 inks black, white;
        shape own() {{ {shape} bound = box((-1, -1, -1), (1, 1, 1)); }}
        scene a {{ own() is 1; }}
        draw (x, y) = {{
            let r = pinhole((4, 1.7, 0.9), at: (0, 0, 0), field: 24deg).through(x, y);
            threshold(if let h = a.trace(r, far: 10) then {shade} else 0, bayer(4)[x mod 4, y mod 4])
        }};"
    )
}

#[test]
fn lengths_that_are_0_on_a_surface_make_no_noise() {
    for shape in SHAPES {
        for target in ["6502:plain", "bbc:micro"] {
            let target = find(target).unwrap();
            let scene = scene::check("test", &text(shape, "0.7 * h.normal.x"));
            let options = |offset| Options {
                offset,
                ..Options::default()
            };
            let graph = scene.lower(&options(target.offset)).unwrap();
            let exact = scene.lower(&options(1e-9)).unwrap();
            let goal = Goal {
                name: "test".to_owned(),
                mode: default_mode(target, 48, 48).unwrap(),
                rows: None,
                plot: true,
            };
            let plan = plan(&graph, target, &goal).unwrap().plan;
            let (mut model, mut native) = (ModelRun::new(&plan), Native::new(&exact));
            let all = (0..48).flat_map(|y| (0..48).map(move |x| (x, y)));
            let off = all.filter(|&(x, y)| model.pixel(x, y).ink != native.pixel(x, y).ink);
            let off = off.count();
            assert!(off <= 23, "{shape} on {}: {off} of 2304", target.name);
        }
    }
}

#[test]
fn normals_of_flat_faces_are_the_faces() {
    let scene = scene::check(
        "test",
        &text(SHAPES[0], "if h.normal.x > 0.9999 then 1 else 0"),
    );
    let graph = scene.lower(&Options::default()).unwrap();
    let mut native = Native::new(&graph);
    let lit = (0..48 * 48).filter(|k| native.pixel(k % 48, k / 48).ink == 1);
    // A third of the picture is the wall.
    assert!(lit.count() > 700);
}

/// Whether a shape's normal is made of differences of its distance, over four times how far apart.
fn is_by_differences(dist: &str) -> bool {
    let shape = format!("dist(p) = {dist};");
    let scene = scene::check("test", &text(&shape, "h.normal.x"));
    assert!(scene.is_right(), "{dist}: {:?}", scene.diagnostics);
    let options = Options {
        offset: 0.003,
        ..Options::default()
    };
    let graph = scene.lower(&options).unwrap();
    let apart = Constant::new(Value::Real(1.0 / (4.0 * 0.006)));
    graph.nodes.contains(&Node::Const(apart))
}

#[test]
fn only_lengths_that_may_be_0_on_the_surface_are_differences() {
    let length = "length((max(p.x, 0), max(p.y, 0), max(p.z, 0)))";
    let inner = "min(max(p.x, max(p.y, p.z)), 0)";
    for dist in [
        format!("{length} + {inner}"),
        format!("{inner} + {length}"),
        format!("max({length}, p.y - 0.5)"),
        format!("2 * {length} + p.x * 0.1"),
    ] {
        assert!(is_by_differences(&dist), "{dist}");
    }
    for dist in [
        format!("{length} - 0.3"),
        format!("{length} + {inner} - 0.1"),
        format!("min({length} - 0.2, p.y)"),
        format!("0.5 * ({length} - 0.2)"),
        "length(p - (0, clamp(p.y, -0.5, 0.5), 0)) - 0.2".to_owned(),
        "length((p.x, p.y, p.z)) - 0.8".to_owned(),
    ] {
        assert!(!is_by_differences(&dist), "{dist}");
    }
}
