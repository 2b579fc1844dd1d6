//! What fits a machine, and what is said of what does not.

use crate::cli::{directory, json, names, slowlight};

const ROOM: &str = include_str!("../../examples/room.scn");

/// A program that does not fit as it reads best is written tight, and draws
/// what its model does.
#[test]
fn a_tight_program_draws_the_same() {
    let dir = directory(&[("room.scn", ROOM)]);
    let args = [
        "run",
        "room.scn",
        "-t",
        "bbc:micro",
        "--rows",
        "100..100",
        "--json",
    ];
    let said = json(dir.path(), &args);
    assert_eq!(said["mode"], 1);
    assert_eq!(said["inks"], 4);
    assert_eq!(said["differs_from_model"], 0);
    let bytes = |name: &str| said[name].as_u64().expect("bytes");
    // From PAGE &1900 to HIMEM &3000.
    assert!(bytes("code_bytes") + bytes("ram_bytes") <= 5888);
}

/// Nothing is written where nothing fits, and the message says by how much.
#[test]
fn what_does_not_fit_is_said_in_bytes() {
    let spheres: Vec<String> = (0..60)
        .map(|k| format!("sphere(({k} - 30, sin({k}rad), 0.{k}), 0.4) is 0.{k};"))
        .collect();
    let scene = format!(
        "image 64 x 48 inks black, white;
        param eye: vec3 = (0, 0, 9) in (-1, -1, 8) .. (1, 1, 10);
        scene world {{ {} }}
        effect lit(h: hit) -> real else 0 = max(h.normal.z, 0);
        draw (x, y) = {{
          let r = ray(eye, unit((x / 32 - 1, 0.75 - y / 32, -1)));
          let v = if let h = world.trace(r, far: 30) then lit(h) * h.tag else 0;
          threshold(v, bayer(2)[x mod 2, y mod 2])
        }};",
        spheres.join("\n")
    );
    let dir = directory(&[("many.scn", &scene)]);
    for target in ["bbc:micro", "6502:plain"] {
        let args = ["build", "many.scn", "-t", target, "-o", "out"];
        let output = slowlight(dir.path(), &args);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{said}");
        let parts = [
            "many does not fit",
            "too many (",
            "program",
            "--without lit",
        ];
        for part in parts.into_iter().chain([target, "--freeze all"]) {
            assert!(said.contains(part), "{part}: {said}");
        }
        assert_eq!(names(dir.path()), ["many.scn"]);
        // A stage may be looked at all the same.
        let args = ["build", "many.scn", "-t", target, "--emit", "text"];
        let output = slowlight(dir.path(), &args);
        assert_eq!(output.status.code(), Some(0));
    }
    // Values that are never alive together share what they are kept in.
    let args = [
        "run", "many.scn", "-t", "jack", "--rows", "24..24", "--json",
    ];
    assert_eq!(json(dir.path(), &args)["differs_from_model"], 0);
}
