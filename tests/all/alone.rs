//! The page by itself, without a browser: what its worker says of scenes, as JSON.

use crate::cli::{directory, success};
use serde_json::{Value, json};
use slowlight::live::{Alone, Tell, about};
use std::cell::RefCell;
use std::collections::BTreeMap;

const BALL: &str = "image 48 x 32 inks black, grey, white;
param light: vec3 = (0.5, 0.7, 0.5) in (-1, -1, 0) .. (1, 1, 1);
draw (x, y) = {
  let r = ray((0, 0, 4), unit(((x - 23.5) / 24, (15.5 - y) / 24, -1)));
  let v = if let h = sphere((0, 0, 0), 2).hit(r) then 0.1 + 0.8 * max(dot(h.normal, light), 0) else y / 40;
  threshold(v, bayer(4)[x mod 4, y mod 4])
};
";

/// All that was told.
#[derive(Default)]
struct Heard {
    shown: RefCell<Vec<Value>>,
    bytes: RefCell<BTreeMap<String, Vec<u8>>>,
    files: RefCell<BTreeMap<String, Vec<u8>>>,
}

impl Tell for Heard {
    fn shown(&self, json: &str) {
        let value = serde_json::from_str(json).expect("JSON");
        self.shown.borrow_mut().push(value);
    }

    fn bytes(&self, name: &str, bytes: &[u8]) {
        self.bytes
            .borrow_mut()
            .insert(name.to_owned(), bytes.to_vec());
    }

    fn file(&self, name: &str, bytes: &[u8]) {
        self.files
            .borrow_mut()
            .insert(name.to_owned(), bytes.to_vec());
    }
}

impl Heard {
    fn last(&self) -> Value {
        self.shown.borrow().last().cloned().expect("it was told")
    }
}

fn run(panel: usize, target: &str) -> Value {
    json!({"panel": panel, "serial": 2, "target": target, "format": null, "mode": null, "options": ""})
}

fn wish(text: &str) -> Value {
    json!({"serial": 2, "name": "ball.scn", "text": text, "set": {}, "run": run(0, "6502")})
}

#[test]
fn a_scene_is_drawn_run_counted_and_built() {
    let (mut worker, heard) = (Alone::default(), Heard::default());
    let wish = wish(BALL).to_string();
    assert_eq!(worker.draw(&wish, &heard), Ok(true));
    let shown = heard.last();
    assert_eq!(
        (&shown["native"]["stage"], &shown["native"]["size"]),
        (&json!("done"), &json!([48, 32]))
    );
    assert_eq!(shown["params"][0]["name"], "light");
    for task in ["run", "costs", "build"] {
        assert_eq!(worker.work(task, &wish, &heard), Ok(()), "{task}");
    }
    let shown = heard.last();
    assert_eq!(
        (
            &shown["panels"][0]["machine"]["stage"],
            &shown["panels"][0]["machine"]["unlike_model"]
        ),
        (&json!("done"), &json!(0))
    );
    let bytes = heard.bytes.borrow();
    for name in ["native.png", "1/machine.png", "1/difference.png"] {
        assert!(bytes[name].starts_with(b"\x89PNG"), "{name}");
    }
    let costs: Value = serde_json::from_slice(&bytes["costs"]).expect("JSON");
    assert!(costs["lines"].as_array().map(Vec::len) > Some(2), "{costs}");
    // The files are those of the command line.
    let dir = directory(&[("ball.scn", BALL)]);
    success(
        dir.path(),
        &["build", "ball.scn", "-t", "6502", "-o", "out"],
    );
    let files = heard.files.borrow();
    let written = std::fs::read_dir(dir.path().join("out")).expect("files");
    let mut count = 0;
    for entry in written {
        let path = entry.expect("a file").path();
        let name = path.file_name().expect("a name").to_string_lossy();
        assert!(
            std::fs::read(&path).expect("bytes") == files[&*name],
            "{name}"
        );
        count += 1;
    }
    assert_eq!(
        (count, shown["built"]["files"].as_array().map(Vec::len)),
        (files.len(), Some(count))
    );
}

