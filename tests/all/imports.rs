//! Imports between files: no circles but of a module with its own children, and no arrow up
//! between the compiler's folders.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use syn::visit::Visit;

/// The compiler's folders, the lowest first: each imports from those before it only.
const FLOORS: [&str; 18] = [
    "fuel",
    "prelude",
    "ir",
    "sema",
    "scene",
    "analysis",
    "eval",
    "targets",
    "schedule",
    "passes",
    "selection",
    "plan",
    "homes",
    "cost",
    "wordlength",
    "planner",
    "backend",
    "report",
];

/// A crate's modules by their paths (`plan::model`), and which of them each imports from.
type Imports = BTreeMap<String, BTreeSet<String>>;

/// What a crate's files import from each other, tests aside.
fn imports(root: &Path) -> Imports {
    let mut files = BTreeMap::new();
    modules(&root.join("lib.rs"), root, "", &mut files);
    let known: BTreeSet<&str> = files.keys().map(String::as_str).collect();
    (files.iter())
        .map(|(name, file)| {
            let mut found = Paths {
                paths: Vec::new(),
                children: Vec::new(),
            };
            found.visit_file(file);
            let to = found.paths.iter().filter_map(|path| {
                let of = absolute(name, path, &found.children)?;
                (0..=of.len())
                    .rev()
                    .map(|count| of[..count].join("::"))
                    .find(|of| known.contains(of.as_str()))
            });
            let to = to.filter(|to| to != name && !to.is_empty()).collect();
            (name.clone(), to)
        })
        .collect()
}

/// Reads a module's file and those of its children; `folder` is where the children are.
fn modules(path: &Path, folder: &Path, name: &str, out: &mut BTreeMap<String, syn::File>) {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let file = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    for item in &file.items {
        if let syn::Item::Mod(child) = item
            && child.content.is_none()
            && !is_test(&child.attrs)
        {
            let short = child.ident.to_string();
            let inside = folder.join(&short);
            let beside = folder.join(format!("{short}.rs"));
            let path = match beside.exists() {
                true => beside,
                false => inside.join("mod.rs"),
            };
            let name = match name {
                "" => short,
                name => format!("{name}::{short}"),
            };
            modules(&path, &inside, &name, out);
        }
    }
    out.insert(name.to_owned(), file);
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute
                .parse_args::<syn::Ident>()
                .is_ok_and(|what| what == "test" || what == "doc")
    })
}

/// A path from the crate's root, if it leads to something of the crate.
fn absolute(module: &str, path: &[String], children: &[String]) -> Option<Vec<String>> {
    let mut base: Vec<String> = module
        .split("::")
        .filter(|m| !m.is_empty())
        .map(str::to_owned)
        .collect();
    let mut rest = path;
    match path.first()?.as_str() {
        "crate" => return Some(path[1..].to_vec()),
        "self" => rest = &path[1..],
        "super" => {
            while rest.first().is_some_and(|first| first == "super") {
                base.pop();
                rest = &rest[1..];
            }
        }
        first if children.iter().any(|child| child == first) => {}
        _ => return None,
    }
    base.extend_from_slice(rest);
    Some(base)
}

/// All paths of a file, tests aside, and the modules declared in it.
struct Paths {
    paths: Vec<Vec<String>>,
    children: Vec<String>,
}

impl Paths {
    fn used(&mut self, before: &[String], tree: &syn::UseTree) {
        let mut path = before.to_vec();
        match tree {
            syn::UseTree::Path(of) => {
                path.push(of.ident.to_string());
                self.used(&path, &of.tree);
            }
            syn::UseTree::Group(all) => all.items.iter().for_each(|tree| self.used(before, tree)),
            syn::UseTree::Name(name) => {
                path.push(name.ident.to_string());
                self.paths.push(path);
            }
            syn::UseTree::Rename(name) => {
                path.push(name.ident.to_string());
                self.paths.push(path);
            }
            syn::UseTree::Glob(_) => self.paths.push(path),
        }
    }
}

