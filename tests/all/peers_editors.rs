//! What editors make of `editors/`: Visual Studio Code's own library colours all scenes, its
//! packer packs the extension, and tree-sitter reads every scene and the library by the parser that
//! is kept with its grammar.

use crate::cli::directory;
use serde_json::Value;
use slowlight_compiler::syntax::{ITEMS, WORDS};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Runs a tool that must succeed.
fn run(command: &mut Command) -> Output {
    let output = command
        .output()
        .unwrap_or_else(|e| panic!("{command:?}: {e}: run tests/peers/setup"));
    let said = [&output.stdout[..], &output.stderr[..]].concat();
    let said = String::from_utf8_lossy(&said);
    assert!(output.status.success(), "{command:?}: {said}");
    output
}

/// The examples and the library.
fn scenes() -> Vec<PathBuf> {
    let mut all = Vec::new();
    for folder in [
        "examples",
        "examples/hard",
        "compiler/prelude",
        "compiler/syntax/src/tests/scenes",
        "tests/scenes",
        "tests/fragile",
    ] {
        let entries = std::fs::read_dir(root().join(folder)).expect("a folder");
        let paths = entries.map(|entry| entry.expect("an entry").path());
        all.extend(paths.filter(|path| path.extension().is_some_and(|e| e == "scn")));
    }
    all.sort();
    assert!(all.len() > 40, "{}", all.len());
    all
}

/// The files of a folder, copied to where tools may write beside them.
fn copied(folder: &str, to: &Path) {
    std::fs::create_dir_all(to).expect("a folder");
    for entry in std::fs::read_dir(root().join(folder)).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_owned();
        match path.is_dir() {
            true if name == "node_modules" => {}
            true => copied(path.to_str().expect("a path"), &to.join(name)),
            false => drop(std::fs::copy(&path, to.join(name)).expect("a copy")),
        }
    }
}

#[test]
fn the_textmate_grammar_colours_all_scenes() {
    let words: Vec<&str> = ITEMS.into_iter().chain(WORDS).collect();
    let mut node = Command::new("node");
    node.arg(root().join("tests/peers/textmate.mjs"))
        .arg(words.join(","));
    let output = run(node.args(scenes()));
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(found["wrong"], Value::Array(Vec::new()));
    assert!(found["seen"].as_u64() > Some(10_000), "{}", found["seen"]);
}

#[test]
fn the_extension_packs() {
    let dir = directory(&[]);
    let own = dir.path().join("vscode");
    copied("editors/vscode", &own);
    // What it depends on is as npm gave it.
    let modules = root().join("target/peers/node_modules");
    let vsce = modules.join("@vscode/vsce/vsce");
    let pack = [
        "package",
        "--no-dependencies",
        "--allow-missing-repository",
        "--skip-license",
        "-o",
        "own.vsix",
    ];
    run(Command::new("node").arg(vsce).args(pack).current_dir(&own));
    let packed = std::fs::read(own.join("own.vsix")).expect("a package");
    let has = |name: &str| {
        packed
            .windows(name.len())
            .any(|part| part == name.as_bytes())
    };
    for name in [
        "extension/extension.js",
        "extension/syntaxes/slowlight.tmLanguage.json",
    ] {
        assert!(has(name), "{name}");
    }
    // The client that it asks for is the one whose interface it uses.
    let about = modules.join("vscode-languageclient/package.json");
    let about = std::fs::read_to_string(about).expect("run tests/peers/setup");
    let about: Value = serde_json::from_str(&about).expect("JSON");
    let package = std::fs::read_to_string(own.join("package.json")).expect("a package");
    let package: Value = serde_json::from_str(&package).expect("JSON");
    assert_eq!(
        package["dependencies"]["vscode-languageclient"],
        about["version"]
    );
}

const GRAMMAR: &str = "editors/tree-sitter-slowlight";

/// The parser that is kept with the grammar is made by a tool that the tests go without: what the
/// tool has noted of the grammar beside the parser is held to the grammar instead.
#[test]
fn the_parser_is_of_this_tree_sitter_grammar() {
    let script = root().join("tests/peers/grammar.mjs");
    let output = run(Command::new("node").arg(script).arg(root().join(GRAMMAR)));
    let wrong: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let none = Value::Array(Vec::new());
    assert_eq!(wrong, none, "make the parser anew: {GRAMMAR}/README.md");
}

#[test]
fn tree_sitter_reads_all_scenes() {
    let dir = directory(&[("wrong.scn", "draw (x, y) = ink(;\n")]);
    let tool = dir.path().join("tree_sitter");
    let mut cc = Command::new("cc");
    cc.args(["-std=c11", "-Wall", "-Werror", "-o"]).arg(&tool);
    cc.arg(root().join("tests/peers/tree_sitter.c"));
    cc.arg(root().join(GRAMMAR).join("src/parser.c"));
    run(cc.arg("-ltree-sitter"));
    let parse = || {
        let mut command = Command::new(&tool);
        command.arg(root().join(GRAMMAR).join("queries/highlights.scm"));
        command
    };
    // Fails where a tree has an error.
    let output = run(parse().args(scenes()));
    let counts = String::from_utf8_lossy(&output.stdout).into_owned();
    for line in counts.lines() {
        assert!(!line.ends_with(" 0"), "never captured: {line}");
    }
    assert!(counts.lines().any(|line| line.starts_with("keyword ")));
    let output = parse().arg(dir.path().join("wrong.scn")).output();
    let output = output.expect("it runs");
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("wrong.scn:1:18: not understood"), "{said}");
}
