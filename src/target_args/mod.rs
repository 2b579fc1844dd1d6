//! Which machine and screen: the options that choose a target, and the plan
//! that they lead to.

mod columns;
mod heap;
mod items;
mod lowered;
mod machine;
mod passes;
mod post;
mod read;
mod sampling;
mod values;

pub use heap::HeapOf;
pub use passes::{PassArgs, TABLES};
pub use read::*;
pub use sampling::{Refining, refining};
pub use values::*;

use columns::of_columns;
use items::items;

use crate::failure::{Failure, Outcome};
use crate::fit;
use crate::interrupt;
use crate::machine::Machine;
use crate::progress::Waiting;
use crate::scene::Scene;
use crate::toot;
use crate::ways::WayArgs;
use clap::Args;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::planner::{PlannedScene, SEARCH};
use slowlight_compiler::planner::{plan_among, plan_as_written, plan_with_every_shade};
use slowlight_compiler::sema::Instancing;
use slowlight_compiler::targets::{self, Language, Mode, Target};
use std::sync::Once;

/// Screen and rows.
#[derive(Args, Clone, Debug, Default)]
pub struct ScreenArgs {
    /// The screen's mode, as in 1 or hires (see `slowlight targets`) [default: the best]
    #[arg(long, value_name = "N")]
    pub mode: Option<String>,
    /// Only these rows of the picture, both ends included, as in 0..19
    #[arg(long, value_name = "A..B")]
    pub rows: Option<String>,
    /// Compute all pixels and draw none: what arithmetic alone takes
    #[arg(long)]
    pub no_plot: bool,
    /// Jack's operating system: `native`, the VM's own, or `jack`, ours in Jack, which
    /// makes a program for the processor's ROM [default: native]
    #[arg(long, value_name = "OS")]
    pub os: Option<Os>,
    /// How BASIC is written: `fast`, `listing`, to be read, or `toot`, to be posted; for the
    /// 6502 `listing` writes a file more: its memory, its routines, and the code below the
    /// scene's lines, with its cycles [default: fast]
    #[arg(long, value_name = "STYLE")]
    pub style: Option<Style>,
    /// The format that reals are held in, as in log10 or fixed16 (`slowlight targets` says
    /// which there are) [default: the quickest that is within --error]
    #[arg(long, value_name = "F", help_heading = "How numbers are held")]
    pub format: Option<String>,
    /// What share of the pixels may have another ink than the native picture, as in 0.5% or
    /// 0.005, where no --format is given: the quickest format within it is taken [default: 1%]
    #[arg(long, value_name = "E", help_heading = "How numbers are held", value_parser = share, conflicts_with = "format")]
    pub error: Option<f64>,
    /// The same in a word: `fast` 3%, `balanced` 1%, `exact` 0.1%
    #[arg(long, value_name = "GOAL", help_heading = "How numbers are held", conflicts_with_all = ["format", "error"])]
    pub goal: Option<ErrorGoal>,
    /// Whether sines and cosines that change from pixel to pixel are looked up in tables
    /// [default: where the picture stays within --error; where a --format of more than 16 bits is
    /// asked for, no]
    #[arg(long, value_name = "TABLES", help_heading = "How numbers are held")]
    pub tables: Option<Tables>,
    /// Where programs begin on a BBC Micro, in hexadecimal: 1900 with a disc, E00 without
    /// [default: 1900; a program that needs more is at E00, where its disc moves it]
    #[arg(long, value_name = "PAGE", value_parser = page)]
    pub page: Option<u16>,
    /// On the 6502 targets: opcodes that the data sheet leaves out, where two instructions
    /// become one. Every NMOS 6502 has them (a BBC Micro, a Commodore 64); a CMOS 6502 (65C02,
    /// as in a Master) has others in their places
    #[arg(long)]
    pub undocumented: bool,
    /// Compute once for N x N or W x H pixels, as in 4 or 4x2, and draw them as a block: the
    /// shade is that of the block's middle. The picture must be whole blocks
    #[arg(long, value_name = "N|WxH", help_heading = "A coarser picture in less time", value_parser = block)]
    pub block: Option<(u32, u32)>,
    /// Trace every Nth row (2, 4, 8 or 16), and between them only pixels whose neighbours differ
    /// by more than TOL of white, as in 8 or 8:0.05; the others lie between [TOL: 0.031]
    #[arg(long, value_name = "N[:TOL]", help_heading = "A coarser picture in less time", value_parser = refining)]
    pub refine: Option<Refining>,
    /// Let no loop that the scene writes (bounces, say) take more than N turns on the
    /// machine; its `else` then says what it comes to. The native picture keeps them all
    #[arg(long, value_name = "N", help_heading = "A coarser picture in less time", value_parser = turns)]
    pub max_turns: Option<u32>,
    /// The same for the library's loops: marches, walks through maps, searches for hits
    #[arg(long, value_name = "N", help_heading = "A coarser picture in less time", value_parser = turns)]
    pub max_steps: Option<u32>,
    /// Other ways to what the scene asks for.
    #[command(flatten)]
    pub ways: WayArgs,
    /// Passes of the planner that are left out.
    #[command(flatten)]
    pub passes: PassArgs,
    /// Rewrite nothing, neither for accuracy nor for speed: every formula as the scene has it
    #[arg(long, help_heading = "To see what the compiler does (docs/passes.md)")]
    pub as_written: bool,
    /// Compute each pixel's whole shade even where its ink is known without, to compare
    #[arg(long, help_heading = "To see what the compiler does (docs/passes.md)")]
    pub every_shade: bool,
    /// Make subroutines of what the program has several times, even where it fits without
    #[arg(long, help_heading = "To see what the compiler does (docs/passes.md)")]
    pub outlined: bool,
    /// Spend less memory (on tables, say) for speed, from 0, the default, to 6
    #[arg(long, value_name = "STEP", help_heading = "To see what the compiler does (docs/passes.md)", value_parser = thrift)]
    pub thrift: Option<u8>,
    /// How shapes that are alike may be found.
    #[arg(skip)]
    pub instancing: Instancing,
    /// What may be done where it is one way of many; what is cut short is refused then.
    #[arg(skip)]
    pub fuel: Option<Among>,
}

