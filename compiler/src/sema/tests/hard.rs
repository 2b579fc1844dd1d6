//! Scenes made to break the checker: they end soon, with a diagnostic or a graph.

use crate::scene::{Scene, check};

const FRAME: &str = "image 8 x 8 inks black, white;\n";

fn wrong(text: &str) -> Scene {
    let scene = check("scene", text);
    assert!(!scene.is_right());
    scene
}

#[test]
fn long_chains_of_calls_are_refused_or_done() {
    for n in [100, 400, 5000] {
        let mut text = format!("{FRAME}fn f0(v: real) -> real = v;\n");
        for k in 1..n {
            text += &format!(
                "fn f{k}(v: real) -> real = {{ let a = (f{}(v)) + 1; a * 2 }};\n",
                k - 1
            );
        }
        text += &format!("draw (x, y) = ink(floor(f{}(x)));", n - 1);
        let scene = check("scene", &text);
        assert_eq!(scene.is_right(), n < 200, "{n}");
    }
}

#[test]
fn constants_in_any_order_are_found() {
    for n in [100, 5000] {
        let mut text = FRAME.to_owned();
        for k in 0..n {
            text += &format!("const c{k} = c{} + 1;\n", k + 1);
        }
        text += &format!("const c{n} = 0;\ndraw (x, y) = ink(c0);");
        assert_eq!(check("scene", &text).is_right(), n < 200, "{n}");
    }
}

#[test]
fn records_that_double_are_refused() {
    let mut text = FRAME.to_owned() + "record r0 { a: real, b: real }\n";
    for k in 1..40 {
        text += &format!("record r{k} {{ a: r{0}, b: r{0} }}\n", k - 1);
    }
    text += "fn f(r: r39) -> ink = loop (s = r) max 9 { next(s) } else ink(0);\n";
    text += "draw (x, y) = ink(0);";
    assert!(check("scene", &text).is_right());
    let text = text.replace(
        "draw (x, y) = ink(0);",
        "fn g0(a: real) -> r0 = r0(a, a);\n",
    );
    let mut text = text;
    for k in 1..40 {
        text += &format!(
            "fn g{k}(a: real) -> r{k} = r{k}(g{0}(a), g{0}(a));\n",
            k - 1
        );
    }
    wrong(&(text + "draw (x, y) = f(g39(x));"));
}

#[test]
fn loops_in_loops_are_limited() {
    let mut body = "next(a, b, c, 1.5)".to_owned();
    for _ in 0..60 {
        body = format!(
            "loop (a = 0, b = 0, c = 0, d = 0) max 3 {{ if a > 9 then next(b, c, d, 1.5) else {body} }} else 0"
        );
    }
    wrong(&format!("{FRAME}draw (x, y) = ink({body});"));
    let mut body = "1".to_owned();
    for _ in 0..6 {
        body = format!(
            "loop (a = 0, b = 0, c = 0, d = 0) max 3 {{ if a > {body} then next(b, c, d, 1.5) else 3 }} else 0"
        );
    }
    let scene = check("scene", &format!("{FRAME}draw (x, y) = ink({body});"));
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
}

#[test]
fn deep_expressions_are_carried() {
    for n in [60, 200, 240, 300] {
        let open = "if x > 1 then { let a = (x + 1) * (".repeat(n);
        let close = "); a } else 2".repeat(n);
        let text = format!("{FRAME}draw (x, y) = ink({open}x{close});");
        let scene = check("scene", &text);
        assert!(scene.is_right() || !scene.diagnostics.is_empty());
        let sum = "x + ".repeat(n * 40) + "1";
        let scene = check("scene", &format!("{FRAME}draw (x, y) = ink({sum});"));
        assert!(scene.is_right() || !scene.diagnostics.is_empty());
    }
}

