//! What variables, constants and tables are called.

use super::Style;
use crate::homes::interference::{InPlace, homes};
use crate::ir::graph::NodeId;
use crate::ir::tree::{Place, SubroutineId, tabulated};
use crate::plan::Plan;
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::{Format, Type};
use std::collections::BTreeSet;

/// Names of everything in the program.
pub struct Names {
    homes: FxHashMap<Place, String>,
    /// The params, in the plan's order.
    params: Vec<String>,
    /// Copies of params in variables that may be renamed.
    copies: Vec<Option<String>>,
    pub tables: Vec<String>,
    /// Arrays by columns.
    columns: FxHashMap<NodeId, String>,
    /// Of the pass over a row.
    pub pass: String,
    /// Of the procedures for subroutines.
    procedures: Vec<String>,
    taken: FxHashSet<String>,
    /// Constants by their text, in order of first use.
    constants: Vec<(String, String)>,
}

/// What a name ends in.
fn suffix(ty: Type) -> &'static str {
    if ty == Type::Real { "" } else { "%" }
}

impl Names {
    pub fn new(plan: &Plan) -> Names {
        let mut names = Names {
            homes: FxHashMap::default(),
            params: Vec::new(),
            copies: vec![None; plan.graph.params.len()],
            tables: Vec::new(),
            columns: FxHashMap::default(),
            pass: String::new(),
            procedures: Vec::new(),
            taken: FxHashSet::default(),
            constants: Vec::new(),
        };
        names.pass = names.unique("pass", "%");
        for p in &plan.graph.params {
            // In capitals `COUNT` and `TOp` would hold keywords, and `X%` is
            // the picture's own; no machine here knows keywords in small letters.
            let name = names.unique(&p.label().to_ascii_lowercase(), suffix(p.ty));
            names.params.push(name);
        }
        // Values share variables where names are short: few are quick, and small.
        let shared = (Style::of(plan) != Style::Listing).then(|| homes(plan, InPlace::Copies));
        let mut sharing: FxHashMap<(Format, usize), String> = FxHashMap::default();
        for (place, format) in plan.places() {
            let mut fresh = || names.unique(plan.home(place), suffix(format.scalar()));
            let name = match shared.as_ref().and_then(|s| s.number.get(&place)) {
                Some(&at) => sharing.entry((format, at)).or_insert_with(fresh).clone(),
                None => fresh(),
            };
            names.homes.insert(place, name);
        }
        if let (Some(shared), Some(ink)) = (shared, plan.place(plan.graph.ink)) {
            let one = shared.one.get(&ink).copied();
            for (place, _) in shared.one.iter().filter(|(_, own)| Some(**own) == one) {
                names.homes.insert(*place, "I%".to_owned());
            }
        }
        for table in &plan.graph.tables {
            let clean: String = table
                .name
                .chars()
                .filter(|c| c.is_ascii_alphanumeric() || *c == '_')
                .map(|c| c.to_ascii_lowercase())
                .take(16)
                .collect();
            let clean = if clean.starts_with(|c: char| c.is_ascii_lowercase()) {
                clean
            } else {
                format!("table{clean}")
            };
            // With its bracket, an array's name is its own.
            let name = names.unique(&clean, &format!("{}(", suffix(table.ty)));
            names.tables.push(name.trim_end_matches('(').to_owned());
        }
        for id in tabulated(&plan.graph, &plan.tree) {
            let suffix = format!("{}(", suffix(plan.graph.ty(id)));
            let name = names.unique(plan.home(Place::Node(id)), &suffix);
            names
                .columns
                .insert(id, name.trim_end_matches('(').to_owned());
        }
        for (k, subroutine) in plan.tree.subroutines.iter().enumerate() {
            // Procedures have names of their own, short where memory is.
            let letter = u8::try_from(k).ok().filter(|k| *k < 26).map(|k| b'a' + k);
            let short = Style::of(plan) != Style::Listing;
            let name = match letter.filter(|_| short) {
                Some(letter) => char::from(letter).to_string(),
                None => names.unique(&format!("do_{}", subroutine.label()), ""),
            };
            names.procedures.push(name);
        }
        names
    }

