//! What a television makes of the lines: frames, which it counts, and colours.
//!
//! A frame is what lies between the begins of two vertical syncs; the line in which a sync
//! begins is the first of its frame. What is before the first sync is no frame.
//!
//! The colours are those of the two systems' phases: a hue is an angle of the colour carrier,
//! 26 degrees from one to the next in NTSC and 28 in PAL, where every second hue goes the
//! other way round; eight steps of brightness. No two televisions agree on them.

use crate::Screen;

/// Columns of a line.
pub const COLUMNS: usize = 160;

/// Lines of a frame that are kept: more are counted, and not seen.
const KEPT: usize = 400;

/// Frames whose lines are kept in mind.
const FRAMES: usize = 1_000_000;

/// A system of television.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// 262 lines.
    Ntsc,
    /// 312 lines.
    Pal,
}

impl System {
    /// The lines of a frame.
    pub fn lines(self) -> u32 {
        match self {
            System::Ntsc => 262,
            System::Pal => 312,
        }
    }

    /// The first line that is seen, and how many are.
    pub fn window(self) -> (usize, usize) {
        match self {
            System::Ntsc => (20, 240),
            System::Pal => (24, 288),
        }
    }

    fn name(self) -> &'static str {
        match self {
            System::Ntsc => "NTSC",
            System::Pal => "PAL",
        }
    }

    /// Red, green and blue of all colours, by half of the byte that programs store.
    pub fn palette(self) -> Vec<[u8; 3]> {
        let colour = |ink: i64| {
            let (hue, light) = (ink / 8, ink % 8);
            let (u, v) = match (self, hue) {
                (_, 0) | (System::Pal, 1 | 14 | 15) => (0, 0),
                (System::Ntsc, _) => carrier(167 - 26 * (hue - 1)),
                (System::Pal, _) if hue % 2 == 0 => carrier(168 - 28 * (hue / 2 - 1)),
                (System::Pal, _) => carrier(196 + 28 * (hue / 2 - 1)),
            };
            // Brightness and both differences of colour in thousandths of white.
            let y = light * 1000 / 7;
            let part = |value: i64| u8::try_from(value.clamp(0, 1000) * 255 / 1000).unwrap_or(0);
            [
                part(y + v * 1140 / 1000),
                part(y - (u * 395 + v * 581) / 1000),
                part(y + u * 2032 / 1000),
            ]
        };
        (0..128).map(colour).collect()
    }
}

/// How strong a colour is, in thousandths.
const STRENGTH: i64 = 190;

/// The differences of colour, blue and red, at an angle in degrees: thousandths.
fn carrier(angle: i64) -> (i64, i64) {
    (
        cosine(angle) * STRENGTH / 1000,
        cosine(angle - 90) * STRENGTH / 1000,
    )
}

/// The cosine in thousandths, after Bhaskara.
fn cosine(angle: i64) -> i64 {
    let angle = (angle + 90).rem_euclid(360);
    let (half, sign) = if angle < 180 {
        (angle, 1)
    } else {
        (angle - 180, -1)
    };
    let product = half * (180 - half);
    sign * 4000 * product / (40_500 - product)
}

/// Follows the lines.
#[derive(Clone, Debug, Default)]
pub struct Television {
    /// The frame that is drawn, and its lines so far; none before the first sync.
    now: Vec<u8>,
    count: Option<u32>,
    /// The last one that is complete.
    last: Vec<u8>,
    /// The lines of each frame.
    lines: Vec<u32>,
    frames: u64,
    /// Lines of the first frame.
    system: Option<System>,
    /// Frames that have too many lines or too few, and the first of them.
    wrong: u64,
    first: Vec<(u64, u32)>,
}

/// So many wrong frames are told by number.
const TOLD: usize = 10;

/// Lines after which a vertical sync is overdue: three frames of PAL.
const LONG: u64 = 3 * 312;

