//! Sixels as a terminal would read them: libsixel's `sixel2png` gives the picture back.

use crate::cli::directory;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// How long the reader may take.
const LIMIT: Duration = Duration::from_secs(30);

#[test]
fn a_reader_of_sixels_gives_the_picture_back() {
    let dir = directory(&[]);
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/mirrors.scn");
    let slowlight = |args: &[&str], show: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_slowlight"))
            .arg("render")
            .arg(&scene)
            .args(args)
            .current_dir(dir.path())
            .env("SLOWLIGHT_SHOW", show)
            .output()
            .expect("it runs");
        assert!(output.status.success());
        output.stdout
    };
    slowlight(&["-o", "native.png"], "");
    let shown = slowlight(&[], "sixel");
    assert!(shown.starts_with(b"\x1bP"), "a device control string");
    let end = shown
        .windows(2)
        .position(|two| two == b"\x1b\\")
        .expect("its end");
    std::fs::write(dir.path().join("shown.six"), &shown[..end + 2]).expect("a file");
    let mut reader = Command::new("sixel2png")
        .args(["-i", "shown.six", "-o", "shown.png"])
        .current_dir(dir.path())
        .stdin(Stdio::null())
        .spawn()
        .unwrap_or_else(|e| panic!("sixel2png: {e}: run tests/peers/setup"));
    let start = Instant::now();
    while reader.try_wait().expect("a child").is_none() {
        if start.elapsed() > LIMIT {
            let _ = reader.kill();
            panic!("sixel2png did not end");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    let read = |name: &str| {
        let file = std::fs::File::open(dir.path().join(name)).expect("a file");
        let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().expect("a PNG");
        let mut data = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut data).expect("a picture");
        let each = info.color_type.samples();
        let pixels: Vec<[u8; 3]> = data.chunks(each).map(|p| [p[0], p[1], p[2]]).collect();
        (info.width, info.height, pixels)
    };
    assert_eq!(read("shown.png"), read("native.png"));
}

/// What `render` sends to a terminal that answers so.
fn sent(answer: &str, variables: &[(&str, &str)]) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut command = Command::new("python3");
    command
        .arg(root.join("tests/peers/terminal.py"))
        .args([answer, env!("CARGO_BIN_EXE_slowlight"), "render"])
        .arg(root.join("tests/scenes/ball.scn"))
        .env("TERM", "xterm-256color");
    for name in [
        "NO_COLOR",
        "TERM_PROGRAM",
        "KITTY_WINDOW_ID",
        "TMUX",
        "SLOWLIGHT_SHOW",
    ] {
        command.env_remove(name);
    }
    let output = command.envs(variables.iter().copied()).output();
    let output = output.expect("python3 is installed: see tests/peers/setup");
    assert!(output.status.success(), "{answer}");
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn terminals_are_asked_for_sixels() {
    assert!(sent("62;4;22c", &[]).contains("\x1bP0;1q"));
    // None of its attributes is 4, or it does not answer in time: half blocks.
    for answer in ["4;6c", "62;22c", "", "62;4;"] {
        let shown = sent(answer, &[]);
        assert!(
            shown.contains('▀') && !shown.contains("\x1bP"),
            "{answer}: {shown}"
        );
    }
    // Nobody is asked where that is known, or not wanted.
    assert!(sent("62;4c", &[("SLOWLIGHT_SHOW", "blocks")]).contains('▀'));
    assert!(sent("62;4c", &[("TERM", "xterm-kitty")]).contains("\x1b_G"));
    assert!(!sent("62;4c", &[("NO_COLOR", "1")]).contains('\x1b'));
}
