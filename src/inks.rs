//! What is said where a screen has fewer inks than the scene's ink numbers need, or a machine
//! shorter ints.

use crate::draw::Window;
use crate::failure::Outcome;
use crate::format::count;
use crate::scene::{Precision, Scene};
use slowlight_compiler::plan::Plan;
use slowlight_compiler::report::domain;
use slowlight_compiler::report::inks::{Beyond, beyond};
use slowlight_compiler::source::Diagnostic;
use std::collections::BTreeMap;

/// Columns and rows of the pixels that are looked at, at most.
const SIDE: u32 = 32;

/// A screen: what it is called, and how many inks it has; none for the picture's own.
pub type Screen = (String, Option<u32>);

/// Warnings for ink numbers that some screens clip, one a place in the scene.
///
/// # Errors
/// Where the scene does not compile.
pub fn warnings(scene: &Scene, screens: &[Screen], window: Window) -> Outcome<Vec<Diagnostic>> {
    let mut by_inks: BTreeMap<usize, (Option<Beyond>, Vec<&str>)> = BTreeMap::new();
    let places = window.grid(SIDE);
    for (name, inks) in screens {
        let graph = scene.graph_of_all_inks(*inks, Precision::NATIVE)?;
        let shown = graph.image.palette.len();
        let (_, names) = by_inks
            .entry(shown)
            .or_insert_with(|| (beyond(&graph, &places), Vec::new()));
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    let mut said: Vec<Diagnostic> = Vec::new();
    for (inks, (found, names)) in by_inks {
        let Some(found) = found else {
            continue;
        };
        let last = inks.saturating_sub(1);
        let what = format!(
            "{}: {} of {} pixels looked at have a number above {last}",
            names.join(", "),
            count(found.pixels as u64),
            count(found.looked as u64)
        );
        if let Some(known) = said.iter_mut().find(|d| d.span == found.span) {
            known.label = format!("{}; {what}", known.label);
            continue;
        }
        let message = format!(
            "ink numbers go up to {} where there are {inks} inks: all above {last} look like {last}",
            found.greatest
        );
        let help = "let a dither make the ink of a shade from 0 to 1, as \
                    `threshold(v, bayer(4)[x mod 4, y mod 4])` or `floyd(v, x, y)` do, or count \
                    with `inks`, which is what the screen has";
        said.push(
            Diagnostic::warning(found.span, message)
                .label(what)
                .help(help),
        );
    }
    Ok(said)
}

/// Says on standard error what the screen of a plan clips, and where its machine's ints do.
///
/// # Errors
/// As for [`warnings`].
pub fn warn(scene: &Scene, plan: &Plan) -> Outcome<()> {
    let screen = (plan.target.name.to_owned(), Some(plan.mode.inks));
    let mut said = warnings(scene, &[screen], Window::on_screen(plan))?;
    if plan.target.runtime.int.bits() < 32 {
        let graph = scene.graph(Some(plan.mode.inks), Precision::NATIVE)?;
        let sources = &scene.checked.sources;
        said.extend(domain::int_warning(&graph, sources, plan.target));
    }
    crate::diagnostics::print(&scene.checked.sources, &said);
    Ok(())
}
