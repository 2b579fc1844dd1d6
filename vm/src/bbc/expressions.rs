//! Reads expressions.
//!
//! The grammar is the ROM's, level by level: OR EOR; AND; comparisons; + -; * / DIV MOD; ^ (to
//! the left); then a factor. A unary minus belongs to its factor (-2^2 is 4), and a function
//! without brackets takes one factor (`SQR A*2` is `(SQR A)*2`). BASIC II takes one comparison
//! (1=1=1 ends before the second `=`) and one sign (--3 is no expression).

use slowlight_isa::basic_tokens::token as t;
use slowlight_isa::real40::text::{Parsed, parse};

use super::Dialect;
use super::ast::{Compare, Expr, Func1, FuncS, Kind, Op2};
use super::cost;
use super::cursor::Cursor;
use super::error::Error;

/// How deep expressions may nest. The machine has a stack of 256 bytes for this.
const DEEPEST: u8 = 64;

impl Cursor<'_> {
    /// A whole expression.
    pub fn expr(&mut self) -> Result<Expr, Error> {
        if self.depth >= DEEPEST {
            return Err(Error::TooDeep);
        }
        self.depth += 1;
        let result = self.or_level();
        self.depth -= 1;
        self.noted(result)
    }

    fn or_level(&mut self) -> Result<Expr, Error> {
        let mut left = self.and_level()?;
        loop {
            let op = match self.peek() {
                Some(t::OR) => Op2::Or,
                Some(t::EOR) => Op2::Eor,
                _ => return Ok(left),
            };
            self.at += 1;
            let right = self.and_level()?;
            left = Expr::Op2(op, Box::new((left, right)));
        }
    }

    fn and_level(&mut self) -> Result<Expr, Error> {
        let mut left = self.compare_level()?;
        while self.eat(t::AND) {
            let right = self.compare_level()?;
            left = Expr::Op2(Op2::And, Box::new((left, right)));
        }
        Ok(left)
    }

    fn compare_level(&mut self) -> Result<Expr, Error> {
        let mut left = self.add_level()?;
        loop {
            let first = match self.peek() {
                Some(c @ (b'<' | b'=' | b'>')) => c,
                _ => return Ok(left),
            };
            self.at += 1;
            let op = match (first, self.peek_raw()) {
                (b'<', Some(b'=')) => Compare::Le,
                (b'<', Some(b'>')) => Compare::Ne,
                (b'>', Some(b'=')) => Compare::Ge,
                (b'<', _) => Compare::Lt,
                (b'>', _) => Compare::Gt,
                _ => Compare::Eq,
            };
            if matches!(op, Compare::Le | Compare::Ne | Compare::Ge) {
                self.at += 1;
            }
            let right = self.add_level()?;
            let numbers = (left.is_string(), right.is_string()) == (Some(false), Some(false));
            let sides = Box::new((left, right));
            left = if numbers {
                Expr::Compare(op, sides)
            } else {
                Expr::CompareAny(op, sides)
            };
            if self.dialect == Dialect::Micro {
                return Ok(left);
            }
        }
    }

    fn add_level(&mut self) -> Result<Expr, Error> {
        let mut left = self.mul_level()?;
        loop {
            let op = match self.peek() {
                Some(b'+') => Op2::Add,
                Some(b'-') => Op2::Sub,
                _ => return Ok(left),
            };
            self.at += 1;
            let right = self.mul_level()?;
            let strings = left.is_string() != Some(false) || right.is_string() != Some(false);
            let sides = Box::new((left, right));
            left = if strings && op == Op2::Add {
                Expr::Concat(sides)
            } else {
                Expr::Op2(op, sides)
            };
        }
    }

    fn mul_level(&mut self) -> Result<Expr, Error> {
        let mut left = self.pow_level()?;
        loop {
            let op = match self.peek() {
                Some(b'*') => Op2::Mul,
                Some(b'/') => Op2::Div,
                Some(t::DIV) => Op2::IntDiv,
                Some(t::MOD) => Op2::Mod,
                _ => return Ok(left),
            };
            self.at += 1;
            let right = self.pow_level()?;
            left = Expr::Op2(op, Box::new((left, right)));
        }
    }

    fn pow_level(&mut self) -> Result<Expr, Error> {
        let mut left = self.factor()?;
        while self.eat(b'^') {
            let right = self.factor()?;
            left = Expr::Op2(Op2::Pow, Box::new((left, right)));
        }
        Ok(left)
    }

    /// An operand with its unary operators.
    pub fn factor(&mut self) -> Result<Expr, Error> {
        if self.depth >= DEEPEST {
            return Err(Error::TooDeep);
        }
        self.depth += 1;
        let result = self.factor_inner();
        self.depth -= 1;
        self.noted(result)
    }

    /// At the outermost level the tree is whole.
    fn noted(&self, mut result: Result<Expr, Error>) -> Result<Expr, Error> {
        if let (0, Ok(e)) = (self.depth, &mut result) {
            e.note_depth(0);
        }
        result
    }

    fn factor_inner(&mut self) -> Result<Expr, Error> {
        let c = self.peek().ok_or(Error::NoSuchVariable)?;
        match c {
            b'0'..=b'9' | b'.' => self.number(),
            b'-' => self.signed(Func1::Neg),
            b'+' => self.signed(Func1::Plus),
            b'(' => {
                self.at += 1;
                let inner = self.expr()?;
                self.bracket()?;
                self.cost += cost::BRACKETS;
                Ok(inner)
            }
            b'&' => self.hex(),
            b'"' => self.quoted(),
            b'?' => self.func1(Func1::Byte),
            b'!' => self.func1(Func1::Word),
            b'$' => {
                self.at += 1;
                let address = self.factor()?;
                Ok(Expr::FS(FuncS::At, Box::new([address])))
            }
            c if c >= 0x80 => self.function(c),
            _ => self.variable_value(),
        }
    }

    /// A sign and its operand, which BASIC II has without a sign of its own and not quoted.
    fn signed(&mut self, f: Func1) -> Result<Expr, Error> {
        let sign = self.at;
        self.at += 1;
        let micro = self.dialect == Dialect::Micro;
        if micro && matches!(self.peek(), Some(b'-' | b'+' | b'"')) {
            return Err(Error::NoSuchVariable);
        }
        self.at = sign;
        self.func1(f)
    }

    fn variable_value(&mut self) -> Result<Expr, Error> {
        let (kind, slot) = self.variable().ok_or(Error::NoSuchVariable)?;
        let base = match kind {
            Kind::Int => Expr::IntVar(slot),
            Kind::Real => Expr::RealVar(slot),
            Kind::Str => return Ok(Expr::StrVar(slot)),
            _ => Expr::Element(kind, slot, self.subscripts()?),
        };
        if kind == Kind::Strs {
            return Ok(base);
        }
        match self.peek_raw() {
            Some(b'?') => {
                self.at += 1;
                Ok(Expr::ByteAt(Box::new((base, self.factor()?))))
            }
            Some(b'!') => {
                self.at += 1;
                Ok(Expr::WordAt(Box::new((base, self.factor()?))))
            }
            _ => Ok(base),
        }
    }

    fn number(&mut self) -> Result<Expr, Error> {
        let rest = self.text.get(self.at..).unwrap_or(&[]);
        let (value, used) = parse(rest)?.ok_or(Error::Syntax)?;
        self.cost += cost::literal(rest.get(..used).unwrap_or(&[]));
        self.at += used;
        Ok(match value {
            Parsed::Int(n) => Expr::Int(n),
            Parsed::Real(x) => Expr::Real(x),
        })
    }

    fn hex(&mut self) -> Result<Expr, Error> {
        self.at += 1;
        let mut value = 0u32;
        let mut digits = 0;
        while let Some(c) = self.peek_raw() {
            let digit = match c {
                b'0'..=b'9' => c - b'0',
                b'A'..=b'F' => c - b'A' + 10,
                _ => break,
            };
            value = value << 4 | u32::from(digit);
            digits += 1;
            self.at += 1;
        }
        if digits == 0 {
            return Err(Error::BadHex);
        }
        self.cost += cost::HEX + cost::HEX_DIGIT * digits;
        Ok(Expr::Int(value as i32))
    }

    fn quoted(&mut self) -> Result<Expr, Error> {
        self.at += 1;
        let mut string = Vec::new();
        loop {
            let c = self.peek_raw().ok_or(Error::MissingQuote)?;
            self.at += 1;
            if c == b'"' {
                if self.peek_raw() != Some(b'"') {
                    return Ok(Expr::Str(string.into()));
                }
                self.at += 1;
            }
            string.push(c);
        }
    }
}
