//! Tests in place of guards: where the ranges do not prove that an expression
//! of BASIC is right, a program that is to be quick tests its arguments, and
//! calls the total function only for the rest.
//!
//! A test reads its argument beside the expression, so the argument gets a
//! variable of its own.

use super::Style;
use super::expression::Expressions;
use super::text::{Fast, Text};
use crate::ir::graph::NodeId;
use crate::ir::tree::Place;
use slowlight_routine::{Form, Format, Range, Value};
use slowlight_runtime_bbc::RUNTIME;
use slowlight_runtime_bbc::guards::{self, Test};

/// More tests than this take as long as the call that they save.
const TESTS: usize = 3;

/// BASIC's integers lie within this; the least has no size.
const LEAST: f64 = -2_147_483_648.0;

/// How a routine is written under tests.
pub struct Guard {
    pub form: Form,
    pub tests: Vec<String>,
    pub below: Option<f64>,
    pub otherwise: Option<&'static str>,
}

impl Expressions<'_> {
    /// How a routine may be left out, if it is one of those that may.
    pub fn guard(&mut self, id: NodeId, name: &str, args: &[NodeId]) -> Option<Guard> {
        let assumed = self.assumed.get(&id).copied();
        if self.calls || self.style != Style::Fast && assumed.is_none() {
            return None;
        }
        let guarded = guards::guard(name)?;
        let cheap = RUNTIME.routines.iter().find(|r| r.name == guarded.cheap)?;
        let mut tests = Vec::new();
        for &(k, test) in guarded.when {
            let arg = *args.get(k)?;
            let known = self.plan.ranges.args.get(id.0 as usize).copied();
            let ranges = assumed.or(known);
            let range = ranges.and_then(|r| r.get(k).copied());
            let range = range.unwrap_or(Range::ALL);
            if test.proved(range) || self.stays(arg, test) {
                continue;
            }
            if self.style != Style::Fast {
                return None;
            }
            if !self.simple(arg) {
                return None;
            }
            let text = self.read(arg).text;
            let int = matches!(cheap.args.get(k), Some(Format::Int { .. }));
            tests.push(self.test(test, &text, range, int));
        }
        for (k, arg) in args.iter().enumerate() {
            if cheap.form.repeats(k) {
                self.simple(*arg);
            }
        }
        Some(Guard {
            form: cheap.form,
            tests,
            below: guarded.below,
            otherwise: guarded.otherwise,
        })
    }

    /// Whether the tests of an operand imply this one.
    fn stays(&mut self, arg: NodeId, test: Test) -> bool {
        let below = self.read(arg).fast.and_then(|f| f.below);
        matches!((test, below), (Test::Below(most), Some(below)) if below <= most)
    }

    /// A test as text. `int`: the argument is whole in BASIC, too.
    fn test(&mut self, test: Test, text: &str, range: Range, int: bool) -> String {
        let whole = int || range.within(LEAST, -LEAST);
        let mut number = |x: f64| self.constant(Value::Real(x)).text;
        match test {
            Test::Below(most) if range.lo > -most => format!("{text}<{}", number(most)),
            Test::Below(most) if range.hi < most => format!("{text}>{}", number(-most)),
            Test::Below(most) if whole && range.lo <= LEAST => {
                format!("{text}>{} AND {text}<{}", number(-most), number(most))
            }
            Test::Below(most) => format!("ABS({text})<{}", number(most)),
            Test::Above(least) if range.lo >= 0.0 => format!("{text}>{}", number(least)),
            Test::Above(least) if range.hi <= 0.0 => format!("{text}<{}", number(-least)),
            Test::Above(least) => format!("ABS({text})>{}", number(least)),
            Test::Least(least) => format!("{text}>={}", number(least)),
            Test::More(least) => format!("{text}>{}", number(least)),
        }
    }

    /// Sees to it that a value is a variable or a number; whether it is.
    pub fn simple(&mut self, id: NodeId) -> bool {
        let text = self.read(id);
        if text.is_simple() {
            return true;
        }
        if !self.unfold(id) {
            return false;
        }
        let home = self.names.home(Place::Node(id)).to_owned();
        self.before.push((home, text));
        true
    }

    /// The guard of an expression whose tests are few: operands with tests of
    /// their own are assigned before, one by one, until they are.
    pub fn few_tests(&mut self, id: NodeId, name: &str, args: &[NodeId]) -> Option<Guard> {
        loop {
            // What an operand's tests imply changes with the operand.
            let guard = self.guard(id, name, args);
            let count = |e: &mut Self, arg: NodeId| e.read(arg).fast.map_or(0, |f| f.tests.len());
            let inner: usize = args.iter().map(|arg| count(self, *arg)).sum();
            let own = guard.as_ref().map_or(0, |g| g.tests.len());
            let tested = args.iter().copied().find(|arg| count(self, *arg) > 0);
            match tested {
                Some(arg) if own + inner > TESTS && self.simple(arg) => {}
                _ => return guard,
            }
        }
    }

    /// An expression under all its tests.
    pub fn fast<'t>(
        &self,
        operands: &'t [Text],
        own: impl Iterator<Item = &'t String>,
        text: Text,
        below: Option<f64>,
    ) -> Option<Fast> {
        let inner = operands.iter().filter_map(|o| o.fast.as_ref());
        let mut tests: Vec<String> = Vec::new();
        for test in inner.flat_map(|f| f.tests.iter()).chain(own) {
            if !tests.contains(test) {
                tests.push(test.clone());
            }
        }
        (self.style != Style::Listing).then_some(Fast {
            text: text.text,
            level: text.level,
            tests,
            below,
            otherwise: None,
        })
    }
}
