//! The language of the formulas in a file of hard cases: bodies of functions in a small
//! part of Python (shared/reference/hard_cases.md).

use std::iter::Peekable;
use std::vec::IntoIter;

#[derive(Clone, Debug)]
pub enum Expr {
    Number(String),
    Nothing,
    Truth(bool),
    Name(String),
    Unary(String, Box<Expr>),
    Binary(String, Box<Expr>, Box<Expr>),
    /// `a if c else b`: c, a, b.
    Choice(Box<[Expr; 3]>),
    Call(String, Vec<Expr>),
    List(Vec<Expr>),
}

#[derive(Clone, Debug)]
pub enum Statement {
    Assign(Vec<String>, Expr),
    If(Expr, Vec<Statement>, Vec<Statement>),
    While(Expr, Vec<Statement>),
    For(Vec<String>, Expr, Vec<Statement>),
    Return(Expr),
    Break,
    /// `list.append(value)`.
    Append(String, Expr),
}

impl Expr {
    /// Whether it is made of this name.
    pub fn is_of(&self, wanted: &str) -> bool {
        match self {
            Expr::Name(name) => name == wanted,
            Expr::Unary(_, of) => of.is_of(wanted),
            Expr::Binary(_, a, b) => a.is_of(wanted) || b.is_of(wanted),
            Expr::Choice(parts) => parts.iter().any(|p| p.is_of(wanted)),
            Expr::Call(_, all) | Expr::List(all) => all.iter().any(|e| e.is_of(wanted)),
            Expr::Number(_) | Expr::Nothing | Expr::Truth(_) => false,
        }
    }
}

struct Tokens(Peekable<IntoIter<String>>);

const SIGNS: [&str; 9] = ["//", "**", "<=", ">=", "==", "!=", "<", ">", "="];

fn tokens(text: &str) -> Tokens {
    let mut found = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let word = |ok: fn(char) -> bool| rest.find(|c| !ok(c)).unwrap_or(rest.len());
        let length = if first.is_ascii_digit() {
            word(|c| c.is_ascii_digit() || c == '.')
        } else if first.is_alphabetic() || first == '_' {
            word(|c| c.is_alphanumeric() || c == '_' || c == '.')
        } else {
            let sign = SIGNS.into_iter().find(|s| rest.starts_with(s));
            sign.map_or(first.len_utf8(), str::len)
        };
        found.push(rest[..length].to_owned());
        rest = rest[length..].trim_start();
    }
    Tokens(found.into_iter().peekable())
}

/// Binary operators from loosest to tightest.
const LEVELS: [&[&str]; 5] = [
    &["or"],
    &["and"],
    &["<", ">", "<=", ">=", "==", "!=", "is"],
    &["+", "-"],
    &["*", "/", "//", "%"],
];

impl Tokens {
    fn peek(&mut self) -> &str {
        self.0.peek().map_or("", String::as_str)
    }

    fn next(&mut self) -> String {
        self.0.next().unwrap_or_default()
    }

    fn take(&mut self, wanted: &str) -> bool {
        let there = self.peek() == wanted;
        if there {
            self.next();
        }
        there
    }

    fn expect(&mut self, wanted: &str) {
        let got = self.next();
        assert_eq!(got, wanted);
    }

    /// Several with commas are a list.
    fn several(&mut self, end: &str) -> Expr {
        let first = self.choice();
        if self.peek() != "," {
            return first;
        }
        let mut all = vec![first];
        while self.take(",") && self.peek() != end {
            all.push(self.choice());
        }
        Expr::List(all)
    }

    fn choice(&mut self) -> Expr {
        let value = self.binary(0);
        if !self.take("if") {
            return value;
        }
        let condition = self.binary(0);
        self.expect("else");
        Expr::Choice(Box::new([condition, value, self.choice()]))
    }

    fn binary(&mut self, level: usize) -> Expr {
        let Some(operators) = LEVELS.get(level) else {
            return self.unary();
        };
        let mut left = self.binary(level + 1);
        while operators.contains(&self.peek()) {
            let operator = self.next();
            let right = self.binary(level + 1);
            left = Expr::Binary(operator, Box::new(left), Box::new(right));
        }
        left
    }

