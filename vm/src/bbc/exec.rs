//! Carries out statements.

use super::ast::{DimItem, Expr, Kind, OnKind, Place, Program, Stmt, Target};
use super::code::Code;
use super::cost;
use super::error::Error;
use super::state::State;
use super::values::{Array, Elements, Home, Loop, Num, Value, array_index, is_numeric};
use crate::{Progress, Stop};

type Result<T> = std::result::Result<T, Error>;

/// "The next op" after a function's result: leave the loop.
pub(crate) const DONE: u32 = u32::MAX;

const MOST_FORS: usize = 10;
const MOST_REPEATS: usize = 20;
const MOST_GOSUBS: usize = 26;
/// Cycles between two looks at the limit and the watcher.
const CHECK_EVERY: u64 = 10_000_000;

impl State {
    /// Runs from an op until a function's result, or until an error (END is one, too).
    pub fn run_ops(&mut self, p: &Code<'_>, start: u32) -> Result<()> {
        let mut at = start;
        while at != DONE {
            let op = p.program.ops.get(at as usize).ok_or(Error::BadProgram)?;
            self.op = at;
            self.cycles += u64::from(op.cost);
            if self.cycles >= self.next_check {
                self.check(p)?;
            }
            at = self.exec(p, &op.stmt, at)?;
        }
        Ok(())
    }

    /// Is it time to stop?
    fn check(&mut self, p: &Code<'_>) -> Result<()> {
        if self.cycles >= p.limit {
            self.stop = Some(Stop::CycleLimit);
            return Err(Error::Halt);
        }
        self.next_check = (self.cycles + CHECK_EVERY).min(p.limit);
        let progress = Progress {
            cycles: self.cycles,
            row: self.display.last_row(),
        };
        let go_on = match p.watch.try_borrow_mut() {
            Ok(mut watch) => watch(progress),
            Err(_) => true,
        };
        if go_on {
            return Ok(());
        }
        self.stop = Some(Stop::Interrupted);
        Err(Error::Halt)
    }

    fn exec(&mut self, p: &Code<'_>, stmt: &Stmt, at: u32) -> Result<u32> {
        let next = at + 1;
        match stmt {
            Stmt::LetInt(slot, e) => {
                self.define_int(*slot)?;
                let n = self.num(p, e)?.int()?;
                if let Some(v) = self.ints.get_mut(*slot as usize) {
                    self.cycles += u64::from(v.lookup);
                    v.value = n;
                }
            }
            Stmt::LetReal(slot, e) => {
                self.define_real(*slot)?;
                let x = self.num(p, e)?.real();
                if let Some(v) = self.reals.get_mut(*slot as usize) {
                    self.cycles += u64::from(v.lookup);
                    v.value = x;
                }
            }
            Stmt::Let(place, e) => {
                let home = self.home(p, place)?;
                let value = self.value(p, e)?;
                self.store(home, value)?;
            }
            Stmt::If(e, otherwise) => {
                if self.num(p, e)?.int()? == 0 {
                    return Ok(*otherwise);
                }
            }
            Stmt::EndLine => return Ok(self.next_line(p, at)),
            Stmt::Goto(target) => return self.go(p, target),
            Stmt::Gosub(target) => {
                if self.gosubs.len() >= MOST_GOSUBS {
                    return Err(Error::TooManyGosubs);
                }
                let to = self.go(p, target)?;
                self.gosubs.push(next);
                return Ok(to);
            }
            Stmt::Return => return self.gosubs.pop().ok_or(Error::NoGosub),
            Stmt::On(kind, e, targets, otherwise) => {
                return self.on(p, kind, e, targets, *otherwise, at);
            }
            Stmt::For(place, parts) => {
                self.start_for(p, place, &parts.0, &parts.1, parts.2.as_ref(), next)?
            }
            Stmt::Next(list) => return self.next_for(p, list, next),
            Stmt::Repeat => {
                if self.repeats.len() >= MOST_REPEATS {
                    return Err(Error::TooManyRepeats);
                }
                self.repeats.push(next);
            }
            Stmt::Until(e) => {
                let done = self.num(p, e)?.int()? != 0;
                let back = *self.repeats.last().ok_or(Error::NoRepeat)?;
                if !done {
                    return Ok(back);
                }
                self.repeats.pop();
            }
            Stmt::Proc(slot, list) => return self.enter_call(p, Kind::Proc, *slot, list, next),
            Stmt::EndProc => return self.leave_call(false),
            Stmt::Result(e) => {
                if !self.frames.last().is_some_and(|f| f.function) {
                    return Err(Error::NoFn);
                }
                self.result = self.value(p, e)?;
                return self.leave_call(true);
            }
            Stmt::Local(places) => self.local(p, places)?,
            Stmt::Dim(items) => {
                for item in items {
                    self.dim(p, item)?;
                }
            }
            Stmt::Bad(e) => return Err(*e),
            other => return self.exec_more(p, other, at),
        }
        Ok(next)
    }

