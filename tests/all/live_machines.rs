//! `live` with what accuracy costs, and with two machines: what is searched, taken, built,
//! stopped, and run beside each other.

use crate::cli::{directory, json, success};
use crate::live::{BALL, picture};
use crate::live_client::{Live, is_run};
use serde_json::{Value, json};

/// A run of a point.
fn taken(target: &str, dot: &Value) -> Value {
    json!({"target": target, "format": dot["format"], "options": dot["options"]})
}

fn frontier(shown: &Value) -> &Value {
    &shown["panels"][0]["frontier"]
}

#[test]
fn a_point_is_that_of_tune_and_is_taken_run_and_built() {
    let dir = directory(&[("ball.scn", BALL)]);
    let live = Live::begin(dir.path(), &["ball.scn", "-t", "6502"]);
    live.run(1);
    live.post("tune", &json!({"panel": 0}));
    let shown = live.until("a frontier", |s| frontier(s)["stage"] == "done");
    let points = frontier(&shown)["points"].as_array().expect("points");
    let tune = json(dir.path(), &["tune", "ball.scn", "-t", "6502", "--json"]);
    let all = tune["points"].as_array().expect("points");
    let wanted: Vec<&Value> = all.iter().filter(|p| p["on_frontier"] == true).collect();
    assert!(points.len() > 3, "{points:?}");
    assert_eq!(points.len(), wanted.len());
    for (mine, its) in points.iter().zip(wanted) {
        let options = format!(
            "--format {} {}",
            word(&mine["format"]),
            word(&mine["options"])
        );
        assert_eq!(options.trim(), word(&its["options"]));
        assert_eq!(
            (&mine["cycles"], &mine["error"]),
            (&its["cycles"], &its["error"])
        );
    }
    // One of blocks is taken: its run has the cycles that the search has measured.
    let dot = points
        .iter()
        .find(|p| p["options"].to_string().contains("--block"));
    let dot = dot.expect("blocks");
    let shown = live.run(live.edit(json!({"runs": [taken("6502", dot)]})));
    assert_eq!(shown["panels"][0]["machine"]["cycles"], dot["cycles"]);
    assert_eq!(shown["native"]["serial"], 1, "it is not drawn again");
    assert_eq!(frontier(&shown)["stale"], false);
    live.post("build", &json!({"panel": 0}));
    let shown = live.until("files", |s| s["built"].is_object());
    assert_eq!(shown["built"]["files"], json!(["ball.asm", "ball.prg"]));
    let format = word(&dot["format"]);
    let mut build = vec![
        "build", "ball.scn", "-t", "6502", "-o", "there", "--format", format,
    ];
    build.extend(word(&dot["options"]).split(' '));
    success(dir.path(), &build);
    for name in ["ball.asm", "ball.prg"] {
        let bytes = |path: std::path::PathBuf| std::fs::read(path).expect("a file");
        let there = bytes(dir.path().join("there").join(name));
        assert!(bytes(dir.path().join(name)) == there, "{name}");
    }
    // A newer text has another frontier; what was taken stays.
    let text = BALL.replace("0.8 *", "0.7 *");
    let shown = live.run(live.edit(json!({"text": text})));
    assert_eq!(frontier(&shown)["stale"], true);
    assert_eq!(shown["chosen"]["runs"][0]["options"], dot["options"]);
    // What is no option is said, and another machine has no points of this one's.
    let mut wrong = taken("6502", dot);
    wrong["options"] = json!("--block 7x");
    live.edit(json!({"runs": [wrong]}));
    let shown = live.until("what is wrong", |s| {
        s["panels"][0]["machine"]["stage"] == "wrong"
    });
    let said = shown["panels"][0]["machine"]["wrong"].to_string();
    assert!(said.contains("7x"), "{said}");
    let shown = live.run(live.edit(json!({"runs": [{"target": "jack"}]})));
    assert_eq!(frontier(&shown)["points"], json!([]));
}

fn word(value: &Value) -> &str {
    value.as_str().expect("a word")
}

/// A picture whose ways take a while.
fn large(gain: &str) -> String {
    let larger = BALL
        .replace("48 x 32", "256 x 192")
        .replace("23.5) / 24", "127.5) / 96");
    (larger.replace("(15.5 - y) / 24", "(95.5 - y) / 96")).replace("0.8 *", gain)
}

