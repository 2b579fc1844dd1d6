//! Patterns of the accuracy rules: formulas with letters for values, to be found in a graph and
//! put into one.

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use slowlight_routine::{Op, Value};
use std::fmt;

/// A formula. Written by [`form!`].
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// Any value; the same one wherever the letter stands.
    Value(&'static str),
    /// This constant.
    Number(f64),
    /// An operation on forms.
    Apply(Op, &'static [Form]),
    /// A choice: condition, yes, no. Only put in, never looked for.
    Select(&'static [Form; 3]),
    /// What fits the form, under a name.
    As(&'static str, &'static Form),
}

/// A [`Form`]: `a`, `2.0`, `(Sub a b)`, `(s = (Sqrt a))`, `(if (Less a b) a b)`,
/// and `[NAME]` for one that has been given a name.
macro_rules! form {
    ([$named:ident]) => { $named };
    ($value:ident) => { Form::Value(stringify!($value)) };
    ($number:literal) => { Form::Number($number) };
    ((if $cond:tt $yes:tt $no:tt)) => {
        Form::Select(&[form!($cond), form!($yes), form!($no)])
    };
    (($value:ident = $form:tt)) => { Form::As(stringify!($value), &form!($form)) };
    (($op:ident $($form:tt)+)) => { Form::Apply(Op::$op, &[$(form!($form)),+]) };
}
pub(super) use form;

/// How many forms are held against nodes before a match is given up.
const PATIENCE: u32 = 4000;

/// What the letters of a form stand for in a graph.
#[derive(Clone, Debug, Default)]
pub struct Bound(Vec<(&'static str, NodeId)>);

impl Bound {
    /// What a letter stands for.
    pub fn get(&self, letter: &str) -> Option<NodeId> {
        self.0.iter().find(|(l, _)| *l == letter).map(|(_, id)| *id)
    }

    fn bind(&mut self, letter: &'static str, id: NodeId) -> bool {
        match self.get(letter) {
            Some(held) => held == id,
            None => {
                self.0.push((letter, id));
                true
            }
        }
    }
}

/// Holds a form against a node; sums and products fit in either order.
pub fn fits(graph: &Graph, form: &'static Form, id: NodeId) -> Option<Bound> {
    let mut search = Search {
        graph,
        bound: Bound::default(),
        left: PATIENCE,
    };
    search.all(vec![(form, id)]).then_some(search.bound)
}

struct Search<'g> {
    graph: &'g Graph,
    bound: Bound,
    left: u32,
}

impl Search<'_> {
    /// Whether every form fits its node.
    fn all(&mut self, mut todo: Vec<(&'static Form, NodeId)>) -> bool {
        while let Some((form, id)) = todo.pop() {
            let Some(left) = self.left.checked_sub(1) else {
                return false;
            };
            self.left = left;
            let fits = match form {
                Form::Value(letter) => self.bound.bind(letter, id),
                Form::As(letter, inner) => {
                    todo.push((*inner, id));
                    self.bound.bind(letter, id)
                }
                Form::Number(n) => self.graph.constant(id).is_some_and(|v| v.real() == *n),
                Form::Select(_) => false,
                Form::Apply(op, forms) => match (self.graph.node(id), forms) {
                    (Node::Apply(found, [a, _]), [f]) if found == *op => {
                        todo.push((f, a));
                        true
                    }
                    (Node::Apply(found, [a, b]), [f, g]) if found == *op => {
                        if op.commutes() && a != b {
                            let held = self.bound.0.len();
                            let mut straight = todo.clone();
                            straight.extend([(g, b), (f, a)]);
                            if self.all(straight) {
                                return true;
                            }
                            self.bound.0.truncate(held);
                            todo.extend([(g, a), (f, b)]);
                        } else {
                            todo.extend([(g, b), (f, a)]);
                        }
                        true
                    }
                    _ => false,
                },
            };
            if !fits {
                return false;
            }
        }
        true
    }
}

/// Where a rule puts what it makes.
pub struct Out<'o> {
    pub builder: &'o mut Builder,
    /// What stands for a node of the old graph.
    pub new: &'o dyn Fn(NodeId) -> Option<NodeId>,
    /// Where that came from which the rule replaces.
    pub span: Span,
}

impl Out<'_> {
    pub fn real(&mut self, value: f64) -> NodeId {
        self.builder.constant(Value::Real(value), self.span)
    }

    pub fn apply(&mut self, op: Op, args: &[NodeId]) -> NodeId {
        self.builder.apply(op, args, self.span)
    }

    /// Puts a form, given what its letters are.
    pub fn form(&mut self, form: &Form, bound: &Bound) -> Option<NodeId> {
        Some(match form {
            Form::Value(letter) | Form::As(letter, _) => (self.new)(bound.get(letter)?)?,
            Form::Number(n) => self.real(*n),
            Form::Apply(op, forms) => {
                let args = forms.iter().map(|f| self.form(f, bound));
                let args: Vec<NodeId> = args.collect::<Option<_>>()?;
                self.apply(*op, &args)
            }
            Form::Select(parts) => {
                let [cond, yes, no] = parts.each_ref().map(|f| self.form(f, bound));
                self.builder.select(cond?, yes?, no?, self.span)
            }
        })
    }
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Form::Value(letter) => write!(f, "{letter}"),
            Form::As(_, form) => write!(f, "{form}"),
            Form::Number(n) => write!(f, "{n}"),
            Form::Select([cond, yes, no]) => write!(f, "if {cond} then {yes} else {no}"),
            Form::Apply(op, [a]) => match op {
                Op::Neg => write!(f, "-{}", Tight(a)),
                op => write!(f, "{}({a})", op.name()),
            },
            Form::Apply(op, [a, b]) => match op {
                Op::Add => write!(f, "{a} + {}", Tight(b)),
                Op::Sub => write!(f, "{a} - {}", Tight(b)),
                Op::Mul => write!(f, "{}*{}", Tight(a), Tight(b)),
                Op::Div => write!(f, "{}/{}", Tight(a), Tight(b)),
                Op::Less => write!(f, "{a} < {b}"),
                op => write!(f, "{}({a}, {b})", op.name()),
            },
            Form::Apply(op, _) => write!(f, "{}", op.name()),
        }
    }
}

/// A form in brackets, where it is a sum, product or choice.
struct Tight<'f>(&'f Form);

impl fmt::Display for Tight<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let form = match self.0 {
            Form::As(_, inner) => inner,
            other => other,
        };
        match form {
            Form::Apply(Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Neg, _) | Form::Select(_) => {
                write!(f, "({form})")
            }
            form => write!(f, "{form}"),
        }
    }
}
