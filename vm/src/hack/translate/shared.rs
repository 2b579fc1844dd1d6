//! What the translation of each function looks things up in.

use super::Compare;
use super::code::{Code, Label};
use super::frames::{Frame, Frames};
use super::graph::Graph;
use super::live::Live;
use crate::hack::vm::heights::Heights;
use crate::hack::vm::link::Program;

/// What all functions share.
pub(super) struct Shared<'p> {
    pub program: &'p Program,
    pub heights: &'p Heights,
    pub live: &'p Live,
    pub frames: &'p [Frame],
    pub scratch: &'p [u16],
    pub compare: Compare,
    /// Where each function is entered, by its number of arguments.
    pub entries: Vec<Vec<(u16, Label)>>,
    /// Where each function goes on when it has kept its return address.
    pub bodies: Vec<Label>,
    /// Whether to save words rather than cycles.
    pub small: bool,
    pub halt: Label,
    /// Where functions with frames on the stack return: those that do not set THIS
    /// and THAT, and those that do.
    pub leave: [Label; 2],
}

impl<'p> Shared<'p> {
    /// With labels for all functions that are reached.
    pub fn new(
        program: &'p Program,
        heights: &'p Heights,
        graph: &Graph,
        live: &'p Live,
        frames: &'p Frames,
        code: &mut Code,
    ) -> Self {
        let mut entries = vec![Vec::new(); program.functions.len()];
        for index in &graph.order {
            let Some(function) = program.functions.get(*index) else {
                continue;
            };
            let mut arguments = graph.arguments.get(*index).cloned().unwrap_or_default();
            if *index == program.start as usize {
                arguments.push(0);
            }
            arguments.sort_unstable();
            arguments.dedup();
            for count in arguments {
                if let Some(entries) = entries.get_mut(*index) {
                    entries.push((count, code.named(function.name.clone())));
                }
            }
        }
        Shared {
            program,
            heights,
            live,
            frames: &frames.of,
            scratch: &frames.scratch,
            compare: Compare::default(),
            entries,
            bodies: program.functions.iter().map(|_| code.label()).collect(),
            small: false,
            halt: code.named("halt".to_owned()),
            leave: ["leave", "leave"].map(|name| code.named(name.to_owned())),
        }
    }

    /// Where a function is entered with so many arguments.
    pub fn entry(&self, function: usize, arguments: u16) -> Option<Label> {
        let entries = self.entries.get(function)?;
        let entry = entries.iter().find(|(count, _)| *count == arguments);
        entry.map(|(_, label)| *label)
    }
}
