//! Proves how high the stack stands at every command.
//!
//! The fused engine leaves out the checks for overflow and underflow, and
//! joins commands as if locals and arguments were never stack cells in use.
//! Both are right where every path to a command leaves the same number of
//! words above the locals, no command takes more than there are, and locals
//! and arguments stay within their counts. Jack compilers emit nothing else.

use super::command::{ARG, Command, LCL, Place};
use super::link::Function;

/// The height at a command that no path reaches.
pub(in crate::hack) const UNREACHED: u16 = u16::MAX;

/// More words than the stack has: whoever needs them overflows it.
const TOO_HIGH: u16 = 4096;

/// What is proved about a program.
pub(in crate::hack) struct Heights {
    /// Words above the locals before each command.
    pub at: Vec<u16>,
    /// The greatest height in each function.
    pub peaks: Vec<u16>,
}

/// The heights, or `None` if they are not the same on every path.
pub(in crate::hack) fn prove(
    commands: &[Command],
    functions: &[Function],
    start: u32,
) -> Option<Heights> {
    let mut arguments = vec![u16::MAX; functions.len()];
    *arguments.get_mut(start as usize)? = 0;
    for command in commands {
        if let Command::Call {
            function,
            arguments: given,
            ..
        } = *command
        {
            let least = arguments.get_mut(function as usize)?;
            *least = given.min(*least);
        }
    }
    let mut heights = Heights {
        at: vec![UNREACHED; commands.len()],
        peaks: Vec::with_capacity(functions.len()),
    };
    for (function, arguments) in functions.iter().zip(arguments) {
        let frame = Frame {
            locals: function.locals,
            arguments,
        };
        let peak = frame.walk(commands, function.start + 1, &mut heights.at)?;
        heights.peaks.push(peak);
    }
    Some(heights)
}

/// What a function's commands may name.
struct Frame {
    locals: u16,
    arguments: u16,
}

impl Frame {
    /// Follows all paths from `first`; answers the greatest height.
    fn walk(&self, commands: &[Command], first: u32, at: &mut [u16]) -> Option<u16> {
        let mut peak = 0;
        let mut work = vec![(first, 0)];
        while let Some((index, height)) = work.pop() {
            let known = at.get_mut(index as usize)?;
            if *known != UNREACHED {
                if *known != height {
                    return None;
                }
                continue;
            }
            *known = height;
            let command = *commands.get(index as usize)?;
            let (takes, leaves) = self.effect(command)?;
            let after = height.checked_sub(takes)?.saturating_add(leaves);
            if after > TOO_HIGH {
                return None;
            }
            peak = peak.max(after);
            match command {
                Command::Return | Command::FunctionEnd => {}
                Command::Goto(target) => work.push((target, after)),
                Command::IfGoto(target) => work.extend([(target, after), (index + 1, after)]),
                _ => work.push((index + 1, after)),
            }
        }
        Some(peak)
    }

    /// How many words a command takes from the stack and leaves there.
    fn effect(&self, command: Command) -> Option<(u16, u16)> {
        match command {
            Command::Push(place) if self.allows(place) => Some((0, 1)),
            Command::Pop(place) if self.allows(place) => Some((1, 0)),
            Command::Push(_) | Command::Pop(_) | Command::Function { .. } => None,
            Command::Binary(_) => Some((2, 1)),
            Command::Neg | Command::Not => Some((1, 1)),
            Command::IfGoto(_) => Some((1, 0)),
            Command::Return => Some((1, 1)),
            Command::Goto(_) | Command::FunctionEnd => Some((0, 0)),
            Command::Call { arguments, .. } => Some((arguments, 1)),
            Command::Native(native) => Some((native.arguments(), 1)),
        }
    }

    fn allows(&self, place: Place) -> bool {
        match place.base {
            LCL => place.offset < self.locals,
            ARG => place.offset < self.arguments,
            _ => true,
        }
    }
}
