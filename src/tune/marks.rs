//! Marks: programs that are not ours, at the time and error that somebody measured, so that
//! a frontier can be held against what it means to beat.

use super::goal::{percent, share, time};
use super::plot::escaped;
use crate::format::duration;
use std::fmt::Write as _;

/// A program beside the frontier.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// What it is called.
    pub name: String,
    /// Its time on the machine.
    pub seconds: f64,
    /// Its error, a share of 1.
    pub error: f64,
}

/// Reads `--mark`: `the original=9h45m,0.47%`.
///
/// # Errors
/// Where it is no name, time and error.
pub fn mark(text: &str) -> Result<Mark, String> {
    let wrong = "write a name, a time and an error, as in 'the original=9h45m,0.47%'";
    let (name, figures) = text.rsplit_once('=').ok_or(wrong)?;
    let (seconds, error) = figures.split_once(',').ok_or(wrong)?;
    match name.trim() {
        "" => Err(wrong.to_owned()),
        name => Ok(Mark {
            name: name.to_owned(),
            seconds: time(seconds)?,
            error: share(error)?,
        }),
    }
}

/// A mark in the plot: a diamond with its name, on the side that has room.
pub(super) fn diamond(
    out: &mut String,
    mark: &Mark,
    (x, y): (f64, f64),
    middle: f64,
    phrase: &str,
) {
    let (anchor, away) = match x > middle {
        true => ("end", -11.0),
        false => ("start", 11.0),
    };
    let said = format!(
        "{}: {}, {} {phrase}",
        mark.name,
        duration(mark.seconds),
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
        assert_eq!((read.seconds, read.error), (8880.0, 0.0));
        for wrong in ["", "x", "=1m,1%", "x=1m", "x=1,1%", "x=1m,200%"] {
            assert!(mark(wrong).is_err(), "{wrong}");
        }
    }
}
