//! Profitability and accuracy of a normal form: the machine's cycles for a pixel, and what is
//! lost to roundings.
//!
//! Roundings are followed through both formulas at pixels spread over the picture
//! (and params over their ranges), to first order: each operation adds a unit in
//! the last place of its result, exact ones nothing. That is an estimate, not a
//! bound; it is compared with the same estimate for what stands there now. A form
//! with values beyond the format's end, where there are none now, is not taken.

use super::New;
use super::key::{Keys, near, shared};
use super::wholes::{floored, inexact};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::rounding_samples::{Follow, Nodes, Rounded, Sample};
use rustc_hash::FxHashMap;
use slowlight_routine::{Format, Runtime, Type, scale};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Cycles a pixel for all that a value needs and that is another in every
/// column, beside what is there anyway; either arm of a choice is taken for half
/// of the pixels.
pub fn cycles(
    nodes: &dyn Nodes,
    root: NodeId,
    runtime: &Runtime,
    there: &dyn Fn(NodeId) -> bool,
) -> u32 {
    let mut varies = FxHashMap::default();
    // How often each value is needed; users have greater numbers.
    let mut todo: BTreeMap<NodeId, f64> = BTreeMap::from([(root, 1.0)]);
    let mut sum = 0.0;
    while let Some((id, often)) = todo.pop_last() {
        if there(id) || !column(nodes, id, &mut varies, 0) {
            continue;
        }
        let mut needs = |id: NodeId, part: f64| {
            let held = todo.entry(id).or_insert(0.0);
            *held = match part < 1.0 {
                true => (*held + often * part).min(1.0),
                false => held.max(often),
            };
        };
        match nodes.node(id) {
            Node::Select { cond, yes, no } => {
                needs(cond, 1.0);
                needs(yes, 0.5);
                needs(no, 0.5);
            }
            node => {
                node.operands().for_each(|id| needs(id, 1.0));
                if let Node::Apply(op, _) = node {
                    let found = runtime.usual(op);
                    sum += often * found.map_or(0.0, |r| f64::from(r.cycles));
                }
            }
        }
    }
    sum as u32
}

/// Whether a node depends on the column beyond its pass (or on a loop); deep graphs count as such.
fn column(nodes: &dyn Nodes, id: NodeId, known: &mut FxHashMap<NodeId, bool>, deep: u32) -> bool {
    if let Some(&found) = known.get(&id) {
        return found;
    }
    let made = match nodes.node(id) {
        Node::Axis(Axis::X) => true,
        _ if deep > 500 => true,
        Node::Carried { .. } | Node::Last { .. } | Node::Result { .. } => true,
        Node::Received | Node::Neighbour(_) => true,
        node => node.operands().any(|a| column(nodes, a, known, deep + 1)),
    };
    known.insert(id, made);
    made
}

/// What decides whether roundings do too much.
pub struct Judge<'g> {
    pub graph: &'g Graph,
    pub samples: &'g [Sample],
    pub allowance: f64,
    /// The greatest real of the format: what a form has beyond it would saturate.
    pub end: f64,
    /// What the graph's own values come to at the samples.
    pub followed: &'g Followed,
}

/// What a graph's own values come to at its samples, kept for whoever judges other forms of
/// them: forms are judged again and again, each time with other ones beside them.
#[derive(Default)]
pub struct Followed {
    /// Whether forms are judged by what they do to the operands of values, which were judged
    /// themselves: else by what they do from the pixel's place on.
    local: bool,
    values: Mutex<FxHashMap<NodeId, Known>>,
    /// Whether a form is good enough for a value, by its number ([`Keys`]).
    judged: Mutex<FxHashMap<(NodeId, bool, u64), bool>>,
    /// Which values a `floor` needs as they are.
    floored: OnceLock<Vec<bool>>,
}

/// What is known of a value.
#[derive(Clone)]
struct Known {
    at: Arc<AtSamples>,
    /// What of it is the same in its forms.
    shared: Arc<Vec<NodeId>>,
}

/// A value at each sample, as far as it was looked at; nothing where it depends on a loop.
type AtSamples = Vec<OnceLock<Option<Was>>>;

/// A value at a sample.
struct Was {
    relative: f64,
    value: Option<Rounded>,
    misses_root: bool,
    /// The greatest magnitude of a real on the way.
    most: f64,
    /// What is the same in its forms.
    shared: Vec<(NodeId, Rounded)>,
}

impl Was {
    fn new(follow: &mut Follow<'_, Graph>, id: NodeId, shared: &[NodeId]) -> Option<Was> {
        let relative = relative(follow, id)?;
        let value = follow.value(id, 0);
        let shared = (shared.iter()).filter_map(|id| Some((*id, follow.known.get(*id)?)));
        Some(Was {
            relative,
            value,
            misses_root: follow.misses_root(),
            most: follow.most(),
            shared: shared.collect(),
        })
    }
}

impl Followed {
    /// For forms that are judged by their operands.
    pub fn local() -> Followed {
        Followed {
            local: true,
            ..Followed::default()
        }
    }

