//! Walls: what a picture's columns look like, whatever they are made of.

use rustc_hash::FxHashMap;

/// What was seen of columns: by kind and by steps reached, the inks from top to bottom.
pub(super) struct Walls {
    rows: usize,
    seen: Vec<((usize, usize), Vec<u8>)>,
}

/// Heights, inks, and what is above and below.
type Read = (Vec<u8>, Vec<u8>, [u8; 2]);

impl Walls {
    pub fn new(rows: usize) -> Walls {
        let seen = Vec::new();
        Walls { rows, seen }
    }

    pub fn see(&mut self, of: (usize, usize), inks: Vec<u8>) {
        if self
            .seen
            .last()
            .is_none_or(|last| *last != (of, inks.clone()))
        {
            self.seen.push((of, inks));
        }
    }

    /// Heights by steps, inks by kinds, and what is above and below.
    ///
    /// # Errors
    /// What of it is no wall.
    pub fn read(&self) -> Result<Read, String> {
        let half = self.rows / 2;
        let backs = self.backs()?;
        let mut heights: FxHashMap<usize, usize> = FxHashMap::default();
        let mut inks: FxHashMap<usize, u8> = FxHashMap::default();
        for ((kind, step), seen) in &self.seen {
            let above = seen.iter().take(half).take_while(|ink| **ink == backs[0]);
            let height = half - above.count();
            let wall = seen.get(half).copied().filter(|_| height > 0);
            let should = (0..self.rows).map(|y| match wall {
                Some(wall) if (half - height..half + height).contains(&y) => wall,
                _ => backs[usize::from(y >= half)],
            });
            if !should.eq(seen.iter().copied()) {
                return Err("a column is not a wall of one ink about the middle row".to_owned());
            }
            if *heights.entry(*step).or_insert(height) != height {
                return Err("how tall a wall is hangs on more than one number".to_owned());
            }
            if let Some(wall) = wall
                && *inks.entry(*kind).or_insert(wall) != wall
            {
                return Err(
                    "a wall's ink hangs on the column's number, or on how tall it is".to_owned(),
                );
            }
        }
        let kinds = self.seen.iter().map(|((kind, _), _)| *kind).max();
        let steps = self.seen.iter().map(|((_, step), _)| *step).max();
        let height = |step| heights.get(&step).map_or(0, |h| *h as u8);
        let ink = |kind| inks.get(&kind).copied().unwrap_or(backs[0]);
        Ok((
            (0..=steps.unwrap_or(0)).map(height).collect(),
            (0..=kinds.unwrap_or(0)).map(ink).collect(),
            backs,
        ))
    }

    /// What is above and below the walls: the ends of the column with most of the same at them.
    fn backs(&self) -> Result<[u8; 2], String> {
        let half = self.rows / 2;
        let run = |seen: &Vec<u8>| {
            let first = seen.first().copied();
            seen.iter()
                .take(half)
                .take_while(|ink| Some(**ink) == first)
                .count()
        };
        // A column that is one ink from top to bottom may be a wall.
        let whole = |seen: &Vec<u8>| seen.iter().all(|ink| Some(ink) == seen.first());
        let parted = self
            .seen
            .iter()
            .map(|(_, seen)| seen)
            .filter(|seen| !whole(seen));
        let lowest = parted.max_by_key(|seen| run(seen));
        match lowest.map(|seen| (seen.first().copied(), seen.last().copied())) {
            Some((Some(above), Some(below))) => Ok([above, below]),
            _ => Err("no column has anything above or below a wall".to_owned()),
        }
    }
}
