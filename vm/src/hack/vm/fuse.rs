//! Operations, each of which does several commands at once.
//!
//! An operation never reaches over a jump's target, and the whole state is
//! that of the real machine before and after each, so the engines can change
//! places between any two. Within one, the words that would only pass
//! through the stack do not.

use super::command::{Command, HEAP, Place};
use super::heights::{self, UNREACHED};
use super::join::join;
use super::link::Function;
use super::os::Native;
use std::collections::HashSet;

/// An index of [`Fused::cells`], in halves so that an operation needs no
/// alignment beyond 2 and a cell stays at 16 bytes. While cells are being
/// made, an index of the commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Target([u16; 2]);

impl Target {
    pub const fn new(index: u32) -> Self {
        Target([(index >> 16) as u16, index as u16])
    }

    #[inline(always)]
    pub const fn index(self) -> usize {
        let Target([high, low]) = self;
        ((high as u32) << 16 | low as u32) as usize
    }
}

/// An operation. The digit in a name tells how many operands are places
/// (never fields) and not the stack's; `To` ends in a place instead of on
/// the stack; a jump is taken where its comparison holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Op {
    /// Leaves the next command to the plain engine.
    Plain,
    Push(Place),
    PushTwo(Place, Place),
    PushWord(u16),
    PushField(Place),
    Pop(Place),
    PopField(Place),
    Move(Place, Place),
    FieldTo(Place, Place),
    ToField(Place, Place),
    Neg,
    Not,

    Add0,
    Sub0,
    And0,
    Or0,
    Eq0,
    Gt0,
    Lt0,
    Add1(Place),
    Sub1(Place),
    And1(Place),
    Or1(Place),
    Eq1(Place),
    Gt1(Place),
    Lt1(Place),
    Add2(Place, Place),
    Sub2(Place, Place),
    And2(Place, Place),
    Or2(Place, Place),
    Eq2(Place, Place),
    Gt2(Place, Place),
    Lt2(Place, Place),
    Add1To(Place, Place),
    Sub1To(Place, Place),
    And1To(Place, Place),
    Or1To(Place, Place),
    Add2To(Place, Place, Place),
    Sub2To(Place, Place, Place),
    And2To(Place, Place, Place),
    Or2To(Place, Place, Place),

    /// `add`, `pop pointer 1`, `push that 0`.
    Fetch0,
    Fetch1(Place),
    Fetch2(Place, Place),
    Fetch2To(Place, Place, Place),
    /// `pop temp t`, `pop pointer 1`, `push temp t`, `pop that 0`.
    Store(Place),

    Goto(Target),
    If(Target),
    IfNot(Target),
    If1(Place, Target),
    IfNot1(Place, Target),
    IfEq0(Target),
    IfNe0(Target),
    IfLt0(Target),
    IfGe0(Target),
    IfGt0(Target),
    IfLe0(Target),
    IfEq1(Place, Target),
    IfNe1(Place, Target),
    IfLt1(Place, Target),
    IfGe1(Place, Target),
    IfGt1(Place, Target),
    IfLe1(Place, Target),
    IfEq2(Place, Place, Target),
    IfNe2(Place, Place, Target),
    IfLt2(Place, Place, Target),
    IfGe2(Place, Place, Target),
    IfGt2(Place, Place, Target),
    IfLe2(Place, Place, Target),

    /// A call, with the callee's `function` command.
    Call {
        target: Target,
        arguments: u16,
        locals: u16,
        room: u16,
        site: u16,
    },
    Return,
    Multiply,
    Divide,
    Native(Native),
}

impl Op {
    fn target_mut(&mut self) -> Option<&mut Target> {
        match self {
            Op::Goto(to) | Op::If(to) | Op::IfNot(to) | Op::If1(_, to) | Op::IfNot1(_, to) => {
                Some(to)
            }
            Op::IfEq0(to) | Op::IfNe0(to) | Op::IfLt0(to) => Some(to),
            Op::IfGe0(to) | Op::IfGt0(to) | Op::IfLe0(to) => Some(to),
            Op::IfEq1(_, to) | Op::IfNe1(_, to) | Op::IfLt1(_, to) => Some(to),
            Op::IfGe1(_, to) | Op::IfGt1(_, to) | Op::IfLe1(_, to) => Some(to),
            Op::IfEq2(_, _, to) | Op::IfNe2(_, _, to) | Op::IfLt2(_, _, to) => Some(to),
            Op::IfGe2(_, _, to) | Op::IfGt2(_, _, to) | Op::IfLe2(_, _, to) => Some(to),
            Op::Call { target, .. } => Some(target),
            _ => None,
        }
    }
}

