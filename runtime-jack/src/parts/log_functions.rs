//! Sines, arcs, powers and logarithms of logarithmic reals: see
//! [`crate::log`] for how they work.

pub(crate) const SINE: &str = "    /** Of the sine of an angle up to a quarter turn. */
    function int sine(int a) {
        var int z, c;
        if (a < (-5632)) { return a; }
        let z = a + a;
        let c = Log.leave(0, z - 5575);
        let c = Log.leave(0, (z + c) - 4426);
        return a + Log.leave(0, (z + c) - 2647);
    }

    /** Of the sine of a magnitude and n quarter turns; plus() is its sign. From 256
     *  quarter turns on a magnitude counts as whole ones. */
    function int quarterSine(int a, int n) {
        var int k;
        let k = Log.whole(a - 667);
        let n = n + k;
        let plus = true;
        if (k > 255) { let a = -13312; }
        else {
            if (k > 0) { let a = Log.add(a, true, logs[k] + 667, false); }
        }
        if ((n & 1) = 1) { let a = Log.add(667, true, a, ~plus); }
        if ((n & 2) = 2) { let plus = ~plus; }
        return Log.sine(a);
    }
";

pub(crate) const SIN: &str = "    /** Of the sine; plus() is its sign. */
    function int sin(int a, boolean aPlus) {
        let a = Log.quarterSine(a, 0);
        let plus = (plus = aPlus);
        return a;
    }
";

pub(crate) const TAN: &str = "    /** Of the tangent; plus() is its sign. */
    function int tan(int a, boolean aPlus) {
        var int c;
        var boolean right;
        let c = Log.quarterSine(a, 1);
        let right = plus;
        let a = Log.quarterSine(a, 0);
        let plus = (plus = aPlus) = right;
        return Log.clamp(a - c);
    }
";

pub(crate) const ANGLE: &str = "    /** Of the angle of (b, a), both positive. */
    function int angle(int a, int b) {
        if (a < b) { return Log.arc(a - b); }
        return Log.leave(667, Log.arc(b - a));
    }

    /** Of the arc tangent of what is at most 1. */
    function int arc(int a) {
        if (a < (-1302)) { return Log.smallArc(a); }
        return Log.leave(-357, Log.smallArc(Log.difference(0, a) - Log.sum(0, a)));
    }

    /** The same up to the root of 2 less 1. */
    function int smallArc(int a) {
        var int z;
        if (a < (-5632)) { return a; }
        let z = a + a;
        return a + Log.leave(0, (z - 1623) + Log.leave(0, z - 907));
    }
";

pub(crate) const ATAN2: &str = "    /** Of the angle of (x, y); its sign is that of y. */
    function int atan2(int y, int x, boolean xPlus) {
        let y = Log.angle(y, x);
        if (xPlus) { return Math.max(y, -13312); }
        return Log.leave(1691, y);
    }
";

pub(crate) const ASIN: &str =
    "    /** Of the angle whose sine it is, at most 1; it has its sign. */
    function int asin(int a) {
        if (a < 0) { return Log.angle(a, Log.half(Log.difference(0, a + a))); }
        return 667;
    }
";

pub(crate) const ACOS: &str = "    /** Of the angle whose cosine it is, kept within -1 and 1. */
    function int acos(int a, boolean aPlus) {
        if (a < 0) { let a = Log.angle(Log.half(Log.difference(0, a + a)), a); }
        else { let a = -13312; }
        if (aPlus) { return a; }
        return Log.leave(1691, a);
    }
";

pub(crate) const UNITS: &str =
    "    /** The whole number nearest to the magnitude, at most 32767. */
    function int units(int a) {
        var int n, unit, low, gap;
        if (a > 15359) { return 32767; }
        if (a < 8192) { return (Log.whole(a + 1024) + 1) / 2; }
        let unit = 1;
        while (a > 9215) {
            let a = a - 1024;
            let unit = unit + unit;
        }
        let n = Log.whole(a);
        let low = logs[n];
        let gap = logs[n + 1] - low;
        return (n * unit) + ((((a - low) * unit) + (gap / 2)) / gap);
    }
";

pub(crate) const EXP: &str = "    /** Of e to this power. */
    function int exp(int a, boolean aPlus) {
        let a = Log.units(a + 10781);
        if (aPlus) { return Math.min(a, 16383); }
        return Math.max(-a, -13312);
    }
";

pub(crate) const LOG: &str =
    "    /** Of the natural logarithm; plus() is its sign. That of 0 is the most negative value. */
    function int log(int a, boolean aPlus) {
        let plus = false;
        if ((~aPlus) | (a < (-13311))) { return 16383; }
        let plus = ~(a < 0);
        if (a = 0) { return -13312; }
        return Log.fromInt(a) - 10781;
    }
";

pub(crate) const POW: &str =
    "    /** Of a to the power b; plus() is its sign. To the power 0 it is 1; 0 to a negative
     *  is the largest value, a negative to a fraction 0. */
    function int pow(int a, boolean aPlus, int b, boolean bPlus) {
        var int n, size;
        var boolean whole, less;
        let plus = true;
        if (b < (-13311)) { return 0; }
        if (a < (-13311)) {
            if (bPlus) { return -13312; }
            return 16383;
        }
        let n = Log.whole(b);
        let whole = false;
        if (n < 513) { let whole = (logs[n] = b); }
        if (~aPlus) {
            if (whole) { let plus = (n & 1) = 0; }
            else {
                if (b < 9217) { return -13312; }
            }
        }
        if (a = 0) { return 0; }
        let less = (a < 0) = bPlus;
        let size = Math.abs(a);
        if (whole) {
            if (size > (16383 / n)) { let size = 16383; }
            else { let size = size * n; }
        }
        else { let size = Log.units(b + Log.fromInt(size)); }
        if (less) { return Math.max(-size, -13312); }
        return Math.min(size, 16383);
    }
";
