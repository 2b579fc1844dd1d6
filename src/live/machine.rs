//! What a machine is asked for: a scene that has rested is planned, run so that its picture is
//! seen to grow, and counted; one thing at a time.

use super::board::{Board, Pictures, Task, Views};
use super::frontier;
use super::run::{MOST, Run};
use super::shown::{Costs, Machine as State, Panel, Planned, Shown, Stage};
use crate::auto_format;
use crate::draw::{self, Window};
use crate::explain::{self, Explained, error};
use crate::failure::{Failure, Outcome};
use crate::machine::{MachineRun, Sizes};
use crate::measure::differences;
use crate::picture::{FileFormat, Picture};
use crate::scene::{Precision, Scene};
use crate::target_args::ScreenArgs;
use crate::trial::{self, LIMIT};
use crate::unlike::difference;
use crate::{forecast, interrupt};
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::report::profile;
use std::sync::Arc;
use std::time::Duration;
use web_time::Instant;

/// How often a growing picture is shown.
const FRAME: Duration = Duration::from_millis(90);

/// The last plan of each machine, for what is asked of the same run.
pub type Kept = [Last; MOST];

/// The plan of one.
type Last = Option<(u64, PlannedScene)>;

/// Writes the program of a plan; answers the names of its files.
pub type Build<'b> = &'b dyn Fn(&PlannedScene, &ScreenArgs) -> Outcome<Vec<String>>;

/// One thing that is to be done.
struct Work<'w, B> {
    board: &'w B,
    run: &'w Run,
    /// As the run's options have it.
    scene: &'w Scene,
    screen: ScreenArgs,
}

