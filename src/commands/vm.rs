//! `vm`: any program on a bundled machine.

mod frames;

use crate::failure::{Failure, Outcome};
use crate::format::{count, table};
use crate::machine::{
    Board, File, HackConfig, Loaded, Machine, Mos6502Config, address, complaint, stop_word,
};
use crate::output::remark;
use crate::picture::{Picture, PictureFile};
use crate::progress::Progress as Bar;
use crate::target_args::{HeapOf, Os, page};
use crate::{files, keys, say, say_json};
use clap::ValueEnum;
use serde::Serialize;
use slowlight_vm::Progress;
use slowlight_vm::bbc::{self, Config, LineCost};
use slowlight_vm::mos6502::Dialect;
use std::path::{Path, PathBuf};

/// Cycles after which a program is stopped, unless the user says otherwise.
const LIMIT: u64 = 100_000_000_000;

/// Options of `vm`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The machine
    machine: Kind,
    /// The program's files; for Jack and Hack also a directory of them
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
    /// Translate Jack or VM code to machine code, and run that on the CPU, with the
    /// operating system in Jack as far as the program brings none itself
    #[arg(long)]
    cpu: bool,
    /// For Jack and VM code on the VM, where the program brings no operating system:
    /// `native`, the VM's own, or `jack`, ours in Jack [default: native; jack with --cpu]
    #[arg(long, value_name = "OS")]
    os: Option<Os>,
    /// The heap of the native operating system: that of VM emulators, or what the official
    /// system leaves as `.vm` files [default: built-in]
    #[arg(long, value_name = "SYSTEM")]
    heap: Option<HeapOf>,
    /// Where to write the Hack computer's machine code: .asm, or .hack, an image of
    /// the ROM
    #[arg(long, value_name = "FILE")]
    image: Option<PathBuf>,
    /// Print what each line of a BASIC program took
    #[arg(long, conflicts_with = "json")]
    profile: bool,
    /// Where a BASIC program begins, in hexadecimal: 1900 with a disc, E00 without
    /// [default: 1900]
    #[arg(long, value_name = "PAGE", value_parser = page)]
    page: Option<u16>,
    /// Whose BASIC and screen [default: micro]
    #[arg(long, value_name = "DIALECT")]
    dialect: Option<Basic>,
    /// How 6502 assembly is written [default: ca65]
    #[arg(long, value_name = "SYNTAX")]
    syntax: Option<Syntax>,
    /// Where a binary for the 6502 is loaded, which does not say so itself: 0x2000 (also
    /// `$2000`, `&2000`), or 8192
    #[arg(long, value_name = "ADDR", value_parser = address)]
    at: Option<u16>,
    /// Where a program for the 6502 begins, if not with its first byte
    #[arg(long, value_name = "ADDR", value_parser = address)]
    start: Option<u16>,
    /// How many frames an Atari VCS shows; all of them become a film where -o is a .gif
    /// [default: 60, or as many as the keys' script has]
    #[arg(long, value_name = "N")]
    frames: Option<u32>,
    #[command(flatten)]
    keys: keys::KeyArgs,
}

/// A way to write assembly that the bundled assembler reads.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Syntax {
    /// As ca65 with `--feature pc_assignment`, and most others, have it
    Ca65,
    /// As beebasm has it
    Beebasm,
}

/// Whose BASIC a program is for.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Basic {
    /// BBC Micro, BASIC II
    Micro,
    /// Agon Light, BBC BASIC (Z80)
    Agon,
    /// Matrix Brandy and others with BASIC V
    Basicv,
}

impl Basic {
    fn config(self) -> Config {
        let dialect = match self {
            Basic::Micro => bbc::Dialect::Micro,
            Basic::Agon => bbc::Dialect::Agon,
            Basic::Basicv => bbc::Dialect::BasicV,
        };
        Config {
            dialect,
            ..Config::default()
        }
    }
}

/// A machine by its name here.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Jack classes (.jack), on the Hack computer's VM with a native OS
    Jack,
    /// VM code (.vm), on the same; or assembly (.asm) or an image of the ROM
    /// (.hack), on the Hack computer's CPU
    Hack,
    /// A BBC BASIC program, as text, as tokens or on a disc (.ssd), on a BBC Micro
    /// unless --dialect says another
    Bbc,
    /// Assembly (any text), a .prg, or a binary with --at, on the plain machine
    #[value(name = "6502", alias = "6502:plain")]
    Mos6502,
    /// The same, or a disc (.ssd), on a BBC Micro without its ROMs, where assembly is loaded
    /// at &1900 or above
    #[value(name = "6502:bbc")]
    MosBbc,
    /// The same on a Commodore 64 without its ROMs, with a line of BASIC that starts it
    #[value(name = "6502:c64")]
    MosC64,
    /// A cartridge of 2K to 32K, or assembly of one, on an Atari VCS
    #[value(name = "6502:vcs")]
    MosVcs,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Report {
    /// VM instructions on the Hack VM.
    cycles: u64,
    /// Instructions in the Hack CPU's ROM.
    #[serde(skip_serializing_if = "Option::is_none")]
    rom_words: Option<u64>,
    /// `ended`, `limit` or `fault`.
    stopped: &'static str,
    /// Null where the program showed no picture.
    inks_sha256: Option<String>,
    /// What it printed: beside the JSON it would spoil it.
    output: String,
}

