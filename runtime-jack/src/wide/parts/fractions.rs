//! Fractions of 28 bits, in two words: `high` and `low`. See [`super::super::model`].

/// Sums of up to four products of 7 bits have 16; the sign's bit is one of them.
pub(super) const FRACTION: &str =
    "    static int whole, high, low; // a number: whole + (high * 16384 + low) / 2^28
    static int x3, x2, x1, x0; // the digits of what fractions are multiplied by

    /** What is in high and low is what fractions are multiplied by from now on. */
    function void by() {
        let x3 = high / 128;
        let x2 = high & 127;
        let x1 = low / 128;
        let x0 = low & 127;
        return;
    }

    /** The fraction in high and low is multiplied. */
    function void times() {
        var int p, q, r, t, x, y;
        let p = high / 128;
        let q = high & 127;
        let r = low / 128;
        let t = low & 127;
        let x = (((q * x0) + (t * x2)) / 128) + (((r * x1) / 128) + 64);
        let y = ((((p * x0) + (q * x1)) + (r * x2)) + (t * x3)) + x;
        let x = (((p * x1) + (q * x2)) + (r * x3)) + ((y & 32767) / 128);
        if (y < 0) { let x = x + 256; }
        let y = ((p * x2) + (q * x3)) + ((x & 32767) / 128);
        if (x < 0) { let y = y + 256; }
        let high = (p * x3) + (y / 128);
        let low = ((y & 127) * 128) + (x & 127);
        return;
    }

    /** A term of a polynomial, less what comes after it. */
    function void minus(int h, int k) {
        do Float.times();
        let high = h - high;
        let low = k - low;
        if (low < 0) { let low = low + 16384; let high = high - 1; }
        return;
    }

    /** A term of a polynomial, and what comes after it. */
    function void plus(int h, int k) {
        do Float.times();
        let high = h + high;
        let low = k + low;
        if (low > 16383) { let low = low - 16384; let high = high + 1; }
        return;
    }
";

pub(super) const GATHER: &str =
    "    /** Adds a, cut behind 28 bits of a fraction; what is beyond all results becomes 16384. */
    function void gather(Array a) {
        var int x, p, q, w, u;
        let x = a[1] - 126;
        let p = a[2];
        let q = a[3];
        if (p = 0) { return; }
        if (x > 14) {
            let whole = 16384;
            if (a[0] = 1) { let whole = -16384; }
            return;
        }
        let w = 0;
        if (x > 0) {
            let u = powers[14 - x];
            let w = p / u;
            let p = ((p * powers[x]) & 16383) + (q / u);
            let q = (q * powers[x]) & 16383;
        }
        else {
            let x = -x;
            if (x > 13) { let q = p; let p = 0; let x = x - 14; }
            if (x > 13) { return; }
            let u = powers[x];
            let q = (q / u) + ((p & (u - 1)) * (16384 / u));
            let p = p / u;
        }
        if (a[0] = 1) {
            let whole = whole - w;
            let high = high - p;
            let low = low - q;
            if (low < 0) { let low = low + 16384; let high = high - 1; }
            if (high < 0) { let high = high + 16384; let whole = whole - 1; }
        }
        else {
            let whole = whole + w;
            let high = high + p;
            let low = low + q;
            if (low > 16383) { let low = low - 16384; let high = high + 1; }
            if (high > 16383) { let high = high - 16384; let whole = whole + 1; }
        }
        return;
    }
";

pub(super) const SQUARE: &str =
    "    /** Fractions are multiplied by the square of this, which is from 0 to 1. */
    method void square() {
        var int sign;
        let sign = s;
        let s = 0;
        let whole = 0;
        let high = 0;
        let low = 0;
        do Float.gather(this);
        let s = sign;
        let high = high + (whole * 16384);
        do Float.by();
        do Float.times();
        do Float.by();
        return;
    }
";

pub(super) const SET_FRACTION: &str =
    "    /** this = the fraction in high and low, which is less than 2; its 29th bit is rounded. */
    method void setFraction() {
        let s = 0;
        let e = 126;
        let m = high;
        let l = low;
        if (m > 16383) {
            let e = 127;
            let l = ((l + 1) / 2) + ((m & 1) * 8192);
            let m = m / 2;
            if (l > 16383) { let l = 0; let m = m + 1; }
        }
        do normal();
        return;
    }
";
