//! Scenes as people write them, beside what somebody who counts cycles would write: the
//! compiler finds the second by itself.
#![allow(clippy::unwrap_used)]

use crate::cli::{directory, json};

pub(crate) const HEAD: &str = "image 32 x 24 inks black, #555555, #aaaaaa, white;\n";

/// What rows 13 to 15 of a scene take, without what it does before.
fn cycles(scene: &str, target: &str) -> f64 {
    cycles_with(scene, target, &[])
}

fn cycles_with(scene: &str, target: &str, options: &[&str]) -> f64 {
    let dir = directory(&[("scene.scn", scene)]);
    let run = |rows: &str| {
        let args = ["run", "scene.scn", "-t", target, "--rows", rows, "--json"];
        let said = json(dir.path(), &[&args, options].concat());
        assert_eq!(said["differs_from_model"], 0, "{target}:\n{scene}");
        said["cycles"].as_f64().unwrap()
    };
    run("12..15") - run("12..12")
}

/// Holds what the first scene takes to what the second does.
pub(crate) fn is_as_quick(written: &str, by_hand: &str) {
    is_as_quick_on(&["jack", "6502:plain", "bbc:micro"], written, by_hand);
}

/// The same on some machines.
pub(crate) fn is_as_quick_on(targets: &[&str], written: &str, by_hand: &str) {
    for target in targets {
        let [written, by_hand] = [written, by_hand].map(|scene| cycles(scene, target));
        let times = written / by_hand;
        assert!(
            times < 1.15,
            "{target}: {written} for {by_hand}, {times:.2}"
        );
    }
}

/// Balls in a ring, where their centres are this.
fn ring(table: &str, centre: &str) -> String {
    format!(
        "{HEAD}{table}
        record near {{ t: real, n: vec3 }}
        fn nearer(b: near, r: ray, c: vec3) -> near =
          if let h = sphere(c, 0.15).hit(r) then (if h.t < b.t then near(h.t, h.normal) else b) else b;
        draw (x, y) = {{
          let r = pinhole((0.5, 2.2, 4.6), at: (0, 0.2, 0), field: 48deg).through(x, y);
          let b = loop (k = 0, b = near(1000, (0, 1, 0))) max 40 {{
            if k == 36 then b else next(k + 1, nearer(b, r, {centre}))
          }} else b;
          threshold(if b.t < 999 then 0.1 + 0.9 * max(dot(b.n, (0.48, 0.64, 0.6)), 0) else 0.05, bayer(4)[x mod 4, y mod 4])
        }};"
    )
}

#[test]
fn what_hangs_on_a_counter_is_a_table() {
    let centre = |k: i32| {
        let (turn, wave) = (
            f64::from(10 * k).to_radians(),
            f64::from(30 * k).to_radians(),
        );
        let [x, y, z] = [1.6 * turn.cos(), 0.4 + 0.3 * wave.sin(), 1.6 * turn.sin()];
        format!("{x:.9}, {y:.9}, {z:.9}")
    };
    let all: Vec<String> = (0..36).map(centre).collect();
    let table = format!("const places = [{}];", all.join("; "));
    is_as_quick(
        &ring(
            "",
            "(1.6 * cos(k * 10deg), 0.4 + 0.3 * sin(k * 30deg), 1.6 * sin(k * 10deg))",
        ),
        &ring(&table, "(places[0, k], places[1, k], places[2, k])"),
    );
}

#[test]
fn a_short_loop_is_its_turns() {
    let scene = |charge: &str| {
        format!(
            "{HEAD}param time: real = 0.2 in 0 .. 1;
            const centres = [0.9, 0.2, 0; -0.6, 0.6, 0.3; 0.1, -0.5, 0.5];
            fn one(p: vec3, c: vec3) -> real = {{ let d = p - c; 0.12 / max(dot(d, d), 0.02) }};
            fn charge(p: vec3) -> real = {charge};
            draw (x, y) = {{
              let r = pinhole((0, 0.3, 4), at: (0, 0, 0), field: 50deg).through(x, y);
              let v = loop (i = 0, s = 0.0) max 6 {{
                if i == 5 then s else next(i + 1, max(s, charge(r.at(2.5 + 0.6 * i))))
              }} else s;
              threshold(v / 4, bayer(4)[x mod 4, y mod 4])
            }};"
        )
    };
    is_as_quick(
        &scene(
            "loop (k = 0, s = 0.0) max 4 {
              if k == 3 then s
              else next(k + 1, s + one(p, (centres[0, k] * cos(time * 1turn + k * 1rad), centres[1, k], centres[2, k])))
            } else s",
        ),
        &scene(
            "one(p, (0.9 * cos(time * 1turn), 0.2, 0)) + one(p, (-0.6 * cos(time * 1turn + 1rad), 0.6, 0.3))
            + one(p, (0.1 * cos(time * 1turn + 2rad), -0.5, 0.5))",
        ),
    );
}

