#![allow(clippy::unwrap_used)]

use super::text::{NumberFormat, Parsed, parse, to_text};
use super::*;
use proptest::prelude::*;

/// Measured on the genuine ROM: A, B, A+B, A-B, A*B, A/B, SQR ABS A, five bytes each.
const ROM: [&str; 23] = [
    "862B000000 7984730000 862AFBDC68 862B042398 7EB0F1A200 8EA5417B51 83513A2675",
    "7D0B000000 86B8310000 86B7EB8000 8638768000 82C8053600 77C130B9FB 7F0562FBE3",
    "812B000000 85CE6B0000 85C3BB0000 85591B0000 8689E17900 7CD4131665 8113F228DE",
    "8354000000 7B3C600000 8354BC6000 835343A000 7E1BFF8000 89100D9705 8224BAE6AB",
    "8785000000 7F5C090000 878423F700 8785DC0900 85E4A15A00 889ABD2922 840279DE82",
    "8724335CCD 8724335CCE 8824335CCD 6880000000 8D52A3B26B 807FFFFFFE 8410F989EB",
    "8629E74604 7E2FE87DA8 862A972E82 8629375D86 83697ECBB3 887742E156 83508E21E9",
    "81C43E3D98 8267BD9062 82059E7196 83A4EE5797 83B1A57A36 7FD8C96123 811E7D78F3",
    "80D8AF7A96 882F6B7F7D 882E92D002 88B0442EF8 88947AF20E 799E1C4D21 806B861A54",
    "83B8339BB6 7EF9BA4E15 83C0016E27 83B065C945 8133B04022 853CD3FBFD 82198CF7D3",
    "79463F0000 88A4C5BAF5 88A4C42E77 8824C74773 80FF32F685 729A00DBE5 7D1F4C0127",
    "7B03D44631 7E5556A4CF 7E65D12D95 7EC4DC1C09 785BB8792A 7D1E30F511 7E01E68675",
    "7A90F8CA61 8459D26DC8 8459AE2F95 84D9F6ABFB 7DF6B41B9B 76AA619C03 7D40A594DB",
    "7E9986529B 7A7361B1BF 7E8A50377F 7EA8BC6DB7 7891F516E7 84A17BFE6C 7F463F85B7",
    "855AA90000 7A242586C2 855ABD84B1 855A947B4F 7F0C345187 8C2A82599B 83274C3211",
    "7982385680 80162DB662 80152945B5 809732270F 7898C886B8 79DDFA5E75 7D011AF285",
    "7EAC7E11E0 7BD2BD6314 7EC6D5BE43 7E9226657D 790DFF067F 835189D1B6 7F5223621F",
    "79103B41B1 7C5D5F1B3C 7C6F668372 7CCB57B306 7479717A16 7D26CB0D6F 7D07DFA297",
    "8501872CCE 80994724B2 847979E751 85065165F4 849B1B91AB 85D8556CEE 8300C301DB",
    "805303BA5E 7EE5E8A104 801989921D 81063EF14F 7EBD8215D0 82EAF62E60 80686BE3CE",
    "8285B9E93C 82E582BF0A 83B59E5423 813F91AB9C 836FC733AC 8015290FBB 8139062A44",
    "8756460000 88DF000000 87E7BA0000 8925118000 8FBAA6FA00 7FF5FB6877 84259C69D7",
    "857C9EDCB9 7F112E6292 857EE39643 857A5A232F 840F43C0D5 875EB98320 8333D20FBB",
];

fn real(hex: &str) -> Real40 {
    Real40::from_bits(u64::from_str_radix(hex, 16).unwrap())
}

fn num(text: &str) -> Real40 {
    match parse(text.as_bytes()).unwrap().unwrap().0 {
        Parsed::Int(n) => Real40::from_i32(n),
        Parsed::Real(x) => x,
    }
}

#[test]
fn agrees_with_the_rom() {
    for line in ROM {
        let v: Vec<Real40> = line.split(' ').map(real).collect();
        let (a, b) = (v[0], v[1]);
        assert_eq!(arith::add(a, b), Ok(v[2]), "{line} +");
        assert_eq!(arith::sub(a, b), Ok(v[3]), "{line} -");
        assert_eq!(arith::mul(a, b), Ok(v[4]), "{line} *");
        assert_eq!(arith::div(a, b), Ok(v[5]), "{line} /");
        assert_eq!(arith::sqrt(a.abs()), Ok(v[6]), "{line} SQR");
    }
}

