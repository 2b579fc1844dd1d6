//! Evaluates what may be a string, and the functions with strings among their arguments.

use slowlight_isa::real40::text::{NumberFormat, Parsed, parse, to_text};

use super::ast::{Expr, FuncS, Kind};
use super::code::Code;
use super::cursor::Cursor;
use super::error::Error;
use super::state::State;
use super::tokenise::tokenise_line;
use super::values::{Elements, Num, Value};
use super::work::{self, text};

type Result<T> = std::result::Result<T, Error>;

fn number(n: impl TryInto<i32>) -> Value {
    Value::Num(Num::Int(n.try_into().unwrap_or(i32::MAX)))
}

/// A number as text; integers as exactly as reals.
pub(crate) fn number_text(n: Num, format: NumberFormat) -> String {
    to_text(n.real(), format)
}

/// VAL: the number at the start of a string, 0 if there is none.
pub(crate) fn val(text: &[u8]) -> Result<Num> {
    let start = text.iter().take_while(|c| **c == b' ').count();
    let text = text.get(start..).unwrap_or(&[]);
    let (negative, digits) = match text.first() {
        Some(b'-') => (true, text.get(1..).unwrap_or(&[])),
        Some(b'+') => (false, text.get(1..).unwrap_or(&[])),
        _ => (false, text),
    };
    let spaces = digits.iter().take_while(|c| **c == b' ').count();
    Ok(match parse(digits.get(spaces..).unwrap_or(&[]))? {
        None => Num::Int(0),
        Some((Parsed::Int(n), _)) => Num::Int(if negative { -n } else { n }),
        Some((Parsed::Real(x), _)) => Num::Real(if negative { x.negate() } else { x }),
    })
}

/// What reading the number costs.
pub(crate) fn val_cost(text: &[u8]) -> u64 {
    let digit = |c: &&u8| c.is_ascii_digit() || matches!(c, b'.' | b'E' | b'-' | b'+');
    let length = text.iter().take_while(digit).count();
    u64::from(super::cost::literal(text.get(..length).unwrap_or(&[])))
}

impl State {
    /// The value of any expression.
    pub fn value(&mut self, p: &Code<'_>, e: &Expr) -> Result<Value> {
        match e {
            Expr::Str(s) => Ok(Value::Str(s.to_vec())),
            Expr::StrVar(slot) => {
                let v = self
                    .texts
                    .get(*slot as usize)
                    .ok_or(Error::NoSuchVariable)?;
                if !v.defined {
                    return Err(Error::NoSuchVariable);
                }
                self.cycles += u64::from(v.lookup) + text::READ * v.value.len() as u64;
                Ok(Value::Str(v.value.clone()))
            }
            Expr::Element(Kind::Strs, slot, index) => {
                let at = self.subscript(p, Kind::Strs, *slot, index)?;
                match &self.array(Kind::Strs, *slot)?.elements {
                    Elements::Str(v) => v.get(at).cloned().map(Value::Str).ok_or(Error::Subscript),
                    _ => Err(Error::TypeMismatch),
                }
            }
            Expr::FS(f, list) => self.string_function(p, *f, list),
            Expr::Concat(ab) => match (self.value(p, &ab.0)?, self.value(p, &ab.1)?) {
                (Value::Str(mut a), Value::Str(b)) => {
                    self.cycles += text::JOINED * b.len() as u64;
                    if a.len() + b.len() > 255 {
                        return Err(Error::StringTooLong);
                    }
                    a.extend(b);
                    Ok(Value::Str(a))
                }
                (Value::Num(a), Value::Num(b)) => Ok(Value::Num(self.add(a, b)?)),
                _ => Err(Error::TypeMismatch),
            },
            Expr::CompareAny(op, ab) => Ok(Value::Num(self.compare_any(p, *op, &ab.0, &ab.1)?)),
            Expr::Fn(slot, list, depth) => self.call_function(p, *slot, list, *depth),
            _ => Ok(Value::Num(self.num(p, e)?)),
        }
    }

    /// The value of a string expression.
    pub fn string(&mut self, p: &Code<'_>, e: &Expr) -> Result<Vec<u8>> {
        match self.value(p, e)? {
            Value::Str(s) => Ok(s),
            Value::Num(_) => Err(Error::TypeMismatch),
        }
    }

