//! The loops over lanes held against the operations themselves.

use super::*;

fn nasty(ty: Type) -> Vec<Value> {
    let reals = [
        0.0,
        -0.0,
        0.5,
        -2.5,
        7.0,
        3e9,
        f64::MAX,
        f64::MIN,
        5e-324,
        1e-300,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];
    match ty {
        Type::Real => reals.map(Value::Real).to_vec(),
        Type::Int => [0, 1, -1, 7, -3, i32::MAX, i32::MIN]
            .map(Value::Int)
            .to_vec(),
        Type::Bool => [false, true].map(Value::Bool).to_vec(),
    }
}

fn bits(value: Value) -> (Type, u64) {
    let bits = match value {
        Value::Real(r) => r.to_bits(),
        other => u64::from(other.int().cast_unsigned()),
    };
    (value.ty(), bits)
}

/// In each lane other arguments, as many as there are; in the lanes of the
/// mask what the operation means, in all others what was there.
fn holds(op: Op, mask: Mask) {
    let types = [0, 1].map(|k| op.args().get(k).copied().unwrap_or(op.args()[0]));
    let pairs: Vec<[Value; 2]> = (nasty(types[0]).iter())
        .flat_map(|&a| nasty(types[1]).into_iter().map(move |b| [a, b]))
        .collect();
    let (mut count, result) = (Count::default(), op.result());
    let slots = [types[0], types[1], result].map(|ty| count.add(ty));
    let mut lanes = Lanes::new(count);
    assert_eq!(lanes.lanes(), LANES);
    let before = nasty(result)[1];
    for block in pairs.chunks(LANES) {
        lanes.fill(result, slots[2], before);
        let lane_pairs = (0..LANES).map(|lane| block[lane % block.len()]);
        for (lane, pair) in lane_pairs.clone().enumerate() {
            for k in 0..2 {
                lanes.set(types[k], slots[k], lane, pair[k]);
            }
        }
        lanes.apply(op, [slots[0], slots[1]], slots[2], mask);
        for (lane, pair) in lane_pairs.enumerate() {
            let wanted = match mask >> lane & 1 {
                1 => op.eval(&pair[..op.arity()]),
                _ => before,
            };
            let found = lanes.get(result, slots[2], lane);
            assert_eq!(bits(found), bits(wanted), "{op:?} {pair:?} in lane {lane}");
        }
    }
}

#[test]
fn operations_mean_in_lanes_what_they_mean() {
    for &op in Op::EVERY {
        for mask in [!0, 1, 0x5555_0000_ff0f_00ff, 1 << 63, 0] {
            holds(op, mask);
        }
    }
}

#[test]
fn large_graphs_have_fewer_lanes() {
    let count = |reals| Count {
        reals,
        ..Count::default()
    };
    assert_eq!(Lanes::new(count(10)).lanes(), 64);
    assert_eq!(Lanes::new(count(200_000)).lanes(), 16);
    assert_eq!(Lanes::new(count(1_000_000)).lanes(), 8);
}
