//! What `f316r` has in place of parts of `f316`: sums with a guard bit, and roots
//! from a table, all rounded. Its products and quotients are `product` and `ratio`.

macro_rules! add {
    ($alike:expr, $unlike:expr) => {
        sum!(
            "this = a + b, to the nearest",
            "add",
            "b[0]",
            $alike,
            $unlike
        )
    };
}

macro_rules! sub {
    ($alike:expr, $unlike:expr) => {
        sum!(
            "this = a - b, to the nearest",
            "sub",
            "1 - b[0]",
            $alike,
            $unlike
        )
    };
}

/// Of mantissas whose signs are the same.
macro_rules! alike {
    () => {
        "            let u = powers[d];
            let m = p + ((q + (u / 2)) / u);
            if (m > 16383) {
                let m = ((p + (q / u)) + 1) / 2;
                let e = e + 1;
                if (e > 8000) { let e = 8000; let m = 16383; }
            }
"
    };
}

/// Of mantissas whose signs differ: twice the difference, for a guard bit.
macro_rules! unlike {
    () => {
        "        let u = powers[d];
        let p = p + p;
        let m = p - ((q + q) / u);
        if (m > 16383) { let m = m / 2; return; }
        let e = e - 1;
        if (d > 1) {
            let u = u / 2;
            let m = p - ((q + (u / 2)) / u);
        }
        else {
            if (m = 0) { let s = 0; let e = 0; return; }
            if (m < 0) { let m = -m; let s = 1 - s; }
            while (m < 8192) { let m = m + m; let e = e - 1; }
        }
"
    };
}

pub(crate) const ADD: &str = add!(alike!(), unlike!());

pub(crate) const SUB: &str = sub!(alike!(), unlike!());

/// [`alike`] for the processor: shifts, and the bit that is rounded looked at.
macro_rules! alike_shifted {
    () => {
        "            if (d = 0) { let m = p + q; }
            else { let m = p + Float.shifted(q, d); }
            if (m < 16384) {
                if (d = 0) { return; }
                if ((q & powers[d - 1]) = 0) { return; }
                let m = m + 1;
                if (m < 16384) { return; }
                let m = 8192;
            }
            else { let m = Float.shifted(m - 16383, 1) + 8192; }
            let e = e + 1;
            if (e > 8000) { let e = 8000; let m = 16383; }
"
    };
}

/// [`unlike`] for the processor.
macro_rules! unlike_shifted {
    () => {
        "        let p = p + p;
        if (d > 1) {
            let m = p - Float.shifted(q, d - 1);
            if (m > 16383) { let m = Float.shifted(m - 16384, 1) + 8192; return; }
            let e = e - 1;
            if (~((q & powers[d - 2]) = 0)) { let m = m - 1; }
        }
        else {
            let m = p - q;
            if (d = 0) { let m = m - q; }
            if (m > 16383) { let m = Float.shifted(m - 16384, 1) + 8192; return; }
            let e = e - 1;
            if (m = 0) { let s = 0; let e = 0; return; }
            if (m < 0) { let m = -m; let s = 1 - s; }
            while (m < 8192) { let m = m + m; let e = e - 1; }
        }
"
    };
}

pub(crate) const ADD_SHIFTED: &str = add!(alike_shifted!(), unlike_shifted!());

pub(crate) const SUB_SHIFTED: &str = sub!(alike_shifted!(), unlike_shifted!());

/// The roots of 4096 + 32 k for k below 128, then of 64 k.
pub(crate) const MAKE_ROOTS: &str = "    static Array roots; // of what a mantissa begins with, cut

    function void makeRoots() {
        var int k, root, square;
        let roots = Array.new(256);
        let root = 64;
        let square = 4096;
        while (k < 256) {
            while (~(((root + 1) * (root + 1)) > square)) { let root = root + 1; }
            let roots[k] = root;
            let square = square + 32;
            if (k > 127) { let square = square + 32; }
            let k = k + 1;
        }
        return;
    }
";

/// A root is 128 g + c, and c + c c / 256 g = t / g. What wraps on the way, products
/// with p among them, is right again once the difference is taken.
pub(crate) const SQRT: &str =
    "    /** this = the root of a, to the nearest; of a negative zero. From a root g of 7
        bits: what is missing to a, over twice g, less a small square. */
    method void sqrt(Array a) {
        var int p, g, t, c;
        let p = a[2];
        if ((p = 0) | (a[0] = 1)) { let s = 0; let e = 0; let m = 0; return; }
        let s = 0;
        let e = a[1];
        let g = p / 64;
        if ((e & 1) = 0) { let g = roots[g]; let p = p * 64; }
        else { let g = roots[g - 128]; let p = p * 32; }
        let e = ((e + 8127) / 2) - 4000;
        let t = p - ((g * g) * 64);
        let c = t / g;
        let m = (g * 128) + ((t - ((c * c) / 256)) / g);
        if (((p * 256) - (m * m)) > m) { let m = m + 1; }
        return;
    }
";