/// An operation and the number of commands that it executes.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
pub(super) struct Cell {
    pub op: Op,
    pub commands: u16,
}

/// No operation starts here.
const NONE: u32 = u32::MAX;

/// The most commands that are joined.
const LONGEST_OP: u32 = 6;

/// A program's operations.
#[derive(Clone, Debug)]
pub(super) struct Fused {
    pub cells: Vec<Cell>,
    /// The command that each operation starts with.
    pub origins: Vec<u32>,
    /// The operation at each return site; past the end of `cells` for those
    /// that are no command.
    pub sites: Vec<u32>,
    /// More commands than any path without a jump, a call or a return has.
    pub longest: u64,
    /// The operation that starts with each command, or `NONE`.
    entries: Vec<u32>,
    rooms: Vec<u16>,
}

impl Fused {
    /// Joins the commands of a program; `None` if its stack heights cannot be proved.
    pub fn new(
        commands: &[Command],
        functions: &[Function],
        sites: &[u32],
        start: u32,
    ) -> Option<Fused> {
        let heights = heights::prove(commands, functions, start)?;
        let rooms = functions.iter().zip(&heights.peaks);
        let mut fused = Fused {
            cells: Vec::new(),
            origins: Vec::new(),
            sites: Vec::new(),
            longest: 0,
            entries: vec![NONE; commands.len()],
            rooms: rooms
                .map(|(f, peak)| HEAP.saturating_sub(f.locals.saturating_add(*peak)))
                .collect(),
        };
        let targets: HashSet<u32> = commands
            .iter()
            .filter_map(|command| match command {
                Command::Goto(target) | Command::IfGoto(target) => Some(*target),
                _ => None,
            })
            .collect();
        for function in functions {
            // Twice over, as a call's cell also counts the callee's first command.
            let length = 2 * u64::from(function.end - function.start + 2);
            fused.longest = fused.longest.max(length);
            fused.add(function, commands, functions, &heights.at, &targets)?;
        }
        let entries = &fused.entries;
        let entry = |at: usize| entries.get(at).copied().unwrap_or(NONE);
        for cell in &mut fused.cells {
            if let Some(target) = cell.op.target_mut() {
                *target = Target::new(entry(target.index()));
            }
        }
        fused.sites = sites.iter().map(|site| entry(*site as usize)).collect();
        Some(fused)
    }

    /// Adds the operations of one function.
    fn add(
        &mut self,
        function: &Function,
        commands: &[Command],
        functions: &[Function],
        heights: &[u16],
        targets: &HashSet<u32>,
    ) -> Option<()> {
        let mut at = function.start + 1;
        while at <= function.end {
            if heights.get(at as usize) == Some(&UNREACHED) {
                at += 1;
                continue;
            }
            let most = (function.end + 1).min(at + LONGEST_OP);
            let end = (at + 1..most).find(|next| targets.contains(next));
            let window = commands.get(at as usize..end.unwrap_or(most) as usize)?;
            let (op, taken) = join(at, window);
            let mut commands = taken as u16;
            let op = match op {
                Op::Call {
                    target,
                    arguments,
                    site,
                    ..
                } => {
                    let callee = functions.get(target.index())?;
                    commands += 1;
                    Op::Call {
                        target: Target::new(callee.start + 1),
                        arguments,
                        locals: callee.locals,
                        room: self.room(target.index() as u32),
                        site,
                    }
                }
                op => op,
            };
            *self.entries.get_mut(at as usize)? = self.cells.len() as u32;
            self.cells.push(Cell { op, commands });
            self.origins.push(at);
            at += taken;
        }
        Some(())
    }

    /// The operation that starts with a command, if one does.
    pub fn entry(&self, command: u32) -> Option<usize> {
        let entry = self.entries.get(command as usize).copied();
        entry
            .filter(|entry| *entry != NONE)
            .map(|entry| entry as usize)
    }

    /// The highest SP right after a function's frame is pushed that leaves
    /// room for all that it pushes itself.
    pub fn room(&self, function: u32) -> u16 {
        self.rooms.get(function as usize).copied().unwrap_or(0)
    }
}
