//! The operating system of the Hack platform, native: one command a call.
//!
//! Names, argument counts, results and error numbers are those of the
//! official built-in implementation (the API of *The Elements of Computing
//! Systems*, appendix 6). What differs: text goes to a string instead of the
//! screen, keys are a script's and standard input's ([`keyboard`]), and `Sys.wait`
//! takes no commands, only time of the frames that scripts count.

pub(in crate::hack::vm) mod keyboard;
mod memory;
mod screen;
mod string;

pub use memory::Heap;

use super::command::{HEAP, KEYBOARD, Memory, RAM_MASK, SCREEN, SP, STACK, TEMP};

/// Text that a program prints beyond this many bytes is dropped, so that an
/// endless loop of printing does not eat the host's memory.
const TEXT_LIMIT: usize = 1 << 20;

/// Why a command ends the run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Trap {
    /// The program came to its end.
    Halt,
    /// The operating system gives up with a number; the text says why, where known.
    Error(u16, &'static str),
    /// The machine cannot carry on.
    Fault(String),
    /// An address where there is no memory.
    Address(u16),
}

/// The state of the operating system that is not in the RAM.
#[derive(Clone, Debug)]
pub(super) struct Os {
    /// Whose heap it is.
    heap: Heap,
    /// Whether the screen's colour is black.
    black: bool,
    /// What the program printed.
    pub text: String,
    /// The last screen address stored to.
    pub drawn: Option<u16>,
    /// Calls of each function, in the order of `Native::ALL`.
    pub calls: [u64; Native::COUNT],
    /// Words touched by long operations since this was last cleared.
    pub effort: u64,
    /// A store hit the pointers or the stack from outside: what the fused
    /// commands take for granted no longer holds.
    pub odd: bool,
    /// The keyboard, where there is one.
    pub keys: Option<Box<keyboard::Keys>>,
    /// The command that is executed, for who looks at the clock: how many there have been,
    /// and its place in what the engine runs.
    pub now: u64,
    pub place: u64,
    /// Whether `Memory` is the native one.
    pub native_heap: bool,
}

impl Os {
    pub fn new(heap: Heap) -> Self {
        Os {
            heap,
            black: true,
            text: String::new(),
            drawn: None,
            calls: [0; Native::COUNT],
            effort: 0,
            odd: false,
            keys: None,
            now: 0,
            place: 0,
            native_heap: true,
        }
    }

    /// Every store to an address that a program computed comes through here.
    #[inline]
    pub fn store(&mut self, memory: &mut Memory, address: u16, value: u16) {
        let address = address & RAM_MASK;
        memory[usize::from(address)] = value;
        if address < TEMP || (STACK..HEAP).contains(&address) {
            self.odd = true;
        }
        self.drew(address);
    }

    /// Takes note of a store, if it was one to the screen.
    #[inline]
    pub fn drew(&mut self, address: u16) {
        if (SCREEN..KEYBOARD).contains(&address) {
            self.drawn = Some(address);
        }
    }

    fn print(&mut self, c: char) {
        if self.text.len() < TEXT_LIMIT {
            self.text.push(c);
        }
    }
}

/// An address that a program computed, if there is memory: the keyboard's is
/// the last.
#[inline]
pub(super) fn inside(address: u16) -> Result<u16, Trap> {
    if address > KEYBOARD {
        return Err(Trap::Address(address));
    }
    Ok(address)
}

/// The word at an address that a program computed.
fn load(memory: &Memory, address: u16) -> u16 {
    memory[usize::from(address & RAM_MASK)]
}

macro_rules! natives {
    ($($variant:ident $name:literal $arguments:literal)*) => {
        /// A function of the native operating system.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(in crate::hack) enum Native { $($variant),* }

        impl Native {
            /// All of them.
            pub const ALL: &[Native] = &[$(Native::$variant),*];
            /// How many there are.
            pub const COUNT: usize = Self::ALL.len();

            /// The full name, `Class.function`.
            pub const fn name(self) -> &'static str {
                match self { $(Native::$variant => $name),* }
            }

            /// How many arguments it takes, `this` included.
            pub const fn arguments(self) -> u16 {
                match self { $(Native::$variant => $arguments),* }
            }

            /// The function of that name.
            pub fn named(name: &str) -> Option<Native> {
                match name { $($name => Some(Native::$variant),)* _ => None }
            }
        }
    };
}

