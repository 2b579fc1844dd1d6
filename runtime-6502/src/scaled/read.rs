//! Reading a number at another scale, and its whole part.

use crate::write::{Place, Shape, byte, byte_at, copy_bytes};

/// A number to be read.
#[derive(Clone, Copy, Debug)]
pub struct Read<'a> {
    /// Where it is.
    pub from: &'a Place,
    /// So many fraction bits more.
    pub by: i32,
    /// Whether it is known not to leave the bytes that it is read into.
    pub fits: bool,
    /// Where it goes.
    pub to: &'a str,
    /// In so many bytes, 1 to 3.
    pub bytes: u8,
    /// Must differ at each use in a program.
    pub serial: u32,
    /// What is spent for what.
    pub pace: Pace,
}

/// What of memory and speed may be spent for the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// Memory.
    Quick,
    Usual,
    /// Speed.
    Short,
}

/// Adds instructions that are separated by `|` to lines.
pub(super) fn add(text: &str, lines: &mut Vec<String>) {
    for instruction in text.split('|').map(str::trim).filter(|i| !i.is_empty()) {
        let indent = if instruction.ends_with(':') {
            ""
        } else {
            "        "
        };
        lines.push(format!("{indent}{instruction}"));
    }
}

fn times(text: &str, k: i32) -> String {
    format!("{text} | ").repeat(k.max(0) as usize)
}

/// One more, if an instruction before it has not gone to the label.
pub(super) fn one_more(to: &str, bytes: u8, label: &str) -> String {
    let each: Vec<String> = (0..bytes)
        .map(|k| format!("inc {}", byte_at(to, k)))
        .collect();
    each.join(&format!(" | bne {label} | ")) + &format!(" | {label}:")
}

