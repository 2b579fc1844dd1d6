//! Lines as tests write them.

use super::{Label, Labels, Lines};

/// The lines `texts`, where `@n;` goes to the line number n.
pub fn of_texts(texts: &[&str]) -> (Lines, Labels) {
    let mut labels = Labels::default();
    let all: Vec<Label> = texts.iter().map(|_| labels.next()).collect();
    let mut lines = Lines::default();
    for (text, label) in texts.iter().zip(&all) {
        lines.place(*label);
        let mut text = (*text).to_owned();
        for (k, label) in all.iter().enumerate() {
            text = text.replace(&format!("@{k};"), &label.to_string());
        }
        lines.line(text, None);
    }
    (lines, labels)
}
