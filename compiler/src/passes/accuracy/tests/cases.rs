//! Formulas that meet the rules: what they are, where they are hard.

/// A formula and vectors that it loses its bits on.
pub struct Case {
    /// The rules that it meets, all of them.
    pub rules: &'static [&'static str],
    /// A machine that has use for them.
    pub on: &'static str,
    /// The inputs and their ranges.
    pub params: &'static [(&'static str, f64, f64)],
    /// The formula.
    pub value: &'static str,
    /// Inputs on which it is bad as written; ids are those of the hard cases
    /// that they are from.
    pub vectors: &'static [(&'static str, &'static [f64])],
}

const FAR: &[(&str, f64, f64)] = &[
    ("ox", -3.0, 3.0),
    ("oy", -3.0, 3.0),
    ("oz", 90.0, 110.0),
    ("dx", -0.1, 0.1),
    ("dy", -0.1, 0.1),
    ("r", 0.25, 1.0),
];

const WIDE: &[(&str, f64, f64)] = &[
    ("ox", -200.0, 200.0),
    ("oy", -300.0, 300.0),
    ("oz", -800.0, 800.0),
    ("dx", -4.0, 4.0),
    ("dy", -5.0, 5.0),
    ("dz", 1.0, 13.0),
    ("r", 0.25, 1.0),
];

const PLANE: &[(&str, f64, f64)] = &[
    ("ox", -10.0, 10.0),
    ("oy", -10.0, 10.0),
    ("dx", 1.0, 4.0),
    ("dy", 1.0, 5.0),
    ("r", 0.25, 1.25),
];

const QUADRATIC: &[(&str, f64, f64)] = &[("a", 0.5, 2.0), ("b", -600.0, 600.0), ("c", -1.0, 1.0)];

const ROOT: &[(&str, f64, f64)] = &[("b", -600.0, 600.0), ("c", -1.0, 1.0)];

const CORNERS: &[(&str, f64, f64)] = &[
    ("px", 0.0, 1000.0),
    ("py", 0.0, 1000.0),
    ("qx", 0.0, 1000.0),
    ("qy", 0.0, 1000.0),
    ("rx", 0.0, 1000.0),
    ("ry", 0.0, 1000.0),
];

const SLIVER: &[(&str, &[f64])] = &[(
    "a sliver, far off",
    &[800.5, 801.0, 812.5, 813.5, 824.0, 825.5],
)];

