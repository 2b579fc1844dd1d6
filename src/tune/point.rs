//! A point: what a choice came to on its machine, the whole picture.

use super::choice::{Base, Choice};
use super::planned::Planned;
use super::spent::{Spent, spent};
use crate::digest;
use crate::draw::{Drawn, Window, native};
use crate::failure::{Failure, Outcome};
use crate::machine::Sizes;
use crate::measure::{self, Errors};
use crate::picture::FileFormat;
use crate::scene::{Precision, Scene};
use crate::unlike::difference;
use crate::{estimate, trial};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::sync::{Arc, Mutex};

/// A choice and what was measured of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The choice.
    pub choice: Choice,
    /// What was measured.
    pub measured: Measured,
}

/// What a machine and its picture say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The screen's mode.
    pub mode: String,
    /// Inks of the picture there.
    pub inks: usize,
    /// Columns and rows of the picture seen.
    pub size: (u32, u32),
    /// The machine's cycles.
    pub cycles: u64,
    /// Its time in seconds.
    pub seconds: f64,
    /// The cycles that the planner's figures predict.
    pub predicted: f64,
    /// Those of them before the first row.
    pub before: f64,
    /// Bytes of code, tables and memory beside, where they are known.
    pub bytes: [Option<u64>; 3],
    /// Pixels unlike the model's: 0, or something is broken.
    pub differs_from_model: u64,
    /// How far it is from the native picture.
    pub errors: Errors,
    /// What its time goes to, the dearest first; nothing where nobody asked.
    pub spent: Vec<Spent>,
    /// Digest of the program's files.
    pub program_sha256: String,
    /// Digest of the inks, as `run` gives it.
    pub inks_sha256: String,
    /// The picture, as a PNG in base 64.
    pub picture: String,
    /// Where it is other than the native one, the same way.
    pub difference: String,
}

impl Measured {
    /// All bytes that are known.
    pub fn memory(&self) -> u64 {
        self.bytes.iter().flatten().sum()
    }
}

/// By how many inks and which part of the screen is drawn.
type Drawings = HashMap<(u32, [u32; 4]), Arc<Drawn>>;

/// The native pictures that points are held against, by inks and window; each is drawn once.
#[derive(Default)]
pub struct Natives(Mutex<Drawings>);

impl Natives {
    /// The picture of the scene as written, in so many inks.
    ///
    /// # Errors
    /// Only an interruption.
    pub fn of(&self, scene: &Scene, inks: u32, window: Window) -> Outcome<Arc<Drawn>> {
        let Window { columns, rows } = window;
        let key = (inks, [columns.0, columns.1, rows.0, rows.1]);
        let known = |all: &HashMap<_, Arc<Drawn>>| all.get(&key).cloned();
        if let Some(drawn) = self.0.lock().ok().and_then(|all| known(&all)) {
            return Ok(drawn);
        }
        let graph = scene.graph(Some(inks), Precision::NATIVE)?;
        let drawn = Arc::new(native(&graph, window)?);
        if let Ok(mut all) = self.0.lock() {
            all.insert(key, drawn.clone());
        }
        Ok(drawn)
    }
}

/// Runs a plan on its machine, the whole picture; where it is asked for, some rows line by
/// line as well, which takes as long again.
///
/// # Errors
/// Where the program does not end by itself, or shows no picture, or another than its model.
pub fn measure(
    base: &Base,
    scene: &Scene,
    natives: &Natives,
    choice: &Choice,
    planned: Planned,
    (limit, by_line): (u64, bool),
) -> Outcome<Point> {
    let plan = &planned.plan;
    let predicted = planned.cycles();
    let before = estimate::before(plan);
    let spent = match by_line {
        true => spent(scene, &planned, &base.screen(choice), limit)?,
        false => Vec::new(),
    };
    let loaded = trial::build_for(plan, base.screen(choice).machine(plan.target))?.loaded;
    let run = trial::ran(scene, plan, loaded, limit)?;
    let native = natives.of(scene, plan.mode.inks, Window::on_screen(plan))?;
    let modelled = planned.modelled(plan.rows, true)?;
    let program_sha256 = digest::program(plan);
    let tried = trial::held_with(scene, planned.plan, run, (*native).clone(), modelled)?;
    let Some(picture) = &tried.picture else {
        return Err(Failure::Wrong("the program drew nothing".to_owned()));
    };
    let palette = &tried.plan.graph.image.palette;
    let shades = &tried.modelled.pixels;
    let errors = measure::errors(
        picture.width,
        &picture.inks,
        shades,
        &tried.native.pixels,
        palette.len(),
    );
    let Sizes { code, tables, ram } = tried.run.sizes;
    Ok(Point {
        choice: choice.clone(),
        measured: Measured {
            mode: tried.plan.mode.name.to_owned(),
            inks: palette.len(),
            size: (picture.width, picture.height),
            cycles: tried.run.cycles,
            seconds: tried.seconds(),
            predicted,
            before,
            bytes: [code, tables, ram],
            differs_from_model: tried.from_model.as_ref().map_or(0, Vec::len) as u64,
            errors,
            spent,
            program_sha256,
            inks_sha256: picture.sha256(),
            picture: BASE64.encode(picture.encode(FileFormat::Png)?),
            difference: BASE64.encode(difference(picture, &tried.native)?),
        },
    })
}

/// The native picture as a PNG in base 64.
///
/// # Errors
/// Where it cannot be written.
pub fn encoded(drawn: &Drawn) -> Outcome<String> {
    Ok(BASE64.encode(drawn.picture().encode(FileFormat::Png)?))
}
