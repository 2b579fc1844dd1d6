//! Instances: shapes that are alike but for numbers are found in tables and grids as they are
//! found one by one.

use super::right;
use crate::eval::native::Native;
use crate::ir::graph::Graph;
use crate::sema::{Instancing, Options, Ways};

/// Numbers that look random, from 0 to 1 (Knuth's linear congruential generator, MMIX).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = (self.0.wrapping_mul(6_364_136_223_846_793_005)).wrapping_add(1);
        (self.0 >> 40) as f64 / f64::from(1 << 24)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        // Two places, as people write: so that faces and cells' borders coincide at times.
        ((low + (high - low) * self.next()) * 100.0).round() / 100.0
    }

    fn point(&mut self) -> String {
        let [x, y, z] = [(-4.0, 4.0), (0.0, 3.0), (-5.0, 2.0)].map(|(l, h)| self.between(l, h));
        format!("({x}, {y}, {z})")
    }
}

/// A shape of a kind; its size and place are random.
fn shape(kind: usize, n: &mut Numbers) -> String {
    let (at, size) = (n.point(), n.between(0.2, 0.7));
    match kind {
        0 => format!("sphere({at}, {size})"),
        1 => format!(
            "box({at}, {at} + ({size}, {}, {size}))",
            n.between(0.1, 0.9)
        ),
        2 => format!("clip(cylinder({at}, (0, 1, 0), {size}), slab(0.2, 1.6))"),
        3 => format!("quadric({at}, ({}, 9, 4))", n.between(3.0, 30.0)),
        4 => format!(
            "rotation(box((-0.3, 0, -0.2), (0.3, 1, 0.2)), (0, 1, 0), {size}turn).translation({at})"
        ),
        _ => format!("sphere({at}, {size} + sway)"),
    }
}

fn scene(kind: usize, count: usize, n: &mut Numbers) -> String {
    let mut items = String::new();
    for k in 0..count {
        let shape = shape(kind, n);
        items += &format!("  {shape} is {};\n", (k % 7) as f64 / 8.0 + 0.2);
        // The later one is seen where two are at one place.
        if k % 9 == 4 {
            items += &format!("  {shape} is 0.05;\n");
        }
    }
    let (eye, lamp, lift) = (n.point(), n.point(), n.between(0.01, 0.5));
    format!(
        "image 64 x 48 inks black, grey, white;\n\
         param sway: real = 0.1 in 0 .. 0.3;\n\
         scene s {{\n  plane((0, 1, 0), 0) is 0.4;\n{items}}}\n\
         fn seen(r: ray) -> real = if let h = s.trace(r, far: 12) then\n\
             h.tag * (0.3 + 0.7 * lambert(h, (0.48, 0.64, 0.6)))\n\
             * (if s.blocked(ray(h.point + 0.01 * h.normal, (0.48, 0.64, 0.6)), far: 20) then 0.5 else 1)\n\
             * (0.8 + 0.6 * hard_shadow(s, h, {lamp}, lift: {lift})) else 0;\n\
         fn mirrored(r: ray) -> real = if let h = s.trace(r, far: 12) then\n\
             seen(ray(h.point + 0.01 * h.normal, reflect(r.dir, h.normal))) else 0.5;\n\
         fn followed(first: ray) -> real = loop (r = first, left = 1.2) max 3 {{\n\
             if let h = s.trace(r, far: 12) then\n\
               (if h.tag > 0.5 then next(ray(h.point + 0.01 * h.normal, reflect(r.dir, h.normal)), left * h.tag)\n\
                else left * h.tag)\n\
             else 0.7 * left }} else left;\n\
         draw (x, y) = {{\n\
           let v = if y < 8 then followed(pinhole((0, 2, 9), at: (0, 1, 0), field: 50deg).through(x, 4 * y))\n\
             else if y < 16 then seen(pinhole((0, 2, 9), at: (0, 1, 0), field: 50deg).through(x, 2 * y))\n\
             else if y < 32 then seen(pinhole({eye}, at: (0.1, 0.9, -1), field: 80deg).through(x, 2 * y - 24))\n\
             else mirrored(ray(((x - 32) / 8, (48 - y) / 5, 7), (0, 0, -1)));\n\
           threshold(v, bayer(4)[x mod 4, y mod 4])\n}};"
    )
}

fn graph_of(text: &str, ways: Ways) -> Graph {
    let options = Options {
        ways,
        ..Options::default()
    };
    right(text).lower(&options).unwrap()
}

fn inks(graph: &Graph) -> Vec<u8> {
    let mut native = Native::new(graph);
    let places = (0..48).flat_map(|y| (0..64).map(move |x| (x, y)));
    places.map(|(x, y)| native.pixel(x, y).ink).collect()
}

/// How many nodes a graph needs.
fn size(graph: &Graph) -> usize {
    graph
        .reached()
        .into_iter()
        .filter(|&reached| reached)
        .count()
}

fn separate() -> Ways {
    Ways {
        instancing: Instancing::Separate,
        ..Ways::default()
    }
}

/// What scenes had that were compared.
#[derive(Default)]
struct Had {
    tables: usize,
    grids: usize,
    views: usize,
    bright: usize,
}