pub const CASES: &[Case] = &[
    Case {
        rules: &["discriminant by the perpendicular"],
        on: "jack",
        params: FAR,
        value: "{ let o = (ox, oy, oz); let d = unit((dx, dy, -1)); let b = dot(o, d); b * b - (dot(o, o) - r * r) }",
        vectors: &[("near the middle", &[0.1, 0.2, 100.0, 0.0, 0.0, 0.5])],
    },
    Case {
        rules: &["discriminant by the perpendicular"],
        on: "jack",
        params: FAR,
        value: "{ let o = (ox, oy, oz); let d = unit((dx, dy, -1)); let b = dot(o, d); b * b - dot(o, o) + r * r }",
        vectors: &[("near the middle", &[0.1, 0.2, 100.0, 0.0, 0.0, 0.5])],
    },
    Case {
        rules: &["discriminant by the perpendicular, doubled"],
        on: "jack",
        params: FAR,
        value: "{ let o = (ox, oy, oz); let d = unit((dx, dy, -1)); let b = 2 * dot(o, d); b * b - 4 * (dot(o, o) - r * r) }",
        vectors: &[("near the middle", &[0.1, 0.2, 100.0, 0.0, 0.0, 0.5])],
    },
    Case {
        rules: &["discriminant by the cross product"],
        on: "jack",
        params: WIDE,
        value: "{ let o = (ox, oy, oz); let d = (dx, dy, dz); let b = dot(o, d); b * b - dot(d, d) * (dot(o, o) - r * r) }",
        vectors: &[
            (
                "sphere_far_tiny/s4",
                &[-11.875, -16.09375, -48.0, 3.0, 4.0, 12.0, 0.5],
            ),
            (
                "sphere_far_tiny/s64",
                &[-191.875, -256.09375, -768.0, 3.0, 4.0, 12.0, 0.5],
            ),
        ],
    },
    Case {
        rules: &["discriminant by the cross product, doubled"],
        on: "jack",
        params: WIDE,
        value: "{ let o = (ox, oy, oz); let d = (dx, dy, dz); let b = 2 * dot(o, d); b * b - 4 * dot(d, d) * (dot(o, o) - r * r) }",
        vectors: &[(
            "sphere_far_tiny/s64",
            &[-191.875, -256.09375, -768.0, 3.0, 4.0, 12.0, 0.5],
        )],
    },
    Case {
        rules: &["discriminant by the cross product, in a plane"],
        on: "jack",
        params: PLANE,
        value: "{ let o = (ox, oy); let d = (dx, dy); let b = dot(o, d); b * b - dot(d, d) * (dot(o, o) - r * r) }",
        vectors: &[(
            "sphere_tangent/p10_w7, inside",
            &[-4.296875, -7.8125, 3.0, 4.0, 1.25],
        )],
    },
    Case {
        rules: &["lesser root from its companion"],
        on: "jack",
        params: ROOT,
        value: "{ let d = b * b - c; if d < 0 then 0 else -b - sqrt(d) }",
        vectors: &[
            ("quadratic_cancellation/k3, halved", &[-4.0, 0.25]),
            ("quadratic_cancellation/k7, halved", &[-64.0, 0.25]),
        ],
    },
    Case {
        rules: &["greater root from its companion"],
        on: "jack",
        params: ROOT,
        value: "{ let d = b * b - c; if d < 0 then 0 else -b + sqrt(d) }",
        vectors: &[("quadratic_cancellation/both_neg, halved", &[256.0, 0.125])],
    },
    Case {
        rules: &["lesser quotient from its companion"],
        on: "jack",
        params: QUADRATIC,
        value: "{ let d = b * b - a * c; if d < 0 then 0 else (-b - sqrt(d)) / a }",
        vectors: &[("quadratic_cancellation/k7, halved", &[1.0, -64.0, 0.25])],
    },
    Case {
        rules: &["greater quotient from its companion"],
        on: "jack",
        params: QUADRATIC,
        value: "{ let d = b * b - a * c; if d < 0 then 0 else (sqrt(d) - b) / a }",
        vectors: &[(
            "quadratic_cancellation/both_neg, halved",
            &[1.0, 256.0, 0.125],
        )],
    },
    Case {
        rules: &["lesser solution of a quadratic from its companion"],
        on: "jack",
        params: QUADRATIC,
        value: "{ let d = b * b - 4 * a * c; if d < 0 then 0 else (-b - sqrt(d)) / (2 * a) }",
        vectors: &[
            ("quadratic_cancellation/k3", &[1.0, -8.0, 0.25]),
            ("quadratic_cancellation/k7", &[1.0, -128.0, 0.25]),
        ],
    },
    Case {
        rules: &["greater solution of a quadratic from its companion"],
        on: "jack",
        params: QUADRATIC,
        value: "{ let d = b * b - 4 * a * c; if d < 0 then 0 else (-b + sqrt(d)) / (2 * a) }",
        vectors: &[("quadratic_cancellation/both_neg", &[1.0, 512.0, 0.125])],
    },
    Case {
        rules: &["difference of squares"],
        on: "jack",
        params: &[("a", -100.0, 100.0), ("b", -100.0, 100.0)],
        value: "a * a - b * b",
        vectors: &[("neighbours", &[99.9375, 99.875])],
    },
    Case {
        rules: &["difference of squares", "equal terms"],
        on: "jack",
        params: &[("h", 0.0, 2.0), ("r", 200.0, 1100.0)],
        value: "{ let f = h + r; f * f - r * r }",
        vectors: &[
            ("sphere_huge_near/R2p8, its constant", &[1.0, 256.0]),
            ("sphere_huge_near, R 1000", &[0.3, 1000.0]),
        ],
    },
    Case {
        rules: &["one less a square"],
        on: "jack",
        params: &[("x", -1.0, 1.0)],
        value: "1 - x * x",
        vectors: &[("sqrt_negative_noise, on the rim", &[0.999755859375])],
    },
    Case {
        rules: &["a square less one"],
        on: "jack",
        params: &[("x", 0.5, 2.0)],
        value: "x * x - 1",
        vectors: &[("near 1", &[1.01])],
    },
    Case {
        rules: &["difference of reciprocals"],
        on: "jack",
        params: &[("x", 1.0, 200.0)],
        value: "1 / x - 1 / (x + 0.125)",
        vectors: &[("far", &[100.0])],
    },
    Case {
        rules: &["difference of square roots"],
        on: "jack",
        params: &[("x", 0.0, 5000.0)],
        value: "sqrt(x + 1) - sqrt(x)",
        vectors: &[("cancellation/sqrt_diff_k8", &[256.0]), ("far", &[1000.0])],
    },
    Case {
        rules: &["difference of square roots, the greater first"],
        on: "jack",
        params: &[("x", 2.0, 5000.0)],
        value: "sqrt(x) - sqrt(x - 1)",
        vectors: &[("far", &[1000.0])],
    },
    Case {
        rules: &["hypotenuse less a side"],
        on: "jack",
        params: &[("r", 1.0, 2100.0), ("e", 0.0, 1.0)],
        value: "sqrt(r * r + e * e) - r",
        vectors: &[
            ("cancellation/sdf_sphere_R2p7", &[128.0, 0.5]),
            ("cancellation/sdf_sphere_R2p11", &[2048.0, 0.5]),
        ],
    },
    Case {
        rules: &["hypotenuse less a known side"],
        on: "jack",
        params: &[("x", -0.5, 3.0)],
        value: "sqrt(4 + x) - 2",
        vectors: &[("near 0", &[0.01])],
    },
    Case {
        rules: &["known side less a shorter one"],
        on: "jack",
        params: &[("x", -3.0, 0.5)],
        value: "1 - sqrt(1 - x)",
        vectors: &[("near 0", &[0.001])],
    },
    Case {
        rules: &["one less a cosine"],
        on: "jack",
        params: &[("x", -3.0, 3.0)],
        value: "1 - cos(x * 1rad)",
        vectors: &[
            ("cancellation/one_minus_cos_k4", &[0.0625]),
            ("cancellation/one_minus_cos_k6", &[0.015625]),
        ],
    },
    Case {
        rules: &["logarithm of two exponentials"],
        on: "6502:plain",
        params: &[("a", -10.0, 10.0), ("b", -10.0, 10.0), ("k", 1.0, 40.0)],
        value: "-log(exp(-k * a) + exp(-k * b)) / k",
        vectors: &[
            ("smooth_min_exp/k32_far", &[4.0, 5.0, 32.0]),
            ("smooth_min_exp/k32_neg", &[-4.0, -5.0, 32.0]),
        ],
    },
    Case {
        rules: &["logarithm of three exponentials"],
        on: "6502:plain",
        params: &[("a", -10.0, 10.0), ("b", -10.0, 10.0), ("c", -10.0, 10.0)],
        value: "-log(exp(-32 * a) + exp(-32 * b) + exp(-32 * c)) / 32",
        vectors: &[("smooth_min_exp/k32_far, and a third", &[4.0, 5.0, 6.0])],
    },
    Case {
        rules: &["orientation by differences"],
        on: "jack",
        params: CORNERS,
        value: "px * (qy - ry) + qx * (ry - py) + rx * (py - qy)",
        vectors: SLIVER,
    },
    Case {
        rules: &["orientation by differences"],
        on: "jack",
        params: CORNERS,
        value: "px * qy - py * qx + qx * ry - qy * rx + rx * py - ry * px",
        vectors: SLIVER,
    },
    Case {
        rules: &["divisor beyond the format"],
        on: "6502:plain",
        params: &[("x", -1000.0, 1000.0)],
        value: "x / 240000",
        vectors: &[("near the greatest", &[900.0]), ("small", &[47.5])],
    },
    Case {
        rules: &["equal terms"],
        on: "jack",
        params: &[("x", 500.0, 1000.0), ("y", -1.0, 1.0), ("z", -1.0, 1.0)],
        value: "(x + y) - (x + z)",
        vectors: &[("far", &[777.3, 0.37, 0.11])],
    },
    Case {
        rules: &["constants of a sum"],
        on: "jack",
        params: &[("x", -2.0, 2.0), ("y", -2.0, 2.0)],
        value: "((x + 1000) + y) - 998",
        vectors: &[("far", &[0.3, 0.7])],
    },
    Case {
        rules: &["shifted square against a constant"],
        on: "jack",
        params: &[("x", -3.0, 3.0), ("y", 1.0, 3.0), ("z", 2.0, 8.0)],
        value: "{ let o = (x, y, z) - (0, -1000, 0); dot(o, o) - 1000 * 1000 }",
        vectors: &[("sphere_huge_near, R 1000", &[0.0, 1.5, 4.0])],
    },
    Case {
        rules: &["common factor"],
        on: "jack",
        params: &[("a", 1.0, 100.0), ("b", -10.0, 10.0), ("c", -10.0, 10.0)],
        value: "a * b - a * c",
        vectors: &[("neighbours", &[77.3, 9.9375, 9.875])],
    },
];
