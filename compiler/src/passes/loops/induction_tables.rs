//! Functions of induction variables, and of ints of few values, as constant tables.
//!
//! A loop that counts often makes numbers of its counter: where the k-th ball stands, the
//! corners of the k-th face. All turns of all pixels make the same few. Here what hangs on one
//! or two counters alone, and takes more than to be looked up, is worked out beforehand, for
//! each turn that the loop may take, and becomes a [`Table`] that is read by the counter. An int
//! that is rounded and stays within few values, whatever the pixel, is like a counter in that.
//! (An induction variable as in Aho, Lam, Sethi and Ullman, Compilers, 2nd edition, 9.1.8.)

use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use slowlight_routine::{Op, Type, Value};

/// How many entries a table may have.
const MOST: usize = 256;

/// How many values an int may have that is no counter.
const FEW: f64 = 64.0;

/// What a table's entry at a counter weighs ([`weight`]).
pub const ENTRY: u32 = 2;

/// The graph with such values in tables that weigh so much at least; nothing where it has none.
pub fn induction_tables(graph: &Graph, worth: u32) -> Option<Graph> {
    Tables::of(graph)?.tabled(worth)
}

/// The same of what hangs on ints that are rounded and stay within few values.
/// Where memory for tables is cheap, so is the column's number, and what a remainder leaves.
pub fn tables_of_ints(
    graph: &Graph,
    ranges: &Ranges,
    (worth, cheap): (u32, bool),
) -> Option<Graph> {
    let mut tables = Tables {
        graph,
        counters: graph
            .ids()
            .filter_map(|id| few(graph, ranges, id, cheap))
            .collect(),
        known: Vec::new(),
    };
    tables.find();
    tables.tabled(worth)
}

/// The loops whose turns a counter alone decides on, and how many of these go on.
pub(crate) fn counted(graph: &Graph) -> Vec<(LoopId, usize)> {
    let tables = Tables::of(graph);
    let counters = tables.iter().flat_map(|tables| &tables.counters);
    counters
        .filter_map(|counter| Some((counter.of?, counter.going?)))
        .collect()
}

/// Of each value whether it hangs on loops' counters alone, and not on none; nothing where no loop
/// counts.
pub(crate) fn on_counters(graph: &Graph) -> Option<Vec<bool>> {
    let tables = Tables::of(graph)?;
    let hangs = |known: &Option<Known>| known.as_ref().is_some_and(|of| of.by[0].is_some());
    Some(tables.known.iter().map(hangs).collect())
}

/// A carried int that each turn moves on by 1 or back by 1, from a constant; or an int that
/// stays within as many values.
struct Counter {
    of: Option<LoopId>,
    node: NodeId,
    first: i32,
    step: i32,
    /// How many turns there are at most, the last included.
    turns: usize,
    /// How many of these go on, where the counter alone decides.
    going: Option<usize>,
}

impl Counter {
    fn at(&self, turn: usize) -> Value {
        Value::Int(self.first + self.step * turn as i32)
    }
}

/// What hangs on counters alone, for all their turns.
struct Known {
    /// Which counters: of a table's columns, and of its rows.
    by: [Option<usize>; 2],
    /// Row by row.
    values: Vec<Value>,
}

struct Tables<'g> {
    graph: &'g Graph,
    counters: Vec<Counter>,
    known: Vec<Option<Known>>,
}

