//! Functions of one number and of none.

use slowlight_isa::real40::{Real40, arith, elementary};

use super::arithmetic::truth;
use super::ast::{Func0, Func1};
use super::error::Error;
use super::state::State;
use super::values::Num;
use super::work;

type Result<T> = std::result::Result<T, Error>;

impl State {
    pub fn func1(&mut self, f: Func1, x: Num) -> Result<Num> {
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
            Func1::Deg => Num::Real(arith::mul(self.real_of(x), super::DEGREES)?),
            Func1::Rad => Num::Real(arith::mul(self.real_of(x), super::RADIANS)?),
            Func1::Rnd => self.rnd_of(x)?,
            Func1::Inkey => match x.int()? {
                wait @ 0..32768 => Num::Int(self.inkey(wait as u32)?.map_or(-1, i32::from)),
                key @ -128..0 => truth(self.held((-1 - key) as u8)?),
                // OS 1.20 is -1.
                other => truth(other as u8 == 0),
            },
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

    pub fn func0(&mut self, f: Func0) -> Result<Num> {
        Ok(Num::Int(match f {
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
            Func0::Get => i32::from(self.get("GET")?),
        }))
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
}
