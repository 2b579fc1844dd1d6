//! Transition functions: states' next values, of states, params, what a player holds and the
//! picture's number.
//!
//! A state is a param to the picture. Its next value, kept within its range, is what the graph
//! reports; all are of the states as they are, so that they step together.

use super::value::Val;
use super::{Found, Lower};
use crate::ir::graph::{self, Button, NodeId, Role};
use crate::source::{Diagnostic, Span};
use slowlight_routine::{Op, Range, Type};

/// The last number of a picture; the next is 0 again. The least of the machines' ints has it.
pub const LAST_PICTURE: i32 = 32767;

/// What moves beside the scene's own states.
#[derive(Default)]
pub(super) struct Steps {
    /// Whether a next value is being worked out.
    stepping: bool,
    /// The picture's number, where something asks for it.
    picture: Option<NodeId>,
    /// What is held, where something asks for it.
    buttons: [Option<NodeId>; 5],
}

impl<'a> Lower<'a> {
    /// Reports every state's next value, in the order of the states.
    pub(super) fn next_values(&mut self) -> Found<()> {
        let mut next = Vec::new();
        self.steps_on.stepping = true;
        for (at, param) in self.program.params.iter().enumerate() {
            let Some(body) = &param.next else {
                continue;
            };
            let span = body.value.span;
            let value = self.enter(body, Vec::new(), |l| {
                let value = l.expr(&body.value)?;
                l.force(value)
            })?;
            let mut nodes = Vec::new();
            self.flatten(value, &param.ty, &mut nodes, span)?;
            let state = self.params.get(at).cloned().unwrap_or(Val::Undefined);
            let mut states = Vec::new();
            self.flatten(state, &param.ty, &mut states, span)?;
            for (node, state) in nodes.into_iter().zip(states) {
                let range = self.b.param_at(state).and_then(|p| p.range);
                next.push(match range {
                    Some(range) => self.kept(node, range, span)?,
                    None => node,
                });
            }
        }
        self.steps_on.stepping = false;
        if let Some(picture) = self.steps_on.picture {
            let span = self.b.param_at(picture).map_or(Span::default(), |p| p.span);
            let [one, last, first] = [1, LAST_PICTURE, 0].map(|n| self.int(n, span));
            let more = self.apply(Op::IntAdd, &[picture, one], span)?;
            let on = self.apply(Op::IntLess, &[picture, last], span)?;
            next.push(self.select(on, more, first, span));
        }
        next.into_iter().for_each(|node| self.b.report(node));
        Ok(())
    }

    /// A value, or the end of its range that it is beyond.
    fn kept(&mut self, node: NodeId, range: Range, span: Span) -> Found<NodeId> {
        let (low, high, least, greatest) = match self.b.ty(node) {
            Type::Real => {
                let [low, high] = [range.lo, range.hi].map(|end| self.real(end, span));
                (low, high, Op::Max, Op::Min)
            }
            Type::Int => {
                let [low, high] = [range.lo, range.hi].map(|end| self.int(end as i32, span));
                (low, high, Op::IntMax, Op::IntMin)
            }
            Type::Bool => return Ok(node),
        };
        let node = self.apply(least, &[node, low], span)?;
        self.apply(greatest, &[node, high], span)
    }

    /// How many pictures there were before this one.
    pub(super) fn picture_number(&mut self, span: Span) -> Found<Val> {
        if self.constant > 0 {
            return Err(self.no_constant("picture", span));
        }
        if !self.options.moves {
            return Ok(Val::Node(self.int(0, span)));
        }
        let picture = match self.steps_on.picture {
            Some(picture) => picture,
            None => self.given_number("picture", "", Role::State, f64::from(LAST_PICTURE), span),
        };
        self.steps_on.picture = Some(picture);
        Ok(Val::Node(picture))
    }

    /// All that a player holds, as the library's record has it.
    pub(super) fn input(&mut self, span: Span) -> Found<Val> {
        let parts: Found<Vec<Val>> = (0..Button::ALL.len() + 2)
            .map(|at| Ok(Val::Node(self.held(at, span)?)))
            .collect();
        Ok(Val::parts(parts?))
    }

    /// A field of that record: whether a button is held, or an axis.
    pub(super) fn held(&mut self, at: usize, span: Span) -> Found<NodeId> {
        if self.constant > 0 {
            return Err(self.no_constant("input", span));
        }
        if !self.steps_on.stepping {
            let message = "`input` is what a player holds between two pictures: only a state's \
                           next value may ask for it";
            let error = self.error(span, message);
            return Err(Box::new(error.help(
                "keep it in a state: `state fired: int = 0 in 0 .. 1 -> input.fire;`",
            )));
        }
        let axis = |positive: Button, negative: Button| (positive as usize, negative as usize);
        let (positive, negative) = match at {
            5 => axis(Button::Right, Button::Left),
            6 => axis(Button::Down, Button::Up),
            _ => return self.button(at, span),
        };
        let (positive, negative) = (self.button(positive, span)?, self.button(negative, span)?);
        self.apply(Op::IntSub, &[positive, negative], span)
    }

    fn button(&mut self, at: usize, span: Span) -> Found<NodeId> {
        let Some(&button) = Button::ALL.get(at) else {
            return Err(self.confused(span));
        };
        if let Some(node) = self.steps_on.buttons.get(at).copied().flatten() {
            return Ok(node);
        }
        let node = self.given_number("input", button.name(), Role::Input(button), 1.0, span);
        if let Some(known) = self.steps_on.buttons.get_mut(at) {
            *known = Some(node);
        }
        Ok(node)
    }

    /// An int from 0 up that the scene does not declare.
    fn given_number(
        &mut self,
        name: &str,
        component: &'static str,
        role: Role,
        most: f64,
        span: Span,
    ) -> NodeId {
        self.b.param(graph::Param {
            name: name.to_owned(),
            component,
            role,
            ty: Type::Int,
            value: 0.0,
            usual: 0.0,
            range: Some(Range::new(0.0, most)),
            span: self.at(span),
        })
    }

    fn no_constant(&self, name: &str, span: Span) -> Box<Diagnostic> {
        let error = self.error(span, format!("a constant cannot depend on `{name}`"));
        Box::new(error.help("make it a function"))
    }
}
