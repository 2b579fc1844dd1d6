//! Jumps that lead to another jump go where that one goes.
//!
//! A way that ends in `v%=FALSE:GOTO a` where line a is `IF NOT v% THEN b` goes
//! to b: the test would tell what is known. Where line a is a choice between few
//! statements, those of the known way are carried out on the way. (Jump threading
//! and tail duplication: Aho, Lam, Sethi and Ullman, Compilers, 2nd edition, 8.7.3.)

use super::lines::jump;
use super::lines::{Label, Labels, Lines};
use super::test_line::opposite;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// How many jumps are followed from one.
const HOPS: usize = 8;

/// The lines with every jump to a jump shortened.
///
/// `longer`: statements may stand on several ways, which takes memory.
pub fn threaded(lines: Lines, labels: &mut Labels, longer: bool) -> Lines {
    let lines = if longer {
        decided(lines, labels)
    } else {
        lines
    };
    let texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let mut road = Road {
        placed: lines.labelled().collect(),
        behind: FxHashMap::default(),
        texts: &texts,
        labels,
        longer,
    };
    let changed: Vec<String> = texts.iter().map(|text| road.shortened(text)).collect();
    let behind = road.behind;
    lines.with_texts(changed, &behind)
}

/// A flag that one way of a choice sets and the next line asks for is asked for on
/// the other way only, where the first jumps then.
fn decided(lines: Lines, labels: &mut Labels) -> Lines {
    let texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let mut changed: Vec<Vec<String>> = Vec::new();
    let mut behind = FxHashMap::default();
    // From the last on: what becomes of the next line is what is met.
    for (at, text) in texts.iter().enumerate().rev() {
        let next = changed.last().and_then(|next| next.first());
        changed.push(match next.and_then(|next| split(text, next)) {
            Some((sets, otherwise)) => {
                let label = labels.next();
                behind.insert(at, label);
                vec![format!("{sets}:GOTO {label}"), otherwise]
            }
            None => vec![text.clone()],
        });
    }
    changed.reverse();
    lines.with_lines(changed, &behind)
}

/// The two lines of `IF c THEN v%=TRUE ELSE ...v%=e` before a line that jumps where v% holds,
/// or where it does not.
fn split(text: &str, next: &str) -> Option<(String, String)> {
    let (sets, otherwise) = text.split_once(" ELSE ")?;
    let (_, set) = sets.strip_prefix("IF ")?.split_once(" THEN ")?;
    let (name, value) = set.split_once('=')?;
    let plain = |text: &str| !text.contains([':', ' ']);
    let asks = next.strip_prefix("IF ")?;
    let asks = asks.strip_prefix("NOT ").unwrap_or(asks);
    let known = ["TRUE", "FALSE"].contains(&value);
    let way = asks.strip_prefix(name)?.strip_prefix(" THEN ")?;
    let jumps = jump(next).is_some() && !way.contains("IF ") && !way.contains(" ELSE ");
    // What the other way does before it sets the flag is no matter here.
    let set = otherwise.rsplit(':').next().unwrap_or_default();
    let same = set.split_once('=').is_some_and(|(of, _)| of == name);
    let leaves = ["IF ", "ELSE", "GOTO", "NEXT"];
    let lone = plain(name) && same && !leaves.iter().any(|word| otherwise.contains(word));
    (known && jumps && lone).then(|| (sets.to_owned(), otherwise.to_owned()))
}

struct Road<'t> {
    /// The line that each label stands before.
    placed: FxHashMap<Label, usize>,
    /// New labels, by the line that they stand behind.
    behind: FxHashMap<usize, Label>,
    texts: &'t [String],
    labels: &'t mut Labels,
    longer: bool,
}

