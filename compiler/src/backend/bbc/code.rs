//! Statements: assignments, IF and loops over GOTO.

use super::Style;
use super::expression::Expressions;
use super::lines::{Label, Labels, Lines};
use super::text::Text;
use crate::analysis::region::Fact;
use crate::ir::graph::{LoopId, Node, NodeId};
use crate::ir::often;
use crate::ir::tree::*;
use crate::plan::Plan;
use crate::source::Span;
use rustc_hash::FxHashSet;
use std::collections::BTreeMap;

mod arc;
mod extreme;

/// About how often an arm is taken, for the weights of names only.
const ARM: u64 = 2;

/// An assignment with a test and both its ways stands on one line.
const TWO_WAYS: usize = 225;

/// Writes blocks of statements.
pub struct Code<'p> {
    pub values: Expressions<'p>,
    pub lines: Lines,
    /// What is rarely carried out, and stands behind the rest.
    pub rare: Lines,
    /// Ways of choices that few pixels take, between two labels each.
    pub seldom: Vec<(Label, Label)>,
    /// Which way that is ([`Plan::seldom`]).
    ways: BTreeMap<NodeId, bool>,
    /// Loops of the scene around what is written.
    pub loops: u32,
    /// FOR loops that are left by a jump, still open: the NEXT of one around them, which says
    /// its name, ends them as well.
    pub open: u32,
    /// Whether there is one: what is written is a pixel's.
    pub closes: bool,
    /// Loops by GOTO around what is written, which end none.
    pub gotos: u32,
    /// What loops count by themselves.
    pub counted: Counted,
    pub labels: Labels,
    /// What ends a run of columns, where its block is being written.
    pub ends: Option<Ends>,
    /// The same for the procedures that it calls.
    pub ends_called: Option<Ends>,
    /// What is known of a condition where a pixel is being written.
    pub known: Option<Fact>,
    /// Ramps that are stepped where they are read only.
    pub late: Option<Late>,
    /// Where what surrounds the scene's statements comes from: nowhere, or its `draw`.
    pub frame: Option<Span>,
    span: Option<Span>,
}

