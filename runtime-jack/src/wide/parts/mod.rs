//! The Jack source of Float416: the class of the same name as that of other Floats, with a
//! word more. What does not look at a mantissa's last bits is theirs.

/// What lies beyond the exponent's ends.
macro_rules! ends {
    () => {
        "        if (Math.abs(e) > 8000) {
            if (e > 0) { let e = 8000; let m = 16383; let l = 16383; }
            else { let s = 0; let e = 0; let m = 0; let l = 0; }
        }
        return;
    }
"
    };
}

mod conversions;
mod fractions;
mod functions;
mod powers;
mod roots;
mod sums;

use crate::parts::{float, int};
use slowlight_routine::{Part, Source};

#[rustfmt::skip]
pub(crate) static ALL: &[Part] = &[
    part!("Float", [], 70, HEAD),
    part!("Float.makePowers", ["Float"], 120, float::MAKE_POWERS, 387),
    part!("Float.constant", ["Float"], 50, CONSTANT),
    part!("Float.copy", ["Float"], 80, COPY),
    part!("Float.neg", ["Float"], 80, NEG),
    part!("Float.abs", ["Float"], 80, ABS),
    part!("Float.mul", ["Float"], 800, MUL),
    part!("Float.scale", ["Float"], 170, SCALE),
    part!("Float.normal", ["Float"], 250, NORMAL),
    part!("Float.add", ["Float.makePowers", "Float.normal"], 1450, sums::ADD),
    part!("Float.sub", ["Float.makePowers", "Float.normal"], 1460, sums::SUB),
    part!("Float.div", ["Float"], 1250, roots::DIV),
    part!("Float.sqrt", ["Float"], 700, roots::SQRT),
    part!("Float.less", ["Float"], 300, LESS),
    part!("Float.equal", ["Float"], 140, EQUAL),
    part!("Float.negative", ["Float"], 40, float::NEGATIVE),
    part!("Float.positive", ["Float"], 40, float::POSITIVE),
    part!("Float.min", ["Float.less", "Float.copy"], 80, float::MIN),
    part!("Float.max", ["Float.less", "Float.copy"], 80, float::MAX),
    part!("Float.sign", ["Float"], 40, float::SIGN),
    part!("Float.floor", ["Float.makePowers"], 360, conversions::FLOOR),
    part!("Float.round", ["Float.makePowers"], 330, conversions::ROUND),
    part!("Float.mod", ["Float.copy", "Float.add"], 520, conversions::MOD),
    part!("Float.fromInt", ["Float"], 220, conversions::FROM_INT),
    part!("Float.set", ["Float"], 100, conversions::SET),
    part!("Float.fraction", ["Float"], 800, fractions::FRACTION),
    part!("Float.gather", ["Float.fraction", "Float.makePowers"], 620, fractions::GATHER),
    part!("Float.square", ["Float.gather"], 120, fractions::SQUARE),
    part!("Float.setFraction", ["Float.fraction", "Float.normal"], 160, fractions::SET_FRACTION),
    part!("Float.makeShape", ["Float"], 80, functions::MAKE_SHAPE, 21),
    part!("Float.makeQuarter", ["Float.set"], 100, functions::MAKE_QUARTER, 41),
    part!("Float.makeOne", ["Float.set"], 100, functions::MAKE_ONE, 41),
    part!("Float.makeExcess", ["Float.set"], 120, functions::MAKE_EXCESS, 57),
    part!("Float.quarterSine", ["Float.makeShape", "Float.makeQuarter", "Float.makeExcess", "Float.square", "Float.setFraction", "Float.mul", "Float.add", "Float.sub", "Float.scale", "Float.fromInt"], 1100, functions::SINE),
    part!("Float.sin", ["Float.quarterSine"], 100, functions::SIN),
    part!("Float.cos", ["Float.quarterSine"], 60, functions::COS),
    part!("Float.makeTangent", ["Float"], 80, functions::MAKE_TANGENT, 21),
    part!("Float.tan", ["Float.makeTangent", "Float.sin", "Float.cos", "Float.div"], 80, functions::TAN),
    part!("Float.atan2", ["Float.makeShape", "Float.makeQuarter", "Float.square", "Float.setFraction", "Float.mul", "Float.div", "Float.sub", "Float.scale"], 850, functions::ATAN2),
    part!("Float.leg", ["Float.makeOne", "Float.makeShape", "Float.makeTangent", "Float.add", "Float.sub", "Float.mul", "Float.sqrt", "Float.abs"], 180, functions::LEG),
    part!("Float.asin", ["Float.leg", "Float.atan2"], 60, functions::ASIN),
    part!("Float.acos", ["Float.leg", "Float.atan2"], 60, functions::ACOS),
    part!("Float.makeLogE", ["Float.set"], 120, powers::MAKE_LOG_E, 57),
    part!("Float.exponent", ["Float.makeLogE", "Float.gather", "Float.mul"], 420, powers::EXPONENT),
    part!("Float.exp", ["Float.exponent"], 100, powers::EXP),
    part!("Float.nearLog", ["Float.makeOne", "Float.makeShape", "Float.add", "Float.sub", "Float.div", "Float.mul", "Float.scale", "Float.square", "Float.setFraction"], 330, powers::NEAR_LOG),
    part!("Float.makeLog", ["Float.set"], 120, powers::MAKE_LOG, 57),
    part!("Float.log", ["Float.makeLog", "Float.nearLog", "Float.fromInt", "Float.mul", "Float.add"], 200, powers::LOG),
    part!("Float.pow", ["Float.makeLog", "Float.makeTangent", "Float.nearLog", "Float.exponent", "Float.copy", "Float.fromInt", "Float.set"], 700, powers::POW),
    part!("Int", [], 0, ""),
    part!("Int.magnitude", [], 60, int::MAGNITUDE),
    part!("Int.add", [], 120, int::ADD),
    part!("Int.sub", [], 120, int::SUB),
    part!("Int.mul", ["Int.magnitude"], 140, int::MUL),
    part!("Int.div", ["Int.magnitude"], 160, int::DIV),
    part!("Int.mod", ["Int.magnitude"], 160, int::MOD),
    part!("Int.xor", [], 60, int::XOR),
    part!("Int.sign", [], 60, int::SIGN),
    part!("Int.less", [], 100, int::LESS),
    part!("Int.min", ["Int.less"], 60, int::MIN),
    part!("Int.max", ["Int.less"], 60, int::MAX),
];

