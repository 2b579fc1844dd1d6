//! Posts on the genuine BASIC II: the bot's tokeniser makes of them what ours does, and they draw
//! what they draw here.

use crate::cli::{directory, success};
use crate::peers_jsbeeb::{hex, inks, jsbeeb, layout, unhex};
use crate::toots::{MIRRORS, POSTS};
use serde_json::{Value, json};
use slowlight_vm::Stop;
use slowlight_vm::bbc::{Config, Machine};
use std::path::Path;
use std::process::Command;

#[test]
fn posts_are_tokenised_and_run_as_here() {
    let dir = directory(&[("mirrors.scn", MIRRORS)]);
    for (name, text) in POSTS {
        std::fs::write(dir.path().join(format!("{name}.scn")), text).expect("a file");
    }
    let mut jobs = Vec::new();
    let mut ours = Vec::new();
    let mut tokens = Vec::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut bot = Command::new("node");
    bot.arg(root.join("tests/peers/tokens.mjs"));
    bot.arg(root.join("target/peers/node_modules/jsbeeb"));
    let scenes = [
        ("mirrors", "120..120"),
        ("plasma", "0..5"),
        ("ball", "20..24"),
        ("julia", "8..9"),
    ];
    for (name, rows) in scenes {
        let scene = format!("{name}.scn");
        let options = ["-t", "bbc:micro", "--style", "toot", "--rows", rows];
        success(
            dir.path(),
            &[&["build", scene.as_str()][..], &options].concat(),
        );
        let read = |end: &str| std::fs::read(dir.path().join(format!("{name}.{end}")));
        let bytes = read("bbc").expect("tokens");
        let text = String::from_utf8(read("toot.txt").expect("a post")).expect("text");
        let mut machine = Machine::new(Config::default());
        machine.load_text(&text).expect("a program");
        let run = machine.run(100_000_000_000, &mut |_| true);
        assert_eq!(run.stop, Stop::Ended, "{name}");
        jobs.push(json!({"tokenised": hex(&bytes), "dump": [0x3000, 0x8000]}));
        ours.push(run);
        tokens.push(hex(&bytes));
        bot.arg(dir.path().join(format!("{name}.toot.txt")));
    }
    let output = bot
        .output()
        .expect("node is installed: see tests/peers/setup");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let made: Vec<String> = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(made, tokens);
    let results: Vec<Value> = jsbeeb(&jobs);
    for ((result, run), (name, _)) in results.iter().zip(&ours).zip(scenes) {
        let mode = match run.screen.width {
            640 => 0,
            320 if run.screen.palette.len() == 2 => 4,
            320 => 1,
            160 if run.screen.palette.len() == 4 => 5,
            _ => 2,
        };
        assert_eq!(result["stopped"], "prompt", "{name}");
        let memory = unhex(result["memory"].as_str().expect("memory"));
        let rom = inks(mode, &memory[memory.len() - (0x8000 - layout(mode).0)..]);
        // No prompt is written over the picture.
        assert!(rom == run.screen.pixels, "{name}");
    }
}
