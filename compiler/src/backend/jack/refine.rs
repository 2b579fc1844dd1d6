//! Adaptive sampling: what pixels leave to later ones waits in an array, a row for every second
//! row of a band ([`KeptRows`]).
//!
//! The rows come in bands, and in each by halves: the key row below it, the one in the middle,
//! the middles of what is left. A method goes to the next.

use super::code::Code;
use super::kept_names::Refined;
use super::{Line, Subroutine, Text, subroutine};
#[cfg(doc)]
use crate::plan::KeptRows;
use slowlight_runtime_jack::TERM;

impl Refined {
    /// The array and the ints.
    pub fn declared(&self) -> [(&'static str, Vec<String>); 2] {
        let Refined {
            up,
            down,
            own,
            band,
            till,
            end,
            reach,
            ..
        } = self;
        let ints = [up, down, own, band, till, end, reach].into_iter();
        let ints = ints.chain(&self.neighbours).cloned().collect();
        [("Array", vec![self.kept.clone()]), ("int", ints)]
    }

    /// The loop over the rows: from the key row above the first that is drawn.
    pub fn picture(&self, y: &str, [first, last]: &[String; 2], text: &mut Text) {
        let Refined {
            band,
            till,
            end,
            reach,
            ..
        } = self;
        let step = self.rows.refinement.step;
        let bottom = self.height.saturating_sub(1);
        text.line(format!("let {y} = ({first} / {step}) * {step};"));
        text.line(format!("let {band} = {y} - {step};"));
        text.line(format!("let {till} = {y};"));
        text.line(format!("let {reach} = 1;"));
        let up = step - 1;
        text.line(format!("let {end} = (({last} + {up}) / {step}) * {step};"));
        text.line(format!("if ({end} > {bottom}) {{ let {end} = {bottom}; }}"));
        text.open(format!("while ({band} < {end}) {{"));
        text.line("do drawRow();");
        text.line("do nextRow();");
        text.close("}");
    }

    /// Before a row's first pixel: where its neighbours are. A key row has none below.
    pub fn row(&self, y: &str, text: &mut Text) {
        let Refined {
            kept,
            up,
            down,
            own,
            band,
            reach,
            ..
        } = self;
        let (step, width) = (self.rows.refinement.step, self.rows.width);
        text.line(format!("let {own} = (({y} - {band}) / 2) * {width};"));
        text.line(format!(
            "let {up} = (({y} - {band} - {reach}) / 2) * {width};"
        ));
        text.line(format!("let {down} = {up};"));
        text.line(format!(
            "if ({reach} < {step}) {{ let {down} = {up} + ({reach} * {width}); }}"
        ));
        let [_, _, left] = &self.neighbours;
        text.line(format!("let {left} = {kept}[{up}];"));
    }

    /// Takes what a pixel's neighbours have left.
    pub fn receive(&self, x: &str, text: &mut Text) {
        let [above, below, _] = &self.neighbours;
        let Refined { kept, up, down, .. } = self;
        text.line(format!("let {above} = {kept}[{up} + {x}];"));
        text.line(format!("let {below} = {kept}[{down} + {x}];"));
    }

    /// Leaves what the pixel came to.
    pub fn send(&self, code: &mut Code, x: &str, text: &mut Text) {
        let [_, _, left] = &self.neighbours;
        let value = code.read(self.rows.refinement.kept).at(TERM);
        text.line(format!("let {left} = {value};"));
        text.line(format!("let {}[{} + {x}] = {left};", self.kept, self.own));
    }

    /// The tests for a row that is computed to be drawn.
    pub fn seen(&self, y: &str, [first, last]: &[String; 2]) -> [String; 2] {
        [format!("~({y} < {first})"), format!("~({y} > {last})")]
    }

    /// The methods that go to the next row, and to the next band.
    pub fn methods(&self, [x, y]: &[String; 2]) -> [Subroutine; 2] {
        let Refined {
            kept,
            band,
            till,
            end,
            reach,
            ..
        } = self;
        let (step, width) = (self.rows.refinement.step, self.rows.width);
        let mut row = Text::default();
        row.line(format!("let {y} = {y} + {reach} + {reach};"));
        row.open(format!("while (({y} > {till}) & ({band} < {end})) {{"));
        row.line(format!("let {reach} = {reach} / 2;"));
        row.line(format!("let {y} = {band} + {reach};"));
        row.line(format!("if ({reach} = 0) {{ do nextBand(); }}"));
        row.close("}");
        let mut next = Text::default();
        next.line(format!("let {x} = 0;"));
        next.open(format!("while ({x} < {width}) {{"));
        let from = step / 2 * width;
        next.line(format!("let {kept}[{x}] = {kept}[{x} + {from}];"));
        next.line(format!("let {x} = {x} + 1;"));
        next.close("}");
        next.line(format!("let {band} = {till};"));
        next.line(format!("let {reach} = {step};"));
        next.line(format!("let {y} = {band} + {step};"));
        next.line(format!("let {till} = {y};"));
        next.line(format!("if ({till} > {end}) {{ let {till} = {end}; }}"));
        [
            subroutine(
                "To the next row: by halves of what is between two key rows.",
                "method void nextRow()",
                row.lines,
            ),
            subroutine(
                "The key row below a band is above the next.",
                "method void nextBand()",
                next.lines,
            ),
        ]
    }

    /// What makes the array.
    pub fn making(&self) -> Subroutine {
        let line = Line {
            depth: 0,
            text: format!("let {} = Array.new({});", self.kept, self.rows.bytes()),
            span: None,
        };
        let about = "What pixels leave to later ones: a row for every second of a band.";
        subroutine(about, "method void makeRows()", vec![line])
    }
}
