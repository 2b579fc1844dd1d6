//! `vm`: any program on a bundled machine.

use crate::failure::{Failure, Outcome};
use crate::format::count;
use crate::machine::{File, Machine, complaint, stop_word};
use crate::picture::PictureFile;
use crate::progress::Progress;
use crate::{files, say, say_json};
use clap::ValueEnum;
use serde_json::json;
use slowlight_vm::Stop;
use slowlight_vm::bbc::Dialect;
use std::path::PathBuf;

/// Cycles after which a program is stopped, unless the user says otherwise.
const LIMIT: u64 = 100_000_000_000;

/// Options of `vm`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The machine
    machine: Kind,
    /// The program's files
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Stop after so many cycles of the machine
    #[arg(long, value_name = "CYCLES", default_value_t = LIMIT)]
    limit: u64,
    /// Where to write the screen: .png, .pgm (ink indices) or .pbm (two inks)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print cycles, why it stopped, and the screen's digest as JSON
    #[arg(long)]
    json: bool,
}

/// A machine by its name here.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A BBC BASIC program, as text or tokens, on a BBC Micro
    Bbc,
    /// Assembly (.asm, .s) or a binary with its load address, on the plain machine
    #[value(name = "6502")]
    Mos6502,
}

/// Runs the program to its end.
pub fn run(args: &Args) -> Outcome<()> {
    let output = PictureFile::named(args.output.as_deref())?;
    let machine = match args.machine {
        Kind::Bbc => Machine::Bbc(Dialect::Micro),
        Kind::Mos6502 => Machine::Mos6502,
    };
    let mut program = Vec::new();
    for path in &args.files {
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned());
        program.push(File {
            name: name.unwrap_or_default(),
            bytes: files::read(path)?,
        });
    }
    let mut loaded = machine.load(&program)?;
    let progress = Progress::new("cycles", args.limit);
    let run = loaded.run(args.limit, &mut |now| progress.reach(now.cycles))?;
    drop(progress);
    let picture = run.picture();
    if output.wanted() && run.stop == Stop::Ended {
        match &picture {
            Some(picture) => output.write(picture)?,
            None => return Err(Failure::Wrong("the program showed no picture".to_owned())),
        }
    }
    if args.json {
        // Its own text would spoil the JSON: it goes into it.
        say_json(&json!({
            "cycles": run.cycles,
            "stopped": stop_word(&run.stop),
            "inks_sha256": picture.as_ref().map(|p| p.sha256()),
            "output": String::from_utf8_lossy(&run.output),
        }));
    } else {
        say(&String::from_utf8_lossy(&run.output));
        eprintln!("{} cycles", count(run.cycles));
    }
    match complaint(&run, args.limit) {
        Some(wrong) => Err(Failure::Wrong(wrong)),
        None => Ok(()),
    }
}