/// Writes the reading; answers the part of the runtime that it needs, if any.
pub fn read(read: Read<'_>, lines: &mut Vec<String>) -> Option<&'static str> {
    let Read {
        from,
        by,
        fits,
        to,
        bytes,
        pace,
        ..
    } = read;
    let short = pace == Pace::Short && bytes == 2;
    let wide = matches!(from, Place::Held(_, shape) if shape.bytes > bytes || shape.bytes == bytes && !shape.signed && !shape.spare);
    // Where it fits, its lower bytes are all of it.
    if wide && (by < 0 || !fits) {
        if super::wide::read(read, lines) {
            return None;
        }
        // An int of more bytes.
        copy_bytes(from, "acc", 4, lines);
        let way = if by < 0 { "right" } else { "left" };
        return Some(called(read, &format!("narrow_{way}"), lines));
    }
    let narrow = matches!(from, Place::Held(_, shape) if shape.bytes < bytes && shape.signed);
    let same = matches!(from, Place::At(name) | Place::Held(name, _) if name == to);
    // Whole bytes do not go up where they stand.
    let apart = bytes > 2 && by >= 8 && (narrow || same);
    let extended = if apart { "acc" } else { to };
    let held = Place::Held(extended.to_owned(), Shape::whole(bytes));
    let from = match narrow || apart {
        true => {
            copy_bytes(from, extended, bytes, lines);
            &held
        }
        false => from,
    };
    let read = Read { from, ..read };
    match by {
        // Less than a byte, of which in place each bit takes three bytes and more.
        2..8 if short && fits => return Some(called_in_16(read, lines)),
        -7..0 if short => return Some(called_in_16(read, lines)),
        0.. if fits => add(&up(read), lines),
        1..8 if bytes == 1 => add(&byte_up(read), lines),
        0.. if bytes == 1 => {
            copy_bytes(from, "acc", 4, lines);
            return Some(called(read, "narrow_left", lines));
        }
        // What leaves 16 bits has another sign then.
        1 if bytes == 2 && !narrow && !same && !short => {
            let (low, high, n) = (byte(from, 0), byte(from, 1), read.serial);
            let text = format!(
                "lda {low} | asl | sta {to} | lda {high} | rol | sta {to}+1 | eor {high} | bpl fits{n}
                | lda {high} | asl | lda #$7f | adc #0 | sta {to}+1 | eor #$80 | ora #1 | sta {to} | bne read{n}
                | fits{n}: | lda {to}+1 | cmp #$80 | bne read{n} | lda {to} | bne read{n} | inc {to} | read{n}:"
            );
            add(&text, lines);
        }
        // What the bits that are lost say must be the sign.
        2..8 if pace == Pace::Quick && bytes == 2 => {
            let (low, high, n) = (byte(from, 0), byte(from, 1), read.serial);
            let text = format!(
                "lda {high} | clc | adc #{} | cmp #{} | bcs large{n}
                | lda {low} | sta {to} | lda {high} | {}sta {to}+1
                | cmp #$80 | bne read{n} | lda {to} | bne read{n} | inc {to} | bne read{n}
                | large{n}: | lda {high} | asl | lda #$7f | adc #0 | sta {to}+1 | eor #$80 | ora #1 | sta {to} | read{n}:",
                0x80 >> by,
                0x100 >> by,
                times(&format!("asl {to} | rol"), by)
            );
            add(&text, lines);
        }
        0.. if bytes == 2 => return Some(called_in_16(read, lines)),
        0.. => {
            copy_bytes(from, "acc", 3, lines);
            return Some(called(read, "left24", lines));
        }
        _ => add(&down(read), lines),
    }
    None
}

/// Reads one of two bytes by a subroutine that has no more; answers its part.
fn called_in_16(read: Read<'_>, lines: &mut Vec<String>) -> &'static str {
    let (low, high) = (byte(read.from, 0), byte(read.from, 1));
    add(&format!("lda {low} | ldx {high}"), lines);
    let (name, part) = match read.by {
        0.. => ("left16", "narrow"),
        _ => ("right16", "right16"),
    };
    called(read, name, lines);
    part
}

/// Reads by a subroutine, of whose name that for three bytes follows; answers its part.
fn called(read: Read<'_>, name: &str, lines: &mut Vec<String>) -> &'static str {
    let Read { by, to, bytes, .. } = read;
    let count = by.unsigned_abs().min(40);
    if bytes == 1 {
        let name = name.replace("narrow_", "narrow8_");
        add(&format!("ldy #{count} | jsr {name} | sta {to}"), lines);
        return "narrow8";
    }
    if bytes == 2 {
        let text = format!("ldy #{count} | jsr {name} | sta {to} | stx {to}+1");
        add(&text, lines);
        return "narrow";
    }
    let name = name.replace("narrow_", "narrow24_");
    add(&format!("ldy #{count} | jsr {name}"), lines);
    if to != "acc" {
        copy_bytes(&Place::At("acc".to_owned()), to, bytes, lines);
    }
    "hold24"
}

/// To the left, where it fits.
fn up(read: Read<'_>) -> String {
    let Read {
        from,
        by,
        to,
        bytes,
        ..
    } = read;
    let whole = ((by / 8) as u8).min(bytes - 1);
    let bits = (by - 8 * i32::from(whole)).min(8);
    let at = |k: u8| byte_at(to, k);
    let mut text = String::new();
    for k in whole..bytes {
        text += &format!("lda {} | ", byte(from, k - whole));
        if k < bytes - 1 {
            text += &format!("sta {} | ", at(k));
        }
    }
    let shifted: Vec<String> = (whole..bytes - 1)
        .map(|k| format!("{} {}", if k == whole { "asl" } else { "rol" }, at(k)))
        .collect();
    text += &match shifted.is_empty() {
        true => times("asl", bits),
        false => times(&format!("{} | rol", shifted.join(" | ")), bits),
    };
    text += &format!("sta {} | ", at(bytes - 1));
    if whole > 0 {
        text += "lda #0 | ";
        (0..whole).for_each(|k| text += &format!("sta {} | ", at(k)));
    }
    text
}

/// A byte to the left, to the ends where it does not fit. What would be the one number that has
/// no negative does not.
fn byte_up(read: Read<'_>) -> String {
    let Read {
        from,
        by,
        to,
        serial: n,
        ..
    } = read;
    let (at, end) = (byte(from, 0), (0x80 >> by) - 1);
    format!(
        "lda {at} | clc | adc #{end} | cmp #{} | bcs large{n} | lda {at} | {}jmp held{n}
        | large{n}: | lda {at} | asl | lda #$7f | adc #0 | cmp #$80 | adc #0 | held{n}: | sta {to}",
        2 * end + 1,
        times("asl", by)
    )
}

/// To the right, rounded.
fn down(read: Read<'_>) -> String {
    let Read {
        from,
        by,
        to,
        bytes,
        serial: n,
        ..
    } = read;
    let (whole, bits) = ((-by / 8) as u8, -by % 8);
    let at = |k: u8| byte_at(to, k);
    // Less than half of the last place.
    if whole >= bytes {
        return "lda #0 | ".to_owned()
            + &(0..bytes)
                .map(|k| format!("sta {} | ", at(k)))
                .collect::<String>();
    }
    let left = bytes - whole;
    let source = |k: u8| byte(from, whole + k);
    let signs: String = (left..bytes).map(|k| format!("stx {} | ", at(k))).collect();
    if bits == 0 {
        // The sign before it is rounded: what was below 0 may become 0.
        let (below, top) = (byte(from, whole - 1), source(left - 1));
        let first = match left {
            1 => format!(
                "ldx #0 | lda {below} | asl | lda {top} | bpl read{n} | dex | read{n}: | adc #0 | sta {to} | bne above{n} | ldx #0 | above{n}: | "
            ),
            _ => format!(
                "ldx #0 | lda {below} | asl | lda {top} | bpl read{n} | dex | read{n}: | lda {} | adc #0 | sta {to} | lda {top} | adc #0 | sta {to}+1 | bcc above{n} | ldx #0 | above{n}: | ",
                source(0)
            ),
        };
        return first + &signs;
    }
    let loads: String = (0..left - 1)
        .map(|k| format!("lda {} | sta {} | ", source(k), at(k)))
        .collect();
    let rest: String = (0..left - 1)
        .rev()
        .map(|k| format!(" | ror {}", at(k)))
        .collect();
    let shift = times(&format!("cmp #$80 | ror{rest}"), bits);
    let top = source(left - 1);
    if left == 1 {
        return format!(
            "ldx #0 | lda {top} | {shift}adc #0 | sta {to} | bpl read{n} | dex | read{n}: | {signs}"
        );
    }
    let rounded: String = (0..left - 1)
        .map(|k| format!("inc {} | bne read{n} | ", at(k)))
        .collect();
    let extended = match signs.is_empty() {
        true => String::new(),
        false => format!(" | ldx #0 | cmp #$80 | bcc plus{n} | dex | plus{n}: | {signs}"),
    };
    format!(
        "{loads}lda {top} | {shift}bcc read{n} | {rounded}adc #0 | read{n}: | sta {}{extended}",
        at(left - 1)
    )
}

/// The greatest whole number not above one of `of` bytes with so many fraction bits, two
/// less than it has at most, in so many bytes.
pub fn floor(
    (from, of): (&Place, u8),
    bits: i32,
    (to, bytes): (&str, u8),
    lines: &mut Vec<String>,
) {
    let extended = Place::At("first".to_owned());
    let from = match from {
        Place::Held(_, shape) if shape.signed && shape.bytes < of => {
            copy_bytes(from, "first", of, lines);
            &extended
        }
        _ => from,
    };
    let (whole, bits) = ((bits / 8) as u8, bits % 8);
    let left = of - whole;
    let at = |k: u8| byte_at("third", k);
    let loads: String = (0..left - 1)
        .map(|k| format!("lda {} | sta {} | ", byte(from, whole + k), at(k)))
        .collect();
    let rest: String = (0..left - 1)
        .rev()
        .map(|k| format!(" | ror {}", at(k)))
        .collect();
    let shift = times(&format!("cmp #$80 | ror{rest}"), bits);
    let text = format!(
        "{loads}lda {} | {shift}sta {}",
        byte(from, of - 1),
        at(left - 1)
    );
    add(&text, lines);
    let made = Place::Held("third".to_owned(), Shape::whole(left));
    copy_bytes(&made, to, bytes, lines);
}
