//! Scenes: the nearest of their shapes.

use super::instances::Member;
use super::shape::{REACH, Solution};
use super::value::{Shape, Val};
use super::{Found, Lower, Search, leaving};
use crate::ir::graph::NodeId;
use crate::sema::builtins::Builtin;
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use crate::syntax::tree::BinaryOp;
use std::rc::Rc;

/// What is met of a scene's shape, or of a group: in which row.
#[derive(Clone)]
enum Hit {
    Of(Solution),
    In(NodeId),
}

/// Turns that a loop may have at most.
const MOST_STEPS: u32 = 65535;

impl<'a> Lower<'a> {
    /// A scene's shapes, made once.
    pub(super) fn shapes_of(&mut self, id: SceneId, span: Span) -> Found<Vec<Rc<Shape>>> {
        if let Some(found) = self.scenes.get(&id) {
            return Ok(found.clone());
        }
        let mut found = Vec::new();
        for placed in self.placed(id, span)?.iter() {
            let place = self.place.take();
            let shape = self.enter(placed.shape, placed.locals(), |l| {
                let value = l.expr(&placed.shape.value)?;
                l.force(value)
            });
            self.place = place;
            match shape.map_err(|error| placed.wrong(error))? {
                Val::Shape(shape) => found.push(shape),
                _ => return Err(self.confused(span)),
            }
        }
        self.scenes.insert(id, found.clone());
        Ok(found)
    }

    /// What is asked of a scene.
    pub(super) fn ask_scene(
        &mut self,
        what: Builtin,
        scene: SceneId,
        arg: Val,
        more: Vec<Option<Val>>,
        ty: &Ty,
        span: Span,
    ) -> Found<Val> {
        let mut more = more.into_iter().map(Some).chain([None, None, None]);
        let mut take = || more.next().flatten().flatten();
        // `march` has steps and near before far.
        let (steps, near, far) = match what {
            Builtin::March => (take(), take(), take()),
            _ => (None, None, take()),
        };
        match (what, self.options.ways.search) {
            (Builtin::Trace, None | Some(Search::Trace))
            | (Builtin::March, Some(Search::Trace)) => self.trace(scene, arg, far, ty, span),
            (Builtin::Blocked, _) => self.blocked(scene, arg, far, span),
            (Builtin::Trace | Builtin::March, Some(Search::March { steps, near })) => {
                let steps = self.int(steps.min(MOST_STEPS) as i32, span);
                let (near, reach) = (self.real(near.value(), span), self.real(REACH, span));
                let far = far.unwrap_or(Val::Node(reach));
                let args = vec![Val::Node(steps), Val::Node(near), far];
                self.march(scene, arg, args, ty, span)
            }
            (Builtin::March, None) => {
                let args = [steps, near, far].into_iter().flatten().collect();
                self.march(scene, arg, args, ty, span)
            }
            (Builtin::SceneDist, _) => {
                let (distance, _) = self.nearest(scene, &arg, span)?;
                Ok(Val::Node(distance))
            }
            _ => {
                let (_, wins) = self.nearest(scene, &arg, span)?;
                self.tag_of(scene, &wins, arg, span)
            }
        }
    }

    /// The least distance, and for each shape whether it is nearer than those
    /// before it (the later one on a tie).
    fn nearest(&mut self, id: SceneId, p: &Val, span: Span) -> Found<(NodeId, Vec<NodeId>)> {
        let mut best: Option<NodeId> = None;
        let mut wins = Vec::new();
        for shape in self.shapes_of(id, span)? {
            let d = self.ask(Builtin::ShapeDist, &shape, p.clone(), span)?;
            let d = self.node(d, &Ty::Real, span)?;
            let (win, next) = match best {
                None => (self.bool(true, span), d),
                Some(best) => {
                    let win = self.scalar(BinaryOp::Le, &Ty::Real, d, best, span)?;
                    (win, self.select(win, d, best, span))
                }
            };
            wins.push(win);
            best = Some(next);
        }
        match best {
            Some(best) => Ok((best, wins)),
            None => Err(self.confused(span)),
        }
    }

