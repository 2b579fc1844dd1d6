//! How a scene fares in the targets' formats: where it is fragile, and how far
//! its shades are off, proved and measured.

use crate::failure::{Failure, Outcome};
use crate::format;
use crate::interrupt;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::target_args::ScreenArgs;
use serde_json::{Value, json};
use slowlight_compiler::report::bounded::{Bounded, bounded};
use slowlight_compiler::report::{bounces, fragile::fragile, words::warnings};
use slowlight_compiler::source::{Diagnostic, Severity};
use slowlight_compiler::targets::Target;

/// What was found of one target.
pub struct Fared {
    target: &'static Target,
    /// What is proved and measured; or why the scene does not compile.
    shades: Result<Bounded, String>,
    /// Where it is fragile.
    pub said: Vec<Diagnostic>,
    /// Whether a single pixel took all the work that may be done to find that.
    pub unseen: bool,
}

/// The first of the targets with each format.
pub fn formats(targets: impl Iterator<Item = &'static Target>) -> Vec<&'static Target> {
    let mut seen = Vec::new();
    let new = |t: &&Target| {
        let fresh = !seen.contains(&t.runtime.format);
        seen.push(t.runtime.format);
        fresh
    };
    targets.filter(new).collect()
}

fn as_written() -> ScreenArgs {
    ScreenArgs {
        as_written: true,
        ..ScreenArgs::default()
    }
}

/// Looks at a scene in the formats of some targets. A target that it does not
/// compile for is a row of the table, unless it is the only one.
///
/// The formulas are looked at as the scene has them: what the compiler makes of
/// them depends on ranges, and a reader is to know what they lose by themselves.
///
/// # Errors
/// Where the only target cannot compile it, or the user interrupts.
pub fn look(scene: &Scene, targets: &[&'static Target]) -> Outcome<Vec<Fared>> {
    let progress = Progress::new("checking", 2 * targets.len() as u64);
    let mut all = Vec::new();
    for &target in targets {
        interrupt::check()?;
        let plan = match as_written().draft(scene, target) {
            Ok(plan) => plan,
            Err(Failure::Scene(said)) if targets.len() > 1 => {
                let first = said.diagnostics.iter().find(|d| d.is_error());
                let why = first.map_or(String::new(), |d| d.message.clone());
                all.push(Fared {
                    target,
                    shades: Err(why),
                    said: Vec::new(),
                    unseen: false,
                });
                progress.step(2);
                continue;
            }
            Err(other) => return Err(other),
        };
        let (fragile, bounces) = (fragile(&plan), bounces::measure(&plan));
        let mut said = warnings(&plan, &fragile);
        said.extend(bounces::warnings(&plan, &bounces));
        progress.step(1);
        interrupt::check()?;
        all.push(Fared {
            target,
            shades: Ok(bounded(&plan)),
            said,
            unseen: fragile.looked == 0 || bounces.looked == 0,
        });
        progress.step(1);
    }
    Ok(all)
}

/// That of some formats no pixel could be looked at, where it is so: no warning means nothing
/// there.
pub fn unseen(all: &[Fared]) -> Option<String> {
    let unseen = all.iter().filter(|fared| fared.unseen);
    let formats: Vec<&str> = unseen.map(|f| f.target.runtime.format).collect();
    (!formats.is_empty()).then(|| {
        format!(
            "no pixel could be looked at in {}: a single one takes more steps than are run for \
             that",
            formats.join(", ")
        )
    })
}

/// The table: formats against what is proved and what is measured.
pub fn text(all: &[Fared]) -> String {
    let head = [
        "format",
        "target",
        "warnings",
        "pixels",
        "bound proved",
        "within (proved)",
        "off by (measured)",
        "ratio",
    ];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for fared in all {
        let first = [fared.target.runtime.format, fared.target.name].map(str::to_owned);
        let rest = match &fared.shades {
            Err(why) => vec![format!("does not compile: {why}")],
            Ok(shades) => cells(fared, shades),
        };
        rows.push(first.into_iter().chain(rest).collect());
    }
    format::table(&rows) + LEGEND
}

/// What the columns mean.
const LEGEND: &str = "bound proved: of how many of these pixels it is proved how far the shade, 0 to 1, can \
                      be off at most;\nwithin: by no more than this; off by: how far it is; ratio: of \
                      within to off by, the median (docs/precision.md)\n";

fn cells(fared: &Fared, shades: &Bounded) -> Vec<String> {
    let warned = fared
        .said
        .iter()
        .filter(|d| d.severity == Severity::Warning);
    let mut cells = vec![warned.count().to_string(), shades.looked.to_string()];
    if shades.proved == 0 {
        let none = if shades.looked == 0 {
            "no shade"
        } else {
            "of none"
        };
        cells.push(none.to_owned());
        return cells;
    }
    cells.push(format!(
        "{:.1} %",
        100.0 * shades.proved as f64 / shades.looked as f64
    ));
    cells.push(format!("{:.1e}", shades.bound));
    cells.push(format!("{:.1e}", shades.measured));
    cells.push(shades.ratio.map_or(String::new(), |r| format!("{r:.1}")));
    cells
}

/// The same as JSON; shades in parts of 1.
pub fn to_json(all: &[Fared]) -> Value {
    let row = |fared: &Fared| match &fared.shades {
        Err(why) => json!({
            "format": fared.target.runtime.format, "target": fared.target.name, "failure": why,
        }),
        Ok(s) => json!({
            "format": fared.target.runtime.format, "target": fared.target.name,
            "warnings": fared.said.len(), "unseen": fared.unseen, "pixels": s.looked, "proved": s.proved,
            "bound_proved": s.bound, "error_measured": s.measured, "ratio": s.ratio,
        }),
    };
    Value::Array(all.iter().map(row).collect())
}
