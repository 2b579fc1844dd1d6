//! A raster font of 8 by 8 pixels for the characters 32 to 127.
//!
//! The shapes are a public-domain font's (the operating system's own are not free to copy), so
//! text stands where it stands on a Micro but looks otherwise. As there, 96 is a pound sign and
//! 127 a full square.

use font8x8::legacy::{BASIC_LEGACY, LATIN_LEGACY};

/// A row a byte, from the top; the leftmost pixel in the highest bit.
pub(crate) const FONT: [[u8; 8]; 96] = {
    let mut font = [[0xff; 8]; 96];
    let mut i = 0;
    while i < 95 {
        let shape = match i {
            // Of the signs from 160 on, the third.
            64 => LATIN_LEGACY[3],
            _ => BASIC_LEGACY[32 + i],
        };
        let mut row = 0;
        while row < 8 {
            font[i][row] = shape[row].reverse_bits();
            row += 1;
        }
        i += 1;
    }
    font
};
