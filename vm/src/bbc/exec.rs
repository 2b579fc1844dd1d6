//! Carries out statements: the run from one to the next, conditions and jumps.
//! `loops` has FOR and NEXT, `arrays` DIM, `data` READ, `io` what deals with the world.

use super::ast::{Expr, Kind, OnKind, Stmt, Target};
use super::code::Code;
use super::cost;
use super::error::Error;
use super::profile::At;
use super::program::Program;
use super::state::State;
use crate::{Progress, Stop};

type Result<T> = std::result::Result<T, Error>;

/// "The next op" after a function's result: leave the loop.
pub(crate) const DONE: u32 = u32::MAX;

const MOST_REPEATS: usize = 20;
const MOST_GOSUBS: usize = 26;
/// Cycles between two looks at the limit and the watcher.
const CHECK_EVERY: u64 = 10_000_000;

impl State {
    /// Runs from an op until a function's result, or until an error (END is one, too).
    pub fn run_ops(&mut self, p: &Code<'_>, start: u32) -> Result<()> {
        let mut at = start;
        let mut caller = None;
        while at != DONE {
            let op = p.program.ops.get(at as usize).ok_or(Error::BadProgram)?;
            if self.trace > 0 {
                self.tell_line(p, at);
            }
            self.op = at;
            if let Some(profile) = &mut self.profile {
                let now = At {
                    statement: op.statement,
                    depth: self.frames.len() as u32,
                    begins: p
                        .statements
                        .get(op.statement as usize)
                        .is_some_and(|s| s.op == at),
                };
                let left = profile.enter(now, self.cycles);
                caller.get_or_insert(left);
            }
            self.cycles += u64::from(op.cost);
            if self.cycles >= self.next_check {
                self.check(p)?;
            }
            at = self.exec(p, &op.stmt, at)?;
        }
        if let (Some(profile), Some(caller)) = (&mut self.profile, caller) {
            // It goes on; it does not begin again.
            let caller = At {
                begins: false,
                ..caller
            };
            profile.enter(caller, self.cycles);
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
        let shown = || Some(self.display.screen(&self.mem)).filter(|s| !s.pixels.is_empty());
        let progress = Progress {
            cycles: self.cycles,
            row: self.display.last_row(),
            screen: &shown,
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
                let n = self.int(p, e)?;
                if let Some(v) = self.ints.get_mut(*slot as usize) {
                    self.cycles += u64::from(v.lookup);
                    v.value = n;
                }
            }
            Stmt::LetReal(slot, e) => {
                self.define_real(*slot)?;
                let x = self.operand(p, e)?;
                let x = self.real_of(x);
                if let Some(v) = self.reals.get_mut(*slot as usize) {
                    self.cycles += u64::from(v.lookup);
                    v.value = x;
                }
            }
            Stmt::Let(place, e) => {
                let before = self.cycles;
                let home = self.home(p, place)?;
                let shown = self.is_shown(&home);
                let value = self.value(p, e)?;
                self.store(home, value)?;
                if shown {
                    let written = p.program.ops.get(at as usize).map_or(0, |op| op.cost);
                    self.plot_cycles += self.cycles - before + u64::from(written);
                }
            }
            Stmt::If(e, otherwise, skipped) => {
                if !self.condition(p, e)? {
                    self.cycles += u64::from(*skipped);
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
                let done = self.condition(p, e)?;
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
                let line = match target {
                    None => 0,
                    Some(target) => self.line_of(p, target)?,
                };
                self.restore(p, line);
            }
            Stmt::SetTime(e) => {
                let t = self.int(p, e)?;
                self.time_base = cost::with_interrupts(self.cycles) as i64 - i64::from(t) * 20_000;
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
            Stmt::Trace(None) => self.trace = 0,
            Stmt::Trace(Some(e)) => self.trace = self.int(p, e)? as u16,
            Stmt::Clear => self.clear(),
            Stmt::Run => {
                // Also out of every function that is being called.
                self.clear();
                return Err(Error::Halt);
            }
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
                let passed = p.lines.iter().take(line).map(|l| l.number);
                self.cycles += u64::from(cost::search(passed, number as u16));
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
}
