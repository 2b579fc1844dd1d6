//! The language server's edits of a scene: renames, right ones and those that must be refused,
//! and the form.

use crate::cli::{directory, success};
use crate::lsp_client::{Client, place};
use serde_json::{Value, json};

/// A scene with names of all kinds.
pub const SCENE: &str = "image 4 x 4 inks black, white;
record paint { shade: real, gloss: real }
const half = 0.5;
fn twice(a: real) -> real = 2 * a;
fn twice(a: vec3) -> vec3 = 2 * a;
fn apply(f: fn(real) -> real, v: real) -> real = f(v);
fn plain(v: real) -> real = v;
scene world { each k in 0 .. 2 { sphere((k, 0, 0), half) is p.x + k; } }
draw (x, y) = {
  let v = paint(twice(0.25) + x / 9, 0.5);
  let w = { let v = length(twice((1, 0, 0))); v };
  let n = loop (i = 0) max 3 { if i > 1 then i else next(i + 1) } else 9;
  ink(floor(apply(plain, v.shade * w * n)))
};
";

/// What a rename asks.
pub fn rename(uri: &str, place: Value, name: &str) -> Value {
    json!({"textDocument": {"uri": uri}, "position": place, "newName": name})
}

/// A text after the edits of a rename; the last first, as they do not touch.
fn renamed(text: &str, edit: &Value) -> String {
    let mut lines: Vec<String> = text.split('\n').map(str::to_owned).collect();
    let mut edits = edit["edits"].as_array().expect("edits").clone();
    edits.reverse();
    for edit in edits {
        let at = |end: &str, part: &str| {
            let value = edit["range"][end][part].as_u64().expect("a number");
            usize::try_from(value).expect("small")
        };
        let new = edit["newText"].as_str().expect("a text");
        let line = &mut lines[at("start", "line")];
        line.replace_range(at("start", "character")..at("end", "character"), new);
    }
    lines.join("\n")
}

#[test]
fn names_are_renamed_in_their_scope_or_not_at_all() {
    let cache = directory(&[]);
    let mut client = Client::start(cache.path(), Value::Null);
    let here = "untitled:a";
    client.open(here, SCENE);
    assert_eq!(client.diagnostics(here), Vec::<Value>::new());
    let good = [
        (
            "v = paint",
            0,
            "coat",
            "let coat = paint(twice(0.25) + x / 9, 0.5);",
            2,
        ),
        (
            "v = length",
            0,
            "long",
            "{ let long = length(twice((1, 0, 0))); long }",
            2,
        ),
        (
            "twice(a: vec3)",
            0,
            "double",
            "length(double((1, 0, 0)))",
            2,
        ),
        ("a: vec3", 0, "b", "fn twice(b: vec3) -> vec3 = 2 * b;", 2),
        (
            "i = 0",
            0,
            "turn",
            "loop (turn = 0) max 3 { if turn > 1 then turn else next(turn + 1) }",
            4,
        ),
        (
            "k in",
            0,
            "number",
            "each number in 0 .. 2 { sphere((number, 0, 0), half) is p.x + number; }",
            3,
        ),
        (
            "f: fn",
            0,
            "g",
            "apply(g: fn(real) -> real, v: real) -> real = g(v);",
            2,
        ),
        ("shade: real", 0, "tone", "apply(plain, v.tone * w * n)", 2),
        ("plain(v: real)", 0, "same", "apply(same, v.shade", 2),
        ("x, y", 0, "column", "draw (column, y)", 2),
        ("half", 1, "radius", "const radius = 0.5;", 2),
        ("paint(", 0, "coat", "record coat {", 2),
    ];
    for (part, nth, name, line, times) in good {
        let asked = rename(here, place(SCENE, part, nth, 0), name);
        let found = client.ask("textDocument/rename", asked);
        let edit = &found["documentChanges"][0];
        assert_eq!(
            edit["edits"].as_array().map(Vec::len),
            Some(times),
            "{part}: {found}"
        );
        let text = renamed(SCENE, edit);
        assert!(text.contains(line), "{part}: {text}");
        client.open("untitled:b", &text);
        assert_eq!(
            client.diagnostics("untitled:b"),
            Vec::<Value>::new(),
            "{part}"
        );
    }
    let bad = [
        ("sphere", 0, "ball", "library"),
        ("p.x", 0, "q", "language"),
        ("let v", 0, "w", "language"),
        ("floor", 0, "below", "language"),
        ("half", 0, "let", "is no name"),
        ("half", 0, "a b", "is no name"),
        ("half", 0, "2", "is no name"),
        ("half", 0, "twice", "means something else"),
        ("half", 0, "world", "means something else"),
        ("v = paint", 0, "n", "means something else"),
        ("plain(v", 0, "twice", "means something else"),
        ("apply(f", 0, "length", ""),
        ("0.25", 0, "a", "language"),
    ];
    for (part, nth, name, why) in bad {
        let asked = rename(here, place(SCENE, part, nth, 0), name);
        if why.is_empty() {
            client.ask("textDocument/rename", asked);
            continue;
        }
        let said = client.refused("textDocument/rename", asked);
        assert!(said.contains(why), "{part}: {said}");
    }
    let prepared = json!({"textDocument": {"uri": here}, "position": place(SCENE, "half", 1, 2)});
    let found = client.ask("textDocument/prepareRename", prepared);
    assert_eq!(found["placeholder"], "half", "{found}");
    // Where the scene has mistakes, which of two is called is not known.
    client.change(here, 2, &SCENE.replace("v.shade", "v.shadow"));
    let asked = rename(here, place(SCENE, "twice", 0, 0), "double");
    assert!(
        client
            .refused("textDocument/rename", asked)
            .contains("mistakes")
    );
    let asked = rename(here, place(SCENE, "v = length", 0, 0), "long");
    client.ask("textDocument/rename", asked);
    assert_eq!(client.stop(), Some(0));
}

