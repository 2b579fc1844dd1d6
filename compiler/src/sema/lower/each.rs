//! `each`: what it repeats, written out, its counter a constant in each copy.

use super::value::Val;
use super::{Found, Lower, Options};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use std::rc::Rc;

/// Copies that an `each` may make, and shapes that a scene with one may have.
const COPIES: usize = 1000;

/// A shape of a scene, and the numbers that the `each`s around it have reached.
pub(super) struct Placed<'a> {
    pub(super) shape: &'a Body,
    pub(super) tag: Option<&'a Body>,
    counters: Vec<i32>,
}

impl Placed<'_> {
    /// The counters, as the first locals.
    pub(super) fn locals(&self) -> Vec<Val> {
        numbers(&self.counters)
    }

    /// What is wrong with this copy alone, perhaps.
    pub(super) fn wrong(&self, error: Box<Diagnostic>) -> Box<Diagnostic> {
        let names = self.shape.locals.iter().map(|local| local.name.as_str());
        let counters = names.zip(self.counters.iter().copied());
        in_copy(error, counters, self.shape.value.span)
    }
}

/// Says in which copy something is wrong.
fn in_copy<'n>(
    error: Box<Diagnostic>,
    counters: impl Iterator<Item = (&'n str, i32)>,
    span: Span,
) -> Box<Diagnostic> {
    let all: Vec<String> = counters.map(|(k, n)| format!("`{k}` is {n}")).collect();
    match all.is_empty() {
        true => error,
        false => Box::new(error.also(span, format!("in the copy where {}", all.join(", ")))),
    }
}

fn numbers(counters: &[i32]) -> Vec<Val> {
    counters.iter().map(|&number| Val::Number(number)).collect()
}

/// How many shapes the largest of a program's scenes has; those that options are wrong for have
/// none.
pub fn most_shapes(program: &Program, options: &Options) -> usize {
    let Some(image) = &program.image else {
        return 0;
    };
    let mut lower = Lower::new(program, options, image);
    lower.declare_params(&mut Vec::new());
    let scenes = program.scenes.iter().enumerate();
    let counts = scenes.map(|(k, scene)| lower.placed(SceneId(k), scene.span));
    counts
        .map(|all| all.map_or(0, |all| all.len()))
        .max()
        .unwrap_or(0)
}

impl<'a> Lower<'a> {
    /// Looks at every scene, used or not.
    pub(super) fn place_scenes(&mut self, said: &mut Vec<Diagnostic>) {
        self.declare_params(&mut Vec::new());
        for (k, scene) in self.program.scenes.iter().enumerate() {
            if let Err(error) = self.placed(SceneId(k), scene.span) {
                said.push(*error);
            }
        }
    }

    /// A scene's shapes in their order, found once.
    pub(super) fn placed(&mut self, id: SceneId, span: Span) -> Found<Rc<[Placed<'a>]>> {
        if let Some(found) = self.placed.get(&id) {
            return Ok(found.clone());
        }
        let Some(scene) = self.program.scenes.get(id.0) else {
            return Err(self.confused(span));
        };
        let mut found = Vec::new();
        let place = self.place.take();
        let done = self.place_all(&scene.members, &mut Vec::new(), &mut found);
        self.place = place;
        done?;
        if found.is_empty() {
            let error = Diagnostic::error(scene.span, "a scene has at least one shape");
            return Err(Box::new(
                error.help("here no `each` has any number to count"),
            ));
        }
        let found: Rc<[Placed<'a>]> = found.into();
        self.placed.insert(id, found.clone());
        Ok(found)
    }

    // Recursion is bounded: the parser nests no deeper than its limit.
    fn place_all(
        &mut self,
        members: &'a [Member],
        counters: &mut Vec<i32>,
        found: &mut Vec<Placed<'a>>,
    ) -> Found<()> {
        for member in members {
            match member {
                Member::One { shape, tag } => found.push(Placed {
                    shape,
                    tag: tag.as_ref(),
                    counters: counters.clone(),
                }),
                Member::Each {
                    low,
                    high,
                    members,
                    span,
                    ..
                } => {
                    let args = numbers(counters);
                    let low = self.enter(low, args.clone(), |l| l.bound(&low.value))?;
                    let high = self.enter(high, args, |l| l.bound(&high.value))?;
                    for number in self.numbers_of(low, high, *span)? {
                        self.step(*span)?;
                        counters.push(number);
                        let done = self.place_all(members, counters, found);
                        counters.pop();
                        done?;
                        if found.len() > COPIES {
                            let message =
                                format!("a scene with `each` has {COPIES} shapes at most");
                            return Err(Box::new(self.error(*span, message).help(FEWER)));
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// A bound of an `each`.
    fn bound(&mut self, e: &'a Expr) -> Found<i32> {
        if let ExprKind::Int(written) = e.kind {
            return Ok(written);
        }
        self.constant += 1;
        let node = self
            .expr(e)
            .and_then(|value| self.node(value, &Ty::Int, e.span));
        self.constant -= 1;
        match self.b.value(node?) {
            Some(value) => Ok(value.int()),
            None => {
                let error = self.error(e.span, "a bound of `each` must be constant");
                Err(Box::new(error.help(
                    "it may use numbers, `const`s, functions of these, and what an `each` around it counts",
                )))
            }
        }
    }

    /// What an `each` counts, both bounds included.
    fn numbers_of(
        &mut self,
        low: i32,
        high: i32,
        span: Span,
    ) -> Found<std::ops::RangeInclusive<i32>> {
        let count = (i64::from(high) - i64::from(low) + 1).max(0);
        if count > COPIES as i64 {
            let message = format!("this `each` makes {count} copies, {COPIES} at most may be");
            return Err(Box::new(self.error(span, message).help(FEWER)));
        }
        Ok(low..=high)
    }

    /// `union each k in 0 .. 9 { .. }`
    pub(super) fn joined_each(&mut self, each: &'a Each, span: Span) -> Found<Val> {
        let (low, high) = (self.bound(&each.low)?, self.bound(&each.high)?);
        if low > high {
            let message = format!("there is nothing to join from {low} to {high}");
            let error = self.error(each.low.span.to(each.high.span), message);
            let help = "an `each` that joins has at least one number to count";
            return Err(Box::new(error.help(help)));
        }
        let numbers: Vec<i32> = self.numbers_of(low, high, span)?.collect();
        self.joined(each, &numbers, span)
    }

    /// What is made for these numbers, joined in pairs, and these again: of four, (1 2) (3 4).
    fn joined(&mut self, each: &'a Each, numbers: &[i32], span: Span) -> Found<Val> {
        self.step(span)?;
        if let &[number] = numbers {
            self.put(each.counter, Val::Number(number));
            let name = self.locals.get(each.counter.0);
            let name = name.map_or("", |local| local.name.as_str());
            let counter = std::iter::once((name, number));
            let made = self.expr(&each.body);
            return made.map_err(|error| in_copy(error, counter, each.body.span));
        }
        let (left, right) = numbers.split_at(numbers.len().div_ceil(2));
        let (left, right) = (
            self.joined(each, left, span)?,
            self.joined(each, right, span)?,
        );
        self.put(each.left, left);
        self.put(each.right, right);
        self.expr(&each.join)
    }

    /// Binds a local without a name: none is written where copies are.
    fn put(&mut self, local: LocalId, value: Val) {
        if let Some(slot) = self.frame.get_mut(local.0) {
            *slot = value;
        }
    }
}

/// The way out of too many copies.
const FEWER: &str = "every copy is code or a table's row of its own; draw fewer";
