//! Pictures in a terminal, as it can show them: by kitty's protocol, iTerm2's or as sixels where
//! it has one of them, else as half blocks in colours.

mod asked;
mod sixel;

use crate::failure::Outcome;
use crate::picture::{FileFormat, Picture};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use console::Term;
use std::fmt::Write as _;
use std::io::IsTerminal;

/// What a terminal can show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Means {
    /// The graphics protocol of kitty, which Ghostty, WezTerm and Konsole have as well.
    Kitty,
    /// iTerm2's inline images.
    Iterm,
    /// Sixels, as xterm, foot, mlterm, Windows Terminal and others show them.
    Sixel,
    /// Half blocks, two pixels above each other in one character, in 24-bit colours.
    Blocks,
    /// The same in the 256 colours that xterm has.
    Blocks256,
}

/// Columns where the terminal does not say how many it has.
const COLUMNS: u16 = 80;

/// How many bytes of base 64 kitty takes at a time.
const CHUNK: usize = 4096;

/// Columns that a picture of so many pixels is enlarged to at least, by whole factors.
const ENLARGED: u32 = 256;

/// What says by its name which of them is used, whatever the terminal can.
const FORCED: &str = "SLOWLIGHT_SHOW";

/// What standard output can show; none where it is no terminal, or colours are not wanted.
/// `SLOWLIGHT_SHOW=sixel`, `kitty`, `iterm` or `blocks` says it for what is not asked.
pub fn means() -> Option<Means> {
    let variable = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
    if let Some(forced) = variable(FORCED).and_then(|name| named(&name)) {
        return Some(forced);
    }
    if !std::io::stdout().is_terminal() {
        return None;
    }
    match means_of(&variable) {
        Some(Means::Blocks | Means::Blocks256) if asked::has_sixel() => Some(Means::Sixel),
        means => means,
    }
}

fn named(name: &str) -> Option<Means> {
    Some(match name {
        "kitty" => Means::Kitty,
        "iterm" => Means::Iterm,
        "sixel" => Means::Sixel,
        "blocks" => Means::Blocks,
        _ => return None,
    })
}

/// The same by what the environment says.
fn means_of(variable: &dyn Fn(&str) -> Option<String>) -> Option<Means> {
    let is = |name: &str, part: &str| variable(name).is_some_and(|v| v.contains(part));
    if variable("NO_COLOR").is_some() || is("TERM", "dumb") {
        return None;
    }
    // What stands between, tmux or screen, passes no pictures on.
    let between = variable("TMUX").is_some() || is("TERM", "screen") || is("TERM", "tmux");
    let program = |name: &str| is("TERM_PROGRAM", name);
    if !between {
        let kitty = variable("KITTY_WINDOW_ID").is_some() || is("TERM", "kitty");
        if kitty || program("ghostty") || program("WezTerm") {
            return Some(Means::Kitty);
        }
        if program("iTerm") {
            return Some(Means::Iterm);
        }
    }
    let true_colour = is("COLORTERM", "truecolor") || is("COLORTERM", "24bit");
    Some(match true_colour {
        true => Means::Blocks,
        false => Means::Blocks256,
    })
}

/// How many columns and lines standard output has for a picture, a line below it left free.
pub fn room() -> (u32, u32) {
    let (lines, columns) = Term::stdout().size_checked().unwrap_or((25, COLUMNS));
    (u32::from(columns).max(1), u32::from(lines).max(3) - 2)
}

/// A picture as what a terminal with such means shows, in at most so many columns and, where
/// it is to be drawn over again, lines; a line's end behind it.
///
/// # Errors
/// Where it cannot be made a PNG.
pub fn text(picture: &Picture, means: Means, room: (u32, Option<u32>)) -> Outcome<String> {
    Ok(match means {
        Means::Kitty => kitty(&enlarged(picture).encode(FileFormat::Png)?),
        Means::Sixel => sixel::sixel(&enlarged(picture)) + "\n",
        Means::Iterm => {
            let file = enlarged(picture).encode(FileFormat::Png)?;
            let (size, data) = (file.len(), STANDARD.encode(file));
            format!("\x1b]1337;File=inline=1;size={size}:{data}\x07\n")
        }
        Means::Blocks => blocks(picture, room, &|[r, g, b]| format!("2;{r};{g};{b}")),
        Means::Blocks256 => blocks(picture, room, &|colour| format!("5;{}", cube(colour))),
    })
}

