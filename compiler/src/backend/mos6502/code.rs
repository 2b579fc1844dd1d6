//! Statements.

use super::Text;
use super::comment;
use super::homes::{Homes, most_turns};
use super::shapes::by_range;
use super::slots::Slot;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::{Copies, Plan};
use slowlight_routine::Op;
use slowlight_routine::{Format, Routine};
use slowlight_runtime_6502::write::{self, Goal, Place as Operand};

/// Bytes that a branch reaches at least, whatever lies between.
const NEAR: usize = 120;

/// Writes statements.
pub(super) struct Code<'p> {
    pub plan: &'p Plan,
    pub homes: &'p Homes,
    pub text: &'p mut Text,
    /// Whether some index had to be clamped.
    pub clamps: bool,
    /// Parts of the runtime that are needed beside those of the plan's routines.
    pub needs: Vec<&'static str>,
    /// Whether comparisons with the column end the run that begins here.
    pub in_run: bool,
    /// Whether memory is spent for speed here: at pixels, if the program has it.
    pub quick: bool,
    /// Whether this is of a loop's turn.
    looping: bool,
    /// Whether the timer is asked where a loop's turn begins.
    pub asks: bool,
    /// The factors of the products that follow in this block.
    pub ahead: Vec<NodeId>,
}

/// Bytes of some lines of assembly, at most.
fn most_bytes(text: &Text) -> usize {
    let instruction =
        |line: &&(String, _)| line.0.starts_with(' ') && !line.0.trim_start().starts_with(';');
    3 * text.lines.iter().filter(instruction).count()
}

