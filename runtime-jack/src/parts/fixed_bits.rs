//! Fixed point as the Hack's processor has it: the same values without its system's
//! products and quotients, bit by bit.

/// A bit of both bytes of `b`: what stands together in the product.
macro_rules! bytes_bits {
    ($low:literal, $high:literal) => {
        concat!(
            "        if (~((b & ",
            $low,
            ") = 0)) { let across = across + high; let least = least + half; }
        if (~((b & ",
            $high,
            ") = 0)) { let most = most + high; let other = other + a; }
        let high = high + high;
        let half = half + half;
        let a = a + a;
"
        )
    };
}

/// All bits of a magnitude from one on, divided by that.
macro_rules! upper_bits {
    ($from:literal / "128", $to:literal) => {
        concat!(
            bit_of_128th!($from, "128", $to, "1"),
            upper_bits!($from / "256", $to, "2", "4", "8", "16", "32", "64", "128")
        )
    };
    ($from:literal / "256", $to:literal) => {
        upper_bits!($from / "256", $to, "1", "2", "4", "8", "16", "32", "64")
    };
    ($from:literal / "256", $to:literal, $a:literal, $b:literal, $c:literal, $d:literal, $e:literal, $f:literal, $g:literal) => {
        concat!(
            bit_of_128th!($from, "256", $to, $a),
            bit_of_128th!($from, "512", $to, $b),
            bit_of_128th!($from, "1024", $to, $c),
            bit_of_128th!($from, "2048", $to, $d),
            bit_of_128th!($from, "4096", $to, $e),
            bit_of_128th!($from, "8192", $to, $f),
            bit_of_128th!($from, "16384", $to, $g),
        )
    };
}

/// The products of bytes that a product of magnitudes is made of: `most` is that of
/// both upper ones, and a is what the others are in 2^-8 of it, twice: the halves of
/// either, cut, and what the lower ones have in 256 of theirs.
macro_rules! magnitudes {
    ($result:literal) => {
        concat!(
            "        var int high, half, most, across, other, least, ",
            $result,
            ";
        var boolean minus;
",
            magnitudes_of!(),
            upper_bits!("a" / "256", "high"),
            "        let a = a & 255;
",
            bit_of_128th!("a", "2", "half", "1"),
            bit_of_128th!("a", "4", "half", "2"),
            bit_of_128th!("a", "8", "half", "4"),
            bit_of_128th!("a", "16", "half", "8"),
            bit_of_128th!("a", "32", "half", "16"),
            bit_of_128th!("a", "64", "half", "32"),
            bit_of_128th!("a", "128", "half", "64"),
            bytes_bits!("1", "256"),
            bytes_bits!("2", "512"),
            bytes_bits!("4", "1024"),
            bytes_bits!("8", "2048"),
            bytes_bits!("16", "4096"),
            bytes_bits!("32", "8192"),
            bytes_bits!("64", "16384"),
            "        if (~((b & 128) = 0)) { let across = across + high; let least = least + half; }
        let a = (across & (-2)) + (other & (-2));
",
            bit_of_128th!("least", "256", "a", "2"),
            bit_of_128th!("least", "512", "a", "4"),
            bit_of_128th!("least", "1024", "a", "8"),
            bit_of_128th!("least", "2048", "a", "16"),
            bit_of_128th!("least", "4096", "a", "32"),
            bit_of_128th!("least", "8192", "a", "64"),
            bit_of_128th!("least", "16384", "a", "128"),
        )
    };
}

pub(crate) const MUL: &str = concat!(
    "    /** a * b / 32768, rounded. */
    function int mul(int a, int b) {
",
    magnitudes!("p"),
    "        let a = a + 64;
        let p = most + most;
",
    upper_bits!("a" / "128", "p"),
    "        if (a < 0) { let p = p + 256; }
        if (minus) { return -p; }
        return p;
    }
"
);

pub(crate) const HALF_MUL: &str = concat!(
    "    /** a * b / 65536, rounded. */
    function int halfMul(int a, int b) {
",
    magnitudes!("p"),
    "        let a = a + 128;
        let p = most;
",
    upper_bits!("a" / "256", "p"),
    "        if (a < 0) { let p = p + 128; }
        if (minus) { return -p; }
        return p;
    }
"
);

pub(crate) const WIDE_MUL: &str = concat!(
    "    /** a * b * up / 65536, rounded; that is a * b / (512 * down). */
    function int wideMul(int a, int b, int up, int down) {
",
    magnitudes!("p, bit, value"),
    "        let a = a + down;
        let bit = down + down;
        let value = 1;
        while (~(bit = 0)) {
            if (~((a & bit) = 0)) { let p = p + value; }
            let bit = bit + bit;
            let value = value + value;
        }
        // up is what makes 128 of down.
        while (down < 128) {
            if (most > 16383) {
                let most = 32767;
                let down = 128;
            }
            else {
                let most = most + most;
                let down = down + down;
            }
        }
        if (most > (32767 - p)) { let p = 32767; }
        else { let p = most + p; }
        if (minus) { return -p; }
        return p;
    }
"
);

pub(crate) const LEFT: &str = "    /** a * unit; most is the greatest int that may be that. */
    function int left(int a, int most, int unit) {
        var int made;
        if (a > most) { return 32767; }
        if (a < (-most)) { return -32767; }
        let made = 1;
        while (made < unit) {
            let a = a + a;
            let made = made + made;
        }
        return a;
    }
";

pub(crate) const RIGHT: &str = concat!(
    "    /** a / (2 * half), rounded. */
    function int right(int a, int half) {
        var int p, bit, value;
        var boolean minus;
        if (a < 0) {
            let a = -a;
            let minus = true;
        }
        if (half = 1) {
            let p = a & 1;
",
    bit_of_128th!("a", "2", "p", "1"),
    bit_of_128th!("a", "4", "p", "2"),
    bit_of_128th!("a", "8", "p", "4"),
    bit_of_128th!("a", "16", "p", "8"),
    bit_of_128th!("a", "32", "p", "16"),
    bit_of_128th!("a", "64", "p", "32"),
    bit_of_128th!("a", "128", "p", "64"),
    bit_of_128th!("a", "256", "p", "128"),
    bit_of_128th!("a", "512", "p", "256"),
    bit_of_128th!("a", "1024", "p", "512"),
    bit_of_128th!("a", "2048", "p", "1024"),
    bit_of_128th!("a", "4096", "p", "2048"),
    bit_of_128th!("a", "8192", "p", "4096"),
    bit_of_128th!("a", "16384", "p", "8192"),
    "        }
        else {
            if (~((a & half) = 0)) { let p = 1; }
            let bit = half + half;
            let value = 1;
            while (~(bit = 0)) {
                if (~((a & bit) = 0)) { let p = p + value; }
                let bit = bit + bit;
                let value = value + value;
            }
        }
        if (minus) { return -p; }
        return p;
    }
"
);

pub(crate) const DIV: &str = concat!(
    "    /** a / b with so many bits more, rounded; by 0 the greatest with the sign of a. */
    function int div(int a, int b, int bits) {
        var int whole;
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
        while (bits > 0) {
            if (whole > 16383) {
                if (minus) { return -32767; }
                return 32767;
            }
            let whole = whole + whole;
            // What is left is below b: twice that, less b, has a sign.
            let a = (a - b) + a;
            if (a < 0) { let a = a + b; }
            else { let whole = whole + 1; }
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

/// A bit of the lower seven, times `step`.
macro_rules! step_bits {
    ($($bit:literal),*) => {
        concat!($(
            "        if (~((a & ", $bit, ") = 0)) { let more = more + step; }
        let step = step + step;
"
        ),*)
    };
}

/// What a table has at the 128ths that `a` counts, from `first` on, in proportion: `least`.
macro_rules! entry {
    ($table:literal, $first:literal) => {
        concat!(
            "        let at = ",
            $first,
            ";\n",
            upper_bits!("a" / "128", "at"),
            "        let least = ",
            $table,
            "[at];
        let step = ",
            $table,
            "[at + 1] - least;
        let more = 64;
",
            step_bits!("1", "2", "4", "8", "16", "32", "64"),
            upper_bits!("more" / "128", "least"),
        )
    };
}

pub(crate) const ENTRY: &str = concat!(
    "    /** What a table of 257 has at a / 128, in proportion. */
    function int entry(Array table, int a) {
        var int at, least, step, more;
",
    entry!("table", "0"),
    "        return least;
    }
"
);

pub(crate) const SQRT: &str = concat!(
    "    /** The root of a, which is made 4, 16, 64, ... times as large first; down is 2 times as
     *  large for each of these, from 1 for 0 on. */
    function int root(int a, int down) {
        var int at, least, step, more, half;
        if (a < 1) { return 0; }
        if (down > 1) {
            let half = 1;
            while ((half + half) < down) { let half = half + half; }
        }
        while (a < 8192) {
            let a = (a + a) + (a + a);
            let half = down;
            let down = down + down;
        }
",
    entry!("roots", "-64"),
    "        if (down = 1) { return least; }
        return Fixed.right(least, half);
    }
"
);

pub(crate) const DOUBLE_SQRT: &str =
    "    /** The root of 2 * a; down as for root, up as if for root of a / 2. */
    function int doubleRoot(int a, int down, int up) {
        if (a < 1) { return 0; }
        // Half of one less, rounded up, is half of it, cut.
        if (a > 16383) { return Fixed.root(Fixed.right(a - 1, 1), up); }
        return Fixed.root(a + a, down);
    }
";
