//! Ints of more than two bytes read as reals that are known to fit into two: whole bytes
//! are taken from where they stand, and only what is left of the shift is done bit by bit.

use super::Read;
use crate::write::{Place, byte};

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
        serial: n,
        quick: _,
    } = read;
    let down = by.unsigned_abs();
    if !fits || by >= 0 || down > MOST {
        return false;
    }
    let (first, bits) = (down / 8, down % 8);
    let at = |k: u32| byte(from, (first + k) as u8);
    let mut code = |text: &str| {
        for instruction in text.split('|').map(str::trim).filter(|i| !i.is_empty()) {
            let indent = if instruction.ends_with(':') {
                ""
            } else {
                "        "
            };
            lines.push(format!("{indent}{instruction}"));
        }
    };
    if bits == 0 {
        let below = byte(from, (first - 1) as u8);
        // The sum's upper byte: where it has none of its own, the sign's.
        code(&format!("lda {} | sta {to}", at(0)));
        upper(from, first + 1, &mut code);
        code(&format!("sta {to}+1"));
        code(&format!(
            "lda {below} | bpl read{n} | inc {to} | bne read{n} | inc {to}+1 | read{n}:"
        ));
        return true;
    }
    if bits >= LEFT {
        // By the rest of a byte to the left, and a byte to the right.
        code(&format!("lda {} | sta acc", at(0)));
        upper(from, first + 1, &mut code);
        code(&format!("sta {to}"));
        upper(from, first + 2, &mut code);
        code(&format!("asl acc | rol {to} | rol | ").repeat((8 - bits) as usize));
        code(&format!(
            "sta {to}+1 | asl acc | bcc read{n} | inc {to} | bne read{n} | inc {to}+1 | read{n}:"
        ));
        return true;
    }
    code(&format!("lda {} | sta {to}", at(0)));
    upper(from, first + 1, &mut code);
    code(&format!("sta {to}+1"));
    upper(from, first + 2, &mut code);
    // What is above these bits does not come down.
    let shift = format!("lsr | ror {to}+1 | ror {to} | ").repeat(bits as usize);
    code(&shift);
    code(&format!(
        "bcc read{n} | inc {to} | bne read{n} | inc {to}+1 | read{n}:"
    ));
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
