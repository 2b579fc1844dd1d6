#![allow(clippy::unwrap_used)]

use super::*;
use crate::analysis::range::{Slack, ranges};
use crate::eval::arithmetic::Exact;
use crate::eval::drawn::{drawn, examples, grid, picture};
use crate::eval::random_graphs;
use crate::eval::run::Run;
use crate::ir::build::Builder;
use crate::passes::simplify::fold::fold;
use crate::scene::check;
use crate::schedule::statements::{schedule, schedule_in_segments, schedule_together};
use crate::sema::Options;
use slowlight_routine::{Op, Type, Value};

const AT: Span = Span {
    file: 0,
    start: 0,
    end: 0,
    within: None,
    effect: None,
};

/// Sizes with which everything that stands twice is worth a subroutine.
const EAGER: Sizes = Sizes {
    operation: 10,
    copy_bool: 1,
    copy: 1,
    home: 0,
    test: 4,
    turns: 8,
    call: 1,
    around: 1,
    ends: 0,
};

fn graph(text: &str) -> Graph {
    let scene = check("test", text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    fold(&scene.lower(&Options::default()).unwrap())
}

fn outlined(graph: &Graph, sizes: &Sizes) -> (Graph, Tree) {
    outlined_until(u64::MAX, graph, sizes)
}

fn outlined_until(enough: u64, graph: &Graph, sizes: &Sizes) -> (Graph, Tree) {
    let called = |_| Some("shape".to_owned());
    outline(
        graph,
        schedule_together(graph),
        &[],
        sizes,
        (Extent::All, enough),
        &called,
    )
}

/// No more subroutines are made than what is wanted takes: none, the one that saves most, all.
#[test]
fn what_is_saved_is_enough() {
    let mut several = 0;
    for seed in 0..100 {
        let graph = fold(&random_graphs::graph(seed));
        let count = |enough| {
            let (other, tree) = outlined_until(enough, &graph, &EAGER);
            let places = grid(7, 5, 1);
            assert_eq!(
                picture(&graph, &schedule(&graph), &places),
                picture(&other, &tree, &places),
                "seed {seed}, {enough}:\n{tree}"
            );
            tree.subroutines.len()
        };
        let all = count(u64::MAX);
        assert_eq!((count(0), count(1)), (0, all.min(1)), "seed {seed}");
        several += usize::from(all > 1);
    }
    assert!(several > 20, "{several}");
}

fn calls(block: &[Statement]) -> usize {
    let mut calls = 0;
    walk(block, &mut |s| {
        calls += usize::from(matches!(s, Statement::Call(_)));
    });
    calls
}

#[test]
fn random_graphs_draw_the_same() {
    let mut made = 0;
    for seed in 0..300 {
        let graph = fold(&random_graphs::graph(seed));
        let (other, tree) = outlined(&graph, &EAGER);
        made += tree.subroutines.len();
        let places = grid(7, 5, 1);
        assert_eq!(
            picture(&graph, &schedule(&graph), &places),
            picture(&other, &tree, &places),
            "seed {seed}:\n{tree}"
        );
    }
    assert!(made > 300, "{made}");
}

#[test]
fn what_is_done_seldom_alone_calls() {
    let mut made = 0;
    for seed in 0..300 {
        let graph = fold(&random_graphs::graph(seed));
        let plain = schedule_in_segments(&graph);
        let places = grid(7, 5, 1);
        for extent in [Extent::Rows, Extent::Runs] {
            let (other, tree) = outline(
                &graph,
                plain.clone(),
                &[],
                &EAGER,
                (extent, u64::MAX),
                &|_| None,
            );
            made += tree.subroutines.len();
            assert_eq!(calls(&tree.pixel), 0);
            assert!(extent == Extent::Runs || calls(&tree.segment) == 0);
            assert_eq!(tree.pixel, plain.pixel);
            assert_eq!(
                drawn(&graph, &plain, &places),
                drawn(&other, &tree, &places),
                "seed {seed}:\n{tree}"
            );
        }
    }
    assert!(made > 100, "{made}");
}

#[test]
fn ranges_hold_for_every_call() {
    for seed in 0..100 {
        let (graph, tree) = outlined(&fold(&random_graphs::graph(seed)), &EAGER);
        let found = ranges(&graph, &tree, &Slack::exact());
        let mut run = Run::new(&graph, &tree, Exact(&graph));
        for (x, y) in grid(7, 5, 1) {
            run.pixel(x, y);
            for id in graph.ids() {
                let (Some(value), range) = (run.last(id), found.result[id.0 as usize]) else {
                    continue;
                };
                let value = value.real();
                assert!(
                    range.contains(value),
                    "seed {seed}: {id} is {value} outside of {range:?}"
                );
            }
        }
    }
}

#[test]
fn the_examples_draw_the_same() {
    let (mut compared, mut called) = (0, 0);
    for (name, graph) in examples() {
        let plain = schedule(&graph);
        let (other, tree) = outlined(&graph, &crate::targets::mos6502::PLAIN.sizes);
        let image = &graph.image;
        let places = match graph.diffusion {
            // All pixels before one are drawn too.
            Some(_) => grid(image.width.min(9), 2, 1),
            None => grid(image.width, image.height, 61),
        };
        let (first, unset) = drawn(&graph, &plain, &places);
        let (second, more) = drawn(&other, &tree, &places);
        assert_eq!(first, second, "{name}");
        assert_eq!((unset, more), (0, 0), "{name}");
        compared += 1;
        called += usize::from(!tree.subroutines.is_empty());
    }
    assert!(compared > 20 && called > 5, "{compared} {called}");
}

const BALLS: &str = "image 32 x 32 inks black, white;
scene balls {
  sphere((0.1, 0.5, -4), 1) is 0.3;
  sphere((1.2, 0.2, -5), 0.9) is 0.5;
  sphere((-1.3, -0.7, -6), 0.8) is 0.7;
  sphere((0.4, -1.6, -7), 0.7) is 0.9;
}
draw (x, y) = {
  let r = ray((0, 0, 0), unit((x / 16 - 1, 1 - y / 16, -1)));
  let v = if let h = balls.trace(r, far: 30) then h.tag * max(h.normal.z, 0) else 0;
  threshold(v, bayer(2)[x mod 2, y mod 2])
};";

/// Instances with other constants, one after another, each with what the one
/// before it left.
#[test]
fn a_shape_is_one_subroutine() {
    let graph = graph(BALLS);
    let (other, tree) = outlined(&graph, &EAGER);
    let most = (0..tree.subroutines.len() as u32).map(|k| tree.calls(SubroutineId(k)));
    assert!(most.max().unwrap() >= 3, "{tree}");
    assert!(tree.subroutines.iter().all(|s| s.label() == "shape"));
    // Some call others.
    let nested = tree.subroutines.iter().filter(|s| calls(&s.body) > 0);
    assert!(nested.count() > 0, "{tree}");
    let places = grid(32, 32, 3);
    let plain = picture(&graph, &schedule(&graph), &places);
    assert_eq!(plain, picture(&other, &tree, &places));
    // Balls, and sky around them.
    assert!(plain.iter().any(|p| p.contains("Int(1)")));
    assert!(plain.iter().any(|p| p.contains("Int(0)")));
}

#[test]
fn what_does_not_get_smaller_stays() {
    let graph = graph(BALLS);
    let dear = Sizes {
        call: 100_000,
        ..EAGER
    };
    let plain = schedule_together(&graph);
    let (other, tree) = outline(
        &graph,
        plain.clone(),
        &[],
        &dear,
        (Extent::All, u64::MAX),
        &|_| None,
    );
    assert_eq!(tree, plain);
    assert_eq!(other, graph);
}

/// A loop that halves a start value until it is small, three times from others.
#[test]
fn a_loop_is_part_of_a_subroutine() {
    let mut b = Builder::new();
    let x = b.axis(Axis::X, AT);
    let x = b.apply(Op::ToReal, &[x], AT);
    let mut sum = b.constant(Value::Int(0), AT);
    for k in 0..3 {
        let factor = b.constant(Value::Real(2.5 + f64::from(k)), AT);
        let start = b.apply(Op::Mul, &[x, factor], AT);
        let zero = b.constant(Value::Int(0), AT);
        let carried = [
            ("v".to_owned(), Type::Real, start),
            ("n".to_owned(), Type::Int, zero),
        ];
        let of = b.open_loop(9, &carried, AT);
        let (v, n) = (b.carried(of, 0, AT), b.carried(of, 1, AT));
        let one = b.constant(Value::Real(1.0), AT);
        let half = b.constant(Value::Real(0.5), AT);
        let again = b.apply(Op::Less, &[one, v], AT);
        let smaller = b.apply(Op::Mul, &[v, half], AT);
        let step = b.constant(Value::Int(1), AT);
        let more = b.apply(Op::IntAdd, &[n, step], AT);
        let last = b.last(of, 1, AT);
        let results = b.close_loop(of, again, &[smaller, more], &[n], &[last]);
        sum = b.apply(Op::IntAdd, &[sum, results[0]], AT);
    }
    let image = Image {
        block: (1, 1),
        width: 40,
        height: 2,
        palette: vec![[0; 3]; 64],
    };
    let graph = b.finish(image, sum, None);
    let (other, tree) = outlined(&graph, &EAGER);
    let mut loops = 0;
    for block in tree.blocks() {
        walk(block, &mut |s| {
            loops += usize::from(matches!(s, Statement::Loop(_)))
        });
    }
    assert_eq!(loops, 1, "{tree}");
    let places = grid(40, 2, 1);
    let plain = picture(&graph, &schedule(&graph), &places);
    assert_eq!(plain, picture(&other, &tree, &places));
    assert_ne!(plain[1], plain[39]);
}
