//! Phase accumulators held against exact arithmetic.
#![allow(clippy::unwrap_used)]

use super::phase::{parities, phases};
use crate::analysis::range::{Slack, ranges};
use crate::analysis::verify::verify;
use crate::eval::native::Native;
use crate::eval::random::Random;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::simplify::fold::fold;
use crate::plan::Goal;
use crate::plan::model::ModelRun;
use crate::planner::plan;
use crate::schedule::statements::schedule;
use crate::source::Span;
use crate::targets::bbc::MICRO;
use slowlight_routine::{Op, Value};

const AT: Span = Span {
    file: 0,
    start: 0,
    end: 0,
    within: None,
    effect: None,
};

const WIDTH: i32 = 320;
const HEIGHT: i32 = 12;

/// From -most to most.
fn about(random: &mut Random, most: i64) -> i64 {
    random.below(2 * most as u64 + 1) as i64 - most
}

/// floor((by x + down y + from)/over) + more y + turn x + some, and perhaps
/// floor((by x + from)/over), another over.
struct Tiles {
    second: Option<(i64, i64, i64)>,
    by: i64,
    down: i64,
    from: i64,
    over: i64,
    more: i64,
    turn: i64,
    some: i64,
}

impl Tiles {
    /// `dyadic`: what is divided by is a power of two.
    fn random(seed: u64, dyadic: bool) -> Tiles {
        let mut random = Random::new(seed);
        let mut about = |most| about(&mut random, most);
        let over = match dyadic {
            true => 4096,
            false => 7919,
        };
        let second = (about(90_000), about(900_000), over);
        Tiles {
            second: seed.is_multiple_of(3).then_some(second),
            by: about(90_000),
            down: about(90_000),
            from: about(900_000),
            over: match dyadic {
                true => 1 << (10 + about(4)),
                false => 3 * about(2000).abs() + 1009,
            },
            more: about(3),
            turn: about(1),
            some: about(5),
        }
    }

    /// The parity, and how far the floor is from its border.
    fn exact(&self, x: i64, y: i64) -> (bool, f64) {
        let above = self.by * x + self.down * y + self.from;
        let rest = above.rem_euclid(self.over);
        let tile = above.div_euclid(self.over) + self.more * y + self.turn * x + self.some;
        let near = |rest: i64, over: i64| rest.min(over - rest) as f64 / over as f64;
        let mut found = (tile, near(rest, self.over));
        if let Some((by, from, over)) = self.second {
            let above = by * x + from;
            found.0 -= above.div_euclid(over);
            found.1 = found.1.min(near(above.rem_euclid(over), over));
        }
        (found.0.rem_euclid(2) == 1, found.1)
    }

    fn graph(&self) -> Graph {
        let mut b = Builder::new();
        let axes = [Axis::X, Axis::Y].map(|axis| b.axis(axis, AT));
        let [x, y] = axes.map(|axis| b.apply(Op::ToReal, &[axis], AT));
        let real = |b: &mut Builder, n: i64| b.constant(Value::Real(n as f64), AT);
        let parts = [self.by, self.down, self.from, self.over].map(|n| real(&mut b, n));
        let [by, down, from, over] = parts;
        // ((by x + from)/over + down y/over): divided here and there, as scenes do.
        let moved = b.apply(Op::Mul, &[x, by], AT);
        let moved = b.apply(Op::Add, &[moved, from], AT);
        let moved = b.apply(Op::Div, &[moved, over], AT);
        let below = b.apply(Op::Mul, &[down, y], AT);
        let below = b.apply(Op::Div, &[below, over], AT);
        let minus = b.apply(Op::Neg, &[below], AT);
        let sum = b.apply(Op::Sub, &[moved, minus], AT);
        let floor = b.apply(Op::Floor, &[sum], AT);
        let mut second = None;
        if let Some(parts) = self.second {
            let parts = [parts.0, parts.1, parts.2].map(|n| real(&mut b, n));
            let moved = b.apply(Op::Mul, &[x, parts[0]], AT);
            let moved = b.apply(Op::Add, &[parts[1], moved], AT);
            let moved = b.apply(Op::Div, &[moved, parts[2]], AT);
            second = Some(b.apply(Op::Floor, &[moved], AT));
        }
        let [more, turn, some] =
            [self.more, self.turn, self.some].map(|n| b.constant(Value::Int(n as i32), AT));
        let rows = b.apply(Op::IntMul, &[axes[1], more], AT);
        let rows = b.apply(Op::IntAdd, &[rows, some], AT);
        let turns = b.apply(Op::IntMul, &[axes[0], turn], AT);
        let tile = b.apply(Op::IntAdd, &[floor, rows], AT);
        let mut tile = b.apply(Op::IntAdd, &[tile, turns], AT);
        if let Some(second) = second {
            tile = b.apply(Op::IntSub, &[tile, second], AT);
        }
        let two = b.constant(Value::Int(2), AT);
        let odd = b.apply(Op::IntMod, &[tile, two], AT);
        let zero = b.constant(Value::Int(0), AT);
        let lit = b.apply(Op::IntLess, &[zero, odd], AT);
        let three = b.constant(Value::Int(3), AT);
        let ink = b.select(lit, three, zero, AT);
        let image = Image {
            block: (1, 1),
            width: WIDTH as u32,
            height: HEIGHT as u32,
            palette: vec![[0; 3]; 4],
        };
        b.finish(image, ink, None)
    }
}

