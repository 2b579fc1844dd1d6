//! Words of the screen, each written at once when its sixteen pixels are known.
//!
//! For the processor, where a call of `Screen.drawPixel` takes some 150 cycles. On the VM
//! it is one command, and a pixel's share of gathering a word is eight.

use super::Text;
use crate::plan::Plan;

/// Where the screen's words begin, and how many are a row.
const SCREEN: i32 = 16384;
const ROW: i32 = 32;
const PIXELS: i32 = 16;

/// The names of what gathers pixels.
#[derive(Clone)]
pub(super) struct Canvas {
    /// Where the word goes.
    word: String,
    /// The pixels that are black.
    bits: String,
    /// The bit of the next.
    bit: String,
    /// The columns of the screen that are drawn.
    columns: (i32, i32),
    /// What a row of the picture is above one of the screen.
    above: i32,
}

impl Canvas {
    /// For a plan that draws all that it computes, for the processor.
    pub fn new(plan: &Plan, fresh: &mut dyn FnMut(&str) -> String) -> Option<Canvas> {
        let wanted = plan.statics && plan.plot && !plan.graph.is_in_order();
        let wanted = wanted && plan.graph.image.block == (1, 1);
        let [first, last] = [plan.columns.0, plan.columns.1].map(i32::try_from);
        let (first, last) = (first.ok()?, last.ok()?);
        wanted.then(|| Canvas {
            word: fresh("word"),
            bits: fresh("bits"),
            bit: fresh("bit"),
            columns: (first + plan.offset.0, last + plan.offset.0),
            above: plan.offset.1,
        })
    }

    /// What it is kept in: a type and names.
    pub fn declared(&self) -> [(&'static str, Vec<String>); 2] {
        [
            ("Array", vec![self.word.clone()]),
            ("int", vec![self.bits.clone(), self.bit.clone()]),
        ]
    }

    /// Before a row's first pixel.
    pub fn begin(&self, y: &str, text: &mut Text) {
        let Canvas {
            word, bits, bit, ..
        } = self;
        let first = SCREEN + self.columns.0 / PIXELS + ROW * self.above;
        text.line(format!("let {word} = {y} + {y};"));
        let mut times = 2;
        while times < ROW {
            text.line(format!("let {word} = {word} + {word};"));
            times += times;
        }
        // Words wrap, as the row's number times their number has.
        text.line(match first as i16 {
            first @ 0.. => format!("let {word} = {word} + {first};"),
            i16::MIN => format!("let {word} = {word} + 16384 + 16384;"),
            first => format!("let {word} = {word} - {};", first.unsigned_abs()),
        });
        text.line(format!("let {bits} = 0;"));
        // The highest bit is no constant of Jack's.
        match self.columns.0 % PIXELS {
            15 => {
                text.line(format!("let {bit} = 16384;"));
                text.line(format!("let {bit} = {bit} + {bit};"));
            }
            place => text.line(format!("let {bit} = {};", 1 << place)),
        }
    }

    /// A pixel: black where a condition holds. Sixteen doublings of a bit leave 0.
    pub fn pixel(&self, black: &str, text: &mut Text) {
        let Canvas {
            word, bits, bit, ..
        } = self;
        text.line(format!("if ({black}) {{ let {bits} = {bits} | {bit}; }}"));
        text.line(format!("let {bit} = {bit} + {bit};"));
        text.open(format!("if ({bit} = 0) {{"));
        text.line(format!("let {word}[0] = {bits};"));
        text.line(format!("let {word} = {word} + 1;"));
        text.line(format!("let {bits} = 0;"));
        text.line(format!("let {bit} = 1;"));
        text.close("}");
    }

    /// Behind a row's last pixel: what is left of a word.
    pub fn end(&self, text: &mut Text) {
        if (self.columns.1 + 1) % PIXELS != 0 {
            text.line(format!("let {}[0] = {};", self.word, self.bits));
        }
    }
}
