//! The plan as text: each value with its home, format, routine and range, and
//! the statements in order.

use super::Plan;
use crate::analysis::range::Ranges;
use crate::analysis::rate::Rates;
use crate::ir::graph::*;
use crate::ir::print::{node_text, type_name};
use crate::ir::tree::*;
use slowlight_routine::Range;
use std::fmt::{self, Display, Write};

/// A graph's nodes, each with its rate.
pub fn rates_text(graph: &Graph, rates: &Rates) -> String {
    table(graph, |id| {
        let set: Vec<String> = rates.rate(id).iter().map(ToString::to_string).collect();
        if set.is_empty() {
            "constant".to_owned()
        } else {
            set.join(", ")
        }
    })
}

/// A graph's nodes, each with its range.
pub fn ranges_text(graph: &Graph, ranges: &Ranges) -> String {
    table(graph, |id| {
        ranges
            .result
            .get(id.0 as usize)
            .map_or(String::new(), |r| range_text(*r))
    })
}

/// A range: `0..1`, `0<..5` where 0 itself is excluded.
pub fn range_text(range: Range) -> String {
    let end = |x: f64| match x {
        x if x == f64::MIN || x == f64::NEG_INFINITY => "-max".to_owned(),
        x if x == f64::MAX || x == f64::INFINITY => "max".to_owned(),
        x if x == x.trunc() && x.abs() < 1e9 => format!("{x}"),
        x => format!("{x:.6}"),
    };
    let not_zero = if range.nonzero && range.lo <= 0.0 && range.hi >= 0.0 {
        " but 0"
    } else {
        ""
    };
    format!("{}..{}{not_zero}", end(range.lo), end(range.hi))
}

fn table(graph: &Graph, text: impl Fn(NodeId) -> String) -> String {
    let reached = graph.reached();
    let mut out = String::new();
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        let name = graph
            .names
            .get(&id)
            .map_or(String::new(), |n| format!(" ; {n}"));
        let node = node_text(graph, graph.node(id));
        let _ = writeln!(
            out,
            "{id}: {} = {node} :: {}{name}",
            type_name(graph.ty(id)),
            text(id)
        );
    }
    out
}

impl Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mode = if self.mode.name.is_empty() {
            String::new()
        } else {
            format!(" mode {}", self.mode.name)
        };
        writeln!(
            f,
            "plan {} for {}{mode} {}x{}x{} at ({}, {}) columns {}..{} rows {}..{} in {}",
            self.name,
            self.target.name,
            self.mode.width,
            self.mode.height,
            self.mode.inks,
            self.offset.0,
            self.offset.1,
            self.columns.0,
            self.columns.1,
            self.rows.0,
            self.rows.1,
            self.runtime.format
        )?;
        if self.was_cut() {
            writeln!(f, "cut short: the search did all the work that it may")?;
        }
        for p in &self.params {
            write!(f, "param {} = {}", p.label, p.text)?;
            if let Some(d) = p.digits.filter(|d| *d > 0) {
                write!(f, " / 10^{d}")?;
            }
            match &p.range {
                Some((lo, hi)) => writeln!(f, " in {lo}..{hi}")?,
                None => writeln!(f)?,
            }
        }
        for (name, block) in [
            ("frame", &self.tree.frame),
            ("column", &self.tree.column),
            ("row", &self.tree.row),
            ("pass", &self.tree.pass),
            ("segment", &self.tree.segment),
            ("pixel", &self.tree.pixel),
            ("step", &self.tree.step),
        ] {
            if matches!(name, "column" | "pass" | "segment" | "step") && block.is_empty() {
                continue;
            }
            writeln!(f, "{name}:")?;
            self.block(f, block, 1)?;
        }
        for (k, subroutine) in self.tree.subroutines.iter().enumerate() {
            writeln!(f, "subroutine {k} {}:", subroutine.name)?;
            self.block(f, &subroutine.body, 1)?;
        }
        for Share { dx, dy, node } in self.graph.shares() {
            writeln!(f, "send {dx} {dy} {}", self.operand(node))?;
        }
        if let Some(Refinement { step, kept, .. }) = self.graph.refinement {
            writeln!(f, "keep {} every {step}", self.operand(kept))?;
        }
        writeln!(f, "ink {}", self.operand(self.graph.ink))
    }
}

