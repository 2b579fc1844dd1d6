//! Cartridges for an Atari VCS: how long the timer must have for the next slice of their work is
//! proved from the program, and what the beam drew is read as the scene's picture.

use crate::failure::{Failure, Outcome};
use crate::machine::{Loaded, MachineRun, Sizes};
use crate::picture::Picture;
use slowlight_compiler::backend::Document;
use slowlight_compiler::backend::mos6502::vcs::{
    ASKED, CONVERT, CROSSED, Cartridge, LEAST, PUBLISH, PUBLISHED, Shape, WORK, cartridge,
};
use slowlight_compiler::plan::Plan;
use slowlight_compiler::targets::System;
use slowlight_vm::Screen;
use slowlight_vm::keys::{Keyboard, Script, Unit};
use slowlight_vm::mos6502::assemble;
use slowlight_vm::mos6502::worst::Question;
use std::collections::{BTreeMap, BTreeSet};

/// Cycles of a tick of the timer.
const TICK: u64 = 64;

/// Cycles between a look at the timer and the begin of the kernel, beside a slice: the look that
/// comes late, the call through banks, and the kernel's own first look.
const LOOK: u64 = 4 + 2 + 2 + 6 + 4 + 6 + 7;

/// Ticks that each part of a frame has for the work at least.
const PART: u64 = 50;

/// What is proved of a cartridge's work.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// The most cycles between two looks at the timer.
    pub slice: u64,
    /// The same behind each look, by its label.
    pub behind: BTreeMap<String, u64>,
    /// And where playfield was made.
    pub published: u64,
    /// The most cycles of making playfield of the columns.
    pub convert: u64,
}

/// Whether a plan is for such a machine.
pub fn is_cartridge(plan: &Plan) -> bool {
    plan.target.system == System::Vcs
}

/// A plan's cartridge, with what its timer must have.
///
/// # Errors
/// Where it is none, or no bound of its slices is found.
pub fn proved(plan: &Plan) -> Outcome<(Cartridge, Proof)> {
    let wrong = |why: String| Failure::Wrong(format!("{}: {why}", plan.target.name));
    let mut made = cartridge(plan).map_err(wrong)?;
    let proof = proof(&made.document).map_err(wrong)?;
    let ticks = |cycles: u64| (cycles + LOOK).div_ceil(TICK) + 1;
    let publish = ticks(proof.published + proof.convert);
    if publish.max(ticks(proof.slice)) > PART {
        return Err(wrong(format!(
            "a slice of its work takes up to {} cycles, for which a frame has no room",
            proof.slice
        )));
    }
    set(&mut made.document, PUBLISH, publish);
    // Each look asks for as much as the slice behind it takes.
    let mut least = None;
    let lines = made.document.text.lines().map(|line| {
        let slice = line.strip_suffix(':').and_then(|at| proof.behind.get(at));
        least = slice.copied().or(least);
        match line.starts_with(LEAST).then(|| least.take()).flatten() {
            Some(cycles) => format!("{LEAST}{}\n", ticks(cycles)),
            None => format!("{line}\n"),
        }
    });
    made.document.text = lines.collect();
    Ok((made, proof))
}

/// Gives a symbol that a document assigns another number.
fn set(document: &mut Document, symbol: &str, number: u64) {
    let head = format!("{symbol} = ");
    let lines = document.text.lines();
    let lines: Vec<String> = lines
        .map(|line| match line.starts_with(&head) {
            true => format!("{head}{number}"),
            false => line.to_owned(),
        })
        .collect();
    document.text = lines.join("\n") + "\n";
}

fn proof(document: &Document) -> Result<Proof, String> {
    let assembly = assemble(&document.text).map_err(|faults| {
        let said: Vec<String> = faults.iter().take(5).map(ToString::to_string).collect();
        said.join("\n")
    })?;
    let labels = |head: &str| -> BTreeSet<u16> {
        let all = assembly
            .symbols
            .iter()
            .filter(|(name, _)| name.starts_with(head));
        all.filter_map(|(_, at)| u16::try_from(*at).ok()).collect()
    };
    let question = Question {
        assembly: &assembly,
        ram: 0x80..=0xFF,
        mirrored: true,
        turns: Question::turns_of(&assembly, &document.text),
        ends: [ASKED, CROSSED, PUBLISHED]
            .into_iter()
            .flat_map(labels)
            .collect(),
        exit: None,
    };
    let at = |name: &str| {
        let at = assembly.symbols.get(name).copied();
        at.and_then(|at| u16::try_from(at).ok()).unwrap_or(0)
    };
    let told = |unknown: slowlight_vm::mos6502::worst::Unknown| {
        let line = assembly.line_at(unknown.address);
        let line = line.and_then(|line| document.text.lines().nth(line as usize - 1));
        format!(
            "no bound of its slices is known: {} at ${:04x}: {}",
            unknown.why,
            unknown.address,
            line.unwrap_or_default().trim()
        )
    };
    let each = question.slices_behind_ends().map_err(told)?;
    let most = |head: &str| {
        let all = labels(head).into_iter();
        all.filter_map(|at| each.get(&at))
            .copied()
            .max()
            .unwrap_or(0)
    };
    let first = question.worst_slice(at(WORK)).map_err(told)?;
    let asked = assembly
        .symbols
        .iter()
        .filter(|(name, _)| name.starts_with(ASKED));
    let behind = asked.filter_map(|(name, at)| {
        let cycles = each.get(&u16::try_from(*at).ok()?)?;
        Some((name.clone(), *cycles))
    });
    Ok(Proof {
        slice: each.values().copied().fold(first, u64::max),
        behind: behind.collect(),
        published: most(PUBLISHED),
        convert: question.worst(at(CONVERT)).map_err(told)?,
    })
}

