//! Which functions a program calls, and which of them recursively.

use crate::hack::vm::command::Command;
use crate::hack::vm::heights::{Heights, UNREACHED};
use crate::hack::vm::link::{Function, Program};

/// The calls of a program.
pub(super) struct Graph {
    /// The functions that are reached, those called before those that call them,
    /// but for recursion.
    pub order: Vec<usize>,
    /// For each function whether it may be called while it runs.
    pub recursive: Vec<bool>,
    /// For each function those that it calls.
    pub callees: Vec<Vec<usize>>,
    /// For each function with how many arguments it is called, each number once.
    pub arguments: Vec<Vec<u16>>,
}

impl Graph {
    /// Follows the calls from the function that the program starts in.
    pub fn new(program: &Program, heights: &Heights) -> Graph {
        let count = program.functions.len();
        let mut graph = Graph {
            order: Vec::new(),
            recursive: vec![false; count],
            callees: vec![Vec::new(); count],
            arguments: vec![Vec::new(); count],
        };
        for (function, callees) in program.functions.iter().zip(&mut graph.callees) {
            for command in reached(program, heights, function) {
                if let Command::Call { function, .. } = command {
                    callees.push(*function as usize);
                }
            }
            callees.sort_unstable();
            callees.dedup();
        }
        graph.visit(program.start as usize);
        graph.count_arguments(program, heights);
        graph
    }

    /// Tarjan's strongly connected components, without recursion of the host.
    fn visit(&mut self, start: usize) {
        const NEW: usize = usize::MAX;
        let count = self.callees.len();
        let mut index = vec![NEW; count];
        let mut low = vec![NEW; count];
        let mut open = vec![false; count];
        let mut component = Vec::new();
        let mut work = vec![(start, 0)];
        let mut next = 0;
        while let Some((at, edge)) = work.pop() {
            if edge == 0 {
                index[at] = next;
                low[at] = next;
                next += 1;
                component.push(at);
                open[at] = true;
            }
            if let Some(&callee) = self.callees[at].get(edge) {
                work.push((at, edge + 1));
                if index[callee] == NEW {
                    work.push((callee, 0));
                } else if open[callee] {
                    low[at] = low[at].min(index[callee]);
                }
                if callee == at {
                    self.recursive[at] = true;
                }
                continue;
            }
            if let Some((caller, _)) = work.last() {
                low[*caller] = low[*caller].min(low[at]);
            }
            if low[at] == index[at] {
                let from = component.iter().rposition(|f| *f == at).unwrap_or(0);
                let members = component.split_off(from);
                for member in &members {
                    open[*member] = false;
                    if members.len() > 1 {
                        self.recursive[*member] = true;
                    }
                }
                self.order.extend(members);
            }
        }
    }

    fn count_arguments(&mut self, program: &Program, heights: &Heights) {
        for function in &self.order {
            let Some(function) = program.functions.get(*function) else {
                continue;
            };
            for command in reached(program, heights, function) {
                if let Command::Call {
                    function,
                    arguments,
                    ..
                } = command
                    && let Some(known) = self.arguments.get_mut(*function as usize)
                    && !known.contains(arguments)
                {
                    known.push(*arguments);
                }
            }
        }
    }
}

/// The commands of a function that a path leads to.
fn reached<'p>(
    program: &'p Program,
    heights: &'p Heights,
    function: &Function,
) -> impl Iterator<Item = &'p Command> {
    let commands = program.commands.get(function.range()).unwrap_or(&[]);
    let heights = heights.at.get(function.range()).unwrap_or(&[]);
    let both = commands.iter().zip(heights);
    both.filter(|(_, height)| **height != UNREACHED)
        .map(|(command, _)| command)
}
