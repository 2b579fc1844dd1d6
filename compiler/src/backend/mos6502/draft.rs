//! A program as it is first written, and what becomes of it when it is read again as a whole.
//!
//! That takes most of the time, and makes the program shorter by a small part: so a draft says
//! how long it is before it is tidied, and the program that was tidied last is kept. The one
//! that is found to fit is the one that is wanted next, more than once.

use super::bbc::SET_UP;
use super::extent::{Extent, extent};
use super::frame::{self, Lines};
use super::homes::Homes;
use super::memory::Room;
use super::syntax::{self, Syntax};
use super::{Document, Text};
use crate::plan::Plan;
use crate::source::Span;
use slowlight_runtime_6502::tidy::outline::outline;
use slowlight_runtime_6502::tidy::tidy;
use slowlight_runtime_6502::tidy::undocumented::undocumented as put_undocumented;
use std::sync::{Mutex, PoisonError};

/// A plan's program.
pub struct Draft<'p> {
    plan: &'p Plan,
    syntax: &'p Syntax,
    /// What it may take of its machine's memory, and what its values do.
    pub room: Room,
    lines: Vec<Line>,
    parts: Lines,
}

/// A line and the place in the scene that it comes from.
type Line = (String, Option<Span>);

/// The program that was tidied last.
struct Tidied {
    parts: Lines,
    undocumented: bool,
    room: Option<Room>,
    before: Vec<Line>,
    behind: Vec<Line>,
}

static LAST: Mutex<Option<Tidied>> = Mutex::new(None);

impl<'p> Draft<'p> {
    /// As it is first written.
    pub fn new(plan: &'p Plan) -> Draft<'p> {
        Draft::with(plan, syntax::USUAL)
    }

    /// The same for some assembler.
    pub(super) fn with(plan: &'p Plan, syntax: &'p Syntax) -> Draft<'p> {
        let homes = Homes::new(plan);
        let mut text = Text::default();
        let parts = frame::program(plan, &homes, syntax, &mut text);
        Draft {
            plan,
            syntax,
            room: homes.room(plan),
            lines: text.lines,
            parts,
        }
    }

    /// Leaves out what it does without, which only ever makes it shorter; where it is to be short,
    /// what it has several times is called, as far as it is too large.
    pub fn tidy(&mut self) {
        let undocumented = self.plan.undocumented;
        let room = self.plan.tight.then_some(self.room);
        let same = |last: &&Tidied| {
            last.parts == self.parts
                && last.undocumented == undocumented
                && last.room == room
                && last.before == self.lines
        };
        let last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(last) = last.as_ref().filter(same) {
            self.lines = last.behind.clone();
            return;
        }
        drop(last);
        let before = self.lines.clone();
        let Lines { symbols, code } = &self.parts;
        tidy(&mut self.lines, symbols, code);
        if let Some(excess) = room.and_then(|room| self.excess(room)) {
            let gone = before.len() - self.lines.len();
            let mut own = code.start..code.end - gone;
            // What is done once takes no room where it stands, and must not be called later.
            let once = |(line, _): &Line| line.strip_suffix(':') == Some(SET_UP);
            if let Some(at) = self.lines[own.clone()].iter().position(once) {
                own.end = own.start + at;
            }
            outline(&mut self.lines, symbols, &own, excess);
        }
        if undocumented {
            put_undocumented(&mut self.lines, symbols, code.start);
        }
        *LAST.lock().unwrap_or_else(PoisonError::into_inner) = Some(Tidied {
            parts: self.parts.clone(),
            undocumented,
            room,
            before,
            behind: self.lines.clone(),
        });
    }

    /// By how many bytes it is too large.
    fn excess(&self, room: Room) -> Option<u32> {
        let all = self.bytes()? + room.values;
        u32::try_from(all.saturating_sub(room.bytes)).ok()
    }

    /// Bytes that it takes of its room, without what of it may be where the screen will be;
    /// nothing where that is not known without assembling it.
    pub fn bytes(&self) -> Option<u64> {
        let Extent { origin, label, end } = self.placed()?;
        let whole = end.saturating_sub(origin);
        let resident = label.map_or(whole, |label| label.saturating_sub(origin));
        Some(u64::from(resident).max(u64::from(whole).saturating_sub(self.room.once)))
    }

    /// The addresses of its first byte and behind its last one, which may be beyond 64K;
    /// nothing where that is not known without assembling it.
    pub fn extent(&self) -> Option<(u32, u32)> {
        self.placed().map(|extent| (extent.origin, extent.end))
    }

    fn placed(&self) -> Option<Extent> {
        // What an assembler is told around the program is no part of it.
        let told = |line: &&str| Some(*line) == self.syntax.first();
        let behind = usize::from(self.syntax.last("", None).is_some());
        let lines = self.lines.len() - behind;
        let lines = self.lines.iter().take(lines).map(|(line, _)| line.as_str());
        extent(lines.filter(|line| !told(line)), SET_UP)
    }

    /// As a text.
    pub fn document(&self) -> Document {
        let (text, lines) = self.syntax.write(&self.lines);
        Document {
            name: format!("{}.asm", self.plan.name),
            text,
            lines,
            later: Vec::new(),
        }
    }
}
