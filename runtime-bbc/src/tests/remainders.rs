//! Remainders and nearest whole numbers, where a quotient or a sum is rounded: near multiples of
//! the modulus, and near what lies in the middle between whole numbers.

use super::*;

/// The reals nearest to one, and itself.
fn around(x: f64) -> Vec<Bits> {
    let bits = Real40::from_f64(x).unwrap().to_bits();
    // The mantissa counts on into the exponent, if the sign between them is left out.
    let sign = bits & 1 << 31;
    let size = (bits >> 32) << 31 | bits & 0x7fff_ffff;
    let near = (-3i64..=3).filter_map(|off| size.checked_add_signed(off));
    near.map(|size| (size >> 31) << 32 | sign | size & 0x7fff_ffff)
        .collect()
}

fn routine(name: &str) -> &'static Routine {
    RUNTIME.routines.iter().find(|r| r.name == name).unwrap()
}

fn real_of(bits: Bits) -> f64 {
    Real40::from_bits(bits).to_f64()
}

/// Holds a routine's model against the definition where its domain has a value, and the machine
/// against its model on some of them; how many values that were.
fn holds(name: &str, cases: &[Vec<Bits>], some: usize) -> usize {
    let r = routine(name);
    let mut inside = cases.to_vec();
    inside.retain(|args| {
        let ranges: Vec<Range> = args.iter().map(|b| Range::point(real_of(*b))).collect();
        let values: Vec<Value> = args.iter().map(|b| Value::Real(real_of(*b))).collect();
        (r.domain)(&ranges, Range::point(r.op.eval(&values).real()))
    });
    for args in &inside {
        let values: Vec<Value> = args.iter().map(|b| Value::Real(real_of(*b))).collect();
        let exact = r.op.eval(&values).real();
        let got = value((r.model)(args), r.result).real();
        let allowed = r.error.most(&[], exact);
        assert!(
            (got - exact).abs() <= allowed,
            "{name}{values:?} = {got}, not {exact}"
        );
        if let (Op::Mod, Some(modulus)) = (r.op, args.get(1)) {
            assert!(
                0.0 <= got && got <= real_of(*modulus),
                "{name}{values:?} = {got}"
            );
        }
    }
    let step = (inside.len() / some).max(1);
    let tried: Vec<Vec<Bits>> = inside.iter().step_by(step).cloned().collect();
    let made = if tried.is_empty() {
        Vec::new()
    } else {
        run(r, &tried)
    };
    for (args, got) in tried.iter().zip(made) {
        assert_eq!(got, (r.model)(args), "{name} of {args:x?} on the machine");
    }
    inside.len()
}

#[test]
fn remainders_near_multiples_are_right() {
    let moduli = [
        1.0,
        2.0,
        4.0,
        8.0,
        16.0,
        3.0,
        5.0,
        7.0,
        12.0,
        360.0,
        1023.0,
        65_535.0,
        2.5,
        1.5,
        0.75,
        0.5,
        0.25,
        6.125,
        0.7,
        0.3,
        1.2,
        3.1,
        6.3831853,
        0.999999999,
        1.000000001,
        1e-3,
        1e-14,
        12_345.67,
        1e17,
    ];
    let mut cases = Vec::new();
    let mut runner = TestRunner::deterministic();
    for modulus in moduli {
        let own = nearest(modulus).to_f64();
        let mut quotients: Vec<f64> = (0..40).map(f64::from).collect();
        quotients.extend([
            63.0,
            64.0,
            255.0,
            1000.0,
            4095.0,
            16_383.0,
            29_999.0,
            1e5,
            8_388_607.0,
        ]);
        for _ in 0..60 {
            let some = (0.0f64..30_000.0).new_tree(&mut runner).unwrap().current();
            quotients.extend([some, some.floor()]);
        }
        for quotient in quotients {
            for a in around(quotient * own)
                .into_iter()
                .chain(around(-quotient * own))
            {
                cases.push(vec![a, nearest(modulus).to_bits()]);
            }
        }
        for tiny in [3e-39, 1e-38, 1e-30, 1e-16, 1e-15, 1.1e-15, 1e-9, 1e-4] {
            for a in [tiny, -tiny] {
                cases.push(vec![nearest(a).to_bits(), nearest(modulus).to_bits()]);
            }
        }
    }
    for (name, least) in [
        ("fract", 500),
        ("above_1", 500),
        ("above_3", 500),
        ("above_7", 500),
        ("above_15", 500),
        ("rem", 5_000),
        ("whole_rem", 5_000),
        ("FNrem", 10_000),
        ("FNrest", 20_000),
        ("FNmod_whole", 5_000),
        ("FNmod_binary", 10_000),
        ("FNmod", 30_000),
    ] {
        let tried = holds(name, &cases, 1_000);
        assert!(tried > least, "{name}: {tried}");
    }
}

