//! Numbers at a format's ends: vectors whose squares leave it, hits by distance to its
//! precision, secondary rays from flat surfaces, bounds that touch what they bound.

use crate::cli::{directory, json};

/// Machines and formats whose ends are near, and those whose are not.
const FORMATS: [(&str, &str); 13] = [
    ("jack", "f316"),
    ("jack", "f316r"),
    ("jack", "log10"),
    ("jack", "fixed16"),
    ("jack", "f416"),
    ("bbc:micro", "real40"),
    ("6502:plain", "fixed16.16"),
    ("6502:plain", "fixed12"),
    ("6502:plain", "fixed16"),
    ("6502:plain", "fixed20"),
    ("6502:plain", "fixed24"),
    ("6502:plain", "log10"),
    ("6502:plain", "real40"),
];

/// Pixels of a scene that are not the native's.
fn off(scene: &str, target: &str, format: &str) -> u64 {
    let dir = directory(&[("numbers.scn", scene)]);
    let args = [
        "run",
        "numbers.scn",
        "-t",
        target,
        "--format",
        format,
        "--json",
    ];
    let run = json(dir.path(), &args);
    assert_eq!(run["differs_from_model"], 0, "{scene} {target} {format}");
    run["differs_from_native"].as_u64().expect("a number")
}

/// At most so many pixels of a scene are not the native's, in any format.
fn at_most(pixels: u64, scene: &str) {
    for (target, format) in FORMATS {
        let off = off(scene, target, format);
        assert!(off <= pixels, "{off} pixels, {target} {format}: {scene}");
    }
}

/// Unit vectors of components from 1/8000 to 1,280, in the plane and in space. A pixel
/// may lie at the threshold.
#[test]
fn directions_of_long_and_short_vectors() {
    for (x, y, z) in [
        ("s * (x + 1) * 10", "s * (y + 1) * 10", "0"),
        ("s * (x + 1) / 4000", "s * (y + 1) / 3000", "0"),
        ("s * (x - 5) * 17", "s * (y + 2) * 13", "s * 310"),
        ("s * (x - 5) / 900", "s * (y + 2) / 700", "s / 50"),
    ] {
        at_most(
            2,
            &format!(
                "image 32 x 8 inks black, white; param s: real = 1 in 0.5 .. 2;
                draw (x, y) = threshold(dot(unit(({x}, {y}, {z})), (0.6, 0.8, 0)) / 2, 0.6);"
            ),
        );
    }
}

/// Lengths, too; and a vector that may be long keeps its digits where it is not.
#[test]
fn lengths_of_long_and_short_vectors() {
    for (of, scale) in [("(x * 40, y * 30)", "2000"), ("(x / 900, y / 700)", "0.03")] {
        at_most(
            2,
            &format!(
                "image 32 x 8 inks black, white; param s: real = 1 in 0.5 .. 1.5;
                draw (x, y) = threshold(length({of} * s) / {scale}, 0.513);"
            ),
        );
    }
}

/// What is found by its distance is found as near as a pixel here tells, within 1/500: in
/// front and where a ray meets it aslant, round and flat, and far from where it starts.
#[test]
fn marches_come_near() {
    for (beside, from, dist, t) in [
        ("0.3", "2", "length(p) - 0.4", "2 - sqrt(0.16 - k * k)"),
        ("0.1", "2", "length(p) - 0.35", "2 - sqrt(0.1225 - k * k)"),
        ("0.5", "3", "length(p) - 0.6", "3 - sqrt(0.36 - k * k)"),
        ("0.2", "9", "length(p) - 0.7", "9 - sqrt(0.49 - k * k)"),
        (
            "0.2",
            "2",
            "0.6 * p.z + 0.8 * p.x - 0.1",
            "2 + (0.8 * k - 0.1) / 0.6",
        ),
        ("0.1", "2", "max(abs(p.x), abs(p.z)) - 0.5", "1.5"),
    ] {
        at_most(
            0,
            &format!(
                "image 8 x 1 inks black, white; param k: real = {beside} in 0 .. 0.6;
                shape solid(n: real) {{ dist(p) = {dist}; }}
                draw (x, y) = {{
                  let t = {t};
                  ink(if let h = solid(1).hit(ray((k, 0, {from}), (0, 0, -1))) then
                    (if abs(h.t - t) < (x + 1) / 500 then 1 else 0) else 0)
                }};"
            ),
        );
    }
}

/// What is hardly ever off is compared with what is far greater: this may end where the
/// other does, below 1, and is then no whole number.
#[test]
fn thresholds_far_above_what_is_compared_with_them() {
    for over in ["500", "300", "40"] {
        at_most(
            0,
            &format!(
                "image 8 x 1 inks black, white; param k: real = 0.3 in 0.28 .. 0.32;
                draw (x, y) = {{
                  let near = loop (t = 1.0, n = 0) max 9 {{
                    if n >= 5 then t else next((t + k / t) / 2, n + 1)
                  }} else t;
                  ink(if abs(near - sqrt(k)) < (x + 1) / {over} then 1 else 0)
                }};"
            ),
        );
    }
}

/// No flat floor shades itself, level or not, under a low sun.
#[test]
fn flat_surfaces_do_not_shade_themselves() {
    for (normal, height, sun) in [
        ("(0, 1, 0)", "0", "(1, g, 0.3)"),
        ("(0, 1, 0)", "-1.3", "(-0.4, g, 1)"),
        ("(0.6, 0.8, 0)", "-0.7", "(0.8, g - 0.6, 0.2)"),
    ] {
        let scene = format!(
            "image 16 x 8 inks black, white; param g: real = 0.02 in 0.01 .. 0.5;
            scene w {{ plane({normal}, {height}) is 1; }}
            draw (x, y) = {{
              let r = ray((0, 1, 0), unit(((x - 7.5) / 16, -0.02 - y / 10, -1)));
              let v = if let h = w.trace(r, far: 300) then
                (if w.blocked(ray(h.point, unit({sun})), far: 1000) then 0 else 1) else 0.5;
              ink(floor(v * 1.5))
            }};"
        );
        at_most(0, &scene);
    }
}

/// A bound may touch what it bounds.
#[test]
fn superquadrics_have_no_holes() {
    for (half, power) in [("(1, 1, 1)", 8), ("(0.8, 1.1, 0.6)", 6)] {
        let scene = format!(
            "image 16 x 16 inks black, white;
            draw (x, y) = {{
              let r = ray(((x - 7.5) / 11, (7.5 - y) / 11, 3), (0, 0, -1));
              if let h = superquadric((0, 0, 0), {half}, {power}).hit(r) then ink(1) else ink(0)
            }};"
        );
        let dir = directory(&[("hole.scn", &scene)]);
        let run = json(dir.path(), &["run", "hole.scn", "-t", "jack", "--json"]);
        assert_eq!(run["differs_from_native"], 0, "{scene}");
        let text = crate::cli::success(dir.path(), &["render", "hole.scn", "--ascii"]);
        let middle = text.lines().nth(7).expect("a row").trim_end();
        assert!(
            middle.ends_with("@@@@") || middle.contains("@@@@@@@@"),
            "{text}"
        );
    }
}
