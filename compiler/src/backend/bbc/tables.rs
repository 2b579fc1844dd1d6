//! Tables: arrays that are filled at the start, from DATA or from one another.
//!
//! Tables of one size are filled together, cell by cell: a cell's number, which
//! several tables are images of, is read once, then the tables that are read as
//! they are, then the others are worked out ([`Recipe`]).

use super::code::Code;
use super::strings;
use crate::ir::graph::{Table, TableId};
use crate::plan::Plan;
use crate::plan::table_init::{From, Function, Recipe};
use slowlight_routine::{Type, Value};
use slowlight_runtime_bbc::literal;

/// How many arrays one DIM makes.
const ARRAYS: usize = 6;

/// Tables that are filled in one loop.
pub(super) struct Group<'p> {
    /// Columns and rows.
    pub size: (u32, u32),
    /// The cells' numbers, if any table is worked out from them.
    pub seed: &'p [i32],
    pub tables: Vec<(TableId, &'p Table)>,
}

/// The tables by their size and seeds, in the order of the plan's.
pub(super) fn groups(plan: &Plan) -> Vec<Group<'_>> {
    let mut groups: Vec<Group<'_>> = Vec::new();
    for (k, table) in plan.graph.tables.iter().enumerate() {
        if strings::string(plan, TableId(k as u32)).is_some() {
            continue;
        }
        let (id, size) = (TableId(k as u32), (table.width, table.height));
        let recipe = plan.table(id).and_then(|made| made.recipe);
        let is_image = recipe.is_some_and(|recipe| recipe.from != From::Index);
        let seed: &[i32] = if is_image { &table.seed } else { &[] };
        let fits = |g: &&mut Group<'_>| {
            g.size == size && (seed.is_empty() || g.seed.is_empty() || g.seed == seed)
        };
        match groups.iter_mut().find(fits) {
            Some(group) => {
                group.tables.push((id, table));
                group.seed = if seed.is_empty() { group.seed } else { seed };
            }
            None => groups.push(Group {
                size,
                seed,
                tables: vec![(id, table)],
            }),
        }
    }
    groups
}

fn recipe(plan: &Plan, id: TableId) -> Option<Recipe> {
    plan.table(id).and_then(|made| made.recipe)
}

/// Makes all arrays.
pub fn make(plan: &Plan, code: &mut Code<'_>) {
    for group in groups(plan) {
        let (w, h) = (group.size.0 - 1, group.size.1 - 1);
        // The element, the bounds, and the loops around filling it.
        let (index, bounds, loops, ends) = match (w, h) {
            (_, 0) => ("X%", format!("{w}"), format!("FOR X%=0 TO {w}"), "NEXT"),
            (0, _) => ("Y%", format!("{h}"), format!("FOR Y%=0 TO {h}"), "NEXT"),
            _ => (
                "X%,Y%",
                format!("{w},{h}"),
                format!("FOR Y%=0 TO {h}:FOR X%=0 TO {w}"),
                "NEXT:NEXT",
            ),
        };
        let name = |code: &Code<'_>, id: TableId| {
            let name = code.values.names.tables.get(id.0 as usize);
            name.cloned().unwrap_or_default()
        };
        let names = group.tables.iter().map(|(id, _)| name(code, *id));
        let arrays: Vec<String> = names.map(|name| format!("{name}({bounds})")).collect();
        for some in arrays.chunks(match plan.listing {
            true => 1,
            false => ARRAYS,
        }) {
            code.statement(format!("DIM {}", some.join(",")));
        }
        let made = |id: &TableId| recipe(plan, *id);
        let seeded = !group.seed.is_empty();
        let cell = seeded.then(|| code.values.names.unique("cell", ""));
        let entry = seeded.then(|| code.values.names.unique("entry", ""));
        let element = |code: &Code<'_>, id: TableId| format!("{}({index})", name(code, id));
        code.statement(loops);
        let plain = group.tables.iter().filter(|(id, _)| made(id).is_none());
        let read: Vec<String> = (cell.iter().cloned())
            .chain(plain.clone().map(|(id, _)| element(code, *id)))
            .collect();
        if !read.is_empty() {
            code.statement(format!("READ {}", read.join(",")));
        }
        for (id, table) in plain {
            let element = element(code, *id);
            match scale(plan, table) {
                1 => {}
                scale => code.statement(format!("{element}={element}/{scale}")),
            }
        }
        let cooked: Vec<(TableId, &Table, Recipe)> = (group.tables.iter())
            .filter_map(|(id, table)| Some((*id, *table, made(id)?)))
            .collect();
        let mut kept = None;
        for (id, table, recipe) in in_order(&cooked) {
            let from = match recipe.from {
                From::Seed => cell.clone().unwrap_or_default(),
                From::Table(of) => element(code, of),
                From::Index => index.to_owned(),
            };
            let element = element(code, id);
            let pot = Pot {
                from: &from,
                entry: entry.as_deref().unwrap_or_default(),
                kept,
            };
            kept = pot.cook(code, recipe, table, &element);
        }
        code.statement(ends);
    }
}

