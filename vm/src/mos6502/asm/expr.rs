//! Expressions: parsed once, evaluated when their symbols are known.
//!
//! Assemblers disagree about precedence: `&` binds like `*` in ca65 and looser
//! than `+` in 64tass, and `<` takes the whole rest of an expression in one and
//! only the next operand in the other. What they would read differently is an
//! error here that asks for parentheses:
//!
//! ```text
//! expr  = ("<" | ">") unary                     low or high byte; nothing may follow
//!       | unary { ("+" | "-" | "*" | "/") unary }   with the usual precedence
//!       | unary { "&" unary }  | the same with | and ^  | unary ("<<" | ">>") unary
//! unary = { "-" } (number | 'c' | name | "*" | "(" expr ")")
//!       | ("LO" | "HI") "(" expr ")"            in beebasm's dialect
//! ```

use super::Dialect;
use super::lexer::{Lexeme, Token, Wrong, wrong};
use super::symbols::Symbols;

/// Deepest nesting of parentheses.
const NESTING: u32 = 256;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Op {
    Number(i64),
    Symbol(usize),
    Here,
    Negate,
    Low,
    High,
    Add,
    Subtract,
    Multiply,
    Divide,
    And,
    Or,
    Xor,
    ShiftLeft,
    ShiftRight,
}

/// An expression in postfix order, so that no text can nest it deeply.
#[derive(Clone, Debug)]
pub(super) struct Expr {
    ops: Vec<Op>,
    /// Where it starts, from 1.
    pub column: u32,
}

/// Why an expression has no value.
pub(super) enum NoValue {
    /// A symbol has no value (yet).
    Unknown(usize),
    /// It never has one.
    Wrong(&'static str),
}

impl Expr {
    /// The value, with `here` for `*`.
    pub fn value(&self, symbols: &Symbols, here: i64) -> Result<i64, NoValue> {
        let mut stack: Vec<i64> = Vec::new();
        for op in &self.ops {
            let value = match op {
                Op::Number(n) => *n,
                Op::Here => here,
                Op::Symbol(s) => symbols.value(*s).ok_or(NoValue::Unknown(*s))?,
                Op::Negate => -stack.pop().unwrap_or(0),
                Op::Low => stack.pop().unwrap_or(0) & 0xFF,
                Op::High => (stack.pop().unwrap_or(0) >> 8) & 0xFF,
                binary => {
                    let right = stack.pop().unwrap_or(0);
                    let left = stack.pop().unwrap_or(0);
                    apply(*binary, left, right)?
                }
            };
            if !(-0x8000_0000..=0xFFFF_FFFF).contains(&value) {
                return Err(NoValue::Wrong("this does not fit 32 bits"));
            }
            stack.push(value);
        }
        stack.pop().ok_or(NoValue::Wrong("an empty expression"))
    }

    /// The symbols it mentions.
    pub fn mentions(&self) -> impl Iterator<Item = usize> + '_ {
        self.ops.iter().filter_map(|op| match op {
            Op::Symbol(s) => Some(*s),
            _ => None,
        })
    }
}

/// `left op right`; both fit 33 bits, so no product overflows 64.
fn apply(op: Op, left: i64, right: i64) -> Result<i64, NoValue> {
    let shift = |n: i64| {
        u32::try_from(n)
            .ok()
            .filter(|n| *n < 32)
            .ok_or(NoValue::Wrong("a shift must be 0 to 31"))
    };
    Ok(match op {
        Op::Add => left + right,
        Op::Subtract => left - right,
        Op::Multiply => left.saturating_mul(right),
        Op::Divide => left
            .checked_div(right)
            .ok_or(NoValue::Wrong("division by zero"))?,
        Op::And => left & right,
        Op::Or => left | right,
        Op::Xor => left ^ right,
        Op::ShiftLeft => left << shift(right)?,
        Op::ShiftRight => left >> shift(right)?,
        _ => return Err(NoValue::Wrong("not an operator")),
    })
}

