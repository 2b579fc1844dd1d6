//! The BBC Micro and the Commodore 64 in machine code.

use crate::cli::{directory, json, slowlight, success};
use slowlight_vm::Stop;
use slowlight_vm::mos6502::C64;
use std::path::Path;

/// Each mode's name, and how many inks it has.
pub const MODES: [(&str, &str, u32); 7] = [
    ("6502:bbc", "0", 2),
    ("6502:bbc", "1", 4),
    ("6502:bbc", "2", 16),
    ("6502:bbc", "4", 2),
    ("6502:bbc", "5", 4),
    ("6502:c64", "hires", 2),
    ("6502:c64", "multicolour", 4),
];

/// A scene whose picture has some size: ramps of inks in all directions, so that a pixel
/// in a wrong place is seen.
pub fn waves(width: u32, height: u32) -> String {
    format!(
        "image {width} x {height} inks black, red, yellow, white;
        param tilt: real = 0.25 in -1 .. 1;
        draw (x, y) = ink((floor(x * tilt) + y + x * y) mod inks);"
    )
}

/// Pixels of a scene's run that are not the model's, of how many.
fn wrong(dir: &Path, args: &[&str]) -> (u64, u64) {
    let said = json(dir, &[&["run", "--json"], args].concat());
    let number = |name: &str| said[name].as_u64().expect("a count");
    (number("differs_from_model"), number("pixels"))
}

/// Pictures that end within a byte at both sides, that are cropped at all sides, and blocks.
#[test]
fn every_mode_draws_what_its_model_does() {
    let scenes = [
        ("odd.scn", waves(37, 23)),
        ("wide.scn", waves(401, 300)),
        ("blocks.scn", waves(48, 24)),
    ];
    let files: Vec<(&str, &str)> = scenes.iter().map(|(n, t)| (*n, t.as_str())).collect();
    let dir = directory(&files);
    for (target, mode, inks) in MODES {
        for more in [
            &["odd.scn"][..],
            &["odd.scn", "--rows", "7..12"],
            &["wide.scn", "--rows", "60..69"],
            &["blocks.scn", "--block", "3x2"],
            &["blocks.scn", "--block", "8x4", "--rows", "8..19"],
        ] {
            let args = [&["-t", target, "--mode", mode], more].concat();
            let (wrong, pixels) = wrong(dir.path(), &args);
            assert_eq!(wrong, 0, "{args:?}");
            assert!(pixels >= 37 * 6, "{args:?}");
        }
        let args = ["run", "odd.scn", "-t", target, "--mode", mode, "--json"];
        let said = json(dir.path(), &args);
        assert_eq!(said["differs_from_native"], 0);
        assert_eq!(said["inks"], inks.min(4), "MODE {mode}");
    }
}

/// Rows above and columns beside what is seen are computed, and not drawn.
#[test]
fn errors_come_from_what_is_not_seen() {
    let scene = "image 200 x 24 inks black, grey, white;
        param tilt: real = 1.5 in 1 .. 2;
        draw (x, y) = floyd((x + tilt * y) / 260, x, y);";
    let dir = directory(&[("spread.scn", scene)]);
    for (target, mode) in [
        ("6502:bbc", "5"),
        ("6502:bbc", "4"),
        ("6502:c64", "multicolour"),
    ] {
        for rows in ["0..3", "9..12"] {
            let args = ["spread.scn", "-t", target, "--mode", mode, "--rows", rows];
            let (wrong, pixels) = wrong(dir.path(), &args);
            assert_eq!(wrong, 0, "{args:?}");
            assert!(pixels >= 4 * 160);
        }
    }
}

/// A program is at home where the disc leaves memory if it fits there, else lower; the
/// picture is the same.
#[test]
fn a_program_moves_itself_down() {
    let dir = directory(&[("waves.scn", &waves(24, 16))]);
    let read = |name: &str| std::fs::read(dir.path().join(name)).expect("a file");
    let mut inks = Vec::new();
    for (page, out) in [("1900", "high"), ("E00", "low")] {
        let at = ["waves.scn", "-t", "6502:bbc", "--page", page];
        inks.push(json(dir.path(), &[&["run", "--json"], &at[..]].concat())["inks_sha256"].clone());
        success(dir.path(), &[&["build", "-o", out], &at[..]].concat());
        let (text, disc) = (
            read(&format!("{out}/waves.asm")),
            read(&format!("{out}/waves.ssd")),
        );
        let moves = String::from_utf8_lossy(&text).contains("move_down:");
        assert_eq!(moves, page == "E00");
        // Loaded and entered at the same place, &1900 or behind.
        let entry = &disc[256 + 8..256 + 12];
        assert_eq!(entry[..2], entry[2..]);
        assert!(entry[1] >= 0x19);
    }
    assert_eq!(inks[0], inks[1]);
    let usual = json(
        dir.path(),
        &["run", "waves.scn", "-t", "6502:bbc", "--json"],
    );
    assert_eq!(usual["differs_from_model"], 0);
}

/// A mirror's program takes more than MODE 1 leaves above the disc's memory.
#[test]
fn a_large_program_fits_lower() {
    let mirrors = include_str!("../../examples/mirrors.scn");
    let dir = directory(&[("mirrors.scn", mirrors)]);
    let of = [
        "mirrors.scn",
        "-t",
        "6502:bbc",
        "--mode",
        "1",
        "--format",
        "fixed24",
        "--rows",
        "120..120",
    ];
    let (wrong, pixels) = wrong(dir.path(), &of);
    assert_eq!((wrong, pixels), (0, 320));
    let high = slowlight(
        dir.path(),
        &[&["build", "--page", "1900"], &of[..]].concat(),
    );
    let said = String::from_utf8_lossy(&high.stderr).into_owned();
    assert_eq!(high.status.code(), Some(1), "{said}");
    assert!(
        said.contains("of 7,168 bytes") && said.contains("what would help"),
        "{said}"
    );
    assert!(!dir.path().join("mirrors.asm").exists());
}

