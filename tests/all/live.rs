//! `live` over plain HTTP: who is let in, what it draws and runs, and how it ends.

use crate::cli::{directory, json, success};
use crate::live_client::Live;
use serde_json::{Value, json};
use std::path::Path;

pub const BALL: &str = "image 48 x 32 inks black, grey, white;
param light: vec3 = (0.5, 0.7, 0.5) in (-1, -1, 0) .. (1, 1, 1);
draw (x, y) = {
  let r = ray((0, 0, 4), unit(((x - 23.5) / 24, (15.5 - y) / 24, -1)));
  let v = if let h = sphere((0, 0, 0), 2).hit(r) then 0.1 + 0.8 * max(dot(h.normal, light), 0) else y / 40;
  threshold(v, bayer(4)[x mod 4, y mod 4])
};
";

/// A picture that takes minutes, its pixels some microseconds each.
const SLOW: &str = "image 4096 x 4096 inks black, white;
draw (x, y) = ink(loop (n = x + y) max 2000 { if n < 0 then n else next(n + 1) } else 1);";

/// What `render` and `run` write.
pub fn picture(dir: &Path, args: &[&str]) -> Vec<u8> {
    success(dir, &[args, &["-o", "there.png"]].concat());
    std::fs::read(dir.join("there.png")).expect("a picture")
}

#[test]
fn only_its_own_page_is_answered() {
    let dir = directory(&[("ball.scn", BALL), ("secret.txt", "a secret")]);
    let live = Live::begin(dir.path(), &["ball.scn"]);
    assert_eq!(live.get("").0, 200);
    assert!(
        live.address
            .ends_with(&format!(":{}/{}/", live.port, live.token))
    );
    let path = format!("/{}/scene", live.token);
    let host = format!("Host: 127.0.0.1:{}\r\n", live.port);
    assert_eq!(live.ask("GET", &path, &host, "").0, 200);
    for origin in ["http://slowlight.example", "null", "http://127.0.0.1:1"] {
        let headers = format!("{host}Origin: {origin}\r\n");
        assert_eq!(live.ask("GET", &path, &headers, "").0, 403, "{origin}");
    }
    let rebound = format!("Host: slowlight.example:{}\r\n", live.port);
    assert_eq!(live.ask("GET", &path, &rebound, "").0, 403);
    let wrong = format!("/{}/scene", "0".repeat(live.token.len()));
    for path in ["/", "/scene", "/ball.scn", wrong.as_str()] {
        assert_eq!(live.ask("GET", path, &host, "").0, 403, "{path}");
    }
    // A form of another page is no JSON.
    let form = live.own_headers() + "Content-Type: text/plain\r\n";
    let save = format!("/{}/save", live.token);
    assert_eq!(live.ask("POST", &save, &form, "{}").0, 415);
}

#[test]
fn nothing_outside_is_read_or_written() {
    let dir = directory(&[
        ("outside.scn", "const far = 7;\n"),
        ("secret.txt", "a secret"),
    ]);
    let inside = dir.path().join("inside");
    std::fs::create_dir(&inside).expect("a directory");
    std::fs::write(inside.join("ball.scn"), BALL).expect("a file");
    std::fs::write(inside.join("near.scn"), "const near = 7;\n").expect("a file");
    let live = Live::begin(&inside, &["ball.scn"]);
    for path in [
        "../secret.txt",
        "%2e%2e/secret.txt",
        "..%2fsecret.txt",
        "/etc/passwd",
        "ball.scn",
        "page/../../secret.txt",
    ] {
        let (status, body) = live.get(path);
        assert_eq!(status, 404, "{path}");
        assert!(!String::from_utf8_lossy(&body).contains("secret"), "{path}");
    }
    let with = |line: &str| json!({"text": format!("{line}\n{BALL}")});
    let serial = live.edit(with("use \"../outside.scn\";"));
    let shown = live.until("what is wrong", |s| s["problems"]["serial"] == serial);
    let said = shown["problems"]["list"][0]["message"].to_string();
    assert!(said.contains("outside of the scene's directory"), "{said}");
    live.drawn(live.edit(with("use \"near.scn\";")));
}

