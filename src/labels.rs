//! Debug information: names for a program's addresses and for the scene's lines, as symbol files
//! that debuggers of emulators read.

use crate::failure::{Failure, Outcome};
use crate::listing::assembled;
use crate::machine::{File, Machine};
use crate::scene::Scene;
use crate::{target_args, trial};
use clap::ValueEnum;
use slowlight_compiler::backend::Document;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::targets::{System, Target};
use slowlight_vm::mos6502::Assembly;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// A form of symbol file.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Labels {
    /// NAME.vs: `al C:0810 .name` a line, for VICE (`x64sc -moncommands NAME.vs`) and others
    Vice,
    /// NAME.labels: one line, as beebasm's -d writes it, for b-em (`swiftsym NAME.labels`)
    Beebasm,
    /// NAME.dbg: as ld65's --dbgfile writes it, with the lines of the assembly and of the scene
    Ca65,
    /// Main.sym: `address name` a line, of the Hack's ROM; with --os jack
    Hack,
}

impl Labels {
    /// Whether a target has such a file.
    ///
    /// # Errors
    /// That it has not.
    pub fn check(self, target: &Target, on_processor: bool) -> Outcome<()> {
        let message = match self {
            Labels::Hack if target.system != System::Hack => {
                format!(
                    "--labels hack is the Hack's; {} has vice, beebasm and ca65",
                    target.name
                )
            }
            Labels::Hack if !on_processor => {
                "--labels hack are addresses in the ROM, which --os jack makes".to_owned()
            }
            Labels::Hack => return Ok(()),
            _ if target_args::is_6502(target) => return Ok(()),
            _ if target.system == System::Hack => {
                "--labels vice, beebasm and ca65 are the 6502's; jack has hack, with --os jack"
                    .to_owned()
            }
            _ => format!(
                "--labels are of machine code; a program for {} has line numbers",
                target.name
            ),
        };
        Err(Failure::Usage(message))
    }
}

/// The files that were asked for, of a plan's program.
///
/// # Errors
/// Where the machine's tools refuse the program, which is a fault of ours.
pub fn files(
    asked: &[Labels],
    scene: &Scene,
    (plan, text): (&Plan, &[Document]),
    machine: Machine,
) -> Outcome<Vec<File>> {
    let mut files = Vec::new();
    let named =
        |extension: &str, text: &str| File::text(&format!("{}.{extension}", plan.name), text);
    let program = match target_args::is_6502(plan.target) && !asked.is_empty() {
        true => {
            let (document, assembly) = assembled(plan)?;
            Some(Program::of(scene, document, assembly))
        }
        false => None,
    };
    for form in asked {
        files.push(match (form, &program) {
            (Labels::Vice, Some(program)) => named("vs", &program.vice()),
            (Labels::Beebasm, Some(program)) => named("labels", &program.beebasm()),
            (Labels::Ca65, Some(program)) => named("dbg", &program.ca65(&plan.name)),
            _ => File::text("Main.sym", &hack(text, plan, machine)?),
        });
    }
    Ok(files)
}

/// A program of the 6502 with its names.
struct Program {
    document: Document,
    assembly: Assembly,
    /// Names of the source, and whether each is a label of the program or an address or number
    /// beside it.
    names: BTreeMap<String, (u16, bool)>,
    /// The scene's files that the program comes from, by their numbers: names and sizes.
    files: BTreeMap<u16, (String, usize)>,
    /// Where each line of the scene comes into the program: offset and length, by file and line.
    stretches: BTreeMap<(u16, usize), Vec<(u32, u32)>>,
    /// Names for the beginnings of these.
    lines: Vec<(String, u16)>,
}

