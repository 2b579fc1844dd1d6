//! Later: what one way needs at once and another may need later is computed where it is
//! needed.
//!
//! A value that one way of a choice uses, and what stands behind the choice on some ways,
//! has its place before the choice: a reflected ray's point is needed where it may meet
//! something else, and on the floor, but in no pixel of the sky that left the box of
//! everything at once. Here the way computes it for itself, and who needs it later asks
//! which way was taken: of the one it is known, of the other it is computed there.
//! So no pixel computes it twice, and those do not at all that need it nowhere. (Sinking
//! of partially dead code: Knoop, Rüthing and Steffen, PLDI 1994.)
//!
//! In the graph that is a choice by the same condition between two nodes that are alike,
//! so no pass may rebuild the graph by equal nodes after it, as with [`super::apart`].

use super::arena::Arena;
use super::demand::{place, place_in_segments};
use super::region::*;
use crate::flow::graph::*;
use slowlight_routine::Runtime;
use std::collections::{BTreeMap, BTreeSet};

/// Graphs of which each has what one way of a condition needs computed on that way.
/// Of many ways those are taken whose values take most cycles.
pub fn later(graph: &Graph, runtime: &Runtime) -> Vec<Graph> {
    let site = Site::new(graph, runtime.segments);
    let mut asked: BTreeSet<(RegionId, NodeId, bool)> = BTreeSet::new();
    for region in &site.regions.regions {
        if let (RegionKind::Arm { cond, holds }, Some(home)) = (region.kind, region.parent)
            && site.in_pixel(home)
        {
            asked.insert((home, cond, holds));
        }
    }
    let ways = asked.into_iter();
    let mut ways: Vec<(u64, Way)> = ways
        .filter_map(|(home, cond, holds)| Way::new(&site, home, cond, holds))
        .map(|way| (way.cycles(runtime), way))
        .collect();
    ways.sort_by_key(|(cycles, _)| std::cmp::Reverse(*cycles));
    let ways = ways.into_iter().take(WAYS);
    ways.filter_map(|(_, way)| way.moved()).collect()
}

/// How many ways are tried: each is a graph that is scheduled and priced.
const WAYS: usize = 8;

/// Where a value is used: by which other, as what, and in which region.
#[derive(Clone, Copy, Debug)]
struct Use {
    /// Nothing where it is used as no operand of a node.
    user: Option<NodeId>,
    region: RegionId,
}

/// Values, their places and their uses.
struct Site<'g> {
    graph: &'g Graph,
    regions: Regions,
    uses: Vec<Vec<Use>>,
}

impl<'g> Site<'g> {
    fn new(graph: &'g Graph, segments: bool) -> Site<'g> {
        let regions = match segments {
            true => place_in_segments(graph),
            false => place(graph),
        };
        let mut site = Site {
            graph,
            regions,
            uses: vec![Vec::new(); graph.nodes.len()],
        };
        for id in graph.ids() {
            if let Some(home) = site.regions.of[id.0 as usize] {
                site.note(id, home);
            }
        }
        for root in graph.roots() {
            site.used(root, None, PIXEL);
        }
        site
    }

    fn used(&mut self, id: NodeId, user: Option<NodeId>, region: RegionId) {
        self.uses[id.0 as usize].push(Use { user, region });
    }

    /// Notes what a node uses.
    fn note(&mut self, id: NodeId, home: RegionId) {
        match self.graph.node(id) {
            Node::Select { cond, yes, no } => {
                self.used(cond, None, home);
                for (arm, holds) in [(yes, true), (no, false)] {
                    let inner = self.regions.child(home, RegionKind::Arm { cond, holds });
                    // What is chosen twice cannot be told apart.
                    let user = (yes != no && arm != cond).then_some(id);
                    self.used(arm, user, inner.unwrap_or(home));
                }
            }
            Node::Result { of, .. } => self.note_loop(of, home),
            node => {
                for used in node.operands() {
                    self.used(used, Some(id), home);
                }
            }
        }
    }

    fn note_loop(&mut self, of: LoopId, home: RegionId) {
        let turns = &self.graph.loops[of.0 as usize];
        let child = |of: RegionId, kind| self.regions.child(of, kind).unwrap_or(of);
        let body = child(home, RegionKind::Body(of));
        let lists = [
            (&turns.init, home),
            (&turns.next, child(body, RegionKind::Next(of))),
            (&turns.done, child(body, RegionKind::Done(of))),
            (&turns.otherwise, child(home, RegionKind::Otherwise(of))),
        ];
        for (list, region) in lists {
            for id in list {
                self.used(*id, None, region);
            }
        }
        self.used(turns.again, None, body);
    }

    /// Whether a region is the pixel's or a condition's way in it, in no loop.
    fn in_pixel(&self, mut region: RegionId) -> bool {
        loop {
            match self.regions.get(region) {
                Region {
                    kind: RegionKind::Pixel,
                    ..
                } => return true,
                Region {
                    kind: RegionKind::Arm { .. },
                    parent: Some(parent),
                    ..
                } => region = parent,
                _ => return false,
            }
        }
    }

    /// All that a value is made of, itself included; nothing where there is a loop in it.
    fn cone(&self, of: NodeId) -> Option<BTreeSet<NodeId>> {
        let (mut cone, mut todo) = (BTreeSet::new(), vec![of]);
        while let Some(id) = todo.pop() {
            if cone.insert(id) {
                let node = self.graph.node(id);
                if matches!(
                    node,
                    Node::Result { .. } | Node::Carried { .. } | Node::Last { .. }
                ) {
                    return None;
                }
                todo.extend(node.operands());
            }
        }
        Some(cone)
    }
}

/// What a use becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fate {
    /// It stays: the value is known there.
    Stays,
    /// Of the value's copy in a region.
    Copied(RegionId),
    /// Of what is chosen in a region between value and copy.
    Chosen(RegionId),
}