/// What a cartridge takes.
pub fn sizes(made: &Cartridge) -> Sizes {
    Sizes {
        code: Some(u64::from(made.rom)),
        tables: None,
        ram: Some(u64::from(made.ram + made.chip)),
    }
}

/// What `build` says of a cartridge: its memory, and how long its slices are.
///
/// # Errors
/// As for [`proved`].
pub fn text(plan: &Plan) -> Outcome<String> {
    let (made, proof) = proved(plan)?;
    Ok(format!(
        "{} banks of 4K; {} bytes of the machine's 128 (8 of them for the stack), {} of the \
         cartridge's 128\nat most {} cycles between two looks at the timer, {} to make playfield\n",
        made.banks, made.ram, made.chip, proof.slice, proof.convert
    ))
}

/// Runs a program that goes on for ever until its first picture is there.
///
/// # Errors
/// An interruption.
pub fn first_picture(loaded: &mut Loaded, limit: u64) -> Outcome<MachineRun> {
    let script = Script::default().filmed(1);
    let keyboard = Keyboard::new(script, Unit::Calls, |_| None).remembering();
    let (mut run, keyboard) = loaded.play(keyboard, limit, &mut |_| {})?;
    let shot = keyboard.shots().first();
    run.screen = shot.and_then(|(_, screen)| screen.clone());
    run.cycles = keyboard.times().first().copied().unwrap_or(run.cycles);
    Ok(run)
}

/// Colour clocks of a column, and those before the first of 32.
const COLUMN: u32 = 4;
const BORDER: u32 = 16;

/// The picture that the beam drew: a wall that is drawn on every line is of the one ink, one on
/// every second of the other; anything else is an ink that no picture has.
///
/// # Errors
/// Where there is no screen.
pub fn picture(plan: &Plan, shape: &Shape, screen: Option<&Screen>) -> Outcome<Picture> {
    let Some(screen) = screen else {
        let message = format!("{}: the program drew nothing", plan.target.name);
        return Err(Failure::Wrong(message));
    };
    // The first line that is seen.
    let seen = 24;
    let (width, height) = shape.size;
    let at = |x: u32, line: u32| {
        let row = line.checked_sub(seen)?;
        screen
            .pixels
            .get((row * screen.width + x) as usize)
            .copied()
    };
    let [wall, colours @ ..] = shape.colours.map(|colour| colour / 2);
    let mut inks = Vec::new();
    for y in 0..height {
        let below = usize::from(y >= height / 2);
        let (back, other) = (shape.backs[below], colours[below]);
        for x in 0..width {
            let clock = BORDER + COLUMN * (x + shape.first);
            let line = shape.top + 2 * shape.pairs * y;
            let mut looks = [[0u32; 3]; 2];
            for k in 0..2 * shape.pairs {
                for clock in clock..clock + COLUMN {
                    let kind = match at(clock, line + k) {
                        Some(colour) if colour == wall => 0,
                        Some(colour) if colour == other => 1,
                        _ => 2,
                    };
                    looks[(k % 2) as usize][kind] += 1;
                }
            }
            let all = COLUMN * shape.pairs;
            inks.push(match looks {
                [[first, ..], [second, ..]] if first == all && second == all => shape.walls.0,
                [[first, ..], [_, second, _]] if first == all && second == all => {
                    shape.walls.1.unwrap_or(u8::MAX)
                }
                [[_, first, _], [_, second, _]] if first == all && second == all => back,
                _ => u8::MAX,
            });
        }
    }
    let mut palette = plan.graph.image.palette.clone();
    if inks.contains(&u8::MAX) {
        palette.resize(256, [255, 0, 255]);
    }
    Ok(Picture {
        width,
        height,
        palette,
        inks,
    })
}

/// How the pictures of a plan for such a machine are shown; none for others.
pub fn shape(plan: &Plan) -> Option<Shape> {
    if !is_cartridge(plan) {
        return None;
    }
    let columns = slowlight_compiler::plan::columns::columns(plan).ok()?;
    Some(Shape::of(plan, &columns))
}
