//! Parts of a survey, for job arrays: each measures every Nth scene on its machine and writes
//! what it found as JSON; joined they are the document that one run writes.

use super::Survey;
use super::by_scene::{ByScene, Written};
use super::section::Section;
use crate::failure::{Failure, Outcome};
use crate::scene::{Changes, Scene};
use crate::tune::goal::Measure;
use crate::{digest, files};
use serde::{Deserialize, Serialize};
use slowlight_compiler::targets::{self, Target};
use std::path::{Path, PathBuf};

/// More is no part of a survey.
const MOST: usize = 256 << 20;

/// Which part of all: `K/N`, from 1/N to N/N.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    part: usize,
    of: usize,
}

impl Shard {
    /// Reads `K/N`.
    ///
    /// # Errors
    /// How it is written.
    pub fn read(text: &str) -> Result<Shard, String> {
        let parts = text.split_once('/');
        let numbers = parts.and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((part, of)) if (1..=of).contains(&part) && of <= 100_000 => Ok(Shard { part, of }),
            _ => Err("write K/N, from 1/N to N/N, as in 3/8".to_owned()),
        }
    }

    /// Whether a scene on a machine, counted from 0 in the document's order, is of this part.
    pub fn has(self, place: usize) -> bool {
        place % self.of == self.part - 1
    }
}

/// What was asked for: it must be the same of all parts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Asked {
    /// The scenes' files.
    pub scenes: Vec<PathBuf>,
    /// The machines' names.
    pub targets: Vec<String>,
    /// Whether they were named, and not just all that there are.
    pub named: bool,
    /// The error that decides.
    pub measure: Measure,
    /// `--settings`, as they were given.
    pub settings: Vec<Written>,
    /// `--limit`, likewise.
    pub limit: Vec<Written>,
}

impl Asked {
    /// The survey of it.
    ///
    /// # Errors
    /// Where a machine is none that there is.
    pub fn survey(&self, (settings, limit): (ByScene, ByScene)) -> Outcome<Survey> {
        let target = |name: &String| -> Outcome<&'static Target> {
            targets::find(name).ok_or_else(|| Failure::Wrong(format!("no target `{name}`")))
        };
        Ok(Survey {
            scenes: self.scenes.clone(),
            targets: self.targets.iter().map(target).collect::<Outcome<_>>()?,
            measure: self.measure,
            settings,
            limit,
            cached: true,
            shard: None,
        })
    }
}

/// A part, as its file holds it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// The version that measured.
    slowlight: String,
    shard: Shard,
    asked: Asked,
    /// The scenes' texts by their digests.
    texts: Vec<String>,
    /// What was found, with places in the document.
    sections: Vec<(usize, Section)>,
}

impl Part {
    /// Of what was found.
    ///
    /// # Errors
    /// Where a scene cannot be read.
    pub fn new(shard: Shard, asked: Asked, sections: Vec<(usize, Section)>) -> Outcome<Part> {
        let texts = asked.scenes.iter().map(|path| written(path));
        Ok(Part {
            slowlight: env!("CARGO_PKG_VERSION").to_owned(),
            shard,
            texts: texts.collect::<Outcome<_>>()?,
            asked,
            sections,
        })
    }

    /// What was found.
    pub fn sections(&self) -> impl Iterator<Item = &Section> {
        self.sections.iter().map(|(_, section)| section)
    }

    /// As a file.
    ///
    /// # Errors
    /// Where it is nothing that JSON can hold.
    pub fn text(&self) -> Outcome<String> {
        let text = serde_json::to_string_pretty(self);
        let text = text.map_err(|e| Failure::Wrong(format!("cannot be written as JSON: {e}")))?;
        Ok(text + "\n")
    }

    fn read(path: &Path) -> Outcome<Part> {
        let bytes = files::read_bounded(path, MOST)?;
        serde_json::from_slice(&bytes).map_err(|e| {
            let name = path.display();
            Failure::Wrong(format!(
                "{name} is no part of a survey, as --shard writes it: {e}"
            ))
        })
    }
}

/// All of a scene's own texts as one digest.
fn written(path: &Path) -> Outcome<String> {
    let scene = Scene::open(path, &Changes::default())?;
    let files = scene.checked.sources.files.iter();
    let own: Vec<&str> = files.filter(|f| !f.library).map(|f| &*f.text).collect();
    Ok(digest::bytes(own.join("\0").as_bytes()))
}

/// Joins parts: what was asked for, and all sections in the document's order.
///
/// # Errors
/// Where a file is no part, is of another survey, or one is missing or there twice.
pub fn joined(paths: &[PathBuf]) -> Outcome<(Asked, Vec<Section>)> {
    let mut first: Option<(&PathBuf, Part)> = None;
    let mut found: Vec<(usize, Section)> = Vec::new();
    let mut there: Vec<Shard> = Vec::new();
    for path in paths {
        let mut part = Part::read(path)?;
        if there.contains(&part.shard) {
            let Shard { part: k, of } = part.shard;
            return wrong(format!("{}: part {k}/{of} is there twice", path.display()));
        }
        there.push(part.shard);
        found.append(&mut part.sections);
        match &first {
            None => first = Some((path, part)),
            Some((other, known)) => {
                let what = match &part {
                    p if p.slowlight != known.slowlight => "another version of slowlight",
                    p if p.shard.of != known.shard.of => "another number of parts",
                    p if p.asked != known.asked => "other scenes, machines or options",
                    p if p.texts != known.texts => "another text of a scene",
                    _ => continue,
                };
                let (a, b) = (path.display(), other.display());
                return wrong(format!("{a} is of {what} than {b}"));
            }
        }
    }
    let Some((_, part)) = first else {
        return wrong("there is no part to join".to_owned());
    };
    let of = part.shard.of;
    let missing = (1..=of).find(|k| !there.contains(&Shard { part: *k, of }));
    if let Some(k) = missing {
        let missing = of - there.len();
        return wrong(format!(
            "{missing} of {of} parts are missing, {k}/{of} first"
        ));
    }
    found.sort_by_key(|(place, _)| *place);
    let whole = part.asked.scenes.len() * part.asked.targets.len();
    let places = found.iter().map(|(place, _)| *place);
    if !places.eq(0..whole) {
        return wrong("these parts are not all of one survey".to_owned());
    }
    let sections = found.into_iter().map(|(_, section)| section);
    Ok((part.asked, sections.collect()))
}

fn wrong<T>(message: String) -> Outcome<T> {
    Err(Failure::Wrong(message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_everything_out_once() {
        for of in 1..6 {
            let all: Vec<Shard> = (1..=of)
                .map(|k| Shard::read(&format!("{k}/{of}")).expect("a shard"))
                .collect();
            for place in 0..20 {
                assert_eq!(all.iter().filter(|s| s.has(place)).count(), 1);
            }
        }
        for text in ["0/3", "4/3", "3", "", "1/0", "-1/3", "a/b", "1/2/3"] {
            assert!(Shard::read(text).is_err(), "{text}");
        }
    }
}
