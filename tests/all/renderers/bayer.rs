//! Bayer's matrix, for the renderers alone.

/// The 8 x 8 matrix of Bayer over 64: the bits of x xor y and of x in turn,
/// the lowest first in rank.
pub fn bayer8(x: i32, y: i32) -> f64 {
    let rank = (0..3).fold(0, |rank, k| {
        rank * 4 + ((x ^ y) >> k & 1) * 2 + (x >> k & 1)
    });
    f64::from(rank) / 64.0
}
