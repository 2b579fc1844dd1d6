//! `each`: in scenes, behind what joins two, and where it cannot stand.

use super::*;
use crate::{MAX_DEPTH, format, print};

/// Each source and its tree, or what is said of it.
fn show(sources: &[&str]) -> String {
    let mut out = String::new();
    for source in sources {
        let (file, diagnostics) = parse(source, 0);
        for line in source.lines() {
            out += &format!("  | {line}\n");
        }
        out += &plain(source, &diagnostics);
        for line in print::tree(&file).lines() {
            out += &format!("  > {line}\n");
        }
        out.push('\n');
    }
    out
}

#[test]
fn right() {
    let all = [
        "scene w { each k in 0 .. 9 { sphere((k, 0, 0), 1) is k; } plane(1) is 2; }",
        "scene w { plane(1); each k in -n .. 2 * n { each j in k .. 9 { a(j); b(k); } } each i in 1 .. 2 { c(i); } }",
        "scene w { union each k in 0 .. 9 { sphere(k) } is 1; }",
        "const a = max each k in 0 .. n - 1 { let b = k * k; b mod 7 } + 1;",
        "const a = smooth_union(0.2) each k in 0 .. 9 { f each j in 0 .. k { g(j, k) } }.dist(p);",
        "const a = f each k in {1} .. if b then c else d { k };",
    ];
    let text = show(&all);
    assert!(!text.contains("help"), "{text}");
    snapshot("good_each", &text);
}

#[test]
fn wrong() {
    snapshot(
        "wrong_each",
        &show(&[
            "scene w { each k 0 .. 9 { a(k) is 1; } b() is 2; }",
            "scene w { each in 0 .. 9 { a(k) is 1; } }",
            "scene w { each k in 0, 9 { a(k) is 1; } }",
            "scene w { each k in 0 to 9 { a(k) is 1; } }",
            "scene w { each (k in 0 .. 9) { a(k) is 1; } }",
            "scene w { each k in 0 .. 9 a(k) is 1; b() is 2; }",
            "scene w { each k in 0 .. 9 { a(k) is 1 } b() is 2; }",
            "scene w { each k in 0 .. 9 { a(k) is ; b(k) is 3; } c() is 2; }",
            "scene w { each k in 0 .. 9 { a(k) is 1; }; b() is 2; }",
            "scene w { a() is 1\n  each k in 0 .. 9 { b(k) is 2; } }",
            "scene w { for k in 0 .. 9 { a(k) is 1; } }",
            "scene w { each k in 0 .. 9 { a(k) is 1; }",
            "each k in 0 .. 9 { sphere(k) is 1; }",
            "shape s() { each k in 0 .. 9 { dist(p) = 1; } }",
            "draw (x, y) = { each k in 0 .. 9 { ink(k) } };",
            "draw (x, y) = { let a = each k in 0 .. 9 { k }; ink(a) };",
            "const a = union(each k in 0 .. 9 { b(k) });",
            "const a = b.union each k in 0 .. 9 { b(k) };",
            "const a = union each k in 0 .. 9 { };",
            "const a = union each k in 0 .. 9 { b(k); };",
            "const a = union each k in 0 .. 9 b(k);",
            "const each = 1;",
        ]),
    );
}

#[test]
fn formatted() {
    let messy = "scene w{plane(1)is 1;\neach k in - n..2*n{\nsphere(k)is k+1;\neach j in 0 ..k{a(j)is 2;}\n\
                 // inside\neach i\nin 0 ..\n9\n{ b(i)\nis 3;\n}\n}\neach l in 0 .. 1 { d(l) is 7; }\nbox(2) is 4; // behind\n\
                 union each k in 0 ..9{let a=k;\nsphere(a)\n}\nis 5;\n}\n\
                 const m=max each k in 0..3{k}+1;\nfn f()->shape=\nsmooth_union( 0.2 )each k in 1..3{\nc(k)}\n.moved(1);";
    let once = format::format(messy, 0).unwrap();
    assert_eq!(format::format(&once, 0).unwrap(), once);
    snapshot("formatted_each", &once);
}

#[test]
fn many_stand_beside_each_other_and_few_in_each_other() {
    let one = "each k in 0 .. 9 { a(k) is 1; } ";
    let (file, diagnostics) = parse(&format!("scene w {{ {} }}", one.repeat(1000)), 0);
    assert_eq!(plain("", &diagnostics), "");
    assert_eq!(file.items.len(), 1);
    let nested = |n: usize| {
        let (open, close) = ("each k in 0 .. 9 { ".repeat(n), " }".repeat(n));
        parse(&format!("scene w {{ {open} a() is 1; {close} }}"), 0)
    };
    assert_eq!(plain("", &nested(100).1), "");
    for n in [127, MAX_DEPTH, 10_000] {
        let (file, diagnostics) = nested(n);
        assert_eq!(diagnostics.len(), 1, "{n}");
        assert!(file.items.is_empty());
    }
}
