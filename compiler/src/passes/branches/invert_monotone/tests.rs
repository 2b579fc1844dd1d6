//! The comparisons give the ink that the steps give.
#![allow(clippy::unwrap_used)]

use super::invert_monotone;
use crate::analysis::range::{Slack, ranges};
use crate::analysis::rate::{Dependence, rates};
use crate::analysis::verify::verify;
use crate::eval::native::Native;
use crate::eval::random_graphs;
use crate::ir::graph::*;
use crate::passes::simplify::fold::fold;
use crate::scene;
use crate::schedule::statements::schedule;
use crate::sema::Options;
use crate::source::Span;
use crate::targets::find;
use slowlight_routine::{Op, Type, Value};

/// A graph before and after the pass, if it does anything.
fn both(source: &str) -> (Graph, Option<Graph>) {
    let scene = scene::check("test", source);
    assert!(scene.is_right(), "{source}: {:?}", scene.diagnostics);
    let graph = fold(&scene.lower(&Options::default()).unwrap());
    let ranges = ranges(&graph, &schedule(&graph), &Slack::exact());
    let runtime = find("bbc:micro").unwrap().runtime;
    let after = invert_monotone(&graph, &ranges, runtime);
    (graph, after.map(|g| fold(&g)))
}

fn scene_of(inks: &str, dither: &str, shade: &str) -> String {
    format!(
        "image 61 x 47 inks {inks};\n\
         const cells = [0, 24, 6, 30; 36, 12, 42, 18; 9, 33, 3, 27; 45, 21, 39, 15];\n\
         dither d(v: real, x: int, y: int) -> ink = {dither};\n\
         draw (x, y) = d({shade}, x, y);\n"
    )
}

const FOUR: &str = "black, red, yellow, white";

#[test]
fn every_pixel_keeps_its_ink() {
    let shade = "(x * 31 + y * 17) mod 97 / 90";
    for (inks, dither) in [
        (
            FOUR,
            "ink(inks - 1 - floor(16 * (inks - 1) * sqrt(v) + cells[x mod 4, (247 - y) mod 4] / 3) div 16)",
        ),
        (FOUR, "ink(floor(3.99 * v + cells[x mod 4, y mod 4] / 48))"),
        (FOUR, "ink(round((1 - v) * 3 / 1.1))"),
        (FOUR, "ink(floor(sqrt(max(v, 0.1) * 12 + (x mod 4)) - 0.5))"),
        (
            "black, white",
            "ink(floor(0 - (clamp(v, 0, 1) * 0.9 - (x mod 8) / 8)) + 1)",
        ),
    ] {
        let (before, after) = both(&scene_of(inks, dither, shade));
        let after = after.unwrap_or_else(|| panic!("{dither} is left alone"));
        let [mut old, mut new] = [&before, &after].map(Native::new);
        let mut seen = std::collections::BTreeSet::new();
        for (x, y) in (0..47).flat_map(|y| (0..61).map(move |x| (x, y))) {
            let [is, was] = [new.pixel(x, y).ink, old.pixel(x, y).ink];
            assert_eq!(is, was, "{dither} at {x}, {y}");
            seen.insert(is);
        }
        assert!(seen.len() > 1, "{dither}: one ink everywhere");
    }
}

/// Bisection finds the first real of a step to its last bit.
#[test]
fn thresholds_are_exact() {
    let (_, after) = both(&scene_of(
        "black, white",
        "ink(floor(sqrt(v) * 3 - 0.1))",
        "x / 30",
    ));
    let after = after.unwrap();
    let compared = after.ids().find_map(|id| match after.node(id) {
        Node::Apply(slowlight_routine::Op::Less, [_, t]) => after.constant(t),
        _ => None,
    });
    let t = compared.unwrap().real();
    // What is compared is x, before it is divided.
    let ink = |x: f64| ((x / 30.0).sqrt() * 3.0 - 0.1).floor();
    assert_eq!((ink(t), ink(t.next_down())), (1.0, 0.0));
}