#[test]
fn a_search_is_stopped_by_the_page_and_by_another_text() {
    let dir = directory(&[("ball.scn", &large("0.8 *"))]);
    let live = Live::begin(dir.path(), &["ball.scn", "-t", "jack"]);
    let searching = |shown: &Value| frontier(shown)["stage"] == "running";
    live.drawn(1);
    live.post("tune", &json!({"panel": 0}));
    live.post("tune", &json!({"panel": 0}));
    live.until("that it searches", searching);
    live.post("stop", &json!({}));
    let shown = live.until("its end", |s| frontier(s)["stage"] == "stopped");
    assert_eq!(frontier(&shown)["waits"], false);
    // Text that is not what it was: nothing is remembered of it.
    let time = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    let gain = format!("0.7{} *", time.expect("a clock").subsec_nanos());
    live.drawn(live.edit(json!({"text": large(&gain)})));
    live.post("tune", &json!({"panel": 0}));
    let shown = live.until("points as they come", |s| {
        searching(s) && frontier(s)["points"].as_array().map(Vec::len) > Some(0)
    });
    // One is taken while others are still to come: it waits, and the search goes on.
    let dot = frontier(&shown)["points"][0].clone();
    let serial = live.edit(json!({"runs": [taken("jack", &dot)]}));
    live.until("more of it", |s| {
        frontier(s)["measured"].as_u64() > Some(1) || !searching(s)
    });
    live.post("stop-search", &json!({"panel": 0}));
    live.until("its end", |s| frontier(s)["stage"] == "stopped");
    let shown = live.run(serial);
    assert_eq!(shown["panels"][0]["machine"]["cycles"], dot["cycles"]);
    let other = live.edit(json!({"text": BALL}));
    assert!(other > serial);
    let shown = live.run(other);
    assert_eq!(frontier(&shown)["stale"], true);
    assert_eq!(shown["chosen"]["runs"][0]["options"], dot["options"]);
}

/// How long a text must rest before machines are put to work, and more.
const REST: std::time::Duration = std::time::Duration::from_millis(500);

#[test]
fn a_search_is_seen_and_is_of_what_was_wanted_when_it_began() {
    let dir = directory(&[("ball.scn", BALL)]);
    let live = Live::begin(dir.path(), &["ball.scn", "-t", "6502:bbc"]);
    live.run(1);
    std::thread::sleep(REST);
    // Another format is chosen while the search has hardly begun.
    live.post("tune", &json!({"panel": 0}));
    std::thread::sleep(std::time::Duration::from_millis(15));
    let run =
        |format: &str, mode: Value| json!({"target": "6502:bbc", "format": format, "mode": mode});
    let log = run("log10", Value::Null);
    let serial = live.edit(json!({"runs": [log]}));
    let shown = live.until("its end", |s| frontier(s)["stage"] == "done");
    assert_eq!(frontier(&shown)["stale"], false);
    assert!(frontier(&shown)["points"].as_array().map(Vec::len) > Some(2));
    live.run(serial);
    // What it is of is chosen otherwise, and as it was: mode, values, text.
    let light = |x: f64| json!({"set": {"light": [x, 0.7, 0.5]}});
    let text = |text: &str| json!({"text": text});
    for (other, back) in [
        (
            json!({"runs": [run("log10", json!("1"))]}),
            json!({"runs": [log]}),
        ),
        (light(0.4), json!({"set": {}})),
        (light(0.4), light(0.5)),
        (text(&BALL.replace("0.8 *", "0.7 *")), text(BALL)),
    ] {
        live.edit(other.clone());
        let shown = live.state(0).1;
        assert_eq!(frontier(&shown)["stale"], true, "{other}");
        live.edit(back.clone());
        let shown = live.state(0).1;
        assert_eq!(frontier(&shown)["stale"], false, "{back}");
    }
}

#[test]
fn what_waits_for_a_search_is_shown_and_said_where_it_is_dropped() {
    let dir = directory(&[("ball.scn", &large("0.8 *"))]);
    let live = Live::begin(dir.path(), &["ball.scn", "-t", "jack"]);
    let searching = |shown: &Value| frontier(shown)["stage"] == "running";
    let waits = |shown: &Value, what: &str| shown["panels"][0]["waits"][what] == true;
    live.drawn(1);
    live.post("tune", &json!({"panel": 0}));
    live.until("that it searches", searching);
    live.post("costs", &json!({"panel": 0}));
    live.post("build", &json!({"panel": 0}));
    let shown = live.state(0).1;
    assert!(searching(&shown) && waits(&shown, "costs") && waits(&shown, "build"));
    // All is run again: the search, which hangs on nothing of it, goes on.
    live.post("run", &json!({}));
    let shown = live.state(0).1;
    assert!(searching(&shown) && !waits(&shown, "costs") && !waits(&shown, "build"));
    assert!(shown["built"]["wrong"].to_string().contains("not built"));
    live.drawn(shown["chosen"]["serial"].as_u64().expect("a number"));
    assert!(searching(&live.state(0).1));
    live.post("build", &json!({"panel": 0}));
    live.edit(json!({"runs": [{"target": "jack", "format": "log10"}]}));
    let shown = live.state(0).1;
    assert!(searching(&shown));
    assert_eq!(shown["built"]["count"], 2);
    live.post("stop-search", &json!({"panel": 0}));
    live.until("its end", |s| frontier(s)["stage"] == "stopped");
}

