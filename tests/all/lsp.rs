//! The language server, driven over its standard input and output: a script of what an editor
//! asks.

use crate::cli::{directory, success};
use crate::lsp_client::{Client, behind, place, uri};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;

const SCENE: &str = "// A ball; \u{1f600}
image 24 x 16 inks black, grey, white;
param light: vec3 = (-1, 1, 1) in (-2, 0, 0.5) .. (2, 2, 2);
record paint { shade: real, gloss: real }
// How bright a hit is.
effect shine(h: hit, lit: real = 1) -> real else 0.5 = lit * max(dot(h.normal, unit(light)), 0);
fn twice(a: real) -> real = 2 * a;
fn twice(a: vec3) -> vec3 = 2 * a;
scene world { sphere((0, 0, 0), 1) is 0.5 + p.x / 8; }
draw (x, y) = {
  let coat = paint(0.25, 0.5);
  /* let r = ray((0, 0, 3), unit(((x - 11.5) / 12, (7.5 - y) / 12, -1.5)));
  let v = if let h = world.trace(r, far: 9) then shine(h, lit: twice(0.5)) else coat.shade;
  threshold(v, bayer(2)[x mod 2, y mod 2])
};
";

/// The scene without what cannot be read.
fn scene() -> String {
    SCENE.replace("/* ", "")
}

fn at(uri: &str, place: Value) -> Value {
    json!({"textDocument": {"uri": uri}, "position": place})
}

fn hover(client: &mut Client, uri: &str, place: Value) -> String {
    let found = client.ask("textDocument/hover", at(uri, place));
    found["contents"]["value"].as_str().unwrap_or("").to_owned()
}

#[test]
fn an_editor_is_served() {
    let cache = directory(&[]);
    let text = scene();
    let dir = directory(&[("ball.scn", &text)]);
    let ball = uri(&dir.path().join("ball.scn"));
    let mut client = Client::start(cache.path(), Value::Null);

    // Diagnostics come with their places, and go.
    client.open(&ball, SCENE);
    let wrong = client.diagnostics(&ball);
    assert_eq!(wrong.len(), 1, "{wrong:?}");
    assert_eq!(wrong[0]["range"]["start"], place(SCENE, "/*", 0, 0));
    assert_eq!(wrong[0]["severity"], 1);
    assert!(
        wrong[0]["message"]
            .as_str()
            .is_some_and(|m| m.contains("help: "))
    );
    let cut = json!({"start": place(SCENE, "/*", 0, 0), "end": place(SCENE, "let r", 0, 0)});
    let change = json!([{"range": cut, "text": ""}]);
    let of = json!({"uri": ball, "version": 2});
    client.tell(
        "textDocument/didChange",
        json!({"textDocument": of, "contentChanges": change}),
    );
    assert_eq!(client.diagnostics(&ball), Vec::<Value>::new());
    assert_eq!(client.versions[&ball], 2);

    // What stands there.
    let of_shine = hover(&mut client, &ball, place(&text, "shine(h, lit", 0, 1));
    assert!(
        of_shine.contains("effect shine(h: hit, lit: real = 1) -> real else 0.5"),
        "{of_shine}"
    );
    assert!(of_shine.contains("How bright a hit is."), "{of_shine}");
    let of_r = hover(&mut client, &ball, place(&text, "trace(r", 0, 6));
    assert!(of_r.contains("let r: ray"), "{of_r}");
    let of_sphere = hover(&mut client, &ball, place(&text, "sphere", 0, 0));
    let said = success(Path::new("."), &["doc", "sphere"]);
    let first = said.lines().next().expect("a line");
    assert!(
        of_sphere.contains(first) && of_sphere.contains("shapes.scn"),
        "{of_sphere}"
    );
    let of_trace = hover(&mut client, &ball, place(&text, "trace", 0, 0));
    assert!(of_trace.contains("far: real = .."), "{of_trace}");
    let of_part = hover(&mut client, &ball, place(&text, "(x - 11.5)", 0, 3));
    assert!(of_part.contains("real"), "{of_part}");
    assert!(
        of_part.contains("changes with: column; -11.5 to 11.5"),
        "{of_part}"
    );

    // Where it is declared.
    let to = |client: &mut Client, place| {
        let found = client.ask("textDocument/definition", at(&ball, place));
        assert_eq!(found.as_array().map(Vec::len), Some(1), "{found}");
        found[0].clone()
    };
    let local = to(&mut client, place(&text, "shine(h, lit", 0, 6));
    assert_eq!(local["range"]["start"], place(&text, "let h", 0, 4));
    let chosen = to(&mut client, place(&text, "twice(0.5)", 0, 0));
    assert_eq!(
        chosen["range"]["start"],
        place(&text, "twice(a: real)", 0, 0)
    );
    let field = to(&mut client, place(&text, "coat.shade", 0, 5));
    assert_eq!(field["range"]["start"], place(&text, "shade: real", 0, 0));
    let label = to(&mut client, place(&text, "lit: twice", 0, 0));
    assert_eq!(label["range"]["start"], place(&text, "lit: real", 0, 0));
    let library = to(&mut client, place(&text, "sphere", 0, 2));
    let shapes = library["uri"].as_str().expect("an address").to_owned();
    let path = shapes.strip_prefix("file://").expect("a file");
    let kept = std::fs::read_to_string(path).expect("the library's text");
    let line = library["range"]["start"]["line"].as_u64().expect("a line");
    let line = kept
        .lines()
        .nth(usize::try_from(line).expect("small"))
        .expect("a line");
    assert!(line.starts_with("shape sphere("), "{line}");

    // The library's text is served, too, and nothing is wrong with it.
    client.open(&shapes, &kept);
    let of_unit = hover(&mut client, &shapes, place(&kept, "unit(", 0, 0));
    assert!(of_unit.contains("vectors.scn"), "{of_unit}");
    assert_eq!(client.diagnostics(&shapes), Vec::<Value>::new());

    // All places of a name.
    let context = json!({"includeDeclaration": true});
    let mut asked = at(&ball, place(&text, "light", 0, 0));
    asked["context"] = context;
    let found = client.ask("textDocument/references", asked);
    assert_eq!(found.as_array().map(Vec::len), Some(2), "{found}");
    let found = client.ask(
        "textDocument/documentHighlight",
        at(&ball, place(&text, "let v", 0, 4)),
    );
    assert_eq!(found.as_array().map(Vec::len), Some(2), "{found}");

    // The outline.
    let found = client.ask(
        "textDocument/documentSymbol",
        json!({"textDocument": {"uri": ball}}),
    );
    let names = found
        .as_array()
        .expect("a list")
        .iter()
        .map(|s| s["name"].as_str());
    let names: Vec<&str> = names.map(|n| n.expect("a name")).collect();
    let all = [
        "image", "light", "paint", "shine", "twice", "twice", "world", "draw",
    ];
    assert_eq!(names, all);
    assert_eq!(client.stop(), Some(0));
}

#[test]
fn what_is_being_written_is_completed() {
    let cache = directory(&[]);
    let mut client = Client::start(cache.path(), Value::Null);
    let text = scene();
    // Not saved: there is no file.
    let here = "untitled:Untitled-1";
    client.open(here, &text);
    let mut version = 1;
    let mut offered = |client: &mut Client, from: &str, to: &str, on: &str| {
        let text = scene().replacen(from, to, 1);
        version += 1;
        client.change(here, version, &text);
        let found = client.ask("textDocument/completion", at(here, behind(&text, on)));
        let all = found.as_array().cloned().unwrap_or_default();
        let all = all
            .into_iter()
            .map(|i| (i["label"].as_str().expect("a label").to_owned(), i));
        all.collect::<BTreeMap<String, Value>>()
    };
    let has = |found: &BTreeMap<String, Value>, names: &[&str]| {
        for name in names {
            assert!(found.contains_key(*name), "no {name} in {:?}", found.keys());
        }
    };
    let found = offered(
        &mut client,
        "threshold(v, bayer(2)[x mod 2, y mod 2])",
        "thr",
        "  thr",
    );
    has(
        &found,
        &[
            "threshold",
            "v",
            "coat",
            "x",
            "light",
            "world",
            "shine",
            "mix",
            "if",
            "inks",
        ],
    );
    assert!(!found.contains_key("h"), "h is not in sight");
    let detail = found["threshold"]["detail"].as_str().expect("a head");
    assert!(
        detail.starts_with("fn threshold(v: real, d: real) -> ink"),
        "{detail}"
    );
    assert_eq!(found["coat"]["detail"], "let coat: paint");
    let found = offered(&mut client, "coat.shade", "coat.", "coat.");
    assert_eq!(found.len(), 2, "{:?}", found.keys());
    has(&found, &["shade", "gloss"]);
    let found = offered(&mut client, "shine(h, lit", "shine(h.n, lit", "shine(h.n");
    has(&found, &["point", "normal", "tag", "shine"]);
    let found = offered(&mut client, "world.trace(r, far: 9)", "world.", "= world.");
    has(&found, &["trace", "blocked", "dist"]);
    let found = offered(&mut client, "far: 9", "f", "trace(r, f");
    has(&found, &["floor", "fog", "far:"]);
    let found = offered(&mut client, "shine(h, lit", "shine(h, l", "shine(h, l");
    has(&found, &["lit:", "light"]);
    let found = offered(&mut client, "-> real =", "-> r =", "a: real) -> r");
    has(&found, &["real", "ray", "paint", "lens"]);
    assert!(!found.contains_key("if"));
    let found = offered(&mut client, "inks black, grey", "inks black, g", "black, g");
    has(&found, &["grey", "green"]);
    assert!(!found.contains_key("light"));
    let found = offered(&mut client, "scene world", "p\nscene world", "a;\np");
    has(&found, &["param"]);
    assert!(!found.contains_key("light"));
    assert!(offered(&mut client, "// A ball", "// A li ball", "// A li").is_empty());

    // The heads of what is called.
    version += 1;
    client.change(here, version, &text);
    let found = client.ask(
        "textDocument/signatureHelp",
        at(here, place(&text, "lit: twice", 0, 0)),
    );
    assert_eq!(found["activeParameter"], 1, "{found}");
    let label = found["signatures"][0]["label"].as_str().expect("a label");
    assert!(label.starts_with("effect shine("), "{label}");
    let found = client.ask(
        "textDocument/signatureHelp",
        at(here, place(&text, "far: 9", 0, 0)),
    );
    assert_eq!(found["activeParameter"], 2, "{found}");
    assert_eq!(client.stop(), Some(0));
}
