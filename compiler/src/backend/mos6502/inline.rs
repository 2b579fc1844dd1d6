//! Products written in place at pixels, where the program has memory for that.

use super::code::{Code, READ};
use crate::ir::graph::*;
use crate::ir::tree::Place;
use slowlight_routine::{Form, Format, Type};
use slowlight_runtime_6502::scaled::{copied, inline, inline_byte};
use slowlight_runtime_6502::write::{Place as Operand, copy_bytes, shift_of_one};

impl Code<'_> {
    /// Writes a value that is only another one, at another scale perhaps; whether it is
    /// such.
    pub(super) fn copied(&mut self, id: NodeId, args: [NodeId; 2]) -> bool {
        let (Some(routine), Some(points)) = (self.plan.routine(id), self.plan.points()) else {
            return false;
        };
        // Of more bytes a home may have fewer than the format.
        let width = points.widths().operation(id);
        if width > 16 {
            return false;
        }
        let Form::Statement(text) = routine.form else {
            return false;
        };
        let real = Format::Scaled { bits: width };
        let (Some(k), true) = (copied(text), routine.result == real) else {
            return false;
        };
        let scale = points.scales(id).args[k];
        let (arg, place) = (args[k], Place::of(&self.plan.graph, id));
        if self.is_known(id, k, scale) || self.plan.graph.ty(arg) == Type::Bool {
            return false;
        }
        let home = self.homes.place(place).to_owned();
        let read = self.read_at(points, arg, (scale, width), &home);
        if read != Operand::At(home.clone()) {
            self.copy(&read, &home, routine.result);
        }
        true
    }

    /// Writes a product or one over a value in place; whether it is such, and may be.
    pub(super) fn inline(&mut self, id: NodeId, args: &[Operand; 2]) -> bool {
        let (Some(routine), Node::Apply(_, nodes)) =
            (self.plan.routine(id), self.plan.graph.node(id))
        else {
            return false;
        };
        let Form::Statement(text) = routine.form else {
            return false;
        };
        let one_over = inline::is_one_over(text);
        let byte = inline_byte::bits(text, self.number(id));
        if !self.quick || !(one_over || byte.is_some() || inline::can(text)) {
            return false;
        }
        let ranges = self.plan.ranges.args.get(id.0 as usize);
        let positive = [0, 1].map(|k| {
            let range = ranges.and_then(|all| all.get(k));
            range.is_some_and(|range| range.lo >= 0.0)
        });
        let home = self.homes.place(Place::of(&self.plan.graph, id)).to_owned();
        let serial = self.text.next_serial();
        let [a, b] = &match byte {
            Some(_) => args.clone(),
            None => self.extended(args),
        };
        let mut lines = Vec::new();
        if one_over {
            if positive[1] {
                let bits = shift_of_one(Some(a), self.number(id), 16);
                inline::one_over(b, bits, &home, serial, &mut lines);
                lines.iter().for_each(|line| self.text.line(line));
            }
            return positive[1];
        }
        let kept = self.text.kept.clone();
        let used = inline::Inline {
            args: [a, b],
            positive,
            kept: kept.as_deref(),
            again: nodes.iter().position(|node| self.ahead.contains(node)),
            to: &home,
            serial,
        };
        let pointed = match (byte, a == b) {
            (Some(bits), _) => match inline_byte::product(bits, used, &mut lines) {
                true => None,
                false => kept.clone(),
            },
            (None, true) => {
                inline::square(text, used, &mut lines);
                None
            }
            (None, false) => inline::product(text, used, &mut lines),
        };
        lines.iter().for_each(|line| self.text.line(line));
        self.text.kept = pointed.filter(|symbol| *symbol != home);
        true
    }

    /// Operands in all bytes that a product in place reads, as templates have them too.
    fn extended(&mut self, args: &[Operand; 2]) -> [Operand; 2] {
        let mut made = args.clone();
        for k in 0..2 {
            let short =
                matches!(&args[k], Operand::Held(_, shape) if shape.signed && shape.bytes < 2);
            if k == 1 && args[1] == args[0] {
                made[1] = made[0].clone();
            } else if short {
                let mut lines = Vec::new();
                copy_bytes(&args[k], READ[k], 2, &mut lines);
                lines.iter().for_each(|line| self.text.line(line));
                made[k] = Operand::At(READ[k].to_owned());
            }
        }
        made
    }
}
