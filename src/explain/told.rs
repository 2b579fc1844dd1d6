//! Remarks that say the same of several lines, as one.

use super::Explained;
use slowlight_compiler::report::profile::SourceLine;

/// What is said of one line, or of several.
pub struct Told<'e> {
    /// The lines, in the order of files and lines.
    pub lines: Vec<&'e SourceLine>,
    /// What their plan could not do, and what would let it.
    pub head: &'e str,
    /// Their cycles.
    pub cycles: u64,
    /// How many of these would be spared.
    pub saves: u64,
}

/// What is said of lines, the dearest first.
pub fn told(found: &Explained) -> Vec<Told<'_>> {
    let mut all: Vec<Told<'_>> = Vec::new();
    for line in &found.profile.lines {
        let known = found.why.as_ref();
        let Some(why) = known.and_then(|all| all.get(&(line.file, line.line))) else {
            continue;
        };
        match all.iter_mut().find(|told| told.head == why.head) {
            Some(told) => {
                told.lines.push(line);
                told.cycles += line.cycles;
                // What has only gone from one of them to another is not spared.
                told.saves = (told.saves + why.saves).min(why.saves_in_all);
            }
            None => all.push(Told {
                lines: vec![line],
                head: &why.head,
                cycles: line.cycles,
                saves: why.saves,
            }),
        }
    }
    for told in &mut all {
        told.lines.sort_by_key(|line| (line.file, line.line));
    }
    all.sort_by_key(|told| std::cmp::Reverse(told.cycles));
    all
}
