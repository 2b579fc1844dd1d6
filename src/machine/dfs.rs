//! Disc images for the Micro: single-sided, 80 tracks, Acorn's DFS (`.ssd`).
//!
//! The first two sectors are the catalogue: the title, the number of files and
//! what holding SHIFT at a start does, then for each file its name in sector 0
//! and where it is loaded, its length and its first sector in sector 1, the
//! file that lies furthest back first. Files lie in whole sectors, from sector
//! 2 on. Numbers are little-endian; what exceeds 16 bits is in the bits of one
//! byte.

const SECTOR: usize = 256;
/// Sectors of 80 tracks.
const SECTORS: usize = 800;
/// Files that a catalogue holds.
const FILES: usize = 31;
/// What SHIFT and BREAK do with `!BOOT`: `*EXEC`, as if it was typed.
const EXEC: u8 = 3;
/// Addresses in the Micro itself, rather than in a second processor: both bits above 16.
const HOST: u32 = 0x3_0000;

/// A file on a disc.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DiscFile {
    /// Up to seven characters; more are cut off.
    pub name: String,
    /// Where `*LOAD` puts it.
    pub load: u16,
    /// Where `*RUN` begins.
    pub exec: u16,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// A disc image; `None` where the files do not fit it.
pub fn image(title: &str, files: &[DiscFile]) -> Option<Vec<u8>> {
    let mut disc = vec![0; 2 * SECTOR];
    let text = |text: &str, length: usize| -> Vec<u8> {
        let plain = text.bytes().filter(u8::is_ascii_graphic);
        plain.chain(std::iter::repeat(b' ')).take(length).collect()
    };
    let title = text(&title.to_ascii_uppercase(), 12);
    disc.get_mut(..8)?.copy_from_slice(title.get(..8)?);
    disc.get_mut(SECTOR..SECTOR + 4)?
        .copy_from_slice(title.get(8..)?);
    let count = u8::try_from(files.len()).ok()?;
    if files.len() > FILES {
        return None;
    }
    let [high, low] = (SECTORS as u16).to_be_bytes();
    disc.get_mut(SECTOR + 4..SECTOR + 8)?
        .copy_from_slice(&[0, count * 8, high | EXEC << 4, low]);
    for (k, file) in files.iter().enumerate() {
        let start = disc.len() / SECTOR;
        // The last file comes first.
        let entry = 8 * (files.len() - k);
        disc.get_mut(entry..entry + 7)?
            .copy_from_slice(&text(&file.name, 7));
        *disc.get_mut(entry + 7)? = b'$';
        let length = u32::try_from(file.bytes.len()).ok()?;
        let (load, exec) = (HOST | u32::from(file.load), HOST | u32::from(file.exec));
        let start16 = u32::try_from(start).ok()?;
        let mut fields = Vec::new();
        for number in [load, exec, length] {
            fields.extend((number as u16).to_le_bytes());
        }
        let above = |number: u32, at: u32| (number >> 16 & 3) << at;
        let bits = above(exec, 6) | above(length, 4) | above(load, 2) | start16 >> 8 & 3;
        fields.extend([bits as u8, start16 as u8]);
        disc.get_mut(SECTOR + entry..SECTOR + entry + 8)?
            .copy_from_slice(&fields);
        disc.extend(&file.bytes);
        disc.resize(disc.len().next_multiple_of(SECTOR), 0);
    }
    (disc.len() <= SECTORS * SECTOR).then_some(disc)
}

/// A disc that runs a tokenised program when SHIFT is held at a start.
///
/// `page`: where programs begin. The disc system's own is &1900; a program for
/// a lower one is loaded above it, moved down once the disc system is put
/// away, and started from there: by the keyboard's first function key, since
/// nothing reads `!BOOT` any more by then.
pub fn bootable(name: &str, tokens: &[u8], page: u16) -> Option<Vec<u8>> {
    let name = file_name(name);
    let boot = if page >= DISC_PAGE {
        format!("*BASIC\rCHAIN\"{name}\"\r")
    } else {
        let last = tokens.len().next_multiple_of(4) - 4;
        format!(
            "*BASIC\r*KEY0*TAPE|MFORA%=0TO{last} STEP4:A%!&{page:X}=A%!&{ABOVE:X}:NEXT|MPAGE=&{page:X}|MOLD|MRUN|M\r\
             *LOAD {name} {ABOVE:X}\r*FX138,0,128\r"
        )
    };
    let file = |name: &str, load: u16, bytes: &[u8]| DiscFile {
        name: name.to_owned(),
        load,
        exec: BASIC,
        bytes: bytes.to_vec(),
    };
    let files = [file("!BOOT", 0, boot.as_bytes()), file(&name, page, tokens)];
    image(&name, &files)
}