/// A condition at its home, one of its ways, and the values that go there.
struct Way<'s, 'g> {
    site: &'s Site<'g>,
    home: RegionId,
    cond: NodeId,
    holds: bool,
    /// What the condition is made of.
    cone: BTreeSet<NodeId>,
    values: BTreeSet<NodeId>,
}

impl<'s, 'g> Way<'s, 'g> {
    /// Nothing where no value would go to that way.
    fn new(site: &'s Site<'g>, home: RegionId, cond: NodeId, holds: bool) -> Option<Way<'s, 'g>> {
        let mut way = Way {
            site,
            home,
            cond,
            holds,
            cone: site.cone(cond)?,
            values: BTreeSet::new(),
        };
        let here = |id: &NodeId| {
            let plain = matches!(site.graph.node(*id), Node::Apply(..) | Node::Lookup { .. });
            plain && site.regions.of[id.0 as usize] == Some(home) && !way.cone.contains(id)
        };
        way.values = site.graph.ids().filter(here).collect();
        // What one that stays needs stays.
        loop {
            let needed = way.needed();
            let fits = |id: &&NodeId| needed.contains(*id) && way.fits(**id);
            let left: BTreeSet<NodeId> = way.values.iter().filter(fits).copied().collect();
            if left.len() == way.values.len() {
                break;
            }
            way.values = left;
        }
        let later = |id: &NodeId| {
            let mut uses = site.uses[id.0 as usize].iter();
            uses.any(|used| matches!(way.fate(used), Some(Fate::Chosen(_))))
        };
        way.values.iter().any(later).then_some(way)
    }

    /// What all of its values take together.
    fn cycles(&self, runtime: &Runtime) -> u64 {
        let of = |id: &NodeId| match self.site.graph.node(*id) {
            Node::Apply(op, _) => runtime.usual(op).map_or(0, |routine| routine.cycles),
            _ => 0,
        };
        self.values.iter().map(|id| u64::from(of(id))).sum()
    }

    /// What the way itself needs, at once or for another of the values.
    fn needed(&self) -> BTreeSet<NodeId> {
        let (cond, holds) = (self.cond, self.holds);
        let regions = &self.site.regions;
        let arm = regions.child(self.home, RegionKind::Arm { cond, holds });
        let mut needed = BTreeSet::new();
        // Users stand behind what they use.
        for id in self.values.iter().rev() {
            let mut uses = self.site.uses[id.0 as usize].iter();
            let here = |used: &Use| {
                arm.is_some_and(|arm| regions.holds(arm, used.region))
                    || used.user.is_some_and(|user| needed.contains(&user))
            };
            if uses.any(here) {
                needed.insert(*id);
            }
        }
        needed
    }

    /// Whether all uses of a value may be told which way was taken.
    fn fits(&self, id: NodeId) -> bool {
        let mut uses = self.site.uses[id.0 as usize].iter();
        uses.all(|used| match used.user {
            Some(user) if used.region == self.home => self.values.contains(&user),
            Some(user) => !self.cone.contains(&user) && self.fate(used).is_some(),
            None => self.fate(used) == Some(Fate::Stays),
        })
    }

