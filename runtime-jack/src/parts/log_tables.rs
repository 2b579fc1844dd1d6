//! How the class of logarithmic reals makes its tables.

pub(crate) const MAKE_POWERS: &str = "    static Array powers;

    /** 16384 * 2^(j/2048) for j from 0 to 2047, on the screen as long as tables are made.
     *  e f g is the power, 14 bits a word behind the first; a b c its difference from
     *  the next, p q that difference's own, r the last of them. */
    function void makePowers() {
        var int j, e, f, g, a, b, c, p, q, r, last;
        let powers = 16384;
        let e = 16384;
        let a = 5;
        let b = 8947;
        let c = 9232;
        let p = 30;
        let q = 12442;
        let r = 171;
        let last = 16374;
        while (j < 2048) {
            if (f > 8191) { let powers[j] = e + 1; }
            else { let powers[j] = e; }
            let g = g + c;
            let f = f + b;
            let e = e + a;
            if (g > 16383) { let g = g - 16384; let f = f + 1; }
            if (f > 16383) { let f = f - 16384; let e = e + 1; }
            let c = c + q;
            let b = b + p;
            if (c > 16383) { let c = c - 16384; let b = b + 1; }
            if (b > 16383) { let b = b - 16384; let a = a + 1; }
            let q = q + r;
            if (q > 16383) { let q = q - 16384; let p = p + 1; }
            if ((e - last) > 95) { let r = r + 1; let last = last + 96; }
            let j = j + 1;
        }
        // The next is 32768. No word is more than the one behind it.
        let powers[2048] = 32767;
        let powers[2049] = 32767;
        return;
    }
";

pub(crate) const MAKE_WHITE: &str =
    "    /** Leaves the screen as it was found, and clears nothing else: Screen.clearScreen
     *  of the web IDE takes the upper half of the heap with it. */
    function void makeWhite() {
        var int j;
        let j = 2050;
        while (j > 0) {
            let j = j - 1;
            let powers[j] = 0;
        }
        return;
    }
";

pub(crate) const MAKE_LOGS: &str = "    static Array logs;

    /** 1024 * log2(n) for n from 1 to 512. */
    function void makeLogs() {
        var int n, m, k;
        let logs = Array.new(513);
        let n = 256;
        let m = 16384;
        while (n < 512) {
            while ((k < 1024) & (~(powers[k + k + 1] > m))) { let k = k + 1; }
            let logs[n] = 8192 + k;
            let n = n + 1;
            let m = m + 64;
        }
        let logs[512] = 9216;
        let n = 255;
        while (n > 0) {
            let logs[n] = logs[n + n] - 1024;
            let n = n - 1;
        }
        let logs[0] = -13312;
        return;
    }
";

pub(crate) const MAKE_HALVES: &str = "    static Array halves;

    /** n / 2 for n from 0 to 511. */
    function void makeHalves() {
        var int n;
        let halves = Array.new(512);
        while (n < 256) {
            let halves[n + n] = n;
            let halves[n + n + 1] = n;
            let n = n + 1;
        }
        return;
    }
";

pub(crate) const MAKE_SUMS: &str = "    static Array sums;

    /** What the greater summand's logarithm grows by where the other's is d less:
     *  1024 * log2(1 + 2^(-d/1024)). */
    function void makeSums() {
        var int d, k, at, octave, grown;
        let sums = Array.new(4608);
        let k = 1024;
        let at = 2048;
        let octave = 1;
        let grown = powers[2047] - 16384;
        while (d < 4608) {
            // at is where 32768 * 2^(-d/1024) stands, times 2 for each octave.
            if (at = 0) { let at = 2048; let octave = octave + octave; let grown = grown + grown; }
            while (grown > (powers[at] - grown)) {
                let k = k - 1;
                let grown = (powers[k + k - 1] - 16384) * octave;
            }
            let sums[d] = k;
            let d = d + 1;
            let at = at - 2;
        }
        return;
    }
";

pub(crate) const MAKE_DIFFERENCES: &str = "    static Array differences;

    /** What the greater logarithm shrinks by where one that is d less is taken away:
     *  -1024 * log2(1 - 2^(-d/1024)). */
    function void makeDifferences() {
        var int d, k, squares, cut, left, octaves;
        let differences = Array.new(4608);
        let differences[0] = 32767;
        let squares = 8866;
        let d = 1;
        while (d < 256) {
            let squares = squares + d + d - 1;
            if (squares > 17731) { let squares = squares - 17731; let cut = cut + 1; }
            let differences[d] = ((21564 - logs[d]) - logs[d] + d - cut) / 2;
            let d = d + 1;
        }
        let octaves = 2048;
        let k = 1024;
        while (d < 1024) {
            let left = (32767 - powers[2048 - d - d]) + 1;
            if (left < 8192) { let left = left + left; }
            else { if (octaves = 2048) { let octaves = 1024; let k = 1024; } }
            let left = left + left;
            while (left > powers[2049 - k - k]) { let k = k - 1; }
            let differences[d] = k + octaves;
            let d = d + 1;
        }
        do Log.makeFurtherDifferences();
        return;
    }

    /** The same from an octave on. */
    function void makeFurtherDifferences() {
        var int d, k, at, octave, taken;
        let k = 1024;
        let d = 1024;
        let at = 2048;
        let octave = 1;
        let taken = (32767 - powers[1]) + 1;
        while (d < 4608) {
            if (at = 0) { let at = 2048; let octave = octave + octave; let taken = taken + taken; }
            while (taken > (powers[at] - taken)) {
                let k = k - 1;
                let taken = ((32767 - powers[2049 - k - k]) + 1) * octave;
            }
            let differences[d] = k;
            let d = d + 1;
            let at = at - 2;
        }
        return;
    }
";
