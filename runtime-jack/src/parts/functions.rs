//! Sines, arcs, and the fractions that all functions are made of: see [`crate::model`] for how they work.

pub(crate) const FRACTION: &str =
    "    /** a * b to the nearest, of fractions of 14 bits: 16384 is 1. */
    function int fraction(int a, int b) {
        var int h, k;
        let h = a / 128;
        let k = b / 128;
        let a = a & 127;
        let b = b & 127;
        return (h * k) + (((((h * b) + (a * k)) + ((a * b) / 128)) + 64) / 128);
    }
";

pub(crate) const PART: &str =
    "    /** This, at most 1, as a fraction of 14 bits; the rest is cut. */
    method int part() {
        if (e > 126) { return 16384; }
        if (e < 113) { return 0; }
        return m / powers[126 - e];
    }

    /** this = a fraction of 14 bits, at most 2, whose 15th is rounded. */
    method void setPart(int a) {
        let s = 0;
        let e = 126;
        let m = a;
        if (a = 0) { let e = 0; return; }
        if (a > 16383) { let m = (a + 1) / 2; let e = 127; }
        while (m < 8192) { let m = m + m; let e = e - 1; }
        return;
    }
";

pub(crate) const SET: &str = "    method void set(int sign, int exponent, int mantissa) {
        let s = sign;
        let e = exponent;
        let m = mantissa;
        return;
    }
";

/// What lies beyond the exponent's ends.
macro_rules! ends {
    ($beyond:literal) => {
        concat!(
            "        if (",
            $beyond,
            ") {
            if (e > 0) { let e = 8000; let m = 16383; }
            else { let s = 0; let e = 0; let m = 0; }
        }
        return;
    }
"
        )
    };
}

