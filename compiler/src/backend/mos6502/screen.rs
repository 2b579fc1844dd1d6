//! What a program draws on: the plain machine's ports, or a screen that is memory.

use super::bitmap::Bitmap;
use super::homes::Homes;
use super::memory::Machine;
use super::ports::{self, Ports};
use super::{Text, bbc, c64};
use crate::plan::Plan;

/// How a plan's pixels are drawn.
pub(super) enum Screen {
    Ports(Ports),
    Bitmap(Bitmap),
}

impl Screen {
    pub fn new(plan: &Plan, homes: &Homes) -> Screen {
        match Bitmap::new(plan, homes) {
            Some(bitmap) => Screen::Bitmap(bitmap),
            None => Screen::Ports(Ports::new(plan, homes)),
        }
    }

    /// At a picture's beginning.
    pub fn begin(&self, text: &mut Text) {
        if let Screen::Bitmap(bitmap) = self {
            bitmap.open(text);
        }
    }

    /// Before everything that is drawn.
    pub fn open(&self, plan: &Plan, text: &mut Text) {
        match self {
            Screen::Ports(ports) => ports.open(plan, text),
            // A BBC Micro's may be where what is done before the picture stands.
            Screen::Bitmap(_) if Machine::of(plan) == Machine::C64 => c64::open(plan, text),
            Screen::Bitmap(_) => {}
        }
    }

    /// Before a row's first pixel; `y` is the row.
    pub fn row(&self, y: &str, text: &mut Text) {
        match self {
            Screen::Ports(ports) => ports.row(y, text),
            Screen::Bitmap(bitmap) => bitmap.row(text),
        }
    }

    /// Before the first pixel of a pass at a column; the first of all passes is given as well.
    pub fn pass(&self, start: &str, first: u32, text: &mut Text) {
        if let Screen::Ports(ports) = self {
            ports.pass(start, first, text);
        }
    }

    /// Draws a pixel; goes to `unseen_pixel` where its column is not seen.
    pub fn pixel(&self, ink: &str, text: &mut Text) {
        match self {
            Screen::Ports(ports) => ports.pixel(ink, text),
            Screen::Bitmap(bitmap) => bitmap.pixel(ink, text),
        }
    }

    /// What has to follow the column, if anything does.
    pub fn follows(&self) -> Option<&'static str> {
        match self {
            Screen::Ports(ports) => ports.follows(),
            Screen::Bitmap(_) => None,
        }
    }

    /// Behind a pixel, drawn or not.
    pub fn next(&self, text: &mut Text) {
        if let Screen::Ports(ports) = self {
            ports.next(text);
        }
    }

    /// Behind a row's last pixel.
    pub fn row_done(&self, text: &mut Text) {
        if let Screen::Bitmap(bitmap) = self {
            bitmap.row_done(text);
        }
    }

    /// What is called and looked up.
    pub fn data(&self, plan: &Plan, text: &mut Text) {
        match self {
            Screen::Ports(_) => ports::colours(plan, text),
            Screen::Bitmap(bitmap) => {
                bitmap.data(text);
                bbc::turned(plan, bitmap.first_byte(), text);
                if Machine::of(plan) == Machine::C64 {
                    c64::data(text);
                }
            }
        }
    }
}