impl Program {
    fn of(scene: &Scene, document: Document, assembly: Assembly) -> Program {
        let mut program = Program {
            names: names(&document, &assembly),
            document,
            assembly,
            files: BTreeMap::new(),
            stretches: BTreeMap::new(),
            lines: Vec::new(),
        };
        let begun = program.find(scene);
        let mut taken: BTreeSet<String> = program.names.keys().cloned().collect();
        let mut times: BTreeMap<(u16, usize), u32> = BTreeMap::new();
        for (address, (file, line)) in begun {
            let stem = program.files.get(&file).map_or("scene", |(name, _)| name);
            let time = times.entry((file, line)).or_default();
            *time += 1;
            let mut name = format!("{}_{line}", identifier(stem));
            if *time > 1 {
                let _ = write!(name, "_{time}");
            }
            while !taken.insert(name.clone()) {
                name.push('_');
            }
            program.lines.push((name, address));
        }
        program
    }

    /// Finds which bytes come from which line of the scene; answers where another line than
    /// before begins.
    fn find(&mut self, scene: &Scene) -> Vec<(u16, (u16, usize))> {
        let sources = &scene.checked.sources;
        let mut begun = Vec::new();
        let mut before: Option<(u16, usize)> = None;
        for span in &self.assembly.lines {
            let at = (span.line as usize).saturating_sub(1);
            let from = self.document.span(at, 0);
            let here = from.map(|from| (from.file, sources.line_column(from).0));
            if let Some(place) = here {
                if let Some(file) = sources.files.get(usize::from(place.0)) {
                    let about = || (file.name.clone(), file.text.len());
                    self.files.entry(place.0).or_insert_with(about);
                }
                let offset = u32::from(span.address.wrapping_sub(self.assembly.origin));
                let stretches = self.stretches.entry(place).or_default();
                match stretches.last_mut() {
                    Some((start, length)) if *start + *length == offset => *length += span.length,
                    _ => stretches.push((offset, span.length)),
                }
                if before != here {
                    begun.push((span.address, place));
                }
            }
            before = here;
        }
        begun
    }

    /// All names by their addresses, those of the scene's lines first where both are there.
    fn all(&self) -> Vec<(u16, &str)> {
        let lines = self.lines.iter().map(|(name, at)| (*at, name.as_str()));
        let names = self
            .names
            .iter()
            .map(|(name, (at, _))| (*at, name.as_str()));
        let mut all: Vec<(u16, &str)> = lines.chain(names).collect();
        all.sort_by_key(|(at, _)| *at);
        all
    }

    fn vice(&self) -> String {
        let mut text = String::new();
        for (address, name) in self.all() {
            let _ = writeln!(text, "al C:{address:04x} .{name}");
        }
        text
    }

    fn beebasm(&self) -> String {
        let all = self.all().into_iter();
        let all: Vec<String> = all.map(|(at, name)| format!("'{name}':{at}L")).collect();
        format!("[{{{}}}]\n", all.join(","))
    }

