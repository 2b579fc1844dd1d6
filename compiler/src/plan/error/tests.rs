//! The bounds against what is measured: the library's closed formulas, on boxes
//! of inputs, in every format.

#![allow(clippy::unwrap_used)]

mod boxes;

use super::*;
use crate::eval::native::Native;
use crate::eval::random::Random;
use crate::plan::Goal;
use crate::plan::model::ModelRun;
use crate::planner::plan_as_written;
use crate::scene;
use crate::sema::Options;
use crate::targets::{Target, default_mode, in_all_formats};
use slowlight_routine::{Format, Value as Scalar};

/// A formula: its inputs with the ranges that boxes are taken from, and the value.
const KERNELS: &[(&str, &str, &str)] = &[
    (
        "sphere",
        "a 1 3, b -0.6 0.6, c -0.6 0.6",
        "hit_or(sphere((b, c, a), 1.5), (0.0, 0.0, 6.0), (0.0, 0.0, -1.0))",
    ),
    (
        "sphere along",
        "a 0.05 0.3, b 0.05 0.3, c 2 5",
        "hit_or(sphere((0, 0, 0), 1.5), (0, 0, c), unit((a - 0.2, b - 0.2, -1)))",
    ),
    (
        "plane",
        "a 0.5 3, b -0.9 -0.2, c -2 2",
        "hit_or(plane((0, 1, 0), -1), (c, a, 0), unit((c, b, -1)))",
    ),
    (
        "cylinder",
        "a -0.3 0.3, b -0.2 0.2, c 3 6",
        "hit_or(cylinder((0, 0, 0), (0, 1, 0), 1), (a, b, c), unit((b, a, -1)))",
    ),
    (
        "cone",
        "a -0.2 0.2, b -0.3 -0.1, c 3 5",
        "hit_or(cone((0, 2, 0), (0, -1, 0), 30deg), (a, 0.5, c), unit((a, b, -1)))",
    ),
    (
        "box",
        "a -0.4 0.4, b -0.4 0.4, c 3 6",
        "hit_or(box((-1, -1, -1), (1, 1, 1)), (a, b, c), unit((a / 8, b / 8, -1)))",
    ),
    (
        "normal",
        "a -0.4 0.4, b -0.4 0.4, c 3 5",
        "normal_or(sphere((0.1, 0, 0), 1.5), (a, b, c), unit((a / 4, b / 4, -1)))",
    ),
    (
        "torus normal",
        "a 0.8 1.2, b 0.1 0.4, c 0.1 0.6",
        "torus((0, 0, 0), 1, 0.25).normal((a, b, c)).x",
    ),
    (
        "torus distance",
        "a 1.5 3, b 0.5 1.5, c 0.5 1.5",
        "torus((0, 0, 0), 1, 0.25).dist((a, b, c))",
    ),
    (
        "reflect",
        "a 0.2 0.9, b 0.2 0.9, c 0.2 0.9",
        "reflect(unit((a, -b, c)), unit((c, a, b))).y",
    ),
    (
        "refract",
        "a 0.2 0.9, b 0.5 0.9, c 0.2 0.9",
        "refracted(unit((a, -b, c)), (0, 1, 0))",
    ),
    ("unit", "a 0.2 3, b 0.2 3, c 0.2 3", "unit((a, b, c)).x"),
    (
        "look_at",
        "a 1 3, b 1 2, c 2 4",
        "look_at((a, b, c), at: (0, 0, 0)).up.y",
    ),
    (
        "towards",
        "a -0.4 0.4, b -0.4 0.4, c 2 4",
        "look_at((1, 2, c), at: (0, 0, 0)).towards((a, b, -1)).dir.x",
    ),
    (
        "smooth_min",
        "a 0.5 0.9, b 1 1.4, c 1 2",
        "smooth_min(a, b, c)",
    ),
    ("mix", "a 0.5 0.9, b 1 1.4, c 0.1 0.9", "mix(a, b, c)"),
    ("schlick", "a 0.2 0.9, b 1.2 1.8, c 0 1", "schlick(a, b)"),
    (
        "distance of a box",
        "a 1.2 2, b 1.2 2, c 1.2 2",
        "box((-1, -1, -1), (1, 1, 1)).dist((a, b, c))",
    ),
    ("phong", "a -0.3 0.3, b 0.3 0.6, c 2 4", "lit((a, b, c))"),
];

