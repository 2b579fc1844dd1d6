//! What a whole picture takes on its machine, by running some of its rows there.
//!
//! A program for fewer rows is the same program with other bounds. Two rows, each by itself
//! and both together, tell what a program does before its first row: by itself each does it
//! once more. What is left is the rows' own, of rows spread evenly over the picture; and the
//! routines' mean costs ([`crate::estimate`]) say how much dearer all rows are than those (a
//! ratio estimate: Cochran, Sampling Techniques, 1977, chapter 6). Where all rows together are
//! no work, all are run. Where a single row is much work, two are run, at the same time, and
//! what comes before them is what that is said to take ([`estimate::before`]), where that hardly
//! counts.
//!
//! Where errors go from row to row, a row wants all those above it. There as many rows from
//! the top are run as are no work.

use crate::estimate;
use crate::failure::{Failure, Outcome};
use crate::format::count;
use crate::machine::{File, Machine, Mos6502Source, complaint};
use crate::progress::Progress;
use crate::trial::{self, HACK_HERTZ};
use rayon::prelude::*;
use slowlight_compiler::backend::Document;
use slowlight_compiler::backend::mos6502::ROWS;
use slowlight_compiler::plan::Plan;
use slowlight_vm::Stop;

/// Cycles after which no more rows are looked at, and after which a run is given up: about a
/// tenth of a second and some seconds of the host's time.
const ENOUGH: f64 = 3e7;
const MOST: u64 = 2_000_000_000;

/// Where so many rows are as much work as may be, what comes before them is measured only where
/// it counts.
const FEW: f64 = 4.0;

/// What comes before the first row counts where it is said to be such a part of a row.
const COUNTS: f64 = 0.1;

/// Bands that are looked at at least, where not every pixel is traced.
const BANDS: u32 = 6;

/// The cycles after which there are no more of those.
const LONG: f64 = 20.0 * ENOUGH;

/// Where rows are looked at, in sixteenths of the picture's height: each beginning of this
/// order is spread over all of it.
const PLACES: [u32; 16] = [8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15, 0];

/// What is known of a picture's time.
#[derive(Clone, Debug, PartialEq)]
pub enum Forecast {
    /// The cycles of the whole, which was run.
    Whole(f64),
    /// The same by so many of its rows.
    Rows(f64, u32),
    /// Nothing, and why.
    Not(String),
}

impl Forecast {
    /// Cycles of the whole picture, where they are known.
    pub fn cycles(&self) -> Option<f64> {
        match self {
            Forecast::Whole(cycles) | Forecast::Rows(cycles, _) => Some(*cycles),
            Forecast::Not(_) => None,
        }
    }
}

/// Cycles a second: those of the processor, where the program runs on the Hack's.
pub fn hertz(plan: &Plan, machine: Machine) -> f64 {
    match machine {
        Machine::Hack(config) if config.cpu => HACK_HERTZ,
        _ => plan.target.hertz,
    }
}

/// Runs a plan's program, whose text is known, or as many of its rows as are no work.
///
/// # Errors
/// Only an interruption: why nothing can be told is an answer.
pub fn forecast((plan, text): (&Plan, &[Document]), machine: Machine) -> Outcome<Forecast> {
    let progress = Progress::new("rows, for the time", PLACES.len() as u64);
    let whole = match (machine, text) {
        (Machine::Mos6502(config), [one]) => {
            Some(Mos6502Source::of(&File::text(&one.name, &one.text), config))
        }
        _ => None,
    };
    let mut look = Look {
        plan,
        whole,
        machine,
        progress,
        spent: 0.0,
        rows: 0,
    };
    match look.told() {
        Err(Failure::Interrupted) => Err(Failure::Interrupted),
        Err(other) => Ok(Forecast::Not(other.reason())),
        Ok(told) => Ok(told),
    }
}

/// Looking at rows.
struct Look<'p> {
    plan: &'p Plan,
    /// The program of the whole, where that of fewer rows is soon made of it: machine code takes
    /// long to write and to read.
    whole: Option<Mos6502Source>,
    machine: Machine,
    progress: Progress,
    /// Cycles that were run.
    spent: f64,
    /// Rows that were looked at.
    rows: u32,
}