impl Road<'_> {
    /// A line whose jump, if it ends in one, goes as far as is known.
    fn shortened(&mut self, text: &str) -> String {
        let Some((before, mut to)) = jump(text) else {
            return text.to_owned();
        };
        let first = to;
        let mut known = Known::default();
        let mut before = before.to_owned();
        if let Some(statements) = before.strip_suffix(":GOTO ") {
            known.learn(last(statements));
        }
        for _ in 0..HOPS {
            match self.next(to, &known) {
                Some(Step::Jump(next)) if next != to => to = next,
                Some(Step::Way(way, next)) => {
                    let Some(statements) = before.strip_suffix("GOTO ") else {
                        break;
                    };
                    if statements.len() + way.len() > LONG {
                        break;
                    }
                    before = statements.to_owned();
                    for statement in way.split(':') {
                        if !known.has(statement) {
                            known.learn(statement);
                            before = without_flag(&before, statement);
                            before = format!("{before}{statement}:");
                        }
                    }
                    before.push_str("GOTO ");
                    to = next;
                }
                _ => break,
            }
        }
        // A procedure ends wherever it says so.
        let at = self.placed.get(&to).and_then(|at| self.texts.get(*at));
        if at.is_some_and(|text| text == "ENDPROC") {
            let before = before.strip_suffix("GOTO ").unwrap_or(&before);
            return format!("{before}ENDPROC");
        }
        if to == first {
            return text.to_owned();
        }
        format!("{before}{to}")
    }

    /// Where a jump to a label goes on to at once, or what it does on the way.
    fn next(&mut self, to: Label, known: &Known) -> Option<Step> {
        let at = *self.placed.get(&to)?;
        let text = self.texts.get(at)?;
        let goes = jump(text);
        if let Some(("GOTO ", next)) = goes {
            return Some(Step::Jump(next));
        }
        let (test, ways) = text.strip_prefix("IF ")?.split_once(" THEN ")?;
        let holds = match test.strip_prefix("NOT ") {
            Some(test) => !known.of(test)?,
            None => known.of(test)?,
        };
        if let Some((before, next)) = goes {
            if before.contains(" ELSE ") || before.matches("IF ").count() > 1 {
                return None;
            }
            if !holds {
                return Some(Step::Jump(self.label_behind(at)));
            }
            let (_, way) = before.split_once(" THEN ")?;
            let way = way.strip_suffix("GOTO ").unwrap_or_default();
            return Some(match way.strip_suffix(':') {
                Some(_) if !self.longer => return None,
                Some(way) => Step::Way(way.to_owned(), next),
                None => Step::Jump(next),
            });
        }
        let (yes, no) = ways.split_once(" ELSE ").unwrap_or((ways, ""));
        let way = if holds { yes } else { no }.to_owned();
        let plain = !ways.contains("IF ") && !way.contains("GOTO");
        let behind = plain.then(|| self.label_behind(at))?;
        Some(match way.is_empty() {
            true => Step::Jump(behind),
            false if !self.longer => return None,
            false => Step::Way(way, behind),
        })
    }

    /// A label behind a line.
    fn label_behind(&mut self, at: usize) -> Label {
        let label = match self.behind.get(&at) {
            Some(label) => *label,
            None => self.labels.next(),
        };
        self.behind.insert(at, label);
        self.placed.insert(label, at + 1);
        label
    }
}

/// Statements without a last one that sets the flag that another one sets behind it.
fn without_flag(before: &str, statement: &str) -> String {
    let name = statement.split_once('=').map_or("", |(name, _)| name);
    let set = ["TRUE", "FALSE"].map(|value| format!("{name}={value}:"));
    let front = set.iter().find_map(|set| before.strip_suffix(set.as_str()));
    let whole = |front: &&str| front.ends_with([':', ' ']);
    front.filter(whole).unwrap_or(before).to_owned()
}

/// What a jump meets.
enum Step {
    Jump(Label),
    /// Statements, and where it goes on behind them.
    Way(String, Label),
}

/// How long a line may become by statements on the way.
const LONG: usize = 120;

/// Variables and tests of which it is known whether they hold, and tests of which it is
/// known that they come out as a flag says, or as it does not.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known {
    holds: BTreeMap<String, bool>,
    told: BTreeMap<String, (String, bool)>,
}