natives! {
    MathInit "Math.init" 0
    Abs "Math.abs" 1
    Multiply "Math.multiply" 2
    Divide "Math.divide" 2
    Min "Math.min" 2
    Max "Math.max" 2
    Sqrt "Math.sqrt" 1
    MemoryInit "Memory.init" 0
    Peek "Memory.peek" 1
    Poke "Memory.poke" 2
    Alloc "Memory.alloc" 1
    DeAlloc "Memory.deAlloc" 1
    ArrayNew "Array.new" 1
    ArrayDispose "Array.dispose" 1
    StringNew "String.new" 1
    StringDispose "String.dispose" 1
    Length "String.length" 1
    CharAt "String.charAt" 2
    SetCharAt "String.setCharAt" 3
    AppendChar "String.appendChar" 2
    EraseLastChar "String.eraseLastChar" 1
    IntValue "String.intValue" 1
    SetInt "String.setInt" 2
    BackSpace "String.backSpace" 0
    DoubleQuote "String.doubleQuote" 0
    NewLine "String.newLine" 0
    OutputInit "Output.init" 0
    MoveCursor "Output.moveCursor" 2
    PrintChar "Output.printChar" 1
    PrintString "Output.printString" 1
    PrintInt "Output.printInt" 1
    Println "Output.println" 0
    OutputBackSpace "Output.backSpace" 0
    ScreenInit "Screen.init" 0
    ClearScreen "Screen.clearScreen" 0
    SetColor "Screen.setColor" 1
    DrawPixel "Screen.drawPixel" 2
    DrawLine "Screen.drawLine" 4
    DrawRectangle "Screen.drawRectangle" 4
    DrawCircle "Screen.drawCircle" 3
    KeyboardInit "Keyboard.init" 0
    KeyPressed "Keyboard.keyPressed" 0
    ReadChar "Keyboard.readChar" 0
    ReadLine "Keyboard.readLine" 1
    ReadInt "Keyboard.readInt" 1
    Halt "Sys.halt" 0
    Error "Sys.error" 1
    Wait "Sys.wait" 1
}

impl Native {
    /// Whether the first argument is an address: of a word, an array, a string.
    const fn takes_address(self) -> bool {
        matches!(
            self,
            Native::Peek
                | Native::Poke
                | Native::DeAlloc
                | Native::ArrayDispose
                | Native::StringDispose
                | Native::Length
                | Native::CharAt
                | Native::SetCharAt
                | Native::AppendChar
                | Native::EraseLastChar
                | Native::IntValue
                | Native::SetInt
                | Native::PrintString
                | Native::ReadLine
                | Native::ReadInt
        )
    }
}