impl Look<'_> {
    fn told(&mut self) -> Outcome<Forecast> {
        let (first, last) = self.plan.rows;
        // So few are all run sooner than looked at.
        if last - first < 4 {
            return Ok(Forecast::Whole(self.took((first, last))?));
        }
        let cycles = match self.plan.graph.diffusion {
            Some(_) => self.top_rows()?,
            None => self.spread()?,
        };
        match cycles <= ENOUGH {
            true => Ok(Forecast::Whole(self.took((first, last))?)),
            false => Ok(Forecast::Rows(cycles, self.rows)),
        }
    }

    /// Cycles of the program for some rows.
    fn took(&mut self, rows: (u32, u32)) -> Outcome<f64> {
        let cycles = self.run(rows)?;
        self.spent += cycles;
        Ok(cycles)
    }

    fn run(&self, rows: (u32, u32)) -> Outcome<f64> {
        let mut loaded = match &self.whole {
            Some(whole) => whole.load(&[(ROWS[0], rows.0.into()), (ROWS[1], rows.1.into())])?,
            None => {
                let mut plan = self.plan.clone();
                plan.rows = rows;
                trial::build_for(&plan, self.machine)?.loaded
            }
        };
        let run = loaded.run(MOST, &mut |_| {})?;
        let wrong = match run.stop {
            Stop::CycleLimit => Some(format!(
                "a few rows take more than {} cycles",
                count(run.cycles)
            )),
            _ => complaint(&run, MOST),
        };
        self.progress.step(1);
        match wrong {
            Some(wrong) => Err(Failure::Wrong(wrong)),
            None => Ok(run.cycles as f64),
        }
    }

    fn height(&self) -> u32 {
        let (first, last) = self.plan.rows;
        last - first + 1
    }

    /// A row by its place in sixteenths of the picture's height.
    fn at(&self, place: u32) -> u32 {
        let height = self.height();
        self.plan.rows.0 + ((2 * place + 1) * height / 32).min(height - 1)
    }

    /// What is looked at by itself, in its order: rows; where not all pixels are traced, bands
    /// that have a key row below them, each once.
    fn places(&self) -> Vec<(u32, u32)> {
        let rows = PLACES.into_iter().map(|place| self.at(place));
        let Some(refinement) = self.plan.graph.refinement else {
            return rows.map(|row| (row, row)).collect();
        };
        let (first, last) = self.plan.rows;
        let mut all: Vec<(u32, u32)> = Vec::new();
        for row in rows {
            let key = row / refinement.step * refinement.step;
            let band = (key, key + refinement.step - 1);
            if key >= first && band.1 < last && !all.contains(&band) {
                all.push(band);
            }
        }
        all
    }

    /// Cycles of the whole, by rows spread over it, two at the same time.
    fn spread(&mut self) -> Outcome<f64> {
        let said = estimate::rows(self.plan);
        let all = self.places();
        if all.is_empty() {
            return self.took(self.plan.rows);
        }
        let refined = self.plan.graph.refinement.is_some();
        let mut bands = 0;
        let mut before = refined.then(|| estimate::before(self.plan));
        let (mut sum, mut whole) = (0.0, 0.0);
        // What is said of the rows that are looked at.
        let mut part = 0.0;
        for places in all.chunks(2) {
            let looked = places.par_iter().map(|rows| self.looked(*rows));
            let looked: Vec<(f64, f64)> = looked.collect::<Outcome<_>>()?;
            let before = match before {
                Some(before) => before,
                None => *before.insert(self.before(looked.first().map_or(0.0, |(took, _)| *took))?),
            };
            for (took, said) in looked {
                self.spent += took;
                bands += 1;
                sum += (took - before).max(0.0);
                part += said;
            }
            whole = before + sum * said / f64::max(part, 1.0);
            self.rows += places.iter().map(|(from, to)| to + 1 - from).sum::<u32>();
            // What is said of rows knows little of which pixels are traced.
            let many = !refined || bands >= BANDS || self.spent > LONG;
            let enough = self.spent > ENOUGH && many;
            if whole <= ENOUGH || enough {
                break;
            }
        }
        Ok(whole)
    }

    /// Cycles of a row by itself, and what its statements are said to take; or of a band: a
    /// program for one computes one key row more than the band has, so that is run by itself.
    fn looked(&self, rows: (u32, u32)) -> Outcome<(f64, f64)> {
        if self.plan.graph.refinement.is_none() {
            return Ok((self.run(rows)?, self.said(rows)));
        }
        let key = (rows.0, rows.0);
        let (all, one) = (self.run(rows)?, self.run(key)?);
        let before = estimate::before(self.plan);
        let said = self.said(rows) - self.said(key);
        Ok(((all - one).max(0.0) + before, said))
    }

    /// What the statements of some rows are said to take.
    fn said(&self, rows: (u32, u32)) -> f64 {
        let mut plan = self.plan.clone();
        plan.rows = rows;
        estimate::all_rows(&plan)
    }

    /// The cycles before the first row, where the middle one by itself takes so long: as they are
    /// said, where they hardly count, else by that row and the next one.
    fn before(&mut self, one: f64) -> Outcome<f64> {
        let said = estimate::before(self.plan);
        if one * FEW > ENOUGH && said <= one * COUNTS {
            return Ok(said);
        }
        let row = self.at(PLACES[0]);
        let (both, other) =
            rayon::join(|| self.run((row, row + 1)), || self.run((row + 1, row + 1)));
        let (both, other) = (both?, other?);
        self.spent += both + other;
        Ok((one + other - both).clamp(0.0, one.min(other)))
    }

    /// Cycles of the whole, by its first rows.
    fn top_rows(&mut self) -> Outcome<f64> {
        let (first, last) = self.plan.rows;
        let one = self.took((first, first))?;
        let both = self.took((first, first + 1))?;
        let before = (2.0 * one - both).clamp(0.0, one);
        let (mut took, mut rows) = (both, 2);
        while first + 2 * rows - 1 < last && self.spent + 2.0 * took < ENOUGH {
            rows *= 2;
            took = self.took((first, first + rows - 1))?;
        }
        self.rows = rows;
        let expected = |rows: (u32, u32)| {
            let mut plan = self.plan.clone();
            plan.rows = rows;
            estimate::rows(&plan)
        };
        let part = expected((first, first + rows - 1)).max(1.0);
        Ok(before + (took - before) * expected((first, last)) / part)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_sixteenths_in_an_order_that_is_spread() {
        let mut all = PLACES;
        all.sort_unstable();
        assert_eq!(all.to_vec(), (0..16).collect::<Vec<u32>>());
        // Of the first four, one in each quarter but the first, which has the last of eight.
        for many in [2, 4, 8] {
            let mut first = PLACES[..many].to_vec();
            first.sort_unstable();
            let gaps = first.windows(2).map(|two| two[1] - two[0]);
            assert!(gaps.max() <= Some(16 / many as u32 * 2), "{first:?}");
        }
    }
}