/// The stated rule for a wide value m / 2^`point` (m has any number of bits up to 127): normalise to 40
/// bits, truncating, then round with the &80 => OR 1 rule.
fn reference_round(negative: bool, mut exp: i32, mut wide: u128) -> Real40 {
    if wide == 0 {
        return Real40::ZERO;
    }
    while wide >> 40 != 0 {
        wide >>= 1;
        exp += 1;
    }
    while wide >> 39 == 0 {
        wide <<= 1;
        exp -= 1;
    }
    let guard = wide & 255;
    let mut m = wide >> 8;
    if guard == 128 {
        m |= 1;
    } else if guard > 128 {
        m += 1;
    }
    if m >> 32 != 0 {
        m >>= 1;
        exp += 1;
    }
    arith::pack(negative, exp, m as u32).unwrap_or(Real40::MAX)
}

fn reference_mul(a: Real40, b: Real40) -> Real40 {
    let mut w = u128::from(a.mantissa()) << 8;
    let mut sum = 0u128;
    for bit in (0..32).rev() {
        w >>= 1;
        if b.mantissa() >> bit & 1 == 1 {
            sum += w;
        }
    }
    let exp = i32::from(a.exponent()) + i32::from(b.exponent()) - 128;
    reference_round(a.is_negative() != b.is_negative(), exp, sum)
}

fn reference_div(a: Real40, b: Real40) -> Real40 {
    let mut rest = u128::from(a.mantissa());
    let below = u128::from(b.mantissa());
    let mut quotient = 0u128;
    for _ in 0..39 {
        quotient <<= 1;
        if rest >= below {
            rest -= below;
            quotient |= 1;
        }
        rest <<= 1;
    }
    let exp = i32::from(a.exponent()) - i32::from(b.exponent()) + 129;
    reference_round(a.is_negative() != b.is_negative(), exp, quotient << 1)
}

fn reference_add(a: Real40, b: Real40) -> Real40 {
    let exp = a.exponent().max(b.exponent());
    let place = |x: Real40| {
        let gap = u32::from(exp - x.exponent());
        let size = (u128::from(x.mantissa()) << 8)
            .checked_shr(gap)
            .unwrap_or(0) as i128;
        if x.is_negative() { -size } else { size }
    };
    let sum = place(a) + place(b);
    reference_round(sum < 0, i32::from(exp), sum.unsigned_abs())
}

fn any_real() -> impl Strategy<Value = Real40> {
    prop_oneof![
        (64u64..=192, any::<u32>()).prop_map(|(e, m)| Real40::from_bits(e << 32 | u64::from(m))),
        (-70000i32..70000).prop_map(Real40::from_i32),
        (120u64..=136, any::<u8>())
            .prop_map(|(e, m)| Real40::from_bits(e << 32 | u64::from(m) << 24)),
        Just(Real40::ZERO),
    ]
}

proptest! {
    #[test]
    fn arithmetic_is_the_stated_algorithm(a in any_real(), b in any_real()) {
        prop_assert_eq!(arith::add(a, b).unwrap(), reference_add(a, b));
        prop_assert_eq!(arith::sub(a, b).unwrap(), reference_add(a, b.negate()));
        if !a.is_zero() && !b.is_zero() {
            prop_assert_eq!(arith::mul(a, b).unwrap_or(Real40::MAX).abs(), reference_mul(a, b).abs());
            prop_assert_eq!(arith::div(a, b).unwrap_or(Real40::MAX).abs(), reference_div(a, b).abs());
        }
    }

    #[test]
    fn square_roots_are_within_three_quarters_of_a_unit(a in any_real()) {
        let a = a.abs();
        let root = arith::sqrt(a).unwrap().to_f64();
        let ulp = 2f64.powi(-31) * root;
        prop_assert!((root - a.to_f64().sqrt()).abs() <= 0.75 * ulp, "{a:?} {root}");
    }

    #[test]
    fn any_bits_survive_every_operation(x in any::<u64>(), y in any::<u64>()) {
        let (a, b) = (Real40::from_bits(x), Real40::from_bits(y));
        let _ = (arith::add(a, b), arith::mul(a, b), arith::div(a, b), arith::sqrt(a), elementary::pow(a, b));
        let _ = (a.to_i32(), a.int_floor(), elementary::sin(a), elementary::exp(a), elementary::atn(a));
        for at in [0, 0x90a, 0x2020a, 0x1030a] {
            let text = to_text(a, NumberFormat::from_at_percent(at));
            prop_assert!(parse(text.trim_start_matches('-').as_bytes()).is_ok());
        }
        prop_assert_eq!(Real40::from_f64(a.to_f64()), Ok(a));
        prop_assert_eq!(Real40::from_bytes(a.to_bytes()), a);
    }

    #[test]
    fn order_is_that_of_the_values(a in any_real(), b in any_real()) {
        prop_assert_eq!(Some(a.compare(b)), a.to_f64().partial_cmp(&b.to_f64()));
    }

    #[test]
    fn ten_digits_read_back(n in 1u64..10_000_000_000, power in -30i32..20) {
        let x = num(&format!("{n}E{power}"));
        let y = format!("{n}e{power}").parse::<f64>().unwrap();
        // Half a unit of the last place, and what powers of ten lose in 40 bits: a tenth is
        // five roundings and a shift, ten times a rounding and a shift (`decimal.rs`), each
        // of half a unit there, at most 2^-40 of the number.
        let losses = if power < 0 { -6 * power } else { 2 * power };
        let part = 2f64.powi(-32) + f64::from(losses) * 2f64.powi(-40);
        prop_assert!((x.to_f64() - y).abs() <= part * y.abs() * 1.000_001);
    }

    #[test]
    fn any_text_is_read_or_refused(text in prop::collection::vec(prop::sample::select(b"0159.E-+ ".to_vec()), 0..40)) {
        if let Ok(Some((_, used))) = parse(&text) {
            prop_assert!(used <= text.len());
        }
    }
}

