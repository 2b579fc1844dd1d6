//! Pictures of inks, and the files that they become.

use crate::digest;
use crate::failure::{Failure, Outcome};
use slowlight_vm::Screen;
use std::path::Path;

/// A picture: an ink a pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue of each ink; 2 to 256 of them.
    pub palette: Vec<[u8; 3]>,
    /// Ink indices, row by row from the top left; `width * height` long.
    pub inks: Vec<u8>,
}

/// A picture file's format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// PNG with the palette.
    Png,
    /// Binary PGM (P5) of ink indices; maxval is the number of inks less one.
    Pgm,
    /// Binary PBM (P4); 1 (black) is ink 0. For two inks.
    Pbm,
}

impl FileFormat {
    /// By the name's extension.
    ///
    /// # Errors
    /// Where the extension is none of the three.
    pub fn of(path: &Path) -> Outcome<FileFormat> {
        let extension = path.extension().map(|e| e.to_ascii_lowercase());
        match extension.as_deref().and_then(|e| e.to_str()) {
            Some("png") => Ok(FileFormat::Png),
            Some("pgm") => Ok(FileFormat::Pgm),
            Some("pbm") => Ok(FileFormat::Pbm),
            _ => Err(Failure::Usage(format!(
                "{} is no picture's name; end it in .png, .pgm (ink indices) or .pbm (two inks)",
                path.display()
            ))),
        }
    }
}

/// Where a picture goes, if anywhere; its format is known before any work is done, and that
/// it may be written.
pub struct PictureFile<'p>(Option<(&'p Path, FileFormat)>);

impl<'p> PictureFile<'p> {
    /// The file that `-o` names.
    ///
    /// # Errors
    /// Where its extension names no format, or it cannot be written.
    pub fn named(path: Option<&'p Path>) -> Outcome<PictureFile<'p>> {
        let Some(path) = path else {
            return Ok(PictureFile(None));
        };
        let format = FileFormat::of(path)?;
        crate::files::may_write(path)?;
        Ok(PictureFile(Some((path, format))))
    }

    /// Whether there is one.
    pub fn wanted(&self) -> bool {
        self.0.is_some()
    }

    /// Writes the picture, if it is wanted.
    ///
    /// # Errors
    /// Where it cannot be written, or has too many inks for its format.
    pub fn write(&self, picture: &Picture) -> Outcome<()> {
        match self.0 {
            Some((path, format)) => crate::files::write(path, &picture.encode(format)?),
            None => Ok(()),
        }
    }
}

impl From<&Screen> for Picture {
    fn from(screen: &Screen) -> Picture {
        Picture {
            width: screen.width,
            height: screen.height,
            palette: screen.palette.clone(),
            inks: screen.pixels.clone(),
        }
    }
}

impl Picture {
    /// The picture as a file of some format.
    ///
    /// # Errors
    /// Where a picture of more than two inks is to be a PBM.
    pub fn encode(&self, format: FileFormat) -> Outcome<Vec<u8>> {
        match format {
            FileFormat::Png => self.png(),
            FileFormat::Pgm => Ok(self.pgm()),
            FileFormat::Pbm if self.palette.len() > 2 => Err(Failure::Usage(format!(
                "a .pbm holds two inks, and the picture has {}; write a .pgm or .png",
                self.palette.len()
            ))),
            FileFormat::Pbm => Ok(self.pbm()),
        }
    }

    fn png(&self) -> Outcome<Vec<u8>> {
        let colours: Vec<u8> = self.palette.iter().flatten().copied().collect();
        png(self.width, self.height, Some(colours), &self.inks)
    }

    fn pgm(&self) -> Vec<u8> {
        let top = self.palette.len().saturating_sub(1).clamp(1, 255);
        let mut file = format!("P5\n{} {}\n{top}\n", self.width, self.height).into_bytes();
        file.extend(&self.inks);
        file
    }

    fn pbm(&self) -> Vec<u8> {
        let mut file = format!("P4\n{} {}\n", self.width, self.height).into_bytes();
        for row in self.inks.chunks(self.width.max(1) as usize) {
            // Rows begin at a byte; its highest bit is the leftmost pixel.
            file.extend(row.chunks(8).map(|byte| {
                let bits = byte.iter().enumerate();
                bits.fold(0, |all, (k, &ink)| all | (u8::from(ink == 0) << (7 - k)))
            }));
        }
        file
    }

    /// SHA-256 of one byte an ink, row by row from the top left, in hexadecimal.
    pub fn sha256(&self) -> String {
        digest::bytes(&self.inks)
    }

    /// The colour of each pixel.
    pub fn colours(&self) -> impl Iterator<Item = [u8; 3]> + '_ {
        self.inks
            .iter()
            .map(|&i| self.palette.get(i as usize).copied().unwrap_or_default())
    }
}

/// A PNG of eight bits a sample: indexed where there is a palette, else red, green, blue.
///
/// # Errors
/// Where the data does not fit the size.
pub fn png(width: u32, height: u32, palette: Option<Vec<u8>>, data: &[u8]) -> Outcome<Vec<u8>> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_color(match &palette {
        Some(_) => png::ColorType::Indexed,
        None => png::ColorType::Rgb,
    });
    if let Some(palette) = palette {
        encoder.set_palette(palette);
    }
    encoder
        .write_header()
        .and_then(|mut writer| {
            writer.write_image_data(data)?;
            writer.finish()
        })
        .map_err(|e| Failure::Wrong(format!("cannot make the PNG: {e}")))?;
    Ok(file)
}