impl<'p> Code<'p> {
    pub fn new(plan: &'p Plan) -> Code<'p> {
        Code {
            values: Expressions::new(plan),
            lines: Lines::default(),
            rare: Lines::default(),
            seldom: Vec::new(),
            ways: match plan.toot {
                true => BTreeMap::new(),
                false => plan.seldom(),
            },
            loops: 0,
            open: 0,
            closes: false,
            gotos: 0,
            counted: Counted::default(),
            labels: Labels::default(),
            ends: None,
            ends_called: None,
            known: None,
            late: None,
            frame: None,
            span: None,
        }
    }

    /// Where in the scene what is being written comes from.
    pub fn span(&self) -> Option<Span> {
        self.span
    }

    /// A statement that no value of the scene comes from.
    pub fn statement(&mut self, text: impl Into<String>) {
        self.lines.statement(text, self.frame);
    }

    /// The same; a test takes the rest of its line with it.
    pub fn statement_or_test(&mut self, text: &str) {
        match text.starts_with("IF ") {
            true => self.line(text),
            false => self.statement(text),
        }
    }

    /// A line that no value of the scene comes from.
    pub fn line(&mut self, text: impl Into<String>) {
        self.lines.line(text, self.frame);
    }

    /// A block's lines by themselves.
    pub fn apart(&mut self, block: &Block) -> Lines {
        let weight = (self.lines.weight / ARM).max(1);
        let outer = std::mem::replace(&mut self.lines, Lines::of_weight(weight));
        self.block(block);
        std::mem::replace(&mut self.lines, outer)
    }

    /// A block that is carried out `times` as often as what is around it.
    pub fn often(&mut self, block: &Block, times: u64) {
        let weight = self.lines.weight;
        self.lines.weight = weight.saturating_mul(times);
        self.block(block);
        self.lines.weight = weight;
    }

    /// A way as statements for the line of its test, if it fits.
    fn on_one_line(&self, way: &Lines) -> Option<String> {
        let text = way.in_one_line()?;
        (self.values.length(&text) <= self.one_line()).then_some(text)
    }

    /// How long an IF with all it does may be to stand on one line: as long as
    /// it reads well, or as the machine takes it.
    fn one_line(&self) -> usize {
        match self.values.style {
            Style::Listing => 90,
            _ => 190,
        }
    }

    pub fn one(&mut self, statement: &Statement) {
        // In listings, remarks go by what is computed alone.
        if self.values.style != Style::Listing {
            let plan = self.values.plan;
            self.span = Some(statement.span(&plan.graph, &plan.tree));
        }
        match statement {
            Statement::Let(id) => self.assignment(*id, true),
            Statement::Set { place, .. } if self.counted.sets(*place) => {}
            Statement::Set { place, from } => {
                let text = match *from {
                    Origin::Node(id) => self.values.read(id),
                    Origin::Scratch(l, k) => {
                        Text::operand(self.values.names.home(Place::Scratch(l, k)))
                    }
                };
                let home = self.goal(*place);
                self.assign(&home, &text);
            }
            Statement::If { cond, yes, no } if self.known.is_some_and(|(of, _)| of == *cond) => {
                self.block(match self.known {
                    Some((_, false)) => no,
                    _ => yes,
                });
            }
            Statement::If { cond, yes, no } => {
                let holds = self.values.condition(*cond, true);
                let fails = self.values.condition(*cond, false);
                let span = self.span;
                let loops = often::loops(yes) != often::loops(no);
                let yes = self.apart(yes);
                let no = self.apart(no);
                let (yes, no) = match self.ways.get(cond) {
                    Some(true) if loops => (self.seldom(yes), no),
                    Some(false) if loops => (yes, self.seldom(no)),
                    _ => (yes, no),
                };
                self.branch(&holds, &fails, yes, no, span);
            }
            Statement::Loop(turns) => self.repeat(turns),
            Statement::Call(id) => {
                let name = self.values.names.procedure(*id);
                self.lines.statement(format!("PROC{name}"), self.span);
            }
        }
    }

    /// What an assignment to a place is to: its variable, or an entry of its array.
    fn goal(&self, place: Place) -> String {
        let names = &self.values.names;
        match place {
            Place::Node(id) if self.values.plan.is_tabulated(id) => {
                format!("{}(X%)", names.column(id))
            }
            _ => names.home(place).to_owned(),
        }
    }

    /// Computes a node. `fold`: it may be written where it is read.
    pub fn assignment(&mut self, id: NodeId, fold: bool) {
        if self.counted.nexts.contains(&id) {
            return;
        }
        self.span = Some(self.values.plan.graph.span(id));
        self.end_run(id);
        if let Node::Stepped { step, .. } = self.values.plan.graph.node(id) {
            return self.add_step(id, step);
        }
        if self.extreme(id) || self.arc(id) {
            return;
        }
        let text = self.values.compute(id);
        self.assign_before();
        if !(fold && self.values.fold(id, &text)) {
            let home = self.values.names.home(Place::Node(id)).to_owned();
            self.assign(&home, &text);
        }
    }

    /// An assignment; of two ways to compute the value, tests choose.
    pub fn assign(&mut self, home: &str, text: &Text) {
        if home == text.text {
            return;
        }
        let slow = format!("{home}={}", text.text);
        let Some(fast) = &text.fast else {
            self.lines.statement(slow, self.span);
            return;
        };
        let tests = fast.tests.join(" AND ");
        let otherwise = match fast.otherwise {
            Some(value) => format!("{home}={value}"),
            None => slow.clone(),
        };
        let both = format!("IF {tests} THEN {home}={} ELSE {otherwise}", fast.text);
        if self.values.length(&both) <= TWO_WAYS {
            self.lines.line(both, self.span);
        } else {
            self.lines.statement(slow, self.span);
        }
    }

    /// Assigns what must be variables for what was computed last.
    pub fn assign_before(&mut self) {
        for (home, text) in std::mem::take(&mut self.values.before) {
            self.assign(&home, &text);
        }
    }

    /// A way that is seldom taken, between labels: it is moved out of the others' way.
    fn seldom(&mut self, way: Lines) -> Lines {
        let (from, to) = (self.labels.next(), self.labels.next());
        self.seldom.push((from, to));
        let mut lines = Lines::of_weight(way.weight);
        lines.place(from);
        lines.append(way);
        lines.place(to);
        lines
    }

    /// Two ways, on one line if they fit.
    fn branch(&mut self, holds: &str, fails: &str, yes: Lines, no: Lines, span: Option<Span>) {
        if let (Some(a), Some(b)) = (self.on_one_line(&yes), self.on_one_line(&no)) {
            let text = match (a.as_str(), b.as_str()) {
                (a, "") => format!("IF {holds} THEN {a}"),
                ("", b) => format!("IF {fails} THEN {b}"),
                (a, b) => format!("IF {holds} THEN {a} ELSE {b}"),
            };
            if a.is_empty() && b.is_empty() {
                return;
            }
            if self.values.length(&text) <= self.one_line() + 30 {
                self.lines.line(text, span);
                return;
            }
        }
        let end = self.labels.next();
        let short = self.values.style != Style::Listing;
        if short && self.jump_behind(holds, fails, &yes, &no, end, span) {
            self.lines.append(if self.on_one_line(&yes).is_some() {
                no
            } else {
                yes
            });
            self.lines.place(end);
            return;
        }
        if yes.is_empty() {
            self.lines.line(format!("IF {holds} THEN {end}"), span);
            self.lines.append(no);
        } else if no.is_empty() {
            self.lines.line(format!("IF {fails} THEN {end}"), span);
            self.lines.append(yes);
        } else {
            let other = self.labels.next();
            // Either way jumps once; the shorter test is the quicker one.
            let swaps = short && fails.len() > holds.len() + 1;
            let (test, first, second) = match swaps {
                true => (holds, no, yes),
                false => (fails, yes, no),
            };
            self.lines.line(format!("IF {test} THEN {other}"), span);
            self.lines.append(first);
            self.lines.line(format!("GOTO {end}"), span);
            self.lines.place(other);
            self.lines.append(second);
        }
        self.lines.place(end);
    }

    /// Where memory is shortest: a way that fits the line of its test stands
    /// there with a jump behind it, if both ways do something.
    fn jump_behind(
        &mut self,
        holds: &str,
        fails: &str,
        yes: &Lines,
        no: &Lines,
        end: Label,
        span: Option<Span>,
    ) -> bool {
        if yes.is_empty() || no.is_empty() {
            return false;
        }
        let short = [(holds, yes), (fails, no)]
            .into_iter()
            .find_map(|(test, way)| {
                let way = self.on_one_line(way)?;
                Some(format!("IF {test} THEN {way}:GOTO {end}"))
            });
        if let Some(text) = &short {
            self.lines.line(text.clone(), span);
        }
        short.is_some()
    }
}

/// What loops count by themselves: values that need no statement.
#[derive(Default)]
pub struct Counted {
    pub carried: FxHashSet<(LoopId, u32)>,
    /// One more than those, where that is what they carry on and no more.
    pub nexts: FxHashSet<NodeId>,
}

impl Counted {
    /// Whether the loop itself sets a place.
    pub fn sets(&self, place: Place) -> bool {
        match place {
            Place::Carried(of, index) | Place::Scratch(of, index) => {
                self.carried.contains(&(of, index))
            }
            Place::Node(_) => false,
        }
    }
}

/// Ramps that only runs of two inks read ([`crate::schedule::constant_runs::Inks::Either`]): they are stepped
/// there, and before that over all columns that were passed since.
pub struct Late {
    pub(super) ramps: Vec<(NodeId, NodeId)>,
    /// The variable of where they stand: a column, or its byte.
    pub(super) at: String,
}

/// What the comparisons of a segment tell.
pub struct Ends {
    pub(super) end: String,
    pub(super) bounds: FxHashSet<NodeId>,
}
