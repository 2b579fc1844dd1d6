//! Tokenised program to [`Program`]: cuts lines into statements.
//!
//! Control flow within a line is flat, as in the ROM: IF jumps to what stands after the first
//! ELSE on the line when it is false; an ELSE reached from above skips the rest of the line.

use slowlight_isa::basic_tokens::token as t;

use super::Dialect;
use super::ast::{Expr, Kind, Place, Stmt, Target};
use super::cost;
use super::cursor::Cursor;
use super::error::Error;
use super::names::Names;
use super::program::{DataLine, Def, Line, Op, Program, Statement};
use super::tokenise::RawLine;

/// Decodes all lines. Never fails: what is wrong is raised when it is reached.
pub(crate) fn decode(lines: &[RawLine<'_>], dialect: Dialect, names: &mut Names) -> Program {
    let mut program = Program::default();
    for (index, line) in lines.iter().enumerate() {
        program.lines.push(Line {
            number: line.number,
            op: program.ops.len() as u32,
        });
        let mut decoder = Decoder {
            cursor: Cursor::new(line.text, dialect, names),
            lines,
            line: index as u32,
            program: &mut program,
            waiting: Vec::new(),
        };
        decoder.cursor.cost = cost::LINE;
        decoder.begin();
        decoder.line();
    }
    program.ops.push(Op {
        stmt: Stmt::End,
        cost: 0,
        line: lines.len().saturating_sub(1) as u32,
        statement: program.statements.len().saturating_sub(1) as u32,
    });
    program.fns.resize(names.count(Kind::Fn), None);
    program.procs.resize(names.count(Kind::Proc), None);
    program
}

/// Makes a statement that goes on where it should end what is carried out of it: nothing, but for
/// what the ROM does before it looks.
fn cut_short(stmt: &mut Stmt) {
    let bad = Expr::Bad(Error::Syntax);
    match stmt {
        Stmt::Read(_) | Stmt::Input(..) | Stmt::Proc(..) => {}
        Stmt::Goto(Target::Missing) | Stmt::Gosub(Target::Missing) => {}
        Stmt::LetInt(_, e) | Stmt::LetReal(_, e) | Stmt::Let(_, e) | Stmt::Result(e) => *e = bad,
        other => *other = Stmt::Bad(Error::Syntax),
    }
}

pub(crate) struct Decoder<'a, 'b> {
    pub cursor: Cursor<'a>,
    lines: &'b [RawLine<'b>],
    line: u32,
    program: &'b mut Program,
    /// Ops of this line's IFs that do not know yet where to go when false, and where they end.
    waiting: Vec<(usize, usize)>,
}

impl Decoder<'_, '_> {
    fn push(&mut self, stmt: Stmt) {
        // At least something, so that no endless loop is free.
        let cost = cost::stmt(&stmt).max(20) + std::mem::take(&mut self.cursor.cost);
        self.program.ops.push(Op {
            stmt,
            cost,
            line: self.line,
            statement: self.program.statements.len().saturating_sub(1) as u32,
        });
    }

    /// A statement begins, perhaps an empty one.
    fn begin(&mut self) {
        let number = match self.program.statements.last() {
            Some(last) if last.line == self.line => last.statement + 1,
            _ => 0,
        };
        self.program.statements.push(Statement {
            line: self.line,
            statement: number,
            op: self.program.ops.len() as u32,
            at: self.cursor.at as u32,
        });
    }

    fn line(&mut self) {
        loop {
            match self.statement() {
                Ok(()) => {}
                Err(e) => {
                    self.push(Stmt::Bad(e));
                    if !self.skip_to_else() {
                        break;
                    }
                }
            }
            match self.cursor.peek() {
                None => break,
                Some(b':') => {
                    self.cursor.at += 1;
                    self.begin();
                }
                Some(t::ELSE) => {
                    self.cursor.at += 1;
                    self.push(Stmt::EndLine);
                    self.meet_else();
                    self.branch();
                }
                Some(_) => {
                    if let Some(last) = self.program.ops.last_mut() {
                        cut_short(&mut last.stmt);
                    }
                    self.push(Stmt::Bad(Error::Syntax));
                    if !self.skip_to_else() {
                        break;
                    }
                }
            }
        }
        // IFs without ELSE: on to the next line, whose first op comes next.
        self.meet_else();
    }

    fn meet_else(&mut self) {
        let here = self.program.ops.len() as u32;
        for (at, from) in self.waiting.drain(..) {
            let passed = self.cursor.at.saturating_sub(from) as u32;
            if let Some(op) = self.program.ops.get_mut(at) {
                match &mut op.stmt {
                    Stmt::If(_, to, skipped) => {
                        *to = here;
                        *skipped = cost::SKIPPED * passed;
                    }
                    Stmt::On(_, _, _, to) => *to = to.map(|_| here),
                    _ => {}
                }
            }
        }
    }

    /// After an error: to the next ELSE, for the IFs that jump there. None: the line is over.
    fn skip_to_else(&mut self) -> bool {
        if self.waiting.is_empty() {
            return false;
        }
        self.cursor.skip_to_else();
        self.cursor.peek_raw().is_some()
    }

    /// After THEN or ELSE: a line number is a GOTO.
    fn branch(&mut self) {
        if let Some(number) = self.cursor.line_number() {
            let target = self.find_line(number);
            self.push(Stmt::Goto(target));
        }
    }