#[test]
fn remainders_by_any_modulus_are_right() {
    let mut runner = TestRunner::deterministic();
    let mut cases = Vec::new();
    let any = (any::<u32>(), 100u64..=170, any::<u32>(), 0.0f64..15.0);
    for _ in 0..60_000 {
        let (mantissa, exponent, start, size) = any.new_tree(&mut runner).unwrap().current();
        let modulus = Real40::from_bits(exponent << 32 | u64::from(mantissa & 0x7fff_ffff));
        let quotient = (f64::from(start) / 4_294_967_296.0) * 2f64.powf(size);
        let quotient = [quotient, quotient.round()][(start & 1) as usize];
        let sign = [1.0, -1.0][(start >> 1 & 1) as usize];
        let near = around(sign * quotient * modulus.to_f64());
        let a = near[(start >> 2) as usize % near.len()];
        cases.push(vec![a, modulus.to_bits()]);
    }
    let tried = holds("FNrest", &cases, 2_000);
    assert!(tried > 50_000, "{tried}");
}

#[test]
fn halves_are_rounded_away_from_0() {
    let mut cases = Vec::new();
    let mut middles: Vec<f64> = (0..70).map(|n| f64::from(n) / 2.0).collect();
    middles.extend((0..31).map(|power| 2f64.powi(power) - 0.5));
    middles.extend((0..31).map(|power| 2f64.powi(power) + 0.5));
    middles.extend([
        0.25,
        1e-38,
        1e-9,
        2_147_483_646.0,
        2_147_483_647.0,
        2_147_483_648.0,
        1e10,
    ]);
    for middle in middles {
        cases.extend(around(middle).into_iter().map(|a| vec![a]));
        cases.extend(around(-middle).into_iter().map(|a| vec![a]));
    }
    for (name, least) in [("round_up", 800), ("round", 1_600), ("FNround", 1_700)] {
        let tried = holds(name, &cases, 2_000);
        assert!(tried > least, "{name}: {tried}");
    }
}

#[test]
fn what_tests_allow_is_the_same() {
    let mut cases = Vec::new();
    for modulus in [
        1.0, 2.0, 4.0, 8.0, 16.0, 3.0, 100.0, 65_535.0, 2.5, 6.125, 0.75, 32_767.5,
    ] {
        for quotient in [
            0.0, 1.0, 2.0, 3.0, 7.0, 9.0, 100.0, 1_001.0, 11_999.0, 15_000.0, 1e7, 9e8,
        ] {
            for a in around(quotient * modulus)
                .into_iter()
                .chain(around(-quotient * modulus))
            {
                cases.push([a, nearest(modulus).to_bits()]);
            }
        }
    }
    let all = guards::GUARDED
        .iter()
        .filter(|g| routine(g.name).op == Op::Mod);
    for guarded in all {
        let (full, cheap) = (routine(guarded.name), routine(guarded.cheap));
        let mut tried = 0;
        for args in &cases {
            let known = args.map(|b| Range::point(real_of(b)));
            let passes = |(k, test): &(usize, guards::Test)| test.holds(real_of(args[*k]));
            if (full.domain)(&known, Range::ALL) && guarded.when.iter().all(passes) {
                assert_eq!(
                    (full.model)(args),
                    (cheap.model)(args),
                    "{} of {args:x?}",
                    full.name
                );
                tried += 1;
            }
        }
        assert!(tried > 100, "{}: {tried}", guarded.name);
    }
}