impl Known {
    /// Whether a variable or test holds, where that is known.
    pub fn of(&self, test: &str) -> Option<bool> {
        let found = self.holds.get(test).copied();
        found.or_else(|| Some(!*self.holds.get(&opposite(test)?)?))
    }

    /// The test of a flag that comes out as another does.
    pub fn told_by(&self, test: &str) -> Option<String> {
        let (flag, holds) = match self.told.get(test) {
            Some((flag, holds)) => (flag, *holds),
            None => {
                let (flag, holds) = self.told.get(&opposite(test)?)?;
                (flag, !holds)
            }
        };
        Some(match holds {
            true => flag.clone(),
            false => format!("NOT {flag}"),
        })
    }

    /// Nothing is known any more of what a name is in.
    fn forget(&mut self, name: &str) {
        let within = |text: &str| {
            let mut words = text.split(|c: char| !(c.is_ascii_alphanumeric() || "_%".contains(c)));
            words.any(|word| word == name)
        };
        self.holds.retain(|test, _| !within(test));
        (self.told).retain(|test, (flag, _)| flag != name && !within(test));
    }

    /// Whether a statement assigns what the variable has already.
    fn has(&self, statement: &str) -> bool {
        let holds = |name: &str, value| match value {
            "TRUE" => self.of(name) == Some(true),
            "FALSE" => self.of(name) == Some(false),
            _ => false,
        };
        (statement.split_once('=')).is_some_and(|(name, value)| holds(name, value))
    }

    /// What a statement tells of a variable; what is no assignment may change any.
    pub fn learn(&mut self, statement: &str) {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
        // What counts a loop's turns is no flag.
        if statement.starts_with("NEXT") {
            self.holds.retain(|test, _| test.chars().all(plain));
            self.told.clear();
            return;
        }
        let Some((name, value)) = (statement.split_once('='))
            .filter(|(name, _)| !name.is_empty() && name.chars().all(plain))
        else {
            *self = Known::default();
            return;
        };
        let holds = match value.strip_prefix("NOT ") {
            _ if value == "TRUE" || value == "FALSE" => Some(value == "TRUE"),
            Some(flag) if flag.chars().all(plain) => self.of(flag).map(|holds| !holds),
            None if value.chars().all(plain) => self.of(value),
            _ => None,
        };
        self.forget(name);
        if let Some(holds) = holds {
            self.holds.insert(name.to_owned(), holds);
        }
    }
}

impl Known {
    /// What follows from a test's outcome: of a flag or a comparison, or the contrary of
    /// one, or that a flag is what another test is.
    pub fn assume(&mut self, test: &str, holds: bool) {
        let (name, holds) = match test.strip_prefix("NOT ") {
            Some(name) => (name, !holds),
            None => (test, holds),
        };
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let flag = name.strip_suffix('%').is_some_and(|f| f.chars().all(plain));
        if flag || compares(name) {
            self.holds.insert(name.to_owned(), holds);
        }
        if let Some((flag, other)) = name.split_once("%=(")
            && flag.chars().all(plain)
            && let Some(other) = other.strip_suffix(')').filter(|other| compares(other))
        {
            (self.told).insert(other.to_owned(), (format!("{flag}%"), holds));
        }
    }

    /// What is known on two ways that meet.
    pub fn met(mut self, other: &Known) -> Known {
        self.holds
            .retain(|test, holds| other.of(test) == Some(*holds));
        (self.told).retain(|test, told| other.told.get(test) == Some(told));
        self
    }
}

/// Whether a test compares two values that change by assignments alone.
fn compares(test: &str) -> bool {
    !test.contains(['(', ' ', '?', '!', '$']) && opposite(test).is_some()
}

/// The last of some statements, without the test before it.
fn last(statements: &str) -> &str {
    let from = statements.rfind([':', ' ']).map_or(0, |at| at + 1);
    &statements[from..]
}

#[cfg(test)]
mod tests;
