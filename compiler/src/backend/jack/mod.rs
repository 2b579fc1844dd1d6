//! From a plan to Jack, for the Hack computer.
//!
//! A program is a handful of classes:
//!
//! - `Main` makes the scene and lets it draw;
//! - a class named after the scene: at its top the parameter block (what may be
//!   changed, as scaled ints), then the checks, the constants and tables, and
//!   the work once a picture, once a row, once a pixel;
//! - `Float` and `Int`, put together from the runtime's parts that are used.
//!
//! Every value has a field of the scene's one object, under the name that the
//! scene gives it: Jack allows 240 statics in all classes together, but any
//! number of fields, and a field costs the virtual machine the same. Floats are
//! made once, at the start; nothing is allocated while drawing. As all values
//! are fields, any run of statements can be a method of its own, and long ones
//! are: the web IDE slows down on long subroutines.
//!
//! The text is legal for the official compiler and the web IDE: all types are
//! declared, constants end at 32767, every path returns, and expressions carry
//! their parentheses, as Jack has no precedence.
//!
//! Logarithmic reals are two fields each, an int and a sign; nothing is made for them, nor
//! for fixed-point reals, which are ints.
//!
//! - `names`: what everything is called; `code`: statements and expressions; `copies`: of values; `logs`:
//!   those of logarithmic reals; `fixed`: those in fixed point; `lookup`: entries of tables;
//! - `object`: constants and params; `making`: what fills the fields at the start;
//! - `steps`: what a picture that moves has between two pictures;
//! - `frame`: the classes around; `canvas`: words of the screen; `spread`: error diffusion; `statics`: which values
//!   are statics, for the processor; `tidy`: what is done to statements once they are written.

mod canvas;
mod code;
mod columns;
mod copies;
mod error_names;
mod expression;
mod fixed;
mod frame;
mod in_place;
mod kept_names;
mod logs;
mod lookup;
mod making;
mod names;
mod object;
mod params;
mod refine;
mod remark;
mod report;
mod spread;
mod starts;
mod statics;
mod steps;
mod tidy;

/// A subroutine under construction: what stands over it, its first line, its body.
struct Subroutine {
    about: String,
    head: String,
    body: Vec<Line>,
}

fn subroutine(about: impl Into<String>, head: impl Into<String>, body: Vec<Line>) -> Subroutine {
    Subroutine {
        about: about.into(),
        head: head.into(),
        body,
    }
}

fn line(text: &str) -> Line {
    Line {
        depth: 0,
        text: text.to_owned(),
        span: None,
    }
}

#[cfg(test)]
mod tests;

/// The operating system for programs on the processor.
pub use slowlight_runtime_jack::os;

pub(super) use frame::program as emit;
pub(super) use starts::starts;
pub use steps::{Held, held};

use super::Document;
use crate::source::Span;

/// A line of source, without its indentation, and the place in the scene that
/// it comes from.
#[derive(Clone, Debug)]
struct Line {
    depth: usize,
    text: String,
    span: Option<Span>,
}

/// Lines under way.
#[derive(Debug, Default)]
struct Text {
    lines: Vec<Line>,
    depth: usize,
    /// The place that lines come from now.
    span: Option<Span>,
}

impl Text {
    fn line(&mut self, text: impl Into<String>) {
        self.lines.push(Line {
            depth: self.depth,
            text: text.into(),
            span: self.span,
        });
    }

    /// A line that opens a block.
    fn open(&mut self, text: impl Into<String>) {
        self.line(text);
        self.depth += 1;
    }

    /// A line that closes a block.
    fn close(&mut self, text: &str) {
        self.depth = self.depth.saturating_sub(1);
        self.line(text);
    }

    /// Lines written elsewhere, this much deeper.
    fn append(&mut self, lines: Vec<Line>) {
        let depth = self.depth;
        self.lines.extend(lines.into_iter().map(|line| Line {
            depth: line.depth + depth,
            ..line
        }));
    }

    fn document(self, class: &str) -> Document {
        let mut document = Document {
            name: format!("{class}.jack"),
            text: String::new(),
            lines: Vec::with_capacity(self.lines.len()),
            later: Vec::new(),
        };
        for line in self.lines {
            if !line.text.is_empty() {
                document.text.push_str(&"    ".repeat(line.depth));
                document.text.push_str(&line.text);
            }
            document.text.push('\n');
            document.lines.push(line.span);
        }
        document
    }
}
