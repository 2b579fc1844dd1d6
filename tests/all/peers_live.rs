//! The page of `live` in a browser: written on, dragged, by the keyboard, on a telephone and in
//! the dark, without a request that leaves this computer; and the page by itself.

use crate::cli::directory;
use crate::live_client::Live;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// A picture that takes the machine some seconds.
const SCENE: &str = "image 320 x 240 inks black, red, yellow, white;
param light: vec3 = (0.5, 0.7, 0.5) in (-1, -1, 0) .. (1, 1, 1);

fn shade(r: ray, sky: real) -> real =
  if let h = torus((0, 0, 0), 1.5, 0.5).hit(r) then 0.1 + 0.8 * max(dot(h.normal, light), 0) else sky;

draw (x, y) = {                    // eight rays a pixel
  let v = loop (k = 0, sum = 0.0) max 9 {
    if k >= 8 then sum / 8
    else next(k + 1, sum + shade(ray((0, 0, 4), unit(((x - 159.5 + k / 8) / 160, (119.5 - y) / 160, -1))), y / 400))
  } else 0.5;
  threshold(v, bayer(4)[x mod 4, y mod 4])
};
";

/// Works with the page at an address in a browser; with a scene's file it is a page by itself.
fn worked(address: &str, pictures: &str, scene: Option<&Path>) -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new("node")
        .arg(root.join("tests/peers/live.mjs"))
        .arg(root.join("target/peers/node_modules/puppeteer-core"))
        .arg(address)
        .arg(root.join("target/peers").join(pictures))
        .args(scene)
        .output()
        .expect("node is installed: see tests/peers/setup");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let found = serde_json::from_slice(&output.stdout).expect("the answer is JSON");
    holds(&found);
    found
}

/// What holds of both pages.
fn holds(found: &Value) {
    for none in ["errors", "asked", "serious"] {
        assert_eq!(found[none], json!([]), "{none}");
    }
    let rows = found["rows"].as_array().expect("rows");
    assert!(rows.len() >= 3, "{rows:?}");
    let rows: Vec<u64> = rows.iter().filter_map(Value::as_u64).collect();
    assert!(
        rows.is_sorted() && rows[0] < rows[rows.len() - 1],
        "{rows:?}"
    );
    assert_eq!(found["typed"]["changed"], true);
    let problem = &found["problem"];
    assert!(
        problem["said"].to_string().contains("line 5: "),
        "{problem}"
    );
    let kept = found["dragged"]["line"].to_string();
    let value = found["dragged"]["value"].as_str().expect("a value");
    assert!(
        kept.contains(&format!("= ({value}, 0.7, 0.5) in")),
        "{kept} {value}"
    );
    assert_ne!(value, "0.5");
    let cost = &found["cost"];
    assert_eq!(cost["title"], "Line 5");
    assert!(cost["gutter"].as_u64() >= Some(3), "{cost}");
    let frontier = &found["frontier"];
    assert_eq!(frontier["busy"], "Stop the search");
    assert!(
        frontier["rows"].as_u64() > Some(2) && frontier["dots"] == frontier["rows"],
        "{frontier}"
    );
    // What was taken is run with its options, and takes what was measured.
    assert!(frontier["options"].to_string().contains("--"), "{frontier}");
    assert_eq!(frontier["cycles"], frontier["row"], "{frontier}");
    let older = frontier["older"].to_string();
    assert!(older.contains("as it was"), "{older}");
    let said = frontier["said"].to_string();
    assert!(said.contains("of the pixels"), "{said}");
    let second = &found["second"];
    assert_eq!(second["names"], json!(["6502:plain", "6502:bbc"]));
    assert_ne!(second["cycles"][0], second["cycles"][1], "{second}");
    assert!(second["shown"].as_u64() > Some(0), "{second}");
    assert!(
        second["built"].to_string().contains("6502:bbc: "),
        "{second}"
    );
    let keys = found["keys"].to_string();
    assert!(!keys.starts_with("[\"cm-content"), "{keys}");
    assert!(keys.contains("costs") && keys.contains("build"), "{keys}");
    assert!(found["width"].as_f64() <= Some(390.0), "{}", found["width"]);
    let luma = |scheme: &str, k: usize| found["luma"][scheme][k].as_f64().expect("a luma");
    assert!(luma("light", 0) > 200.0 && luma("light", 1) < 80.0);
    assert!(luma("dark", 0) < 50.0 && luma("dark", 1) > 180.0);
}

#[test]
fn a_scene_is_written_on_a_page() {
    let dir = directory(&[("ring.scn", SCENE)]);
    let live = Live::begin(dir.path(), &["ring.scn", "-t", "6502"]);
    worked(&live.address, "live", None);
}

/// A file server, until this is dropped.
struct Files(Child);

impl Drop for Files {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Serves a folder's files; answers the address.
fn served(folder: &Path) -> (Files, String) {
    let mut child = Command::new("python3")
        .args(["-u", "-m", "http.server", "--bind", "127.0.0.1", "0"])
        .current_dir(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("python3 is installed: see tests/peers/setup");
    let mut line = String::new();
    let mut out = BufReader::new(child.stdout.take().expect("its output"));
    out.read_line(&mut line).expect("a line");
    let address = line.split_once('(').and_then(|(_, r)| r.split_once(')'));
    let address = address.expect("an address").0.to_owned();
    (Files(child), address)
}

#[test]
fn the_page_by_itself_does_the_same_from_a_file_server() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    if !root.join("target/site/slowlight.wasm").exists() {
        println!("skipped: target/site is not built (`npm run build` in web/, see docs/live.md)");
        return;
    }
    let dir = directory(&[("ring.scn", SCENE)]);
    // In a folder of another, as any address that only has to end in a slash.
    let (_files, address) = served(&root.join("target"));
    let scene = dir.path().join("ring.scn");
    let found = worked(&format!("{address}site/"), "alone", Some(&scene));
    let files = &found["files"];
    assert_eq!(files["saved"], "ring.ssd", "{files}");
    assert!(files["bytes"].as_u64() > Some(0), "{files}");
    assert_eq!(files["first"], json!(["ring.asm", "ring.prg"]));
    let restored = &found["restored"];
    assert_eq!(
        (&restored["text"], &restored["target"]),
        (&json!(true), &json!(true))
    );
    let gallery = &found["gallery"];
    assert!(
        gallery["names"].as_array().map(Vec::len) > Some(10),
        "{gallery}"
    );
    assert_eq!(found["broken"], "this link holds no scene");
    println!(
        "planned in {} ms, {} MHz",
        found["planned"], found["megahertz"]
    );
}
