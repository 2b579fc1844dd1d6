//! The class of Floats.

/// Whichever of two comes first, or last.
macro_rules! pick {
    ($doc:literal, $name:literal, $test:literal) => {
        concat!(
            "    /** ",
            $doc,
            " */
    method void ",
            $name,
            "(Float a, Float b) {
        if (",
            $test,
            ") { do copy(b); }
        else { do copy(a); }
        return;
    }
"
        )
    };
}

pub(crate) const HEAD: &str = "    field int s, e, m;

    /** Makes zero; let it be made once, and given its values as they come. */
    constructor Float new() {
        let s = 0;
        let e = 0;
        let m = 0;
        return this;
    }
";

macro_rules! make_powers {
    () => {
        "    static Array powers; // powers[k] = 2^k

    function void makePowers() {
        var int k;
        let powers = Array.new(15);
        let powers[0] = 1;
        let k = 1;
        while (k < 15) { let powers[k] = powers[k - 1] * 2; let k = k + 1; }
        return;
    }
"
    };
}

pub(crate) const MAKE_POWERS: &str = make_powers!();

pub(crate) const MAKE_ROOT: &str = "    static Float quotient, root; // while a root is found

    function void makeRoot() {
        let quotient = Float.new();
        let root = Float.new();
        return;
    }
";

pub(crate) const CONSTANT: &str = "    /** A value from its sign, exponent and mantissa. */
    constructor Float constant(int sign, int exponent, int mantissa) {
        let s = sign;
        let e = exponent;
        let m = mantissa;
        return this;
    }
";

pub(crate) const COPY: &str = "    /** this = a */
    method void copy(Array a) {
        let s = a[0];
        let e = a[1];
        let m = a[2];
        return;
    }
";

pub(crate) const NEG: &str = "    /** this = -a */
    method void neg(Array a) {
        let s = 1 - a[0];
        let e = a[1];
        let m = a[2];
        return;
    }
";

pub(crate) const ABS: &str = "    /** this = the magnitude of a */
    method void abs(Array a) {
        let s = 0;
        let e = a[1];
        let m = a[2];
        return;
    }
";

pub(crate) const MUL: &str =
    "    /** this = a * b; of the mantissas' halves, low times low is dropped. */
    method void mul(Array a, Array b) {
        var int p, q, h, k, x;
        let p = a[2];
        let q = b[2];
        let x = (a[1] + b[1]) - 126;
        let s = (a[0] + b[0]) & 1;
        if ((p = 0) | (q = 0)) { let e = 0; let m = 0; return; }
        let h = p / 128;
        let k = q / 128;
        let p = (h * k) + (((h * (q & 127)) + ((p & 127) * k)) / 128);
        if (p < 8192) { let p = p + p; let x = x - 1; }
        if (x > 8000) { let x = 8000; let p = 16383; }
        if (x < (-8000)) { let s = 0; let x = 0; let p = 0; }
        let e = x;
        let m = p;
        return;
    }
";

pub(crate) const SCALE: &str = "    /** this = a * 2^k, for k from -9 to 9 */
    method void scale(Array a, int k) {
        var int x;
        let s = a[0];
        let m = a[2];
        if (m = 0) { let e = 0; return; }
        let x = a[1] + k;
        if (x > 8000) { let x = 8000; let m = 16383; }
        if (x < (-8000)) { let s = 0; let x = 0; let m = 0; }
        let e = x;
        return;
    }
";

pub(crate) const DIV: &str =
    "    /** this = a / b; by zero the largest value, zero by zero is zero. */
    method void div(Array a, Array b) {
        var int r, d, q, x;
        let r = a[2];
        let d = b[2];
        if (r = 0) { let s = 0; let e = 0; let m = 0; return; }
        if (d = 0) { let s = a[0]; let e = 8000; let m = 16383; return; }
        let x = (a[1] + 127) - b[1];
        let s = (a[0] + b[0]) & 1;
        let q = 0;
        while (d > 0) {
            let q = q + q;
            if (~(r < d)) { let r = r - d; let q = q + 1; }
            let d = d / 2;
        }
        if (q < 8192) { let q = q + q; let x = x - 1; }
        if (x > 8000) { let x = 8000; let q = 16383; }
        if (x < (-8000)) { let s = 0; let x = 0; let q = 0; }
        let e = x;
        let m = q;
        return;
    }
";

