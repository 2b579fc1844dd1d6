//! Repeated sequences: which runs of statements have one shape, and which of them are worth a
//! subroutine.

use super::forest::Forest;
use super::step::BlockId;
use super::token::{Token, mix};
use crate::ir::graph::*;
use crate::targets::Sizes;
use rustc_hash::FxHashMap;
use slowlight_routine::Type;
use std::collections::BTreeMap;

/// Statements that a run has at most, those inside others included.
const LONGEST: usize = 400;

/// Some statements of a block, one after another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Run {
    pub block: BlockId,
    pub from: usize,
    pub to: usize,
}

/// What a token refers to, apart from which run it stands in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Reference {
    /// What the run computed, by number.
    Own(u32),
    /// A carried value of a loop in the run: which loop, which value, and
    /// whether the last one.
    Carried(u32, u32, bool),
    /// What has to be the same in all runs ([`Forest::is_fixed`]).
    Fixed(NodeId),
    /// Anything else of this type.
    Outside(Type),
}

/// What a token reads, what it writes, and the loop whose values it sets, by
/// number from 1.
type References = (Vec<Reference>, Option<Reference>, u32);

/// Reads tokens one by one and numbers what they refer to.
pub(super) struct Reader<'f> {
    graph: &'f Graph,
    forest: &'f Forest,
    block: BlockId,
    /// By node the run that computed it, and its number there.
    own: Vec<(u32, u32)>,
    /// Which run is read, from 1, and how many nodes it has computed so far.
    run: u32,
    count: u32,
    loops: FxHashMap<LoopId, u32>,
}

impl<'f> Reader<'f> {
    pub fn new(graph: &'f Graph, forest: &'f Forest) -> Reader<'f> {
        Reader {
            graph,
            forest,
            block: 0,
            own: vec![(0, 0); graph.nodes.len()],
            run: 0,
            count: 0,
            loops: FxHashMap::default(),
        }
    }

    /// Goes on to a run in a block.
    pub fn begin(&mut self, block: BlockId) {
        self.block = block;
        self.run += 1;
        self.count = 0;
        self.loops.clear();
    }

    fn is_fixed(&self, id: NodeId) -> bool {
        let owner = self.forest.owner[self.block];
        self.forest.is_fixed(self.graph, id, owner)
    }

    fn used(&self, id: NodeId) -> Reference {
        let (run, number) = self.own[id.0 as usize];
        if run == self.run {
            return Reference::Own(number);
        }
        if let node @ (Node::Carried { of, index } | Node::Last { of, index }) = self.graph.node(id)
            && let Some(&number) = self.loops.get(&of)
        {
            return Reference::Carried(number, index, matches!(node, Node::Last { .. }));
        }
        if self.is_fixed(id) {
            return Reference::Fixed(id);
        }
        Reference::Outside(self.graph.ty(id))
    }

    /// A token's references: what it reads, each told to `uses`, what it writes, the loop
    /// whose values it sets. `None` where it writes to a loop outside of the run.
    pub fn token(
        &mut self,
        token: &Token,
        uses: &mut impl FnMut(Reference),
    ) -> Option<(Option<Reference>, u32)> {
        for &id in &token.uses {
            uses(self.used(id));
        }
        if let Some(of) = token.opens {
            let number = self.loops.len() as u32;
            self.loops.insert(of, number);
        }
        let within = match token.within {
            Some(of) => 1 + *self.loops.get(&of)?,
            None => 0,
        };
        let def = token.def.map(|id| {
            if self.is_fixed(id) {
                return Reference::Fixed(id);
            }
            let own = &mut self.own[id.0 as usize];
            if own.0 != self.run {
                *own = (self.run, self.count);
                self.count += 1;
            }
            Reference::Own(own.1)
        });
        Some((def, within))
    }
}

/// Several runs of one shape.
pub(super) struct Group {
    /// In order; none overlap.
    pub runs: Vec<Run>,
    /// For each run, what it reads from outside, by position.
    pub outside: Vec<Vec<NodeId>>,
    /// For each run, what it computes, by number.
    pub own: Vec<Vec<NodeId>>,
    /// For each run, which of those are read elsewhere.
    pub left: Vec<Vec<u32>>,
    /// For each position, what all runs read there, or the number of the slot
    /// that they are to be given it in.
    pub given: Vec<Given>,
    /// Each slot's positions' type.
    pub slots: Vec<Type>,
}

