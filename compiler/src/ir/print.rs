//! The graph's text form: one node a line, operands by number.
//!
//! ```text
//! image 320x240 inks #000000 #ffffff
//! param 0 eye_x: real = 0 in -3..3
//! loop 0 max 12 (r_x: real = %4) again %20 next (%30) done (%31) else (%2)
//! %0: int = axis x
//! %1: real = to_real %0
//! ink %1
//! ```

use super::graph::*;
use slowlight_routine::{Type, Value};
use std::fmt::{self, Display, Write};

/// A type's name.
pub fn type_name(ty: Type) -> &'static str {
    match ty {
        Type::Bool => "bool",
        Type::Int => "int",
        Type::Real => "real",
    }
}

/// A value as text that reads back to the same value.
pub fn value_text(value: Value) -> String {
    match value {
        Value::Bool(b) => b.to_string(),
        Value::Int(i) => i.to_string(),
        Value::Real(r) if r != 0.0 && !(1e-4..1e15).contains(&r.abs()) => format!("{r:e}"),
        Value::Real(r) => r.to_string(),
    }
}

impl Display for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "%{}", self.0)
    }
}

fn list(ids: &[NodeId]) -> String {
    ids.iter()
        .map(NodeId::to_string)
        .collect::<Vec<_>>()
        .join(", ")
}

/// What a node is, without its number and type.
pub fn node_text(graph: &Graph, node: Node) -> String {
    match node {
        Node::Const(c) => format!("const {}", value_text(c.value())),
        Node::Param(p) => {
            let name = graph
                .params
                .get(p.0 as usize)
                .map_or(String::new(), Param::label);
            format!("param {} ; {name}", p.0)
        }
        Node::Axis(Axis::X) => "axis x".to_owned(),
        Node::Axis(Axis::Y) => "axis y".to_owned(),
        Node::Axis(Axis::Pass(passes)) => format!("axis x mod {passes}"),
        Node::Axis(Axis::Run) => "axis run".to_owned(),
        Node::Apply(op, args) => {
            let shown: Vec<NodeId> = args.into_iter().take(op.arity()).collect();
            format!("{} {}", op.name(), list(&shown))
        }
        Node::Select { cond, yes, no } => format!("select {cond}, {yes}, {no}"),
        Node::Lookup { table, column, row } => format!("lookup {} [{column}, {row}]", table.0),
        Node::Ramp {
            first,
            step,
            stride: 1,
        } => format!("ramp {first}, {step}"),
        Node::Ramp {
            first,
            step,
            stride,
        } => format!("ramp {first}, {step} every {stride}"),
        Node::Stepped { first, step } => format!("stepped {first}, {step}"),
        Node::Tabulated(value) => format!("tabulated {value}"),
        Node::Carried { of, index } => format!("carried {}.{index}", of.0),
        Node::Last { of, index } => format!("last {}.{index}", of.0),
        Node::Result { of, index } => format!("result {}.{index}", of.0),
        Node::Received => "received".to_owned(),
        Node::Neighbour(which) => format!("neighbour {}", which.name()),
        Node::Slot(_) => "slot".to_owned(),
        Node::Undefined(_) => "undefined".to_owned(),
    }
}

impl Display for Graph {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "image {}x{}", self.image.width, self.image.height)?;
        if self.image.block != (1, 1) {
            write!(f, " of {}x{}", self.image.block.0, self.image.block.1)?;
        }
        write!(f, " inks")?;
        for [r, g, b] in &self.image.palette {
            write!(f, " #{r:02x}{g:02x}{b:02x}")?;
        }
        writeln!(f)?;
        for (k, p) in self.params.iter().enumerate() {
            let value = value_text(Value::Real(p.value));
            write!(f, "param {k} {}: {} = {value}", p.label(), type_name(p.ty))?;
            if let Some(range) = p.range {
                write!(f, " in {}..{}", range.lo, range.hi)?;
            }
            match p.role {
                Role::Param => {}
                Role::State => f.write_str(" by state")?,
                Role::Input(button) => write!(f, " by {}", button.name())?,
            }
            writeln!(f)?;
        }
        for (k, t) in self.tables.iter().enumerate() {
            write!(
                f,
                "table {k} {}: {} {}x{} =",
                t.name,
                type_name(t.ty),
                t.width,
                t.height
            )?;
            for entry in &t.entries {
                write!(f, " {}", value_text(entry.value()))?;
            }
            writeln!(f)?;
        }
        for (k, l) in self.loops.iter().enumerate() {
            let mut carried = String::new();
            for ((name, ty), init) in l.names.iter().zip(&l.types).zip(&l.init) {
                let comma = if carried.is_empty() { "" } else { ", " };
                write!(carried, "{comma}{name}: {} = {init}", type_name(*ty))?;
            }
            writeln!(
                f,
                "loop {k} max {} ({carried}) again {} next ({}) done ({}) else ({})",
                l.max,
                l.again,
                list(&l.next),
                list(&l.done),
                list(&l.otherwise)
            )?;
        }
        let reached = self.reached();
        for id in self
            .ids()
            .filter(|id| reached.get(id.0 as usize) == Some(&true))
        {
            let node = node_text(self, self.node(id));
            write!(f, "{id}: {} = {node}", type_name(self.ty(id)))?;
            match self.names.get(&id) {
                Some(name) => writeln!(f, " ; {name}")?,
                None => writeln!(f)?,
            }
        }
        let live = |id: &&NodeId| reached.get(id.0 as usize) == Some(&true);
        let directions = self.directions.iter().filter(|(id, _)| live(id));
        let (unit, long): (Vec<_>, Vec<_>) = directions.partition(|(_, length)| **length == 1.0);
        if !unit.is_empty() {
            let unit: Vec<NodeId> = unit.into_iter().map(|(id, _)| *id).collect();
            writeln!(f, "directions {}", list(&unit))?;
        }
        for (id, length) in long {
            writeln!(f, "long {id} {length}")?;
        }
        for effect in &self.effects {
            writeln!(f, "effect {} {}", effect.name, effect.calls)?;
        }
        if let Some(shade) = self.shade {
            writeln!(f, "shade {shade}")?;
        }
        for Share { dx, dy, node } in self.shares() {
            writeln!(f, "send {dx} {dy} {node}")?;
        }
        if let Some(refinement) = self.refinement {
            let Refinement {
                step,
                tolerance,
                often,
                kept,
            } = refinement;
            writeln!(
                f,
                "keep {kept} every {step} within {tolerance} often {often}"
            )?;
        }
        for report in &self.reports {
            writeln!(f, "report {report}")?;
        }
        writeln!(f, "ink {}", self.ink)
    }
}