pub(crate) const PRODUCT: &str = concat!(
    "    /** this = a * b, to the nearest */
    method void product(Array a, Array b) {
        var int p, q, h, k, r;
        let p = a[2];
        let q = b[2];
        let h = p / 128;
        let k = q / 128;
        let p = p & 127;
        let q = q & 127;
        let r = (((h * q) + (p * k)) + ((p * q) / 128)) + 64;
        let s = (a[0] + b[0]) & 1;
        let e = (a[1] + b[1]) - 126;
        let m = (h * k) + (r / 128);
        if (m < 8193) {
            if (m = 0) { let e = 0; return; }
            let m = ((m + m) + (((r & 127) + 32) / 64)) - 1;
            if (m > 16383) { let m = 8192; }
            else { let e = e - 1; }
        }
",
    ends!("Math.abs(e) > 8000")
);

pub(crate) const RATIO: &str = concat!(
    "    /** this = a / b, to the nearest; by zero the largest value, zero by zero is zero.
        Digits of 7 and 6 bits, found with a divisor that is too large by at most 64,
        then what they lack. What wraps is right again in the difference. */
    method void ratio(Array a, Array b) {
        var int r, d, k, q, t;
        let r = a[2];
        let d = b[2];
        if (r < d) {
            if (r = 0) { let s = 0; let e = 0; let m = 0; return; }
            let e = (a[1] - b[1]) + 126;
            let r = (r + r) - d;
        }
        else {
            if (d = 0) {
                let s = a[0];
                let e = 8000;
                let m = 16383;
                if (r = 0) { let s = 0; let e = 0; let m = 0; }
                return;
            }
            let e = (a[1] - b[1]) + 127;
            let r = r - d;
        }
        let s = (a[0] + b[0]) & 1;
        let k = (d / 64) + 1;
        let q = (r + r) / k;
        let r = (r * 128) - (q * d);
        let t = r / k;
        let r = (r * 64) - (t * d);
        let m = (((q * 64) + t) + ((r + (d / 2)) / d)) + 8192;
",
    ends!("Math.abs(e) > 8000")
);

pub(crate) const MAKE_SHAPE: &str =
    "    static Float shape; // what a reduced argument is multiplied by

    function void makeShape() {
        let shape = Float.new();
        return;
    }
";

pub(crate) const MAKE_QUARTER: &str = "    static Float quarter; // pi / 2, too large by excess

    function void makeQuarter() {
        let quarter = Float.new();
        do quarter.set(0, 127, 12868);
        return;
    }
";

pub(crate) const MAKE_EXCESS: &str = "    static Float excess, spare; // while a sine is found

    function void makeExcess() {
        let excess = Float.new();
        do excess.set(0, 109, 9566);
        let spare = Float.new();
        return;
    }
";

pub(crate) const SINE: &str =
    "    /** this = the rest of the magnitude of a by whole quarter turns; returns
        their number. From 32768 on, with Floats more than a radian apart, 0. */
    method int reduce(Array a) {
        var int r, k, n;
        let s = 0;
        let e = a[1];
        let m = a[2];
        if (e < 127) { return 0; }
        if ((e > 141) | (m = 0)) { let e = 0; let m = 0; return 0; }
        let r = m;
        let k = 0;
        let n = e - 127;
        while (~(n < 0)) {
            let k = k + k;
            if (r > 12867) { let r = r - 12868; let k = k + 1; }
            if (n > 0) { let r = r + r; }
            let n = n - 1;
        }
        let m = r;
        let e = 127;
        if (r = 0) { let e = 0; return k; }
        while (m < 8192) { let m = m + m; let e = e - 1; }
        return k;
    }

    /** this = the sine of the magnitude of a and n quarter turns */
    method void quarterSine(Array a, int n) {
        var int k, z, c;
        let k = reduce(a);
        let n = n + k;
        if ((n & 1) = 1) {
            do sub(quarter, this);
            do spare.fromInt(k + 1);
            do spare.product(excess, spare);
            do sub(this, spare);
        }
        else {
            if (k > 0) {
                do spare.fromInt(k);
                do spare.product(excess, spare);
                do add(this, spare);
            }
        }
        do shape.scale(this, -1);
        let z = shape.part();
        let z = Float.fraction(z, z);
        let c = 208 - Float.fraction(z, 11);
        let c = 2184 - Float.fraction(z, c);
        let c = 10923 - Float.fraction(z, c);
        do shape.setPart(16384 - Float.fraction(z, c));
        do product(this, shape);
        if ((n & 2) = 2) { let s = 1 - s; }
        return;
    }
";

pub(crate) const SIN: &str = "    /** this = the sine of a */
    method void sin(Array a) {
        var int sign;
        let sign = a[0];
        do quarterSine(a, 0);
        let s = (s + sign) & 1;
        return;
    }
";

pub(crate) const COS: &str = "    /** this = the cosine of a */
    method void cos(Array a) {
        do quarterSine(a, 1);
        return;
    }
";

pub(crate) const MAKE_TANGENT: &str = "    static Float rise; // while a tangent is found

    function void makeTangent() {
        let rise = Float.new();
        return;
    }
";

pub(crate) const TAN: &str = "    /** this = the tangent of a */
    method void tan(Array a) {
        do rise.sin(a);
        do cos(a);
        do ratio(rise, this);
        return;
    }
";

pub(crate) const ATAN2: &str = "    /** this = the angle of (y, x), of (0, 0) zero */
    method void atan2(Array y, Array x) {
        var int p, d, sign, z, c;
        var boolean flat, left;
        let p = y[2];
        if ((p = 0) & (x[2] = 0)) { let s = 0; let e = 0; let m = 0; return; }
        let sign = 0;
        if (p > 0) { let sign = y[0]; }
        let left = (x[0] = 1) & (x[2] > 0);
        let d = y[1] - x[1];
        if (p = 0) { let flat = true; }
        else {
            if (x[2] = 0) { let flat = false; }
            else {
                if (d = 0) { let d = p - x[2]; }
                let flat = (d < 0);
            }
        }
        if (flat) { do ratio(y, x); }
        else { do ratio(x, y); }
        let s = 0;
        let z = part();
        let z = Float.fraction(z, z);
        let c = 613 - Float.fraction(z, 131);
        let c = 1382 - Float.fraction(z, c);
        let c = 2214 - Float.fraction(z, c);
        let c = 3258 - Float.fraction(z, c);
        let c = 5460 - Float.fraction(z, c);
        do shape.setPart(16384 - Float.fraction(z, c));
        do product(this, shape);
        if (~flat) { do sub(quarter, this); }
        if (left) {
            do shape.scale(quarter, 1);
            do sub(shape, this);
        }
        let s = sign;
        return;
    }
";

pub(crate) const ARC: &str =
    "    /** this = the arc sine of the magnitude of a below 1/2; from there on its
        arc cosine, twice the arc sine of the root of (1 - a)/2: returns true. */
    method boolean arc(Array a) {
        var int z, c;
        var boolean large;
        let z = a[1];
        let m = a[2];
        let large = (z > 125) & (m > 0);
        if (large) {
            let z = 16384 - m;
            if (a[1] > 126) { let z = 0; }
            do shape.fromInt(z);
            do shape.scale(shape, -9);
            do shape.scale(shape, -6);
            do sqrt(shape);
            let z = z / 2;
        }
        else {
            let s = 0;
            let e = z;
            let z = part();
            let z = Float.fraction(z, z);
        }
        let c = 688 + Float.fraction(z, 749);
        let c = 1231 + Float.fraction(z, c);
        let c = 2731 + Float.fraction(z, c);
        do shape.setPart(16384 + Float.fraction(z, c));
        do product(this, shape);
        if (large) { do scale(this, 1); }
        return large;
    }
";

pub(crate) const ASIN: &str = "    /** this = the angle whose sine is a, kept within -1 and 1 */
    method void asin(Array a) {
        var int sign;
        let sign = a[0];
        if (arc(a)) { do sub(quarter, this); }
        let s = sign;
        return;
    }
";

pub(crate) const ACOS: &str = "    /** this = the angle whose cosine is a, kept within -1 and 1 */
    method void acos(Array a) {
        var int sign;
        let sign = a[0];
        if (arc(a)) {
            if (sign = 1) {
                do shape.scale(quarter, 1);
                do sub(shape, this);
            }
            return;
        }
        let s = sign;
        do sub(quarter, this);
        return;
    }
";
