//! Options that find in another way what a scene asks for: each is read here and written
//! as it was read, so that `tune` can say how its points are had again.

use clap::Args;
use serde::{Deserialize, Serialize};
use slowlight_compiler::sema::{Instancing, Millionths, Search, Ways};

/// Other ways to what the scene asks for.
#[derive(
    Args, Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(into = "Words", try_from = "Words")]
pub struct WayArgs {
    /// Find what rays meet by each shape's own solution (`trace`) or by sphere tracing
    /// (`march:64:0.01`: steps at most, and what is near enough), whichever the scene says.
    /// The native picture keeps to the scene
    #[arg(long, value_name = "WAY", help_heading = "A coarser picture in less time", value_parser = search)]
    pub hits: Option<Search>,
    /// Find normals by comparing the shape at four points so far apart, as in 0.01, where
    /// otherwise its formula is differentiated
    #[arg(long, value_name = "APART", help_heading = "A coarser picture in less time", value_parser = apart)]
    pub differences: Option<Millionths>,
    /// Let no pixel have more than N rays where the library draws it by several (`supersample`,
    /// `depth_of_field`)
    #[arg(long, value_name = "N", help_heading = "A coarser picture in less time", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub samples: Option<u32>,
}

/// Options and their values: as ways are kept.
type Words = Vec<(String, String)>;

impl From<Ways> for WayArgs {
    fn from(ways: Ways) -> WayArgs {
        WayArgs {
            hits: ways.search,
            differences: ways.differences,
            samples: ways.samples,
        }
    }
}

impl From<WayArgs> for Words {
    fn from(args: WayArgs) -> Words {
        let words = args.words().into_iter();
        words
            .map(|(option, value)| (option.to_owned(), value))
            .collect()
    }
}

impl TryFrom<Words> for WayArgs {
    type Error = String;

    fn try_from(words: Words) -> Result<WayArgs, String> {
        let mut args = WayArgs::default();
        for (option, value) in &words {
            match option.as_str() {
                "--hits" => args.hits = Some(search(value)?),
                "--differences" => args.differences = Some(apart(value)?),
                "--samples" => args.samples = Some(value.parse().map_err(|_| "no number")?),
                other => return Err(format!("no way {other}")),
            }
        }
        Ok(args)
    }
}

impl WayArgs {
    /// What they ask the compiler for.
    pub fn ways(&self) -> Ways {
        Ways {
            search: self.hits,
            differences: self.differences,
            samples: self.samples,
            unbounded: false,
            instancing: Instancing::default(),
        }
    }

    /// Each as an option and its value.
    pub fn words(&self) -> Vec<(&'static str, String)> {
        let hits = self.hits.map(|search| match search {
            Search::Trace => "trace".to_owned(),
            Search::March { steps, near } => format!("march:{steps}:{}", near.value()),
        });
        let differences = self.differences.map(|apart| apart.value().to_string());
        let samples = self.samples.map(|n| n.to_string());
        let all = [
            ("--hits", hits),
            ("--differences", differences),
            ("--samples", samples),
        ];
        let given = all.into_iter();
        given.filter_map(|(o, v)| Some((o, v?))).collect()
    }
}

/// Reads `--hits`.
///
/// # Errors
/// Where it is no such way.
pub fn search(text: &str) -> Result<Search, String> {
    let wrong = || {
        "rays find what they meet by `trace` or by `march:STEPS:NEAR`, as in march:64:0.01"
            .to_owned()
    };
    if text == "trace" {
        return Ok(Search::Trace);
    }
    let rest = text.strip_prefix("march:").ok_or_else(wrong)?;
    let (steps, near) = rest.split_once(':').ok_or_else(wrong)?;
    let steps = steps.parse().ok().filter(|n| (1..=65535).contains(n));
    Ok(Search::March {
        steps: steps.ok_or_else(|| "a march takes from 1 to 65535 steps".to_owned())?,
        near: apart(near)?,
    })
}

/// Reads a distance above 0, to six places.
///
/// # Errors
/// Where it is none.
pub fn apart(text: &str) -> Result<Millionths, String> {
    let number = text
        .parse::<f64>()
        .ok()
        .filter(|n| (1e-6..=1000.0).contains(n));
    let millionths = number.map(|n| (n * 1e6).round() as u32);
    millionths
        .map(Millionths)
        .ok_or_else(|| "a distance is from 0.000001 to 1000, as in 0.01".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_are_written_as_they_are_read() {
        for text in ["trace", "march:64:0.01", "march:1:0.000001", "march:9:1000"] {
            let args = WayArgs {
                hits: Some(search(text).expect(text)),
                ..WayArgs::default()
            };
            assert_eq!(args.words(), [("--hits", text.to_owned())]);
            assert_eq!(WayArgs::try_from(Words::from(args)), Ok(args));
        }
        for wrong in [
            "",
            "march",
            "march:0:1",
            "march:2",
            "march:2:0",
            "march:2:nan",
            "traces",
        ] {
            assert!(search(wrong).is_err(), "{wrong}");
        }
        for wrong in ["", "0", "-1", "inf", "1001", "x"] {
            assert!(apart(wrong).is_err(), "{wrong}");
        }
    }
}