    /// What is known of a value at so many samples.
    fn of(&self, graph: &Graph, id: NodeId, samples: usize) -> Known {
        // A thread that panicked has left whole entries.
        let mut all = self.values.lock().unwrap_or_else(PoisonError::into_inner);
        let none = || Known {
            at: Arc::new((0..samples).map(|_| OnceLock::new()).collect()),
            shared: Arc::new(match self.local {
                true => near(graph, id),
                false => shared(graph, id),
            }),
        };
        all.entry(id).or_insert_with(none).clone()
    }

    /// Whether a `floor` needs a value as it is.
    fn floors(&self, graph: &Graph, id: NodeId) -> bool {
        self.floored.get_or_init(|| floored(graph))[id.0 as usize]
    }

    /// What a form was judged to be, if it was; else what it is.
    fn judged(&self, key: (NodeId, bool, u64), judge: impl FnOnce() -> bool) -> bool {
        let held = || self.judged.lock().unwrap_or_else(PoisonError::into_inner);
        let known = held().get(&key).copied();
        known.unwrap_or_else(|| {
            let good = judge();
            held().insert(key, good);
            good
        })
    }
}

/// The greatest real that a format of reals holds, wherever its point may be.
pub fn end(real: Format) -> f64 {
    match real {
        Format::Scaled { bits } => (scale::most(bits) as f64) * f64::from(-scale::FEWEST).exp2(),
        real => real.most(),
    }
}

/// By which part two formulas for one value may differ in `f64`.
const APART: f64 = 1e-6;

impl Judge<'_> {
    /// Whether roundings do no more to a value or a comparison than allowed.
    pub fn sound(&self, b: &Builder, new: New<'_>, old: NodeId, made: NodeId) -> bool {
        self.judged(b, new, old, made, false)
    }

    /// The same of formulas that hold where roots are of what is not below 0.
    pub fn equal(&self, b: &Builder, new: New<'_>, old: NodeId, made: NodeId) -> bool {
        self.judged(b, new, old, made, true)
    }

    fn judged(
        &self,
        b: &Builder,
        new: New<'_>,
        old: NodeId,
        made: NodeId,
        where_equal: bool,
    ) -> bool {
        let breaks = || inexact(b, made) && !inexact(self.graph, old);
        if self.followed.floors(self.graph, old) && breaks() {
            return false;
        }
        let known = self.followed.of(self.graph, old, self.samples.len());
        let judge = || self.judged_at(&known, (b, new), (old, made), where_equal);
        match Keys::new(b, new, &known.shared).of(made) {
            Some(key) => self.followed.judged((old, where_equal, key), judge),
            None => judge(),
        }
    }

    fn judged_at(
        &self,
        known: &Known,
        (b, new): (&Builder, New<'_>),
        (old, made): (NodeId, NodeId),
        where_equal: bool,
    ) -> bool {
        let Some(first) = self.samples.first() else {
            return false;
        };
        let now = |t: TableId| self.graph.tables.get(t.0 as usize);
        let mut before = Follow::new(self.graph, &now, first);
        let next = |t: TableId| b.table_of(t);
        let mut is = Follow::new(b, &next, first);
        let mut told = 0;
        for (was, sample) in known.at.iter().zip(self.samples) {
            let was = was.get_or_init(|| {
                before.to(sample);
                Was::new(&mut before, old, &known.shared)
            });
            let Some(was) = was else {
                continue;
            };
            // There the value is not needed: its roots are of what is not below 0.
            if where_equal && was.misses_root {
                continue;
            }
            is.to(sample);
            // What both need is the same in both.
            for &(id, value) in &was.shared {
                if let Some(id) = new(id) {
                    is.known.insert(id, value);
                }
            }
            let Some(after) = relative(&mut is, made) else {
                return false;
            };
            told += 1;
            if is.most() > self.end && was.most <= self.end {
                return false;
            }
            let differs = where_equal && !agree(was.value, is.value(made, 0));
            if differs || after > self.allowance * was.relative.max(2.0) {
                return false;
            }
        }
        told > 0
    }
}

/// Whether two values are one but for roundings of `f64`.
fn agree(a: Option<Rounded>, b: Option<Rounded>) -> bool {
    let (Some(a), Some(b)) = (a, b) else {
        return false;
    };
    let size = a.value.abs().max(b.value.abs()).max(1.0);
    (a.value - b.value).abs() <= APART * size
}

/// How much of a value, or of a comparison's difference, roundings may change:
/// in units of the format, as a part of it.
fn relative<N: Nodes>(follow: &mut Follow<'_, N>, id: NodeId) -> Option<f64> {
    let part = |r: Rounded| r.off / r.value.abs().max(1e-300);
    match follow.nodes.node(id) {
        Node::Const(_) => Some(0.0),
        Node::Select { cond, yes, no } => {
            let holds = follow.value(cond, 0)?.value != 0.0;
            relative(follow, if holds { yes } else { no })
        }
        Node::Apply(op, [a, b]) if op.result() == Type::Bool && op.arity() == 2 => {
            let (a, b) = (follow.value(a, 0)?, follow.value(b, 0)?);
            Some(part(Rounded {
                value: a.value - b.value,
                off: a.off + b.off,
            }))
        }
        _ => follow.value(id, 0).map(part),
    }
}
