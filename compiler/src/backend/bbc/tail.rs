//! Ends of a pixel's loop that stand on several ways.
//!
//! A way that jumps to where its ink is drawn and its loop goes on does that
//! itself, where memory is left: NEXT finds its loop by itself, a jump looks
//! through the lines. Where the ink is a number or a variable there, it is drawn
//! without being assigned.

use super::lines::{Label, Labels, Lines};
use super::pieces::{Piece, pieces, short_length};
use rustc_hash::{FxHashMap, FxHashSet};

/// How long an end may be to stand on several ways.
const LONGEST: usize = 48;

/// How long a line may become.
const LINE: usize = 120;

/// The lines with short ends of loops on each way that jumps to them.
pub fn copied(lines: Lines, labels: &mut Labels) -> Lines {
    let texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let mut ends = Ends {
        placed: lines.labelled().collect(),
        behind: FxHashMap::default(),
        asked: FxHashSet::default(),
        texts: &texts,
        labels,
    };
    let asked = texts.iter().flat_map(|text| Label::all_of(text));
    ends.asked = asked
        .filter_map(|label| ends.placed.get(&label).copied())
        .collect();
    let mut changed = texts.clone();
    for at in 0..texts.len() {
        ends.at(at, &mut changed);
    }
    let behind = ends.behind;
    lines.with_texts(changed, &behind)
}

struct Ends<'t> {
    /// The line that each label stands before.
    placed: FxHashMap<Label, usize>,
    /// New labels, by the line that they stand behind.
    behind: FxHashMap<usize, Label>,
    /// The lines that jumps go to.
    asked: FxHashSet<usize>,
    texts: &'t [String],
    labels: &'t mut Labels,
}

/// What is done from a label on, up to a loop's NEXT, and where it goes on behind that.
struct End {
    statements: String,
    behind: Label,
    /// A variable that is read once, there and nowhere else.
    only: Option<String>,
}

impl Ends<'_> {
    /// Changes a line that leads to an end.
    fn at(&mut self, at: usize, changed: &mut [String]) {
        let text = &self.texts[at];
        if let Some((before, to)) = Label::last_of(text)
            && let Some(before) = before.strip_suffix("GOTO ")
            && (before.is_empty() || before.ends_with(':'))
        {
            let placed = self.asked.contains(&at);
            let Some(end) = self.end(to) else {
                return;
            };
            // A choice before it that nothing else comes between.
            if before.is_empty()
                && !placed
                && at > 0
                && let Some(both) = end.chosen(&self.texts[at - 1])
            {
                changed[at - 1] = both;
                changed[at] = String::new();
                return;
            }
            let way = end.behind_statements(before);
            if way.len() <= LINE {
                changed[at] = way;
            }
        } else if let Some(label) = self.label_at(at + 1)
            && let Some(end) = self.end(label)
            && let Some(both) = end.chosen(text)
        {
            changed[at] = both;
        }
    }

    /// A label that stands before a line.
    fn label_at(&self, at: usize) -> Option<Label> {
        let mut labels = self.placed.iter();
        labels
            .find(|(_, line)| **line == at)
            .map(|(label, _)| *label)
    }

    /// The end of a loop that begins at a label.
    fn end(&mut self, to: Label) -> Option<End> {
        let from = *self.placed.get(&to)?;
        let length = self
            .texts
            .get(from..)?
            .iter()
            .position(|t| t.starts_with("NEXT"))?;
        let texts = self.texts.get(from..=from + length)?;
        let statements = texts.join(":");
        let leaves = |word| pieces(&statements).contains(&Piece::Word(word));
        if short_length(&statements) > LONGEST
            || ["IF", "FOR", "GOTO", "DEF"].iter().any(|w| leaves(w))
        {
            return None;
        }
        let last = from + length;
        let label = match self.behind.get(&last) {
            Some(label) => *label,
            None => self.labels.next(),
        };
        self.behind.insert(last, label);
        let only = ["I%"].into_iter().find(|name| self.is_read_once(name));
        let only = only.filter(|name| reads(&statements, name) == 1);
        Some(End {
            statements,
            behind: label,
            only: only.map(str::to_owned),
        })
    }

    /// Whether a variable is read in one place of the program.
    fn is_read_once(&self, name: &str) -> bool {
        self.texts
            .iter()
            .map(|text| reads(text, name))
            .sum::<usize>()
            == 1
    }
}

/// How often some statements read a resident variable, more or less: what they
/// assign they do not read.
fn reads(text: &str, name: &str) -> usize {
    let all = text.matches(name).count();
    let assigned = text.matches(&format!("{name}=")).count();
    all - assigned
}

