//! What editors know of the language without asking, held against the compiler's lists of words:
//! the TextMate grammar, the tree-sitter grammar and its query; and that the extension's parts
//! fit together.

use serde_json::Value;
use slowlight::lsp::TYPES;
use slowlight_compiler::scene::check;
use slowlight_compiler::syntax::{ITEMS, PLACED, WORDS};
use std::collections::BTreeSet;
use std::path::Path;

fn read(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("editors")
        .join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn parsed(path: &str) -> Value {
    serde_json::from_str(&read(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

fn set<'w>(words: impl IntoIterator<Item = &'w str>) -> BTreeSet<String> {
    words.into_iter().map(str::to_owned).collect()
}

fn reserved() -> BTreeSet<String> {
    set(ITEMS.into_iter().chain(WORDS))
}

/// The words of `\b(a|b)\b` in a pattern.
fn spelt(pattern: &str) -> Vec<String> {
    let groups = pattern.split("\\b(").skip(1);
    let groups = groups.filter_map(|rest| rest.split(')').next());
    let words = groups.flat_map(|group| group.split('|'));
    let plain = words.filter(|word| {
        word.bytes()
            .all(|b| b.is_ascii_lowercase() || b.is_ascii_digit())
    });
    plain.map(str::to_owned).collect()
}

#[test]
fn the_textmate_grammar_has_the_compiler_s_words() {
    let grammar = parsed("vscode/syntaxes/slowlight.tmLanguage.json");
    let rules = &grammar["repository"];
    let words_of = |rule: &str| {
        let own = rules[rule]["match"].as_str().into_iter();
        let inner = rules[rule]["patterns"].as_array().into_iter().flatten();
        let inner = inner.filter_map(|p| p["match"].as_str());
        own.chain(inner)
            .flat_map(spelt)
            .collect::<BTreeSet<String>>()
    };
    assert_eq!(words_of("item"), set(ITEMS));
    assert_eq!(words_of("word"), set(WORDS));
    assert!(words_of("declaration").is_subset(&set(ITEMS)));
    let claims = words_of("claim");
    let one = |rule: &str, word: &str| {
        let pattern = rules[rule]["match"].as_str().expect("a pattern");
        assert!(pattern.contains(&format!("\\b{word}\\b")), "{pattern}");
        word.to_owned()
    };
    let others = [("image", "inks"), ("loop", "max"), ("spread", "to")].map(|(r, w)| one(r, w));
    let placed: BTreeSet<String> = claims.into_iter().chain(others).collect();
    assert_eq!(placed, set(PLACED));
    // Those that are reserved words as well are seen as such.
    let types = set(TYPES);
    assert_eq!(
        words_of("type"),
        types.difference(&reserved()).cloned().collect()
    );
    let included = grammar["patterns"].as_array().expect("patterns").iter();
    for rule in included.filter_map(|p| p["include"].as_str()) {
        assert!(rules.get(rule.trim_start_matches('#')).is_some(), "{rule}");
    }
}

#[test]
fn the_types_are_the_checker_s() {
    for name in TYPES {
        let ty = if name == "fn" { "fn(int) -> int" } else { name };
        let text = format!(
            "image 4 x 4 inks black, white; fn a(b: {ty}) -> int = 1; draw (x, y) = ink(0);"
        );
        let scene = check("a", &text);
        assert!(scene.is_right(), "{name}: {:?}", scene.diagnostics);
    }
}

/// Words between quotes.
fn quoted(text: &str) -> BTreeSet<String> {
    let parts = text.split('"').skip(1).step_by(2);
    set(parts.filter(|p| !p.is_empty() && p.bytes().all(|b| b.is_ascii_lowercase())))
}

fn without_comments(text: &str, mark: &str) -> String {
    let kept = text
        .lines()
        .filter(|line| !line.trim_start().starts_with(mark));
    kept.collect::<Vec<&str>>().join("\n")
}

#[test]
fn the_tree_sitter_grammar_has_the_compiler_s_words() {
    let grammar = without_comments(&read("tree-sitter-slowlight/grammar.js"), "//");
    let (_, rules) = grammar.split_once("rules: {").expect("rules");
    // Patterns have quotes of their own.
    let words = rules.lines().filter(|line| !line.contains("=> /"));
    let words: Vec<&str> = words.collect();
    // Fields' names are none of the language's.
    let mut text = String::new();
    for (k, part) in words.join("\n").split("field(\"").enumerate() {
        let rest = part.split_once("\",").map_or(part, |(_, rest)| rest);
        text += if k == 0 { part } else { rest };
    }
    let mut all = reserved();
    all.extend(set(PLACED));
    all.insert("x".to_owned());
    assert_eq!(quoted(&text), all);
    // What the query colours are rules and words of the grammar.
    let query = without_comments(&read("tree-sitter-slowlight/queries/highlights.scm"), ";");
    for node in query.split('(').skip(1) {
        let name: String = node
            .chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect();
        assert!(
            name.is_empty() || rules.contains(&format!(" {name}: (")),
            "{name}"
        );
    }
    let nodes = ["true", "false", "none", "frame", "row", "column"];
    let mut coloured = quoted(&query);
    coloured.extend(set(nodes));
    assert_eq!(coloured, all);
}

#[test]
fn the_extension_s_parts_fit_together() {
    let package = parsed("vscode/package.json");
    let code = read("vscode/extension.js");
    let parts = &package["contributes"];
    for command in parts["commands"].as_array().expect("commands") {
        let name = command["command"].as_str().expect("a name");
        assert!(code.contains(&format!("\"{name}\"")), "{name}");
    }
    for setting in parts["configuration"]["properties"]
        .as_object()
        .expect("settings")
        .keys()
    {
        let name = setting.strip_prefix("slowlight.").expect("a name of ours");
        assert!(code.contains(&format!("get(\"{name}\")")), "{name}");
    }
    for grammar in parts["grammars"].as_array().expect("grammars") {
        let path = grammar["path"].as_str().expect("a path");
        let found = parsed(&format!("vscode/{}", path.trim_start_matches("./")));
        assert_eq!(found["scopeName"], grammar["scopeName"]);
    }
    let language = &parts["languages"][0];
    assert_eq!(language["extensions"][0], ".scn");
    let about = language["configuration"].as_str().expect("a path");
    parsed(&format!("vscode/{}", about.trim_start_matches("./")));
    assert_eq!(package["version"], env!("CARGO_PKG_VERSION"));
}
