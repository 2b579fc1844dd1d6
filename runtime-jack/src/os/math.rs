//! `Math`: products and quotients on a processor that adds.
//!
//! Both are written out step by step, without a loop: most of what a float program
//! does is in here.

pub(super) const ABS: &str = "    function int abs(int x) {
        if (x < 0) { return -x; }
        return x;
    }
";

/// Whichever of two comes first or last. Signs that differ decide: the difference
/// would not fit.
macro_rules! pick {
    ($name:literal, $where_a_is_less:literal, $otherwise:literal) => {
        concat!(
            "    function int ",
            $name,
            "(int a, int b) {
        var boolean less;
        if ((a < 0) = (b < 0)) { let less = ((a - b) < 0); }
        else { let less = (a < 0); }
        if (less) { return ",
            $where_a_is_less,
            "; }
        return ",
            $otherwise,
            ";
    }
"
        )
    };
}

pub(super) const MIN: &str = pick!("min", "a", "b");
pub(super) const MAX: &str = pick!("max", "b", "a");

/// One bit of a factor.
macro_rules! product_bit {
    ($bit:literal) => {
        concat!(
            "        if (~((y & ",
            $bit,
            ") = 0)) { let sum = sum + x; }
        let x = x + x;
"
        )
    };
}

/// The last 16 bits of a product do not mind the signs, so both factors may change
/// theirs; the lesser one is looked at bit by bit.
pub(super) const MULTIPLY: &str = concat!(
    "    /** x * y: x, doubled at every step, is added up where y has a bit. */
    function int multiply(int x, int y) {
        var int sum;
        if (y < 0) {
            let x = -x;
            let y = -y;
            if (y < 0) { // it was -32768
                if ((x & 1) = 0) { return 0; }
                return y;
            }
        }
        if ((x - y) < 0) {
            if (~(x < 0)) { let sum = x; let x = y; let y = sum; }
        }
        let sum = 0;
",
    product_bit!("1"),
    product_bit!("2"),
    product_bit!("4"),
    product_bit!("8"),
    "        if (y < 16) { return sum; }\n",
    product_bit!("16"),
    product_bit!("32"),
    product_bit!("64"),
    "        if (y < 128) { return sum; }\n",
    product_bit!("128"),
    product_bit!("256"),
    product_bit!("512"),
    product_bit!("1024"),
    "        if (y < 2048) { return sum; }\n",
    product_bit!("2048"),
    product_bit!("4096"),
    product_bit!("8192"),
    "        if (~((y & 16384) = 0)) { return sum + x; }
        return sum;
    }
"
);

/// Twice the divisor, if that is not above what is left; `inner`, which does the
/// same with twice as much; and then this one. `half` is not above x.
macro_rules! quotient_bit {
    ($half:literal, $y:literal, $bit:literal, $inner:expr) => {
        concat!(
            "        if (~((x - ",
            $half,
            " - ",
            $half,
            ") < 0)) {
        let ",
            $y,
            " = ",
            $half,
            " + ",
            $half,
            ";
",
            $inner,
            "        if (~((x - ",
            $y,
            ") < 0)) { let x = x - ",
            $y,
            "; let q = q + ",
            $bit,
            "; }
        }
"
        )
    };
}

/// A bit of x where it comes to in the quotient.
macro_rules! shifted_bit {
    ($bit:literal, $value:literal) => {
        concat!(
            "            if (~((x & ",
            $bit,
            ") = 0)) { let q = q + ",
            $value,
            "; }\n"
        )
    };
}

/// Halves and 128ths, which floats are made of, are bits in other places.
#[rustfmt::skip]
pub(super) const DIVIDE: &str = concat!(
    "    /** x / y, cut towards 0: y is doubled while it is not above x, and taken
        away from it on the way back. */
    function int divide(int x, int y) {
        var int q, y1, y2, y3, y4, y5, y6, y7, y8, y9, y10, y11, y12, y13, y14;
        var boolean minus;
        let q = 0;
        let minus = false;
        if (~((x < 0) | (y < 1))) {
        if (y = 2) {
",
    shifted_bit!("2", "1"), shifted_bit!("4", "2"), shifted_bit!("8", "4"),
    shifted_bit!("16", "8"), shifted_bit!("32", "16"), shifted_bit!("64", "32"),
    "            if (x > 127) {\n",
    shifted_bit!("128", "64"), shifted_bit!("256", "128"), shifted_bit!("512", "256"),
    shifted_bit!("1024", "512"), shifted_bit!("2048", "1024"), shifted_bit!("4096", "2048"),
    shifted_bit!("8192", "4096"), shifted_bit!("16384", "8192"),
    "            }
            return q;
        }
        if (y = 128) {
",
    shifted_bit!("128", "1"), shifted_bit!("256", "2"), shifted_bit!("512", "4"),
    shifted_bit!("1024", "8"), shifted_bit!("2048", "16"), shifted_bit!("4096", "32"),
    shifted_bit!("8192", "64"), shifted_bit!("16384", "128"),
    "            return q;
        }
        }
        else {
            if (y = 0) { do Sys.error(3); }
            let minus = ~((x < 0) = (y < 0));
            if (y < 0) {
                let y = -y;
                if (y < 0) { // it was -32768
                    if (x = y) { return 1; }
                    return 0;
                }
            }
            if (x < 0) {
                let x = -x;
                if (x < 0) { let x = x - y; let q = 1; } // it was -32768
            }
        }
",
    "        if (~((x - y) < 0)) {\n",
    quotient_bit!("y", "y1", "2",
    quotient_bit!("y1", "y2", "4",
    quotient_bit!("y2", "y3", "8",
    quotient_bit!("y3", "y4", "16",
    quotient_bit!("y4", "y5", "32",
    quotient_bit!("y5", "y6", "64",
    quotient_bit!("y6", "y7", "128",
    quotient_bit!("y7", "y8", "256",
    quotient_bit!("y8", "y9", "512",
    quotient_bit!("y9", "y10", "1024",
    quotient_bit!("y10", "y11", "2048",
    quotient_bit!("y11", "y12", "4096",
    quotient_bit!("y12", "y13", "8192",
    quotient_bit!("y13", "y14", "16384", "")))))))))))))),
    "        if (~((x - y) < 0)) { let q = q + 1; }
        }
        if (minus) { return -q; }
        return q;
    }
"
);

/// The sum of the first n odd numbers is the square of n.
pub(super) const SQRT: &str = "    /** The greatest int whose square is not above x. */
    function int sqrt(int x) {
        var int root, odd;
        if (x < 0) { do Sys.error(4); }
        let root = 0;
        let odd = 1;
        let x = x - odd;
        while (~(x < 0)) {
            let odd = odd + 2;
            let root = root + 1;
            let x = x - odd;
        }
        return root;
    }
";
