//! Spans decide what the polynomial decides, in every column.
#![allow(clippy::unwrap_used)]

use super::spans;
use crate::analysis::range::{Slack, ranges};
use crate::analysis::verify::verify;
use crate::eval::native::Native;
use crate::eval::random::Random;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::plan::Goal;
use crate::plan::model::ModelRun;
use crate::planner::plan;
use crate::schedule::statements::schedule;
use crate::source::Span;
use crate::targets::{default_mode, find};
use slowlight_routine::{Op, Type, Value};

const AT: Span = Span {
    file: 0,
    start: 0,
    end: 0,
    within: None,
    effect: None,
};
const WIDTH: i32 = 320;

fn within(random: &mut Random, lo: i64, hi: i64) -> i64 {
    lo + random.below((hi - lo + 1) as u64) as i64
}

/// A value that each row has in a table.
fn by_row(b: &mut Builder, rows: &[[f64; 3]], k: usize, ty: Type) -> NodeId {
    let (zero, y) = (b.constant(Value::Int(0), AT), b.axis(Axis::Y, AT));
    let value = |row: &[f64; 3]| match ty {
        Type::Int => Constant::Int(row[k] as i32),
        _ => Constant::new(Value::Real(row[k])),
    };
    let table = b.table(Table {
        name: format!("c{k}"),
        width: 1,
        height: rows.len() as u32,
        ty,
        entries: rows.iter().map(value).collect(),
        seed: Vec::new(),
    });
    b.lookup(table, zero, y, AT)
}

/// Ink 1 where a x² + b x + c compares with 0, the row's coefficients in a table.
fn picture(rows: &[[f64; 3]], ty: Type, op: Op, turned: bool) -> Graph {
    let mut b = Builder::new();
    let x = b.axis(Axis::X, AT);
    let zero = b.constant(Value::Int(0), AT);
    let coefficient = |b: &mut Builder, k: usize| by_row(b, rows, k, ty);
    let [c, l, q] = [0, 1, 2].map(|k| coefficient(&mut b, k));
    let (times, plus) = match ty {
        Type::Int => (Op::IntMul, Op::IntAdd),
        _ => (Op::Mul, Op::Add),
    };
    let linear = rows.iter().all(|row| row[2] == 0.0);
    let mut sum = l;
    if !linear {
        let square = b.apply(times, &[q, x], AT);
        sum = b.apply(plus, &[square, l], AT);
    }
    let sum = b.apply(times, &[sum, x], AT);
    let sum = b.apply(plus, &[sum, c], AT);
    let pair = if turned { [zero, sum] } else { [sum, zero] };
    let holds = b.apply(op, &pair, AT);
    let one = b.constant(Value::Int(1), AT);
    let ink = b.select(holds, one, zero, AT);
    let image = Image {
        block: (1, 1),
        width: WIDTH as u32,
        height: rows.len() as u32,
        palette: vec![[0; 3]; 2],
    };
    b.finish(image, ink, None)
}

/// The graph with its comparison as a span.
fn spanned(graph: &Graph) -> Option<Graph> {
    let tree = schedule(graph);
    let runtime = find("bbc:micro").unwrap().runtime;
    let ranges = ranges(graph, &tree, &Slack::of(runtime));
    let found = spans(graph, &ranges, runtime, &|_| true, &Default::default())?;
    verify(&found.graph).unwrap();
    Some(found.graph)
}

fn quadratic(a: i64, [p, q]: [i64; 2], more: i64) -> [f64; 3] {
    [a * p * q + more, -a * (p + q), a].map(|n| n as f64)
}

/// Rows of quadratics with first coefficients from `low` to twice that: at random, double roots,
/// roots on columns and beside the picture, empty ones, and whole rows.
fn hard(low: i64) -> Vec<[f64; 3]> {
    let mut random = Random::new(low as u64);
    let mut rows = Vec::new();
    for _ in 0..50 {
        let a = within(&mut random, low, 2 * low);
        let roots = [within(&mut random, -90, 400), within(&mut random, -90, 400)];
        let near = within(&mut random, -3, 3);
        rows.push(quadratic(a, roots, 0));
        rows.push(quadratic(a, roots, near));
        rows.push(quadratic(a, [roots[0]; 2], near));
        rows.push(quadratic(a, [roots[0], roots[0] + 1], near));
        rows.push(quadratic(
            a,
            roots,
            within(&mut random, -1_000_000, 1_000_000),
        ));
        // Never where the root is moved past all of it, always on the other side.
        rows.push(quadratic(a, roots, 200_000_000));
        rows.push(quadratic(a, roots, -200_000_000));
    }
    rows.extend([-1, 0, 1, 318, 319, 320, 321].map(|n| quadratic(low, [n; 2], 0)));
    rows.extend([-1, 0, 1, 318, 319, 320, 321].map(|n| quadratic(low, [n - 1, n], 0)));
    rows
}