impl<'g> Tables<'g> {
    fn of(graph: &'g Graph) -> Option<Tables<'g>> {
        let found = |id: NodeId| counter(graph, id);
        let mut tables = Tables {
            graph,
            counters: graph.ids().filter_map(found).collect(),
            known: Vec::new(),
        };
        tables.find();
        for at in 0..tables.counters.len() {
            let counter = &tables.counters[at];
            let Some(of) = counter.of else { continue };
            let again = graph.loops[of.0 as usize].again;
            let known = tables.known[again.0 as usize].as_ref();
            let own = known.filter(|known| known.by == [Some(at), None]);
            let goes_on = |own: &Known| own.values.iter().take_while(|on| on.truth()).count();
            let going = own.map(goes_on);
            let counter = &mut tables.counters[at];
            counter.turns = going.map_or(counter.turns, |on| counter.turns.min(on + 1));
            counter.going = going;
        }
        tables.counters.retain(|counter| counter.turns <= MOST);
        tables.find();
        (!tables.counters.is_empty()).then_some(tables)
    }

    fn tabled(&self, worth: u32) -> Option<Graph> {
        let chosen = self.chosen(worth);
        chosen.contains(&true).then(|| {
            rebuild_old(self.graph, &mut |builder, made, id, span| {
                let read = || self.read(builder, made, id, span);
                chosen[id.0 as usize].then(read).flatten()
            })
        })
    }

    /// Works out what hangs on counters alone.
    fn find(&mut self) {
        self.known = Vec::with_capacity(self.graph.nodes.len());
        for id in self.graph.ids() {
            let known = self.worked_out(id);
            self.known.push(known);
        }
    }

    fn worked_out(&self, id: NodeId) -> Option<Known> {
        if let Ok(at) = self.counters.binary_search_by_key(&id, |c| c.node) {
            let counter = &self.counters[at];
            let values = (0..counter.turns).map(|turn| counter.at(turn)).collect();
            return Some(Known {
                by: [Some(at), None],
                values,
            });
        }
        let node = self.graph.node(id);
        match node {
            Node::Const(constant) => {
                let (by, values) = ([None; 2], vec![constant.value()]);
                return Some(Known { by, values });
            }
            Node::Apply(..) | Node::Select { .. } | Node::Lookup { .. } => {}
            _ => return None,
        }
        let mut operands = Vec::new();
        for id in node.operands() {
            operands.push(self.known[id.0 as usize].as_ref()?);
        }
        let by = together(&operands)?;
        let [columns, rows] = by.map(|at| at.map_or(1, |at| self.counters[at].turns));
        if columns * rows > MOST + 1 {
            return None;
        }
        let mut values = Vec::with_capacity(columns * rows);
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |c| (row, c))) {
            let of = |known: &&Known| self.entry(known, by, column, row);
            let of: Vec<Value> = operands.iter().map(of).collect();
            values.push(match node {
                Node::Apply(op, _) => op.eval(&of),
                Node::Select { .. } => of[if of[0].truth() { 1 } else { 2 }],
                Node::Lookup { table, .. } => {
                    self.graph.tables[table.0 as usize].at(of[0].int(), of[1].int())
                }
                _ => return None,
            });
        }
        Some(Known { by, values })
    }

    /// The value where the counters of `by` are at a column and a row.
    fn entry(&self, known: &Known, by: [Option<usize>; 2], column: usize, row: usize) -> Value {
        let turn = |counter: Option<usize>| match counter {
            None => 0,
            some if some == by[0] => column,
            _ => row,
        };
        let columns = known.by[0].map_or(1, |at| self.counters[at].turns);
        known.values[turn(known.by[1]) * columns + turn(known.by[0])]
    }

    /// Which values are read from tables: the last ones on each way that are worth it, but not
    /// what is little more than another one of these.
    fn chosen(&self, worth: u32) -> Vec<bool> {
        let mut chosen = vec![false; self.graph.nodes.len()];
        let all = self.weights(2 * worth, &chosen);
        let mut seen = chosen.clone();
        let mut todo: Vec<NodeId> = self.graph.outputs().collect();
        while let Some(id) = todo.pop() {
            let at = id.0 as usize;
            if std::mem::replace(&mut seen[at], true) {
                continue;
            }
            chosen[at] = all[at] >= self.least(id, worth) && self.graph.ty(id) != Type::Bool;
            if !chosen[at] {
                todo.extend(self.graph.refers(id));
            }
        }
        let beside = self.weights(2 * worth, &chosen);
        for (id, weight) in self.graph.ids().zip(beside) {
            chosen[id.0 as usize] &= weight >= self.least(id, worth);
        }
        chosen
    }

    /// What a value must weigh, where one that hangs on one int must weigh so much. Where
    /// nothing counts, a row and a column are joined by a product.
    fn least(&self, id: NodeId, worth: u32) -> u32 {
        let known = self.known[id.0 as usize].as_ref();
        let by = known.map_or([None; 2], |known| known.by);
        let counters = by.iter().flatten().map(|&at| &self.counters[at]);
        // What was looked up is a number of an entry as it is.
        let is_index = |c: &Counter| matches!(self.graph.node(c.node), Node::Lookup { .. });
        if counters.clone().all(|c| c.first == 0 && is_index(c)) {
            return worth / 2;
        }
        let free = counters.filter(|c| c.of.is_none()).count();
        worth * (free.max(1) as u32)
    }

    /// What each value weighs that hangs on counters, up to `most`, where some are in tables.
    fn weights(&self, most: u32, tabled: &[bool]) -> Vec<u32> {
        let mut weights: Vec<u32> = Vec::with_capacity(self.graph.nodes.len());
        for id in self.graph.ids() {
            let node = self.graph.node(id);
            let of = |id: NodeId| match tabled[id.0 as usize] {
                true => ENTRY,
                false => weights[id.0 as usize],
            };
            let all = weight(node) + node.operands().map(of).sum::<u32>();
            let varies = |known: &Known| known.by[0].is_some();
            let known = self.known[id.0 as usize].as_ref();
            weights.push(if known.is_some_and(varies) {
                all.min(most)
            } else {
                0
            });
        }
        weights
    }

    /// The entry that stands for a value.
    fn read(
        &self,
        builder: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        span: Span,
    ) -> Option<NodeId> {
        let known = self.known[id.0 as usize].as_ref()?;
        let mut index = [builder.constant(Value::Int(0), span); 2];
        for (index, by) in index.iter_mut().zip(known.by) {
            let Some(counter) = by.map(|at| &self.counters[at]) else {
                continue;
            };
            let now = made[counter.node.0 as usize]?;
            let first = builder.constant(Value::Int(counter.first), span);
            *index = match (counter.first, counter.step) {
                (0, 1) => now,
                (_, 1) => builder.apply(Op::IntSub, &[now, first], span),
                _ => builder.apply(Op::IntSub, &[first, now], span),
            };
        }
        let table = builder.table(self.table(known, id));
        Some(builder.lookup(table, index[0], index[1], span))
    }

    /// A value for each turn.
    fn table(&self, known: &Known, id: NodeId) -> Table {
        let turns = |by: Option<usize>| by.map_or(1, |at| self.counters[at].turns as u32);
        let [width, height] = known.by.map(turns);
        let name = self.graph.names.get(&id);
        Table {
            name: name.map_or_else(|| "by_turn".to_owned(), |name| name.to_string()),
            width,
            height,
            ty: self.graph.ty(id),
            entries: known.values.iter().copied().map(Constant::new).collect(),
            seed: Vec::new(),
        }
    }
}

