//! Statements: assignments, IF and loops over GOTO.

use super::expression::Expressions;
use super::lines::{Label, Labels, Lines};
use crate::flow::tree::*;
use crate::plan::Plan;
use crate::source::Span;

/// An IF with all it does fits one line up to this length.
const ONE_LINE: usize = 90;

/// Writes blocks of statements.
pub struct Code<'p> {
    pub values: Expressions<'p>,
    pub lines: Lines,
    labels: Labels,
    span: Option<Span>,
}

impl<'p> Code<'p> {
    pub fn new(plan: &'p Plan) -> Code<'p> {
        Code {
            values: Expressions::new(plan),
            lines: Lines::default(),
            labels: Labels::default(),
            span: None,
        }
    }

    /// A statement that comes from no place in the scene.
    pub fn statement(&mut self, text: impl Into<String>) {
        self.lines.statement(text, None);
    }

    /// A line that comes from no place in the scene.
    pub fn line(&mut self, text: impl Into<String>) {
        self.lines.line(text, None);
    }

    pub fn block(&mut self, block: &Block) {
        for statement in block {
            self.one(statement);
        }
    }

    /// A block's lines by themselves.
    fn apart(&mut self, block: &Block) -> Lines {
        let outer = std::mem::take(&mut self.lines);
        self.block(block);
        std::mem::replace(&mut self.lines, outer)
    }

    fn one(&mut self, statement: &Statement) {
        match statement {
            Statement::Let(id) => {
                self.span = Some(self.values.plan.graph.span(*id));
                let text = self.values.compute(*id);
                if !self.values.fold(*id, &text) {
                    let home = self.values.names.home(Place::Node(*id));
                    self.lines
                        .statement(format!("{home}={}", text.text), self.span);
                }
            }
            Statement::Set { place, from } => {
                let text = match *from {
                    Origin::Node(id) => self.values.read(id).text,
                    Origin::Scratch(l, k) => {
                        self.values.names.home(Place::Scratch(l, k)).to_owned()
                    }
                };
                let home = self.values.names.home(*place);
                if home != text {
                    self.lines.statement(format!("{home}={text}"), self.span);
                }
            }
            Statement::If { cond, yes, no } => {
                let holds = self.values.condition(*cond, true);
                let fails = self.values.condition(*cond, false);
                let span = self.span;
                let yes = self.apart(yes);
                let no = self.apart(no);
                self.branch(&holds, &fails, yes, no, span);
            }
            Statement::Loop(turns) => self.repeat(turns),
            Statement::Call(id) => {
                let name = self.values.names.procedure(*id);
                self.lines.statement(format!("PROC{name}"), self.span);
            }
        }
    }

    /// Two ways, on one line if they fit.
    fn branch(&mut self, holds: &str, fails: &str, yes: Lines, no: Lines, span: Option<Span>) {
        if let (Some(a), Some(b)) = (yes.in_one_line(ONE_LINE), no.in_one_line(ONE_LINE)) {
            let text = match (a.as_str(), b.as_str()) {
                (a, "") => format!("IF {holds} THEN {a}"),
                ("", b) => format!("IF {fails} THEN {b}"),
                (a, b) => format!("IF {holds} THEN {a} ELSE {b}"),
            };
            if a.is_empty() && b.is_empty() {
                return;
            }
            if text.len() <= ONE_LINE + 40 {
                self.lines.line(text, span);
                return;
            }
        }
        let end = self.labels.next();
        if self.values.plan.is_outlined() && self.jump_behind(holds, fails, &yes, &no, end, span) {
            self.lines.append(if yes.in_one_line(ONE_LINE).is_some() {
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
            self.lines.line(format!("IF {fails} THEN {other}"), span);
            self.lines.append(yes);
            self.lines.line(format!("GOTO {end}"), span);
            self.lines.place(other);
            self.lines.append(no);
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
                let way = way.in_one_line(ONE_LINE)?;
                Some(format!("IF {test} THEN {way}:GOTO {end}"))
            });
        if let Some(text) = &short {
            self.lines.line(text.clone(), span);
        }
        short.is_some()
    }

    /// A loop: turns are counted, so that it ends.
    fn repeat(&mut self, turns: &Turns) {
        self.block(&turns.start);
        let plan = self.values.plan;
        let (max, span) = plan
            .graph
            .loops
            .get(turns.of.0 as usize)
            .map_or((1, None), |l| (l.max, Some(l.span)));
        let turn = self.values.names.unique("turn", "%");
        let (top, leave, end) = (self.labels.next(), self.labels.next(), self.labels.next());
        self.lines.statement(format!("{turn}=0"), span);
        self.lines.place(top);
        self.block(&turns.body);
        let fails = self.values.condition(turns.again, false);
        self.lines.line(format!("IF {fails} THEN {leave}"), span);
        self.block(&turns.next);
        self.lines.statement(format!("{turn}={turn}+1"), span);
        self.lines.line(format!("IF {turn}<{max} THEN {top}"), span);
        self.block(&turns.otherwise);
        let done = self.apart(&turns.done);
        if !done.is_empty() {
            self.lines.line(format!("GOTO {end}"), span);
        }
        self.lines.place(leave);
        self.lines.append(done);
        self.lines.place(end);
    }
}
