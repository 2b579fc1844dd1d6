//! `doc`: what the library has.

use crate::failure::{Failure, Outcome};
use crate::library::{self, Group, Page};
use crate::say;

/// Options of `doc`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// An item, or a file of the library
    item: Option<String>,
    /// Print the whole as docs/library.md
    #[arg(long, conflicts_with = "item")]
    markdown: bool,
}

/// How many near names are told where there is none as asked for.
const NEAR: usize = 5;

/// Lists the library, or says what an item of it is.
pub fn run(args: &Args) -> Outcome<()> {
    if args.markdown {
        return say(&library::markdown());
    }
    let pages = library::pages();
    let Some(name) = &args.item else {
        let listed: Vec<String> = pages.iter().map(listed).collect();
        return say(&listed.join("\n"));
    };
    let mut found: Vec<String> = Vec::new();
    for page in &pages {
        let own = page.groups.iter().filter_map(|group| told(group, name));
        found.extend(own.map(|text| format!("{text}  ({}.scn)\n", page.name)));
    }
    found.extend(pages.iter().filter(|page| page.name == name).map(listed));
    match found.is_empty() {
        true => Err(Failure::Wrong(unknown(&pages, name))),
        false => say(&found.join("\n")),
    }
}

/// A file's items, each with the first sentence on it.
fn listed(page: &Page) -> String {
    let mut out = format!("{}.scn: {}\n", page.name, page.about.sentence());
    for group in &page.groups {
        for entry in &group.entries {
            out += &format!("  {}\n", entry.signature);
        }
        if !group.about.0.is_empty() {
            out += &format!("      {}\n", group.about.sentence());
        }
    }
    out
}

/// All that is said of the items of a name.
fn told(group: &Group, name: &str) -> Option<String> {
    let named = group.entries.iter().filter(|entry| entry.name == name);
    let mut out: String = named.map(|e| format!("{}\n", e.signature)).collect();
    if out.is_empty() {
        return None;
    }
    for line in &group.about.0 {
        out += &format!("  {line}\n");
    }
    Some(out)
}

/// That there is no such item, and what is near it, the nearest first.
fn unknown(pages: &[Page], name: &str) -> String {
    let groups = pages.iter().flat_map(|page| &page.groups);
    let entries = groups.flat_map(|group| &group.entries);
    let mut known: Vec<&str> = entries.map(|entry| entry.name.as_str()).collect();
    known.extend(pages.iter().map(|page| page.name));
    known.sort_unstable();
    known.dedup();
    let like = |known: &str| match known.split('_').any(|word| word == name) {
        true => 1.0,
        false => strsim::normalized_damerau_levenshtein(name, known),
    };
    let mut near: Vec<(f64, &str)> = known.iter().map(|k| (like(k), *k)).collect();
    near.retain(|(like, _)| *like >= 0.5);
    near.sort_by(|a, b| b.0.total_cmp(&a.0));
    let near: Vec<String> = (near.iter().take(NEAR))
        .map(|(_, name)| format!("`{name}`"))
        .collect();
    match near.is_empty() {
        true => format!("the library has no `{name}`; `slowlight doc` lists what it has"),
        false => format!("the library has no `{name}`; near it: {}", near.join(", ")),
    }
}