/// The counter that a node is, if it is one.
fn counter(graph: &Graph, id: NodeId) -> Option<Counter> {
    let Node::Carried { of, index } = graph.node(id) else {
        return None;
    };
    let turns = &graph.loops[of.0 as usize];
    let int = |id: NodeId| match graph.constant(id) {
        Some(Value::Int(int)) => Some(int),
        _ => None,
    };
    let first = int(turns.init[index as usize])?;
    let step = match graph.node(turns.next[index as usize]) {
        Node::Apply(Op::IntAdd, [now, by]) if now == id => int(by)?,
        Node::Apply(Op::IntAdd, [by, now]) if now == id => int(by)?,
        Node::Apply(Op::IntSub, [now, by]) if now == id => int(by)?.checked_neg()?,
        _ => return None,
    };
    // One more than a table may have: whether the loop ends before is seen from that.
    let most = (turns.max as usize).min(MOST + 1);
    let fits = step.abs() == 1 && first.checked_add(step * most as i32).is_some();
    fits.then_some(Counter {
        of: Some(of),
        node: id,
        first,
        step,
        turns: most,
        going: None,
    })
}

/// The int that a node rounds to, or is looked up, where it stays within few values.
fn few(graph: &Graph, ranges: &Ranges, id: NodeId, cheap: bool) -> Option<Counter> {
    let most = match graph.node(id) {
        Node::Axis(Axis::X) | Node::Apply(Op::IntMod, _) if cheap => MOST as f64,
        Node::Apply(Op::Round | Op::Floor, _) => FEW,
        Node::Lookup { .. } if graph.ty(id) == Type::Int => MOST as f64,
        _ => return None,
    };
    let range = ranges.result[id.0 as usize];
    let (lo, values) = (range.lo.ceil(), range.hi.floor() - range.lo.ceil() + 1.0);
    (1.0..=most).contains(&values).then_some(Counter {
        of: None,
        node: id,
        first: lo as i32,
        step: 1,
        turns: values as usize,
        going: None,
    })
}

/// The counters that operands hang on, if they are two at most.
fn together(operands: &[&Known]) -> Option<[Option<usize>; 2]> {
    let mut all: Vec<usize> = operands.iter().flat_map(|k| k.by).flatten().collect();
    all.sort_unstable();
    all.dedup();
    match all[..] {
        [] => Some([None; 2]),
        [one] => Some([Some(one), None]),
        [one, two] => Some([Some(one), Some(two)]),
        _ => None,
    }
}

/// What a node takes, roughly the same on every machine.
fn weight(node: Node) -> u32 {
    match node {
        Node::Lookup { .. } => ENTRY,
        Node::Select { .. } => 1,
        Node::Apply(op, _) => match op {
            Op::IntMul | Op::IntDiv | Op::IntMod => 3,
            Op::ToReal | Op::Add | Op::Sub | Op::Min | Op::Max => 2,
            // Inks are made of these: how they come about is what other passes ask for.
            _ if op.args().first() != Some(&Type::Real) => 0,
            Op::Neg | Op::Abs | Op::Less | Op::LessEqual | Op::Equal => 1,
            Op::Sin | Op::Cos | Op::Tan | Op::Asin | Op::Acos | Op::Atan2 => 8,
            Op::Exp | Op::Log | Op::Pow => 8,
            _ => 4,
        },
        _ => 0,
    }
}

#[cfg(test)]
#[path = "induction_tables_tests.rs"]
mod tests;
