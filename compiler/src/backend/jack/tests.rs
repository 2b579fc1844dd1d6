#![allow(clippy::unwrap_used)]

use crate::ir::build::Builder;
use crate::ir::graph::{Axis, Graph, Image, Table};
use crate::plan::Goal;
use crate::planner::PlannedScene;
use crate::planner::plan;
use crate::scene::check;
use crate::sema::Options;
use crate::source::Span;
use crate::targets::default_mode;
use slowlight_routine::{Op, Type, Value};

fn lowered(source: &str) -> Graph {
    let scene = check("test", source);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let options = Options {
        inks: Some(2),
        offset: crate::targets::jack::JACK.offset,
        ..Options::default()
    };
    scene.lower(&options).unwrap()
}

fn planned(name: &str, graph: &Graph) -> PlannedScene {
    let mode = default_mode(
        &crate::targets::jack::JACK,
        graph.image.width,
        graph.image.height,
    )
    .unwrap();
    let goal = Goal {
        name: name.to_owned(),
        mode,
        rows: None,
        plot: true,
    };
    plan(graph, &crate::targets::jack::JACK, &goal).unwrap()
}

/// All classes, each under its name.
fn text(name: &str, graph: &Graph) -> String {
    let documents = crate::backend::emit(&planned(name, graph));
    let mut all = String::new();
    for document in documents {
        assert_eq!(document.text.lines().count(), document.lines.len());
        all += &format!("---- {}\n{}", document.name, document.text);
    }
    all
}

const GRADIENT: &str = "image 8 x 4 inks black, white;
param tilt: real = 0.25 in -1 .. 1;
const steps = [0, 1, 1];
draw (x, y) = if x * tilt < y - 1 then ink(steps[x mod 3, 0]) else ink(1);";

#[test]
fn a_small_scene_reads_well() {
    insta::assert_snapshot!(format!(
        "{GRADIENT}\n\n{}",
        text("gradient", &lowered(GRADIENT))
    ));
}

/// A loop that exchanges two values, and a table of reals, without a scene.
fn built_by_hand() -> Graph {
    let mut b = Builder::new();
    let at = Span::default();
    let x = b.axis(Axis::X, at);
    let y = b.axis(Axis::Y, at);
    let weights = b.table(Table {
        name: "weights".to_owned(),
        width: 2,
        height: 2,
        ty: Type::Real,
        entries: [0.5, -1.0, 2.0, 0.25]
            .map(|r| crate::ir::graph::Constant::new(Value::Real(r)))
            .to_vec(),
        seed: Vec::new(),
    });
    let weight = b.lookup(weights, x, y, at);
    let start = b.apply(Op::ToReal, &[x], at);
    let carried = [
        ("near".to_owned(), Type::Real, start),
        ("far".to_owned(), Type::Real, weight),
    ];
    let of = b.open_loop(5, &carried, at);
    let near = b.carried(of, 0, at);
    let far = b.carried(of, 1, at);
    let again = b.apply(Op::Less, &[near, far], at);
    let last = b.last(of, 0, at);
    let result = b.close_loop(of, again, &[far, near], &[near], &[last]);
    let bound = b.constant(Value::Real(1.5), at);
    let above = b.apply(Op::Less, &[bound, result[0]], at);
    let (zero, one) = (b.constant(Value::Int(0), at), b.constant(Value::Int(1), at));
    let ink = b.select(above, one, zero, at);
    let image = Image {
        block: (1, 1),
        width: 3,
        height: 2,
        palette: vec![[0; 3], [255; 3]],
    };
    b.finish(image, ink, None)
}

#[test]
fn loops_and_tables_read_well() {
    insta::assert_snapshot!(text("exchange", &built_by_hand()));
}

#[test]
fn only_what_is_used_is_written() {
    let source = "image 8 x 4 inks black, white; draw (x, y) = ink((x + y) mod 2);";
    let text = text("parity", &lowered(source));
    for absent in ["Float", "Int.", "class Int", "makeTables", "takeParameters"] {
        assert!(!text.contains(absent), "{absent} in {text}");
    }
}

#[test]
fn no_subroutine_is_long() {
    let sum: Vec<String> = (0..120).map(|n| format!("sqrt(x + {n})")).collect();
    let source = format!(
        "image 8 x 4 inks black, white; draw (x, y) = ink(floor({}) mod 2);",
        sum.join(" * ")
    );
    let text = text("long", &lowered(&source));
    let (mut longest, mut length) = (0, 0);
    for line in text.lines() {
        length = if line == "    }" { 0 } else { length + 1 };
        longest = longest.max(length);
    }
    assert!((40..100).contains(&longest), "{longest}");
}

#[test]
fn classes_are_named_after_the_scene() {
    let class = |name: &str| {
        let documents = crate::backend::emit(&planned(name, &built_by_hand()));
        documents[1].name.clone()
    };
    assert_eq!(class("two-mirrors"), "TwoMirrors.jack");
    assert_eq!(class("main"), "SceneMain.jack");
    assert_eq!(class("3d"), "Scene3d.jack");
    assert_eq!(class("\u{e9}"), "Scene.jack");
    assert_eq!(class("a*/\nb"), "AB.jack");
}

#[test]
fn a_dither_that_spreads_reads_well() {
    let source = "image 8 x 4 inks black, white; draw (x, y) = floyd(x / 8, x, y);";
    insta::assert_snapshot!(format!("{source}\n\n{}", text("ramp", &lowered(source))));
}
