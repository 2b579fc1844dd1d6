//! From a scene's file to a graph: reading, parsing, checking, lowering.

mod changes;
mod edited;
mod read;

pub use changes::Changes;
pub use edited::Edit;
pub use read::{STANDARD_INPUT, given, is_standard_input, text, used};

use crate::failure::{Failure, Outcome, Said};
use changes::{options, settable};
use clap::Args;
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::scene;
use slowlight_compiler::sema::{self, Options, Ways};
use slowlight_compiler::source::{Diagnostic, Sources, Span};
use slowlight_compiler::targets::Target;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What a scene knows of the number format that it is computed in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precision {
    /// The self-intersection offset.
    pub offset: f64,
    /// The unit roundoff.
    pub epsilon: f64,
    /// Whether its reals have an exponent.
    pub floats: bool,
    /// Whether they have a mantissa beside it.
    pub mantissas: bool,
}

impl Precision {
    /// Of the native evaluation.
    pub const NATIVE: Precision = Precision {
        offset: 1e-9,
        epsilon: f64::EPSILON / 2.0,
        floats: true,
        mantissas: true,
    };

    /// Of a target.
    pub fn of(target: &Target) -> Precision {
        Precision {
            offset: target.offset,
            epsilon: target.runtime.real.epsilon(),
            floats: !target.runtime.real.is_fixed(),
            mantissas: target.runtime.real.has_mantissa(),
        }
    }

    /// The options of a lowering for it.
    pub fn options(self, options: Options) -> Options {
        Options {
            offset: self.offset,
            epsilon: self.epsilon,
            floats: self.floats,
            mantissas: self.mantissas,
            ..options
        }
    }
}

/// What of a scene is done with less, or otherwise, than it says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Limits {
    /// How many turns loops of the scene's own text take at most.
    pub turns: Option<u32>,
    /// The same of the library's.
    pub steps: Option<u32>,
    /// What is found in another way.
    pub ways: Ways,
}

/// Which scene, and what is changed about it.
#[derive(Args, Clone, Debug)]
pub struct SceneArgs {
    /// The scene's file; - is standard input
    pub scene: PathBuf,
    #[command(flatten)]
    pub changes: Changes,
}

/// Several scenes, and what is changed about each.
#[derive(Args, Clone, Debug)]
pub struct ScenesArgs {
    /// The scenes' files; - is standard input
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    #[command(flatten)]
    pub changes: Changes,
}

/// A scene that was read and found right.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The file's name without extension; names the generated files.
    pub name: String,
    /// Texts, program and warnings.
    pub checked: scene::Scene,
    options: Options,
}

impl Scene {
    /// The names of its params and states that are angles.
    pub fn angles(&self) -> BTreeSet<String> {
        let params = self.checked.program.params.iter();
        let angles = params.filter(|param| param.ty == sema::Ty::Angle);
        angles.map(|param| param.name.clone()).collect()
    }

    /// Whether it moves.
    pub fn has_states(&self) -> bool {
        let mut params = self.checked.program.params.iter();
        params.any(|param| param.next.is_some())
    }

    /// Reads and checks a scene.
    ///
    /// # Errors
    /// Where its file cannot be read, where it is wrong, or where the arguments
    /// name a param or effect that it does not have.
    pub fn load(args: &SceneArgs) -> Outcome<Scene> {
        Scene::open(&args.scene, &args.changes)
    }

