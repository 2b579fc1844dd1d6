//! Which of the scene's values are statics rather than fields of its object.
//!
//! To the VM both are the same. The processor finds a static at a fixed address, in
//! two instructions, and a field behind a pointer, in three to five. Jack has 240
//! statics in all classes together, so those values get them that are met most in
//! what is done for each pixel.

use super::Line;
use std::collections::{BTreeMap, BTreeSet};

/// The statics that all classes have together.
const ALL: usize = 240;
/// Left for the operating system's.
const SYSTEM: usize = 24;

/// The names to declare static: of these, those met most in `lines`, as many as the
/// program's other classes, whose texts these are, leave room for.
pub(super) fn statics<'l>(
    names: impl IntoIterator<Item = String>,
    lines: impl Iterator<Item = &'l Line>,
    others: &[(&'static str, String)],
) -> BTreeSet<String> {
    let taken: usize = others.iter().map(|(_, text)| declared(text)).sum();
    let mut met: BTreeMap<String, usize> = names.into_iter().map(|name| (name, 0)).collect();
    for line in lines {
        let code = line.text.split("//").next().unwrap_or_default();
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        for word in code.split(|c| !is_part(c)) {
            if let Some(count) = met.get_mut(word) {
                *count += 1;
            }
        }
    }
    let mut ranked: Vec<(String, usize)> = met.into_iter().filter(|(_, n)| *n > 0).collect();
    ranked.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    ranked.truncate(ALL.saturating_sub(SYSTEM + taken));
    ranked.into_iter().map(|(name, _)| name).collect()
}

/// How many statics a class declares.
fn declared(text: &str) -> usize {
    let lines = text.lines().map(str::trim_start);
    let lines = lines.filter_map(|line| line.strip_prefix("static "));
    let names = lines.map(|line| line.split(';').next().unwrap_or_default());
    names.map(|names| names.split(',').count()).sum()
}
