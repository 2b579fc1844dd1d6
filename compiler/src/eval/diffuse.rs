//! Error diffusion while a picture is evaluated: what later pixels will
//! receive, and which pixels have to be drawn before one.
//!
//! Only the rows that a share can still reach are kept. [`Graph::diffusion`]
//! says in which order shares are added up.
//!
//! [`Graph::diffusion`]: crate::ir::graph::Graph

use crate::ir::graph::{Graph, Share};
use std::collections::VecDeque;
use std::ops::Range;

/// What the pixels to come will receive.
#[derive(Clone, Debug)]
pub struct Pending<V> {
    width: i64,
    height: i64,
    zero: V,
    /// The row that `rows` begins with.
    top: i64,
    rows: VecDeque<Vec<V>>,
    /// The next pixel in scan order: row times width plus column.
    next: i64,
}

impl<V: Copy> Pending<V> {
    /// Nothing sent yet. `None` where the graph spreads nothing.
    pub fn new(graph: &Graph, zero: V) -> Option<Pending<V>> {
        let reach = graph.diffusion.as_ref()?.reach();
        let width = graph.image.width as usize;
        Some(Pending {
            width: i64::from(graph.image.width),
            height: i64::from(graph.image.height),
            zero,
            top: 0,
            rows: (0..=reach).map(|_| vec![zero; width]).collect(),
            next: 0,
        })
    }

    fn inside(&self, x: i64, y: i64) -> bool {
        (0..self.width).contains(&x) && (0..self.height).contains(&y)
    }

    /// The pixels, by number in scan order, that have to be drawn before the
    /// one at (x, y): none when pixels are asked for in order. Where that one
    /// was drawn already, the picture begins anew.
    pub fn due(&mut self, x: i32, y: i32) -> Range<i64> {
        let (x, y) = (i64::from(x), i64::from(y));
        if !self.inside(x, y) {
            return 0..0;
        }
        let number = y * self.width + x;
        if number < self.next {
            self.next = 0;
            self.top = 0;
            self.rows.iter_mut().for_each(|row| row.fill(self.zero));
        }
        self.next..number
    }

    /// Where a pixel stands, by its number.
    pub fn place(&self, number: i64) -> (i32, i32) {
        let width = self.width.max(1);
        ((number % width) as i32, (number / width) as i32)
    }

    /// Comes to a pixel, the next in order; answers what it receives. A pixel
    /// outside of the picture receives nothing.
    pub fn receive(&mut self, x: i32, y: i32) -> V {
        let (x, y) = (i64::from(x), i64::from(y));
        if !self.inside(x, y) {
            return self.zero;
        }
        self.next = y * self.width + x + 1;
        while self.top < y {
            self.top += 1;
            if let Some(mut row) = self.rows.pop_front() {
                row.fill(self.zero);
                self.rows.push_back(row);
            }
        }
        let row = self.rows.front();
        let found = row.and_then(|row| row.get(x as usize));
        found.copied().unwrap_or(self.zero)
    }

    /// Adds what the pixel at (x, y) sends to another: `add(received, sent)`.
    pub fn send(&mut self, x: i32, y: i32, share: Share, sent: V, add: impl Fn(V, V) -> V) {
        let (from_x, from_y) = (i64::from(x), i64::from(y));
        let (to_x, to_y) = (from_x + i64::from(share.dx), from_y + i64::from(share.dy));
        if !self.inside(from_x, from_y) || !self.inside(to_x, to_y) {
            return;
        }
        let row = usize::try_from(to_y - self.top).ok();
        let row = row.and_then(|row| self.rows.get_mut(row));
        if let Some(slot) = row.and_then(|row| row.get_mut(to_x as usize)) {
            *slot = add(*slot, sent);
        }
    }
}
