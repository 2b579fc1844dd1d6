//! Adaptive sampling while a picture is evaluated: what the pixels have left, and which of them
//! have to be drawn before one.
//!
//! All of the picture is kept, so that pixels may be asked for in any order; a program keeps a
//! band ([`crate::plan::KeptRows`]).

use crate::ir::graph::{Graph, Neighbour, Refinement};

/// What the pixels so far have left.
#[derive(Clone, Debug)]
pub struct Neighbours {
    refinement: Refinement,
    width: u32,
    height: u32,
    /// Row by row, from the left, as far as they are drawn.
    rows: Vec<Vec<i32>>,
    /// The row whose neighbours are all there.
    ready: Option<i32>,
}

impl Neighbours {
    /// Nothing left yet. `None` where every pixel is traced.
    pub fn new(graph: &Graph) -> Option<Neighbours> {
        let (width, height) = (graph.image.width, graph.image.height);
        Some(Neighbours {
            refinement: graph.refinement?,
            width,
            height,
            rows: vec![Vec::new(); height as usize],
            ready: None,
        })
    }

    /// The pixels that have to be drawn before the one at (x, y), in that order.
    pub fn due(&mut self, x: i32, y: i32) -> Vec<(i32, i32)> {
        let Some(row) = u32::try_from(y).ok().filter(|y| *y < self.height) else {
            return Vec::new();
        };
        let mut all = Vec::new();
        let mut up_to = |row: u32, end: u32| {
            let drawn = self.rows[row as usize].len() as u32;
            all.extend((drawn..end).map(|x| (x as i32, row as i32)));
        };
        if self.ready.replace(y) != Some(y) {
            let before = self.refinement.before(row, self.height);
            before
                .iter()
                .filter(|other| **other != row)
                .for_each(|other| up_to(*other, self.width));
        }
        up_to(row, u32::try_from(x).unwrap_or(0).min(self.width));
        all
    }

    /// What a pixel's neighbours have left.
    pub fn around(&self, x: i32, y: i32) -> [i32; 3] {
        let there = |y: i64, x: i64| {
            let row = usize::try_from(y).ok().and_then(|y| self.rows.get(y));
            let at = usize::try_from(x).ok();
            row.and_then(|row| row.get(at?)).copied()
        };
        let (wide, high) = (i64::from(x), i64::from(y));
        let reach = u32::try_from(y)
            .ok()
            .and_then(|y| self.refinement.reach(y, self.height));
        Neighbour::ALL.map(|which| {
            let found = reach.map(i64::from).and_then(|reach| match which {
                Neighbour::Above => there(high - reach, wide),
                Neighbour::Below => there(high + reach, wide),
                Neighbour::Left if x == 0 => there(high - reach, wide),
                Neighbour::Left => there(high, wide - 1),
            });
            found.unwrap_or(which.alone())
        })
    }

    /// Whether a pixel between key rows is traced with such neighbours; nothing in other rows.
    pub fn traces_between(&self, y: i32, around: [i32; 3]) -> Option<bool> {
        let (row, height) = (u32::try_from(y).ok()?, self.height);
        self.refinement.reach(row, height)?;
        Some(self.refinement.traces(row, height, around))
    }

    /// Keeps what a pixel leaves, where it is the next of its row; what was there already is
    /// the same.
    pub fn keep(&mut self, x: i32, y: i32, kept: i32) {
        let row = usize::try_from(y).ok().and_then(|y| self.rows.get_mut(y));
        if let Some(row) = row.filter(|row| usize::try_from(x) == Ok(row.len()))
            && row.len() < self.width as usize
        {
            row.push(kept);
        }
    }
}

/// What is around a pixel that is being evaluated, and how many of those that were asked for
/// are traced.
#[derive(Clone, Debug)]
pub struct Around {
    /// What was left so far; none where each pixel is by itself.
    drawn: Option<Neighbours>,
    /// What the neighbours of the pixel left.
    pub left: [i32; 3],
    traced: u64,
}

impl Around {
    /// Before the first pixel.
    pub fn new(graph: &Graph) -> Around {
        Around {
            drawn: Neighbours::new(graph),
            left: Neighbour::ALL.map(Neighbour::alone),
            traced: 0,
        }
    }

    /// The same with each pixel by itself: what neighbours leave is made up
    /// ([`Refinement::sampled`]).
    #[must_use]
    pub fn alone(self) -> Around {
        Around {
            drawn: None,
            ..self
        }
    }

    /// The pixels that have to be drawn before the one at (x, y), in that order.
    pub fn due(&mut self, x: i32, y: i32) -> Vec<(i32, i32)> {
        let drawn = self.drawn.as_mut();
        drawn.map_or(Vec::new(), |drawn| drawn.due(x, y))
    }

    /// Comes to a pixel.
    pub fn come(&mut self, graph: &Graph, x: i32, y: i32) {
        if let Some(refinement) = graph.refinement {
            self.left = match &self.drawn {
                Some(drawn) => drawn.around(x, y),
                None => refinement.sampled(x, y),
            };
        }
    }

    /// Keeps what a pixel leaves.
    pub fn keep(&mut self, x: i32, y: i32, kept: i32) {
        if let Some(drawn) = &mut self.drawn {
            drawn.keep(x, y, kept);
        }
    }

    /// Counts a pixel that was asked for.
    pub fn count(&mut self, graph: &Graph, y: i32) {
        let row = u32::try_from(y).unwrap_or(0);
        let traces = |r: Refinement| r.traces(row, graph.image.height, self.left);
        self.traced += u64::from(graph.refinement.is_none_or(traces));
    }

    /// How many of those were traced, and are not what lies between those around them.
    pub fn traced(&self) -> u64 {
        self.traced
    }
}
