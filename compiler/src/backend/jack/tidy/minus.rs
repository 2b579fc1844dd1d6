//! Numbers below 0: `a + (-5)` is `a - 5`, and `(-5) + a` too, which is a command less.

use super::tree::{Item, code};

/// Writes all lines so.
pub(super) fn subtracted(items: &mut [Item]) {
    for item in items {
        match item {
            Item::Line(line) => line.text = written(&line.text),
            Item::While { head, body } => {
                head.text = written(&head.text);
                subtracted(body);
            }
            Item::If { head, yes, no } => {
                head.text = written(&head.text);
                subtracted(yes);
                subtracted(no);
            }
        }
    }
}

/// A line, whose remark stays as it is.
fn written(text: &str) -> String {
    let (mut rest, remark) = text.split_at(code(text).len());
    let mut all = String::new();
    while let Some((before, number, behind)) = next(rest) {
        all += before;
        let plus = all.strip_suffix(" + ").map(|a| (a.len(), " - "));
        let minus = all.strip_suffix(" - ").map(|a| (a.len(), " + "));
        rest = behind;
        if let Some((end, sign)) = plus.or(minus) {
            all.truncate(end);
            all += &format!("{sign}{number}");
        } else if let Some((term, behind)) = added(behind).filter(|_| begins(&all)) {
            all += &format!("{term} - {number}");
            rest = behind;
        } else {
            all += &format!("(-{number})");
        }
    }
    all + rest + remark
}

/// What stands before a number below 0, that number without its sign, and what is behind it.
fn next(text: &str) -> Option<(&str, &str, &str)> {
    let mut from = 0;
    while let Some(at) = text[from..].find("(-").map(|at| from + at) {
        let digits = &text[at + 2..];
        let end = digits.find(|c: char| !c.is_ascii_digit())?;
        if end > 0 && digits[end..].starts_with(')') {
            return Some((&text[..at], &digits[..end], &digits[end + 1..]));
        }
        from = at + 2;
    }
    None
}

/// Whether an expression begins behind a text: not in the middle of a sum, nor as a call's
/// only argument.
fn begins(text: &str) -> bool {
    text.ends_with(" = ") && text.starts_with("let ") && text.matches(" = ").count() == 1
        || text.ends_with(['(', '['])
        || text.ends_with(", ")
}

/// The term that is added and all that is, with what comes behind it.
fn added(text: &str) -> Option<(&str, &str)> {
    let text = text.strip_prefix(" + ")?;
    let mut depth = 0usize;
    for (at, c) in text.char_indices() {
        match c {
            ')' | ']' | ',' | ';' if depth == 0 => return Some(text.split_at(at)),
            ' ' if depth == 0 => return None,
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::written;

    #[test]
    fn numbers_below_0_are_subtracted() {
        for (text, simple) in [
            (
                "let a = b + (-5); // b + (-5)",
                "let a = b - 5; // b + (-5)",
            ),
            ("let a = (-5) + b[k];", "let a = b[k] - 5;"),
            (
                "let a = f(b, (-5) + (c - d));",
                "let a = f(b, (c - d) - 5);",
            ),
            ("let a = b - (-5);", "let a = b + 5;"),
            ("let a = b * ((-5) + c + d);", "let a = b * ((-5) + c + d);"),
            ("if (a < (-5)) {", "if (a < (-5)) {"),
            ("let a = (-b) + (-5);", "let a = (-b) - 5;"),
            ("let a = f((-5), b);", "let a = f((-5), b);"),
        ] {
            assert_eq!(written(text), simple);
        }
    }
}