#[test]
fn what_is_not_monotone_is_left_alone() {
    for dither in [
        "ink(floor(v * 9) mod 4)",
        // Nothing to save.
        "ink(if v < 0.5 then 1 else 0)",
        "ink((x + y) mod 4)",
    ] {
        let (_, after) = both(&scene_of(FOUR, dither, "(x + y) / 90"));
        assert!(after.is_none(), "{dither}");
    }
    let spread = "{ spread v / 2 to { (1, 0): 1 }; ink(floor(sqrt(v) * 3)) }";
    assert!(both(&scene_of(FOUR, spread, "x / 60")).1.is_none());
}

/// All thresholds of a dither by a matrix are worked out from its cells, as are
/// the squares that algebra compares with; the bits stay near the entries.
#[test]
fn thresholds_are_worked_out_from_the_cells() {
    let scene = crate::scene::check("test", include_str!("../../../../../examples/mirrors.scn"));
    let target = crate::targets::find("bbc:micro").unwrap();
    let options = crate::sema::Options {
        offset: target.offset,
        ..Default::default()
    };
    let graph = scene.lower(&options).unwrap();
    let goal = crate::plan::Goal {
        name: "test".to_owned(),
        mode: crate::targets::default_mode(target, 320, 240).unwrap(),
        rows: None,
        plot: true,
    };
    let plan = crate::planner::plan(&graph, target, &goal).unwrap();
    assert!(plan.graph.tables.len() > 4);
    for (k, table) in plan.graph.tables.iter().enumerate() {
        let id = TableId(k as u32);
        assert!(plan.table(id).unwrap().recipe.is_some(), "{}", table.name);
        for (at, entry) in table.entries.iter().enumerate() {
            let (real, bits) = (entry.value().real(), plan.entry(id, at));
            let made = (plan.runtime.decode)(bits, plan.runtime.real).real();
            assert!(
                (made - real).abs() <= real.abs() / 4_194_304.0,
                "{made} for {real}"
            );
        }
    }
}

/// How many results of loops a graph's inks need that are reals.
fn real_results(graph: &Graph) -> usize {
    let shadeless = Graph {
        shade: None,
        ..graph.clone()
    };
    let reached = shadeless.reached();
    let result = |id: &NodeId| {
        let real = graph.ty(*id) == Type::Real && reached[id.0 as usize];
        real && matches!(graph.node(*id), Node::Result { .. })
    };
    graph.ids().filter(result).count()
}

/// Asserts that the pass leaves every ink as it was; answers how many loops'
/// results it made inks.
fn sunk(name: &str, before: &Graph, after: &Graph) -> usize {
    verify(after).unwrap_or_else(|broken| panic!("{name}: {broken}"));
    let [mut old, mut new] = [before, after].map(Native::new);
    let image = &before.image;
    for y in 0..image.height as i32 {
        for x in 0..image.width as i32 {
            let was = old.pixel(x, y);
            // Thresholds that nothing reaches are no further away.
            if was.shade.abs() < 1e30 {
                assert_eq!(was.ink, new.pixel(x, y).ink, "{name} at {x}, {y}");
            }
        }
    }
    real_results(before) - real_results(after)
}

/// Shades that are a loop's result, one of two loops', or neither.
#[test]
fn a_shade_is_compared_where_its_loop_ends() {
    let dither =
        "ink(inks - 1 - floor(16 * (inks - 1) * sqrt(v) + cells[x mod 4, y mod 4] / 3) div 16)";
    let loops = "fn grown(from: real, by: real) -> real = loop (v = from, n = 1) max 6 {
        if v < 1 then next(v * 1.5 + by, n + 1) else v / 3 + n / 40
      } else 0.2;\n";
    for (shade, results) in [
        ("grown(x / 90, y / 99)", 1),
        (
            "if x < 20 then grown(x / 90, 0.01) else grown(0.05, y / 70)",
            2,
        ),
        ("if x < y then x / 61 else grown(y / 50, x / 200)", 1),
        // The first step is a root already.
        ("sqrt(grown(x / 90, y / 99)) / 2", 1),
        // Something else needs the result: it stays.
        (
            "{ let g = grown(x / 90, y / 99); if g < 0.4 then g else 0.5 }",
            0,
        ),
    ] {
        let (before, after) = both(&format!("{}{loops}", scene_of(FOUR, dither, shade)));
        assert_eq!(sunk(shade, &before, &after.unwrap()), results, "{shade}");
    }
}

