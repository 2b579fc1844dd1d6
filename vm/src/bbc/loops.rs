//! FOR and NEXT: the machine's stack of ten loops, each of which knows its
//! variable, its end, its step and where its body starts.

use std::cmp::Ordering;

use slowlight_isa::real40::Real40;

use super::arithmetic::order;
use super::ast::{Expr, Op2, Place};
use super::code::Code;
use super::cost;
use super::error::Error;
use super::state::State;
use super::values::{Home, Loop, Num, Value};
use super::work;

type Result<T> = std::result::Result<T, Error>;

const MOST_FORS: usize = 10;

impl State {
    pub(super) fn start_for(
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
            Some(e) => Some(self.num(p, e)?),
            None => None,
        };
        // A loop over a byte in memory goes on with a word.
        let home = word_of(home);
        let int = !home.is_real();
        let mut fit = |n: Num| -> Result<Num> {
            Ok(if int {
                Num::Int(self.whole(n)?)
            } else {
                Num::Real(self.real_of(n))
            })
        };
        let to = fit(to)?;
        let step = match step {
            Some(step) => fit(step)?,
            None if int => Num::Int(1),
            None => Num::Real(Real40::ONE),
        };
        self.loops.push(Loop {
            home,
            to,
            step,
            body,
        });
        Ok(())
    }

    pub(super) fn next_for(
        &mut self,
        p: &Code<'_>,
        list: &[Option<Place>],
        next: u32,
    ) -> Result<u32> {
        for place in list {
            let wanted = match place {
                Some(_) if self.loops.is_empty() => return Err(Error::NoFor),
                Some(place) if !self.is_defined(place) => return Err(Error::Syntax),
                Some(place) => Some(word_of(self.home(p, place)?)),
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
        let int = !l.home.is_real();
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
                let sum = slowlight_isa::real40::arith::add(v.value, step)?;
                self.cycles += u64::from(work::add(v.value, step, sum));
                v.value = sum;
                if step.is_negative() {
                    v.value < to
                } else {
                    v.value > to
                }
            }
            (home, to, step) => self.step(home, to, step)?,
        };
        if over {
            self.loops.pop();
            return Ok(None);
        }
        Ok(Some(l.body))
    }

    /// A step of an element or of a word in memory; answers whether the loop is over.
    fn step(&mut self, home: Home, to: Num, step: Num) -> Result<bool> {
        let Value::Num(old) = self.load(home)? else {
            return Err(Error::ForVariable);
        };
        let new = self.op2(Op2::Add, old, step)?;
        self.store(home, Value::Num(new))?;
        let past = order(new, to);
        let down = order(step, Num::Int(0)) == Ordering::Less;
        Ok(past
            == if down {
                Ordering::Less
            } else {
                Ordering::Greater
            })
    }
}

fn word_of(home: Home) -> Home {
    match home {
        Home::Byte(address) => Home::Word(address),
        home => home,
    }
}
