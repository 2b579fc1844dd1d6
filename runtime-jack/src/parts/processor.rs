//! Parts as the Hack's processor has them, where a product takes a hundred cycles
//! and a quotient more: they add and look at bits. The values are the same; on the
//! VM, where a product is one command, they are slower than the others.

/// A bit of both halves of `q`, h 128 + l being the other factor: what stands
/// together in the product, t 128 + u.
macro_rules! product_bits {
    ($low:literal, $high:literal) => {
        concat!(
            "        if (~((q & ",
            $low,
            ") = 0)) { let u = u + h; }
        if (~((q & ",
            $high,
            ") = 0)) { let t = t + h; let u = u + l; }
        let h = h + h;
        let l = l + l;
"
        )
    };
}

/// A bit where it comes to, divided by 128.
macro_rules! bit_of_128th {
    ($from:literal, $bit:literal, $to:literal, $value:literal) => {
        concat!(
            "        if (~((",
            $from,
            " & ",
            $bit,
            ") = 0)) { let ",
            $to,
            " = ",
            $to,
            " + ",
            $value,
            "; }\n"
        )
    };
}

pub(crate) const MUL: &str = concat!(
    "    /** this = a * b; of the mantissas' halves, low times low is dropped. */
    method void mul(Array a, Array b) {
        var int p, q, h, l, t, u, x;
        let p = a[2];
        let q = b[2];
        let x = (a[1] + b[1]) - 126;
        let s = (a[0] + b[0]) & 1;
        if ((p = 0) | (q = 0)) { let e = 0; let m = 0; return; }
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
",
    product_bits!("1", "128"),
    product_bits!("2", "256"),
    product_bits!("4", "512"),
    product_bits!("8", "1024"),
    product_bits!("16", "2048"),
    product_bits!("32", "4096"),
    "        if (~((q & 64) = 0)) { let u = u + h; }
        let p = t + h;
        let u = u + l;
",
    bit_of_128th!("u", "128", "p", "1"),
    bit_of_128th!("u", "256", "p", "2"),
    bit_of_128th!("u", "512", "p", "4"),
    bit_of_128th!("u", "1024", "p", "8"),
    bit_of_128th!("u", "2048", "p", "16"),
    bit_of_128th!("u", "4096", "p", "32"),
    bit_of_128th!("u", "8192", "p", "64"),
    bit_of_128th!("u", "16384", "p", "128"),
    "        if (p < 8192) { let p = p + p; let x = x - 1; }
        if (x > 8000) { let x = 8000; let p = 16383; }
        if (x < (-8000)) { let s = 0; let x = 0; let p = 0; }
        let e = x;
        let m = p;
        return;
    }
"
);

/// What stays of a mantissa, or of its upper half, after so many halvings: its bits
/// from there on, one place after the other.
macro_rules! shifted_by {
    ($shift:literal, $($bit:literal $value:literal),*) => {
        concat!(
            "        if (d = ",
            $shift,
            ") {\n",
            $(bit_of_128th!("q", $bit, "p", $value),)*
            "            return p;\n        }\n"
        )
    };
}

/// In place of a quotient by a power of two; goes with the powers.
#[rustfmt::skip]
pub(crate) const MAKE_POWERS_AND_SHIFT: &str = concat!(
    make_powers!(),
    "
    /** q / 2^d, for a mantissa and d from 1 to 13 */
    function int shifted(int q, int d) {
        var int p;
        let p = 0;
        if (d > 6) {
",
    bit_of_128th!("q", "128", "p", "1"), bit_of_128th!("q", "256", "p", "2"),
    bit_of_128th!("q", "512", "p", "4"), bit_of_128th!("q", "1024", "p", "8"),
    bit_of_128th!("q", "2048", "p", "16"), bit_of_128th!("q", "4096", "p", "32"),
    bit_of_128th!("q", "8192", "p", "64"),
    "            if (d = 7) { return p; }
            let q = p;
            let p = 0;
            let d = d - 7;
        }
",
    shifted_by!("1", "2" "1", "4" "2", "8" "4", "16" "8", "32" "16", "64" "32", "128" "64",
        "256" "128", "512" "256", "1024" "512", "2048" "1024", "4096" "2048", "8192" "4096"),
    shifted_by!("2", "4" "1", "8" "2", "16" "4", "32" "8", "64" "16", "128" "32",
        "256" "64", "512" "128", "1024" "256", "2048" "512", "4096" "1024", "8192" "2048"),
    shifted_by!("3", "8" "1", "16" "2", "32" "4", "64" "8", "128" "16",
        "256" "32", "512" "64", "1024" "128", "2048" "256", "4096" "512", "8192" "1024"),
    shifted_by!("4", "16" "1", "32" "2", "64" "4", "128" "8",
        "256" "16", "512" "32", "1024" "64", "2048" "128", "4096" "256", "8192" "512"),
    shifted_by!("5", "32" "1", "64" "2", "128" "4",
        "256" "8", "512" "16", "1024" "32", "2048" "64", "4096" "128", "8192" "256"),
    shifted_by!("6", "64" "1", "128" "2",
        "256" "4", "512" "8", "1024" "16", "2048" "32", "4096" "64", "8192" "128"),
    "        return p;
    }
"
);

/// The divisor cut one bit less short, by its next bit, which is the sign's of `k`.
macro_rules! less_cut {
    ($shorter:literal, $longer:literal) => {
        concat!(
            "        let k = k + k;
        if (k < 0) { let ",
            $longer,
            " = ",
            $shorter,
            " + ",
            $shorter,
            " + 1; }
        else { let ",
            $longer,
            " = ",
            $shorter,
            " + ",
            $shorter,
            "; }
"
        )
    };
}

/// A bit of the quotient.
macro_rules! quotient_bit {
    ($divisor:literal) => {
        concat!(
            "        let q = q + q;
        if (~((r - ",
            $divisor,
            ") < 0)) { let r = r - ",
            $divisor,
            "; let q = q + 1; }
"
        )
    };
}

pub(crate) const DIV: &str = concat!(
    "    /** this = a / b; by zero the largest value, zero by zero is zero. The divisor
        is halved step by step: its halves, which there is no way to have one from
        the one before, are made from the last, which is 1. */
    method void div(Array a, Array b) {
        var int r, d, q, x, k;
        var int d1, d2, d3, d4, d5, d6, d7, d8, d9, d10, d11, d12;
        let r = a[2];
        let d = b[2];
        if (r = 0) { let s = 0; let e = 0; let m = 0; return; }
        if (d = 0) { let s = a[0]; let e = 8000; let m = 16383; return; }
        let x = (a[1] + 127) - b[1];
        let s = (a[0] + b[0]) & 1;
        let k = d + d;
        let k = k + k;
        let d12 = 2;
        let k = k + k;
        if (k < 0) { let d12 = 3; }
",
    less_cut!("d12", "d11"),
    less_cut!("d11", "d10"),
    less_cut!("d10", "d9"),
    less_cut!("d9", "d8"),
    less_cut!("d8", "d7"),
    less_cut!("d7", "d6"),
    less_cut!("d6", "d5"),
    less_cut!("d5", "d4"),
    less_cut!("d4", "d3"),
    less_cut!("d3", "d2"),
    less_cut!("d2", "d1"),
    "        let q = 0;\n",
    quotient_bit!("d"),
    quotient_bit!("d1"),
    quotient_bit!("d2"),
    quotient_bit!("d3"),
    quotient_bit!("d4"),
    quotient_bit!("d5"),
    quotient_bit!("d6"),
    quotient_bit!("d7"),
    quotient_bit!("d8"),
    quotient_bit!("d9"),
    quotient_bit!("d10"),
    quotient_bit!("d11"),
    quotient_bit!("d12"),
    quotient_bit!("1"),
    "        if (q < 8192) { let q = q + q; let x = x - 1; }
        if (x > 8000) { let x = 8000; let q = 16383; }
        if (x < (-8000)) { let s = 0; let x = 0; let q = 0; }
        let e = x;
        let m = q;
        return;
    }
"
);