impl<'p> Code<'p> {
    pub fn new(plan: &'p Plan, homes: &'p Homes, text: &'p mut Text) -> Code<'p> {
        Code {
            plan,
            homes,
            text,
            clamps: false,
            needs: Vec::new(),
            in_run: false,
            quick: false,
            looping: false,
            asks: false,
            ahead: Vec::new(),
        }
    }

    pub fn block(&mut self, block: &Block) {
        for (k, statement) in block.iter().enumerate() {
            if self.quick {
                self.ahead = ahead(self.plan, block.get(k + 1..).unwrap_or_default());
            }
            self.statement(statement);
        }
    }

    /// Statements apart, to see how long they are.
    fn apart(&mut self, write: impl FnOnce(&mut Code<'_>)) -> Text {
        let mut text = Text {
            serial: self.text.serial,
            span: self.text.span,
            ..Text::default()
        };
        let mut code = Code::new(self.plan, self.homes, &mut text);
        code.in_run = self.in_run;
        code.quick = self.quick;
        code.looping = self.looping;
        code.asks = self.asks;
        write(&mut code);
        self.clamps |= code.clamps;
        let needs = std::mem::take(&mut code.needs);
        self.needs.extend(needs);
        self.text.serial = text.serial;
        text
    }

    fn append(&mut self, text: Text) {
        self.text.lines.extend(text.lines);
        self.text.kept = None;
    }

    fn statement(&mut self, statement: &Statement) {
        self.text.span = Some(statement.span(&self.plan.graph, &self.plan.tree));
        match statement {
            Statement::Let(id) => {
                self.compute(*id);
                self.keep_moved(*id);
            }
            Statement::Set { place, from } => {
                self.set(*place, *from);
                self.keep_column(*place);
            }
            Statement::If { cond, yes, no } => self.choose(*cond, yes, no),
            Statement::Loop(turns) => self.repeat(turns),
            Statement::Call(id) => {
                let name = self.homes.subroutine(*id);
                self.text.code(&format!("jsr {name}"));
            }
        }
    }

    fn set(&mut self, place: Place, from: Origin) {
        let to = self.homes.place(place).to_owned();
        let (from, said) = match from {
            Origin::Node(id) if self.moves(place, id) => {
                let said = comment::operand(self.plan, self.homes, id);
                self.text.line(format!("        ; {to} = {said}"));
                return self.set_real(place, &to, id);
            }
            Origin::Node(id) => (
                self.homes.operand(self.plan, id),
                comment::operand(self.plan, self.homes, id),
            ),
            Origin::Scratch(l, k) => {
                let place = Place::Scratch(l, k);
                let name = self.homes.place(place).to_owned();
                (self.homes.held_in(self.plan, place), name)
            }
        };
        let same = matches!(&from, Operand::At(name) | Operand::Held(name, _) | Operand::Signed(name, _) if *name == to);
        if !same {
            self.text.line(format!("        ; {to} = {said}"));
            self.copy_into(&from, &to, place);
        }
    }

    fn compute(&mut self, id: NodeId) {
        self.text.span = Some(self.plan.graph.span(id));
        self.end_run(id);
        self.text.line(format!(
            "        {}",
            comment::of_value(self.plan, self.homes, id)
        ));
        match self.plan.graph.node(id) {
            Node::Apply(_, [a, b]) => {
                let Some(routine) = self.plan.routine(id) else {
                    return;
                };
                if self.copied(id, [a, b]) {
                    return;
                }
                let args = self.read_all(id, [a, b]);
                let place = Place::of(&self.plan.graph, id);
                let home = self.homes.place(place);
                if self.inline(id, &args) {
                    return;
                }
                let goal = match self.homes.shape(self.plan, place) {
                    _ if self.homes.fused.contains(&id) => Goal::Carry,
                    Some(shape) => Goal::Held(home, shape.bytes),
                    None => Goal::At(home),
                };
                let args = args.get(..routine.args.len()).unwrap_or_default();
                let number = self.number(id);
                self.use_of(routine, args, &goal, number);
            }
            Node::Lookup { table, column, row } => self.lookup(id, table, column, row),
            // As a row begins it.
            Node::Ramp { first, .. } => {
                let place = Place::Node(id);
                let to = self.homes.place(place).to_owned();
                let from = self.homes.operand(self.plan, first);
                self.copy_into(&from, &to, place);
            }
            Node::Stepped { step, .. } => self.add_step(id, step),
            Node::Tabulated(_) => self.read_column(id),
            _ => {}
        }
    }

    /// Whether what routines look up in tables is called for.
    fn calls(&self) -> bool {
        let written = self.looping && self.plan.copies >= Copies::Loops;
        self.plan.tight || self.plan.lean && !written
    }

    /// What a routine makes of some operands.
    pub fn use_of(&mut self, routine: &Routine, args: &[Operand], goal: &Goal<'_>, number: i32) {
        let mut lines = Vec::new();
        let serial = self.text.next_serial();
        let used = write::Use {
            routine,
            args,
            goal,
            serial,
            number,
            calls: self.calls(),
        };
        self.needs.extend(write::instructions(used, &mut lines));
        lines.iter().for_each(|line| self.text.line(line));
    }

    /// Brings the ramps to the next column.
    pub fn step(&mut self) {
        for (id, by) in self.plan.ramps() {
            self.text.span = Some(self.plan.graph.span(id));
            self.add_step(id, by);
        }
        self.text.span = None;
    }

    /// Adds a step to what is stepped.
    fn add_step(&mut self, id: NodeId, by: NodeId) {
        let place = Place::of(&self.plan.graph, id);
        let to = self.homes.place(place).to_owned();
        let step = self.homes.operand(self.plan, by);
        let said = comment::operand(self.plan, self.homes, by);
        self.text.line(format!("        ; {to} = {to} + {said}"));
        let adds = |r: &&Routine| r.name == "int_add";
        if let Some(routine) = self.plan.runtime.routines.iter().find(adds) {
            let ramp = self.homes.held_in(self.plan, place);
            let shape = self.homes.shape(self.plan, place);
            let bytes = shape.map_or(write::size(routine.result), |shape| shape.bytes);
            if let Operand::Constant(by) = step {
                let (mut lines, serial) = (Vec::new(), self.text.next_serial());
                write::add_constant(&to, bytes, by, serial, &mut lines);
                return lines.iter().for_each(|line| self.text.line(line));
            }
            self.use_of(routine, &[ramp, step], &Goal::Held(&to, bytes), 0);
        }
    }

    /// A copy into a place.
    pub(super) fn copy_into(&mut self, from: &Operand, to: &str, place: Place) {
        match self.homes.shape(self.plan, place) {
            Some(shape) => {
                let mut lines = Vec::new();
                write::copy_bytes(from, to, shape.bytes, &mut lines);
                lines.iter().for_each(|line| self.text.line(line));
            }
            None => self.copy(from, to, self.plan.place_format(place)),
        }
    }

    pub fn copy(&mut self, from: &Operand, to: &str, format: Format) {
        let mut lines = Vec::new();
        write::copy(from, to, format, &mut lines);
        lines.iter().for_each(|line| self.text.line(line));
    }

    /// A copy into so many bytes.
    pub fn copy_bytes(&mut self, from: &Operand, (to, bytes): (&str, u8)) {
        let mut lines = Vec::new();
        write::copy_bytes(from, to, bytes, &mut lines);
        lines.iter().for_each(|line| self.text.line(line));
    }

    /// Copies an int or a real.
    pub fn copy_to(&mut self, from: &Operand, to: &str) {
        self.copy(from, to, self.plan.runtime.int);
    }

    /// Gives the column or the row a value.
    pub fn copy_axis(&mut self, from: &Operand, to: &str) {
        let mut lines = Vec::new();
        let bytes = match by_range(self.plan) {
            true => 2,
            false => write::size(self.plan.runtime.int),
        };
        write::copy_bytes(from, to, bytes, &mut lines);
        lines.iter().for_each(|line| self.text.line(line));
    }

    /// Leaves a condition where a branch finds it: `bcc` or `beq` goes where it does not hold.
    fn test(&mut self, cond: NodeId) -> (&'static str, &'static str) {
        if self.homes.fused.contains(&cond) {
            // The sign of what was computed last becomes the carry for bytes alone.
            let lines = &mut self.text.lines;
            if lines.last().is_some_and(|(line, _)| line.trim() == "asl") {
                lines.pop();
                return ("bpl", "bmi");
            }
            return ("bcc", "bcs");
        }
        let place = self.homes.operand(self.plan, cond);
        let said = comment::operand(self.plan, self.homes, cond);
        self.text.line(format!("        ; {said}?"));
        self.text.code(&format!("lda {}", write::byte(&place, 0)));
        ("beq", "bne")
    }

    fn choose(&mut self, cond: NodeId, yes: &Block, no: &Block) {
        let (fails, holds) = self.test(cond);
        let n = self.text.next_serial();
        let first = self.apart(|code| code.block(yes));
        let second = self.apart(|code| code.block(no));
        if yes.is_empty() {
            self.branch(holds, fails, &format!("end{n}"), most_bytes(&second));
        } else {
            let target = if no.is_empty() { "end" } else { "else" };
            self.branch(
                fails,
                holds,
                &format!("{target}{n}"),
                most_bytes(&first) + 3,
            );
            self.append(first);
            if !no.is_empty() {
                self.text.code(&format!("jmp end{n}"));
                self.text.label(&format!("else{n}"));
            }
        }
        self.append(second);
        self.text.label(&format!("end{n}"));
    }

    /// Branches forward over so many bytes, around a jump where that is too far.
    fn branch(&mut self, branch: &str, opposite: &str, target: &str, bytes: usize) {
        if bytes <= NEAR {
            self.text.code(&format!("{branch} {target}"));
        } else {
            let n = self.text.next_serial();
            self.text.code(&format!("{opposite} go{n} | jmp {target}"));
            self.text.label(&format!("go{n}"));
        }
    }

    fn repeat(&mut self, turns: &Turns) {
        self.block(&turns.start);
        let n = self.text.next_serial();
        let counter = self.homes.name(Slot::Turns(turns.of)).to_owned();
        let most = most_turns(self.plan, turns.of);
        let [lo, hi, ..] = most.to_le_bytes();
        let wide = hi > 0;
        self.text.line(format!("        ; at most {most} turns"));
        self.text.code(&format!("lda #{lo} | sta {counter}"));
        if wide {
            self.text.code(&format!("lda #{hi} | sta {counter}+1"));
        }
        self.text.label(&format!("loop{n}"));
        if self.asks {
            self.text.code("jsr vcs_ask");
        }
        let outer = std::mem::replace(&mut self.looping, true);
        self.block(&turns.body);
        let (fails, holds) = self.test(turns.again);
        let turn = self.apart(|code| code.block(&turns.next));
        self.looping = outer;
        let rest = self.apart(|code| code.block(&turns.otherwise));
        let over = most_bytes(&turn) + most_bytes(&rest) + 30;
        self.branch(fails, holds, &format!("done{n}"), over);
        self.append(turn);
        if wide {
            // Sixteen bits: down to 0, the high byte borrowing where the low one is 0.
            self.text
                .code(&format!("lda {counter} | bne low{n} | dec {counter}+1"));
            self.text.label(&format!("low{n}"));
            self.text
                .code(&format!("dec {counter} | lda {counter} | ora {counter}+1"));
        } else {
            self.text.code(&format!("dec {counter}"));
        }
        self.text.code(&format!("beq out{n} | jmp loop{n}"));
        self.text.label(&format!("out{n}"));
        self.append(rest);
        let ending = self.apart(|code| code.block(&turns.done));
        if ending.lines.is_empty() {
            self.text.label(&format!("done{n}"));
            return;
        }
        self.text.code(&format!("jmp after{n}"));
        self.text.label(&format!("done{n}"));
        self.append(ending);
        self.text.label(&format!("after{n}"));
    }
}

/// Where operands go that are read at another scale.
pub(super) const READ: [&str; 2] = ["first", "second"];

/// How many statements are looked at for a product with the same factor.
const FAR: usize = 6;

/// The factors of the products among the statements that follow.
fn ahead(plan: &Plan, rest: &[Statement]) -> Vec<NodeId> {
    let product = |statement: &Statement| match statement {
        Statement::Let(id) => match plan.graph.node(*id) {
            Node::Apply(Op::Mul, args) => Some(args),
            _ => None,
        },
        _ => None,
    };
    let straight = rest.iter().take(FAR);
    let straight = straight.take_while(|s| !matches!(s, Statement::If { .. } | Statement::Loop(_)));
    straight.filter_map(product).flatten().collect()
}
