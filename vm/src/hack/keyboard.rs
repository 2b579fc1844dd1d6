//! The keyboard of the Hack computer: the codes of its keys, and its clock's frames.
//!
//! Codes are those of *The Elements of Computing Systems*, appendix 5; letters are as they
//! are typed, `a` 97 and `A` 65.

use crate::keys::Key;

/// Commands of the VM in a frame, a fiftieth of a second at what the official emulator does.
pub(super) const VM_FRAME: u64 = 250_000;
/// Cycles of the CPU in a frame, a fiftieth of a second at 7.2 MHz.
pub(super) const CPU_FRAME: u64 = 144_000;
/// Milliseconds of a frame.
pub(super) const MILLISECONDS: u64 = 20;

/// The word at the keyboard's address while a key is held; 0 for keys that the computer does
/// not have.
pub(super) fn code(key: Key) -> u16 {
    match key {
        Key::Char(c) => u16::from(c),
        Key::Enter => 128,
        Key::Backspace => 129,
        Key::Left => 130,
        Key::Up => 131,
        Key::Right => 132,
        Key::Down => 133,
        Key::Home => 134,
        Key::End => 135,
        Key::PageUp => 136,
        Key::PageDown => 137,
        Key::Insert => 138,
        Key::Delete => 139,
        Key::Escape => 140,
        Key::Function(n @ 1..=12) => 140 + u16::from(n),
        Key::Function(_) | Key::Tab | Key::Shift | Key::Control => 0,
    }
}
