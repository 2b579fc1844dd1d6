//! The command line, run as its user runs it: right uses.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The binary, to be run in a directory.
pub fn slowlight(dir: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_slowlight"))
        .args(args)
        .current_dir(dir)
        // What `tune` keeps is no affair of the user's.
        .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"))
        .output()
        .expect("the binary runs")
}

/// What a run that must succeed prints.
pub fn success(dir: &Path, args: &[&str]) -> String {
    let output = slowlight(dir, args);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {said}");
    String::from_utf8(output.stdout).expect("output is text")
}

/// The JSON that a run prints.
pub fn json(dir: &Path, args: &[&str]) -> Value {
    serde_json::from_str(&success(dir, args)).expect("output is JSON")
}

/// A directory with some files, gone at the end of the test.
pub fn directory(files: &[(&str, &str)]) -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("a directory");
    for (name, text) in files {
        std::fs::write(dir.path().join(name), text).expect("a file");
    }
    dir
}

/// The format of reals that a target has first: another may be taken where none is asked for.
pub fn usual_format(target: &str) -> &'static str {
    let found = slowlight_compiler::targets::find(target).expect("a target");
    found.runtime.format
}

/// The names in a directory, sorted.
pub fn names(dir: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(dir).expect("a directory");
    let name = |e: std::io::Result<std::fs::DirEntry>| e.expect("an entry").file_name();
    let mut names: Vec<String> = entries
        .map(|e| name(e).to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// A picture that takes hours.
pub const LONG: &str = "image 4096 x 4096 inks black, white;
  fn turns(n: int) -> int = loop (m = n) max 65535 { if m < 0 then m else next(m + 1) } else m;
  draw (x, y) = ink(loop (n = x + y) max 65535 {
    if n < 0 then n else next(turns(n))
  } else 1);";

/// Runs what takes long, and interrupts it as Ctrl-C does.
#[cfg(unix)]
pub fn interrupted(dir: &Path, args: &[&str]) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_slowlight"))
        .args(args)
        .current_dir(dir)
        .stderr(std::process::Stdio::null())
        .spawn()
        .expect("the binary runs");
    std::thread::sleep(std::time::Duration::from_millis(300));
    assert!(
        child.try_wait().expect("it runs").is_none(),
        "it ended early"
    );
    let kill = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(kill.expect("kill runs").success());
    let status = child.wait().expect("it ends");
    // By the signal itself, where it came before anybody listened for it.
    assert!(status.code().is_none_or(|code| code == 130), "{status}");
}

fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Four pixels by three, the ink by column, moved by a param.
pub const STEPS: &str = "image 4 x 3 inks black, white;
param shift: real = 0 in 0 .. 4;
effect bright(v: real) -> real else 0 = v;
draw (x, y) = ink(floor(bright((x + shift) / 2)));
";

fn pgm(dir: &Path, args: &[&str]) -> Vec<u8> {
    let mut all = vec!["render", "steps.scn", "-o", "out.pgm"];
    all.extend(args);
    success(dir, &all);
    std::fs::read(dir.join("out.pgm")).expect("a picture")
}

#[test]
fn pictures_are_written_in_each_format() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let dir = dir.path();
    let row = [0, 0, 1, 1];
    assert_eq!(
        pgm(dir, &[]),
        [&b"P5\n4 3\n1\n"[..], &row, &row, &row].concat()
    );
    success(dir, &["render", "steps.scn", "-o", "out.pbm"]);
    let pbm = std::fs::read(dir.join("out.pbm")).expect("a picture");
    assert_eq!(pbm, [&b"P4\n4 3\n"[..], &[0xC0; 3]].concat());
    success(dir, &["render", "steps.scn", "-o", "out.png"]);
    let file = std::fs::File::open(dir.join("out.png")).expect("a picture");
    let decoder = png::Decoder::new(std::io::BufReader::new(file));
    let mut reader = decoder.read_info().expect("a PNG");
    let mut data = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut data).expect("an image");
    assert_eq!(
        reader.info().palette.as_deref(),
        Some(&[0, 0, 0, 255, 255, 255][..])
    );
    assert_eq!(data, [row, row, row].concat());
    assert_eq!(names(dir), ["out.pbm", "out.pgm", "out.png", "steps.scn"]);
}