impl Visit<'_> for Paths {
    fn visit_item_mod(&mut self, item: &syn::ItemMod) {
        if !is_test(&item.attrs) {
            self.children.push(item.ident.to_string());
            syn::visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_use(&mut self, item: &syn::ItemUse) {
        if !is_test(&item.attrs) {
            self.used(&[], &item.tree);
        }
    }

    fn visit_item_fn(&mut self, item: &syn::ItemFn) {
        if !is_test(&item.attrs) {
            syn::visit::visit_item_fn(self, item);
        }
    }

    fn visit_path(&mut self, path: &syn::Path) {
        let names = path.segments.iter().map(|s| s.ident.to_string());
        self.paths.push(names.collect());
        syn::visit::visit_path(self, path);
    }
}

/// Whether one module is the other's child, or its child's child.
fn is_inside(module: &str, of: &str) -> bool {
    module
        .strip_prefix(of)
        .is_some_and(|rest| rest.starts_with("::"))
}

/// A way back from a module to itself, if there is one; a module's arrows to its own children
/// do not count.
fn circle<'i>(imports: &'i Imports, from: &'i str) -> Option<Vec<&'i str>> {
    let mut before: BTreeMap<&str, &str> = BTreeMap::new();
    let mut left = vec![from];
    while let Some(at) = left.pop() {
        for to in imports.get(at).into_iter().flatten() {
            if is_inside(to, at) {
                continue;
            }
            if to == from {
                let mut way = vec![from, at];
                while way.last() != Some(&from) {
                    way.push(before[way[way.len() - 1]]);
                }
                way.reverse();
                return Some(way);
            }
            if !before.contains_key(to.as_str()) {
                before.insert(to, at);
                left.push(to);
            }
        }
    }
    None
}

/// Files of the compiler and of the command line import in one direction: no circles.
#[test]
fn no_files_import_each_other() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (folder, least) in [("compiler/src", 250), ("src", 100)] {
        let imports = imports(&root.join(folder));
        let arrows: usize = imports.values().map(BTreeSet::len).sum();
        assert!(
            imports.len() > least && arrows > 2 * least,
            "{folder}: {arrows}"
        );
        for module in imports.keys() {
            if let Some(way) = circle(&imports, module) {
                panic!("{folder}: {}", way.join(" -> "));
            }
        }
    }
}

/// Folders of the compiler stand above each other.
#[test]
fn the_compilers_folders_import_from_lower_ones() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let floor = |module: &str| {
        let folder = module.split("::").next().unwrap_or_default();
        let found = FLOORS.iter().position(|f| *f == folder);
        found.unwrap_or_else(|| panic!("{folder} has no floor"))
    };
    for (from, all) in &imports(&root.join("compiler/src")) {
        if from.is_empty() {
            continue;
        }
        for to in all {
            assert!(floor(to) <= floor(from), "{from} imports from {to}");
        }
    }
}

/// Circles are found where there are some.
#[test]
fn circles_are_found() {
    let imports = |arrows: &[(&str, &[&str])]| -> Imports {
        let set = |to: &[&str]| to.iter().map(|t| (*t).to_owned()).collect();
        let all = arrows
            .iter()
            .map(|(from, to)| ((*from).to_owned(), set(to)));
        all.collect()
    };
    let way = imports(&[("a", &["b"]), ("b", &["c", "d"]), ("c", &["a"]), ("d", &[])]);
    assert_eq!(circle(&way, "b"), Some(vec!["b", "c", "a", "b"]));
    assert_eq!(circle(&way, "d"), None);
    // A module and its own child are none.
    let own = imports(&[("a", &["a::b"]), ("a::b", &["a"])]);
    assert_eq!(circle(&own, "a"), None);
    assert_eq!(circle(&own, "a::b"), None);
}
