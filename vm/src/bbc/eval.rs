//! Evaluates expressions that give numbers. Strings are in [`super::strings`].

use std::cmp::Ordering;

use slowlight_isa::real40::{Real40, arith, elementary};

use super::Dialect;
use super::ast::{Compare, Expr, Func0, Func1, Kind, Op2, Slot};
use super::code::Code;
use super::error::Error;
use super::state::State;
use super::values::{Elements, Num, Value};
use super::work;

type Result<T> = std::result::Result<T, Error>;

fn truth(b: bool) -> Num {
    Num::Int(-i32::from(b))
}

impl State {
    /// The value of a numeric expression.
    pub fn num(&mut self, p: &Code<'_>, e: &Expr) -> Result<Num> {
        match e {
            Expr::Int(n) => Ok(Num::Int(*n)),
            Expr::Real(x) => Ok(Num::Real(*x)),
            Expr::IntVar(slot) => self.int_var(*slot),
            Expr::RealVar(slot) => self.real_var(*slot),
            Expr::Op2(op, ab) => {
                let a = self.num(p, &ab.0)?;
                let b = self.num(p, &ab.1)?;
                self.op2(*op, a, b)
            }
            Expr::Compare(op, ab) => {
                let a = self.num(p, &ab.0)?;
                let b = self.num(p, &ab.1)?;
                let ints = matches!((a, b), (Num::Int(_), Num::Int(_)));
                self.cycles += if ints { 208 } else { 311 };
                if !ints {
                    if let Num::Int(_) = a {
                        self.cycles += work::LEFT_INT;
                    }
                    let sides = (Num::Real(self.real_of(a)), Num::Real(self.real_of(b)));
                    return Ok(truth(holds(*op, order(sides.0, sides.1))));
                }
                Ok(truth(holds(*op, order(a, b))))
            }
            Expr::F1(f, x) => {
                let x = self.num(p, x)?;
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
            Expr::F0(f) => Ok(self.func0(*f)),
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

    #[inline]
    pub fn int(&mut self, p: &Code<'_>, e: &Expr) -> Result<i32> {
        let n = self.num(p, e)?;
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
        if array.dims.len() != index.len() {
            return Err(Error::Array);
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

    #[inline]
    pub fn op2(&mut self, op: Op2, a: Num, b: Num) -> Result<Num> {
        if let (Num::Int(x), Num::Int(y)) = (a, b) {
            return self.int_op2(op, x, y);
        }
        if matches!(op, Op2::IntDiv | Op2::Mod | Op2::And | Op2::Or | Op2::Eor) {
            let (x, y) = (self.whole(a)?, self.whole(b)?);
            return self.int_op2(op, x, y);
        }
        let (x, y) = (self.real_of(a), self.real_of(b));
        if let (Num::Int(_), Num::Real(_)) = (a, b) {
            self.cycles += work::LEFT_INT;
            if op == Op2::Mul {
                // It comes to be the side whose bits are scanned.
                return self.real_op2(op, y, x);
            }
        }
        self.real_op2(op, x, y)
    }

    /// `+ - * / ^` on reals.
    #[inline]
    fn real_op2(&mut self, op: Op2, x: Real40, y: Real40) -> Result<Num> {
        let (result, cost) = match op {
            Op2::Sub => {
                let difference = arith::sub(x, y)?;
                (difference, work::SUBTRACT + work::add(x, y, difference))
            }
            Op2::Mul => {
                let product = arith::mul(x, y)?;
                (product, work::mul(x, y, product))
            }
            Op2::Div => {
                let quotient = arith::div(x, y)?;
                (quotient, work::div(x, quotient))
            }
            Op2::Pow => (elementary::pow(x, y)?, work::pow(y)),
            _ => {
                let sum = arith::add(x, y)?;
                (sum, work::add(x, y, sum))
            }
        };
        self.cycles += u64::from(cost);
        Ok(Num::Real(result))
    }

    fn int_op2(&mut self, op: Op2, a: i32, b: i32) -> Result<Num> {
        let micro = self.config.dialect == Dialect::Micro;
        let real = |n| Real40::from_i32(n);
        self.cycles += u64::from(match op {
            Op2::Add => 117,
            Op2::Sub => 125,
            Op2::IntDiv | Op2::Mod => work::int_div(a, b),
            Op2::Mul => work::int_mul(a, b).unwrap_or(0),
            _ => 0,
        });
        Ok(Num::Int(match op {
            Op2::Add => match a.checked_add(b) {
                Some(sum) => sum,
                None if micro => a.wrapping_add(b),
                None => return Ok(Num::Real(arith::add(real(a), real(b))?)),
            },
            Op2::Sub => match a.checked_sub(b) {
                Some(difference) => difference,
                None if micro => a.wrapping_sub(b),
                None => return Ok(Num::Real(arith::sub(real(a), real(b))?)),
            },
            Op2::Mul if work::int_mul(a, b).is_some() => a.wrapping_mul(b),
            // Too long for the ROM's product of 16 bits: real from here on.
            Op2::Mul | Op2::Div | Op2::Pow => {
                let (x, y) = (self.real_of(Num::Int(a)), self.real_of(Num::Int(b)));
                return self.real_op2(op, x, y);
            }
            Op2::IntDiv | Op2::Mod if b == 0 => match self.config.dialect {
                // Measured on the Z80 interpreters: -1, and no error.
                Dialect::Agon => -1,
                _ => return Err(Error::DivisionByZero),
            },
            Op2::IntDiv => a.wrapping_div(b),
            Op2::Mod => a.wrapping_rem(b),
            Op2::And => a & b,
            Op2::Or => a | b,
            Op2::Eor => a ^ b,
        }))
    }

    fn func1(&mut self, f: Func1, x: Num) -> Result<Num> {
        Ok(match f {
            Func1::Neg => match x {
                Num::Int(n) => Num::Int(n.wrapping_neg()),
                Num::Real(x) => Num::Real(x.negate()),
            },
            Func1::Plus => x,
            Func1::Abs => match x {
                Num::Int(n) => Num::Int(n.wrapping_abs()),
                Num::Real(x) => Num::Real(x.abs()),
            },
            Func1::Int => match x {
                Num::Int(n) => Num::Int(n),
                Num::Real(x) => {
                    self.cycles += u64::from(work::floor(x));
                    Num::Int(x.int_floor()?)
                }
            },
            Func1::Sgn => match x {
                Num::Int(n) => Num::Int(n.signum()),
                Num::Real(x) => Num::Int(x.signum()),
            },
            Func1::Sqr => Num::Real(arith::sqrt(self.real_of(x))?),
            Func1::Byte => Num::Int(i32::from(self.byte(x.int()? as u16))),
            Func1::Word => Num::Int(self.word(x.int()? as u16)),
            Func1::Not => Num::Int(!x.int()?),
            Func1::Sin | Func1::Cos | Func1::Tan | Func1::Atn | Func1::Exp | Func1::Ln => {
                let x = self.real_of(x);
                return self.curve(f, x);
            }
            Func1::Asn => Num::Real(elementary::asn(self.real_of(x))?),
            Func1::Acs => Num::Real(elementary::acs(self.real_of(x))?),
            Func1::Log => Num::Real(elementary::log10(self.real_of(x))?),
            Func1::Deg => Num::Real(Real40::from_f64(x.real().to_f64().to_degrees())?),
            Func1::Rad => Num::Real(Real40::from_f64(x.real().to_f64().to_radians())?),
            Func1::Rnd => self.rnd_of(x)?,
            // No key is ever pressed: INKEY waits its hundredths and gives -1.
            Func1::Inkey => {
                let wait = x.int()?;
                if (0..32768).contains(&wait) {
                    self.cycles += wait as u64 * 20_000;
                    Num::Int(-1)
                } else {
                    Num::Int(0)
                }
            }
            Func1::Adval => Num::Int(0),
            Func1::Bget => {
                let channel = x.int()?;
                Num::Int(i32::from(self.files.get(channel)?))
            }
            Func1::Ext => Num::Int(self.files.length(x.int()?)? as i32),
            Func1::Ptr => Num::Int(self.files.position(x.int()?)? as i32),
            Func1::Eof => truth(self.files.at_end(x.int()?)?),
        })
    }

    /// The functions whose cost depends on their argument.
    fn curve(&mut self, f: Func1, x: Real40) -> Result<Num> {
        let (value, cost) = match f {
            Func1::Sin => (elementary::sin(x)?, work::quarter_turns(x, 0)),
            Func1::Cos => (elementary::cos(x)?, work::quarter_turns(x, 1)),
            Func1::Tan => (elementary::tan(x)?, work::beyond_one(x, 4_900)),
            Func1::Atn => (elementary::atn(x)?, work::beyond_one(x, 3_800)),
            Func1::Exp => (elementary::exp(x)?, work::exp(x)),
            _ => (elementary::ln(x)?, work::ln(x)),
        };
        self.cycles += u64::from(cost);
        Ok(Num::Real(value))
    }

    fn func0(&mut self, f: Func0) -> Num {
        Num::Int(match f {
            Func0::Rnd => self.rnd_word(),
            Func0::Time => self.time(),
            Func0::Himem => self.himem as i32,
            Func0::Lomem => self.lomem as i32,
            Func0::Page => self.page as i32,
            Func0::Top => self.top as i32,
            Func0::Err => i32::from(self.err),
            Func0::Erl => i32::from(self.erl),
            Func0::Count => self.count as i32,
            Func0::Pos => self.display.cursor().0 as i32,
            Func0::Vpos => self.display.cursor().1 as i32,
            // Nobody is at the keyboard: as if RETURN were pressed.
            Func0::Get => 13,
        })
    }

    /// One step of the machine's 33-bit shift register, 32 times.
    fn rnd_step(&mut self) {
        for _ in 0..32 {
            let r = &mut self.rnd;
            let carry = ((r[2] >> 3) ^ r[4]) & 1;
            let mut c = carry;
            for byte in r.iter_mut() {
                let out = *byte >> 7;
                *byte = *byte << 1 | c;
                c = out;
            }
        }
    }

    fn rnd_word(&mut self) -> i32 {
        self.rnd_step();
        i32::from_le_bytes([self.rnd[0], self.rnd[1], self.rnd[2], self.rnd[3]])
    }

    /// The register as a fraction: its bytes, lowest first, are the mantissa from the top.
    fn rnd_fraction(&self) -> Result<Real40> {
        let m = u32::from_be_bytes([self.rnd[0], self.rnd[1], self.rnd[2], self.rnd[3]]);
        Ok(Real40::from_f64(f64::from(m) / 4_294_967_296.0)?)
    }

    fn rnd_of(&mut self, x: Num) -> Result<Num> {
        let n = x.int()?;
        if n < 0 {
            let bytes = n.to_le_bytes();
            self.rnd = [bytes[0], bytes[1], bytes[2], bytes[3], 0x40];
            return Ok(Num::Int(n));
        }
        if n > 0 {
            self.rnd_step();
        }
        let fraction = self.rnd_fraction()?;
        if n <= 1 {
            return Ok(Num::Real(fraction));
        }
        self.cycles += 4_400;
        let scaled = arith::mul(fraction, Real40::from_i32(n))?;
        Ok(Num::Int(scaled.int_floor()? + 1))
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

#[inline]
fn order(a: Num, b: Num) -> Ordering {
    match (a, b) {
        (Num::Int(a), Num::Int(b)) => a.cmp(&b),
        (a, b) => a.real().compare(b.real()),
    }
}

#[inline]
fn holds(op: Compare, order: Ordering) -> bool {
    match op {
        Compare::Eq => order == Ordering::Equal,
        Compare::Ne => order != Ordering::Equal,
        Compare::Lt => order == Ordering::Less,
        Compare::Le => order != Ordering::Greater,
        Compare::Gt => order == Ordering::Greater,
        Compare::Ge => order != Ordering::Less,
    }
}
