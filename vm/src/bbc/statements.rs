//! Reads the statements that do not change the flow within their line.

use slowlight_isa::basic_tokens::token as t;

use super::ast::{Ask, DimItem, Expr, Item, Kind, Place, Stmt};
use super::cost;
use super::decode::Decoder;
use super::error::Error;
use super::values::is_numeric;

impl Decoder<'_, '_> {
    /// One statement from its first token or letter.
    pub fn simple(&mut self) -> Result<Stmt, Error> {
        let c = &mut self.cursor;
        let Some(token) = c.peek() else {
            return Err(Error::Mistake);
        };
        if token < 0x80 {
            return self.letter_statement(token);
        }
        c.at += 1;
        Ok(match token {
            t::LET => {
                c.cost += cost::LET;
                return self.assignment();
            }
            t::PRINT => {
                if c.peek() == Some(b'#') {
                    let channel = c.channel()?;
                    return Ok(Stmt::PrintFile(channel, self.after_commas()?));
                }
                Stmt::Print(self.items()?)
            }
            t::GOTO => Stmt::Goto(self.target()?),
            t::GOSUB => Stmt::Gosub(self.target()?),
            t::RETURN => Stmt::Return,
            t::FOR => return self.for_statement(),
            t::NEXT => return self.next_statement(),
            t::UNTIL => Stmt::Until(c.expr()?),
            t::PROC => {
                let (slot, list) = c.call(Kind::Proc)?;
                Stmt::Proc(slot, list)
            }
            t::ENDPROC => Stmt::EndProc,
            t::LOCAL => Stmt::Local(self.places()?),
            t::DIM => return self.dim_statement(),
            t::READ => Stmt::Read(self.read_places()?),
            t::RESTORE => {
                if c.at_end() {
                    Stmt::Restore(None)
                } else {
                    Stmt::Restore(Some(self.target()?))
                }
            }
            t::INPUT => return self.input_statement(),
            t::BPUT => {
                let channel = c.channel()?;
                c.comma()?;
                Stmt::Bput(Box::new((channel, c.expr()?)))
            }
            t::CLOSE => Stmt::Close(c.channel()?),
            t::SET_PTR => {
                let channel = c.channel()?;
                Stmt::SetPtr(Box::new((channel, self.after_equals()?)))
            }
            t::SET_TIME => Stmt::SetTime(self.after_equals()?),
            t::SET_HIMEM => Stmt::SetHimem(self.after_equals()?),
            t::SET_LOMEM => Stmt::SetLomem(self.after_equals()?),
            t::SET_PAGE => Stmt::SetPage(self.after_equals()?),
            _ => return self.other(token),
        })
    }

    fn other(&mut self, token: u8) -> Result<Stmt, Error> {
        let c = &mut self.cursor;
        Ok(match token {
            t::MODE => Stmt::Mode(c.expr()?),
            t::VDU => return self.vdu_statement(),
            t::GCOL => Stmt::Gcol(Box::new(self.pair()?)),
            t::COLOUR => Stmt::Colour(c.expr()?),
            t::PLOT => {
                let k = c.expr()?;
                c.comma()?;
                let (x, y) = self.pair()?;
                Stmt::Plot(Box::new((k, x, y)))
            }
            t::MOVE => Stmt::PlotAs(4, Box::new(self.pair()?)),
            t::DRAW => Stmt::PlotAs(5, Box::new(self.pair()?)),
            t::CLS => Stmt::Cls,
            t::CLG => Stmt::Clg,
            t::CLEAR => Stmt::Clear,
            t::REPORT => Stmt::Report,
            t::WIDTH => Stmt::Width(c.expr()?),
            t::OSCLI => Stmt::OsCli(c.expr()?),
            t::END => Stmt::End,
            t::STOP => Stmt::Stop,
            t::SOUND => Stmt::Ignore(self.several(4)?),
            t::ENVELOPE => Stmt::Ignore(self.several(14)?),
            t::TRACE if c.eat(t::OFF) => Stmt::Trace(None),
            t::TRACE if c.eat(t::ON) => Stmt::Trace(Some(Expr::Int(0xffff))),
            t::TRACE => Stmt::Trace(Some(match c.line_number() {
                Some(number) => Expr::Int(i32::from(number)),
                None => c.expr()?,
            })),
            t::RUN => Stmt::Run,
            t::CALL | t::CHAIN => return Err(Error::NotHere),
            // LIST, NEW and such are for BASIC's prompt alone.
            _ => return Err(Error::Syntax),
        })
    }

