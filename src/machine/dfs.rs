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
pub const EXEC: u8 = 3;
/// The same with `*RUN`, as machine code.
pub const RUN: u8 = 2;
/// Addresses in the Micro itself, rather than in a second processor: both bits above 16.
const HOST: u32 = 0x3_0000;

/// A file on a disc.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DiscFile {
    /// Up to seven characters; more are cut off. What is read and lies in another
    /// directory than `$` has that in front, as `A.NAME`.
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

/// What is on a disc.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Disc {
    /// Its title.
    pub title: String,
    /// What SHIFT and BREAK do with `!BOOT`: nothing, `*LOAD`, [`RUN`] or [`EXEC`].
    pub option: u8,
    /// Its files, in the catalogue's order.
    pub files: Vec<DiscFile>,
}

impl Disc {
    /// The file of a name, which may have its drive and directory before it; capital and
    /// small letters are alike.
    pub fn find(&self, name: &str) -> Option<&DiscFile> {
        let name = name.strip_prefix(":0.").unwrap_or(name);
        let name = name.strip_prefix("$.").unwrap_or(name);
        let same = |file: &&DiscFile| file.name.eq_ignore_ascii_case(name);
        self.files.iter().find(same)
    }
}

/// Reads a disc's catalogue and its files. An image may end behind its last file.
///
/// # Errors
/// What is wrong with the image.
pub fn read(disc: &[u8]) -> Result<Disc, String> {
    let (Some(names), Some(numbers)) = (disc.get(..SECTOR), disc.get(SECTOR..2 * SECTOR)) else {
        return Err("this is no disc image: it ends within its catalogue".to_owned());
    };
    let no = |what: &str| Err(format!("this is no disc image of Acorn's DFS: {what}"));
    let byte = |from: &[u8], at: usize| from.get(at).copied().unwrap_or(0);
    let text = |bytes: &[u8]| -> Option<String> {
        // Unused places are blanks, or nothing.
        let bytes = bytes.iter().map(|b| if *b == 0 { b' ' } else { b & 0x7F });
        let text: String = bytes.map(char::from).collect();
        let printable = text.bytes().all(|b| (b' '..=b'~').contains(&b));
        printable.then(|| text.trim_end().to_owned())
    };
    let (bits, ends) = (byte(numbers, 6), byte(numbers, 5));
    let sectors = usize::from(bits & 3) << 8 | usize::from(byte(numbers, 7));
    if ends % 8 != 0 || usize::from(ends) / 8 > FILES {
        return no("its catalogue has no whole number of files");
    }
    if !(2..=SECTORS).contains(&sectors) {
        return no(&format!("it would have {sectors} sectors"));
    }
    let mut files = Vec::new();
    for at in (8..=usize::from(ends)).step_by(8) {
        let entry = names.get(at..at + 8).unwrap_or_default();
        let of = numbers.get(at..at + 8).unwrap_or_default();
        let (Some(name), Some(directory)) = (
            text(entry.get(..7).unwrap_or_default()),
            text(entry.get(7..).unwrap_or_default()),
        ) else {
            return no("a file's name has characters that cannot be printed");
        };
        let name = match directory.as_str() {
            "$" => name,
            directory => format!("{directory}.{name}"),
        };
        let word = |at: usize| u16::from_le_bytes([byte(of, at), byte(of, at + 1)]);
        let bits = byte(of, 6);
        let length = usize::from(bits >> 4 & 3) << 16 | usize::from(word(4));
        let start = usize::from(bits & 3) << 8 | usize::from(byte(of, 7));
        if length > 0 && (start < 2 || start + length.div_ceil(SECTOR) > sectors) {
            return no(&format!("{name} lies outside the disc"));
        }
        let Some(bytes) = disc.get(start * SECTOR..start * SECTOR + length) else {
            return Err(format!("the image ends within the disc's file {name}"));
        };
        files.push(DiscFile {
            name,
            load: word(0),
            exec: word(2),
            bytes: bytes.to_vec(),
        });
    }
    let title = [names.get(..8), numbers.get(..4)].map(Option::unwrap_or_default);
    Ok(Disc {
        title: text(&title.concat()).unwrap_or_default(),
        option: bits >> 4 & 3,
        files,
    })
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

    /// Where in an image the catalogue has a file's numbers, the first file's first.
    fn numbers(file: usize) -> usize {
        SECTOR + 8 * (file + 1)
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
        let mut found = read(&disc).unwrap();
        assert_eq!((found.title.as_str(), found.option), ("ALONGTITLEIN", EXEC));
        found.files.reverse();
        assert_eq!(found.files, files);
        // As the catalogue is written: a file in the host's memory, in directory $.
        assert_eq!(&disc[SECTOR + 4..SECTOR + 8], [0, 31 * 8, 0x33, 0x20]);
        assert_eq!(&disc[8..16], b"F30    $");
        assert_eq!(disc[numbers(0) + 6] & 0xCC, 0xCC);
        assert_eq!(found.files[3], *read(&disc).unwrap().find("$.f3").unwrap());
    }

    #[test]
    fn wrong_images_are_told() {
        let file = DiscFile {
            name: "CODE".to_owned(),
            load: 0x2000,
            exec: 0x2003,
            bytes: (0..=255).cycle().take(700).collect(),
        };
        let disc = image("T", std::slice::from_ref(&file)).unwrap();
        assert_eq!(read(&disc).unwrap().files, [file]);
        assert!(read(&disc[..2 * SECTOR + 700]).is_ok());
        let wrong = |change: &dyn Fn(&mut Vec<u8>)| {
            let mut disc = disc.clone();
            change(&mut disc);
            read(&disc).unwrap_err()
        };
        assert!(wrong(&|d| d.truncate(511)).contains("ends within its catalogue"));
        assert!(
            wrong(&|d| d.truncate(2 * SECTOR + 699)).contains("ends within the disc's file CODE")
        );
        assert!(wrong(&|d| d[SECTOR + 5] = 9).contains("no whole number"));
        assert!(wrong(&|d| d[SECTOR + 7] = 0xFF).contains("1023 sectors"));
        assert!(wrong(&|d| d[9] = 7).contains("cannot be printed"));
        assert!(wrong(&|d| d[numbers(0) + 7] = 1).contains("outside the disc"));
        assert!(
            wrong(&|d| (d[numbers(0) + 6], d[numbers(0) + 7]) = (0xCF, 0x1E))
                .contains("outside the disc")
        );
        // Another directory, and a file that is locked.
        let mut other = disc.clone();
        other[15] = b'A' | 0x80;
        assert_eq!(read(&other).unwrap().files[0].name, "A.CODE");
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
        let Disc {
            title,
            option,
            files,
        } = read(&disc).unwrap();
        assert_eq!((title.as_str(), option), ("TWOMIRR", EXEC));
        assert_eq!((files[0].name.as_str(), files[0].load), ("TWOMIRR", 0x1900));
        assert_eq!(files[0].bytes, b"\r\xff");
        assert_eq!(files[1].name, "!BOOT");
        assert_eq!(files[1].bytes, b"*BASIC\rCHAIN\"TWOMIRR\"\r");
        let code = bootable_code("two-mirrors.x", &[0x34, 0x1a, 0xa9, 0x60]).unwrap();
        let Disc { option, files, .. } = read(&code).unwrap();
        assert_eq!(option, EXEC);
        assert_eq!((files[0].load, files[0].exec), (0x1a34, 0x1a34));
        assert_eq!(files[0].bytes, [0xa9, 0x60]);
        assert_eq!(files[1].bytes, b"*RUN TWOMIRR\r");
        let low = bootable("m", &[13; 1001], 0xe00).unwrap();
        let boot = String::from_utf8(read(&low).unwrap().files[1].bytes.clone()).unwrap();
        assert!(boot.contains("FORA%=0TO1000 STEP4:A%!&E00=A%!&3000:NEXT|MPAGE=&E00"));
        // What a function key and BASIC's line hold.
        assert!(boot.split('\r').all(|line| line.len() < 230));
    }
}
