//! The plain machine's ports: how its picture is opened and drawn.

use super::Text;
use super::blocks::Blocks;
use super::homes::Homes;
use super::slots::Slot;
use crate::ir::graph::Axis;
use crate::passes::loops::strip_mine::passes;
use crate::plan::Plan;
use slowlight_runtime_6502::write::{self, Place as Operand};

/// The ports' addresses.
pub(super) fn symbols(plan: &Plan, text: &mut Text) {
    text.headline("the machine's ports");
    let moving = [
        (
            HANDS,
            "ff0c",
            "a picture is done: what is held then is to be",
        ),
        (
            HELD,
            "ff0d",
            "seen here: left 1, right 2, up 4, down 8, fire 16",
        ),
    ];
    let moving = moving.into_iter().filter(|_| plan.graph.is_moving());
    let ports = [
        ("width_port", "ff00", "the picture's size: two bytes"),
        ("height_port", "ff02", "two bytes"),
        ("inks_port", "ff04", "opens the picture"),
        ("x_port", "ff05", "where the next ink goes: two bytes"),
        ("y_port", "ff07", "two bytes"),
        ("ink_port", "ff09", "draws a pixel and moves to the right"),
        ("exit_port", "ff0a", "ends the program"),
        ("palette_port", "ff0b", "red, green, blue of each ink"),
    ];
    for (name, address, about) in ports.into_iter().chain(moving) {
        text.line(format!("{:<24}; {about}", format!("{name} = ${address}")));
    }
}

/// Tells that a picture is done, and what is held then.
pub(super) const HANDS: &str = "hands_port";
pub(super) const HELD: &str = "held_port";

/// How pixels go to the ports.
pub(super) struct Ports {
    blocks: Option<Blocks>,
    /// The left column and the picture's top row on the screen.
    first: [u64; 2],
    /// The column, where each pixel says its own: passes leave columns out.
    column: Option<String>,
    /// Whether the port is told the column as soon as that is stepped.
    follows: bool,
    /// The row, where passes are told it as well: one before them may end at the screen's last
    /// column, from where the ports go on to the next row.
    wraps: Option<String>,
}

impl Ports {
    pub fn new(plan: &Plan, homes: &Homes) -> Ports {
        let n = passes(&plan.graph);
        let apart = n > 1;
        let left = match apart {
            true => i64::from(plan.offset.0),
            false => i64::from(plan.computed_columns().0) + i64::from(plan.offset.0),
        };
        let (first_column, _) = plan.computed_columns();
        let last = i64::from(plan.mode.width.max(1)) - 1 - left;
        let in_pass = (last - i64::from(first_column)).rem_euclid(i64::from(n));
        let wraps = in_pass + 1 < i64::from(n);
        Ports {
            wraps: wraps.then(|| homes.name(Slot::Axis(Axis::Y)).to_owned()),
            follows: apart && left == 0 && plan.graph.image.block == (1, 1),
            column: apart.then(|| homes.name(Slot::Axis(Axis::X)).to_owned()),
            blocks: Blocks::new(plan, homes),
            first: [left as u64, i64::from(plan.offset.1) as u64],
        }
    }

    /// Opens the picture and tells its palette.
    pub fn open(&self, plan: &Plan, text: &mut Text) {
        let image = &plan.graph.image;
        // The screen is the mode's where there is one, else the picture's.
        let (width, height) = (plan.mode.width.max(1), plan.mode.height.max(1));
        for (port, value) in [("width_port", width), ("height_port", height)] {
            let [lo, hi, ..] = value.to_le_bytes();
            text.code(&format!(
                "lda #{lo} | sta {port} | lda #{hi} | sta {port}+1"
            ));
        }
        text.code(&format!(
            "lda #{} | sta inks_port",
            image.palette.len() & 0xFF
        ));
        let bytes = 3 * image.palette.len();
        // All fit an index of one byte but those of more than 85 inks.
        for (k, _) in image.palette.chunks(85).enumerate() {
            let count = (bytes - 255 * k).min(255);
            text.code("ldx #0");
            text.label(&format!("palette{k}"));
            text.code(&format!(
                "lda colours+{},x | sta palette_port | inx | cpx #{count} | bne palette{k}",
                255 * k
            ));
        }
    }

    /// Before a row's first pixel: where it goes.
    pub fn row(&self, y: &str, text: &mut Text) {
        if let Some(blocks) = &self.blocks {
            return blocks.row(y, text);
        }
        let [x0, x1] = [0, 1].map(|k| write::byte(&Operand::Constant(self.first[0]), k));
        text.code(&format!("lda {x0} | sta x_port | lda {x1} | sta x_port+1"));
        self.to_row(y, text);
    }

    /// Tells the row.
    fn to_row(&self, y: &str, text: &mut Text) {
        let [dy0, dy1] = [0, 1].map(|k| write::byte(&Operand::Constant(self.first[1]), k));
        text.code(&format!("clc | lda {y} | adc {dy0} | sta y_port"));
        text.code(&format!("lda {y}+1 | adc {dy1} | sta y_port+1"));
    }

    /// Draws a pixel.
    pub fn pixel(&self, ink: &str, text: &mut Text) {
        if let Some(blocks) = &self.blocks {
            return blocks.draw(ink, text);
        }
        if let (Some(x), false) = (&self.column, self.follows) {
            text.code(&match self.first[0] {
                0 => format!("lda {x} | sta x_port | lda {x}+1 | sta x_port+1"),
                left => {
                    let [lo, hi] = [0, 1].map(|k| write::byte(&Operand::Constant(left), k));
                    format!(
                        "clc | lda {x} | adc {lo} | sta x_port | lda {x}+1 | adc {hi} | sta x_port+1"
                    )
                }
            });
        }
        text.code(&format!("lda {ink} | sta ink_port"));
    }

    /// Before the first pixel of a pass.
    pub fn pass(&self, start: &str, first: u32, text: &mut Text) {
        if let Some(blocks) = &self.blocks {
            blocks.pass(start, first, text);
            return;
        }
        if let Some(y) = &self.wraps {
            self.to_row(y, text);
        }
        if self.follows {
            text.code(&format!(
                "lda {start} | sta x_port | lda {start}+1 | sta x_port+1"
            ));
        }
    }

    /// The port's name, if it has to follow the column.
    pub fn follows(&self) -> Option<&'static str> {
        self.follows.then_some("x_port")
    }

    /// Behind a pixel, drawn or not.
    pub fn next(&self, text: &mut Text) {
        if let Some(blocks) = &self.blocks {
            blocks.next(text);
        }
    }
}

/// The palette: red, green and blue of each ink.
pub(super) fn colours(plan: &Plan, text: &mut Text) {
    text.headline("the inks' red, green and blue");
    text.label("colours");
    for [red, green, blue] in &plan.graph.image.palette {
        text.line(format!("        .byte {red}, {green}, {blue}"));
    }
}
