//! Tangents, arcs, powers and logarithms of fixed-point reals: see
//! [`crate::fixed::functions`] for how they work.

/// How a table of 257 entries goes on: its value, to which so many 128ths are added.
macro_rules! further {
    ($table:literal, $d:literal) => {
        concat!(
            "            let ",
            $table,
            "[k] = value;
            let rest = rest + ",
            $d,
            ";
            let value = value + (rest / 128);
            let rest = rest & 127;
            let k = k + 1;
"
        )
    };
}

pub(crate) const ENTRY: &str = "    /** What a table of 257 has at a / 128, in proportion. */
    function int entry(Array table, int a) {
        var int at, least;
        let at = a / 128;
        let least = table[at];
        return least + ((((table[at + 1] - least) * (a & 127)) + 64) / 128);
    }
";

pub(crate) const TAN: &str =
    "    /** The tangent of so many 65536ths of a turn, with so many bits behind the point. */
    function int tan(int turn, int bits) {
        return Fixed.div(Fixed.sin(turn), Fixed.sin(turn + 16384), bits);
    }
";

pub(crate) const MAKE_ARCS: &str = concat!(
    "    static Array arcs; // arc tangents of k / 256, times 32768
    /** 16384 / 256 over 1 + (k / 256)^2, in the middle of two, is what one grows by. */
    function void makeArcs() {
        var int k, value, rest, sum;
        let arcs = Array.new(257);
        let rest = 64;
        while (k < 256) {
            let sum = sum + k;
",
    further!("arcs", "Fixed.div(16384, 16384 + ((sum + 1) / 2), 14)"),
    "        }
        let arcs[256] = value;
        return;
    }
"
);

pub(crate) const ARC: &str = "    /** The arc tangent of a / b, which is at most 1, times 32768. */
    function int arc(int a, int b) { return Fixed.entry(arcs, Fixed.div(a, b, 15)); }
";

pub(crate) const ATAN2: &str = "    /** The angle of (x, y), times 8192. */
    function int atan2(int y, int x) {
        var int angle;
        var boolean minus, left;
        if (y < 0) {
            let y = -y;
            let minus = true;
        }
        if (x < 0) {
            let x = -x;
            let left = true;
        }
        if (y > x) { let angle = 12868 - ((Fixed.arc(x, y) + 2) / 4); }
        else { let angle = (Fixed.arc(y, x) + 2) / 4; }
        if (left) { let angle = 25736 - angle; }
        if (minus) { return -angle; }
        return angle;
    }
";

pub(crate) const HALF_ARC: &str =
    "    /** The angle whose cosine is a / 16384, or that without its sign, times 16384. */
    function int halfArc(int a) {
        if (a < 0) { let a = -a; }
        if (a > 16383) { return 0; }
        return Fixed.arc(Fixed.root(16384 - a, 1), Fixed.root(16384 + a, 1));
    }
";

pub(crate) const ASIN: &str = "    /** The angle whose sine is a / 16384, times 16384. */
    function int asin(int a) {
        if (a < 0) { return Fixed.halfArc(a) - 25736; }
        return 25736 - Fixed.halfArc(a);
    }
";

pub(crate) const ACOS: &str = "    /** The angle whose cosine is a / 16384, times 8192. */
    function int acos(int a) {
        if (a < 0) { return 25736 - ((Fixed.halfArc(a) + 1) / 2); }
        return (Fixed.halfArc(a) + 1) / 2;
    }
";

pub(crate) const MAKE_POWERS: &str = concat!(
    "    static Array powers, ones; // 2^(k/256) - 1, times 32768; 2^k
    /** Each is the one before and 11372 / 4194304 of it. */
    function void makePowers() {
        var int k, value, rest;
        let powers = Array.new(257);
        let rest = 50;
        while (k < 256) {
",
    further!("powers", "11372 + Fixed.mul(value, 11372)"),
    "        }
        let powers[256] = 32767;
        let ones = Array.new(15);
        let k = 0;
        let value = 1;
        while (k < 15) {
            let ones[k] = value;
            let value = value + value;
            let k = k + 1;
        }
        return;
    }
"
);

pub(crate) const POWER: &str =
    "    /** 2^(b (k + part / 32768)), or one over that, with so many bits behind the point. b
     *  has five more than make one, and those of unit less than 15. */
    function int power(int b, int k, int part, boolean under, int unit, int one, int bits) {
        var int whole, low;
        if (b < 0) {
            let b = -b;
            let under = ~under;
        }
        let low = Fixed.mul(b, part);
        let whole = (k * (b / 32)) + (low / 32);
        let whole = (whole + (((k * (b & 31)) + (low & 31)) / 32)) / one;
        let low = (((k * b) + low) * unit) & 32767;
        if (under) {
            let whole = -whole;
            if (low > 0) {
                let low = (32767 - low) + 1;
                let whole = whole - 1;
            }
        }
        let whole = whole + bits;
        if (whole > 14) { return 32767; }
        if (whole < 0) {
            if (whole = (-1)) { return 1; }
            return 0;
        }
        return ones[whole] + Fixed.right(Fixed.entry(powers, low), ones[14 - whole]);
    }
";

pub(crate) const EXP: &str = "    /** e to this power. */
    function int exp(int a, int unit, int one, int bits) {
        return Fixed.power(a, 1, 14506, false, unit, one, bits);
    }
";

pub(crate) const MAKE_LOGS: &str = concat!(
    "    static Array logs; // to the base 2 of 1 + k/256, times 32768
    /** 2 / ln(2) over the sum of two is what lies between their logarithms. */
    function void makeLogs() {
        var int k, value, rest;
        let logs = Array.new(257);
        let rest = 64;
        while (k < 256) {
",
    further!("logs", "Fixed.div(23637, (k + k) + 513, 9)"),
    "        }
        let logs[256] = value;
        return;
    }
"
);

pub(crate) const LOG: &str =
    "    /** Natural, of a * 2^k / 16384: its part above 1 / 1024 times unit, which saturates
     *  where it is above most; the rest over twice half. */
    function int log(int a, int k, int most, int unit, int half) {
        if (a < 1) { return -32767; }
        while (a < 16384) {
            let a = a + a;
            let k = k - 1;
        }
        let a = Fixed.mul(Fixed.entry(logs, (a + a) & 32767), 22713) + (k * 25);
        // Both of one sign.
        if (k < 0) {
            if (a > 0) {
                let a = a - 22688;
                let k = k + 1;
            }
        }
        return Int.add(Fixed.left(k * 709, most, unit), Fixed.right(a, half));
    }
";

pub(crate) const SMALL_LOG: &str =
    "    /** The same with ten bits behind the point, over twice half. */
    function int smallLog(int a, int k, int half) {
        if (a < 1) { return -32767; }
        return Fixed.right(Fixed.log(a, k, 32767, 1, 16), half);
    }
";

pub(crate) const POW: &str =
    "    /** (a * 2^k / 16384)^b; the rest as for power. A negative only to whole numbers. */
    function int pow(int a, int b, int k, int unit, int one, int bits) {
        var int part;
        var boolean minus, under;
        if (a = 0) {
            if (b < 0) { return 32767; }
            if (b > 0) { return 0; }
            let a = 1;
        }
        if (a < 0) {
            if (~((b & ((one * 32) - 1)) = 0)) { return 0; }
            let minus = ~((b & (one * 32)) = 0);
            let a = -a;
        }
        while (a < 16384) {
            let a = a + a;
            let k = k - 1;
        }
        let part = Fixed.entry(logs, (a + a) & 32767);
        if (k < 0) {
            let k = -k;
            let under = true;
            if (part > 0) {
                let part = (32767 - part) + 1;
                let k = k - 1;
            }
        }
        let a = Fixed.power(b, k, part, under, unit, one, bits);
        if (minus) { return -a; }
        return a;
    }
";
