//! The language server while a scene is edited: edits at random, and figures behind lines.

use crate::cli::{directory, json as run_json, slowlight};
use crate::lsp_client::{Client, place, uri};
use proptest::prelude::Rng as _;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use serde_json::{Value, json};
use std::path::Path;

/// How many edits are made.
const EDITS: usize = 1000;

/// What is put in: pieces of scenes, and what is none.
const PIECES: [&str; 23] = [
    "(",
    ")",
    "{",
    "}",
    "let ",
    " = ",
    ";",
    "\n",
    "draw (x, y) = ",
    "fn f(a: real) -> real = a;",
    "\u{1f600}",
    "\u{e9}",
    "0.5",
    "x",
    ".",
    ",",
    "if ",
    " then ",
    " else ",
    "// ",
    "\"",
    "sphere((0, 0, 0), 1)",
    "use \"b.scn\";",
];

struct Dice(TestRng);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.0.next_u64() % n.max(1) as u64).expect("small")
    }
}

/// A scene's text as the test keeps it, by characters.
fn edit(text: &mut Vec<char>, dice: &mut Dice) -> (Value, String) {
    let start = dice.below(text.len() + 1);
    let end = (start + dice.below(12)).min(text.len());
    let end = if dice.below(3) == 0 { end } else { start };
    let new = PIECES[dice.below(PIECES.len())];
    let before: String = text[..start].iter().collect();
    let until: String = text[..end].iter().collect();
    let place = |text: &str| {
        let lines: Vec<&str> = text.split('\n').collect();
        let last = lines.last().copied().unwrap_or("");
        json!({"line": lines.len() - 1, "character": last.encode_utf16().count()})
    };
    let range = json!({"start": place(&before), "end": place(&until)});
    text.splice(start..end, new.chars());
    (range, new.to_owned())
}

/// After any edits the server says what a server says that was given their result at once.
#[test]
fn edits_at_random_come_to_what_their_result_is() {
    let cache = directory(&[]);
    let mut client = Client::start(cache.path(), Value::Null);
    let config = Config::default();
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut dice = Dice(TestRunner::new_with_rng(config, rng).new_rng());
    let scene = std::fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/primitives.scn"),
    );
    let scene = scene.expect("an example");
    let mut text: Vec<char> = scene.chars().collect();
    let here = "untitled:edited";
    client.open(here, &scene);
    for k in 0..EDITS {
        // Now and then it is a scene again.
        if k % 40 == 39 {
            text = scene.chars().collect();
            client.change(here, 2, &scene);
        }
        let (range, new) = edit(&mut text, &mut dice);
        let of = json!({"uri": here, "version": k});
        let change = json!([{"range": range, "text": new}]);
        client.tell(
            "textDocument/didChange",
            json!({"textDocument": of, "contentChanges": change}),
        );
        if k % 25 == 0 {
            let at = json!({"textDocument": {"uri": here}, "position": range["start"]});
            for method in [
                "textDocument/hover",
                "textDocument/completion",
                "textDocument/signatureHelp",
            ] {
                client.ask(method, at.clone());
            }
        }
        if k % 100 == 99 {
            let shown = client.diagnostics(here);
            let whole: String = text.iter().collect();
            let fresh = format!("untitled:fresh{k}");
            client.open(&fresh, &whole);
            let said = json!(client.diagnostics(&fresh))
                .to_string()
                .replace(&fresh, here);
            assert_eq!(said, json!(shown).to_string(), "{whole}");
        }
    }
    let shown = client.diagnostics(here);
    assert_eq!(client.stop(), Some(0));
    let mut fresh = Client::start(cache.path(), Value::Null);
    let whole: String = text.iter().collect();
    fresh.open(here, &whole);
    assert_eq!(fresh.diagnostics(here), shown, "{whole}");
    assert_eq!(fresh.stop(), Some(0));
}

