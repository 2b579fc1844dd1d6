//! What the routines compute, step by step as BASIC does.

use slowlight_isa::real40::{Real40, arith, elementary};
use slowlight_routine::Bits;

use crate::{BIG, FAR, nearest};

/// The bits of an int: sign-extended.
pub fn from_int(n: i32) -> Bits {
    i64::from(n) as u64
}

/// The int of bits.
pub fn int(bits: Bits) -> i32 {
    bits as i32
}

/// The real of bits.
pub fn real(bits: Bits) -> Real40 {
    Real40::from_bits(bits)
}

pub fn big() -> Real40 {
    nearest(BIG)
}

/// SGN(s) times the largest value.
fn signed_big(s: i32) -> Real40 {
    if s < 0 { big().negate() } else { big() }
}

/// Outside a routine's domain BASIC stops with an error; the model saturates.
pub fn plain(x: Result<Real40, slowlight_isa::real40::RealError>) -> Real40 {
    x.unwrap_or_else(|_| big())
}

fn whole(x: i32) -> Real40 {
    Real40::from_i32(x)
}

pub fn add(a: Real40, b: Real40) -> Real40 {
    plain(arith::add(a, b))
}

pub fn mul(a: Real40, b: Real40) -> Real40 {
    plain(arith::mul(a, b))
}

pub fn div(a: Real40, b: Real40) -> Real40 {
    plain(arith::div(a, b))
}

/// `FNadd`.
pub fn fn_add(a: Real40, b: Real40) -> Real40 {
    let limit = div(big(), whole(2));
    let half = add(div(a, whole(2)), div(b, whole(2)));
    if (a.abs() < limit && b.abs() < limit) || half.abs() < limit {
        return add(a, b);
    }
    signed_big(half.signum())
}

/// `FNmul`.
pub fn fn_mul(a: Real40, b: Real40) -> Real40 {
    if b.abs() > Real40::ONE && a.abs() > div(big(), b.abs()) {
        return signed_big(a.signum() * b.signum());
    }
    mul(a, b)
}

/// `FNdiv`.
pub fn fn_div(a: Real40, b: Real40) -> Real40 {
    let far = nearest(FAR);
    if b.is_zero() {
        return mul(whole(a.signum()), far);
    }
    if div(a, far).abs() > b.abs() {
        return if a.signum() * b.signum() < 0 {
            far.negate()
        } else {
            far
        };
    }
    div(a, b)
}

/// `FNsqr`.
pub fn fn_sqr(a: Real40) -> Real40 {
    if a.signum() > 0 {
        plain(arith::sqrt(a))
    } else {
        Real40::ZERO
    }
}

/// `FNmod`: the remainder by halving steps, each exact; then the divisor's sign.
pub fn fn_mod(a: Real40, b: Real40) -> Real40 {
    if b.is_zero() {
        return Real40::ZERO;
    }
    let two = whole(2);
    let size = b.abs();
    let mut rest = a.abs();
    let mut step = size;
    while step <= div(rest, two) {
        step = mul(step, two);
    }
    while step >= size {
        if rest >= step {
            rest = plain(arith::sub(rest, step));
        }
        if step.exponent() <= 1 {
            break;
        }
        step = div(step, two);
    }
    if a.is_negative() {
        rest = rest.negate();
    }
    if !rest.is_zero() && rest.is_negative() != b.is_negative() {
        rest = add(rest, b);
    }
    rest
}

/// a - INT(q)*b, with q = a/b.
fn less_multiple(a: Real40, q: Real40, b: Real40) -> Real40 {
    let whole = whole(q.int_floor().unwrap_or(0));
    plain(arith::sub(a, mul(whole, b)))
}

/// The remainder by one quotient.
pub fn rem(a: Real40, b: Real40) -> Real40 {
    less_multiple(a, div(a, b), b)
}

/// The same by the quotient of the floor.
pub fn whole_rem(a: Real40, b: Real40) -> Real40 {
    let floor = whole(a.int_floor().unwrap_or(0));
    less_multiple(a, div(floor, b), b)
}

/// The remainder by a power of two: the bits of the floor above it are taken off.
pub fn masked_rem(a: Real40, b: i32) -> Real40 {
    let multiple = a.int_floor().unwrap_or(0) & -b;
    plain(arith::sub(a, whole(multiple)))
}

/// `FNrem`.
pub fn fn_rem(a: Real40, b: Real40) -> Real40 {
    if a.is_negative() && a > nearest(1e-15).negate() {
        return add(a, b);
    }
    rem(a, b)
}

