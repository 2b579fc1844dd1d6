//! Pairs as in [`crate::pairs`], of single expressions and loops: what is written where it is
//! needed takes no longer than what somebody moves, shares or folds by hand.

use crate::pairs::{HEAD, is_as_quick, is_as_quick_on};

/// A picture by a value.
fn shade(before: &str) -> String {
    format!(
        "{HEAD}const balls = [0.2, 0.3, 0, 0.4; -0.7, 0.1, 0.4, 0.3; 0.8, -0.2, -0.3, 0.35; -0.1, 0.7, 0.5, 0.2];
        draw (x, y) = {{
          let r = pinhole((0.4, 1.9, 3), at: (0, 0, 0), field: 48deg).through(x, y);
          {before};
          threshold(v, bayer(4)[x mod 4, y mod 4])
        }};"
    )
}

/// A picture by a sum over eight numbers `a`.
fn summed(term: &str) -> String {
    shade(&format!(
        "let v = loop (k = 0, a = x * y * 0.003, s = 0.0) max 9 {{
          if k == 8 then s / 8 else next(k + 1, a * 0.9, s + {term})
        }} else 0"
    ))
}

#[test]
fn what_stays_the_same_is_moved_out_of_an_inner_loop() {
    let march = |before: &str, point: &str| {
        shade(&format!(
            "let v = loop (t = 0.5) max 24 {{
              {before}
              let d = loop (k = 0, d = 9.0) max 5 {{
                if k == 4 then d
                else next(k + 1, min(d, length({point} - (balls[0, k], balls[1, k], balls[2, k])) - balls[3, k]))
              }} else d;
              if d < 0.02 then 1 - t / 6 else if t > 6 then 0 else next(t + d)
            }} else 0"
        ))
    };
    is_as_quick(&march("", "r.at(t)"), &march("let p = r.at(t);", "p"));
}

/// A value that only one arm of a loop's body uses.
#[test]
fn what_an_arm_alone_wants_is_moved_out_of_the_loop() {
    let turns = |before: &str, direction: &str| {
        shade(&format!(
            "let d = (x / 20 - 0.8, 0.6 - y / 20, -1.5);
            {before}
            let v = loop (k = 0, s = 0.0) max 5 {{
              if k == 4 then s else {{
                let b = dot({direction}, (balls[0, k], balls[1, k], balls[2, k]));
                next(k + 1, if b > s then b else s)
              }}
            }} else 0"
        ))
    };
    is_as_quick(&turns("", "unit(d)"), &turns("let u = unit(d);", "u"));
}

/// Most balls of a table are further away along one axis than the nearest so far is.
#[test]
fn the_least_of_a_tables_distances_is_bounded_before_it_is_worked_out() {
    let march = |distance: &str| {
        shade(&format!(
            "let v = loop (t = 0.5) max 24 {{
              let p = r.at(t);
              let d = loop (k = 0, d = 9.0) max 5 {{
                if k == 4 then d else next(k + 1, {distance})
              }} else d;
              if d < 0.02 then 1 - t / 6 else if t > 6 then 0 else next(t + d)
            }} else 0"
        ))
    };
    is_as_quick(
        &march("min(d, length(p - (balls[0, k], balls[1, k], balls[2, k])) - balls[3, k])"),
        &march(
            "{
              let limit = d + balls[3, k];
              let x = p.x - balls[0, k];
              if abs(x) < limit then {
                let y = p.y - balls[1, k];
                if abs(y) < limit then {
                  let z = p.z - balls[2, k];
                  if abs(z) < limit then min(d, sqrt(x * x + y * y + z * z) - balls[3, k]) else d
                } else d
              } else d
            }",
        ),
    );
}

#[test]
fn a_point_in_equal_steps_is_stepped() {
    let steps = |carried: &str, point: &str, next: &str| {
        shade(&format!(
            "let v = loop (t = 0.5{carried}) max 40 {{
              let p = {point};
              if p.y < 0.2 * (p.x * p.z) then 1 - t / 6 else next(t + 0.125{next})
            }} else 0"
        ))
    };
    is_as_quick(
        &steps("", "r.at(t)", ""),
        &steps(", p = r.at(0.5)", "p", ", p + 0.125 * r.dir"),
    );
}