const LIBRARY: &str = "
fn hit_or(s: shape, from: vec3, dir: vec3) -> real = if let h = s.hit(ray(from, dir)) then h.t else 0;
fn normal_or(s: shape, from: vec3, dir: vec3) -> real = if let h = s.hit(ray(from, dir)) then h.normal.x else 0;
fn refracted(d: vec3, n: vec3) -> real = if let r = refract(d, n, 1.5) then r.y else 0;
fn lit(eye: vec3) -> real = if let h = sphere((0, 0, 0), 1).hit(ray(eye, unit(-eye)))
  then phong(h, 0.7, (2, 5, 1), eye, shininess: 4) else 0;
dither shown(v: real, x: int, y: int) -> ink = ink(floor(v * 8) mod 2);
";

/// From 0 to 1.
fn part(random: &mut Random) -> f64 {
    const ALL: u64 = 1 << 40;
    random.below(ALL) as f64 / ALL as f64
}

/// The kernel as a scene of one pixel, its value the shade.
fn planned(target: &'static Target, inputs: &[(String, f64, f64)], value: &str) -> Plan {
    let params = inputs.iter().map(|(name, lo, hi)| {
        let middle = (lo + hi) / 2.0;
        format!("param {name}: real = {middle:?} in {lo:?} .. {hi:?};\n")
    });
    let params: String = params.collect();
    let text = format!(
        "image 1 x 1 inks black, white;\n{params}{LIBRARY}draw (x, y) = shown({value}, x, y);\n"
    );
    planned_as(target, &text, 1)
}

/// The plan of a scene as it is written, `size` pixels each way.
fn planned_as(target: &'static Target, text: &str, size: u32) -> Plan {
    let scene = scene::check("kernel", text);
    assert!(scene.is_right(), "{text}: {:?}", scene.diagnostics);
    let options = Options {
        offset: target.offset,
        ..Options::default()
    };
    let graph = scene.lower(&options).unwrap();
    let goal = Goal {
        name: "kernel".to_owned(),
        mode: default_mode(target, size, size).unwrap(),
        rows: None,
        plot: true,
    };
    let planned = plan_as_written(&graph, target, &goal);
    planned.unwrap_or_else(|e| panic!("{text}: {e:?}")).plan
}

fn inputs(text: &str) -> Vec<(String, f64, f64)> {
    let each = text.split(", ").map(|part| {
        let mut words = part.split(' ');
        let name = words.next().unwrap().to_owned();
        let mut number = || words.next().unwrap().parse().unwrap();
        (name, number(), number())
    });
    each.collect()
}

/// The shade natively and in the model, the params as the machine holds them.
fn shades(plan: &Plan) -> (f64, f64) {
    let native = Native::new(&plan.graph).pixel(0, 0).shade;
    (native, ModelRun::new(plan).pixel(0, 0).shade)
}

/// Bound, greatest error measured and number of evaluations of one box.
struct Tried {
    bound: f64,
    measured: f64,
    points: usize,
}

const POINTS: usize = 600;

/// One box of inputs: a thousandth of each range wide.
fn try_box(plan: &mut Plan, inputs: &[(String, f64, f64)], random: &mut Random) -> Tried {
    let spans: Vec<(f64, f64)> = inputs
        .iter()
        .map(|(_, lo, hi)| {
            let wide = (hi - lo) / 1000.0;
            let from = lo + (hi - lo - wide) * part(random);
            (from, from + wide)
        })
        .collect();
    let runtime = plan.runtime;
    let formats: Vec<Format> = (0..spans.len() as u32)
        .map(|k| plan.param_format(ParamId(k)))
        .collect();
    let held = |k: usize, v: f64| (runtime.encode)(Scalar::Real(v), formats[k]);
    let value = |k: usize, bits| (runtime.decode)(bits, formats[k]).real();
    let mut tile = Tile::of(plan, (0, 0), (0, 0));
    tile.params = spans
        .iter()
        .enumerate()
        .map(|(k, &(lo, hi))| {
            let ends = [value(k, held(k, lo)), value(k, held(k, hi))];
            (Range::new(ends[0].min(lo), ends[1].max(hi)), 0.0)
        })
        .collect();
    let shade = plan.graph.shade.unwrap();
    let made = bounds(plan, &tile);
    let found = made.of(shade);
    // What the ink makes of the shade is not the kernel's affair.
    let flips = made.undecided.iter().any(|&id| id < shade);
    let mut tried = Tried {
        bound: match found {
            Some(found) if !flips => found.error,
            _ => f64::INFINITY,
        },
        measured: 0.0,
        points: 0,
    };
    for _ in 0..POINTS {
        for (k, &(lo, hi)) in spans.iter().enumerate() {
            let bits = held(k, lo + (hi - lo) * part(random));
            plan.params[k].bits = bits;
            plan.graph.params[k].value = value(k, bits);
        }
        let (native, model) = shades(plan);
        if let Some(found) = found {
            let least = native >= found.exact.lo - 1e-9 && native <= found.exact.hi + 1e-9;
            assert!(least, "{native} outside of {:?}", found.exact);
        }
        tried.measured = tried.measured.max((model - native).abs());
        tried.points += 1;
    }
    tried
}

