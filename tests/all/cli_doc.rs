//! `doc`, `completions` and `man`: what there is, said of itself.

use crate::cli::{directory, names, slowlight, success};
use slowlight::command_line;
use slowlight::library::pages;
use slowlight_compiler::prelude::PRELUDE;
use slowlight_compiler::scene::check;
use std::path::Path;

#[test]
fn the_library_s_page_is_fresh() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/library.md");
    let kept = std::fs::read_to_string(path).expect("the page");
    let now = success(Path::new("."), &["doc", "--markdown"]);
    assert!(
        kept == now,
        "docs/library.md is stale: cargo run -p slowlight -- doc --markdown > docs/library.md"
    );
}

/// Every signature is what the library's files say, and all items are there that are for
/// scenes.
#[test]
fn all_items_are_told_as_they_are() {
    let words = |text: &str| text.split_whitespace().collect::<Vec<&str>>().join(" ");
    let mut items = 0;
    for page in pages() {
        let file = format!("{}.scn", page.name);
        let (_, text) = PRELUDE.iter().find(|(f, _)| *f == file).expect("a file");
        let begins = ["effect ", "shape ", "record ", "dither "];
        let told = |line: &&str| {
            let plain = line
                .rsplit_once("= ")
                .is_some_and(|(_, v)| v.starts_with(char::is_numeric));
            begins.iter().any(|b| line.starts_with(b))
                || line.starts_with("fn ") && page.name != "shapes"
                || line.starts_with("const ") && plain
        };
        let heads = text.lines().filter(told);
        let entries: Vec<_> = page.groups.iter().flat_map(|g| &g.entries).collect();
        assert_eq!(entries.len(), heads.count(), "{file}");
        let text = words(text);
        for entry in entries {
            let Some((_, behind)) = text.split_once(&entry.signature) else {
                panic!("{}", entry.signature);
            };
            let end = behind.trim_start().chars().next();
            let whole = entry.signature.starts_with("record ");
            assert!(whole || end.is_some_and(|c| "={;".contains(c)), "{entry:?}");
            items += 1;
        }
    }
    assert!(items > 100, "{items}");
    assert!(
        pages()
            .iter()
            .all(|p| p.name != "solve" && p.name != "instances")
    );
}

#[test]
fn an_item_is_told_with_its_comment() {
    let here = Path::new(".");
    let said = success(here, &["doc", "mix"]);
    assert_eq!(
        said,
        "fn mix(a: real, b: real, t: real) -> real\n\
         fn mix(a: vec2, b: vec2, t: real) -> vec2\n\
         fn mix(a: vec3, b: vec3, t: real) -> vec3\n  \
         From `a` where `t` is 0 to `b` where `t` is 1.\n  (numbers.scn)\n"
    );
    let said = success(here, &["doc", "pinhole"]);
    assert!(
        said.contains("field: angle = 60deg, aspect: real = 1) -> lens"),
        "{said}"
    );
    let said = success(here, &["doc", "fog"]);
    assert!(
        said.contains("haze: real = 0.8) -> real else v\n"),
        "{said}"
    );
    let all = success(here, &["doc"]);
    let shapes = success(here, &["doc", "shapes"]);
    assert!(all.contains(&shapes));
    assert!(
        shapes.contains("\n  shape polygon(corners: [vec3])\n"),
        "{shapes}"
    );
    for (name, part) in [
        ("spher", "no `spher`; near it: `sphere`"),
        ("shadow", "`hard_shadow`, `soft_shadow`"),
        ("qqqqqq", "`slowlight doc` lists"),
        ("roots", "no `roots`"),
    ] {
        let output = slowlight(here, &["doc", name]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains(part), "{said}");
    }
}

/// What the list has can be called: a scene's own item of the name hides it, so a scene
/// that says nothing of them has them all.
#[test]
fn records_of_the_list_are_known_to_scenes() {
    let all = pages();
    let entries = all.iter().flat_map(|p| &p.groups).flat_map(|g| &g.entries);
    let records = entries.filter(|e| e.signature.starts_with("record "));
    let uses: Vec<String> = records
        .map(|e| format!("fn take_{0}(a: {0}) -> real = 1;\n", e.name))
        .collect();
    assert!(uses.len() > 3);
    let text = format!(
        "image 4 x 4 inks black, white;\n{}draw (x, y) = ink(0);\n",
        uses.concat()
    );
    let scene = check("test", &text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
}

#[test]
fn shells_complete_every_command() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = success(Path::new("."), &["completions", shell]);
        for command in command_line().get_subcommands() {
            assert!(script.contains(command.get_name()), "{shell}: {command}");
        }
        assert!(script.contains("without-pass"), "{shell}");
        // Values, where the shell's scripts can have them.
        let values = ["bash", "zsh", "fish"].contains(&shell);
        assert_eq!(script.contains("torus-march"), values, "{shell}");
    }
    let output = slowlight(Path::new("."), &["completions", "csh"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn every_command_has_a_manual_page() {
    let dir = directory(&[]);
    let dir = dir.path();
    success(dir, &["man", "share/man1"]);
    let mut pages: Vec<String> = (command_line().get_subcommands())
        .map(|command| format!("slowlight-{}.1", command.get_name()))
        .collect();
    pages.push("slowlight.1".to_owned());
    pages.sort();
    assert_eq!(names(&dir.join("share/man1")), pages);
    let page = std::fs::read_to_string(dir.join("share/man1/slowlight-run.1"));
    let page = page.expect("a page");
    assert!(page.contains("slowlight run"), "{page}");
    assert!(page.contains("\\-\\-target"), "{page}");
    // Where a file is in the way, none is written.
    std::fs::write(dir.join("file"), "").expect("a file");
    let output = slowlight(dir, &["man", "file"]);
    assert_eq!(output.status.code(), Some(1));
}

#[test]
fn the_page_of_commands_lists_every_command() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/commands.md");
    let page = std::fs::read_to_string(path).expect("the page");
    for command in command_line().get_subcommands() {
        let row = format!("\n| `slowlight {}", command.get_name());
        assert!(page.contains(&row), "{row}");
    }
}
