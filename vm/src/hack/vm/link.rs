//! Links files of VM commands into a program.
//!
//! Labels are scoped by function, statics by file; functions are global. A
//! call goes to the program's own function of that name, else to the native
//! one. `Sys.halt` always is the native one: whatever a program's own would
//! do, it never returns, so the run ends there. A single file without functions is
//! run from its first command to its last.

use super::command::{ARG, LCL, TEMP, THAT, THIS};
use super::command::{CONSTANTS, Command, Place, STATIC, STATICS};
use super::fuse::Fused;
use super::glue::{self, linked_in};
use super::os::Native;
use super::parse::{Line, Segment, Written, fault, parse};
use crate::Fault;
use std::collections::HashMap;

/// The name of commands without a function, which nobody can call.
const BARE: &str = "the program";

/// No more than this many faults are reported.
const FAULTS: usize = 100;

/// A linked program: whole and consistent, ready to run on any number of machines.
#[derive(Clone, Debug)]
pub struct Program {
    pub(in crate::hack) commands: Vec<Command>,
    /// Where each command comes from: an index of `files`, and a line.
    pub(in crate::hack) origins: Vec<(u32, u32)>,
    pub(in crate::hack) files: Vec<String>,
    /// In the order of their code.
    pub(in crate::hack) functions: Vec<Function>,
    /// Where each call returns to, as an index of `commands`. Entry 0 is the
    /// end of the program, entry 1 the return from the program's own `Sys.error`.
    pub(in crate::hack) sites: Vec<u32>,
    /// The function that the machine starts in.
    pub(in crate::hack) start: u32,
    /// The program's own `Sys.error`.
    pub(in crate::hack) on_error: Option<u32>,
    /// Whether the machine's own allocator is used, so that the heap needs preparing.
    pub(in crate::hack) native_heap: bool,
    /// Whether it is commands without a function.
    pub(in crate::hack) bare: bool,
    /// The commands joined into faster ones, if the program is regular enough.
    pub(super) fused: Option<Fused>,
    count: usize,
    statics: Vec<(String, u16, u16)>,
}

/// A function: `Command::Function` at `start`, `Command::FunctionEnd` at `end`.
#[derive(Clone, Debug)]
pub(in crate::hack) struct Function {
    pub name: String,
    pub start: u32,
    pub end: u32,
    pub locals: u16,
}

impl Function {
    /// Where its commands are, `function` included, the end not.
    pub(in crate::hack) fn range(&self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
}

impl Program {
    /// Links `.vm` files, each a name and a text, in the order of their names: where statics
    /// stand, and so a word here and there of what is translated, hangs on it.
    ///
    /// # Errors
    /// What is wrong with them, by file and line; at most a hundred faults.
    pub fn link(files: &[(String, String)]) -> Result<Program, Vec<Fault>> {
        let mut faults = Vec::new();
        let mut sources: Vec<Source> = Vec::new();
        let mut files: Vec<&(String, String)> = files.iter().collect();
        files.sort_by(|(a, _), (b, _)| a.cmp(b));
        for (name, text) in files {
            let lines = parse(name, text, &mut faults);
            sources.push(Source { name, lines });
        }
        let linked_in = linked_in(&sources);
        let linked_in = parse(glue::FILE, &linked_in, &mut faults);
        let own = sources.len();
        sources.push(Source {
            name: glue::FILE,
            lines: linked_in,
        });

        let mut linker = Linker {
            bare: bare(&sources),
            ..Linker::default()
        };
        linker.declare(&sources, &mut faults);
        for (file, source) in sources.iter().enumerate() {
            if file == own {
                linker.count = linker.commands.len() - linker.functions.len();
            }
            linker.emit(file, source, &mut faults);
        }
        let start = linker.start();
        if start.is_none() && faults.is_empty() {
            faults.push(Fault {
                message: "the program has neither Sys.init nor Main.main to start in".to_owned(),
                file: None,
                line: None,
                column: None,
            });
        }
        match start {
            Some(start) if faults.is_empty() => Ok(linker.finish(start, &sources)),
            _ => {
                faults.truncate(FAULTS);
                Err(faults)
            }
        }
    }

    /// Whether it is commands without a function.
    pub fn is_bare(&self) -> bool {
        self.bare
    }

    /// How many commands the files hold. Labels are not counted: nothing executes them.
    pub fn commands(&self) -> usize {
        self.count
    }

    /// How many words of statics the files take together, of 240.
    pub fn statics(&self) -> u16 {
        self.statics.iter().map(|(_, _, count)| count).sum()
    }

