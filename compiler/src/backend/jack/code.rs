//! Statements and expressions.

use super::error_names::Spread;
use super::expression::{Expression, constant, int};
use super::kept_names::Refined;
use super::names::Names;
use super::object::Object;
use super::{Line, Text};
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use rustc_hash::FxHashMap;
use slowlight_routine::{Form, Format, Routine, Value};
use slowlight_runtime_jack::{SUM, TERM};
use std::collections::{BTreeMap, BTreeSet};

/// Lines that a subroutine holds at most before it is divided.
const LONG: usize = 60;
/// Characters of an expression that is still written where it is read.
const WIDE: usize = 56;

/// A method that holds a part of the program.
pub(super) struct Method {
    /// What it is, for the comment over it; empty where its name says it.
    pub about: String,
    pub name: String,
    pub lines: Vec<Line>,
}

/// The program under way.
pub(super) struct Code<'p> {
    pub plan: &'p Plan,
    pub names: Names,
    pub object: Object,
    /// What pixels send to later ones.
    pub spread: Option<Spread>,
    /// What they leave.
    pub refined: Option<Refined>,
    /// The parts of the runtime that are needed, beside those of the routines.
    pub needs: BTreeSet<&'static str>,
    /// The fields of homes that are written, by format.
    pub written: Vec<(String, Format)>,
    /// Their names, to find them quickly.
    pub known: BTreeSet<String>,
    /// Signs that another value's variable has.
    pub same_signs: BTreeMap<NodeId, String>,
    /// What became a method of its own.
    pub methods: Vec<Method>,
    /// Values that are written where they are read.
    pub folded: FxHashMap<NodeId, Expression>,
    /// A variable for exchanges of objects, where there are such.
    pub spare: Option<String>,
    text: Text,
}

