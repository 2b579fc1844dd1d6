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

#[cfg(test)]
mod tests {
    use super::super::line;
    use super::*;

    #[test]
    fn those_met_most_are_static_while_there_is_room() {
        let names = (0..300).map(|k| format!("v{k}"));
        // v0 is met once, v1 twice, and so on; v200 and the rest never.
        let text = |k: usize| line(&format!("let v{k} = v{k} + v{k}; // v299 is not met"));
        let lines: Vec<Line> = (0..200).flat_map(|k| vec![text(k); k + 1]).collect();
        let library = "class Log {\n    static Array a, b, c;\n    static int d; // two\n}\n";
        let few = [("Log", library.to_owned())];
        let found = statics(names.clone(), lines.iter(), &few);
        assert_eq!(found.len(), 200, "{found:?}");
        let many = format!("static int {};\n", vec!["s"; 100].join(", "));
        let most = statics(names, lines.iter(), &[("Log", many)]);
        assert_eq!(most.len(), ALL - SYSTEM - 100);
        assert!(most.contains("v199") && !most.contains("v0") && !most.contains("v299"));
    }
}
