//! What the library has: signatures by the compiler's own parser, with the comments before them.

use slowlight_compiler::prelude::PRELUDE;
use slowlight_compiler::syntax::parse;
use slowlight_compiler::syntax::tree::{Binding, ExprKind, File, Item, ItemKind};

/// Files that only the compiler calls.
const INNER: [&str; 3] = ["solve.scn", "instances.scn", "inside.scn"];

/// A file whose functions are for its shapes' own use.
const SHAPES: &str = "shapes.scn";

/// A file of the library.
#[derive(Debug)]
pub struct Page {
    /// Its name without `.scn`.
    pub name: &'static str,
    /// What its head says.
    pub about: Comment,
    /// Its items, as they stand together.
    pub groups: Vec<Group>,
}

/// Items without an empty line between them: the comment before the first is of all.
#[derive(Debug, Default)]
pub struct Group {
    /// What the comment says.
    pub about: Comment,
    /// The items, of one name or several.
    pub entries: Vec<Entry>,
}

/// An item.
#[derive(Debug)]
pub struct Entry {
    /// What scenes call it by.
    pub name: String,
    /// Its head as written, on one line.
    pub signature: String,
}

/// A comment's lines, without the marks before them.
#[derive(Clone, Debug, Default)]
pub struct Comment(pub Vec<String>);

impl Comment {
    /// All of it on one line.
    pub fn text(&self) -> String {
        self.0.join(" ")
    }

    /// Its first sentence.
    pub fn sentence(&self) -> String {
        let text = self.text();
        let mut ends = text.match_indices(". ").map(|(at, _)| at + 1);
        let begins = |end: &usize| {
            let next = text[*end..].trim_start().chars().next();
            next.is_some_and(|c| c.is_uppercase() || c == '`')
        };
        let end = ends.find(begins).unwrap_or(text.len());
        text[..end].to_owned()
    }

    /// The lines right before the end of a text.
    fn before(text: &str) -> Comment {
        let lines = text.lines().rev();
        let marked = lines.map_while(|line| line.strip_prefix("//"));
        let mut lines: Vec<String> = marked.map(|line| line.trim().to_owned()).collect();
        lines.reverse();
        Comment(lines)
    }
}

/// Whether only the compiler calls what a file of the library has.
pub fn is_inner(file: &str) -> bool {
    INNER.contains(&file)
}

/// The library for those who write scenes, file by file.
pub fn pages() -> Vec<Page> {
    let outer = PRELUDE.iter().filter(|(file, _)| !is_inner(file));
    outer.map(|(file, text)| page(file, text)).collect()
}

fn page(file: &'static str, text: &str) -> Page {
    let head: Vec<&str> = (text.lines().take_while(|line| line.starts_with("//"))).collect();
    let mut page = Page {
        name: file.strip_suffix(".scn").unwrap_or(file),
        about: Comment::before(&head.join("\n")),
        groups: Vec::new(),
    };
    let (tree, _) = parse(text, 0);
    for (about, items) in groups(&tree, text) {
        let own = |item: &Item| file == SHAPES && matches!(item.kind, ItemKind::Fn(_));
        let scenes = items.into_iter().filter(|item| !own(item));
        page.groups.push(Group {
            about,
            entries: scenes.filter_map(|item| entry(item, text)).collect(),
        });
    }
    page.groups.retain(|group| !group.entries.is_empty());
    page
}

/// The items of a file as they stand together, with the comments before them.
pub fn groups<'t>(tree: &'t File, text: &str) -> Vec<(Comment, Vec<&'t Item>)> {
    let mut found: Vec<(Comment, Vec<&Item>)> = Vec::new();
    let mut end = 0;
    for item in &tree.items {
        let start = item.span.start as usize;
        let between = text.get(end..start).unwrap_or_default();
        end = item.span.end as usize;
        // After its semicolon.
        let apart = between.trim_matches(|c| c != '\n') != "\n";
        match found.last_mut() {
            Some((_, items)) if !apart => items.push(item),
            _ => found.push((Comment::before(between), vec![item])),
        }
    }
    found
}

/// The comment right before an item, or else behind it on its line.
pub fn comment(text: &str, item: &Item) -> Comment {
    let before = text.get(..item.span.start as usize).unwrap_or_default();
    let before = Comment::before(before.trim_end_matches([' ', '\t']));
    let behind = text.get(item.span.end as usize..).unwrap_or_default();
    let line = behind.lines().next().unwrap_or_default();
    match line.trim_start_matches([';', ' ']).strip_prefix("//") {
        Some(behind) if before.0.is_empty() => Comment(vec![behind.trim().to_owned()]),
        _ => before,
    }
}

/// An item's name and head; none of what no scene needs.
pub fn entry(item: &Item, text: &str) -> Option<Entry> {
    let to = |end: u32| part(text, item.span.start, end);
    let end = |binding: &Binding| {
        let default = binding.default.as_ref();
        default.map_or(binding.ty.span, |value| value.span).end
    };
    let (name, signature) = match &item.kind {
        ItemKind::Fn(function) | ItemKind::Dither(function) => {
            (&function.name, to(function.result.span.end))
        }
        ItemKind::Effect {
            function,
            otherwise,
        } => (&function.name, to(otherwise.span.end)),
        ItemKind::Shape { name, params, .. } => {
            let head = params.last().map(|last| to(end(last)) + ")");
            (name, head.unwrap_or_else(|| to(name.span.end)))
        }
        ItemKind::Record { name, .. } => (name, to(item.span.end)),
        // Tables and what hangs on the format are for the file's own use.
        ItemKind::Const { name, value } => match value.kind {
            ExprKind::Int(_) | ExprKind::Real(_) | ExprKind::Angle(..) => {
                (name, to(value.span.end))
            }
            _ => return None,
        },
        _ => return None,
    };
    Some(Entry {
        name: name.text.clone(),
        signature,
    })
}

/// A part of a text on one line.
fn part(text: &str, start: u32, end: u32) -> String {
    let part = text.get(start as usize..end as usize).unwrap_or_default();
    let words: Vec<&str> = part.split_whitespace().collect();
    words.join(" ")
}

/// The library as a document.
pub fn markdown() -> String {
    let mut out = String::from(
        "# The library\n\
         What scenes can call without a `use`, file by file of \
         [compiler/prelude](../compiler/prelude); what the language itself has is in \
         [language.md](language.md). `slowlight doc ITEM` says it of one, and \
         `slowlight doc --markdown` writes this page.\n",
    );
    for page in pages() {
        out += &format!("\n## {}\n", page.name);
        if !page.about.0.is_empty() {
            out += &format!("{}\n", page.about.text());
        }
        for group in &page.groups {
            let signatures = group.entries.iter().map(|e| e.signature.as_str());
            let signatures: Vec<&str> = signatures.collect();
            out += &format!("\n```\n{}\n```\n", signatures.join("\n"));
            if !group.about.0.is_empty() {
                out += &format!("{}\n", group.about.text());
            }
        }
    }
    out
}