/// The files named, and for a directory those in it that the machine reads.
fn paths(args: &Args) -> Outcome<Vec<PathBuf>> {
    let extension = match args.machine {
        Kind::Jack => "jack",
        Kind::Hack => "vm",
        _ => return Ok(args.files.clone()),
    };
    let mut all = Vec::new();
    for path in &args.files {
        if path.is_dir() {
            all.extend(files::list(path, extension)?);
        } else {
            all.push(path.clone());
        }
    }
    Ok(all)
}

/// Runs a BASIC program and prints a line for each of its lines that was run.
fn profile(loaded: &mut Loaded, limit: u64) -> Outcome<()> {
    let (run, lines) = loaded.profile(limit)?;
    let share = |cycles: u64| 100.0 * cycles as f64 / run.cycles.max(1) as f64;
    let row = |l: &LineCost| {
        vec![
            l.line.to_string(),
            format!("{} times", count(l.times)),
            format!("{} cycles", count(l.cycles)),
            format!("{:.1}%", share(l.cycles)),
        ]
    };
    let rows: Vec<Vec<String>> = lines.iter().filter(|l| l.times > 0).map(row).collect();
    say(&table(&rows))?;
    say(&format!("{} cycles\n", count(run.cycles)))?;
    complaint(&run, limit).map_or(Ok(()), |wrong| Err(Failure::Wrong(wrong)))
}

/// Writes the binary that has the extension of `path`.
fn write_image(path: &Path, loaded: &Loaded) -> Outcome<()> {
    let extension = path.extension().map(|e| e.to_string_lossy().into_owned());
    let wanted = |file: &&File| {
        let end = file.name.rsplit_once('.').map(|(_, e)| e);
        end.is_some() && end == extension.as_deref()
    };
    let Some(file) = loaded.binaries.iter().find(wanted) else {
        let message = "--image is for machine code that is made, with --cpu or from .asm: a .hack file, and with --cpu also an .asm";
        return Err(Failure::Usage(message.to_owned()));
    };
    files::write(path, &file.bytes)
}

/// Options that the machine, or what it runs, does not have.
///
/// # Errors
/// Bytes of a line of BASIC at most.
const LINE: usize = 255;

/// Where a BASIC program of ours begins, as the remark on its first line says.
fn said_page(args: &Args, program: &File) -> Option<u16> {
    let basic = args.machine == Kind::Bbc && args.dialect.unwrap_or(Basic::Micro) == Basic::Micro;
    let first = program.bytes.get(..program.bytes.len().min(LINE))?;
    let text = String::from_utf8_lossy(first);
    let (line, behind) = text.split_once(" at PAGE &")?;
    let digits: String = behind.chars().take_while(char::is_ascii_hexdigit).collect();
    let ours = basic && line.contains("by slowlight for");
    page(&digits).ok().filter(|_| ours)
}

