//! Adaptive sampling: what pixels leave to later ones waits in bytes, a row for every second
//! row of a band ([`KeptRows`]).
//!
//! The rows come in bands, and in each by halves: the key row below it, the one in the middle,
//! the middles of what is left. A procedure goes to the next.

use super::code::Code;
use super::lines::Lines;
use crate::ir::graph::Neighbour;
use crate::plan::{KeptRows, Plan};

/// The names of what the rows need.
pub struct Refined {
    rows: KeptRows,
    height: u32,
    /// The bytes, and the rows in them of the neighbours and the pixel itself.
    kept: String,
    up: String,
    down: String,
    own: String,
    /// The key row above the band, how far neighbours are from the row, the last row of the
    /// band and the last of all.
    band: String,
    reach: String,
    till: String,
    end: String,
    /// To the next row, and to the next band.
    below: String,
    next: String,
    neighbours: [String; 3],
}

impl Refined {
    /// Where a plan does not trace every pixel.
    pub fn new(plan: &Plan, code: &mut Code<'_>) -> Option<Refined> {
        let rows = plan.kept_rows()?;
        let names = &mut code.values.names;
        let neighbours = Neighbour::ALL.map(|which| names.unique(which.name(), "%"));
        let mut int = |base: &str| names.unique(base, "%");
        let refined = Refined {
            rows,
            height: plan.graph.image.height,
            kept: int("kept"),
            up: int("up"),
            down: int("down"),
            own: int("own"),
            band: int("band"),
            reach: int("reach"),
            till: int("till"),
            end: int("end"),
            below: names.unique("PROCbelow", ""),
            next: names.unique("PROCband", ""),
            neighbours,
        };
        code.values.neighbours.clone_from(&refined.neighbours);
        Some(refined)
    }

    /// Begins the loop over the rows: those from the key row above the first that is drawn.
    pub fn begin(&self, code: &mut Code<'_>, (first, last): (&str, &str)) {
        let Refined {
            kept, band, end, ..
        } = self;
        let step = self.rows.refinement.step;
        // Words are copied, and the last may end behind the row.
        code.statement(format!("DIM {kept} {}", self.rows.bytes() + 2));
        code.statement(format!("Y%={first} DIV {step}*{step}"));
        code.statement(format!("{band}=Y%-{step}"));
        code.statement(format!("{}=1", self.reach));
        code.statement(format!("{}=Y%", self.till));
        code.statement(format!("{end}=({last}+{}) DIV {step}*{step}", step - 1));
        let bottom = self.height.saturating_sub(1);
        code.line(format!("IF {end}>{bottom} THEN {end}={bottom}"));
        code.line("REPEAT");
    }

    /// Where a row's neighbours are.
    pub fn row(&self, code: &mut Code<'_>) {
        let Refined {
            kept,
            up,
            band,
            reach,
            ..
        } = self;
        let width = self.rows.width;
        let half = match width % 2 {
            0 => format!("*{}", width / 2),
            _ => format!("*{width} DIV 2"),
        };
        code.statement(format!("{up}={kept}+(Y%-{band}-{reach}){half}"));
        code.statement(format!("{}={up}+{reach}*{width}", self.down));
        code.statement(format!("{}={kept}+(Y%-{band}) DIV 2*{width}", self.own));
        let [_, _, left] = &self.neighbours;
        code.statement(format!("{left}=?{up}"));
    }

    /// Takes what a pixel's neighbours have left.
    pub fn receive(&self, code: &mut Code<'_>) {
        let [above, below, _] = &self.neighbours;
        code.statement(format!("{above}={}?X%", self.up));
        code.statement(format!("{below}={}?X%", self.down));
    }

    /// Leaves what the pixel came to.
    pub fn send(&self, code: &mut Code<'_>) {
        let [_, _, left] = self.neighbours.clone();
        let kept = code.values.read(self.rows.refinement.kept);
        code.assign(&left, &kept);
        code.statement(format!("{}?X%={left}", self.own));
    }

    /// Ends the loop over the rows.
    pub fn end(&self, code: &mut Code<'_>) {
        code.statement(self.below.clone());
        code.line(format!("UNTIL {}>={}", self.band, self.end));
    }

    /// The procedures that go to the next row.
    pub fn procedures(&self, code: &Code<'_>) -> Lines {
        let Refined {
            kept,
            band,
            reach,
            till,
            end,
            below,
            next,
            ..
        } = self;
        let (step, width) = (self.rows.refinement.step, self.rows.width);
        let mut lines = Lines::of_weight(code.lines.weight);
        let mut line = |text: String| lines.line(text, code.frame);
        line(format!("DEF {below}"));
        line(format!("Y%=Y%+{reach}+{reach}"));
        line("REPEAT".to_owned());
        line(format!(
            "IF Y%>{till} THEN {reach}={reach} DIV 2:Y%={band}+{reach}"
        ));
        line(format!("IF {reach}=0 THEN {next}"));
        line(format!("UNTIL Y%<={till} OR {band}>={end}"));
        line("ENDPROC".to_owned());
        line(format!("DEF {next}"));
        line(format!("{band}={kept}+{}", step / 2 * width));
        line(format!("FOR X%=0 TO {} STEP 4", width.saturating_sub(1)));
        line(format!("{kept}!X%={band}!X%"));
        line("NEXT".to_owned());
        line(format!("{band}={till}"));
        line(format!("{reach}={step}"));
        line(format!("Y%={band}+{step}"));
        line(format!("{till}=Y%"));
        line(format!("IF {till}>{end} THEN {till}={end}"));
        line("ENDPROC".to_owned());
        lines
    }
}