impl End {
    /// The end behind some statements that end in `:` or are none.
    fn behind_statements(&self, before: &str) -> String {
        if let Some(name) = &self.only {
            let whole = before.strip_suffix(':').unwrap_or(before);
            let from = whole.rfind([':', ' ']).map_or(0, |at| at + 1);
            let (front, last) = whole.split_at_checked(from).unwrap_or(("", whole));
            if let Some(value) = assigned(last, name) {
                return format!("{front}{}", self.with(name, value));
            }
        }
        format!("{before}{}:GOTO {}", self.statements, self.behind)
    }

    /// Both ways of a choice of what is read there, each with the end.
    fn chosen(&self, text: &str) -> Option<String> {
        let name = self.only.as_ref()?;
        let (test, ways) = text.strip_prefix("IF ")?.split_once(" THEN ")?;
        let (yes, no) = ways.split_once(" ELSE ")?;
        let [yes, no] = [assigned(yes, name)?, assigned(no, name)?];
        let [yes, no] = [yes, no].map(|value| self.with(name, value));
        Some(format!("IF {test} THEN {yes} ELSE {no}"))
    }

    /// The end with a value in a variable's place.
    fn with(&self, name: &str, value: &str) -> String {
        let statements = self.statements.replacen(name, value, 1);
        format!("{statements}:GOTO {}", self.behind)
    }
}

/// What a statement assigns to a variable, where that is a number or a variable.
fn assigned<'t>(statement: &'t str, name: &str) -> Option<&'t str> {
    let value = statement.strip_prefix(name)?.strip_prefix('=')?;
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
    (!value.is_empty() && value.chars().all(plain)).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines with labels `@n` before them; `@n` in a text is one.
    fn program(lines: &[&str], labels: &mut Labels) -> Lines {
        let all = [labels.next(), labels.next(), labels.next()];
        let mut out = Lines::default();
        for text in lines {
            let mut text = (*text).to_owned();
            for (k, label) in all.iter().enumerate() {
                if let Some(rest) = text.strip_prefix(&format!("@{k} ")) {
                    out.place(*label);
                    text = rest.to_owned();
                }
                text = text.replace(&format!("@{k}"), &label.to_string());
            }
            out.line(text, None);
        }
        out
    }

    fn written(lines: &[&str]) -> String {
        let mut labels = Labels::default();
        let mut out = copied(program(lines, &mut labels), &mut labels);
        out.remove_empty();
        out.finish().0
    }

    #[test]
    fn an_end_stands_on_each_way_to_it() {
        let source = [
            "FOR X%=0 TO 9",
            "IF x<0 THEN I%=3:GOTO @0",
            "IF x<1 THEN @1",
            "IF x<2 THEN I%=1 ELSE I%=ink%",
            "GOTO @0",
            "@1 I%=x+1:GOTO @0",
            "IF x<3 THEN I%=1 ELSE I%=0",
            "@0 ?at%=?at%+bits%?I%",
            "NEXT",
            "X%=7",
            "END",
        ];
        let expected = "10FOR X%=0 TO 9\n20IF x<0 THEN ?at%=?at%+bits%?3:NEXT:GOTO 90\n\
            30IF x<1 THEN 50\n\
            40IF x<2 THEN ?at%=?at%+bits%?1:NEXT:GOTO 90 ELSE ?at%=?at%+bits%?ink%:NEXT:GOTO 90\n\
            50I%=x+1:?at%=?at%+bits%?I%:NEXT:GOTO 90\n\
            60IF x<3 THEN ?at%=?at%+bits%?1:NEXT:GOTO 90 ELSE ?at%=?at%+bits%?0:NEXT:GOTO 90\n\
            70?at%=?at%+bits%?I%\n80NEXT\n90X%=7\n100END\n";
        assert_eq!(written(&source), expected);
    }

    #[test]
    fn what_is_read_elsewhere_is_assigned() {
        let source = [
            "FOR X%=0 TO 9",
            "IF x<0 THEN I%=3:GOTO @0",
            "I%=2",
            "@0 ?at%=bits%?I%",
            "NEXT",
            "PRINT I%",
        ];
        let text = written(&source);
        assert!(text.contains("20IF x<0 THEN I%=3:?at%=bits%?I%:NEXT:GOTO 60\n"));
    }

    #[test]
    fn long_ends_and_those_that_ask_stand_once() {
        let long = "a%=b%+c%:d%=e%+f%:g%=h%+i%:j%=k%+l%:m%=n%+o%";
        for end in ["IF I% THEN GCOL 0,I%", long] {
            let source = [
                "IF x<0 THEN I%=3:GOTO @0",
                "I%=2",
                &format!("@0 {end}"),
                "NEXT",
            ];
            let text = written(&source);
            assert!(text.contains("10IF x<0 THEN I%=3:GOTO 30\n"), "{text}");
        }
    }
}
