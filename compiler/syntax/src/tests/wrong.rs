//! What is wrong, and how it is said. Each snapshot shows scenes and what the
//! user reads; a change of words is a change of the product.

use super::*;
use crate::print;

/// Each scene as written, what is said of it, and what is left of its tree
/// where that is not nothing.
fn show(scenes: &[&str]) -> String {
    let mut out = String::new();
    for scene in scenes {
        let (file, diagnostics) = parse(scene, 0);
        assert!(!diagnostics.is_empty(), "nothing wrong with {scene:?}");
        for line in scene.lines() {
            out += &format!("  | {}\n", line.replace('\0', "\\0"));
        }
        out += &plain(scene, &diagnostics);
        let tree = print::tree(&file);
        for line in tree.lines() {
            out += &format!("  > {line}\n");
        }
        out.push('\n');
    }
    out
}

#[test]
fn characters() {
    snapshot(
        "wrong_characters",
        &show(&[
            "const a = .5;",
            "const a = 5.;",
            "const a = 1. + .25turn;",
            "const a = b.5;",
            "const a = 1e6;",
            "const a = 90degrees;",
            "image 320x240 inks black, white;",
            "image 320 × 240 inks black, white;",
            "image 8 x 8 inks black, #ff80;",
            "image 8 x 8 inks black, #fffffg;",
            "const a = b && !c || d;",
            "const a = 7 % 2;",
            "const a = 2 ** 3;",
            "const a = b xor c;",
            "const a = if b xor c then 1 else 0;",
            "const a = mod(7, 2);",
            "const a = b <> c;",
            "const a = @@@ 1;",
            "const a = 1 − 2;",
            "const a = 3 ≤ 4;",
            "const é = 1;",
            "const a = 90°;",
            "use \"file.scn;",
            "use “file.scn”;",
            "map m { \"#\" } where '##' => 1;",
            "map m { \"#\" } where '' => 1;",
            "const a = 1; /* one */ const b = 2;",
            "const a = \u{0};",
        ]),
    );
}

#[test]
fn items() {
    snapshot(
        "wrong_items",
        &show(&[
            "function f(a: real) -> real = a;",
            "scen world { }",
            "let a = 3;",
            "a = 3;",
            "struct s { a: real }",
            "3 + 4;",
            "const a = 1;; const b = 2;",
            "record s { a: real };",
            "const a = 1;\n} const b = 2;",
            "image 320 240 inks black, white;",
            "image 320 x 240;",
            "image 320 x 240 inks;",
            "image 320 x 240 inks black white;",
            "param eye = (0, 0, 3);",
            "param eye: vec3;",
            "param eye: vec3 = (0, 0, 3) in (0, 0, 0);",
            "const shape = 1;",
            "const a: real = 1;",
            "const a 1;",
            "fn f(a) -> real = a;",
            "fn f(a: real) = a;",
            "fn f(a: real): real = a;",
            "fn f a: real -> real = a;",
            "fn f(a: real,) -> real = a;",
            "fn f(a: real) -> real { a }",
            "fn (a: real) -> real = a;",
            "fn map(a: real) -> real = a;",
            "fn f(loop: real) -> real = loop;",
            "effect f(a: real) -> real = a;",
            "effect f(a: real) -> real else = a;",
            "shape s { f(p) = p.x; }",
            "shape s() { f(p) = p.x }",
            "shape s() { f(p): p.x; }",
            "shape s() { fn f(p) = p.x; }",
            "scene w { sphere((0, 0, 0), 1) is 1, }",
            "scene w { loop (k = 0) max 3 { next(k + 1) } else 0 }",
            "scene w { sphere((0, 0, 0), 1) = 1; cube(1) is 2; }",
            "record r { a: real; b: real; }",
            "record r { a = 1 }",
            "record r {}",
            "map m { \"#\", \".\" } where '#' => 1;",
            "map m { \"#\" };",
            "map m { \"#\" } where \"#\" => 1;",
            "map m { \"#\" } where '#' = 1;",
            "draw x, y = ink(0);",
            "draw (x) = ink(0);",
            "draw (x, y) { ink(0) }",
            "use file;",
        ]),
    );
}

