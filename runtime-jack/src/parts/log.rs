//! The class of logarithmic reals.

pub(crate) use super::log_tables::*;

pub(crate) const HEAD: &str = "    /**
     * Reals by their logarithms: 1024 units are an octave, so 2048 stands for 4 and
     * -1024 for 1/2. A product is a sum of logarithms, a sum is looked up. The least
     * logarithm, -13312 (2^-13), stands for 0 as well. Signs are kept beside them, true
     * for plus, where it is not known anyway.
     */
";

pub(crate) const SUM: &str = "    /** Of the sum of two values of one sign. */
    function int sum(int a, int b) {
        var int d;
        if (a < b) {
            let d = b - a;
            if (d < 4608) { return b + sums[d]; }
            return b + Log.farSum(d);
        }
        let d = a - b;
        if (d < 4608) { return a + sums[d]; }
        return a + Log.farSum(d);
    }
";

pub(crate) const DIFFERENCE: &str =
    "    /** Of the difference of two values of one sign, the greater less the other. */
    function int difference(int a, int b) {
        var int d;
        let d = a - b;
        if (d < 0) {
            let d = -d;
            let a = b;
        }
        if (d < 4608) {
            let d = differences[d];
            if (d < (a + 13312)) { return a - d; }
            return -13312;
        }
        let a = a - Log.farDifference(d);
        if (a > (-13312)) { return a; }
        return -13312;
    }
";

/// For the processor, which is quick to tell what is above 0.
pub(crate) const SUM_BY_SIGN: &str = "    /** Of the sum of two values of one sign. */
    function int sum(int a, int b) {
        var int d;
        let d = a - b;
        if (d > 0) {
            if (d < 4608) { return a + sums[d]; }
            return a + Log.farSum(d);
        }
        if (d > (-4608)) { return b + sums[-d]; }
        return b + Log.farSum(-d);
    }
";

pub(crate) const LEFT: &str =
    "    /** What a value leaves where one is taken away whose logarithm is d less. */
    function int left(int a, int d) {
        if (d < 4608) {
            // The first entry is more than any a has above the least.
            let d = differences[d];
            if (d < (a + 13312)) { return a - d; }
            return -13312;
        }
        let a = a - Log.farDifference(d);
        if (a > (-13312)) { return a; }
        return -13312;
    }
";

pub(crate) const REST: &str =
    "    /** The same of a value so large that what it leaves is more than 0 but where d is 0. */
    function int rest(int a, int d) {
        if (d < 4608) {
            if (d > 0) { return a - differences[d]; }
            return -13312;
        }
        return a - Log.farDifference(d);
    }
";

pub(crate) const LEAVE: &str =
    "    /** Of the difference where the greater is so large that what is left is more than 0. */
    function int leave(int a, int b) {
        var int d;
        let d = a - b;
        if (d > 0) {
            if (d < 4608) { return a - differences[d]; }
            return a - Log.farDifference(d);
        }
        if (d = 0) { return -13312; }
        if (d > (-4608)) { return b - differences[-d]; }
        return b - Log.farDifference(-d);
    }
";

pub(crate) const ADD: &str = "    static boolean plus;

    /** Of the sum of two values; plus() is its sign. */
    function int add(int a, boolean aPlus, int b, boolean bPlus) {
        var int d;
        let d = a - b;
        if (d > 0) {
            let plus = aPlus;
            if (d < 4608) {
                if (aPlus = bPlus) { return a + sums[d]; }
                let a = a - differences[d];
            }
            else {
                if (aPlus = bPlus) { return a + Log.farSum(d); }
                let a = a - Log.farDifference(d);
            }
        }
        else {
            let plus = bPlus;
            if (d > (-4608)) {
                if (aPlus = bPlus) { return b + sums[-d]; }
                if (d = 0) { let plus = aPlus; return -13312; }
                let a = b - differences[-d];
            }
            else {
                if (aPlus = bPlus) { return b + Log.farSum(-d); }
                let a = b - Log.farDifference(-d);
            }
        }
        if (a > (-13312)) { return a; }
        return -13312;
    }

    /** Whether the last sum is positive. */
    function boolean plus() {
        return plus;
    }
";

pub(crate) const CLAMP: &str = "    /** A logarithm kept within the ends. */
    function int clamp(int a) {
        if (a < 0) {
            if (a < (-13312)) { return -13312; }
            return a;
        }
        if (a > 16383) { return 16383; }
        return a;
    }
";

