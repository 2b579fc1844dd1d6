//! `targets`: what can be compiled for.

use crate::failure::Outcome;
use crate::format::table;
use crate::trial::mode_json;
use crate::{say, say_json};
use serde_json::{Value, json};
use slowlight_compiler::plan::columns::MOST;
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
                let size = match (m.width, target.columns_only) {
                    (0, true) => format!("up to {} x {}", MOST.0, MOST.1),
                    (0, false) => "any size".to_owned(),
                    (width, _) => format!("{width} x {}", m.height),
                };
                vec![name, size, format!("{} inks", m.inks)]
            })
            .collect();
        say(&table(&rows))?;
    }
    let known: Vec<&str> = every().flat_map(formats).collect();
    let told = FORMATS.iter().filter(|(name, _)| known.contains(name));
    let told: String = told
        .map(|(name, what)| format!("  {name:<10}  {what}\n"))
        .collect();
    say(&format!("\nformats of reals (docs/formats.md):\n{told}"))
}

/// How each format holds a real, in a few words.
const FORMATS: [(&str, &str); 11] = [
    ("fixed16.16", "a whole number of 65,536ths, in four bytes"),
    ("fixed12", "as fixed16, in one byte where that is enough"),
    (
        "fixed16",
        "fixed point in 16 bits: each value has its own number of bits behind the point",
    ),
    ("fixed20", "as fixed24, in two bytes where that is enough"),
    (
        "fixed24",
        "fixed point in 24 bits: each value has its own number of bits behind the point",
    ),
    (
        "log10",
        "the logarithm, with ten bits behind the point: quick products, coarse sums",
    ),
    ("log11", "the same with eleven bits"),
    (
        "f316",
        "a float in three words: sign, exponent, and 14 bits of digits, cut off",
    ),
    ("f316r", "the same, rounded to the nearest"),
    (
        "f416",
        "a float in four words, with 28 bits of digits: slow and nearly exact",
    ),
    (
        "real40",
        "a float in five bytes, with 32 bits of digits, as BBC BASIC has them: nearly exact",
    ),
];

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_format_is_told_of() {
        for name in every().flat_map(formats) {
            assert!(FORMATS.iter().any(|(told, _)| *told == name), "{name}");
        }
    }
}