/// Reads tokens from left to right.
pub(super) struct Reader<'t, 'a> {
    tokens: &'t [Token<'a>],
    next: usize,
    /// The column behind the last token.
    end: u32,
    /// Whether an expression has mentioned `*`.
    here: bool,
    pub dialect: Dialect,
}

impl<'t, 'a> Reader<'t, 'a> {
    pub fn new(tokens: &'t [Token<'a>], end: u32, dialect: Dialect) -> Self {
        Reader {
            tokens,
            next: 0,
            end,
            here: false,
            dialect,
        }
    }

    pub fn peek(&self) -> Option<&'t Lexeme<'a>> {
        self.tokens.get(self.next).map(|t| &t.what)
    }

    pub fn peek_second(&self) -> Option<&'t Lexeme<'a>> {
        self.tokens.get(self.next + 1).map(|t| &t.what)
    }

    pub fn column(&self) -> u32 {
        self.tokens.get(self.next).map_or(self.end, |t| t.column)
    }

    pub fn skip(&mut self) {
        self.next += 1;
    }

    /// Whether the next token is this mark; it is taken if so.
    pub fn eat(&mut self, mark: char) -> bool {
        let found = self.peek() == Some(&Lexeme::Mark(mark));
        self.next += usize::from(found);
        found
    }

    /// Whether a `,` and this register come next; both are taken if so.
    pub fn eat_index(&mut self, register: &str) -> bool {
        let found = self.peek() == Some(&Lexeme::Mark(','))
            && matches!(self.peek_second(), Some(Lexeme::Name(n)) if n.eq_ignore_ascii_case(register));
        self.next += 2 * usize::from(found);
        found
    }

    /// Reads something and says whether it mentions `*`.
    pub fn watch_here<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> Result<T, Wrong>,
    ) -> Result<(T, bool), Wrong> {
        self.here = false;
        let found = read(self)?;
        Ok((found, self.here))
    }

    pub fn at_end(&self) -> bool {
        self.next >= self.tokens.len()
    }

    /// Whether the next token begins `(` and its `)` ends the operand, but for `,y`.
    pub fn is_indirect(&self) -> bool {
        let mut depth = 0u32;
        for (i, token) in self.tokens.iter().enumerate().skip(self.next) {
            match token.what {
                Lexeme::Mark('(') => depth += 1,
                Lexeme::Mark(')') => depth = depth.saturating_sub(1),
                _ => {}
            }
            if depth == 0 {
                let behind = self.tokens.get(i + 1).map(|t| &t.what);
                return i > self.next && matches!(behind, None | Some(Lexeme::Mark(',')));
            }
        }
        false
    }

    pub fn expr(&mut self, symbols: &mut Symbols, line: u32) -> Result<Expr, Wrong> {
        let column = self.column();
        let mut ops = Vec::new();
        self.whole(&mut ops, symbols, line, 0)?;
        Ok(Expr { ops, column })
    }

    fn operator(&self) -> Option<Op> {
        Some(match self.peek()? {
            Lexeme::Mark('+') => Op::Add,
            Lexeme::Mark('-') => Op::Subtract,
            Lexeme::Mark('*') => Op::Multiply,
            Lexeme::Mark('/') => Op::Divide,
            Lexeme::Mark('&') => Op::And,
            Lexeme::Mark('|') => Op::Or,
            Lexeme::Mark('^') => Op::Xor,
            Lexeme::ShiftLeft => Op::ShiftLeft,
            Lexeme::ShiftRight => Op::ShiftRight,
            _ => return None,
        })
    }

    fn ambiguous<T>(&self) -> Result<T, Wrong> {
        wrong(
            self.column(),
            "assemblers read this differently: put parentheses around one of the parts",
        )
    }

    fn whole(
        &mut self,
        ops: &mut Vec<Op>,
        symbols: &mut Symbols,
        line: u32,
        depth: u32,
    ) -> Result<(), Wrong> {
        for (mark, op) in [('<', Op::Low), ('>', Op::High)] {
            if self.eat(mark) {
                self.unary(ops, symbols, line, depth)?;
                ops.push(op);
                return if self.operator().is_some() {
                    self.ambiguous()
                } else {
                    Ok(())
                };
            }
        }
        self.unary(ops, symbols, line, depth)?;
        match self.operator() {
            None => Ok(()),
            Some(Op::Add | Op::Subtract | Op::Multiply | Op::Divide) => {
                self.sum(ops, symbols, line, depth)
            }
            Some(first) => {
                let mut count = 0;
                while let Some(op) = self.operator() {
                    let shift = matches!(first, Op::ShiftLeft | Op::ShiftRight);
                    if op != first || (shift && count > 0) {
                        return self.ambiguous();
                    }
                    count += 1;
                    self.skip();
                    self.unary(ops, symbols, line, depth)?;
                    ops.push(op);
                }
                Ok(())
            }
        }
    }

    /// The rest of a sum of products, behind its first operand.
    fn sum(
        &mut self,
        ops: &mut Vec<Op>,
        symbols: &mut Symbols,
        line: u32,
        depth: u32,
    ) -> Result<(), Wrong> {
        // The + or - that waits for the product on its right.
        let mut waiting = None;
        loop {
            match self.operator() {
                Some(op @ (Op::Multiply | Op::Divide)) => {
                    self.skip();
                    self.unary(ops, symbols, line, depth)?;
                    ops.push(op);
                }
                Some(op @ (Op::Add | Op::Subtract)) => {
                    ops.extend(waiting.replace(op));
                    self.skip();
                    self.unary(ops, symbols, line, depth)?;
                }
                Some(_) => return self.ambiguous(),
                None => {
                    ops.extend(waiting);
                    return Ok(());
                }
            }
        }
    }

    /// `LO` or `HI` with its parenthesis behind it, in the dialect that has them.
    fn function(&self) -> Option<Op> {
        match (self.dialect, self.peek()?, self.peek_second()?) {
            (Dialect::Beebasm, Lexeme::Name(name), Lexeme::Mark('(')) => {
                let is = |word| name.eq_ignore_ascii_case(word);
                (is("lo").then_some(Op::Low)).or(is("hi").then_some(Op::High))
            }
            _ => None,
        }
    }

    fn unary(
        &mut self,
        ops: &mut Vec<Op>,
        symbols: &mut Symbols,
        line: u32,
        depth: u32,
    ) -> Result<(), Wrong> {
        let mut negative = false;
        while self.eat('-') {
            negative = !negative;
        }
        let function = self.function();
        if function.is_some() {
            self.skip();
        }
        let column = self.column();
        match self.peek() {
            Some(Lexeme::Number(n)) => ops.push(Op::Number(*n)),
            Some(Lexeme::Name(name)) => {
                super::parse::check_name(name, column)?;
                ops.push(Op::Symbol(symbols.mention(name, line, column)));
            }
            Some(Lexeme::Mark('*')) => {
                self.here = true;
                ops.push(Op::Here);
            }
            Some(Lexeme::Mark('(')) => {
                if depth >= NESTING {
                    return wrong(column, format!("parentheses nest deeper than {NESTING}"));
                }
                self.skip();
                self.whole(ops, symbols, line, depth + 1)?;
                if self.peek() != Some(&Lexeme::Mark(')')) {
                    return wrong(self.column(), "expected `)`");
                }
            }
            Some(Lexeme::Text(_)) => return wrong(column, "a string stands only in `.byte`"),
            _ => return wrong(column, "expected a number, a name, `*` or `(`"),
        }
        self.skip();
        ops.extend(function);
        if negative {
            ops.push(Op::Negate);
        }
        Ok(())
    }
}
