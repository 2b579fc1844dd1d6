//! Bounds over boxes in parts: nearer than over the whole, and kept.

use super::*;

/// How many statements and roundings a box is worth here.
const FUEL: u64 = 20_000;

/// The box of some inputs, as the plan holds them, and the node asked for.
fn whole(plan: &Plan, inputs: &[(String, f64, f64)]) -> (Tile, NodeId) {
    let mut tile = Tile::of(plan, (0, 0), (0, 0));
    let ends = inputs.iter().map(|&(_, lo, hi)| (Range::new(lo, hi), 0.0));
    tile.params = ends.collect();
    (tile, plan.graph.shade.unwrap())
}

/// The greatest error at points at random in the box.
fn measured(plan: &mut Plan, inputs: &[(String, f64, f64)], points: usize) -> f64 {
    let mut random = Random::new(1);
    let mut worst = 0.0f64;
    for _ in 0..points {
        for (k, &(_, lo, hi)) in inputs.iter().enumerate() {
            let format = plan.param_format(ParamId(k as u32));
            let wanted = Scalar::Real(lo + (hi - lo) * part(&mut random));
            let bits = (plan.runtime.encode)(wanted, format);
            let value = (plan.runtime.decode)(bits, format).real();
            plan.params[k].bits = bits;
            plan.graph.params[k].value = value;
        }
        let (native, model) = shades(plan);
        worst = worst.max((model - native).abs());
    }
    worst
}

fn everywhere(_: &[(Range, f64)]) -> bool {
    true
}

/// Small formulas whose ends are whole in every format; by how much nearer the bound is in
/// parts, at least, in floating formats.
const SMALL: &[(&str, &str, f64)] = &[
    // Both are great at once over the whole.
    ("a 0 256", "a / (a + 1)", 100.0),
    // The root is small where its rounding is not; the side is even about 0.
    ("a 0.125 8, b -4 4", "sqrt(a + b * b)", 4.0),
    // The difference is small only at one end.
    (
        "a 1.25 2, b 1.25 2",
        "(a * b - 1) / (a * a * b * b - 1)",
        4.0,
    ),
];

#[test]
fn parts_have_nearer_bounds_that_are_kept() {
    let mut seen = BTreeSet::new();
    let targets = in_all_formats().filter(|t| seen.insert(t.runtime.format));
    for target in targets.collect::<Vec<_>>() {
        for &(ends, formula, nearer) in SMALL {
            let inputs = inputs(ends);
            let mut plan = planned(target, &inputs, formula);
            let (tile, of) = whole(&plan, &inputs);
            let once = bounds(&plan, &tile)
                .of(of)
                .map_or(f64::INFINITY, |b| b.error);
            let found = bound_within(&plan, &tile, of, FUEL, &everywhere);
            let name = target.runtime.format;
            assert!(found.error <= once, "{name}: {found:?}, not {once}");
            if matches!(name, "f316" | "real40") {
                assert!(
                    found.error * nearer <= once,
                    "{formula} in {name}: {found:?}, {once}"
                );
            }
            let off = measured(&mut plan, &inputs, 500);
            assert!(off <= found.error, "{formula} in {name}: {off}, {found:?}");
        }
    }
}

#[test]
fn what_is_not_kept_does_not_count() {
    let target = in_all_formats()
        .find(|t| t.runtime.format == "f316")
        .unwrap();
    let inputs = inputs("a 0 4, b 0 4");
    let plan = planned(target, &inputs, "1 / (a - b)");
    let (tile, of) = whole(&plan, &inputs);
    let apart = |at: &[(Range, f64)]| at[0].0.hi - at[1].0.lo >= 1.0;
    assert!(
        bound_within(&plan, &tile, of, FUEL, &everywhere)
            .error
            .is_infinite()
    );
    let found = bound_within(&plan, &tile, of, FUEL, &apart);
    assert!(found.error < 0.1, "{found:?}");
}

#[test]
fn it_ends_with_its_fuel() {
    let target = in_all_formats()
        .find(|t| t.runtime.format == "real40")
        .unwrap();
    let inputs = inputs("a 0 256");
    let plan = planned(target, &inputs, "a / (a + 1)");
    let (tile, of) = whole(&plan, &inputs);
    let once = bounds(&plan, &tile);
    let none = bound_within(&plan, &tile, of, 0, &everywhere);
    assert_eq!(
        (none.boxes, Some(none.error)),
        (1, once.of(of).map(|b| b.error))
    );
    let each = once.walked + u64::from(once.operations) + 1;
    let some = bound_within(&plan, &tile, of, FUEL, &everywhere);
    assert!((FUEL..FUEL + 4 * each).contains(&some.walked), "{some:?}");
    // The same again: nothing of it is timed.
    assert_eq!(some, bound_within(&plan, &tile, of, FUEL, &everywhere));
}
