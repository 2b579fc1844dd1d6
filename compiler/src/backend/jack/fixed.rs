//! Fixed-point reals in statements: ints, read at the scale that is wanted.

use super::Line;
use super::code::Code;
use super::expression::{Expression, int};
use super::line;
use crate::analysis::points::Points;
use crate::ir::graph::*;
use crate::plan::ParamPlan;
use crate::wordlength::divided;
use slowlight_routine::{Form, Format, Routine, Type, scale};
use slowlight_runtime_jack::fixed::{self, BITS};
use slowlight_runtime_jack::model;

impl<'p> Code<'p> {
    /// Where reals have their points, where each has its own.
    pub fn points(&self) -> Option<&'p Points> {
        self.plan.points()
    }

    /// Whether a real is an int, so that nothing need be made for it.
    pub fn real_is_int(&self) -> bool {
        self.logs() || self.points().is_some()
    }

    /// A real where it is used, with so many fraction bits.
    pub fn read_at(&mut self, points: &Points, id: NodeId, to: i8) -> Expression {
        let graph = &self.plan.graph;
        if let Some(value) = graph.constant(id) {
            let bits = scale::nearest(value.real(), to, BITS);
            return int(model::int(bits));
        }
        let own = points.own(id);
        let range = self.plan.ranges.result.get(id.0 as usize);
        let most = scale::most(BITS) as f64;
        let fits = range.is_some_and(|r| scale::in_units(*r, to).within(-most, most));
        let value = self.read(id);
        let by = i32::from(to) - i32::from(own);
        let (text, level, need) = fixed::read((&value.text, value.level), by, fits);
        self.needs.extend(need);
        Expression { text, level }
    }

    /// An operation's expression.
    pub fn fixed(&mut self, points: &Points, id: NodeId, routine: &Routine) -> Expression {
        let (
            Node::Apply(op, args),
            Form::Expression {
                template,
                level,
                operands,
            },
        ) = (self.plan.graph.node(id), routine.form)
        else {
            return Expression::term("0");
        };
        let scales = points.scales(id);
        let mut text = fixed::filled(template, scales.number(op));
        let mut whole = None;
        let of = op.args().iter().zip(args).zip(scales.args);
        for (k, ((ty, arg), to)) in of.enumerate() {
            let hole = format!("{{{k}}}");
            if !text.contains(&hole) {
                continue;
            }
            let read = match ty {
                Type::Bool => self.read(arg),
                // Of scale 0 itself, which is 0 for what is no real.
                _ => self.read_at(points, arg, to),
            };
            if text == hole {
                whole = Some(read.level);
            }
            let level = operands.get(k).copied().unwrap_or_default();
            let read = match whole {
                Some(_) => read.text,
                None => read.at(level),
            };
            text = text.replace(&hole, &read);
        }
        Expression {
            text,
            level: whole.unwrap_or(level),
        }
    }

    /// What stands behind a line that computes a real: its meaning and its last place.
    pub fn fixed_said(&mut self, points: &Points, id: NodeId, text: &str) -> String {
        if self.plan.graph.ty(id) != Type::Real || !text.contains('(') {
            return String::new();
        }
        match self.plan.graph.node(id) {
            Node::Apply(..) => format!(" // {}; 2^-{}", self.meaning(id), points.own(id)),
            _ => String::new(),
        }
    }

    /// Takes a param from its whole number.
    pub fn take_fixed(
        &mut self,
        points: &Points,
        (value, label): (&str, &str),
        (at, param): (usize, &ParamPlan),
    ) -> Line {
        let graph = &self.plan.graph;
        let is = |id: &NodeId| graph.node(*id) == Node::Param(ParamId(at as u32));
        let own = graph.ids().find(is).map_or(0, |id| points.own(id));
        let Some(digits) = param.digits else {
            // Given by its bits.
            return line(&format!(
                "let {value} = {};",
                int(model::int(param.bits)).text
            ));
        };
        let unit = 10i32.saturating_pow(u32::from(digits));
        let routine = divided(self.plan.runtime, own).filter(|_| digits > 0);
        let text = match routine.map(|routine| (routine, routine.form)) {
            Some((routine, Form::Expression { template, .. })) => {
                self.needs.extend(routine.needs);
                let text = fixed::filled(template, i32::from(own));
                text.replace("{0}", label).replace("{1}", &unit.to_string())
            }
            _ => {
                let (text, _, need) = fixed::read((label, 1), i32::from(own), false);
                self.needs.extend(need);
                text
            }
        };
        line(&format!(
            "let {value} = {text}; // {label} / {unit}; 2^-{own}"
        ))
    }

    /// What a pixel sends, added to what stands there.
    pub fn gather_fixed(&mut self, points: &Points, there: &str, share: NodeId) -> String {
        let template = match self.plan.gather().map(|routine| routine.form) {
            Some(Form::Expression { template, .. }) => template,
            _ => "{0}",
        };
        let sent = self.read_at(points, share, points.received());
        let text = template.replace("{0}", there).replace("{1}", &sent.text);
        format!("let {there} = {text};")
    }
}

/// Whether a variable's format is a real's in fixed point.
pub(super) fn is_fixed(format: Format) -> bool {
    matches!(format, Format::Fixed { .. })
}
