//! Other ways to what a scene asks for: each is what the scene would be if it were written so.

use crate::cli::{directory, json, slowlight, usual_format};
use serde_json::Value;

/// A ring and a floor, found by `{hits}`, a pixel by `{rays}` rays each way.
const RING: &str = "image 24 x 16 inks black, grey, white;
scene world {
  torus((0, 0, 0), 1, 0.4)  is 0.9;
  plane((0, 1, 0), -1)      is 0.4;
}
fn shade(x: real, y: real) -> real = {
  let r = ray((0, 1, 4), unit(((x - 11.5) / 12, (5 - y) / 12, -1)));
  if let h = world.{hits} then h.tag * max(dot(h.normal, (0.48, 0.8, 0.36)), 0.1) else 0.7
};
draw (x, y) = threshold(supersample(shade, x, y, {rays}), bayer(2)[x mod 2, y mod 2]);
";

fn ring(hits: &str, rays: &str) -> String {
    RING.replace("{hits}", hits).replace("{rays}", rays)
}

const TRACE: &str = "trace(r, far: 9)";
const MARCH: &str = "march(r, steps: 24, near: 0.02, far: 9)";

fn drawn(scene: &str, target: &str, more: &[&str]) -> Value {
    let dir = directory(&[("ring.scn", scene)]);
    let args = ["run", "ring.scn", "-t", target, "--json", "--rows", "4..9"];
    let format = ["--format", usual_format(target)];
    let run = json(dir.path(), &[&args[..], &format, more].concat());
    assert_eq!(run["differs_from_model"], 0, "{target} {more:?}");
    run
}

/// Cycles and inks.
fn figures(run: &Value) -> [&Value; 2] {
    [&run["cycles"], &run["inks_sha256"]]
}

#[test]
fn a_way_is_the_scene_written_so() {
    let (traced, marched) = (ring(TRACE, "1"), ring(MARCH, "1"));
    for target in ["jack", "6502:plain"] {
        let trace = drawn(&traced, target, &[]);
        let march = drawn(&marched, target, &[]);
        assert_ne!(figures(&trace), figures(&march), "{target}");
        let by = drawn(&marched, target, &["--hits", "trace"]);
        assert_eq!(figures(&by), figures(&trace), "{target}");
        let by = drawn(&traced, target, &["--hits", "march:24:0.02"]);
        assert_eq!(figures(&by), figures(&march), "{target}");
        // Errors are against the scene as it is written.
        let exact = trace["differs_from_native"].as_u64();
        assert!(by["differs_from_native"].as_u64() > exact, "{target}: {by}");
        let few = drawn(&ring(TRACE, "2"), target, &["--samples", "3"]);
        assert_eq!(figures(&few), figures(&trace), "{target}");
    }
}

/// A shape whose normals nobody says.
#[test]
fn differences_stand_for_gradients_only() {
    let pipe = "shape pipe(a: real, b: real) { dist(p) = length((length(p.xz) - a, p.y)) - b; }\n";
    let piped = pipe.to_owned() + &ring(MARCH, "1").replace("torus((0, 0, 0), ", "pipe(");
    for target in ["jack", "6502:plain"] {
        let more = ["--differences", "0.05"];
        let exact = drawn(&piped, target, &[]);
        assert_ne!(
            figures(&drawn(&piped, target, &more)),
            figures(&exact),
            "{target}"
        );
        // The library's ring has a normal of its own.
        let marched = ring(MARCH, "1");
        let own = drawn(&marched, target, &[]);
        assert_eq!(
            figures(&drawn(&marched, target, &more)),
            figures(&own),
            "{target}"
        );
    }
}

#[test]
fn less_memory_for_speed_is_a_smaller_program() {
    let scene = ring(TRACE, "1");
    let plenty = drawn(&scene, "bbc:micro", &[]);
    let same = drawn(&scene, "bbc:micro", &["--thrift", "0"]);
    assert_eq!(figures(&same), figures(&plenty));
    let little = drawn(&scene, "bbc:micro", &["--thrift", "6"]);
    assert!(
        little["code_bytes"].as_u64() < plenty["code_bytes"].as_u64(),
        "{little}"
    );
    assert!(
        little["cycles"].as_u64() > plenty["cycles"].as_u64(),
        "{little}"
    );
    assert_eq!(little["differs_from_native"], plenty["differs_from_native"]);
}

#[test]
fn what_is_no_way_is_said() {
    let bare = "image 8 x 8 inks black, white;
shape bowl(c: vec3) { f(p) = (p.x - c.x)^2 + p.z^2 - p.y; bound = box((-2, 0, -2), (2, 4, 2)); }
scene world { bowl((0, 0, 0)) is 1; }
draw (x, y) = if let h = world.trace(ray((0, 1, 4), unit((x - 3.5, 3.5 - y, -8)))) then ink(1) else ink(0);
";
    let dir = directory(&[("bowl.scn", bare)]);
    for (more, status, said) in [
        (&["--hits", "march:64:0.01"][..], 1, "`bowl` has no `dist`"),
        (&["--hits", "look"], 2, "march:STEPS:NEAR"),
        (&["--differences", "0"], 2, "a distance is"),
        (&["--samples", "0"], 2, "1..=64"),
        (&["--thrift", "7"], 2, "from 0 to 6"),
    ] {
        let args = [&["run", "bowl.scn", "-t", "6502"][..], more].concat();
        let output = slowlight(dir.path(), &args);
        assert_eq!(output.status.code(), Some(status), "{more:?}");
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(text.contains(said), "{text}");
    }
}
