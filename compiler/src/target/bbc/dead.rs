//! Flags that are set where nothing asks for them any more.
//!
//! Where jumps go straight to where a test would have led, what was set for the test
//! may be read nowhere on the way. Lines are walked from the jump on, as control may go
//! (liveness: Aho, Lam, Sethi and Ullman, Compilers, 2nd edition, 9.2.5); what is not
//! certain counts as read.

use super::lines::{Label, Lines};
use super::pieces::{Piece, pieces};
use std::collections::{BTreeSet, HashMap};

/// The lines without flags that are set in vain before a jump or at a line's end.
pub fn without(lines: Lines) -> Lines {
    let mut texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let placed: HashMap<Label, usize> = lines.labelled().collect();
    let flow = Flow::of(&texts, &placed);
    let changed: Vec<String> = texts
        .iter()
        .enumerate()
        .map(|(at, text)| flow.without_last(at, text, &placed))
        .collect();
    texts = changed;
    lines.with_texts(texts, &HashMap::new())
}

/// What a line does with names.
struct Line {
    /// What may be read before it is written here.
    reads: BTreeSet<String>,
    /// Where it goes on, and what it has written on that way whatever happens.
    next: Vec<(usize, BTreeSet<String>)>,
}

struct Flow(Vec<Line>);

impl Flow {
    fn of(texts: &[String], placed: &HashMap<Label, usize>) -> Flow {
        let holding = |word: &str| -> Vec<usize> {
            let all = texts.iter().enumerate();
            let found = all.filter(|(_, text)| text.contains(word) && !text.starts_with("DEF"));
            found.map(|(at, _)| at).collect()
        };
        let (loops, calls) = (holding("FOR "), holding("PROC"));
        let lines = texts.iter().enumerate().map(|(at, text)| {
            let (reads, ways) = uses(text);
            let mut next = Vec::new();
            for way in &ways {
                let to = Label::all_of(way.text).filter_map(|label| placed.get(&label).copied());
                next.extend(to.map(|to| (to, way.writes.clone())));
                if !leaves(way.text) {
                    next.push((at + 1, way.writes.clone()));
                }
            }
            // Anywhere else, so nothing is written for sure.
            let mut other: Vec<usize> = Vec::new();
            if text.contains("NEXT") {
                other.extend(&loops);
            }
            if text.contains("ENDPROC") {
                other.extend(&calls);
            }
            for (from, _) in text.match_indices("PROC") {
                let name = text.get(from..).and_then(|t| match pieces(t).first() {
                    Some(Piece::Fixed(name)) => Some(format!("DEF {name}")),
                    _ => None,
                });
                other.extend(texts.iter().position(|t| Some(t) == name.as_ref()));
            }
            let all = ways
                .first()
                .map(|way| way.writes.clone())
                .unwrap_or_default();
            let sure = ways.iter().skip(1).fold(all, |all, way| &all & &way.writes);
            next.extend(other.into_iter().map(|to| (to, sure.clone())));
            Line { reads, next }
        });
        Flow(lines.collect())
    }

    /// Whether a name may be read from a line on, before it is written.
    fn reads(&self, name: &str, from: usize) -> bool {
        let mut seen = vec![false; self.0.len()];
        let mut todo = vec![from];
        while let Some(at) = todo.pop() {
            let Some(line) = self.0.get(at) else {
                continue;
            };
            if std::mem::replace(&mut seen[at], true) {
                continue;
            }
            if line.reads.contains(name) {
                return true;
            }
            let next = line
                .next
                .iter()
                .filter(|(_, writes)| !writes.contains(name));
            todo.extend(next.map(|(to, _)| *to));
        }
        false
    }

    /// A line without the flags that it sets last and in vain.
    fn without_last(&self, at: usize, text: &str, placed: &HashMap<Label, usize>) -> String {
        let plain = |text: &str| {
            let way = text.contains(" ELSE ") || text.contains("NEXT");
            !way && text.matches("IF ").count() <= 1
        };
        if let Some((before, label)) = Label::last_of(text)
            && let Some(&to) = placed.get(&label)
            && let Some(mut before) = before.strip_suffix("GOTO ")
            && plain(before)
        {
            while let Some((front, last)) = last(before.strip_suffix(':').unwrap_or(""))
                && flag(last).is_some_and(|name| !self.reads(name, to))
            {
                before = front;
            }
            return match before.ends_with(" THEN ") {
                true => format!("{before}{label}"),
                false => format!("{before}GOTO {label}"),
            };
        }
        match flag(text) {
            Some(name) if !self.reads(name, at + 1) => String::new(),
            _ => text.to_owned(),
        }
    }
}

/// The last of some statements, and what stands before it.
fn last(statements: &str) -> Option<(&str, &str)> {
    let from = statements.rfind([':', ' ']).map_or(0, |at| at + 1);
    let (front, last) = statements.split_at_checked(from)?;
    (!last.is_empty()).then_some((front, last))
}

