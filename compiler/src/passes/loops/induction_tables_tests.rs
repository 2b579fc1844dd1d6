//! What hangs on counters alone is read from tables, counted loops stand turn by turn, and
//! pictures stay as they are.
#![allow(clippy::unwrap_used)]

use super::{ENTRY, counted, induction_tables, tables_of_ints};
use crate::analysis::verify::verify;
use crate::eval::drawn::{grid, picture};
use crate::eval::random_graphs;
use crate::ir::graph::*;
use crate::passes::loops::unroll::unroll;
use crate::passes::simplify::fold::fold;
use crate::scene::check;
use crate::schedule::statements::schedule;
use crate::sema::Options;
use slowlight_routine::Value;

/// A picture whose shade is this.
fn scene(shade: &str) -> Graph {
    let text = format!(
        "image 9 x 5 inks black, grey, white;
        param push: real = 0.25 in 0 .. 1;
        const places = [0.9, 0.2; -0.6, 0.6; 0.1, -0.5; -0.4, -0.3; 0.5, 0.7];
        draw (x, y) = threshold({shade}, 0.5);"
    );
    let scene = check("counted", &text);
    assert!(scene.is_right(), "{shade}: {:?}", scene.diagnostics);
    fold(&scene.lower(&Options::default()).unwrap())
}

fn draws_the_same(graph: &Graph, other: &Graph, what: &str) {
    let places = grid(9, 5, 1);
    verify(other).unwrap_or_else(|broken| panic!("{what}: {broken}"));
    let (plain, tree) = (picture(graph, &schedule(graph), &places), schedule(other));
    assert_eq!(plain, picture(other, &tree, &places), "{what}:\n{tree}");
}

/// How many loops outputs reach.
fn loops(graph: &Graph) -> usize {
    let reached = graph.reached();
    let of = |id: NodeId| match graph.node(id) {
        Node::Result { of, .. } if reached[id.0 as usize] => Some(of),
        _ => None,
    };
    let all: std::collections::BTreeSet<LoopId> = graph.ids().filter_map(of).collect();
    all.len()
}

/// Shades with loops, how many tables these have then, and how many loops where the counted
/// ones are unrolled.
const SHADES: [(&str, usize, usize); 9] = [
    // A sine of the counter; with the param, nothing to be looked up.
    ("loop (k = 0, s = 0.0) max 9 { if k == 5 then s else next(k + 1, s + sin((k + 0.5) * 1rad) * x / 9) } else s", 1, 0),
    ("loop (k = 0, s = 0.0) max 9 { if k == 5 then s else next(k + 1, s + sin((k + push) * 1rad) * x / 9) } else s", 0, 0),
    // All turns that there may be, then what the last one gave.
    ("loop (k = 0, s = 0.0) max 5 { if s > 1000 then s else next(k + 1, s + exp(-k) * y / 5) } else s / 2", 1, 1),
    ("loop (k = 0, s = 0.0) max 5 { if k == 7 then s else next(k + 1, s + exp(-k) * y / 5) } else s / 2", 1, 0),
    // Back, and from elsewhere than 0.
    ("loop (k = 4, s = 0.0) max 9 { if k < 0 then s else next(k - 1, s + places[1, k] * places[0, k] * x) } else s", 1, 0),
    ("loop (k = 2, s = 0.0) max 9 { if k == 5 then s else next(k + 1, s + sqrt(k) * x) } else s", 1, 0),
    // By twos, or by what a pixel says: no counter.
    ("loop (k = 0, s = 0.0) max 9 { if k >= 8 then s else next(k + 2, s + sin(k * 1rad) * x / 9) } else s", 0, 1),
    ("loop (k = x, s = 0.0) max 9 { if k > 12 then s else next(k + 1, s + sin(k * 1rad) / 9) } else s", 0, 1),
    // Two counters.
    ("loop (k = 0, s = 0.0) max 4 { if k == 3 then s else {
        let t = loop (j = 0, t = s) max 5 { if j == 4 then t else next(j + 1, t + sin((j * 4 + k) * 1rad) * x / 9) } else t; next(k + 1, t) } } else s", 1, 1),
];

