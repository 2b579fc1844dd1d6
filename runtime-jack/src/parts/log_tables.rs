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
        return;
    }
";

pub(crate) const MAKE_WHITE: &str =
    "    /** Leaves the screen as it was found, and clears nothing else: Screen.clearScreen
     *  of the web IDE takes the upper half of the heap with it. */
    function void makeWhite() {
        var int j;
        let j = 2048;
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
        var int d, r, octave, k, y;
        let sums = Array.new(4608);
        let k = 1024;
        while (d < 4608) {
            if (r = 1024) { let r = 0; let octave = octave + 1; }
            let y = Log.powerLess(r);
            while (Log.above((powers[k + k - 1]) - 16384, octave, y)) { let k = k - 1; }
            let sums[d] = k;
            let d = d + 1;
            let r = r + 1;
        }
        return;
    }
";

pub(crate) const POWER_LESS: &str = "    /** 32768 * 2^(-r/1024), or 32767. */
    function int powerLess(int r) {
        if (r = 0) { return 32767; }
        return powers[2048 - r - r];
    }

    /** Whether a * 2^(octave + 1) > y. */
    function boolean above(int a, int octave, int y) {
        while (octave > 0) {
            let a = a + a;
            let octave = octave - 1;
        }
        return a > (y - a);
    }
";

pub(crate) const MAKE_DIFFERENCES: &str = "    static Array differences;

    /** What the greater logarithm shrinks by where one that is d less is taken away:
     *  -1024 * log2(1 - 2^(-d/1024)). */
    function void makeDifferences() {
        var int d, k, squares, cut, twice, octaves, left, doubled;
        let differences = Array.new(4608);
        let squares = 8866;
        let k = 10783;
        let d = 1;
        while (d < 256) {
            let squares = squares + d + d - 1;
            if (squares > 17731) { let squares = squares - 17731; let cut = cut + 1; }
            let twice = 21563 - logs[d] - logs[d] + d - cut;
            while ((k + k - 1) > twice) { let k = k - 1; }
            let differences[d] = k;
            let d = d + 1;
        }
        let octaves = 9;
        while (d < 1024) {
            let left = 32767 - Log.powerLess(d) + 1;
            let doubled = 0;
            while (left < 16384) { let left = left + left; let doubled = doubled + 1; }
            if (doubled < octaves) {
                let octaves = doubled;
                let k = 1024;
            }
            while (Log.stillLeft(left, k)) { let k = k - 1; }
            let differences[d] = k;
            let doubled = octaves;
            while (doubled > 0) { let differences[d] = differences[d] + 1024; let doubled = doubled - 1; }
            let d = d + 1;
        }
        do Log.makeFurtherDifferences();
        return;
    }

    /** The same from an octave on. */
    function void makeFurtherDifferences() {
        var int d, r, octave, k, y;
        let k = 1024;
        let d = 1024;
        while (d < 4608) {
            if (r = 1024) { let r = 0; let octave = octave + 1; }
            let y = Log.powerLess(r);
            while (Log.furtherLeft(k, octave, y)) { let k = k - 1; }
            let differences[d] = k;
            let d = d + 1;
            let r = r + 1;
        }
        return;
    }

    /** Whether 2^(-k/1024) is less than what is left, half a unit aside. */
    function boolean stillLeft(int left, int k) {
        if (k = 0) { return false; }
        return left > powers[2049 - k - k];
    }

    /** The same where that is compared with what is taken away, y / 2^(octave + 1). */
    function boolean furtherLeft(int k, int octave, int y) {
        if (k = 0) { return false; }
        return Log.above((32767 - powers[2049 - k - k]) + 1, octave, y);
    }
";
