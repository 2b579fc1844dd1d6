//! The pages of `tune --html` and `explain --html` in a browser: they open without an error
//! or a question to any network, and a click on a point shows its picture.

use crate::cli::{directory, success};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

const BALL: &str = "image 48 x 32 inks black, grey, white;
param light: vec3 = (0.5, 0.7, 0.5) in (-1, -1, 0) .. (1, 1, 1);
draw (x, y) = {
  let r = ray((0, 0, 4), unit(((x - 23.5) / 24, (15.5 - y) / 24, -1)));
  let v = if let h = sphere((0, 0, 0), 2).hit(r) then 0.1 + 0.8 * max(dot(h.normal, light), 0) else y / 40;
  threshold(v, bayer(4)[x mod 4, y mod 4])
};
";

#[test]
fn a_click_on_a_point_shows_its_picture() {
    let dir = directory(&[("ball.scn", BALL)]);
    let args = ["tune", "ball.scn", "-t", "6502", "--settings", "4"];
    let more = ["--no-cache", "--html", "report.html"];
    success(dir.path(), &[&args[..], &more].concat());
    let found = opened(&dir.path().join("report.html"));
    assert_eq!(found["errors"], Value::Array(Vec::new()));
    assert_eq!(found["asked"], Value::Array(Vec::new()));
    assert!(found["points"].as_u64() >= Some(3), "{}", found["points"]);
    for (image, before) in [(0, true), (1, false)] {
        assert_eq!(found["before"][image]["shown"], before);
        let clicked = &found["clicked"][image];
        assert_eq!(clicked["shown"], true);
        assert_eq!(
            (&clicked["width"], &clicked["height"]),
            (&48.into(), &32.into())
        );
        assert_ne!(clicked["data"], found["before"][image]["data"]);
    }
    let words = found["words"].to_string();
    for said in ["Numbers are held as", "of the time", "time of the machine"] {
        assert!(words.contains(said), "{said}: {words}");
    }
}

/// As on a telephone, in the dark, and by the keyboard alone.
#[test]
fn pages_are_for_every_screen_and_for_the_keyboard() {
    let dir = directory(&[("ball.scn", BALL)]);
    let tune = ["tune", "ball.scn", "-t", "6502", "--settings", "2"];
    success(dir.path(), &[&tune[..], &["--html", "tune.html"]].concat());
    let explain = [
        "explain",
        "ball.scn",
        "-t",
        "6502",
        "--html",
        "explain.html",
    ];
    success(dir.path(), &explain);
    for name in ["tune", "explain"] {
        let stem = format!("target/peers/{name}");
        let found = seen("pages.mjs", &dir.path().join(format!("{name}.html")), &stem);
        for none in ["errors", "backticks", "unexplained"] {
            assert_eq!(found[none], Value::Array(Vec::new()), "{name}: {none}");
        }
        let width = found["width"].as_f64().expect("a width");
        assert!(width <= 390.0, "{name}: {width}");
        let luma = |scheme: &str, part: &str| found[scheme][part].as_f64().expect("a luma");
        assert!(luma("light", "paper") > 200.0 && luma("light", "ink") < 80.0);
        assert!(luma("dark", "paper") < 50.0 && luma("dark", "ink") > 180.0);
        for scheme in ["light", "dark"] {
            let faint = &found[scheme]["faint"];
            assert_eq!(*faint, Value::Array(Vec::new()), "{name}: {scheme}");
        }
        let keys = found["keys"].as_array().expect("keys");
        if name == "explain" {
            // The first line that has parts opens.
            assert_eq!(
                (&keys[0][1]["on"], &keys[1][1]["open"]),
                (&"summary".into(), &1.into())
            );
            continue;
        }
        assert!(found["small"].as_f64() >= Some(9.0), "{}", found["small"]);
        let points = |k: usize| (&keys[k][1]["point"], &keys[k][1]["chosen"]);
        assert_eq!(keys[0][1]["on"], "circle");
        let chosen = ["0", "1", "2", "1"];
        for (k, point) in (1..).zip(chosen) {
            assert_eq!(points(k), (&point.into(), &point.into()), "{}", keys[k][0]);
        }
        assert_eq!(keys[5][1]["point"], keys[5][1]["chosen"]);
        // Then the table's rows, each a stop.
        assert_eq!(keys[6][1]["on"], "tr");
        assert_eq!(keys[7][1]["point"], keys[7][1]["chosen"]);
    }
}

/// Opens a page of points; its screenshot stands under `target/peers`, to be looked at.
fn opened(page: &Path) -> Value {
    seen("chromium.mjs", page, "target/peers/report.png")
}

/// What one of the scripts beside sees of a page.
fn seen(script: &str, page: &Path, screenshot: &str) -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new("node")
        .arg(root.join("tests/peers").join(script))
        .arg(root.join("target/peers/node_modules/puppeteer-core"))
        .arg(page)
        .arg(root.join(screenshot))
        .output()
        .expect("node is installed: see tests/peers/setup");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    serde_json::from_slice(&output.stdout).expect("the answer is JSON")
}
