//! The rewriting engine: a graph rebuilt node by node, by what every rewriting pass puts in the
//! place of each.

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use rustc_hash::FxHashMap;

/// A rewriting rule: given the node's old id and the node with its operands
/// already rebuilt, what stands for it instead, if anything.
pub type Rule<'r> = &'r mut dyn FnMut(&mut Builder, NodeId, Node, Span) -> Option<NodeId>;

/// A rule that looks at the old graph: given what stands for each old node so
/// far, and the node's old id, what stands for it instead, if anything.
pub type OldRule<'r> =
    &'r mut dyn FnMut(&mut Builder, &[Option<NodeId>], NodeId, Span) -> Option<NodeId>;

/// Where a value leaves the nodes: it goes on to another place of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// A loop's carried value: its start or its next.
    Carried(LoopId, u32),
    /// A loop's result, either way.
    Result(LoopId, u32),
    /// The pixel's ink.
    Ink,
    /// The picture's: the shade, what is sent or reported.
    Output,
}

/// What a rewriting pass does, for those that look at more than nodes.
pub trait Rewrite {
    /// What stands for a node, if anything else than itself.
    fn node(
        &mut self,
        builder: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        moved: Node,
        span: Span,
    ) -> Option<NodeId>;

    /// What stands for an old node where it ends, if anything else than what
    /// stands for it elsewhere.
    fn end(
        &mut self,
        _builder: &mut Builder,
        _made: &[Option<NodeId>],
        _id: NodeId,
        _end: End,
    ) -> Option<NodeId> {
        None
    }
}

/// The graph with `rule` applied to every node that the outputs reach.
pub fn rebuild(graph: &Graph, rule: Rule<'_>) -> Graph {
    rebuild_by(
        graph,
        &mut Nodes(|builder: &mut Builder, _: &[_], id, node, span| rule(builder, id, node, span)),
    )
}

/// The same by a rule that matches the old graph, several nodes deep.
pub fn rebuild_old(graph: &Graph, rule: OldRule<'_>) -> Graph {
    traced_old(graph, rule).0
}

/// What stands in a new graph for each node of the old one, if it is there.
pub type Trace = Vec<Option<NodeId>>;

/// [`rebuild_old`], and what stands for each old node.
pub fn traced_old(graph: &Graph, rule: OldRule<'_>) -> (Graph, Trace) {
    rebuild_all(
        graph,
        &mut Nodes(|builder: &mut Builder, made: &[_], id, _, span| rule(builder, made, id, span)),
    )
}

/// A rule on nodes alone.
struct Nodes<F>(F);

impl<F> Rewrite for Nodes<F>
where
    F: FnMut(&mut Builder, &[Option<NodeId>], NodeId, Node, Span) -> Option<NodeId>,
{
    fn node(
        &mut self,
        builder: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        moved: Node,
        span: Span,
    ) -> Option<NodeId> {
        (self.0)(builder, made, id, moved, span)
    }
}

/// The same by any rewriting.
pub fn rebuild_by(graph: &Graph, rewrite: &mut dyn Rewrite) -> Graph {
    rebuild_all(graph, rewrite).0
}