fn holds(op: Op, turned: bool, value: f64) -> bool {
    let pair = if turned { (0.0, value) } else { (value, 0.0) };
    match op {
        Op::Less | Op::IntLess => pair.0 < pair.1,
        _ => pair.0 <= pair.1,
    }
}

/// Natively and as the Micro computes it, against whole numbers.
fn as_whole_numbers(rows: &[[f64; 3]]) {
    for op in [Op::IntLess, Op::IntLessEqual] {
        for turned in [false, true] {
            let graph = picture(rows, Type::Int, op, turned);
            let next = spanned(&graph).expect("no span");
            let target = find("bbc:micro").unwrap();
            let goal = Goal {
                name: "test".to_owned(),
                mode: default_mode(target, WIDTH as u32, 200).unwrap(),
                rows: None,
                plot: true,
            };
            let plan = plan(&next, target, &goal).unwrap();
            let (mut native, mut model) = (Native::new(&next), ModelRun::new(&plan));
            for (y, [c, b, a]) in rows.iter().enumerate() {
                for x in 0..WIDTH {
                    let at = f64::from(x);
                    let right = u8::from(holds(op, turned, (a * at + b) * at + c));
                    let place = (x, y as i32);
                    assert_eq!(native.pixel(x, y as i32).ink, right, "{op:?} {place:?}");
                    assert_eq!(model.pixel(x, y as i32).ink, right, "{op:?} {place:?}");
                }
            }
            assert_eq!(model.unset_reads(), 0);
        }
    }
}

#[test]
fn spans_of_whole_numbers_are_the_polynomials() {
    for low in [1, 7, 450] {
        as_whole_numbers(&hard(low));
        let negative = hard(low).into_iter().map(|row| row.map(|n| -n));
        as_whole_numbers(&negative.collect::<Vec<_>>());
    }
}

#[test]
fn borders_of_lines_are_the_lines() {
    let mut random = Random::new(77);
    let line = |_| {
        let b = within(&mut random, 1, 50);
        let root = within(&mut random, -50, 370);
        [-b * root + within(&mut random, -2, 2), b, 0].map(|n| n as f64)
    };
    let lines: Vec<[f64; 3]> = (0..400).map(line).collect();
    as_whole_numbers(&lines);
    as_whole_numbers(&lines.iter().map(|l| l.map(|n| -n)).collect::<Vec<_>>());
}

#[test]
fn spans_of_reals_are_the_polynomials_but_for_their_roundings() {
    let compared: usize = [0.001, 0.3, 70.0].map(as_reals).iter().sum();
    assert!(compared > 300_000, "{compared} compared");
}

/// Rows whose first coefficients are about as large as this; how many pixels
/// were compared.
fn as_reals(low: f64) -> usize {
    let mut random = Random::new(5);
    let mut row = |k: i64| {
        let a = within(&mut random, 1000, 2000) as f64 / 1000.0 * low;
        let [p, q] = [0; 2].map(|_| within(&mut random, -90_000, 400_000) as f64 / 1000.0);
        let more = if k % 3 == 0 { a * 7.5 } else { 0.0 };
        [a * p * q + more, -a * (p + q), a]
    };
    let rows: Vec<[f64; 3]> = (0..400).map(&mut row).collect();
    let graph = picture(&rows, Type::Real, Op::Less, false);
    let next = spanned(&graph).expect("no span");
    let (mut before, mut after) = (Native::new(&graph), Native::new(&next));
    let mut compared = 0;
    for (y, [c, b, a]) in rows.iter().enumerate() {
        for x in 0..WIDTH {
            let at = f64::from(x);
            let (square, line) = (a * at * at, b * at);
            let size = square.abs() + line.abs() + c.abs();
            if (square + line + c).abs() > 1e-12 * size {
                let inks = [&mut before, &mut after].map(|run| run.pixel(x, y as i32).ink);
                assert_eq!(inks[0], inks[1], "{:?} column {x}", rows[y]);
                compared += 1;
            }
        }
    }
    compared
}

