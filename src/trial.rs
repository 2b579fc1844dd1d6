//! A trial: a scene built for a target, run on its machine, and held against
//! the model and the native evaluation.

use crate::draw::{Drawn, Window, model, native};
use crate::failure::{Failure, Outcome};
use crate::machine::{File, Loaded, Machine, MachineRun, complaint};
use crate::measure::{self, Difference};
use crate::picture::Picture;
use crate::progress::Progress;
use crate::scene::{Precision, Scene};
use crate::tables::table_bytes;
use crate::vcs;
use serde::Serialize;
use serde_json::{Value, json};
use slowlight_compiler::backend::Document;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::planner::PlannedScene;
use slowlight_vm::Screen;

/// Cycles after which a run is given up, unless the user says otherwise.
pub const LIMIT: u64 = 1_000_000_000_000;

/// Cycles a second of the Hack computer's processor in the web IDE's emulator, the
/// machine that most have: the computer was never built for a clock.
pub const HACK_HERTZ: f64 = 7.2e6;

/// A plan written down, and accepted by the machine's own tools.
pub struct Built {
    /// The sources.
    pub sources: Vec<File>,
    /// The program in its machine.
    pub loaded: Loaded,
}

impl Built {
    /// All files of the program, as `build` writes them.
    pub fn files(&self) -> impl Iterator<Item = &File> {
        let loaded = &self.loaded;
        (self.sources.iter())
            .chain(&loaded.system)
            .chain(&loaded.binaries)
    }
}

/// Writes a plan down and gives it to the machine.
///
/// # Errors
/// Where the machine's tools refuse the text, which is a fault of ours.
pub fn build(plan: &Plan) -> Outcome<Built> {
    build_for(plan, Machine::of(plan.target))
}

/// The same for a machine with other options than the target's own.
///
/// # Errors
/// As for [`build`], and where the program is too large for what it is to run on.
pub fn build_for(plan: &Plan, machine: Machine) -> Outcome<Built> {
    build_written(&slowlight_compiler::backend::emit(plan), plan, machine)
}

/// The same for a plan that is written down.
///
/// # Errors
/// As for [`build_for`].
pub fn build_written(documents: &[Document], plan: &Plan, machine: Machine) -> Outcome<Built> {
    if vcs::is_cartridge(plan) {
        let (made, _) = vcs::proved(plan)?;
        let sources = vec![File::text(&made.document.name, &made.document.text)];
        let mut loaded = machine.load(&sources)?;
        loaded.sizes = vcs::sizes(&made);
        return Ok(Built { sources, loaded });
    }
    let sources: Vec<File> = documents
        .iter()
        .map(|d| File::text(&d.name, &d.text))
        .collect();
    let loaded = machine.at_page(plan.page).load(&sources)?;
    Ok(Built { sources, loaded })
}

/// What a trial showed.
pub struct Trial {
    /// The scene's name.
    pub scene: String,
    /// The plan.
    pub plan: PlannedScene,
    /// The machine's counts.
    pub run: MachineRun,
    /// The machine's picture: what was asked for of it, without the screen
    /// around; none where the program was not to draw.
    pub picture: Option<Picture>,
    /// What the model makes of the plan, shades included.
    pub modelled: Drawn,
    /// The native picture in the target's inks.
    pub native: Drawn,
    /// Where machine and model differ; unknown without the machine's picture.
    pub from_model: Option<Vec<Difference>>,
    /// Where machine and native picture differ; unknown without the machine's picture.
    pub from_native: Option<Vec<Difference>>,
    /// Root of the mean square of model shade less native shade.
    pub rmse: f64,
}

/// Runs a program and holds it against its plan. `set` are values that the
/// program's source has instead of the scene's.
///
/// # Errors
/// Where the program does not end by itself, or shows no such picture.
pub fn run(
    scene: &Scene,
    plan: PlannedScene,
    set: &[(String, Vec<f64>)],
    loaded: Loaded,
    limit: u64,
) -> Outcome<Trial> {
    let graph = scene.graph_with(Some(plan.mode.inks), Precision::NATIVE, set)?;
    let run = ran(scene, &plan, loaded, limit)?;
    let native = native(&graph, Window::on_screen(&plan))?;
    held(scene, plan, run, native)
}

