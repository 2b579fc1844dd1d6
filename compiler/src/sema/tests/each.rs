//! `each` means what it repeats, written out.

use super::{plain, right};
use crate::analysis::verify::verify;
use crate::eval::native::Native;
use crate::ir::graph::Graph;
use crate::scene::check;
use crate::sema::{Options, most_shapes};
use std::fmt::Write;

/// A picture of the scene `world`, whose tags are reals.
const DRAW: &str = "
image 48 x 32 inks black, grey, white;
param sway: real = 0.1 in 0 .. 0.3;
const light = (6, 9, 7);
draw (x, y) = {
  let r = pinhole((0, 2, 8), at: (0, 1, 0), field: 60deg).through(x, y);
  let v = if let h = world.trace(r, far: 30) then
    h.tag * (0.15 + 0.85 * lambert(h, unit(light - h.point)) * hard_shadow(world, h, light)) else 0.1;
  threshold(v, bayer(4)[x mod 4, y mod 4])
};";

/// Where shapes stand, and how large they are.
const PLACES: &str = "
const n = 4;
fn centre(k: int) -> vec3 = ((k mod 5) * 1.25 - 3, 0.5 + (k mod 3) * 0.5, -(k div 5) * 0.75);
fn radius(k: int) -> real = 0.25 + (k mod 4) / 16;
fn tag(k: int) -> real = 0.4 + (k mod 7) / 16;";

fn graph_of(items: &str) -> Graph {
    let scene = right(&format!("{items}{PLACES}{DRAW}"));
    let graph = scene.lower(&Options::default()).unwrap();
    verify(&graph).unwrap();
    graph
}

fn inks(graph: &Graph) -> Vec<u8> {
    let mut native = Native::new(graph);
    let places = (0..32).flat_map(|y| (0..48).map(move |x| (x, y)));
    places.map(|(x, y)| native.pixel(x, y).ink).collect()
}

/// What is the same to the letter: graphs, and what they draw.
fn same(each: &str, written: &str) {
    let (each, written) = (graph_of(each), graph_of(written));
    assert_eq!(each.to_string(), written.to_string());
    let picture = inks(&each);
    assert!(picture.contains(&0) && picture.contains(&2));
    assert_eq!(picture, inks(&written));
}

/// A graph's lines without the numbers of its nodes.
fn unordered(graph: &Graph) -> Vec<String> {
    let bare = |line: &str| {
        let words = line.split_inclusive(|c: char| !c.is_ascii_alphanumeric() && c != '.');
        let mut is_node = false;
        let keep = words.filter(|word| !std::mem::replace(&mut is_node, word.ends_with('%')));
        keep.collect::<String>()
    };
    let mut lines: Vec<String> = graph.to_string().lines().map(bare).collect();
    lines.sort_unstable();
    lines
}

/// A line for each number.
fn lines(numbers: impl IntoIterator<Item = i32>, line: impl Fn(i32) -> String) -> String {
    numbers.into_iter().map(|k| line(k) + "\n").collect()
}

#[test]
fn it_is_what_it_repeats_written_one_by_one() {
    for last in [0, 3, 8, 50, 200] {
        let each = format!(
            "scene world {{ plane((0, 1, 0), 0) is checker(p.xz, 0.8, 0.4);
             each k in 0 .. {last} {{ sphere(centre(k), radius(k)) is tag(k); }} }}"
        );
        let called = lines(0..=last, |k| {
            format!("sphere(centre({k}), radius({k})) is tag({k});")
        });
        let numbers = lines(0..=last, |k| {
            let (x, z) = (f64::from(k % 5) * 1.25 - 3.0, -f64::from(k / 5) * 0.75);
            let y = 0.5 + f64::from(k % 3) * 0.5;
            let (r, t) = (f64::from(k % 4), f64::from(k % 7));
            let (r, t) = (0.25 + r / 16.0, 0.4 + t / 16.0);
            format!("sphere(({x}, {y}, {z}), {r}) is {t};")
        });
        let written = |items: &str| {
            format!("scene world {{ plane((0, 1, 0), 0) is checker(p.xz, 0.8, 0.4); {items} }}")
        };
        same(&each, &written(&called));
        // Numbers that are written come in another order than those that are worked out.
        let (each, written) = (graph_of(&each), graph_of(&written(&numbers)));
        assert_eq!(unordered(&each), unordered(&written));
        assert_eq!(inks(&each), inks(&written));
    }
}

#[test]
fn several_items_nested_and_what_params_move() {
    same(
        "scene world {
           plane((0, 1, 0), 0) is 0.4;
           each k in -1 .. n div 2 {
             sphere(centre(k + 1), radius(k) + sway) is tag(k) * (0.9 + 0.1 * sign(p.y));
             each j in k + 1 .. 2 { box((k, j, 0), (k, j, 0) + (0.5, 0.5, 0.5)) is 0.1 * j + 0.5; }
           }
         }",
        &format!(
            "scene world {{ plane((0, 1, 0), 0) is 0.4; {} }}",
            lines(-1..=2, |k| {
                let inner = lines(k + 1..=2, |j| {
                    format!(
                        "box(({k}, {j}, 0), ({k}, {j}, 0) + (0.5, 0.5, 0.5)) is 0.1 * {j} + 0.5;"
                    )
                });
                format!(
                    "sphere(centre({k} + 1), radius({k}) + sway) is tag({k}) * (0.9 + 0.1 * sign(p.y)); {inner}"
                )
            })
        ),
    );
}