impl<'p> Code<'p> {
    pub fn new(plan: &'p Plan) -> Code<'p> {
        let mut names = Names::new(plan);
        Code {
            plan,
            spread: Spread::new(plan, &mut names),
            refined: Refined::new(plan, &mut names),
            names,
            object: Object::default(),
            needs: BTreeSet::new(),
            written: Vec::new(),
            known: BTreeSet::new(),
            same_signs: BTreeMap::new(),
            methods: Vec::new(),
            folded: FxHashMap::default(),
            spare: None,
            text: Text::default(),
        }
    }

    /// The body of a subroutine that runs a block.
    pub fn body(&mut self, block: &Block) -> Vec<Line> {
        self.apart(|code| code.block(block))
    }

    /// Lines divided into methods where they are too many.
    pub fn divided(&mut self, lines: Vec<Line>, name: &str) -> Vec<Line> {
        if lines.len() <= LONG {
            return lines;
        }
        let mut calls = Vec::new();
        for part in lines.chunks(LONG) {
            calls.push(self.outlined(part.to_vec(), name));
        }
        calls
    }

    /// Makes a method of each subroutine.
    pub fn subroutines(&mut self) {
        let plan = self.plan;
        for (k, subroutine) in plan.tree.subroutines.iter().enumerate() {
            let id = SubroutineId(k as u32);
            let name = self.names.subroutine(id);
            let lines = self.body(&subroutine.body);
            let calls = plan.tree.calls(id);
            let about = format!("{}, called from {calls} places.", subroutine.label());
            self.methods.push(Method { about, name, lines });
        }
    }

    /// Makes a method of lines; answers the line that calls it.
    pub fn outlined(&mut self, lines: Vec<Line>, name: &str) -> Line {
        let span = lines.iter().find_map(|line| line.span);
        let name = self.names.fresh(&format!("{name}Part"));
        let call = format!("do {name}();");
        let about = String::new();
        self.methods.push(Method { about, name, lines });
        Line {
            depth: 0,
            text: call,
            span,
        }
    }

    /// What `write` writes, apart from the text so far.
    fn apart(&mut self, write: impl FnOnce(&mut Self)) -> Vec<Line> {
        let fresh = Text {
            span: self.text.span,
            ..Text::default()
        };
        let outer = std::mem::replace(&mut self.text, fresh);
        write(self);
        std::mem::replace(&mut self.text, outer).lines
    }

    fn block(&mut self, block: &Block) {
        block.iter().for_each(|statement| self.statement(statement));
    }

    fn statement(&mut self, statement: &Statement) {
        self.text.span = Some(statement.span(&self.plan.graph, &self.plan.tree));
        match statement {
            Statement::Let(id) => self.compute(*id),
            Statement::Set { place, from } => {
                self.set(*place, *from);
                self.keep_column(*place);
            }
            Statement::If { cond, yes, no } => {
                let cond = self.read(*cond);
                // An arm of copies that are none is empty.
                let [yes, no] = [yes, no].map(|arm| self.body(arm));
                if yes.is_empty() && no.is_empty() {
                    return;
                }
                self.text.open(format!("if ({}) {{", cond.text));
                self.text.append(yes);
                if !no.is_empty() {
                    self.text.close("}");
                    self.text.open("else {");
                    self.text.append(no);
                }
                self.text.close("}");
            }
            Statement::Loop(turns) => self.repeat(turns),
            Statement::Call(id) => {
                let name = self.names.subroutine(*id);
                self.text.line(format!("do {name}();"));
            }
        }
    }

    /// A loop: the counter reaches the greatest number of turns also where the
    /// loop ends by itself. It may pass 32767; being equal does not mind.
    fn repeat(&mut self, turns: &Turns) {
        let counter = self.names.turns(turns.of);
        let greatest = self
            .plan
            .graph
            .loops
            .get(turns.of.0 as usize)
            .map_or(1, |l| l.max);
        let most = int(i32::from(greatest as u16 as i16)).at(TERM);
        self.block(&turns.start);
        self.text.line(format!("let {counter} = 0;"));
        self.text.open(match u16::try_from(greatest) {
            Ok(..=0x7FFF) => format!("while ({counter} < {most}) {{"),
            _ => format!("while (~({counter} = {most})) {{"),
        });
        self.block(&turns.body);
        let ends = !turns.always(&self.plan.graph);
        if ends {
            let again = self.read(turns.again);
            self.text.open(format!("if ({}) {{", again.text));
        }
        self.block(&turns.next);
        self.text.line(format!("let {counter} = {counter} + 1;"));
        let otherwise = self.body(&turns.otherwise);
        if !otherwise.is_empty() {
            self.text.open(format!("if ({counter} = {most}) {{"));
            self.text.append(otherwise);
            self.text.close("}");
        }
        if ends {
            self.text.close("}");
            self.text.open("else {");
            self.block(&turns.done);
            self.text.line(format!("let {counter} = {most};"));
            self.text.close("}");
        }
        self.text.close("}");
    }

    pub fn line(&mut self, text: impl Into<String>) {
        self.text.line(text);
    }

    pub fn open(&mut self, text: impl Into<String>) {
        self.text.open(text);
    }

    pub fn close(&mut self, text: &str) {
        self.text.close(text);
    }

    /// The field of a place that is written.
    pub fn home(&mut self, place: Place, format: Format) -> String {
        let name = self.names.home(place).to_owned();
        if self.known.insert(name.clone()) {
            self.written.push((name.clone(), format));
        }
        name
    }

    /// Computes a value into its home, or keeps its expression for its reader.
    fn compute(&mut self, id: NodeId) {
        self.text.span = Some(self.plan.graph.span(id));
        let place = Place::Node(id);
        let format = self.plan.format(id);
        let expression = match self.plan.graph.node(id) {
            Node::Apply(_, args) => {
                let Some(routine) = self.plan.routine(id) else {
                    return;
                };
                match (routine.form, self.points()) {
                    (_, Some(points)) => self.fixed(points, id, routine),
                    (Form::Expression { .. }, _) => self.apply(routine, args),
                    (Form::Statement(template), _) if self.logs() => {
                        return self.log_statements(id, (routine, template), args);
                    }
                    (Form::Statement(template), _) => {
                        let home = self.home(place, format);
                        let call = self.fill(template, args, &[], Some(&home));
                        let said = self.meaning(id);
                        self.text.line(format!("do {call}; // {home} = {said}"));
                        return;
                    }
                }
            }
            Node::Lookup { table, column, row } => {
                let entry = self.entry(id, table, [column, row]);
                if self.logs() && self.sign_is_looked_up(id, table) {
                    let home = self.home(place, format);
                    let sign = entry.text.replacen('[', "_plus[", 1);
                    return self.copy_log(&home, (&entry.text, &sign), false);
                }
                entry
            }
            Node::Tabulated(_) => {
                let (entry, sign) = self.column(id);
                if self.logs() && format == self.plan.runtime.real {
                    let home = self.home(place, format);
                    let known = sign.is_none();
                    let sign = sign.unwrap_or_default();
                    return self.copy_log(&home, (&entry.text, &sign), known);
                }
                entry
            }
            _ => return,
        };
        if format.is_object() {
            let home = self.home(place, format);
            self.needs.insert("Float.copy");
            self.text
                .line(format!("do {home}.copy({});", expression.text));
        } else if self.plan.folded(id) && expression.text.len() <= WIDE {
            self.folded.insert(id, expression);
        } else {
            let home = self.home(place, format);
            let said = self
                .points()
                .map(|points| self.fixed_said(points, id, &expression.text));
            let said = said.unwrap_or_default();
            self.text
                .line(format!("let {home} = {};{said}", expression.text));
        }
    }

    fn apply(&mut self, routine: &Routine, args: [NodeId; 2]) -> Expression {
        let Form::Expression {
            template,
            level,
            operands,
        } = routine.form
        else {
            return Expression::term("0");
        };
        Expression {
            text: self.fill(template, args, operands, None),
            level,
        }
    }

    /// A routine's template with its arguments and result. What stands before
    /// a point or a comma is as it is.
    fn fill(
        &mut self,
        template: &str,
        args: [NodeId; 2],
        levels: &[u8],
        result: Option<&str>,
    ) -> String {
        let mut text = template.to_owned();
        for (id, hole) in args.into_iter().zip(["{0+}", "{1+}"]) {
            if text.contains(hole) {
                text = text.replace(hole, &self.sign(id).text);
            }
        }
        for (k, (id, hole)) in args.into_iter().zip(["{0}", "{1}"]).enumerate() {
            if text.contains(hole) {
                let level = levels.get(k).copied().unwrap_or(SUM);
                text = text.replace(hole, &self.read(id).at(level));
            }
        }
        text.replace("{r}", result.unwrap_or_default())
    }

    /// A value where it is used.
    pub fn read(&mut self, id: NodeId) -> Expression {
        if let Some(expression) = self.folded.get(&id) {
            return expression.clone();
        }
        if let Some(place) = self.plan.place(id) {
            return Expression::term(self.names.home(place));
        }
        match self.plan.graph.node(id) {
            Node::Const(c) => self.constant(c.value()),
            Node::Param(p) => self.object.param(self.plan, &mut self.names, p),
            Node::Axis(Axis::X | Axis::Run) => Expression::term(&self.names.axes[0]),
            Node::Axis(Axis::Y) => Expression::term(&self.names.axes[1]),
            // Here rows are drawn in one pass.
            Node::Axis(Axis::Pass(_)) => Expression::term("0"),
            Node::Received => {
                Expression::term(self.spread.as_ref().map_or("0", |s| s.received.as_str()))
            }
            Node::Neighbour(which) => {
                let names = self.refined.as_ref().map(|r| &r.neighbours);
                Expression::term(names.map_or("0", |names| names[which as usize].as_str()))
            }
            Node::Undefined(ty) => self.constant(match ty {
                slowlight_routine::Type::Real => Value::Real(0.0),
                slowlight_routine::Type::Int => Value::Int(0),
                slowlight_routine::Type::Bool => Value::Bool(false),
            }),
            _ => Expression::term("0"),
        }
    }

    pub fn constant(&mut self, value: Value) -> Expression {
        let bits = self.plan.bits(value);
        match value {
            Value::Bool(b) => Expression::term(b.to_string()),
            Value::Int(_) => int((self.plan.runtime.decode)(bits, self.plan.runtime.int).int()),
            Value::Real(_) if self.logs() => constant(bits),
            // Where it is read at a scale: `read_at`.
            Value::Real(_) if self.points().is_some() => {
                int(slowlight_runtime_jack::model::int(bits))
            }
            Value::Real(r) => Expression::term(self.object.constant(&mut self.names, bits, r)),
        }
    }
}
