//! `survey`: several scenes tuned on several machines, as one document with plots.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::scene::is_standard_input;
use crate::survey::by_scene::{self, ByScene, Written};
use crate::survey::document::document;
use crate::survey::part::{self, Asked, Part, Shard};
use crate::survey::section::Section;
use crate::survey::survey;
use crate::target_args;
use crate::tune::goal::Measure;
use slowlight_compiler::targets::{TARGETS, Target};
use std::path::{Path, PathBuf};

/// Options of `survey`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The scenes' files
    #[arg(required_unless_present = "merge", value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// A machine, as in jack or 6502:c64; said again, more; all where none is named
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: Vec<&'static Target>,
    /// The document to write, in Markdown; with --shard the part, as JSON
    #[arg(short, long, value_name = "FILE.md")]
    output: PathBuf,
    /// Do only the Kth of N parts of the work, as in 1/8, and write what was found as a part for
    /// --merge (docs/tune.md)
    #[arg(long, value_name = "K/N", value_parser = Shard::read, conflicts_with = "pictures")]
    shard: Option<Shard>,
    /// Join the parts that --shard wrote, all N of them, to the document that one run writes
    #[arg(long, value_name = "PART", num_args = 1..,
          conflicts_with_all = ["scenes", "target", "measure", "settings", "limit", "no_cache", "shard"])]
    merge: Vec<PathBuf>,
    /// The directory for its plots, beside or below the document [default: the document's]
    #[arg(long, value_name = "DIR")]
    pictures: Option<PathBuf>,
    /// The error that decides
    #[arg(long, value_enum, value_name = "MEASURE", default_value_t)]
    measure: Measure,
    /// How many settings, of blocks and loops, are tried in each format: SCENE=N for that
    /// scene alone, SCENE/TARGET=N on that machine alone [default: 5]
    #[arg(long, value_name = "N", value_parser = settings)]
    settings: Vec<Written>,
    /// Measure everything anew, and keep nothing for the next time
    #[arg(long)]
    no_cache: bool,
    /// Give a choice up after so many cycles of the machine: SCENE=CYCLES where that scene
    /// alone is meant, SCENE/TARGET=CYCLES on that machine alone; of several the last counts.
    /// What is given up is told [default: 20000000000]
    #[arg(long, value_name = "CYCLES", value_parser = limit)]
    limit: Vec<Written>,
}

/// A machine runs so many cycles in a minute or so of the host's time.
const LIMIT: u64 = 20_000_000_000;

/// Settings are so many at most.
const SETTINGS: u64 = 200;

/// Reads `--limit`.
fn limit(text: &str) -> Result<Written, String> {
    by_scene::read(text, u64::MAX, ("cycles", 5_000_000_000))
}

/// Reads `--settings`.
fn settings(text: &str) -> Result<Written, String> {
    by_scene::read(text, SETTINGS, ("a number", 8))
}