    /// The address of `static index` in the file of that name, if the file uses it.
    pub fn static_address(&self, file: &str, index: u16) -> Option<u16> {
        let (_, base, count) = self.statics.iter().find(|(name, _, _)| name == file)?;
        (index < *count).then(|| base + index)
    }

    /// For each command, the file and the line (from 1) that it comes from; the files'
    /// names are those that were given.
    pub fn origins(&self) -> impl Iterator<Item = (&str, u32)> {
        let name = |file: u32| self.files.get(file as usize).map_or("", String::as_str);
        self.origins
            .iter()
            .map(move |(file, line)| (name(*file), *line))
    }

    /// The function whose code holds command `at`.
    pub(in crate::hack) fn function_at(&self, at: u32) -> Option<&Function> {
        let after = self.functions.partition_point(|f| f.start <= at);
        self.functions.get(after.checked_sub(1)?)
    }
}

/// A file's commands.
pub(super) struct Source<'t> {
    name: &'t str,
    pub lines: Vec<Line<'t>>,
}

/// Whether a program, given with what is linked in, is one file of commands in no function.
fn bare(sources: &[Source]) -> bool {
    let own = sources.split_last().map(|(_, own)| own);
    let commands = |only: &Source| !only.lines.is_empty() && !only.lines.iter().any(is_function);
    matches!(own, Some([only]) if commands(only))
}

#[derive(Default)]
struct Linker<'t> {
    names: HashMap<&'t str, u32>,
    functions: Vec<Function>,
    commands: Vec<Command>,
    origins: Vec<(u32, u32)>,
    sites: Vec<u32>,
    /// First address and count of each file's statics.
    statics: Vec<(u16, u16)>,
    count: usize,
    bare: bool,
}

