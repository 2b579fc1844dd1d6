//! The table of accuracy rules: what is looked for, what is put instead, and when.
//!
//! Both sides are equal over the reals wherever the side condition holds and
//! the value is needed; `tests` shows it for each with 60 digits. Where a
//! letter stands for a vector's component (`ox`, `oy`, `oz`), the rule is
//! written out.

use super::form::{Form, form};
use super::site::{Site, may_cancel};
use slowlight_routine::{Op, Range};

/// A directed rewrite of one formula.
#[derive(Clone, Copy)]
pub struct Rule {
    /// What the field calls it.
    pub name: &'static str,
    /// What is looked for; all have the same letters.
    pub left: &'static [Form],
    /// What is put instead.
    pub right: Form,
    /// The side condition: what makes both sides equal, and that it helps.
    pub when: fn(&Site<'_>) -> bool,
    /// The same in words.
    pub condition: &'static str,
    /// Where it is from.
    pub source: &'static str,
}

const GOLDBERG: &str =
    "Goldberg, What Every Computer Scientist Should Know About Floating-Point Arithmetic (1991)";
const HAINES: &str = "Haines, Günther, Akenine-Möller, Precision Improvements for Ray/Sphere Intersection (Ray Tracing Gems, 2019)";
const HIGHAM: &str = "Higham, Accuracy and Stability of Numerical Algorithms (2002), chapter 1";
const HAMMING: &str = "Hamming, Numerical Methods for Scientists and Engineers (1973), section 3.3";
const BLUE: &str = "Blue, A Portable Fortran Program to Find the Euclidean Norm of a Vector (1978)";
const SHEWCHUK: &str = "Shewchuk, Adaptive Precision Floating-Point Arithmetic (1997)";
const BLANCHARD: &str =
    "Blanchard, Higham, Higham, Accurately Computing the Log-Sum-Exp and Softmax Functions (2021)";

// o . d, o . o, d . d and parts of the right sides.
const OD: Form = form!((Add (Add (Mul ox dx) (Mul oy dy)) (Mul oz dz)));
const OO: Form = form!((Add (Add (Mul ox ox) (Mul oy oy)) (Mul oz oz)));
const DD: Form = form!((Add (Add (Mul dx dx) (Mul dy dy)) (Mul dz dz)));
const OD2: Form = form!((Add (Mul ox dx) (Mul oy dy)));
const OO2: Form = form!((Add (Mul ox ox) (Mul oy oy)));
const DD2: Form = form!((Add (Mul dx dx) (Mul dy dy)));
const QX: Form = form!((Sub ox (Mul b dx)));
const QY: Form = form!((Sub oy (Mul b dy)));
const QZ: Form = form!((Sub oz (Mul b dz)));
const QQ: Form = form!((Add(Add(Mul[QX][QX])(Mul[QY][QY]))(Mul[QZ][QZ])));
const CX: Form = form!((Sub (Mul oy dz) (Mul oz dy)));
const CY: Form = form!((Sub (Mul oz dx) (Mul ox dz)));
const CZ: Form = form!((Sub (Mul ox dy) (Mul oy dx)));
const CC: Form = form!((Add(Add(Mul[CX][CX])(Mul[CY][CY]))(Mul[CZ][CZ])));
const MINUS: Form = form!((Sub (Neg b) s));
const PLUS: Form = form!((Sub s b));
const COSINE: Form = form!((Sin (Mul 0.5 x)));
const TOP3: Form = form!((Max (Max a b) c));

/// Whether neither of two values may be 0, and their product is within the format.
fn fits(s: &Site<'_>, a: &str, b: &str) -> bool {
    let (a, b) = (s.range(a), s.range(b));
    let some = |r: Range| r.lo > 0.0 || r.hi < 0.0;
    some(a) && some(b) && a.magnitude() * b.magnitude() <= s.known.most
}

/// Every rule on one formula; the first that fits is taken.
pub static RULES: &[Rule] = &[
    Rule {
        name: "discriminant by the perpendicular",
        left: &[
            form!((Sub (Mul (b = [OD]) b) (Sub (g = [OO]) k))),
            form!((Add (Sub (Mul (b = [OD]) b) (g = [OO])) k)),
        ],
        right: form!((Sub k [QQ])),
        when: |s| s.unit(["dx", "dy", "dz"]) && s.outweighs("g", "k"),
        condition: "d has length 1; o.o may exceed 16 k",
        source: HAINES,
    },
    Rule {
        name: "discriminant by the perpendicular, doubled",
        left: &[form!((Sub (Mul (e = (Add (b = [OD]) b)) e) (Mul 4.0 (Sub (g = [OO]) k))))],
        right: form!((Mul 4.0 (Sub k [QQ]))),
        when: |s| s.unit(["dx", "dy", "dz"]) && s.outweighs("g", "k"),
        condition: "d has length 1; o.o may exceed 16 k",
        source: HAINES,
    },
    Rule {
        name: "discriminant by the cross product",
        left: &[form!((Sub (Mul (b = [OD]) b) (Mul (a = [DD]) (Sub (g = [OO]) k))))],
        right: form!((Sub (Mul a k) [CC])),
        when: |s| s.outweighs("g", "k"),
        condition: "o.o may exceed 16 k",
        source: HAINES,
    },
    Rule {
        name: "discriminant by the cross product, doubled",
        left: &[
            form!((Sub (Mul (e = (Add (b = [OD]) b)) e) (Mul (Mul 4.0 (a = [DD])) (Sub (g = [OO]) k)))),
            form!((Sub (Mul (e = (Add (b = [OD]) b)) e) (Mul 4.0 (Mul (a = [DD]) (Sub (g = [OO]) k))))),
        ],
        right: form!((Mul 4.0 (Sub (Mul a k) [CC]))),
        when: |s| s.outweighs("g", "k"),
        condition: "o.o may exceed 16 k",
        source: HAINES,
    },
    Rule {
        name: "discriminant by the cross product, in a plane",
        left: &[form!((Sub (Mul (b = [OD2]) b) (Mul (a = [DD2]) (Sub (g = [OO2]) k))))],
        right: form!((Sub (Mul a k) (Mul [CZ] [CZ]))),
        when: |s| s.outweighs("g", "k"),
        condition: "o.o may exceed 16 k",
        source: HAINES,
    },
    Rule {
        name: "lesser root from its companion",
        left: &[form!((Sub (Neg b) (s = (Sqrt (Sub (Mul b b) c)))))],
        right: form!((if (Less b 0.0) (Div c (Sub s b)) [MINUS])),
        when: |s| s.rooted("s") && small_beside_square(s, 1.0),
        condition: "b*b >= c; c may be less than b*b/16",
        source: GOLDBERG,
    },
    Rule {
        name: "greater root from its companion",
        left: &[
            form!((Add (Neg b) (s = (Sqrt (Sub (Mul b b) c))))),
            form!((Sub (s = (Sqrt (Sub (Mul b b) c))) b)),
        ],
        right: form!((if (Less 0.0 b) (Div (Neg c) (Add s b)) [PLUS])),
        when: |s| s.rooted("s") && small_beside_square(s, 1.0),
        condition: "b*b >= c; c may be less than b*b/16",
        source: GOLDBERG,
    },
    Rule {
        name: "lesser quotient from its companion",
        left: &[form!((Div (Sub (Neg b) (s = (Sqrt (Sub (Mul b b) (Mul a c))))) a))],
        right: form!((if (Less b 0.0) (Div c (Sub s b)) (Div [MINUS] a))),
        when: |s| s.rooted("s") && never_zero(s) && small_beside_square(s, 1.0),
        condition: "b*b >= a*c; a is never 0; a*c may be less than b*b/16",
        source: GOLDBERG,
    },
    Rule {
        name: "greater quotient from its companion",
        left: &[
            form!((Div (Add (Neg b) (s = (Sqrt (Sub (Mul b b) (Mul a c))))) a)),
            form!((Div (Sub (s = (Sqrt (Sub (Mul b b) (Mul a c)))) b) a)),
        ],
        right: form!((if (Less 0.0 b) (Div (Neg c) (Add s b)) (Div [PLUS] a))),
        when: |s| s.rooted("s") && never_zero(s) && small_beside_square(s, 1.0),
        condition: "b*b >= a*c; a is never 0; a*c may be less than b*b/16",
        source: GOLDBERG,
    },
    Rule {
        name: "lesser solution of a quadratic from its companion",
        left: &[
            form!((Div (Sub (Neg b) (s = (Sqrt (Sub (Mul b b) (Mul (Mul 4.0 a) c))))) (Add a a))),
            form!((Div (Sub (Neg b) (s = (Sqrt (Sub (Mul b b) (Mul 4.0 (Mul a c)))))) (Add a a))),
        ],
        right: form!((if (Less b 0.0) (Div (Add c c) (Sub s b)) (Div [MINUS] (Add a a)))),
        when: |s| s.rooted("s") && never_zero(s) && small_beside_square(s, 4.0),
        condition: "b*b >= 4*a*c; a is never 0; 4*a*c may be less than b*b/16",
        source: GOLDBERG,
    },
    Rule {
        name: "greater solution of a quadratic from its companion",
        left: &[
            form!((Div (Add (Neg b) (s = (Sqrt (Sub (Mul b b) (Mul (Mul 4.0 a) c))))) (Add a a))),
            form!((Div (Add (Neg b) (s = (Sqrt (Sub (Mul b b) (Mul 4.0 (Mul a c)))))) (Add a a))),
            form!((Div (Sub (s = (Sqrt (Sub (Mul b b) (Mul (Mul 4.0 a) c)))) b) (Add a a))),
        ],
        right: form!((if (Less 0.0 b) (Div (Neg (Add c c)) (Add s b)) (Div [PLUS] (Add a a)))),
        when: |s| s.rooted("s") && never_zero(s) && small_beside_square(s, 4.0),
        condition: "b*b >= 4*a*c; a is never 0; 4*a*c may be less than b*b/16",
        source: GOLDBERG,
    },
    Rule {
        name: "difference of squares",
        left: &[form!((Sub (p = (Mul a a)) (q = (Mul b b))))],
        right: form!((Mul (Sub a b) (Add a b))),
        when: |s| (s.once("p") || s.once("q")) && may_cancel(s.range("p"), s.range("q")),
        condition: "a*a may be near b*b; one of them is needed for nothing else, as both are for |z|^2 beside z^2",
        source: GOLDBERG,
    },
    Rule {
        name: "one less a square",
        left: &[form!((Sub 1.0 (q = (Mul b b))))],
        right: form!((Mul (Sub 1.0 b) (Add 1.0 b))),
        when: |s| may_cancel(Range::point(1.0), s.range("q")),
        condition: "b*b may be near 1",
        source: GOLDBERG,
    },
    Rule {
        name: "a square less one",
        left: &[form!((Sub (q = (Mul b b)) 1.0))],
        right: form!((Mul (Sub b 1.0) (Add b 1.0))),
        when: |s| may_cancel(Range::point(1.0), s.range("q")),
        condition: "b*b may be near 1",
        source: GOLDBERG,
    },
    Rule {
        name: "difference of reciprocals",
        left: &[form!((Sub (p = (Div 1.0 a)) (q = (Div 1.0 b))))],
        right: form!((Div (Sub b a) (Mul a b))),
        when: |s| fits(s, "a", "b") && may_cancel(s.range("p"), s.range("q")),
        condition: "neither a nor b may be 0, their product fits the format; 1/a may be near 1/b",
        source: HAMMING,
    },
    Rule {
        name: "difference of square roots",
        left: &[form!((Sub (r = (Sqrt (Add x k))) (s = (Sqrt x))))],
        right: form!((Div k (Add r s))),
        when: |s| s.rooted("r") && s.rooted("s") && s.may_vanish("k", "x"),
        condition: "x and x + k are no negatives; k may be less than x/16",
        source: HIGHAM,
    },
    Rule {
        name: "difference of square roots, the greater first",
        left: &[form!((Sub (r = (Sqrt x)) (s = (Sqrt (Sub x k)))))],
        right: form!((Div k (Add r s))),
        when: |s| s.rooted("r") && s.rooted("s") && s.may_vanish("k", "x"),
        condition: "x and x - k are no negatives; k may be less than x/16",
        source: HIGHAM,
    },
    Rule {
        name: "hypotenuse less a side",
        left: &[form!((Sub (r = (Sqrt (Add (p = (Mul a a)) k))) a))],
        right: form!((Div k (Add r a))),
        when: |s| s.rooted("r") && s.range("a").lo >= 0.0 && s.may_vanish("k", "p"),
        condition: "a and a*a + k are no negatives; k may be less than a*a/16",
        source: HIGHAM,
    },
    Rule {
        name: "hypotenuse less a known side",
        left: &[form!((Sub (r = (Sqrt (Add h k))) a))],
        right: form!((Div k (Add r a))),
        when: |s| s.rooted("r") && known_square(s) && s.may_vanish("k", "h"),
        condition: "a is a constant above 0 and h its square; h + k is no negative; k may be less than h/16",
        source: HIGHAM,
    },
    Rule {
        name: "known side less a shorter one",
        left: &[form!((Sub a (r = (Sqrt (Sub h k)))))],
        right: form!((Div k (Add a r))),
        when: |s| s.rooted("r") && known_square(s) && s.may_vanish("k", "h"),
        condition: "a is a constant above 0 and h its square; h - k is no negative; k may be less than h/16",
        source: HIGHAM,
    },
    Rule {
        name: "one less a cosine",
        left: &[form!((Sub 1.0 (c = (Cos x))))],
        right: form!((Mul 2.0 (Mul [COSINE] [COSINE]))),
        when: |s| s.once("c") && near_zero(s),
        condition: "nothing else needs the cosine; x may be less than 1/4",
        source: HIGHAM,
    },
    Rule {
        name: "logarithm of three exponentials",
        left: &[form!((Log (Add (Add (Exp a) (Exp b)) (Exp c))))],
        right: form!((Add [TOP3] (Log
            (Add (Add (Exp (Sub a [TOP3])) (Exp (Sub b [TOP3]))) (Exp (Sub c [TOP3])))))),
        when: |s| ["a", "b", "c"].iter().any(|l| steep(s, l)),
        condition: "an exponent may exceed 4 in magnitude",
        source: BLANCHARD,
    },
    Rule {
        name: "logarithm of two exponentials",
        left: &[form!((Log (Add (Exp a) (Exp b))))],
        right: form!((Add (Max a b) (Log (Add 1.0 (Exp (Neg (Abs (Sub a b)))))))),
        when: |s| ["a", "b"].iter().any(|l| steep(s, l)),
        condition: "an exponent may exceed 4 in magnitude",
        source: BLANCHARD,
    },
    Rule {
        name: "divisor beyond the format",
        left: &[form!((Div x k))],
        right: form!((Div (Div x 16.0) (Div k 16.0))),
        when: |s| s.constant("k").is_some_and(|k| k.abs() > s.known.most),
        condition: "k is a constant greater than the format's greatest real",
        source: BLUE,
    },
    Rule {
        name: "orientation by differences",
        left: &[
            form!((Add (Add (Mul px (Sub qy ry)) (Mul qx (Sub ry py))) (Mul rx (Sub py qy)))),
            form!((Sub (Add (Sub (Add (Sub (Mul px qy) (Mul py qx)) (Mul qx ry)) (Mul qy rx)) (Mul rx py)) (Mul ry px))),
        ],
        right: form!((Sub (Mul (Sub qx px) (Sub ry py)) (Mul (Sub qy py) (Sub rx px)))),
        when: |_| true,
        condition: "none",
        source: SHEWCHUK,
    },
];

/// Whether |a c| times `scale` may be much less than b², with a = 1 where there is none.
fn small_beside_square(s: &Site<'_>, scale: f64) -> bool {
    let least = |letter: &str| {
        let range = s.range(letter);
        range.lo.max(-range.hi).max(0.0)
    };
    let factor = match s.bound.get("a") {
        Some(_) => least("a"),
        None => 1.0,
    };
    let b = s.range("b").magnitude();
    scale * factor * least("c") * super::site::LOST <= b * b
}

fn never_zero(s: &Site<'_>) -> bool {
    s.range("a").nonzero
}

fn known_square(s: &Site<'_>) -> bool {
    match (s.constant("a"), s.constant("h")) {
        (Some(a), Some(h)) => a > 0.0 && a * a == h && a.mul_add(a, -h) == 0.0,
        _ => false,
    }
}

fn near_zero(s: &Site<'_>) -> bool {
    let x = s.range("x");
    x.lo < 0.25 && x.hi > -0.25
}

fn steep(s: &Site<'_>, letter: &str) -> bool {
    s.range(letter).magnitude() > 4.0
}