#[test]
fn what_may_turn_over_or_lies_too_far_is_left_alone() {
    let unknown = [[-100.0, 3.0, 1.0], [100.0, -3.0, -1.0]];
    assert!(spanned(&picture(&unknown, Type::Int, Op::IntLess, false)).is_none());
    // A vertex tens of thousands of columns away.
    let flat = [[1.0, -7.0, 0.000_01], [-1.0, 9.0, 0.000_02]];
    assert!(spanned(&picture(&flat, Type::Real, Op::Less, false)).is_none());
}

/// Ink 1 where over / ((20 x - 3190)² + more) is below a limit, by row.
fn quotients(rows: &[[f64; 3]]) -> Graph {
    let mut b = Builder::new();
    let x = b.axis(Axis::X, AT);
    let zero = b.constant(Value::Int(0), AT);
    let column = |b: &mut Builder, k: usize, ty: Type| by_row(b, rows, k, ty);
    let over = column(&mut b, 0, Type::Real);
    let more = column(&mut b, 1, Type::Int);
    let limit = column(&mut b, 2, Type::Real);
    let [by, from] = [20, 3190].map(|n| b.constant(Value::Int(n), AT));
    let line = b.apply(Op::IntMul, &[x, by], AT);
    let line = b.apply(Op::IntSub, &[line, from], AT);
    let square = b.apply(Op::IntMul, &[line, line], AT);
    let square = b.apply(Op::IntAdd, &[square, more], AT);
    let quotient = b.apply(Op::Div, &[over, square], AT);
    let holds = b.apply(Op::Less, &[quotient, limit], AT);
    let one = b.constant(Value::Int(1), AT);
    let ink = b.select(holds, one, zero, AT);
    let image = Image {
        block: (1, 1),
        width: WIDTH as u32,
        height: rows.len() as u32,
        palette: vec![[0; 3]; 2],
    };
    b.finish(image, ink, None)
}

/// A limit that may be of either sign, or 0: the row decides which way the span lies.
#[test]
fn factors_of_unknown_sign_are_asked_for_it() {
    let mut inside = [0; 2];
    for mixed in [false, true] {
        let mut random = Random::new(31);
        let mut row = |k: i64| {
            let sign = if mixed && k % 2 == 0 { -1.0 } else { 1.0 };
            let over = sign * within(&mut random, 64, 3_000_000) as f64;
            let more = within(&mut random, 1, 9_000_000) as f64;
            let edge = within(&mut random, -4000, 4000) as f64;
            let limit = match k % 5 {
                0 => 0.0,
                1 => -over / (edge * edge + more),
                _ => over / (edge * edge + more),
            };
            [over, more, limit]
        };
        let rows: Vec<[f64; 3]> = (0..200).map(&mut row).collect();
        let graph = quotients(&rows);
        let next = spanned(&graph).expect("no span");
        let target = find("bbc:micro").unwrap();
        let goal = Goal {
            name: "test".to_owned(),
            mode: default_mode(target, WIDTH as u32, 200).unwrap(),
            rows: None,
            plot: true,
        };
        let plan = plan(&next, target, &goal).unwrap();
        let (mut before, mut after) = (Native::new(&graph), Native::new(&next));
        let mut model = ModelRun::new(&plan);
        for (y, [over, more, limit]) in rows.iter().enumerate() {
            for x in 0..WIDTH {
                let line = f64::from(20 * x - 3190);
                let apart = (over / (line * line + more) - limit).abs();
                let place = (x, y as i32);
                let ink = before.pixel(x, y as i32).ink;
                if apart > 1e-12 * limit.abs() {
                    assert_eq!(after.pixel(x, y as i32).ink, ink, "{place:?} {:?}", rows[y]);
                }
                if apart > 1e-6 * limit.abs() {
                    assert_eq!(model.pixel(x, y as i32).ink, ink, "{place:?} {:?}", rows[y]);
                    inside[usize::from(ink)] += 1;
                }
            }
        }
        assert_eq!(model.unset_reads(), 0);
    }
    assert!(inside.iter().all(|n| *n > 20_000), "{inside:?}");
}
