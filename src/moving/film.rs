//! Films: pictures one after the other in a file, as an animated GIF or PNG.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::picture::Picture;
use std::fmt::Display;
use std::path::Path;

/// A film's format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Gif,
    Png,
}

/// Where a film goes, if anywhere; known, and known to be writable, before any work is done.
pub struct FilmFile<'p>(Option<(&'p Path, Format)>);

impl<'p> FilmFile<'p> {
    /// The file that `-o` names.
    ///
    /// # Errors
    /// Where its extension names no format, or it cannot be written.
    pub fn named(path: Option<&'p Path>) -> Outcome<FilmFile<'p>> {
        let Some(path) = path else {
            return Ok(FilmFile(None));
        };
        let extension = path.extension().map(|e| e.to_ascii_lowercase());
        let format = match extension.as_deref().and_then(|e| e.to_str()) {
            Some("gif") => Format::Gif,
            Some("png") => Format::Png,
            _ => {
                return Err(Failure::Usage(format!(
                    "{} is no film's name; end it in .gif or .png",
                    path.display()
                )));
            }
        };
        files::may_write(path)?;
        Ok(FilmFile(Some((path, format))))
    }

    /// Whether there is one.
    pub fn wanted(&self) -> bool {
        self.0.is_some()
    }

    /// Writes pictures of one size and palette, so many a second.
    ///
    /// # Errors
    /// Where they cannot be encoded or written.
    pub fn write(&self, pictures: &[Picture], fps: u16) -> Outcome<()> {
        let Some((path, format)) = self.0 else {
            return Ok(());
        };
        let bytes = match format {
            Format::Gif => gif(pictures, fps)?,
            Format::Png => png(pictures, fps)?,
        };
        files::write(path, &bytes)
    }
}

fn wrong(what: &str, why: impl Display) -> Failure {
    Failure::Wrong(format!("cannot make the {what}: {why}"))
}

/// All colours, one after the other.
fn colours(pictures: &[Picture]) -> Vec<u8> {
    let longest = pictures.iter().max_by_key(|p| p.palette.len());
    let palette = longest.iter().flat_map(|p| &p.palette);
    palette.flatten().copied().collect()
}

fn gif(pictures: &[Picture], fps: u16) -> Outcome<Vec<u8>> {
    let wrong = |e: gif::EncodingError| wrong("GIF", e);
    let (width, height) = size(pictures)?;
    let side = |n: u32| u16::try_from(n).unwrap_or(u16::MAX);
    let mut bytes = Vec::new();
    let palette = colours(pictures);
    let mut encoder =
        gif::Encoder::new(&mut bytes, side(width), side(height), &palette).map_err(wrong)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(wrong)?;
    for picture in pictures {
        let inks = picture.inks.as_slice();
        let mut frame = gif::Frame::from_indexed_pixels(side(width), side(height), inks, None);
        // In hundredths of a second; below two, viewers take their own time.
        frame.delay = (100 / fps.max(1)).max(2);
        encoder.write_frame(&frame).map_err(wrong)?;
    }
    drop(encoder);
    Ok(bytes)
}

fn png(pictures: &[Picture], fps: u16) -> Outcome<Vec<u8>> {
    let wrong = |e: png::EncodingError| wrong("PNG", e);
    let (width, height) = size(pictures)?;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_palette(colours(pictures));
    let count = u32::try_from(pictures.len()).unwrap_or(u32::MAX);
    encoder.set_animated(count, 0).map_err(wrong)?;
    encoder.set_frame_delay(1, fps.max(1)).map_err(wrong)?;
    let mut writer = encoder.write_header().map_err(wrong)?;
    for picture in pictures {
        writer.write_image_data(&picture.inks).map_err(wrong)?;
    }
    writer.finish().map_err(wrong)?;
    Ok(bytes)
}

fn size(pictures: &[Picture]) -> Outcome<(u32, u32)> {
    let first = pictures.first();
    let size = first.map(|p| (p.width, p.height));
    let same = pictures.iter().all(|p| Some((p.width, p.height)) == size);
    let size = size.filter(|_| same);
    size.ok_or_else(|| wrong("film", "its pictures are of several sizes"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pictures() -> Vec<Picture> {
        let one = |ink: u8| Picture {
            width: 3,
            height: 2,
            palette: vec![[0; 3], [255, 0, 0], [255; 3]],
            inks: vec![ink, 0, 1, 2, 1, ink],
        };
        (0..3).map(one).collect()
    }

    #[test]
    fn a_gif_has_every_picture() {
        let bytes = gif(&pictures(), 25).expect("a GIF");
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::Indexed);
        let mut decoder = options.read_info(bytes.as_slice()).expect("a GIF");
        for picture in pictures() {
            let frame = decoder.read_next_frame().expect("a frame").expect("one");
            assert_eq!(
                (frame.buffer.as_ref(), frame.delay),
                (picture.inks.as_slice(), 4)
            );
        }
        assert!(decoder.read_next_frame().expect("the end").is_none());
    }

    #[test]
    fn a_png_has_every_picture() {
        let bytes = png(&pictures(), 25).expect("a PNG");
        let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info();
        let mut reader = reader.expect("a PNG");
        let frames = reader.info().animation_control.map(|a| a.num_frames);
        assert_eq!(frames, Some(3));
        for picture in pictures() {
            let mut row = vec![0; 6];
            reader.next_frame(&mut row).expect("a frame");
            assert_eq!(row, picture.inks);
        }
    }
}