#[test]
fn sines_of_arcs_are_products() {
    // Of a small picture the tables that a format makes first decide which one is taken.
    let scene = |v: &str| {
        format!(
            "image 160 x 120 inks black, #555555, #aaaaaa, white;
            draw (x, y) = {{
              let u = (x - 15.5) / 12;
              let w = (y - 11.5) / 12;
              let r = sqrt(u * u + w * w);
              {v};
              threshold(0.5 + 0.5 * v / max(r, 0.05), bayer(4)[x mod 4, y mod 4])
            }};"
        )
    };
    let (sin, cos) = 40f64.to_radians().sin_cos();
    is_as_quick(
        &scene("let v = r * cos(3 * atan2(w, u) - 40deg)"),
        &scene(&format!(
            "let a = u / r; let b = w / r; let a2 = a * a - b * b; let b2 = 2 * a * b;
            let v = r * ((a2 * a - b2 * b) * {cos:.10} + (b2 * a + a2 * b) * {sin:.10})"
        )),
    );
}

#[test]
fn whole_powers_are_products() {
    let scene = |v: &str| {
        format!(
            "{HEAD}draw (x, y) = {{
              let a = 1 - (x + 0.5) / 32 * ((y + 0.5) / 24);
              {v};
              threshold(v, bayer(4)[x mod 4, y mod 4])
            }};"
        )
    };
    is_as_quick(
        &scene("let v = a ^ 10"),
        &scene("let a2 = a * a; let a4 = a2 * a2; let v = a4 * a4 * a2"),
    );
}

/// A march towards what `shapes` are, and whether it gets there.
fn marched(shapes: &str, rest: &str) -> String {
    format!(
        "{HEAD}shape lump(c: vec3) {{
          dist(p) = {{ let q = abs(p - c) - (0.5, 0.3, 0.4); length(max(q, (0, 0, 0))) + min(max(q.x, max(q.y, q.z)), 0) - 0.1 }};
        }}
        {shapes}
        draw (x, y) = {{
          let r = pinhole((0.4, 1.2, 3), at: (0, 0.2, 0), field: 48deg).through(x, y);
          {rest}
        }};"
    )
}

#[test]
fn steps_end_where_nothing_farther_is_asked_for() {
    let scene = |far: &str| {
        marched(
            "scene world { lump((0, 0.2, 0)); }",
            &format!("ink(if let h = world.trace(r, far: {far}) then 3 else 0)"),
        )
    };
    for target in ["jack", "6502:plain", "bbc:micro"] {
        let everywhere = ["--without-pass", "bounds"];
        let [near, far] = ["5", "900"].map(|far| cycles_with(&scene(far), target, &everywhere));
        assert!(near < 0.8 * far, "{target}: {near} {far}");
        // Nor where the shape is known not to be.
        let in_its_box = cycles(&scene("900"), target);
        assert!(in_its_box < 0.8 * near, "{target}: {in_its_box} {near}");
    }
    // What is hit first is as good as an end.
    is_as_quick(
        &marched(
            "scene world { plane((0, 1, 0), -0.5); lump((0, 0.2, 0)); }",
            "ink(if let h = world.trace(r, far: 9) then (if h.point.y < -0.49 then 1 else 3) else 0)",
        ),
        &marched(
            "scene world { lump((0, 0.2, 0)); }",
            "let t = if r.dir.y < 0 then min(-(1.2 + 0.5) / r.dir.y, 9) else 9;
             ink(if let h = world.trace(r, far: t) then 3 else if t < 9 then 1 else 0)",
        ),
    );
}

#[test]
fn a_turned_point_on_a_ray_is_a_point_on_a_turned_ray() {
    let scene = |before: &str, at: &str| {
        format!(
            "{HEAD}fn away(p: vec3) -> real = max(abs(p.x), max(abs(p.y) + 0.2, abs(p.z))) - 0.7;
            fn turned(p: vec3) -> vec3 = (0.8 * p.x + 0.6 * p.z, p.y, 0.8 * p.z - 0.6 * p.x);
            draw (x, y) = {{
              let r = pinhole((0.4, 1.2, 3), at: (0, 0, 0), field: 48deg).through(x, y);
              {before};
              ink(loop (t = 0.0) max 40 {{
                let d = away({at});
                if t + d > 6 then 0 else if d < 0.01 then 3 else next(t + d)
              }} else 1)
            }};"
        )
    };
    is_as_quick(
        &scene("let s = r", "turned(s.at(t))"),
        &scene("let s = ray(turned(r.from), turned(r.dir))", "s.at(t)"),
    );
}