/// Whether a target is one of those in machine code of the 6502.
pub fn is_6502(target: &Target) -> bool {
    target.system.language() == Language::Assembly
}

impl ScreenArgs {
    /// The machine that a target's programs run on, as these options have it.
    pub fn machine(&self, target: &Target) -> Machine {
        let machine = Machine::of(target).at_page(self.page);
        match self.os {
            Some(Os::Jack) => machine.on_processor(),
            Some(Os::Native) | None => machine,
        }
    }

    /// The plan that spends as little memory on speed as was asked for, or as it can.
    fn thrifty(&self, plan: PlannedScene) -> PlannedScene {
        let last = plan.thrifts().saturating_sub(1);
        let usual = if self.is_toot() { toot::THRIFT } else { 0 };
        let step = usize::from(self.thrift.unwrap_or(usual)).min(last);
        match step {
            0 => plan,
            step => (plan.thriftier(step))
                .and_then(|made| plan.completed(made))
                .unwrap_or(plan),
        }
    }

    /// The best mode of a target for a picture.
    ///
    /// # Errors
    /// Where the target has no mode of that name.
    pub fn mode(&self, target: &'static Target, scene: &Scene) -> Outcome<Mode> {
        let modes = self.modes(target, scene)?;
        let first = modes.first().copied();
        first.ok_or_else(|| Failure::Wrong(format!("{} has no screen", target.name)))
    }

