//! A straightforward Hack VM: each command an arm of one `match`, in the order of the
//! program, on the book's own memory. What the bundled machine is measured against.
//!
//! It knows the functions of the system that the benchmarks' programs call; all others
//! return 0.

use std::collections::HashMap;

#[derive(Clone, Copy)]
enum Segment {
    Constant,
    Local,
    Argument,
    This,
    That,
    /// Pointer, temp and statics: an address.
    Fixed,
}

#[derive(Clone, Copy)]
enum Native {
    Multiply,
    Divide,
    Abs,
    Min,
    Max,
    Alloc,
    Color,
    Pixel,
    Clear,
    Halt,
    Other,
}

#[derive(Clone, Copy)]
enum Command {
    Push(Segment, u16),
    Pop(Segment, u16),
    Add,
    Sub,
    Neg,
    Equal,
    Greater,
    Less,
    And,
    Or,
    Not,
    Goto(usize),
    IfGoto(usize),
    Function(u16),
    Call(usize, u16),
    System(Native, u16),
    Return,
}

const SP: usize = 0;
const LCL: usize = 1;
const ARG: usize = 2;
const THIS: usize = 3;
const THAT: usize = 4;
const SCREEN: usize = 16384;
const RAM: u16 = 0x7FFF;

/// A program, read and linked.
pub struct Straight {
    commands: Vec<Command>,
    main: usize,
}

/// What a run left.
pub struct Left {
    pub commands: u64,
    pub memory: Vec<i16>,
}

impl Straight {
    /// Reads VM code, a text for each class, under its name; none where it is wrong.
    pub fn read(files: &[(String, String)]) -> Option<Straight> {
        let mut places: HashMap<String, usize> = HashMap::new();
        let mut count = 0;
        lines(files, |_, function, words| match words {
            ["label", name] => {
                places.insert(format!("{function}${name}"), count);
            }
            _ => {
                if let ["function", name, _] = words {
                    places.insert((*name).to_owned(), count);
                }
                count += 1;
            }
        });
        let mut statics: HashMap<String, u16> = HashMap::new();
        let mut commands = Vec::with_capacity(count);
        let mut whole = true;
        lines(files, |file, function, words| {
            if let ["label", _] = words {
                return;
            }
            let made = command(words, &places, function, |index| {
                let next = 16 + statics.len() as u16;
                *statics.entry(format!("{file}.{index}")).or_insert(next)
            });
            whole &= made.is_some();
            commands.extend(made);
        });
        let main = *places.get("Main.main")?;
        whole.then_some(Straight { commands, main })
    }

    /// Runs `Main.main` to its end.
    pub fn run(&self) -> Left {
        let mut memory = vec![0i16; 0x8000];
        let end = self.commands.len();
        let (mut heap, mut dark, mut count) = (2048i16, true, 0u64);
        memory[SP] = 256;
        call(&mut memory, end, 0);
        let mut at = self.main;
        while let Some(command) = self.commands.get(at) {
            count += 1;
            at += 1;
            match *command {
                Command::Push(Segment::Constant, value) => push(&mut memory, value as i16),
                Command::Push(segment, index) => {
                    let value = memory[address(&memory, segment, index)];
                    push(&mut memory, value);
                }
                Command::Pop(segment, index) => {
                    let value = pop(&mut memory);
                    let to = address(&memory, segment, index);
                    memory[to] = value;
                }
                Command::Add => binary(&mut memory, i16::wrapping_add),
                Command::Sub => binary(&mut memory, i16::wrapping_sub),
                Command::Equal => binary(&mut memory, |x, y| -i16::from(x == y)),
                Command::Greater => binary(&mut memory, |x, y| -i16::from(x > y)),
                Command::Less => binary(&mut memory, |x, y| -i16::from(x < y)),
                Command::And => binary(&mut memory, |x, y| x & y),
                Command::Or => binary(&mut memory, |x, y| x | y),
                Command::Neg => {
                    let x = pop(&mut memory);
                    push(&mut memory, x.wrapping_neg());
                }
                Command::Not => {
                    let x = pop(&mut memory);
                    push(&mut memory, !x);
                }
                Command::Goto(to) => at = to,
                Command::IfGoto(to) => {
                    if pop(&mut memory) != 0 {
                        at = to;
                    }
                }
                Command::Function(locals) => {
                    for _ in 0..locals {
                        push(&mut memory, 0);
                    }
                }
                Command::Call(to, arguments) => {
                    call(&mut memory, at, arguments);
                    at = to;
                }
                Command::Return => {
                    let frame = memory[LCL] as u16;
                    let saved = |k: u16| usize::from((frame - k) & RAM);
                    at = usize::from(memory[saved(5)] as u16);
                    let value = pop(&mut memory);
                    let to = memory[ARG];
                    memory[usize::from(to as u16 & RAM)] = value;
                    memory[SP] = to.wrapping_add(1);
                    for (k, cell) in [(1, THAT), (2, THIS), (3, ARG), (4, LCL)] {
                        memory[cell] = memory[saved(k)];
                    }
                }
                Command::System(native, arguments) => {
                    let mut given = [0i16; 4];
                    for k in (0..usize::from(arguments)).rev() {
                        let value = pop(&mut memory);
                        if let Some(place) = given.get_mut(k) {
                            *place = value;
                        }
                    }
                    let [x, y, ..] = given;
                    let result = match native {
                        Native::Multiply => x.wrapping_mul(y),
                        Native::Divide => x.checked_div(y).unwrap_or(0),
                        Native::Abs => x.wrapping_abs(),
                        Native::Min => x.min(y),
                        Native::Max => x.max(y),
                        Native::Alloc => {
                            heap += x;
                            heap - x
                        }
                        Native::Color => {
                            dark = x != 0;
                            0
                        }
                        Native::Pixel => {
                            let word = SCREEN + usize::from(y as u16 & 255) * 32;
                            let word = word + usize::from(x as u16 & 511) / 16;
                            let bit = 1 << (x & 15);
                            memory[word] = memory[word] & !bit | if dark { bit } else { 0 };
                            0
                        }
                        Native::Clear => {
                            memory[SCREEN..SCREEN + 8192].fill(0);
                            0
                        }
                        Native::Halt => break,
                        Native::Other => 0,
                    };
                    push(&mut memory, result);
                }
            }
        }
        Left {
            commands: count,
            memory,
        }
    }
}

