//! Naming of homes: the scene's own names where it has them, unique in the program.

use crate::ir::graph::*;
use crate::ir::tree::*;
use rustc_hash::{FxHashMap, FxHashSet};

/// A name for every place that the tree writes.
pub fn homes(graph: &Graph, tree: &Tree) -> FxHashMap<Place, String> {
    let mut taken = Taken::default();
    taken.names.extend(graph.params.iter().map(Param::label));
    taken.names.extend(["x".to_owned(), "y".to_owned()]);
    let mut homes = FxHashMap::default();
    for block in tree.blocks() {
        walk(block, &mut |statement| {
            let place = match statement {
                Statement::Let(id) => Place::of(graph, *id),
                Statement::Set { place, .. } => *place,
                _ => return,
            };
            homes
                .entry(place)
                .or_insert_with(|| taken.unique(&wanted(graph, place)));
        });
    }
    homes
}

fn wanted(graph: &Graph, place: Place) -> String {
    let carried = |l: LoopId, k: u32| {
        let found = graph
            .loops
            .get(l.0 as usize)
            .and_then(|l| l.names.get(k as usize));
        found.cloned().unwrap_or_default()
    };
    match place {
        Place::Node(id) => graph
            .names
            .get(&id)
            .map(|name| name.to_string())
            .unwrap_or_else(|| match graph.node(id) {
                Node::Apply(op, _) => op.name().to_owned(),
                Node::Lookup { table, .. } => graph
                    .tables
                    .get(table.0 as usize)
                    .map_or(String::new(), |t| format!("{}_cell", t.name)),
                Node::Select { .. } => "either".to_owned(),
                Node::Ramp { .. } => "ramp".to_owned(),
                Node::Slot(_) => "given".to_owned(),
                _ => "result".to_owned(),
            }),
        Place::Carried(l, k) => carried(l, k),
        Place::Scratch(l, k) => format!("{}_saved", carried(l, k)),
    }
}

/// Names that are given away.
#[derive(Default)]
struct Taken {
    names: FxHashSet<String>,
    /// The first number behind a name that may be free: a large program has thousands of a name.
    next: FxHashMap<String, usize>,
}

impl Taken {
    /// The name cleaned to an identifier, numbered where it is taken.
    fn unique(&mut self, name: &str) -> String {
        let mut clean: String = name
            .chars()
            .map(|c| {
                if c.is_ascii_alphanumeric() {
                    c.to_ascii_lowercase()
                } else {
                    '_'
                }
            })
            .take(24)
            .collect();
        if !clean.starts_with(|c: char| c.is_ascii_lowercase()) {
            clean.insert(0, 'v');
        }
        if self.names.insert(clean.clone()) {
            return clean;
        }
        let number = self.next.entry(clean.clone()).or_insert(2);
        loop {
            let candidate = format!("{clean}_{number}");
            *number += 1;
            if self.names.insert(candidate.clone()) {
                return candidate;
            }
        }
    }
}
