//! Prices depend on what the scene gives a param, not on what it is now.
#![allow(clippy::unwrap_used)]

use crate::cost::size_budget::SizeBudget;
use crate::eval::native::Native;
use crate::ir::graph::*;
use crate::planner::context::Context;
use crate::scene::check;
use crate::sema::Options;
use crate::targets::{bbc, jack, mos6502};
use slowlight_routine::Runtime;

fn graph(text: &str) -> Graph {
    let scene = check("test", text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    scene.lower(&Options::default()).unwrap()
}

fn price(graph: &Graph, runtime: &'static Runtime) -> f64 {
    let cx = Context::new(graph.clone(), runtime);
    let price = cx.price(SizeBudget::default()).of(&cx.simplified(graph));
    assert!(price.is_finite() && price > 0.0);
    price
}

/// A dear picture where t is above a half, else a cheap one.
fn scene(range: &str) -> Graph {
    graph(&format!(
        "image 64 x 48 inks black, white;
        param t: real = {} in {range};
        dither d(v: real, x: int, y: int) -> ink = ink(floor(v * 2) mod 2);
        draw (x, y) = d(if t > 0.5 then sin((x / 7 + t) * 1rad) * sqrt(y + t) else x / 64, x, y);",
        range.split_once(' ').unwrap().0,
    ))
}

#[test]
fn prices_do_not_depend_on_what_params_are_now() {
    for runtime in [
        bbc::MICRO.runtime,
        jack::JACK.runtime,
        mos6502::PLAIN.runtime,
    ] {
        let [cheap, dear] = ["0.25 .. 0.375", "0.625 .. 0.75"].map(|r| price(&scene(r), runtime));
        assert!(cheap < dear, "{}: {cheap} {dear}", runtime.name);
        let mut graph = scene("0.125 .. 0.75");
        let first = price(&graph, runtime);
        for now in [0.75, 0.5, -3.0, 1e30] {
            graph.params[0].value = now;
            assert_eq!(price(&graph, runtime), first, "{}: {now}", runtime.name);
        }
    }
}

/// So do the prices of whole scenes.
#[test]
fn nor_those_of_mirrors() {
    let mut graph = graph(include_str!("../../../examples/mirrors.scn"));
    let first = price(&graph, bbc::MICRO.runtime);
    for now in [[-3.0, -1.5, 1.5], [3.0, 2.0, 6.0]] {
        for (param, now) in graph.params.iter_mut().zip(now) {
            param.value = now;
        }
        assert_eq!(price(&graph, bbc::MICRO.runtime), first);
    }
}

/// Two loops of 65,535 turns, one in the other: a pixel takes four thousand million.
#[test]
fn a_pixel_that_hardly_ends_has_a_price() {
    let endless = graph(
        "image 32 x 32 inks black, white;
        fn inner(k: int) -> int =
          loop (j = 0) max 65535 { if j < k - 100000 then j else next(j + 1) } else 0;
        draw (x, y) = ink(loop (i = 0) max 65535 {
          if i < x - 1000 then i else next(i + 1 + inner(x * y))
        } else y);",
    );
    for runtime in [
        bbc::MICRO.runtime,
        jack::JACK.runtime,
        mos6502::PLAIN.runtime,
    ] {
        price(&endless, runtime);
    }
    let mut native = Native::within(&endless, 10_000);
    native.pixel(3, 4);
    assert!(native.spent() && native.operations() < 20_000);
}