    /// A statement that starts with a letter or sign: an assignment, `=`, `*`.
    fn letter_statement(&mut self, first: u8) -> Result<Stmt, Error> {
        let c = &mut self.cursor;
        match first {
            b'=' => {
                c.at += 1;
                Ok(Stmt::Result(c.expr()?))
            }
            b'*' => {
                let command = c.text.get(c.at + 1..).unwrap_or(&[]).into();
                c.at = c.text.len();
                Ok(Stmt::OsCli(Expr::Str(command)))
            }
            b'[' => Err(Error::NotHere),
            _ => self.assignment(),
        }
    }

    fn assignment(&mut self) -> Result<Stmt, Error> {
        let c = &mut self.cursor;
        let place = c.place()?.ok_or(Error::Syntax)?;
        if !c.eat(b'=') {
            return Err(Error::Mistake);
        }
        let value = c.expr()?;
        Ok(match place {
            Place::Int(slot) => Stmt::LetInt(slot, value),
            Place::Real(slot) => Stmt::LetReal(slot, value),
            place => Stmt::Let(place, value),
        })
    }

    fn pair(&mut self) -> Result<(Expr, Expr), Error> {
        let a = self.cursor.expr()?;
        self.cursor.comma()?;
        Ok((a, self.cursor.expr()?))
    }

    /// So many numbers, with commas between them.
    fn several(&mut self, count: usize) -> Result<Box<[Expr]>, Error> {
        let mut list = vec![self.cursor.expr()?];
        while list.len() < count {
            self.cursor.comma()?;
            list.push(self.cursor.expr()?);
        }
        Ok(list.into())
    }

    fn after_equals(&mut self) -> Result<Expr, Error> {
        if !self.cursor.eat(b'=') {
            return Err(Error::Mistake);
        }
        self.cursor.expr()
    }

    fn after_commas(&mut self) -> Result<Box<[Expr]>, Error> {
        let mut list = Vec::new();
        while self.cursor.eat(b',') {
            list.push(self.cursor.expr()?);
        }
        Ok(list.into())
    }

    fn places(&mut self) -> Result<Box<[Place]>, Error> {
        let mut list = Vec::new();
        loop {
            list.push(self.cursor.place()?.ok_or(Error::NoSuchVariable)?);
            if !self.cursor.eat(b',') {
                return Ok(list.into());
            }
        }
    }

    /// READ's variables: as many as there are.
    fn read_places(&mut self) -> Result<Box<[Place]>, Error> {
        let mut list = Vec::new();
        while let Some(place) = self.cursor.place()? {
            list.push(place);
            if !self.cursor.eat(b',') {
                break;
            }
        }
        Ok(list.into())
    }

    fn for_statement(&mut self) -> Result<Stmt, Error> {
        let c = &mut self.cursor;
        let place = c.place()?.ok_or(Error::ForVariable)?;
        if !is_numeric(&place) {
            return Err(Error::ForVariable);
        }
        if !c.eat(b'=') {
            return Err(Error::Mistake);
        }
        let from = c.expr()?;
        if !c.eat(t::TO) {
            return Err(Error::NoTo);
        }
        let to = c.expr()?;
        let step = if c.eat(t::STEP) {
            Some(c.expr()?)
        } else {
            None
        };
        Ok(Stmt::For(place, Box::new((from, to, step))))
    }

    fn next_statement(&mut self) -> Result<Stmt, Error> {
        let mut list = vec![self.cursor.place()?];
        while self.cursor.eat(b',') {
            list.push(self.cursor.place()?);
        }
        Ok(Stmt::Next(list.into()))
    }

