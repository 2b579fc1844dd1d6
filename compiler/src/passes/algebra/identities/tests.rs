//! Values that follow from others in ways nobody wrote down are found, and are
//! what they were.
#![allow(clippy::unwrap_used)]

use super::{Cheaper, around, identities};
use crate::eval::native::Native;
use crate::eval::random_graphs;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::Verdicts;
use crate::planner::context::Context;
use crate::scene;
use crate::schedule::analysed::Analysed;
use crate::sema::Options;
use crate::targets::find;
use slowlight_routine::Op;

fn settled(graph: &Graph) -> Analysed {
    let runtime = find("bbc:micro").unwrap().runtime;
    Context::new(graph.clone(), runtime).simplified(graph)
}

fn found(plain: &Analysed) -> Option<Cheaper> {
    let runtime = find("bbc:micro").unwrap().runtime;
    let all = |_| true;
    identities(
        &plain.graph,
        &plain.ranges,
        runtime,
        &all,
        &Verdicts::default(),
    )
}

fn lowered(source: &str) -> Graph {
    let scene = scene::check("test", source);
    assert!(scene.is_right(), "{source}: {:?}", scene.diagnostics);
    scene.lower(&Options::default()).unwrap()
}

/// How many products pixels may need.
fn products(graph: &Graph) -> usize {
    let reached = graph.reached();
    let product = |id: &NodeId| matches!(graph.node(*id), Node::Apply(Op::Mul | Op::Div, _));
    graph
        .ids()
        .filter(|id| reached[id.0 as usize] && product(id))
        .count()
}

fn same(a: &Graph, b: &Graph) {
    let (mut a, mut b) = (Native::new(a), Native::new(b));
    for y in (0..24).step_by(3) {
        for x in (0..32).step_by(2) {
            assert_eq!(a.pixel(x, y).ink, b.pixel(x, y).ink, "at {x}, {y}");
        }
    }
}

/// A ray's reflection d' = d - 2 (d.n) n by n, the root of whose length is given,
/// and d'.n compared.
fn reflected(length: &str) -> Graph {
    lowered(&format!(
        "image 32 x 24 inks black, white;
         draw (x, y) = ink({{
           let a = (x - 15.5) / 40;
           let b = (y - 11.5) / 40;
           let c = sqrt({length} - a * a - b * b);
           let dot = a * 0.3 + b * 0.5 + c;
           let p = 0.3 - 2 * dot * a;
           let q = 0.5 - 2 * dot * b;
           let r = 1 - 2 * dot * c;
           if p * q * r > -0.1 and a * p + b * q + c * r < -0.9 then 1 else 0
         }});"
    ))
}

#[test]
fn a_reflected_ray_has_of_a_normal_what_the_ray_had() {
    // With n a unit vector d'.n is -d.n.
    let plain = settled(&reflected("1"));
    let cheaper = found(&plain).expect("d'.n is -d.n");
    assert!(products(&cheaper.graph) + 3 <= products(&plain.graph));
    same(&plain.graph, &cheaper.graph);
}

#[test]
fn what_does_not_follow_is_not_found() {
    // A little too long to be a unit vector.
    let plain = settled(&reflected("1.001"));
    let left = found(&plain).map_or(products(&plain.graph), |c| products(&c.graph));
    assert!(left + 3 > products(&plain.graph));
}

#[test]
fn what_needs_a_roots_sign_is_not_found() {
    // Over the reals t is 3 s. In the field it is 3 s or -3 s, by which roots are taken.
    let graph = lowered(
        "image 32 x 24 inks black, white;
         draw (x, y) = ink({
           let d = (x - 20.5) * (x - 20.5) + y * y + 1;
           let s = sqrt(d);
           let t = sqrt(9 * d);
           if s > 12 and (x - 15) * t * t * t > 9 then 1 else 0
         });",
    );
    let plain = settled(&graph);
    let roots = |graph: &Graph| {
        let reached = graph.reached();
        let root = |id: &NodeId| matches!(graph.node(*id), Node::Apply(Op::Sqrt, _));
        (graph.ids().filter(|id| reached[id.0 as usize]))
            .filter(root)
            .count()
    };
    assert_eq!(roots(&plain.graph), 2);
    if let Some(cheaper) = found(&plain) {
        assert_eq!(roots(&cheaper.graph), 2);
        same(&plain.graph, &cheaper.graph);
    }
}

/// A ball, and whether what is seen of it is outside of another.
fn beside(centre: &str) -> Graph {
    lowered(&format!(
        "image 32 x 24 inks black, red, white;
         fn outside(p: vec3) -> bool = dot(p - ({centre}), p - ({centre})) > 1;
         fn seen(r: ray) -> int =
           if let h = sphere((1, 0.5, -3), 1.5).hit(r) then (if outside(h.point) and dot(h.normal, (1, 2, 3)) > 0 then 1 else 2) else 0;
         draw (x, y) = ink(seen(ray((0, 0, 0), unit(((x - 15.5) / 20, (11.5 - y) / 20, -1)))));"
    ))
}

#[test]
fn a_point_of_a_ball_is_outside_of_another_that_stands_apart() {
    let runtime = find("bbc:micro").unwrap().runtime;
    let asked = |graph: &Graph| {
        let reached = graph.reached();
        let less = |id: &NodeId| matches!(graph.node(*id), Node::Apply(Op::Less, _));
        let here = graph.ids().filter(|id| reached[id.0 as usize]);
        here.filter(less).count()
    };
    // 3 from the other centre: more than both radii, where no component tells.
    // Then less, and then hardly more.
    for (centre, apart) in [
        ("-1, 2.5, -2", true),
        ("-0.5, 1.5, -2", false),
        ("1, 0.5, -5.5", false),
    ] {
        let plain = settled(&beside(centre));
        let found = around(&plain.graph, &plain.ranges, runtime);
        assert_eq!(found.is_some(), apart, "{centre}");
        if let Some(next) = found {
            assert_eq!(asked(&next) + 1, asked(&plain.graph));
            same(&plain.graph, &next);
        }
    }
}

#[test]
fn graphs_at_random_draw_what_they_drew() {
    let mut sites = 0;
    for seed in 1..400 {
        let plain = settled(&random_graphs::graph(seed));
        if let Some(cheaper) = found(&plain) {
            sites += cheaper.sites.len();
            same(&plain.graph, &cheaper.graph);
        }
    }
    assert!(sites > 0, "{sites}");
}