    /// The rarer statements.
    fn exec_more(&mut self, p: &Code<'_>, stmt: &Stmt, at: u32) -> Result<u32> {
        let next = at + 1;
        match stmt {
            Stmt::OnError => {
                self.on_error = Some(next);
                return Ok(self.next_line(p, at));
            }
            Stmt::OnErrorOff => self.on_error = None,
            Stmt::Read(places) => {
                for place in places {
                    self.read(p, place)?;
                }
            }
            Stmt::Restore(target) => {
                self.data = match target {
                    None => 0,
                    Some(target) => {
                        let line = self.line_of(p, target)?;
                        p.data.partition_point(|d| d.line < line)
                    }
                }
            }
            Stmt::SetTime(e) => {
                let t = self.int(p, e)?;
                self.time_base = self.cycles as i64 - i64::from(t) * 20_000;
            }
            Stmt::SetHimem(e) => {
                let to = u32::from(self.address(p, e)?);
                if to < self.heap {
                    return Err(Error::NoRoom);
                }
                // Also the end of everything on the stack.
                self.himem = to;
                self.stack = to;
                self.least_free = self.least_free.min(to - self.heap);
            }
            Stmt::SetLomem(e) => {
                let to = u32::from(self.address(p, e)?);
                if to > self.stack {
                    return Err(Error::NoRoom);
                }
                self.lomem = to;
                self.clear();
            }
            Stmt::SetPage(e) => {
                self.address(p, e)?;
            }
            Stmt::Clear => self.clear(),
            Stmt::Ignore(list) => {
                for e in list {
                    self.num(p, e)?;
                }
            }
            Stmt::End => {
                self.stop = Some(Stop::Ended);
                return Err(Error::Halt);
            }
            Stmt::Stop => return Err(Error::Stop),
            other => self.exec_io(p, other)?,
        }
        Ok(next)
    }

    /// The first op of the line after an op's.
    fn next_line(&self, p: &Program, at: u32) -> u32 {
        let line = p.ops.get(at as usize).map_or(0, |op| op.line);
        match p.lines.get(line as usize + 1) {
            Some(line) => line.op,
            None => p.ops.len().saturating_sub(1) as u32,
        }
    }

    /// A target's line, as an index.
    fn line_of(&mut self, p: &Code<'_>, target: &Target) -> Result<u32> {
        match target {
            Target::Line(line, cost) => {
                self.cycles += u64::from(*cost);
                Ok(*line)
            }
            Target::Missing => Err(Error::NoSuchLine),
            Target::Computed(e) => {
                let number = self.int(p, e)?;
                let line = p
                    .lines
                    .iter()
                    .position(|l| i32::from(l.number) == number)
                    .ok_or(Error::NoSuchLine)?;
                self.cycles += u64::from(cost::PER_LINE) * line as u64;
                Ok(line as u32)
            }
        }
    }

    fn go(&mut self, p: &Code<'_>, target: &Target) -> Result<u32> {
        let line = self.line_of(p, target)?;
        p.lines
            .get(line as usize)
            .map(|l| l.op)
            .ok_or(Error::NoSuchLine)
    }

    fn on(
        &mut self,
        p: &Code<'_>,
        kind: &OnKind,
        e: &Expr,
        targets: &[Target],
        otherwise: Option<u32>,
        at: u32,
    ) -> Result<u32> {
        let n = self.int(p, e)?;
        let target = usize::try_from(n)
            .ok()
            .and_then(|n| targets.get(n.checked_sub(1)?));
        let Some(target) = target else {
            return otherwise.ok_or(Error::OnRange);
        };
        if *kind == OnKind::Gosub {
            if self.gosubs.len() >= MOST_GOSUBS {
                return Err(Error::TooManyGosubs);
            }
            // After the return, an ELSE clause is skipped: it starts with its own EndLine.
            self.gosubs.push(at + 1);
        }
        self.go(p, target)
    }

    fn start_for(
        &mut self,
        p: &Code<'_>,
        place: &Place,
        from: &Expr,
        to: &Expr,
        step: Option<&Expr>,
        body: u32,
    ) -> Result<()> {
        let home = self.home(p, place)?;
        let start = self.num(p, from)?;
        self.store(home, Value::Num(start))?;
        if self.loops.len() >= MOST_FORS {
            return Err(Error::TooManyFors);
        }
        let to = self.num(p, to)?;
        let step = match step {
            Some(e) => self.num(p, e)?,
            None => Num::Int(1),
        };
        let int = matches!(home, Home::Int(_));
        let fit = |n: Num| -> Result<Num> {
            Ok(if int {
                Num::Int(n.int()?)
            } else {
                Num::Real(n.real())
            })
        };
        self.loops.push(Loop {
            home,
            to: fit(to)?,
            step: fit(step)?,
            body,
        });
        Ok(())
    }

