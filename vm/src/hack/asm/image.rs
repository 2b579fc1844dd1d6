//! Images of the ROM as the book's tools keep them: a line of sixteen binary
//! digits for each word (`.hack`).

use super::{Faults, ROM_WORDS, overflow};
use crate::Fault;

/// Reads an image. Lines may be empty.
///
/// # Errors
/// The lines that are not sixteen binary digits, and too many words for the ROM.
pub fn read_image(text: &str) -> Result<Vec<u16>, Vec<Fault>> {
    let mut faults = Faults::default();
    let mut words = Vec::new();
    let mut count = 0;
    let mut beyond = None;
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.trim();
        if line.is_empty() {
            continue;
        }
        count += 1;
        if count == ROM_WORDS + 1 {
            beyond = Some(number);
        }
        let digits = line.len() == 16 && line.bytes().all(|b| matches!(b, b'0' | b'1'));
        match u16::from_str_radix(line, 2) {
            Ok(word) if digits => words.push(word),
            _ => faults.add(number, "not sixteen binary digits".to_owned()),
        }
    }
    if let (Some(message), Some(line)) = (overflow(count), beyond) {
        faults.add(line, message);
    }
    if faults.0.is_empty() {
        Ok(words)
    } else {
        Err(faults.0)
    }
}

/// Writes an image.
pub fn write_image(words: &[u16]) -> String {
    let mut text = String::with_capacity(17 * words.len());
    for word in words {
        text.push_str(&format!("{word:016b}\n"));
    }
    text
}
