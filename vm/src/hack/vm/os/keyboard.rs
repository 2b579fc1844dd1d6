//! Keys on the VM: what a look at the keyboard's word sees, and the functions that wait.

use super::super::command::{KEYBOARD, Memory, RAM_MASK, SCREEN};
use super::{Os, Trap, memory as heap, string};
use crate::Screen;
use crate::hack::keyboard::{MILLISECONDS, VM_FRAME, code};
use crate::hack::screen::screen;
use crate::keys::{Keyboard, Next, Seen, Still, never};

/// Characters of a line, as our system in Jack has it.
const LINE: u16 = 80;

/// A keyboard on the VM.
#[derive(Clone, Debug)]
pub(in crate::hack::vm) struct Keys {
    pub keyboard: Keyboard,
    /// Commands that would have passed while the program waited.
    waited: u64,
    still: Still<u16>,
}

impl Keys {
    pub fn new(keyboard: Keyboard) -> Keys {
        Keys {
            keyboard,
            waited: 0,
            still: Still::default(),
        }
    }

    /// `Sys.wait`.
    pub fn pass(&mut self, milliseconds: u16) {
        self.waited += u64::from(milliseconds) * VM_FRAME / MILLISECONDS;
    }
}

fn shown(memory: &Memory) -> Option<Screen> {
    let words = memory.get(usize::from(SCREEN)..usize::from(KEYBOARD));
    Some(screen(words.unwrap_or(&[])))
}

/// The program is about to read the keyboard's word.
pub(in crate::hack::vm) fn look(memory: &mut Memory, os: &mut Os) -> Result<(), Trap> {
    let Some(keys) = &mut os.keys else {
        return Ok(());
    };
    let frame = (os.now + keys.waited) / VM_FRAME;
    let words = memory.iter().take(usize::from(SCREEN));
    let now = os.now;
    keys.keyboard
        .remember(now, || words.map(|word| *word as i16).collect());
    memory[usize::from(KEYBOARD)] = match keys.keyboard.look(frame, || shown(memory)) {
        Seen::Nothing => 0,
        Seen::Key(key) => code(key),
        Seen::Quit => return Err(Trap::Halt),
    };
    let place = os.place << 1 | u64::from(os.black);
    let ram = memory.get(..=usize::from(RAM_MASK)).unwrap_or(&[]);
    if keys.keyboard.is_over() && keys.still.again(place, ram) {
        return Err(Trap::Fault(never("the program")));
    }
    Ok(())
}

/// Waits for a key that is pressed and let go; answers its code.
fn press(memory: &Memory, os: &mut Os, who: &str) -> Result<u16, Trap> {
    let Some(keys) = &mut os.keys else {
        return Err(Trap::Fault(format!(
            "{who} waits for a key, and nobody presses one on this machine"
        )));
    };
    keys.still = Still::default();
    let line = os.text.rsplit('\n').next().unwrap_or("");
    loop {
        let frame = (os.now + keys.waited) / VM_FRAME;
        match keys.keyboard.wait_press(frame, line, || shown(memory)) {
            Next::Key(key, frames) => {
                keys.waited += frames * VM_FRAME;
                if code(key) != 0 {
                    return Ok(code(key));
                }
            }
            Next::Quit => return Err(Trap::Halt),
            Next::Never => return Err(Trap::Fault(never(who))),
        }
    }
}

pub(super) fn read_char(memory: &Memory, os: &mut Os) -> Result<u16, Trap> {
    let c = press(memory, os, "Keyboard.readChar")?;
    string::print_char(os, c);
    Ok(c)
}

pub(super) fn read_line(memory: &mut Memory, os: &mut Os, message: u16) -> Result<u16, Trap> {
    line(memory, os, message, "Keyboard.readLine")
}

pub(super) fn read_int(memory: &mut Memory, os: &mut Os, message: u16) -> Result<u16, Trap> {
    let line = line(memory, os, message, "Keyboard.readInt")?;
    let value = string::int_value(memory, os, line);
    heap::de_alloc(memory, os, line);
    Ok(value)
}

/// Shows a message, and what is typed up to a new line, as a new string.
fn line(memory: &mut Memory, os: &mut Os, message: u16, who: &str) -> Result<u16, Trap> {
    if !os.native_heap {
        return Err(Trap::Fault(format!(
            "{who} is the machine's own, and the program brings its own Memory: bring Keyboard as well, or take --os jack"
        )));
    }
    string::print_string(memory, os, message);
    let line = string::new(memory, os, LINE)?;
    loop {
        let length = string::length(memory, line);
        match press(memory, os, who)? {
            string::NEW_LINE => break,
            string::BACK_SPACE if length > 0 => {
                string::erase_last_char(memory, os, line)?;
                string::print_char(os, string::BACK_SPACE);
            }
            string::BACK_SPACE => {}
            c if length < LINE => {
                string::append_char(memory, os, line, c)?;
                string::print_char(os, c);
            }
            _ => {}
        }
    }
    string::print_char(os, string::NEW_LINE);
    Ok(line)
}
