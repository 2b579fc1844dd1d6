//! Tokens to the tree: statements and expressions.

use super::lexer::Token;
use super::parser::{Parser, Read};
use super::tree::{Expression, Invocation, Name, Operator, Statement, Term};

impl<'a> Parser<'_, 'a, '_, '_> {
    /// Statements up to a closing brace, which is left.
    pub(super) fn statements(&mut self) -> Read<Vec<Statement<'a>>> {
        let mut statements = Vec::new();
        while self.peek() != Token::Symbol('}') {
            let statement = self.nested(Self::statement)?;
            statements.push(statement);
        }
        Ok(statements)
    }

    fn block(&mut self) -> Read<Vec<Statement<'a>>> {
        self.symbol('{')?;
        let statements = self.statements()?;
        self.symbol('}')?;
        Ok(statements)
    }

    fn statement(&mut self) -> Read<Statement<'a>> {
        let place = self.place();
        match self.peek() {
            Token::Keyword("let") => {
                self.advance();
                self.assignment()
            }
            Token::Keyword("if") => {
                self.advance();
                let condition = self.condition()?;
                let then = self.block()?;
                let otherwise = if self.accept_keyword("else") {
                    Some(self.block()?)
                } else {
                    None
                };
                Ok(Statement::If {
                    place,
                    condition,
                    then,
                    otherwise,
                })
            }
            Token::Keyword("while") => {
                self.advance();
                let condition = self.condition()?;
                let body = self.block()?;
                Ok(Statement::While {
                    place,
                    condition,
                    body,
                })
            }
            Token::Keyword("do") => {
                self.advance();
                let name = self.name("a subroutine call")?;
                let call = self.invocation(name)?;
                self.symbol(';')?;
                Ok(Statement::Do(call))
            }
            Token::Keyword("return") => {
                self.advance();
                let value = if self.peek() == Token::Symbol(';') {
                    None
                } else {
                    Some(self.expression()?)
                };
                self.symbol(';')?;
                Ok(Statement::Return { place, value })
            }
            Token::Keyword("var") => {
                self.expected("a statement or `}`: all `var` stand before the first statement")
            }
            Token::Name(_) => {
                self.expected("a statement or `}` (assignments begin with `let`, calls with `do`)")
            }
            _ => self.expected("`let`, `if`, `while`, `do`, `return` or `}`"),
        }
    }

    fn assignment(&mut self) -> Read<Statement<'a>> {
        let target = self.name("the variable to assign to")?;
        let index = if self.accept('[') {
            let index = self.nested(Self::expression)?;
            self.symbol(']')?;
            Some(index)
        } else {
            None
        };
        self.symbol('=')?;
        let value = self.expression()?;
        self.symbol(';')?;
        Ok(Statement::Let {
            target,
            index,
            value,
        })
    }

    fn condition(&mut self) -> Read<Expression<'a>> {
        self.symbol('(')?;
        let condition = self.expression()?;
        self.symbol(')')?;
        Ok(condition)
    }

    pub(super) fn expression(&mut self) -> Read<Expression<'a>> {
        let first = self.term()?;
        let mut rest = Vec::new();
        while let Some(operator) = self.operator() {
            let place = self.place();
            self.advance();
            rest.push((operator, place, self.term()?));
        }
        Ok(Expression { first, rest })
    }

    fn operator(&self) -> Option<Operator> {
        Some(match self.peek() {
            Token::Symbol('+') => Operator::Add,
            Token::Symbol('-') => Operator::Subtract,
            Token::Symbol('*') => Operator::Multiply,
            Token::Symbol('/') => Operator::Divide,
            Token::Symbol('&') => Operator::And,
            Token::Symbol('|') => Operator::Or,
            Token::Symbol('<') => Operator::Less,
            Token::Symbol('>') => Operator::Greater,
            Token::Symbol('=') => Operator::Equal,
            _ => return None,
        })
    }

    fn term(&mut self) -> Read<Term<'a>> {
        let place = self.place();
        let term = match self.peek() {
            Token::Integer(value) => Term::Integer(value),
            Token::Text(text) => Term::Text(Name { text, place }),
            Token::Keyword("true") => Term::True,
            Token::Keyword("false" | "null") => Term::Zero,
            Token::Keyword("this") => Term::This(place),
            Token::Symbol('(') => {
                self.advance();
                let inner = self.nested(Self::expression)?;
                self.symbol(')')?;
                return Ok(Term::Group(Box::new(inner)));
            }
            Token::Symbol('-') => {
                self.advance();
                return Ok(Term::Negative(Box::new(self.nested(Self::term)?)));
            }
            Token::Symbol('~') => {
                self.advance();
                return Ok(Term::Not(Box::new(self.nested(Self::term)?)));
            }
            Token::Name(text) => {
                self.advance();
                return self.named(Name { text, place });
            }
            _ => return self.expected("a value"),
        };
        self.advance();
        Ok(term)
    }

    /// What a name begins: a variable, an array's element or a call.
    fn named(&mut self, name: Name<'a>) -> Read<Term<'a>> {
        match self.peek() {
            Token::Symbol('[') => {
                self.advance();
                let index = self.nested(Self::expression)?;
                self.symbol(']')?;
                Ok(Term::Element(name, Box::new(index)))
            }
            Token::Symbol('(' | '.') => Ok(Term::Call(self.invocation(name)?)),
            _ => Ok(Term::Variable(name)),
        }
    }

    /// The rest of a call that begins with this name.
    fn invocation(&mut self, first: Name<'a>) -> Read<Invocation<'a>> {
        let (receiver, name) = if self.accept('.') {
            (Some(first), self.name("the subroutine's name")?)
        } else {
            (None, first)
        };
        let mut arguments = Vec::new();
        self.symbol('(')?;
        if !self.accept(')') {
            loop {
                arguments.push(self.nested(Self::expression)?);
                if self.accept(')') {
                    break;
                }
                if !self.accept(',') {
                    return self.expected("`,` or `)`");
                }
            }
        }
        Ok(Invocation {
            receiver,
            name,
            arguments,
        })
    }
}
