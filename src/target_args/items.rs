//! What a scene consists of, for the remarks of a listing.

use slowlight_compiler::sema::{FunctionKind, Program};
use slowlight_compiler::source::Span;

/// A scene's items, the library's included: where each stands, and what to call
/// it; nothing for those that compute nothing.
pub fn items(program: &Program) -> Vec<(Span, String)> {
    let from = |library: bool| if library { " (library)" } else { "" };
    let functions = program.functions.iter().map(|f| {
        let kind = match f.kind {
            FunctionKind::Effect { .. } => "effect",
            FunctionKind::Dither => "dither",
            _ => "fn",
        };
        (f.span, format!("{kind} {}{}", f.name, from(f.library)))
    });
    let shapes = program.shapes.iter();
    let shapes = shapes.map(|s| (s.span, format!("shape {}{}", s.name, from(s.library))));
    let scenes = program
        .scenes
        .iter()
        .map(|s| (s.span, format!("scene {}", s.name)));
    let draw = program.draw.iter().map(|d| (d.span, "draw".to_owned()));
    let params = program.params.iter().map(|p| (p.span, String::new()));
    let consts = program.consts.iter().map(|c| (c.span, String::new()));
    let all = functions.chain(shapes).chain(scenes).chain(draw);
    all.chain(params).chain(consts).collect()
}
