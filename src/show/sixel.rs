//! Sixel: bitmaps for terminals, in bands of six rows, each ink of a band by itself and in runs
//! (DEC, VT3xx Graphics Programming, chapter 14).

use crate::picture::Picture;
use std::fmt::Write as _;

/// Rows in a band.
const BAND: usize = 6;

/// From so many on equal characters are written as a run.
const RUN: usize = 4;

/// A picture as a device control string, a pixel a pixel.
pub fn sixel(picture: &Picture) -> String {
    let wide = picture.width.max(1) as usize;
    let mut out = format!("\x1bP0;1q\"1;1;{};{}", picture.width, picture.height);
    for (ink, colour) in picture.palette.iter().enumerate() {
        // In hundredths.
        let [r, g, b] = colour.map(|v| (u32::from(v) * 100 + 127) / 255);
        let _ = write!(out, "#{ink};2;{r};{g};{b}");
    }
    for (k, band) in picture.inks.chunks(BAND * wide).enumerate() {
        if k > 0 {
            out.push('-');
        }
        let mut used: Vec<u8> = band.to_vec();
        used.sort_unstable();
        used.dedup();
        for (k, ink) in used.into_iter().enumerate() {
            if k > 0 {
                out.push('$');
            }
            let _ = write!(out, "#{ink}");
            runs(band, wide, ink, &mut out);
        }
    }
    out.push_str("\x1b\\");
    out
}

/// A band's pixels of one ink: a character a column, whose bits are rows.
fn runs(band: &[u8], wide: usize, ink: u8, out: &mut String) {
    let column = |x: usize| -> u8 {
        let rows = band.iter().skip(x).step_by(wide).enumerate();
        b'?' + rows
            .map(|(row, at)| u8::from(*at == ink) << row)
            .sum::<u8>()
    };
    let columns: Vec<u8> = (0..wide).map(column).collect();
    // What is left empty at the end needs no saying.
    let end = columns
        .iter()
        .rposition(|c| *c != b'?')
        .map_or(0, |at| at + 1);
    for run in columns
        .get(..end)
        .unwrap_or_default()
        .chunk_by(|a, b| a == b)
    {
        let sign = char::from(run.first().copied().unwrap_or(b'?'));
        match run.len() {
            length if length >= RUN => {
                let _ = write!(out, "!{length}{sign}");
            }
            length => out.extend(std::iter::repeat_n(sign, length)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The inks that a terminal would show.
    fn decoded(text: &str, width: usize, height: usize) -> Vec<u8> {
        let body = text.strip_prefix("\x1bP0;1q\"1;1;").expect("its head");
        let body = body.strip_suffix("\x1b\\").expect("its end");
        let mut inks = vec![255; width * height];
        let (mut x, mut band, mut ink, mut times) = (0, 0, 0, 1);
        // Behind the size.
        let mut rest = &body[body.find('#').expect("a colour")..];
        while let Some(c) = rest.chars().next() {
            rest = &rest[1..];
            let digits = rest.find(|c: char| !c.is_ascii_digit() && c != ';');
            let (numbers, behind) = rest.split_at(digits.unwrap_or(rest.len()));
            match c {
                '#' => {
                    ink = numbers
                        .split(';')
                        .next()
                        .expect("one")
                        .parse()
                        .expect("an ink");
                    rest = behind;
                }
                '!' => {
                    times = numbers.parse().expect("a count");
                    rest = behind;
                }
                '$' => x = 0,
                '-' => (x, band) = (0, band + 1),
                c => {
                    for _ in 0..std::mem::replace(&mut times, 1) {
                        for row in (0..BAND).filter(|row| (c as u8 - b'?') >> row & 1 == 1) {
                            inks[(BAND * band + row) * width + x] = ink;
                        }
                        x += 1;
                    }
                }
            }
        }
        inks
    }

    #[test]
    fn a_picture_comes_back() {
        for (width, height) in [(1, 1), (5, 6), (40, 13), (7, 25)] {
            let inks: Vec<u8> = (0..width * height)
                .map(|k: u32| (k.wrapping_mul(2_654_435_761) >> 27) as u8 / 8)
                .collect();
            let picture = Picture {
                width,
                height,
                palette: vec![[0; 3], [255, 0, 0], [0, 255, 0], [255; 3]],
                inks: inks.clone(),
            };
            let text = sixel(&picture);
            assert!(text.contains("#1;2;100;0;0"), "{text:?}");
            assert_eq!(decoded(&text, width as usize, height as usize), inks);
        }
    }

    #[test]
    fn equal_columns_are_a_run() {
        let picture = Picture {
            width: 10,
            height: 1,
            palette: vec![[0; 3], [255; 3]],
            inks: vec![1, 1, 1, 1, 1, 1, 1, 1, 0, 0],
        };
        let text = sixel(&picture);
        assert!(text.ends_with("#0!8?@@$#1!8@\x1b\\"), "{text:?}");
    }
}
