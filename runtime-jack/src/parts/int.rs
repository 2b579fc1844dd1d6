//! The class of what ints need beside the language.

pub(crate) const MAGNITUDE: &str = "    /** The magnitude of i; -32768 counts as -32767. */
    function int magnitude(int i) {
        if (i < 0) {
            let i = -i;
            if (i < 0) { return 32767; }
        }
        return i;
    }
";

pub(crate) const ADD: &str = "    /** a + b, from -32767 to 32767 */
    function int add(int a, int b) {
        if (a < 0) {
            if (b < 0) {
                let a = a + b;
                if ((-a) > 0) { return a; }
                return -32767;
            }
            return a + b;
        }
        if (b < 0) { return a + b; }
        let a = a + b;
        if (a < 0) { return 32767; }
        return a;
    }
";

pub(crate) const SUB: &str = "    /** a - b, from -32767 to 32767 */
    function int sub(int a, int b) {
        if (a < 0) {
            if (b < 0) { return a - b; }
            let a = a - b;
            if ((-a) > 0) { return a; }
            return -32767;
        }
        if (b < 0) {
            let a = a - b;
            if (a < 0) { return 32767; }
            return a;
        }
        return a - b;
    }
";

pub(crate) const MUL: &str = "    /** a * b, from -32767 to 32767 */
    function int mul(int a, int b) {
        var int p, q;
        var boolean alike;
        let alike = ((a < 0) = (b < 0));
        let p = Int.magnitude(a);
        let q = Int.magnitude(b);
        if (q = 0) { return 0; }
        if (p > (32767 / q)) { let p = 32767; }
        else { let p = p * q; }
        if (alike) { return p; }
        return -p;
    }
";

pub(crate) const DIV: &str =
    "    /** The greatest int not above a / b; by 0 the greatest with the sign of a. */
    function int div(int a, int b) {
        var int p, q, c;
        var boolean alike;
        let alike = ((a < 0) = (b < 0));
        let p = Int.magnitude(a);
        let q = Int.magnitude(b);
        if (q = 0) {
            if (p = 0) { return 0; }
            if (a < 0) { return -32767; }
            return 32767;
        }
        let c = p / q;
        if (alike) { return c; }
        if ((c * q) < p) { let c = c + 1; }
        return -c;
    }
";

pub(crate) const XOR: &str = "    /** The bits that one of a and b has, and not both. */
    function int xor(int a, int b) {
        return (a | b) - (a & b);
    }
";

pub(crate) const MOD: &str =
    "    /** What is left of a after taking away whole b; with the sign of b. */
    function int mod(int a, int b) {
        var int p, q, c;
        let p = Int.magnitude(a);
        let q = Int.magnitude(b);
        if (q = 0) { return 0; }
        let c = p - ((p / q) * q);
        if (c > 0) {
            if (~((a < 0) = (b < 0))) { let c = q - c; }
        }
        if (b < 0) { return -c; }
        return c;
    }
";

pub(crate) const SIGN: &str = "    /** -1, 0 or 1 */
    function int sign(int i) {
        if (i < 0) { return -1; }
        if (i > 0) { return 1; }
        return 0;
    }
";

pub(crate) const LESS: &str = "    /** Whether a < b, however far apart they are. */
    function boolean less(int a, int b) {
        if ((a < 0) = (b < 0)) { return a < b; }
        return a < 0;
    }
";

pub(crate) const MIN: &str = "    /** The lesser */
    function int min(int a, int b) {
        if (Int.less(b, a)) { return b; }
        return a;
    }
";

pub(crate) const MAX: &str = "    /** The greater */
    function int max(int a, int b) {
        if (Int.less(a, b)) { return b; }
        return a;
    }
";