    fn next_for(&mut self, p: &Code<'_>, list: &[Option<Place>], next: u32) -> Result<u32> {
        for place in list {
            let wanted = match place {
                Some(place) => Some(self.home(p, place)?),
                None => None,
            };
            if let Some(back) = self.turn(wanted)? {
                return Ok(back);
            }
        }
        Ok(next)
    }

    /// One turn of the innermost loop (or of the wanted variable's, dropping those within).
    /// Answers where it goes on, if it does.
    fn turn(&mut self, wanted: Option<Home>) -> Result<Option<u32>> {
        if self.loops.is_empty() {
            return Err(Error::NoFor);
        }
        if let Some(home) = wanted {
            while self.loops.last().is_some_and(|l| l.home != home) {
                self.loops.pop();
            }
        }
        let Some(l) = self.loops.last().cloned() else {
            return Err(Error::CantMatchFor);
        };
        let int = matches!(l.home, Home::Int(_));
        self.cycles += cost::next(int);
        let over = match (l.home, l.to, l.step) {
            (Home::Int(slot), Num::Int(to), Num::Int(step)) => {
                let v = self
                    .ints
                    .get_mut(slot as usize)
                    .ok_or(Error::NoSuchVariable)?;
                v.value = v.value.wrapping_add(step);
                if step < 0 { v.value < to } else { v.value > to }
            }
            (Home::Real(slot), Num::Real(to), Num::Real(step)) => {
                let v = self
                    .reals
                    .get_mut(slot as usize)
                    .ok_or(Error::NoSuchVariable)?;
                v.value = slowlight_isa::real40::arith::add(v.value, step)?;
                if step.is_negative() {
                    v.value < to
                } else {
                    v.value > to
                }
            }
            _ => return Err(Error::ForVariable),
        };
        if over {
            self.loops.pop();
            return Ok(None);
        }
        Ok(Some(l.body))
    }

    fn dim(&mut self, p: &Code<'_>, item: &DimItem) -> Result<()> {
        match item {
            DimItem::Block(place, e) => {
                let home = self.home(p, place)?;
                // DIM P% -1 takes nothing and gives the heap's end.
                let bytes = self.int(p, e)?.checked_add(1).ok_or(Error::DimSpace)?;
                let bytes = u32::try_from(bytes).map_err(|_| Error::BadDim)?;
                let start = self.allocate(bytes).map_err(|_| Error::DimSpace)?;
                self.store(home, Value::Num(Num::Int(start as i32)))
            }
            DimItem::Array(kind, slot, bounds) => {
                if self.array(*kind, *slot).is_ok() {
                    return Err(Error::BadDim);
                }
                let mut dims = Vec::with_capacity(bounds.len());
                let mut count = 1usize;
                for e in bounds {
                    let bound = self.int(p, e)?;
                    let n = usize::try_from(bound).map_err(|_| Error::BadDim)? + 1;
                    dims.push(n);
                    count = count
                        .checked_mul(n)
                        .filter(|n| *n < 0x10000)
                        .ok_or(Error::DimSpace)?;
                }
                let size = if *kind == Kind::Reals { 5 } else { 4 };
                let bytes = 1 + 2 * dims.len() + size * count;
                let lookup = self.enter(*kind, *slot)?;
                self.allocate(bytes as u32).map_err(|_| Error::DimSpace)?;
                self.cycles += 20 * bytes as u64;
                let elements = match kind {
                    Kind::Ints => Elements::Int(vec![0; count]),
                    Kind::Reals => Elements::Real(vec![Default::default(); count]),
                    _ => Elements::Str(vec![Vec::new(); count]),
                };
                let array = Array {
                    dims,
                    elements,
                    lookup,
                };
                if let Some(entry) = self.arrays[array_index(*kind)].get_mut(*slot as usize) {
                    *entry = Some(array);
                }
                Ok(())
            }
        }
    }

    fn read(&mut self, p: &Code<'_>, place: &Place) -> Result<()> {
        let home = self.home(p, place)?;
        let datum = p.data.get(self.data).ok_or(Error::OutOfData)?;
        self.data += 1;
        let text = &datum.text;
        let value = if is_numeric(place) {
            // Numbers in DATA may be expressions; most are plain.
            Value::Num(super::strings::val(text)?)
        } else {
            let text = text.strip_prefix(b"\"").unwrap_or(text);
            Value::Str(text.to_vec())
        };
        self.cycles += 100 * text.len() as u64;
        self.store(home, value)
    }
}
