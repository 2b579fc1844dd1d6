//! Operands between their bounds, and results between theirs.

use super::*;

const VALUES: [f64; 11] = [-1e6, -7.0, -2.5, -0.3, 0.0, 0.001, 0.2, 0.9, 4.0, 33.0, 1e6];

fn of(op: Op, k: usize, args: [f64; 2], asked: Asked) -> Asked {
    let args = match op.arity() {
        1 => [args[0], 0.0],
        _ => args,
    };
    of_operand(op, k, args, op.eval_real(args[0], args[1]).real(), asked)
}

fn within(lo: f64, hi: f64) -> Asked {
    Asked {
        gain: 0.5,
        within: Bounds::new(lo, hi),
        lost: 0.25,
    }
}

/// Places between a value's bounds, the ends among them.
fn places(value: f64, within: Bounds) -> Vec<f64> {
    let lo = within.lo.max(value - 10.0 * value.abs() - 10.0);
    let hi = within.hi.min(value + 10.0 * value.abs() + 10.0);
    vec![lo, (lo + value) / 2.0, value, (hi + value) / 2.0, hi]
}

/// Wherever operands are between their bounds, the result is between its own.
#[test]
fn operands_between_their_bounds_keep_the_result_between_its_own() {
    let ops = [
        Op::Add,
        Op::Sub,
        Op::Neg,
        Op::Abs,
        Op::Min,
        Op::Max,
        Op::Mul,
        Op::Div,
        Op::Sqrt,
        Op::ReciprocalRoot,
    ];
    let ways = [0.0, 0.01, 0.7, 5.0, f64::INFINITY];
    let mut tried = 0;
    for (op, a, b, down, up) in product(&ops, &ways) {
        let result = op.eval_real(a, b).real();
        let asked = within(result - down, result + up);
        let own = [a, b].map(|x| x.abs());
        if result.abs() > 1e300 || op == Op::Div && b == 0.0 || op == Op::Sqrt && a < 0.0 {
            continue;
        }
        let bounds = [0, 1].map(|k| match k < op.arity() {
            true if of(op, k, [a, b], asked).is_something() => of(op, k, [a, b], asked).within,
            true => Bounds::point([a, b][k]),
            false => Bounds::point(b),
        });
        let small = (own[0] + own[1]) * 1e-9 + result.abs() * 1e-9 + 1e-9;
        for x in places(a, bounds[0]) {
            for y in places(b, bounds[1]) {
                if op == Op::Div && y.abs() < 1e-9 {
                    continue;
                }
                let now = op.eval_real(x, y).real();
                let kept = now >= result - down - small && now <= result + up + small;
                assert!(kept, "{op:?}({a}, {b}) -{down} +{up}: {x}, {y}: {now}");
                tried += 1;
            }
        }
    }
    assert!(tried > 50_000, "{tried}");
}

fn product(ops: &[Op], ways: &[f64]) -> Vec<(Op, f64, f64, f64, f64)> {
    let mut all = Vec::new();
    for op in ops {
        for a in VALUES {
            for b in VALUES {
                for down in ways {
                    all.extend(ways.iter().map(|up| (*op, a, b, *down, *up)));
                }
            }
        }
    }
    all
}

/// What is compared stays on its side, wherever both are between their bounds.
#[test]
fn what_is_compared_stays_on_its_side() {
    for a in VALUES {
        for b in VALUES.into_iter().filter(|b| *b != a) {
            let bounds = [0, 1].map(|k| of(Op::Less, k, [a, b], Asked::whole(0.0)).within);
            for x in places(a, bounds[0]) {
                for y in places(b, bounds[1]) {
                    assert_eq!(x < y, a < b, "{a}, {b}: {x}, {y}");
                }
            }
        }
    }
}

#[test]
fn the_larger_of_two_that_are_compared_need_only_stay_so() {
    let need = |op, k, args: [f64; 2], asked| of(op, k, args, asked).need(args[k]);
    let asked = of(Op::Less, 0, [1e6, 3.0], Asked::whole(0.0));
    assert!(asked.need(1e6) < 3.1 && asked.need(1e6) > 3.0 && asked.gain < 1e-5);
    assert_eq!(need(Op::Less, 1, [1e6, 3.0], Asked::whole(0.0)), 0.0);
    assert!(need(Op::Less, 0, [1e6, -3.0], Asked::whole(0.0)) < 3.0);
    let all = f64::INFINITY;
    assert_eq!(need(Op::Max, 0, [-1e6, 3.0], within(3.0, all)), 0.0);
    assert_eq!(need(Op::Max, 0, [-1e6, -3.0], within(-all, -3.0)), 3.0);
    assert_eq!(need(Op::Min, 1, [0.5, 1e6], within(0.5, all)), 0.5);
}

/// A difference of which only the sign counts loses it where what is larger is cut.
#[test]
fn what_a_sign_is_made_of_may_not_be_cut_below_the_rest() {
    let sign = of(Op::Less, 1, [0.0, 0.2], Asked::whole(1.0));
    let made = of(Op::Sub, 0, [1.2, 1.0], sign);
    let need = made.need(1.2);
    assert!(need > 1.0 && need < 1.1, "{need}");
    assert!(made.lost * need > 1.0);
}
