//! Reading a number at another scale, and its whole part.

use crate::write::{Place, Shape, byte, copy_bytes};

/// A number to be read.
#[derive(Clone, Copy, Debug)]
pub struct Read<'a> {
    /// Where it is.
    pub from: &'a Place,
    /// So many fraction bits more.
    pub by: i32,
    /// Whether it is known not to leave 16 bits then.
    pub fits: bool,
    /// Where it goes.
    pub to: &'a str,
    /// Must differ at each use in a program.
    pub serial: u32,
    /// Whether memory may be spent for speed.
    pub quick: bool,
}

/// Writes the reading; answers the part of the runtime that it needs, if any.
pub fn read(read: Read<'_>, lines: &mut Vec<String>) -> Option<&'static str> {
    let Read {
        from,
        by,
        fits,
        to,
        serial,
        quick,
    } = read;
    let wide = matches!(from, Place::Held(_, shape) if shape.bytes > 2 || shape.bytes == 2 && !shape.signed && !shape.spare);
    // Where it fits, its lower bytes are all of it.
    if wide && (by < 0 || !fits) {
        if super::wide::read(read, lines) {
            return None;
        }
        // An int of more bytes.
        let way = if by < 0 { "right" } else { "left" };
        copy_bytes(from, "acc", 4, lines);
        let mut code = |text: String| lines.push(format!("        {text}"));
        code(format!("ldy #{}", by.unsigned_abs().min(40)));
        code(format!("jsr narrow_{way}"));
        code(format!("sta {to}"));
        code(format!("stx {to}+1"));
        return Some("narrow");
    }
    let narrow = matches!(from, Place::Held(_, shape) if shape.bytes < 2 && shape.signed);
    let extended = Place::Held(to.to_owned(), Shape::whole(2));
    let from = match narrow {
        true => {
            copy_bytes(from, to, 2, lines);
            &extended
        }
        false => from,
    };
    let mut code = |text: String| {
        for instruction in text.split('|').map(str::trim) {
            let indent = if instruction.ends_with(':') {
                ""
            } else {
                "        "
            };
            lines.push(format!("{indent}{instruction}"));
        }
    };
    let same = matches!(from, Place::At(name) | Place::Held(name, _) if name == to);
    let (low, high) = (byte(from, 0), byte(from, 1));
    let n = serial;
    let times = |text: &str, k: i32| format!("{text} | ").repeat(k.max(0) as usize);
    match by {
        8.. if fits => code(format!(
            "lda {low} | {}sta {to}+1 | lda #0 | sta {to}",
            times("asl", (by - 8).min(8))
        )),
        0.. if fits => code(format!(
            "lda {low} | sta {to} | lda {high} | {}sta {to}+1",
            times(&format!("asl {to} | rol"), by)
        )),
        // What leaves 16 bits has another sign then.
        1 if !narrow && !same => code(format!(
            "lda {low} | asl | sta {to} | lda {high} | rol | sta {to}+1 | eor {high} | bpl fits{n}
            | lda {high} | asl | lda #$7f | adc #0 | sta {to}+1 | eor #$80 | ora #1 | sta {to} | bne read{n}
            | fits{n}: | lda {to}+1 | cmp #$80 | bne read{n} | lda {to} | bne read{n} | inc {to} | read{n}:"
        )),
        // What the bits that are lost say must be the sign.
        2..8 if quick => code(format!(
            "lda {high} | clc | adc #{} | cmp #{} | bcs large{n}
            | lda {low} | sta {to} | lda {high} | {}sta {to}+1
            | cmp #$80 | bne read{n} | lda {to} | bne read{n} | inc {to} | bne read{n}
            | large{n}: | lda {high} | asl | lda #$7f | adc #0 | sta {to}+1 | eor #$80 | ora #1 | sta {to} | read{n}:",
            0x80 >> by,
            0x100 >> by,
            times(&format!("asl {to} | rol"), by)
        )),
        0.. => {
            code(format!(
                "lda {low} | ldx {high} | ldy #{} | jsr left16 | sta {to} | stx {to}+1",
                by.min(40)
            ));
            return Some("narrow");
        }
        -7..0 => code(format!(
            "lda {low} | sta {to} | lda {high} | {}bcc read{n} | inc {to} | bne read{n} | adc #0 | read{n}: | sta {to}+1",
            times(&format!("cmp #$80 | ror | ror {to}"), -by)
        )),
        -8 => code(format!(
            "ldx #0 | lda {low} | asl | lda {high} | bpl read{n} | dex | read{n}: | adc #0 | sta {to} | bne above{n} | ldx #0 | above{n}: | stx {to}+1"
        )),
        -15..-8 => code(format!(
            "ldx #0 | lda {high} | {}adc #0 | sta {to} | bpl read{n} | dex | read{n}: | stx {to}+1",
            times("cmp #$80 | ror", -by - 8)
        )),
        // Less than half of the last place.
        _ => code(format!("lda #0 | sta {to} | sta {to}+1")),
    }
    None
}

/// The greatest whole number not above one with so many fraction bits, up to 14, in so many
/// bytes.
pub fn floor(from: &Place, bits: i32, to: &str, bytes: u8, lines: &mut Vec<String>) {
    let (low, high) = (byte(from, 0), byte(from, 1));
    let mut code = |text: String| {
        for instruction in text.split('|').map(str::trim).filter(|i| !i.is_empty()) {
            lines.push(format!("        {instruction}"));
        }
    };
    let times = |text: &str, k: i32| format!("{text} | ").repeat(k.max(0) as usize);
    let shape = |bytes| Shape {
        bytes,
        ..Shape::whole(bytes)
    };
    match bits {
        8.. => {
            code(format!(
                "lda {high} | {}sta third",
                times("cmp #$80 | ror", bits - 8)
            ));
            copy_bytes(&Place::Held("third".to_owned(), shape(1)), to, bytes, lines);
        }
        _ => {
            code(format!(
                "lda {low} | sta third | lda {high} | {}sta third+1",
                times("cmp #$80 | ror | ror third", bits)
            ));
            copy_bytes(&Place::Held("third".to_owned(), shape(2)), to, bytes, lines);
        }
    }
}