/// Links that stand in the scene's directory and lead out of it.
#[cfg(unix)]
#[test]
fn no_link_leads_outside() {
    use std::os::unix::fs::symlink;
    let dir = directory(&[
        ("outside.scn", "const far = 7;\n"),
        ("kept.txt", "as it was"),
    ]);
    let inside = dir.path().join("inside");
    std::fs::create_dir(&inside).expect("a directory");
    std::fs::write(inside.join("ball.scn"), BALL).expect("a file");
    symlink("../outside.scn", inside.join("linked.scn")).expect("a link");
    symlink("..", inside.join("up")).expect("a link");
    symlink("../kept.txt", inside.join("ball.asm")).expect("a link");
    let live = Live::begin(&inside, &["ball.scn", "-t", "6502"]);
    for used in ["linked.scn", "up/outside.scn"] {
        let serial = live.edit(json!({"text": format!("use \"{used}\";\n{BALL}")}));
        let shown = live.until("what is wrong", |s| s["problems"]["serial"] == serial);
        let said = shown["problems"]["list"][0]["message"].to_string();
        assert!(said.contains("outside of the scene's directory"), "{said}");
    }
    live.run(live.edit(json!({"text": BALL})));
    live.post("build", &json!({}));
    let shown = live.until("no files", |s| s["built"].is_object());
    let said = shown["built"]["wrong"].to_string();
    assert!(said.contains("is a link"), "{}", shown["built"]);
    assert!(!inside.join("ball.prg").exists());
    // And the scene's own file, once it is one.
    std::fs::remove_file(inside.join("ball.scn")).expect("a file");
    symlink("../kept.txt", inside.join("ball.scn")).expect("a link");
    for force in [false, true] {
        let body = json!({"page": "test", "text": BALL, "force": force});
        let (status, said) = live.post("save", &body);
        assert_ne!(status, 200, "{said}");
    }
    let kept = std::fs::read_to_string(dir.path().join("kept.txt"));
    assert_eq!(kept.expect("the file"), "as it was");
    assert_ne!(live.state(0).1["text"]["by"], "file");
}

#[test]
fn the_native_picture_is_what_render_draws() {
    let dir = directory(&[("ball.scn", BALL)]);
    let live = Live::begin(dir.path(), &["ball.scn"]);
    let shown = live.drawn(1);
    assert_eq!(shown["native"]["size"], json!([48, 32]));
    let render = ["render", "ball.scn"];
    assert_eq!(live.get("native.png").1, picture(dir.path(), &render));
    // A slider.
    let set = json!({"set": {"light": [-0.5, 0.25, 1.0]}});
    live.drawn(live.edit(set));
    let set = [&render[..], &["--set", "light=-0.5,0.25,1"]].concat();
    assert_eq!(live.get("native.png").1, picture(dir.path(), &set));
    let param = &shown["params"][0];
    assert_eq!(param["name"], "light");
    assert_eq!(param["parts"][2]["range"], json!([0.0, 1.0]));
    let place = |k: usize| param["place"][k].as_u64().expect("a place") as usize;
    assert_eq!(&BALL[place(0)..place(1)], "(0.5, 0.7, 0.5)");
}

#[test]
fn an_error_stands_at_its_line_and_goes_again() {
    let dir = directory(&[("ball.scn", BALL)]);
    let live = Live::begin(dir.path(), &["ball.scn"]);
    let wrong = BALL.replace("unit(((x", "unti(((x");
    let serial = live.edit(json!({"text": wrong}));
    let shown = live.until("an error", |s| s["problems"]["serial"] == serial);
    let problem = &shown["problems"]["list"][0];
    assert_eq!(
        (&problem["line"], &problem["severity"]),
        (&4.into(), &"error".into())
    );
    let at = problem["from"].as_u64().expect("a place") as usize;
    assert!(wrong[at..].starts_with("unti"), "{problem}");
    assert_eq!(shown["native"]["stage"], "wrong");
    let shown = live.drawn(live.edit(json!({"text": BALL})));
    assert_eq!(shown["problems"]["list"], json!([]));
}

