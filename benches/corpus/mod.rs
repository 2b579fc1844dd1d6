//! What the benchmarks of the planner run over: scenes, and what `slowlight` says of them.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The scenes that are named on the command line; the examples where none is.
pub fn scenes() -> Vec<PathBuf> {
    let named = std::env::args()
        .skip(1)
        .filter(|arg| !arg.starts_with("--"));
    let named: Vec<PathBuf> = named.map(PathBuf::from).collect();
    if !named.is_empty() {
        return named;
    }
    let dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let scenes = std::fs::read_dir(dir).into_iter().flatten();
    let mut all: Vec<PathBuf> = scenes
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|ext| ext == "scn"))
        .collect();
    all.sort();
    all
}

/// What `slowlight build --json` says of a scene on a target.
pub fn build(scene: &Path, target: &str, args: &[&str]) -> Option<Value> {
    let dir = tempfile::tempdir().ok()?;
    let into = dir.path().to_string_lossy();
    said(scene, target, &[&["build", "-o", &into], args].concat())
}

/// What a command says of a scene on a target.
pub fn said(scene: &Path, target: &str, args: &[&str]) -> Option<Value> {
    let out = Command::new(env!("CARGO_BIN_EXE_slowlight"))
        .args(args)
        .args(["--json", "-t", target])
        .arg(scene)
        .output()
        .ok()?;
    serde_json::from_slice(&out.stdout).ok()
}
