//! From a column's number to the row in which its wall begins, by binary search among the
//! numbers at which the picture changes, and to its kind.

use super::ram::{HEIGHTS, NEW_MASKS, READ, ROWS};
use crate::backend::mos6502::code::Code;
use crate::backend::mos6502::slots::Slot;
use crate::ir::graph::Axis;
use crate::plan::columns::Columns;
use slowlight_runtime_6502::write;

/// How many steps are told apart by so many comparisons.
fn size(columns: &Columns) -> usize {
    (columns.steps.len() + 1).next_power_of_two()
}

/// Keeps the column that was worked out.
pub(super) fn keep(code: &mut Code<'_>, columns: &Columns, first: u32) {
    let plan = code.plan;
    let tall = code.homes.operand(plan, columns.tall);
    let [lo, hi] = [0, 1].map(|k| write::byte(&tall, k));
    let x = code.homes.name(Slot::Axis(Axis::X)).to_owned();
    code.text.span = plan.drawn;
    code.text.line("        ; how tall the column is");
    code.text.code("ldx #0");
    let mut step = size(columns) / 2;
    while step > 0 {
        let less = step - 1;
        let n = code.text.next_serial();
        let upper = match columns.unsigned {
            true => format!("lda {hi}"),
            false => format!("lda {hi} | eor #$80"),
        };
        let next = match step {
            1 => "inx".to_owned(),
            _ => format!("txa | adc #{less} | tax"),
        };
        code.text.code(&format!(
            "lda {lo} | cmp vcs_steps_low+{less},x | {upper} | sbc vcs_steps_high+{less},x | bcc vcs_lower{n} | {next}"
        ));
        code.text.label(&format!("vcs_lower{n}"));
        step /= 2;
    }
    code.text.code(&format!(
        "lda vcs_begins,x | ldy {x} | sta ${:04x},y",
        HEIGHTS + first as u16
    ));
    if columns.walls().len() < 2 {
        return;
    }
    code.text.line("        ; its kind");
    let mut kinds = columns.kinds.iter().zip(0..);
    if let Some(((id, _, _), _)) = kinds.next() {
        let operand = code.homes.operand(plan, *id);
        code.text.code(&format!("ldx {}", write::byte(&operand, 0)));
        code.text.code("lda vcs_kind_0,x");
    }
    for ((id, _, _), k) in kinds {
        let operand = code.homes.operand(plan, *id);
        code.text.code(&format!(
            "ldx {} | clc | adc vcs_kind_{k},x",
            write::byte(&operand, 0)
        ));
    }
    code.text.code(&format!(
        "tax | lda vcs_whole,x | beq vcs_striped | ldx {x} | ldy vcs_column_byte,x \
         | lda vcs_column_bit,x | \
         ora ${:04x},y | sta ${NEW_MASKS:04x},y",
        NEW_MASKS + READ
    ));
    code.text.label("vcs_striped");
}

/// The tables that this reads, by their labels.
pub(super) fn tables(columns: &Columns, first: u32, full: u8) -> Vec<(String, Vec<u8>)> {
    let size = size(columns);
    let high = |step: &i64| match columns.unsigned {
        true => *step,
        false => step ^ 0x8000,
    };
    let mut low_bytes: Vec<u8> = columns.steps.iter().map(|s| s.to_le_bytes()[0]).collect();
    let mut high_bytes: Vec<u8> = columns
        .steps
        .iter()
        .map(|step| high(step).to_le_bytes()[1])
        .collect();
    low_bytes.resize(size - 1, 0xFF);
    high_bytes.resize(size - 1, 0xFF);
    let begins = |height: &u8| (ROWS - 1) as u8 - height;
    let mut begin: Vec<u8> = columns.heights.iter().map(begins).collect();
    let last = begin.last().copied().unwrap_or(0);
    begin.resize(size, last);
    let mut all = vec![
        ("vcs_steps_low".to_owned(), low_bytes),
        ("vcs_steps_high".to_owned(), high_bytes),
        ("vcs_begins".to_owned(), begin),
    ];
    let mut stride = 1;
    for ((_, lo, hi), k) in columns.kinds.iter().zip(0..) {
        // What is below 0 is read from the table's end.
        let entry = |value: i64| ((value - lo).clamp(0, hi - lo) * stride) as u8;
        let table = match lo {
            0.. => (0..=*hi).map(entry).collect(),
            _ => (0..256).map(|v| entry(i64::from(v as u8 as i8))).collect(),
        };
        all.push((format!("vcs_kind_{k}"), table));
        stride *= hi - lo + 1;
    }
    let whole = columns.inks.iter().map(|ink| u8::from(*ink == full));
    all.push(("vcs_whole".to_owned(), whole.collect()));
    let at = |x: u32| byte_and_bit(x + first);
    let columns = 0..32 - first;
    all.push((
        "vcs_column_byte".to_owned(),
        columns.clone().map(|x| at(x).0).collect(),
    ));
    all.push((
        "vcs_column_bit".to_owned(),
        columns.map(|x| at(x).1).collect(),
    ));
    all
}

/// Which of a line's four bytes of playfield has a column, and which bit of it.
pub(super) fn byte_and_bit(column: u32) -> (u8, u8) {
    let (byte, k) = ((column / 8) as u8, column % 8);
    // The second goes the other way round, and the right half is the left one reflected.
    let forwards = matches!(byte, 1 | 3);
    (byte, if forwards { 1 << k } else { 0x80 >> k })
}