#[test]
fn options_change_the_picture() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let dir = dir.path();
    assert_eq!(pgm(dir, &["--rows", "1..1"]), b"P5\n4 1\n1\n\0\0\x01\x01");
    let moved = b"P5\n4 1\n1\n\0\x01\x01\x01";
    assert_eq!(pgm(dir, &["--rows", "1..1", "--set", "shift=1"]), moved);
    let frozen = ["--rows", "2..2", "--set", "shift=1", "--freeze", "all"];
    assert_eq!(pgm(dir, &frozen), moved);
    let dark = pgm(dir, &["--rows", "0..0", "--without", "bright"]);
    assert_eq!(dark, b"P5\n4 1\n1\n\0\0\0\0");
}

#[test]
fn render_reports_as_json() {
    let dir = directory(&[("steps.scn", STEPS)]);
    let said = json(
        dir.path(),
        &["render", "steps.scn", "--json", "--rows", "0..1"],
    );
    assert_eq!(said["width"], 4);
    assert_eq!(said["height"], 2);
    assert_eq!(said["inks"], 2);
    // printf '\0\0\1\1\0\0\1\1' | sha256sum
    let digest = "e68520d17ca2420fe805180d5d57039119414b21ad6577c1f46360dd9e3d2984";
    assert_eq!(said["inks_sha256"], digest);
    assert_eq!(names(dir.path()), ["steps.scn"]);
}

#[test]
fn two_mirrors_equal_the_reference() {
    let scene = repository("examples/mirrors.scn");
    let dir = directory(&[]);
    let scene = scene.to_str().expect("a path");
    success(
        dir.path(),
        &["render", scene, "-o", "m.pgm", "--rows", "9..239"],
    );
    let drawn = std::fs::read(dir.path().join("m.pgm")).expect("a picture");
    let reference = std::fs::read(repository("tests/reference/mirrors-f64.pgm")).expect("it");
    let pixels = 320 * 231;
    let tail = |file: &[u8]| file[file.len() - pixels..].to_vec();
    assert!(
        tail(&drawn) == tail(&reference),
        "the native picture differs"
    );
}