#[test]
fn what_joins_two_joins_halves() {
    let plane = "plane((0, 1, 0), 0) is 0.4;";
    let ball = |k: i32| format!("sphere(centre({k}), radius({k}))");
    same(
        &format!(
            "scene world {{ {plane} union each k in 1 .. 4 {{ sphere(centre(k), radius(k)) }} is 0.9; }}"
        ),
        &format!(
            "scene world {{ {plane} union(union({}, {}), union({}, {})) is 0.9; }}",
            ball(1),
            ball(2),
            ball(3),
            ball(4)
        ),
    );
    same(
        "shape balls(s: real) {
           dist(p) = min each k in 0 .. 2 { let c = centre(k); length(p - c) - radius(k) * s };
         }
         scene world { balls(1) is 0.9; }",
        "shape balls(s: real) {
           dist(p) = min(min(length(p - centre(0)) - radius(0) * s, length(p - centre(1)) - radius(1) * s),
             length(p - centre(2)) - radius(2) * s);
         }
         scene world { balls(1) is 0.9; }",
    );
    same(
        "scene world { smooth_union(0.25) each k in 0 .. 1 {
           union each j in 0 .. 1 { sphere(centre(2 * k + j), 0.7) } } is 0.9; }",
        "scene world { smooth_union(union(sphere(centre(0), 0.7), sphere(centre(1), 0.7)),
           union(sphere(centre(2), 0.7), sphere(centre(3), 0.7)), k: 0.25) is 0.9; }",
    );
}

#[test]
fn numbers_are_joined_as_the_function_takes_them() {
    let graph = |text: &str| {
        let text = format!("image 8 x 8 inks black, grey, white;\n{text}");
        right(&text).lower(&Options::default()).unwrap().to_string()
    };
    // Ints that become reals, a counter that hides a constant, one number, and a `let` inside.
    assert_eq!(
        graph(
            "const k = 2; fn add(a: real, b: real) -> real = a + b;
             draw (x, y) = ink(floor(add each k in k .. 4 { let m = x mod k; m }) + (max each i in 1 .. 1 { y }));"
        ),
        graph(
            "fn add(a: real, b: real) -> real = a + b;
             draw (x, y) = ink(floor(add(add({ let m = x mod 2; m }, { let m = x mod 3; m }),
               { let m = x mod 4; m })) + y);"
        )
    );
}

#[test]
fn a_thousand_shapes_are_placed_and_no_more() {
    let scene = |count: usize| {
        let half = count / 2;
        format!(
            "scene world {{ each k in 1 .. {half} {{ sphere(centre(k), 0.1) is 0.5; }}
             each k in 1 .. {} {{ each j in k .. k {{ sphere(centre(j + {half}), 0.1) is 0.9; }} }} }}
             {PLACES}{DRAW}",
            count - half
        )
    };
    let found = right(&scene(1000));
    assert_eq!(most_shapes(&found.program, &Options::default()), 1000);
    let found = check("scene", &scene(1001));
    let said = plain(&found.sources, &found.diagnostics);
    assert!(said.contains("1000 shapes at most"), "{said}");
    // Copies of nothing end, too.
    let mut deep = "sphere((0, 0, 0), 1) is 1;".to_owned();
    for k in 0..4 {
        deep = match k {
            0 => format!("each k0 in 1 .. inks - 9 {{ {deep} }}"),
            k => format!("each k{k} in 1 .. 1000 {{ {deep} }}"),
        };
    }
    let found = check("scene", &format!("scene world {{ {deep} }}{PLACES}{DRAW}"));
    let said = plain(&found.sources, &found.diagnostics);
    assert!(said.contains("too large"), "{said}");
}

#[test]
fn it_is_printed_as_it_is_written() {
    let scene = right(&format!(
        "scene world {{ each k in 0 .. n {{ each j in 1 .. k {{ sphere((k, j, 0), 1) is j; }} }}
         union each k in 0 .. 1 {{ sphere((k, 0, 0), 1) }} is 2; }}{PLACES}{DRAW}"
    ));
    let text = scene.program.to_string();
    let mut own = String::new();
    for line in text.lines().skip_while(|l| !l.starts_with("scene")) {
        let _ = writeln!(own, "{line}");
        if line == "}" {
            break;
        }
    }
    assert_eq!(
        own,
        "scene world {
  each k in 0 .. n {
    each j in 1 .. k {
      sphere(((k as real), (j as real), 0.0), 1.0) is j
    }
  }
  union each k in 0 .. 1
    {
      sphere(((k as real), 0.0, 0.0), 1.0)
    } is 2
}
"
    );
}
