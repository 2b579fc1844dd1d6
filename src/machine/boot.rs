//! BASIC discs: which program `!BOOT` starts, and where programs begin then.
//!
//! `!BOOT` is typed, as by `*EXEC`: what is understood is `CHAIN"NAME"`, `*LOAD NAME`, `PAGE=` and
//! `*KEY`, whose text comes to be typed after it; other commands of the operating system only set
//! the machine up.

use super::dfs::{self, DiscFile, EXEC};

const MACHINE_CODE: &str =
    "its !BOOT starts machine code: `slowlight vm 6502:bbc` runs what discs of ours start";

/// A program that a disc starts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Booted {
    /// It, in tokens.
    pub program: DiscFile,
    /// Where programs begin, if `!BOOT` says so.
    pub page: Option<u16>,
    /// All files of the disc.
    pub files: Vec<DiscFile>,
}

/// The program of a disc image.
///
/// # Errors
/// What is wrong with the image, or why nothing of it is started in BASIC.
pub fn program(image: &[u8]) -> Result<Booted, String> {
    let disc = dfs::read(image)?;
    if disc.option == dfs::RUN {
        return Err(MACHINE_CODE.to_owned());
    }
    let Some(boot) = disc.find("!BOOT").filter(|_| disc.option == EXEC) else {
        return Err("SHIFT and BREAK start nothing: it has no !BOOT to be typed".to_owned());
    };
    let text: String = boot.bytes.iter().map(|b| char::from(*b)).collect();
    let typed = Typed::read(&text)?;
    let Some(name) = typed.name else {
        return Err("its !BOOT starts no program".to_owned());
    };
    let Some(program) = disc.find(&name) else {
        return Err(format!("its !BOOT starts {name}, which is not on it"));
    };
    Ok(Booted {
        program: program.clone(),
        page: typed.page,
        files: disc.files,
    })
}

/// What the lines of a `!BOOT` come to.
#[derive(Default)]
struct Typed {
    name: Option<String>,
    page: Option<u16>,
}

impl Typed {
    fn read(boot: &str) -> Result<Self, String> {
        let mut typed = Self::default();
        let mut keys = Vec::new();
        for line in boot.split(['\r', '\n']).map(str::trim) {
            if command(line, "RUN").is_some() {
                return Err(MACHINE_CODE.to_owned());
            }
            if let Some(key) = command(line, "KEY") {
                let text = key.trim_start_matches(|c: char| c.is_ascii_digit());
                keys.extend(text.split("|M").map(str::trim));
            } else if !typed.line(line)? {
                return Err(format!(
                    "its !BOOT has what this machine does not read: {line}"
                ));
            }
        }
        for line in keys {
            // A key's other lines move the program and start it.
            typed.line(line)?;
        }
        Ok(typed)
    }

    /// Takes a line; answers whether it was understood.
    fn line(&mut self, line: &str) -> Result<bool, String> {
        if let Some(rest) = command(line, "LOAD") {
            let name = rest.split_whitespace().next();
            self.name = name.map(|n| n.trim_matches('"').to_owned());
        } else if let Some(rest) = line.strip_prefix("CHAIN") {
            self.name = Some(rest.trim().trim_matches('"').to_owned());
        } else if let Some(rest) = line.strip_prefix("PAGE=&") {
            let page = u16::from_str_radix(rest.trim(), 16).ok();
            let page = page.filter(|page| page % 0x100 == 0 && (0xE00..0x7C00).contains(page));
            let message = || format!("its !BOOT sets PAGE to &{rest}: &E00 to &7B00, in pages");
            self.page = Some(page.ok_or_else(message)?);
        } else {
            return Ok(line.is_empty() || line.starts_with('*'));
        }
        Ok(true)
    }
}

/// What follows a command of the operating system.
fn command<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let rest = line.strip_prefix('*')?.trim_start();
    let (head, rest) = rest.split_at_checked(name.len())?;
    head.eq_ignore_ascii_case(name).then(|| rest.trim_start())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn file(name: &str, bytes: &[u8]) -> DiscFile {
        DiscFile {
            name: name.to_owned(),
            load: 0x1900,
            exec: 0x8023,
            bytes: bytes.to_vec(),
        }
    }

    fn booted(boot: &str) -> Result<Booted, String> {
        let files = [
            file("!BOOT", boot.as_bytes()),
            file("ONE", b"\r\xff"),
            file("TWO", b"\r\0\x0a\x05\xf1\r\xff"),
        ];
        program(&dfs::image("T", &files).unwrap())
    }

    #[test]
    fn discs_that_are_built_start_their_program() {
        for (page, said) in [
            (0x1900, None),
            (0x0E00, Some(0x0E00)),
            (0x1100, Some(0x1100)),
        ] {
            let tokens = b"\r\0\x0a\x05\xf1\r\xff";
            let disc = dfs::bootable("mirrors", tokens, page).unwrap();
            let booted = program(&disc).unwrap();
            assert_eq!(booted.program.name, "MIRRORS");
            assert_eq!(
                (booted.program.bytes.as_slice(), booted.page),
                (&tokens[..], said)
            );
        }
    }

    #[test]
    fn other_boots_are_read_or_refused() {
        let name = |boot| booted(boot).map(|b| (b.program.name, b.page));
        let one = |page| Ok(("ONE".to_owned(), page));
        assert_eq!(name("*DISC\r\n CHAIN \"ONE\"\r"), one(None));
        assert_eq!(name("PAGE=&1100\rCHAIN\"$.one\""), one(Some(0x1100)));
        assert_eq!(
            name("*load ONE 3000\r*KEY 0 PAGE=&F00|MOLD|MRUN|M\r"),
            one(Some(0xF00))
        );
        assert_eq!(booted("CHAIN\"TWO\"").unwrap().files.len(), 3);
        for (boot, says) in [
            ("", "starts no program"),
            ("*HELP\r", "starts no program"),
            ("CHAIN\"THREE\"\r", "starts THREE, which is not on it"),
            ("MODE7:CHAIN\"ONE\"\r", "does not read: MODE7"),
            ("PAGE=&1234\rCHAIN\"ONE\"\r", "PAGE to &1234"),
            ("PAGE=&FFFFF\rCHAIN\"ONE\"\r", "PAGE to &FFFFF"),
        ] {
            let said = booted(boot).unwrap_err();
            assert!(said.contains(says), "{boot}: {said}");
        }
    }

    #[test]
    fn discs_without_a_program_in_basic_are_refused() {
        let code = dfs::bootable_code("code", &[0, 0x20, 0x60]).unwrap();
        assert!(program(&code).unwrap_err().contains("vm 6502:bbc"));
        let mut disc = dfs::bootable("one", b"\r\xff", 0x1900).unwrap();
        disc[0x106] &= 0x0F;
        assert!(program(&disc).unwrap_err().contains("start nothing"));
        disc[0x106] |= dfs::RUN << 4;
        assert!(program(&disc).unwrap_err().contains("vm 6502:bbc"));
        assert!(program(&disc[..300]).unwrap_err().contains("no disc image"));
    }
}
