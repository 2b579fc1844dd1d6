//! Strings in the RAM: the capacity, the length, then a word a character.

use super::{Memory, Os, Trap, load, memory};

pub(super) const NEW_LINE: u16 = 128;
pub(super) const BACK_SPACE: u16 = 129;

/// What `Output` shows for a code that has no character.
const UNKNOWN: char = '\u{25a0}';

pub(super) fn new(memory: &mut Memory, os: &mut Os, capacity: u16) -> Result<u16, Trap> {
    if capacity.cast_signed() < 0 {
        return Err(Trap::Error(14, "a string's capacity must not be negative"));
    }
    let string = memory::alloc(memory, os, capacity + 2)?;
    os.store(memory, string, capacity);
    os.store(memory, string.wrapping_add(1), 0);
    Ok(string)
}

pub(super) fn length(memory: &Memory, string: u16) -> u16 {
    load(memory, string.wrapping_add(1))
}

/// The address of character `index`, if the string has it.
fn place(memory: &Memory, string: u16, index: u16) -> Option<u16> {
    let index = index.cast_signed();
    let inside = index >= 0 && index < length(memory, string).cast_signed();
    inside.then(|| string.wrapping_add(2).wrapping_add(index.cast_unsigned()))
}

pub(super) fn char_at(memory: &Memory, string: u16, index: u16) -> Result<u16, Trap> {
    match place(memory, string, index) {
        Some(address) => Ok(load(memory, address)),
        None => Err(Trap::Error(15, "charAt outside the string")),
    }
}

pub(super) fn set_char_at(
    memory: &mut Memory,
    os: &mut Os,
    string: u16,
    index: u16,
    c: u16,
) -> Result<u16, Trap> {
    let address =
        place(memory, string, index).ok_or(Trap::Error(16, "setCharAt outside the string"))?;
    os.store(memory, address, c);
    Ok(0)
}

/// Answers the string itself, as the API has it.
pub(super) fn append_char(
    memory: &mut Memory,
    os: &mut Os,
    string: u16,
    c: u16,
) -> Result<u16, Trap> {
    let length = length(memory, string);
    if length == load(memory, string) {
        return Err(Trap::Error(17, "the string is full"));
    }
    os.store(memory, string.wrapping_add(2).wrapping_add(length), c);
    os.store(memory, string.wrapping_add(1), length.wrapping_add(1));
    Ok(string)
}

pub(super) fn erase_last_char(memory: &mut Memory, os: &mut Os, string: u16) -> Result<u16, Trap> {
    let length = length(memory, string);
    if length == 0 {
        return Err(Trap::Error(18, "the string is empty"));
    }
    os.store(memory, string.wrapping_add(1), length - 1);
    Ok(0)
}

/// The characters' codes.
fn codes(memory: &Memory, string: u16) -> impl Iterator<Item = u16> + '_ {
    let length = length(memory, string).cast_signed().max(0).cast_unsigned();
    let first = string.wrapping_add(2);
    (0..length).map(move |i| load(memory, first.wrapping_add(i)))
}

/// The number that the string starts with, after an optional minus; 0 without one.
pub(super) fn int_value(memory: &Memory, os: &mut Os, string: u16) -> u16 {
    let mut codes = codes(memory, string).peekable();
    let negative = codes.next_if_eq(&u16::from(b'-')).is_some();
    let mut value = 0u16;
    for code in codes {
        os.effort += 1;
        let digit = code.wrapping_sub(u16::from(b'0'));
        if digit > 9 {
            break;
        }
        value = value.wrapping_mul(10).wrapping_add(digit);
    }
    if negative {
        value.wrapping_neg()
    } else {
        value
    }
}

pub(super) fn set_int(
    memory: &mut Memory,
    os: &mut Os,
    string: u16,
    value: u16,
) -> Result<u16, Trap> {
    let digits = value.cast_signed().to_string();
    if usize::try_from(load(memory, string).cast_signed()).unwrap_or(0) < digits.len() {
        return Err(Trap::Error(19, "the string has no room for the number"));
    }
    let mut address = string.wrapping_add(1);
    os.store(memory, address, digits.len() as u16);
    for digit in digits.bytes() {
        address = address.wrapping_add(1);
        os.store(memory, address, u16::from(digit));
    }
    Ok(0)
}

pub(super) fn print_char(os: &mut Os, code: u16) {
    match code {
        NEW_LINE => os.print('\n'),
        BACK_SPACE => {
            if !os.text.ends_with('\n') {
                os.text.pop();
            }
        }
        32..=126 => os.print(char::from(code as u8)),
        _ => os.print(UNKNOWN),
    }
}

pub(super) fn print_string(memory: &Memory, os: &mut Os, string: u16) {
    for code in codes(memory, string) {
        os.effort += 1;
        print_char(os, code);
    }
}
