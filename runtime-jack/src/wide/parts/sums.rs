//! Sums and differences: what is shifted out of the smaller mantissa is rounded.

/// The mantissa (q, o) over 2^d as (w, k), where u is 2^d, or 2^(d - 14) from 14 on.
macro_rules! shifted {
    ($less:literal, $far:literal) => {
        concat!(
            "            if (d < ",
            $far,
            ") {
                let u = powers[d",
            $less,
            "];
                let w = q / u;
                let k = (o / u) + ((q & (u - 1)) * (16384 / u));
            }
            else {
                let w = 0;
                let k = q / powers[d - ",
            $far,
            "];
            }
"
        )
    };
}

macro_rules! sum {
    ($doc:literal, $name:literal, $sign_b:literal) => {
        concat!(
            "    /** this = ",
            $doc,
            ", to the nearest */
    method void ",
            $name,
            "(Array a, Array b) {
        var int p, q, n, o, d, t, u, w, k;
        let p = a[2];
        let q = b[2];
        let n = a[3];
        let o = b[3];
        let t = ",
            $sign_b,
            ";
        let s = a[0];
        let d = b[1];
        let e = a[1];
        let d = e - d;
        if (d < 0) {
            let e = e - d;
            let d = -d;
            let k = p;
            let p = q;
            let q = k;
            let k = n;
            let n = o;
            let o = k;
            let k = s;
            let s = t;
            let t = k;
        }
        if (p = 0) { let s = t; let e = e - d; let m = q; let l = o; return; }
        if (d > 28) { let m = p; let l = n; return; }
        if (s = t) {
",
            shifted!("", "14"),
            "            let l = n + k;
            let m = p + w;
            if (l > 16383) { let l = l - 16384; let m = m + 1; }
            if (m > 16383) {
                let l = ((l + 1) / 2) + ((m & 1) * 8192);
                let m = m / 2;
                let e = e + 1;
            }
            else {
                if (d < 15) {
                    if (d = 0) { return; }
                    if ((o & powers[d - 1]) = 0) { return; }
                }
                else { if ((q & powers[d - 15]) = 0) { return; } }
                let l = l + 1;
            }
            if (l > 16383) {
                let l = 0;
                let m = m + 1;
                if (m > 16383) { let m = 8192; let e = e + 1; }
            }
            if (e > 8000) { let e = 8000; let m = 16383; let l = 16383; }
            return;
        }
        if (d = 0) {
            let l = n - o;
            let m = p - q;
            if (l < 0) { let l = l + 16384; let m = m - 1; }
            if (m < 0) {
                let s = 1 - s;
                let m = -(m + 1);
                let l = 16384 - l;
                if (l > 16383) { let l = 0; let m = m + 1; }
            }
        }
        else {
",
            shifted!(" - 1", "15"),
            "            let l = (n + n) - k;
            let m = (p + p) - w;
            if (l < 0) { let l = l + 16384; let m = m - 1; }
            if (l > 16383) { let l = l - 16384; let m = m + 1; }
            if (m > 16383) {
                let l = (l / 2) + ((m & 1) * 8192);
                let m = m / 2;
                return;
            }
            let e = e - 1;
            if (d > 1) {
                if (d < 16) { let k = o & powers[d - 2]; }
                else { let k = q & powers[d - 16]; }
                if (~(k = 0)) {
                    let l = l - 1;
                    if (l < 0) { let l = 16383; let m = m - 1; }
                }
            }
        }
        if ((m < 8192) | (e < (-8000))) { do normal(); }
        return;
    }
"
        )
    };
}

pub(super) const ADD: &str = sum!("a + b", "add", "b[0]");

pub(super) const SUB: &str = sum!("a - b", "sub", "1 - b[0]");
