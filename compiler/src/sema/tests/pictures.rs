//! Pictures of whole scenes, seen from afar, and derived facets held against
//! explicit ones.

use super::{right, snapshot};
use crate::analysis::verify::verify;
use crate::eval::native::Native;
use crate::sema::Options;

/// Every `step`th pixel, an ink a character.
fn seen(text: &str, step: usize) -> String {
    let graph = right(text).lower(&Options::default()).unwrap();
    verify(&graph).unwrap();
    let mut native = Native::new(&graph);
    let mut out = String::new();
    for y in (step / 2..graph.image.height as usize).step_by(step) {
        for x in (step / 2..graph.image.width as usize).step_by(step) {
            let ink = native.pixel(x as i32, y as i32).ink;
            out.push([' ', '.', 'o', '#'][usize::from(ink).min(3)]);
        }
        out.push('\n');
    }
    out
}

#[test]
fn the_scenes_of_the_language_page_are_seen() {
    let torus = include_str!("../../../syntax/src/tests/scenes/torus.scn");
    let flat = torus.replace("bayer(8)[x mod 8, y mod 8]", "0.5");
    snapshot("seen_torus", &seen(&flat, 8));
    let march = "world.march(r, steps: 64, near: 0.01, far: 12)";
    let march = flat.replace("world.trace(r, far: 12)", march);
    snapshot("seen_march", &seen(&march, 8));
    let maze = include_str!("../../../syntax/src/tests/scenes/maze.scn");
    snapshot("seen_maze", &seen(maze, 1));
    // Without its `spread`: that needs every pixel, not every eighth.
    let primitives = include_str!("../../../syntax/src/tests/scenes/primitives.scn");
    let lines = primitives
        .lines()
        .filter(|l| !l.trim_start().starts_with("spread"));
    let primitives: Vec<&str> = lines.collect();
    snapshot("seen_primitives", &seen(&primitives.join("\n"), 8));
}

/// Every pixel's ray but `few` meets `a` and `b` at the same place with the same
/// normal.
fn same(shapes: &str, a: &str, b: &str, within: f64, few: usize) {
    let text = format!(
        "image 32 x 32 inks black, white; {shapes}
        draw (x, y) = {{
          let r = ray((0.1, 0.2, 4), unit(((x - 15.5) / 16, (15.5 - y) / 16, -1.5)));
          if let h = {a}.hit(r) then
            (if let k = {b}.hit(r) then
              (if abs(h.t - k.t) < {within} and length(h.normal - k.normal) < {within}
               then ink(1) else ink(0))
            else ink(0))
          else if let k = {b}.hit(r) then ink(0) else ink(1)
        }};"
    );
    let picture = seen(&text, 1);
    let differ = picture.matches(' ').count();
    assert!(differ <= few, "{a} {b}\n{picture}");
}

#[test]
fn derived_facets_agree_with_explicit_ones() {
    let ball = "shape ball(c: vec3, k: real) { f(p) = (p.x - c.x)^2 + (p.y - c.y)^2 + dot(p - c, p - c) - (p.x - c.x) * (p.x - c.x) - (p.y - c.y)^2 - k^2; }";
    same(
        ball,
        "sphere((0.2, 0, 0), 1)",
        "ball((0.2, 0, 0), 1)",
        1e-7,
        0,
    );
    let tube = "shape tube(k: real) { f(p) = p.x^2 + p.z^2 - k^2; }";
    same(
        tube,
        "cylinder((0, 0, 0), (0, 1, 0), 0.7)",
        "tube(0.7)",
        1e-7,
        0,
    );
    let floor = "shape ground(k: real) { f(p) = p.y - k; }";
    same(floor, "plane((0, 1, 0), -1)", "ground(-1)", 1e-7, 0);
    let round = "shape round(k: real) { dist(p) = length(p) - k; }";
    same(round, "sphere((0, 0, 0), 1)", "round(1)", 1e-3, 0);
    // Grazing rays have both roots in one step.
    let fourth =
        "shape fourth(k: real) { f(p) = dot(p, p)^2 - k^4; bound = box((-2, -2, -2), (2, 2, 2)); }";
    same(fourth, "sphere((0, 0, 0), 1.5)", "fourth(1.5)", 1e-5, 4);
}

#[test]
fn a_ray_goes_straight_on_through_glass() {
    // Behind the first sphere hangs a second: all that hit the first, and only
    // those in the second's smaller outline, hit it too.
    let text = |onward: &str| {
        format!(
            "image 16 x 16 inks black, white;
            draw (x, y) = {{
              let r = ray((0, 0, 4), unit(((x - 7.5) / 8, (7.5 - y) / 8, -2)));
              if let h = sphere((0, 0, 0), 1).hit(r)
                then (if let k = sphere((0, 0, -4), 1).hit({onward}) then ink(1) else ink(0))
                else ink(0)
            }};"
        )
    };
    let through = seen(&text("beyond(r, h)"), 1);
    assert_eq!(through, seen(&text("r"), 1));
    assert!(through.contains('.'), "{through}");
}