    fn dim_statement(&mut self) -> Result<Stmt, Error> {
        let mut list = Vec::new();
        loop {
            let c = &mut self.cursor;
            let (kind, slot) = c.variable().ok_or(Error::BadDim)?;
            list.push(match kind {
                Kind::Ints | Kind::Reals | Kind::Strs => {
                    let bounds = c.subscripts().map_err(|e| match e {
                        Error::MissingBracket => Error::BadDim,
                        e => e,
                    })?;
                    DimItem::Array(kind, slot, bounds)
                }
                Kind::Int | Kind::Real => {
                    let place = if kind == Kind::Int {
                        Place::Int(slot)
                    } else {
                        Place::Real(slot)
                    };
                    DimItem::Block(place, c.expr()?)
                }
                _ => return Err(Error::BadDim),
            });
            if !self.cursor.eat(b',') {
                return Ok(Stmt::Dim(list.into()));
            }
        }
    }

    fn input_statement(&mut self) -> Result<Stmt, Error> {
        let c = &mut self.cursor;
        if c.peek() == Some(b'#') {
            let channel = c.channel()?;
            let mut list = Vec::new();
            while c.eat(b',') {
                list.push(c.place()?.ok_or(Error::NoSuchVariable)?);
            }
            return Ok(Stmt::InputFile(channel, list.into()));
        }
        let whole = c.eat(t::LINE);
        let mut list = Vec::new();
        while !self.cursor.at_end() {
            let c = &mut self.cursor;
            let first = c.peek();
            let start = c.at;
            let ask = match first {
                Some(b'"') => match c.factor() {
                    Ok(prompt) => Ask::Print(Item::Value(prompt)),
                    // What there is of it is printed first.
                    Err(e) => {
                        let text = c.text.get(start + 1..).unwrap_or(&[]);
                        list.push(Ask::Print(Item::Value(Expr::Str(text.into()))));
                        c.at = c.text.len();
                        Ask::Print(Item::Value(Expr::Bad(e)))
                    }
                },
                Some(b',' | b';') => {
                    c.at += 1;
                    Ask::Separator
                }
                Some(b'\'') => {
                    c.at += 1;
                    Ask::Print(Item::NewLine)
                }
                Some(t::TAB | t::SPC) => Ask::Print(self.tab()?),
                _ => match c.place()? {
                    Some(place) => Ask::Read(place),
                    None => break,
                },
            };
            list.push(ask);
        }
        Ok(Stmt::Input(list.into(), whole))
    }

    fn tab(&mut self) -> Result<Item, Error> {
        let token = self.cursor.peek();
        self.cursor.at += 1;
        let c = &mut self.cursor;
        if token == Some(t::SPC) {
            return Ok(Item::Spc(c.factor()?));
        }
        let x = c.expr()?;
        if c.eat(b')') {
            return Ok(Item::Tab(x));
        }
        c.comma()?;
        let y = c.expr()?;
        c.bracket()?;
        Ok(Item::TabXy(x, y))
    }

    fn items(&mut self) -> Result<Box<[Item]>, Error> {
        let mut list = Vec::new();
        while !self.cursor.at_end() {
            let c = &mut self.cursor;
            list.push(match c.peek() {
                Some(b',') => {
                    c.at += 1;
                    Item::Comma
                }
                Some(b';') => {
                    c.at += 1;
                    Item::Semicolon
                }
                Some(b'\'') => {
                    c.at += 1;
                    Item::NewLine
                }
                Some(b'~') => {
                    c.at += 1;
                    Item::Hex
                }
                Some(t::TAB | t::SPC) => self.tab()?,
                _ => match c.expr() {
                    Ok(e) => Item::Value(e),
                    // What stands before the error is printed first.
                    Err(e) => {
                        list.push(Item::Value(Expr::Bad(e)));
                        c.skip_to_else();
                        return Ok(list.into());
                    }
                },
            });
        }
        Ok(list.into())
    }

    fn vdu_statement(&mut self) -> Result<Stmt, Error> {
        let mut list = Vec::new();
        let c = &mut self.cursor;
        while !c.at_end() {
            let e = c.expr().unwrap_or_else(|e| {
                // What stands before the error is sent first.
                c.skip_to_else();
                Expr::Bad(e)
            });
            let word = c.eat(b';');
            list.push((e, word));
            if !word {
                c.eat(b',');
            }
        }
        Ok(Stmt::Vdu(list.into()))
    }
}
