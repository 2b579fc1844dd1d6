//! Error bounds in fixed point: what the walk does where each real has a point of its own: values
//! are read at the points that operations want, and a last place is the value's own.

use super::Value;
use super::form::Form;
use super::walk::Walk;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use slowlight_routine::{Format, Op, Range, Routine, Type, scale};

impl Walk<'_> {
    /// The operands of an operation as it reads them.
    pub(super) fn operands(&mut self, id: NodeId, op: Op, args: [NodeId; 2]) -> [Value; 2] {
        let [a, b] = args;
        let values = [self.read(a), self.read(b)];
        let Some(points) = self.plan.points().filter(|_| scale::concerns(op)) else {
            return values;
        };
        let scales = points.scales(id).args;
        let width = points.widths().operands(id);
        let [x, y] = values;
        let x = self.read_at(
            a,
            x,
            (scales[0], width),
            op.args().first() == Some(&Type::Int) && op != Op::ToReal,
        );
        match op.arity() {
            2 if a == b && scales[0] == scales[1] => [x.clone(), x],
            2 => [
                x,
                self.read_at(
                    b,
                    y,
                    (scales[1], width),
                    op.args().get(1) == Some(&Type::Int),
                ),
            ],
            _ => [x, y],
        }
    }

    /// What a place has that is given a node's value.
    pub(super) fn copied(&mut self, place: Place, from: NodeId) -> Value {
        let value = self.read(from);
        match self
            .plan
            .points()
            .filter(|_| self.graph.ty(from) == Type::Real)
        {
            Some(points) => {
                let width = points.widths().place(place);
                self.read_at(from, value, (points.place(place), width), false)
            }
            None => value,
        }
    }

    /// A node's value read with so many fraction bits, unless it stays an int.
    fn read_at(&mut self, id: NodeId, value: Value, (to, bits): (i8, u8), int: bool) -> Value {
        let Some(points) = self.plan.points().filter(|_| !int) else {
            return value;
        };
        let format = Format::Fixed { bits, frac: to };
        let real = self.graph.ty(id) == Type::Real;
        if let Some(exact) = self.graph.constant(id).filter(|_| real) {
            let bits = points.read(self.graph, id, 0, (to, bits));
            let made = (self.plan.runtime.decode)(bits, format).real();
            return Value {
                range: value.range,
                error: Form::within((made - exact.real()).abs()),
            };
        }
        let place = format.epsilon();
        // Beyond the format's end it saturates.
        if value.machine().magnitude() > format.most() - place {
            return Value {
                range: value.range,
                error: Form::unbounded(),
            };
        }
        let own = if real { points.own(id) } else { 0 };
        if to >= own {
            return value;
        }
        self.sources += 1;
        Value {
            range: value.range,
            error: value.error.plus(&Form::rounding(self.sources, place / 2.0)),
        }
    }

    /// By how much a routine may round, given the machine's operands and the exact result
    /// of these.
    pub(super) fn rounding(
        &self,
        routine: &Routine,
        id: NodeId,
        op: Op,
        (args, made): (&[Range], Range),
    ) -> f64 {
        let Some(points) = self.plan.points() else {
            return routine.error.most(args, made.magnitude());
        };
        let (args, units) = points.in_units(id, op, args, made);
        routine.error.most(&args, units.magnitude()) * self.plan.format(id).epsilon()
    }
}
