//! Formulas evaluated, with what a case says of its own: how large and how small numbers
//! get on the way, and how far a result moves when one operation's does.

use super::big::Big;
use super::parse::{Expr, Statement};
pub use super::value::{Random, Value};
use slowlight_routine::Op;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Where in a formula an operation stands: however often it is carried out, in one case or
/// in others of its kind, it is the same one.
pub type Site = usize;

fn site(expr: &Expr) -> Site {
    std::ptr::from_ref(expr).addr()
}

/// What moves results.
pub enum Move {
    /// One operation, so far.
    One(usize, Big),
    /// All, each so far up or down.
    All(Rc<BTreeMap<Site, Big>>, Random),
}

/// An operation that was carried out.
#[derive(Clone, Debug)]
pub struct Step {
    pub site: Site,
    /// What it is, if it is a function.
    pub function: Option<Op>,
    /// What it came to, and the greatest magnitude that this or a product in it has.
    pub x: Big,
    pub greatest: f64,
}

/// An evaluation.
pub struct Run<'r> {
    pub names: BTreeMap<String, Value>,
    /// The exponents of the greatest and the least real that is not 0.
    pub seen: Option<(i32, i32)>,
    /// How many operations on reals there were.
    pub operations: usize,
    /// Which operations' results are moved, and how far.
    pub moved: Option<Move>,
    /// Whether a number was 0 on the way.
    pub zero: bool,
    /// The operations on reals.
    pub trail: Vec<Step>,
    site: Site,
    /// What the next operation is, if it is a function; and the greatest number in it.
    function: Option<Op>,
    within: f64,
    /// Whether there was a root or logarithm of what has none, or a quotient by 0: a moved
    /// operation may lead there.
    pub senseless: bool,
    pub random: Option<&'r mut Random>,
}

/// How a block ends.
enum End {
    Through,
    Broken,
    Returned(Value),
}