/// `FNrest`.
pub fn fn_rest(a: Real40, b: Real40) -> Real40 {
    let sub = |a, b| plain(arith::sub(a, b));
    let wide = mul(b, whole(65_537));
    let upper = sub(wide, sub(wide, b));
    let quotient = whole(div(a, b).int_floor().unwrap_or(0));
    let rest = sub(a, mul(quotient, upper));
    let rest = sub(rest, mul(quotient, sub(b, upper)));
    match rest.is_negative() {
        true => add(rest, b),
        false => rest,
    }
}

/// `FNfloor`.
pub fn fn_floor(a: Real40) -> i32 {
    if a >= nearest(2_147_483_648.0) {
        return i32::MAX;
    }
    if a <= nearest(-2_147_483_648.0) {
        return i32::MIN;
    }
    a.int_floor().unwrap_or(0)
}

/// Half away from zero. The sum is never rounded up to a whole number: one that lies in the middle
/// between two reals gets the odd one.
pub fn round(a: Real40) -> i32 {
    let n = add(a.abs(), nearest(0.5)).int_floor().unwrap_or(0);
    a.signum().wrapping_mul(n)
}

/// `FNround`.
pub fn fn_round(a: Real40) -> i32 {
    let most = whole(i32::MAX);
    if a.abs() < most {
        return round(a);
    }
    if a >= most {
        return i32::MAX;
    }
    if a > add(nearest(0.5), nearest(-2_147_483_648.0)) {
        return -i32::MAX;
    }
    i32::MIN
}

pub fn fn_sin(a: Real40) -> Real40 {
    plain(elementary::sin(reduced(a)))
}

pub fn fn_cos(a: Real40) -> Real40 {
    plain(elementary::cos(reduced(a)))
}

/// Large angles are taken modulo twice PI, roughly.
fn reduced(a: Real40) -> Real40 {
    if a.abs() < nearest(1e5) {
        a
    } else {
        fn_mod(a, mul(whole(2), pi()))
    }
}

/// BASIC's PI.
pub fn pi() -> Real40 {
    Real40::from_bits(0x82_490f_daa2)
}

pub fn fn_tan(a: Real40) -> Real40 {
    fn_div(fn_sin(a), fn_cos(a))
}

fn clamped(a: Real40) -> Real40 {
    if a.abs() > Real40::ONE {
        whole(a.signum())
    } else {
        a
    }
}

pub fn fn_asin(a: Real40) -> Real40 {
    plain(elementary::asn(clamped(a)))
}

pub fn fn_acos(a: Real40) -> Real40 {
    plain(elementary::acs(clamped(a)))
}

/// `FNatan2`: y first.
pub fn fn_atan2(a: Real40, b: Real40) -> Real40 {
    let atn = |x| plain(elementary::atn(x));
    if a.abs() > b.abs() {
        let quarter = div(mul(whole(a.signum()), pi()), whole(2));
        return plain(arith::sub(quarter, atn(div(b, a))));
    }
    if b.is_zero() {
        return Real40::ZERO;
    }
    let angle = atn(div(a, b));
    if b.signum() > 0 {
        angle
    } else if a.is_negative() {
        plain(arith::sub(angle, pi()))
    } else {
        add(angle, pi())
    }
}

pub fn fn_exp(a: Real40) -> Real40 {
    if a > whole(88) {
        return big();
    }
    if a < whole(-88) {
        return Real40::ZERO;
    }
    plain(elementary::exp(a))
}

pub fn fn_ln(a: Real40) -> Real40 {
    if a.signum() > 0 {
        plain(elementary::ln(a))
    } else {
        big().negate()
    }
}

/// `FNpow`.
pub fn fn_pow(a: Real40, b: Real40) -> Real40 {
    if b.is_zero() {
        return Real40::ONE;
    }
    if a.is_zero() {
        return if b.is_negative() { big() } else { Real40::ZERO };
    }
    let mut sign = 1;
    if a.is_negative() {
        let rest = fn_mod(b, whole(2));
        if rest != plain(elementary::pow(rest, whole(2))) {
            return Real40::ZERO;
        }
        sign = if rest.is_zero() { 1 } else { -1 };
    }
    let power = fn_exp(fn_mul(b, plain(elementary::ln(a.abs()))));
    mul(whole(sign), power)
}

/// `FNidiv`: floors.
pub fn fn_idiv(a: i32, b: i32) -> i32 {
    match b {
        0 if a == 0 => 0,
        0 if a > 0 => i32::MAX,
        0 => i32::MIN,
        -1 => a.saturating_neg(),
        _ => a.wrapping_div(b) - i32::from(a.wrapping_rem(b) != 0 && (a < 0) != (b < 0)),
    }
}

/// `FNimod`: the divisor's sign.
pub fn fn_imod(a: i32, b: i32) -> i32 {
    if b == 0 {
        return 0;
    }
    let rest = a.wrapping_rem(b);
    if rest != 0 && (rest < 0) != (b < 0) {
        rest.wrapping_add(b)
    } else {
        rest
    }
}
