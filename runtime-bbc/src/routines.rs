//! The list of routines: for each operation the cheap and restricted ones first.
//!
//! Cycles are BASIC II's for the operation alone, from the table of whole statements measured on
//! the ROM; those of products, sines and functions of our own are means over whole programs
//! (`cargo bench --bench prices`), whose operands are shorter and whose guards mostly hold. Bytes
//! are those of the operator.

use slowlight_isa::real40::{Real40, arith, elementary};
use slowlight_routine::{Error, Form, Format, Op, Range, Routine, everywhere};

use crate::level::{AND, COMPARE, OPERAND, OR, POWER, PRODUCT, SUM};
use crate::model::{self as m, from_int, int, plain, real};
use crate::{INT as I, REAL as R, nearest};

const B: Format = Format::Bool;
const EXACT: Error = Error::Exact;
/// The worst of + - * and /: 0.56 units in the last place of 32 bits.
const ULP: Error = Error::Relative(2.7e-10);
/// SQR's worst: 0.75 units.
const ROOT: Error = Error::Relative(3.6e-10);
/// Two sums, one behind the other.
const TWICE: Error = Error::Relative(8e-10);
/// `EXP`: a product with e (2.2e-10 from the real one, rounded by 2.4e-10) for each of up to 88
/// units, and a fraction for the rest, off by 8e-10 at most of a hundred thousand arguments.
const POWERS_OF_E: Error = Error::Growing {
    relative: 1.5e-9,
    each: 4.7e-10,
    most: 88.1,
};
/// `LN`: a multiple of LN(2), and a fraction that takes at most half of it away again.
const LOGARITHM: Error = Error::Relative(2e-9);

/// Sums of what may be BASIC integers stay far from wrapping.
const SMALL: f64 = 1_073_741_824.0;
/// Far from overflow.
const HUGE: f64 = 1e38;
/// Ints without the ends, which may stand for what saturated.
const WHOLE: f64 = i32::MAX as f64 - 1.0;
/// BASIC integers lie within this.
const INTEGERS: f64 = 2_147_483_648.0;

/// A sum: small, or no overflow and one side certainly a real in BASIC.
fn sum(args: &[Range], result: Range) -> bool {
    result.within(-SMALL, SMALL)
        || result.within(-HUGE, HUGE) && args.iter().any(|a| !a.within(-INTEGERS, INTEGERS))
}

/// Not the least BASIC integer, which has no negative.
fn negatable(args: &[Range], _: Range) -> bool {
    args.iter()
        .all(|a| a.lo > -INTEGERS || !a.within(-INTEGERS, INTEGERS))
}

fn finite(_: &[Range], result: Range) -> bool {
    result.within(-HUGE, HUGE)
}

fn fits_int(_: &[Range], result: Range) -> bool {
    result.within(-WHOLE, WHOLE)
}

fn nonzero(args: &[Range], k: usize) -> bool {
    args.get(k).is_some_and(|r| r.nonzero)
}

fn arg(args: &[Range], lo: f64, hi: f64) -> bool {
    args.first().is_some_and(|a| a.within(lo, hi))
}

fn constant(args: &[Range], k: usize) -> Option<f64> {
    args.get(k).and_then(|r| r.constant())
}

/// BASIC's ^ by repeated multiplication: exact powers, any base.
fn whole_power(args: &[Range], result: Range) -> bool {
    matches!(constant(args, 1), Some(p) if (1.0..=8.0).contains(&p) && p.fract() == 0.0)
        && result.within(-1e37, 1e37)
}

/// Factors that BASIC II multiplies as integers; it makes reals of larger ones first.
fn narrow(args: &[Range], result: Range) -> bool {
    args.iter().all(|a| a.within(-32_767.0, 32_767.0)) && fits_int(args, result)
}

/// Both not negative, the second not 0: truncation floors.
fn natural(args: &[Range], _: Range) -> bool {
    args.iter().all(|a| a.lo >= 0.0) && nonzero(args, 1)
}

/// Not so large that a floor of it is no BASIC integer.
fn small(args: &[Range]) -> bool {
    arg(args, -SMALL, SMALL)
}

