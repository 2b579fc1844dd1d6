//! Rows drawn in passes, each over every nth column ([`crate::passes::loops::strip_mine`]).
//!
//! A pass begins at its first column: what is the same for the whole pass is
//! computed there, then a loop over its columns draws them. On the Micro its
//! pixels all stand at the same place in their bytes, so what an ink's bits are
//! there is a part of a table, and each pixel is added to its byte.

use super::code::Code;
use super::lines::{Label, Lines};
use super::poke;
use super::procedure::as_procedure;
use super::ramp;
use super::reads;
use super::screen;
use super::segment::{Draw, Segments};
use crate::passes::loops::strip_mine::passes;
use crate::plan::Plan;

/// A row in passes.
pub struct Passes {
    count: u32,
    columns: (u32, u32),
    spot: Option<Spot>,
}

/// Where in the Micro's memory a pass puts its pixels.
struct Spot {
    /// Pixels in a byte.
    pixels: u32,
    /// The bits of each ink at each place in a byte, and the pass's part of that.
    bits: String,
    here: String,
    /// The row's first byte, and the pixel's.
    start: String,
    at: String,
    /// How far the column is from the byte's address in columns, the same for a pass.
    shift: String,
    /// Whether a pass's loop counts addresses, since nothing in it reads the column.
    counts: bool,
}

impl Passes {
    /// Where the plan has such.
    pub fn new(plan: &Plan, code: &mut Code<'_>) -> Option<Passes> {
        let count = passes(&plan.graph);
        if count < 2 {
            return None;
        }
        let pixels = poke::pixels_in_byte(plan, code.values.style);
        let pixels = pixels.filter(|pixels| count.is_multiple_of(*pixels));
        let names = &mut code.values.names;
        let spot = pixels.map(|pixels| Spot {
            pixels,
            bits: names.unique("bits", "%"),
            here: names.unique("here", "%"),
            start: names.unique("start", "%"),
            at: names.unique("at", "%"),
            shift: names.unique("shift", "%"),
            counts: !reads::pixel(plan).column(),
        });
        if let Some(spot) = &spot {
            spot.table(plan, code);
        }
        Some(Passes {
            count,
            columns: plan.computed_columns(),
            spot,
        })
    }

    /// Whether pixels are put into memory.
    pub fn pokes(&self) -> bool {
        self.spot.is_some()
    }

    /// From a row's beginning to a pixel's; what stands behind the pixel's code.
    pub fn begin(
        &self,
        plan: &Plan,
        code: &mut Code<'_>,
        segments: Option<&Segments>,
        (again, behind_run): (Label, Label),
    ) -> Vec<Lines> {
        let mut apart = Vec::new();
        let (first, last) = self.columns;
        if let Some(spot) = &self.spot {
            let start = poke::first_byte(plan, spot.pixels);
            code.statement(format!("{}={start}", spot.start));
        }
        let pass = code.values.names.pass.clone();
        let n = self.count;
        code.line(format!("FOR {pass}=0 TO {}", n - 1));
        // Its first column, which is its own number modulo the passes.
        code.statement(match first % n {
            0 if first == 0 => format!("X%={pass}"),
            0 => format!("X%={pass}+{first}"),
            off => format!("X%=({pass}+{}) MOD {n}+{first}", n - off),
        });
        apart.extend(as_procedure(code, "pass", |code| {
            code.block(&plan.tree.pass);
            if first > 0 {
                ramp::start_at(plan, code, n, first >= n);
            }
        }));
        if let Some(spot) = &self.spot {
            spot.begin(plan, code, first, n);
        }
        let columns = |to: &str| format!("FOR X%=X% TO {to}{}", ramp::strided(n));
        let counts = self.spot.as_ref().filter(|spot| spot.counts);
        let Some(segments) = segments else {
            let last = last.to_string();
            code.line(match counts {
                Some(spot) => spot.head(&last, n),
                None => columns(&last),
            });
            return apart;
        };
        if let Some(spot) = &self.spot {
            code.statement(format!("{}=X%-{}", spot.shift, spot.in_columns()));
        }
        let draw = self.run(plan, code, segments.end());
        ramp::are_at(code, &draw.count);
        code.lines.place(again);
        apart.extend(as_procedure(code, "segment", |code| {
            segments.begin(plan, code, Some(&draw));
        }));
        segments.drawn(plan, code, behind_run);
        code.line(match counts {
            Some(_) => draw.head(),
            None => columns(segments.end()),
        });
        apart
    }