fn push(graph: &mut Graph, node: Node, ty: Type) -> NodeId {
    graph.nodes.push(node);
    graph.types.push(ty);
    graph.spans.push(Span::default());
    NodeId(graph.nodes.len() as u32 - 1)
}

fn apply(graph: &mut Graph, op: Op, args: &[NodeId]) -> NodeId {
    let args = [args[0], args[args.len() - 1]];
    push(graph, Node::Apply(op, args), op.result())
}

fn constant(graph: &mut Graph, value: Value) -> NodeId {
    push(graph, Node::Const(Constant::new(value)), value.ty())
}

/// A graph at random, its ink found by steps from reals that its loops end with;
/// none where it has no such loop.
fn stepping(seed: u64) -> Option<Graph> {
    let mut graph = random_graphs::graph(seed);
    let rates = rates(&graph);
    let outside = |id: NodeId| {
        let turn = |d: &Dependence| matches!(d, Dependence::Loop(_) | Dependence::Last(_));
        !rates.rate(id).iter().any(turn)
    };
    let of_type = |ty: Type| {
        let graph = &graph;
        let fits = move |id: &NodeId| graph.ty(*id) == ty && outside(*id);
        graph.ids().filter(fits)
    };
    let result = |id: &NodeId| matches!(graph.node(*id), Node::Result { .. });
    let results: Vec<NodeId> = of_type(Type::Real).filter(result).collect();
    let (first, last) = (*results.first()?, *results.last()?);
    let cond = of_type(Type::Bool).next_back()?;
    let (column, row) = (of_type(Type::Int).next_back()?, of_type(Type::Int).next()?);
    let g = &mut graph;
    let shade = match first == last {
        true => first,
        false => push(
            g,
            Node::Select {
                cond,
                yes: first,
                no: last,
            },
            Type::Real,
        ),
    };
    let [half, ten] = [0.5, 10.0].map(|n| constant(g, Value::Real(n)));
    let [low, high] = [0, 3].map(|n| constant(g, Value::Int(n)));
    let cell = push(
        g,
        Node::Lookup {
            table: TableId(0),
            column,
            row,
        },
        Type::Int,
    );
    let cell = apply(g, Op::ToReal, &[cell]);
    let cell = apply(g, Op::Div, &[cell, ten]);
    let root = apply(g, Op::Sqrt, &[shade]);
    let part = apply(g, Op::Mul, &[root, half]);
    let sum = apply(g, Op::Add, &[part, cell]);
    let whole = apply(g, Op::Floor, &[sum]);
    let above = apply(g, Op::IntMax, &[whole, low]);
    g.ink = apply(g, Op::IntMin, &[above, high]);
    g.shade = Some(shade);
    (g.diffusion.is_none()).then(|| fold(g))
}

#[test]
fn random_shades_are_compared_where_their_loops_end() {
    let (mut made, mut inks) = (0, std::collections::BTreeSet::new());
    for graph in (0..400).filter_map(stepping) {
        let found = ranges(&graph, &schedule(&graph), &Slack::exact());
        let runtime = find("bbc:micro").unwrap().runtime;
        if let Some(after) = invert_monotone(&graph, &found, runtime) {
            made += sunk("random", &graph, &fold(&after));
            let mut native = Native::new(&graph);
            inks.extend((0..71).map(|x| native.pixel(x, 2).ink));
        }
    }
    assert!(made > 50 && inks.len() > 2, "{made} {inks:?}");
}