/// A constant modulus, above 0, as BASIC reads it; not so large that quotients vanish.
fn modulus(args: &[Range]) -> Option<Real40> {
    let real = nearest(constant(args, 1)?);
    let kept = constant(args, 1) == Some(real.to_f64());
    (kept && real > nearest(1e-15) && real < nearest(1e15)).then_some(real)
}

/// Whether the multiples of a constant modulus are reals as far as the quotient goes. Then the
/// quotient, as it is rounded, has the floor of the exact one: what lies so near a multiple that
/// they would differ is no real.
fn multiples(args: &[Range]) -> bool {
    let (Some(modulus), Some(a)) = (modulus(args), args.first()) else {
        return false;
    };
    let bits = 32 - modulus.mantissa().trailing_zeros() as i32;
    let most = a.magnitude() / modulus.to_f64() + 1.0;
    small(args) && most < 2f64.powi((32 - bits).min(31))
}

/// Those, and no quotient below 0 that vanishes instead of being floored to -1.
fn plain_multiples(args: &[Range], _: Range) -> bool {
    let below = || modulus(args).is_some_and(|m| m <= Real40::ONE);
    multiples(args) && (arg(args, 0.0, f64::MAX) || below())
}

/// Those of a whole number: floors are whole, and their quotients do not vanish.
fn whole_multiples(args: &[Range], _: Range) -> bool {
    multiples(args) && constant(args, 1).is_some_and(|m| m.fract() == 0.0)
}

/// A constant modulus that has no bits below 2^-15 and none above 2^15: its multiples are reals as
/// far as those tests of the argument go under which `FNmod` is left out.
fn binary(args: &[Range], _: Range) -> bool {
    let bits = |m: Real40| m.to_f64() < 32_768.0 && (m.to_f64() * 32_768.0).fract() == 0.0;
    modulus(args).is_some_and(bits)
}

/// The same of whole numbers, up to 2^16.
fn whole_modulus(args: &[Range], _: Range) -> bool {
    modulus(args).is_some_and(|m| m.to_f64() < 65_536.0 && m.to_f64().fract() == 0.0)
}

/// A modulus that may be cut in halves of 17 bits, and quotients of 15.
fn halves(args: &[Range], _: Range) -> bool {
    let divisor = |m: &Range| m.lo >= 1e-15 && m.hi <= 1e18 && m.nonzero;
    args.get(1)
        .is_some_and(|m| divisor(m) && arg(args, -30_000.0 * m.lo, 30_000.0 * m.lo))
}

const fn form(template: &'static str, level: u8, operands: &'static [u8]) -> Form {
    Form::Expression {
        template,
        level,
        operands,
    }
}

const fn call(template: &'static str) -> Form {
    form(template, OPERAND, &[0, 0])
}

/// A routine: name, operation, formats, form, needs, domain, error, model, cycles, bytes.
/// The letter before each argument says how the model reads it.
macro_rules! routine {
    ($name:literal $op:ident($($arg:ident),+) -> $result:ident, $form:expr, [$($need:literal),*],
     $domain:expr, $error:expr, |$($x:ident: $read:ident),+| $body:expr, $cycles:literal, $bytes:literal) => {
        Routine {
            name: $name,
            op: Op::$op,
            args: &[$($arg),+],
            result: $result,
            form: $form,
            needs: &[$($need),*],
            cycles: $cycles,
            bytes: $bytes,
            domain: $domain,
            error: $error,
            model: |args| {
                let mut args = args.iter().copied();
                $(let $x = $read(args.next().unwrap_or(0));)+
                routine!(@ $result $body)
            },
        }
    };
    (@ R $body:expr) => { $body.to_bits() };
    (@ I $body:expr) => { from_int($body) };
    (@ B $body:expr) => { u64::from($body) };
}

/// MOD by a power of two, which floors by itself in two's complement.
macro_rules! and_mask {
    ($name:literal $n:literal $template:literal) => {
        routine!($name IntMod(I, I) -> I, form($template, AND, &[COMPARE, 0]), [],
            |args, _| constant(args, 1) == Some($n as f64), EXACT, |a: int, _b: int| a & ($n - 1), 526, 3)
    };
}

/// Real modulus of a power of two: the floor's bits above it are taken off.
macro_rules! and_above {
    ($name:literal $n:literal $template:literal $cycles:literal $bytes:literal) => {
        routine!($name Mod(R, R) -> R, form($template, SUM, &[SUM, 0]), [],
            |args, _| small(args) && constant(args, 1) == Some($n as f64), ULP, |a: real, _b: real| m::masked_rem(a, $n), $cycles, $bytes)
    };
}

