//! Reals of two widths are as many narrow as a picture's inks allow.
#![allow(clippy::unwrap_used)]

use crate::eval::arithmetic::Exact;
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::plan::Goal;
use crate::plan::model::ModelRun;
use crate::planner::PlannedScene;
use crate::planner::plan;
use crate::scene::check;
use crate::sema::{Freeze, Options};
use crate::targets::mos6502;
use crate::targets::{Target, default_mode};
use slowlight_routine::Type;

const WIDE: (u32, u32) = (160, 120);

/// The mirrors at a quarter of their size.
fn planned(target: &'static Target) -> PlannedScene {
    let text = include_str!("../../../examples/mirrors.scn")
        .replace("image 320 x 240", &format!("image {} x {}", WIDE.0, WIDE.1))
        .replace(
            "(x - 159.5) / 160, (119.5 - y) / 160",
            "(x - 79.5) / 80, (59.5 - y) / 80",
        );
    let freeze = Options {
        freeze: Freeze::All,
        ..Options::default()
    };
    planned_with(&text, target, &freeze, WIDE)
}

fn planned_with(
    text: &str,
    target: &'static Target,
    options: &Options,
    size: (u32, u32),
) -> PlannedScene {
    let scene = check("test", text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let goal = Goal {
        name: "test".to_owned(),
        mode: default_mode(target, size.0, size.1).unwrap(),
        rows: None,
        plot: true,
    };
    plan(&scene.lower(options).unwrap(), target, &goal).unwrap()
}

/// How many of a plan's inks are not those of its graph in `f64`.
fn off(plan: &PlannedScene) -> usize {
    let mut exact = Run::new(&plan.graph, &plan.tree, Exact(&plan.graph));
    let mut model = ModelRun::new(plan);
    let most = plan.graph.image.palette.len() as i32 - 1;
    let all = (0..WIDE.1 as i32).flat_map(|y| (0..WIDE.0 as i32).map(move |x| (x, y)));
    all.filter(|&(x, y)| {
        let ink = exact.pixel(x, y).int().clamp(0, most);
        i32::from(model.pixel(x, y).ink) != ink
    })
    .count()
}

/// In how many bits reals are computed: how many in 16, how many in 24.
fn widths(plan: &PlannedScene) -> [usize; 2] {
    computed_in(plan, [16, 24])
}

/// How many reals are computed in each of two widths.
fn computed_in(plan: &PlannedScene, bits: [u8; 2]) -> [usize; 2] {
    let real = |id: &NodeId| plan.graph.ty(*id) == Type::Real && plan.routine(*id).is_some();
    let widths = plan.points().unwrap().widths();
    bits.map(|bits| {
        let of = |id: &NodeId| real(id) && widths.value(*id) == bits;
        plan.graph.ids().filter(of).count()
    })
}

#[test]
fn most_reals_are_narrow_where_few_inks_change_for_that() {
    let plans = [
        &mos6502::PLAIN_FIXED16,
        &mos6502::PLAIN_FIXED20,
        &mos6502::PLAIN_FIXED24,
    ]
    .map(planned);
    let [narrow, mixed, wide] = [0, 1, 2].map(|k| off(&plans[k]));
    println!("{narrow} {mixed} {wide}, {:?}", widths(&plans[1]));
    assert!(
        wide < mixed && 2 * mixed < narrow,
        "{wide} {mixed} {narrow}"
    );
    let [short, long] = widths(&plans[1]);
    assert!(long > 0 && short > long, "{short} {long}");
    assert_eq!([widths(&plans[0])[1], widths(&plans[2])[0]], [0, 0]);
}

#[test]
fn some_reals_are_bytes_where_few_inks_change_for_that() {
    let plans = [&mos6502::PLAIN_FIXED12, &mos6502::PLAIN_FIXED16].map(planned);
    let [mixed, wide] = [0, 1].map(|k| off(&plans[k]));
    let [bytes, words] = computed_in(&plans[0], [8, 16]);
    println!("{mixed} {wide}, {bytes} {words}");
    assert!(bytes > 5 && words > bytes, "{bytes} {words}");
    // One in a hundred of those that are wrong in bytes alone: hardly any is right then.
    let pixels = (WIDE.0 * WIDE.1) as usize;
    assert!(
        wide < mixed && mixed <= wide + pixels / 100,
        "{mixed} {wide}"
    );
    assert_eq!(computed_in(&plans[1], [8, 16])[0], 0);
}

/// What is computed in subroutines, and what they are given and leave, has the bits that it had
/// where it stood.
#[test]
fn what_subroutines_are_given_and_leave_keeps_its_bits() {
    let balls: Vec<String> = (0..10)
        .map(|k| {
            let [x, y, z] = [0.7, 0.5, 0.9].map(|by| (f64::from(k) * by) % 1.6 - 0.8);
            format!("sphere(({x:.2}, {y:.2}, {z:.2}), 0.{})", 20 + k)
        })
        .collect();
    let all = balls[1..].iter().fold(balls[0].clone(), |all, ball| {
        format!("smooth_union({all}, {ball}, 0.3)")
    });
    let text = format!(
        "image 160 x 120 inks black, grey, white;
         scene world {{ {all} is 0.9; }}
         draw (x, y) = {{
           let r = pinhole((0, 1, 4), at: (0, 0, 0), field: 40deg).through(x, y);
           let v = if let h = world.march(r, steps: 40, near: 0.01, far: 9)
             then h.tag * lambert(h, (0.48, 0.64, 0.6)) else 0.1;
           threshold(v, bayer(4)[x mod 4, y mod 4])
         }};"
    );
    // Choices are left behind as well.
    let twist = include_str!("../../../examples/twist.scn").replace("320 x 240", "160 x 120");
    let screw = "shape screw(a: shape, by: angle, radius: real) {
          dist(p) = a.dist(turned(p, (0, 1, 0), p.y * by)) / stretch(abs(by) / 1rad * max(length(p.xz), radius));
        }
        scene forms";
    let twist = twist
        .replace("twist(box", "screw(box")
        .replace("scene forms", screw);
    for (text, target) in [
        (text.as_str(), &mos6502::PLAIN_FIXED16),
        (twist.as_str(), &mos6502::PLAIN_FIXED16),
    ] {
        let plain = planned_with(text, target, &Options::default(), WIDE);
        let called = plain.outlined(&|_| None).unwrap();
        let [plain, called] = [&plain, &called].map(off);
        println!("{plain} {called}");
        assert!(called <= 2 * plain + 20, "{called} {plain}");
    }
}

