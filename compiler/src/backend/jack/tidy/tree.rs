//! Lines as a tree of blocks, and the variables that a line names.

use super::super::Line;
use std::collections::BTreeMap;
use std::iter::Peekable;

/// A statement: a line of its own, or one with blocks. An `if` may have an empty arm.
#[derive(Clone, Debug)]
pub(super) enum Item {
    Line(Line),
    If {
        head: Line,
        yes: Vec<Item>,
        no: Vec<Item>,
    },
    While {
        head: Line,
        body: Vec<Item>,
    },
}

pub(super) fn parsed(lines: Vec<Line>) -> Vec<Item> {
    block(&mut lines.into_iter().peekable())
}

/// The statements up to the block's closing brace, which is left.
fn block(lines: &mut Peekable<impl Iterator<Item = Line>>) -> Vec<Item> {
    let mut items = Vec::new();
    while let Some(head) = lines.next_if(|line| line.text != "}") {
        let opens = head.text.ends_with('{');
        items.push(match head.text.split_once(" (") {
            Some(("while", _)) if opens => {
                let body = block(lines);
                lines.next();
                Item::While { head, body }
            }
            Some(("if", _)) if opens => {
                let yes = block(lines);
                lines.next();
                let mut no = Vec::new();
                if lines.next_if(|line| line.text == "else {").is_some() {
                    no = block(lines);
                    lines.next();
                }
                Item::If { head, yes, no }
            }
            _ => Item::Line(head),
        });
    }
    items
}

pub(super) fn written(items: Vec<Item>) -> Vec<Line> {
    let mut lines = Vec::new();
    write(items, 0, &mut lines);
    lines
}

fn write(items: Vec<Item>, depth: usize, lines: &mut Vec<Line>) {
    for item in items {
        match item {
            Item::Line(line) => lines.push(Line { depth, ..line }),
            Item::While { head, body } => {
                let like = |text: &str| Line {
                    depth,
                    text: text.to_owned(),
                    span: head.span,
                };
                let end = like("}");
                lines.push(Line { depth, ..head });
                write(body, depth + 1, lines);
                lines.push(end);
            }
            Item::If { head, yes, no } => {
                let like = |text: &str| Line {
                    depth,
                    text: text.to_owned(),
                    span: head.span,
                };
                let (end, other) = (like("}"), like("else {"));
                let (head, yes, no) = match (yes.is_empty(), denied(condition(&head.text))) {
                    (true, _) => (if_of(&head, &negated(condition(&head.text))), no, yes),
                    // A `not` is a command.
                    (false, Some(other)) if !no.is_empty() => (if_of(&head, other), no, yes),
                    _ => (head, yes, no),
                };
                lines.push(Line { depth, ..head });
                write(yes, depth + 1, lines);
                lines.push(end.clone());
                if !no.is_empty() {
                    lines.push(other);
                    write(no, depth + 1, lines);
                    lines.push(end);
                }
            }
        }
    }
}

/// How many lines they are, without those that only close a block.
pub(super) fn length(items: &[Item]) -> usize {
    let of = |item: &Item| match item {
        Item::Line(_) => 1,
        Item::While { body, .. } => 2 + length(body),
        Item::If { yes, no, .. } => 2 + length(yes) + length(no) + usize::from(!no.is_empty()),
    };
    items.iter().map(of).sum()
}

/// Whether one of the lines is so.
pub(super) fn any(items: &[Item], is: &impl Fn(&str) -> bool) -> bool {
    items.iter().any(|item| match item {
        Item::Line(line) => is(&line.text),
        Item::While { head, body } => is(&head.text) || any(body, is),
        Item::If { head, yes, no } => is(&head.text) || any(yes, is) || any(no, is),
    })
}

/// A line without what is said behind it.
pub(super) fn code(text: &str) -> &str {
    text.split(" //").next().unwrap_or_default()
}

/// What an `if` or a `while` asks.
pub(super) fn condition(head: &str) -> &str {
    let (_, rest) = head.split_once(" (").unwrap_or_default();
    rest.strip_suffix(") {").unwrap_or_default()
}

/// The head of an `if` that asks something else.
pub(super) fn if_of(head: &Line, condition: &str) -> Line {
    Line {
        text: format!("if ({condition}) {{"),
        ..head.clone()
    }
}

