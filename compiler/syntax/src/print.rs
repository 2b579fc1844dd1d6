//! Tokens and trees as text, for `--emit tokens`, `--emit tree` and snapshots.
//!
//! A tree prints as nested lists, the operator in front: `a + b * 2` is
//! `(+ a (* b 2))`. A list that fits a line stands on one line; a longer one has
//! its parts on lines of their own, two columns in. Places are left out: they
//! would change with every blank line.

use super::lexer;
use super::tree::{
    AngleUnit, Argument, BinaryOp, Binding, Claim, Counter, Expr, ExprKind, File, Function, Item,
    ItemKind, Member, Statement, Type, TypeKind, UnaryOp,
};
use std::fmt::Write;

/// Columns that a list on one line may reach.
const WIDTH: usize = 100;

/// The tokens of a text, a line of output for each line of the source that has
/// any: its number, then kind and text of each token. Comments are left out.
pub fn tokens(text: &str) -> String {
    let mut out = String::new();
    let (mut line, mut seen, mut written) = (1, 0, 0);
    for (token, span) in lexer::lex(text, 0).tokens {
        let start = span.start as usize;
        let between = text.get(seen..start).unwrap_or("");
        line += between.matches('\n').count();
        seen = start;
        let lead = if line == written { " " } else { "\n" };
        if line != written {
            let lead = if out.is_empty() { "" } else { lead };
            let _ = write!(out, "{lead}{line:>4} ");
            written = line;
        } else {
            out.push_str(lead);
        }
        let (kind, word) = token.parts();
        let _ = match kind {
            "sign" | "word" | "item" => write!(out, "{word}"),
            _ => write!(out, "{kind}:{word}"),
        };
    }
    out.push('\n');
    out
}

/// The tree of a file, one item after another.
pub fn tree(file: &File) -> String {
    let mut out = String::new();
    for item in &file.items {
        self::item(item).write(0, &mut out);
        out.push('\n');
    }
    out
}

/// The tree of an expression.
pub fn expression(value: &Expr) -> String {
    let mut out = String::new();
    expr(value).write(0, &mut out);
    out
}

/// A word, or a list of nodes in brackets.
enum Node {
    Word(String),
    List(Vec<Node>),
}

impl Node {
    fn word(text: impl Into<String>) -> Node {
        Node::Word(text.into())
    }

    fn list(head: impl Into<String>, rest: impl IntoIterator<Item = Node>) -> Node {
        let mut parts = vec![Node::word(head)];
        parts.extend(rest);
        Node::List(parts)
    }

    /// Columns on one line.
    fn width(&self) -> usize {
        match self {
            Node::Word(text) => text.chars().count(),
            Node::List(parts) => parts.iter().map(|p| p.width() + 1).sum::<usize>() + 1,
        }
    }

    fn write(&self, indent: usize, out: &mut String) {
        match self {
            Node::Word(text) => out.push_str(text),
            Node::List(parts) => {
                let fits = indent + self.width() <= WIDTH;
                out.push('(');
                for (at, part) in parts.iter().enumerate() {
                    match (at, fits) {
                        (0, _) => {}
                        (_, true) => out.push(' '),
                        (_, false) => {
                            let _ = write!(out, "\n{:1$}", "", indent + 2);
                        }
                    }
                    part.write(if fits { 0 } else { indent + 2 }, out);
                }
                out.push(')');
            }
        }
    }
}

