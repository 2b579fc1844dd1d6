//! Code generation for size: a program in as few characters as it goes, in the form of a post.
//!
//! The BBC Micro Bot runs the program of a post: a line of the post is a line of the program,
//! numbered in tens where it has no number, and each character is the byte that its number is
//! modulo 256. So a keyword's token is one character, and ends any name before it: no spaces
//! are wanted, and a GOTO takes its number as a plain expression. Whole numbers live in real
//! variables, which saves the `%`.
//!
//! - `shared`: numbers that are met often; `encode`: characters; `post`: lines.
//!
//! The rest of the program is what other styles have ([`super::frame`]), with jumps shortened
//! in each of several ways, of which the shortest is taken.

mod encode;
mod post;
mod shared;

use super::super::Document;
use super::code::Code;
use super::frame::{self, called, functions, procedures};
use super::lines::{Labels, Lines};
use super::spread::Spread;
use super::terse::terse;
use super::thread::threaded;
use super::{dead, screen, strings, tables, ways};
use crate::plan::{Copies, Plan};
use std::collections::BTreeSet;

/// How often ways are split at most.
const ROUNDS: usize = 2;

/// Writes a plan as a post.
pub fn emit(plan: &Plan) -> Vec<Document> {
    let mut code = Code::new(plan);
    let spread = Spread::new(plan, &mut code);
    let rows = [plan.rows.0, plan.rows.1].map(|row| row.to_string());
    frame::picture(plan, &mut code, &rows[0], &rows[1], spread.as_ref());
    code.lines.weight = frame::PIXEL;
    procedures(plan, &mut code);
    let rare = std::mem::take(&mut code.rare);
    code.lines.append(rare);
    let parts = called(plan, &code);
    functions(&mut code, &parts);
    tables::data(plan, &mut code);
    let body = std::mem::take(&mut code.lines);
    tables::make(plan, &mut code);
    let mut lines = std::mem::take(&mut code.lines).followed_by(body);
    let row = screen::y_expression(plan);
    lines.each_text(|text| *text = text.replace("R%", &row));
    let flags = code.values.names.flags(plan);
    let strings = strings::texts(plan);
    let all = shortened(&lines, &code.labels);
    let all = all.into_iter().map(|lines| {
        let lines = prepared(lines, &flags);
        post::posted(&lines, &strings)
    });
    let shortest = all.min_by_key(|(text, _)| text.chars().count());
    let (text, lines) = shortest.unwrap_or_default();
    vec![Document {
        name: format!("{}.toot.txt", plan.name),
        text,
        lines,
        later: Vec::new(),
    }]
}

/// The same lines with their jumps shortened in each of several ways.
fn shortened(lines: &Lines, labels: &Labels) -> Vec<Lines> {
    let mut all = Vec::new();
    for longer in [false, true] {
        for copies in [Copies::None, Copies::Tests] {
            let mut labels = labels.clone();
            let mut now = dead::without(threaded(lines.clone(), &mut labels, longer));
            all.push(now.clone());
            for _ in 0..ROUNDS {
                now = dead::without(ways::split(now, &mut labels, copies));
                all.push(now.clone());
            }
        }
    }
    all
}

/// Statements made short one by one, numbers that are met often in variables.
fn prepared(mut lines: Lines, flags: &BTreeSet<String>) -> Lines {
    lines.remove_empty();
    lines.each_text(|text| *text = terse(text, flags, true));
    shared::shared(lines)
}
