//! Error diffusion held against the same dithers written by hand.
#![allow(clippy::unwrap_used)]

use super::arithmetic::Exact;
use super::native::Native;
use super::run::Run;
use crate::analysis::rate::{Dependence, rates};
use crate::analysis::verify::verify;
use crate::ir::graph::*;
use crate::ir::tree::{Statement, walk};
use crate::passes::simplify::fold::fold;
use crate::plan::Goal;
use crate::plan::model::ModelRun;
use crate::planner::plan;
use crate::scene::check;
use crate::schedule::statements::{missing, schedule};
use crate::sema::Options;
use crate::targets::{TARGETS, default_mode};

const WIDTH: i32 = 40;
const HEIGHT: i32 = 24;

fn graph(draw: &str) -> Graph {
    let text = format!("image {WIDTH} x {HEIGHT} inks black, red, yellow, white;\n{draw}");
    let scene = check("scene", &text);
    assert_eq!(scene.diagnostics, []);
    let graph = scene.lower(&Options::default()).unwrap();
    verify(&graph).unwrap();
    graph
}

fn gradient(dither: &str) -> Graph {
    graph(&format!("draw (x, y) = {dither}((x + 2 * y) / 87, x, y);"))
}

/// Four inks by error diffusion, in the order that [`Diffusion`] states.
fn by_hand(shares: &[(i32, i32, f64)]) -> Vec<u8> {
    let mut received = vec![0.0; (WIDTH * HEIGHT) as usize];
    let mut inks = Vec::new();
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let shade = f64::from(x + 2 * y) / 87.0;
            let v = shade + received[(y * WIDTH + x) as usize];
            let q = (v * 3.0).round().clamp(0.0, 3.0);
            let error = v - q / 3.0;
            for &(dx, dy, weight) in shares {
                let (to_x, to_y) = (x + dx, y + dy);
                if (0..WIDTH).contains(&to_x) && to_y < HEIGHT {
                    received[(to_y * WIDTH + to_x) as usize] += error * weight;
                }
            }
            inks.push(q as u8);
        }
    }
    inks
}

fn inks(graph: &Graph) -> Vec<u8> {
    let mut native = Native::new(graph);
    let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    places.map(|(x, y)| native.pixel(x, y).ink).collect()
}

const FLOYD: [(i32, i32, f64); 4] = [
    (1, 0, 7.0 / 16.0),
    (-1, 1, 3.0 / 16.0),
    (0, 1, 5.0 / 16.0),
    (1, 1, 1.0 / 16.0),
];

#[test]
fn floyd_and_atkinson_are_what_their_papers_say() {
    let floyd = by_hand(&FLOYD);
    assert_eq!(inks(&gradient("floyd")), floyd);
    let atkinson = [(1, 0), (2, 0), (-1, 1), (0, 1), (1, 1), (0, 2)];
    let atkinson = by_hand(&atkinson.map(|(dx, dy)| (dx, dy, 0.125)));
    assert_eq!(inks(&gradient("atkinson")), atkinson);
    assert_ne!(floyd, atkinson);
    assert_ne!(floyd, by_hand(&[]));
}

#[test]
fn any_order_of_pixels_gives_the_same_picture() {
    let graph = gradient("atkinson");
    let whole = inks(&graph);
    let mut native = Native::new(&graph);
    // Far ahead, back, the same one again, outside of the picture, and on.
    for (x, y) in [
        (7, 9),
        (39, 3),
        (39, 3),
        (-1, 5),
        (0, 4),
        (12, HEIGHT),
        (5, 23),
        (0, 0),
        (1, 0),
    ] {
        let ink = native.pixel(x, y).ink;
        if (0..WIDTH).contains(&x) && (0..HEIGHT).contains(&y) {
            assert_eq!(ink, whole[(y * WIDTH + x) as usize], "({x}, {y})");
        }
    }
}

#[test]
fn the_schedule_of_a_dither_that_spreads_draws_the_same() {
    for graph in [gradient("floyd"), fold(&gradient("floyd"))] {
        verify(&graph).unwrap();
        let tree = schedule(&graph);
        assert_eq!(missing(&graph, &tree), None);
        let mut run = Run::new(&graph, &tree, Exact(&graph));
        let mut found = Vec::new();
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                found.push(run.pixel(x, y).int() as u8);
            }
        }
        assert_eq!(found, by_hand(&FLOYD));
        assert_eq!(run.unset_reads(), 0);
    }
}

#[test]
fn what_is_received_is_never_moved_out_of_the_pixel() {
    // Nothing else here depends on the pixel.
    let graph = fold(&graph("draw (x, y) = floyd(0.4, x, y);"));
    let received = graph.ids().find(|&id| graph.node(id) == Node::Received);
    let rates = rates(&graph);
    let depends = |id, on| rates.depends(id, on);
    assert!(depends(received.unwrap(), Dependence::Row));
    assert!(depends(received.unwrap(), Dependence::Column));
    for root in graph.roots() {
        assert!(depends(root, Dependence::Row) && depends(root, Dependence::Column));
    }
    let tree = schedule(&graph);
    let mut lets = 0;
    for block in [&tree.frame, &tree.row] {
        walk(block, &mut |s| {
            lets += u32::from(matches!(s, Statement::Let(_)))
        });
    }
    assert_eq!(lets, 0);
    let inks = inks(&graph);
    let mean = inks.iter().map(|&i| f64::from(i)).sum::<f64>() / inks.len() as f64;
    assert!((mean - 1.2).abs() < 0.02, "{mean}");
}

#[test]
fn a_graph_that_spreads_reads_back() {
    let printed = fold(&gradient("floyd")).to_string();
    assert!(printed.contains("received") && printed.contains("send -1 1 %"));
    let read = crate::ir::read::read(&printed).unwrap();
    verify(&read).unwrap();
    assert_eq!(read.to_string(), printed);
    assert_eq!(inks(&read), by_hand(&FLOYD));
    // Sent backwards; sent by nobody.
    for (from, to) in [("send 1 0", "send -1 0"), ("send", "effect")] {
        let wrong = crate::ir::read::read(&printed.replace(from, to));
        assert!(wrong.is_err() || verify(&wrong.unwrap()).is_err(), "{to}");
    }
}

#[test]
fn a_dither_may_end_in_one_that_spreads() {
    let graph = graph(
        "dither mine(v: real, x: int, y: int) -> ink = { let w = v; floyd(w, x, y) };
        draw (x, y) = mine((x + 2 * y) / 87, x, y);",
    );
    assert_eq!(inks(&graph), by_hand(&FLOYD));
    assert_eq!(Native::new(&graph).pixel(3, 1).shade, 5.0 / 87.0);
}

#[test]
fn the_models_of_all_targets_spread() {
    let graph = gradient("floyd");
    let native: u32 = by_hand(&FLOYD).into_iter().map(u32::from).sum();
    for target in TARGETS {
        let goal = Goal {
            name: "gradient".to_owned(),
            mode: default_mode(target, WIDTH as u32, HEIGHT as u32).unwrap(),
            rows: None,
            plot: true,
        };
        let plan = plan(&graph, target, &goal).unwrap();
        let mut model = ModelRun::new(&plan);
        let mut sum = 0;
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                sum += u32::from(model.pixel(x, y).ink);
            }
        }
        assert_eq!(model.unset_reads(), 0);
        // Formats differ, the picture's brightness hardly.
        assert!(
            sum.abs_diff(native) * 50 < native,
            "{}: {sum}, not {native}",
            target.name
        );
    }
}