#[test]
fn a_squared_distance_in_equal_steps_is_two_sums() {
    let steps = |before: &str, carried: &str, square: &str, next: &str| {
        shade(&format!(
            "{before}
            let v = loop (t = 0.5{carried}) max 40 {{
              let q = {square};
              if q < 2 then 1 - t / 6 else next(t + 0.125{next})
            }} else 0"
        ))
    };
    is_as_quick(
        &steps(
            "",
            "",
            "{ let p = r.at(t) - (0.1, 0.2, 0.3); dot(p, p) }",
            "",
        ),
        &steps(
            "let o = r.at(0.5) - (0.1, 0.2, 0.3);
             let s = 0.25 * dot(o, r.dir) + 0.015625 * dot(r.dir, r.dir);",
            ", q = dot(o, o), s = s",
            "q",
            ", q + s, s + 0.03125 * dot(r.dir, r.dir)",
        ),
    );
}

#[test]
fn a_cosine_is_no_dearer_than_another_sine() {
    let both = |cosine: &str| {
        shade(&format!(
            "let a = (x * 0.11 + y * y * 0.013) * 1rad;
            let v = 0.5 + 0.3 * (sin(a) * (x * 0.07 - 1 + y * 0.02) + {cosine})"
        ))
    };
    is_as_quick(&both("cos(a)"), &both("sin(a + 90deg)"));
}

#[test]
fn what_is_divided_by_one_number_shares_its_reciprocal() {
    let quotients = |before: &str, by: &str| {
        shade(&format!(
            "{before}
            let a = (x * 0.1 - 1) {by};
            let b = (y * 0.1 - 1) {by};
            let c = (x * y * 0.01 - 1) {by};
            let v = max(a, max(b, c)) / 3"
        ))
    };
    is_as_quick(
        &quotients("", "/ r.dir.z"),
        &quotients("let i = 1 / r.dir.z;", "* i"),
    );
    let slabs = |before: &str, by: [&str; 3]| {
        let [x, y, z] = by;
        shade(&format!(
            "{before}
            let v = loop (k = 0, s = 9.0) max 5 {{
              if k == 4 then s / 9 else {{
                let a = (balls[0, k] - r.from.x) {x};
                let b = (balls[1, k] - r.from.y) {y};
                let c = (balls[2, k] - r.from.z) {z};
                next(k + 1, min(s, abs(max(a, max(b, c)))))
              }}
            }} else 0"
        ))
    };
    is_as_quick(
        &slabs("", ["/ r.dir.x", "/ r.dir.y", "/ r.dir.z"]),
        &slabs(
            "let i = 1 / r.dir.x; let j = 1 / r.dir.y; let m = 1 / r.dir.z;",
            ["* i", "* j", "* m"],
        ),
    );
}

#[test]
fn constants_are_joined_across_sums_and_choices() {
    is_as_quick(
        &summed("max((2.4 + a - 0.8) - 1 + 0.2 - 0.5, 0)"),
        &summed("max(a + 0.3, 0)"),
    );
    is_as_quick(&summed("a * 8 / 4"), &summed("2 * a"));
}

#[test]
fn a_question_is_asked_once() {
    let march = |rest: &str| {
        shade(&format!(
            "let v = loop (t = 0.1 * x, s = 0.0) max 20 {{
              let d = abs(y * 0.05 - t * 0.3);
              {rest}
            }} else s / 20"
        ))
    };
    is_as_quick(
        &march(
            "let near = d < 0.0078;
             let w = if near or t > 5 then 1 else 0;
             if near or t > 5 then s / 20 + 0.1 * w else next(t + d * 0.5, s + 1)",
        ),
        &march("if d < 0.0078 or t > 5 then s / 20 + 0.1 else next(t + d * 0.5, s + 1)"),
    );
}