pub(crate) const HALF: &str = "    /** a / 2, rounded down: the logarithm of a root. */
    function int half(int a) {
        if (a < 0) { return -Log.halved(1 - a); }
        return Log.halved(a);
    }

    /** The same from 0 on. */
    function int halved(int a) {
        var int h;
        if (a > 4095) {
            while (a > 4095) { let a = a - 4096; let h = h + 2048; }
            if (a > 2047) { let a = a - 2048; let h = h + 1024; }
            if (a > 1023) { let a = a - 1024; let h = h + 512; }
            if (a > 511) { let a = a - 512; let h = h + 256; }
            return h + halves[a];
        }
        if (a < 2048) {
            if (a < 1024) {
                if (a < 512) { return halves[a]; }
                return halves[a - 512] + 256;
            }
            if (a < 1536) { return halves[a - 1024] + 512; }
            return halves[a - 1536] + 768;
        }
        if (a < 3072) {
            if (a < 2560) { return halves[a - 2048] + 1024; }
            return halves[a - 2560] + 1280;
        }
        if (a < 3584) { return halves[a - 3072] + 1536; }
        return halves[a - 3584] + 1792;
    }
";

pub(crate) const ROOT: &str = "    /** Of the root; of that of a negative 0. */
    function int root(int a, boolean aPlus) {
        if (aPlus) { return Log.half(a); }
        return -13312;
    }
";

pub(crate) const LESS: &str = "    /** Whether the first is less. */
    function boolean less(int a, boolean aPlus, int b, boolean bPlus) {
        if (aPlus = bPlus) {
            if (aPlus) { return a < b; }
            return b < a;
        }
        return bPlus;
    }
";

pub(crate) const FROM_INT: &str = "    /** Of a whole number's magnitude. */
    function int fromInt(int i) {
        var int high, low;
        if (i < 0) {
            let i = -i;
            if (i < 0) { let i = 32767; }
        }
        if (i < 512) { return logs[i]; }
        let high = i / 64;
        let low = i & 63;
        if (low = 0) { return logs[high] + 6144; }
        return Log.sum(logs[high] + 6144, logs[low]);
    }
";

pub(crate) const WHOLE: &str =
    "    /** The whole part of a magnitude: 0 below 1, of nine bits from 512 on. */
    function int whole(int a) {
        var int n;
        if (a < 0) { return 0; }
        if (a > 3071) {
            if (a > 6143) {
                if (a > 9215) { return Log.manyWhole(a); }
                if (a > 8191) { let n = 256; }
                if (~(logs[n + 128] > a)) { let n = n + 128; }
                if (~(logs[n + 64] > a)) { let n = n + 64; }
            }
            if (~(logs[n + 32] > a)) { let n = n + 32; }
            if (~(logs[n + 16] > a)) { let n = n + 16; }
            if (~(logs[n + 8] > a)) { let n = n + 8; }
        }
        if (~(logs[n + 4] > a)) { let n = n + 4; }
        if (~(logs[n + 2] > a)) { let n = n + 2; }
        if (logs[n + 1] > a) { return n; }
        return n + 1;
    }

    /** The same from 512 on. */
    function int manyWhole(int a) {
        var int n, step, doubled;
        if (a > 15359) { return 32767; }
        while (a > 9215) { let a = a - 1024; let doubled = doubled + 1; }
        let n = 256;
        let step = 128;
        while (step > 0) {
            if (~(logs[n + step] > a)) { let n = n + step; }
            let step = halves[step];
        }
        while (doubled > 0) { let n = n + n; let doubled = doubled - 1; }
        return n;
    }
";

pub(crate) const FLOOR: &str = "    /** The greatest whole number not above. */
    function int floor(int a, boolean aPlus) {
        var int n;
        let n = Log.whole(a);
        if (aPlus) { return n; }
        if (a > 9216) { return -n; }
        if (logs[n] = a) { return -n; }
        return (-n) - 1;
    }
";

pub(crate) const ROUND: &str = "    /** The nearest whole number, halves away from 0. */
    function int round(int a, boolean aPlus) {
        var int n;
        let n = Log.whole(a);
        if (a < 8192) { if (a > (logs[n + n + 1] - 1025)) { let n = n + 1; } }
        if (aPlus) { return n; }
        return -n;
    }
";

pub(crate) const SIGN: &str = "    /** 1 or -1. */
    function int sign(boolean aPlus) {
        if (aPlus) { return 1; }
        return -1;
    }
";

pub(crate) const MOD: &str =
    "    /** Of a - b * floor(a / b), or 0 where that is no remainder; plus() is its sign. */
    function int mod(int a, boolean aPlus, int b, boolean bPlus) {
        var int n;
        let n = Log.floor(Log.clamp(a - b), (aPlus = bPlus));
        let a = Log.clamp(Log.add(a, aPlus, Log.clamp(Log.fromInt(n) + b), (n < 0) = bPlus));
        if ((plus = bPlus) & (a < b)) { return a; }
        let plus = bPlus;
        return -13312;
    }
";
