//! Loops of the scene as FOR loops, which BASIC counts by itself.

use super::Style;
use super::code::Code;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use slowlight_routine::{Op, Value};

/// About how many turns a loop takes, for the weights of names only.
const TURNS: u64 = 2;

/// A carried int that counts the turns of its loop.
struct Counter {
    index: u32,
    first: i32,
    next: NodeId,
    /// Whether no turn needs what it is next for anything else.
    lone: bool,
    /// Whether it, and what it is next, are asked for where the loop is left: there what
    /// counts is past the last turn.
    asked: [bool; 2],
}

/// What counts a loop's turns.
fn counter(plan: &Plan, turns: &Turns) -> Option<Counter> {
    let graph = &plan.graph;
    let of = graph.loops.get(turns.of.0 as usize)?;
    let left = !turns.always(graph);
    // A procedure is written once, and knows one variable of what it reads.
    let calls = [&turns.body, &turns.next, &turns.done]
        .into_iter()
        .any(calls);
    let counts = |(index, (init, next)): (usize, (&NodeId, &NodeId))| {
        let Some(Value::Int(first)) = graph.constant(*init) else {
            return None;
        };
        let Node::Apply(Op::IntAdd, [now, by]) = graph.node(*next) else {
            return None;
        };
        let index = index as u32;
        let own = graph.node(now)
            == Node::Carried {
                of: turns.of,
                index,
            };
        let fits = first.checked_add(of.max as i32).is_some();
        let counts = own && fits && graph.constant(by) == Some(Value::Int(1));
        counts.then(|| {
            let reads = |block: &Block, id| reads(graph, block, id);
            let asked = [now, *next].map(|id| left && reads(&turns.done, id));
            // What is carried on is set at the end.
            let carries = |statement: &&Statement| {
                let own = [Place::Carried, Place::Scratch].map(|place| place(turns.of, index));
                matches!(statement, Statement::Set { place, .. } if own.contains(place))
            };
            let rest = turns.next.iter().filter(|statement| !carries(statement));
            let rest: Block = rest.cloned().collect();
            let lone =
                *next != turns.again && ![&turns.body, &rest].iter().any(|b| reads(b, *next));
            Counter {
                index,
                first,
                next: *next,
                lone,
                asked,
            }
        })
    };
    let mut all = of.init.iter().zip(&of.next).enumerate().filter_map(counts);
    all.find(|counter| !(calls && counter.asked[0]))
}

fn calls(block: &Block) -> bool {
    let mut found = false;
    walk(block, &mut |statement| {
        found |= matches!(statement, Statement::Call(_))
    });
    found
}

/// Whether statements read a value.
fn reads(graph: &Graph, block: &Block, id: NodeId) -> bool {
    let mut found = false;
    walk(block, &mut |statement| {
        found |= match statement {
            Statement::Let(of) => graph.node(*of).inputs().any(|input| input == id),
            Statement::Set { from, .. } => *from == Origin::Node(id),
            Statement::If { cond, .. } => *cond == id,
            Statement::Loop(turns) => turns.again == id,
            Statement::Call(_) => true,
        };
    });
    found
}

impl Code<'_> {
    /// A loop: turns are counted, so that it ends.
    pub fn repeat(&mut self, turns: &Turns) {
        let plan = self.values.plan;
        let Some(of) = plan.graph.loops.get(turns.of.0 as usize) else {
            return;
        };
        let (most, span) = (of.max as i32 - 1, Some(of.span));
        let turn = self.values.names.unique("turn", "%");
        // Its variable where that is asked for where the loop is left, and what sets that and
        // what it is next there.
        let mut kept: Option<(Place, String)> = None;
        let mut keeps = String::new();
        let (first, last) = match (counter(plan, turns), self.values.style) {
            (Some(counter), _) => {
                let place = Place::Carried(turns.of, counter.index);
                let own = self.values.names.home(place).to_owned();
                let [now, next] = counter.asked;
                if now {
                    keeps = format!("{own}={turn}:");
                    kept = Some((place, own));
                }
                if next && counter.lone {
                    let home = self.values.names.home(Place::Node(counter.next));
                    keeps = format!("{keeps}{home}={turn}+1:");
                }
                self.counted.carried.insert((turns.of, counter.index));
                self.counted
                    .nexts
                    .extend(counter.lone.then_some(counter.next));
                self.values.names.rename(place, &turn);
                (counter.first, counter.first + most)
            }
            (None, Style::Listing) => (0, most),
            // Fewer digits for what leaves: it is past the last turn.
            _ => (-most, 0),
        };
        self.block(&turns.start);
        let (leave, end) = (self.labels.next(), self.labels.next());
        self.lines
            .line(format!("FOR {turn}={first} TO {last}"), span);
        self.loops += 1;
        self.often(&turns.body, TURNS);
        self.loops -= 1;
        let ends = !turns.always(&plan.graph);
        if ends {
            // The machine has room for ten loops: one that is left must end as well.
            let fails = self.values.condition(turns.again, false);
            let out = format!(
                "IF {fails} THEN {keeps}{turn}={}:NEXT {turn}:GOTO {leave}",
                last + 1
            );
            self.lines.line(out, span);
        }
        self.block(&turns.next);
        self.lines.line(format!("NEXT {turn}"), span);
        self.block(&turns.otherwise);
        if let Some((place, own)) = &kept {
            self.values.names.rename(*place, own);
        }
        if ends {
            let done = self.apart(&turns.done);
            if !done.is_empty() {
                self.lines.line(format!("GOTO {end}"), span);
            }
            self.lines.place(leave);
            self.lines.append(done);
        }
        self.lines.place(end);
    }
}
