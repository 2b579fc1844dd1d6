//! Ints, remainders, and constants of functions.

pub(super) const FLOOR: &str = "    /** The greatest int not above this, from -32767 to 32767. */
    method int floor() {
        var int q, unit, rest;
        if (m = 0) { return 0; }
        if (e < 127) { return -s; }
        if (e > 140) {
            let q = 32767;
            let rest = 0;
            if (e = 141) { let q = (m + m) + (l / 8192); let rest = l & 8191; }
        }
        else {
            let unit = powers[140 - e];
            let q = m / unit;
            let rest = l | (m & (unit - 1));
        }
        if (s = 0) { return q; }
        if ((rest > 0) & (q < 32767)) { let q = q + 1; }
        return -q;
    }
";

pub(super) const ROUND: &str =
    "    /** The nearest int, halves away from zero, from -32767 to 32767. */
    method int round() {
        var int q;
        if ((m = 0) | (e < 126)) { return 0; }
        let q = 32767;
        if (e = 141) {
            let q = m + m;
            if (q < 32766) { let q = q + ((l + 4096) / 8192); }
            else { if (l > 4095) { let q = 32767; } }
        }
        if (e = 140) { let q = m + (l / 8192); }
        if (e < 140) { let q = (m + powers[139 - e]) / powers[140 - e]; }
        if (s = 1) { return -q; }
        return q;
    }
";

pub(super) const MOD: &str =
    "    /** this = what is left of a after taking away whole b; with the sign of b. */
    method void mod(Array a, Float b) {
        var Array divisor;
        var int r, v, d, o, k, t, u;
        let divisor = b;
        let r = a[2];
        let v = a[3];
        let d = divisor[2];
        let o = divisor[3];
        let k = a[1] - divisor[1];
        if ((r = 0) | (d = 0)) { let s = 0; let e = 0; let m = 0; let l = 0; return; }
        if (k < 0) { do copy(a); }
        else {
            while (~(k < 0)) {
                let t = v - o;
                let u = r - d;
                if (t < 0) { let t = t + 16384; let u = u - 1; }
                if (~(u < 0)) { let r = u; let v = t; }
                if (k > 0) {
                    let r = r + r;
                    let v = v + v;
                    if (v > 16383) { let v = v - 16384; let r = r + 1; }
                }
                let k = k - 1;
            }
            let s = a[0];
            let e = divisor[1];
            let m = r;
            let l = v;
            do normal();
            if (m = 0) { return; }
        }
        if (~(s = divisor[0])) { do add(this, b); }
        return;
    }
";

pub(super) const FROM_INT: &str = "    /** this = i */
    method void fromInt(int i) {
        let s = 0;
        let e = 140;
        let m = i;
        let l = 0;
        if (m = 0) { let e = 0; return; }
        if (m < 0) {
            let s = 1;
            let m = -m;
            if (m < 0) { let m = 32767; }
        }
        if (m > 16383) { let l = (m & 1) * 8192; let m = m / 2; let e = 141; }
        while (m < 8192) { let m = m + m; let e = e - 1; }
        return;
    }
";

pub(super) const SET: &str =
    "    method void set(int sign, int exponent, int mantissa, int lower) {
        let s = sign;
        let e = exponent;
        let m = mantissa;
        let l = lower;
        return;
    }
";
