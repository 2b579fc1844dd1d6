//! Pixels put into the screen's memory, on the Micro.
//!
//! PLOT takes several thousand cycles a point, a poke one. A byte holds 2, 4 or
//! 8 pixels side by side, so a second loop inside the row's gathers their inks:
//! what was gathered moves up by a bit, and the next ink's bits are added in
//! the place of the byte's last pixel. Eight rows make a row of characters,
//! whose bytes run down through each character before they go on to the next.

use super::Style;
use super::code::Code;
use super::lines::{Label, Lines};
use super::procedure::as_procedure;
use super::screen;
use super::segment::Segments;
use crate::plan::Plan;

/// How a picture is put into memory, byte by byte.
pub struct Poke {
    /// Pixels in a byte.
    pixels: u32,
    /// The bits of each ink at the byte's last pixel; none where they are the
    /// ink's number.
    bits: Option<String>,
    /// The byte being gathered, its address, and the first one's of the row.
    byte: String,
    at: String,
    start: String,
    /// The byte's last column, and the last that is drawn before the next of
    /// a row's segments or the next byte.
    last: String,
    until: String,
}

/// The bits of an ink at a byte's last pixel: bit by bit, each so far from the next.
pub fn bits(ink: u32, pixels: u32) -> u32 {
    let each = 8 / pixels;
    (0..each)
        .map(|bit| (ink >> bit & 1) << (bit * pixels))
        .sum()
}

/// How many pixels a byte of the screen holds, if they can be put there: where
/// the program draws on a Micro, is not for reading, and the picture begins and
/// ends at whole bytes.
pub fn pixels_in_byte(plan: &Plan, style: Style) -> Option<u32> {
    let pixels = (plan.target.pixels)(&plan.mode);
    let (first, last) = plan.columns;
    let left = plan.offset.0 + first as i32;
    let whole = |n: i64| n.rem_euclid(i64::from(pixels)) == 0;
    let fits = plan.plot
        && pixels > 1
        && plan.graph.image.block == (1, 1)
        && !matches!(style, Style::Listing | Style::Toot)
        && plan.computed_columns() == plan.columns
        && whole(i64::from(left))
        && whole(i64::from(last) + 1 - i64::from(first));
    fits.then_some(pixels)
}

/// The address of a row's first byte.
pub fn first_byte(plan: &Plan, pixels: u32) -> String {
    let y = match plan.offset.1 {
        0 => "Y%".to_owned(),
        down if down > 0 => format!("(Y%+{down})"),
        up => format!("(Y%{up})"),
    };
    // A row of characters: 8 rows of so many bytes.
    let line = 8 * plan.mode.width / pixels;
    let left = match 8 * (plan.offset.0 + plan.columns.0 as i32) / pixels as i32 {
        0 => String::new(),
        n => format!("+{n}"),
    };
    format!("HIMEM+{y} DIV 8*{line}+({y} AND 7){left}")
}

impl Poke {
    /// Where pixels can be put into memory.
    pub fn new(plan: &Plan, code: &mut Code<'_>) -> Option<Poke> {
        let pixels = pixels_in_byte(plan, code.values.style)?;
        let names = &mut code.values.names;
        let poke = Poke {
            pixels,
            bits: (pixels < 8).then(|| names.unique("bits", "%")),
            byte: names.unique("byte", "%"),
            at: names.unique("at", "%"),
            start: names.unique("start", "%"),
            last: names.unique("last_of_byte", "%"),
            until: names.unique("until", "%"),
        };
        poke.table(plan, code);
        Some(poke)
    }

    /// Makes the table of bits, four inks a word.
    fn table(&self, plan: &Plan, code: &mut Code<'_>) {
        let Some(name) = &self.bits else {
            return;
        };
        let inks = plan.mode.inks;
        code.statement(format!("DIM {name} {}", inks - 1));
        for first in (0..inks).step_by(4) {
            let word: u32 = (0..4)
                .map(|k| bits(first + k, self.pixels) << (8 * k))
                .sum();
            let place = match first {
                0 => format!("!{name}"),
                _ => format!("{name}!{first}"),
            };
            code.statement(format!("{place}=&{word:X}"));
        }
    }

    /// The loops over a row's bytes and each byte's pixels. In `segments`, the
    /// inner loop begins at the label `again` as often as a byte has segments.
    pub fn columns(
        &self,
        plan: &Plan,
        code: &mut Code<'_>,
        segments: Option<&Segments>,
        again: Label,
    ) -> Option<Lines> {
        let (first, last) = plan.columns;
        let (start, at) = (&self.start, &self.at);
        code.statement(format!("{start}={}", first_byte(plan, self.pixels)));
        code.statement(format!("X%={first}"));
        let bytes = (last + 1 - first) / self.pixels;
        let end = 8 * (bytes - 1);
        if let Some(segments) = segments {
            code.statement(format!("{}={}", segments.end(), i64::from(first) - 1));
        }
        code.line(format!("FOR {at}={start} TO {start}+{end} STEP 8"));
        code.statement(format!("{}=0", self.byte));
        let Some(segments) = segments else {
            code.line(format!("FOR X%=X% TO X%+{}", self.pixels - 1));
            return None;
        };
        let (last, until, end) = (&self.last, &self.until, segments.end());
        code.statement(format!("{last}=X%+{}", self.pixels - 1));
        code.lines.place(again);
        let inside = code.labels.next();
        code.line(format!("IF X%<={end} THEN {inside}"));
        let apart = as_procedure(code, "segment", |code| segments.begin(plan, code, None));
        code.lines.place(inside);
        code.line(format!(
            "IF {last}<={end} THEN {until}={last} ELSE {until}={end}"
        ));
        code.line(format!("FOR X%=X% TO {until}"));
        apart
    }

    /// Adds a pixel's ink.
    pub fn gather(&self, code: &mut Code<'_>) {
        let byte = &self.byte;
        let ink = match &self.bits {
            Some(bits) => format!("{bits}?I%"),
            None => "I%".to_owned(),
        };
        code.statement(format!("{byte}={byte}+{byte}+{ink}"));
    }

    /// Puts a byte, and ends the loop over them.
    pub fn put(&self, plan: &Plan, code: &mut Code<'_>, rows: (&str, &str), again: Option<Label>) {
        if let Some(again) = again {
            code.line(format!("IF X%<={} THEN {again}", self.last));
        }
        let put = format!("?{}={}", self.at, self.byte);
        if plan.graph.is_in_order() {
            code.line(format!("IF {} THEN {put}", screen::seen_rows(plan, rows)));
        } else {
            code.statement(put);
        }
        code.line("NEXT");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inks_have_the_bits_of_the_last_pixel() {
        let all = |inks: u32, pixels: u32| -> Vec<u32> {
            (0..inks).map(|ink| bits(ink, pixels)).collect()
        };
        assert_eq!(all(2, 8), [0, 1]);
        assert_eq!(all(4, 4), [0, 1, 16, 17]);
        assert_eq!(all(16, 2)[..5], [0, 1, 4, 5, 16]);
        assert_eq!(all(16, 2)[15], 0x55);
    }
}