/// How a subroutine reads what a run reads from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Given {
    /// Where it is.
    Alike(NodeId),
    /// In a slot, by number.
    Slot(usize),
}

/// What one run is made of, as the others have to be.
struct Read {
    key: Vec<(References, [u32; 4])>,
    outside: Vec<NodeId>,
    /// Whether each position is read on every way.
    sure: Vec<bool>,
    own: Vec<NodeId>,
    bytes: u32,
}

fn read(reader: &mut Reader<'_>, run: Run) -> Option<Read> {
    let forest = reader.forest;
    reader.begin(run.block);
    let mut all = Read {
        key: Vec::new(),
        outside: Vec::new(),
        sure: Vec::new(),
        own: Vec::new(),
        bytes: 0,
    };
    for token in forest.tokens[run.block][run.from..run.to].iter().flatten() {
        let mut uses = Vec::with_capacity(token.uses.len());
        let (def, within) = reader.token(token, &mut |reference| uses.push(reference))?;
        for (reference, &id) in uses.iter().zip(&token.uses) {
            if matches!(reference, Reference::Outside(_)) {
                all.outside.push(id);
                all.sure.push(token.sure);
            }
        }
        if let (Some(Reference::Own(number)), Some(id)) = (def, token.def)
            && number as usize == all.own.len()
        {
            all.own.push(id);
        }
        all.bytes += token.bytes;
        all.key.push(((uses, def, within), token.shape));
    }
    Some(all)
}

/// What a run computes that is read elsewhere; `None` where some of that is
/// computed on some ways only.
fn left(forest: &Forest, run: Run, own: &[NodeId]) -> Option<Vec<u32>> {
    let mut inside: FxHashMap<NodeId, u32> = FxHashMap::default();
    for token in forest.tokens[run.block][run.from..run.to].iter().flatten() {
        for id in &token.uses {
            *inside.entry(*id).or_default() += 1;
        }
    }
    let mut left = Vec::new();
    for (number, id) in own.iter().enumerate() {
        let here = inside.get(id).copied().unwrap_or(0);
        if forest.reads[id.0 as usize] > here {
            if !forest.is_assigned_in(*id, run.block, run.from..run.to) {
                return None;
            }
            left.push(number as u32);
        }
    }
    Some(left)
}

/// Whether what a run reads is computed before it on every way.
fn may_be_given(graph: &Graph, forest: &Forest, run: Run, read: &Read, given: &[Given]) -> bool {
    (0..given.len()).all(|at| {
        let same = |other: &usize| given[*other] == given[at] && read.sure[*other];
        matches!(given[at], Given::Alike(_))
            || forest.is_assigned(graph, read.outside[at], run.block, run.from)
            // Read on every way through the run, hence computed before it.
            || ((0..given.len()).any(|other| same(&other))
                && !matches!(graph.node(read.outside[at]), Node::Undefined(_)))
    })
}

/// How to give each position to a subroutine of several runs.
fn given(outside: &[&Vec<NodeId>], graph: &Graph) -> (Vec<Given>, Vec<Type>) {
    let mut classes: BTreeMap<Vec<NodeId>, usize> = BTreeMap::new();
    let mut slots = Vec::new();
    let positions = outside.first().map_or(0, |o| o.len());
    let all = (0..positions).map(|at| {
        let here: Vec<NodeId> = outside.iter().map(|o| o[at]).collect();
        match here.first() {
            Some(&first) if here.iter().all(|id| *id == first) => Given::Alike(first),
            Some(&first) => Given::Slot(*classes.entry(here).or_insert_with(|| {
                slots.push(graph.ty(first));
                slots.len() - 1
            })),
            None => Given::Slot(0),
        }
    });
    let all = all.collect();
    (all, slots)
}

/// The runs that still stand as they were, of those the first ones that do not overlap.
fn apart(forest: &Forest, runs: &[Run]) -> Vec<Run> {
    let mut kept: Vec<Run> = Vec::new();
    for &run in runs {
        let whole = !forest.touched[run.block][run.from..run.to].contains(&true);
        let clear = kept
            .last()
            .is_none_or(|last| last.block != run.block || last.to <= run.from);
        if whole && clear {
            kept.push(run);
        }
    }
    kept
}

