//! Texts of an editor: places in UTF-16 units against bytes, edits of ranges, files' addresses.
//!
//! A place of an editor is a line and a number of UTF-16 units. What lies beyond its line or
//! text means its end, and the middle of a pair of surrogates the character's begin, so that
//! no place is wrong.

use lsp_types::{Position, Range, TextDocumentContentChangeEvent, Uri};
use slowlight_compiler::source::Span;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Where the lines of a text begin. They end at `\n`, `\r\n` or `\r`.
#[derive(Clone, Debug)]
pub struct Lines {
    starts: Vec<usize>,
}

impl Lines {
    /// Of a text.
    pub fn new(text: &str) -> Lines {
        let bytes = text.as_bytes();
        let ends = bytes.iter().enumerate().filter(|&(k, b)| match b {
            b'\n' => true,
            b'\r' => bytes.get(k + 1) != Some(&b'\n'),
            _ => false,
        });
        Lines {
            starts: std::iter::once(0).chain(ends.map(|(k, _)| k + 1)).collect(),
        }
    }

    /// The place of a byte; of one inside a character, that character's.
    pub fn position(&self, text: &str, byte: usize) -> Position {
        let byte = floor(text, byte);
        let line = self.starts.partition_point(|s| *s <= byte).max(1) - 1;
        let start = self.starts.get(line).copied().unwrap_or(0);
        let before = text.get(start..byte).unwrap_or("");
        Position::new(
            u32::try_from(line).unwrap_or(u32::MAX),
            u32::try_from(before.encode_utf16().count()).unwrap_or(u32::MAX),
        )
    }

    /// The byte of a place.
    pub fn byte(&self, text: &str, at: Position) -> usize {
        let Some(&start) = self.starts.get(at.line as usize) else {
            return text.len();
        };
        let next = self.starts.get(at.line as usize + 1).copied();
        let line = text.get(start..next.unwrap_or(text.len())).unwrap_or("");
        let line = line.trim_end_matches(['\n', '\r']);
        let mut units = 0;
        for (k, c) in line.char_indices() {
            units += c.len_utf16();
            if units > at.character as usize {
                return start + k;
            }
        }
        start + line.len()
    }

    /// The range of a place in the text.
    pub fn range(&self, text: &str, span: Span) -> Range {
        let at = span.range();
        Range::new(self.position(text, at.start), self.position(text, at.end))
    }
}

/// The range of a place in a text.
pub fn range_of(text: &str, span: Span) -> Range {
    Lines::new(text).range(text, span)
}

/// The greatest boundary of characters that is not behind a byte.
fn floor(text: &str, byte: usize) -> usize {
    let mut at = byte.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Does to a text what an editor says was done to it.
pub fn edit(text: &mut String, change: TextDocumentContentChangeEvent) {
    let Some(range) = change.range else {
        *text = change.text;
        return;
    };
    let lines = Lines::new(text);
    let start = lines.byte(text, range.start);
    let end = lines.byte(text, range.end);
    text.replace_range(start.min(end)..end.max(start), &change.text);
}

/// A file's one name.
pub fn full(path: &Path) -> PathBuf {
    std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}

/// The file that an address names; none of another scheme, or of no path.
pub fn path_of(uri: &Uri) -> Option<PathBuf> {
    let rest = uri.as_str().strip_prefix("file://")?;
    let slash = rest.find('/')?;
    let (host, path) = rest.split_at(slash);
    if !matches!(host, "" | "localhost") {
        return None;
    }
    let path = path.split(['?', '#']).next()?;
    let mut bytes = Vec::new();
    let mut left = path.bytes();
    while let Some(byte) = left.next() {
        let byte = match byte {
            b'%' => {
                let digits = [left.next()?, left.next()?];
                u8::from_str_radix(std::str::from_utf8(&digits).ok()?, 16).ok()?
            }
            byte => byte,
        };
        bytes.push(byte);
    }
    let path = String::from_utf8(bytes)
        .ok()
        .filter(|p| !p.contains('\0'))?;
    // `/c:/a` is Windows' `c:/a`.
    let drive = cfg!(windows) && path.as_bytes().get(2) == Some(&b':');
    Some(PathBuf::from(if drive { &path[1..] } else { &path[..] }))
}

/// The address of a file with a full path.
pub fn uri_of(path: &Path) -> Option<Uri> {
    let path = path.to_str().filter(|_| path.is_absolute())?;
    let path = path.strip_prefix(r"\\?\").unwrap_or(path);
    let mut out = "file://".to_owned();
    if !path.starts_with('/') {
        out.push('/');
    }
    for byte in path.bytes() {
        match byte {
            b'\\' if cfg!(windows) => out.push('/'),
            b'/' | b'-' | b'.' | b'_' | b'~' => out.push(byte as char),
            _ if byte.is_ascii_alphanumeric() => out.push(byte as char),
            _ => out += &format!("%{byte:02X}"),
        }
    }
    Uri::from_str(&out).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_counted_in_utf_16() {
        let text = "a\u{e9}\u{1f600}z\r\nb\rc\n";
        let lines = Lines::new(text);
        let at = |line, unit| lines.byte(text, Position::new(line, unit));
        assert_eq!(
            [0, 1, 2, 3, 4, 5, 99].map(|u| at(0, u)),
            [0, 1, 3, 3, 7, 8, 8]
        );
        assert_eq!(
            [at(1, 0), at(1, 9), at(2, 0), at(3, 0), at(9, 9)],
            [10, 11, 12, 14, 14]
        );
        for (byte, line, unit) in [
            (0, 0, 0),
            (4, 0, 2),
            (7, 0, 4),
            (8, 0, 5),
            (12, 2, 0),
            (99, 3, 0),
        ] {
            assert_eq!(
                lines.position(text, byte),
                Position::new(line, unit),
                "{byte}"
            );
        }
    }

    #[test]
    fn edits_that_fit_no_text_change_what_there_is() {
        let change = |from: (u32, u32), to: (u32, u32), text: &str| {
            let range = Range::new(Position::new(from.0, from.1), Position::new(to.0, to.1));
            TextDocumentContentChangeEvent {
                range: Some(range),
                range_length: None,
                text: text.to_owned(),
            }
        };
        let mut text = "ab\n\u{1f600}".to_owned();
        edit(&mut text, change((1, 1), (1, 1), "x"));
        assert_eq!(text, "ab\nx\u{1f600}");
        edit(&mut text, change((9, 9), (0, 1), ""));
        assert_eq!(text, "a");
    }

    #[test]
    fn addresses_are_paths_and_back() {
        let path = Path::new("/tmp/two mirrors/\u{e9}%.scn");
        let uri = uri_of(path).expect("an address");
        assert_eq!(uri.as_str(), "file:///tmp/two%20mirrors/%C3%A9%25.scn");
        assert_eq!(path_of(&uri).as_deref(), Some(path));
        for other in [
            "untitled:a",
            "file://elsewhere/a",
            "file:///%ff",
            "git:/a.scn",
        ] {
            assert_eq!(
                path_of(&Uri::from_str(other).expect("an address")),
                None,
                "{other}"
            );
        }
    }
}
