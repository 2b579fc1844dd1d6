//! The class of fixed-point reals.

/// What makes operands magnitudes: `minus` is the sign of their product.
macro_rules! magnitudes_of {
    () => {
        "        if (a < 0) {
            let a = -a;
            let minus = true;
        }
        if (b < 0) {
            let b = -b;
            let minus = ~minus;
        }
"
    };
}

/// The bytes of magnitudes: `high` and `other`, and `a` and `b` the lower ones.
macro_rules! bytes {
    () => {
        concat!(
            "        var int high, other;
        var boolean minus;
",
            magnitudes_of!(),
            "        let high = a / 256;
        let a = a & 255;
        let other = b / 256;
        let b = b & 255;
"
        )
    };
}

/// What the lower ones add to the product of the upper ones, in 128ths of its unit.
macro_rules! lower {
    () => {
        "(((high * b) / 2) + ((other * a) / 2)) + (((a / 2) * b) / 256)"
    };
}

pub(crate) const HEAD: &str = "    /**
     * Reals in fixed point: n stands for n / 2, n / 4, n / 8, ..., each value its own. All
     * are from -32767 to 32767; what would be more saturates.
     */
";

pub(crate) const LEFT: &str = "    /** a * unit; most is the greatest int that may be that. */
    function int left(int a, int most, int unit) {
        if (a > most) { return 32767; }
        if (a < (-most)) { return -32767; }
        return a * unit;
    }
";

pub(crate) const RIGHT: &str = "    /** a / (2 * half), rounded. */
    function int right(int a, int half) {
        if (a < 0) {
            let a = (-a) / half;
            return (a / 2) - a;
        }
        let a = a / half;
        return a - (a / 2);
    }
";

pub(crate) const MUL: &str = concat!(
    "    /** a * b / 32768, rounded. */
    function int mul(int a, int b) {
",
    bytes!(),
    "        let a = ((",
    lower!(),
    ") + 32) / 64;
        let high = high * other;
        if (minus) { return -((high + high) + a); }
        return (high + high) + a;
    }
"
);

pub(crate) const HALF_MUL: &str = concat!(
    "    /** a * b / 65536, rounded. */
    function int halfMul(int a, int b) {
",
    bytes!(),
    "        let a = ((",
    lower!(),
    ") + 64) / 128;
        if (minus) { return -((high * other) + a); }
        return (high * other) + a;
    }
"
);

pub(crate) const WIDE_MUL: &str = concat!(
    "    /** a * b * up / 65536, rounded; that is a * b / (512 * down). */
    function int wideMul(int a, int b, int up, int down) {
",
    bytes!(),
    "        let a = ",
    lower!(),
    ";
        let a = (a + (down / 2)) / down;
        let high = high * other;
        if (high > ((32767 - a) / up)) { let a = 32767; }
        else { let a = (high * up) + a; }
        if (minus) { return -a; }
        return a;
    }
"
);

pub(crate) const DIV: &str = concat!(
    "    /** a / b with so many bits more, rounded; by 0 the greatest with the sign of a. */
    function int div(int a, int b, int bits) {
        var int whole, high, low, digit;
        var boolean minus;
        if (b = 0) {
            if (a = 0) { return 0; }
            if (a < 0) { return -32767; }
            return 32767;
        }
",
    magnitudes_of!(),
    "        while (b < 16384) {
            let b = b + b;
            let bits = bits + 1;
        }
        if (~(a < b)) {
            let whole = 1;
            let a = a - b;
        }
        // Seven bits at once, at most one or two too many by the upper half of b.
        let high = b / 128;
        let low = b & 127;
        while (bits > 6) {
            if (whole > 255) {
                if (minus) { return -32767; }
                return 32767;
            }
            let digit = a / high;
            let a = ((a - (digit * high)) * 128) - (digit * low);
            while (a < 0) {
                let digit = digit - 1;
                let a = a + b;
            }
            let whole = (whole * 128) + digit;
            let bits = bits - 7;
        }
        while (bits > 0) {
            if (whole > 16383) {
                if (minus) { return -32767; }
                return 32767;
            }
            let whole = whole + whole;
            if (a < (b - a)) { let a = a + a; }
            else {
                let a = a - (b - a);
                let whole = whole + 1;
            }
            let bits = bits - 1;
        }
        if (~(a < (b - a))) {
            if (whole < 32767) { let whole = whole + 1; }
        }
        if (minus) { return -whole; }
        return whole;
    }