#[test]
fn what_hangs_on_counters_is_looked_up_and_draws_the_same() {
    for (shade, tables, _) in SHADES {
        let graph = scene(shade);
        for worth in [2 * ENTRY, 4 * ENTRY] {
            let other = induction_tables(&graph, worth).map(|graph| fold(&graph));
            let more = other.as_ref().map_or(0, |other| {
                draws_the_same(&graph, other, shade);
                let by_turn = |t: &&Table| t.name != "places";
                other.tables.iter().filter(by_turn).count()
            });
            // A root alone is not worth a table where memory is short.
            let short = worth > 2 * ENTRY && shade.contains("sqrt");
            assert_eq!(more, if short { 0 } else { tables }, "{shade}, {worth}");
        }
    }
}

#[test]
fn counted_loops_are_unrolled_and_draw_the_same() {
    for (shade, _, left) in SHADES {
        let graph = scene(shade);
        let other = unroll(&graph).map(|graph| fold(&graph));
        let other = other.unwrap_or_else(|| graph.clone());
        draws_the_same(&graph, &other, shade);
        assert_eq!(loops(&other), left, "{shade}");
    }
}

#[test]
fn graphs_at_random_draw_the_same() {
    let (mut tables, mut loops) = (0, 0);
    for seed in 0..600 {
        let graph = fold(&random_graphs::counted(seed));
        if let Some(other) = induction_tables(&graph, 2 * ENTRY) {
            draws_the_same(&graph, &other, &format!("tables of {seed}"));
            tables += 1;
        }
        if let Some(other) = unroll(&graph) {
            draws_the_same(&graph, &other, &format!("loops of {seed}"));
            loops += counted(&graph).len();
        }
    }
    assert!(tables > 20 && loops > 20, "{tables} {loops}");
}

#[test]
fn a_sum_of_an_entry_is_computed_where_memory_is_short() {
    let graph = scene(
        "loop (k = 0, s = 0.0, t = 0.0) max 40 { if k == 39 then s + t else { let c = sin(k * 1rad); next(k + 1, s + c * x, t + (c - 0.25) * y) } } else s",
    );
    let tables = |worth| induction_tables(&graph, worth).map(|graph| fold(&graph).tables.len());
    assert_eq!((tables(2 * ENTRY), tables(4 * ENTRY)), (Some(2), Some(1)));
}

#[test]
fn tables_hold_what_turns_compute() {
    let graph = scene(
        "loop (k = 0, s = 0.0) max 9 { if k == 5 then s else next(k + 1, s + sin((k + 0.5) * 1rad) * x / 9) } else s",
    );
    let made = fold(&induction_tables(&graph, 2 * ENTRY).unwrap());
    let table = made.tables.iter().find(|t| t.name != "places").unwrap();
    let sines = (0..6).map(|k| Constant::new(Value::Real(libm::sin(f64::from(k) + 0.5))));
    assert_eq!(table.entries, sines.collect::<Vec<_>>());
}

#[test]
fn sines_of_rounded_ints_are_looked_up_and_draw_the_same() {
    // As many values as the range has that is known of what is rounded: 13, and any.
    for (shade, expected) in [
        (
            "sin(round(6 * max(min(x / 4 - 1, 1), -1)) * 1rad)",
            Some(13),
        ),
        ("sin(round(exp(x)) * 1rad)", None),
    ] {
        let graph = scene(shade);
        let slack = crate::analysis::range::Slack::of(crate::targets::bbc::MICRO.runtime);
        let ranges = crate::analysis::range::ranges(&graph, &schedule(&graph), &slack);
        let other = tables_of_ints(&graph, &ranges, (4 * ENTRY, false)).map(|graph| fold(&graph));
        let entries = other.as_ref().map(|other| {
            draws_the_same(&graph, other, shade);
            other.tables.iter().map(|t| t.entries.len()).max().unwrap()
        });
        assert_eq!(entries, expected, "{shade}");
    }
}