/// The variable that a line assigns, and what; none of an element of an array.
pub(super) fn assignment(text: &str) -> Option<(&str, &str)> {
    let rest = code(text).strip_prefix("let ")?.strip_suffix(';')?;
    let (name, value) = rest.split_once(" = ")?;
    (!name.contains('[')).then_some((name, value))
}

/// A variable in a line: where its name begins, the name, and whether it (or an element of
/// it) is assigned.
pub(super) fn variables(text: &str) -> impl Iterator<Item = (usize, &str, bool)> {
    let code = code(text);
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let words = code.split(move |c| !is_part(c)).filter(|w| !w.is_empty());
    words.filter_map(move |word| {
        let at = word.as_ptr() as usize - code.as_ptr() as usize;
        let (before, after) = (&code[..at], &code[at + word.len()..]);
        let is_name = !word.starts_with(|c: char| c.is_ascii_digit());
        let called = before.ends_with('.') || after.starts_with(['.', '(']);
        (is_name && !called).then(|| (at, word, before.ends_with("let ")))
    })
}

/// Whether a line reads a variable.
pub(super) fn reads(text: &str, name: &str) -> bool {
    variables(text).any(|(_, word, assigned)| word == name && !assigned)
}

/// How often variables are read, and assigned.
#[derive(Default)]
pub(super) struct Counts(BTreeMap<String, [usize; 2]>);

impl Counts {
    pub fn of<'l>(lines: impl Iterator<Item = &'l Line>) -> Counts {
        let mut counts = Counts::default();
        for line in lines {
            for (_, word, assigned) in variables(&line.text) {
                match counts.0.get_mut(word) {
                    Some(count) => count[usize::from(assigned)] += 1,
                    None => {
                        let count = [usize::from(!assigned), usize::from(assigned)];
                        counts.0.insert(word.to_owned(), count);
                    }
                }
            }
        }
        counts
    }

    pub fn get(&self, name: &str) -> [usize; 2] {
        self.0.get(name).copied().unwrap_or_default()
    }
}

/// Whether an expression is a name, a number, a call, an element, or in parentheses.
pub(super) fn is_term(text: &str) -> bool {
    let mut depth = 0usize;
    let mut closed = false;
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' => {
                // A second pair is of something else.
                if depth == 0 && closed {
                    return false;
                }
                depth += 1;
            }
            ')' | ']' => {
                depth = depth.saturating_sub(1);
                closed = depth == 0;
            }
            _ if depth > 0 => {}
            '~' | '-' if at == 0 => return false,
            ' ' => return false,
            _ if closed => return false,
            _ => {}
        }
    }
    true
}

/// An expression where a term is wanted.
pub(super) fn term(text: &str) -> String {
    match is_term(text) {
        true => text.to_owned(),
        false => format!("({text})"),
    }
}

/// What a `~` before it makes a condition of, if one stands there.
pub(super) fn denied(condition: &str) -> Option<&str> {
    let rest = condition.strip_prefix('~').filter(|rest| is_term(rest))?;
    let inner = rest.strip_prefix('(').and_then(|r| r.strip_suffix(')'));
    Some(inner.unwrap_or(rest))
}

/// The opposite of a condition.
pub(super) fn negated(condition: &str) -> String {
    match (denied(condition), condition) {
        (Some(other), _) => other.to_owned(),
        (_, "true") => "false".to_owned(),
        (_, "false") => "true".to_owned(),
        _ => format!("~{}", term(condition)),
    }
}

/// A remark in which a name is said in another way.
pub(super) fn renamed(remark: &str, name: &str, said: &str) -> String {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let (mut all, mut rest) = (String::new(), remark);
    while let Some(start) = rest.find(is_part) {
        let (before, from) = rest.split_at(start);
        let end = from.find(|c| !is_part(c)).unwrap_or(from.len());
        let (word, behind) = from.split_at(end);
        all += before;
        all += &match word == name {
            true if all.ends_with('(') && behind.starts_with(')') => said.to_owned(),
            true => term(said),
            false => word.to_owned(),
        };
        rest = behind;
    }
    all + rest
}
