//! Marks: programs that are not ours, at the time and error that somebody measured, so that
//! a frontier can be held against what it means to beat.
//!
//! A scene that follows another program says so itself, in a remark of its own file:
//! `// mark bbc:micro: the original = 17779441084 cycles, 0.0081%`.

use super::choice::Base;
use super::goal::{percent, time};
use crate::failure::Outcome;
use crate::format::duration;
use crate::scene::{self, Scene};
use crate::sheet::escaped;
use crate::target_args::{Os, share};
use slowlight_compiler::source::{Diagnostic, Span};
use slowlight_compiler::targets;
use std::fmt::Write as _;

/// What a mark's words begin with in a scene.
const BEGINS: &str = "// mark ";

/// A program beside the frontier.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// What it is called.
    pub name: String,
    /// What it took.
    pub time: Time,
    /// Its error, a share of 1.
    pub error: f64,
}

/// What a program took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Time {
    /// So many seconds, by whatever clock.
    Seconds(f64),
    /// So many cycles of the machine that its points are of.
    Cycles(f64),
}

impl Time {
    /// In seconds of a machine of so many cycles a second.
    pub fn seconds(self, hertz: f64) -> f64 {
        match self {
            Time::Seconds(seconds) => seconds,
            Time::Cycles(cycles) => cycles / hertz,
        }
    }
}

/// Reads `--mark`: `the original=9h45m,0.47%`, or `the original = 1234567 cycles, 0.47%`.
///
/// # Errors
/// Where it is no name, time and error.
pub fn mark(text: &str) -> Result<Mark, String> {
    let wrong = "write a name, a time or cycles, and an error, as in 'the original=9h45m,0.47%' \
                 or 'the original=1234567 cycles,0.47%'";
    let (name, figures) = text.rsplit_once('=').ok_or(wrong)?;
    let (took, error) = figures.split_once(',').ok_or(wrong)?;
    let took = match took.trim().strip_suffix("cycles") {
        Some(cycles) => {
            let cycles = cycles.trim().parse::<u64>().ok().filter(|n| *n > 0);
            Time::Cycles(cycles.ok_or(wrong)? as f64)
        }
        None => Time::Seconds(time(took)?),
    };
    match name.trim() {
        "" => Err(wrong.to_owned()),
        name => Ok(Mark {
            name: name.to_owned(),
            time: took,
            error: share(error)?,
        }),
    }
}

/// The programs that a scene says it follows, on the machine that is tuned.
///
/// # Errors
/// Where a remark begins as a mark of a machine, and is none: its place, and what is wrong.
pub fn of_scene(scene: &Scene, base: &Base) -> Outcome<Vec<Mark>> {
    // Its cycles would be the VM's.
    if base.screen.os == Some(Os::Jack) {
        return Ok(Vec::new());
    }
    let mut found = Vec::new();
    let files = (0..).zip(&scene.checked.sources.files);
    for (file, own) in files.filter(|(_, file)| !file.library) {
        let mut start = 0;
        for line in own.text.split_inclusive('\n') {
            let at = Span {
                file,
                start,
                end: start + line.trim_end().len() as u32,
                ..Span::default()
            };
            start += line.len() as u32;
            match in_remark(line, base) {
                None => {}
                Some(Ok(mark)) => found.push(mark),
                Some(Err(wrong)) => {
                    let said = Diagnostic::error(at, "this mark is not understood").help(wrong);
                    let sources = scene.checked.sources.clone();
                    return Err(scene::wrong(sources, vec![said]));
                }
            }
        }
    }
    Ok(found)
}

/// The mark in a line, if it has one of the machine that is tuned.
fn in_remark(line: &str, base: &Base) -> Option<Result<Mark, String>> {
    let rest = line.trim().strip_prefix(BEGINS)?;
    let (name, said) = rest.split_once(": ")?;
    // Other words before a colon are no mark.
    let target = targets::find(name.trim())?;
    (target.name == base.target.name).then(|| mark(said))
}

/// A mark in the plot: a diamond with its name, on the side that has room.
pub(super) fn diamond(
    out: &mut String,
    mark: &Mark,
    (x, y): (f64, f64),
    middle: f64,
    (phrase, hertz): (&str, f64),
) {
    let (anchor, away) = match x > middle {
        true => ("end", -11.0),
        false => ("start", 11.0),
    };
    let said = format!(
        "{}: {}, {} {phrase}",
        mark.name,
        duration(mark.time.seconds(hertz)),
        percent(mark.error)
    );
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        "<path d=\"M{x:.1} {:.1}l7 7l-7 7l-7-7z\" fill=\"#d1495b\"><title>{}</title></path>\
         <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" fill=\"#a63446\">{}</text>",
        y - 7.0,
        escaped(&said),
        x + away,
        y + 4.5,
        escaped(&mark.name)
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_read() {
        let read = mark("BASIC = by hand=2h28m,0%").expect("a mark");
        assert_eq!(read.name, "BASIC = by hand");
        assert_eq!((read.time, read.error), (Time::Seconds(8880.0), 0.0));
        let read = mark("the original = 4000000 cycles, 0.5%").expect("a mark");
        assert_eq!((read.time.seconds(2e6), read.error), (2.0, 0.005));
        for wrong in [
            "",
            "x",
            "=1m,1%",
            "x=1m",
            "x=1,1%",
            "x=1m,200%",
            "x=cycles,1%",
            "x=-1 cycles,1%",
        ] {
            assert!(mark(wrong).is_err(), "{wrong}");
        }
    }
}
