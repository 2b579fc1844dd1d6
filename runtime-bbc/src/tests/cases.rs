//! What routines are tried on.

use super::*;

/// Operands of a format: edges, then random ones.
pub fn operands(format: Format) -> Vec<Bits> {
    let mut runner = TestRunner::deterministic();
    let mut draw = |s: BoxedStrategy<Bits>, n: usize| -> Vec<Bits> {
        (0..n)
            .map(|_| s.new_tree(&mut runner).unwrap().current())
            .collect()
    };
    match format {
        Format::Bool => vec![0, 1],
        Format::Real40 => {
            let edges = [
                0.0,
                1.0,
                -1.0,
                2.0,
                0.5,
                -0.5,
                1.5,
                -2.5,
                3.0,
                8.0,
                4.0,
                16.0,
                2.5,
                0.75,
                0.3,
                -0.1,
                1e-3,
                1e3,
                88.0,
                89.0,
                -89.0,
                1e-38,
                3e-39,
                1e5,
                -123456.0,
                2147483647.0,
                2147483648.0,
                -2147483648.0,
                -2147483649.0,
                2147483646.5,
                1e10,
                1e37,
                8.5e37,
                -9e37,
                1.7e38,
                -1.7e38,
                1.701411834e38,
            ];
            let mut list: Vec<Bits> = edges.iter().map(|x| nearest(*x).to_bits()).collect();
            list.extend(draw(
                (-8.0f64..8.0).prop_map(|x| nearest(x).to_bits()).boxed(),
                12,
            ));
            list.extend(draw(
                (124u64..=134, any::<u32>())
                    .prop_map(|(e, m)| Real40::from_bits(e << 32 | u64::from(m)).to_bits())
                    .boxed(),
                12,
            ));
            list.extend(draw(
                (1u64..=255, any::<u32>())
                    .prop_map(|(e, m)| Real40::from_bits(e << 32 | u64::from(m)).to_bits())
                    .boxed(),
                8,
            ));
            list
        }
        _ => {
            let edges = [
                0,
                1,
                -1,
                2,
                -2,
                3,
                4,
                7,
                8,
                16,
                32,
                64,
                128,
                256,
                -256,
                1000,
                65535,
                46341,
                i32::MAX,
                i32::MAX - 1,
                i32::MIN,
                i32::MIN + 1,
            ];
            let mut list: Vec<Bits> = edges.iter().map(|n| model::from_int(*n)).collect();
            list.extend(draw((-1000i32..1000).prop_map(model::from_int).boxed(), 10));
            list.extend(draw(any::<i32>().prop_map(model::from_int).boxed(), 10));
            list
        }
    }
}

pub fn value(bits: Bits, format: Format) -> Value {
    (RUNTIME.decode)(bits, format)
}

/// The operand tuples of a routine's domain.
pub fn cases(r: &Routine) -> Vec<Vec<Bits>> {
    let pools: Vec<Vec<Bits>> = r.args.iter().map(|f| operands(*f)).collect();
    let mut all = vec![Vec::new()];
    for pool in &pools {
        all = all
            .iter()
            .flat_map(|head: &Vec<Bits>| pool.iter().map(|b| [head.as_slice(), &[*b]].concat()))
            .collect();
    }
    all.retain(|args| {
        let values: Vec<Value> = args
            .iter()
            .zip(r.args)
            .map(|(b, f)| value(*b, *f))
            .collect();
        let ranges: Vec<Range> = values.iter().map(|v| Range::point(v.real())).collect();
        (r.domain)(&ranges, Range::point(r.op.eval(&values).real()))
    });
    all
}
