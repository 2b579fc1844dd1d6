//! `run --watch`: a scene is run again when it is saved, and the newest text is the one that
//! counts; and pictures where standard output is no terminal.

use crate::cli::{LONG, directory, slowlight, success};
use serde_json::Value;
use std::io::Read;
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::Duration;

const BALL: &str = include_str!("../scenes/ball.scn");

/// A run that watches; ended when the test is.
struct Watching {
    child: Child,
    said: serde_json::StreamDeserializer<'static, serde_json::de::IoRead<ChildStdout>, Value>,
}

impl Watching {
    fn begin(dir: &Path) -> Watching {
        let mut child = Command::new(env!("CARGO_BIN_EXE_slowlight"))
            .args(["run", "w.scn", "-t", "6502", "--format", "fixed16"])
            .args(["--watch", "--json"])
            .current_dir(dir)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the binary runs");
        // What never says anything ends the test, too.
        let id = child.id().to_string();
        std::thread::spawn(move || {
            std::thread::sleep(Duration::from_secs(240));
            let _ = Command::new("kill").arg(id).status();
        });
        let out = child.stdout.take().expect("its output");
        let said = serde_json::Deserializer::from_reader(out).into_iter();
        Watching { child, said }
    }

    /// The digest of the next picture.
    fn next(&mut self) -> Value {
        let report = self.said.next().expect("a report").expect("JSON");
        assert_eq!(report["differs_from_model"], 0, "{report}");
        report["inks_sha256"].clone()
    }

    /// Ends it as Ctrl-C does; answers its status, and what it said of errors.
    fn interrupted(mut self) -> (Option<i32>, String) {
        let id = self.child.id().to_string();
        let kill = Command::new("kill").args(["-INT", &id]).status();
        assert!(kill.expect("kill runs").success());
        let mut said = String::new();
        let mut errors = self.child.stderr.take().expect("its errors");
        errors.read_to_string(&mut said).expect("text");
        let status = self.child.wait().expect("it ends");
        (status.code(), said)
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn save(dir: &Path, name: &str, text: &str) {
    std::fs::write(dir.join(name), text).expect("it is saved");
}

#[test]
fn what_is_saved_is_run_again() {
    let part = "fn bright() -> real = 0.5;\n";
    let scene = format!(
        "use \"part.scn\";\n{}",
        BALL.replace("else 0;", "else bright();")
    );
    let dir = directory(&[("w.scn", &scene), ("part.scn", part)]);
    let dir = dir.path();
    let mut watching = Watching::begin(dir);
    let first = watching.next();
    // Another text, of the scene and of what it uses.
    save(dir, "w.scn", &scene.replace("-1.5)", "-2)"));
    let second = watching.next();
    assert_ne!(first, second);
    save(dir, "part.scn", "fn bright() -> real = 0.2;\n");
    assert_ne!(watching.next(), second);
    // A wrong one is said to be wrong, and is no end; nor is one that takes hours.
    save(dir, "w.scn", "image 24 x\n");
    std::thread::sleep(Duration::from_millis(600));
    save(dir, "w.scn", LONG);
    std::thread::sleep(Duration::from_millis(600));
    save(dir, "part.scn", part);
    save(dir, "w.scn", &scene);
    assert_eq!(watching.next(), first);
    let (status, said) = watching.interrupted();
    assert_eq!(status, Some(0), "{said}");
    assert!(said.contains("w.scn: saved, it is run again"), "{said}");
    assert!(said.contains("w.scn was saved"), "{said}");
    assert!(said.contains("part.scn was saved"), "{said}");
    assert!(said.contains("w.scn:1:"), "{said}");
}

#[test]
fn ctrl_c_ends_it_in_the_middle_of_a_run() {
    let dir = directory(&[("w.scn", LONG)]);
    let watching = Watching::begin(dir.path());
    std::thread::sleep(Duration::from_millis(1500));
    let since = std::time::Instant::now();
    let (status, said) = watching.interrupted();
    // Work that does not look up is not waited for.
    assert!(matches!(status, Some(0 | 130)), "{said}");
    assert!(since.elapsed() < Duration::from_secs(5));
}

#[test]
fn standard_input_and_programs_are_not_watched() {
    let dir = directory(&[("w.scn", BALL)]);
    for (args, said) in [
        (&["-", "--watch"][..], "standard input is none"),
        (&["w.scn", "--watch", "--program", "out"], "cannot be used"),
    ] {
        let output = slowlight(dir.path(), &[&["run", "-t", "jack"], args].concat());
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(said), "{told}");
    }
}

#[test]
fn a_picture_is_text_where_there_is_no_terminal() {
    let dir = directory(&[("w.scn", BALL)]);
    let run = ["run", "w.scn", "-t", "bbc", "--mode", "1", "--show"];
    let shown = success(dir.path(), &run);
    assert!(!shown.contains('\x1b'), "{shown}");
    let (picture, report) = shown.split_once("w on bbc:micro").expect("its report");
    assert_eq!(picture.lines().count(), 8, "{shown}");
    assert!(report.contains("cycles"), "{shown}");
    let native = success(dir.path(), &["render", "w.scn", "--target", "bbc"]);
    assert!(!native.contains('\x1b'), "{native}");
}
