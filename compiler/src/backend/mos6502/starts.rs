//! What programs take before they begin the scene, in cycles: params are looked at and made
//! numbers, the screen is opened and cleared, and where files are short of room the quarter
//! squares are made. Tables are in the file.

use super::super::starts::{params_made, usual};
use super::memory::Machine;
use super::squares::Squares;
use crate::plan::Plan;
use slowlight_routine::{Format, Op};

/// A param or row, compared with its range and kept.
const PARAM: u64 = 270;
/// An ink's colour, told a port.
const COLOUR: u64 = 50;
/// A byte of a BBC Micro's screen that is cleared, and its registers.
const BYTE: u64 = 11;
const REGISTERS: u64 = 800;
/// A page of a Commodore's screen that is filled, and how many there are, with the colours.
const PAGE: u64 = 2_820;
const PAGES: u64 = 39;

/// What a plan's program takes.
pub(in crate::backend) fn starts(plan: &Plan) -> u64 {
    let [made, divided] = params_made(plan);
    let parts = plan.parts();
    let machine = Machine::of(plan);
    let squares = match Squares::of(machine, &parts) {
        Squares::Made => parts.iter().map(|part| u64::from(part.starts)).sum(),
        Squares::Stored | Squares::Unused => 0,
    };
    let divide = usual(plan, Op::Div);
    let reals = match plan.runtime.real {
        Format::Log { .. } | Format::Real40 => {
            // Of any int, which the last one takes.
            let mut all = plan.runtime.routines.iter().rev();
            let convert = all.find(|routine| routine.op == Op::ToReal);
            made * (convert.map_or(0, |routine| u64::from(routine.cycles)) + divide)
        }
        // Where reals have points of their own, whole numbers are only moved.
        _ if plan.points().is_some() => divided * divide,
        // By what divides any operands, which the last one does.
        _ => {
            let mut all = plan.runtime.routines.iter().rev();
            let divide = all.find(|routine| routine.op == Op::Div);
            made * divide.map_or(0, |routine| u64::from(routine.cycles))
        }
    };
    let params = PARAM * (2 + plan.params.len() as u64) + reals;
    let inks = plan.graph.image.palette.len() as u64;
    let screen = match machine {
        _ if !plan.plot => 0,
        Machine::Plain => COLOUR * inks,
        Machine::Bbc => {
            let bytes = u64::from(plan.mode.width) * u64::from(plan.mode.height) / 8
                * u64::from(plan.mode.inks.max(2).ilog2());
            BYTE * bytes + REGISTERS
        }
        Machine::C64 => PAGE * PAGES,
    };
    squares + params + screen
}