    /// What the last winner gives: `of` makes each shape's value.
    fn of_winner(
        &mut self,
        wins: &[NodeId],
        span: Span,
        mut of: impl FnMut(&mut Self, usize) -> Found<Val>,
    ) -> Found<Val> {
        let mut value = Val::Undefined;
        for (k, &win) in wins.iter().enumerate() {
            let mine = of(self, k)?;
            value = self.merge(win, mine, value, span)?;
        }
        self.force(value)
    }

    fn tag_of(&mut self, id: SceneId, wins: &[NodeId], p: Val, span: Span) -> Found<Val> {
        self.of_winner(wins, span, |l, k| l.tag_at(id, k, p.clone(), span))
    }

    /// The tag of one of a scene's shapes at a point.
    pub(super) fn tag_at(&mut self, id: SceneId, at: usize, p: Val, span: Span) -> Found<Val> {
        let all = self.placed(id, span)?;
        let Some((placed, tag)) = all.get(at).and_then(|placed| Some((placed, placed.tag?))) else {
            return Err(self.confused(span));
        };
        let place = self.place.take();
        let mut args = vec![p];
        args.extend(placed.locals());
        let value = self.enter(tag, args, |l| l.expr(&tag.value));
        self.place = place;
        value.map_err(|error| placed.wrong(error))
    }

    /// The nearest hit; the later shape on a tie.
    fn trace(
        &mut self,
        id: SceneId,
        ray: Val,
        far: Option<Val>,
        ty: &Ty,
        span: Span,
    ) -> Found<Val> {
        let mut best = match far {
            Some(far) => self.node(far, &Ty::Real, span)?,
            None => self.real(f64::MAX, span),
        };
        let mut present = self.bool(false, span);
        let mut wins = Vec::new();
        let mut found = Vec::new();
        let members = self.members_of(id, span)?;
        for (at, member) in members.iter().enumerate() {
            let (win, of) = match member {
                Member::One(_, shape) => {
                    let solution = self.solved_in(id, (at, shape), &ray, Some(best), span)?;
                    let near = self.scalar(BinaryOp::Le, &Ty::Real, solution.t, best, span)?;
                    let no = self.bool(false, span);
                    let win = self.select(solution.present, near, no, span);
                    best = self.select(win, solution.t, best, span);
                    (win, Hit::Of(solution))
                }
                Member::Group(group) => {
                    let met = self.nearest_instance(group, &ray, best, span)?;
                    best = met.t;
                    (met.present, Hit::In(met.row))
                }
            };
            let yes = self.bool(true, span);
            present = self.select(win, yes, present, span);
            wins.push(win);
            found.push(of);
        }
        self.b.name(best, "t");
        // One point of the ray, whoever wins: a point of each shape's solution
        // would cost a choice for each.
        let t = Val::Node(best);
        let along = t.clone();
        let on = leaving::Surface::Of(id, wins.clone());
        let on_ray = ray.clone();
        let point = self.later("point", move |l| {
            let point = l.along(&on_ray, along, span)?;
            l.lies_on(&point, on, span)?;
            Ok(point)
        });
        let (at, won) = (point.clone(), wins.clone());
        let (of, hits) = (members.clone(), found.clone());
        let normal = self.later_normal(
            move |l| {
                l.of_winner(&won, span, |l, k| match (&of[k], &hits[k]) {
                    (Member::One(_, shape), Hit::Of(hit)) => {
                        l.normal_of(shape, hit, at.clone(), span)
                    }
                    (Member::Group(group), Hit::In(row)) => {
                        let shape = l.instance(group, *row, span)?;
                        let hit = l.solved(&shape, ray.clone(), None, span)?;
                        l.normal_of(&shape, &hit, at.clone(), span)
                    }
                    _ => Err(l.confused(span)),
                })
            },
            span,
        );
        let mut parts = vec![point.clone(), normal, t];
        if has_tag(ty) {
            parts.push(self.here(move |l| {
                l.of_winner(&wins, span, |l, k| match (&members[k], &found[k]) {
                    (Member::Group(group), Hit::In(row)) => {
                        l.instance_tag(id, group, *row, point.clone(), span)
                    }
                    (Member::One(at, _), _) => l.tag_at(id, *at, point.clone(), span),
                    _ => Err(l.confused(span)),
                })
            }));
        }
        Ok(Val::Optional {
            present,
            value: Rc::new(Val::parts(parts)),
        })
    }

