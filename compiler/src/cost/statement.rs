//! Statement costs: what a statement takes by itself: its routine's cycles, and what the machine
//! takes beside them to read the operands and to keep the value.

use crate::ir::graph::*;
use crate::ir::tree::*;
use slowlight_routine::{Overhead, Routine, Runtime, Type};

/// Routines, and what statements cost beside them.
pub(crate) struct Beside<'p> {
    pub(crate) graph: &'p Graph,
    pub(crate) runtime: &'static Runtime,
    pub(crate) folded: Vec<bool>,
    pub(crate) routines: Vec<Option<&'static Routine>>,
}

impl Beside<'_> {
    /// Cycles of a statement by itself.
    pub(crate) fn statement(&self, statement: &Statement) -> u32 {
        let Overhead {
            step,
            read,
            write,
            test,
            ..
        } = self.runtime.overhead;
        match statement {
            Statement::Let(id) if matches!(self.graph.node(*id), Node::Stepped { .. }) => {
                step.unwrap_or(0)
            }
            Statement::Let(id) => self.computed(*id),
            Statement::Set { place, from } => {
                let reading = match from {
                    Origin::Node(id) => self.read(*id),
                    Origin::Scratch(..) => read[1],
                };
                let kind = match place {
                    Place::Node(id) => kind(self.graph.ty(*id)),
                    _ => 1,
                };
                reading + write[kind]
            }
            Statement::If { cond, .. } => test + self.read(*cond),
            Statement::Loop(_) | Statement::Call(_) => test,
        }
    }

    /// What computing a node costs, its operands not.
    fn own(&self, id: NodeId) -> u32 {
        if let Node::Tabulated(_) = self.graph.node(id) {
            return self.runtime.overhead.index;
        }
        if let Node::Lookup { table, .. } = self.graph.node(id) {
            let table = self.graph.tables.get(table.0 as usize);
            let flat = table.is_some_and(|t| t.width == 1 || t.height == 1);
            return self.runtime.overhead.index * if flat { 1 } else { 2 };
        }
        let routine = self.routines.get(id.0 as usize).copied().flatten();
        routine.map_or(0, |r| r.cycles)
    }

    fn inline(&self, id: NodeId) -> bool {
        self.folded.get(id.0 as usize) == Some(&true)
    }

    fn read(&self, id: NodeId) -> u32 {
        let Overhead {
            read,
            nested,
            digit,
            ..
        } = self.runtime.overhead;
        let ty = self.graph.ty(id);
        match self.graph.constant(id) {
            _ if self.inline(id) && ty == Type::Real => nested,
            _ if self.inline(id) => 0,
            Some(value) if ty == Type::Int => {
                digit * value.int().unsigned_abs().to_string().len() as u32
            }
            _ => read[kind(ty)],
        }
    }

    /// What computing a node and keeping it costs, its operands not.
    pub(crate) fn kept(&self, id: NodeId) -> u32 {
        let kept = match self.inline(id) {
            false => self.runtime.overhead.write[kind(self.graph.ty(id))],
            true => 0,
        };
        self.own(id) + kept
    }

    fn computed(&self, id: NodeId) -> u32 {
        let node = self.graph.node(id);
        let operands: u32 = node.inputs().map(|used| self.read(used)).sum();
        operands + self.kept(id)
    }

    /// What it takes to ask a bool that is not kept.
    pub(crate) fn asked(&self, id: NodeId) -> u32 {
        let operands = self.graph.node(id).operands();
        let operands: u32 = operands.map(|used| self.read(used)).sum();
        self.runtime.overhead.test + operands + self.own(id)
    }

    /// What ramps take behind each pixel.
    pub(crate) fn steps(&self, row: &Block) -> f64 {
        let step = self.runtime.overhead.step.unwrap_or(0);
        let mut ramps = 0;
        walk(row, &mut |statement| {
            let node = |id: &NodeId| self.graph.node(*id);
            ramps += u32::from(
                matches!(statement, Statement::Let(id) if matches!(node(id), Node::Ramp { .. })),
            );
        });
        f64::from(ramps * step)
    }
}

/// What a plan's parts take by themselves, as plans of one scene are chosen by.
pub struct Costs<'p>(Beside<'p>);

impl crate::plan::Plan {
    /// What statements take. A routine's cost is a mean over its arguments; what draws, and
    /// the loops over rows and columns, are left out.
    pub fn costs(&self) -> Costs<'_> {
        Costs(Beside {
            graph: &self.graph,
            runtime: self.runtime,
            folded: self.folded.clone(),
            routines: self.routines.clone(),
        })
    }
}

impl Costs<'_> {
    /// Cycles of a statement, those inside of it not.
    pub fn statement(&self, statement: &Statement) -> u32 {
        self.0.statement(statement)
    }

    /// Cycles to ask a bool that is not kept.
    pub fn asked(&self, id: NodeId) -> u32 {
        self.0.asked(id)
    }

    /// Cycles behind each pixel of what a block begins that is stepped.
    pub fn steps(&self, block: &Block) -> f64 {
        self.0.steps(block)
    }
}

/// Where a type's costs stand in [`Overhead`].
fn kind(ty: Type) -> usize {
    usize::from(ty == Type::Real)
}