    /// What becomes of a use further in; nothing where that cannot be said.
    fn fate(&self, used: &Use) -> Option<Fate> {
        let regions = &self.site.regions;
        if !regions.holds(self.home, used.region) {
            return None;
        }
        let facts = regions.facts_up_to(self.home, used.region);
        if facts.contains(&(self.cond, self.holds)) {
            return Some(Fate::Stays);
        }
        let top = regions.toward(self.home, used.region)?;
        // In a loop it would be asked each turn.
        let plain = self.site.in_pixel(used.region);
        let known = facts.contains(&(self.cond, !self.holds));
        plain.then_some(if known {
            Fate::Copied(top)
        } else {
            Fate::Chosen(top)
        })
    }

    /// The graph with the values on that way, and asked for it elsewhere.
    fn moved(&self) -> Option<Graph> {
        let graph = self.site.graph;
        let mut fates: BTreeMap<(NodeId, NodeId), Fate> = BTreeMap::new();
        for id in &self.values {
            for used in &self.site.uses[id.0 as usize] {
                let (Some(user), Some(fate)) = (used.user, self.fate(used)) else {
                    continue;
                };
                if fate != Fate::Stays && fates.insert((user, *id), fate).is_some() {
                    return None;
                }
            }
        }
        let mut made = Made {
            way: self,
            out: Arena::new(graph),
            moved: vec![None; graph.nodes.len()],
            copies: BTreeMap::new(),
            chosen: BTreeMap::new(),
        };
        for id in graph.ids() {
            made.keep(id, &fates);
        }
        let Made {
            out, moved, copies, ..
        } = made;
        let mut out = out.finish(&moved);
        // A copy is the same as what it is a copy of, so it is claimed of it, too.
        for ((id, _), copy) in copies {
            if let Some((op, args)) = graph.claims.get(&id) {
                let args = args.map(|a| moved[a.0 as usize].unwrap_or(NodeId(0)));
                out.claims.insert(copy, (*op, args));
            }
        }
        Some(out)
    }
}

/// The new graph while it is made.
struct Made<'w, 's, 'g> {
    way: &'w Way<'s, 'g>,
    out: Arena<'g>,
    moved: Vec<Option<NodeId>>,
    /// Copies of values, and what is chosen between those and the values, by the region
    /// where they stand.
    copies: BTreeMap<(NodeId, RegionId), NodeId>,
    chosen: BTreeMap<(NodeId, RegionId), NodeId>,
}

impl Made<'_, '_, '_> {
    fn at(&self, id: NodeId) -> NodeId {
        self.moved[id.0 as usize].unwrap_or(NodeId(0))
    }

    /// A node, behind what it asks for.
    fn keep(&mut self, id: NodeId, fates: &BTreeMap<(NodeId, NodeId), Fate>) {
        if self.moved[id.0 as usize].is_some() {
            return;
        }
        let node = self.way.site.graph.node(id);
        let mut operands = BTreeMap::new();
        for used in node.operands() {
            let other = match fates.get(&(id, used)) {
                Some(Fate::Copied(region)) => self.copy(used, *region),
                Some(Fate::Chosen(region)) => self.choose(used, *region),
                _ => self.at(used),
            };
            operands.insert(used, other);
        }
        let node = node.with(|a| operands.get(&a).copied().unwrap_or(NodeId(0)));
        self.moved[id.0 as usize] = Some(self.out.push(node, id));
    }

    /// A value's copy in a region, with those of the values that it is made of.
    fn copy(&mut self, of: NodeId, region: RegionId) -> NodeId {
        let graph = self.way.site.graph;
        let (mut all, mut todo) = (BTreeSet::new(), vec![of]);
        while let Some(id) = todo.pop() {
            if self.way.values.contains(&id) && all.insert(id) {
                todo.extend(graph.node(id).operands());
            }
        }
        for id in all {
            if !self.copies.contains_key(&(id, region)) {
                let at = |a: NodeId| {
                    let copy = self.copies.get(&(a, region)).copied();
                    copy.unwrap_or_else(|| self.at(a))
                };
                let node = graph.node(id).with(at);
                let made = self.out.push(node, id);
                self.copies.insert((id, region), made);
            }
        }
        let copy = self.copies.get(&(of, region)).copied();
        copy.unwrap_or_else(|| self.at(of))
    }

    /// The value where its way was taken, else its copy.
    fn choose(&mut self, of: NodeId, region: RegionId) -> NodeId {
        if let Some(known) = self.chosen.get(&(of, region)) {
            return *known;
        }
        // What the condition is made of may stand further behind; it uses none of these.
        for id in &self.way.cone {
            self.keep(*id, &BTreeMap::new());
        }
        let copy = self.copy(of, region);
        let (cond, value) = (self.at(self.way.cond), self.at(of));
        let (yes, no) = match self.way.holds {
            true => (value, copy),
            false => (copy, value),
        };
        let made = self.out.push(Node::Select { cond, yes, no }, of);
        self.chosen.insert((of, region), made);
        made
    }
}
