//! What `cargo package` needs of each crate: what describes it, and all files that it reads.

use serde_json::Value;
use std::path::{Component, Path, PathBuf};
use std::process::Command;

/// What cargo knows of the workspace's packages.
pub fn packages() -> Vec<Value> {
    let output = Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--format-version",
            "1",
            "--no-deps",
            "--offline",
        ])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs");
    let json: Value = serde_json::from_slice(&output.stdout).expect("cargo prints JSON");
    json["packages"].as_array().expect("packages").clone()
}

#[test]
fn crates_say_what_they_are() {
    for package in packages() {
        let name = &package["name"];
        assert!(package["description"].is_string(), "{name}: description");
        assert_eq!(package["license"], "MIT OR Apache-2.0", "{name}");
        for used in package["dependencies"].as_array().expect("dependencies") {
            // Without a version, a package cannot be found from a registry.
            assert_ne!(used["req"], "*", "{name}: {}", used["name"]);
        }
    }
}

/// A path without its `..`.
fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(out.pop()),
            part => out.push(part),
        }
    }
    out
}

/// Rust files below a folder, tests aside.
fn sources(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        if name == "tests" || name.ends_with("_tests") {
            continue;
        }
        if path.is_dir() {
            sources(&path, out);
        } else if path.extension().is_some_and(|e| e == "rs") {
            out.push(path);
        }
    }
}

/// What a crate is built from lies in its own folder, and in no crate's below it.
#[test]
fn crates_read_their_own_files_only() {
    let packages = packages();
    let folder = |package: &Value| {
        let path = package["manifest_path"].as_str().expect("a path");
        Path::new(path).parent().expect("a folder").to_path_buf()
    };
    let folders: Vec<PathBuf> = packages.iter().map(folder).collect();
    // Each file is of the innermost crate around it.
    let owner = |path: &Path| {
        let around = folders.iter().filter(|folder| path.starts_with(folder));
        around.max_by_key(|folder| folder.components().count())
    };
    let mut read = 0;
    for folder in &folders {
        let mut files = Vec::new();
        sources(&folder.join("src"), &mut files);
        for file in files {
            let text = std::fs::read_to_string(&file).expect("a text");
            // Tests within a file stand at its end.
            let text = text
                .split("#[cfg(test)]\nmod tests {")
                .next()
                .unwrap_or_default();
            let includes = ["include_str!(", "include_bytes!("];
            for rest in includes.iter().flat_map(|name| text.split(name).skip(1)) {
                let rest = rest.trim_start().trim_start_matches("concat!(");
                let path = rest
                    .trim_start()
                    .strip_prefix('"')
                    .and_then(|r| r.split('"').next());
                let Some(path) = path else {
                    continue;
                };
                let to = plain(&file.with_file_name(path));
                assert_eq!(owner(&to), Some(folder), "{} reads {path}", file.display());
                read += 1;
            }
        }
    }
    assert!(read > 50, "{read}");
}