#[test]
fn a_counter_that_ends_a_loop_is_its_count_of_turns() {
    let scene = |turns: &str| {
        format!(
            "{HEAD}draw (x, y) = {{
              let a = (x + 0.5) / 40;
              let v = {turns};
              threshold(v, bayer(4)[x mod 4, y mod 4])
            }};"
        )
    };
    is_as_quick(
        &scene(
            "loop (k = 0, s = 0.2) max 99 { if k == 60 then s else next(k + 1, s * a + 0.1) } else 0",
        ),
        &scene("loop (s = 0.2) max 60 { next(s * a + 0.1) } else s"),
    );
}

/// Triangles by Moeller and Trumbore, beside what is left where the eye stands still.
#[test]
fn a_ray_meets_triangles_by_what_their_corners_and_the_eye_say() {
    let scene = |face: &str, numbers: &str| {
        format!(
            "{HEAD}fn corner(k: int) -> vec3 = (cos(40deg * k), 0.3 * sin(70deg * k), sin(50deg * k));
            fn eye() -> vec3 = (0.5, 2.2, 4.6);
            fn face(k: int, d: vec3) -> real = {{
              let p = corner(k);
              let e = corner(k + 3) - p;
              let f = corner(k + 5) - p;
              let o = eye() - p;
              {numbers}
              if abs(a) < 0.001 then 99 else {{
                let u = {face} / a;
                if u < 0 or u > 1 then 99 else u
              }}
            }};
            draw (x, y) = {{
              let r = pinhole(eye(), at: (0, 0, 0), field: 48deg).through(x, y);
              let t = loop (k = 0, t = 99.0) max 24 {{
                if k == 20 then t else next(k + 1, min(t, face(k, r.dir)))
              }} else t;
              threshold(t, bayer(4)[x mod 4, y mod 4])
            }};"
        )
    };
    is_as_quick(
        &scene("dot(o, h)", "let h = cross(d, f); let a = dot(e, h);"),
        &scene("dot(d, cross(f, o))", "let a = dot(d, cross(f, e));"),
    );
}

/// BASIC has room for ten FOR loops: those that are left must not stay there. Their counters
/// are asked for behind them.
#[test]
fn loops_that_are_left_again_and_again_draw_what_they_should() {
    let scene = format!(
        "{HEAD}fn inside(a: real) -> int =
          loop (k = 2, s = a) max 9 {{ if s > 4 then 10 * k else next(k + 1, s + a) }} else 7;
        draw (x, y) = ink((loop (i = 0, n = x + y) max 30 {{
          if n > 2000 then n + i else next(i + 1, n + inside(0.3 + i mod 5 * 0.2) + inside(0.9))
        }} else n) mod 4);"
    );
    for target in ["jack", "6502:plain", "bbc:micro", "bbc:agon"] {
        assert!(cycles(&scene, target) > 0.0);
    }
}

/// What a loop comes to when its turns run out is another value at each turn of the loop around.
#[test]
fn what_the_last_turn_gave_stays_in_the_loop_around() {
    let scene = format!(
        "{HEAD}fn rough(p: real) -> real =
          loop (k = 0, q = p, high = 0.5, sum = 0.0) max 4 {{
            next(k + 1, 2 * q mod 1, high / 2, sum + high * q)
          }} else sum / (1 - 2 * high);
        draw (x, y) = {{
          let v = loop (t = 0.05) max 12 {{
            let d = rough(x / 40 + t) * rough(y / 30 + t / 2) - t;
            if d < 0.01 then t else if t > 3 then 0.9 else next(t + d / 2)
          }} else 0.5;
          threshold(v, bayer(4)[x mod 4, y mod 4])
        }};"
    );
    let dir = directory(&[("scene.scn", &scene)]);
    for target in ["jack", "6502:plain", "bbc:micro"] {
        let said = json(dir.path(), &["run", "scene.scn", "-t", target, "--json"]);
        assert_eq!(said["differs_from_model"], 0, "{target}");
        let wrong = said["differs_from_native"].as_u64().unwrap();
        assert!(wrong < 8, "{target}: {wrong} of 768");
    }
}