    fn find_line(&self, number: u16) -> Target {
        // Lines out of order cannot be searched by halves; the ROM stops at the first larger one.
        let found = match self.lines.binary_search_by_key(&number, |l| l.number) {
            Ok(index) => Some(index),
            Err(_) => self.lines.iter().position(|l| l.number == number),
        };
        match found {
            Some(index) => {
                let passed = self.lines.iter().take(index).map(|l| l.number);
                Target::Line(index as u32, cost::search(passed, number))
            }
            None => Target::Missing,
        }
    }

    pub fn target(&mut self) -> Result<Target, Error> {
        match self.cursor.line_number() {
            Some(number) => Ok(self.find_line(number)),
            None => Ok(Target::Computed(self.cursor.expr()?)),
        }
    }

    /// One statement (or none) from the cursor.
    fn statement(&mut self) -> Result<(), Error> {
        match self.cursor.peek() {
            None | Some(t::ELSE) => Ok(()),
            Some(b':') => {
                self.cursor.cost += cost::EMPTY;
                Ok(())
            }
            Some(t::REPEAT) => {
                // What follows may do so without a colon.
                self.cursor.at += 1;
                self.push(Stmt::Repeat);
                self.statement()
            }
            Some(t::IF) => self.if_statement(),
            Some(t::ON) => self.on_statement(),
            Some(t::DEF) => self.def_statement(),
            Some(t::DATA) => {
                self.data();
                Ok(())
            }
            Some(t::REM) => {
                let end = self.cursor.text.len();
                self.cursor.cost += cost::REMARK * (end - self.cursor.at) as u32;
                self.cursor.at = end;
                self.push(Stmt::EndLine);
                Ok(())
            }
            Some(_) => {
                let stmt = self.simple()?;
                self.push(stmt);
                Ok(())
            }
        }
    }

    fn if_statement(&mut self) -> Result<(), Error> {
        self.cursor.at += 1;
        let condition = self.cursor.expr()?;
        self.waiting.push((self.program.ops.len(), self.cursor.at));
        self.push(Stmt::If(condition, 0, 0));
        if self.cursor.eat(t::THEN) {
            self.cursor.cost += cost::THEN;
            self.branch();
        }
        if !self.cursor.at_end() {
            return self.statement();
        }
        Ok(())
    }

    fn on_statement(&mut self) -> Result<(), Error> {
        self.cursor.at += 1;
        if self.cursor.eat(t::ERROR) {
            if self.cursor.eat(t::OFF) {
                self.push(Stmt::OnErrorOff);
                return Ok(());
            }
            // The handler is the rest of the line; reached in sequence, it is skipped.
            self.push(Stmt::OnError);
            self.cursor.peek();
            return self.statement();
        }
        let selector = self.cursor.expr()?;
        let kind = match self.cursor.peek() {
            Some(t::GOTO) => super::ast::OnKind::Goto,
            Some(t::GOSUB) => super::ast::OnKind::Gosub,
            _ => return Err(Error::OnSyntax),
        };
        self.cursor.at += 1;
        let mut targets = vec![self.target()?];
        while self.cursor.eat(b',') {
            let target = self.target();
            targets.push(target.unwrap_or_else(|e| Target::Computed(Expr::Bad(e))));
        }
        // What else there is goes unread.
        while !self.cursor.at_end() {
            self.cursor.at += 1;
        }
        let otherwise = (self.cursor.peek() == Some(t::ELSE)).then_some(0);
        self.waiting.push((self.program.ops.len(), self.cursor.at));
        self.push(Stmt::On(kind, selector, targets.into(), otherwise));
        Ok(())
    }

    fn def_statement(&mut self) -> Result<(), Error> {
        self.cursor.at += 1;
        self.push(Stmt::EndLine);
        let kind = match self.cursor.peek() {
            Some(t::FN) => Kind::Fn,
            Some(t::PROC) => Kind::Proc,
            _ => return Ok(()),
        };
        self.cursor.at += 1;
        let name = self.cursor.word();
        let slot = self.cursor.names.slot(kind, name) as usize;
        let params = self.params();
        let headed = self.cursor.at_end();
        let def = Def {
            op: self.program.ops.len() as u32,
            cost: if headed { cost::EMPTY } else { 0 },
            params,
        };
        let table = match kind {
            Kind::Fn => &mut self.program.fns,
            _ => &mut self.program.procs,
        };
        if table.len() <= slot {
            table.resize(slot + 1, None);
        }
        if let Some(entry) = table.get_mut(slot) {
            entry.get_or_insert(def);
        }
        if self.cursor.at_end() {
            return Ok(());
        }
        self.statement()
    }

    fn params(&mut self) -> Result<Box<[Place]>, Error> {
        let mut params = Vec::new();
        if self.cursor.peek_raw() == Some(b'(') {
            self.cursor.at += 1;
            loop {
                params.push(self.cursor.place()?.ok_or(Error::Arguments)?);
                if !self.cursor.eat(b',') {
                    break;
                }
            }
            self.cursor.bracket()?;
        }
        Ok(params.into())
    }

    /// DATA: all of the line's rest is for READ.
    fn data(&mut self) {
        let text = self.cursor.text.get(self.cursor.at + 1..).unwrap_or(&[]);
        self.cursor.cost += cost::REMARK * text.len() as u32;
        self.cursor.at = self.cursor.text.len();
        // The ROM finds DATA only at the start of a line.
        let first =
            self.program.lines.last().map(|l| l.op as usize) == Some(self.program.ops.len());
        self.push(Stmt::EndLine);
        if first {
            self.program.data.push(DataLine {
                line: self.line,
                text: [b",", text].concat().into(),
            });
        }
    }
}