/// `FNmod` by some moduli, by which tests of the argument allow something cheaper.
macro_rules! tested_mod {
    ($name:literal $domain:expr) => {
        routine!($name Mod(R, R) -> R, call("FNmod({0},{1})"), ["FNmod"], $domain, ULP, |a: real, b: real| m::fn_mod(a, b), 90000, 9)
    };
    ($name:literal by $n:literal) => {
        tested_mod!($name |args, _| constant(args, 1) == Some($n as f64))
    };
}

const ADD: Form = form("{0}+{1}", SUM, &[SUM, PRODUCT]);
const SUB: Form = form("{0}-{1}", SUM, &[SUM, PRODUCT]);
const MUL: Form = form("{0}*{1}", PRODUCT, &[PRODUCT, POWER]);
const NEG: Form = form("-{0}", PRODUCT, &[PRODUCT]);
const LESS: Form = form("{0}<{1}", COMPARE, &[SUM, SUM]);
const LESS_EQUAL: Form = form("{0}<={1}", COMPARE, &[SUM, SUM]);
const EQUAL: Form = form("{0}={1}", COMPARE, &[SUM, SUM]);

#[rustfmt::skip]
pub(crate) static ALL: &[Routine] = &[
    routine!("add" Add(R, R) -> R, ADD, [], sum, ULP, |a: real, b: real| m::add(a, b), 436, 1),
    routine!("FNadd" Add(R, R) -> R, call("FNadd({0},{1})"), ["FNadd"], everywhere, ULP, |a: real, b: real| m::fn_add(a, b), 13000, 9),
    routine!("sub" Sub(R, R) -> R, SUB, [], sum, ULP, |a: real, b: real| m::add(a, b.negate()), 558, 1),
    routine!("FNsub" Sub(R, R) -> R, call("FNsub({0},{1})"), ["FNsub"], everywhere, ULP, |a: real, b: real| m::fn_add(a, b.negate()), 9500, 9),
    routine!("mul" Mul(R, R) -> R, MUL, [], finite, ULP, |a: real, b: real| m::mul(a, b), 2600, 1),
    routine!("FNmul" Mul(R, R) -> R, call("FNmul({0},{1})"), ["FNmul"], everywhere, ULP, |a: real, b: real| m::fn_mul(a, b), 5900, 9),
    routine!("div" Div(R, R) -> R, form("{0}/{1}", PRODUCT, &[PRODUCT, POWER]), [],
        |args, result| nonzero(args, 1) && finite(args, result), ULP, |a: real, b: real| m::div(a, b), 3427, 1),
    routine!("FNdiv" Div(R, R) -> R, call("FNdiv({0},{1})"), ["FNdiv"], everywhere, ULP, |a: real, b: real| m::fn_div(a, b), 5700, 9),
    routine!("neg" Neg(R) -> R, NEG, [], negatable, EXACT, |a: real| a.negate(), 120, 1),
    routine!("FNneg" Neg(R) -> R, call("FNneg({0})"), ["FNneg"], everywhere, EXACT, |a: real| a.negate(), 5000, 8),
    routine!("abs" Abs(R) -> R, call("ABS({0})"), [], negatable, EXACT, |a: real| a.abs(), 200, 3),
    routine!("FNabs" Abs(R) -> R, call("FNabs({0})"), ["FNabs"], everywhere, EXACT, |a: real| a.abs(), 5000, 8),
    routine!("FNmin" Min(R, R) -> R, call("FNmin({0},{1})"), ["FNmin"], everywhere, EXACT, |a: real, b: real| a.min(b), 6700, 9),
    routine!("FNmax" Max(R, R) -> R, call("FNmax({0},{1})"), ["FNmax"], everywhere, EXACT, |a: real, b: real| a.max(b), 6700, 9),
    routine!("sqr" Sqrt(R) -> R, call("SQR({0})"), [], |args, _| arg(args, 0.0, f64::MAX), ROOT, |a: real| plain(arith::sqrt(a.abs())), 18100, 3),
    routine!("FNsqr" Sqrt(R) -> R, call("FNsqr({0})"), ["FNsqr"], everywhere, ROOT, |a: real| m::fn_sqr(a), 24000, 8),
    and_above!("fract" 1 "{0}-INT({0})" 2400 6),
    and_above!("above_1" 2 "{0}-(INT({0}) AND -2)" 3200 11),
    and_above!("above_3" 4 "{0}-(INT({0}) AND -4)" 3200 11),
    and_above!("above_7" 8 "{0}-(INT({0}) AND -8)" 3200 11),
    and_above!("above_15" 16 "{0}-(INT({0}) AND -16)" 3200 12),
    routine!("rem" Mod(R, R) -> R, form("{0}-INT({0}/{1})*{1}", SUM, &[PRODUCT, POWER]), [], plain_multiples, ULP, |a: real, b: real| m::rem(a, b), 9300, 10),
    routine!("whole_rem" Mod(R, R) -> R, form("{0}-INT(INT({0})/{1})*{1}", SUM, &[PRODUCT, POWER]), [], whole_multiples, ULP, |a: real, b: real| m::whole_rem(a, b), 9000, 13),
    routine!("FNrem" Mod(R, R) -> R, call("FNrem({0},{1})"), ["FNrem"], |args, _| multiples(args), ULP, |a: real, b: real| m::fn_rem(a, b), 18400, 9),
    routine!("FNrest" Mod(R, R) -> R, call("FNrest({0},{1})"), ["FNrest"], halves, TWICE, |a: real, b: real| m::fn_rest(a, b), 37800, 10),
    tested_mod!("FNmod_1" by 1),
    tested_mod!("FNmod_2" by 2),
    tested_mod!("FNmod_4" by 4),
    tested_mod!("FNmod_8" by 8),
    tested_mod!("FNmod_16" by 16),
    tested_mod!("FNmod_whole" whole_modulus),
    tested_mod!("FNmod_binary" binary),
    routine!("FNmod" Mod(R, R) -> R, call("FNmod({0},{1})"), ["FNmod"], everywhere, ULP, |a: real, b: real| m::fn_mod(a, b), 90000, 9),
    routine!("sin" Sin(R) -> R, call("SIN({0})"), [], |args, _| arg(args, -1e5, 1e5), Error::Absolute(1e-9), |a: real| plain(elementary::sin(a)), 48000, 3),
    routine!("FNsin" Sin(R) -> R, call("SIN(FNangle({0}))"), ["FNangle"], everywhere, Error::Absolute(2.0), |a: real| m::fn_sin(a), 65000, 12),
    routine!("cos" Cos(R) -> R, call("COS({0})"), [], |args, _| arg(args, -1e5, 1e5), Error::Absolute(1e-9), |a: real| plain(elementary::cos(a)), 39500, 3),
    routine!("FNcos" Cos(R) -> R, call("COS(FNangle({0}))"), ["FNangle"], everywhere, Error::Absolute(2.0), |a: real| m::fn_cos(a), 44000, 12),
    routine!("tan" Tan(R) -> R, call("TAN({0})"), [], |args, _| arg(args, -1.5, 1.5), Error::Relative(1e-8), |a: real| plain(elementary::tan(a)), 95000, 3),
    routine!("FNtan" Tan(R) -> R, call("FNtan({0})"), ["FNtan"], everywhere, Error::Absolute(f64::MAX), |a: real| m::fn_tan(a), 140000, 8),
    routine!("asn" Asin(R) -> R, call("ASN({0})"), [], |args, _| arg(args, -1.0, 1.0), Error::Absolute(1e-9), |a: real| plain(elementary::asn(a)), 75000, 3),
    routine!("FNasn" Asin(R) -> R, call("ASN(FNclamp({0}))"), ["FNclamp"], everywhere, Error::Absolute(1e-9), |a: real| m::fn_asin(a), 82000, 12),
    routine!("acs" Acos(R) -> R, call("ACS({0})"), [], |args, _| arg(args, -1.0, 1.0), Error::Absolute(1e-9), |a: real| plain(elementary::acs(a)), 75000, 3),
    routine!("FNacs" Acos(R) -> R, call("ACS(FNclamp({0}))"), ["FNclamp"], everywhere, Error::Absolute(1e-9), |a: real| m::fn_acos(a), 82000, 12),
    routine!("FNatan2" Atan2(R, R) -> R, call("FNatan2({0},{1})"), ["FNatan2"], everywhere, Error::Absolute(4e-9), |a: real, b: real| m::fn_atan2(a, b), 57000, 11),
    routine!("exp" Exp(R) -> R, call("EXP({0})"), [], |args, _| arg(args, -80.0, 80.0), POWERS_OF_E, |a: real| plain(elementary::exp(a)), 32500, 3),
    routine!("FNexp" Exp(R) -> R, call("FNexp({0})"), ["FNexp"], everywhere, POWERS_OF_E, |a: real| m::fn_exp(a), 42000, 8),
    routine!("ln" Log(R) -> R, call("LN({0})"), [], |args, _| arg(args, 1e-37, f64::MAX), LOGARITHM, |a: real| plain(elementary::ln(a)), 29400, 3),
    routine!("FNln" Log(R) -> R, call("FNln({0})"), ["FNln"], everywhere, LOGARITHM, |a: real| m::fn_ln(a), 36000, 7),
    routine!("whole_power" Pow(R, R) -> R, form("{0}^{1}", POWER, &[OPERAND, OPERAND]), [], whole_power, Error::Relative(3e-9), |a: real, b: real| plain(elementary::pow(a, b)), 9000, 1),
    routine!("FNpow" Pow(R, R) -> R, call("FNpow({0},{1})"), ["FNpow"], everywhere, Error::Relative(1e-6), |a: real, b: real| m::fn_pow(a, b), 104000, 9),
    routine!("floor" Floor(R) -> I, call("INT({0})"), [], fits_int, EXACT, |a: real| a.int_floor().unwrap_or(0), 1640, 3),
    routine!("FNfloor" Floor(R) -> I, call("FNfloor({0})"), ["FNfloor"], everywhere, EXACT, |a: real| m::fn_floor(a), 8500, 10),
    routine!("round_up" Round(R) -> I, form("INT({0}+MIDWAY)", OPERAND, &[SUM]), ["MIDWAY"], |args, result| arg(args, 0.0, f64::MAX) && fits_int(args, result), EXACT, |a: real| m::round(a), 2000, 10),
    routine!("round" Round(R) -> I, form("SGN({0})*INT(ABS({0})+MIDWAY)", PRODUCT, &[0]), ["MIDWAY"], fits_int, EXACT, |a: real| m::round(a), 3300, 18),
    routine!("FNround" Round(R) -> I, call("FNround({0})"), ["FNround"], everywhere, EXACT, |a: real| m::fn_round(a), 12000, 10),
    routine!("sgn" Sign(R) -> I, call("SGN({0})"), [], everywhere, EXACT, |a: real| a.signum(), 640, 3),
    routine!("to_real" ToReal(I) -> R, form("{0}", OPERAND, &[OPERAND]), [], everywhere, EXACT, |a: int| Real40::from_i32(a), 0, 0),
    routine!("less" Less(R, R) -> B, LESS, [], everywhere, EXACT, |a: real, b: real| a < b, 280, 1),
    routine!("less_equal" LessEqual(R, R) -> B, LESS_EQUAL, [], everywhere, EXACT, |a: real, b: real| a <= b, 280, 2),
    routine!("equal" Equal(R, R) -> B, EQUAL, [], everywhere, EXACT, |a: real, b: real| a == b, 280, 1),

    routine!("int_add" IntAdd(I, I) -> I, ADD, [], fits_int, EXACT, |a: int, b: int| a.wrapping_add(b), 117, 1),
    routine!("FNiadd" IntAdd(I, I) -> I, call("FNiadd({0},{1})"), ["FNiadd"], everywhere, EXACT, |a: int, b: int| a.saturating_add(b), 12400, 10),
    routine!("int_sub" IntSub(I, I) -> I, SUB, [], fits_int, EXACT, |a: int, b: int| a.wrapping_sub(b), 125, 1),
    routine!("FNisub" IntSub(I, I) -> I, call("FNisub({0},{1})"), ["FNisub"], everywhere, EXACT, |a: int, b: int| a.saturating_sub(b), 12500, 10),
    routine!("int_mul" IntMul(I, I) -> I, MUL, [], narrow, EXACT, |a: int, b: int| a.wrapping_mul(b), 892, 1),
    routine!("int_mul_wide" IntMul(I, I) -> I, MUL, [], fits_int, EXACT, |a: int, b: int| a.wrapping_mul(b), 4050, 1),
    routine!("FNimul" IntMul(I, I) -> I, call("FNimul({0},{1})"), ["FNimul"], everywhere, EXACT, |a: int, b: int| a.saturating_mul(b), 14200, 10),
    routine!("int_div" IntDiv(I, I) -> I, form("{0} DIV {1}", PRODUCT, &[PRODUCT, POWER]), [], natural, EXACT, |a: int, b: int| a.checked_div(b).unwrap_or(0), 2147, 3),
    routine!("FNidiv" IntDiv(I, I) -> I, call("FNidiv({0},{1})"), ["FNidiv"], everywhere, EXACT, |a: int, b: int| m::fn_idiv(a, b), 15000, 10),
    and_mask!("and_1" 2 "{0} AND 1"),
    and_mask!("and_3" 4 "{0} AND 3"),
    and_mask!("and_7" 8 "{0} AND 7"),
    and_mask!("and_15" 16 "{0} AND 15"),
    and_mask!("and_31" 32 "{0} AND 31"),
    and_mask!("and_63" 64 "{0} AND 63"),
    and_mask!("and_127" 128 "{0} AND 127"),
    and_mask!("and_255" 256 "{0} AND 255"),
    routine!("int_mod" IntMod(I, I) -> I, form("{0} MOD {1}", PRODUCT, &[PRODUCT, POWER]), [], natural, EXACT, |a: int, b: int| a.checked_rem(b).unwrap_or(0), 2123, 3),
    routine!("FNimod" IntMod(I, I) -> I, call("FNimod({0},{1})"), ["FNimod"], everywhere, EXACT, |a: int, b: int| m::fn_imod(a, b), 13000, 10),
    routine!("int_neg" IntNeg(I) -> I, NEG, [], fits_int, EXACT, |a: int| a.wrapping_neg(), 120, 1),
    routine!("FNineg" IntNeg(I) -> I, call("FNineg({0})"), ["FNineg"], everywhere, EXACT, |a: int| a.saturating_neg(), 7500, 9),
    routine!("int_abs" IntAbs(I) -> I, call("ABS({0})"), [], fits_int, EXACT, |a: int| a.wrapping_abs(), 200, 3),
    routine!("FNiabs" IntAbs(I) -> I, call("FNineg(-ABS({0}))"), ["FNineg"], everywhere, EXACT, |a: int| a.saturating_abs(), 7700, 13),
    routine!("FNimin" IntMin(I, I) -> I, call("FNimin({0},{1})"), ["FNimin"], everywhere, EXACT, |a: int, b: int| a.min(b), 7800, 9),
    routine!("FNimax" IntMax(I, I) -> I, call("FNimax({0},{1})"), ["FNimax"], everywhere, EXACT, |a: int, b: int| a.max(b), 7800, 9),
    routine!("int_sgn" IntSign(I) -> I, call("SGN({0})"), [], everywhere, EXACT, |a: int| a.signum(), 400, 3),
    routine!("and" BitAnd(I, I) -> I, form("{0} AND {1}", AND, &[AND, COMPARE]), [], everywhere, EXACT, |a: int, b: int| a & b, 218, 3),
    routine!("or" BitOr(I, I) -> I, form("{0} OR {1}", OR, &[OR, AND]), [], everywhere, EXACT, |a: int, b: int| a | b, 218, 3),
    routine!("eor" BitXor(I, I) -> I, form("{0} EOR {1}", OR, &[OR, AND]), [], everywhere, EXACT, |a: int, b: int| a ^ b, 218, 3),
    routine!("int_less" IntLess(I, I) -> B, LESS, [], everywhere, EXACT, |a: int, b: int| a < b, 200, 1),
    routine!("int_less_equal" IntLessEqual(I, I) -> B, LESS_EQUAL, [], everywhere, EXACT, |a: int, b: int| a <= b, 200, 2),
    routine!("int_equal" IntEqual(I, I) -> B, EQUAL, [], everywhere, EXACT, |a: int, b: int| a == b, 200, 1),
    routine!("not" Not(B) -> B, form("NOT {0}", OPERAND, &[OPERAND]), [], everywhere, EXACT, |a: int| a == 0, 150, 1),
];
