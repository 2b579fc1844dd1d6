//! Reals with points of their own: read where they are wanted.

use super::code::{Code, READ};
use super::shapes::LEAST;
use crate::analysis::points::Points;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use slowlight_routine::{Op, Type, scale};
use slowlight_runtime_6502::scaled;
use slowlight_runtime_6502::write::{Place as Operand, Shape};

impl Code<'_> {
    /// An operation's operands as its routine wants them.
    pub(super) fn read_all(&mut self, id: NodeId, args: [NodeId; 2]) -> [Operand; 2] {
        let Node::Apply(op, _) = self.plan.graph.node(id) else {
            return args.map(|arg| self.homes.operand(self.plan, arg));
        };
        let points = self.plan.points().filter(|_| scale::concerns(op));
        let mut all = Vec::new();
        for (k, arg) in args.into_iter().enumerate() {
            let ty = op.args().get(k);
            let operand = match (points, ty) {
                (Some(points), Some(Type::Real)) => {
                    let again = k == 1 && arg == args[0];
                    let (to, width) = (points.scales(id).args, points.widths().operands(id));
                    if let Some(known) = self.known(id, k, to[k]) {
                        known
                    } else if again && to[0] == to[1] {
                        all.first().cloned().unwrap_or(Operand::Constant(0))
                    } else {
                        self.read_at(points, arg, (to[k], width), READ[k])
                    }
                }
                (Some(points), Some(Type::Int)) if op == Op::ToReal => {
                    let to = (points.scales(id).args[k], points.widths().operands(id));
                    self.read_at(points, arg, to, READ[k])
                }
                (_, None) => Operand::Constant(0),
                _ => self.homes.operand(self.plan, arg),
            };
            all.push(operand);
        }
        let mut all = all.into_iter();
        [(); 2].map(|()| all.next().unwrap_or(Operand::Constant(0)))
    }

    /// An operand of which the ranges leave one value only: routines are chosen for it as
    /// for a constant, so it is written as one.
    fn known(&self, id: NodeId, k: usize, to: i8) -> Option<Operand> {
        let range = self.plan.ranges.args.get(id.0 as usize)?.get(k)?;
        let units = scale::in_units(*range, to).constant()?;
        let width = self.plan.points()?.widths().operands(id);
        let held = units.fract() == 0.0 && units.abs() <= scale::most(width) as f64;
        held.then_some(Operand::Constant(units as i64 as u64))
    }

    /// Whether it is such an operand.
    pub(super) fn is_known(&self, id: NodeId, k: usize, to: i8) -> bool {
        self.known(id, k, to).is_some()
    }

    /// What an operation's routine has to know of scales.
    pub(super) fn number(&self, id: NodeId) -> i32 {
        match (self.plan.points(), self.plan.graph.node(id)) {
            (Some(points), Node::Apply(op, _)) => points.scales(id).number(op),
            _ => 0,
        }
    }

    /// Keeps a real at the other scales that pixels read it at.
    pub(super) fn keep_moved(&mut self, id: NodeId) {
        let Some(points) = self.plan.points() else {
            return;
        };
        for to in self.homes.scales_kept(id) {
            let Some(name) = self.homes.kept_at(id, to).map(str::to_owned) else {
                continue;
            };
            let from = self.homes.operand(self.plan, id);
            let own = points.own(id);
            self.text.line(format!("        ; {name}"));
            self.move_into(
                id,
                &from,
                i32::from(to) - i32::from(own),
                ((to, points.widths().most()), (&name, LEAST)),
            );
        }
    }

    /// A number with so many fraction bits in some width: where it is, or read into `into`.
    pub(super) fn read_at(
        &mut self,
        points: &Points,
        id: NodeId,
        to: (i8, u8),
        into: &str,
    ) -> Operand {
        let whole = to.1 == points.widths().most();
        if let Some(kept) = self.homes.kept_at(id, to.0).filter(|_| whole) {
            return Operand::At(kept.to_owned());
        }
        self.read_into(points, id, to, (into, LEAST))
    }

    /// The same in so many bytes at least.
    fn read_into(
        &mut self,
        points: &Points,
        id: NodeId,
        (to, width): (i8, u8),
        into: (&str, u8),
    ) -> Operand {
        let real = self.plan.graph.ty(id) == Type::Real;
        if let Some(value) = self.plan.graph.constant(id) {
            return Operand::Constant(match real {
                true => scale::nearest(value.real(), to, width),
                false => points.moved(value.int() as i64 as u64, 0, (to, width)),
            });
        }
        let own = if real { points.own(id) } else { 0 };
        let from = self.homes.operand(self.plan, id);
        let range = self.plan.ranges.result.get(id.0 as usize);
        let most = scale::most(width) as f64;
        let fits = range.is_some_and(|r| scale::in_units(*r, to).within(-most, most));
        // What is in more bytes than are wanted may not fit.
        if own == to && real && (fits || points.widths().value(id) <= width) {
            return from;
        }
        self.move_into(
            id,
            &from,
            i32::from(to) - i32::from(own),
            ((to, width), into),
        )
    }

    /// Reads a number with so many more fraction bits.
    fn move_into(
        &mut self,
        id: NodeId,
        from: &Operand,
        by: i32,
        ((to, width), (into, least)): ((i8, u8), (&str, u8)),
    ) -> Operand {
        let range = self.plan.ranges.result.get(id.0 as usize);
        let within = |bytes: u8| {
            let most = scale::most(8 * bytes) as f64;
            range.is_some_and(|r| scale::in_units(*r, to).within(-most, most))
        };
        let whole = width / 8;
        let bytes = (least..whole).find(|bytes| within(*bytes)).unwrap_or(whole);
        let fits = within(bytes);
        let mut lines = Vec::new();
        let serial = self.text.next_serial();
        let read = scaled::Read {
            from,
            by,
            fits,
            to: into,
            bytes,
            serial,
            pace: match (self.quick, self.plan.tight) {
                (true, _) => scaled::Pace::Quick,
                (_, true) => scaled::Pace::Short,
                _ => scaled::Pace::Usual,
            },
        };
        self.needs.extend(scaled::read(read, &mut lines));
        lines.iter().for_each(|line| self.text.line(line));
        match bytes < whole {
            true => Operand::Held(into.to_owned(), Shape::whole(bytes)),
            false => Operand::At(into.to_owned()),
        }
    }

    /// Whether a place has another scale than what it is given.
    pub(super) fn moves(&self, place: Place, from: NodeId) -> bool {
        let real = self.plan.graph.ty(from) == Type::Real;
        let points = self.plan.points().filter(|_| real);
        let undefined = matches!(self.plan.graph.node(from), Node::Undefined(_));
        points.is_some_and(|points| {
            !undefined
                && (self.plan.graph.constant(from).is_some()
                    || points.place(place) != points.own(from)
                    || points.widths().place(place) < points.widths().value(from))
        })
    }

    /// Gives a param, which is a state, a real of another scale.
    pub(super) fn give_real(&mut self, state: ParamId, to: (&str, u8), from: NodeId) {
        let known = self.plan.points().zip(self.plan.param_node(state));
        let Some((points, node)) = known else {
            return;
        };
        let (own, width) = (points.own(node), points.widths().place(Place::Node(node)));
        let read = self.read_into(points, from, (own, width), to);
        let there = matches!(&read, Operand::At(name) | Operand::Held(name, _) if name == to.0);
        if !there {
            self.copy_bytes(&read, to);
        }
    }

    /// Gives a place a real of another scale.
    pub(super) fn set_real(&mut self, place: Place, to: &str, from: NodeId) {
        let Some(points) = self.plan.points() else {
            return;
        };
        let bytes = self
            .homes
            .shape(self.plan, place)
            .map_or(LEAST, |s| s.bytes);
        let read = self.read_into(
            points,
            from,
            (points.place(place), points.widths().place(place)),
            (to, bytes),
        );
        let there = matches!(&read, Operand::At(name) | Operand::Held(name, _) if name == to);
        if !there {
            self.copy_into(&read, to, place);
        }
    }
}
