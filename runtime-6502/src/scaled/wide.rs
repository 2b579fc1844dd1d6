//! Numbers of more bytes read as reals of fewer: whole bytes
//! are taken from where they stand, and only what is left of the shift is done bit by bit.

use super::Read;
use super::read::{Pace, add, one_more};
use crate::write::{Place, byte, byte_at};

/// The most bits to the right that are read so.
const MOST: u32 = 16;

/// From so many bits of a byte on it is quicker to go to the left.
const LEFT: u32 = 5;

/// Writes the reading; whether there is such.
pub(super) fn read(read: Read<'_>, lines: &mut Vec<String>) -> bool {
    let Read {
        from,
        by,
        fits,
        to,
        bytes,
        serial: n,
        ..
    } = read;
    let down = by.unsigned_abs();
    if by >= 0 || down > MOST {
        return false;
    }
    if !fits {
        return saturating(read, lines);
    }
    let (first, bits) = (down / 8, down % 8);
    let at = |k: u32| byte(from, (first + k) as u8);
    let mut code = |text: &str| add(text, lines);
    let to_at = |k: u8| byte_at(to, k);
    let rounded = one_more(to, bytes, &format!("read{n}"));
    if bits == 0 {
        let below = byte(from, (first - 1) as u8);
        // The sum's upper byte: where it has none of its own, the sign's.
        code(&format!("lda {} | sta {to}", at(0)));
        for k in 1..bytes {
            upper(from, first + u32::from(k), &mut code);
            code(&format!("sta {}", to_at(k)));
        }
        code(&format!("lda {below} | bpl read{n} | {rounded}"));
        return true;
    }
    if bits >= LEFT {
        // By the rest of a byte to the left, and a byte to the right.
        code(&format!("lda {} | sta acc", at(0)));
        for k in 0..bytes - 1 {
            upper(from, first + 1 + u32::from(k), &mut code);
            code(&format!("sta {}", to_at(k)));
        }
        upper(from, first + u32::from(bytes), &mut code);
        let each: String = (0..bytes - 1)
            .map(|k| format!("rol {} | ", to_at(k)))
            .collect();
        code(&format!("asl acc | {each}rol | ").repeat((8 - bits) as usize));
        code(&format!(
            "sta {} | asl acc | bcc read{n} | {rounded}",
            to_at(bytes - 1)
        ));
        return true;
    }
    code(&format!("lda {} | sta {to}", at(0)));
    for k in 1..bytes {
        upper(from, first + u32::from(k), &mut code);
        code(&format!("sta {}", to_at(k)));
    }
    upper(from, first + u32::from(bytes), &mut code);
    // What is above these bits does not come down.
    let each: String = (0..bytes)
        .rev()
        .map(|k| format!("ror {} | ", to_at(k)))
        .collect();
    code(&format!("lsr | {each}").repeat(bits as usize));
    code(&format!("bcc read{n} | {rounded}"));
    true
}

/// The same where it may not fit: what the upper byte has more than a sign is asked first.
fn saturating(used: Read<'_>, lines: &mut Vec<String>) -> bool {
    let Read {
        from,
        by,
        to,
        bytes,
        serial: n,
        pace,
        ..
    } = used;
    let Place::Held(name, shape) = from else {
        return false;
    };
    // Of the upper byte's bits, those that come down.
    let left =
        i64::from(by.unsigned_abs()) + 8 * i64::from(bytes) - 1 - 8 * i64::from(shape.bytes - 1);
    if pace != Pace::Quick || !shape.signed || name == to || left < 0 {
        return false;
    }
    let top = byte(from, shape.bytes - 1);
    if left < 7 {
        let end = 1u32 << left;
        let test = format!(
            "lda {top} | clc | adc #{end} | cmp #{} | bcs large{n}",
            2 * end
        );
        add(&test, lines);
    }
    read(Read { fits: true, ..used }, lines);
    let at = |k: u8| byte_at(to, k);
    let rest: String = (1..bytes - 1)
        .map(|k| format!("ora {} | ", at(k)))
        .collect();
    let middle: String = (1..bytes - 1)
        .map(|k| format!("sta {} | ", at(k)))
        .collect();
    if bytes == 1 {
        // The same in the one byte that there is.
        add(
            &format!(
                "lda {to} | cmp #$80 | bne held{n} | large{n}: | lda {top} | asl | lda #$7f | adc #0 | cmp #$80 | adc #0 | sta {to} | held{n}:"
            ),
            lines,
        );
        return true;
    }
    // What rounds to one more than the end, and the one number that has no negative.
    add(
        &format!(
            "lda {high} | cmp #$80 | bne held{n} | lda {to} | {rest}bne held{n}
            | large{n}: | lda {top} | asl | lda #$7f | adc #0 | sta {high} | eor #$80 | {middle}ora #1 | sta {to} | held{n}:",
            high = at(bytes - 1)
        ),
        lines,
    );
    true
}

/// A byte of a number, in the accumulator: of the sign where it has none there.
fn upper(from: &Place, k: u32, code: &mut dyn FnMut(&str)) {
    match from {
        Place::Held(_, shape) if shape.signed && k >= u32::from(shape.bytes) => {
            let last = byte(from, shape.bytes - 1);
            code(&format!("lda {last} | asl | lda #0 | adc #$ff | eor #$ff"));
        }
        _ => code(&format!("lda {}", byte(from, k as u8))),
    }
}