#[test]
fn a_search_of_nothing_says_why_the_plainest_way_cannot_be() {
    let dir = directory(&[("ball.scn", BALL)]);
    let live = Live::begin(dir.path(), &["ball.scn", "-t", "6502:vcs"]);
    live.drawn(1);
    live.post("tune", &json!({"panel": 0}));
    let shown = live.until("its end", |s| frontier(s)["stage"] == "wrong");
    let said = frontier(&shown)["wrong"].to_string();
    assert!(said.contains("column scenes only"), "{said}");
}

#[test]
fn a_second_machine_runs_beside_the_first() {
    let dir = directory(&[("ball.scn", BALL)]);
    let live = Live::begin(dir.path(), &["ball.scn", "-t", "6502"]);
    live.run(1);
    assert_eq!(live.get("2/machine.png").0, 404);
    let (first, second) = (
        json!({"target": "6502:plain"}),
        json!({"target": "jack", "format": "log10"}),
    );
    let serial = live.edit(json!({"runs": [first, second]}));
    let shown = live.until("a second machine", |s| is_run(s, 1, serial));
    assert!(is_run(&shown, 0, 1), "the first is not run again");
    let machine = &shown["panels"][1]["machine"];
    let run = ["run", "ball.scn", "-t", "jack", "--format", "log10"];
    let said = json(dir.path(), &[&run[..], &["--json"]].concat());
    for (mine, its) in [
        (&machine["cycles"], "cycles"),
        (&machine["unlike_native"], "differs_from_native"),
        (&machine["unlike_model"], "differs_from_model"),
    ] {
        assert_eq!(*mine, said[its], "{its}");
    }
    assert_eq!(live.get("2/machine.png").1, picture(dir.path(), &run));
    // Both run what is written, one after the other.
    let text = BALL.replace("0.8 *", "0.6 *");
    let serial = live.edit(json!({"text": text}));
    live.until("both", |s| is_run(s, 0, serial) && is_run(s, 1, serial));
    #[cfg(target_os = "linux")]
    {
        let threads = live.threads();
        let machines = threads.iter().filter(|name| *name == "machine");
        assert_eq!(machines.count(), 1, "{threads:?}");
    }
    live.post("costs", &json!({"panel": 1}));
    let shown = live.until("costs", |s| s["costs"]["count"] == 1);
    assert_eq!(shown["costs"]["panel"], 1);
    let costs: Value = serde_json::from_slice(&live.get("costs").1).expect("JSON");
    assert_eq!(costs["target"], "jack");
    // And it goes again.
    live.edit(json!({"runs": [{"target": "6502:plain"}]}));
    let shown = live.until("one", |s| s["panels"][1]["machine"]["serial"] == 0);
    assert!(is_run(&shown, 0, serial));
    assert_eq!(live.get("2/machine.png").0, 404);
}

/// What is shown is the first picture, what is built moves.
#[test]
fn what_is_built_of_a_scene_that_moves_moves() {
    let scene = "image 8 x 8 inks black, white;
state at: int = 3 in 0 .. 7 -> (at + 1) mod 8;
draw (x, y) = ink(if x == at then 1 else 0);
";
    let dir = directory(&[("step.scn", scene)]);
    let live = Live::begin(dir.path(), &["step.scn", "-t", "6502"]);
    live.run(1);
    let serial = live.edit(json!({"set": {"at": [5]}}));
    let shown = live.run(serial);
    let cycles = &shown["panels"][0]["machine"]["cycles"];
    let run = ["run", "step.scn", "-t", "6502", "--set", "at=5", "--json"];
    assert_eq!(*cycles, json(dir.path(), &run)["cycles"]);
    live.post("build", &json!({}));
    let shown = live.until("files", |s| s["built"].is_object());
    assert_eq!(shown["built"]["files"], json!(["step.asm", "step.prg"]));
    assert_eq!(shown["panels"][0]["machine"]["cycles"], *cycles);
    let build = [
        "build", "step.scn", "-t", "6502", "--set", "at=5", "-o", "b",
    ];
    success(dir.path(), &build);
    let bytes = |name: &str| std::fs::read(dir.path().join(name)).expect("a file");
    assert_eq!(bytes("step.prg"), bytes("b/step.prg"));
}