    fn string_function(&mut self, p: &Code<'_>, f: FuncS, list: &[Expr]) -> Result<Value> {
        let first = list.first().unwrap_or(&Expr::Bad(Error::Syntax));
        Ok(match f {
            FuncS::Asc => match self.string(p, first)?.first() {
                Some(c) => number(*c),
                None => number(-1),
            },
            FuncS::Len => number(self.string(p, first)?.len()),
            FuncS::Val => {
                let s = self.string(p, first)?;
                self.cycles += val_cost(&s);
                Value::Num(val(&s)?)
            }
            FuncS::Eval => return self.eval(p, first),
            FuncS::Instr => self.instr(p, list)?,
            FuncS::Point => Value::Num(self.point(p, list)?),
            FuncS::Openin | FuncS::Openup => {
                let name = self.string(p, first)?;
                number(self.files.open(&name))
            }
            FuncS::Openout => {
                let name = self.string(p, first)?;
                number(self.files.create(&name))
            }
            FuncS::Chr => Value::Str(vec![self.int(p, first)? as u8]),
            FuncS::Str => {
                let n = self.num(p, first)?;
                let x = self.real_of(n);
                self.cycles += u64::from(work::number_text(x));
                let at = self.at_percent();
                // Only a set top byte makes STR$ follow @%.
                let format = if at as u32 >> 24 != 0 {
                    NumberFormat::from_at_percent(at)
                } else {
                    NumberFormat::STR
                };
                Value::Str(number_text(n, format).into_bytes())
            }
            FuncS::StrHex => Value::Str(format!("{:X}", self.int(p, first)?).into_bytes()),
            FuncS::Left | FuncS::Right | FuncS::Mid => self.part(p, f, list)?,
            FuncS::Strings => self.repeated(p, list)?,
            FuncS::Get => Value::Str(vec![self.get("GET$")?]),
            FuncS::Inkey => {
                let wait = self.int(p, first)?.clamp(0, 32767);
                Value::Str(self.inkey(wait as u32)?.into_iter().collect())
            }
            FuncS::At => {
                let address = self.address(p, first)?;
                Value::Str(self.text_at(address)?)
            }
        })
    }

    /// The string in memory at an address, up to a carriage return; none within 255 bytes is "".
    pub fn text_at(&self, address: u16) -> Result<Vec<u8>> {
        if address < 0x100 {
            return Err(Error::StringRange);
        }
        let bytes = (0..256u16).map(|i| self.byte(address.wrapping_add(i)));
        let string: Vec<u8> = bytes.take_while(|c| *c != 13).collect();
        Ok(if string.len() < 256 {
            string
        } else {
            Vec::new()
        })
    }

    /// The value of @%.
    pub fn at_percent(&self) -> i32 {
        self.ints.first().map_or(0x90a, |v| v.value)
    }

    fn add(&mut self, a: Num, b: Num) -> Result<Num> {
        self.op2(super::ast::Op2::Add, a, b)
    }

    /// EVAL: tokenises and reads the string as an expression.
    fn eval(&mut self, p: &Code<'_>, e: &Expr) -> Result<Value> {
        let text = self.string(p, e)?;
        self.cycles += 100 * text.len() as u64;
        Ok(self.evaluate(p, &tokenise_line(&text, false))?.0)
    }

    /// The value of the expression at the start of a text in tokens, and how many bytes it takes.
    pub fn evaluate(&mut self, p: &Code<'_>, tokens: &[u8]) -> Result<(Value, usize)> {
        let mut cursor = Cursor::new(tokens, self.config.dialect, &mut self.names);
        let parsed = cursor.expr();
        let (cost, used) = (cursor.cost, cursor.at);
        self.fit_names();
        let parsed = parsed?;
        self.cycles += u64::from(cost + super::cost::expr(&parsed));
        // An EVAL in an EVAL nests the host's stack, as a function does.
        self.host += 2_000;
        if self.host > super::state::HOST_STACK {
            return Err(Error::NoRoom);
        }
        let value = self.value(p, &parsed)?;
        self.host -= 2_000;
        Ok((value, used))
    }

    fn instr(&mut self, p: &Code<'_>, list: &[Expr]) -> Result<Value> {
        let [a, b, rest @ ..] = list else {
            return Err(Error::MissingComma);
        };
        let hay = self.string(p, a)?;
        let needle = self.string(p, b)?;
        let from = match rest.first() {
            Some(e) => usize::from((self.int(p, e)? as u8).max(1) - 1),
            None => 0,
        };
        if needle.is_empty() {
            return Ok(number(if from <= hay.len() { from + 1 } else { 0 }));
        }
        let found = hay
            .get(from..)
            .and_then(|h| h.windows(needle.len()).position(|w| w == needle));
        let passed = found.unwrap_or_else(|| hay.len().saturating_sub(from));
        self.cycles += text::SEARCHED * passed as u64 + text::HAY * hay.len() as u64;
        Ok(number(found.map_or(0, |i| from + i + 1)))
    }

    fn part(&mut self, p: &Code<'_>, f: FuncS, list: &[Expr]) -> Result<Value> {
        let [e, n, rest @ ..] = list else {
            return Err(Error::MissingComma);
        };
        let s = self.string(p, e)?;
        self.cycles += text::PART * s.len() as u64;
        // Counts are single bytes in the ROM.
        let n = usize::from(self.int(p, n)? as u8);
        let part = match f {
            FuncS::Left => s.get(..n).unwrap_or(&s),
            FuncS::Right => s.get(s.len().saturating_sub(n)..).unwrap_or(&s),
            _ => {
                let tail = s.get(n.max(1) - 1..).unwrap_or(&[]);
                match rest.first() {
                    Some(e) => {
                        let count = usize::from(self.int(p, e)? as u8);
                        tail.get(..count).unwrap_or(tail)
                    }
                    None => tail,
                }
            }
        };
        Ok(Value::Str(part.to_vec()))
    }

    fn repeated(&mut self, p: &Code<'_>, list: &[Expr]) -> Result<Value> {
        let [n, e] = list else {
            return Err(Error::MissingComma);
        };
        let n = usize::from(self.int(p, n)? as u8);
        let s = self.string(p, e)?;
        self.cycles += text::REPEATED * (n * s.len()) as u64;
        if n * s.len() > 255 {
            return Err(Error::StringTooLong);
        }
        Ok(Value::Str(s.repeat(n)))
    }
}