fn rebuild_all(graph: &Graph, rewrite: &mut dyn Rewrite) -> (Graph, Trace) {
    let mut rebuilder = Rebuilder {
        graph,
        builder: Builder::with_room(graph.nodes.len()),
        made: vec![None; graph.nodes.len()],
        loops: FxHashMap::default(),
        results: FxHashMap::default(),
    };
    let reached = graph.reached();
    // Params keep their numbers, used or not: they are the program's interface.
    let params: Vec<NodeId> = graph
        .params
        .iter()
        .map(|p| rebuilder.builder.param(p.clone()))
        .collect();
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        let made = match graph.node(id) {
            Node::Param(p) => params[p.0 as usize],
            Node::Result { of, index } => rebuilder.result(of, index, rewrite),
            Node::Select { cond, .. } if graph.early.contains(&id) => {
                let (cond, span) = (rebuilder.at(cond), graph.span(id));
                rebuilder.builder.early(cond, span)
            }
            node => {
                let node = rebuilder.moved(node, id, rewrite);
                let span = graph.span(id);
                match rewrite.node(&mut rebuilder.builder, &rebuilder.made, id, node, span) {
                    Some(other) => other,
                    None => rebuilder.plain(node, span),
                }
            }
        };
        rebuilder.made[id.0 as usize] = Some(made);
        if let Some(name) = graph.names.get(&id) {
            rebuilder.builder.name_as(made, || name.clone());
        }
        if let Some(length) = graph.directions.get(&id) {
            rebuilder.builder.direction(made, *length);
        }
    }
    let (ink, shade) = (
        rebuilder.end(graph.ink, End::Ink, rewrite),
        graph.shade.map(|s| rebuilder.end(s, End::Output, rewrite)),
    );
    if let Some(diffusion) = &graph.diffusion {
        let shares: Vec<Share> = (diffusion.shares.iter())
            .map(|&share| Share {
                node: rebuilder.end(share.node, End::Output, rewrite),
                ..share
            })
            .collect();
        rebuilder.builder.spread(&shares, diffusion.span);
    }
    if let Some(refinement) = &graph.refinement {
        let kept = rebuilder.end(refinement.kept, End::Output, rewrite);
        rebuilder.builder.keep(Refinement {
            kept,
            ..*refinement
        });
    }
    for &report in &graph.reports {
        let report = rebuilder.end(report, End::Output, rewrite);
        rebuilder.builder.report(report);
    }
    for (&id, &(op, [a, b])) in &graph.claims {
        let new = |id: NodeId| rebuilder.made.get(id.0 as usize).copied().flatten();
        if let (Some(id), Some(a), Some(b)) = (new(id), new(a), new(b)) {
            rebuilder.builder.claim(id, op, [a, b]);
        }
    }
    for effect in &graph.effects {
        (0..effect.calls).for_each(|_| rebuilder.builder.effect(&effect.name));
    }
    let made = rebuilder.made;
    (
        rebuilder.builder.finish(graph.image.clone(), ink, shade),
        made,
    )
}

struct Rebuilder<'g> {
    graph: &'g Graph,
    builder: Builder,
    made: Vec<Option<NodeId>>,
    /// The new number of each old loop.
    loops: FxHashMap<LoopId, LoopId>,
    /// The new results of each old loop that is closed.
    results: FxHashMap<LoopId, Vec<NodeId>>,
}

