//! Arena form of statements: every block in one arena, so that runs of them can be numbered,
//! compared and replaced.

use super::Extent;
use super::step::{BlockId, Step};
use super::token::{Token, reads_of};
use crate::analysis::region::Fact;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::schedule::constant_runs::still;
use crate::source::Span;
use crate::targets::Sizes;
use rustc_hash::{FxHashMap, FxHashSet};

/// A block's place: in which block, before which statement of it.
type Above = Option<(BlockId, usize)>;

/// Statements under work.
pub(super) struct Forest {
    /// Each block's statements; each may be replaced by several or none.
    pub blocks: Vec<Vec<Vec<Step>>>,
    /// Each statement's tokens, those inside it included.
    pub tokens: Vec<Vec<Vec<Token>>>,
    /// What has been replaced, or holds something that has.
    pub touched: Vec<Vec<bool>>,
    /// The subroutine that each block belongs to.
    pub owner: Vec<Option<SubroutineId>>,
    /// The subroutine that each node belongs to, if it belongs to one.
    pub node_owner: Vec<Option<SubroutineId>>,
    /// The slots that subroutines write themselves, not their calls.
    pub(super) ways: FxHashSet<NodeId>,
    /// How often each node is read anywhere.
    pub reads: Vec<u32>,
    /// The statement after which a node is computed on every way.
    pub(super) assigned: FxHashMap<NodeId, (BlockId, usize)>,
    /// Where what was computed before a block stands.
    pub(super) before: Vec<Above>,
    /// The statement that holds a block.
    pub around: Vec<Above>,
    /// What is known of a condition in a block that is an arm.
    pub(super) facts: Vec<Option<Fact>>,
    /// Frame, row, pixel, then the subroutines' bodies.
    pub(super) tops: Vec<BlockId>,
    /// The subroutines' names and spans.
    pub named: Vec<(String, Span)>,
    /// What of the picture is looked at.
    pub extent: Extent,
    /// Whether each block's statements may become calls.
    pub open: Vec<bool>,
}

impl Forest {
    pub fn new(graph: &Graph, tree: Tree, bytes: &[u32], sizes: &Sizes, extent: Extent) -> Forest {
        let mut forest = Forest {
            blocks: Vec::new(),
            tokens: Vec::new(),
            touched: Vec::new(),
            owner: Vec::new(),
            node_owner: vec![None; graph.nodes.len()],
            ways: FxHashSet::default(),
            reads: vec![0; graph.nodes.len()],
            assigned: FxHashMap::default(),
            before: Vec::new(),
            around: Vec::new(),
            facts: Vec::new(),
            tops: Vec::new(),
            named: Vec::new(),
            extent,
            open: Vec::new(),
        };
        let mut above = None;
        let mut outer = match extent {
            // Such programs are not cut into segments.
            Extent::All => vec![
                (tree.frame, true),
                (tree.column, false),
                (tree.row, true),
                ([tree.pass, tree.segment, tree.pixel].concat(), true),
            ],
            Extent::Rows | Extent::Runs => vec![
                (tree.frame, true),
                (tree.column, false),
                (tree.row, true),
                (tree.pass, true),
                (tree.segment, extent == Extent::Runs),
                (tree.pixel, false),
            ],
        };
        // What stands behind a picture that moves stays there.
        if !tree.step.is_empty() {
            outer.push((tree.step, false));
        }
        for (block, open) in outer {
            let end = block.len();
            let first = forest.blocks.len();
            let made = forest.block(block, None, above, None);
            forest.open[first..].fill(open);
            forest.tops.push(made);
            above = Some((made, end));
        }
        for (k, subroutine) in tree.subroutines.into_iter().enumerate() {
            let id = SubroutineId(k as u32);
            let made = forest.block(subroutine.body, Some(id), None, None);
            forest.tops.push(made);
            forest.named.push((subroutine.name, subroutine.span));
        }
        let known = still(graph);
        let known = known.iter().flat_map(|still| still.reads(graph));
        for root in graph.roots().chain(graph.shade).chain(known) {
            forest.reads[root.0 as usize] += 1;
        }
        forest.own(graph);
        forest.describe(graph, bytes, sizes);
        forest
    }