/// What a subroutine of these runs would save, if anything, and how.
pub(super) fn group(
    graph: &Graph,
    forest: &Forest,
    sizes: &Sizes,
    runs: &[Run],
) -> Option<(u32, Group)> {
    let mut found: Vec<(Run, Read, Vec<u32>)> = Vec::new();
    let mut reader = Reader::new(graph, forest);
    for run in apart(forest, runs) {
        let Some(read) = read(&mut reader, run) else {
            continue;
        };
        // Numbers of 64 bits may meet by chance.
        let alike = found
            .first()
            .is_none_or(|(_, first, _)| first.key == read.key);
        if let Some(left) = left(forest, run, &read.own).filter(|_| alike) {
            found.push((run, read, left));
        }
    }
    let (mut all, mut slots);
    loop {
        let outside: Vec<&Vec<NodeId>> = found.iter().map(|(_, r, _)| &r.outside).collect();
        (all, slots) = given(&outside, graph);
        let before = found.len();
        found.retain(|(run, read, _)| may_be_given(graph, forest, *run, read, &all));
        if found.len() == before {
            break;
        }
    }
    if found.len() < 2 {
        return None;
    }
    let set: u32 = slots.iter().map(|&ty| sizes.copy_of(ty)).sum();
    let mut saved = -i64::from(sizes.around) - i64::from(sizes.home) * slots.len() as i64;
    saved -= i64::from(found.first().map_or(0, |(_, read, _)| read.bytes));
    for (_, read, left) in &found {
        let copies = left.iter().filter_map(|&k| read.own.get(k as usize));
        let copied: u32 = copies.map(|&id| sizes.copy_of(graph.ty(id))).sum();
        saved += i64::from(read.bytes) - i64::from(sizes.call + set + copied);
    }
    let saved = u32::try_from(saved).ok().filter(|s| *s > 0)?;
    let mut group = Group {
        runs: Vec::new(),
        outside: Vec::new(),
        own: Vec::new(),
        left: Vec::new(),
        given: all,
        slots,
    };
    for (run, read, left) in found {
        group.runs.push(run);
        group.outside.push(read.outside);
        group.own.push(read.own);
        group.left.push(left);
    }
    Some((saved, group))
}

fn mixed(into: u64, reference: Reference) -> u64 {
    let (kind, a, b) = match reference {
        Reference::Own(k) => (1, k, 0),
        Reference::Carried(l, k, last) => (2 + u64::from(last), l, k),
        Reference::Fixed(id) => (4, id.0, 0),
        Reference::Outside(ty) => (5, ty as u32, 0),
    };
    mix(mix(into, kind), u64::from(a) << 32 | u64::from(b))
}

/// Runs of one shape that may be worth a subroutine, with what they would save
/// if calls were free.
pub(super) fn candidates(graph: &Graph, forest: &Forest, least: u32) -> Vec<(u32, Vec<Run>)> {
    let mut shapes: FxHashMap<u64, (u32, Vec<Run>)> = FxHashMap::default();
    let mut reader = Reader::new(graph, forest);
    for block in (0..forest.tokens.len()).filter(|block| forest.open[*block]) {
        let statements = &forest.tokens[block];
        for from in 0..statements.len() {
            reader.begin(block);
            let (mut hash, mut length, mut bytes) = (0, 0, 0);
            'run: for (at, tokens) in statements.iter().enumerate().skip(from) {
                length += tokens.len();
                if length > LONGEST || forest.touched[block][at] {
                    break;
                }
                for token in tokens {
                    for part in token.shape {
                        hash = mix(hash, u64::from(part));
                    }
                    let mut uses = |reference| hash = mixed(hash, reference);
                    let Some((def, within)) = reader.token(token, &mut uses) else {
                        break 'run;
                    };
                    hash = mix(hash, u64::from(within));
                    hash = def.into_iter().fold(hash, mixed);
                    bytes += token.bytes;
                }
                if bytes > least {
                    let to = at + 1;
                    let found = shapes.entry(hash).or_insert((bytes, Vec::new()));
                    found.1.push(Run { block, from, to });
                }
            }
        }
    }
    let several = shapes.into_values().filter(|(_, runs)| runs.len() > 1);
    let mut all: Vec<(u32, Vec<Run>)> = several
        .map(|(bytes, runs)| (bytes.saturating_mul(runs.len() as u32 - 1), runs))
        .collect();
    // In an order that no hash decides.
    all.sort_unstable_by(|a, b| (b.0, &a.1).cmp(&(a.0, &b.1)));
    all
}
