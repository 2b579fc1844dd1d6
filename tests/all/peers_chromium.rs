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

/// Opens a page of points; its screenshot stands under `target/peers`, to be looked at.
fn opened(page: &Path) -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new("node")
        .arg(root.join("tests/peers/chromium.mjs"))
        .arg(root.join("target/peers/node_modules/puppeteer-core"))
        .arg(page)
        .arg(root.join("target/peers/report.png"))
        .output()
        .expect("node is installed: see tests/peers/setup");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    serde_json::from_slice(&output.stdout).expect("the answer is JSON")
}
