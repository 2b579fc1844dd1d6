//! Each rule: both sides equal over the reals, and the right one better on a machine.
#![allow(clippy::unwrap_used)]

mod cases;
mod exact;

use super::*;
use crate::analysis::range::{Slack, ranges};
use crate::passes::simplify::fold::fold;
use crate::plan::model::ModelRun;
use crate::plan::{Goal, Plan};
use crate::planner::{plan, plan_as_written};
use crate::scene;
use crate::schedule::statements::schedule;
use crate::sema::Options;
use crate::targets::{default_mode, find};
use cases::{CASES, Case};
use exact::{Big, big};
use std::collections::BTreeSet;
use std::fmt::Write;

/// A graph before and after the pass, and the rules applied.
fn both(target: &str, graph: &Graph) -> (Graph, Graph, Vec<&'static str>) {
    let slack = Slack::of(find(target).unwrap().runtime);
    let before = fold(graph);
    let (mut after, mut names) = (before.clone(), Vec::new());
    for _ in 0..4 {
        let tree = schedule(&after);
        let (next, applied) = rewritten(&after, &ranges(&after, &tree, &slack), &slack);
        if applied.is_empty() {
            break;
        }
        names.extend(applied);
        after = fold(&next);
    }
    (before, after, names)
}

fn graph(target: &str, source: &str) -> Graph {
    let scene = scene::check("test", source);
    assert!(scene.is_right(), "{source}: {:?}", scene.diagnostics);
    let options = Options {
        offset: find(target).unwrap().offset,
        ..Options::default()
    };
    scene.lower(&options).unwrap()
}

/// A scene whose shade is the case's value.
fn scene_of(case: &Case, values: &[f64]) -> String {
    let params = case.params.iter().zip(values);
    let params = params
        .map(|((name, lo, hi), v)| format!("param {name}: real = {v:?} in {lo:?} .. {hi:?};\n"));
    let params: String = params.collect();
    format!(
        "image 1 x 1 inks black, white;\n{params}\
         param pivot: real = 0 in -30000 .. 30000;\n\
         dither shown(v: real, x: int, y: int) -> ink = ink(if v < pivot then 0 else 1);\n\
         draw (i, j) = shown({}, i, j);\n",
        case.value
    )
}

fn middle(case: &Case) -> Vec<f64> {
    case.params
        .iter()
        .map(|(_, lo, hi)| (lo + hi) / 2.0)
        .collect()
}

/// Numbers in a range, the same ones every time (splitmix64).
struct Numbers(u64);

