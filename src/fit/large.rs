//! Modes whose programs are too large: by how much, and what would help.

use crate::failure::{Failure, TooLarge};
use crate::need::{Need, room_in};
use slowlight_compiler::ir::graph::Table;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::Mode;

/// A mode whose programs are too large.
pub(super) struct Large {
    pub mode: Mode,
    /// What the search found first.
    pub quick: Option<PlannedScene>,
    /// The smallest plan, if one was made: a mode may be passed over, as what the programs of
    /// another mode take says what its own do.
    pub plan: Option<PlannedScene>,
    /// What the smallest program takes without subroutines for what is done at each pixel, and
    /// the smallest with them, if it was written.
    pub plain: Need,
    pub outlined: Option<Need>,
}

impl Large {
    pub fn new(plan: PlannedScene, plain: Need) -> Large {
        Large {
            mode: plan.mode,
            quick: None,
            plan: Some(plan),
            plain,
            outlined: None,
        }
    }

    /// What a line about it begins with: its mode, and whether it was measured in another.
    fn mode(&self) -> String {
        let about = if self.plan.is_none() { "about " } else { "" };
        match self.mode.name {
            "" => about.to_owned(),
            name => format!("mode {name}: {about}"),
        }
    }

    /// What the smallest program takes.
    pub fn least(&self) -> &Need {
        match &self.outlined {
            Some(outlined) if outlined.total() < self.plain.total() => outlined,
            _ => &self.plain,
        }
    }
}

/// What programs of a mode take by what the least of others' take, if that is too much by far:
/// they differ by how inks are told and plotted.
pub(super) fn beyond_in<'n>(
    mode: Mode,
    others: impl Iterator<Item = &'n Need>,
    large: &[Large],
) -> Option<Need> {
    let least = others.min_by_key(|need| need.total())?;
    let plan = large.iter().find_map(|large| large.plan.as_ref())?;
    let need = least.in_room(room_in(plan, mode)?);
    need.exceeds(32).then_some(need)
}

/// By how much a scene's programs are too large in each mode, and what would help.
pub(super) fn too_large(large: &[Large]) -> Failure {
    let Some(plan) = large.iter().rev().find_map(|large| large.plan.as_ref()) else {
        return Failure::Wrong("there is no mode to draw in".to_owned());
    };
    let mut said = String::new();
    for large in large {
        said.push_str(&format!("\n  {}{}", large.mode(), large.least().text()));
    }
    let nearest = large.iter().min_by_key(|large| large.least().excess());
    Failure::TooLarge(Box::new(TooLarge {
        text: format!(
            "{} does not fit {}:{said}\n{}",
            plan.name,
            plan.target.name,
            help(plan)
        ),
        least: nearest.map_or(String::new(), |large| {
            format!("{}{}", large.mode(), large.least().short())
        }),
    }))
}

/// What makes a program smaller.
pub fn help(plan: &PlannedScene) -> String {
    let mut ways = Vec::new();
    let effects: Vec<&str> = plan.graph.effects.iter().map(|e| e.name.as_str()).collect();
    if !effects.is_empty() {
        ways.push(format!(
            "leave an effect out (--without {})",
            effects.join(", ")
        ));
    }
    if !plan.params.is_empty() {
        ways.push("fold the params (--freeze all)".to_owned());
    }
    if plan.graph.diffusion.is_some() {
        ways.push("dither by a matrix, which keeps no rows of errors".to_owned());
    }
    if plan.graph.refinement.is_some() {
        ways.push("keep fewer rows (a smaller N of --refine)".to_owned());
    }
    let large = |t: &Table| t.entries.len() > 1000;
    if plan.graph.tables.iter().any(large) {
        ways.push("make tables smaller".to_owned());
    }
    ways.push("draw fewer shapes, or more of one kind: what is alike is written once".to_owned());
    format!("what would help: {}", ways.join("; "))
}
