//! Table initialisation: tables that a program works out at its start.
//!
//! The tables of a dither's thresholds are images of its cells: for each ink a
//! line in the cell, squared perhaps, and what algebra compares with may be a
//! square of that again. A program that has the cells makes such tables from
//! them, element by element, with a sum, a product and a square each; decimals
//! for every entry would take several times as much memory.
//!
//! So is a period of a sine: that of the entry's number, moved and scaled.
//!
//! The entries are then what the machine's own operations give, which differs
//! from the nearest numbers in the last places: by 2^-22 of an entry at most, or
//! the table is not made so. The model has the same bits ([`Made::bits`]).

use crate::analysis::range::ENTRIES;
use crate::ir::graph::*;
use slowlight_routine::{Bits, Op, Runtime, Type, Value};
use std::f64::consts::TAU;

/// What an entry is worked out from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum From {
    /// The cell's number ([`Table::seed`]).
    Seed,
    /// The entry at the same place of another table.
    Table(TableId),
    /// The entry's own number.
    Index,
}

/// How an entry is worked out: (from + moved) * scale; a function of that, if there is one; where
/// there is `more`, that squared with its sign, and `more` added; all of it squared with its sign
/// if `squared`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recipe {
    /// From what.
    pub from: From,
    /// What is added.
    pub moved: f64,
    /// By what the sum is multiplied.
    pub scale: f64,
    /// A function of the product.
    pub function: Option<Function>,
    /// What is added to the product's square.
    pub more: Option<f64>,
    /// Whether the result is squared.
    pub squared: bool,
}

/// A function of one real, and what it is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Function {
    /// Which.
    pub op: Op,
    /// By what its values are multiplied.
    pub times: f64,
}

/// How many entries a period has at least.
const PERIOD: u32 = 16;

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
        if derives && let Some(made) = self.period(table) {
            return made;
        }
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
                for (bent, squared) in [(false, false), (false, true), (true, false), (true, true)]
                {
                    if let Some(made) = self.image(table, from, source, bent, squared) {
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

    /// A table that is a period of a sine, if it is one: the first two entries tell which.
    fn period(&self, table: &Table) -> Option<Made> {
        if table.height > 1 || table.width < PERIOD {
            return None;
        }
        let scale = TAU / f64::from(table.width);
        let entry = |k: usize| table.entries.get(k).map(|e| e.value().real());
        let (first, second) = (entry(0)?, entry(1)?);
        let beside = (second - first * scale.cos()) / scale.sin();
        let function = Function {
            op: Op::Sin,
            times: tidy(first.hypot(beside)),
        };
        let recipe = Recipe {
            from: From::Index,
            moved: tidy(first.atan2(beside) / scale),
            scale,
            function: Some(function),
            more: None,
            squared: false,
        };
        // What is 0 everywhere needs no sine.
        if function.times <= 0.0 {
            return None;
        }
        let numbers = (0..table.width as i32).map(|n| self.bits(Value::Real(f64::from(n))));
        let numbers: Vec<Bits> = numbers.collect();
        self.by(recipe, &numbers, table)
    }

    /// A table as an image of a source, if it is one: of a line in it, or of a
    /// line's square where `bent`.
    fn image(
        &self,
        table: &Table,
        from: From,
        source: &[Bits],
        bent: bool,
        squared: bool,
    ) -> Option<Made> {
        let wanted: Vec<f64> = (table.entries.iter())
            .map(|e| e.value().real())
            .map(|x| if squared { root(x) } else { x })
            .collect();
        let source_of = |k: usize| source.get(k).map(|bits| self.real(*bits));
        let sources: Vec<f64> = (0..wanted.len()).filter_map(source_of).collect();
        let mut points: Vec<(f64, f64)> = sources.iter().copied().zip(wanted).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (scale, moved, more) = match bent {
            false => line(&points).map(|(scale, moved)| (scale, moved, None))?,
            true => square(&points)?,
        };
        // What is lost in the sources' last places is nothing.
        let size = sources.iter().fold(0.0, |most, x: &f64| x.abs().max(most));
        let moved = if moved.abs() < 1e-8 * size {
            0.0
        } else {
            moved
        };
        let recipe = Recipe {
            from,
            moved: tidy(moved),
            scale: tidy(scale),
            function: None,
            more: more.map(tidy),
            squared,
        };
        self.by(recipe, source, table)
    }

    /// A table by a recipe, where its entries come near enough.
    fn by(&self, recipe: Recipe, source: &[Bits], table: &Table) -> Option<Made> {
        // What is left of a sine near its zeros is as exact as the sine is.
        let least = recipe.function.map_or(0.0, |function| function.times.abs());
        let bits: Option<Vec<Bits>> = (source.iter().zip(&table.entries))
            .map(|(source, entry)| {
                let bits = self.cooked(recipe, *source)?;
                let entry = entry.value().real();
                let near = (self.real(bits) - entry).abs() <= ENTRIES * entry.abs().max(least);
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
        let scaled = self.times(moved, recipe.scale)?;
        let scaled = match recipe.function {
            None => scaled,
            Some(Function { op, times }) => {
                let value = self.apply(op, &[scaled])?;
                self.times(value, times)?
            }
        };
        let bent = match recipe.more {
            None => scaled,
            Some(0.0) => self.square(scaled)?,
            Some(more) => {
                let more = self.bits(Value::Real(more));
                self.apply(Op::Add, &[self.square(scaled)?, more])?
            }
        };
        match recipe.squared {
            true => self.square(bent),
            false => Some(bent),
        }
    }

    /// A product with a number.
    fn times(&self, of: Bits, by: f64) -> Option<Bits> {
        match by {
            1.0 => Some(of),
            by => self.apply(Op::Mul, &[of, self.bits(Value::Real(by))]),
        }
    }

    /// The square, with its sign.
    fn square(&self, of: Bits) -> Option<Bits> {
        let size = self.apply(Op::Abs, &[of])?;
        self.apply(Op::Mul, &[of, size])
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

/// The root, with its sign.
fn root(x: f64) -> f64 {
    x.abs().sqrt().copysign(x)
}

/// The line through the ends of points: y = (x + moved) * scale.
fn line(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let (first, last) = (points.first()?, points.last()?);
    let scale = (last.1 - first.1) / (last.0 - first.0);
    let moved = first.1 / scale - first.0;
    (scale.is_finite() && moved.is_finite() && scale != 0.0).then_some((scale, moved))
}

/// The parabola through points as y = u|u| + more, u = (x + moved) * scale, where
/// its vertex is not among them.
fn square(points: &[(f64, f64)]) -> Option<(f64, f64, Option<f64>)> {
    let (a, b, c) = (
        points.first()?,
        points.get(points.len() / 2)?,
        points.last()?,
    );
    let slope = |p: &(f64, f64), q: &(f64, f64)| (q.1 - p.1) / (q.0 - p.0);
    let bend = (slope(b, c) - slope(a, b)) / (c.0 - a.0);
    let moved = (slope(a, b) / bend - a.0 - b.0) / 2.0;
    let more = a.1 - bend * (a.0 + moved).powi(2);
    let (low, high) = (a.0 + moved, c.0 + moved);
    if !(bend.is_finite() && moved.is_finite()) || bend == 0.0 || low * high < 0.0 {
        return None;
    }
    // u has the sign of its square, with its sign.
    let side = if low + high < 0.0 { -1.0 } else { 1.0 };
    let more = if more.abs() < 1e-9 { 0.0 } else { more };
    Some((root(bend) * side, moved, Some(more)))
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
