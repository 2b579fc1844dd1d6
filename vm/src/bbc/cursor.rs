//! Walks over the text of a tokenised line: bytes, words, variables, and what can be assigned
//! to. `expressions` reads whole expressions from it.

use slowlight_isa::basic_tokens::{LINE_NUMBER, decode_line, token as t};

use super::Dialect;
use super::ast::{Expr, Kind, Op2, Place, Slot};
use super::cost;
use super::error::Error;
use super::names::Names;

pub(crate) struct Cursor<'a> {
    pub text: &'a [u8],
    pub at: usize,
    pub names: &'a mut Names,
    /// Whose grammar.
    pub dialect: Dialect,
    /// Cycles that depend on how the text is written: digits, long names, spaces.
    pub cost: u32,
    /// How many expressions and factors are being read, each inside the one before.
    pub depth: u8,
}

impl<'a> Cursor<'a> {
    pub fn new(text: &'a [u8], dialect: Dialect, names: &'a mut Names) -> Self {
        Self {
            text,
            at: 0,
            names,
            dialect,
            cost: 0,
            depth: 0,
        }
    }

    pub fn peek_raw(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    /// The next byte that is not a space, without taking it.
    pub fn peek(&mut self) -> Option<u8> {
        while self.peek_raw() == Some(b' ') {
            self.at += 1;
            self.cost += cost::SPACE;
        }
        self.peek_raw()
    }

    /// Takes the next byte if it is `want` (after spaces).
    pub fn eat(&mut self, want: u8) -> bool {
        let found = self.peek() == Some(want);
        self.at += usize::from(found);
        found
    }

    pub fn comma(&mut self) -> Result<(), Error> {
        if self.eat(b',') {
            Ok(())
        } else {
            Err(Error::MissingComma)
        }
    }

    pub fn bracket(&mut self) -> Result<(), Error> {
        if self.eat(b')') {
            Ok(())
        } else {
            Err(Error::MissingBracket)
        }
    }

    /// At the end of a statement: the line's end, a colon or ELSE?
    pub fn at_end(&mut self) -> bool {
        matches!(self.peek(), None | Some(b':' | t::ELSE))
    }

    /// To the next ELSE, or to the line's end.
    pub fn skip_to_else(&mut self) {
        let rest = self.text.get(self.at..).unwrap_or(&[]);
        let passed = rest.iter().position(|c| *c == t::ELSE);
        self.at += passed.unwrap_or(rest.len());
    }

    /// An encoded line number.
    pub fn line_number(&mut self) -> Option<u16> {
        if self.peek() != Some(LINE_NUMBER) {
            return None;
        }
        let bytes = self.text.get(self.at + 1..self.at + 4)?;
        self.at += 4;
        Some(decode_line([bytes[0], bytes[1], bytes[2]]))
    }

    /// The letters, digits and `_` from here; perhaps none.
    pub fn word(&mut self) -> &'a [u8] {
        let text = self.text;
        let rest = text.get(self.at..).unwrap_or(&[]);
        let length = rest
            .iter()
            .take_while(|c| c.is_ascii_alphanumeric() || matches!(c, b'_' | b'`'))
            .count();
        self.at += length;
        rest.get(..length).unwrap_or(&[])
    }

    /// A variable's name and kind, if one starts here; with `(` taken for an array.
    pub fn variable(&mut self) -> Option<(Kind, Slot)> {
        let first = self.peek()?;
        if first == b'@' && self.text.get(self.at + 1) == Some(&b'%') {
            self.at += 2;
            return Some((Kind::Int, 0));
        }
        if !(first.is_ascii_alphabetic() || matches!(first, b'_' | b'`')) {
            return None;
        }
        let name = self.word();
        let (scalar, array) = match self.peek_raw() {
            Some(b'%') => (Kind::Int, Kind::Ints),
            Some(b'$') => (Kind::Str, Kind::Strs),
            _ => (Kind::Real, Kind::Reals),
        };
        self.at += usize::from(scalar != Kind::Real);
        let kind = if self.peek_raw() == Some(b'(') {
            self.at += 1;
            array
        } else {
            scalar
        };
        let resident = kind == Kind::Int && name.len() == 1 && name[0].is_ascii_uppercase();
        if !resident {
            self.cost += cost::name(name.len(), kind == Kind::Real);
        }
        Some((kind, self.names.slot(kind, name)))
    }

    /// Subscripts after an array's `(`, with the closing bracket.
    pub fn subscripts(&mut self) -> Result<Box<[Expr]>, Error> {
        let mut list = Vec::new();
        self.arguments(&mut list)?;
        Ok(list.into())
    }

    /// Something that can be assigned to, if one starts here.
    pub fn place(&mut self) -> Result<Option<Place>, Error> {
        match self.peek() {
            Some(b'?') => {
                self.at += 1;
                self.cost += cost::PREFIX;
                return Ok(Some(Place::Byte(self.factor()?)));
            }
            Some(b'!') => {
                self.at += 1;
                self.cost += cost::PREFIX;
                return Ok(Some(Place::Word(self.factor()?)));
            }
            Some(b'$') => {
                self.at += 1;
                return Ok(Some(Place::Text(self.factor()?)));
            }
            _ => {}
        }
        let Some((kind, slot)) = self.variable() else {
            return Ok(None);
        };
        let place = match kind {
            Kind::Int => Place::Int(slot),
            Kind::Real => Place::Real(slot),
            Kind::Str => return Ok(Some(Place::Str(slot))),
            _ => Place::Element(kind, slot, self.subscripts()?),
        };
        if kind == Kind::Strs {
            return Ok(Some(place));
        }
        let base = |place| match place {
            Place::Int(slot) => Expr::IntVar(slot),
            Place::Real(slot) => Expr::RealVar(slot),
            Place::Element(kind, slot, index) => Expr::Element(kind, slot, index),
            _ => Expr::Bad(Error::Mistake),
        };
        Ok(Some(match self.peek_raw() {
            Some(b'?') => {
                self.at += 1;
                let offset = self.factor()?;
                Place::Byte(Expr::Op2(Op2::Add, Box::new((base(place), offset))))
            }
            Some(b'!') => {
                self.at += 1;
                let offset = self.factor()?;
                Place::Word(Expr::Op2(Op2::Add, Box::new((base(place), offset))))
            }
            _ => place,
        }))
    }
}
