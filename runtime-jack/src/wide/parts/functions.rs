//! Sines and arcs: see [`super::super::model`] for how they work.

pub(super) const MAKE_SHAPE: &str =
    "    static Float shape; // what a reduced argument is multiplied by

    function void makeShape() {
        let shape = Float.new();
        return;
    }
";

pub(super) const MAKE_QUARTER: &str = "    static Float quarter; // pi / 2, too large by excess

    function void makeQuarter() {
        let quarter = Float.new();
        do quarter.set(0, 127, 12867, 15787);
        return;
    }
";

pub(super) const MAKE_ONE: &str = "    static Float one; // 1

    function void makeOne() {
        let one = Float.new();
        do one.set(0, 127, 8192, 0);
        return;
    }
";

pub(super) const MAKE_EXCESS: &str = "    static Float excess, spare; // while a sine is found

    function void makeExcess() {
        let excess = Float.new();
        do excess.set(0, 99, 14202, 5950);
        let spare = Float.new();
        return;
    }
";

pub(super) const SINE: &str =
    "    /** this = the rest of the magnitude of a by whole quarter turns; returns
        their number. From 32768 on an angle counts as 0. */
    method int reduce(Array a) {
        var int r, v, k, n, t, u;
        let s = 0;
        let e = a[1];
        let m = a[2];
        let l = a[3];
        if (e < 127) { return 0; }
        if ((e > 141) | (m = 0)) { let e = 0; let m = 0; let l = 0; return 0; }
        let r = m;
        let v = l;
        let k = 0;
        let n = e - 127;
        while (~(n < 0)) {
            let k = k + k;
            let t = v - 15787;
            let u = r - 12867;
            if (t < 0) { let t = t + 16384; let u = u - 1; }
            if (~(u < 0)) { let r = u; let v = t; let k = k + 1; }
            if (n > 0) {
                let r = r + r;
                let v = v + v;
                if (v > 16383) { let v = v - 16384; let r = r + 1; }
            }
            let n = n - 1;
        }
        let m = r;
        let l = v;
        let e = 127;
        do normal();
        return k;
    }

    /** this = the sine of the magnitude of a and n quarter turns */
    method void quarterSine(Array a, int n) {
        var int k;
        let k = reduce(a);
        let n = n + k;
        if ((n & 1) = 1) {
            do sub(quarter, this);
            do spare.fromInt(k + 1);
            do spare.mul(excess, spare);
            do sub(this, spare);
        }
        else {
            if (k > 0) {
                do spare.fromInt(k);
                do spare.mul(excess, spare);
                do add(this, spare);
            }
        }
        do shape.scale(this, -1);
        do shape.square();
        let high = 0;
        let low = 6619;
        do Float.minus(11, 9005);
        do Float.minus(208, 801);
        do Float.minus(2184, 8736);
        do Float.minus(10922, 10923);
        do Float.minus(16384, 0);
        do shape.setFraction();
        do mul(this, shape);
        if ((n & 2) = 2) { let s = 1 - s; }
        return;
    }
";

pub(super) const SIN: &str = crate::parts::functions::SIN;

pub(super) const COS: &str = crate::parts::functions::COS;

pub(super) const MAKE_TANGENT: &str = crate::parts::functions::MAKE_TANGENT;

pub(super) const TAN: &str = "    /** this = the tangent of a */
    method void tan(Array a) {
        do rise.sin(a);
        do cos(a);
        do div(rise, this);
        return;
    }
";

pub(super) const ATAN2: &str = "    /** this = the angle of (y, x), of (0, 0) zero */
    method void atan2(Array y, Array x) {
        var int p, d, sign;
        var boolean flat, left;
        let p = y[2];
        if ((p = 0) & (x[2] = 0)) { let s = 0; let e = 0; let m = 0; let l = 0; return; }
        let sign = 0;
        if (p > 0) { let sign = y[0]; }
        let left = (x[0] = 1) & (x[2] > 0);
        let d = y[1] - x[1];
        if (p = 0) { let flat = true; }
        else {
            if (x[2] = 0) { let flat = false; }
            else {
                if (d = 0) {
                    let d = p - x[2];
                    if (d = 0) { let d = y[3] - x[3]; }
                }
                let flat = (d < 0);
            }
        }
        if (flat) { do div(y, x); }
        else { do div(x, y); }
        let s = 0;
        do square();
        let high = 25;
        let low = 10705;
        do Float.minus(155, 8723);
        do Float.minus(441, 12050);
        do Float.minus(813, 1749);
        do Float.minus(1158, 9811);
        do Float.minus(1465, 10741);
        do Float.minus(1817, 2386);
        do Float.minus(2340, 5490);
        do Float.minus(3276, 12999);
        do Float.minus(5461, 5461);
        do Float.minus(16384, 0);
        do shape.setFraction();
        do mul(this, shape);
        if (~flat) { do sub(quarter, this); }
        if (left) {
            do shape.scale(quarter, 1);
            do sub(shape, this);
        }
        let s = sign;
        return;
    }
";

pub(super) const LEG: &str =
    "    /** this = the root of 1 less the square of a; 0 where that is above 1. */
    method void leg(Array a) {
        if (a[1] > 126) { let s = 0; let e = 0; let m = 0; let l = 0; return; }
        do abs(a);
        do shape.add(one, this);
        do sub(one, this);
        do mul(shape, this);
        do sqrt(this);
        return;
    }
";

pub(super) const ASIN: &str = "    /** this = the angle whose sine is a, kept within -1 and 1 */
    method void asin(Array a) {
        do rise.leg(a);
        do atan2(a, rise);
        return;
    }
";

pub(super) const ACOS: &str = "    /** this = the angle whose cosine is a, kept within -1 and 1 */
    method void acos(Array a) {
        do rise.leg(a);
        do atan2(rise, a);
        return;
    }
";