#[test]
fn the_machines_picture_is_what_run_shows() {
    let dir = directory(&[("ball.scn", BALL)]);
    let live = Live::begin(dir.path(), &["ball.scn", "--target", "6502"]);
    let shown = live.run(1);
    let machine = &shown["panels"][0]["machine"];
    let run = json(dir.path(), &["run", "ball.scn", "-t", "6502", "--json"]);
    for (mine, its) in [
        (&machine["cycles"], "cycles"),
        (&machine["plan"]["format"], "format"),
        (&machine["unlike_native"], "differs_from_native"),
        (&machine["unlike_model"], "differs_from_model"),
    ] {
        assert_eq!(*mine, run[its], "{its}");
    }
    assert_eq!(machine["unlike_model"], 0);
    assert!(machine["plan"]["expected"].is_number());
    let there = picture(dir.path(), &["run", "ball.scn", "-t", "6502"]);
    assert_eq!(live.get("1/machine.png").1, there);
    // Another machine, in a format of its own.
    let other = json!({"runs": [{"target": "jack", "format": "log10"}]});
    let shown = live.run(live.edit(other));
    let planned = &shown["panels"][0]["machine"]["plan"];
    assert_eq!(
        (&planned["target"], &planned["format"]),
        (&"jack".into(), &"log10".into())
    );
    for (runs, wrong) in [
        (json!([{"target": "pdp"}]), "no target `pdp`"),
        (json!([]), "there are one machine or two"),
        (
            json!([{"target": "jack"}, {"target": "jack"}, {"target": "jack"}]),
            "there are one machine or two",
        ),
    ] {
        let (status, said) = live.post("edit", &json!({"page": "test", "runs": runs}));
        assert_eq!((status, &said["wrong"]), (400, &wrong.into()));
    }
}

#[test]
fn of_many_edits_the_last_stands_and_one_machine_runs() {
    let dir = directory(&[("ball.scn", BALL)]);
    let live = Live::begin(dir.path(), &["ball.scn", "-t", "6502"]);
    live.run(1);
    #[cfg(target_os = "linux")]
    let before = live.threads();
    let mut last = 0;
    let mut text = String::new();
    for k in 0..50 {
        text = BALL.replace("0.8 *", &format!("0.{:02} *", 40 + k));
        last = live.edit(json!({"text": text}));
    }
    let shown = live.run(last);
    assert_eq!(shown["native"]["serial"], last);
    std::fs::write(dir.path().join("last.scn"), &text).expect("a file");
    let render = picture(dir.path(), &["render", "last.scn"]);
    assert_eq!(live.get("native.png").1, render);
    let run = json(dir.path(), &["run", "last.scn", "-t", "6502", "--json"]);
    assert_eq!(shown["panels"][0]["machine"]["cycles"], run["cycles"]);
    #[cfg(target_os = "linux")]
    {
        let after = live.threads();
        let machines = after.iter().filter(|name| *name == "machine");
        assert_eq!(machines.count(), 1, "{after:?}");
        assert_eq!(after.len(), before.len(), "{before:?} {after:?}");
    }
}