impl<'r> Run<'r> {
    pub fn new(names: BTreeMap<String, Value>) -> Run<'r> {
        let mut run = Run {
            names,
            seen: None,
            operations: 0,
            moved: None,
            zero: false,
            trail: Vec::new(),
            site: 0,
            function: None,
            within: 0.0,
            senseless: false,
            random: None,
        };
        let inputs: Vec<Value> = run.names.values().cloned().collect();
        for input in inputs {
            if let Value::Number(x, false) = input {
                run.look(&x);
            }
        }
        run
    }

    fn look(&mut self, x: &Big) {
        self.zero |= x.is_zero();
        if let Some(exponent) = x.exponent() {
            let (hi, lo) = self.seen.unwrap_or((exponent, exponent));
            self.seen = Some((hi.max(exponent), lo.min(exponent)));
        }
    }

    /// The result of an operation, moved where that is asked for.
    fn result(&mut self, x: Big, whole: bool) -> Value {
        if whole {
            return Value::Number(x, true);
        }
        let here = self.operations;
        self.operations += 1;
        let x = match &mut self.moved {
            Some(Move::One(at, by)) if *at == here => x.plus(by),
            Some(Move::All(by, random)) => match (by.get(&self.site), random.next() % 2) {
                (Some(by), 0) => x.plus(by),
                (Some(by), _) => x.minus(by),
                (None, _) => x,
            },
            _ => x,
        };
        self.look(&x);
        self.trail.push(Step {
            site: self.site,
            function: self.function.take(),
            greatest: x.near().abs().max(std::mem::take(&mut self.within)),
            x: x.clone(),
        });
        Value::real(x)
    }

    fn senseless(&mut self) -> Value {
        self.senseless = true;
        Value::real(Big::new(0.0))
    }

    pub fn body(&mut self, body: &[Statement]) -> Value {
        match self.block(body) {
            End::Returned(value) => value,
            _ => Value::Nothing,
        }
    }

    fn block(&mut self, body: &[Statement]) -> End {
        for statement in body {
            match self.statement(statement) {
                End::Through => {}
                end => return end,
            }
        }
        End::Through
    }

    fn assign(&mut self, names: &[String], value: Value) {
        match names {
            [one] => {
                self.names.insert(one.clone(), value);
            }
            _ => {
                for (name, value) in names.iter().zip(value.list()) {
                    self.names.insert(name.clone(), value);
                }
            }
        }
    }

    fn statement(&mut self, statement: &Statement) -> End {
        match statement {
            Statement::Assign(names, value) => {
                let value = self.value(value);
                self.assign(names, value);
            }
            Statement::If(condition, then, other) => {
                let truth = self.value(condition).truth();
                return self.block(if truth { then } else { other });
            }
            Statement::While(condition, body) => {
                while self.value(condition).truth() {
                    match self.block(body) {
                        End::Through => {}
                        End::Broken => break,
                        end => return end,
                    }
                }
            }
            Statement::For(names, over, body) => {
                for value in self.value(over).list() {
                    self.assign(names, value);
                    match self.block(body) {
                        End::Through => {}
                        End::Broken => break,
                        end => return end,
                    }
                }
            }
            Statement::Return(value) => return End::Returned(self.value(value)),
            Statement::Break => return End::Broken,
            Statement::Append(list, value) => {
                let value = self.value(value);
                match self.names.get_mut(list) {
                    Some(Value::List(all)) => all.push(value),
                    other => panic!("{list} is no list but {other:?}"),
                }
            }
        }
        End::Through
    }

    pub fn value(&mut self, expr: &Expr) -> Value {
        match expr {
            Expr::Nothing => Value::Nothing,
            Expr::Truth(truth) => Value::Truth(*truth),
            Expr::Number(text) => Value::Number(Big::parse(text), !text.contains('.')),
            Expr::Name(name) => match self.names.get(name) {
                Some(value) => value.clone(),
                None => Value::Called,
            },
            Expr::List(all) => Value::List(all.iter().map(|e| self.value(e)).collect()),
            Expr::Choice(parts) => {
                let [condition, then, other] = &**parts;
                let truth = self.value(condition).truth();
                self.value(if truth { then } else { other })
            }
            Expr::Unary(sign, of) => match (sign.as_str(), self.value(of)) {
                ("-", Value::Number(x, whole)) => Value::Number(x.negated(), whole),
                (_, truth) => Value::Truth(!truth.truth()),
            },
            Expr::Binary(operator, a, b) => self.binary(operator, a, b),
            Expr::Call(name, arguments) => {
                let arguments: Vec<Value> = arguments.iter().map(|e| self.value(e)).collect();
                self.site = site(expr);
                self.function = match name.as_str() {
                    "sin" => Some(Op::Sin),
                    "cos" => Some(Op::Cos),
                    "atan" => Some(Op::Atan2),
                    "acos" => Some(Op::Acos),
                    "exp" => Some(Op::Exp),
                    "log" => Some(Op::Log),
                    _ => None,
                };
                self.call(name, arguments)
            }
        }
    }

    fn binary(&mut self, operator: &str, a: &Expr, b: &Expr) -> Value {
        let left = self.value(a);
        match operator {
            "and" if !left.truth() => return Value::Truth(false),
            "or" if left.truth() => return Value::Truth(true),
            "and" | "or" => return Value::Truth(self.value(b).truth()),
            "is" => return Value::Truth(matches!(left, Value::Nothing)),
            _ => {}
        }
        let right = self.value(b);
        let (Value::Number(x, p), Value::Number(y, q)) = (&left, &right) else {
            panic!("{left:?} {operator} {right:?}");
        };
        // What a format's own roundoff makes is no number of an exact run.
        let seen = self.seen;
        let own = a.is_of("u") || b.is_of("u");
        self.site = site(b);
        let made = self.applied(operator, (x, y), *p && *q);
        if own {
            self.seen = seen;
        }
        made
    }

    fn applied(&mut self, operator: &str, (x, y): (&Big, &Big), whole: bool) -> Value {
        let order = x.compare(y);
        match operator {
            "+" => self.result(x.plus(y), whole),
            "-" => self.result(x.minus(y), whole),
            "*" => self.result(x.times(y), whole),
            "/" if y.is_zero() => self.senseless(),
            "/" => self.result(x.over(y), false),
            "//" => Value::Number(x.over(y).floor(), true),
            "%" => Value::Number(x.minus(&y.times(&x.over(y).floor())), whole),
            "**" => Value::real(Big::power(y.near() as i32)),
            "<" => Value::Truth(order == Ordering::Less),
            ">" => Value::Truth(order == Ordering::Greater),
            "<=" => Value::Truth(order != Ordering::Greater),
            ">=" => Value::Truth(order != Ordering::Less),
            "==" => Value::Truth(order == Ordering::Equal),
            "!=" => Value::Truth(order != Ordering::Equal),
            _ => panic!("no operator {operator}"),
        }
    }

    fn call(&mut self, name: &str, arguments: Vec<Value>) -> Value {
        let one = |k: usize| arguments.get(k).expect("an argument").number();
        let below = |least: Ordering| one(0).sign() < least;
        match name {
            "sqrt" if below(Ordering::Equal) => self.senseless(),
            "log" if below(Ordering::Greater) => self.senseless(),
            "sqrt" => self.result(one(0).sqrt(), false),
            "exp" => self.result(one(0).exp(), false),
            "log" => self.result(one(0).log(), false),
            "sin" => self.result(one(0).sin(), false),
            "cos" => self.result(one(0).cos(), false),
            "atan" => self.result(one(0).atan(), false),
            "acos" => self.result(one(0).acos(), false),
            "dot2" => {
                let products = [one(0).times(one(1)), one(2).times(one(3))];
                let sum = products[0].plus(&products[1]);
                // Two products that are rounded, where a machine has no such operation.
                self.within = products.iter().fold(0.0, |m, p| p.near().abs().max(m));
                self.result(sum, false)
            }
            "abs" => match &arguments[0] {
                Value::Number(x, whole) => Value::Number(x.magnitude(), *whole),
                other => panic!("abs of {other:?}"),
            },
            "min" | "max" => {
                let wanted = match name {
                    "min" => Ordering::Less,
                    _ => Ordering::Greater,
                };
                let mut all = arguments.into_iter();
                let first = all.next().expect("an argument");
                all.fold(first, |best, other| {
                    match other.number().compare(best.number()) {
                        order if order == wanted => other,
                        _ => best,
                    }
                })
            }
            "floor" => Value::Number(one(0).floor(), true),
            "range" => {
                let count = one(0).near() as u32;
                let whole = |n: u32| Value::Number(Big::new(f64::from(n)), true);
                Value::List((0..count).map(whole).collect())
            }
            // What the recipes of variation have besides.
            "between" => {
                let part = Big::new(self.random.as_mut().expect("a recipe").part());
                let long = one(1).minus(one(0));
                Value::real(one(0).plus(&long.times(&part)))
            }
            "whole" => {
                let count = one(1).minus(one(0)).near() as u64 + 1;
                let n = self.random.as_mut().expect("a recipe").next() % count;
                Value::Number(one(0).plus(&Big::new(n as f64)), true)
            }
            "either" => {
                let count = arguments.len() as u64;
                let n = self.random.as_mut().expect("a recipe").next() % count;
                arguments[n as usize].clone()
            }
            // The magnitude of a wanted result, where there is one.
            "size" => match &arguments[0] {
                Value::Number(x, _) => Value::real(x.magnitude()),
                _ => Value::real(Big::new(0.0)),
            },
            "bits" => Value::real(significant(one(0), one(1).near() as i32)),
            _ => Value::Called,
        }
    }
}

/// With so many significant bits, to nearest.
fn significant(x: &Big, bits: i32) -> Big {
    let Some(exponent) = x.exponent() else {
        return x.clone();
    };
    let scale = Big::power(bits - 1 - exponent);
    let half = Big::new(0.5);
    x.times(&scale).plus(&half).floor().over(&scale)
}
