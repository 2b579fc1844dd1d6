//! `targets`: what can be compiled for.

use crate::failure::Outcome;
use crate::format::table;
use crate::trial::mode_json;
use crate::{say, say_json};
use serde_json::{Value, json};
use slowlight_compiler::targets;
use slowlight_compiler::targets::{Target, every};

/// Options of `targets`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// Print as JSON
    #[arg(long)]
    json: bool,
}

/// Lists them.
pub fn run(args: &Args) -> Outcome<()> {
    if args.json {
        let all: Vec<Value> = every().map(object).collect();
        return say_json(&Value::Array(all));
    }
    for target in every() {
        let format = formats(target).join(" or ");
        say(&format!(
            "{}: {}; reals are {format}\n",
            target.name, target.about
        ))?;
        let rows: Vec<Vec<String>> = target
            .modes
            .iter()
            .map(|m| {
                let name = match m.name {
                    "" => "  screen".to_owned(),
                    name => format!("  mode {name}"),
                };
                let size = match m.width {
                    0 => "any size".to_owned(),
                    width => format!("{width} x {}", m.height),
                };
                vec![name, size, format!("{} inks", m.inks)]
            })
            .collect();
        say(&table(&rows))?;
    }
    Ok(())
}

fn formats(target: &Target) -> Vec<&'static str> {
    targets::formats(target).map(|t| t.runtime.format).collect()
}

fn object(target: &Target) -> Value {
    let modes: Vec<Value> = target
        .modes
        .iter()
        .map(|m| {
            json!({
                "mode": mode_json(m.name),
                // Null: as large as the picture.
                "width": (m.width > 0).then_some(m.width),
                "height": (m.height > 0).then_some(m.height),
                "inks": m.inks,
            })
        })
        .collect();
    let mut operations: Vec<&str> = target
        .runtime
        .routines
        .iter()
        .map(|r| r.op.name())
        .collect();
    operations.sort_unstable();
    operations.dedup();
    json!({
        "target": target.name,
        "about": target.about,
        "formats": formats(target),
        "hertz": target.hertz,
        "offset": target.offset,
        "operations": operations,
        "modes": modes,
        "columns_only": target.columns_only,
    })
}