#[test]
fn integers() {
    for n in [0, 1, -1, 7, 65535, 1 << 30, i32::MAX, -i32::MAX] {
        assert_eq!(Real40::from_i32(n).to_i32(), Ok(n));
    }
    assert_eq!(Real40::from_i32(i32::MIN).to_i32(), Err(RealError::TooBig));
    assert_eq!(num("2147483648").to_i32(), Err(RealError::TooBig));
    assert_eq!(num("7.9").negate().to_i32(), Ok(-7));
    assert_eq!(num("7.9").negate().int_floor(), Ok(-8));
    assert_eq!(num("7").negate().int_floor(), Ok(-7));
    assert_eq!(num(".25").negate().int_floor(), Ok(-1));
    assert_eq!(num("1E10").int_floor(), Err(RealError::TooBig));
}

#[test]
fn decimals_as_the_rom_prints_them() {
    let at = NumberFormat::from_at_percent(0x90a);
    for (text, printed) in [
        ("1E9", "1E9"),
        ("4294967297", "4.2949673E9"),
        ("9999999999", "1E10"),
        ("12345678901", "1.23456789E10"),
        ("1.7E38", "1.7E38"),
        ("1E-38", "1E-38"),
        ("1E-39", "0"),
        ("0.00001", "1E-5"),
        (".1", "0.1"),
        ("0.05", "5E-2"),
        ("0.0123456", "1.23456E-2"),
        ("123456789", "123456789"),
        ("1234567890", "1.23456789E9"),
        ("99999999.95", "99999999.9"),
        ("0.999999999999", "1"),
        ("3E5", "300000"),
    ] {
        assert_eq!(to_text(num(text), at), printed, "{text}");
    }
    let third = arith::div(Real40::ONE, num("3")).unwrap();
    assert_eq!(to_text(third, at), "0.333333333");
    assert_eq!(to_text(third, NumberFormat::STR), "0.3333333334");
    for (text, at, printed) in [
        ("0", 0x2020a, "0.00"),
        ("1234.5678", 0x2020a, "1234.57"),
        ("99.999", 0x2020a, "100.00"),
        ("1E10", 0x2020a, "1E10"),
        ("123456789", 0x2020a, "123456789"),
        ("2.5", 0x2000a, "3."),
        ("0", 0x2000a, "0."),
        ("5E-7", 0x2050a, "0.00000"),
        ("0.995", 0x2050a, "0.99500"),
        ("0", 0x1030a, "0.00E0  "),
        ("1E10", 0x1030a, "1.00E10 "),
        ("99.999", 0x1030a, "1.00E2  "),
        ("0.995", 0x1030a, "9.95E-1 "),
        ("1234.5678", 0x30a, "1.23E3"),
        ("99.999", 0, "99.99900001"),
        ("5E-7", 0, "5.000000001E-7"),
    ] {
        let format = NumberFormat::from_at_percent(at);
        assert_eq!(to_text(num(text), format), printed, "{text} {at:x}");
    }
    assert_eq!(parse(b"2E38"), Err(RealError::TooBig));
    assert_eq!(parse(b"X"), Ok(None));
    assert_eq!(parse(b"12abc"), Ok(Some((Parsed::Int(12), 2))));
}
