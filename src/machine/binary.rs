//! Programs for the 6502 that are no source: where they are loaded and where they begin.
//!
//! A file is told by what is in it: printable text is assembly, whatever it is called. A
//! binary says where it lies itself where it is a `.prg` (a Commodore's program file: two
//! bytes of load address, low byte first) or a disc of a BBC Micro, `.ssd`, whose catalogue
//! has both addresses; for any other somebody has to say.

use super::board::{Board, Config};
use super::dfs::{self, Disc, DiscFile};
use super::{File, refused};
use crate::failure::{Failure, Outcome};
use slowlight_vm::Fault;

/// Names by which assembly is known that holds bytes other than UTF-8, in remarks say.
const SOURCES: [&str; 7] = ["asm", "s", "a65", "inc", "a", "src", "6502"];

/// Where a VCS has its cartridge, whose vectors say where it begins.
const CARTRIDGE: u16 = 0xF000;

/// Bytes for a place in memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Binary {
    /// Where they go.
    pub at: u16,
    /// Where the program begins; where it is not said, where the machine finds it.
    pub start: Option<u16>,
    pub bytes: Vec<u8>,
}

/// The address that is written as `$2000`, `&2000`, `0x2000` or, in decimal, `8192`.
///
/// # Errors
/// What is wrong with it.
pub fn address(text: &str) -> Result<u16, String> {
    let hex = (text.strip_prefix(['$', '&']))
        .or(text.strip_prefix("0x"))
        .or(text.strip_prefix("0X"));
    let (digits, radix) = match hex {
        Some(digits) => (digits, 16),
        None => (text, 10),
    };
    let plain = !digits.is_empty() && digits.chars().all(|c| c.is_digit(radix));
    match u32::from_str_radix(digits, radix) {
        Ok(value) if plain && value <= 0xFFFF => Ok(value as u16),
        _ if plain => Err("an address is at most 65535, $FFFF".to_owned()),
        _ => Err("an address is hexadecimal, `0x2000`, `$2000` or `&2000` (quoted for the shell), or decimal, `8192`".to_owned()),
    }
}

/// Whether a file is a text: UTF-8, or what is called a source, without control characters
/// but those that part words and lines. A disc never is.
pub(super) fn is_text(file: &File) -> bool {
    if matches!(file.extension().as_str(), "ssd" | "dsd") {
        return false;
    }
    let parts = |b: &u8| matches!(b, b'\t' | b'\n' | b'\r' | 0x0C);
    let control = |b: &u8| (*b < 0x20 && !parts(b)) || *b == 0x7F;
    let printable = !file.bytes.iter().any(control);
    let utf8 = std::str::from_utf8(&file.bytes).is_ok();
    printable && (utf8 || SOURCES.contains(&file.extension().as_str()))
}

