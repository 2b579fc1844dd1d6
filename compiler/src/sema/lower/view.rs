//! Cells of the picture that is seen from a point, or along a direction, and the shapes in each:
//! what the rays of a pencil may meet, without a walk from cell to cell.
//!
//! From a lamp it is a light buffer (Haines and Greenberg, The Light Buffer: A Shadow-Testing
//! Accelerator, 1986).

use super::cells::{Cells, Most};
use super::projection::{Order, Pencil, Projection, SLACK, joined};
use super::value::{Asked, Instances, Val, View};
use super::{Found, Lower};
use crate::ir::extent::Extent;
use crate::ir::graph::NodeId;
use crate::sema::ty::Ty;
use crate::source::Span;
use slowlight_routine::Range;
use std::rc::Rc;

/// Many cells, fewer, few.
const MOST: [Most; 3] = [
    Most::new(32, 512, 20),
    Most::new(24, 200, 10),
    Most::new(16, 100, 5),
];

/// What part of its shapes' costs a view may cost.
const WORTH: f64 = 0.75;

/// What a place in tables costs, in parts of what a ray costs against a shape.
const PLACE: f64 = 1.0 / 4096.0;

/// Where each box is seen, and the window around those that are seen somewhere. What is not, as
/// it is beside the point, may be anywhere.
struct Seen {
    by: Projection,
    boxes: Vec<[Range; 2]>,
    window: [Range; 2],
    anywhere: Vec<i32>,
    /// By how much roundings move what is seen.
    room: f64,
    /// How much of a direction into the window is ahead at least.
    least: f64,
}

impl Seen {
    fn of(by: Projection, boxes: &[Extent], epsilon: f64) -> Option<Seen> {
        let all = boxes.iter().copied().reduce(Extent::join)?;
        let boxes: Vec<Option<[Range; 2]>> = boxes.iter().map(|of| by.seen(of)).collect();
        let somewhere = boxes.iter().copied().flatten();
        let window = somewhere.reduce(|[a, b], [c, d]| [joined(a, c), joined(b, d)])?;
        let (room, least) = by.room(window, &all, epsilon);
        let window = window.map(|side| {
            let more = room + SLACK * (side.hi - side.lo);
            Range::new(side.lo - more, side.hi + more)
        });
        let anywhere = (0..).zip(&boxes).filter(|(_, seen)| seen.is_none());
        Some(Seen {
            by,
            anywhere: anywhere.map(|(k, _)| k).collect(),
            boxes: boxes.iter().map(|seen| seen.unwrap_or(window)).collect(),
            window,
            room,
            least: (1.0 - SLACK) * least,
        })
    }

    /// What cells cost: a ray that leads where shapes are. How large the empty rest of the window
    /// is hangs on the axis ahead alone.
    fn cheapest(&self, most: &Most) -> Option<(f64, [usize; 2])> {
        let cost =
            |cells: &Cells<'_, 2>| cells.crowd() + PLACE * (cells.count() + cells.entries()) as f64;
        let room = [self.room; 2];
        let (cost, cells) = Cells::cheapest(&self.boxes, self.window, room, most, cost)?;
        (cost <= WORTH * self.boxes.len() as f64).then_some((cost, cells.along))
    }

    /// Puts a list into an order.
    fn sort(&self, list: &mut [i32], order: Order, near: &[f64]) {
        let area = |k: i32| {
            let [a, b] = self.boxes[k as usize];
            (a.hi - a.lo) * (b.hi - b.lo)
        };
        match order {
            Order::Given => {}
            Order::Nearest => list.sort_by(|&a, &b| near[a as usize].total_cmp(&near[b as usize])),
            Order::Largest => list.sort_by(|&a, &b| area(b).total_cmp(&area(a))),
        }
    }
}

/// A ray in a view.
pub(super) struct InView {
    pub(super) view: Rc<View>,
    /// In which of its cells.
    pub(super) cell: Val,
    pub(super) order: Order,
    /// Where not all of its rays are the pencil's, whether this one is.
    pub(super) when: Option<NodeId>,
}

