//! Tables that a program works out at its start.
//!
//! The tables of a dither's thresholds are images of its cells: for each ink a
//! line in the cell, squared perhaps, and what algebra compares with may be a
//! square of that again. A program that has the cells makes such tables from
//! them, element by element, with a sum, a product and a square each; decimals
//! for every entry would take several times as much memory.
//!
//! The entries are then what the machine's own operations give, which differs
//! from the nearest numbers in the last places: by 2^-22 of an entry at most, or
//! the table is not made so. The model has the same bits ([`Made::bits`]).

use crate::flow::graph::*;
use crate::range::ENTRIES;
use slowlight_routine::{Bits, Op, Runtime, Type, Value};

/// What an entry is worked out from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum From {
    /// The cell's number ([`Table::seed`]).
    Seed,
    /// The entry at the same place of another table.
    Table(TableId),
}

/// How an entry is worked out: (from + moved) * scale, which is squared with its
/// sign if `squared`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recipe {
    /// From what.
    pub from: From,
    /// What is added.
    pub moved: f64,
    /// By what the sum is multiplied.
    pub scale: f64,
    /// Whether the product is squared.
    pub squared: bool,
}

/// A table as the program has it.
#[derive(Clone, Debug, Default)]
pub struct Made {
    /// How it is worked out; read as it is if `None`.
    pub recipe: Option<Recipe>,
    /// The entries' bits.
    pub bits: Vec<Bits>,
}

/// How each table of a graph comes about on a machine.
pub fn made(graph: &Graph, runtime: &Runtime) -> Vec<Made> {
    let site = Site { graph, runtime };
    let mut all: Vec<Made> = Vec::new();
    for table in &graph.tables {
        let next = site.made(table, &all);
        all.push(next);
    }
    all
}

struct Site<'g> {
    graph: &'g Graph,
    runtime: &'g Runtime,
}

impl Site<'_> {
    fn made(&self, table: &Table, before: &[Made]) -> Made {
        let derives = self.runtime.derives && table.ty == Type::Real;
        let same = |other: &&Table| {
            (other.width, other.height, &other.seed) == (table.width, table.height, &table.seed)
        };
        if derives && !table.seed.is_empty() {
            let seed: Vec<Bits> = (table.seed.iter())
                .map(|n| self.bits(Value::Real(f64::from(*n))))
                .collect();
            // Rather from the cells than from a table, rather a line than a square.
            let tables = (self.graph.tables.iter().zip(before).enumerate())
                .filter(|(_, (other, _))| same(other) && other.ty == Type::Real)
                .map(|(k, (_, made))| (From::Table(TableId(k as u32)), &made.bits));
            for (from, source) in std::iter::once((From::Seed, &seed)).chain(tables) {
                for squared in [false, true] {
                    if let Some(made) = self.image(table, from, source, squared) {
                        return made;
                    }
                }
            }
        }
        Made {
            recipe: None,
            bits: table.entries.iter().map(|e| self.bits(e.value())).collect(),
        }
    }

    /// A table as an image of a source, if it is one.
    fn image(&self, table: &Table, from: From, source: &[Bits], squared: bool) -> Option<Made> {
        let wanted: Vec<f64> = (table.entries.iter())
            .map(|e| e.value().real())
            .map(|x| {
                if squared {
                    x.abs().sqrt().copysign(x)
                } else {
                    x
                }
            })
            .collect();
        let source_of = |k: usize| source.get(k).map(|bits| self.real(*bits));
        let sources: Vec<f64> = (0..wanted.len()).filter_map(source_of).collect();
        let order = |a: &usize, b: &usize| sources[*a].total_cmp(&sources[*b]);
        let least = (0..sources.len()).min_by(order)?;
        let most = (0..sources.len()).max_by(order)?;
        let (dx, dy) = (
            sources[most] - sources[least],
            wanted.get(most)? - wanted.get(least)?,
        );
        let scale = dy / dx;
        let moved = wanted[least] / scale - sources[least];
        if !scale.is_finite() || !moved.is_finite() || scale == 0.0 {
            return None;
        }
        // What is lost in the sources' last places is nothing.
        let size = sources[least].abs().max(sources[most].abs());
        let moved = if moved.abs() < 1e-8 * size {
            0.0
        } else {
            moved
        };
        let recipe = Recipe {
            from,
            moved: tidy(moved),
            scale: tidy(scale),
            squared,
        };
        let bits: Option<Vec<Bits>> = (source.iter().zip(&table.entries))
            .map(|(source, entry)| {
                let bits = self.cooked(recipe, *source)?;
                let entry = entry.value().real();
                let near = (self.real(bits) - entry).abs() <= ENTRIES * entry.abs();
                near.then_some(bits)
            })
            .collect();
        Some(Made {
            recipe: Some(recipe),
            bits: bits?,
        })
    }

    /// What a recipe makes of a source.
    fn cooked(&self, recipe: Recipe, source: Bits) -> Option<Bits> {
        let moved = match recipe.moved {
            0.0 => source,
            by => self.apply(Op::Add, &[source, self.bits(Value::Real(by))])?,
        };
        let scaled = match recipe.scale {
            1.0 => moved,
            by => self.apply(Op::Mul, &[moved, self.bits(Value::Real(by))])?,
        };
        if !recipe.squared {
            return Some(scaled);
        }
        let size = self.apply(Op::Abs, &[scaled])?;
        self.apply(Op::Mul, &[scaled, size])
    }

    /// An operation by the cheapest routine: nothing here is large.
    fn apply(&self, op: Op, args: &[Bits]) -> Option<Bits> {
        let fits = |bits: &Bits| self.real(*bits).abs() < 1e9;
        let routine = self.runtime.routines.iter().find(|r| r.op == op)?;
        args.iter()
            .all(fits)
            .then(|| (routine.model)(args))
            .filter(fits)
    }

    fn bits(&self, value: Value) -> Bits {
        (self.runtime.encode)(value, self.runtime.format_of(value.ty()))
    }

    fn real(&self, bits: Bits) -> f64 {
        (self.runtime.decode)(bits, self.runtime.real).real()
    }
}

/// A whole number or a short decimal where that is as good.
fn tidy(x: f64) -> f64 {
    for scale in [1.0, 10.0, 1000.0] {
        let short = (x * scale).round() / scale;
        if (short - x).abs() <= 1e-8 * x.abs().max(1e-3) {
            return short;
        }
    }
    x
}