const HEAD: &str = "    field int s, e, m, l; // the mantissa: m * 16384 + l

    /** Makes zero; let it be made once, and given its values as they come. */
    constructor Float new() {
        let s = 0;
        let e = 0;
        let m = 0;
        let l = 0;
        return this;
    }
";

const CONSTANT: &str = "    /** A value from its sign, exponent and mantissa. */
    constructor Float constant(int sign, int exponent, int mantissa, int lower) {
        let s = sign;
        let e = exponent;
        let m = mantissa;
        let l = lower;
        return this;
    }
";

/// A copy with a sign of its own.
macro_rules! copy {
    ($doc:literal, $name:literal, $sign:literal) => {
        concat!(
            "    /** this = ",
            $doc,
            " */
    method void ",
            $name,
            "(Array a) {
        let s = ",
            $sign,
            ";
        let e = a[1];
        let m = a[2];
        let l = a[3];
        return;
    }
"
        )
    };
}

const COPY: &str = copy!("a", "copy", "a[0]");
const NEG: &str = copy!("-a", "neg", "1 - a[0]");
const ABS: &str = copy!("the magnitude of a", "abs", "0");

/// Sums of up to four products of 7 bits have 16; the sign's bit is one of them.
const MUL: &str = concat!(
    "    /** this = a * b, to the nearest: digits of 7 bits, whose three last products are left out. */
    method void mul(Array a, Array b) {
        var int p, q, r, t, h, k, n, o, x, y;
        let q = a[2];
        let k = b[2];
        let s = (a[0] + b[0]) & 1;
        if ((q = 0) | (k = 0)) { let e = 0; let m = 0; let l = 0; return; }
        let e = (a[1] + b[1]) - 126;
        let t = a[3];
        let o = b[3];
        let p = q / 128;
        let q = q & 127;
        let r = t / 128;
        let t = t & 127;
        let h = k / 128;
        let k = k & 127;
        let n = o / 128;
        let o = o & 127;
        let x = (((q * o) + (t * k)) / 128) + ((r * n) / 128);
        let y = ((((p * o) + (q * n)) + (r * k)) + (t * h)) + x;
        let x = (((p * n) + (q * k)) + (r * h)) + ((y & 32767) / 128);
        if (y < 0) { let x = x + 256; }
        let r = ((p * k) + (q * h)) + ((x & 32767) / 128);
        if (x < 0) { let r = r + 256; }
        let m = (p * h) + (r / 128);
        let l = ((r & 127) * 128) + (x & 127);
        let y = y & 127;
        if (m < 8192) {
            let e = e - 1;
            let m = m + m;
            let l = ((l + l) - 16384) + ((y + 32) / 64);
            if (l < 0) { let l = l + 16384; }
            else { let m = m + 1; }
        }
        else { let l = l + (y / 64); }
        if (l > 16383) {
            let l = l - 16384;
            let m = m + 1;
            if (m > 16383) { let m = 8192; let e = e + 1; }
        }
",
    ends!()
);

const SCALE: &str = "    /** this = a * 2^k, for k from -9 to 9 */
    method void scale(Array a, int k) {
        var int x;
        let s = a[0];
        let m = a[2];
        let l = a[3];
        if (m = 0) { let e = 0; return; }
        let x = a[1] + k;
        if (x > 8000) { let x = 8000; let m = 16383; let l = 16383; }
        if (x < (-8000)) { let s = 0; let x = 0; let m = 0; let l = 0; }
        let e = x;
        return;
    }
";

/// Sums of a power of two times a word wrap, and their last 14 bits are right.
const NORMAL: &str = "    /** Doubles the mantissa until its first bit is 1. */
    method void normal() {
        var int u;
        if (m = 0) {
            if (l = 0) { let s = 0; let e = 0; return; }
            let m = l;
            let l = 0;
            let e = e - 14;
        }
        if (m < 8192) {
            let u = 1;
            while (m < 8192) { let m = m + m; let u = u + u; let e = e - 1; }
            let m = m + (l / (16384 / u));
            let l = (l * u) & 16383;
        }
        if (e < (-8000)) { let s = 0; let e = 0; let m = 0; let l = 0; }
        return;
    }
";

const LESS: &str = "    /** Whether this < b */
    method boolean less(Array b) {
        var int d;
        if (m = 0) { return (b[2] > 0) & (b[0] = 0); }
        if ((b[2] = 0) | (~(s = b[0]))) { return s = 1; }
        let d = e - b[1];
        if (d = 0) {
            let d = m - b[2];
            if (d = 0) { let d = l - b[3]; }
        }
        if (s = 1) { return d > 0; }
        return d < 0;
    }
";

const EQUAL: &str = "    /** Whether this = b */
    method boolean equal(Array b) {
        if (m = 0) { return b[2] = 0; }
        return (((l = b[3]) & (m = b[2])) & (e = b[1])) & (s = b[0]);
    }
";