impl Plan {
    fn operand(&self, id: NodeId) -> String {
        match (self.place(id), self.graph.node(id)) {
            (Some(place), _) => self.home(place).to_owned(),
            (None, Node::Param(p)) => self
                .params
                .get(p.0 as usize)
                .map_or(String::new(), |p| p.label.clone()),
            (None, node) => node_text(&self.graph, node)
                .replace("const ", "")
                .replace("axis ", ""),
        }
    }

    fn expression(&self, id: NodeId) -> String {
        match self.graph.node(id) {
            Node::Apply(op, args) => {
                let name = self.routine(id).map_or(op.name(), |r| r.name);
                let args: Vec<String> = args
                    .into_iter()
                    .take(op.arity())
                    .map(|a| self.operand(a))
                    .collect();
                format!("{name}({})", args.join(", "))
            }
            Node::Lookup { table, column, row } => {
                let name = self
                    .graph
                    .tables
                    .get(table.0 as usize)
                    .map_or("", |t| t.name.as_str());
                format!("{name}[{}, {}]", self.operand(column), self.operand(row))
            }
            Node::Ramp { first, step, .. } => {
                format!("{}, then +{}", self.operand(first), self.operand(step))
            }
            Node::Tabulated(_) => "its column's entry".to_owned(),
            Node::Stepped { first, step } => {
                format!("{} + {}", self.operand(first), self.operand(step))
            }
            _ => self.operand(id),
        }
    }

    fn block(&self, f: &mut fmt::Formatter<'_>, block: &Block, depth: usize) -> fmt::Result {
        let pad = "  ".repeat(depth);
        for statement in block {
            match statement {
                Statement::Let(id) => {
                    let range = self
                        .ranges
                        .result
                        .get(id.0 as usize)
                        .map_or(String::new(), |r| range_text(*r));
                    let mark = if self.folded(*id) { "~" } else { "=" };
                    let home = self.home(Place::of(&self.graph, *id));
                    writeln!(
                        f,
                        "{pad}{home}: {} {mark} {}  ; {range}",
                        self.format(*id),
                        self.expression(*id)
                    )?;
                }
                Statement::Set { place, from } => {
                    let from = match *from {
                        Origin::Node(id) => self.operand(id),
                        Origin::Scratch(l, k) => self.home(Place::Scratch(l, k)).to_owned(),
                    };
                    writeln!(f, "{pad}{} := {from}", self.home(*place))?;
                }
                Statement::If { cond, yes, no } => {
                    writeln!(f, "{pad}if {}", self.operand(*cond))?;
                    self.block(f, yes, depth + 1)?;
                    if !no.is_empty() {
                        writeln!(f, "{pad}else")?;
                        self.block(f, no, depth + 1)?;
                    }
                }
                Statement::Call(id) => {
                    let found = self.tree.subroutines.get(id.0 as usize);
                    let name = found.map_or("", |s| s.name.as_str());
                    writeln!(f, "{pad}call {} {name}", id.0)?;
                }
                Statement::Loop(turns) => {
                    self.block(f, &turns.start, depth)?;
                    let found = self.graph.loops.get(turns.of.0 as usize);
                    let max = found.map_or(1, |l| l.max);
                    writeln!(f, "{pad}loop at most {max}")?;
                    self.block(f, &turns.body, depth + 1)?;
                    writeln!(f, "{pad}while {}", self.operand(turns.again))?;
                    self.block(f, &turns.next, depth + 1)?;
                    for (name, part) in [("done", &turns.done), ("exhausted", &turns.otherwise)] {
                        if !part.is_empty() {
                            writeln!(f, "{pad}{name}")?;
                            self.block(f, part, depth + 1)?;
                        }
                    }
                }
            }
        }
        Ok(())
    }
}