    /// How a run is drawn whose inks are known.
    fn run(&self, plan: &Plan, code: &mut Code<'_>, end: &str) -> Draw {
        let stride = self.count;
        let Some(spot) = &self.spot else {
            return screen::run(plan, code, end, stride);
        };
        let names = ["run", "other"].map(|name| code.values.names.unique(name, "%"));
        let at = &spot.at;
        let either = [0, 1].map(|k| format!("?{at}=?{at}+{}", names[k]));
        Draw {
            count: at.clone(),
            to: spot.to(end),
            by: spot.stride(stride),
            behind: Some(spot.column()),
            names,
            of: format!("{}?", spot.here),
            once: Vec::new(),
            each: vec![either[0].clone()],
            either,
            then: Vec::new(),
        }
    }

    /// Draws a pixel, where pixels are put into memory.
    pub fn put(&self, code: &mut Code<'_>) {
        if let Some(spot) = &self.spot {
            let Spot { here, at, .. } = spot;
            code.statement(format!("?{at}=?{at}+{here}?I%"));
            if !spot.counts {
                code.statement(format!("{at}={at}+{}", spot.stride(self.count)));
            }
        }
    }

    /// Behind the loop over the pixels of a run: X% is behind it, too.
    pub fn after_run(&self, code: &mut Code<'_>) {
        if let Some(spot) = self.spot.as_ref().filter(|spot| spot.counts) {
            code.statement(spot.column());
        }
    }
}

impl Spot {
    /// How far a byte of a pass is from the next.
    fn stride(&self, stride: u32) -> u32 {
        8 * (stride / self.pixels)
    }

    /// The beginning of a loop over the bytes of columns up to one.
    fn head(&self, last: &str, stride: u32) -> String {
        let (at, by) = (&self.at, ramp::strided(self.stride(stride)));
        format!("FOR {at}={at} TO {}{by}", self.to(last))
    }

    /// Up to where a loop over bytes goes for columns up to one. That may be no
    /// column of the pass, then it is no byte of it either.
    fn to(&self, last: &str) -> String {
        let at = &self.at;
        match 8 / self.pixels {
            1 => format!("{at}+{last}-X%"),
            n => format!("{at}+({last}-X%)*{n}"),
        }
    }

    /// The byte's address, counted in columns.
    fn in_columns(&self) -> String {
        match 8 / self.pixels {
            1 => self.at.clone(),
            n => format!("{} DIV {n}", self.at),
        }
    }

    /// Sets X% by the byte's address.
    fn column(&self) -> String {
        format!("X%={}+{}", self.shift, self.in_columns())
    }

    /// Makes the table of bits, four bytes a statement.
    fn table(&self, plan: &Plan, code: &mut Code<'_>) {
        let (name, inks) = (&self.bits, plan.mode.inks);
        let all: Vec<u32> = (0..self.pixels)
            .flat_map(|place| {
                let behind = self.pixels - 1 - place;
                (0..inks).map(move |ink| poke::bits(ink, self.pixels) << behind)
            })
            .collect();
        code.statement(format!("DIM {name} {}", all.len() - 1));
        if let (true, Some(last)) = (plan.scant && inks == 4, all.last_chunk::<4>()) {
            // A pixel further left, all bits are twice as high.
            let word = u32::from_le_bytes(last.map(|byte| byte as u8));
            let (bits, most) = (&self.here, all.len() - 4);
            code.statement(format!("{bits}=&{word:X}"));
            code.statement(format!("FOR I%={most} TO 0 STEP -4"));
            code.statement(format!("{name}!I%={bits}"));
            code.statement(format!("{bits}={bits}+{bits}"));
            code.statement("NEXT");
            return;
        }
        for (k, four) in all.chunks(4).enumerate() {
            let word = four.iter().rev().fold(0, |word, byte| word << 8 | byte);
            let place = match k {
                0 => format!("!{name}"),
                _ => format!("{name}!{}", 4 * k),
            };
            code.statement(format!("{place}=&{word:X}"));
        }
    }

    /// Where a pass begins, at column X%.
    fn begin(&self, plan: &Plan, code: &mut Code<'_>, first: u32, passes: u32) {
        let column = match first {
            0 => "X%".to_owned(),
            n => format!("(X%-{n})"),
        };
        // The first columns of all passes have their pixels in the first byte.
        let within = first == 0 && passes == self.pixels;
        let (pixels, inks) = (self.pixels, plan.mode.inks);
        let Spot {
            bits,
            here,
            start,
            at,
            ..
        } = self;
        if within {
            code.statement(format!("{here}={bits}+{column}*{inks}"));
            code.statement(format!("{at}={start}"));
            return;
        }
        code.statement(format!(
            "{here}={bits}+({column} AND {})*{inks}",
            pixels - 1
        ));
        code.statement(format!("{at}={start}+{column} DIV {pixels}*8"));
    }
}
