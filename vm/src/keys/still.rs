//! Whether a program stands still: finds a state that comes again, by Brent's method.
//!
//! A program that looks at a keyboard where no key is left, twice in the same state, does
//! for ever what it did in between: nothing from outside can change that.
//!
//! Source: R. P. Brent, "An improved Monte Carlo factorization algorithm" (1980), section 2.

/// States seen so far: of all but a few, only how many.
#[derive(Clone, Debug, Default)]
pub(crate) struct Still<T> {
    memory: Vec<T>,
    place: u64,
    /// States since the one that is kept, and after how many another is.
    since: u64,
    keep: u64,
}

impl<T: Copy + PartialEq> Still<T> {
    /// Whether the state at a place of the program, with this memory, has been before.
    pub fn again(&mut self, place: u64, memory: &[T]) -> bool {
        if self.keep > 0 && self.place == place && self.memory == memory {
            return true;
        }
        if self.since >= self.keep {
            self.keep = (2 * self.keep).max(1);
            self.since = 0;
            self.place = place;
            self.memory.clear();
            self.memory.extend_from_slice(memory);
        }
        self.since += 1;
        false
    }
}
