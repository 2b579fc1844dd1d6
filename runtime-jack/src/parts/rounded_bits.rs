//! What is rounded, as the Hack's processor has it: the same values bit by bit. Its
//! sums are beside the others, in `rounded`.

/// Beside [`product_bits`], the product of the low halves, v.
macro_rules! whole_product_bits {
    ($low:literal, $high:literal) => {
        concat!(
            "        if (~((q & ",
            $low,
            ") = 0)) { let u = u + h; let v = v + l; }
        if (~((q & ",
            $high,
            ") = 0)) { let t = t + h; let u = u + l; }
        let h = h + h;
        let l = l + l;
"
        )
    };
}

pub(crate) const PRODUCT: &str = concat!(
    "    /** this = a * b, to the nearest */
    method void product(Array a, Array b) {
        var int p, q, h, l, t, u, v;
        let p = a[2];
        let q = b[2];
        let s = (a[0] + b[0]) & 1;
        if ((p = 0) | (q = 0)) { let e = 0; let m = 0; return; }
        let e = (a[1] + b[1]) - 126;
        let l = p & 127;
        let h = 64;
",
    bit_of_128th!("p", "128", "h", "1"),
    bit_of_128th!("p", "256", "h", "2"),
    bit_of_128th!("p", "512", "h", "4"),
    bit_of_128th!("p", "1024", "h", "8"),
    bit_of_128th!("p", "2048", "h", "16"),
    bit_of_128th!("p", "4096", "h", "32"),
    "        let t = 0;
        let u = 0;
        let v = 0;
",
    whole_product_bits!("1", "128"),
    whole_product_bits!("2", "256"),
    whole_product_bits!("4", "512"),
    whole_product_bits!("8", "1024"),
    whole_product_bits!("16", "2048"),
    whole_product_bits!("32", "4096"),
    "        if (~((q & 64) = 0)) { let u = u + h; let v = v + l; }
        let p = t + h;
        let u = u + l;
",
    bit_of_128th!("v", "128", "u", "1"),
    bit_of_128th!("v", "256", "u", "2"),
    bit_of_128th!("v", "512", "u", "4"),
    bit_of_128th!("v", "1024", "u", "8"),
    bit_of_128th!("v", "2048", "u", "16"),
    bit_of_128th!("v", "4096", "u", "32"),
    bit_of_128th!("v", "8192", "u", "64"),
    bit_of_128th!("u", "128", "p", "1"),
    bit_of_128th!("u", "256", "p", "2"),
    bit_of_128th!("u", "512", "p", "4"),
    bit_of_128th!("u", "1024", "p", "8"),
    bit_of_128th!("u", "2048", "p", "16"),
    bit_of_128th!("u", "4096", "p", "32"),
    bit_of_128th!("u", "8192", "p", "64"),
    bit_of_128th!("u", "16384", "p", "128"),
    "        let m = p;
",
    bit_of_128th!("u", "64", "m", "1"),
    "        if (p < 8192) {
            let m = m + p;
            if (~((u & 32) = 0)) { let m = m + 1; }
            if (m > 16383) { let m = 8192; }
            else { let e = e - 1; }
        }
",
    ends!("(e > 8000) | (e < (-8000))")
);

/// A bit of a quotient, the rest doubled.
macro_rules! ratio_bits {
    ($($bit:literal),*) => {
        concat!($(
            "        let r = (r + r) - d;
        if (r < 0) { let r = r + d; }
        else { let m = m + ", $bit, "; }
"
        ),*)
    };
}

pub(crate) const RATIO: &str = concat!(
    "    /** this = a / b, to the nearest; by zero the largest value, zero by zero is zero. */
    method void ratio(Array a, Array b) {
        var int r, d;
        let r = a[2];
        let d = b[2];
        if (r = 0) { let s = 0; let e = 0; let m = 0; return; }
        if (d = 0) { let s = a[0]; let e = 8000; let m = 16383; return; }
        let s = (a[0] + b[0]) & 1;
        let e = (a[1] + 127) - b[1];
        let r = r - d;
        if (r < 0) { let r = (r + r) + d; let e = e - 1; }
        let m = 8192;
",
    ratio_bits!(
        "4096", "2048", "1024", "512", "256", "128", "64", "32", "16", "8", "4", "2", "1"
    ),
    "        if (~((r + r) < d)) { let m = m + 1; }
",
    ends!("(e > 8000) | (e < (-8000))")
);

/// A bit of the root.
macro_rules! root_bit {
    ($bit:literal, $half:literal) => {
        concat!(
            "        let t = q + ",
            $half,
            ";
        let f = f - t;
        if (f < 0) { let f = f + t; }
        else { let q = q + ",
            $bit,
            "; }
        let f = f + f;
"
        )
    };
}

/// [`SQRT`] needs none.
pub(crate) const MAKE_NO_ROOTS: &str = "    function void makeRoots() {
        return;
    }
";

pub(crate) const SQRT: &str = concat!(
    "    /** this = the root of a, to the nearest; of a negative zero. Bit by bit: f is
        half of what is missing, over the bit. */
    method void sqrt(Array a) {
        var int q, f, t;
        let f = a[2];
        if ((f = 0) | (a[0] = 1)) { let s = 0; let e = 0; let m = 0; return; }
        let s = 0;
        let e = a[1] + 8127;
        if ((e & 1) = 1) { let f = f + f; }
        let t = e;
        let e = -4000;
",
    bit_of_128th!("t", "2", "e", "1"),
    bit_of_128th!("t", "4", "e", "2"),
    bit_of_128th!("t", "8", "e", "4"),
    bit_of_128th!("t", "16", "e", "8"),
    bit_of_128th!("t", "32", "e", "16"),
    bit_of_128th!("t", "64", "e", "32"),
    bit_of_128th!("t", "128", "e", "64"),
    bit_of_128th!("t", "256", "e", "128"),
    bit_of_128th!("t", "512", "e", "256"),
    bit_of_128th!("t", "1024", "e", "512"),
    bit_of_128th!("t", "2048", "e", "1024"),
    bit_of_128th!("t", "4096", "e", "2048"),
    bit_of_128th!("t", "8192", "e", "4096"),
    "        let f = f - 8192;
        let q = 8192;
",
    root_bit!("4096", "2048"),
    root_bit!("2048", "1024"),
    root_bit!("1024", "512"),
    root_bit!("512", "256"),
    root_bit!("256", "128"),
    root_bit!("128", "64"),
    root_bit!("64", "32"),
    root_bit!("32", "16"),
    root_bit!("16", "8"),
    root_bit!("8", "4"),
    root_bit!("4", "2"),
    root_bit!("2", "1"),
    "        if (f > q) {
            let f = (f - q) + (f - q);
            let q = q + 1;
            if ((f - 1) > q) { let q = q + 1; }
        }
        else { if ((f + f) > q) { let q = q + 1; } }
        let m = q;
        return;
    }
"
);
