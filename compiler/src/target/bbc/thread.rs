//! Jumps that lead to another jump go where that one goes.
//!
//! A way that ends in `v%=FALSE:GOTO a` where line a is `IF NOT v% THEN b` goes
//! to b: the test would tell what is known. (Jump threading: Aho, Lam, Sethi and
//! Ullman, Compilers, 2nd edition, 8.7.3.)

use super::lines::{Label, Labels, Lines};
use std::collections::HashMap;

/// How many jumps are followed from one.
const HOPS: usize = 8;

/// The lines with every jump to a jump shortened.
pub fn threaded(lines: Lines, labels: &mut Labels) -> Lines {
    let texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let mut road = Road {
        placed: lines.labelled().collect(),
        behind: HashMap::new(),
        texts: &texts,
        labels,
    };
    let changed: Vec<String> = texts.iter().map(|text| road.shortened(text)).collect();
    let behind = road.behind;
    lines.with_texts(changed, &behind)
}

struct Road<'t> {
    /// The line that each label stands before.
    placed: HashMap<Label, usize>,
    /// New labels, by the line that they stand behind.
    behind: HashMap<usize, Label>,
    texts: &'t [String],
    labels: &'t mut Labels,
}

impl Road<'_> {
    /// A line whose jump, if it ends in one, goes as far as is known.
    fn shortened(&mut self, text: &str) -> String {
        let Some((before, mut to)) = jump(text) else {
            return text.to_owned();
        };
        let known = before.strip_suffix(":GOTO ").and_then(assigned);
        let first = to;
        for _ in 0..HOPS {
            match self.next(to, known) {
                Some(next) if next != to => to = next,
                _ => break,
            }
        }
        if to == first {
            return text.to_owned();
        }
        format!("{before}{to}")
    }

    /// Where a jump to a label goes on to at once.
    fn next(&mut self, to: Label, known: Option<(&str, bool)>) -> Option<Label> {
        let at = *self.placed.get(&to)?;
        let text = self.texts.get(at)?;
        let (before, next) = jump(text)?;
        if before == "GOTO " {
            return Some(next);
        }
        let (name, value) = known?;
        let test = before.strip_prefix("IF ")?.strip_suffix(" THEN ")?;
        let wanted = match test.strip_prefix("NOT ") {
            Some(test) => (test == name).then_some(false),
            None => (test == name).then_some(true),
        };
        if wanted? == value {
            return Some(next);
        }
        let label = match self.behind.get(&at) {
            Some(label) => *label,
            None => self.labels.next(),
        };
        self.behind.insert(at, label);
        self.placed.insert(label, at + 1);
        Some(label)
    }
}

/// What stands before the label that a line jumps to at its end, and that label.
fn jump(text: &str) -> Option<(&str, Label)> {
    let (before, label) = Label::last_of(text)?;
    (before.ends_with("GOTO ") || before.ends_with("THEN ")).then_some((before, label))
}

/// The variable that statements set to a truth value last, and that value.
fn assigned(text: &str) -> Option<(&str, bool)> {
    let from = text.rfind([':', ' ']).map_or(0, |at| at + 1);
    let (name, value) = text[from..].split_once('=')?;
    let value = match value {
        "TRUE" => true,
        "FALSE" => false,
        _ => return None,
    };
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
    (!name.is_empty() && name.chars().all(plain)).then_some((name, value))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program(lines: &[(&str, Option<usize>)], labels: &mut Labels, all: &[Label]) -> Lines {
        let mut out = Lines::default();
        let _ = labels;
        for (text, label) in lines {
            if let Some(label) = label {
                out.place(all[*label]);
            }
            let mut text = (*text).to_owned();
            for (k, label) in all.iter().enumerate() {
                text = text.replace(&format!("@{k}"), &label.to_string());
            }
            out.line(text, None);
        }
        out
    }

    #[test]
    fn what_is_known_is_not_tested_again() {
        let mut labels = Labels::default();
        let all = [labels.next(), labels.next(), labels.next()];
        let source = [
            ("IF x<0 THEN v%=FALSE:GOTO @0", None),
            ("IF x<1 THEN v%=TRUE:GOTO @0", None),
            ("IF x<2 THEN w%=TRUE:GOTO @0", None),
            ("v%=y<1", None),
            ("IF NOT v% THEN @1", Some(0)),
            ("z=1", None),
            ("GOTO @2", Some(1)),
            ("z=2", None),
            ("END", Some(2)),
        ];
        let (text, _) = threaded(program(&source, &mut labels, &all), &mut labels).finish();
        let expected = "10IF x<0 THEN v%=FALSE:GOTO 90\n20IF x<1 THEN v%=TRUE:GOTO 60\n\
            30IF x<2 THEN w%=TRUE:GOTO 50\n40v%=y<1\n50IF NOT v% THEN 90\n60z=1\n70GOTO 90\n\
            80z=2\n90END\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn jumps_in_a_ring_end() {
        let mut labels = Labels::default();
        let all = [labels.next(), labels.next()];
        let source = [("GOTO @1", Some(0)), ("GOTO @0", Some(1))];
        let (text, _) = threaded(program(&source, &mut labels, &all), &mut labels).finish();
        assert!(text.lines().count() == 2 && text.contains("GOTO"));
    }
}
