//! Inks on machines that lack their colours, by the command line.

use crate::cli::{directory, json, slowlight};

/// Four inks, of which two are no colours of a Micro's.
const GREYS: &str = "image 16 x 4 inks black, #404060, #88a, white;\ndraw (x, y) = ink(x div 4);\n";
const OWN: &str = "image 16 x 4 inks black, red, yellow, white;\ndraw (x, y) = ink(x div 4);\n";

#[test]
fn what_becomes_of_inks_is_said_once() {
    let dir = directory(&[("greys.scn", GREYS), ("own.scn", OWN)]);
    let dir = dir.path();
    let said = |args: &[&str]| {
        let output = slowlight(dir, args);
        assert!(output.status.success(), "{args:?}");
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    for args in [
        &["run", "greys.scn", "-t", "bbc"][..],
        &["run", "greys.scn", "-t", "6502:bbc"],
        &["build", "greys.scn", "-t", "bbc", "-o", "out"],
        &["check", "greys.scn", "-t", "bbc"],
    ] {
        let said = said(args);
        let what = "a BBC Micro shows ink #404060 as blue and #8888aa as cyan";
        assert_eq!(said.matches(what).count(), 1, "{args:?}: {said}");
        assert!(said.contains("dither between"), "{args:?}: {said}");
    }
    for args in [
        &["run", "own.scn", "-t", "bbc"][..],
        &["run", "own.scn", "-t", "6502:c64"],
        &["run", "greys.scn", "-t", "6502:plain"],
        &["run", "greys.scn", "-t", "6502:c64"],
        &["check", "own.scn", "-t", "bbc"],
    ] {
        assert!(!said(args).contains("shows ink"), "{args:?}");
    }
}

#[test]
fn short_colours_are_those_of_six_digits() {
    let scene = |inks| format!("image 8 x 8 inks {inks};\ndraw (x, y) = ink(x mod 3);\n");
    let dir = directory(&[
        ("short.scn", &scene("#000, #3a6, #Fc0")),
        ("long.scn", &scene("#000000, #33aa66, #ffcc00")),
        ("wrong.scn", &scene("#000, #3a6f, #fff")),
    ]);
    let dir = dir.path();
    for (scene, picture) in [("short.scn", "short.png"), ("long.scn", "long.png")] {
        assert!(
            slowlight(dir, &["render", scene, "-o", picture])
                .status
                .success()
        );
    }
    let read = |name: &str| std::fs::read(dir.join(name)).expect(name);
    assert_eq!(read("short.png"), read("long.png"));
    let wrong = slowlight(dir, &["check", "wrong.scn"]);
    assert_eq!(wrong.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&wrong.stderr).contains("`#3a6f` is not a colour"));
}

#[test]
fn machines_show_inks_in_their_order() {
    let dir = directory(&[("greys.scn", GREYS)]);
    let dir = dir.path();
    for (target, colours) in [
        ("bbc", [[0u8; 3], [0, 0, 255], [0, 255, 255], [255; 3]]),
        ("6502:bbc", [[0; 3], [0, 0, 255], [0, 255, 255], [255; 3]]),
        ("bbc:agon", [[0; 3], [85; 3], [170; 3], [255; 3]]),
        ("6502:c64", [[0; 3], [0x44; 3], [0x95; 3], [255; 3]]),
        (
            "bbc:basicv",
            [[0; 3], [0x40, 0x40, 0x60], [0x88, 0x88, 0xAA], [255; 3]],
        ),
    ] {
        let run = [
            "run",
            "greys.scn",
            "-t",
            target,
            "--json",
            "-o",
            "shown.png",
        ];
        assert_eq!(json(dir, &run)["differs_from_model"], 0, "{target}");
        let file = std::fs::File::open(dir.join("shown.png")).expect("a picture");
        let reader = png::Decoder::new(std::io::BufReader::new(file)).read_info();
        let reader = reader.expect("a PNG");
        let palette = reader.info().palette.as_deref().expect("a palette");
        assert_eq!(palette, colours.concat(), "{target}");
    }
}
