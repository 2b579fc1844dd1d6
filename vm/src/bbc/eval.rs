//! Evaluates expressions that give numbers. Strings are in [`super::strings`].

use std::cmp::Ordering;

use slowlight_isa::real40::Real40;

use super::arithmetic::{holds, order, truth};
use super::ast::{Compare, Expr, Kind, Slot};
use super::code::Code;
use super::error::Error;
use super::state::State;
use super::values::{Elements, Num, Value};
use super::work;

type Result<T> = std::result::Result<T, Error>;

impl State {
    /// The value of a numeric expression.
    pub fn num(&mut self, p: &Code<'_>, e: &Expr) -> Result<Num> {
        match e {
            Expr::Int(n) => Ok(Num::Int(*n)),
            Expr::Real(x) => Ok(Num::Real(*x)),
            Expr::IntVar(slot) => self.int_var(*slot),
            Expr::RealVar(slot) => self.real_var(*slot),
            Expr::Op2(op, ab) => {
                let a = self.operand(p, &ab.0)?;
                let b = self.operand(p, &ab.1)?;
                self.op2(*op, a, b)
            }
            Expr::Compare(op, ab) => {
                let a = self.operand(p, &ab.0)?;
                let b = self.operand(p, &ab.1)?;
                Ok(truth(self.compare(*op, a, b)))
            }
            Expr::F1(f, x) => {
                let x = self.operand(p, x)?;
                self.func1(*f, x)
            }
            Expr::Element(kind, slot, index) => self.element(p, *kind, *slot, index),
            Expr::ByteAt(ab) => {
                let address = self.offset(p, &ab.0, &ab.1)?;
                Ok(Num::Int(i32::from(self.byte(address))))
            }
            Expr::WordAt(ab) => {
                let address = self.offset(p, &ab.0, &ab.1)?;
                Ok(Num::Int(self.word(address)))
            }
            Expr::F0(f) => self.func0(*f),
            Expr::Fn(..) | Expr::FS(..) | Expr::Concat(_) | Expr::CompareAny(..) => {
                match self.value(p, e)? {
                    Value::Num(n) => Ok(n),
                    Value::Str(_) => Err(Error::TypeMismatch),
                }
            }
            Expr::Bad(e) => Err(*e),
            Expr::Str(_) | Expr::StrVar(_) => Err(Error::TypeMismatch),
        }
    }

    /// The same, without a call for what most operands are.
    #[inline(always)]
    pub fn operand(&mut self, p: &Code<'_>, e: &Expr) -> Result<Num> {
        match e {
            Expr::RealVar(slot) => self.real_var(*slot),
            Expr::IntVar(slot) => self.int_var(*slot),
            Expr::Int(n) => Ok(Num::Int(*n)),
            e => self.num(p, e),
        }
    }

    /// Is a condition anything but 0?
    #[inline]
    pub fn condition(&mut self, p: &Code<'_>, e: &Expr) -> Result<bool> {
        if let Expr::Compare(op, ab) = e {
            let a = self.operand(p, &ab.0)?;
            let b = self.operand(p, &ab.1)?;
            return Ok(self.compare(*op, a, b));
        }
        Ok(self.int(p, e)? != 0)
    }

    #[inline]
    pub fn int(&mut self, p: &Code<'_>, e: &Expr) -> Result<i32> {
        let n = self.operand(p, e)?;
        self.whole(n)
    }

    /// A number as an integer; the conversion is charged.
    #[inline]
    pub fn whole(&mut self, n: Num) -> Result<i32> {
        if let Num::Real(x) = n {
            self.cycles += u64::from(work::real_to_int(x));
        }
        n.int()
    }

    /// A number as a real; the conversion is charged.
    #[inline]
    pub fn real_of(&mut self, n: Num) -> Real40 {
        if let Num::Int(n) = n {
            self.cycles += u64::from(work::int_to_real(n));
        }
        n.real()
    }

