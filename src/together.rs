//! Warnings of several formats about one place, as one.

use slowlight_compiler::source::{Diagnostic, Severity};

/// Warnings with one for each place: what further formats have to say of it stands behind
/// what the first says. What two say but for its figures is said once.
pub fn together(all: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let mut out: Vec<Diagnostic> = Vec::new();
    for next in all {
        let same = |d: &&mut Diagnostic| {
            d.span == next.span && [d.severity, next.severity] == [Severity::Warning; 2]
        };
        match out.iter_mut().find(same) {
            Some(known) => join(known, next),
            None => out.push(next),
        }
    }
    out
}

fn join(known: &mut Diagnostic, next: Diagnostic) {
    add(&mut known.message, &next.message);
    add(&mut known.label, &next.label);
    match (&mut known.help, next.help) {
        (Some(help), Some(more)) => add(help, &more),
        (help @ None, more) => *help = more,
        _ => {}
    }
    for other in next.others {
        if !known.others.contains(&other) {
            known.others.push(other);
        }
    }
}

/// Adds a part behind a semicolon, unless it is there but for its figures.
fn add(text: &mut String, part: &str) {
    let plain = |t: &str| t.replace(|c: char| c.is_ascii_digit() || c == '.', "");
    // What is there may have semicolons of its own.
    let there = format!("; {}; ", plain(text)).contains(&format!("; {}; ", plain(part)));
    if part.is_empty() || there {
        return;
    }
    if !text.is_empty() {
        text.push_str("; ");
    }
    text.push_str(part);
}

#[cfg(test)]
mod tests {
    use super::*;
    use slowlight_compiler::source::Span;

    #[test]
    fn one_place_has_one_warning() {
        let at = Span::new(0, 4, 9);
        let said = |text: &str, help: &str| Diagnostic::warning(at, text).help(help);
        let elsewhere = Diagnostic::warning(Span::new(0, 5, 9), "a tie on 6.2 %");
        let all = together(vec![
            said("in f316 2 of 13 bits are left", "rearrange"),
            said("in real40 3 of 32 bits are left", "rearrange"),
            elsewhere.clone(),
            said("a tie on 6.2 %", "it counts as 0; move the eye"),
            said("a tie on 6.4 %", "it counts as 0; move the eye"),
        ]);
        assert_eq!(all.len(), 2);
        assert_eq!(
            all[0].message,
            "in f316 2 of 13 bits are left; in real40 3 of 32 bits are left; a tie on 6.2 %"
        );
        assert_eq!(
            all[0].help.as_deref(),
            Some("rearrange; it counts as 0; move the eye")
        );
        assert_eq!(all[1], elsewhere);
    }
}
