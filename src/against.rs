//! Other pictures that a machine's picture is held against: what an original program
//! drew, say, or the same scene in another format.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::picture::FileFormat;
use crate::trial::Trial;
use std::path::Path;

/// The inks of a picture from a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reference {
    width: u32,
    height: u32,
    /// Row by row from the top left.
    inks: Vec<u8>,
}

impl Reference {
    /// Reads a picture such as `-o` writes: a PNG with a palette, or a binary PGM of ink
    /// indices or PBM, black being ink 0.
    ///
    /// # Errors
    /// Where it cannot be read, or is no such picture.
    pub fn read(path: &Path) -> Outcome<Reference> {
        let format = FileFormat::of(path)?;
        let bytes = files::read(path)?;
        let found = match format {
            FileFormat::Png => indexed(&bytes),
            FileFormat::Pgm => plain(&bytes, b"P5"),
            FileFormat::Pbm => plain(&bytes, b"P4"),
        };
        found.map_err(|why| Failure::Wrong(format!("{}: {why}", path.display())))
    }

    /// How many inks of a machine's picture are others. A picture of the whole scene
    /// may be compared with some of its rows.
    ///
    /// # Errors
    /// Where the sizes are not the same.
    pub fn differing(&self, trial: &Trial) -> Outcome<u64> {
        let window = trial.native.window;
        let whole = trial.plan.graph.image.on_screen();
        let size = (self.width, self.height);
        let first = if size == (window.width(), window.height()) {
            0
        } else if size == whole && whole.0 == window.width() {
            window.rows.0
        } else {
            return Err(Failure::Wrong(format!(
                "a picture of {} x {} pixels cannot be compared with one of {} x {}",
                size.0,
                size.1,
                window.width(),
                window.height()
            )));
        };
        let own = self.inks.iter().skip(first as usize * self.width as usize);
        let inks = trial.picture.iter().flat_map(|picture| &picture.inks);
        Ok(own.zip(inks).filter(|(a, b)| a != b).count() as u64)
    }
}

/// A PNG's indices into its palette.
fn indexed(bytes: &[u8]) -> Result<Reference, String> {
    let wrong = |error: png::DecodingError| format!("not a PNG that can be read: {error}");
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(wrong)?;
    let info = reader.info();
    if (info.color_type, info.bit_depth) != (png::ColorType::Indexed, png::BitDepth::Eight) {
        return Err("this PNG has colours, not inks; compare with one that `-o` wrote".to_owned());
    }
    let (width, height) = (info.width, info.height);
    let size = reader.output_buffer_size();
    let mut inks = vec![0; size.ok_or("this PNG is too large")?];
    reader.next_frame(&mut inks).map_err(wrong)?;
    Ok(Reference {
        width,
        height,
        inks,
    })
}

/// A binary PGM of at most 256 values, or a PBM.
fn plain(bytes: &[u8], magic: &[u8]) -> Result<Reference, String> {
    let name = String::from_utf8_lossy(magic).into_owned();
    let mut rest = bytes
        .strip_prefix(magic)
        .ok_or_else(|| format!("it does not begin with {name}"))?;
    let bits = magic == b"P4";
    let mut number = || -> Result<u32, String> {
        rest = behind_blanks(rest);
        let digits = rest.iter().take_while(|b| b.is_ascii_digit()).count();
        let (text, behind) = rest.split_at(digits);
        rest = behind;
        let text = String::from_utf8_lossy(text);
        text.parse()
            .map_err(|_| format!("its head is not that of a {name} file"))
    };
    let (width, height) = (number()?, number()?);
    let most = if bits { 1 } else { number()? };
    if most > 255 {
        return Err(format!("its values go to {most}; inks end at 255"));
    }
    // One blank ends the head.
    let data = rest.get(1..).unwrap_or_default();
    let across = if bits { width.div_ceil(8) } else { width } as usize;
    let size = across.checked_mul(height as usize);
    let data = match size.and_then(|size| data.get(..size)) {
        Some(data) if across > 0 => data,
        _ => return Err(format!("it is not {width} x {height} pixels long")),
    };
    let inks = match bits {
        false => data.to_vec(),
        true => data
            .chunks(across)
            .flat_map(|row| (0..width as usize).map(|x| bit(row, x) ^ 1))
            .collect(),
    };
    Ok(Reference {
        width,
        height,
        inks,
    })
}

/// The highest bit of a byte is its leftmost pixel.
fn bit(row: &[u8], x: usize) -> u8 {
    row.get(x / 8).map_or(0, |byte| byte >> (7 - x % 8) & 1)
}

/// What stands behind blanks and remarks.
fn behind_blanks(mut text: &[u8]) -> &[u8] {
    loop {
        text = text.trim_ascii_start();
        if !text.starts_with(b"#") {
            return text;
        }
        let end = text.iter().position(|b| *b == b'\n');
        text = text.get(end.unwrap_or(text.len())..).unwrap_or_default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Picture;

    fn picture() -> Picture {
        let inks = (0..30).map(|k| k * 7 / 5 % 2).collect();
        Picture {
            width: 10,
            height: 3,
            palette: vec![[0; 3], [255; 3]],
            inks,
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let picture = picture();
        let dir = tempfile::tempdir().expect("a directory");
        for (format, name) in [
            (FileFormat::Png, "a.png"),
            (FileFormat::Pgm, "a.pgm"),
            (FileFormat::Pbm, "a.pbm"),
        ] {
            let path = dir.path().join(name);
            std::fs::write(&path, picture.encode(format).expect("a file")).expect("written");
            let read = Reference::read(&path).expect(name);
            assert_eq!((read.width, read.height), (10, 3), "{name}");
            assert_eq!(read.inks, picture.inks, "{name}");
        }
    }

    #[test]
    fn remarks_are_skipped_and_what_is_cut_is_refused() {
        let read = |bytes: &[u8]| plain(bytes, b"P5").map(|r| r.inks);
        assert_eq!(
            read(b"P5 # two\n# pixels\n2 1\n3\n\x00\x03"),
            Ok(vec![0, 3])
        );
        for wrong in [
            &b"P5\n2 1\n3\n\x00"[..],
            b"P5\n2 1",
            b"P4\n2 1\n\x00",
            b"P5\n2 1\n65535\n\x00\x00\x00\x00",
            b"P5\n4294967295 4294967295\n255\n",
            b"P5 0 4 3\n",
            b"P5 #",
        ] {
            assert!(read(wrong).is_err(), "{wrong:?}");
        }
        assert!(indexed(b"\x89PNG\r\n\x1a\n").is_err());
    }
}