/// The bytes of a file that is no text, and where they belong.
///
/// # Errors
/// Where that is not said, or said twice; a disc that starts no program for the machine.
pub(super) fn read(file: &File, config: Config) -> Outcome<Binary> {
    let Config {
        board, at, start, ..
    } = config;
    let name = &file.name;
    let usage = |message: String| Err(Failure::Usage(message));
    let said = at.is_some() || start.is_some();
    match file.extension().as_str() {
        _ if board == Board::Vcs => Ok(Binary {
            at: CARTRIDGE,
            start: None,
            bytes: file.bytes.clone(),
        }),
        "ssd" if board != Board::Bbc => usage(format!(
            "{name} is a BBC Micro's disc: `slowlight vm 6502:bbc {name}`"
        )),
        "ssd" if said => usage(format!(
            "{name}: a disc's catalogue says where its programs lie and begin; leave --at and --start out"
        )),
        "ssd" => {
            let wrong = |message: String| Failure::Wrong(format!("{name}: {message}"));
            let disc = dfs::read(&file.bytes).map_err(wrong)?;
            let program = started(&disc).map_err(wrong)?;
            Ok(Binary {
                at: program.load,
                start: Some(program.exec),
                bytes: program.bytes,
            })
        }
        "dsd" => Err(Failure::Wrong(format!(
            "{name}: discs of two sides (.dsd) are not read: take the side that you want out of it, as .ssd"
        ))),
        "prg" if at.is_some() => usage(format!(
            "{name}: a .prg's first two bytes say where it lies; leave --at out"
        )),
        "prg" => match file.bytes.as_slice() {
            [lo, hi, bytes @ ..] => Ok(Binary {
                at: u16::from_le_bytes([*lo, *hi]),
                start,
                bytes: bytes.to_vec(),
            }),
            _ => {
                let message = "a .prg begins with two bytes of load address".to_owned();
                Err(refused("machine", name, &[fault(message)]))
            }
        },
        _ => match at {
            Some(at) => Ok(Binary {
                at,
                start: Some(start.unwrap_or(at)),
                bytes: file.bytes.clone(),
            }),
            None => usage(format!(
                "{name} is a binary, and nothing says where it lies: give --at ADDR, and --start \
                 ADDR where it does not begin with its first byte, in hexadecimal as 0x2000; a \
                 file that begins with two bytes of load address is called .prg"
            )),
        },
    }
}

fn fault(message: String) -> Fault {
    Fault {
        message,
        file: None,
        line: None,
        column: None,
    }
}

/// The program that a disc starts, as SHIFT and BREAK would.
fn started(disc: &Disc) -> Result<DiscFile, String> {
    let boot = || {
        disc.find("!BOOT")
            .ok_or("there is no file `!BOOT` on this disc, so it starts nothing".to_owned())
    };
    let all: Vec<&str> = disc.files.iter().map(|f| f.name.as_str()).collect();
    let all = all.join(", ");
    let found = match disc.option {
        dfs::RUN => boot()?.clone(),
        dfs::EXEC => typed(disc, &boot()?.bytes)?,
        _ => {
            return Err(format!(
                "this disc starts nothing when SHIFT and BREAK are pressed; its files are {all}"
            ));
        }
    };
    match found.exec {
        0x8000.. => Err(format!(
            "{} begins in a ROM, at &{:04X}, as programs in BASIC do: `slowlight vm bbc` is for those",
            found.name, found.exec
        )),
        _ => Ok(found),
    }
}

/// The program that lines run which are read from `!BOOT` as if they were typed.
fn typed(disc: &Disc, lines: &[u8]) -> Result<DiscFile, String> {
    let text = String::from_utf8_lossy(lines);
    for line in text.split(['\r', '\n']) {
        let line = line.trim();
        let Some(command) = line.strip_prefix('*') else {
            if line.is_empty() {
                continue;
            }
            return Err(format!(
                "!BOOT types `{line}`, to BASIC: `slowlight vm bbc` is for programs in BASIC"
            ));
        };
        let command = command.trim_start_matches([' ', '*']);
        if command.is_empty() || command.starts_with('|') {
            continue;
        }
        if let Some(program) = program(disc, command) {
            return Ok(program.clone());
        }
        return Err(format!(
            "!BOOT types `{line}`; of the system's commands only *RUN of a file on the disc is bundled"
        ));
    }
    Err("!BOOT runs no program".to_owned())
}

/// The file that a command of the system's runs: by `RUN`, `/`, or its name alone.
fn program<'d>(disc: &'d Disc, command: &str) -> Option<&'d DiscFile> {
    let word = |text: &str| -> String {
        let word = text.split_whitespace().next().unwrap_or_default();
        word.trim_matches('"').to_owned()
    };
    let upper = command.to_ascii_uppercase();
    let ways = ["RUN", "RU.", "R.", "/"];
    let behind = ways.iter().find_map(|way| upper.strip_prefix(way));
    let named = behind.and_then(|name| disc.find(&word(name)));
    named.or_else(|| disc.find(&word(&upper)))
}

#[cfg(test)]
#[path = "binary_tests.rs"]
mod tests;