    /// The modes to try: the one asked for, else the best first.
    ///
    /// # Errors
    /// Where the target has no mode of that name.
    pub fn modes(&self, target: &'static Target, scene: &Scene) -> Outcome<Vec<Mode>> {
        let (width, height) = scene.size();
        let Some(name) = &self.mode else {
            return Ok(targets::modes_for(target, width, height, scene.inks()));
        };
        let found = target.modes.iter().find(|m| m.name == name);
        let found = found.map(|mode| vec![targets::shown_in(target, mode, width, height)]);
        found.ok_or_else(|| {
            let names: Vec<&str> = target
                .modes
                .iter()
                .map(|m| m.name)
                .filter(|n| !n.is_empty())
                .collect();
            let what = format!("{} has no mode {name}", target.name);
            Failure::Usage(match names.is_empty() {
                true => format!("{what}: its screen has one mode"),
                false => format!("{what}; its modes are {}", names.join(", ")),
            })
        })
    }

    /// The target with the format of reals that was asked for.
    ///
    /// # Errors
    /// Where it has no such format.
    fn formatted(&self, target: &'static Target) -> Outcome<&'static Target> {
        let Some(name) = &self.format else {
            return Ok(target);
        };
        let mut all = targets::formats(target);
        all.find(|t| t.runtime.format == name).ok_or_else(|| {
            let names: Vec<&str> = targets::formats(target).map(|t| t.runtime.format).collect();
            let message = format!(
                "{} has no format {name}; it has {}",
                target.name,
                names.join(", ")
            );
            Failure::Usage(message)
        })
    }

    /// The same where the options say all there is to say of the machine's memory.
    fn plan_as_asked(
        &self,
        scene: &Scene,
        target: &'static Target,
        set: &[(String, Vec<f64>)],
    ) -> Outcome<PlannedScene> {
        let target = self.formatted(target)?;
        let modes = self.modes(target, scene)?;
        let (_waiting, _blind) = (Waiting::new("planning"), interrupt::blind());
        let name = |span| scene.called_at(span);
        let plan = self.smaller(scene, |by, taken| {
            let made = |mode, fuel| {
                let (plan, by) = by.plan_in((mode, fuel), scene, target, set)?;
                taken(by);
                match plan.was_cut() && self.fuel.is_some() {
                    true => Err(fit::too_dear()),
                    false => Ok(plan),
                }
            };
            fit::fit_within(
                modes.clone(),
                &made,
                &name,
                self.fuel.map_or(fit::FIT, |fuel| fuel.fit),
            )
        })?;
        if plan.was_cut() && self.fuel.is_some() {
            return Err(fit::too_dear());
        }
        if plan.was_cut() {
            say_cut();
        }
        match self.os {
            Some(Os::Jack) => fit::fit_rom(plan, self.machine(target), &name),
            _ if self.is_toot() => Ok(toot::shortest(plan)),
            _ => fit::with_disc(plan),
        }
    }

    /// The share of pixels that may be wrong in a format that nobody asked for.
    pub fn error_goal(&self) -> f64 {
        let goal = self.goal.unwrap_or(ErrorGoal::Balanced);
        self.error.unwrap_or(goal.share())
    }

    /// A plan of the whole picture without a search, whether or not its program fits.
    ///
    /// # Errors
    /// As for [`ScreenArgs::draft`].
    pub fn unsearched(&self, scene: &Scene, target: &'static Target) -> Outcome<PlannedScene> {
        let mode = self.mode(target, scene)?;
        let whole = ScreenArgs {
            rows: None,
            ..self.clone()
        };
        Ok(whole.plan_in((mode, 0), scene, target, &[])?.0)
    }

    /// Plans a scene for the best mode, whether or not its program fits.
    ///
    /// # Errors
    /// Where the scene does not compile for it, or the options do not fit.
    pub fn draft(&self, scene: &Scene, target: &'static Target) -> Outcome<PlannedScene> {
        let target = self.formatted(target)?;
        let mode = self.mode(target, scene)?;
        let _blind = interrupt::blind();
        Ok(self.plan_in((mode, SEARCH), scene, target, &[])?.0)
    }

    /// A plan for a mode by so much fuel, and how shapes are found in it.
    fn plan_in(
        &self,
        (mode, fuel): (Mode, u64),
        scene: &Scene,
        target: &'static Target,
        set: &[(String, Vec<f64>)],
    ) -> Outcome<(PlannedScene, Instancing)> {
        // Whoever wanted it may have stopped the work: a plan takes a second, and a format many.
        interrupt::check()?;
        self.check_machine(target)?;
        self.check_toot(target)?;
        self.check_columns(target)?;
        let (_, height) = scene.size();
        let block = self.block.unwrap_or((1, 1));
        let asked = self.rows.as_deref().map(|r| rows(r, height)).transpose()?;
        let asked = asked.map(|asked| blocks_of(asked, block.1)).transpose()?;
        let goal = Goal {
            name: scene.name.clone(),
            mode,
            rows: asked,
            plot: !self.no_plot,
        };
        let (graph, taken) = self.lowered(scene, target, &goal, set)?;
        let graph = self.sampled(&graph)?;
        let planned = match (self.as_written, self.every_shade) {
            (true, _) => plan_as_written(&graph, target, &goal),
            (_, true) => plan_with_every_shade(&graph, target, &goal),
            _ => {
                let fuel = (fuel, self.fuel.map_or(u64::MAX, |fuel| fuel.modelled));
                plan_among(&graph, target, &goal, fuel, self.left_out(target))
            }
        };
        let planned = planned.map(|plan| self.thrifty(plan));
        let planned = match self.outlined {
            true => planned.and_then(|plan| plan.outlined(&|span| scene.called_at(span))),
            false => planned,
        };
        let mut plan = planned.map_err(|said| scene.wrong(said))?;
        of_columns(scene, &plan)?;
        let basic = target.system.language() == Language::Basic;
        plan.listing = basic && self.style == Some(Style::Listing);
        plan.toot = self.is_toot();
        plan.page = self.page;
        plan.undocumented = self.undocumented;
        plan.statics = self.os == Some(Os::Jack);
        // A listing has remarks before what comes from another line of the scene.
        let draw = scene.checked.program.draw.as_ref();
        plan.drawn = draw.map(|draw| draw.span).filter(|_| !plan.listing);
        if plan.listing {
            plan.items = items(&scene.checked.program);
        }
        match asked {
            // The screen is lower than the picture, and these are cropped away.
            Some(asked) if asked != plan.rows => Err(Failure::Usage(format!(
                "--rows {}: this screen shows rows {}..{} of the picture",
                self.rows.as_deref().unwrap_or_default(),
                seen(height, mode.height).0,
                seen(height, mode.height).1
            ))),
            _ => Ok((plan, taken)),
        }
    }
}

/// Says once that a search was ended: a table of many plans says it of all of them.
fn say_cut() {
    static SAID: Once = Once::new();
    SAID.call_once(|| {
        eprintln!(
            "note: the search for a quick program ended at the work that it may do (a large \
             scene, or a nest of loops): there may be a quicker one"
        );
    });
}

/// The rows of a picture that a screen shows: the middle ones.
fn seen(picture: u32, screen: u32) -> (u32, u32) {
    let first = picture.saturating_sub(screen).div_ceil(2);
    (first, first + picture.min(screen).max(1) - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_are_hexadecimal() {
        assert_eq!(page("E00"), Ok(0xe00));
        assert_eq!(page("&1900"), Ok(0x1900));
        for wrong in ["", "19", "e01", "8000", "d00", "g00", "-e00"] {
            assert!(page(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn rows_include_both_ends() {
        assert_eq!(rows("9..239", 240).ok(), Some((9, 239)));
        assert_eq!(rows("9..=10", 240).ok(), Some((9, 10)));
        assert_eq!(rows("7", 240).ok(), Some((7, 7)));
        for wrong in ["", "..", "1..", "3..2", "0..240", "a..b", "-1..2"] {
            assert!(
                matches!(rows(wrong, 240), Err(Failure::Usage(_))),
                "{wrong}"
            );
        }
    }
}