/// Where one is given: whose it is, and how it is used there.
fn check_options(args: &Args) -> Outcome<()> {
    let basic = args.machine == Kind::Bbc;
    let placed = matches!(args.machine, Kind::Mos6502 | Kind::MosBbc | Kind::MosC64);
    let assembles = placed || args.machine == Kind::MosVcs;
    let hack = matches!(args.machine, Kind::Jack | Kind::Hack);
    let is_code = |path: &PathBuf| path.extension().is_some_and(|e| e == "asm" || e == "hack");
    let wrong = [
        (
            args.page.is_some() && !basic,
            "--page is the BBC Micro's: `slowlight vm bbc --page E00 FILE`",
        ),
        (
            args.dialect.is_some() && !basic,
            "--dialect is BBC BASIC's: `slowlight vm bbc --dialect agon FILE`",
        ),
        (
            args.syntax.is_some() && !assembles,
            "--syntax is the 6502's: `slowlight vm 6502 --syntax beebasm FILE`",
        ),
        (
            (args.at.is_some() || args.start.is_some()) && !placed,
            "--at and --start are the 6502's: `slowlight vm 6502 --at 0x2000 FILE`",
        ),
        (
            args.frames.is_some() && args.machine != Kind::MosVcs,
            "--frames is the Atari VCS's: `slowlight vm 6502:vcs --frames 60 FILE`",
        ),
        (
            args.cpu && !hack,
            "--cpu is the Hack computer's: `slowlight vm jack --cpu DIR`",
        ),
        (
            args.os.is_some() && !hack,
            "--os is the Hack computer's: `slowlight vm jack --os jack DIR`",
        ),
        (
            args.cpu && args.os == Some(Os::Native),
            "the native operating system is the VM's; the CPU has --os jack",
        ),
        (
            hack && args.heap.is_some() && args.files.iter().any(is_code),
            "--heap is the native operating system's, which the VM has; .asm and .hack are the CPU's",
        ),
    ];
    match wrong.iter().find(|(is_wrong, _)| *is_wrong) {
        Some((_, message)) => Err(Failure::Usage((*message).to_owned())),
        None => Ok(()),
    }
}

/// Runs the program to its end.
pub fn run(args: &Args) -> Outcome<()> {
    check_options(args)?;
    let film = frames::film(args)?;
    let output = match film {
        Some(_) => PictureFile::named(None)?,
        None => PictureFile::named(args.output.as_deref())?,
    };
    let on = |board| {
        let dialect = match args.syntax {
            Some(Syntax::Beebasm) => Dialect::Beebasm,
            Some(Syntax::Ca65) | None => Dialect::Common,
        };
        Machine::Mos6502(Mos6502Config {
            board,
            dialect,
            at: args.at,
            start: args.start,
        })
    };
    let machine = match args.machine {
        Kind::Jack | Kind::Hack => Machine::Hack(HackConfig {
            cpu: args.cpu,
            os: args.os == Some(Os::Jack),
            ..HackConfig::default()
        }),
        Kind::Bbc => Machine::Bbc(args.dialect.unwrap_or(Basic::Micro).config()),
        Kind::Mos6502 => on(Board::Plain),
        Kind::MosBbc => on(Board::Bbc),
        Kind::MosC64 => on(Board::C64),
        Kind::MosVcs => on(Board::Vcs),
    };
    let machine = HeapOf::of(args.heap, args.os, machine)?;
    let (keyboard, limit) = match args.machine {
        Kind::MosVcs => frames::keyboard(args, film.is_some())?,
        _ => (args.keys.keyboard(machine)?, args.limit),
    };
    let hack = machine.many_sources();
    let mut program = Vec::new();
    for path in paths(args)? {
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned());
        program.push(File {
            name: name.unwrap_or_default(),
            bytes: files::read(&path)?,
        });
    }
    let page = args.page.or_else(|| said_page(args, program.first()?));
    let mut loaded = machine.at_page(page).load(&program)?;
    for warning in loaded.warnings() {
        eprintln!("warning: {warning}");
    }
    if let Some(path) = &args.image {
        write_image(path, &loaded)?;
    }
    if args.profile {
        return profile(&mut loaded, args.limit);
    }
    let progress = Bar::new("cycles", limit);
    let reach = &mut |now: Progress<'_>| progress.reach(now.cycles);
    let (run, keyboard) = loaded.play(keyboard, limit, reach)?;
    drop(progress);
    let picture = run.picture();
    // Also where the program was stopped: many draw, and then wait for ever.
    if let Some(picture) = &picture {
        output.write(picture)?;
    }
    if args.json {
        say_json(&Report {
            cycles: run.cycles,
            rom_words: hack
                .then_some(run.sizes.code)
                .flatten()
                .map(|code| code / 2),
            stopped: stop_word(&run.stop),
            inks_sha256: picture.as_ref().map(Picture::sha256),
            output: String::from_utf8_lossy(&run.output).into_owned(),
        })?;
    } else {
        say(&String::from_utf8_lossy(&run.output))?;
        remark(&format!("{} cycles", count(run.cycles)));
    }
    let shots = match &film {
        Some(film) => frames::write(film, &keyboard),
        None => keys::write_shots(&keyboard),
    };
    match keys::waits(&run, limit, &keyboard) {
        Some(wrong) => Err(Failure::Wrong(match shots {
            Err(Failure::Wrong(missed)) => format!("{wrong}\n{missed}"),
            _ => wrong,
        })),
        None if shots.is_err() => shots,
        None if output.wanted() && picture.is_none() => {
            Err(Failure::Wrong("the program showed no picture".to_owned()))
        }
        None => Ok(()),
    }
}
