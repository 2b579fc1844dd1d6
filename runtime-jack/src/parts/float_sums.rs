//! Sums and differences of Floats, on the virtual machine and for the processor.

/// Sum or difference: alike but for the sign of `b`. What is made of mantissas whose
/// signs are the same, and of others, says how it is rounded: `p` is the mantissa of what
/// has the greater exponent, by `d`; `q` the other's.
macro_rules! sum {
    ($doc:literal, $name:literal, $sign_b:literal, $alike:expr, $unlike:expr) => {
        concat!(
            "    /** ",
            $doc,
            " */
    method void ",
            $name,
            "(Array a, Array b) {
        var int p, q, d, t, u;
        let p = a[2];
        let q = b[2];
        let t = ",
            $sign_b,
            ";
        let s = a[0];
        let d = b[1];
        let e = a[1];
        let d = e - d;
        if (s = t) {
            if (d < 0) { let e = e - d; let d = -d; let t = p; let p = q; let q = t; }
            if (p = 0) { let e = e - d; let m = q; return; }
            if (d > 14) { let m = p; return; }
",
            $alike,
            "            return;
        }
        if (d < 0) { let e = e - d; let d = -d; let s = t; let t = p; let p = q; let q = t; }
        if (p = 0) { let s = 1 - s; let e = e - d; let m = q; return; }
        if (d > 14) { let m = p; return; }
",
            $unlike,
            "        if (e < (-8000)) { let s = 0; let e = 0; let m = 0; }
        return;
    }
"
        )
    };
}

/// A sum or difference whose last bits are cut, by what is shifted out of the smaller
/// in a sum and of twice the smaller in a difference: that has a guard bit.
macro_rules! cut {
    ($doc:literal, $name:literal, $sign_b:literal, $shifted:literal, $twice:literal, $half:literal) => {
        sum!(
            $doc,
            $name,
            $sign_b,
            concat!(
                "            if (d = 0) { let m = p + q; }
            else { let m = p + (",
                $shifted,
                "); }
            if (m > 16383) {
                let m = ",
                $half,
                ";
                let e = e + 1;
                if (e > 8000) { let e = 8000; let m = 16383; }
            }
"
            ),
            concat!(
                "        let p = p + p;
        if (d > 1) { let m = p - (",
                $twice,
                "); }
        else {
            let m = p - q;
            if (d = 0) { let m = m - q; }
        }
        if (m > 16383) { let m = ",
                $half,
                "; return; }
        let e = e - 1;
        if (m < 8192) {
            if (m = 0) { let s = 0; let e = 0; return; }
            if (m < 0) { let m = -m; let s = 1 - s; }
            while (m < 8192) { let m = m + m; let e = e - 1; }
        }
"
            )
        )
    };
}

macro_rules! add {
    ($shifted:literal, $twice:literal, $half:literal) => {
        cut!(
            "this = a + b, cut; where the signs differ behind a guard bit.",
            "add",
            "b[0]",
            $shifted,
            $twice,
            $half
        )
    };
}

macro_rules! sub {
    ($shifted:literal, $twice:literal, $half:literal) => {
        cut!(
            "this = a - b, cut; where the signs agree behind a guard bit.",
            "sub",
            "1 - b[0]",
            $shifted,
            $twice,
            $half
        )
    };
}

pub(crate) const ADD: &str = add!("q / powers[d]", "q / powers[d - 1]", "m / 2");

pub(crate) const SUB: &str = sub!("q / powers[d]", "q / powers[d - 1]", "m / 2");

/// The same for the processor.
pub(crate) const ADD_SHIFTED: &str = add!(
    "Float.shifted(q, d)",
    "Float.shifted(q, d - 1)",
    "Float.shifted(m - 16384, 1) + 8192"
);

/// The same for the processor.
pub(crate) const SUB_SHIFTED: &str = sub!(
    "Float.shifted(q, d)",
    "Float.shifted(q, d - 1)",
    "Float.shifted(m - 16384, 1) + 8192"
);
