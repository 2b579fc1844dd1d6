//! Polynomials are divided exactly; pictures stay what they are.
#![allow(clippy::unwrap_used)]

use super::extent::surely;
use super::number::Number;
use super::poly::Poly;
use crate::eval::native::Native;
use crate::ir::graph::*;
use crate::ir::tree::{Statement, walk};
use crate::plan::model::ModelRun;
use crate::plan::{Goal, Plan};
use crate::planner::{plan, plan_as_written};
use crate::scene;
use crate::sema::Options;
use crate::targets::{default_mode, find};
use slowlight_routine::{Op, Range};

fn planned(source: &str, set: &[(String, Vec<f64>)]) -> (Graph, Plan, Plan) {
    let scene = scene::check("test", source);
    assert!(scene.is_right(), "{source}: {:?}", scene.diagnostics);
    let target = find("bbc:micro").unwrap();
    let graph = scene
        .lower(&Options {
            offset: target.offset,
            set: set.to_vec(),
            ..Options::default()
        })
        .unwrap();
    let goal = Goal {
        name: "test".to_owned(),
        mode: default_mode(target, graph.image.width, graph.image.height).unwrap(),
        rows: None,
        plot: true,
    };
    let [fast, written] = [plan, plan_as_written].map(|p| p(&graph, target, &goal).unwrap().plan);
    (graph, fast, written)
}

/// Whether every pixel takes a root.
fn always_roots(plan: &Plan) -> bool {
    let root = |id| matches!(plan.graph.node(id), Node::Apply(Op::Sqrt, _));
    (plan.tree.pixel.iter()).any(|s| matches!(s, Statement::Let(id) if root(*id)))
}

/// Pixels of every third row and column whose ink is not the native one.
fn wrong(graph: &Graph, plan: &Plan) -> usize {
    let (mut model, mut native) = (ModelRun::new(plan), Native::new(graph));
    let (width, height) = (graph.image.width as i32, graph.image.height as i32);
    let places = (0..height)
        .step_by(3)
        .flat_map(|y| (0..width).step_by(3).map(move |x| (x, y)));
    let off = places.filter(|&(x, y)| model.pixel(x, y).ink != native.pixel(x, y).ink);
    let off = off.count();
    assert_eq!(model.unset_reads(), 0);
    off
}

#[test]
fn a_product_is_divided_by_either_factor() {
    let [x, y] = [0, 1].map(Poly::atom);
    let n = |a: f64| Poly::constant(Number::of(a));
    // (x - 1.5 y + 0.1) (x^2 + y x - 3)
    let a = x
        .add(&y.scaled(Number::of(-1.5)))
        .unwrap()
        .add(&n(0.1))
        .unwrap();
    let b = x
        .mul(&x)
        .unwrap()
        .add(&y.mul(&x).unwrap())
        .unwrap()
        .add(&n(-3.0))
        .unwrap();
    let product = a.mul(&b).unwrap();
    assert_eq!(product.divided(&a, 0), Some(b.clone()));
    assert_eq!(product.divided(&b, 0), Some(a.clone()));
    let rest = product.add(&n(1.0)).unwrap();
    assert_eq!(rest.divided(&a, 0), None);
    assert_eq!(a.content(), Some(Number::of(0.1)));
}

/// Leading terms that cancel over the reals leave roundings of the coefficients' own.
#[test]
fn a_division_ends_whatever_its_coefficients_round_to() {
    let [x, y] = [0, 1].map(Poly::atom);
    for seed in 1..200 {
        let near = |k: i32| Number::of((f64::from(seed * 7 + k) / 63.0).sin() / 3.0);
        let of = |[a, b, c]: [i32; 3]| {
            let linear = x.scaled(near(b)).add(&y.scaled(near(c))).unwrap();
            let square = x.mul(&x).unwrap().scaled(near(a));
            square.add(&linear).unwrap()
        };
        let (p, by) = (of([1, 2, 3]), of([4, 5, 6]));
        let product = p.mul(&by).unwrap();
        for dividend in [
            product.clone(),
            product.add(&y).unwrap(),
            p.mul(&p).unwrap(),
        ] {
            let Some(quotient) = dividend.divided(&by, 0) else {
                continue;
            };
            let back = quotient.mul(&by).unwrap();
            let off = dividend.add(&back.scaled(Number::whole(-1))).unwrap();
            assert!(off.terms.values().all(|n| n.real().abs() < 1e-9));
        }
    }
}

#[test]
fn decimals_are_fractions() {
    assert_eq!(Number::of(0.1).mul(Number::of(30.0)), Number::whole(3));
    assert_eq!(Number::of(-2.5e-3).inverse(), Some(Number::whole(-400)));
    assert_eq!(Number::of(1.0 / 3.0), Number::Near(1.0 / 3.0));
    // What overflows a fraction is still a number.
    let large = (0..20).fold(Number::of(123456.75), |n, _| n.mul(n));
    assert!(matches!(large, Number::Near(_)));
}

/// Ten eyes, one of them inside of a sphere, none at which tiles' edges fall on whole rows: no root for what a ray misses, and
/// the native picture.
#[test]
fn two_mirrors_from_ten_places() {
    let source = include_str!("../../../../../examples/mirrors.scn").replace(
        "param eye: vec3 = (0, -0.1, 3) in (-3, -1.5, 1.5) .. (3, 2, 6);",
        "const eye = (EYE);",
    );
    let mut off = 0;
    for eye in [
        "0, -0.1, 3",
        "0.35, 0.25, 3.6",
        "-2.917, -1.437, 1.531",
        "2.917, 1.873, 5.911",
        "-0.713, 1.917, 2.237",
        "1.037, 0.971, 0.313",
        "2.931, -1.413, 5.537",
        "-2.127, 0.0631, 4.019",
        "0.123, -0.456, 1.789",
        "0.001, 0.017, 5.983",
    ] {
        let (graph, fast, written) = planned(&source.replace("EYE", eye), &[]);
        assert!(
            fast.graph.loops[0].max < written.graph.loops[0].max,
            "{eye}: no turn peeled"
        );
        off += wrong(&graph, &fast);
    }
    assert!(off <= 3, "{off} pixels are not native's");
}