/// Compares pictures of a random scene by tables, grids and views with those by shapes one by
/// one.
fn compare(text: &str, had: &mut Had) {
    let one_by_one = graph_of(text, separate());
    let expected = inks(&one_by_one);
    had.bright += usize::from(expected.contains(&2));
    let together = graph_of(text, Ways::default());
    let by = |instancing| Ways {
        instancing,
        ..Ways::default()
    };
    let rows = graph_of(text, by(Instancing::Rows));
    let few = graph_of(text, by(Instancing::FewCells));
    let seen = graph_of(text, by(Instancing::Seen));
    let has = |graph: &Graph, name: &str| graph.tables.iter().any(|t| t.name == name);
    had.tables += usize::from(size(&together) < size(&one_by_one));
    had.grids += usize::from(has(&together, "list"));
    // Of what rays from the eye meet, of what hides the lamp, and of what stands in the sun.
    had.views += together.tables.iter().filter(|t| t.name == "first").count();
    assert!(!has(&rows, "list"));
    let all = [
        (together, "a grid"),
        (few, "few cells"),
        (rows, "a table"),
        (seen, "views and code for each"),
    ];
    for (graph, how) in all {
        let differ = inks(&graph)
            .iter()
            .zip(&expected)
            .filter(|(a, b)| a != b)
            .count();
        assert_eq!(differ, 0, "{how}: {text}");
    }
}

#[test]
fn pictures_are_those_of_shapes_one_by_one() {
    let (n, mut had) = (&mut Numbers(5), Had::default());
    for round in 0..12 {
        compare(&scene(round % 6, [12, 30][round / 6], n), &mut had);
    }
    // Spheres that hang on a param are code each.
    let (tables, grids) = (had.tables, had.grids);
    assert!(tables >= 8 && grids >= 7, "{tables} {grids}");
    assert!(had.bright >= 10, "{}", had.bright);
    assert!(had.views >= 3 * grids, "{} {grids}", had.views);
}

/// `cargo test --release -p slowlight-compiler --lib hundreds_of -- --ignored --nocapture`
#[test]
#[ignore = "takes some minutes"]
fn hundreds_of_pictures_are_those_of_shapes_one_by_one() {
    let (n, mut had) = (&mut Numbers(77), Had::default());
    for round in 0..250 {
        compare(&scene(round % 6, [4, 12, 30, 60][round % 4], n), &mut had);
    }
    println!(
        "250 scenes: {} smaller by tables, {} with grids",
        had.tables, had.grids
    );
    assert!(had.tables >= 150 && had.grids >= 100);
}

#[test]
fn a_grid_grows_less_than_shapes() {
    let n = &mut Numbers(9);
    let nodes =
        |count: usize, n: &mut Numbers| size(&graph_of(&scene(0, count, n), Ways::default()));
    let (few, many) = (nodes(20, n), nodes(200, n));
    assert!(many < few + few / 10, "{few} {many}");
}

#[test]
fn turns_of_the_library_do_not_cut_tables_short() {
    let text = scene(0, 60, &mut Numbers(3));
    let cut = Options {
        max_steps: Some(4),
        ..Options::default()
    };
    let graph = right(&text).lower(&cut).unwrap();
    assert!(inks(&graph) == inks(&graph_of(&text, separate())));
}

/// Balls and something else in turn, or one kind after the other.
fn in_turn(other: &str, mixed: bool) -> String {
    let place = |k: i32| format!("({}, 1, {})", 2 * (k % 3) - 2, -2 * (k / 3));
    let ball = |k: i32| format!("  sphere({}, 0.45) is 0.{};\n", place(k), k + 1);
    let second = |k: i32| format!("  {} is 0.5;\n", other.replace("AT", &place(k)));
    let items: String = match mixed {
        true => (0..9).flat_map(|k| [ball(k), second(k)]).collect(),
        false => (0..9).map(ball).chain((0..9).map(second)).collect(),
    };
    format!(
        "image 64 x 48 inks black, grey, white;\nscene s {{\n{items}}}\n\
         draw (x, y) = {{\n\
           let r = pinhole((0.5, 2.5, 5), at: (0, 0.9, -2), field: 60deg).through(x, y);\n\
           let v = if let h = s.trace(r, far: 40) then h.tag * lambert(h, (0.48, 0.64, 0.6)) else 0;\n\
           threshold(v, bayer(4)[x mod 4, y mod 4])\n}};"
    )
}

#[test]
fn shapes_of_two_kinds_in_turn_are_two_tables() {
    let post = "cylinder(AT, (0, 1, 0), 0.2).clip(slab(0, 1))";
    let graph = |mixed, ways| graph_of(&in_turn(post, mixed), ways);
    let (mixed, sorted) = (graph(true, Ways::default()), graph(false, Ways::default()));
    assert_eq!(size(&mixed), size(&sorted));
    assert!(size(&mixed) < size(&graph(true, separate())) / 2);
    let expected = inks(&graph(false, separate()));
    assert!(expected.contains(&2));
    assert!(inks(&mixed) == expected);
}

#[test]
fn shapes_whose_faces_may_be_the_same_keep_their_order() {
    // A ball on a ball of the same place and size is seen, whatever it is made of.
    let again = "quadric(AT, (4.93827, 4.93827, 4.93827))";
    let [text, sorted] = [true, false].map(|mixed| in_turn(again, mixed));
    let (mixed, one_by_one) = (
        graph_of(&text, Ways::default()),
        graph_of(&text, separate()),
    );
    assert_eq!(size(&mixed), size(&one_by_one));
    assert!(size(&graph_of(&sorted, Ways::default())) < size(&mixed) / 2);
}

/// What one is made of may hang on its numbers as no row of a table can.
#[test]
fn shapes_of_ones_own_are_code_each_whatever_moves_them() {
    let text = in_turn("quartic(0.4).translation(AT)", true).replace(
        "scene s",
        "shape quartic(s: real) { f(p) = p.x^4 + p.y^4 + p.z^4 - s^4; }\nscene s",
    );
    let (mixed, one_by_one) = (
        graph_of(&text, Ways::default()),
        graph_of(&text, separate()),
    );
    assert_eq!(size(&mixed), size(&one_by_one));
}
