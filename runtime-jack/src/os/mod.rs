//! An operating system in Jack, with the API of *The Elements of Computing Systems*
//! (appendix 6), for programs that run on the Hack computer's processor.
//!
//! A program gets those subroutines that it calls, and what they need: a part is one
//! subroutine, or several that belong together. What the functions answer, what they
//! leave in memory, on which pixels they draw and the numbers of their errors are
//! those of the bundled VM's native system. Not the same: text is drawn, keys are
//! waited for, and waiting takes time.
//!
//! The source keeps the rules of the other parts, and compares by differences that
//! fit 16 bits, or with constants after the sign is known, so it is right however a
//! translator compares. Nothing calls itself, so that its words can lie at fixed
//! addresses.

mod keyboard;
mod math;
mod memory;
mod output;
mod screen;
mod string;
mod sys;

pub use sys::{FAILED, NUMBER};

use crate::parts::{class, class_of, init, makers};
use slowlight_routine::{Part, Source};

#[rustfmt::skip]
pub(crate) static ALL: &[Part] = &[
    part!("Math.abs", [], 10, math::ABS),
    part!("Math.min", [], 40, math::MIN),
    part!("Math.max", [], 40, math::MAX),
    part!("Math.multiply", [], 260, math::MULTIPLY),
    part!("Math.divide", ["Sys.error"], 500, math::DIVIDE),
    part!("Math.sqrt", ["Sys.error"], 40, math::SQRT),
    part!("Memory.peek", [], 10, memory::PEEK),
    part!("Memory.poke", [], 10, memory::POKE),
    part!("Memory.makeHeap", [], 20, memory::MAKE_HEAP),
    part!("Memory.alloc", ["Memory.makeHeap", "Sys.error"], 80, memory::ALLOC),
    part!("Memory.deAlloc", ["Memory.makeHeap"], 60, memory::DE_ALLOC),
    part!("Array.new", ["Memory.alloc", "Sys.error"], 20, memory::NEW),
    part!("Array.dispose", ["Memory.deAlloc"], 10, memory::DISPOSE),
    part!("Screen.makeBlack", [], 4, screen::MAKE_BLACK),
    part!("Screen.clearScreen", [], 20, screen::CLEAR_SCREEN),
    part!("Screen.setColor", ["Screen.makeBlack"], 8, screen::SET_COLOR),
    part!("Screen.isOutside", [], 20, screen::IS_OUTSIDE),
    part!("Screen.wordAt", [], 80, screen::WORD_AT),
    part!("Screen.bit", [], 20, screen::BIT),
    part!("Screen.paint", ["Screen.makeBlack"], 20, screen::PAINT),
    part!("Screen.drawPixel", ["Screen.isOutside", "Screen.wordAt", "Screen.bit", "Screen.paint", "Sys.error"], 40, screen::DRAW_PIXEL),
    part!("Screen.span", ["Screen.wordAt", "Screen.bit", "Screen.paint"], 70, screen::SPAN),
    part!("Screen.drawLine", ["Screen.isOutside", "Screen.wordAt", "Screen.bit", "Screen.paint", "Sys.error"], 260, screen::DRAW_LINE),
    part!("Screen.drawRectangle", ["Screen.isOutside", "Screen.span", "Sys.error"], 70, screen::DRAW_RECTANGLE),
    part!("Screen.drawCircle", ["Screen.isOutside", "Screen.span", "Sys.error"], 180, screen::DRAW_CIRCLE),
    part!("String", [], 0, string::HEAD),
    part!("String.new", ["Memory.alloc", "Sys.error"], 40, string::NEW),
    part!("String.dispose", ["Memory.deAlloc"], 10, string::DISPOSE),
    part!("String.length", [], 8, string::LENGTH),
    part!("String.charAt", ["Sys.error"], 40, string::CHAR_AT),
    part!("String.setCharAt", ["Sys.error"], 40, string::SET_CHAR_AT),
    part!("String.appendChar", ["Sys.error"], 40, string::APPEND_CHAR),
    part!("String.eraseLastChar", ["Sys.error"], 20, string::ERASE_LAST_CHAR),
    part!("String.intValue", [], 100, string::INT_VALUE),
    part!("String.setInt", ["String.appendChar", "Sys.error"], 200, string::SET_INT),
    part!("String.newLine", [], 4, string::NEW_LINE),
    part!("String.backSpace", [], 4, string::BACK_SPACE),
    part!("String.doubleQuote", [], 4, string::DOUBLE_QUOTE),
    part!("Output.makeCursor", [], 20, output::MAKE_CURSOR),
    part!("Output.makeFont", ["Array.new"], 1600, output::MAKE_FONT),
    part!("Output.draw", ["Output.makeCursor", "Output.makeFont"], 180, output::DRAW),
    part!("Output.moveCursor", ["Output.makeCursor", "Output.draw", "Sys.error"], 80, output::MOVE_CURSOR),
    part!("Output.printChar", ["Output.draw", "Output.println", "Output.backSpace"], 60, output::PRINT_CHAR),
    part!("Output.printString", ["Output.printChar", "String.length", "String.charAt"], 50, output::PRINT_STRING),
    part!("Output.printInt", ["Output.printChar"], 110, output::PRINT_INT),
    part!("Output.println", ["Output.makeCursor"], 30, output::PRINTLN),
    part!("Output.backSpace", ["Output.makeCursor", "Output.draw"], 30, output::BACK_SPACE),
    part!("Keyboard.keyPressed", [], 8, keyboard::KEY_PRESSED),
    part!("Keyboard.readKey", ["Keyboard.keyPressed"], 30, keyboard::READ_KEY),
    part!("Keyboard.readChar", ["Keyboard.readKey", "Output.printChar"], 20, keyboard::READ_CHAR),
    part!("Keyboard.readLine", ["Keyboard.readKey", "Output.printString", "Output.printChar", "Output.println", "Output.backSpace", "String.new", "String.length", "String.appendChar", "String.eraseLastChar"], 100, keyboard::READ_LINE),
    part!("Keyboard.readInt", ["Keyboard.readLine", "String.intValue", "String.dispose"], 30, keyboard::READ_INT),
    part!("Sys.error", ["Sys.halt"], 260, sys::ERROR),
    part!("Sys.halt", [], 4, sys::HALT),
    part!("Sys.wait", ["Sys.error"], 30, sys::WAIT),
];