fn item(item: &Item) -> Node {
    match &item.kind {
        ItemKind::Image(image) => {
            let mut parts = vec![expr(&image.width), expr(&image.height)];
            parts.extend(image.inks.iter().map(|ink| Node::word(&ink.text)));
            Node::list("image", parts)
        }
        ItemKind::Param(param) => {
            let mut parts = vec![typed(&param.name.text, &param.ty), expr(&param.value)];
            if let Some((low, high)) = &param.range {
                parts.push(Node::list("in", [expr(low), expr(high)]));
            }
            match &param.next {
                Some(next) => {
                    parts.push(Node::list("->", [expr(next)]));
                    Node::list("state", parts)
                }
                None => Node::list("param", parts),
            }
        }
        ItemKind::Const { name, value } => {
            Node::list(format!("const {}", name.text), [expr(value)])
        }
        ItemKind::Fn(function) => self::function("fn", function, None),
        ItemKind::Dither(function) => self::function("dither", function, None),
        ItemKind::Effect {
            function,
            otherwise,
        } => self::function("effect", function, Some(otherwise)),
        ItemKind::Shape {
            name,
            params,
            facets,
        } => {
            let mut parts = vec![bindings(params)];
            for facet in facets {
                let argument = facet.argument.as_ref().map(|a| format!("({})", a.text));
                let head = facet.name.text.clone() + &argument.unwrap_or_default();
                parts.push(Node::list(head, [expr(&facet.body)]));
            }
            Node::list(format!("shape {}", name.text), parts)
        }
        ItemKind::Scene { name, members } => {
            Node::list(format!("scene {}", name.text), members.iter().map(member))
        }
        ItemKind::Record { name, fields } => {
            Node::list(format!("record {}", name.text), fields.iter().map(binding))
        }
        ItemKind::Map { name, rows, cells } => {
            let rows = rows.iter().map(|(row, _)| Node::word(format!("\"{row}\"")));
            let cells = cells
                .iter()
                .map(|(cell, value)| Node::list(format!("'{cell}'"), [expr(value)]));
            Node::list(format!("map {}", name.text), rows.chain(cells))
        }
        ItemKind::Draw { x, y, body } => {
            Node::list(format!("draw {} {}", x.text, y.text), [expr(body)])
        }
        ItemKind::Use { path, .. } => Node::list("use", [Node::word(format!("\"{path}\""))]),
    }
}

fn member(member: &Member) -> Node {
    match member {
        Member::One { shape, tag } => match tag {
            Some(tag) => Node::list("is", [expr(shape), expr(tag)]),
            None => expr(shape),
        },
        Member::Each { counter, members } => {
            let members = members.iter().map(self::member);
            Node::list("each", self::counter(counter).into_iter().chain(members))
        }
    }
}

fn counter(counter: &Counter) -> [Node; 2] {
    let range = [expr(&counter.low), expr(&counter.high)];
    [Node::word(&counter.name.text), Node::list("in", range)]
}

fn function(word: &str, function: &Function, otherwise: Option<&Expr>) -> Node {
    let mut parts = vec![
        bindings(&function.params),
        Node::word(format!("-> {}", ty(&function.result))),
    ];
    parts.extend(otherwise.map(|e| Node::list("else", [expr(e)])));
    parts.push(expr(&function.body));
    Node::list(format!("{word} {}", function.name.text), parts)
}

fn bindings(bindings: &[Binding]) -> Node {
    Node::List(bindings.iter().map(binding).collect())
}

fn binding(binding: &Binding) -> Node {
    let head = typed(&binding.name.text, &binding.ty);
    match &binding.default {
        Some(value) => Node::List(vec![head, Node::word("="), expr(value)]),
        None => head,
    }
}

fn typed(name: &str, ty: &Type) -> Node {
    Node::word(format!("{name}: {}", self::ty(ty)))
}

/// A type as it is written.
pub fn ty(ty: &Type) -> String {
    match &ty.kind {
        TypeKind::Name(name) => name.clone(),
        TypeKind::Table(of) => format!("[{}]", self::ty(of)),
        TypeKind::Optional(of) => format!("{}?", self::ty(of)),
        TypeKind::Function(from, to) => {
            let from: Vec<String> = from.iter().map(self::ty).collect();
            format!("fn({}) -> {}", from.join(", "), self::ty(to))
        }
        TypeKind::Error => "<error>".into(),
    }
}

/// A number as it is written: digits, and around a real's point.
pub fn real(value: f64) -> String {
    let text = format!("{value}");
    if text.contains('.') {
        text
    } else {
        text + ".0"
    }
}

/// The unit as it is written.
pub fn unit(unit: AngleUnit) -> &'static str {
    match unit {
        AngleUnit::Deg => "deg",
        AngleUnit::Turn => "turn",
        AngleUnit::Rad => "rad",
    }
}

/// The operator as it is written.
pub fn operator(op: BinaryOp) -> &'static str {
    match op {
        BinaryOp::Or => "or",
        BinaryOp::And => "and",
        BinaryOp::Eq => "==",
        BinaryOp::Ne => "!=",
        BinaryOp::Lt => "<",
        BinaryOp::Le => "<=",
        BinaryOp::Gt => ">",
        BinaryOp::Ge => ">=",
        BinaryOp::Add => "+",
        BinaryOp::Sub => "-",
        BinaryOp::Mul => "*",
        BinaryOp::Div => "/",
        BinaryOp::Mod => "mod",
        BinaryOp::IntDiv => "div",
        BinaryOp::Pow => "^",
    }
}