/// Each line's words, with its file and function.
fn lines(files: &[(String, String)], mut each: impl FnMut(&str, &str, &[&str])) {
    for (file, text) in files {
        let mut function = "";
        for line in text.lines() {
            let code = line.split("//").next().unwrap_or_default();
            let words: Vec<&str> = code.split_whitespace().collect();
            if let ["function", name, _] = words[..] {
                function = name;
            }
            if !words.is_empty() {
                each(file, function, &words);
            }
        }
    }
}

fn command(
    words: &[&str],
    places: &HashMap<String, usize>,
    function: &str,
    mut fixed: impl FnMut(&str) -> u16,
) -> Option<Command> {
    let label = |name: &str| places.get(&format!("{function}${name}")).copied();
    let mut place = |segment: &str, index: &str| {
        let number: u16 = index.parse().ok()?;
        Some(match segment {
            "constant" => (Segment::Constant, number),
            "local" => (Segment::Local, number),
            "argument" => (Segment::Argument, number),
            "this" => (Segment::This, number),
            "that" => (Segment::That, number),
            "pointer" => (Segment::Fixed, 3 + number),
            "temp" => (Segment::Fixed, 5 + number),
            "static" => (Segment::Fixed, fixed(index)),
            _ => return None,
        })
    };
    Some(match words {
        ["push", segment, index] => {
            let (segment, index) = place(segment, index)?;
            Command::Push(segment, index)
        }
        ["pop", segment, index] => {
            let (segment, index) = place(segment, index)?;
            Command::Pop(segment, index)
        }
        ["add"] => Command::Add,
        ["sub"] => Command::Sub,
        ["neg"] => Command::Neg,
        ["eq"] => Command::Equal,
        ["gt"] => Command::Greater,
        ["lt"] => Command::Less,
        ["and"] => Command::And,
        ["or"] => Command::Or,
        ["not"] => Command::Not,
        ["goto", name] => Command::Goto(label(name)?),
        ["if-goto", name] => Command::IfGoto(label(name)?),
        ["function", _, locals] => Command::Function(locals.parse().ok()?),
        ["call", name, arguments] => {
            let arguments = arguments.parse().ok()?;
            match places.get(*name) {
                Some(to) => Command::Call(*to, arguments),
                None => Command::System(native(name), arguments),
            }
        }
        ["return"] => Command::Return,
        _ => return None,
    })
}

fn native(name: &str) -> Native {
    match name {
        "Math.multiply" => Native::Multiply,
        "Math.divide" => Native::Divide,
        "Math.abs" => Native::Abs,
        "Math.min" => Native::Min,
        "Math.max" => Native::Max,
        "Memory.alloc" | "Array.new" => Native::Alloc,
        "Screen.setColor" => Native::Color,
        "Screen.drawPixel" => Native::Pixel,
        "Screen.clearScreen" => Native::Clear,
        "Sys.halt" => Native::Halt,
        _ => Native::Other,
    }
}

fn address(memory: &[i16], segment: Segment, index: u16) -> usize {
    let base = match segment {
        Segment::Local => memory[LCL],
        Segment::Argument => memory[ARG],
        Segment::This => memory[THIS],
        Segment::That => memory[THAT],
        Segment::Constant | Segment::Fixed => 0,
    };
    usize::from((base as u16).wrapping_add(index) & RAM)
}

fn push(memory: &mut [i16], value: i16) {
    let top = memory[SP];
    memory[usize::from(top as u16 & RAM)] = value;
    memory[SP] = top.wrapping_add(1);
}

fn pop(memory: &mut [i16]) -> i16 {
    let top = memory[SP].wrapping_sub(1);
    memory[SP] = top;
    memory[usize::from(top as u16 & RAM)]
}

fn binary(memory: &mut [i16], of: impl Fn(i16, i16) -> i16) {
    let y = pop(memory);
    let x = pop(memory);
    push(memory, of(x, y));
}

/// The book's frame; the return address is a command's number.
fn call(memory: &mut [i16], back: usize, arguments: u16) {
    let given = memory[SP] as u16 - arguments;
    push(memory, back as u16 as i16);
    for cell in [LCL, ARG, THIS, THAT] {
        let value = memory[cell];
        push(memory, value);
    }
    memory[ARG] = given as i16;
    memory[LCL] = memory[SP];
}
