//! What stands around a place of a text that may not be read yet: brackets, calls, comments.

/// A bracket that is open at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bracket {
    /// Which.
    pub sign: u8,
    /// Where it stands.
    pub at: usize,
    /// Commas behind it, outside of brackets inside.
    pub commas: usize,
}

/// What is open where a text is cut.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Around {
    /// Brackets, the innermost last.
    pub brackets: Vec<Bracket>,
    /// Whether it is in a comment, a string or a character.
    pub quoted: bool,
    /// Where the item begins, or would.
    pub item: usize,
}

/// What is open before a byte of a text.
pub fn around(text: &str, byte: usize) -> Around {
    let bytes = text.as_bytes();
    let byte = byte.min(bytes.len());
    let mut found = Around::default();
    let mut at = 0;
    while at < byte {
        let sign = bytes[at];
        let end = match sign {
            b'/' if bytes.get(at + 1) == Some(&b'/') => Some(line_end(bytes, at)),
            b'"' => Some(closed(bytes, at, b'"')),
            b'\'' => Some(closed(bytes, at, b'\'')),
            _ => None,
        };
        if let Some(end) = end {
            found.quoted = byte < end || (byte == end && sign == b'/');
            at = end;
            continue;
        }
        match sign {
            b'(' | b'[' | b'{' => found.brackets.push(Bracket {
                sign,
                at,
                commas: 0,
            }),
            b')' | b']' | b'}' => {
                found.brackets.pop();
                if sign == b'}' && found.brackets.is_empty() {
                    found.item = at + 1;
                }
            }
            b',' => found
                .brackets
                .iter_mut()
                .next_back()
                .into_iter()
                .for_each(|b| b.commas += 1),
            b';' if found.brackets.is_empty() => found.item = at + 1,
            _ => {}
        }
        at += 1;
    }
    found
}

fn line_end(bytes: &[u8], at: usize) -> usize {
    let rest = bytes.get(at..).unwrap_or_default();
    let end = rest.iter().position(|b| *b == b'\n');
    at + end.unwrap_or(rest.len())
}

/// Behind what is quoted, which ends with its line; behind the text where nothing ends it.
fn closed(bytes: &[u8], at: usize, quote: u8) -> usize {
    let rest = bytes.get(at + 1..).unwrap_or_default();
    let end = rest.iter().position(|b| *b == quote || *b == b'\n');
    at + 1 + end.unwrap_or(rest.len()) + 1
}

/// A call around a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call<'t> {
    /// What is called.
    pub name: &'t str,
    /// Where its name begins.
    pub at: usize,
    /// Whether it is called on a value: `a.f(..)`.
    pub method: bool,
    /// Which argument the place is in, from 0, what it is called on not counted.
    pub argument: usize,
}

/// The innermost call whose arguments a place is among.
pub fn call<'t>(text: &'t str, around: &Around) -> Option<Call<'t>> {
    let open = around.brackets.iter().rev().find(|b| b.sign == b'(')?;
    // What is around a block does not take its statements for arguments.
    if around
        .brackets
        .iter()
        .any(|b| b.sign == b'{' && b.at > open.at)
    {
        return None;
    }
    let before = text.get(..open.at)?;
    let start = before.rfind(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    let start = start.map_or(0, |at| {
        at + before[at..].chars().next().map_or(1, char::len_utf8)
    });
    let name = before.get(start..).filter(|name| !name.is_empty())?;
    let method = before.get(..start)?.trim_end().ends_with('.');
    Some(Call {
        name,
        at: start,
        method,
        argument: open.commas,
    })
}

/// Where the value begins that ends at a byte and that a `.` there would be of.
pub fn receiver(text: &str, end: usize) -> Option<usize> {
    let bytes = text.as_bytes();
    let space = |b: &u8| b.is_ascii_whitespace();
    let word = |b: &u8| b.is_ascii_alphanumeric() || *b == b'_';
    let mut at = end;
    loop {
        // Groups of brackets, then a word before them.
        let from = at;
        while at > 0 && matches!(bytes.get(at - 1), Some(b')' | b']' | b'}')) {
            at = opening(bytes, at - 1)?;
        }
        while at > 0 && bytes.get(at - 1).is_some_and(word) {
            at -= 1;
        }
        if at == from {
            return None;
        }
        let mut before = at;
        while before > 0 && bytes.get(before - 1).is_some_and(space) {
            before -= 1;
        }
        if before == 0
            || bytes.get(before - 1) != Some(&b'.')
            || before >= 2 && bytes.get(before - 2) == Some(&b'.')
        {
            return Some(at);
        }
        before -= 1;
        while before > 0 && bytes.get(before - 1).is_some_and(space) {
            before -= 1;
        }
        at = before;
    }
}

fn opening(bytes: &[u8], close: usize) -> Option<usize> {
    let mut depth = 0usize;
    for at in (0..=close).rev() {
        match bytes.get(at)? {
            b')' | b']' | b'}' => depth += 1,
            b'(' | b'[' | b'{' => {
                depth -= 1;
                if depth == 0 {
                    return Some(at);
                }
            }
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn called(text: &str) -> Option<(&str, usize, bool)> {
        call(text, &around(text, text.len())).map(|c| (c.name, c.argument, c.method))
    }

    #[test]
    fn calls_are_found_in_what_is_not_finished() {
        assert_eq!(
            called("draw (x, y) = mix(1, f(2, 3), "),
            Some(("mix", 2, false))
        );
        assert_eq!(called("= a.trace(r, far: [1, 2"), Some(("trace", 1, true)));
        assert_eq!(called("= f(\"a(b\", ')', // g("), Some(("f", 2, false)));
        assert_eq!(called("= f({ let a = 1, "), None);
        assert_eq!(called("= (1, 2"), None);
        assert!(around("a // b", 6).quoted);
        assert!(around("use \"a", 6).quoted);
        assert!(!around("use \"a\";", 8).quoted);
    }

    #[test]
    fn what_a_point_is_behind_is_found() {
        let of = |text: &str| receiver(text, text.len()).map(|at| text[at..].to_owned());
        assert_eq!(of("a + h").as_deref(), Some("h"));
        assert_eq!(
            of("a + w.trace(ray(a, b)) . x").as_deref(),
            Some("w.trace(ray(a, b)) . x")
        );
        assert_eq!(of("1 * (a + b)").as_deref(), Some("(a + b)"));
        assert_eq!(of("t[1, 2]").as_deref(), Some("t[1, 2]"));
        assert_eq!(of("a +"), None);
        assert_eq!(of(")"), None);
    }
}