impl<'t> Linker<'t> {
    /// Finds all functions and lays out the statics.
    fn declare(&mut self, sources: &[Source<'t>], faults: &mut Vec<Fault>) {
        // Returning from the first function ends the program, and returning
        // from the program's Sys.error is a fault: both are no command.
        self.sites = vec![u32::MAX, u32::MAX];
        let mut next = STATIC;
        let mut number = 0;
        if self.bare {
            self.names.insert(BARE, 0);
        }
        for source in sources {
            let mut count = 0;
            for line in &source.lines {
                match line.what {
                    Written::Function(name, _) => {
                        if self.names.insert(name, number).is_some() {
                            let message = format!("a second function {name}");
                            faults.push(fault(source.name, line.line, message));
                        }
                        number += 1;
                    }
                    Written::Push(Segment::Static, index)
                    | Written::Pop(Segment::Static, index) => {
                        count = count.max(index + 1);
                        if next - STATIC + count > STATICS {
                            let message = format!(
                                "static {index} does not fit: all files together have {STATICS} statics, and the files before take {}",
                                next - STATIC
                            );
                            faults.push(fault(source.name, line.line, message));
                            count = 0;
                        }
                    }
                    _ => {}
                }
            }
            self.statics.push((next, count));
            next += count;
        }
    }

    /// Links one file.
    fn emit(&mut self, file: usize, source: &Source<'t>, faults: &mut Vec<Fault>) {
        let mut rest = source.lines.as_slice();
        while let Some((first, after)) = rest.split_first() {
            let (head, after) = match first.what {
                Written::Function(name, locals) => ((name, locals), after),
                _ if self.bare => ((BARE, 0), rest),
                _ => {
                    let message = "a command outside every function".to_owned();
                    faults.push(fault(source.name, first.line, message));
                    let next = rest.iter().position(is_function).unwrap_or(rest.len());
                    rest = rest.get(next..).unwrap_or(&[]);
                    continue;
                }
            };
            let size = after.iter().position(is_function).unwrap_or(after.len());
            let (body, next) = after.split_at(size);
            self.function(file, source.name, (head, first.line), body, faults);
            rest = next;
        }
    }

    /// Links one function: its name, its count of locals, where it begins.
    fn function(
        &mut self,
        file: usize,
        file_name: &str,
        ((name, locals), line): ((&'t str, u16), u32),
        body: &[Line<'t>],
        faults: &mut Vec<Fault>,
    ) {
        let start = self.commands.len() as u32;
        self.add(file, line, Command::Function { locals });
        self.body(file, file_name, name, body, faults);
        let end = self.commands.len() as u32;
        let last = body.last().map_or(line, |line| line.line);
        self.add(file, last, Command::FunctionEnd);
        self.functions.push(Function {
            name: name.to_owned(),
            start,
            end,
            locals,
        });
    }

    fn add(&mut self, file: usize, line: u32, command: Command) {
        self.commands.push(command);
        self.origins.push((file as u32, line));
    }

    /// Links the commands of one function.
    fn body(
        &mut self,
        file: usize,
        file_name: &str,
        function: &str,
        body: &[Line<'t>],
        faults: &mut Vec<Fault>,
    ) {
        let mut labels = HashMap::new();
        let mut at = self.commands.len() as u32;
        for line in body {
            if let Written::Label(name) = line.what {
                if labels.insert(name, at).is_some() {
                    let message = format!("a second label {name} in {function}");
                    faults.push(fault(file_name, line.line, message));
                }
            } else {
                at += 1;
            }
        }
        let statics = self.statics.get(file).map_or(STATIC, |(base, _)| *base);
        for line in body {
            let jump = |name: &str| match labels.get(name) {
                Some(target) => Ok(*target),
                None => Err(format!("no label {name} in {function}")),
            };
            let command = match line.what {
                Written::Push(segment, index) => Ok(Command::Push(place(segment, index, statics))),
                Written::Pop(segment, index) => Ok(Command::Pop(place(segment, index, statics))),
                Written::Binary(binary) => Ok(Command::Binary(binary)),
                Written::Neg => Ok(Command::Neg),
                Written::Not => Ok(Command::Not),
                Written::Label(_) | Written::Function(..) => continue,
                Written::Goto(name) => jump(name).map(Command::Goto),
                Written::IfGoto(name) => jump(name).map(Command::IfGoto),
                Written::Call(name, arguments) => self.call(name, arguments),
                Written::Return => Ok(Command::Return),
            };
            match command {
                Ok(command) => self.add(file, line.line, command),
                Err(message) => faults.push(fault(file_name, line.line, message)),
            }
        }
    }

    fn call(&mut self, name: &str, arguments: u16) -> Result<Command, String> {
        let native = Native::named(name);
        let own = self.names.get(name).copied();
        match (own, native) {
            (Some(function), native) if native != Some(Native::Halt) => {
                let site = u16::try_from(self.sites.len())
                    .map_err(|_| "more than 65,534 calls in the program".to_owned())?;
                self.sites.push(self.commands.len() as u32 + 1);
                Ok(Command::Call {
                    function,
                    arguments,
                    site,
                })
            }
            (_, Some(native)) if arguments == native.arguments() => Ok(Command::Native(native)),
            (_, Some(native)) => Err(format!(
                "{name} takes {} arguments, not {arguments}",
                native.arguments()
            )),
            (_, None) => Err(format!(
                "no function {name}: neither the program nor the operating system has it"
            )),
        }
    }

    fn start(&self) -> Option<u32> {
        let names = ["Sys.init", "Main.main", BARE];
        names.iter().find_map(|name| self.names.get(name)).copied()
    }

    fn finish(self, start: u32, sources: &[Source]) -> Program {
        let named = |name: &str| self.names.get(name).copied();
        let regular = !self.bare;
        let fused =
            regular.then(|| Fused::new(&self.commands, &self.functions, &self.sites, start));
        let files = sources.iter().map(|source| source.name.to_owned());
        let statics = sources
            .iter()
            .zip(&self.statics)
            .map(|(source, (base, count))| (source.name.to_owned(), *base, *count));
        Program {
            start,
            on_error: named("Sys.error"),
            native_heap: named("Memory.alloc").is_none(),
            fused: fused.flatten(),
            bare: self.bare,
            count: self.count,
            files: files.collect(),
            statics: statics.collect(),
            commands: self.commands,
            origins: self.origins,
            functions: self.functions,
            sites: self.sites,
        }
    }
}

fn is_function(line: &Line) -> bool {
    matches!(line.what, Written::Function(..))
}

fn place(segment: Segment, index: u16, statics: u16) -> Place {
    let relative = |base| Place {
        base,
        offset: index,
    };
    match segment {
        Segment::Constant => Place::fixed(CONSTANTS | index),
        Segment::Local => relative(LCL),
        Segment::Argument => relative(ARG),
        Segment::This => relative(THIS),
        Segment::That => relative(THAT),
        Segment::Static => Place::fixed(statics + index),
        Segment::Temp => Place::fixed(TEMP + index),
        Segment::Pointer => Place::fixed(THIS + index),
    }
}