#[test]
fn many_unknown_names_are_not_slow() {
    let mut text = FRAME.to_owned();
    for k in 0..8000 {
        text += &format!("fn f{k}(v: real) -> real = unknown{k} + v.speling + g{k}(v);\n");
    }
    assert_eq!(wrong(&text).diagnostics.len(), 100);
    let mut text = FRAME.to_owned();
    for k in 0..8000 {
        text += &format!("record r{k} {{ a: recrod{k}, b: s{k} }}\n");
    }
    assert_eq!(wrong(&text).diagnostics.len(), 100);
}

#[test]
fn many_functions_of_one_name_are_refused() {
    let mut text = FRAME.to_owned();
    for k in 0..8000 {
        text += &format!("record r{k} {{ a: int }}\nfn f(a: r{k}) -> int = f(r{k}(1)) + f(1);\n");
    }
    let said = wrong(&text).diagnostics;
    assert!(said.iter().any(|d| d.message.contains("64")), "{said:?}");
}

/// A ray, what it hits, and a chain of choices between hits; `end` is the ink.
fn choices(n: usize, end: &str) -> String {
    let lets: String = (0..n)
        .map(|k| format!("let h = if x > {} then h else g;\n", k % 97))
        .collect();
    format!(
        "{FRAME}fn pick(h: hit, g: hit, x: int) -> ink = {{ {lets} {end} }};
draw (x, y) = {{
  let r = ray((x, y, 9), (0, 0, -1));
  if let h = sphere((0, 0, 0), 1).hit(r) then
    (if let g = torus((0, 0, 0), 1, 0.5).hit(r) then pick(h, g, x) else ink(0))
  else ink(1)
}};"
    )
}

#[test]
fn long_chains_of_choices_fit_the_stack() {
    for n in [10, 300, 30_000] {
        let end = "ink(floor(h.normal.x + h.point.y))";
        for end in [end, "ink(floor(h.t))"] {
            let scene = check("scene", &choices(n, end));
            assert!(scene.is_right(), "{n}: {:?}", scene.diagnostics);
        }
    }
}

#[test]
fn what_grows_without_end_is_refused() {
    let turns = |body: &str| format!("loop (a = 0) max 65535 {{ {body} }} else a");
    let constant = turns(&format!("next(a + ({}))", turns("next(a + 1)")));
    wrong(&format!(
        "{FRAME}const c = {constant};\ndraw (x, y) = ink(c);"
    ));
    let mut twice = "fn f0(v: real) -> real = sin(v * 1rad);\n".to_owned();
    for k in 1..30 {
        let j = k - 1;
        twice += &format!("fn f{k}(v: real) -> real = f{j}(v) + f{j}(v + {k});\n");
    }
    wrong(&format!("{FRAME}{twice}draw (x, y) = ink(floor(f29(x)));"));
    let mut shapes = "shape s0(k: real) { dist(p) = length(p) - k; }\n".to_owned();
    for k in 1..30 {
        let j = k - 1;
        shapes += &format!(
            "shape s{k}(k: real) {{ dist(p) = s{j}(k).dist(p + (k, 0, 0)) + s{j}(2 * k).dist(p); }}\n"
        );
    }
    wrong(&format!(
        "{FRAME}{shapes}scene w {{ s29(1); }}\ndraw (x, y) = ink(floor(w.dist((x, y, 1))));"
    ));
    let sum: String = (0..400)
        .map(|k| format!("let a = a + bayer(256)[x + {k}, y * {k}];"))
        .collect();
    let scene = check(
        "scene",
        &format!("{FRAME}draw (x, y) = {{ let a = 0; {sum} ink(floor(a)) }};"),
    );
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
}

#[test]
fn a_large_map_may_be_looked_into_often() {
    let rows: String = (0..900)
        .map(|_| format!("\"{}\"\n", "#.".repeat(450)))
        .collect();
    let sum: String = (0..2000)
        .map(|k| format!("let a = a + m[x + {k}, y * {k}];\n"))
        .collect();
    let text = format!(
        "{FRAME}map m {{ {rows} }} where '#' => 1, '.' => 0;
draw (x, y) = {{ let a = 0; {sum} ink(a) }};"
    );
    let scene = check("scene", &text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
}
