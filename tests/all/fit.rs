//! What fits a machine, and what is said of what does not.

use crate::cli::{directory, json, names, slowlight, usual_format};

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

/// Sixty spheres: far too many for the machines if each is written out.
fn many() -> String {
    let spheres: Vec<String> = (0..60)
        .map(|k| format!("sphere(({k} - 30, sin({k}rad), 0.{k}), 0.4) is 0.{k};"))
        .collect();
    format!(
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
    )
}

/// Where shapes are too many to be written out, they share subroutines, and
/// the program still draws what its model does.
#[test]
fn shapes_share_subroutines_where_memory_is_short() {
    let csg = include_str!("../../examples/csg.scn");
    let scenes = [("csg.scn", csg), ("many.scn", &many())];
    let dir = directory(&scenes);
    for (scene, rows, target, room) in [
        ("csg.scn", "110..110", "6502:plain", 65_280),
        ("csg.scn", "110..110", "bbc:micro", 16_128),
    ] {
        let args = ["run", scene, "-t", target, "--rows", rows, "--json"];
        let said = json(dir.path(), &args);
        assert_eq!(said["differs_from_model"], 0, "{scene} {target}");
        let bytes = |name: &str| said[name].as_u64().expect("bytes");
        let all = bytes("code_bytes") + bytes("ram_bytes");
        assert!(all <= room, "{scene} {target}: {all}");
    }
    // Values that are never alive together share what they are kept in.
    let args = [
        "run", "many.scn", "-t", "jack", "--rows", "24..24", "--json",
    ];
    assert_eq!(json(dir.path(), &args)["differs_from_model"], 0);
}

/// A program reads as the scene does: subroutines are named after what the
/// scene calls there.
#[test]
fn subroutines_are_named_after_the_scene() {
    let csg = include_str!("../../examples/csg.scn");
    let dir = directory(&[("csg.scn", csg)]);
    let args = [
        "build",
        "csg.scn",
        "-t",
        "6502:plain",
        "-o",
        ".",
        "--outlined",
    ];
    let output = slowlight(dir.path(), &args);
    assert_eq!(output.status.code(), Some(0));
    let text = std::fs::read_to_string(dir.path().join("csg.asm")).expect("written");
    for line in ["; ---- trace, called from ", "do_trace:", "jsr do_trace"] {
        assert!(text.contains(line), "{line}");
    }
}

/// With subroutines or without, a program draws what its own model does.
#[test]
fn subroutines_draw_the_same_everywhere() {
    let dir = directory(&[("room.scn", ROOM)]);
    for target in ["bbc:micro", "bbc:agon", "jack", "6502:plain"] {
        let rows = "100..100";
        let args = [
            "run",
            "room.scn",
            "-t",
            target,
            "--rows",
            rows,
            "--json",
            "--outlined",
        ];
        assert_eq!(json(dir.path(), &args)["differs_from_model"], 0, "{target}");
    }
}

/// Nothing is written where nothing fits, and the message says by how much.
#[test]
fn what_does_not_fit_is_said_in_bytes() {
    let entries: Vec<String> = (0..34_000)
        .map(|k| format!("0.{:04}", k * 7919 % 10_000))
        .collect();
    let scene = format!(
        "image 64 x 48 inks black, white;
        param eye: vec3 = (0, 0, 9) in (-1, -1, 8) .. (1, 1, 10);
        scene world {{ sphere((0, 0, 0), 1) is 0.5; }}
        const noise = [{}];
        effect lit(h: hit) -> real else 0 = max(h.normal.z, 0);
        draw (x, y) = {{
          let r = ray(eye, unit((x / 32 - 1, 0.75 - y / 32, -1)));
          let v = if let h = world.trace(r, far: 30) then lit(h) * h.tag else 0;
          threshold(v, noise[x + 64 * y, 0])
        }};",
        entries.join(", ")
    );
    let dir = directory(&[("large.scn", &scene)]);
    for target in ["bbc:micro", "6502:plain"] {
        let format = usual_format(target);
        let build = ["build", "large.scn", "-t", target, "--format", format];
        let args = [&build[..], &["-o", "out"]].concat();
        let output = slowlight(dir.path(), &args);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{said}");
        let parts = [
            "large does not fit",
            "too many (",
            "program",
            "--without lit",
            "make tables smaller",
        ];
        for part in parts.into_iter().chain([target, "--freeze all"]) {
            assert!(said.contains(part), "{part}: {said}");
        }
        assert_eq!(names(dir.path()), ["large.scn"]);
        // A stage may be looked at all the same.
        let args = [&build[..], &["--emit", "text"]].concat();
        let output = slowlight(dir.path(), &args);
        assert_eq!(output.status.code(), Some(0));
    }
}