    /// A name that is not taken yet.
    pub fn unique(&mut self, base: &str, suffix: &str) -> String {
        let mut name = format!("{base}{suffix}");
        let mut number = 2;
        while !self.taken.insert(name.clone()) {
            name = format!("{base}_{number}{suffix}");
            number += 1;
        }
        name
    }

    pub fn param(&self, at: usize) -> &str {
        self.params.get(at).map_or("0", String::as_str)
    }

    /// A value's array by columns.
    pub fn column(&self, id: NodeId) -> &str {
        self.columns.get(&id).map_or("unused", String::as_str)
    }

    /// The procedure of a subroutine.
    pub fn procedure(&self, id: SubroutineId) -> &str {
        self.procedures
            .get(id.0 as usize)
            .map_or("unused", String::as_str)
    }

    /// A copy of a param, whose own name is long.
    pub fn copy(&mut self, at: usize) -> String {
        if let Some(Some(name)) = self.copies.get(at) {
            return name.clone();
        }
        let param = self.param(at).to_owned();
        let suffix = if param.ends_with('%') { "%" } else { "" };
        let name = self.unique(&format!("copy_{}", param.trim_end_matches('%')), suffix);
        if let Some(copy) = self.copies.get_mut(at) {
            *copy = Some(name.clone());
        }
        name
    }

    /// The assignment of a param's copy, if it has one.
    pub fn copied(&self, at: usize) -> Option<String> {
        let copy = self.copies.get(at)?.as_ref()?;
        Some(format!("{copy}={}", self.param(at)))
    }

    /// Assignments of all copies of params.
    pub fn copies(&self) -> impl Iterator<Item = String> + '_ {
        let pairs = self.copies.iter().zip(&self.params);
        pairs.filter_map(|(copy, param)| Some(format!("{}={param}", copy.as_ref()?)))
    }

    /// The variables of what is true or false.
    pub fn flags(&self, plan: &Plan) -> BTreeSet<String> {
        let flag = |place: Place| plan.place_format(place).scalar() == Type::Bool;
        let all = self.homes.iter().filter(|(place, _)| flag(**place));
        all.map(|(_, name)| name.clone()).collect()
    }

    /// Gives a place another variable.
    pub fn rename(&mut self, place: Place, name: &str) {
        self.homes.insert(place, name.to_owned());
    }

    pub fn home(&self, place: Place) -> &str {
        self.homes.get(&place).map_or("unused", String::as_str)
    }

    /// The variable of a decimal constant.
    pub fn constant(&mut self, text: &str) -> String {
        let known = |(t, name): &&(String, String)| t == text && !name.ends_with('%');
        if let Some((_, name)) = self.constants.iter().find(known) {
            return name.clone();
        }
        // 0.3 is c0_3; what would be long is numbered.
        let spelt: String = text
            .chars()
            .map(|c| match c {
                '.' => '_',
                '-' => 'm',
                c => c.to_ascii_lowercase(),
            })
            .collect();
        let name = if spelt.len() <= 6 {
            self.unique(&format!("c{spelt}"), "")
        } else {
            let number = self.constants.len() + 1;
            self.unique(&format!("c_{number}"), "")
        };
        self.constants.push((text.to_owned(), name.clone()));
        name
    }

    /// The variable of a whole constant.
    pub fn whole(&mut self, text: &str) -> String {
        let known = |(t, name): &&(String, String)| t == text && name.ends_with('%');
        if let Some((_, name)) = self.constants.iter().find(known) {
            return name.clone();
        }
        let spelt = text.replace('-', "m");
        let name = self.unique(&format!("c{spelt}"), "%");
        self.constants.push((text.to_owned(), name.clone()));
        name
    }

    /// Assignments of all constants used.
    pub fn constants(&self) -> impl Iterator<Item = String> + '_ {
        self.constants
            .iter()
            .map(|(text, name)| format!("{name}={text}"))
    }
}
