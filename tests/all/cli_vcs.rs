//! `vm 6502:vcs`: frames, their lines, and what becomes of them.

use crate::cli::{directory, json, slowlight, success};
use std::path::Path;

/// A cartridge's source: 3 lines of sync and so many others; the background's colour is the
/// picture's number, and stays while left is held.
fn cart(lines: u32) -> String {
    let text = format!(
        "* = $F000\nstart: lda #0\n sta $80\nframe: lda #2\n sta $02\n sta $00\n sta $02\n sta $02\n \
         sta $02\n lda #0\n sta $00\n lda $80\n sta $09\n bit $0280\n bvc held\n inc $80\n inc $80\n\
         held: ldx #{}\nupper: sta $02\n dex\n bne upper\n ldx #100\nlower: sta $02\n dex\n bne lower\n \
         jmp frame\n",
        lines - 104
    );
    let length = slowlight_vm::mos6502::assemble(&text)
        .expect("a program")
        .bytes
        .len();
    format!(
        "{text} .res {}\n .word start, start, start\n",
        0xFFA - length
    )
}

fn failure(dir: &Path, args: &[&str], status: i32) -> String {
    let output = slowlight(dir, args);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{args:?}: {said}");
    said
}

#[test]
fn a_cartridge_is_run_for_frames() {
    let dir = directory(&[
        ("pal.asm", &cart(312)),
        ("ntsc.asm", &cart(262)),
        ("wrong.asm", &cart(300)),
    ]);
    let dir = dir.path();
    let vm = ["vm", "6502:vcs"];
    let said = success(
        dir,
        &[&vm[..], &["pal.asm", "--image", "pal.a26", "-o", "pal.pgm"]].concat(),
    );
    assert_eq!(said, "60 frames, 60 of them of 312 lines (PAL)\n");
    assert_eq!(
        std::fs::read(dir.join("pal.a26"))
            .expect("a cartridge")
            .len(),
        4096
    );
    // The source and the file are one cartridge.
    let text = json(
        dir,
        &[&vm[..], &["ntsc.asm", "--frames", "20", "--json"]].concat(),
    );
    success(
        dir,
        &[&vm[..], &["ntsc.asm", "--image", "ntsc.a26"]].concat(),
    );
    let file = json(
        dir,
        &[&vm[..], &["ntsc.a26", "--frames", "20", "--json"]].concat(),
    );
    assert_eq!(text, file);
    assert_eq!(
        text["output"],
        "20 frames, 20 of them of 262 lines (NTSC)\n"
    );
    assert_eq!(text["stopped"], "ended");
    let said = failure(dir, &[&vm[..], &["wrong.asm", "--frames", "3"]].concat(), 1);
    let wrong =
        "3 of 3 frames have not 312 lines: frame 0 has 300, frame 1 has 300, frame 2 has 300";
    assert!(said.contains(wrong), "{said}");
    // What has no sync is stopped, and has no picture.
    let none = "* = $F000\nstart: jmp start\n .res 4087\n .word start, start, start\n";
    std::fs::write(dir.join("none.asm"), none).expect("a file");
    let said = failure(
        dir,
        &[&vm[..], &["none.asm", "--frames", "3", "-o", "x.png"]].concat(),
        1,
    );
    assert!(said.contains("no vertical sync began in"), "{said}");
}

#[test]
fn keys_are_the_joystick_and_films_have_every_frame() {
    let dir = directory(&[("pal.asm", &cart(312))]);
    let dir = dir.path();
    let vm = ["vm", "6502:vcs", "pal.asm"];
    // Frames 0 to 3 are counted, in 4 to 8 left is held, and 9 is counted again.
    let keys = "wait 4 left*5 wait 20 shot a.pgm wait 1 quit";
    let keys = ["--keys", keys, "-o", "b.pgm"];
    success(dir, &[&vm[..], &keys].concat());
    let ink = |name: &str| {
        let bytes = std::fs::read(dir.join(name)).expect("a picture");
        bytes[bytes.len() - 160 * 100]
    };
    // The shot at frame 30 shows frame 29, and the last one 30: five of them had left.
    assert_eq!((ink("a.pgm"), ink("b.pgm")), (29 - 5, 30 - 5));
    success(
        dir,
        &[&vm[..], &["--frames", "7", "-o", "film.gif"]].concat(),
    );
    let file = std::fs::File::open(dir.join("film.gif")).expect("a film");
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::Indexed);
    let mut film = options.read_info(file).expect("a GIF");
    let mut inks = Vec::new();
    while let Some(frame) = film.read_next_frame().expect("a frame") {
        assert_eq!((frame.width, frame.height), (160, 288));
        inks.push(frame.buffer[160 * 100]);
    }
    assert_eq!(inks, [0, 1, 2, 3, 4, 5, 6]);
}

#[test]
fn what_is_no_vcs_is_refused() {
    let dir = directory(&[("pal.asm", &cart(312)), ("hello.bas", "10 PRINT 1\n")]);
    let dir = dir.path();
    std::fs::write(dir.join("odd.bin"), vec![0xEA; 5000]).expect("a file");
    for (args, status, part) in [
        (&["6502:vcs", "odd.bin"][..], 1, "a cartridge of 5000 bytes"),
        (
            &["6502:vcs", "pal.asm", "--at", "0x2000"],
            2,
            "--at and --start",
        ),
        (
            &["6502:vcs", "pal.asm", "--frames", "9999", "-o", "x.gif"],
            2,
            "at most 3000",
        ),
        (
            &["6502:vcs", "pal.asm", "--keys", "shot a.png", "-o", "x.gif"],
            2,
            "no `shot`",
        ),
        (
            &["6502:vcs", "pal.asm", "-o", "x.jpg"],
            2,
            "no picture's name",
        ),
        (
            &["bbc", "hello.bas", "--frames", "5"],
            2,
            "--frames is the Atari VCS's",
        ),
    ] {
        let said = failure(dir, &[&["vm"][..], args].concat(), status);
        assert!(said.contains(part), "{args:?}: {said}");
    }
}
