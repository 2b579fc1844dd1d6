//! Pencils of rays: those of one place in a scene's text that all pass one point, or are parallel.
//!
//! A camera's rays start at its eye. Those that ask whether a lamp is seen lead to it, from points
//! that are lifted off their surface; those of a sun have one direction. What such a ray may meet
//! hangs on two numbers, where for any ray it is four.

use super::projection::Pencil;
use super::value::Val;
use super::{Found, Lower};
use crate::ir::graph::{Node, NodeId};
use crate::sema::ty::Ty;
use crate::source::Span;
use crate::syntax::tree::BinaryOp;
use slowlight_routine::Op;

impl Lower<'_> {
    /// What a ray has in common with those of all other pixels; none where nothing is known.
    pub(super) fn pencil_of(&mut self, ray: &Val, span: Span) -> Found<Option<Pencil>> {
        let [from, dir] = self.start_and_direction(ray, span)?;
        if let Some(point) = self.constants(from) {
            return Ok(Some(Pencil::from(point)));
        }
        if let Some(dir) = self.constants(dir) {
            return Ok(Some(Pencil::Along(dir)));
        }
        Ok(self.towards(from, dir))
    }

    /// The point at which a ray starts that a loop carries, in the loop's first turn, and whether
    /// it starts there: a bool.
    pub(super) fn first_pencil(
        &mut self,
        ray: &Val,
        span: Span,
    ) -> Found<Option<(Pencil, NodeId)>> {
        let [from, _] = self.start_and_direction(ray, span)?;
        let starts = from.map(|node| match self.b.node(node) {
            Node::Carried { of, index } => {
                let carried = self.b.loop_of(of)?.init.get(index as usize);
                carried.copied()
            }
            _ => None,
        });
        let [Some(x), Some(y), Some(z)] = starts else {
            return Ok(None);
        };
        let Some(point) = self.constants([x, y, z]) else {
            return Ok(None);
        };
        let mut all = self.bool(true, span);
        for (at, start) in from.into_iter().zip([x, y, z]).rev() {
            let equal = self.scalar(BinaryOp::Eq, &Ty::Real, at, start, span)?;
            let no = self.bool(false, span);
            all = self.select(equal, all, no, span);
        }
        Ok(Some((Pencil::from(point), all)))
    }

    /// The coordinates of where a ray starts and of its direction.
    pub(super) fn start_and_direction(&mut self, ray: &Val, span: Span) -> Found<[[NodeId; 3]; 2]> {
        let of = |l: &mut Self, part| {
            let vector = l.part(ray.clone(), part, span)?;
            let nodes = l.vector(vector, 3, span)?;
            <[NodeId; 3]>::try_from(nodes).map_err(|_| l.confused(span))
        };
        Ok([of(self, 0)?, of(self, 1)?])
    }

    fn constants(&self, of: [NodeId; 3]) -> Option<[f64; 3]> {
        let [x, y, z] = of.map(|node| self.b.value(node).map(|v| v.real()));
        Some([x?, y?, z?])
    }

    /// A direction that is what lies between a point and another, made as long as it may be, of a
    /// ray that starts at the first point or beside it: where the other one is a constant, or as
    /// far from the first one for all of them.
    fn towards(&self, from: [NodeId; 3], dir: [NodeId; 3]) -> Option<Pencil> {
        let scaled = dir.map(|node| self.scaled(node));
        let [x, y, z] = scaled;
        let (op, by) = (x?.0, x?.2);
        if [y?, z?].iter().any(|other| (other.0, other.2) != (op, by)) {
            return None;
        }
        let gaps = scaled.map(|of| of.map(|(_, gap, _)| gap));
        if let [Some(x), Some(y), Some(z)] = gaps.map(|gap| gap.and_then(|gap| self.apart(gap))) {
            let length = (x * x + y * y + z * z).sqrt();
            return (length > 0.0).then(|| Pencil::Along([x, y, z].map(|part| part / length)));
        }
        let (mut point, mut beside) = ([0.0; 3], [0.0; 3]);
        for axis in 0..3 {
            let Node::Apply(Op::Sub, [to, at]) = self.b.node(scaled[axis]?.1) else {
                return None;
            };
            point[axis] = self.b.value(to)?.real();
            beside[axis] = self.beside(from[axis], at)?;
        }
        Some(Pencil::Through {
            point,
            beside,
            starts: false,
        })
    }

    /// A quotient or product: the operation, what is scaled, and by what. `unit` divides a vector;
    /// a product is read with the vector's part first.
    fn scaled(&self, node: NodeId) -> Option<(Op, NodeId, NodeId)> {
        match self.b.node(node) {
            Node::Apply(op @ (Op::Div | Op::Mul), [of, by]) => Some((op, of, by)),
            _ => None,
        }
    }

    /// What lies between a coordinate and another that is it and a constant, but for the roundings
    /// of both.
    fn apart(&self, gap: NodeId) -> Option<f64> {
        let Node::Apply(Op::Sub, [to, at]) = self.b.node(gap) else {
            return None;
        };
        let Node::Apply(Op::Add, [a, b]) = self.b.node(to) else {
            return None;
        };
        let by = if a == at { b } else { a };
        (a == at || b == at)
            .then(|| self.b.value(by))?
            .map(|v| v.real())
    }

    /// How far a coordinate is from another at most: not at all, or by a part of a normal.
    fn beside(&self, coordinate: NodeId, of: NodeId) -> Option<f64> {
        if coordinate == of {
            return Some(0.0);
        }
        let Node::Apply(Op::Add | Op::Sub, [a, b]) = self.b.node(coordinate) else {
            return None;
        };
        let Node::Apply(Op::Mul, [lift, normal]) = self.b.node(b) else {
            return None;
        };
        let (lift, normal) = match self.normals.contains(&normal) {
            true => (lift, normal),
            false => (normal, lift),
        };
        // A normal has length 1.
        (a == of && self.normals.contains(&normal)).then_some(())?;
        Some(self.b.value(lift)?.real().abs())
    }
}
