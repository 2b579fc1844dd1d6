//! Loops of the scene as FOR loops, which BASIC counts by itself.

use super::Style;
use super::code::Code;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use crate::source::Span;
use slowlight_routine::{Op, Value};

/// About how many turns a loop takes, for the weights of names only.
const TURNS: u64 = 2;

/// How many loops may be left open.
const OPEN: u32 = 5;

/// What makes the next turn ready is written behind a test up to this length.
const NEXT: usize = 200;

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
        let fits = of.max < i32::MAX as u32 && first.checked_add(of.max as i32).is_some();
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
        let (most, span) = (of.max.min(i32::MAX as u32) as i32 - 1, Some(of.span));
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
            (None, Style::Toot) => (1, most + 1),
            // Fewer digits for what leaves: it is past the last turn.
            _ => (-most, 0),
        };
        self.block(&turns.start);
        if self.values.style == Style::Toot && of.max == u32::MAX {
            return self.until_left(turns, span);
        }
        let (leave, end) = (self.labels.next(), self.labels.next());
        self.lines
            .line(format!("FOR {turn}={first} TO {last}"), span);
        self.loops += 1;
        let open = self.open;
        self.often(&turns.body, TURNS);
        self.loops -= 1;
        let ends = !turns.always(&plan.graph);
        if ends {
            // The machine has room for ten loops: one that is left must end as well.
            let fails = self.values.condition(turns.again, false);
            let closed = format!("{turn}={}:NEXT {turn}:", last + 1);
            let closed = match self.may_stay_open() {
                true => "",
                false => closed.as_str(),
            };
            let out = match (keeps.as_str(), closed) {
                ("", "") => format!("IF {fails} THEN {leave}"),
                _ => format!("IF {fails} THEN {keeps}{closed}GOTO {leave}"),
            };
            self.lines.line(out, span);
        }
        self.block(&turns.next);
        match self.open > open || self.values.style != Style::Toot {
            true => self.lines.line(format!("NEXT {turn}"), span),
            false => self.lines.line("NEXT", span),
        }
        if ends && self.may_stay_open() {
            self.open += 1;
        }
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

    /// Whether a FOR loop that is left may stay open: what is around it ends it, and there is
    /// room for ten.
    fn may_stay_open(&self) -> bool {
        let alone = self.closes && self.gotos == 0 && self.values.plan.tree.subroutines.is_empty();
        self.values.style == Style::Toot && alone && self.open < OPEN
    }

    /// A loop that never comes to its limit, whose first turn is made ready.
    fn until_left(&mut self, turns: &Turns, span: Option<Span>) {
        let top = self.labels.next();
        self.lines.place(top);
        self.gotos += 1;
        self.often(&turns.body, TURNS);
        if turns.always(&self.values.plan.graph) {
            self.block(&turns.next);
            self.gotos -= 1;
            self.lines.line(format!("GOTO {top}"), span);
            return;
        }
        let holds = self.values.condition(turns.again, true);
        let fails = self.values.condition(turns.again, false);
        let next = self.apart(&turns.next);
        self.gotos -= 1;
        match next.in_one_line().filter(|text| text.len() < NEXT) {
            Some(text) if text.is_empty() => {
                self.lines.line(format!("IF {holds} THEN {top}"), span);
            }
            Some(text) => {
                let out = format!("IF {holds} THEN {text}:GOTO {top}");
                self.lines.line(out, span);
            }
            None => {
                let leave = self.labels.next();
                self.lines.line(format!("IF {fails} THEN {leave}"), span);
                self.lines.append(next);
                self.lines.line(format!("GOTO {top}"), span);
                self.lines.place(leave);
            }
        }
        self.block(&turns.done);
    }
}