    /// Reads and checks one of several scenes.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn open(path: &Path, changes: &Changes) -> Outcome<Scene> {
        let (name, text) = given(path)?;
        Scene::of_text((&name, &text), path, changes, &mut used)
    }

    /// Checks a scene whose text is at hand, by the name that diagnostics give it. Other files
    /// that it uses are read by `read`.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn of_text(
        (name, text): (&str, &str),
        path: &Path,
        changes: &Changes,
        read: scene::Read<'_>,
    ) -> Outcome<Scene> {
        let library = changes.prelude.as_deref().map(read::prelude).transpose()?;
        let checked = scene::load(name, text, library.as_deref(), read);
        if !checked.is_right() {
            return Err(wrong(checked.sources, checked.diagnostics));
        }
        let options = options(changes, &checked.program)?;
        if let Err(said) = settable(&checked.program, &options) {
            let sources = checked.sources;
            return Err(Failure::Options(Box::new(Said {
                sources,
                diagnostics: said,
            })));
        }
        Ok(Scene {
            name: name_of(path),
            options,
            checked,
        })
    }

    /// The same scene with other values for some params.
    ///
    /// # Errors
    /// Where a value is outside its param's range.
    pub fn setting(&self, set: Vec<(String, Vec<f64>)>) -> Outcome<Scene> {
        let options = Options {
            set,
            ..self.options.clone()
        };
        if let Err(said) = settable(&self.checked.program, &options) {
            return Err(self.wrong(said));
        }
        Ok(Scene {
            name: self.name.clone(),
            checked: self.checked.clone(),
            options,
        })
    }

    /// The values that params have in the place of the text's own.
    pub fn values(&self) -> &[(String, Vec<f64>)] {
        &self.options.set
    }

    /// The same scene with an effect replaced by its `else`.
    pub fn leaving_out(&self, effect: &str) -> Scene {
        let mut options = self.options.clone();
        options.without.push(effect.to_owned());
        Scene {
            name: self.name.clone(),
            checked: self.checked.clone(),
            options,
        }
    }

    /// The image's columns and rows.
    pub fn size(&self) -> (u32, u32) {
        self.checked
            .program
            .image
            .as_ref()
            .map_or((1, 1), |i| (i.width, i.height))
    }

    /// How many inks the image has.
    pub fn inks(&self) -> u32 {
        let image = self.checked.program.image.as_ref();
        image.map_or(1, |image| image.palette.len() as u32)
    }

    /// The scene's graph for a screen of so many inks (the image's own where
    /// `None`) and a number format.
    ///
    /// # Errors
    /// Where it does not compile.
    pub fn graph(&self, inks: Option<u32>, precision: Precision) -> Outcome<Graph> {
        self.graph_with(inks, precision, &[])
    }

    /// As [`Scene::graph`], with other values for some params.
    ///
    /// # Errors
    /// Where it does not compile, or a value is outside its param's range.
    pub fn graph_with(
        &self,
        inks: Option<u32>,
        precision: Precision,
        set: &[(String, Vec<f64>)],
    ) -> Outcome<Graph> {
        self.graph_within(inks, precision, set, Limits::default())
    }

    /// As [`Scene::graph`], with ink numbers beyond the screen's inks as they are.
    ///
    /// # Errors
    /// Where it does not compile.
    pub fn graph_of_all_inks(&self, inks: Option<u32>, precision: Precision) -> Outcome<Graph> {
        let options = Options {
            inks,
            all_inks: true,
            ..precision.options(self.options.clone())
        };
        sema::lower(&self.checked.program, &options).map_err(|said| self.wrong(said))
    }

    /// The same with less than the scene has, or otherwise.
    ///
    /// # Errors
    /// As [`Scene::graph_with`].
    pub fn graph_within(
        &self,
        inks: Option<u32>,
        precision: Precision,
        set: &[(String, Vec<f64>)],
        limits: Limits,
    ) -> Outcome<Graph> {
        let mut options = precision.options(self.options.clone());
        options.inks = inks;
        (options.max_turns, options.max_steps) = (limits.turns, limits.steps);
        options.ways = limits.ways;
        options.set.extend_from_slice(set);
        sema::lower(&self.checked.program, &options).map_err(|said| self.wrong(said))
    }

    /// How many shapes the largest of its scenes has.
    pub fn shapes(&self) -> usize {
        sema::most_shapes(&self.checked.program, &self.options)
    }

    /// What the source calls at a place: `sphere` where it has `sphere((0, 0, 0), 1)`.
    pub fn called_at(&self, span: Span) -> Option<String> {
        let (path, _) = self.checked.sources.text(span).split_once('(')?;
        let name = path.rsplit('.').next().unwrap_or(path).trim();
        let word = |c: char| c.is_alphanumeric() || c == '_';
        (!name.is_empty() && path.chars().all(|c| word(c) || c == '.')).then(|| name.to_owned())
    }

    /// The same scene with what is between two pictures, where it moves; its graphs are then of
    /// pictures that follow each other.
    #[must_use]
    pub fn moving(mut self) -> Scene {
        self.options.moves = true;
        self
    }

    /// A failure with something said about this scene.
    pub fn wrong(&self, said: Vec<Diagnostic>) -> Failure {
        wrong(self.checked.sources.clone(), said)
    }

    /// Says the warnings on standard error.
    pub fn warn(&self) {
        if !self.checked.diagnostics.is_empty() {
            crate::diagnostics::print(&self.checked.sources, &self.checked.diagnostics);
        }
    }
}

/// The failure of texts about which something was said.
pub fn wrong(sources: Sources, diagnostics: Vec<Diagnostic>) -> Failure {
    Failure::Scene(Box::new(Said {
        sources,
        diagnostics,
    }))
}

/// A name that every target's files can bear.
fn name_of(path: &Path) -> String {
    if is_standard_input(path) {
        return "stdin".to_owned();
    }
    let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned());
    let clean = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = stem.unwrap_or_default().chars().map(clean).collect();
    if name.is_empty() {
        "scene".to_owned()
    } else {
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_identifiers() {
        assert_eq!(name_of(Path::new("a/two mirrors.scn")), "two_mirrors");
        assert_eq!(name_of(Path::new("..")), "scene");
        assert_eq!(name_of(Path::new("-")), "stdin");
    }
}
