//! Numbers at random for tests, the same in every run. The tests of the whole
//! include this file, too.

/// Marsaglia's xorshift with 64 bits (Xorshift RNGs, 2003).
pub struct Random(u64);

impl Random {
    /// By a seed: seeds that are near each other begin far apart.
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// From 0 to n - 1, n below 2^44.
    pub fn below(&mut self, n: u64) -> u64 {
        (self.next() >> 20) % n
    }
}
