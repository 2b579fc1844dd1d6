//! What everything is called in the generated classes.
//!
//! Fields keep the names that the plan gives its homes, in lower case with
//! underscores; methods have a capital letter in their names, so the two never
//! meet. A param keeps its label whatever happens, unless Jack reserves it.

use super::canvas::Canvas;
use super::in_place::in_place;
use crate::homes::interference::{InPlace, homes};
use crate::ir::graph::*;
use crate::ir::tree::{Place, SubroutineId, tabulated};
use crate::plan::Plan;
use rustc_hash::FxHashMap;
use slowlight_routine::Format;
use std::collections::{BTreeMap, BTreeSet};

/// Words that no variable may have for a name.
const KEYWORDS: &[&str] = &[
    "class",
    "constructor",
    "function",
    "method",
    "field",
    "static",
    "var",
    "int",
    "char",
    "boolean",
    "void",
    "true",
    "false",
    "null",
    "this",
    "let",
    "do",
    "if",
    "else",
    "while",
    "return",
];

/// Classes of the system and of the generated program.
const CLASSES: &[&str] = &[
    "Main", "Float", "Log", "Int", "Math", "String", "Array", "Output", "Screen", "Keyboard",
    "Memory", "Sys",
];

/// Methods of the scene's class.
const METHODS: &[&str] = &[
    "new",
    "setParameters",
    "inRange",
    "makeConstants",
    "makeTables",
    "makeValues",
    "makeErrors",
    "makeRows",
    "nextRow",
    "nextBand",
    "takeParameters",
    "drawPicture",
    "drawRow",
    "drawPixel",
    "reportFloat",
];

/// Those of a picture that moves.
const STEPS: &[&str] = &["showPictures", "readKeys", "takeStep"];

/// Values that can have a static each; more share them.
const SHARED_BEYOND: usize = 100;

/// Names in use, and the fields' names.
pub(super) struct Names {
    /// The scene's class.
    pub class: String,
    /// Each param's label, as the parameter block writes it.
    pub params: Vec<String>,
    /// First and last row to draw.
    pub rows: [String; 2],
    /// The pixel's column and row.
    pub axes: [String; 2],
    homes: FxHashMap<Place, String>,
    tables: BTreeMap<TableId, String>,
    columns: BTreeMap<NodeId, String>,
    turns: BTreeMap<LoopId, String>,
    subroutines: Vec<String>,
    /// The variables of signs, by those of the logarithms.
    signs: BTreeMap<String, String>,
    /// What gathers the screen's words, where the program does.
    pub canvas: Option<Canvas>,
    /// How many places have each variable.
    places: FxHashMap<String, u32>,
    taken: BTreeSet<String>,
}

impl Names {
    pub fn new(plan: &Plan) -> Names {
        let taken = KEYWORDS.iter().chain(CLASSES).chain(METHODS);
        let taken = taken.map(|w| (*w).to_owned());
        let moving = plan.graph.is_moving();
        let more = STEPS.iter().filter(|_| moving).map(|w| (*w).to_owned());
        let mut names = Names {
            class: class_name(&plan.name),
            params: Vec::new(),
            rows: Default::default(),
            axes: Default::default(),
            homes: FxHashMap::default(),
            tables: BTreeMap::new(),
            columns: BTreeMap::new(),
            turns: BTreeMap::new(),
            subroutines: Vec::new(),
            signs: BTreeMap::new(),
            canvas: None,
            places: FxHashMap::default(),
            taken: taken.chain(more).collect(),
        };
        names.taken.insert(names.class.clone());
        names.params = plan.params.iter().map(|p| names.fresh(&p.label)).collect();
        names.rows = ["first_row", "last_row"].map(|n| names.fresh(n));
        names.axes = ["x", "y"].map(|n| names.fresh(n));
        names.canvas = Canvas::new(plan, &mut |name| names.fresh(name));
        // In little memory values share fields, and statics, of which there are few.
        let many = plan.statics && plan.places().len() > SHARED_BEYOND;
        let scarce = plan.tight || many;
        let is_safe = |id| in_place(plan, id);
        let homes = homes(plan, InPlace::Where(&is_safe));
        let mut sharing: FxHashMap<(Format, usize), String> = FxHashMap::default();
        let mut ones: FxHashMap<Place, String> = FxHashMap::default();
        for (place, format) in plan.places() {
            // Copies of each other are one.
            let one = homes.one.get(&place).copied().unwrap_or(place);
            let fresh = || names.fresh(plan.home(one));
            let name = match homes.number.get(&place).filter(|_| scarce) {
                Some(&at) => sharing.entry((format, at)).or_insert_with(fresh).clone(),
                None => ones.get(&one).cloned().unwrap_or_else(fresh),
            };
            ones.entry(one).or_insert_with(|| name.clone());
            *names.places.entry(name.clone()).or_default() += 1;
            names.homes.insert(place, name);
        }
        for id in tabulated(&plan.graph, &plan.tree) {
            let name = format!("{}_by_column", plan.home(Place::Node(id)));
            let name = names.fresh(&name);
            names.columns.insert(id, name);
        }
        for subroutine in &plan.tree.subroutines {
            let name = names.fresh(&format!("do{}", capital(&subroutine.label())));
            names.subroutines.push(name);
        }
        names
    }