impl Numbers {
    fn within(&mut self, lo: f64, hi: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        lo + (hi - lo) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[test]
fn both_sides_are_equal_over_the_reals() {
    let tiny = big(1e-45);
    for case in CASES {
        let (before, after, names) = both(case.on, &graph(case.on, &scene_of(case, &middle(case))));
        for rule in case.rules {
            assert!(
                names.contains(rule),
                "{}: {names:?}, not {rule}",
                case.value
            );
        }
        let mut numbers = Numbers(1);
        for _ in 0..300 {
            let at = case
                .params
                .iter()
                .map(|(_, lo, hi)| numbers.within(*lo, *hi));
            let at: Vec<f64> = at.collect();
            let (left, right) = (exact::shade(&before, &at), exact::shade(&after, &at));
            let size = left.clone().max(-left.clone()).max(big(1.0));
            let off = &left - &right;
            let off = off.clone().max(-off);
            assert!(
                off <= size * &tiny,
                "{} at {at:?}: {left} and {right}",
                case.value
            );
        }
    }
}

#[test]
fn every_rule_has_a_case() {
    let rules = rules::RULES.iter().map(|r| r.name);
    let all: BTreeSet<&str> = rules.chain(sums::SUMS.iter().map(|r| r.name)).collect();
    let held: BTreeSet<&str> = CASES.iter().flat_map(|c| c.rules).copied().collect();
    assert_eq!(all, held);
    assert_eq!(all.len(), rules::RULES.len() + sums::SUMS.len());
}

/// How far a plan's shade is off, relative to the exact one for the params as
/// the machine holds them, in units of the format's last place.
fn off(plan: &Plan, exact_graph: &Graph) -> f64 {
    let runtime = plan.runtime;
    let held = plan
        .params
        .iter()
        .map(|p| (runtime.decode)(p.bits, runtime.real).real());
    let wanted: Big = exact::shade(exact_graph, &held.collect::<Vec<f64>>());
    let got = big(ModelRun::new(plan).pixel(0, 0).shade);
    let wanted_f64 = wanted.to_f64().value();
    match (got - wanted).to_f64().value().abs() {
        0.0 => 0.0,
        off => off / wanted_f64.abs() / runtime.real.epsilon(),
    }
}

/// How far the shade of a case is off as written and in the stable form.
fn offs(target: &str, case: &Case, values: &[f64]) -> (f64, f64) {
    let graph = graph(target, &scene_of(case, values));
    let target = find(target).unwrap();
    let goal = Goal {
        name: "test".to_owned(),
        mode: default_mode(target, 1, 1).unwrap(),
        rows: None,
        plot: true,
    };
    let written = plan_as_written(&graph, target, &goal).unwrap();
    let stable = plan(&graph, target, &goal).unwrap();
    (off(&written, &graph), off(&stable, &graph))
}

/// Errors of the two in units of the last place, and by how much one must be
/// less than the other to be called better.
const BETTER: f64 = 4.0;

#[test]
fn the_right_side_is_better_on_its_vectors() {
    let shown = |units: f64| match units {
        u if u > 1e6 => "over a million".to_owned(),
        u => format!("{u:.1}"),
    };
    let mut text = String::new();
    for case in CASES {
        for (id, values) in case.vectors {
            let rule = case.rules.join(", ");
            writeln!(text, "{rule}: {id}").unwrap();
            for target in ["jack", "bbc:micro", "6502:plain"] {
                let (written, stable) = offs(target, case, values);
                let least = if case.on == target {
                    stable * BETTER
                } else {
                    stable
                };
                assert!(
                    least <= written.max(BETTER) && (case.on != target || written > BETTER),
                    "{rule}: {id} on {target}: {written} -> {stable}"
                );
                let (written, stable) = (shown(written), shown(stable));
                writeln!(text, "  {target}: {written} -> {stable}").unwrap();
            }
        }
    }
    insta::assert_snapshot!(text);
}

/// What is written well keeps its plan: no rule has anything to say of it.
#[test]
fn sound_scenes_are_left_alone() {
    let scenes = [
        include_str!("../../../../../examples/mirrors.scn"),
        include_str!("../../../../../examples/torus.scn"),
        include_str!("../../../../../examples/maze.scn"),
        include_str!("../../../../../examples/primitives.scn"),
        include_str!("../../../../../examples/fog.scn"),
    ];
    for source in scenes {
        for target in ["jack", "bbc:micro", "6502:plain"] {
            let (.., names) = both(target, &graph(target, source));
            assert!(names.is_empty(), "{target}: {names:?} in {source}");
        }
    }
}

/// Side conditions that do not hold keep a rule away.
#[test]
fn what_is_not_proved_is_left_alone() {
    let unproved = [
        // No direction: b^2 - (o.o - k) is something else.
        "{ let o = (p, q, 100 + p); let d = (p, q, 1 - p); let b = dot(o, d); b * b - (dot(o, o) - 0.01) }",
        // Two directions' components make none.
        "{ let o = (p, q, 100 + p); let d = unit((p, q, 2)); let e = unit((q, p, 2)); \
           let b = dot(o, (d.x, e.y, d.z)); b * b - (dot(o, o) - 0.01) }",
        // The root may be of a negative, which counts as 0.
        "-p - sqrt(p * p - q)",
        "sqrt(p + q) - sqrt(p)",
        // A negative side.
        "sqrt(p * p + 0.01) - p",
        // a may be 0.
        "{ let d = 9 - p * q; if d < 0 then 0 else (-3 - sqrt(d)) / p }",
        // No cancellation.
        "(p + 10) * (p + 10) - q * q",
        "(p + 3) + 4",
        "log(exp(p) + exp(q))",
        // The cosine is there already.
        "(1 - cos(p * 1rad)) * cos(p * 1rad)",
    ];
    for value in unproved {
        let source = format!(
            "image 1 x 1 inks black, white;\n\
             param p: real = 0.5 in -1 .. 1;\nparam q: real = 0.5 in -1 .. 1;\n\
             draw (x, y) = threshold({value}, 0.5);\n"
        );
        let (.., names) = both("jack", &graph("jack", &source));
        assert!(names.is_empty(), "{value}: {names:?}");
    }
}
