//! Powers and logarithms: see [`crate::model`] for how they work.

pub(crate) const EXPONENT: &str =
    "    static int whole, rest; // an exponent of 2: whole + rest/16384

    /** Adds (h + l/16384) / 2^places; beyond all results, sets 32767. */
    function void split(int h, int l, int places, boolean minus) {
        var int unit;
        while (places < 0) {
            if ((h > 8191) | (places < (-30))) {
                let whole = 32767;
                if (minus) { let whole = -32767; }
                let rest = 0;
                return;
            }
            let l = l + l;
            let h = (h + h) + (l / 16384);
            let l = l & 16383;
            let places = places + 1;
        }
        if (places > 14) { let l = h / 2; let h = 0; let places = places - 15; }
        if (places > 14) { let l = 0; }
        else {
            let unit = powers[places];
            let l = (l / unit) + ((h & (unit - 1)) * (16384 / unit));
            let h = h / unit;
        }
        if (minus) {
            let whole = whole - h;
            if (l > 0) { let whole = whole - 1; let rest = rest + (16384 - l); }
        }
        else { let whole = whole + h; let rest = rest + l; }
        if (rest > 16383) { let rest = rest - 16384; let whole = whole + 1; }
        return;
    }

    /** Adds a * log2(e), which is 1 + 7253/2^14 + 1893/2^28. */
    function void natural(Array a) {
        var int p, q, h, l, x;
        let p = a[2];
        let x = a[1];
        if (p = 0) { return; }
        if (x > 140) { do Float.split(16383, 0, -1, a[0] = 1); return; }
        let h = p / 128;
        let l = p & 127;
        let q = (h * 85) + (l * 56);
        let l = ((q & 127) * 128) + (l * 85);
        let h = ((h * 56) + (q / 128)) + p;
        if (l > 16383) { let l = l - 16384; let h = h + 1; }
        let l = l + Float.fraction(p, 1893);
        if (l > 16383) { let l = l - 16384; let h = h + 1; }
        do Float.split(h, l, 140 - x, a[0] = 1);
        return;
    }

    /** this = 2 to the exponent */
    method void raise() {
        var int c;
        let s = 0;
        if (whole > 7873) { let e = 8000; let m = 16383; return; }
        if (whole < (-8127)) { let e = 0; let m = 0; return; }
        let c = 151 + Float.fraction(rest, 29);
        let c = 912 + Float.fraction(rest, c);
        let c = 3936 + Float.fraction(rest, c);
        let c = 11357 + Float.fraction(rest, c);
        let m = 8192 + ((Float.fraction(rest, c) + 1) / 2);
        let e = 127 + whole;
        if (m > 16383) { let m = 8192; let e = e + 1; }
        if (e > 8000) { let e = 8000; let m = 16383; }
        return;
    }
";

pub(crate) const EXP: &str = "    /** this = e to the power a */
    method void exp(Array a) {
        let whole = 0;
        let rest = 0;
        do Float.natural(a);
        do raise();
        return;
    }
";

pub(crate) const NEAR_LOG: &str =
    "    /** The magnitude of a is 2^n r, with r from 0.707 to 1.414: this = the
        logarithm of r; returns n. */
    method int nearLog(Array a) {
        var int n, z, c, sign;
        let z = a[2];
        let n = a[1] - 127;
        if (z > 11585) {
            let n = n + 1;
            let z = 16384 - z;
            let sign = 1;
            let c = 3077 + Float.fraction(z, 2001);
            let c = 3351 + Float.fraction(z, c);
            let c = 4079 + Float.fraction(z, c);
            let c = 5459 + Float.fraction(z, c);
            let c = 8192 + Float.fraction(z, c);
            let c = 16384 + Float.fraction(z, c);
        }
        else {
            let z = (z - 8192) * 2;
            let sign = 0;
            let c = 3077 - Float.fraction(z, 2001);
            let c = 3351 - Float.fraction(z, c);
            let c = 4079 - Float.fraction(z, c);
            let c = 5459 - Float.fraction(z, c);
            let c = 8192 - Float.fraction(z, c);
            let c = 16384 - Float.fraction(z, c);
        }
        do setPart(z);
        do shape.setPart(c);
        do product(this, shape);
        let s = sign;
        return n;
    }
";

pub(crate) const MAKE_LOG: &str = "    static Float ln2, doublings; // while a logarithm is found

    function void makeLog() {
        let ln2 = Float.new();
        do ln2.set(0, 126, 11357);
        let doublings = Float.new();
        return;
    }
";

pub(crate) const LOG: &str =
    "    /** this = the natural logarithm of a; of zero or a negative the most negative value */
    method void log(Array a) {
        if ((a[2] = 0) | (a[0] = 1)) { let s = 1; let e = 8000; let m = 16383; return; }
        do doublings.fromInt(nearLog(a));
        do doublings.product(ln2, doublings);
        do add(doublings, this);
        return;
    }
";

pub(crate) const POW: &str =
    "    /** this = a to the power b; to the power zero it is 1. Zero to a negative is
        the largest value, a negative to a fraction zero. */
    method void pow(Array a, Array b) {
        var int sign, n, p, q, h, l, x, unit;
        var boolean minus;
        let p = b[2];
        let x = b[1];
        let minus = (b[0] = 1);
        if (p = 0) { let s = 0; let e = 127; let m = 8192; return; }
        if (a[2] = 0) {
            let s = 0;
            let e = 0;
            let m = 0;
            if (minus) { let e = 8000; let m = 16383; }
            return;
        }
        let sign = 0;
        if ((a[0] = 1) & (x < 141)) {
            let q = 0;
            let unit = 2;
            if (x > 126) { let unit = powers[140 - x]; let q = p / unit; }
            if (~((q * unit) = p)) { let s = 0; let e = 0; let m = 0; return; }
            let sign = q & 1;
        }
        let whole = 0;
        let rest = 0;
        do doublings.copy(b);
        let n = nearLog(a);
        do product(this, doublings);
        do Float.natural(this);
        if (~(n = 0)) {
            if (n < 0) { let n = -n; let minus = ~minus; }
            let h = p / 128;
            let l = p & 127;
            let q = n / 128;
            let n = n & 127;
            let unit = (h * n) + (l * q);
            let l = ((unit & 127) * 128) + (l * n);
            let h = ((h * q) + (unit / 128)) + (l / 16384);
            do Float.split(h, l & 16383, 126 - x, minus);
        }
        do raise();
        let s = sign;
        return;
    }
";
