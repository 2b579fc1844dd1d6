//! The language server and what is wrong, elsewhere or not there: files that use each other,
//! mistakes, messages that are none.

use crate::cli::directory;
use crate::lsp_client::{Client, place, uri};
use crate::lsp_rename::{SCENE, rename};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn files_that_use_each_other_are_one_scene() {
    let cache = directory(&[]);
    let main = "image 4 x 4 inks black, white;\nuse \"part.scn\";\ndraw (x, y) = ink(level(x));\n";
    let part = "fn level(a: int) -> int = a mod 2;\n";
    let dir = directory(&[("main.scn", main), ("part.scn", part)]);
    let [scene, used] = ["main.scn", "part.scn"].map(|name| uri(&dir.path().join(name)));
    let mut client = Client::start(cache.path(), Value::Null);
    // A file for others to use lacks nothing.
    client.open(&used, part);
    assert_eq!(client.diagnostics(&used), Vec::<Value>::new());
    client.open(&scene, main);
    assert_eq!(client.diagnostics(&scene), Vec::<Value>::new());
    // The text in the editor is what counts, not the one on the disk.
    client.change(&used, 2, "fn level(a: int) -> real = a / 2;\n");
    let said = client.diagnostics(&scene);
    assert_eq!(said.len(), 1, "{said:?}");
    client.change(&used, 3, "fn level(a: int) -> int = b;\n");
    assert_eq!(client.diagnostics(&used).len(), 1);
    client.change(&used, 4, part);
    assert_eq!(client.diagnostics(&used), Vec::<Value>::new());
    assert_eq!(client.diagnostics(&scene), Vec::<Value>::new());
    // Definitions and renames go from one to the other.
    let at = |uri: &str, place| json!({"textDocument": {"uri": uri}, "position": place});
    let found = client.ask(
        "textDocument/definition",
        at(&scene, place(main, "level", 0, 0)),
    );
    assert_eq!(found[0]["uri"], json!(used));
    let found = client.ask(
        "textDocument/definition",
        at(&scene, place(main, "part.scn", 0, 0)),
    );
    assert_eq!(found[0]["uri"], json!(used));
    let found = client.ask(
        "textDocument/rename",
        rename(&used, place(part, "level", 0, 0), "shade"),
    );
    assert_eq!(
        found["documentChanges"].as_array().map(Vec::len),
        Some(2),
        "{found}"
    );
    // What is gone shows nothing any more, and what is not there is said.
    client.tell(
        "textDocument/didClose",
        json!({"textDocument": {"uri": used}}),
    );
    std::fs::remove_file(dir.path().join("part.scn")).expect("it is removed");
    let changes = json!({"changes": [{"uri": used, "type": 3}]});
    client.tell("workspace/didChangeWatchedFiles", changes);
    let said = client.diagnostics(&scene);
    assert!(
        said[0]["message"]
            .as_str()
            .is_some_and(|m| m.contains("part.scn")),
        "{said:?}"
    );
    assert_eq!(client.stop(), Some(0));
}

/// Diagnostics are those of `check`.
#[test]
fn diagnostics_are_those_of_check() {
    let cache = directory(&[]);
    let mut client = Client::start(cache.path(), Value::Null);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut texts: Vec<String> = vec![
        SCENE
            .replace("twice(0.25)", "1 / x")
            .replace("length(", "len("),
    ];
    texts.push(SCENE.replace("v.shade", "v.shade / (x - 1)"));
    for name in ["maze", "wave"] {
        let path = root.join(format!("examples/{name}.scn"));
        texts.push(std::fs::read_to_string(path).expect("an example"));
    }
    let mut said = 0;
    for (k, text) in texts.iter().enumerate() {
        let dir = directory(&[("a.scn", text)]);
        let output = crate::cli::slowlight(dir.path(), &["check", "--quick", "--json", "a.scn"]);
        let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let lines = found["diagnostics"].as_array().expect("a list").iter();
        let mut wanted: Vec<(usize, String)> = lines
            .map(|d| {
                let line = d["line"].as_u64().expect("a line");
                let message = d["message"].as_str().expect("a text");
                (usize::try_from(line).expect("small"), message.to_owned())
            })
            .collect();
        let here = format!("untitled:{k}");
        client.open(&here, text);
        let shown = client.diagnostics(&here);
        let mut shown: Vec<(usize, String)> = shown.iter().map(line_and_message).collect();
        // What a screen makes of inks takes looking at every pixel.
        wanted.retain(|(_, message)| !message.starts_with("ink numbers"));
        wanted.sort();
        shown.sort();
        assert_eq!(shown, wanted, "{text}");
        said += shown.len();
    }
    assert!(said > 1, "{said}");
    assert_eq!(client.stop(), Some(0));
}

