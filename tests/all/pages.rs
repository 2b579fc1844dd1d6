//! The front page and the book: short enough, complete, and what they tell to type is understood.

use slowlight::command_line;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

/// The pages of the book's folder, the table of contents left out.
fn pages() -> Vec<PathBuf> {
    let mut pages = Vec::new();
    for folder in ["docs", "docs/design"] {
        let entries = std::fs::read_dir(root().join(folder)).expect("docs");
        pages.extend(entries.map(|entry| entry.expect("an entry").path()));
    }
    pages.retain(|page| page.extension().is_some_and(|e| e == "md"));
    pages.retain(|page| !page.ends_with("SUMMARY.md"));
    pages.sort();
    pages
}

/// Where the links of a text lead, as they are written.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let ends = text.split("](").skip(1);
    ends.filter_map(|rest| rest.split(')').next())
}

#[test]
fn the_front_page_is_short() {
    let lines = read(&root().join("README.md")).lines().count();
    assert!(lines <= 120, "{lines} lines");
}

#[test]
fn the_book_has_every_page_once() {
    let docs = root().join("docs");
    let summary = read(&docs.join("SUMMARY.md"));
    let mut listed = BTreeSet::new();
    for link in links(&summary) {
        let page = docs.join(link);
        assert!(page.exists(), "SUMMARY.md: {link}");
        assert!(listed.insert(page), "SUMMARY.md has {link} twice");
    }
    for page in pages() {
        assert!(listed.contains(&page), "not in SUMMARY.md: {page:?}");
    }
    let book = read(&root().join("book.toml"));
    assert!(book.contains("src = \"docs\""), "{book}");
}

/// What a heading is called behind a `#`, as GitHub and mdbook make it.
fn slug(heading: &str) -> String {
    let kept = heading.trim().to_lowercase();
    let kept = kept.chars().filter_map(|c| match c {
        ' ' => Some('-'),
        c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
        _ => None,
    });
    kept.collect()
}

#[test]
fn links_to_headings_lead_to_headings() {
    let mut all = pages();
    all.extend(["README.md", "ARCHITECTURE.md"].map(|page| root().join(page)));
    let mut found = 0;
    for page in all {
        let text = read(&page);
        for link in links(&text).filter(|link| !link.contains("://")) {
            let Some((file, heading)) = link.split_once('#') else {
                continue;
            };
            let to = match file {
                "" => page.clone(),
                file => page.with_file_name(file),
            };
            let text = read(&to);
            let mut headings = text.lines().filter(|line| line.starts_with('#'));
            let named = headings.any(|line| slug(line.trim_start_matches('#')) == heading);
            assert!(named, "{}: {link}", page.display());
            found += 1;
        }
    }
    assert!(found > 3, "{found}");
}

/// Command lines in a page's blocks of code, without what starts the program.
fn commands(text: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let mut code = false;
    for line in text.lines() {
        if line.starts_with("```") {
            code = !code;
        }
        let line = line.trim().trim_start_matches("$ ");
        let starts = ["slowlight ", "cargo run --release -- "];
        let Some(rest) = starts.iter().find_map(|s| line.strip_prefix(s)) else {
            continue;
        };
        let rest = rest.split([';', '|', '>', '&', '\\']).next();
        if let Some(words) = rest.filter(|_| code).and_then(shlex::split) {
            let words = words.into_iter().take_while(|w| !w.starts_with('#'));
            found.push(words.collect());
        }
    }
    found
}

#[test]
fn what_pages_say_to_type_is_understood() {
    let mut all = pages();
    all.push(root().join("README.md"));
    let mut found = 0;
    for page in all {
        for words in commands(&read(&page)) {
            let line = std::iter::once("slowlight".to_owned()).chain(words.clone());
            // Words in capitals, and a shell's variables, stand for something.
            let capitals = |w: &String| w.len() > 1 && w.chars().all(|c| c.is_ascii_uppercase());
            let open = |w: &String| capitals(w) || w.contains('$');
            if words.iter().any(open) {
                continue;
            }
            if let Err(why) = command_line().try_get_matches_from(line) {
                panic!("{}: {}\n{why}", page.display(), words.join(" "));
            }
            found += 1;
        }
    }
    assert!(found > 20, "{found}");
}