/// The variable of a statement that sets a flag.
fn flag(statement: &str) -> Option<&str> {
    let (name, value) = statement.split_once('=')?;
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
    let lone = name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(plain);
    (lone && ["TRUE", "FALSE"].contains(&value)).then_some(name)
}

/// Whether control never goes on behind some statements.
fn leaves(text: &str) -> bool {
    let last = text.rsplit(':').next().unwrap_or(text);
    let ends = ["GOTO ", "ENDPROC", "END", "="];
    Label::last_of(last).is_some_and(|(before, _)| before.is_empty())
        || !text.contains("IF ") && ends.iter().any(|word| last.starts_with(word))
}

/// A way through a line: its last statements, and what is written on it for sure.
struct Way<'t> {
    text: &'t str,
    writes: BTreeSet<String>,
}

/// What a line may read before it writes it, and the ways through it.
fn uses(text: &str) -> (BTreeSet<String>, Vec<Way<'_>>) {
    let mut reads = BTreeSet::new();
    // Control may come back into the middle of a line.
    let entered = text.contains("PROC") || text.match_indices("FOR ").any(|(at, _)| at > 0);
    let (before, test) = match text.find("IF ") {
        Some(at) if !entered => text.split_at_checked(at).unwrap_or((text, "")),
        _ => (text, ""),
    };
    let writes = written(before, &BTreeSet::new(), &mut reads);
    let sure = |writes| match entered {
        true => BTreeSet::new(),
        false => writes,
    };
    let Some((asked, ways)) = test.split_once(" THEN ") else {
        let _ = written(test, &writes, &mut reads);
        let writes = sure(writes);
        return (reads, vec![Way { text, writes }]);
    };
    let _ = written(asked, &writes, &mut reads);
    if ways.contains("IF ") {
        let _ = written(ways, &writes, &mut reads);
        return (reads, vec![Way { text, writes }]);
    }
    let (yes, no) = ways.split_once(" ELSE ").unwrap_or((ways, ""));
    let mut way = |text| {
        let own = written(text, &writes, &mut reads);
        Way { text, writes: own }
    };
    let both = vec![way(yes), way(no)];
    (reads, both)
}

/// What is written behind some statements, where something is written before; what
/// they read that is not is noted.
fn written(
    text: &str,
    before: &BTreeSet<String>,
    reads: &mut BTreeSet<String>,
) -> BTreeSet<String> {
    let mut writes = before.clone();
    let arms = text.split(" THEN ").flat_map(|t| t.split(" ELSE "));
    let one = arms.clone().count() == 1;
    for statement in arms.flat_map(|t| t.split(':')) {
        let (to, from) = match statement.split_once('=') {
            Some((name, value)) if is_name(name) => (Some(name), value),
            _ => (None, statement),
        };
        for piece in pieces(from) {
            if let Piece::Name(name) = piece
                && !(one && writes.contains(name))
            {
                reads.insert(name.to_owned());
            }
        }
        if let Some(name) = to.filter(|_| one) {
            writes.insert(name.to_owned());
        }
    }
    writes
}

fn is_name(text: &str) -> bool {
    matches!(pieces(text).as_slice(), [Piece::Name(_)])
}

#[cfg(test)]
mod tests {
    use super::super::lines::Labels;
    use super::*;

    /// The lines `texts`, where `@n` goes to the line number n, without dead flags.
    fn written(texts: &[&str]) -> String {
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
        let mut lines = without(lines);
        lines.remove_empty();
        lines.finish().0
    }

    #[test]
    fn a_flag_that_is_asked_for_on_no_way_is_not_set() {
        let source = [
            "FOR x%=1 TO 9",
            "a%=x%<4",
            "IF a% THEN b%=TRUE:a%=FALSE:GOTO @5;",
            "b%=FALSE",
            "IF x%<7 THEN a%=TRUE:GOTO @2;",
            "IF b% THEN PRINT x%",
            "a%=TRUE",
            "NEXT",
        ];
        let expected = "10FOR x%=1 TO 9\n20a%=x%<4\n30IF a% THEN b%=TRUE:GOTO 60\n40b%=FALSE\n\
            50IF x%<7 THEN a%=TRUE:GOTO 30\n60IF b% THEN PRINT x%\n70NEXT\n";
        assert_eq!(written(&source), expected);
    }

    #[test]
    fn what_a_procedure_or_another_turn_reads_is_set() {
        let source = [
            "FOR y%=1 TO 9:a%=FALSE:FOR x%=1 TO 9",
            "PROCrow",
            "IF b% THEN a%=TRUE:GOTO @3;",
            "NEXT:NEXT:END",
            "DEF PROCrow",
            "IF a% THEN b%=TRUE:GOTO @7;",
            "b%=FALSE",
            "ENDPROC",
        ];
        let text = written(&source);
        assert!(
            text.contains("THEN a%=TRUE:GOTO 40\n") && text.contains("70b%=FALSE\n"),
            "{text}"
        );
    }
}