    fn unary(&mut self) -> Expr {
        let sign = self.peek().to_owned();
        if sign == "-" || sign == "not" {
            self.next();
            return Expr::Unary(sign, Box::new(self.unary()));
        }
        let base = self.atom();
        if self.take("**") {
            return Expr::Binary("**".to_owned(), Box::new(base), Box::new(self.unary()));
        }
        base
    }

    fn atom(&mut self) -> Expr {
        let token = self.next();
        match token.as_str() {
            "(" => {
                let inner = self.several(")");
                self.expect(")");
                inner
            }
            "[" => {
                let mut all = Vec::new();
                while !self.take("]") {
                    all.push(self.choice());
                    self.take(",");
                }
                Expr::List(all)
            }
            "None" => Expr::Nothing,
            "True" | "False" => Expr::Truth(token == "True"),
            _ if token.starts_with(|c: char| c.is_ascii_digit()) => Expr::Number(token),
            _ if self.take("(") => {
                let mut arguments = Vec::new();
                while !self.take(")") {
                    arguments.push(self.choice());
                    self.take(",");
                }
                Expr::Call(token, arguments)
            }
            _ => Expr::Name(token),
        }
    }
}

pub fn expression(text: &str) -> Expr {
    let mut tokens = tokens(text);
    let found = tokens.several("");
    assert_eq!(tokens.peek(), "", "{text}");
    found
}

/// Lines with their depth.
type Lines<'t> = Peekable<IntoIter<(usize, &'t str)>>;

pub fn body<'t>(lines: impl IntoIterator<Item = &'t str>) -> Vec<Statement> {
    let deep = |line: &'t str| (line.len() - line.trim_start().len(), line.trim());
    let lines: Vec<_> = lines.into_iter().map(deep).collect();
    block(&mut lines.into_iter().peekable(), 0)
}

fn block(lines: &mut Lines, depth: usize) -> Vec<Statement> {
    let mut all = Vec::new();
    while let Some((_, line)) = lines.next_if(|(deep, _)| *deep == depth) {
        all.push(statement(line, lines, depth));
    }
    all
}

/// What stands behind a colon, or deeper in the lines that follow.
fn inner(rest: &str, lines: &mut Lines, depth: usize) -> Vec<Statement> {
    if rest.is_empty() {
        let deeper = lines.peek().map_or(0, |(deep, _)| *deep);
        assert!(deeper > depth, "something is to follow");
        block(lines, deeper)
    } else {
        vec![statement(rest, lines, depth)]
    }
}

fn statement(line: &str, lines: &mut Lines, depth: usize) -> Statement {
    let headed = |word: &str| {
        let rest = line.strip_prefix(word)?;
        let (head, rest) = rest.split_once(':')?;
        Some((head, rest.trim()))
    };
    if let Some((condition, rest)) = headed("if ").or_else(|| headed("elif ")) {
        let then = inner(rest, lines, depth);
        let next = lines.next_if(|(deep, line)| *deep == depth && line.starts_with("el"));
        let other = match next.map(|(_, line)| (line, line.strip_prefix("else:"))) {
            None => Vec::new(),
            Some((_, Some(rest))) => inner(rest.trim(), lines, depth),
            Some((elif, None)) => vec![statement(elif, lines, depth)],
        };
        return Statement::If(expression(condition), then, other);
    }
    if let Some((condition, rest)) = headed("while ") {
        return Statement::While(expression(condition), inner(rest, lines, depth));
    }
    if let Some((head, rest)) = headed("for ") {
        let (names, over) = head.split_once(" in ").expect("for names in list");
        return Statement::For(listed(names), expression(over), inner(rest, lines, depth));
    }
    if line == "break" {
        return Statement::Break;
    }
    if let Some(value) = line.strip_prefix("return ") {
        return Statement::Return(expression(value));
    }
    if let Some((list, value)) = line.split_once(".append(") {
        let value = value.strip_suffix(')').expect("append(value)");
        return Statement::Append(list.to_owned(), expression(value));
    }
    let (names, value) = line.split_once(" = ").expect(line);
    Statement::Assign(listed(names), expression(value))
}

fn listed(names: &str) -> Vec<String> {
    names.split(',').map(|n| n.trim().to_owned()).collect()
}
