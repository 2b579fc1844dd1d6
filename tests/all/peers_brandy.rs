//! The generated BBC BASIC, unchanged, under a real interpreter: Matrix Brandy.
//!
//! Brandy has no way to hand a screen out, and a program that ends leaves it at
//! its prompt. So a driver opens a file of commands as the keyboard (`*EXEC`)
//! and CHAINs the very file that `slowlight build` wrote; at the prompt after
//! its END those commands call a library procedure that writes every pixel of
//! the screen, read by POINT, to a file. The prompt writes over the screen's
//! first line of text, eight rows above any picture of 240 rows.

use crate::cli::{directory, json, success};
use crate::mos6502::Scribe;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// The screen of modes 1 and 9, in pixels of 4 x 4 graphics units.
const SCREEN: (usize, usize) = (320, 256);

const DRIVER: &str = "10*EXEC commands\n20CHAIN \"program\"\n";
const COMMANDS: &str = "PROCshot\nQUIT\n";
/// Writes the last error's number (0 for none), then the screen from its top left.
const LIBRARY: &str = "DEF PROCshot
LOCAL F%,X%,Y%
F%=OPENOUT(\"screen\")
BPUT#F%,ERR
FOR Y%=1023 TO 3 STEP -4:FOR X%=0 TO 1276 STEP 4:BPUT#F%,POINT(X%,Y%):NEXT:NEXT
CLOSE#F%
ENDPROC
";

/// Long enough for a machine with much else to do: a picture takes half a second.
const LIMIT: Duration = Duration::from_secs(60);

/// Runs Brandy without screen or keyboard; kills what has not ended in time.
fn brandy(dir: &Path, args: &[&str]) -> ExitStatus {
    let mut child = Command::new("brandy")
        .args(args)
        .current_dir(dir)
        .env("SDL_VIDEODRIVER", "dummy")
        .env("SDL_AUDIODRIVER", "dummy")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("brandy is installed: see tests/peers/setup");
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait().expect("a status") {
            return status;
        }
        if start.elapsed() > LIMIT {
            child.kill().expect("brandy is killed");
            child.wait().expect("brandy ends");
            panic!("brandy did not end within {LIMIT:?}");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// The screen that a program leaves, an ink a byte, and the error it ended with.
fn run(program: &[u8]) -> (u8, Vec<u8>) {
    let dir = directory(&[
        ("driver", DRIVER),
        ("commands", COMMANDS),
        ("library", LIBRARY),
    ]);
    std::fs::write(dir.path().join("program"), program).expect("a file");
    let status = brandy(dir.path(), &["-lib", "library", "-chain", "driver"]);
    assert!(status.success(), "{status}");
    let written = std::fs::read(dir.path().join("screen")).expect("a screen");
    let (error, screen) = written.split_first().expect("an error's number");
    assert_eq!(screen.len(), SCREEN.0 * SCREEN.1);
    (*error, screen.to_vec())
}

/// A picture as rows of inks.
struct Picture {
    width: usize,
    rows: Vec<Vec<u8>>,
}

impl Picture {
    fn varies(&self) -> bool {
        let first = self.rows[0][0];
        self.rows.iter().flatten().any(|ink| *ink != first)
    }
}

/// The native picture, in the inks of a target's mode.
fn native(dir: &Path, common: &[&str]) -> Picture {
    let args = [&["render", "scene.scn", "-o", "native.pgm"], common].concat();
    success(dir, &args);
    let bytes = std::fs::read(dir.join("native.pgm")).expect("a picture");
    // P5, width and height, the greatest value, then the pixels.
    let (mut header, mut at) = (Vec::new(), 0);
    while header.len() < 4 {
        let end = at
            + bytes[at..]
                .iter()
                .position(u8::is_ascii_whitespace)
                .expect("a header");
        header.push(String::from_utf8_lossy(&bytes[at..end]).into_owned());
        at = end + 1;
    }
    let width = header[1].parse().expect("a width");
    let rows: Vec<_> = bytes[at..].chunks(width).map(<[u8]>::to_vec).collect();
    assert_eq!(rows.len().to_string(), header[2]);
    Picture { width, rows }
}

/// The part of the screen where a centred picture of that size lies.
fn centred(screen: &[u8], width: usize, height: usize) -> Vec<Vec<u8>> {
    let (left, top) = ((SCREEN.0 - width) / 2, (SCREEN.1 - height) / 2);
    assert!(top >= 8, "the prompt would write over the picture");
    let row = |y: usize| screen[(top + y) * SCREEN.0 + left..][..width].to_vec();
    (0..height).map(row).collect()
}

/// Pixels, from a row down, in which a scene's generated file, run by Brandy as
/// it is, differs from the native picture; and the native picture.
fn differences(scene: &str, file: &str, options: &[&str], first: usize) -> (usize, Picture) {
    let dir = directory(&[("scene.scn", scene)]);
    json(
        dir.path(),
        &[&["build", "scene.scn", "--json"], options].concat(),
    );
    let program = std::fs::read(dir.path().join(file)).expect("a program");
    let (error, screen) = run(&program);
    assert_eq!(error, 0, "{}", String::from_utf8_lossy(&program));
    let native = native(dir.path(), options);
    let drawn = centred(&screen, native.width, native.rows.len());
    let pairs = drawn.iter().zip(&native.rows).skip(first);
    let different = pairs
        .flat_map(|(drawn, native)| drawn.iter().zip(native))
        .filter(|(drawn, native)| drawn != native)
        .count();
    (different, native)
}

/// Programs for a Micro put whole bytes into its screen where the picture begins
/// with one: that is jsbeeb's to run. The others run here too.
const MICRO: &[&str] = &["--target", "bbc:micro", "--mode", "1"];
const BASIC_V: &[&str] = &["--target", "bbc:basicv", "--mode", "9"];

#[test]
fn two_mirrors_are_drawn_as_the_native_picture() {
    let mirrors = include_str!("../../examples/mirrors.scn");
    let moved: &[&str] = &["--set", "eye=0.35,0.25,3.6"];
    for set in [&[], moved] {
        for file in ["scene.bas", "scene.bbc"] {
            let options = [BASIC_V, set].concat();
            // Rows 0 to 8 are nobody's in the original; the issue compares from 9.
            let (different, native) = differences(mirrors, file, &options, 9);
            println!("{file} {options:?}: {different} pixels of rows 9 to 239 differ");
            assert!(different <= 12, "{file} {options:?}: {different} pixels");
            assert_eq!((native.width, native.rows.len()), (320, 240));
            let inks = (0..4).filter(|ink| native.rows.iter().any(|r| r.contains(ink)));
            assert_eq!(inks.count(), 4);
        }
    }
}

#[test]
fn small_scenes_are_drawn_as_the_native_picture() {
    for (name, scene) in [
        ("ball", include_str!("../scenes/ball.scn")),
        ("gradient", include_str!("../scenes/gradient.scn")),
        ("spiral", include_str!("../scenes/spiral.scn")),
    ] {
        let (different, native) = differences(scene, "scene.bas", BASIC_V, 0);
        println!("{name}: {different} pixels differ");
        assert_eq!(different, 0, "{name}");
        assert!(native.varies());
    }
}

/// Every operation of the language's reals and integers, edges of domains included.
#[test]
fn random_scenes_are_drawn_as_the_native_picture() {
    let mut scribe = Scribe(11);
    let (mut total, mut varied) = (0, 0);
    for n in 0..40 {
        let scene = scribe.scene();
        let target = [MICRO, BASIC_V][n % 2];
        let (different, native) = differences(&scene, "scene.bas", target, 0);
        total += different;
        varied += u32::from(native.varies());
    }
    println!("random scenes: {total} of {} pixels differ", 40 * 7 * 5);
    assert!(total <= 14, "{total} pixels");
    assert!(varied >= 10, "only {varied} pictures show anything");
}

#[test]
fn the_harness_sees_errors_and_wrong_pixels() {
    let drawn = b"10MODE 9\n20GCOL 0,5:PLOT 69,4*7,4*100\n30PRINT FNnone\n";
    let (error, screen) = run(drawn);
    assert_ne!(error, 0);
    assert_eq!(screen[155 * SCREEN.0 + 7], 5);
}