/// Runs a program to its end.
///
/// # Errors
/// Where it does not end by itself.
pub fn ran(scene: &Scene, plan: &Plan, loaded: Loaded, limit: u64) -> Outcome<MachineRun> {
    let window = Window::on_screen(plan);
    let progress = Progress::new(
        format!("{} {}", scene.name, plan.target.name),
        u64::from(window.height()),
    );
    ran_watched(plan, loaded, limit, &mut |now| {
        progress.reach(rows_drawn(plan, &now).unwrap_or(0));
    })
}

/// How many of a plan's rows a running program has come past, if it has drawn.
pub fn rows_drawn(plan: &Plan, now: &slowlight_vm::Progress<'_>) -> Option<u64> {
    let top = i64::from(Window::on_screen(plan).rows.0) + i64::from(plan.offset.1);
    let row = i64::from(now.row?) - top;
    Some(u64::try_from(row).unwrap_or(0))
}

/// The same with somebody who watches it run.
///
/// # Errors
/// As for [`ran`].
pub fn ran_watched(
    plan: &Plan,
    mut loaded: Loaded,
    limit: u64,
    watch: &mut dyn FnMut(slowlight_vm::Progress<'_>),
) -> Outcome<MachineRun> {
    let mut run = match vcs::is_cartridge(plan) {
        true => vcs::first_picture(&mut loaded, limit)?,
        false => loaded.run(limit, watch)?,
    };
    if let Some(wrong) = complaint(&run, limit) {
        let name = plan.target.name;
        return Err(Failure::Wrong(format!("{name}: {wrong}")));
    }
    run.sizes.tables = run.sizes.tables.or(Some(table_bytes(plan)));
    Ok(run)
}

/// Holds what a program showed against its plan, and against the native picture of the same
/// pixels.
///
/// # Errors
/// Where it shows no such picture.
pub fn held(scene: &Scene, plan: PlannedScene, run: MachineRun, native: Drawn) -> Outcome<Trial> {
    let modelled = model(&plan)?;
    held_with(scene, plan, run, native, modelled)
}

/// The same, where the model's picture is known.
///
/// # Errors
/// As for [`held`].
pub fn held_with(
    scene: &Scene,
    plan: PlannedScene,
    run: MachineRun,
    native: Drawn,
    modelled: Drawn,
) -> Outcome<Trial> {
    let window = native.window;
    let picture = plan.plot.then(|| shown(&plan, run.screen.as_ref()));
    let picture = picture.transpose()?;
    let differences = |other: &Drawn| {
        let inks = picture.as_ref().map(|p| &p.inks)?;
        Some(measure::differences(window.places(), inks, &other.pixels))
    };
    Ok(Trial {
        scene: scene.name.clone(),
        from_model: differences(&modelled),
        from_native: differences(&native),
        rmse: measure::rmse(&modelled.pixels, &native.pixels),
        plan,
        run,
        picture,
        modelled,
        native,
    })
}

/// The part of the screen that the plan draws, in the picture's inks.
///
/// # Errors
/// Where there is no screen, or it does not hold the picture.
pub fn shown(plan: &Plan, screen: Option<&Screen>) -> Outcome<Picture> {
    if let Some(shape) = vcs::shape(plan) {
        return vcs::picture(plan, &shape, screen);
    }
    let name = plan.target.name;
    let Some(screen) = screen else {
        return Err(Failure::Wrong(format!("{name}: the program drew nothing")));
    };
    let window = Window::on_screen(plan);
    let mut inks = Vec::with_capacity((window.width() * window.height()) as usize);
    for (x, y) in window.places() {
        let column = i64::from(x) + i64::from(plan.offset.0);
        let row = i64::from(y) + i64::from(plan.offset.1);
        let inside = (0..i64::from(screen.width)).contains(&column)
            && (0..i64::from(screen.height)).contains(&row);
        let at = inside.then(|| (row * i64::from(screen.width) + column) as usize);
        match at.and_then(|at| screen.pixels.get(at)) {
            Some(&ink) => inks.push(ink),
            None => {
                let size = format!("{} x {}", screen.width, screen.height);
                return Err(Failure::Wrong(format!(
                    "{name}: the program's screen of {size} pixels does not hold the picture"
                )));
            }
        }
    }
    // A machine whose palette is fixed shows its own colours.
    let mut palette = plan.graph.image.palette.clone();
    for (k, colour) in palette.iter_mut().enumerate() {
        if let Some(&own) = screen.palette.get(k) {
            *colour = own;
        }
    }
    // An ink beyond the picture's shows that something is wrong: it must be visible.
    let most = inks.iter().copied().max().unwrap_or(0);
    for ink in palette.len()..=usize::from(most) {
        palette.push(screen.palette.get(ink).copied().unwrap_or([255, 0, 255]));
    }
    Ok(Picture {
        width: window.width(),
        height: window.height(),
        palette,
        inks,
    })
}

impl Trial {
    /// Pixels counted.
    pub fn pixels(&self) -> u64 {
        self.native.pixels.len() as u64
    }

    /// The machine's time in seconds.
    pub fn seconds(&self) -> f64 {
        let hertz = match self.run.rom_words {
            Some(_) => HACK_HERTZ,
            None => self.plan.target.hertz,
        };
        self.run.cycles as f64 / hertz
    }

    /// Pixels that the program ran: where pixels hang on others, those of other rows, too.
    pub fn pixels_run(&self) -> u64 {
        let (first, last) = self.plan.computed_rows();
        let rows = u64::from(last + 1 - first) * u64::from(self.plan.graph.image.block.1);
        rows * u64::from(self.native.window.width())
    }

    /// Cycles a pixel, of those that were run.
    pub fn cycles_per_pixel(&self) -> f64 {
        self.run.cycles as f64 / self.pixels_run().max(1) as f64
    }

    /// What `run --json` prints.
    pub fn report(&self) -> Report<'_> {
        let plan = &self.plan;
        let run = &self.run;
        let jack = run.vm_instructions.is_some();
        Report {
            scene: &self.scene,
            target: plan.target.name,
            mode: mode_json(plan.mode.name),
            inks: plan.graph.image.palette.len(),
            offset: [plan.offset.0, plan.offset.1],
            format: plan.runtime.format,
            width: self.native.window.width(),
            height: self.native.window.height(),
            pixels: self.pixels(),
            traced: self.modelled.traced,
            cycles: run.cycles,
            plot_cycles: run.plot_cycles,
            cycles_per_pixel: self.cycles_per_pixel(),
            machine_seconds: self.seconds(),
            code_bytes: run.sizes.code,
            table_bytes: run.sizes.tables,
            ram_bytes: run.sizes.ram,
            inks_sha256: self.picture.as_ref().map(Picture::sha256),
            differs_from_model: self.from_model.as_ref().map(Vec::len),
            differs_from_native: self.from_native.as_ref().map(Vec::len),
            rmse: self.rmse,
            psnr: measure::psnr(self.rmse),
            effects: plan.graph.effects.iter().map(|e| e.name.as_str()).collect(),
            vm_instructions: run.vm_instructions,
            os_calls: run.os_calls,
            rom_words: jack.then_some(run.rom_words),
        }
    }
}