#[test]
fn check_lists_what_it_finds() {
    let wrong = "image 4 x 3 inks black, white;\ndraw (x, y) = ink(z);\n";
    let dir = directory(&[("steps.scn", STEPS), ("wrong.scn", wrong)]);
    let said = json(dir.path(), &["check", "steps.scn", "--json"]);
    assert_eq!(said["diagnostics"], Value::Array(Vec::new()));
    let output = slowlight(dir.path(), &["check", "wrong.scn", "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let said: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let first = &said["diagnostics"][0];
    assert_eq!(first["severity"], "error");
    assert_eq!((&first["line"], &first["column"]), (&2.into(), &19.into()));
    assert_eq!(first["file"], "wrong.scn");
}

#[test]
fn stages_are_printed_without_a_target() {
    let dir = directory(&[("steps.scn", STEPS)]);
    for (stage, part) in [
        ("tokens", "image"),
        ("tree", "shift"),
        ("graph", "param 0 shift"),
        ("rates", "column"),
    ] {
        let text = success(dir.path(), &["build", "steps.scn", "--emit", stage]);
        assert!(text.contains(part), "{stage}: {text}");
    }
    assert_eq!(names(dir.path()), ["steps.scn"]);
}

#[test]
fn a_scene_uses_other_files() {
    let user = "use \"lib/grey.scn\";\nimage 2 x 1 inks black, white;\ndraw (x, y) = pick(x);\n";
    let dir = directory(&[("user.scn", user)]);
    std::fs::create_dir(dir.path().join("lib")).expect("a directory");
    let grey = "use \"../lib/grey.scn\";\nfn pick(x: int) -> ink = ink(1 - x);\n";
    std::fs::write(dir.path().join("lib/grey.scn"), grey).expect("a file");
    success(dir.path(), &["render", "user.scn", "-o", "out.pgm"]);
    let drawn = std::fs::read(dir.path().join("out.pgm")).expect("a picture");
    assert_eq!(drawn, b"P5\n2 1\n1\n\x01\0");
    std::fs::write(dir.path().join("lib/grey.scn"), "fn pick(").expect("a file");
    let output = slowlight(dir.path(), &["check", "user.scn"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1));
    assert!(said.contains("lib/grey.scn:1:"), "{said}");
}

/// Opens a picture of 2 x 1 pixels in 2 inks, stores ink 1, and ends.
const ASSEMBLY: &str = "* = $0800
 lda #2
 sta $FF00
 lda #1
 sta $FF02
 lda #2
 sta $FF04
 lda #1
 sta $FF09
 lda #0
 sta $FF0A
";

#[test]
fn any_program_runs_on_a_machine() {
    let basic = "10 PRINT 6*7\n20 MODE 1\n30 GCOL 0,3\n40 PLOT 69,0,1020\n50 END\n";
    let jack = "class Main { function void main() {
        do Screen.drawPixel(0, 0); do Output.printInt(42); return; } }";
    let vm = "function Main.main 0\npush constant 0\npush constant 0\n\
        call Screen.drawPixel 2\npop temp 0\npush constant 0\nreturn\n";
    let dir = directory(&[("dot.asm", ASSEMBLY), ("dot.bas", basic)]);
    let dir = dir.path();
    let said = json(dir, &["vm", "6502", "dot.asm", "--json", "-o", "dot.pgm"]);
    assert_eq!(said["stopped"], "ended");
    assert_eq!(said["cycles"], 30);
    let drawn = std::fs::read(dir.join("dot.pgm")).expect("a picture");
    assert_eq!(drawn, b"P5\n2 1\n1\n\x01\0");
    let text = success(dir, &["vm", "bbc", "dot.bas", "-o", "dot2.pgm"]);
    assert!(text.contains("42"), "{text}");
    let drawn = std::fs::read(dir.join("dot2.pgm")).expect("a picture");
    let pixels = &drawn[drawn.len() - 320 * 256..];
    assert_eq!(pixels[0], 3);
    assert!(pixels[1..].iter().all(|&ink| ink == 0));
    for (machine, file, text) in [("jack", "Main.jack", jack), ("hack", "Main.vm", vm)] {
        std::fs::create_dir(dir.join(machine)).expect("a directory");
        std::fs::write(dir.join(machine).join(file), text).expect("a file");
        success(dir, &["vm", machine, machine, "-o", "dot.pbm"]);
        let drawn = std::fs::read(dir.join("dot.pbm")).expect("a picture");
        assert_eq!(&drawn[..11], b"P4\n512 256\n", "{machine}");
        assert_eq!(drawn[11], 0x80, "{machine}: the pixel is black");
        let said = json(
            dir,
            &["vm", machine, &format!("{machine}/{file}"), "--json"],
        );
        assert_eq!(said["output"], if machine == "jack" { "42" } else { "" });
    }
}

#[test]
fn programs_that_do_not_end_are_stopped() {
    let dir = directory(&[
        ("loop.asm", "* = $0800\nloop: jmp loop\n"),
        ("loop.bas", "10 MODE 4\n20 GOTO 20\n"),
        ("stop.bas", "10 PRINT 1/0\n"),
        (
            "Main.vm",
            "function Main.main 0\nlabel a\npush constant 0\npop temp 0\ngoto a\n",
        ),
    ]);
    for (machine, file, stopped) in [
        ("6502", "loop.asm", "limit"),
        ("bbc", "loop.bas", "limit"),
        ("bbc", "stop.bas", "fault"),
        ("hack", "Main.vm", "limit"),
    ] {
        let picture = format!("{machine}.png");
        let more = ["--limit", "100000", "--json", "-o", &picture];
        let output = slowlight(dir.path(), &[&["vm", machine, file][..], &more].concat());
        assert_eq!(output.status.code(), Some(1), "{file}");
        let said: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(said["stopped"], stopped, "{file}");
        assert!(!output.stderr.is_empty());
    }
    // What it had drawn so far; the assembly opened no picture.
    let drawn: Vec<String> = names(dir.path())
        .into_iter()
        .filter(|n| n.ends_with(".png"))
        .collect();
    assert_eq!(drawn, ["bbc.png", "hack.png"]);
}
