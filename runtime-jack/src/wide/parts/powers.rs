//! Powers and logarithms: see [`super::super::model`] for how they work.

pub(super) const MAKE_LOG_E: &str =
    "    static Float logE, portion; // log2(e) - 1, and what is multiplied by it

    function void makeLogE() {
        let logE = Float.new();
        do logE.set(0, 125, 14506, 3786);
        let portion = Float.new();
        return;
    }
";

pub(super) const EXPONENT: &str = "    /** Adds a * log2(e) to an exponent of 2. */
    function void natural(Array a) {
        do Float.gather(a);
        do portion.mul(logE, a);
        do Float.gather(portion);
        return;
    }

    /** this = 2 to the exponent */
    method void raise() {
        let s = 0;
        if (whole > 7873) { let e = 8000; let m = 16383; let l = 16383; return; }
        if (whole < (-8127)) { let e = 0; let m = 0; let l = 0; return; }
        do Float.by();
        let high = 0;
        let low = 5570;
        do Float.plus(2, 6435);
        do Float.plus(21, 15361);
        do Float.plus(157, 9022);
        do Float.plus(909, 6305);
        do Float.plus(3935, 14266);
        do Float.plus(11356, 8576);
        do Float.times();
        let m = 8192 + (high / 2);
        let l = ((low + 1) / 2) + ((high & 1) * 8192);
        let e = 127 + whole;
        if (l > 16383) { let l = 0; let m = m + 1; }
        if (m > 16383) { let m = 8192; let e = e + 1; }
        if (e > 8000) { let e = 8000; let m = 16383; let l = 16383; }
        return;
    }
";

pub(super) const EXP: &str = "    /** this = e to the power a */
    method void exp(Array a) {
        let whole = 0;
        let high = 0;
        let low = 0;
        do Float.natural(a);
        do raise();
        return;
    }
";

pub(super) const NEAR_LOG: &str =
    "    /** The magnitude of a is 2^n r, with r from 0.707 to 1.414: this = the logarithm
        of r, twice the inverse hyperbolic tangent of (r - 1) / (r + 1); returns n. */
    method int nearLog(Array a) {
        var int n;
        let n = a[1] - 127;
        let s = 0;
        let e = 127;
        let m = a[2];
        let l = a[3];
        if (m > 11585) { let n = n + 1; let e = 126; }
        do shape.add(this, one);
        do sub(this, one);
        do div(this, shape);
        do square();
        let high = 2423;
        let low = 7317;
        do Float.plus(3275, 14319);
        do Float.plus(5461, 5486);
        do Float.times();
        let high = high + 16384;
        do shape.setFraction();
        do mul(this, shape);
        do scale(this, 1);
        return n;
    }
";

pub(super) const MAKE_LOG: &str = "    static Float ln2, doublings; // while a logarithm is found

    function void makeLog() {
        let ln2 = Float.new();
        do ln2.set(0, 126, 11356, 8575);
        let doublings = Float.new();
        return;
    }
";

pub(super) const LOG: &str =
    "    /** this = the natural logarithm of a; of zero or a negative the most negative value */
    method void log(Array a) {
        if ((a[2] = 0) | (a[0] = 1)) { let s = 1; let e = 8000; let m = 16383; let l = 16383; return; }
        do doublings.fromInt(nearLog(a));
        do doublings.mul(ln2, doublings);
        do add(doublings, this);
        return;
    }
";

pub(super) const POW: &str =
    "    /** this = a to the power b; to the power zero it is 1. Zero to a negative is
        the largest value, a negative to a fraction zero. */
    method void pow(Array a, Array b) {
        var int sign, c, f, p, q, x, unit;
        let c = b[0];
        let x = b[1];
        let p = b[2];
        let q = b[3];
        if (p = 0) { let s = 0; let e = 127; let m = 8192; let l = 0; return; }
        if (a[2] = 0) {
            let s = 0;
            let e = 0;
            let m = 0;
            let l = 0;
            if (c = 1) { let e = 8000; let m = 16383; let l = 16383; }
            return;
        }
        let sign = 0;
        if ((a[0] = 1) & (x < 155)) {
            // Beside the bits of a fraction, the last one before the point.
            let f = 1;
            if (x > 140) {
                let unit = powers[154 - x];
                let f = q & (unit - 1);
                let sign = (q / unit) & 1;
            }
            if ((x > 126) & (x < 141)) {
                let unit = powers[140 - x];
                let f = q | (p & (unit - 1));
                let sign = (p / unit) & 1;
            }
            if (f > 0) { let s = 0; let e = 0; let m = 0; let l = 0; return; }
        }
        do rise.copy(b);
        do doublings.fromInt(nearLog(a));
        let whole = 0;
        let high = 0;
        let low = 0;
        do mul(this, rise);
        do Float.natural(this);
        do set(c, x, p, 0);
        do mul(doublings, this);
        do Float.gather(this);
        do set(c, x, 0, q);
        do normal();
        do mul(doublings, this);
        do Float.gather(this);
        do raise();
        let s = sign;
        return;
    }
";
