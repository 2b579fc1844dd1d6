//! Quotients and roots, by digits of a few bits.

/// The rest (r, v) times a power of two, less a digit t times the divisor (d, g * 128 + f).
/// What the mantissa's upper word wraps to on the way is right again in the end.
macro_rules! rest {
    ($by:literal, $low_product:literal, $over:literal, $wrapped:literal) => {
        concat!(
            "        let w = (v - (t * ",
            $low_product,
            ")) - (((t * f) + ",
            $over,
            ";
        let r = ((r * ",
            $by,
            ") - (t * d)) + ((w & 32767) / ",
            $wrapped,
            ");
        let v = ((v * ",
            $by,
            ") - (t * o)) & 16383;
"
        )
    };
}

pub(super) const DIV: &str = concat!(
    "    /** this = a / b, to the nearest; by zero the largest value, zero by zero is zero.
        Digits of 7, 6, 6, 6 and 2 bits, found with a divisor that is too large. */
    method void div(Array a, Array b) {
        var int r, v, d, o, g, f, k, t, w, x, y;
        let r = a[2];
        let d = b[2];
        if (r = 0) { let s = 0; let e = 0; let m = 0; let l = 0; return; }
        if (d = 0) { let s = a[0]; let e = 8000; let m = 16383; let l = 16383; return; }
        let v = a[3];
        let o = b[3];
        let e = (a[1] - b[1]) + 127;
        let s = (a[0] + b[0]) & 1;
        let x = r;
        let y = v;
        let r = r - d;
        let v = v - o;
        if (v < 0) { let v = v + 16384; let r = r - 1; }
        if (r < 0) {
            let e = e - 1;
            let r = r + x;
            let v = v + y;
            if (v > 16383) { let v = v - 16384; let r = r + 1; }
        }
        let k = (d / 64) + 1;
        let g = o / 128;
        let f = o & 127;
        let t = (r + r) / k;
        let x = 8193 + (t * 64);
",
    rest!("128", "g", "127) / 128)", "128"),
    "        if (w < 0) { let r = r - 256; }
        let g = g + g;
        let t = r / k;
        let x = x + t;
",
    rest!("64", "g", "63) / 64)", "256"),
    "        if (w < 0) { let r = r - 128; }
        let t = r / k;
        let y = (t * 256) - 16384;
",
    rest!("64", "g", "63) / 64)", "256"),
    "        if (w < 0) { let r = r - 128; }
        let t = r / k;
        let y = y + (t * 4);
",
    rest!("64", "g", "63) / 64)", "256"),
    "        if (w < 0) { let r = r - 128; }
        let l = y + ((r + (d / 8)) / (d / 4));
        let m = x;
        if (l < 0) { let l = l + 16384; let m = m - 1; }
        if (l > 16383) { let l = l - 16384; let m = m + 1; }
        if (m > 16383) { let m = 8192; let e = e + 1; }
",
    ends!()
);

/// A root of the upper word is 128 g + c. What wraps on the way is right again in a difference.
pub(super) const SQRT: &str =
    "    /** this = the root of a, to the nearest; of a negative zero. From a root k of 14
        bits: what is missing to a, over twice k, less a small square. */
    method void sqrt(Array a) {
        var int p, q, h, g, c, k, t, d;
        let p = a[2];
        if ((p = 0) | (a[0] = 1)) { let s = 0; let e = 0; let m = 0; let l = 0; return; }
        let q = a[3];
        let h = 0;
        let s = 0;
        let e = a[1];
        if ((e & 1) = 1) {
            let h = (q & 1) * 32;
            let q = (q / 2) + ((p & 1) * 8192);
            let p = p / 2;
        }
        let e = ((e + 8127) / 2) - 4000;
        let g = Math.sqrt(p);
        let t = ((p - (g * g)) * 64) + (q / 256);
        let c = t / g;
        let k = (g * 128) + (((t - ((c * c) / 256)) + (g / 2)) / g);
        let t = (q + (p * 16384)) - (k * k);
        if (t < 0) { let k = k - 1; let t = ((t + k) + k) + 1; }
        let d = (k / 64) + 1;
        let c = t / d;
        let t = ((t * 64) + h) - (c * k);
        let g = t / d;
        let t = ((t * 64) - (g * k)) + ((k / 4) - ((c * c) / 4));
        let l = (c * 128) + (g + g);
        if (t < 0) { let l = l - 1; }
        else { let l = l + (t / (k / 2)); }
        let m = k;
        if (l > 16383) {
            let l = l - 16384;
            let m = m + 1;
            if (m > 16383) { let m = 8192; let e = e + 1; }
        }
        return;
    }
";
