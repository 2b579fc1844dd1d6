//! Products of bytes written in place: the bits of `product8` (`asm/scaled8/product.asm`), with
//! nothing asked of signs that are known. A constant needs no pointers.

use super::inline::{Inline, put};
use super::templates_byte as t;
use crate::write::{Place, byte};

/// How many bits a product is longer than its result, of texts that can be written in place.
pub fn bits(text: &str, number: i32) -> Option<i32> {
    let all = [
        (t::MULTIPLY_8, 8),
        (t::MULTIPLY_7, 7),
        (t::MULTIPLY_6, 6),
        (t::MULTIPLY_5, 5),
        (t::MULTIPLY_4, 4),
        (t::MULTIPLY_RIGHT, number),
    ];
    let found = all.into_iter().find(|(known, _)| *known == text);
    found.map(|(_, bits)| bits)
}

/// Writes a product that is so many bits longer than its result; whether the pointers into the
/// quarter squares are for one of its factors then.
pub fn product(bits: i32, used: Inline<'_>, lines: &mut Vec<String>) -> bool {
    let constant = |place: &Place| matches!(place, Place::Constant(_));
    let first = usize::from(!constant(used.args[0]) && constant(used.args[1]));
    let (a, b) = (used.args[first], used.args[1 - first]);
    let positive = [used.positive[first], used.positive[1 - first]];
    let (n, to) = (used.serial, used.to);
    let [of_a, of_b] = [a, b].map(|place| byte(place, 0));
    let times = |half: &str| match a {
        Place::Constant(bits) => {
            let at = bits & 255;
            format!("lda sqr_{half}+{at},y | sbc sqd_{half}+{},y", 255 - at)
        }
        _ => format!("lda (sum_{half}),y | sbc (dif_{half}),y"),
    };
    if !constant(a) {
        let point = "sta sum_lo | sta sum_hi | eor #$ff | sta dif_lo | sta dif_hi";
        put(&format!("lda {of_a} | {point}"), lines);
    }
    put(
        &format!(
            "ldy {of_b} | sec | {} | sta prod | {}",
            times("lo"),
            times("hi")
        ),
        lines,
    );
    // Nothing is borrowed from a whole product, so the carry is set.
    if !positive[1] {
        put(
            &format!("cpy #$80 | bcc plusb{n} | sbc {of_a} | plusb{n}:"),
            lines,
        );
    }
    match a {
        _ if positive[0] => {}
        Place::Constant(bits) if bits & 128 == 0 => {}
        Place::Constant(_) => put(&format!("sec | sbc {of_b}"), lines),
        _ => put(
            &format!("ldx {of_a} | bpl plusa{n} | sec | sbc {of_b} | plusa{n}:"),
            lines,
        ),
    }
    let shifted = match bits {
        ..=8 => "asl prod | rol | ".repeat((8 - bits) as usize) + "asl prod | adc #0",
        _ => "cmp #$80 | ror | ".repeat((bits - 8) as usize) + "adc #0",
    };
    put(&format!("{shifted} | sta {to}"), lines);
    !constant(a)
}
