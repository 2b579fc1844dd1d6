//! Pictures as text, for a look in the terminal.

use crate::picture::Picture;

/// Columns of text at most, where nobody says.
pub const COLUMNS: u32 = 80;

/// From dark to bright on a dark terminal.
const RAMP: &[u8] = b" .:-=+*#%@";

/// A picture in at most `columns` columns, and no more than it has itself. A
/// character stands for twice as many rows as columns, as it is about twice as
/// tall as wide, and shows the mean luma (ITU-R BT.601) of its pixels. A line
/// has no spaces at its end.
pub fn text(picture: &Picture, columns: u32) -> String {
    let columns = columns.clamp(1, picture.width.max(1));
    // Rounded, so that proportions stay as near as lines can.
    let (width, height) = (u64::from(picture.width), u64::from(picture.height));
    let lines = ((height * u64::from(columns) + width) / (2 * width.max(1))).max(1);
    let luma: Vec<u64> = picture
        .palette
        .iter()
        .map(|&[r, g, b]| 299 * u64::from(r) + 587 * u64::from(g) + 114 * u64::from(b))
        .collect();
    let mut out = String::new();
    for line in 0..lines {
        let mut row = String::new();
        let rows = span(line, lines, height);
        for column in 0..u64::from(columns) {
            let (mut sum, mut count) = (0, 0);
            for y in rows.clone() {
                for x in span(column, u64::from(columns), width) {
                    let ink = picture.inks.get((y * width + x) as usize);
                    sum += ink.and_then(|&i| luma.get(usize::from(i))).unwrap_or(&0);
                    count += 1;
                }
            }
            let step = sum * RAMP.len() as u64 / (255_001 * count.max(1));
            row.push(char::from(*RAMP.get(step as usize).unwrap_or(&b'@')));
        }
        out += row.trim_end();
        out.push('\n');
    }
    out
}

/// The pixels, of `length`, that part `k` of `parts` stands for; at least one.
fn span(k: u64, parts: u64, length: u64) -> std::ops::Range<u64> {
    let start = k * length / parts;
    start..((k + 1) * length / parts).max(start + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, inks: &[u8]) -> Picture {
        Picture {
            width,
            height: inks.len() as u32 / width,
            palette: vec![[0; 3], [128; 3], [255; 3]],
            inks: inks.to_vec(),
        }
    }

    #[test]
    fn each_ink_has_its_brightness() {
        let p = picture(3, &[0, 1, 2, 0, 1, 2]);
        assert_eq!(text(&p, 80), " +@\n");
        // A dither of black and white is as bright as grey.
        let p = picture(4, &[0, 2, 1, 0, 2, 0, 1, 0]);
        assert_eq!(text(&p, 2), "=:\n");
    }

    #[test]
    fn a_character_is_twice_as_tall_as_wide() {
        for (width, height, columns, lines) in [
            (320, 240, 80, 30),
            (512, 256, 80, 20),
            (32, 32, 32, 16),
            (3, 1, 3, 1),
            (1, 3, 1, 2),
            (4096, 1, 80, 1),
        ] {
            let p = picture(width, &vec![2; width as usize * height]);
            let text = text(&p, COLUMNS);
            assert_eq!(text.lines().count(), lines, "{width} x {height}");
            assert!(text.lines().all(|l| l == "@".repeat(columns)));
        }
    }
}
