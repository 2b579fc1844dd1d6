//! Global code motion (late placement, Click 1995): where each value is placed.
//!
//! The places are regions: the frame, the row, the pixel, the two arms of an
//! `If`, the parts of a loop. A value belongs to the innermost region that
//! holds all its uses, so a value that only one path uses is computed on that
//! path only. From there it moves out to the row or the frame where its rate
//! allows (a row has hundreds of pixels, so this pays even where some rows do
//! not need it; every operation is total, so computing it in vain cannot
//! matter), and out of a loop's body where every turn would compute it again.
//!
//! Conditions imply others: where a sphere is hit, its discriminant was not
//! negative. So a value that is used under both conditions belongs under the
//! weaker one: it is computed at its first use and kept for the second. Without
//! this, every value that an optional's presence and its content share would
//! be computed on paths that need neither.
//!
//! Users are placed before what they use, so the nodes are visited backwards.

use super::segment::by_segment;
use crate::analysis::needed::{live_carried, needed};
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::analysis::region::*;
use crate::ir::graph::*;
use crate::schedule::constant_runs::{Still, still};
use slowlight_routine::Op;

/// Places every value that the ink needs.
pub fn place(graph: &Graph) -> Regions {
    place_all(graph, false, false)
}

/// The same with what is the same for a run of columns placed in its segment.
pub fn place_in_segments(graph: &Graph) -> Regions {
    place_all(graph, false, true)
}

/// The same, but a sum of what needs no computing stays where it is used, for
/// machines short of memory: it costs less there than its home does.
pub fn place_near(graph: &Graph) -> Regions {
    place_all(graph, true, false)
}

fn place_all(graph: &Graph, near: bool, segments: bool) -> Regions {
    let rates = rates(graph);
    let needed = needed(graph);
    let mut placer = Placer {
        graph,
        near,
        arms: segments,
        segment: match segments {
            true => by_segment(graph, &rates, &needed),
            false => vec![false; graph.nodes.len()],
        },
        needed,
        rates,
        regions: Regions::new(graph),
        uses: vec![None; graph.nodes.len()],
        all: vec![Vec::new(); graph.nodes.len()],
    };
    for root in graph.roots() {
        placer.need(root, PIXEL);
    }
    if let Some(still) = segments.then(|| still(graph)).flatten() {
        placer.need_still(&still);
    }
    for id in graph.ids().rev() {
        placer.visit(id);
    }
    placer.regions
}

struct Placer<'g> {
    graph: &'g Graph,
    /// Whether cheap values stay where they are used.
    near: bool,
    /// Whether what moves outward stays under the conditions that are known there.
    arms: bool,
    needed: Vec<bool>,
    rates: Rates,
    /// Which values are the same for a run of columns.
    segment: Vec<bool>,
    regions: Regions,
    /// The innermost region that holds all uses seen so far.
    uses: Vec<Option<RegionId>>,
    /// The regions of all uses seen so far.
    all: Vec<Vec<RegionId>>,
}