const BOXES: usize = 30;

/// What is found for one kernel on one target: how many boxes had a bound, and
/// the ratios of bound to measured.
fn try_kernel(target: &'static Target, kernel: &(&str, &str, &str)) -> (usize, usize, Vec<f64>) {
    let inputs = inputs(kernel.1);
    let mut plan = planned(target, &inputs, kernel.2);
    let mut random = Random::new(0);
    let (mut proved, mut points, mut ratios) = (0, 0, Vec::new());
    for _ in 0..BOXES {
        let tried = try_box(&mut plan, &inputs, &mut random);
        points += tried.points;
        if tried.bound.is_finite() {
            proved += 1;
            assert!(
                tried.measured <= tried.bound,
                "{} on {}: {} measured, {} proved",
                kernel.0,
                target.name,
                tried.measured,
                tried.bound
            );
            if tried.measured > 0.0 {
                ratios.push(tried.bound / tried.measured);
            }
        }
    }
    (proved, points, ratios)
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[test]
fn bounds_hold_and_are_near() {
    let (mut boxes, mut proved, mut points, mut all) = ([0; 2], [0; 2], 0, Vec::new());
    let mut seen = BTreeSet::new();
    let targets = in_all_formats().filter(|t| seen.insert(t.runtime.format));
    for target in targets.collect::<Vec<_>>() {
        let name = target.runtime.format;
        // In bytes many a value is no greater than what it may be off: no divisor has a bound then.
        let of = usize::from(target.runtime.narrow.is_some_and(|n| n.bits == 8));
        for kernel in KERNELS {
            let (bounded, tried, mut ratios) = try_kernel(target, kernel);
            let middle = median(&mut ratios);
            println!(
                "{name:12} {:20} {bounded:3} of {BOXES}, ratio {middle:.2}",
                kernel.0
            );
            boxes[of] += BOXES;
            proved[of] += bounded;
            points += tried;
            if of == 0 {
                all.extend(ratios);
            }
        }
    }
    let middle = median(&mut all);
    println!(
        "{proved:?} of {boxes:?} boxes have a bound; none of {points} evaluations exceeds it; ratio {middle:.2}"
    );
    for (of, least) in [(0, 95), (1, 60)] {
        let enough = proved[of] * 100 >= boxes[of] * least;
        assert!(enough, "{proved:?} of {boxes:?}");
    }
    assert!(middle <= 5.0, "{middle}");
}

/// 255 times 255 is no int of 16 bits: what is made of it is not what it should be, whatever the
/// roundings.
#[test]
fn what_ints_cannot_hold_proves_nothing() {
    let text = "image 256 x 256 inks black, white;\ndraw (x, y) = threshold(x * y / 65536, 0.5);\n";
    let target = in_all_formats().find(|t| t.name == "jack").unwrap();
    let plan = planned_as(target, text, 256);
    let shade = plan.graph.shade.unwrap();
    for (at, proved) in [(100, true), (255, false)] {
        let made = bounds(&plan, &Tile::of(&plan, (at, at), (at, at)));
        let decided = !made.undecided.iter().any(|&id| id < shade);
        assert_eq!(decided, proved, "{at}");
    }
}