impl Rebuilder<'_> {
    /// The new node for an old one; operands stand before their users, so it is there.
    fn at(&mut self, id: NodeId) -> NodeId {
        match self.made.get(id.0 as usize).copied().flatten() {
            Some(made) => made,
            None => self.builder.undefined(self.graph.ty(id)),
        }
    }

    /// The same where the value ends.
    fn end(&mut self, id: NodeId, end: End, rewrite: &mut dyn Rewrite) -> NodeId {
        let plain = self.at(id);
        let other = rewrite.end(&mut self.builder, &self.made, id, end);
        other.unwrap_or(plain)
    }

    fn ends(
        &mut self,
        list: &[NodeId],
        end: impl Fn(u32) -> End,
        rewrite: &mut dyn Rewrite,
    ) -> Vec<NodeId> {
        let numbered = (0..).zip(list);
        numbered
            .map(|(k, &id)| self.end(id, end(k), rewrite))
            .collect()
    }

    /// A node with its operands and loop replaced by the new ones.
    fn moved(&mut self, node: Node, id: NodeId, rewrite: &mut dyn Rewrite) -> Node {
        match node {
            Node::Apply(op, [a, b]) => Node::Apply(op, [self.at(a), self.at(b)]),
            Node::Select { cond, yes, no } => Node::Select {
                cond: self.at(cond),
                yes: self.at(yes),
                no: self.at(no),
            },
            Node::Lookup { table, column, row } => {
                let table = self.graph.tables.get(table.0 as usize).cloned();
                let table = table.map_or(TableId(0), |t| self.builder.table(t));
                Node::Lookup {
                    table,
                    column: self.at(column),
                    row: self.at(row),
                }
            }
            Node::Ramp {
                first,
                step,
                stride,
            } => Node::Ramp {
                first: self.at(first),
                step: self.at(step),
                stride,
            },
            Node::Stepped { first, step } => Node::Stepped {
                first: self.at(first),
                step: self.at(step),
            },
            Node::Tabulated(value) => Node::Tabulated(self.at(value)),
            Node::Carried { of, index } => Node::Carried {
                of: self.open(of, rewrite),
                index,
            },
            Node::Last { of, index } => Node::Last {
                of: self.open(of, rewrite),
                index,
            },
            Node::Undefined(_) => Node::Undefined(self.graph.ty(id)),
            other => other,
        }
    }

    fn plain(&mut self, node: Node, span: Span) -> NodeId {
        let b = &mut self.builder;
        match node {
            Node::Const(c) => b.constant(c.value(), span),
            Node::Axis(axis) => b.axis(axis, span),
            Node::Apply(op, args) => b.apply(op, &args[..op.arity()], span),
            Node::Select { cond, yes, no } => b.select(cond, yes, no, span),
            Node::Lookup { table, column, row } => b.lookup(table, column, row, span),
            Node::Ramp {
                first,
                step,
                stride,
            } => b.ramp(first, step, stride, span),
            Node::Stepped { first, step } => b.stepped(first, step, span),
            Node::Tabulated(value) => b.tabulated(value, span),
            Node::Carried { of, index } => b.carried(of, index, span),
            Node::Last { of, index } => b.last(of, index, span),
            Node::Received => b.received(span),
            Node::Neighbour(which) => b.neighbour(which, span),
            // Graphs are rebuilt before they have subroutines.
            Node::Slot(ty) | Node::Undefined(ty) => b.undefined(ty),
            Node::Param(_) | Node::Result { .. } => b.undefined(slowlight_routine::Type::Real),
        }
    }

    /// The new loop for an old one. Its start values stand before anything
    /// that uses its carried values.
    fn open(&mut self, of: LoopId, rewrite: &mut dyn Rewrite) -> LoopId {
        if let Some(&found) = self.loops.get(&of) {
            return found;
        }
        let old = &self.graph.loops[of.0 as usize];
        let init = self.ends(&old.init, |k| End::Carried(of, k), rewrite);
        let carried: Vec<_> = (old
            .names
            .iter()
            .cloned()
            .zip(old.types.iter().copied())
            .zip(init))
        .map(|((name, ty), init)| (name, ty, init))
        .collect();
        let made = self.builder.open_loop(old.max, &carried, old.span);
        self.loops.insert(of, made);
        made
    }

    fn result(&mut self, of: LoopId, index: u32, rewrite: &mut dyn Rewrite) -> NodeId {
        if !self.results.contains_key(&of) {
            let new = self.open(of, rewrite);
            let old = &self.graph.loops[of.0 as usize];
            let again = self.at(old.again);
            let next = self.ends(&old.next, |k| End::Carried(of, k), rewrite);
            let done = self.ends(&old.done, |k| End::Result(of, k), rewrite);
            let otherwise = self.ends(&old.otherwise, |k| End::Result(of, k), rewrite);
            let made = self
                .builder
                .close_loop(new, again, &next, &done, &otherwise);
            self.results.insert(of, made);
        }
        let found = self
            .results
            .get(&of)
            .and_then(|r| r.get(index as usize))
            .copied();
        found.unwrap_or_else(|| self.builder.undefined(slowlight_routine::Type::Real))
    }
}