    /// Sphere tracing in so many steps, until so near, and so far: the hit's normal and tag are those of the shape nearest
    /// to the point where it stops.
    fn march(&mut self, id: SceneId, ray: Val, how: Vec<Val>, ty: &Ty, span: Span) -> Found<Val> {
        let [steps, near, far] = <[Val; 3]>::try_from(how).map_err(|_| self.confused(span))?;
        let near = self.node(near, &Ty::Real, span)?;
        let far = self.node(far, &Ty::Real, span)?;
        let args = [steps, Val::Node(near), Val::Node(far)];
        let args = [Val::Scene(id), ray.clone()].into_iter().chain(args);
        let found = self.library("marched", Ty::Scene(None), args.collect(), span)?;
        let Val::Optional { present, value } = found else {
            return Err(self.confused(span));
        };
        let (mut present, t) = (present, (*value).clone());
        // Where a march stops hangs on its steps: those that are made are the same ones.
        let level = self.b.value(near).map(|near| near.real());
        let shapes = self.shapes_of(id, span)?;
        if let Some(level) = level
            && let Some(on) = self.stretch_of_any(&shapes, level, (&ray, far), span)?
        {
            let is_met = self.scalar(BinaryOp::Le, &Ty::Real, on.near, on.far, span)?;
            let no = self.bool(false, span);
            present = self.select(is_met, present, no, span);
        }
        let along = t.clone();
        let point = self.later("point", move |l| l.along(&ray, along, span));
        let at = point.clone();
        let normal = self.later_normal(
            move |l| {
                let shapes = l.shapes_of(id, span)?;
                let (_, wins) = l.nearest(id, &at, span)?;
                l.of_winner(&wins, span, |l, k| match shapes.get(k) {
                    Some(shape) => l.shape_normal(shape, at.clone(), span),
                    None => Err(l.confused(span)),
                })
            },
            span,
        );
        let mut parts = vec![point.clone(), normal, t];
        if has_tag(ty) {
            parts.push(self.here(move |l| {
                let (_, wins) = l.nearest(id, &point, span)?;
                l.tag_of(id, &wins, point, span)
            }));
        }
        Ok(Val::Optional {
            present,
            value: Rc::new(Val::parts(parts)),
        })
    }

    /// The nearest hit of a scene's shape; none where the ray leaves it for good, and perhaps
    /// none where it is beyond `reach`.
    fn solved_in(
        &mut self,
        id: SceneId,
        (at, shape): (usize, &Rc<Shape>),
        ray: &Val,
        reach: Option<NodeId>,
        span: Span,
    ) -> Found<Solution> {
        let mut found = self.solved(shape, ray.clone(), reach, span)?;
        if let Some(leaves) = self.leaves_one_of(id, at, shape, ray, span)? {
            let no = self.bool(false, span);
            found.present = self.select(leaves, no, found.present, span);
        }
        Ok(found)
    }

    /// Whether anything is hit nearer than `far`: stops at the first.
    fn blocked(&mut self, id: SceneId, ray: Val, far: Option<Val>, span: Span) -> Found<Val> {
        let far = match far {
            Some(far) => Some(self.node(far, &Ty::Real, span)?),
            None => None,
        };
        let mut hits = Vec::new();
        for (at, member) in self.members_of(id, span)?.iter().enumerate() {
            let shape = match member {
                Member::One(_, shape) => shape,
                Member::Group(group) => {
                    let far = far.unwrap_or_else(|| self.real(f64::MAX, span));
                    hits.push(self.any_instance(group, &ray, far, span)?);
                    continue;
                }
            };
            let Solution {
                present: there, t, ..
            } = self.solved_in(id, (at, shape), &ray, far, span)?;
            hits.push(match far {
                Some(far) => {
                    let near = self.scalar(BinaryOp::Lt, &Ty::Real, t, far, span)?;
                    let no = self.bool(false, span);
                    self.select(there, near, no, span)
                }
                None => there,
            });
        }
        let mut any = self.bool(false, span);
        for hit in hits.into_iter().rev() {
            let yes = self.bool(true, span);
            any = self.select(hit, yes, any, span);
        }
        Ok(Val::Node(any))
    }
}

/// Whether an optional hit has a tag.
fn has_tag(ty: &Ty) -> bool {
    matches!(ty, Ty::Optional(hit) if matches!(**hit, Ty::Hit(Some(_))))
}
