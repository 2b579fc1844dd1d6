//! What is right parses to the tree that it says.

use super::*;
use crate::print;

#[test]
fn whole_scenes_parse_without_diagnostics() {
    for scene in SCENES {
        let (file, diagnostics) = parse(scene, 0);
        assert_eq!(plain(scene, &diagnostics), "");
        assert!(file.items.len() >= 5);
    }
}

#[test]
fn the_mirrors() {
    let (file, _) = parse(MIRRORS, 0);
    snapshot("mirrors_tokens", &print::tokens(MIRRORS));
    snapshot("mirrors_tree", &print::tree(&file));
}

/// Each source and its tree.
fn show(sources: &[&str]) -> String {
    let mut out = String::new();
    for source in sources {
        let (file, diagnostics) = parse(source, 0);
        assert_eq!(plain(source, &diagnostics), "", "{source}");
        out += &format!("{source}\n");
        for line in print::tree(&file).lines() {
            out += &format!("  > {line}\n");
        }
    }
    out
}

/// Each expression and its tree.
fn show_expressions(sources: &[&str]) -> String {
    let mut out = String::new();
    for source in sources {
        out += &format!("{source:<40} {}\n", tree_of(source));
    }
    out
}

fn tree_of(source: &str) -> String {
    let scene = format!("const it = {source};");
    let (file, diagnostics) = parse(&scene, 0);
    assert_eq!(plain(&scene, &diagnostics), "", "{source}");
    let tree = print::tree(&file);
    let inner = tree.trim_end().strip_prefix("(const it").unwrap();
    inner.strip_suffix(')').unwrap().trim_start().to_string()
}

#[test]
fn items() {
    snapshot(
        "good_items",
        &show(&[
            "",
            "// only a comment",
            "image 320 x 240 inks black, #ff8000;",
            "param eye: vec3 = (0, -0.1, 3) in (-3, -1.5, 1.5) .. (3, 2, 6);",
            "param a: angle = 0.125turn;",
            "param t: real = 0 in 0..1;",
            "const bayer2 = [0, 2; 3, 1];",
            "fn none_at_all() -> int = 3;",
            "fn f(a: real, b: [vec3], c: real?, d: fn(vec3, real) -> real) -> [real?] = a;",
            "fn f(s: shape, w: scene, g: fn(shape) -> scene) -> shape = s;",
            "fn f(a: vec3, up: vec3 = (0, 1, 0)) -> vec3 = a;",
            "effect sky(d: vec3) -> real else 0 = d.y;",
            "shape ball(c: vec3, r: real) { dist(p) = length(p - c) - r; bound = box(c - r, c + r); }",
            "shape nothing() { }",
            "scene world { sphere((0, 0, 0), 1) is 1; plane((0, 1, 0), 0); }",
            "record surface { albedo: real, clear: real }",
            "map m { \"#'\" \"\\\\.\" } where '#' => 1, ''' => 2, '\\' => -1, '.' => 0;",
            "dither d(v: real, x: int, y: int) -> ink = threshold(v, 0.5);",
            "draw (x, y) = ink(0);",
            "use \"lib/shapes.scn\";",
            "const a = 1; const b = 2; record r { a: int } fn f() -> int = a;",
        ]),
    );
}

#[test]
fn precedence() {
    snapshot(
        "good_precedence",
        &show_expressions(&[
            "a or b and c or d",
            "not a and not b or c",
            "not a == b",
            "not not a",
            "a + b < c - d",
            "(a < b) == (c < d)",
            "a - b - c",
            "a / b * c / d",
            "a div b mod c",
            "a + b * c ^ d",
            "a ^ b ^ c",
            "-a ^ b",
            "a ^ -b",
            "a ^ -b ^ c",
            "-a * b",
            "a * -b + c",
            "--a",
            "- a.b",
            "-a[0].f(1) ^ 2",
            "7/16",
            "2.max(3)",
            "a.f(b).g[c, d].h",
            "a.b.c(d)[e](f)".trim_end_matches("(f)"),
            "f(a, -b, c: d, e: 1)",
            "f()",
            "(a)",
            "((a + b)) * c",
            "(a, b)",
            "(a, (b, c), d)",
            "[a]",
            "[a, b; c, d]",
            "[[a, b], [c]]",
            "max(inks, x, frame + row - column, to)",
            "1 + if a then b else c + 2",
            "if a then b else if c then d else e",
            "if a then if b then c else d else e",
            "if let h = a.hit(r) then h.t else none",
            "loop (i = 0) max 12 { next(i + 1) } else i + 1",
            "loop (a = 1, b = a) max 2 ^ 3 { a } else loop (c = 1) max 1 { c } else 2",
            "{ { a } }",
            "{ let a = 1; frame let b = a; row let c = b; column let d = c; d }",
            "{ spread a to { (1, 0): 7/16, (-1, 1): 3/16 }; ink(a) }",
            "90deg + 0.25turn - 1.57rad",
            "true and false",
            "1.50 + 007",
        ]),
    );
}

/// A name is a word of the language only where that word can stand.
#[test]
fn words_of_one_place_are_names_elsewhere() {
    let scene =
        "fn f(x: int, to: int, row: int, max: int, inks: int) -> int = row + max(x, to) * inks;";
    let (file, diagnostics) = parse(scene, 0);
    assert_eq!(plain(scene, &diagnostics), "");
    assert_eq!(file.items.len(), 1);
}

#[test]
fn spans_cover_what_they_say() {
    let scene = "const a = (b + c) * f(d).e;";
    let (file, _) = parse(scene, 7);
    let mut seen = Vec::new();
    fn visit(expr: &crate::tree::Expr, scene: &str, seen: &mut Vec<String>) {
        assert_eq!(expr.span.file, 7);
        seen.push(scene[expr.span.range()].to_string());
        crate::walk::children(expr, &mut |child| visit(child, scene, seen));
    }
    crate::walk::roots(&file, &mut |expr| visit(expr, scene, &mut seen));
    assert_eq!(
        seen,
        ["(b + c) * f(d).e", "b + c", "b", "c", "f(d).e", "f(d)", "d"]
    );
}

#[test]
fn bytes_that_are_not_utf8_are_reported_once() {
    let (text, diagnostics) = crate::decode(b"\xEF\xBB\xBF// caf\xE9 \xFF\nconst a = 1;", 0);
    assert_eq!(text, "// caf\u{fffd} \u{fffd}\nconst a = 1;");
    assert_eq!(
        plain(&text, &diagnostics),
        "1:7 the file is not UTF-8 here [\u{fffd}] (byte 0xe9)\n     help: save the scene as UTF-8; outside comments it needs ASCII only\n"
    );
    assert!(parse(&text, 0).1.is_empty());
}