pub(crate) const SQRT: &str =
    "    /** this = the root of a, by two steps of Newton's from the mean of a, scaled to
        1 to 4, and of 1 or 4; of a negative zero. */
    method void sqrt(Array a) {
        var int x, p, turn;
        let x = a[1];
        if ((a[2] = 0) | (a[0] = 1)) { let s = 0; let e = 0; let m = 0; return; }
        let p = (a[2] / 2) + 4096;
        if ((x & 1) = 0) { let p = p + 4096; }
        do root.guess((((x + 8000) / 2) - 3937) + (x & 1), p);
        let turn = 0;
        while (turn < 2) {
            do quotient.ratio(a, root);
            do root.add(root, quotient);
            do root.scale(root, -1);
            let turn = turn + 1;
        }
        do copy(root);
        return;
    }

    method void guess(int exponent, int mantissa) {
        let s = 0;
        let e = exponent;
        let m = mantissa;
        return;
    }
";

pub(crate) const LESS: &str = "    /** Whether this < b */
    method boolean less(Array b) {
        var int d;
        if (m = 0) { return (b[2] > 0) & (b[0] = 0); }
        if ((b[2] = 0) | (~(s = b[0]))) { return s = 1; }
        let d = e - b[1];
        if (d = 0) { let d = m - b[2]; }
        if (s = 1) { return d > 0; }
        return d < 0;
    }
";

pub(crate) const EQUAL: &str = "    /** Whether this = b */
    method boolean equal(Array b) {
        if (m = 0) { return b[2] = 0; }
        return ((m = b[2]) & (e = b[1])) & (s = b[0]);
    }
";

pub(crate) const NEGATIVE: &str = "    /** Whether this < 0 */
    method boolean negative() {
        return (s = 1) & (m > 0);
    }
";

pub(crate) const POSITIVE: &str = "    /** Whether this > 0 */
    method boolean positive() {
        return (s = 0) & (m > 0);
    }
";

pub(crate) const MIN: &str = pick!("this = the lesser of a and b", "min", "b.less(a)");

pub(crate) const MAX: &str = pick!("this = the greater of a and b", "max", "a.less(b)");

pub(crate) const SIGN: &str = "    /** -1, 0 or 1 */
    method int sign() {
        if (m = 0) { return 0; }
        return (1 - s) - s;
    }
";

pub(crate) const FLOOR: &str = "    /** The greatest int not above this, from -32767 to 32767. */
    method int floor() {
        var int q, unit;
        if (m = 0) { return 0; }
        if (e < 127) { return -s; }
        if (e > 140) {
            let q = 32767;
            if (e = 141) { let q = m + m; }
            if (s = 1) { return -q; }
            return q;
        }
        let unit = powers[140 - e];
        let q = m / unit;
        if (s = 0) { return q; }
        if ((q * unit) < m) { let q = q + 1; }
        return -q;
    }
";

pub(crate) const ROUND: &str =
    "    /** The nearest int, halves away from zero, from -32767 to 32767. */
    method int round() {
        var int q;
        if ((m = 0) | (e < 126)) { return 0; }
        let q = 32767;
        if (e = 141) { let q = m + m; }
        if (e = 140) { let q = m; }
        if (e < 140) { let q = (m + powers[139 - e]) / powers[140 - e]; }
        if (s = 1) { return -q; }
        return q;
    }
";

pub(crate) const MOD: &str =
    "    /** this = what is left of a after taking away whole b; with the sign of b. */
    method void mod(Array a, Float b) {
        var Array divisor;
        var int r, d, k, x;
        let divisor = b;
        let r = a[2];
        let d = divisor[2];
        let x = divisor[1];
        let k = a[1] - x;
        if ((r = 0) | (d = 0)) { let s = 0; let e = 0; let m = 0; return; }
        if (k < 0) { do copy(a); }
        else {
            while (~(k < 0)) {
                if (~(r < d)) { let r = r - d; }
                if (k > 0) { let r = r + r; }
                let k = k - 1;
            }
            if (r = 0) { let s = 0; let e = 0; let m = 0; return; }
            while (r < 8192) { let r = r + r; let x = x - 1; }
            if (x < (-8000)) { let s = 0; let e = 0; let m = 0; return; }
            let s = a[0];
            let e = x;
            let m = r;
        }
        if (~(s = divisor[0])) { do add(this, b); }
        return;
    }
";

pub(crate) const FROM_INT: &str = "    /** this = i; above 16383 its last bit is cut. */
    method void fromInt(int i) {
        let s = 0;
        let e = 140;
        let m = i;
        if (m = 0) { let e = 0; return; }
        if (m < 0) {
            let s = 1;
            let m = -m;
            if (m < 0) { let m = 32767; }
        }
        if (m > 16383) { let m = m / 2; let e = 141; }
        while (m < 8192) { let m = m + m; let e = e - 1; }
        return;
    }
";