    /// Takes a block apart. `before` is where what is computed earlier stands.
    fn block(
        &mut self,
        block: Block,
        owner: Option<SubroutineId>,
        before: Above,
        around: Above,
    ) -> BlockId {
        let id = self.blocks.len();
        self.blocks.push(Vec::new());
        self.tokens.push(Vec::new());
        self.touched.push(vec![false; block.len()]);
        self.owner.push(owner);
        self.open.push(true);
        self.before.push(before);
        self.around.push(around);
        self.facts.push(None);
        let mut steps = Vec::with_capacity(block.len());
        for (at, statement) in block.into_iter().enumerate() {
            let here = Some((id, at));
            let step = match statement {
                Statement::Let(node) => {
                    self.assigned.insert(node, (id, at));
                    Step::Let(node)
                }
                Statement::Set { place, from } => {
                    if let Place::Node(node) = place {
                        self.assigned.insert(node, (id, at));
                    }
                    Step::Set { place, from }
                }
                Statement::Call(called) => Step::Call(called),
                Statement::If { cond, yes, no } => {
                    let arms = [yes, no].map(|arm| self.block(arm, owner, here, here));
                    let [yes, no] = arms;
                    self.facts[yes] = Some((cond, true));
                    self.facts[no] = Some((cond, false));
                    self.join(
                        &steps_of(&self.blocks[yes]),
                        &steps_of(&self.blocks[no]),
                        (id, at),
                    );
                    Step::If { cond, arms }
                }
                Statement::Loop(turns) => {
                    let mut last = here;
                    let part = |forest: &mut Forest, block: Block, before: Above| {
                        let end = block.len();
                        let made = forest.block(block, owner, before, here);
                        (made, Some((made, end)))
                    };
                    let (start, after_start) = part(self, turns.start, last);
                    let (body, after_body) = part(self, turns.body, after_start);
                    let (next, after_next) = part(self, turns.next, after_body);
                    let (done, _) = part(self, turns.done, after_body);
                    last = after_next;
                    let (otherwise, _) = part(self, turns.otherwise, last);
                    let (a, b) = (
                        steps_of(&self.blocks[done]),
                        steps_of(&self.blocks[otherwise]),
                    );
                    self.join(&a, &b, (id, at));
                    Step::Loop {
                        of: turns.of,
                        again: turns.again,
                        parts: [start, body, next, done, otherwise],
                    }
                }
            };
            steps.push(vec![step]);
        }
        self.blocks[id] = steps;
        id
    }

    /// What two ways both set is set after them.
    fn join(&mut self, a: &[Step], b: &[Step], at: (BlockId, usize)) {
        let set = |step: &Step| match step {
            Step::Set {
                place: Place::Node(id),
                ..
            } => Some(*id),
            _ => None,
        };
        let others: Vec<NodeId> = b.iter().filter_map(set).collect();
        for id in a.iter().filter_map(set).filter(|id| others.contains(id)) {
            self.assigned.insert(id, at);
        }
    }

    /// Finds out which nodes belong to subroutines: what their bodies write,
    /// and the slots that they read.
    fn own(&mut self, graph: &Graph) {
        // A body may set the slots of what it calls, so those who read come first.
        for writes in [false, true] {
            for (block, owner) in self.owner.iter().enumerate() {
                let Some(owner) = *owner else {
                    continue;
                };
                for step in self.blocks[block].iter().flatten() {
                    let ids = match step {
                        Step::Let(id)
                        | Step::Set {
                            place: Place::Node(id),
                            ..
                        } if writes => vec![*id],
                        _ if writes => Vec::new(),
                        step => reads_of(graph, step),
                    };
                    for id in ids {
                        let slot = matches!(graph.node(id), Node::Slot(_));
                        let held = &mut self.node_owner[id.0 as usize];
                        if held.is_none() && (slot || writes) {
                            *held = Some(owner);
                        }
                        if slot && writes && *held == Some(owner) {
                            self.ways.insert(id);
                        }
                    }
                }
            }
        }
    }

