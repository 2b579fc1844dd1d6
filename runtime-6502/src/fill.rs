//! Fills in the templates that routines are written as.

use crate::write::*;
use slowlight_routine::Format;
use slowlight_routine::scale::Scales;

/// Where operands go that have to be extended, and a result of which a part is kept.
const EXTENDED: [&str; 2] = ["first", "second"];
const CUT: &str = "third";

/// Fills in a template's places.
pub(crate) fn template(text: &str, used: Use<'_>, bytes: u8, lines: &mut Vec<String>) {
    let of_args = full_of(used.routine);
    let shapes = || used.args.iter().map(|a| a.shape(of_args));
    let is_bool = used.routine.result == Format::Bool;
    let whole = if is_bool {
        of_args
    } else {
        size(used.routine.result)
    };
    let as_short_as_operands = text.starts_with('=');
    let (text, width) = match (text.get(..1), text.get(1..)) {
        (Some("~"), Some(rest)) => (rest, bytes),
        (Some("="), Some(rest)) => {
            let needed = shapes().map(Shape::needed).max().unwrap_or(1);
            let needed = if is_bool { needed } else { needed.max(bytes) };
            (rest, needed.min(whole))
        }
        _ => (text, whole),
    };
    // Bytes that are named have to be there.
    let named = |k: u8| text.contains(&format!("{{0.{k}}}"));
    let read = (0..of_args).rev().find(|k| named(*k)).map_or(0, |k| k + 1);
    let read = width.max(read).min(of_args);
    let extended: Vec<Place> = (used.args.iter().zip(shapes()).zip(EXTENDED))
        .map(|((place, shape), to)| match place {
            Place::Held(..) if shape.signed && shape.bytes < read => {
                copy_bytes(place, to, read, lines);
                Place::At(to.to_owned())
            }
            _ => place.clone(),
        })
        .collect();
    // A logarithm is written without its sign where that is known.
    let of_logs = matches!(used.routine.result, Format::Log { .. });
    let part = !is_bool && !of_logs && bytes < width;
    let cut = Goal::At(CUT);
    let inner = Use {
        args: &extended,
        goal: if part { &cut } else { used.goal },
        ..used
    };
    let text = &match of_logs {
        true => with_sign(text, bytes == width),
        false => text.to_owned(),
    };
    // A comparison of one byte leaves the overflow flag alone, that of more ends in a subtraction.
    let repeated = match as_short_as_operands && width == 1 && text.contains("bv") {
        true => repeated(&text.replace("| cmp ", "| sec | sbc "), width),
        false => repeated(text, width),
    };
    let instructions = repeated
        .split(['|', '\n'])
        .map(str::trim)
        .filter(|i| !i.is_empty());
    for line in instructions {
        let mut filled = String::new();
        let mut rest = line;
        while let Some((before, behind)) = rest.split_once('{') {
            let (inside, after) = behind.split_once('}').unwrap_or((behind, ""));
            filled.push_str(before);
            filled.push_str(&placeholder(inside, inner));
            rest = after;
        }
        filled.push_str(rest);
        if of_logs && folded(&filled, lines) {
            continue;
        }
        let indent = if filled.ends_with(':') {
            ""
        } else {
            "        "
        };
        lines.push(format!("{indent}{filled}"));
    }
    if let (true, Goal::Held(to, _)) = (part, used.goal) {
        copy_bytes(&Place::At(CUT.to_owned()), to, bytes, lines);
    }
}

/// A template with what gives its result a sign, or without.
fn with_sign(text: &str, signed: bool) -> String {
    let mut made = String::new();
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once("[s") {
        let (inside, after) = behind.split_once(']').unwrap_or((behind, ""));
        made.push_str(before);
        made.push('|');
        made.push_str(if signed { inside } else { "" });
        made.push('|');
        rest = after;
    }
    made + rest
}

/// Whether an instruction does nothing, or does what the last one becomes instead: signs that
/// are known are constants.
fn folded(instruction: &str, lines: &mut [String]) -> bool {
    let Some(operand) = instruction.strip_prefix("eor ") else {
        return false;
    };
    match lines.last_mut() {
        Some(last) if last == "        lda #$00" => *last = format!("        lda {operand}"),
        _ => return operand == "#$00",
    }
    true
}

/// A template whose parts in brackets stand there once a byte.
fn repeated(text: &str, width: u8) -> String {
    let mut made = String::new();
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once('[') {
        let (inside, after) = behind.split_once(']').unwrap_or((behind, ""));
        made.push_str(before);
        let kinds = ['+', '-', '1'].map(|kind| inside.strip_prefix(kind));
        let (inside, bytes) = match kinds {
            [Some(inside), ..] => (inside, 1..width),
            [_, Some(inside), _] => (inside, 0..width.saturating_sub(1)),
            [.., Some(inside)] => (inside, 1..width.min(2)),
            _ => (inside, 0..width),
        };
        for k in bytes {
            made.push('|');
            made.push_str(&inside.replace(".k}", &format!(".{k}}}")));
        }
        made.push('|');
        rest = after;
    }
    made.push_str(rest);
    made.replace(".h}", &format!(".{}}}", width.saturating_sub(1)))
}

fn placeholder(inside: &str, used: Use<'_>) -> String {
    if inside == "%" {
        let bits = i32::from(size(used.routine.result)) * 8;
        return format!(
            "#{}",
            shift_of_one(used.args.first(), used.number, bits) & 0xFF
        );
    }
    if let Some(formula) = inside.strip_prefix('#') {
        return format!("#{}", number(formula, used.number) & 0xFF);
    }
    let Some((which, k)) = inside.split_once('.') else {
        return used.serial.to_string();
    };
    let k = k.parse().unwrap_or(0);
    match (which.parse::<usize>(), used.goal) {
        (Ok(arg), _) => used
            .args
            .get(arg)
            .map_or_else(String::new, |place| byte(place, k)),
        (Err(_), _) if which != "r" => byte_at(which, k),
        (Err(_), Goal::At(to) | Goal::Held(to, _)) => byte_at(to, k),
        (Err(_), Goal::Carry) => String::new(),
    }
}

/// What a formula of the number comes to: a sum of numbers and of n, a, b and r, the
/// scales of operands and result.
fn number(formula: &str, n: i32) -> i32 {
    let scales = Scales::unpacked(n);
    let [a, b] = scales.args.map(i32::from);
    let (whole, halved) = match formula.strip_suffix("/2") {
        Some(whole) => (whole, true),
        None => (formula, false),
    };
    let spaced = whole.replace('-', " -").replace('+', " ");
    let terms = spaced.split_whitespace().map(|term| {
        let (sign, name) = match term.strip_prefix('-') {
            Some(name) => (-1, name),
            None => (1, term),
        };
        sign * match name {
            "n" => n,
            "a" => a,
            "b" => b,
            "r" => i32::from(scales.result),
            number => number.parse().unwrap_or(0),
        }
    });
    let sum: i32 = terms.sum();
    if halved { sum / 2 } else { sum }
}