/// An edited program is the one that would be made for the edited param.
#[test]
fn widths_are_those_of_the_scene_whatever_its_params_are_set_to() {
    let text = "image 48 x 32 inks black, white;
        param eye: vec3 = (1, 2, 3) in (0.1, 0, 0) .. (100, 9, 9); param n: int = 7 in 1 .. 99;
        draw (x, y) = {
          let fine = floor(1 / (x * 0.2 + eye.x) * (y + eye.y) * 999 / (1 + eye.z));
          let coarse = floor(sqrt(x * eye.y + 0.3) + eye.z * (y + 0.7) / 9);
          ink((fine * n + coarse) mod 2)
        };";
    let planned = |set: &[(&str, &[f64])]| {
        let options = Options {
            set: set
                .iter()
                .map(|(name, x)| ((*name).to_owned(), x.to_vec()))
                .collect(),
            ..Options::default()
        };
        planned_with(text, &mos6502::PLAIN_FIXED20, &options, (48, 32))
    };
    let of = |plan: &PlannedScene| {
        let ids = plan.graph.ids();
        let points = plan.points().unwrap();
        let own = ids.map(|id| (points.widths().value(id), points.own(id)));
        own.collect::<Vec<_>>()
    };
    let usual = planned(&[]);
    let [short, long] = widths(&usual);
    assert!(long > 0 && short > 0, "{short} {long}");
    let other = planned(&[("eye", &[99.0, 0.5, 8.0]), ("n", &[3.0])]);
    assert_eq!(of(&usual), of(&other));
    assert_ne!(usual.params, other.params);
}
