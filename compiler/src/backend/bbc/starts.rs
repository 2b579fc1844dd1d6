//! What BASIC programs take before they begin the scene, in cycles: params are looked at,
//! tables read or worked out, constants kept, and the screen opened. BASIC makes a number of
//! its digits whenever it meets them, so a text's length counts.

use super::super::starts::{constants, usual};
use super::is_first;
use super::screen;
use super::tables::groups;
use crate::plan::Plan;
use crate::plan::table_init::{From, Recipe};
use slowlight_routine::{Op, Overhead, Value};
use slowlight_runtime_bbc::literal;

/// `NEXT` after an entry; an array's element, beside its subscripts; each subscript more.
const NEXT: u64 = 400;
const ELEMENT: u64 = 830;
const DIMENSION: u64 = 650;
/// A `DIM`, and each entry of what it clears.
const DIM: u64 = 700;
const CLEARED: u64 = 90;
/// A statement that keeps a number or reads one, beside the number.
const KEEP: u64 = 1_000;
/// `MODE` and the cursor; each ink's colour.
const OPEN: u64 = 15_000;
const COLOUR: u64 = 1_700;
/// What is compared with its range, beside the digits of that.
const LOOK: u64 = 5_500;
/// A part that is carried out at the start: one limit of reals, mostly, since what nothing
/// uses is left out.
const FIRST: u64 = 15_000;

/// What a plan's program takes.
pub(in crate::backend) fn starts(plan: &Plan) -> u64 {
    let parts = plan.parts();
    let first = parts.iter().filter(|part| is_first(part)).count() as u64;
    let params = plan.params.iter().map(|param| {
        let range = param.range.iter().flat_map(|(least, most)| [least, most]);
        let ends: u64 = range.map(|text| digits(text)).sum();
        let looked = if ends > 0 { LOOK } else { 0 };
        KEEP + digits(&param.text) + looked + ends
    });
    let params: u64 = params.sum();
    let kept = constants(plan).into_iter().map(literal);
    // One digit is as quick as a variable.
    let kept = kept.filter(|text| text.len() > 1);
    let kept: u64 = kept.map(|text| KEEP + digits(&text)).sum();
    let palette = &plan.graph.image.palette;
    let told = |(ink, rgb): (usize, &[u8; 3])| screen::colour(plan, ink, *rgb).is_some();
    let screen = match plan.plot {
        true => OPEN + COLOUR * palette.iter().enumerate().filter(|ink| told(*ink)).count() as u64,
        false => 0,
    };
    // The rows are looked at together.
    first * FIRST + params + LOOK + kept + screen + filling(plan)
}

/// Reading tables, and working them out.
fn filling(plan: &Plan) -> u64 {
    let Overhead { read, write, .. } = plan.runtime.overhead;
    let [read_int, read] = read.map(u64::from);
    let groups = groups(plan);
    let each = groups.iter().map(|group| {
        let (width, height) = group.size;
        let cells = u64::from(width) * u64::from(height);
        let element = match width > 1 && height > 1 {
            true => ELEMENT + DIMENSION + 2 * read_int,
            false => ELEMENT + read_int,
        };
        let mut seeded = false;
        let tables = group.tables.iter().map(|(id, table)| {
            if let Some(recipe) = plan.table(*id).and_then(|made| made.recipe) {
                seeded |= recipe.from != From::Index;
                return DIM + cells * (CLEARED + element + worked_out(plan, recipe, read));
            }
            let texts = table.entries.iter().map(|entry| match entry.value() {
                Value::Real(x) => literal(x),
                Value::Int(n) => n.to_string(),
                Value::Bool(b) => (-i32::from(b)).to_string(),
            });
            let read: u64 = texts.map(|text| digits(&text)).sum();
            read + DIM + cells * (CLEARED + element + u64::from(write[1]))
        });
        let tables: u64 = tables.sum();
        let seeds = group.seed.iter().map(|n| KEEP + digits(&n.to_string()));
        let seeds: u64 = if seeded { seeds.sum() } else { 0 };
        tables + seeds + cells * NEXT
    });
    each.sum()
}

/// An entry by a recipe, beside the element that it goes to.
fn worked_out(plan: &Plan, recipe: Recipe, read: u64) -> u64 {
    let [add, mul] = [Op::Add, Op::Mul].map(|op| usual(plan, op));
    let with = |x: f64, op: u64| op + digits(&literal(x));
    let mut cycles = KEEP + read;
    if recipe.moved != 0.0 {
        cycles += with(recipe.moved, add);
    }
    if recipe.scale != 1.0 {
        cycles += with(recipe.scale, mul);
    }
    if let Some(function) = recipe.function {
        cycles += usual(plan, function.op);
        if function.times != 1.0 {
            cycles += with(function.times, mul);
        }
    }
    if let Some(more) = recipe.more {
        cycles += KEEP + 2 * read + mul;
        if more != 0.0 {
            cycles += with(more, add);
        }
    }
    if recipe.squared {
        cycles += KEEP + 2 * read + mul;
    }
    cycles
}

/// Cycles to make a number of its text: each place behind the point and each power of ten is
/// a multiplication or division.
fn digits(text: &str) -> u64 {
    let text = text.trim_start_matches('-');
    let (number, power) = text.split_once('E').unwrap_or((text, "0"));
    let power: i64 = power.parse().unwrap_or(0);
    let Some((whole, places)) = number.split_once('.') else {
        return match power {
            0 => 108 + 200 * number.len() as u64,
            _ => 925 + 700 * power.unsigned_abs(),
        };
    };
    let power = power - places.len() as i64;
    let step = if power < 0 { 850 } else { 220 };
    925 + 21 * whole.len() as u64 + step * power.unsigned_abs()
}