    /// As ld65 writes it: one module, one segment, one scope; the scene's files are sources
    /// above the assembly (lines of type 1), as C's are.
    fn ca65(&self, name: &str) -> String {
        let (mut lines, mut spans) = (String::new(), String::new());
        let (mut line_count, mut span_count) = (0, 0);
        let mut line_of = BTreeMap::new();
        let mut span = |(start, size): (u32, u32)| {
            let _ = writeln!(
                spans,
                "span\tid={span_count},seg=0,start={start},size={size}"
            );
            span_count += 1;
            (span_count - 1).to_string()
        };
        let whole = span((0, self.assembly.bytes.len() as u32));
        for of in &self.assembly.lines {
            let offset = u32::from(of.address.wrapping_sub(self.assembly.origin));
            let id = span((offset, of.length));
            let _ = writeln!(
                lines,
                "line\tid={line_count},file=0,line={},span={id}",
                of.line
            );
            line_of.insert(of.line, line_count);
            line_count += 1;
        }
        let numbers: BTreeMap<u16, usize> = (self.files.keys())
            .enumerate()
            .map(|(k, file)| (*file, k + 1))
            .collect();
        for ((file, line), stretches) in &self.stretches {
            let ids: Vec<String> = stretches.iter().map(|s| span(*s)).collect();
            let (file, ids) = (
                numbers.get(file).copied().unwrap_or_default(),
                ids.join("+"),
            );
            let _ = writeln!(
                lines,
                "line\tid={line_count},file={file},line={line},type=1,span={ids}"
            );
            line_count += 1;
        }
        let mut symbols = String::new();
        let labels = self
            .names
            .iter()
            .map(|(name, (at, label))| (name, *at, *label));
        let own = self.lines.iter().map(|(name, at)| (name, *at, true));
        let mut count = 0;
        for (name, at, label) in labels.chain(own) {
            let size = if at < 0x100 { "zeropage" } else { "absolute" };
            let line = self.assembly.line_at(at).filter(|_| label);
            let defined = line.and_then(|line| line_of.get(&line));
            let defined = defined.map_or(String::new(), |line| format!(",def={line}"));
            let kind = if label { "lab" } else { "equ" };
            let _ = writeln!(
                symbols,
                "sym\tid={count},name=\"{name}\",addrsize={size},scope=0{defined},val=0x{at:X},type={kind}"
            );
            count += 1;
        }
        let mut text = format!(
            "version\tmajor=2,minor=0\n\
             info\tcsym=0,file={},lib=0,line={line_count},mod=1,scope=1,seg=1,span={span_count},sym={count},type=0\n\
             file\tid=0,name=\"{}\",size={},mtime=0x00000000,mod=0\n",
            1 + self.files.len(),
            self.document.name,
            self.document.text.len(),
        );
        for (k, (file, size)) in self.files.values().enumerate() {
            let _ = writeln!(
                text,
                "file\tid={},name=\"{}\",size={size},mtime=0x00000000,mod=0",
                k + 1,
                file.replace('"', "'")
            );
        }
        let (origin, size) = (self.assembly.origin, self.assembly.bytes.len());
        let _ = writeln!(text, "{lines}mod\tid=0,name=\"{name}.o\",file=0");
        let _ = writeln!(
            text,
            "seg\tid=0,name=\"CODE\",start=0x{origin:06X},size=0x{size:04X},addrsize=absolute,type=rw,oname=\"{name}.prg\",ooffs=2"
        );
        let _ = writeln!(
            text,
            "{spans}scope\tid=0,name=\"\",mod=0,size={size},span={whole}"
        );
        text + &symbols
    }
}

/// The names that a source gives to places of the program, and to addresses and numbers beside
/// it, as it writes them, with what they are worth.
fn names(document: &Document, assembly: &Assembly) -> BTreeMap<String, (u16, bool)> {
    let mut found = BTreeMap::new();
    for line in document.text.lines() {
        let end = line.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        let (name, rest) = line.split_at(end.unwrap_or(line.len()));
        let rest = rest.trim_start();
        let label = rest.starts_with(':');
        if name.is_empty() || !label && !rest.starts_with("= $") {
            continue;
        }
        let value = assembly.symbols.get(name);
        if let Some(value) = value.and_then(|value| u16::try_from(*value).ok()) {
            found.insert(name.to_owned(), (value, label));
        }
    }
    found
}

/// A file's name as an identifier, without directories and without what is behind its dot.
fn identifier(name: &str) -> String {
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let stem = name.split('.').next().unwrap_or(name);
    let kept = stem.chars().map(|c| match c.is_ascii_alphanumeric() {
        true => c,
        false => '_',
    });
    let kept: String = kept.take(40).collect();
    match kept.chars().next() {
        Some(first) if !first.is_ascii_digit() => kept,
        _ => format!("_{kept}"),
    }
}

/// The functions of a program in the Hack's ROM, read off its assembly; what has a `$` in its
/// name is a place within one, and left out.
fn hack(text: &[Document], plan: &Plan, machine: Machine) -> Outcome<String> {
    let built = trial::build_written(text, plan, machine)?;
    let assembly = built.loaded.binaries.iter().find(|f| f.name == "Main.asm");
    let (mut address, mut out) = (0_u32, String::new());
    for line in assembly.map(File::as_text).unwrap_or_default().lines() {
        let line = line.split("//").next().unwrap_or_default().trim();
        if line.is_empty() {
            continue;
        }
        let Some(name) = line.strip_prefix('(').and_then(|l| l.strip_suffix(')')) else {
            address += 1;
            continue;
        };
        if !name.contains('$') {
            let _ = writeln!(out, "{address} {name}");
        }
    }
    Ok(out)
}