#[test]
fn saving_writes_the_file_and_not_over_anothers_text() {
    let dir = directory(&[("ball.scn", BALL)]);
    let path = dir.path().join("ball.scn");
    let live = Live::begin(dir.path(), &["ball.scn"]);
    let read = || std::fs::read_to_string(&path).expect("the file");
    let save = |text: &str, force: bool| {
        let body = json!({"page": "test", "text": text, "force": force});
        live.post("save", &body).0
    };
    let mine = BALL.replace("0.8", "0.7");
    assert_eq!(save(&mine, false), 200);
    assert_eq!(read(), mine);
    // Saved elsewhere, where the page's text is saved: it is taken.
    let other = BALL.replace("0.8", "0.6");
    std::fs::write(&path, &other).expect("a file");
    let shown = live.until("the file's text", |s| {
        s["text"]["by"] == "file" && s["text"]["revision"].as_u64() > Some(2)
    });
    assert_eq!(shown["file"]["elsewhere"], false);
    let scene: Value = serde_json::from_slice(&live.get("scene").1).expect("JSON");
    assert_eq!(scene["text"], other.as_str());
    // And where it is not: that is said, and the page's text stays.
    let unsaved = BALL.replace("0.8", "0.5");
    live.edit(json!({"text": unsaved}));
    std::fs::write(&path, BALL).expect("a file");
    live.until("that it changed", |s| s["file"]["elsewhere"] == true);
    assert_eq!(read(), BALL);
    assert_eq!(save(&unsaved, false), 409);
    assert_eq!(read(), BALL);
    assert_eq!(save(&unsaved, true), 200);
    assert_eq!(read(), unsaved);
    let shown = live.until("saved", |s| s["file"]["saved"] == true);
    assert_eq!(shown["file"]["elsewhere"], false);
    let names = crate::cli::names(dir.path());
    assert_eq!(names, ["ball.scn"], "nothing is left behind");
}

#[test]
fn cycles_by_line_and_builds_are_those_of_the_commands() {
    let dir = directory(&[("ball.scn", BALL)]);
    let live = Live::begin(dir.path(), &["ball.scn", "-t", "6502"]);
    live.run(1);
    assert_eq!(live.get("costs").0, 404);
    live.post("costs", &json!({}));
    live.until("costs", |s| s["costs"]["count"] == 1);
    let found: Value = serde_json::from_slice(&live.get("costs").1).expect("JSON");
    let explain = json(dir.path(), &["explain", "ball.scn", "-t", "6502", "--json"]);
    assert_eq!(found, explain);
    live.post("build", &json!({}));
    let shown = live.until("files", |s| s["built"].is_object());
    assert_eq!(
        shown["built"]["files"],
        json!(["ball.asm", "ball.prg"]),
        "{}",
        shown["built"]
    );
    success(
        dir.path(),
        &["build", "ball.scn", "-t", "6502", "-o", "there"],
    );
    for name in ["ball.asm", "ball.prg"] {
        let bytes = |path: std::path::PathBuf| std::fs::read(path).expect("a file");
        assert_eq!(
            bytes(dir.path().join(name)),
            bytes(dir.path().join("there").join(name))
        );
    }
}

#[cfg(unix)]
#[test]
fn it_is_stopped_by_the_page_and_ended_by_ctrl_c() {
    let dir = directory(&[("slow.scn", SLOW)]);
    let live = Live::begin(dir.path(), &["slow.scn", "-t", "6502"]);
    live.until("it is read", |s| s["problems"]["serial"] == 1);
    live.post("stop", &json!({}));
    live.until("stopped", |s| s["native"]["stage"] == "stopped");
    live.edit(json!({"text": BALL}));
    live.until("another picture", |s| s["native"]["stage"] == "done");
    // A picture of hours, each pixel of it, does not stand in the way of the next.
    live.edit(json!({"text": crate::cli::LONG}));
    live.until("that it is dear", |s| s["native"]["wrong"].is_string());
    live.drawn(live.edit(json!({"text": BALL})));
    live.edit(json!({"text": SLOW}));
    assert_eq!(live.interrupted().code(), Some(0));
}

#[test]
fn what_cannot_be_served_is_said() {
    let dir = directory(&[("ball.scn", BALL)]);
    let taken = std::net::TcpListener::bind(("127.0.0.1", 0)).expect("a port");
    let port = taken.local_addr().expect("an address").port().to_string();
    for (args, status, said) in [
        (vec!["live", "none.scn"], 1, "cannot read none.scn"),
        (vec!["live", "-"], 2, "live watches a file"),
        (
            vec!["live", "ball.scn", "--port", &port],
            1,
            "cannot listen at port",
        ),
    ] {
        let output = crate::cli::slowlight(dir.path(), &args);
        assert_eq!(output.status.code(), Some(status), "{args:?}");
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(text.contains(said), "{text}");
    }
}
