//! Scaling minimisation (Kum, Kang and Sung, AUTOSCALER for C, IEEE Transactions on Circuits and
//! Systems II 47(9), 2000): values that loops copy, add and compare at every turn have one point,
//! where that costs the picture hardly anything, so that nothing is shifted there.

use super::histogram::Seen;
use super::scales::greatest;
use crate::analysis::carried::{Readers, held_by, readers};
use crate::analysis::points::widths::Widths;
use crate::ir::graph::*;
use crate::ir::tree::*;
use slowlight_routine::scale::fitting;
use slowlight_routine::{Op, Type};

/// What it may cost a pixel that values have one point.
const HARDLY: f64 = 1.5 / 1024.0;

/// Two values that are shifted to each other's point in so many loops at each turn.
struct Edge {
    deep: u32,
    ends: [NodeId; 2],
}

/// Operations that read their operands at one scale.
fn reads_alike(op: Op) -> bool {
    matches!(
        op,
        Op::Add
            | Op::Sub
            | Op::Min
            | Op::Max
            | Op::Neg
            | Op::Abs
            | Op::Less
            | Op::LessEqual
            | Op::Equal
    )
}

/// What is shifted in loops, that of the innermost first.
fn edges(graph: &Graph, tree: &Tree, carried: &Readers) -> Vec<Edge> {
    let mut found = Found {
        graph,
        carried,
        edges: Vec::new(),
    };
    for block in tree.blocks() {
        found.block(block, 0);
    }
    let mut edges = found.edges;
    edges.sort_by_key(|edge| std::cmp::Reverse(edge.deep));
    edges
}

struct Found<'g> {
    graph: &'g Graph,
    carried: &'g Readers,
    edges: Vec<Edge>,
}

impl Found<'_> {
    fn block(&mut self, block: &Block, deep: u32) {
        for statement in block {
            match statement {
                Statement::Let(id) => self.operation(*id, deep),
                Statement::Set {
                    place,
                    from: Origin::Node(from),
                } => {
                    // What a loop begins with is its turns'.
                    let inside = u32::from(matches!(place, Place::Carried(..)));
                    if let Some(to) = held_by(self.carried, *place) {
                        self.edge(*from, to, deep.max(inside));
                    }
                }
                Statement::If { yes, no, .. } => {
                    self.block(yes, deep);
                    self.block(no, deep);
                }
                Statement::Loop(turns) => {
                    self.block(&turns.body, deep + 1);
                    self.block(&turns.next, deep + 1);
                    self.block(&turns.start, deep);
                    self.block(&turns.done, deep);
                    self.block(&turns.otherwise, deep);
                }
                _ => {}
            }
        }
    }

    fn operation(&mut self, id: NodeId, deep: u32) {
        let Node::Apply(op, [a, b]) = self.graph.node(id) else {
            return;
        };
        if !reads_alike(op) {
            return;
        }
        if op.result() == Type::Real {
            self.edge(a, id, deep);
        }
        if op.arity() == 2 {
            self.edge(a, b, deep);
        }
    }

    fn edge(&mut self, a: NodeId, b: NodeId, deep: u32) {
        let varies = |id| self.graph.ty(id) == Type::Real && self.graph.constant(id).is_none();
        if deep > 0 && a != b && varies(a) && varies(b) {
            self.edges.push(Edge { deep, ends: [a, b] });
        }
    }
}

/// Values that have one point, and the finest that they may have.
struct Group {
    frac: i8,
    finest: i8,
    members: Vec<NodeId>,
}

/// Whether a value has the point that its range leaves room for, or a coarser one: it is not cut
/// by who computes it.
fn is_given(graph: &Graph, id: NodeId) -> bool {
    match graph.node(id) {
        Node::Lookup { table, .. } => {
            let table = graph.tables.get(table.0 as usize);
            table.is_none_or(|table| !table.seed.is_empty())
        }
        Node::Apply(..) | Node::Select { .. } | Node::Carried { .. } => false,
        _ => true,
    }
}

/// The points that values in loops share, of what was seen of each in so many pixels; `most` is
/// what each is expected to stay within, and becomes what those are expected to that share one.
pub(super) fn shared(
    (graph, tree): (&Graph, &Tree),
    (seen, pixels): (&[Seen], f64),
    widths: &Widths,
    most: &mut [Option<f64>],
) -> Vec<Option<i8>> {
    let carried = readers(graph);
    let own: Vec<i8> = (graph.ids())
        .map(|id| {
            let at = id.0 as usize;
            let end = most[at].unwrap_or(seen[at].room());
            let end = match graph.node(id) {
                Node::Lookup { table, .. } => greatest(graph, table),
                _ => end.min(seen[at].room()),
            };
            fitting(end, widths.value(id))
        })
        .collect();
    let cost = |id: NodeId, frac: i8| seen[id.0 as usize].cost(frac, widths.value(id));
    let loss = |members: &[NodeId], frac: i8| -> f64 {
        let each = members.iter();
        each.map(|id| cost(*id, frac) - cost(*id, own[id.0 as usize]))
            .sum()
    };
    let mut groups: Vec<Group> = (graph.ids().zip(&own))
        .map(|(id, own)| Group {
            frac: *own,
            finest: if is_given(graph, id) { *own } else { i8::MAX },
            members: vec![id],
        })
        .collect();
    let mut home: Vec<usize> = (0..groups.len()).collect();
    for Edge { ends: [a, b], .. } in edges(graph, tree, &carried) {
        let (to, from) = (home[a.0 as usize], home[b.0 as usize]);
        if to == from || widths.value(a) != widths.value(b) {
            continue;
        }
        let [one, other] = [to, from].map(|k| groups[k].frac);
        let finest = groups[to].finest.min(groups[from].finest);
        let joined = [&groups[to].members[..], &groups[from].members[..]].concat();
        let losses =
            (one.min(other)..=one.max(other).min(finest)).map(|frac| (loss(&joined, frac), frac));
        let best = losses.min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, frac)) = best.filter(|(loss, _)| *loss <= HARDLY * pixels) else {
            continue;
        };
        for id in &groups[from].members {
            home[id.0 as usize] = to;
        }
        groups[from].members.clear();
        groups[to] = Group {
            frac,
            finest,
            members: joined,
        };
    }
    let mut points = vec![None; graph.nodes.len()];
    for group in groups.iter().filter(|group| group.members.len() > 1) {
        for id in &group.members {
            let at = id.0 as usize;
            points[at] = Some(group.frac);
            if own[at] < group.frac {
                let end = slowlight_routine::scale::most(widths.value(*id)) as f64;
                most[at] = Some(end * (-f64::from(group.frac)).exp2());
            }
        }
    }
    points
}