#[test]
fn texts_are_formatted_as_fmt_does() {
    let cache = directory(&[]);
    let mut client = Client::start(cache.path(), Value::Null);
    let crooked = SCENE
        .replace("record paint {", "record   paint{")
        .replace("2 * a", "2*a");
    let dir = directory(&[("a.scn", &crooked)]);
    success(dir.path(), &["fmt", "a.scn"]);
    let wanted = std::fs::read_to_string(dir.path().join("a.scn")).expect("a text");
    assert_ne!(wanted, crooked);
    let here = "untitled:a";
    client.open(here, &crooked);
    let asked =
        json!({"textDocument": {"uri": here}, "options": {"tabSize": 2, "insertSpaces": true}});
    let edits = client.ask("textDocument/formatting", asked.clone());
    let of = json!({"uri": here, "version": 2});
    let edit = &edits[0];
    let change = json!([{"range": edit["range"], "text": edit["newText"]}]);
    client.tell(
        "textDocument/didChange",
        json!({"textDocument": of, "contentChanges": change}),
    );
    // What is formatted has no edits more; the server's text is what `fmt` wrote.
    assert_eq!(
        client.ask("textDocument/formatting", asked.clone()),
        json!([])
    );
    client.change(here, 3, &wanted);
    assert_eq!(
        client.ask("textDocument/formatting", asked.clone()),
        json!([])
    );
    client.change(here, 4, "draw (");
    assert_eq!(client.ask("textDocument/formatting", asked), json!([]));
    assert_eq!(client.stop(), Some(0));
}

/// What two open scenes use is not renamed for one of them alone.
#[test]
fn names_that_another_open_scene_has_are_not_renamed() {
    let user = "use \"p.scn\";\nimage 4 x 4 inks black, white;\n\
                draw (x, y) = threshold(level(), 0.5);\n";
    let part = "fn level() -> real = own(0.4);\nfn own(a: real) -> real = a;\n";
    let dir = directory(&[("p.scn", part), ("a.scn", user), ("b.scn", user)]);
    let cache = directory(&[]);
    let mut client = Client::start(cache.path(), Value::Null);
    let uri = |name: &str| format!("file://{}", dir.path().join(name).display());
    for (name, text) in [("p.scn", part), ("a.scn", user), ("b.scn", user)] {
        client.open(&uri(name), text);
    }
    assert_eq!(client.diagnostics(&uri("b.scn")), Vec::<Value>::new());
    let asked =
        |name: &str, text: &str, of: &str| rename(&uri(name), place(text, of, 0, 0), "height");
    for asked in [asked("a.scn", user, "level"), asked("p.scn", part, "level")] {
        let said = client.refused("textDocument/rename", asked);
        assert!(said.contains("has that name"), "{said}");
    }
    // What only the used text speaks of is renamed there.
    let edits = client.ask("textDocument/rename", asked("p.scn", part, "own"));
    assert!(edits.to_string().contains("p.scn"), "{edits}");
    assert_eq!(client.stop(), Some(0));
}