/// The word of a claim.
pub fn claim(claim: Claim) -> &'static str {
    match claim {
        Claim::Frame => "frame",
        Claim::Row => "row",
        Claim::Column => "column",
    }
}

fn expr(value: &Expr) -> Node {
    match &value.kind {
        ExprKind::Error => Node::word("<error>"),
        ExprKind::Int(n) => Node::word(format!("{n}")),
        ExprKind::Real(n) => Node::word(real(*n)),
        ExprKind::Angle(n, u) => Node::word(format!("{n}{}", unit(*u))),
        ExprKind::Bool(truth) => Node::word(truth.to_string()),
        ExprKind::None => Node::word("none"),
        ExprKind::Name(name) => Node::word(name),
        ExprKind::Tuple(parts) => Node::list("vec", parts.iter().map(expr)),
        ExprKind::Table(rows) => match rows.as_slice() {
            [row] => Node::list("list", row.iter().map(expr)),
            rows => Node::list(
                "table",
                rows.iter()
                    .map(|r| Node::List(r.iter().map(expr).collect())),
            ),
        },
        ExprKind::Unary(UnaryOp::Neg, a) => Node::list("-", [expr(a)]),
        ExprKind::Unary(UnaryOp::Not, a) => Node::list("not", [expr(a)]),
        ExprKind::Binary(op, a, b) => Node::list(operator(*op), [expr(a), expr(b)]),
        ExprKind::Call { name, args } => {
            Node::list(format!("call {}", name.text), args.iter().map(argument))
        }
        ExprKind::Method {
            receiver,
            name,
            args,
        } => {
            let args = args.iter().map(argument);
            let all = std::iter::once(expr(receiver)).chain(args);
            Node::list(format!("method {}", name.text), all)
        }
        ExprKind::Field { base, name } => Node::list(format!(".{}", name.text), [expr(base)]),
        ExprKind::Index { base, indices } => {
            let all = std::iter::once(expr(base)).chain(indices.iter().map(expr));
            Node::list("at", all)
        }
        ExprKind::If {
            binding,
            condition,
            yes,
            no,
        } => {
            let head = match binding {
                Some(name) => format!("if let {} =", name.text),
                None => "if".into(),
            };
            Node::list(head, [expr(condition), expr(yes), expr(no)])
        }
        ExprKind::Loop {
            carried,
            max,
            body,
            otherwise,
        } => {
            let carried = carried
                .iter()
                .map(|(name, start)| Node::list(format!("{} =", name.text), [expr(start)]));
            let rest = [
                Node::list("max", [expr(max)]),
                expr(body),
                Node::list("else", [expr(otherwise)]),
            ];
            Node::list("loop", carried.chain(rest))
        }
        ExprKind::Each(each) => {
            let args = each.args.iter().map(argument);
            let parts = args.chain(counter(&each.counter));
            let parts = parts.chain([expr(&each.body)]);
            Node::list(format!("each {}", each.name.text), parts)
        }
        ExprKind::Next(values) => Node::list("next", values.iter().map(expr)),
        ExprKind::Block { statements, result } => {
            let all = statements.iter().map(statement);
            Node::list("block", all.chain([expr(result)]))
        }
    }
}

fn argument(argument: &Argument) -> Node {
    match &argument.name {
        Some(name) => Node::list(format!("{}:", name.text), [expr(&argument.value)]),
        None => expr(&argument.value),
    }
}

fn statement(statement: &Statement) -> Node {
    match statement {
        Statement::Let { claim, name, value } => {
            let claim = claim.map_or("", |(c, _)| self::claim(c));
            let head = format!("{claim} let {} =", name.text);
            Node::list(head.trim_start(), [expr(value)])
        }
        Statement::Spread { value, to, .. } => {
            let shares = to
                .iter()
                .map(|(offset, weight)| Node::List(vec![expr(offset), expr(weight)]));
            Node::list("spread", std::iter::once(expr(value)).chain(shares))
        }
    }
}
