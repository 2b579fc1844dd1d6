//! The heap of a Jack program, in words, by its text.

use super::{HEADER, HEAP, Measured, Need};
use crate::machine::File;
use slowlight_compiler::backend::Document;

/// Words of a string beside its characters, in the web IDE, which has most: the two lengths,
/// where the characters are, and the header of these.
const STRING: u64 = 3 + HEADER;

/// How the class of Floats of four words begins.
const WIDE: &str = "field int s, e, m, l;";

/// The heap of a Jack program before it draws: one object of fields, Floats and
/// arrays, the tables of its classes and of the system's, and the longest message. Rows
/// of errors are filled in a loop, of Floats with one an element.
pub(super) fn heap(documents: &[Document], system: &[File]) -> Need {
    let (mut fields, mut floats, mut arrays, mut rows, mut message) = (0, 0, 0, 0, 0);
    let texts = documents.iter().map(|d| d.text.clone());
    let texts = texts.chain(system.iter().map(|file| file.as_text().into_owned()));
    let mut largest = texts
        .flat_map(|text| largest_array(&text))
        .max_by_key(|(_, size)| *size);
    // Behind `Main` comes the scene's class.
    let scene = documents.get(1).map_or("", |d| d.text.as_str());
    let of_floats = scene.contains("] = Float.new()");
    let lines = scene.lines().map(str::trim_start);
    let befores = std::iter::once("").chain(lines.clone());
    for (line, before) in lines.zip(befores) {
        if let Some(declared) = line.strip_prefix("field ") {
            let names = declared.split(';').next().unwrap_or_default();
            fields += names.split(',').count() as u64;
        } else if let Some(size) = array(line) {
            arrays += size + HEADER;
            if of_floats && line.starts_with("let errors") || line.ends_with("// of Floats") {
                rows += size;
            }
        } else if line.contains("= Float.constant(") {
            floats += 1;
        } else if line.contains("= Float.new(") {
            // Elements of rows are counted as these are made.
            floats += u64::from(!line.contains("] = ") && !replaces(line, before));
        } else if let Some((_, said)) = line.split_once("Output.printString(\"") {
            let length = said.split('"').next().unwrap_or_default().len() as u64;
            message = message.max(length + STRING + HEADER);
        }
    }
    let words = documents.iter().map(|d| d.text.contains(WIDE));
    let float = 3 + u64::from(words.fold(false, |a, b| a | b)) + HEADER;
    let classes = documents.iter().skip(2).flat_map(|d| d.text.lines());
    let arithmetic = classes.filter_map(|line| match line.contains("= Float.new(") {
        true => Some(float),
        false => array(line).map(|size| size + HEADER),
    });
    let beside: u64 = (system.iter())
        .map(|file| {
            file.as_text()
                .lines()
                .filter_map(array)
                .map(|size| size + HEADER)
                .sum::<u64>()
        })
        .sum();
    let groups = [
        ("the fields", fields + HEADER),
        ("the numbers", floats * float),
        ("the rows of errors", rows * float),
    ];
    for (name, size) in groups {
        if largest.as_ref().is_none_or(|(_, most)| size > *most) {
            largest = Some((name.to_owned(), size));
        }
    }
    Need {
        unit: "words of heap",
        largest,
        system: !system.is_empty(),
        of: Measured::Whole,
        parts: vec![
            ("fields", fields + HEADER),
            ("numbers", floats * float),
            ("tables", arrays),
            ("errors", rows * float),
            ("arithmetic", arithmetic.sum()),
            ("messages", message),
            ("operating system", beside),
        ],
        room: HEAP,
    }
}

/// Whether a line makes the variable anew that the line before put into an array.
fn replaces(line: &str, before: &str) -> bool {
    let made = line.strip_prefix("let ").and_then(|l| l.split_once(" = "));
    let put = before
        .split_once("] = ")
        .and_then(|(_, p)| p.strip_suffix(';'));
    made.is_some_and(|(name, _)| put == Some(name))
}

/// The longest array that a class makes, and its words.
fn largest_array(class: &str) -> Option<(String, u64)> {
    let name = |line: &str| {
        let (name, _) = line.trim_start().strip_prefix("let ")?.split_once(" = ")?;
        Some((format!("the array {name}"), array(line)? + HEADER))
    };
    class.lines().filter_map(name).max_by_key(|(_, size)| *size)
}

/// The length of the array that a line makes.
fn array(line: &str) -> Option<u64> {
    let (_, size) = line.split_once("= Array.new(")?;
    size.split(')').next()?.parse().ok()
}
