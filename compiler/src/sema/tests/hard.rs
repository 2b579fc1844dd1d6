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
}