/// Of wrong scenes the compiler's diagnostics are shown, each at its place.
#[test]
fn wrong_scenes_show_what_the_compiler_says() {
    let cache = directory(&[]);
    let mut client = Client::start(cache.path(), Value::Null);
    let mut seen = 0;
    for part in include_str!("../wrong/scenes.txt").split("\n=== ").skip(1) {
        let (name, text) = part.split_once('\n').unwrap_or((part, ""));
        let found = slowlight_compiler::scene::check(name, text);
        let wanted: BTreeSet<(usize, String)> = found
            .diagnostics
            .iter()
            .map(|d| (found.sources.line_column(d.span).0, d.message.clone()))
            .filter(|(_, message)| !message.starts_with("the scene has no `"))
            .collect();
        // Files are looked for elsewhere.
        if text.contains("use \"") {
            continue;
        }
        let here = format!("untitled:{name}").replace(' ', "_");
        client.open(&here, text);
        let shown = client.diagnostics(&here);
        let shown: BTreeSet<(usize, String)> = shown
            .iter()
            .map(line_and_message)
            .filter(|(_, message)| !message.starts_with("the scene has no `"))
            .collect();
        assert_eq!(shown, wanted, "{name}");
        client.tell(
            "textDocument/didClose",
            json!({"textDocument": {"uri": here}}),
        );
        assert_eq!(client.diagnostics(&here), Vec::<Value>::new(), "{name}");
        seen += 1;
    }
    assert!(seen > 80, "{seen}");
    assert_eq!(client.stop(), Some(0));
}

fn line_and_message(shown: &Value) -> (usize, String) {
    let line = shown["range"]["start"]["line"].as_u64().expect("a line");
    let first = shown["message"].as_str().and_then(|m| m.lines().next());
    let line = usize::try_from(line).expect("small") + 1;
    (line, first.expect("a message").to_owned())
}

#[test]
fn what_is_no_message_ends_nothing() {
    let cache = directory(&[]);
    let mut client = Client::spawn(cache.path());
    let hover = "textDocument/hover";
    assert!(client.refused(hover, Value::Null).contains("initialize"));
    client.tell("textDocument/didOpen", json!({"textDocument": 3}));
    client.ask("initialize", json!({"capabilities": null}));
    client.refused("initialize", json!({}));
    client.raw("Content-Length: x\r\nNothing\r\n\r\n");
    let id = "{\"jsonrpc\":\"2.0\",\"id\":1.5,\"method\":\"hover\"}";
    let answer = "{\"jsonrpc\":\"2.0\",\"id\":7,\"result\":null}";
    for body in ["{{{", "[]", "", "3", id, answer] {
        client.raw(&format!("Content-Length: {}\r\n\r\n{body}", body.len()));
    }
    for params in [
        json!(null),
        json!([]),
        json!({"textDocument": {"uri": "a b"}}),
        json!("x"),
    ] {
        client.refused(hover, params);
    }
    client.refused("textDocument/semanticTokens/full", json!({}));
    let all = [
        hover,
        "textDocument/definition",
        "textDocument/completion",
        "textDocument/signatureHelp",
        "textDocument/prepareRename",
        "textDocument/documentHighlight",
    ];
    let text = "draw (x, y) = // \u{1f600}\u{e9}\n ink(\u{1f600}x)";
    for uri in [
        "file:///nowhere/\u{e9}.scn",
        "file:///%zz",
        "file:///%00",
        "git:a",
        "file://host/a.scn",
        "x",
    ] {
        client.open(uri, text);
        for line in [0, 1, 2, u32::MAX] {
            for character in [0, 3, 6, 18, 19, 20, 99, u32::MAX] {
                let place = json!({"line": line, "character": character});
                let asked = json!({"textDocument": {"uri": uri}, "position": place});
                for method in all {
                    let found = client.response(method, asked.clone());
                    assert_ne!(found["error"]["code"], -32603, "{method} {asked}: {found}");
                }
            }
        }
    }
    // Texts that are not open, changes that fit no text.
    let nowhere = json!({"textDocument": {"uri": "file:///none.scn", "version": 3},
        "contentChanges": [{"text": "a"}]});
    client.tell("textDocument/didChange", nowhere);
    client.tell(
        "textDocument/didClose",
        json!({"textDocument": {"uri": "file:///none.scn"}}),
    );
    let asked = json!({"textDocument": {"uri": "file:///none.scn"}, "position": {"line": 0, "character": 0}});
    assert_eq!(client.ask(hover, asked), Value::Null);
    let range = json!({"start": {"line": 9, "character": 9}, "end": {"line": 0, "character": 19}});
    let change = json!({"textDocument": {"uri": "git:a", "version": 2},
        "contentChanges": [{"range": range, "text": "\u{1f600}"}, {"range": range, "text": ""}]});
    client.tell("textDocument/didChange", change);
    let settings = json!({"settings": {"slowlight": {"target": "pdp8"}}});
    client.tell("workspace/didChangeConfiguration", settings);
    client.diagnostics("git:a");
    let said = client
        .told
        .iter()
        .find(|m| m["method"] == "window/showMessage");
    let said = said.expect("a warning")["params"]["message"]
        .as_str()
        .expect("a text")
        .to_owned();
    assert!(said.contains("pdp8"), "{said}");
    assert_eq!(client.stop(), Some(0));
    // An editor that is gone ends the server.
    let output = crate::cli::slowlight(Path::new("."), &["lsp"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("without `shutdown`"));
}
