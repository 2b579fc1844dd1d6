//! The program beside its bytes.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::Assembly;

/// Bytes shown on a line; the rest of a long one is left out.
const SHOWN: usize = 8;

impl Assembly {
    /// The source with the address and the bytes of every line before it.
    pub fn listing(&self, source: &str) -> String {
        let by_line: BTreeMap<u32, _> = self.lines.iter().map(|span| (span.line, span)).collect();
        let mut text = String::new();
        for (line, source) in (1u32..).zip(source.lines()) {
            let mut left = String::new();
            if let Some(span) = by_line.get(&line) {
                let start = usize::from(span.address - self.origin);
                let bytes = self.bytes.iter().skip(start).take(span.length as usize);
                let _ = write!(left, "{:04X} ", span.address);
                for byte in bytes.take(SHOWN) {
                    let _ = write!(left, " {byte:02X}");
                }
                if span.length as usize > SHOWN {
                    left.push_str(" +");
                }
            }
            let _ = writeln!(text, "{}", format!("{left:<32}{source}").trim_end());
        }
        text
    }
}