/// Tunes all, then writes the document and its plots, or a part, whole or not at all; or joins
/// parts.
pub fn run(args: &Args) -> Outcome<()> {
    if args.scenes.iter().any(|path| is_standard_input(path)) {
        let message = "plots are named after scenes: give their files, not standard input";
        return Err(Failure::Usage(message.to_owned()));
    }
    let beside = args.output.parent().unwrap_or(Path::new(""));
    let directory = args.pictures.as_deref().unwrap_or(beside);
    // Any way begins with the nothing that stands before a file in the working directory.
    let way = directory.strip_prefix(beside).ok();
    let way = way.filter(|way| way.is_relative()).ok_or_else(|| {
        let (own, plots) = (args.output.display(), directory.display());
        Failure::Usage(format!(
            "--pictures {plots}: plots stand beside or below {own}"
        ))
    })?;
    // What is not there is made in the end; an hour's work is not to be lost by what cannot be.
    files::may_hold(beside)?;
    files::may_hold(directory)?;
    if beside.exists() || beside.as_os_str().is_empty() {
        files::may_write(&args.output)?;
    }
    alike(&args.scenes)?;
    let (asked, sections) = match args.merge.is_empty() {
        false => part::joined(&args.merge)?,
        true => {
            let asked = args.asked();
            let mut all = asked.survey(numbers(&asked))?;
            (all.cached, all.shard) = (!args.no_cache, args.shard);
            let found = survey(&all)?;
            if let Some(shard) = args.shard {
                return parted(args, beside, Part::new(shard, asked, found)?);
            }
            let sections = found.into_iter().map(|(_, section)| section);
            (asked, sections.collect())
        }
    };
    let pictures = match way.as_os_str().is_empty() {
        true => String::new(),
        false => format!("{}/", way.display()),
    };
    let all = asked.survey(numbers(&asked))?;
    let text = document(&all, &sections, &own(args, &asked), &pictures);
    let plots: Vec<(PathBuf, String)> = (sections.iter())
        .map(|s| (directory.join(s.picture()), format!("{}\n", s.svg)))
        .collect();
    let mut files: Vec<(&Path, &[u8])> = (plots.iter())
        .map(|(path, svg)| (path.as_path(), svg.as_bytes()))
        .collect();
    files.push((&args.output, text.as_bytes()));
    for made in [beside, directory] {
        files::make(made)?;
    }
    files::write_all(&files)?;
    held(sections.iter())
}

/// Writes a part.
fn parted(args: &Args, beside: &Path, part: Part) -> Outcome<()> {
    files::make(beside)?;
    files::write(&args.output, part.text()?.as_bytes())?;
    held(part.sections())
}

/// Fails where a program's pixels were not its model's.
fn held<'s>(mut sections: impl Iterator<Item = &'s Section>) -> Outcome<()> {
    match sections.any(|s| s.wrong > 0) {
        true => Err(Failure::Differs),
        false => Ok(()),
    }
}

/// The settings and the limits of what was asked for.
fn numbers(asked: &Asked) -> (ByScene, ByScene) {
    (
        ByScene::new("settings", 5, &asked.settings),
        ByScene::new("limit", LIMIT, &asked.limit),
    )
}

impl Args {
    /// What is asked for; all machines where none is named.
    fn asked(&self) -> Asked {
        let targets: &[&Target] = match self.target.is_empty() {
            true => TARGETS,
            false => &self.target,
        };
        Asked {
            scenes: self.scenes.clone(),
            targets: targets.iter().map(|t| t.name.to_owned()).collect(),
            named: !self.target.is_empty(),
            measure: self.measure,
            settings: self.settings.clone(),
            limit: self.limit.clone(),
        }
    }
}

/// Plots are named after scenes, so two of one name would have one.
///
/// # Errors
/// Which they are.
fn alike(scenes: &[PathBuf]) -> Outcome<()> {
    for (k, scene) in scenes.iter().enumerate() {
        let same = |other: &&PathBuf| other.file_stem() == scene.file_stem();
        if let Some(other) = scenes[..k].iter().find(same) {
            let (a, b) = (other.display(), scene.display());
            let message = format!("{a} and {b} have one name, and plots are named after scenes");
            return Err(Failure::Usage(message));
        }
    }
    Ok(())
}

/// The command that writes the same document.
fn own(args: &Args, asked: &Asked) -> String {
    let mut words = vec!["slowlight survey".to_owned()];
    words.extend(asked.scenes.iter().map(|s| s.display().to_string()));
    let named = asked.targets.iter().filter(|_| asked.named);
    words.extend(named.map(|t| format!("--target {t}")));
    if asked.measure != Measure::default() {
        let name = format!("{:?}", asked.measure).to_lowercase();
        words.push(format!("--measure {name}"));
    }
    let (settings, limit) = numbers(asked);
    words.extend(settings.words());
    words.extend(limit.words());
    words.push(format!("-o {}", args.output.display()));
    words.extend(
        args.pictures
            .iter()
            .map(|p| format!("--pictures {}", p.display())),
    );
    words.join(" ")
}