/// Carries out a call whose arguments are on the stack; answers the result.
pub(super) fn call(native: Native, memory: &mut Memory, os: &mut Os) -> Result<u16, Trap> {
    if let Some(count) = os.calls.get_mut(native as usize) {
        *count += 1;
    }
    let first = memory[usize::from(SP)].wrapping_sub(native.arguments());
    let argument = |n: u16| load(memory, first.wrapping_add(n));
    let [a, b, c, d] = [argument(0), argument(1), argument(2), argument(3)];
    if native.takes_address() {
        inside(a)?;
    }
    match native {
        Native::MathInit | Native::OutputInit | Native::KeyboardInit => Ok(0),
        Native::Abs => Ok(a.cast_signed().wrapping_abs().cast_unsigned()),
        Native::Multiply => Ok(a.wrapping_mul(b)),
        Native::Divide => divide(a, b).ok_or(Trap::Error(3, "division by zero")),
        Native::Min => Ok(a.cast_signed().min(b.cast_signed()).cast_unsigned()),
        Native::Max => Ok(a.cast_signed().max(b.cast_signed()).cast_unsigned()),
        Native::Sqrt if a > 32767 => Err(Trap::Error(4, "square root of a negative number")),
        Native::Sqrt => Ok(a.isqrt()),

        Native::MemoryInit => {
            memory::init(memory, os.heap);
            Ok(0)
        }
        Native::Peek => {
            if a == KEYBOARD {
                keyboard::look(memory, os)?;
            }
            Ok(load(memory, a))
        }
        Native::Poke => {
            os.store(memory, a, b);
            Ok(0)
        }
        Native::Alloc => memory::alloc(memory, os, a),
        Native::DeAlloc | Native::ArrayDispose | Native::StringDispose => {
            memory::de_alloc(memory, os, a);
            Ok(0)
        }
        Native::ArrayNew if a.cast_signed() <= 0 => {
            Err(Trap::Error(2, "an array's size must be positive"))
        }
        Native::ArrayNew => memory::alloc(memory, os, a),

        Native::StringNew => string::new(memory, os, a),
        Native::Length => Ok(string::length(memory, a)),
        Native::CharAt => string::char_at(memory, a, b),
        Native::SetCharAt => string::set_char_at(memory, os, a, b, c),
        Native::AppendChar => string::append_char(memory, os, a, b),
        Native::EraseLastChar => string::erase_last_char(memory, os, a),
        Native::IntValue => Ok(string::int_value(memory, os, a)),
        Native::SetInt => string::set_int(memory, os, a, b),
        Native::BackSpace => Ok(string::BACK_SPACE),
        Native::DoubleQuote => Ok(u16::from(b'"')),
        Native::NewLine => Ok(string::NEW_LINE),

        Native::MoveCursor if a >= 23 || b >= 64 => {
            Err(Trap::Error(20, "the cursor would leave the 23 rows of 64"))
        }
        Native::MoveCursor => Ok(0),
        Native::PrintChar => {
            string::print_char(os, a);
            Ok(0)
        }
        Native::PrintString => {
            string::print_string(memory, os, a);
            Ok(0)
        }
        Native::PrintInt => {
            for c in a.cast_signed().to_string().chars() {
                os.print(c);
            }
            Ok(0)
        }
        Native::Println => {
            os.print('\n');
            Ok(0)
        }
        Native::OutputBackSpace => {
            string::print_char(os, string::BACK_SPACE);
            Ok(0)
        }

        Native::ScreenInit => {
            os.black = true;
            Ok(0)
        }
        Native::ClearScreen => {
            screen::clear(memory, os);
            Ok(0)
        }
        Native::SetColor => {
            os.black = a != 0;
            Ok(0)
        }
        Native::DrawPixel => screen::pixel(memory, os, a, b),
        Native::DrawLine => screen::line(memory, os, (a, b), (c, d)),
        Native::DrawRectangle => screen::rectangle(memory, os, (a, b), (c, d)),
        Native::DrawCircle => screen::circle(memory, os, (a, b), c),

        Native::KeyPressed => {
            keyboard::look(memory, os)?;
            Ok(load(memory, KEYBOARD))
        }
        Native::ReadChar => keyboard::read_char(memory, os),
        Native::ReadLine => keyboard::read_line(memory, os, a),
        Native::ReadInt => keyboard::read_int(memory, os, a),

        Native::Halt => Err(Trap::Halt),
        Native::Error => Err(Trap::Error(a, "")),
        Native::Wait if a.cast_signed() < 0 => {
            Err(Trap::Error(1, "a time to wait must not be negative"))
        }
        Native::Wait => {
            if let Some(keys) = &mut os.keys {
                keys.pass(a);
            }
            Ok(0)
        }
    }
}

/// Signed division that truncates; `None` for a zero divisor. -32768 / -1
/// wraps to -32768.
#[inline]
pub(super) fn divide(a: u16, b: u16) -> Option<u16> {
    if b == 0 {
        return None;
    }
    Some(
        a.cast_signed()
            .wrapping_div(b.cast_signed())
            .cast_unsigned(),
    )
}

/// Prepares the RAM as the native `Sys.init` does.
pub(super) fn init(memory: &mut Memory, heap: Heap) {
    memory::init(memory, heap);
}
