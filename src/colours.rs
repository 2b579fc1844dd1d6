//! Warnings of inks that a machine's palette lacks.

use crate::diagnostics;
use crate::scene::Scene;
use slowlight_compiler::backend::colours;
use slowlight_compiler::source::Diagnostic;
use slowlight_compiler::targets::Target;

/// What is to be said of the colours in which these targets show a scene, once for each
/// machine.
pub fn warnings(scene: &Scene, targets: &[&Target]) -> Vec<Diagnostic> {
    let image = scene.checked.program.image.as_ref();
    let of = |target: &&Target| colours::remark(image?, target);
    let mut all: Vec<Diagnostic> = Vec::new();
    for said in targets.iter().filter_map(of) {
        if !all.contains(&said) {
            all.push(said);
        }
    }
    all
}

/// Says so on standard error.
pub fn warn(scene: &Scene, target: &Target) {
    let said = warnings(scene, &[target]);
    if !said.is_empty() {
        diagnostics::print(&scene.checked.sources, &said);
    }
}