#[test]
fn one_mistake_costs_one_item() {
    snapshot(
        "wrong_one_mistake_costs_one_item",
        &show(&[
            "const a = 1\nconst b = 2;\nfn f() -> real = b",
            "const a = (1 + 2;\nconst b = 2;",
            "const a = 1 + 2);\nconst b = 2;",
            "const a = [1, 2);\nconst b = 2;",
            "draw (x, y) = {\n  let a = f(1;\n  ink(a)\n};\nconst b = 2;",
            "draw (x, y) = {\n  let a = 1;\n  ink(a)\n\nconst b = 2;",
            "scene w {\n  sphere(1) is 1;\nfn f() -> real = 1;\n",
            "fn f(a: shape, b: scene\nfn g(a: shape) -> scene = a;",
            "draw (x, y) = {\n  let a = 1 +;\n  let b = * 2;\n  let c = 3\n  ink(a b)\n};",
            "scene w {\n  sphere(1 2) is 1;\n  cube(1) is 2;\n  cone(1) is ;\n}",
        ]),
    );
}

#[test]
fn expressions() {
    snapshot(
        "wrong_expressions",
        &show(&[
            "const a = ;",
            "const a = 1 +;",
            "const a = 1 2;",
            "const a = 2 b;",
            "const a = 2(b);",
            "const a = (b)(c);",
            "const a = b < c < d;",
            "const a = b == c == d;",
            "const a = 0 <= b and b < c <= d;",
            "const a = ();",
            "const a = [];",
            "const a = (1, 2,);",
            "const a = [1, 2;];",
            "const a = f(1, );",
            "const a = f(b: 1, 2);",
            "const a = f(1 2);",
            "const a = f(b = 1);",
            "const a = b.;",
            "const a = b.map;",
            "const a = b[];",
            "const a = if b then c;",
            "const a = if b c else d;",
            "const a = if (b) { c } else { d };",
            "const a = if b = c then d else e;",
            "const a = if let b then c else d;",
            "const a = if let b == c then d else e;",
            "const a = b ? c : d;",
            "const a = \"text\";",
            "const a = #ff0000;",
            "const a = 'x';",
            "const a = loop (i = 0) { next(i) } else 0;",
            "const a = loop (i = 0) max 3 { next(i) };",
            "const a = loop i = 0 max 3 { next(i) } else 0;",
            "const a = loop (i) max 3 { next(i) } else 0;",
            "const a = loop (i = 0) max 3 next(i) else 0;",
            "const a = next();",
            "const a = next;",
            "const a = + 1;",
            "const a = b -> c;",
            "const a = 1..2;",
            "const a = b += 1;",
        ]),
    );
}

#[test]
fn blocks() {
    snapshot(
        "wrong_blocks",
        &show(&[
            "const a = {};",
            "const a = { let b = 1; };",
            "const a = { let b = 1; b; };",
            "const a = { b = 1; b };",
            "const a = { let b = 1\n let c = 2; b };",
            "const a = { let b = 1\n  b };",
            "const a = { let b 1; b };",
            "const a = { let b: real = 1; b };",
            "const a = { let if = 1; 2 };",
            "const a = { let (b, c) = 1; 2 };",
            "const a = { pixel let b = 1; 2 };",
            "const a = { row b = 1; 2 };",
            "const a = { spread 1 { (1, 0): 1 }; 2 };",
            "const a = { spread 1 to (1, 0): 1; 2 };",
            "const a = { spread 1 to { (1, 0) 1 }; 2 };",
            "const a = { spread 1 to {}; 2 };",
            "const a = { spread 1 to { (1, 0): 1 }\n 2 };",
            "const a = { return 1; };",
            "const a = { const b = 1; b };",
        ]),
    );
}