    /// An address: 16 bits of an integer.
    pub fn address(&mut self, p: &Code<'_>, e: &Expr) -> Result<u16> {
        Ok(self.int(p, e)? as u16)
    }

    fn offset(&mut self, p: &Code<'_>, a: &Expr, b: &Expr) -> Result<u16> {
        let a = self.int(p, a)?;
        let b = self.int(p, b)?;
        Ok(a.wrapping_add(b) as u16)
    }

    #[inline]
    fn int_var(&mut self, slot: Slot) -> Result<Num> {
        let v = self.ints.get(slot as usize).ok_or(Error::NoSuchVariable)?;
        if !v.defined {
            return Err(Error::NoSuchVariable);
        }
        self.cycles += u64::from(v.lookup);
        Ok(Num::Int(v.value))
    }

    #[inline]
    fn real_var(&mut self, slot: Slot) -> Result<Num> {
        let v = self.reals.get(slot as usize).ok_or(Error::NoSuchVariable)?;
        if !v.defined {
            return Err(Error::NoSuchVariable);
        }
        self.cycles += u64::from(v.lookup);
        Ok(Num::Real(v.value))
    }

    fn element(&mut self, p: &Code<'_>, kind: Kind, slot: Slot, index: &[Expr]) -> Result<Num> {
        let at = self.subscript(p, kind, slot, index)?;
        match &self.array(kind, slot)?.elements {
            Elements::Int(v) => v.get(at).map(|n| Num::Int(*n)),
            Elements::Real(v) => v.get(at).map(|x| Num::Real(*x)),
            Elements::Str(_) => return Err(Error::TypeMismatch),
        }
        .ok_or(Error::Subscript)
    }

    /// Subscripts to the index of an element: the last one runs fastest.
    pub fn subscript(
        &mut self,
        p: &Code<'_>,
        kind: Kind,
        slot: Slot,
        index: &[Expr],
    ) -> Result<usize> {
        let array = self.array(kind, slot)?;
        let lookup = array.lookup;
        match index.len().cmp(&array.dims.len()) {
            Ordering::Less => return Err(Error::Array),
            // The ROM wants the bracket after as many as there are.
            Ordering::Greater => return Err(Error::MissingBracket),
            Ordering::Equal => {}
        }
        self.cycles += u64::from(lookup);
        let mut at = 0usize;
        for (i, e) in index.iter().enumerate() {
            let n = self.int(p, e)?;
            let bound = self.array(kind, slot)?.dims.get(i).copied().unwrap_or(0);
            let n = usize::try_from(n).map_err(|_| Error::Subscript)?;
            if n >= bound {
                return Err(Error::Subscript);
            }
            at = at * bound + n;
        }
        Ok(at)
    }

    /// Compares where a side may be a string.
    pub fn compare_any(&mut self, p: &Code<'_>, op: Compare, a: &Expr, b: &Expr) -> Result<Num> {
        let a = self.value(p, a)?;
        let b = self.value(p, b)?;
        let order = match (a, b) {
            (Value::Num(a), Value::Num(b)) => order(a, b),
            (Value::Str(a), Value::Str(b)) => {
                let equal = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
                self.cycles += work::text::READ * a.len() as u64;
                self.cycles += work::text::EQUAL * equal as u64;
                a.cmp(&b)
            }
            _ => return Err(Error::TypeMismatch),
        };
        Ok(truth(holds(op, order)))
    }

    pub fn point(&mut self, p: &Code<'_>, list: &[Expr]) -> Result<Num> {
        let [x, y] = list else {
            return Err(Error::MissingComma);
        };
        let x = self.int(p, x)?;
        let y = self.int(p, y)?;
        self.cycles += super::cost::plot::READ;
        self.plot_cycles += super::cost::plot::READ;
        Ok(Num::Int(self.display.point(&self.mem, x, y)))
    }
}