/// Does something for a run, whose scene is right.
///
/// # Errors
/// What the page is to say of it ([`ended`]).
pub fn done<B: Board>(
    board: &B,
    run: &Run,
    scene: &Scene,
    task: Task,
    (kept, build): (&mut Kept, Build<'_>),
) -> Outcome<()> {
    let kept = (kept.get_mut(run.panel)).ok_or(Failure::Interrupted)?;
    let with_options = |work: &mut dyn FnMut(&Work<'_, B>) -> Outcome<()>| {
        let (screen, scene) = run.planned_with(scene)?;
        work(&Work {
            board,
            run,
            scene: &scene,
            screen,
        })
    };
    match task {
        Task::Tune => frontier::search(board, run, scene),
        Task::Run => with_options(&mut |work| work.run(kept)),
        Task::Costs => with_options(&mut |work| work.costs(kept)),
        Task::Build => with_options(&mut |work| work.build(kept, build)),
    }
}

/// How it ended: where it was no run, the last one's picture is what it was before.
pub fn ended<B: Board>(board: &B, run: &Run, (task, before): (Task, Stage), done: Outcome<()>) {
    if task == Task::Tune {
        return frontier::ended(board, run, done);
    }
    let failed = done.err().map(|failure| match failure {
        Failure::Interrupted => None,
        Failure::TooLarge(large) => Some(large.text),
        other => Some(other.reason()),
    });
    if let (Task::Build, Some(why)) = (task, &failed) {
        // Whatever is chosen by now: somebody waits for the files.
        let why = why.clone();
        let why = why.unwrap_or_else(|| "not built: it was stopped".to_owned());
        board.show(|shown, _| shown.build(run.target.name, Vec::new(), Some(why)));
    }
    // Whoever's work it was: no machine runs now.
    board.show(|shown, _| with_panel(shown, run, |panel| panel.machine.at_work = 0));
    board.show_run(run, |shown, _| {
        let stage = match &failed {
            _ if task != Task::Run => before,
            None => Stage::Done,
            Some(None) => Stage::Stopped,
            Some(Some(_)) => Stage::Wrong,
        };
        let why = failed.clone().flatten();
        with_panel(shown, run, |panel| {
            let machine = &mut panel.machine;
            if machine.serial != run.serial {
                // It has failed before anything was shown.
                *machine = machine.begun(run.serial, stage);
            }
            machine.stage = stage;
            if task == Task::Run {
                machine.wrong.clone_from(&why);
            }
        });
        match task {
            Task::Costs if why.is_some() => {
                shown.costs = Costs {
                    panel: run.panel,
                    serial: run.serial,
                    wrong: why,
                    ..shown.costs
                };
            }
            _ => {}
        }
    });
}

/// What is shown of a run's machine.
fn with_panel(shown: &mut Shown, run: &Run, change: impl FnOnce(&mut Panel)) {
    if let Some(panel) = shown.panels.get_mut(run.panel) {
        change(panel);
    }
}

impl<B: Board> Work<'_, B> {
    /// Shows something of the machine, unless a newer run is wanted.
    fn show(&self, change: impl FnOnce(&mut State)) {
        self.show_with(|machine, _| change(machine));
    }

    /// The same with its pictures.
    fn show_with(&self, change: impl FnOnce(&mut State, &mut Views)) {
        let Run { panel, serial, .. } = *self.run;
        self.board
            .show_run(self.run, |shown: &mut Shown, pictures: &mut Pictures| {
                let places = (shown.panels.get_mut(panel)).zip(pictures.machines.get_mut(panel));
                let Some((Panel { machine, .. }, views)) = places else {
                    return;
                };
                if machine.serial != serial {
                    // Another run's figures are none of this one's.
                    *machine = machine.begun(serial, machine.stage);
                }
                change(machine, views);
            });
    }

    /// The run's plan, made or kept.
    fn plan(&self, kept: &mut Last) -> Outcome<PlannedScene> {
        if let Some((serial, plan)) = kept
            && *serial == self.run.serial
        {
            return Ok(plan.clone());
        }
        *kept = None;
        self.show(|machine| machine.stage = Stage::Planning);
        let chosen = auto_format::plan(&self.screen, self.scene, self.run.target)?;
        interrupt::check()?;
        let plan = chosen.plan;
        let planned = Planned {
            target: plan.target.name,
            format: plan.runtime.format,
            mode: plan.mode.name,
            inks: plan.graph.image.palette.len(),
            expected: chosen.why.as_ref().map(|why| why.expected),
            goal: chosen.why.as_ref().map(|why| why.goal),
        };
        self.show(|machine| machine.plan = Some(planned));
        *kept = Some((self.run.serial, plan.clone()));
        Ok(plan)
    }

    /// Runs the program, and counts.
    fn run(&self, kept: &mut Last) -> Outcome<()> {
        self.show(|machine| *machine = machine.begun(self.run.serial, Stage::Planning));
        let plan = self.plan(kept)?;
        let run = self.watched(&plan)?;
        let picture = trial::shown(&plan, run.screen.as_ref())?;
        self.show_picture(&plan, &picture, run.cycles, |_| {})?;
        let graph = (self.scene).graph(Some(plan.mode.inks), Precision::NATIVE)?;
        let window = Window::on_screen(&plan);
        let native = draw::native(&graph, window)?;
        let unlike = differences(window.places(), &picture.inks, &native.pixels).len();
        let image = Arc::new(difference(&picture, &native)?);
        let Sizes { code, tables, ram } = run.sizes;
        self.show_with(|machine, views| {
            views.difference = image;
            machine.stage = Stage::Comparing;
            machine.difference = true;
            machine.bytes = [code, tables, ram];
            machine.pixels = picture.inks.len() as u64;
            machine.unlike_native = Some(unlike as u64);
        });
        let modelled = draw::model_with(&plan, None)?;
        let unlike = differences(window.places(), &picture.inks, &modelled.pixels).len();
        self.show(|machine| machine.unlike_model = Some(unlike as u64));
        Ok(())
    }

    /// Runs the program on its machine, and shows its picture now and then.
    fn watched(&self, plan: &PlannedScene) -> Outcome<MachineRun> {
        let machine = self.screen.machine(plan.target);
        let loaded = trial::build_for(plan, machine)?.loaded;
        let window = Window::on_screen(plan);
        self.show(|machine| {
            machine.stage = Stage::Running;
            machine.at_work = 1;
            machine.size = (window.width(), window.height());
        });
        let mut last = Instant::now();
        let run = trial::ran_watched(plan, loaded, LIMIT, &mut |now| {
            if last.elapsed() < FRAME {
                return;
            }
            last = Instant::now();
            let screen = (now.screen)();
            // Before its first mode is set, a machine's screen does not hold the picture.
            if let Ok(picture) = trial::shown(plan, screen.as_ref()) {
                let rows = trial::rows_drawn(plan, &now).map_or(0, |row| row + 1);
                // A picture that cannot be encoded is not shown; the last one is an error.
                let _ = self.show_picture(plan, &picture, now.cycles, |machine| {
                    machine.rows = rows.min(u64::from(window.height()));
                });
            }
        });
        self.show(|machine| machine.at_work = 0);
        let run = run?;
        self.show(|machine| {
            machine.rows = u64::from(window.height());
            machine.unit = explain::unit(&run);
        });
        Ok(run)
    }

    /// Shows the machine's picture as it is now.
    fn show_picture(
        &self,
        plan: &PlannedScene,
        picture: &Picture,
        cycles: u64,
        more: impl FnOnce(&mut State),
    ) -> Outcome<()> {
        let png = Arc::new(picture.encode(FileFormat::Png)?);
        let hertz = forecast::hertz(plan, self.screen.machine(plan.target));
        self.show_with(|machine, views| {
            views.machine = png;
            machine.picture += 1;
            machine.cycles = cycles;
            machine.seconds = cycles as f64 / hertz;
            more(machine);
        });
        Ok(())
    }

    /// Counts what each line takes.
    fn costs(&self, kept: &mut Last) -> Outcome<()> {
        let plan = self.plan(kept)?;
        self.show(|machine| {
            machine.stage = Stage::Counting;
            machine.at_work = 1;
        });
        let counted = explain::count_lines(self.scene, plan, &self.screen, LIMIT)?;
        let profile = profile::profile(&self.scene.checked, &counted.plan, counted.measured());
        let errors = error::errors(self.scene, &counted.plan)?;
        let found = Explained {
            scene: self.scene.clone(),
            plan: counted.plan,
            run: counted.run,
            profile,
            why: None,
            errors,
        };
        let report = serde_json::to_vec(&found.report());
        let report = Arc::new(report.map_err(|e| Failure::Wrong(e.to_string()))?);
        let Run { panel, serial, .. } = *self.run;
        self.board.show_run(self.run, |shown, pictures| {
            pictures.costs = report;
            shown.costs = Costs {
                panel,
                serial,
                count: shown.costs.count + 1,
                wrong: None,
            }
        });
        Ok(())
    }

    /// Writes the program's files; of a scene that moves the program that goes on, as `build` has
    /// it, though its first picture alone is shown.
    fn build(&self, kept: &mut Last, build: Build<'_>) -> Outcome<()> {
        let moving = self.scene.clone().moving();
        let plan = match moving.graph(None, Precision::NATIVE)?.is_moving() {
            true => {
                self.show(|machine| machine.stage = Stage::Planning);
                let plan = auto_format::plan(&self.screen, &moving, self.run.target)?.plan;
                interrupt::check()?;
                plan
            }
            false => self.plan(kept)?,
        };
        self.show(|machine| machine.stage = Stage::Building);
        let files = build(&plan, &self.screen)?;
        // They are there, whatever is chosen by now.
        (self.board).show(|shown, _| shown.build(self.run.target.name, files, None));
        Ok(())
    }
}