"
);

pub(crate) const MAKE_ROOTS: &str =
    "    static Array roots; // of k / 256, times 32768, from k = 64 on
    /** The greatest numbers whose squares are not above. */
    function void makeRoots() {
        var int k, root, step;
        let roots = Array.new(193);
        let root = 16384;
        let k = 0;
        while (k < 192) {
            let step = 64;
            while (step > 0) {
                if (~(Fixed.mul(root + step, root + step) > ((k + 64) * 128))) {
                    let root = root + step;
                }
                let step = step / 2;
            }
            let roots[k] = root;
            let k = k + 1;
        }
        let roots[192] = 32767;
        return;
    }
";

pub(crate) const SQRT: &str =
    "    /** The root of a, which is made 4, 16, 64, ... times as large first; down is 2 times as
     *  large for each of these, from 1 for 0 on. */
    function int root(int a, int down) {
        var int at, least;
        if (a < 1) { return 0; }
        while (a < 8192) {
            let a = (a + a) + (a + a);
            let down = down + down;
        }
        let at = (a / 128) - 64;
        let least = roots[at];
        let a = least + ((((roots[at + 1] - least) * (a & 127)) + 64) / 128);
        if (down = 1) { return a; }
        return Fixed.right(a, down / 2);
    }
";

pub(crate) const DOUBLE_SQRT: &str =
    "    /** The root of 2 * a; down as for root, up as if for root of a / 2. */
    function int doubleRoot(int a, int down, int up) {
        if (a < 1) { return 0; }
        if (a > 16383) { return Fixed.root(a / 2, up); }
        return Fixed.root(a + a, down);
    }
";

pub(crate) const MAKE_SINES: &str =
    "    static Array sines; // times 16384, of a quarter of a turn in 128 steps
    /** That in the middle of two is their mean over the cosine of half their distance. */
    function void makeSines() {
        let sines = Array.new(130);
        let sines[0] = 0;
        let sines[128] = 16384;
        let sines[129] = 16384;
        do Fixed.between(64, 23170);
        do Fixed.between(32, 17734);
        do Fixed.between(16, 16705);
        do Fixed.between(8, 16463);
        do Fixed.between(4, 16404);
        do Fixed.between(2, 16389);
        do Fixed.between(1, 16385);
        return;
    }

    function void between(int step, int factor) {
        var int k;
        let k = step;
        while (k < 128) {
            let sines[k] = Fixed.mul(sines[k - step] + sines[k + step], factor);
            let k = k + (step + step);
        }
        return;
    }
";

pub(crate) const TURNS: &str =
    "    /** Radians, times 8192 / unit, in units of which 65536 are a turn. */
    function int turns(int a, int unit) { return (a + Fixed.halfMul(a, 17907)) * unit; }
";

pub(crate) const SIN: &str = "    /** The sine of so many 65536ths of a turn, times 16384. */
    function int sin(int turn) {
        var int at, least;
        var boolean minus;
        if (turn < 0) {
            let turn = -turn;
            // Half a turn has no negative.
            if (turn < 0) { return 0; }
            let minus = true;
        }
        if (turn > 16384) { let turn = (32767 - turn) + 1; }
        let at = turn / 128;
        let least = sines[at];
        let least = least + ((((sines[at + 1] - least) * (turn & 127)) + 64) / 128);
        if (minus) { return -least; }
        return least;
    }
";

pub(crate) const FLOOR: &str = "    /** The greatest whole number not above a / unit. */
    function int floor(int a, int unit) {
        if (a < 0) { return (-1) - (((-1) - a) / unit); }
        return a / unit;
    }
";