impl Lower<'_> {
    /// The cells of a group's picture from a ray's pencil, and the ray's cell there; none where
    /// there is no such pencil, or they are worth nothing.
    pub(super) fn view_of(
        &mut self,
        of: &Instances,
        ray: &Val,
        asked: Asked,
        span: Span,
    ) -> Found<Option<InView>> {
        let (pencil, when) = match self.pencil_of(ray, span)? {
            Some(pencil) => (pencil, None),
            None => match self.first_pencil(ray, span)? {
                Some((pencil, when)) => (pencil, Some(when)),
                None => return Ok(None),
            },
        };
        let order = match pencil {
            _ if asked == Asked::Any => Order::Largest,
            Pencil::Through { starts: true, .. } => Order::Nearest,
            _ => Order::Given,
        };
        let key = (pencil, order);
        let known = of.views.borrow().iter().find(|v| v.0 == key).cloned();
        let view = match known {
            Some((_, view)) => view,
            None => {
                let view = self.view_from(of, key, span).map(Rc::new);
                of.views.borrow_mut().push((key, view.clone()));
                view
            }
        };
        match view {
            Some(view) => Ok(Some(InView {
                cell: self.cell_in(&view, ray, span)?,
                order,
                when,
                view,
            })),
            None => Ok(None),
        }
    }

    fn view_from(
        &mut self,
        of: &Instances,
        (pencil, order): (Pencil, Order),
        span: Span,
    ) -> Option<View> {
        let most = Most::asked(MOST, self.options.ways.instancing)?;
        let boxes = of.boxes.as_deref()?;
        let mut best: Option<(f64, Seen, [usize; 2])> = None;
        for ahead in 0..3 {
            if matches!(pencil, Pencil::Along(dir) if dir[ahead] == 0.0) {
                continue;
            }
            let by = Projection { pencil, ahead };
            if let Some(seen) = Seen::of(by, boxes, self.options.epsilon)
                && let Some((cost, along)) = seen.cheapest(&most)
                && best.as_ref().is_none_or(|(least, ..)| cost < *least)
            {
                best = Some((cost, seen, along));
            }
        }
        let (_, seen, along) = best?;
        let cells = Cells::new(&seen.boxes, seen.window, [seen.room; 2], along);
        let slices = |part, k: usize| seen.by.slices(part, &boxes[k]);
        let mut lists = self.without_empty(&of.shapes, &cells, slices, span);
        // The last one is what a line outside of the window may meet.
        lists.push(seen.anywhere.clone());
        let near: Vec<f64> = boxes.iter().map(|of| seen.by.distance(of)).collect();
        for list in &mut lists {
            seen.sort(list, order, &near);
        }
        Some(View {
            by: seen.by,
            low: seen.window.map(|side| side.lo),
            side: cells.side(),
            along,
            least: seen.least,
            lists: self.lists_of(&lists, span),
            near: self.reals("near", &near, span),
        })
    }

    /// The cell that a ray of a pencil is in.
    fn cell_in(&mut self, view: &View, ray: &Val, span: Span) -> Found<Val> {
        let [from, dir] = self.start_and_direction(ray, span)?;
        let [u, v, w] = view.by.axes();
        let across = |of: [NodeId; 3]| [of[u], of[v], of[w]].map(Val::Node);
        let seen = self.view_value(view, span);
        let (name, mut args) = match view.by.pencil {
            Pencil::Through { .. } => ("cell_through", across(dir).to_vec()),
            Pencil::Along(dir) => {
                let slopes = [dir[u] / dir[w], dir[v] / dir[w]];
                let slopes = slopes.map(|slope| Val::Node(self.real(slope, span)));
                let args = across(from).into_iter().chain(slopes);
                ("cell_along", args.collect())
            }
        };
        args.push(seen);
        self.library(name, Ty::Real, args, span)
    }

    /// A view as the library's record.
    fn view_value(&mut self, view: &View, span: Span) -> Val {
        let mut pair = |of: [f64; 2]| Val::parts(of.map(|v| Val::Node(self.real(v, span))).into());
        let (low, side) = (pair(view.low), pair(view.side));
        let [across, up] = view.along.map(|n| Val::Node(self.int(n as i32, span)));
        let least = Val::Node(self.real(view.least, span));
        Val::parts(vec![low, side, across, up, least])
    }
}