/// A small picture by a whole factor larger, whose pixels stay squares.
fn enlarged(picture: &Picture) -> Picture {
    let factor = (ENLARGED / picture.width.max(1)).clamp(1, 8);
    let wide = picture.width.max(1) as usize;
    let (factor, mut inks) = (factor as usize, Vec::new());
    for row in picture.inks.chunks(wide) {
        let row: Vec<u8> = row
            .iter()
            .flat_map(|ink| std::iter::repeat_n(*ink, factor))
            .collect();
        inks.extend(std::iter::repeat_n(row, factor).flatten());
    }
    Picture {
        width: picture.width * factor as u32,
        height: picture.height * factor as u32,
        palette: picture.palette.clone(),
        inks,
    }
}

fn kitty(file: &[u8]) -> String {
    let data = STANDARD.encode(file);
    let chunks: Vec<&[u8]> = data.as_bytes().chunks(CHUNK).collect();
    let mut out = String::new();
    for (k, chunk) in chunks.iter().enumerate() {
        let more = u8::from(k + 1 < chunks.len());
        // `q=2`: it is not to answer, as nobody would read that.
        let first = if k == 0 { "a=T,f=100,q=2," } else { "" };
        let chunk = String::from_utf8_lossy(chunk);
        let _ = write!(out, "\x1b_G{first}m={more};{chunk}\x1b\\");
    }
    out.push('\n');
    out
}

/// Two rows of cells a line: the upper ones are a half block's colour, the lower ones what is
/// behind it.
fn blocks(
    picture: &Picture,
    (columns, lines): (u32, Option<u32>),
    colour: &dyn Fn([u8; 3]) -> String,
) -> String {
    let (width, height) = (picture.width.max(1), picture.height.max(1));
    let mut cells = (width.min(columns), height);
    let scaled = |columns: u32| {
        let all = u64::from(height) * u64::from(columns) + u64::from(width) / 2;
        ((all / u64::from(width)) as u32).max(1)
    };
    cells.1 = scaled(cells.0);
    if let Some(most) = lines.map(|lines| 2 * lines.max(1))
        && cells.1 > most
    {
        let columns = u64::from(width) * u64::from(most) / u64::from(height);
        cells.0 = (columns as u32).clamp(1, cells.0);
        cells.1 = scaled(cells.0).min(most);
    }
    let seen = Seen::of(picture);
    let mut out = String::new();
    for line in 0..cells.1.div_ceil(2) {
        let mut last = String::new();
        for column in 0..cells.0 {
            let upper = colour(seen.cell(picture, cells, (column, 2 * line)));
            let lower = match 2 * line + 1 < cells.1 {
                true => format!(
                    "48;{}",
                    colour(seen.cell(picture, cells, (column, 2 * line + 1)))
                ),
                false => "49".to_owned(),
            };
            let both = format!("\x1b[38;{upper};{lower}m");
            if both != last {
                out.push_str(&both);
                last = both;
            }
            out.push('▀');
        }
        out.push_str("\x1b[0m\n");
    }
    out
}

/// Inks as light, which adds up: what is dithered looks from afar like its mean.
struct Seen(Vec<[f64; 3]>);

impl Seen {
    fn of(picture: &Picture) -> Seen {
        let light = |v: u8| (f64::from(v) / 255.0).powf(2.2);
        Seen(picture.palette.iter().map(|ink| ink.map(light)).collect())
    }

    /// The mean colour of the pixels that a cell stands for.
    fn cell(&self, picture: &Picture, (columns, rows): (u32, u32), at: (u32, u32)) -> [u8; 3] {
        let span = |k: u32, parts: u32, length: u32| {
            let at = |k: u32| (u64::from(k) * u64::from(length) / u64::from(parts.max(1))) as u32;
            at(k)..at(k + 1).max(at(k) + 1)
        };
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for y in span(at.1, rows, picture.height) {
            for x in span(at.0, columns, picture.width) {
                let place = y as usize * picture.width as usize + x as usize;
                let ink = picture.inks.get(place).map_or(0, |ink| usize::from(*ink));
                let light = self.0.get(ink).copied().unwrap_or_default();
                for (sum, light) in sum.iter_mut().zip(light) {
                    *sum += light;
                }
                count += 1.0;
            }
        }
        sum.map(|sum| (255.0 * (sum / f64::max(count, 1.0)).powf(1.0 / 2.2)).round() as u8)
    }
}

