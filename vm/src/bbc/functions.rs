//! Reads the built-in functions, and calls of the program's own.

use slowlight_isa::basic_tokens::token as t;

use super::ast::{Expr, Func0, Func1, FuncS, Kind, Slot};
use super::cost;
use super::cursor::Cursor;
use super::error::Error;

impl Cursor<'_> {
    pub fn func1(&mut self, f: Func1) -> Result<Expr, Error> {
        self.at += 1;
        let argument = self.factor()?;
        Ok(match (f, argument) {
            // A negative literal costs as much but is one value.
            (Func1::Neg, Expr::Int(n)) => {
                self.cost += cost::NEGATE;
                Expr::Int(n.wrapping_neg())
            }
            (f, argument) => Expr::F1(f, Box::new(argument)),
        })
    }

    /// `#channel`.
    pub fn channel(&mut self) -> Result<Expr, Error> {
        if self.eat(b'#') {
            self.factor()
        } else {
            Err(Error::MissingHash)
        }
    }

    fn on_channel(&mut self, f: Func1) -> Result<Expr, Error> {
        let channel = self.channel()?;
        Ok(Expr::F1(f, Box::new(channel)))
    }

    pub fn function(&mut self, token: u8) -> Result<Expr, Error> {
        let f1 = match token {
            t::ABS => Func1::Abs,
            t::ACS => Func1::Acs,
            t::ASN => Func1::Asn,
            t::ATN => Func1::Atn,
            t::COS => Func1::Cos,
            t::DEG => Func1::Deg,
            t::EXP => Func1::Exp,
            t::INT => Func1::Int,
            t::LN => Func1::Ln,
            t::LOG => Func1::Log,
            t::NOT => Func1::Not,
            t::RAD => Func1::Rad,
            t::SGN => Func1::Sgn,
            t::SIN => Func1::Sin,
            t::SQR => Func1::Sqr,
            t::TAN => Func1::Tan,
            t::INKEY => Func1::Inkey,
            t::ADVAL => Func1::Adval,
            _ => return self.other_function(token),
        };
        self.func1(f1)
    }

    fn constant(&mut self, cost: u32, value: Expr) -> Expr {
        self.cost += cost;
        value
    }

    fn other_function(&mut self, token: u8) -> Result<Expr, Error> {
        self.at += 1;
        let f0 = match token {
            t::TRUE => return Ok(self.constant(cost::TRUE, Expr::Int(-1))),
            t::FALSE => return Ok(self.constant(cost::FALSE, Expr::Int(0))),
            t::PI => return Ok(self.constant(cost::PI, Expr::Real(super::PI))),
            t::TIME => Func0::Time,
            t::HIMEM => Func0::Himem,
            t::LOMEM => Func0::Lomem,
            t::PAGE => Func0::Page,
            t::ERR => Func0::Err,
            t::ERL => Func0::Erl,
            t::COUNT => Func0::Count,
            t::POS => Func0::Pos,
            t::VPOS => Func0::Vpos,
            t::GET => Func0::Get,
            t::TO if self.peek_raw() == Some(b'P') => {
                self.at += 1;
                Func0::Top
            }
            t::BGET => return self.on_channel(Func1::Bget),
            t::EXT => return self.on_channel(Func1::Ext),
            t::PTR => return self.on_channel(Func1::Ptr),
            t::EOF => return self.on_channel(Func1::Eof),
            t::RND => {
                if self.peek_raw() != Some(b'(') {
                    Func0::Rnd
                } else {
                    let argument = self.factor()?;
                    return Ok(Expr::F1(Func1::Rnd, Box::new(argument)));
                }
            }
            t::FN => return self.fn_call(),
            t::USR => {
                self.factor()?;
                return Err(Error::NotHere);
            }
            _ => return self.string_function(token),
        };
        Ok(Expr::F0(f0))
    }

    fn fn_call(&mut self) -> Result<Expr, Error> {
        let (slot, arguments) = self.call(Kind::Fn)?;
        Ok(Expr::Fn(slot, arguments, 0))
    }

    /// Name and arguments after FN or PROC.
    pub fn call(&mut self, kind: Kind) -> Result<(Slot, Box<[Expr]>), Error> {
        let name = self.word();
        if name.is_empty() {
            return Err(Error::BadCall);
        }
        self.cost += cost::name(name.len(), false);
        let slot = self.names.slot(kind, name);
        let mut arguments = Vec::new();
        if self.peek_raw() == Some(b'(') {
            self.at += 1;
            // What is wrong with one comes to be known when it is evaluated.
            if let Err(e) = self.arguments(&mut arguments) {
                arguments.push(Expr::Bad(e));
                self.skip_to_else();
            }
        }
        Ok((slot, arguments.into()))
    }

    /// Expressions up to a closing bracket, as far as they go.
    pub fn arguments(&mut self, list: &mut Vec<Expr>) -> Result<(), Error> {
        list.push(self.expr()?);
        while self.eat(b',') {
            list.push(self.expr()?);
        }
        self.bracket()
    }

    fn string_function(&mut self, token: u8) -> Result<Expr, Error> {
        let one = match token {
            t::ASC => FuncS::Asc,
            t::LEN => FuncS::Len,
            t::VAL => FuncS::Val,
            t::EVAL => FuncS::Eval,
            t::OPENIN => FuncS::Openin,
            t::OPENOUT => FuncS::Openout,
            t::OPENUP => FuncS::Openup,
            t::CHR_STR => FuncS::Chr,
            t::INKEY_STR => FuncS::Inkey,
            t::GET_STR => return Ok(Expr::FS(FuncS::Get, Box::default())),
            t::STR_STR => {
                if self.eat(b'~') {
                    FuncS::StrHex
                } else {
                    FuncS::Str
                }
            }
            t::INSTR => return self.listed(FuncS::Instr, 2, 3),
            t::POINT => return self.listed(FuncS::Point, 2, 2),
            t::LEFT_STR => return self.listed(FuncS::Left, 2, 2),
            t::RIGHT_STR => return self.listed(FuncS::Right, 2, 2),
            t::MID_STR => return self.listed(FuncS::Mid, 2, 3),
            t::STRING_STR => return self.listed(FuncS::Strings, 2, 2),
            _ => {
                // It may be an ELSE, which an IF before it wants to find.
                self.at -= 1;
                return Err(Error::NoSuchVariable);
            }
        };
        let argument = self.factor()?;
        Ok(Expr::FS(one, Box::new([argument])))
    }

    /// A function whose token includes its opening bracket.
    fn listed(&mut self, f: FuncS, least: usize, most: usize) -> Result<Expr, Error> {
        let mut list = vec![self.expr()?];
        while list.len() < most {
            if list.len() < least {
                self.comma()?;
            } else if !self.eat(b',') {
                break;
            }
            list.push(self.expr()?);
        }
        self.bracket()?;
        Ok(Expr::FS(f, list.into()))
    }
}