/// A disc that runs machine code when SHIFT is held at a start: two bytes of load address,
/// where it is begun as well, and what goes there.
pub fn bootable_code(name: &str, image: &[u8]) -> Option<Vec<u8>> {
    let [lo, hi, code @ ..] = image else {
        return None;
    };
    let at = u16::from_le_bytes([*lo, *hi]);
    let name = file_name(name);
    let boot = DiscFile {
        name: "!BOOT".to_owned(),
        load: 0,
        exec: 0,
        bytes: format!("*RUN {name}\r").into_bytes(),
    };
    let program = DiscFile {
        name: name.clone(),
        load: at,
        exec: at,
        bytes: code.to_vec(),
    };
    self::image(&name, &[boot, program])
}

/// A program's name as the disc system has it.
fn file_name(name: &str) -> String {
    let letters = name.chars().filter(char::is_ascii_alphanumeric);
    let name: String = letters.take(7).collect();
    match name.to_ascii_uppercase() {
        name if name.is_empty() => "PROGRAM".to_owned(),
        name => name,
    }
}

/// Where programs begin with a disc system.
pub const DISC_PAGE: u16 = 0x1900;
/// Where a program for a lower PAGE is put first.
const ABOVE: u16 = 0x3000;
/// Where BASIC is entered.
const BASIC: u16 = 0x8023;

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// Reads a disc back as its files, the first in the catalogue first, and what SHIFT does.
    fn read(disc: &[u8]) -> (String, u8, Vec<DiscFile>) {
        let mut title = disc[..8].to_vec();
        title.extend(&disc[256..260]);
        let sectors = usize::from(disc[262] & 3) << 8 | usize::from(disc[263]);
        assert_eq!(sectors, 800);
        let files = (1..=usize::from(disc[261]) / 8).map(|k| {
            let name = String::from_utf8(disc[8 * k..8 * k + 7].to_vec()).unwrap();
            assert_eq!(disc[8 * k + 7], b'$');
            let at = |n: usize| usize::from(disc[256 + 8 * k + n]);
            let word = |n: usize| at(n) | at(n + 1) << 8;
            let (bits, start) = (at(6), at(7) | (at(6) & 3) << 8);
            let length = word(4) | (bits >> 4 & 3) << 16;
            assert_eq!((bits >> 2 & 3, bits >> 6), (3, 3));
            DiscFile {
                name: name.trim_end().to_owned(),
                load: word(0) as u16,
                exec: word(2) as u16,
                bytes: disc[start * 256..start * 256 + length].to_vec(),
            }
        });
        let files = files.collect();
        let title = String::from_utf8(title).unwrap().trim_end().to_owned();
        (title, disc[262] >> 4 & 3, files)
    }

    #[test]
    fn what_is_written_is_read_back() {
        let mut files: Vec<DiscFile> = (0..31u32)
            .map(|k| DiscFile {
                name: format!("F{k}"),
                load: 0x1900 + k as u16,
                exec: 0x8023,
                bytes: (0..k * 211).map(|n| (n % 251) as u8).collect(),
            })
            .collect();
        // Longer than 16 bits can say, and beyond sector 255.
        files[3].bytes = vec![7; 70_000];
        let disc = image("a long title indeed", &files).unwrap();
        assert_eq!(disc.len() % 256, 0);
        let (title, boot, mut found) = read(&disc);
        assert_eq!((title.as_str(), boot), ("ALONGTITLEIN", 3));
        found.reverse();
        assert_eq!(found, files);
    }

    #[test]
    fn what_does_not_fit_a_disc_is_refused() {
        let file = |length| DiscFile {
            name: "F".to_owned(),
            load: 0,
            exec: 0,
            bytes: vec![0; length],
        };
        assert!(image("", &vec![file(1); 32]).is_none());
        assert!(image("", &[file(798 * 256)]).is_some());
        assert!(image("", &[file(798 * 256 + 1)]).is_none());
    }

    #[test]
    fn a_disc_starts_its_program() {
        let disc = bootable("two-mirrors.x", b"\r\xff", 0x1900).unwrap();
        let (title, boot, files) = read(&disc);
        assert_eq!((title.as_str(), boot), ("TWOMIRR", 3));
        assert_eq!((files[0].name.as_str(), files[0].load), ("TWOMIRR", 0x1900));
        assert_eq!(files[0].bytes, b"\r\xff");
        assert_eq!(files[1].name, "!BOOT");
        assert_eq!(files[1].bytes, b"*BASIC\rCHAIN\"TWOMIRR\"\r");
        let code = bootable_code("two-mirrors.x", &[0x34, 0x1a, 0xa9, 0x60]).unwrap();
        let (_, boot, files) = read(&code);
        assert_eq!(boot, 3);
        assert_eq!((files[0].load, files[0].exec), (0x1a34, 0x1a34));
        assert_eq!(files[0].bytes, [0xa9, 0x60]);
        assert_eq!(files[1].bytes, b"*RUN TWOMIRR\r");
        let low = bootable("m", &[13; 1001], 0xe00).unwrap();
        let boot = String::from_utf8(read(&low).2[1].bytes.clone()).unwrap();
        assert!(boot.contains("FORA%=0TO1000 STEP4:A%!&E00=A%!&3000:NEXT|MPAGE=&E00"));
        // What a function key and BASIC's line hold.
        assert!(boot.split('\r').all(|line| line.len() < 230));
    }
}