#[test]
fn remainders_by_a_power_of_two_and_clamps_are_no_calls() {
    is_as_quick(
        &summed("(a + 0.77 * k - 3) mod 2"),
        &summed("({ let b = a + 0.77 * k - 3; b - 2 * floor(b / 2) })"),
    );
    is_as_quick(
        &summed("min(max(a * 2 - 0.3, 0), 1)"),
        &summed("({ let b = a * 2 - 0.3; if b < 0 then 0 else if b > 1 then 1 else b })"),
    );
}

#[test]
fn a_number_times_a_vector_is_three_products() {
    let far = |point: &str| {
        shade(&format!(
            "let v = loop (t = 0.5, s = 0.0) max 9 {{
              let p = {point};
              next(t * 1.3, max(s, p.x * p.y + p.z))
            }} else s / 3"
        ))
    };
    is_as_quick(
        &far("r.at(t)"),
        &far("(r.from.x + t * r.dir.x, r.from.y + t * r.dir.y, r.from.z + t * r.dir.z)"),
    );
}

/// A table of 65 entries, and what is between two of them in proportion.
fn between(name: &str, entry: &dyn Fn(f64) -> f64, place: &str, at: &str) -> String {
    let entries: Vec<String> = (0..=64)
        .map(|k| format!("{:.9}", entry(f64::from(k))))
        .collect();
    format!(
        "const {name}s = [{}];
         fn {name}(a: real) -> real = {{
           let p = {place}; let k = floor(p); let i = {at};
           {name}s[i] + ({name}s[i + 1] - {name}s[i]) * (p - k)
         }};",
        entries.join(", ")
    )
}

/// BASIC's own functions have nine digits, and a table has four.
const SHORT: [&str; 2] = ["jack", "6502:plain"];

#[test]
fn sines_and_exponentials_are_tables_with_steps_between() {
    let turn = std::f64::consts::TAU / 64.0;
    let scene = |item: &str, v: &str| {
        let drawn = shade(&format!(
            "let a = r.dir.x * 4 + r.dir.y * r.dir.z; let v = {v}"
        ));
        let (head, rest) = drawn.split_at(HEAD.len());
        format!("{head}{item}\n{rest}")
    };
    let sine = between("sine", &|k| (k * turn).sin(), "a * 10.18591636", "k mod 64");
    is_as_quick_on(
        &SHORT,
        &scene("", "0.5 + 0.5 * sin(a * 1rad)"),
        &scene(&sine, "0.5 + 0.5 * sine(a)"),
    );
    let fall = between("fall", &|k| (-k / 8.0).exp(), "a * 8", "k");
    is_as_quick_on(
        &SHORT,
        &scene("", "exp(-abs(a))"),
        &scene(&fall, "fall(min(abs(a), 7.9))"),
    );
}

#[test]
fn noise_is_no_dearer_than_in_whole_numbers() {
    let fades: Vec<String> = (0..128)
        .map(|k| f64::from(k) / 128.0)
        .map(|t| format!("{:.0}", 128.0 * t * t * (3.0 - 2.0 * t)))
        .collect();
    let items = format!(
        "const fades = [{}];
         fn between(a: int, b: int, u: int) -> int = a + (b - a) * u div 128;",
        fades.join(", ")
    );
    let scene = |items: &str, v: &str| {
        format!(
            "{HEAD}{items}
             draw (x, y) = {{ {v}; threshold(v, bayer(4)[x mod 4, y mod 4]) }};"
        )
    };
    is_as_quick(
        &scene(
            "",
            "let v = noise((x * 0.23 + y * 0.07, y * 0.31 - x * 0.05))",
        ),
        &scene(
            &items,
            "let p = floor((x * 0.23 + y * 0.07) * 128);
             let q = floor((y * 0.31 - x * 0.05) * 128);
             let i = p div 128; let j = q div 128; let u = fades[p mod 128];
             let near = between(hash(i, j), hash(i + 1, j), u);
             let far = between(hash(i, j + 1), hash(i + 1, j + 1), u);
             let v = between(near, far, fades[q mod 128]) / 255",
        ),
    );
}