impl Television {
    /// A vertical sync begins.
    pub fn begin(&mut self) {
        if let Some(lines) = self.count {
            let system = *self.system.get_or_insert(match lines {
                ..287 => System::Ntsc,
                _ => System::Pal,
            });
            if lines != system.lines() {
                self.wrong += 1;
                if self.first.len() < TOLD {
                    self.first.push((self.frames, lines));
                }
            }
            if self.lines.len() < FRAMES {
                self.lines.push(lines);
            }
            self.frames += 1;
            self.last = std::mem::take(&mut self.now);
        }
        self.count = Some(0);
    }

    /// A line is drawn.
    pub fn line(&mut self, colours: &[u8; COLUMNS]) {
        if let Some(count) = &mut self.count {
            *count += 1;
            if self.now.len() < KEPT * COLUMNS {
                self.now.extend(colours);
            }
        }
    }

    /// How many frames are complete.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// The lines of each of them.
    pub fn lines(&self) -> &[u32] {
        &self.lines
    }

    /// All of the last complete frame.
    pub fn last(&self) -> &[u8] {
        &self.last
    }

    /// The line that is drawn, from the top of what is seen.
    pub fn row(&self) -> Option<u32> {
        let (first, count) = self.system?.window();
        let row = usize::try_from(self.count?).ok()?.checked_sub(first)?;
        u32::try_from(row.min(count - 1)).ok()
    }

    /// What is seen of the last complete frame.
    pub fn screen(&self) -> Option<Screen> {
        self.seen(&self.last)
    }

    /// What is seen of the frame that is drawn, as far as it is.
    pub fn drawn(&self) -> Option<Screen> {
        self.seen(&self.now)
    }

    fn seen(&self, lines: &[u8]) -> Option<Screen> {
        let system = self.system?;
        let (first, count) = system.window();
        let seen = lines.iter().skip(first * COLUMNS);
        let mut pixels: Vec<u8> = seen.map(|colour| colour / 2).collect();
        pixels.resize(count * COLUMNS, 0);
        Some(Screen {
            width: u32::try_from(COLUMNS).ok()?,
            height: u32::try_from(count).ok()?,
            pixels,
            palette: system.palette(),
        })
    }

    /// How many frames there were, in words.
    pub fn summary(&self) -> String {
        match self.system {
            None => "no frame: there were not two vertical syncs\n".to_owned(),
            Some(system) => format!(
                "{} {}, {} of them of {} lines ({})\n",
                self.frames,
                if self.frames == 1 { "frame" } else { "frames" },
                self.frames - self.wrong,
                system.lines(),
                system.name()
            ),
        }
    }

    /// What is wrong where a run is stopped after so many lines, of which the last ones are
    /// missing here: a vertical sync that does not come, and frames that have not as many lines
    /// as the television wants.
    pub fn late(&self, all: u64, missing: u64) -> Option<String> {
        let now = self.count.map(|lines| u64::from(lines) + missing);
        let frame = self.frames;
        let overdue = match now {
            None if all > LONG => Some(format!("no vertical sync began in {all} lines")),
            Some(lines) if lines > LONG => Some(format!(
                "no vertical sync ended frame {frame} in {lines} lines"
            )),
            _ => None,
        };
        let all: Vec<String> = self.complaint().into_iter().chain(overdue).collect();
        (!all.is_empty()).then(|| all.join("; "))
    }

    /// Which frames have not as many lines as the television wants, if there are any.
    pub fn complaint(&self) -> Option<String> {
        let system = self.system?;
        if self.wrong == 0 {
            return None;
        }
        let one = |(frame, lines): &(u64, u32)| format!("frame {frame} has {lines}");
        let mut all: Vec<String> = self.first.iter().map(one).collect();
        let more = self.wrong - self.first.len() as u64;
        if more > 0 {
            all.push(format!("and {more} more are wrong"));
        }
        Some(format!(
            "{} of {} frames have not {} lines: {}",
            self.wrong,
            self.frames,
            system.lines(),
            all.join(", ")
        ))
    }
}