/// The lines and cycles that hints show; none until there are any.
fn hints(client: &mut Client, uri: &str) -> Vec<(u64, String)> {
    let range = json!({"start": {"line": 0, "character": 0}, "end": {"line": 999, "character": 0}});
    let asked = json!({"textDocument": {"uri": uri}, "range": range});
    let found = client.ask("textDocument/inlayHint", asked);
    let hint = |hint: &Value| {
        let line = hint["position"]["line"].as_u64().expect("a line");
        (line, hint["label"].as_str().expect("a label").to_owned())
    };
    found
        .as_array()
        .map_or(Vec::new(), |all| all.iter().map(hint).collect())
}

/// Waits until the server says that it has other hints.
fn refreshed(client: &mut Client) {
    while client.next()["method"] != "workspace/inlayHint/refresh" {}
}

#[test]
fn figures_behind_lines_are_those_of_explain() {
    let cache = directory(&[]);
    let text = "image 32 x 16 inks black, white;
param shift: real = 0.1 in 0 .. 4;

effect bright(v: real) -> real else 0 = sin(v * 1rad);
draw (x, y) = {
  let a = y / 8; // rows
  ink(floor(2 * bright((x + shift) / 9 + a)))
};
";
    let dir = directory(&[("a.scn", text)]);
    let here = uri(&dir.path().join("a.scn"));
    let wanted = |target: &str| {
        let found = run_json(dir.path(), &["explain", "a.scn", "--json", "-t", target]);
        let unit = found["unit"].as_str().expect("a unit").to_owned();
        let lines = found["lines"].as_array().expect("lines").iter();
        let lines = lines.filter(|line| line["cycles"] != 0).map(|line| {
            let cycles = line["cycles"].as_u64().expect("cycles");
            let share = 100.0 * line["share"].as_f64().expect("a share");
            let label = format!("{} {unit}, {share:.1}%", grouped(cycles));
            (line["line"].as_u64().expect("a line") - 1, label)
        });
        lines.collect::<Vec<(u64, String)>>()
    };
    let mut client = Client::start(cache.path(), json!({"target": "6502:plain"}));
    client.open(&here, text);
    assert_eq!(hints(&mut client, &here), []);
    refreshed(&mut client);
    let first = wanted("6502:plain");
    assert!(first.len() > 3, "{first:?}");
    assert_eq!(hints(&mut client, &here), first);
    // While it is edited they are marked, and go with their lines.
    let edit = json!({"textDocument": {"uri": here, "version": 2}, "contentChanges": [
        {"range": {"start": place(text, "param", 0, 0), "end": place(text, "param", 0, 0)}, "text": "\n"}
    ]});
    client.tell("textDocument/didChange", edit);
    let old: Vec<(u64, String)> = first
        .iter()
        .map(|(line, label)| {
            (
                if *line > 0 { line + 1 } else { 0 },
                format!("old: {label}"),
            )
        })
        .collect();
    assert_eq!(hints(&mut client, &here), old);
    // Then they are measured again.
    refreshed(&mut client);
    let moved: Vec<(u64, String)> = first
        .iter()
        .map(|(line, label)| (if *line > 0 { line + 1 } else { 0 }, label.clone()))
        .collect();
    assert_eq!(hints(&mut client, &here), moved);
    // On another machine they are its own.
    client.change(&here, 3, text);
    client.tell(
        "workspace/didChangeConfiguration",
        json!({"settings": {"slowlight": {"target": "jack"}}}),
    );
    refreshed(&mut client);
    assert_eq!(hints(&mut client, &here), wanted("jack"));
    client.tell(
        "workspace/didChangeConfiguration",
        json!({"settings": {"slowlight": {"target": ""}}}),
    );
    assert_eq!(hints(&mut client, &here), []);
    assert_eq!(client.stop(), Some(0));
    assert_eq!(
        slowlight(dir.path(), &["check", "a.scn", "--quick"])
            .status
            .code(),
        Some(0)
    );
}

fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}