#[test]
fn what_is_wrong_has_its_place() {
    let (mut worker, heard) = (Alone::default(), Heard::default());
    let text = BALL.replace("unit(", "units(");
    assert_eq!(worker.draw(&wish(&text).to_string(), &heard), Ok(false));
    let shown = heard.last();
    assert_eq!(shown["native"]["stage"], "wrong");
    let problem = &shown["problems"]["list"][0];
    let from = problem["from"].as_u64().map(|at| at as usize);
    assert_eq!(
        (problem["line"].as_u64(), from),
        (Some(4), text.find("units")),
        "{problem}"
    );
    let text = "use \"other.scn\";\n".to_owned() + BALL;
    assert_eq!(worker.draw(&wish(&text).to_string(), &heard), Ok(false));
    let said = heard.last()["problems"]["text"].to_string();
    assert!(said.contains("this page has none"), "{said}");
    let mut other = wish(BALL);
    other["run"]["target"] = json!("abacus");
    for wrong in ["", "{}", &other.to_string()] {
        assert!(worker.draw(wrong, &heard).is_err(), "{wrong}");
    }
    assert!(
        worker
            .work("sing", &wish(BALL).to_string(), &heard)
            .is_err()
    );
}

#[test]
fn a_param_is_set_for_both_pictures() {
    let (mut worker, heard) = (Alone::default(), Heard::default());
    let mut set = wish(BALL);
    assert_eq!(worker.draw(&set.to_string(), &heard), Ok(true));
    let usual = heard.bytes.borrow()["native.png"].clone();
    set["set"] = json!({"light": [-0.5, 0.2, 0.1], "gone": [1.0]});
    assert_eq!(worker.draw(&set.to_string(), &heard), Ok(true));
    assert!(heard.bytes.borrow()["native.png"] != usual);
    assert_eq!(worker.work("run", &set.to_string(), &heard), Ok(()));
    assert_eq!(heard.last()["panels"][0]["machine"]["unlike_model"], 0);
}

#[test]
fn a_page_begins_with_machines_and_scenes() {
    let about = about();
    assert!(about["gallery"].as_array().map(Vec::len) > Some(10));
    assert_eq!(
        about["machines"].as_array().map(Vec::len),
        Some(slowlight_compiler::targets::every().count())
    );
    assert_eq!(about["blank"]["panels"][1]["machine"]["stage"], "idle");
}

#[test]
fn two_machines_have_plans_of_their_own_and_a_frontier_is_found() {
    let (mut worker, heard) = (Alone::default(), Heard::default());
    let (first, mut second) = (wish(BALL), wish(BALL));
    second["run"] = run(1, "jack");
    for wish in [&first, &second] {
        assert_eq!(worker.work("run", &wish.to_string(), &heard), Ok(()));
    }
    let shown = heard.last();
    let targets = [0, 1].map(|k| shown["panels"][k]["machine"]["plan"]["target"].clone());
    assert_eq!(targets, ["6502:plain", "jack"]);
    assert_eq!(worker.work("tune", &second.to_string(), &heard), Ok(()));
    let shown = heard.last();
    let frontier = &shown["panels"][1]["frontier"];
    assert_eq!(
        (&frontier["stage"], &frontier["serial"]),
        (&json!("done"), &json!(2))
    );
    let points = frontier["points"].as_array().expect("points");
    assert!(points.len() > 2, "{frontier}");
    assert_eq!(shown["panels"][0]["frontier"]["stage"], "idle");
    // One is taken.
    second["run"]["format"] = points[0]["format"].clone();
    second["run"]["options"] = points[0]["options"].clone();
    second["run"]["serial"] = json!(3);
    assert_eq!(worker.work("run", &second.to_string(), &heard), Ok(()));
    let machine = heard.last()["panels"][1]["machine"].clone();
    assert_eq!(machine["cycles"], points[0]["cycles"]);
    // A link may bring anything.
    second["run"]["options"] = json!("--prelude /");
    assert_eq!(worker.work("run", &second.to_string(), &heard), Ok(()));
    let machine = heard.last()["panels"][1]["machine"].clone();
    assert_eq!(machine["stage"], "wrong");
    assert!(
        machine["wrong"].to_string().contains("--prelude"),
        "{machine}"
    );
}
