//! The house: which crate may know which (ARCHITECTURE.md, "Arrows point down only"), and what its
//! documents point at.

use crate::packages::packages;
use std::collections::BTreeSet;
use std::path::Path;

/// The workspace's own crates that a crate's normal dependencies name.
fn arrows() -> Vec<(String, BTreeSet<String>)> {
    let packages = packages();
    let name = |v: &serde_json::Value| v["name"].as_str().unwrap_or_default().to_owned();
    let own: BTreeSet<String> = packages.iter().map(name).collect();
    let normal = |p: &serde_json::Value| {
        let all = p["dependencies"].as_array().cloned().unwrap_or_default();
        let kept = all
            .into_iter()
            .filter(|d| d["kind"].is_null())
            .map(|d| name(&d));
        kept.filter(|d| own.contains(d)).collect()
    };
    packages.iter().map(|p| (name(p), normal(p))).collect()
}

#[test]
fn arrows_point_down_only() {
    let allowed = [
        (
            "slowlight",
            &["slowlight-compiler", "slowlight-routine", "slowlight-vm"][..],
        ),
        (
            "slowlight-compiler",
            &[
                "slowlight-isa",
                "slowlight-routine",
                "slowlight-runtime-6502",
                "slowlight-runtime-bbc",
                "slowlight-runtime-jack",
                "slowlight-syntax",
            ],
        ),
        (
            "slowlight-runtime-jack",
            &["slowlight-routine", "slowlight-isa"],
        ),
        (
            "slowlight-runtime-bbc",
            &["slowlight-routine", "slowlight-isa"],
        ),
        (
            "slowlight-runtime-6502",
            &["slowlight-routine", "slowlight-isa"],
        ),
        ("slowlight-routine", &[]),
        ("slowlight-syntax", &[]),
        ("slowlight-vm", &["slowlight-isa"]),
        ("slowlight-isa", &[]),
        ("slowlight-web", &["slowlight"]),
    ];
    let found = arrows();
    assert_eq!(
        found.len(),
        allowed.len(),
        "a crate is missing from this list"
    );
    for (name, uses) in found {
        let rule = allowed.iter().find(|(n, _)| *n == name);
        let (_, may) = rule.unwrap_or_else(|| panic!("no rule for {name}"));
        for used in uses {
            assert!(may.contains(&used.as_str()), "{name} must not use {used}");
        }
    }
}

/// What the documents point at is there.
#[test]
fn links_of_documents_lead_somewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pages = vec![root.join("README.md"), root.join("ARCHITECTURE.md")];
    for folder in ["docs", "docs/design"] {
        let docs = std::fs::read_dir(root.join(folder)).expect("docs");
        pages.extend(docs.map(|entry| entry.expect("an entry").path()));
    }
    pages.retain(|page| page.extension().is_some_and(|e| e == "md"));
    let mut links = 0;
    for page in pages {
        let text = std::fs::read_to_string(&page).expect("a page");
        for link in text.split("](").skip(1) {
            let link = link.split([')', '#']).next().unwrap_or_default();
            if link.is_empty() || link.contains("://") {
                continue;
            }
            let to = page.with_file_name(link);
            assert!(to.exists(), "{}: {link}", page.display());
            links += 1;
        }
    }
    assert!(links > 50, "{links}");
}

/// The map is short enough to be read, and names every pass.
#[test]
fn the_map_is_short_and_names_every_pass() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let map = std::fs::read_to_string(root.join("ARCHITECTURE.md")).expect("the map");
    assert!(map.len() <= 15 * 1024, "{} bytes", map.len());
    let passes = std::fs::read_dir(root.join("compiler/src/passes")).expect("passes");
    for entry in passes {
        let name = entry.expect("an entry").file_name();
        let name = name.to_string_lossy().replace(".rs", "");
        if name != "mod" && !name.ends_with("_tests") {
            assert!(
                map.contains(&format!("`{name}`")),
                "{name} is not on the map"
            );
        }
    }
}

/// Files can be held in the head: none is longer than 400 lines.
#[test]
fn files_are_short() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut folders, mut files) = (Vec::new(), 0);
    for name in [
        "src",
        "compiler",
        "runtime-jack",
        "runtime-bbc",
        "runtime-6502",
        "vm",
        "web/wasm",
        "tests",
    ] {
        folders.push(root.join(name));
    }
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let lines = std::fs::read_to_string(&path)
                    .expect("text")
                    .lines()
                    .count();
                assert!(lines <= 400, "{}: {lines} lines", path.display());
                files += 1;
            }
        }
    }
    assert!(files > 800, "{files}");
}
