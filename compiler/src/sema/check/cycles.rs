//! Nothing may need itself: a function that calls itself, constants that
//! refer to each other, a record that holds itself.

use super::Checker;
use super::names::Entity;
use crate::source::{Diagnostic, Span};
use std::collections::BTreeMap;

impl Checker<'_> {
    fn name_of(&self, entity: Entity) -> String {
        let program = &self.program;
        match entity {
            Entity::Function(id) => program.functions[id.0].name.clone(),
            Entity::Const(id) => program.consts[id.0].name.clone(),
            Entity::Param(id) => program.params[id.0].name.clone(),
            Entity::Shape(id) => program.shapes[id.0].name.clone(),
            Entity::Scene(id) => program.scenes[id.0].name.clone(),
            Entity::Record(id) => program.records[id.0].name.clone(),
            Entity::Map(id) => program.maps[id.0].name.clone(),
            Entity::Draw => "draw".into(),
            Entity::Known(_) | Entity::Builtin(_) => String::new(),
        }
    }

    /// Reports each cycle once: a depth-first search that keeps its own stack.
    pub(super) fn cycles(&mut self) {
        let mut edges: BTreeMap<Entity, Vec<(Entity, Span)>> = BTreeMap::new();
        for &(from, to, span) in &self.mentions {
            let list = edges.entry(from).or_default();
            if list.last().is_none_or(|l| l.0 != to) {
                list.push((to, span));
            }
        }
        // Absent: not seen; true: on the path; false: done.
        let mut state: BTreeMap<Entity, bool> = BTreeMap::new();
        let mut found: Vec<Vec<(Entity, Span)>> = Vec::new();
        let none = Vec::new();
        for &start in edges.keys() {
            if state.contains_key(&start) {
                continue;
            }
            // The item, how it was come by, and how many of its edges are done.
            let mut path: Vec<(Entity, Span, usize)> = vec![(start, Span::default(), 0)];
            state.insert(start, true);
            while let Some((here, _, done)) = path.last_mut() {
                let list = edges.get(here).unwrap_or(&none);
                let Some(&(to, span)) = list.get(*done) else {
                    state.insert(*here, false);
                    path.pop();
                    continue;
                };
                *done += 1;
                match state.get(&to) {
                    None => {
                        state.insert(to, true);
                        path.push((to, span, 0));
                    }
                    Some(true) => {
                        let from = path.iter().position(|p| p.0 == to).unwrap_or(0);
                        let mut cycle: Vec<(Entity, Span)> =
                            path[from + 1..].iter().map(|p| (p.0, p.1)).collect();
                        cycle.push((to, span));
                        found.push(cycle);
                    }
                    Some(false) => {}
                }
            }
        }
        for cycle in found {
            self.report_cycle(&cycle);
        }
    }

    fn report_cycle(&mut self, cycle: &[(Entity, Span)]) {
        let Some(&(first, last)) = cycle.last() else {
            return;
        };
        let name = self.name_of(first);
        let mut chain = vec![format!("`{name}`")];
        chain.extend(
            cycle
                .iter()
                .take(12)
                .map(|(e, _)| format!("`{}`", self.name_of(*e))),
        );
        let message = match (first, cycle.len()) {
            (Entity::Record(_), 1) => format!("the record `{name}` holds itself"),
            (Entity::Function(_), 1) => format!("`{name}` calls itself"),
            (_, 1) => format!("`{name}` refers to itself"),
            _ => format!("`{name}` needs itself: {}", chain.join(" → ")),
        };
        let place = self.span_of(first).unwrap_or(last);
        let mut error = Diagnostic::error(place, message);
        for (entity, span) in cycle.iter().take(12) {
            error = error.also(
                *span,
                format!("here it comes to `{}`", self.name_of(*entity)),
            );
        }
        if matches!(first, Entity::Function(_)) {
            error = error.help("there is no recursion: use `loop (..) max n { .. } else ..`");
        }
        self.report(error);
    }
}