    /// A name like this one that nothing else has.
    pub fn fresh(&mut self, wanted: &str) -> String {
        let tries = (2..).map(|n| format!("{wanted}_{n}"));
        let mut tries = std::iter::once(wanted.to_owned()).chain(tries);
        let found = tries.find(|name| !self.taken.contains(name));
        let name = found.unwrap_or_default();
        self.taken.insert(name.clone());
        name
    }

    /// Whether no other place shares a place's variable.
    pub fn is_alone(&self, place: Place) -> bool {
        let sharing = self
            .homes
            .get(&place)
            .and_then(|name| self.places.get(name));
        sharing == Some(&1)
    }

    /// A value's array by columns.
    pub fn column(&self, id: NodeId) -> &str {
        self.columns.get(&id).map_or("unused", String::as_str)
    }

    pub fn home(&self, place: Place) -> &str {
        self.homes.get(&place).map_or("unused", String::as_str)
    }

    /// The variable for the sign of what another has the logarithm of.
    pub fn sign(&mut self, of: &str) -> String {
        if let Some(name) = self.signs.get(of) {
            return name.clone();
        }
        let name = self.fresh(&format!("{of}_plus"));
        self.signs.insert(of.to_owned(), name.clone());
        name
    }

    /// All of them.
    pub fn signs(&self) -> BTreeSet<String> {
        self.signs.values().cloned().collect()
    }

    /// The array of a table.
    pub fn table(&mut self, plan: &Plan, id: TableId) -> String {
        if let Some(name) = self.tables.get(&id) {
            return name.clone();
        }
        let written = plan.graph.tables.get(id.0 as usize).map_or("", |t| &t.name);
        let name = self.fresh(&identifier(written, "table"));
        self.tables.insert(id, name.clone());
        name
    }

    /// The tables that were asked for.
    pub fn tables(&self) -> impl Iterator<Item = (TableId, &str)> {
        self.tables.iter().map(|(id, name)| (*id, name.as_str()))
    }

    /// The counter of a loop's turns.
    pub fn turns(&mut self, of: LoopId) -> String {
        if let Some(name) = self.turns.get(&of) {
            return name.clone();
        }
        let name = self.fresh("turns");
        self.turns.insert(of, name.clone());
        name
    }

    /// The method of a subroutine.
    pub fn subroutine(&self, id: SubroutineId) -> String {
        let found = self.subroutines.get(id.0 as usize);
        found.cloned().unwrap_or_default()
    }

    /// The counters that were asked for.
    pub fn counters(&self) -> impl Iterator<Item = &str> {
        self.turns.values().map(String::as_str)
    }
}

/// Letters, digits and underscores only, a lower-case letter in front.
pub(super) fn identifier(text: &str, otherwise: &str) -> String {
    let clean = |c: char| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '_'
        }
    };
    let name: String = text.chars().map(clean).take(24).collect();
    match name.chars().next() {
        Some(c) if c.is_ascii_lowercase() => name,
        _ => format!("{otherwise}{name}"),
    }
}

/// A word with a capital letter in front.
fn capital(word: &str) -> String {
    let mut chars = word.chars();
    let first = chars.next().map(|c| c.to_ascii_uppercase());
    first.into_iter().chain(chars).collect()
}

/// `two-mirrors` as `TwoMirrors`.
fn class_name(scene: &str) -> String {
    let words = scene.split(|c: char| !c.is_ascii_alphanumeric());
    let name: String = words
        .map(capital)
        .collect::<String>()
        .chars()
        .take(32)
        .collect();
    let starts = name.starts_with(|c: char| c.is_ascii_alphabetic());
    // Some file systems take Main.jack and MAIN.jack for one.
    if starts && !CLASSES.iter().any(|c| c.eq_ignore_ascii_case(&name)) {
        name
    } else {
        format!("Scene{name}")
    }
}
