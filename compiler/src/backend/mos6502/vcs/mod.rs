//! Atari VCS: a cartridge of a column scene ([`crate::plan::columns`]).
//!
//! There is no frame buffer: the beam shows what the kernel stores while it draws. So a picture
//! is not plotted. The program works out one column after another, how tall it is and of which
//! kind, and asks the timer at the ends of statements whether the next of them still fits before
//! the beam wants the kernel; where not, it calls the kernel, and goes on behind it. When all
//! columns are there, they are made playfield.
//!
//! - `work`: the scene's statements, with what asks the timer, as one text;
//! - `tall`: from a column's number to its height and kind;
//! - `kernel`: what draws, the conversion to playfield, and what the machine begins with;
//! - `ram`: where values are, in the RIOT's RAM and in the cartridge's;
//! - `parts`: what of the runtime and which tables a piece of text needs;
//! - `banks`: pieces of the work in banks of 4K, each with its own copies of those, and the ways
//!   from bank to bank.

mod banks;
mod colours;
mod kernel;
mod parts;
mod ram;
mod tall;
mod work;

use super::Document;
use super::homes::Homes;
use super::slots::Slot;
use super::steps::Held;
use crate::ir::graph::*;
use crate::ir::tree::{Origin, Place, Statement};
use crate::plan::Plan;
use crate::plan::columns::columns;
use crate::source::Span;
use slowlight_routine::Type;
use slowlight_runtime_6502::tidy::tidy;

pub use kernel::{LINES, Shape};

/// Before the number of ticks that the timer must have for the next slice of the work, where it
/// is asked.
pub const LEAST: &str = "        cmp #";
/// The symbol whose value says how many it must have for making playfield and for the slice
/// behind that.
pub const PUBLISH: &str = "vcs_publish_least";
/// Before the numbers of labels at which the timer is asked, and at which the kernel is called
/// where there is no time.
pub const ASKED: &str = "vcs_at_ask_";
/// See [`ASKED`].
pub const CROSSED: &str = "vcs_at_cross_";
/// Before those at which all columns are made playfield.
pub const PUBLISHED: &str = "vcs_at_publish_";
/// Where the work begins, and the conversion.
pub const WORK: &str = "next_picture";
/// See [`WORK`].
pub const CONVERT: &str = "vcs_convert";

/// A line and the place in the scene that it comes from.
type Line = (String, Option<Span>);

/// A cartridge's program.
#[derive(Clone, Debug)]
pub struct Cartridge {
    /// Its text.
    pub document: Document,
    /// How many banks it has.
    pub banks: u32,
    /// Bytes of them that are used.
    pub rom: u32,
    /// Bytes of the machine's RAM that are used, the stack among them, and of the cartridge's.
    pub ram: u32,
    /// See there.
    pub chip: u32,
    /// Where the states are.
    pub states: Vec<Held>,
    /// How the picture is shown.
    pub shape: Shape,
}

/// Writes a plan down as a cartridge.
///
/// # Errors
/// Why it is none, in words.
pub fn cartridge(plan: &Plan) -> Result<Cartridge, String> {
    let columns = columns(plan).map_err(|refusal| refusal.why)?;
    let shape = Shape::of(plan, &columns);
    let plan = &reduced(plan, &columns);
    if plan.is_outlined() {
        return Err("it has subroutines".to_owned());
    }
    let homes = Homes::new(plan);
    let mut work = work::Work::new(plan, &homes, &columns);
    tidy(&mut work.lines, &work.symbols.clone(), &work.code.clone());
    let units = parts::Units::new(plan, &homes, &work)?;
    let mut names = work::cells(&work.lines);
    // Tables have names like bytes.
    names.retain(|cell| !units.labels.contains_key(&cell.name));
    let code = without_unread(plan, &homes, work.code_lines());
    let beside = units.lines(&code);
    let boot = kernel::boot(plan, &homes, &shape, &[&code, &beside]);
    let places = ram::Places::new(plan, &names, &[&code, &beside, &boot])?;
    let pieces = work::pieces(code);
    let kernel = kernel::text(&shape);
    let packed = banks::packed(plan, pieces, &units, &places, (boot, kernel), &shape)?;
    let (text, lines): (Vec<String>, Vec<Option<Span>>) = packed.lines.into_iter().unzip();
    let states = held(plan, &homes, &places, &text);
    Ok(Cartridge {
        document: Document {
            name: format!("{}.asm", plan.name),
            text: text.join("\n") + "\n",
            lines,
            later: Vec::new(),
        },
        banks: packed.banks,
        rom: packed.rom,
        ram: places.ram,
        chip: places.chip,
        states,
        shape,
    })
}

/// The plan without what is done for rows and pixels: what says how tall columns are and of which
/// kind is reported instead, so that it is kept.
fn reduced(plan: &Plan, columns: &crate::plan::columns::Columns) -> Plan {
    let mut plan = plan.clone();
    let graph = &plan.graph;
    let for_pixels = |statement: &Statement| {
        matches!(statement, Statement::Set { place: Place::Node(id), from: Origin::Node(_) }
            if matches!(graph.node(*id), Node::Tabulated(_)))
    };
    let mut column = plan.tree.column.clone();
    column.retain(|statement| !for_pixels(statement));
    plan.tree.column = column;
    for block in [
        &mut plan.tree.row,
        &mut plan.tree.pass,
        &mut plan.tree.segment,
        &mut plan.tree.pixel,
    ] {
        block.clear();
    }
    plan.still = None;
    plan.graph.reports.push(columns.tall);
    let kinds = columns.kinds.iter().map(|(id, _, _)| *id);
    plan.graph.reports.extend(kinds);
    plan
}

/// The work without the bytes of what is held that nobody reads.
fn without_unread(plan: &Plan, homes: &Homes, mut lines: Vec<Line>) -> Vec<Line> {
    for (id, _) in plan.graph.buttons() {
        let name = homes.name(Slot::Param(id.0));
        let texts: Vec<&str> = lines.iter().map(|(line, _)| line.as_str()).collect();
        let read = super::steps::read(&texts, name);
        let unread = |line: &str| {
            let stored = line
                .trim()
                .strip_prefix("sta ")
                .and_then(|to| to.strip_prefix(name));
            let byte = stored.and_then(|rest| rest.strip_prefix('+')?.parse::<u32>().ok());
            byte.is_some_and(|k| read.checked_shr(k).unwrap_or(0) & 1 == 0)
        };
        lines.retain(|(line, _)| !unread(line));
    }
    lines
}

/// Where the program has its states.
fn held(plan: &Plan, homes: &Homes, places: &ram::Places, text: &[String]) -> Vec<Held> {
    let lines: Vec<&str> = text.iter().map(String::as_str).collect();
    let lines: Vec<&str> = lines.into_iter().filter(|l| l.starts_with(' ')).collect();
    let held = plan.graph.steps().filter_map(|(state, next)| {
        let slot = Slot::Param(state.0);
        let name = homes.name(slot);
        Some(Held {
            state,
            address: places.at(name)?,
            bytes: match plan.graph.ty(next) {
                Type::Bool => 1,
                _ => homes.bytes(plan, slot) as u8,
            },
            read: super::steps::read(&lines, name),
        })
    });
    held.collect()
}