/// The nearest of xterm's colours 16 to 255: a cube of six levels a channel, and 24 greys.
fn cube(colour: [u8; 3]) -> u8 {
    const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    let apart = |a: [u8; 3]| -> u32 {
        let parts = a.iter().zip(colour);
        parts.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let near = |v: u8| {
        let levels = LEVELS.iter().enumerate();
        levels
            .min_by_key(|(_, level)| level.abs_diff(v))
            .map_or(0, |(k, _)| k)
    };
    let [r, g, b] = colour.map(near);
    let cubed = [r, g, b].map(|k| LEVELS.get(k).copied().unwrap_or_default());
    let mean = colour.iter().map(|v| u32::from(*v)).sum::<u32>() / 3;
    let step = (mean.saturating_sub(3) / 10).min(23) as u8;
    let grey = 8 + 10 * step;
    match apart([grey; 3]) < apart(cubed) {
        true => 232 + step,
        false => (16 + 36 * r + 6 * g + b) as u8,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, inks: &[u8]) -> Picture {
        Picture {
            width,
            height: inks.len() as u32 / width,
            palette: vec![[0; 3], [255, 0, 0], [255; 3]],
            inks: inks.to_vec(),
        }
    }

    #[test]
    fn a_terminal_is_known_by_its_environment() {
        for (set, means) in [
            (&[("TERM", "xterm-kitty")][..], Some(Means::Kitty)),
            (
                &[("TERM", "xterm-256color"), ("TERM_PROGRAM", "iTerm.app")],
                Some(Means::Iterm),
            ),
            (
                &[("TERM", "xterm"), ("COLORTERM", "truecolor")],
                Some(Means::Blocks),
            ),
            (&[("TERM", "xterm")], Some(Means::Blocks256)),
            (
                &[("TERM", "tmux-256color"), ("KITTY_WINDOW_ID", "1")],
                Some(Means::Blocks256),
            ),
            (&[("TERM", "xterm-kitty"), ("NO_COLOR", "1")], None),
            (&[("TERM", "dumb")], None),
        ] {
            let variable = |name: &str| {
                let found = set.iter().find(|(n, _)| *n == name);
                found.map(|(_, value)| (*value).to_owned())
            };
            assert_eq!(means_of(&variable), means, "{set:?}");
        }
    }

    #[test]
    fn two_rows_are_a_line_of_half_blocks() {
        let shown =
            |inks: &[u8]| text(&picture(2, inks), Means::Blocks, (80, None)).expect("no error");
        assert_eq!(
            shown(&[0, 1, 2, 2]),
            "\x1b[38;2;0;0;0;48;2;255;255;255m▀\x1b[38;2;255;0;0;48;2;255;255;255m▀\x1b[0m\n"
        );
        // An odd last row has nothing below it; the same colours are said once.
        assert_eq!(shown(&[1, 1]), "\x1b[38;2;255;0;0;49m▀▀\x1b[0m\n");
    }

    #[test]
    fn a_picture_fits_its_room() {
        let wide = picture(64, &[2; 64 * 48]);
        for (room, lines, columns) in [
            ((80, None), 24, 64),
            ((32, None), 12, 32),
            ((80, Some(10)), 10, 26),
            ((1, Some(1)), 1, 1),
        ] {
            let shown = text(&wide, Means::Blocks256, room).expect("no error");
            assert_eq!(shown.lines().count(), lines, "{room:?}");
            let wide = shown.lines().map(|line| line.matches('▀').count());
            assert!(wide.into_iter().all(|n| n == columns), "{room:?}: {shown}");
        }
    }

    #[test]
    fn a_dither_looks_like_its_mean() {
        let p = picture(2, &[0, 2, 2, 0]);
        let seen = Seen::of(&p).cell(&p, (1, 1), (0, 0));
        assert_eq!(seen, [186; 3]);
        assert_eq!(cube(seen), 250);
        assert_eq!(cube([255, 0, 0]), 196);
        assert_eq!([cube([0; 3]), cube([255; 3])], [16, 231]);
    }

    #[test]
    fn protocols_carry_a_png() {
        let small = picture(2, &[0, 1, 2, 0]);
        let kitty = text(&small, Means::Kitty, (80, None)).expect("no error");
        let data = kitty
            .strip_prefix("\x1b_Ga=T,f=100,q=2,m=0;")
            .expect("its head");
        let data = data.strip_suffix("\x1b\\\n").expect("its end");
        let file = STANDARD.decode(data).expect("base 64");
        assert!(file.starts_with(b"\x89PNG"));
        let iterm = text(&small, Means::Iterm, (80, None)).expect("no error");
        assert!(
            iterm.starts_with("\x1b]1337;File=inline=1;size="),
            "{iterm:?}"
        );
        // What is large is sent in pieces, all but the last of which say that more follows.
        let large: Vec<u8> = (0..300_u32 * 300)
            .map(|k| (k.wrapping_mul(2_654_435_761) >> 20) as u8 % 3)
            .collect();
        let kitty = text(&picture(300, &large), Means::Kitty, (80, None)).expect("no error");
        let pieces = kitty.matches("\x1b_G").count();
        assert!(pieces > 1);
        assert_eq!(kitty.matches("m=1;").count(), pieces - 1);
    }
}