impl Placer<'_> {
    fn need(&mut self, id: NodeId, region: RegionId) {
        let at = id.0 as usize;
        self.uses[at] = Some(match self.uses[at] {
            Some(other) => self.common(other, region),
            None => region,
        });
        self.all[at].push(region);
    }

    /// The innermost region that holds all uses of a value. Which that is hangs on their
    /// order where conditions imply others: an arm of the weakest is found from there.
    fn used(&mut self, id: NodeId) -> Option<RegionId> {
        let at = id.0 as usize;
        let found = self.uses[at]?;
        let mut all = std::mem::take(&mut self.all[at]);
        if all.len() < 3 || !self.regions.holds(PIXEL, found) {
            return Some(found);
        }
        let depth = |region: &RegionId| self.regions.get(*region).depth;
        all.sort_by_key(depth);
        let mut all = all.into_iter();
        let first = all.next()?;
        let other = all.fold(first, |a, b| self.regions.common(a, b));
        Some(match self.regions.holds(found, other) {
            true => other,
            false => found,
        })
    }

    /// The innermost region whose values both may use. Further out than the pixel
    /// that may be an arm whose condition both are under.
    fn common(&mut self, a: RegionId, b: RegionId) -> RegionId {
        let region = self.regions.common(a, b);
        if !self.arms || !matches!(region, ROW | PASS | SEGMENT) {
            return region;
        }
        let facts = self.regions.facts_up_to(region, b);
        let mut both = self.regions.facts_up_to(region, a);
        both.retain(|fact| facts.contains(fact));
        self.arms_of(region, both)
    }

    fn visit(&mut self, id: NodeId) {
        let graph = self.graph;
        let Some(used) = self.used(id) else {
            return;
        };
        match self.graph.node(id) {
            Node::Apply(op, args) => {
                let region = self.settle(id, used);
                for arg in args.into_iter().take(op.arity()) {
                    self.need(arg, region);
                }
            }
            Node::Lookup { column, row, .. } => {
                let region = self.settle(id, used);
                self.need(column, region);
                self.need(row, region);
            }
            Node::Select { cond, yes, no } => {
                let region = self.settle(id, used);
                self.need(cond, region);
                for (arm, holds) in [(yes, true), (no, false)] {
                    let inner =
                        self.regions
                            .make_child(graph, region, RegionKind::Arm { cond, holds });
                    self.need(arm, inner);
                }
            }
            // Set where a row or pass begins, whoever reads it.
            Node::Ramp {
                first,
                step,
                stride,
            } => {
                let region = if stride == 1 { ROW } else { PASS };
                self.regions.of[id.0 as usize] = Some(region);
                self.need(first, region);
                self.need(step, region);
            }
            Node::Stepped { first, step } => {
                let region = self.along_run(used);
                self.regions.of[id.0 as usize] = Some(region);
                self.need(first, region);
                self.need(step, region);
            }
            Node::Tabulated(value) => {
                self.settle(id, used);
                self.need(value, COLUMN);
            }
            Node::Result { of, .. } => self.visit_loop(of),
            // Known without computing.
            Node::Const(_) | Node::Param(_) | Node::Axis(_) => {}
            Node::Received | Node::Neighbour(_) => {}
            Node::Carried { .. } | Node::Last { .. } => {}
            Node::Slot(_) | Node::Undefined(_) => {}
        }
    }

    /// Places a loop, with all its results, on meeting the last of them.
    fn visit_loop(&mut self, of: LoopId) {
        if self.regions.loops[of.0 as usize].is_some() {
            return;
        }
        let graph = self.graph;
        let mut results = Vec::new();
        for id in graph.ids() {
            if let Node::Result { of: l, index } = graph.node(id)
                && l == of
                && self.uses[id.0 as usize].is_some()
            {
                results.push((id, index as usize));
            }
        }
        let all = results
            .iter()
            .filter_map(|(id, _)| self.uses[id.0 as usize]);
        let Some(used) = all.reduce(|a, b| self.regions.common(a, b)) else {
            return;
        };
        let Some(&(first, _)) = results.first() else {
            return;
        };
        let region = self.settle(first, used);
        self.regions.loops[of.0 as usize] = Some(region);
        let found = &graph.loops[of.0 as usize];
        let body = self.regions.make_child(graph, region, RegionKind::Body(of));
        let next = self.regions.make_child(graph, body, RegionKind::Next(of));
        let done = self.regions.make_child(graph, body, RegionKind::Done(of));
        let otherwise = self
            .regions
            .make_child(graph, region, RegionKind::Otherwise(of));
        for index in live_carried(graph, &self.needed, of) {
            self.need(found.init[index as usize], region);
            self.need(found.next[index as usize], next);
        }
        self.need(found.again, body);
        for (id, index) in results {
            self.regions.of[id.0 as usize] = Some(region);
            self.need(found.done[index], done);
            self.need(found.otherwise[index], otherwise);
        }
    }

    /// The innermost place around another that all pixels of a run come to, or none:
    /// what is stepped must be stepped at each of them.
    fn along_run(&self, mut used: RegionId) -> RegionId {
        let mut path = Vec::new();
        while used != PIXEL {
            path.push(used);
            match self.regions.get(used).parent {
                Some(parent) => used = parent,
                None => break,
            }
        }
        let known = |region: &RegionId| match self.regions.get(*region).kind {
            RegionKind::Arm { cond, .. } => self.is_known_in(cond, SEGMENT),
            _ => false,
        };
        let all = path.into_iter().rev();
        all.take_while(known).last().unwrap_or(PIXEL)
    }

    /// Moves a value outward where its rate allows, and notes its region.
    fn settle(&mut self, id: NodeId, used: RegionId) -> RegionId {
        let mut region = used;
        while let Some(outer) = self.leave(id, region) {
            region = match outer {
                ROW | PASS | SEGMENT if self.arms => self.arms_within(outer, region),
                _ => outer,
            };
        }
        self.regions.of[id.0 as usize] = Some(region);
        region
    }

    /// A run's ink, and each condition under those before it, is known before its
    /// first pixel.
    fn need_still(&mut self, still: &Still) {
        let mut region = SEGMENT;
        for &(cond, holds) in &still.conditions {
            self.need(cond, region);
            let kind = RegionKind::Arm { cond, holds };
            region = self.regions.make_child(self.graph, region, kind);
        }
        let reads: Vec<NodeId> = still
            .reads(self.graph)
            .skip(still.conditions.len())
            .collect();
        reads.into_iter().for_each(|id| self.need(id, region));
    }

    /// What is known of a region's conditions further out already: the arms of
    /// those in a region around it. What only rows above the horizon need is not
    /// computed in the others.
    fn arms_within(&mut self, outer: RegionId, inner: RegionId) -> RegionId {
        let mut path = Vec::new();
        let mut at = inner;
        while at != outer {
            path.push(at);
            match self.regions.get(at).parent {
                Some(parent) => at = parent,
                None => break,
            }
        }
        path.retain(|region| matches!(self.regions.get(*region).kind, RegionKind::Arm { .. }));
        let facts = path.into_iter().rev();
        let facts = facts.flat_map(|region| self.regions.facts[region.0 as usize].clone());
        let facts = facts.collect();
        self.arms_of(outer, facts)
    }

    /// The arm in the arm and so on of those conditions that are known in a region.
    fn arms_of(&mut self, outer: RegionId, facts: Vec<Fact>) -> RegionId {
        let (mut region, mut taken) = (outer, Vec::new());
        for (cond, holds) in facts {
            // One that was placed already, further inside, cannot be asked here.
            let placed = self.regions.of[cond.0 as usize];
            let there = placed.is_none_or(|home| self.regions.holds(home, region));
            let fixed = self.graph.constant(cond).is_some();
            if fixed || !there || !self.is_known_in(cond, outer) || taken.contains(&cond) {
                continue;
            }
            taken.push(cond);
            self.need(cond, region);
            let kind = RegionKind::Arm { cond, holds };
            region = self.regions.make_child(self.graph, region, kind);
        }
        region
    }

    /// Whether a condition is known in the row's, the pass's or the segment's region.
    fn is_known_in(&self, cond: NodeId, region: RegionId) -> bool {
        match region {
            ROW => (self.rates.rate(cond).iter())
                .all(|d| matches!(d, Dependence::Frame | Dependence::Row)),
            PASS => self.rates.is_still(cond),
            _ => self.rates.is_still(cond) || self.segment[cond.0 as usize],
        }
    }

    /// Whether a value is a sum of what needs no computing.
    fn is_cheap(&self, id: NodeId) -> bool {
        let graph = self.graph;
        let leaf = |id: NodeId| {
            matches!(
                graph.node(id),
                Node::Const(_) | Node::Param(_) | Node::Axis(_)
            )
        };
        match graph.node(id) {
            Node::Apply(Op::Add | Op::Sub | Op::IntAdd | Op::IntSub, args) => {
                args.into_iter().all(leaf)
            }
            _ => false,
        }
    }

    /// A region further out that is entered less often and still has all that
    /// the value depends on.
    fn leave(&self, id: NodeId, region: RegionId) -> Option<RegionId> {
        if self.near && self.is_cheap(id) {
            return None;
        }
        let depends = |d| self.rates.depends(id, d);
        let loops = self
            .rates
            .rate(id)
            .iter()
            .any(|d| matches!(d, Dependence::Loop(_) | Dependence::Last(_)));
        let (x, y) = (depends(Dependence::Column), depends(Dependence::Row));
        let pass = depends(Dependence::Pass);
        let inside = |outer| region != outer && self.regions.holds(outer, region);
        if !x && !pass && !loops && (region == PASS || inside(PASS)) {
            return Some(ROW);
        }
        if !x && !loops && (region == SEGMENT || inside(SEGMENT)) {
            return Some(PASS);
        }
        if self.segment[id.0 as usize] && !loops && (region == PIXEL || inside(PIXEL)) {
            return Some(SEGMENT);
        }
        let outer = self.regions.holds(ROW, region) || self.regions.holds(COLUMN, region);
        if !x && !pass && !y && !loops && region != FRAME && outer {
            return Some(FRAME);
        }
        if !loops && region != COLUMN && self.regions.holds(COLUMN, region) {
            return Some(COLUMN);
        }
        match self.regions.get(region).kind {
            // Every turn of the loop would compute it.
            RegionKind::Body(l) if !depends(Dependence::Loop(l)) => self.regions.get(region).parent,
            _ => self.before_loop(id, region),
        }
    }

    /// The region around the innermost loop that a value is hoisted out of.
    fn before_loop(&self, id: NodeId, region: RegionId) -> Option<RegionId> {
        if self.graph.hoisted.is_empty() || region == PIXEL {
            return None;
        }
        let found = self.regions.get(region);
        match found.kind {
            RegionKind::Body(l) if self.graph.hoisted.contains(&(id, l)) => found.parent,
            _ => self.before_loop(id, found.parent?),
        }
    }
}
