//! Tokens to the tree, by recursive descent: the declarations. Statements and
//! expressions are in [`super::statement`].
//!
//! A syntax error ends its subroutine; reading goes on at the next one, so
//! that one slip does not hide another.

use super::lexer::{Token, tokens};
use super::tree::{Call, Class, Kind, Name, Subroutine, Type, Variable};
use super::{Faults, NESTING, Place};

/// A fault was reported; what was being read is abandoned.
#[derive(Debug)]
pub(super) struct Abandoned;

pub(super) type Read<T> = Result<T, Abandoned>;

/// The class in a file's text; `None` if it has a syntax error.
pub(super) fn parse<'a>(text: &'a str, faults: &mut Faults) -> Option<Class<'a>> {
    let before = faults.list.len();
    let tokens = tokens(text, faults);
    if faults.list.len() > before {
        return None;
    }
    let mut parser = Parser {
        tokens: &tokens,
        at: 0,
        depth: 0,
        faults,
    };
    let class = parser.class().ok()?;
    (parser.faults.list.len() == before).then_some(class)
}

pub(super) struct Parser<'t, 'a, 'f, 'n> {
    tokens: &'t [(Token<'a>, Place)],
    at: usize,
    depth: u32,
    faults: &'f mut Faults<'n>,
}

impl<'a> Parser<'_, 'a, '_, '_> {
    fn class(&mut self) -> Read<Class<'a>> {
        self.keyword("class")?;
        let name = self.name("the class's name")?;
        self.symbol('{')?;
        let mut class = Class {
            name,
            variables: Vec::new(),
            subroutines: Vec::new(),
        };
        loop {
            let kind = match self.peek() {
                Token::Keyword("static") => Kind::Static,
                Token::Keyword("field") => Kind::Field,
                _ => break,
            };
            self.advance();
            self.variables(kind, &mut class.variables)?;
        }
        while self.peek() != Token::Symbol('}') {
            match self.subroutine() {
                Ok(subroutine) => class.subroutines.push(subroutine),
                Err(Abandoned) => {
                    self.skip_to_subroutine();
                    if self.peek() == Token::End {
                        return Err(Abandoned);
                    }
                }
            }
        }
        self.advance();
        match self.peek() {
            Token::End => Ok(class),
            _ => self.expected("the end of the file: a file holds one class"),
        }
    }

    fn subroutine(&mut self) -> Read<Subroutine<'a>> {
        let kind = match self.peek() {
            Token::Keyword("constructor") => Call::Constructor,
            Token::Keyword("function") => Call::Function,
            Token::Keyword("method") => Call::Method,
            Token::Keyword("static" | "field") => {
                return self.expected("a subroutine: statics and fields stand before the first");
            }
            Token::Keyword("int" | "char" | "boolean") | Token::Name(_) => {
                return self.expected("`static`, `field`, `constructor`, `function` or `method`");
            }
            _ => return self.expected("`constructor`, `function`, `method` or the class's `}`"),
        };
        self.advance();
        let returns = if self.accept_keyword("void") {
            None
        } else {
            Some(self.of_type("`void` or a type")?)
        };
        let name = self.name("the subroutine's name")?;
        let parameters = self.parameters()?;
        self.symbol('{')?;
        let mut locals = Vec::new();
        while self.accept_keyword("var") {
            self.variables(Kind::Local, &mut locals)?;
        }
        let body = self.statements()?;
        let end = self.place();
        self.symbol('}')?;
        Ok(Subroutine {
            kind,
            returns,
            name,
            parameters,
            locals,
            body,
            end,
        })
    }

    fn parameters(&mut self) -> Read<Vec<Variable<'a>>> {
        let mut parameters = Vec::new();
        self.symbol('(')?;
        if self.accept(')') {
            return Ok(parameters);
        }
        let mut what = "a type or `)`";
        loop {
            parameters.push(Variable {
                kind: Kind::Parameter,
                of: self.of_type(what)?,
                name: self.name("the parameter's name")?,
            });
            if self.accept(')') {
                return Ok(parameters);
            }
            if !self.accept(',') {
                return self.expected("`,` or `)`");
            }
            what = "a type";
        }
    }

    /// A type and its names, after `static`, `field` or `var`.
    fn variables(&mut self, kind: Kind, into: &mut Vec<Variable<'a>>) -> Read<()> {
        let of = self.of_type("a type")?;
        loop {
            let name = self.name("a variable's name")?;
            into.push(Variable { kind, of, name });
            if self.accept(';') {
                return Ok(());
            }
            if !self.accept(',') {
                return self.expected("`,` or `;`");
            }
        }
    }

    fn of_type(&mut self, what: &str) -> Read<Type<'a>> {
        let place = self.place();
        let of = match self.peek() {
            Token::Keyword(word @ ("int" | "char" | "boolean")) => Type::Plain(word),
            Token::Name(text) => Type::Class(Name { text, place }),
            _ => return self.expected(what),
        };
        self.advance();
        Ok(of)
    }

    fn skip_to_subroutine(&mut self) {
        while !matches!(
            self.peek(),
            Token::Keyword("constructor" | "function" | "method") | Token::End
        ) {
            self.advance();
        }
    }

    pub(super) fn peek(&self) -> Token<'a> {
        self.tokens.get(self.at).map_or(Token::End, |token| token.0)
    }

    /// Where the next token begins.
    pub(super) fn place(&self) -> Place {
        let last = Place { line: 1, column: 1 };
        let token = self.tokens.get(self.at).or(self.tokens.last());
        token.map_or(last, |token| token.1)
    }

    pub(super) fn advance(&mut self) {
        self.at += 1;
    }

    pub(super) fn accept(&mut self, symbol: char) -> bool {
        let found = self.peek() == Token::Symbol(symbol);
        if found {
            self.advance();
        }
        found
    }

    pub(super) fn accept_keyword(&mut self, word: &str) -> bool {
        let found = matches!(self.peek(), Token::Keyword(found) if found == word);
        if found {
            self.advance();
        }
        found
    }

    pub(super) fn symbol(&mut self, symbol: char) -> Read<()> {
        if self.accept(symbol) {
            Ok(())
        } else {
            self.expected(&format!("`{symbol}`"))
        }
    }

    fn keyword(&mut self, word: &str) -> Read<()> {
        if self.accept_keyword(word) {
            Ok(())
        } else {
            self.expected(&format!("`{word}`"))
        }
    }

    pub(super) fn name(&mut self, what: &str) -> Read<Name<'a>> {
        let place = self.place();
        match self.peek() {
            Token::Name(text) => {
                self.advance();
                Ok(Name { text, place })
            }
            Token::Keyword(word) => self.fail(
                place,
                format!("expected {what}, found `{word}`, which is a reserved word"),
            ),
            _ => self.expected(what),
        }
    }

    pub(super) fn expected<T>(&mut self, what: &str) -> Read<T> {
        let found = self.peek().shown();
        self.fail(self.place(), format!("expected {what}, found {found}"))
    }

    fn fail<T>(&mut self, place: Place, message: String) -> Read<T> {
        self.faults.add(place, message);
        Err(Abandoned)
    }

    /// Reads something one level deeper, or refuses to.
    pub(super) fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Read<T>) -> Read<T> {
        if self.depth >= NESTING {
            let message = format!("nested more than {NESTING} levels deep: split it");
            return self.fail(self.place(), message);
        }
        self.depth += 1;
        let answer = read(self);
        self.depth -= 1;
        answer
    }
}