/// The classes, in the order in which `Sys.init` initialises them.
const CLASSES: &[&str] = &[
    "Memory", "Math", "Screen", "Output", "Keyboard", "Array", "String", "Sys",
];

/// What a program brings and asks for.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted<'n> {
    /// The subroutines that it calls, as `Class.subroutine`; others than the
    /// system's may be among them.
    pub calls: &'n [&'n str],
    /// Those that it may come to call: what the others need is there, so that the
    /// program compiles, but not initialised.
    pub reached: &'n [&'n str],
    /// The subroutines that it has. A class of which it has any is its own, whole.
    pub has: &'n [&'n str],
}

/// The classes of the system that a program asks for, each as its name and its text,
/// cut down to what is called. `Sys.init` initialises the classes that want it, the
/// program's own among them, and calls `Main.main`.
pub fn classes(wanted: Wanted) -> Vec<(&'static str, String)> {
    let owns = |class: &str| wanted.has.iter().any(|name| class_name(name) == class);
    let parts = closure(wanted.calls, &owns);
    let live = closure(wanted.reached, &owns);
    let has_init = |class: &str| {
        let given = if owns(class) {
            wanted.has
        } else {
            wanted.calls
        };
        makers(class, &live).next().is_some() || given.contains(&format!("{class}.init").as_str())
    };
    let others = CLASSES.iter().copied().filter(|class| *class != "Sys");
    let begin = sys::init(others.filter(|class| has_init(class)));
    let mut classes = Vec::new();
    for name in CLASSES.iter().copied().filter(|name| !owns(name)) {
        let own: Vec<&Part> = (parts.iter().copied())
            .filter(|part| class_of(part) == name)
            .collect();
        let init = match name {
            "Sys" => Some(begin.clone()),
            name => has_init(name).then(|| init(makers(name, &live))),
        };
        if init.is_some() || !own.is_empty() {
            classes.push((name, class(ALL, name, &own, init)));
        }
    }
    classes
}

/// The parts that these subroutines are, and all that they need, in the order of
/// [`ALL`]; nothing of classes that the program owns.
fn closure(calls: &[&str], owns: &dyn Fn(&str) -> bool) -> Vec<&'static Part> {
    let mut wanted: Vec<&str> = calls.to_vec();
    // What a program that has no end of its own comes to.
    wanted.push("Sys.halt");
    let mut seen: Vec<&str> = Vec::new();
    while let Some(name) = wanted.pop() {
        if !seen.contains(&name) && !owns(class_name(name)) {
            seen.push(name);
            let part = ALL.iter().find(|part| part.name == name);
            wanted.extend(part.map_or(&[][..], |part| part.needs));
        }
    }
    ALL.iter()
        .filter(|part| seen.contains(&part.name))
        .collect()
}

fn class_name(subroutine: &str) -> &str {
    subroutine.split('.').next().unwrap_or(subroutine)
}