    /// Notes that a run is replaced: nothing that holds it or is in it may be
    /// compared with its tokens any more.
    pub fn touch(&mut self, block: BlockId, run: std::ops::Range<usize>) {
        for at in run {
            self.touch_down(block, at);
        }
        let mut above = self.around[block];
        while let Some((block, at)) = above {
            self.touched[block][at] = true;
            above = self.around[block];
        }
    }

    fn touch_down(&mut self, block: BlockId, at: usize) {
        self.touched[block][at] = true;
        let inner: Vec<BlockId> = self.blocks[block][at]
            .iter()
            .flat_map(|step| match step {
                Step::If { arms, .. } => arms.to_vec(),
                Step::Loop { parts, .. } => parts.to_vec(),
                _ => Vec::new(),
            })
            .collect();
        for block in inner {
            for at in 0..self.blocks[block].len() {
                self.touch_down(block, at);
            }
        }
    }

    /// A new subroutine.
    pub fn add(&mut self, name: String, span: Span, body: Vec<Step>) -> SubroutineId {
        let id = SubroutineId(self.named.len() as u32);
        self.named.push((name, span));
        let body = self.add_block(body);
        self.tops.push(body);
        id
    }

    /// A new block, which is compared with none in this round.
    pub fn add_block(&mut self, steps: Vec<Step>) -> BlockId {
        self.touched.push(vec![true; steps.len()]);
        self.blocks
            .push(steps.into_iter().map(|s| vec![s]).collect());
        self.tokens.push(Vec::new());
        self.owner.push(None);
        self.open.push(true);
        self.before.push(None);
        self.around.push(None);
        self.facts.push(None);
        self.blocks.len() - 1
    }

    pub fn into_tree(mut self) -> Tree {
        let usual = if self.extent == Extent::All { 4 } else { 6 };
        let steps = self.tops.len() > usual + self.named.len();
        let mut tops = std::mem::take(&mut self.tops).into_iter();
        let mut next = |forest: &mut Forest| tops.next().map_or(Block::new(), |b| forest.take(b));
        let mut tree = Tree {
            frame: next(&mut self),
            column: next(&mut self),
            row: next(&mut self),
            ..Tree::default()
        };
        if self.extent != Extent::All {
            tree.pass = next(&mut self);
            tree.segment = next(&mut self);
        }
        tree.pixel = next(&mut self);
        if steps {
            tree.step = next(&mut self);
        }
        for (name, span) in std::mem::take(&mut self.named) {
            tree.subroutines.push(Subroutine {
                name,
                span,
                body: next(&mut self),
            });
        }
        tree
    }

    fn take(&mut self, block: BlockId) -> Block {
        let steps = std::mem::take(&mut self.blocks[block]);
        let mut all = Block::new();
        for step in steps.into_iter().flatten() {
            all.push(match step {
                Step::Let(id) => Statement::Let(id),
                Step::Set { place, from } => Statement::Set { place, from },
                Step::Call(id) => Statement::Call(id),
                Step::If {
                    cond,
                    arms: [yes, no],
                } => Statement::If {
                    cond,
                    yes: self.take(yes),
                    no: self.take(no),
                },
                Step::Loop {
                    of,
                    again,
                    parts: [start, body, next, done, otherwise],
                } => Statement::Loop(Box::new(Turns {
                    of,
                    start: self.take(start),
                    body: self.take(body),
                    again,
                    next: self.take(next),
                    done: self.take(done),
                    otherwise: self.take(otherwise),
                })),
            });
        }
        all
    }
}

fn steps_of(block: &[Vec<Step>]) -> Vec<Step> {
    block.iter().flatten().cloned().collect()
}