/// The object of `run --json`, counted over the rows asked for. What is not
/// known is null; what only Jack has is absent elsewhere.
#[derive(Clone, Debug, Serialize)]
pub struct Report<'t> {
    scene: &'t str,
    target: &'t str,
    /// The machine's number or name for it; null where there is only one.
    mode: Value,
    inks: usize,
    /// Column and row of the screen where the picture's top left stands;
    /// negative where the picture is cropped.
    offset: [i32; 2],
    format: &'t str,
    /// Columns drawn.
    width: u32,
    /// Rows drawn.
    height: u32,
    pixels: u64,
    /// With `--refine` alone: how many of them were traced.
    #[serde(skip_serializing_if = "Option::is_none")]
    traced: Option<u64>,
    cycles: u64,
    /// Of those, what drawing took, where the machine can tell.
    plot_cycles: Option<u64>,
    cycles_per_pixel: f64,
    machine_seconds: f64,
    code_bytes: Option<u64>,
    table_bytes: Option<u64>,
    ram_bytes: Option<u64>,
    /// Null with `--no-plot`, as are the two counts that need the machine's picture.
    inks_sha256: Option<String>,
    differs_from_model: Option<usize>,
    differs_from_native: Option<usize>,
    /// Over shades, model against native.
    rmse: f64,
    /// In dB; null where the shades are equal.
    psnr: Option<f64>,
    effects: Vec<&'t str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    vm_instructions: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    os_calls: Option<u64>,
    /// Null where nothing is translated to Hack machine code.
    #[serde(skip_serializing_if = "Option::is_none")]
    rom_words: Option<Option<u64>>,
}

/// A mode as JSON: its number, its name, or null where there is only one.
pub fn mode_json(name: &str) -> Value {
    match name.parse::<u32>() {
        Ok(number) => json!(number),
        Err(_) if name.is_empty() => Value::Null,
        Err(_) => json!(name),
    }
}