/// None of the examples: a disc on a slope, a fan of bands and another dither.
const OTHER: &str = "
image 90 x 60 inks black, red, yellow, white;
const eye = (0.5, 1.25, -4);
fn look(d: vec3) -> real =
  if d.y < -0.1 then {
    let t = 1.25 / (0 - d.y);
    let p = (eye.x + t * d.x, eye.z + t * d.z);
    if p.x * p.x + p.y * p.y < 9 then 0.9 else (floor(p.x * 0.5) + floor(p.y * 0.5)) mod 2 / 2 + 0.2
  } else if dot(d, eye) * dot(d, eye) > 16 then 0.5 + d.y / 2 else d.z * d.z;
dither steps(v: real, x: int, y: int) -> ink = ink(floor(3.5 * v * v + (x * 3 + y) mod 5 / 9));
draw (x, y) = steps(look(unit(((x - 44.5) / 50, (29.5 - y) / 50, 1))), x, y);
";

#[test]
fn another_scene_keeps_its_picture_and_needs_no_root() {
    let (graph, fast, written) = planned(OTHER, &[]);
    assert!(always_roots(&written) && !always_roots(&fast));
    assert_eq!(wrong(&graph, &fast), 0);
}

/// What would lose its bits, or cost more, stays as it is.
#[test]
fn what_loses_its_bits_is_left_alone() {
    // In one sum the squares cancel; as it stands they do not.
    let source = "image 64 x 48 inks black, white;\n\
        draw (x, y) = {\n\
          let a = (x - 31.5) / 3000000 + 1;\n\
          let b = (y - 23.5) / 3000000 + 1;\n\
          ink(if (a - b) * (a - b) * (a - b) * (a + 3) < 0 then 1 else 0)\n\
        };\n";
    let (graph, fast, written) = planned(source, &[]);
    assert_eq!(wrong(&graph, &fast), wrong(&graph, &written));
}

/// A ball seen from EYE, its inks by how far it is: nothing but the hit compares what
/// has a root in it.
const BALL: &str = "
image 64 x 48 inks black, red, yellow, white;
const eye = (EYE);
fn seen(r: ray) -> int =
  if let h = sphere((0.5, 0.25, 0), 1.5).hit(r) then 1 + floor(8 * h.normal.x + 4 * h.normal.y + 20) mod 3 else 0;
draw (x, y) = ink(seen(ray(eye, unit(((x - 31.5) / 40, (23.5 - y) / 40, -1)))));
";

/// How many comparisons of what has a root in it a pixel makes.
fn rooted_comparisons(plan: &Plan) -> usize {
    let graph = &plan.graph;
    let mut rooted = vec![false; graph.nodes.len()];
    for id in graph.ids() {
        let root = matches!(graph.node(id), Node::Apply(Op::Sqrt, _));
        let any = graph.node(id).operands().any(|a| rooted[a.0 as usize]);
        rooted[id.0 as usize] = root || any;
    }
    let mut asked = 0;
    walk(&plan.tree.pixel, &mut |statement| {
        if let Statement::Let(id) = statement
            && matches!(graph.node(*id), Node::Apply(Op::Less, _))
            && rooted[id.0 as usize]
        {
            asked += 1;
        }
    });
    asked
}

/// From outside the nearer root is always ahead, unless the ball is behind.
#[test]
fn what_comes_out_the_same_everywhere_is_not_asked() {
    for (eye, outside) in [
        ("0.3, -0.1, 2.2", true),
        ("0.25, 0.75, 2", true),
        ("0.3, 0.5, 0.7", false),
    ] {
        let (graph, fast, written) = planned(&BALL.replace("EYE", eye), &[]);
        assert!(rooted_comparisons(&written) > 0, "{eye}");
        assert_eq!(rooted_comparisons(&fast) == 0, outside, "{eye}");
        assert_eq!(wrong(&graph, &fast), 0, "{eye}");
    }
}

#[test]
fn what_is_surely_above_0_is_so_by_a_margin() {
    let x = Poly::atom(0);
    let of = |_| Range::new(0.0, 10.0);
    // (x - 2)² + more
    let sure = |more: f64| {
        let square = x.mul(&x).unwrap().add(&x.scaled(Number::of(-4.0)));
        let rest = Poly::constant(Number::of(4.0 + more));
        surely(&square.unwrap().add(&rest).unwrap(), &of, 1e-3)
    };
    assert!(sure(1.0) && !sure(0.0) && !sure(-1.0));
    assert!(!sure(0.1)); // Less than a part of 144 in 1000.
    assert!(!surely(&x, &|_| Range::ALL, 1e-3));
}

#[test]
fn quotients_under_a_floor_are_exact_where_they_are_whole() {
    for draw in [
        "floor(x / 3) mod 8",
        "floor((x - 64) / 7 - y / 5) mod 8",
        "floor((x / 6) mod 5)",
        "round(x / 6) mod 8",
    ] {
        let inks = "black, red, green, yellow, blue, magenta, cyan, white";
        let source = format!("image 160 x 64 inks {inks}; draw (x, y) = ink({draw});");
        let (graph, fast, _) = planned(&source, &[]);
        assert_eq!(wrong(&graph, &fast), 0, "{draw}");
    }
}