fn ramps_of(graph: &Graph) -> usize {
    let reached = graph.reached();
    let ramp = |id: &NodeId| matches!(graph.node(*id), Node::Ramp { .. });
    let ids = graph.ids().filter(|id| reached[id.0 as usize]);
    ids.filter(ramp).count()
}

#[test]
fn phases_are_exact_but_at_borders() {
    let (mut told, mut borders) = (0, 0);
    for seed in 0..80 {
        let dyadic = seed % 2 == 0;
        let tiles = Tiles::random(seed, dyadic);
        let graph = fold(&tiles.graph());
        let known = ranges(&graph, &schedule(&graph), &Slack::exact());
        let sites = parities(&graph, &known, MICRO.runtime);
        assert_eq!(sites.len(), 1, "{graph}");
        let made = phases(&graph, &known, &sites).unwrap();
        verify(&made).unwrap();
        let floors = 1 + usize::from(tiles.second.is_some());
        assert_eq!(ramps_of(&made), floors, "{made}");
        let mut native = Native::new(&made);
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let (odd, near) = tiles.exact(i64::from(x), i64::from(y));
                // Steps of what is divided by a power of two are whole units.
                let units = f64::from(x + 1) * 0.5f64.powi(32);
                if !dyadic && near <= units + 1e-11 {
                    borders += 1;
                    continue;
                }
                told += 1;
                let found = native.pixel(x, y).ink == 3;
                assert_eq!(found, odd, "{seed} at ({x}, {y}): {made}");
            }
        }
    }
    assert!(told > 50 * borders, "{told} {borders}");
}

#[test]
fn a_micro_steps_phases_within_their_bound() {
    let mut borders = 0;
    for seed in 0..30 {
        let tiles = Tiles::random(1000 + seed, false);
        let goal = Goal {
            name: "tiles".to_owned(),
            mode: *MICRO.modes.iter().find(|m| m.name == "1").unwrap(),
            rows: None,
            plot: true,
        };
        let plan = plan(&tiles.graph(), &MICRO, &goal).unwrap();
        let floors = 1 + usize::from(tiles.second.is_some());
        assert_eq!(ramps_of(&plan.graph), floors, "{}", plan.graph);
        let mut model = ModelRun::new(&plan);
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let (odd, near) = tiles.exact(i64::from(x), i64::from(y));
                let ulp = 0.5f64.powi(32);
                let slope = tiles.by.abs() as f64 / tiles.over as f64;
                let start = (tiles.down.abs() * i64::from(y) + tiles.from.abs()) as f64;
                let other = tiles.second.map_or(0.0, |(by, from, over)| {
                    (by.abs() * i64::from(x) + from.abs()) as f64 / over as f64
                });
                let size = slope * f64::from(x) + start / tiles.over as f64 + other;
                let reals = 4.0 * ulp * (size + 2.0);
                if near <= f64::from(x + 2) * ulp + reals {
                    borders += 1;
                    continue;
                }
                let found = model.pixel(x, y).ink == 3;
                assert_eq!(found, odd, "{seed} at ({x}, {y}): {}", plan.graph);
            }
        }
        assert_eq!(model.unset_reads(), 0);
    }
    assert!(borders < 2000, "{borders}");
}

/// A floor of a small line, of which the reals know more than a phase does.
#[test]
fn what_the_reals_know_better_is_left_alone() {
    let mut b = Builder::new();
    let x = b.axis(Axis::X, AT);
    let x = b.apply(Op::ToReal, &[x], AT);
    let by = b.constant(Value::Real(0.000_123), AT);
    let moved = b.apply(Op::Mul, &[x, by], AT);
    let floor = b.apply(Op::Floor, &[moved], AT);
    let one = b.constant(Value::Int(1), AT);
    let odd = b.apply(Op::BitAnd, &[floor, one], AT);
    let image = Image {
        block: (1, 1),
        width: 320,
        height: 2,
        palette: vec![[0; 3]; 2],
    };
    let graph = b.finish(image, odd, None);
    let known = ranges(&graph, &schedule(&graph), &Slack::exact());
    assert_eq!(parities(&graph, &known, MICRO.runtime), []);
}
