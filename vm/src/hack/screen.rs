//! The screen of the Hack computer: 256 rows of 32 words from address 16384.

use crate::Screen;

/// What the words of the screen show, the leftmost pixel of a word in its
/// lowest bit: 512 x 256 where there are 8,192; ink 0 is black (the bit set),
/// ink 1 white.
pub(crate) fn screen(words: &[u16]) -> Screen {
    let pixels = words
        .iter()
        .flat_map(|word| (0..16).map(move |bit| u8::from(word >> bit & 1 == 0)));
    Screen {
        width: 512,
        height: 256,
        pixels: pixels.collect(),
        palette: vec![[0, 0, 0], [255, 255, 255]],
    }
}