/// What such a program has several times is called, and it draws what it did.
#[test]
fn a_program_that_calls_what_it_repeats_draws_the_same() {
    let csg = include_str!("../../examples/csg.scn");
    let dir = directory(&[("csg.scn", csg)]);
    let of = "csg.scn -t 6502:bbc --mode 4 --format fixed16 --rows 120..120";
    let of: Vec<&str> = of.split(' ').collect();
    assert_eq!(wrong(dir.path(), &of), (0, 320));
    let built = slowlight(dir.path(), &[&["build"], &of[..]].concat());
    assert!(built.status.success());
    let text = std::fs::read_to_string(dir.path().join("csg.asm")).expect("a program");
    assert!(text.matches("jsr shared").count() > 10);
    // What is short is called as well.
    for called in ["jsr saturate16", "jsr abs16", "jsr right16"] {
        assert!(text.contains(called), "{called}");
    }
}

#[test]
fn wrong_options_say_what_there_is() {
    let dir = directory(&[("waves.scn", &waves(24, 16))]);
    for (args, said) in [
        (
            &["-t", "6502:bbc", "--mode", "7"][..],
            "its modes are 4, 1, 2, 0, 5",
        ),
        (
            &["-t", "6502:c64", "--mode", "1"],
            "its modes are hires, multicolour",
        ),
        (
            &["-t", "6502:c64", "--page", "E00"],
            "--page is the BBC Micro's",
        ),
        (
            &["-t", "jack", "--style", "listing"],
            "--style is BASIC's and the 6502's",
        ),
        (&["-t", "6502:vic"], "no target `6502:vic`"),
    ] {
        let output = slowlight(dir.path(), &[&["build", "waves.scn"], args].concat());
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(text.contains(said), "{text}");
    }
}

/// A param outside of its range is refused by the program itself.
#[test]
fn a_wrong_param_is_said_on_the_screen() {
    let dir = directory(&[("waves.scn", &waves(24, 16))]);
    for (target, said) in [
        ("6502:bbc", "OUT OF ITS RANGE: PARAM 02"),
        ("6502:c64", "out of its range: param 02"),
    ] {
        success(dir.path(), &["build", "waves.scn", "-t", target]);
        let path = dir.path().join("waves.asm");
        let text = std::fs::read_to_string(&path).expect("a program");
        assert_eq!(text.matches("first_row = 0 ").count(), 1);
        std::fs::write(&path, text.replace("first_row = 0 ", "first_row = 99 ")).expect("written");
        let output = slowlight(dir.path(), &["vm", target, "waves.asm"]);
        assert_eq!(output.status.code(), Some(1));
        assert!(String::from_utf8_lossy(&output.stderr).contains(said));
    }
}

/// The picture stands until a key is pressed; then BASIC has its zero page, its ROMs and
/// its screen again.
#[test]
fn the_c64_gets_everything_back() {
    let dir = directory(&[("waves.scn", &waves(24, 16))]);
    success(dir.path(), &["build", "waves.scn", "-t", "6502:c64"]);
    let image = std::fs::read(dir.path().join("waves.prg")).expect("a program");
    // 10 SYS 2061
    assert_eq!(image[..14], *b"\x01\x08\x0b\x08\x0a\0\x9e2061\0\0\0");
    let mut machine = C64::new();
    let theirs = |at: u16| (at * 7 + 3) as u8;
    (2..256).for_each(|at| machine.poke(at, theirs(at)));
    machine.load(&image).expect("it is loaded");
    let drawn = machine.run(100_000_000, &mut |_| true);
    assert_eq!(drawn.stop, Stop::Ended);
    assert!(drawn.screen.is_some());
    assert_ne!(machine.peek(2), theirs(2));
    machine.press();
    let after = machine.run(100_000_000, &mut |_| true);
    assert_eq!((after.stop, after.screen), (Stop::Ended, None));
    assert!((2..256).all(|at| machine.peek(at) == theirs(at)));
    assert_eq!((machine.peek(1), machine.register(0xDD00) & 3), (0x37, 3));
    assert_eq!(machine.cpu().status() & 4, 0, "interrupts");
    assert_eq!(machine.cpu().sp, 1, "the stack as it was, less the return");
}

/// What is wanted of every target: profiles add up, effects are free, snapshots hold.
#[test]
fn reports_know_the_machines() {
    let dir = directory(&[("waves.scn", &waves(24, 16))]);
    for target in ["6502:bbc", "6502:c64"] {
        let said = json(
            dir.path(),
            &["explain", "waves.scn", "-t", target, "--json"],
        );
        let cycles = said["cycles"].as_u64().expect("cycles");
        let run = json(dir.path(), &["run", "waves.scn", "-t", target, "--json"]);
        assert_eq!(run["cycles"].as_u64(), Some(cycles), "{target}");
        success(
            dir.path(),
            &["snapshot", "waves.scn", "-t", target, "--accept"],
        );
        success(dir.path(), &["snapshot", "waves.scn", "-t", target]);
        success(dir.path(), &["compare", "waves.scn", "-t", target]);
    }
}