/// What is made in the order in which a square that two tables are made of is had once:
/// the one that is nothing else, then that to which something is added.
fn in_order<'t>(all: &[(TableId, &'t Table, Recipe)]) -> Vec<(TableId, &'t Table, Recipe)> {
    let mut rest = all.to_vec();
    let mut order = Vec::new();
    while !rest.is_empty() {
        let next = rest.remove(0);
        order.push(next);
        let more = |other: &Recipe| other.more.is_some_and(|more| more != 0.0);
        let found = (next.2.more == Some(0.0)).then(|| {
            (rest.iter()).position(|(.., of)| square_of(of) == square_of(&next.2) && more(of))
        });
        if let Some(at) = found.flatten() {
            order.push(rest.remove(at));
        }
    }
    order
}

/// What a recipe squares first, if anything.
fn square_of(recipe: &Recipe) -> Option<(From, [u64; 2])> {
    recipe.more?;
    Some((
        recipe.from,
        [recipe.moved.to_bits(), recipe.scale.to_bits()],
    ))
}

/// Where elements are worked out.
struct Pot<'t> {
    from: &'t str,
    /// A variable for what is not done yet.
    entry: &'t str,
    /// Of what the square is in that variable.
    kept: Option<(From, [u64; 2])>,
}

impl Pot<'_> {
    /// Works out an element; answers whose square is left.
    fn cook(
        &self,
        code: &mut Code<'_>,
        recipe: Recipe,
        table: &Table,
        element: &str,
    ) -> Option<(From, [u64; 2])> {
        let Pot { from, entry, .. } = *self;
        let mut text = self.line(recipe);
        if let Some(of) = recipe.function {
            text = function(of, &text);
        }
        let mut left = None;
        let simple = |text: &str| text == from || text == entry;
        let signs = table.entries.iter().any(|e| e.value().real() < 0.0);
        if let Some(more) = recipe.more {
            if self.kept.is_some() && self.kept == square_of(&recipe) {
                text = entry.to_owned();
            } else {
                if !simple(&text) {
                    code.statement(format!("{entry}={text}"));
                } else if text != entry {
                    code.statement(format!("{entry}={from}"));
                }
                text = format!("{entry}*ABS({entry})");
            }
            if more == 0.0 {
                left = square_of(&recipe);
            }
            text.push_str(&term(more));
        }
        if !recipe.squared {
            code.statement(format!("{element}={text}"));
            return None;
        }
        let text = match simple(&text) {
            true => text,
            false => {
                code.statement(format!("{entry}={text}"));
                entry.to_owned()
            }
        };
        code.statement(match signs {
            true => format!("{element}={text}*ABS({text})"),
            false => format!("{element}={text}*{text}"),
        });
        left
    }

    /// The line in a cell's number that a recipe begins with.
    fn line(&self, recipe: Recipe) -> String {
        let text = format!("{}{}", self.from, term(recipe.moved));
        if recipe.scale == 1.0 {
            return text;
        }
        let scale = literal(recipe.scale);
        match recipe.moved != 0.0 {
            true => format!("({text})*{scale}"),
            false => format!("{text}*{scale}"),
        }
    }
}

/// A function of an expression; only sines are made so.
fn function(Function { times, .. }: Function, of: &str) -> String {
    match times {
        1.0 => format!("SIN({of})"),
        times => format!("SIN({of})*{}", literal(times)),
    }
}

/// A number that is added to what stands before it.
fn term(more: f64) -> String {
    let text = literal(more);
    match more != 0.0 {
        true if text.starts_with('-') => text,
        true => format!("+{text}"),
        false => String::new(),
    }
}

/// By what a table's entries are multiplied in DATA: where memory is short,
/// fractions of a power of two are written as whole numbers, which are shorter
/// and, divided again, the same bits.
fn scale(plan: &Plan, table: &Table) -> u32 {
    if !plan.tight && !plan.toot || table.ty != Type::Real {
        return 1;
    }
    let whole = |scale: &u32| {
        let mut entries = table.entries.iter().map(|e| e.value().real());
        entries.all(|x| {
            let scaled = x * f64::from(*scale);
            scaled.fract() == 0.0 && scaled.abs() < 1e6
        })
    };
    (0..=16).map(|k| 1 << k).find(whole).unwrap_or(1)
}

/// What the arrays are read from.
pub fn data(plan: &Plan, code: &mut Code<'_>) {
    let width = if plan.tight || plan.toot { 200 } else { 60 };
    for group in groups(plan) {
        let cells = (group.size.0 * group.size.1) as usize;
        let read = |(id, _): &&(TableId, &Table)| recipe(plan, *id).is_none();
        let mut line = String::new();
        for at in 0..cells {
            let seed = group.seed.get(at).map(|n| n.to_string());
            let plain = group.tables.iter().filter(read).filter_map(|(_, table)| {
                let scale = f64::from(scale(plan, table));
                Some(match table.entries.get(at)?.value() {
                    Value::Real(x) => literal(x * scale),
                    Value::Int(n) => n.to_string(),
                    Value::Bool(b) => (-i32::from(b)).to_string(),
                })
            });
            for text in seed.into_iter().chain(plain) {
                if line.len() + text.len() > width {
                    code.line(std::mem::take(&mut line));
                }
                line.push_str(if line.is_empty() { "DATA " } else { "," });
                line.push_str(&text);
            }
        }
        if !line.is_empty() {
            code.line(line);
        }
    }
}
