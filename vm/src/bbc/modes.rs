//! Screen modes as data, by dialect.

use super::Dialect;

/// How pixels lie in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layout {
    /// In the 64K of memory from HIMEM up: characters of 8 bytes, 640 (or 320) bytes a row of them.
    Memory,
    /// In memory of its own, one byte a pixel here.
    Apart,
    /// Text only: nothing to draw on.
    Text,
}

/// A screen mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Mode {
    pub number: u8,
    pub width: u32,
    pub height: u32,
    pub inks: u16,
    pub columns: u8,
    pub rows: u8,
    pub himem: u32,
    pub layout: Layout,
}

const fn micro(number: u8, width: u32, inks: u16, text: (u8, u8), himem: u32) -> Mode {
    Mode {
        number,
        width,
        height: 256,
        inks,
        columns: text.0,
        rows: text.1,
        himem,
        layout: if width == 0 {
            Layout::Text
        } else {
            Layout::Memory
        },
    }
}

const fn apart(number: u8, width: u32, height: u32, inks: u16) -> Mode {
    Mode {
        number,
        width,
        height,
        inks,
        columns: if width / 8 > 255 {
            255
        } else {
            (width / 8) as u8
        },
        rows: (height / 8) as u8,
        himem: 0x8000,
        layout: Layout::Apart,
    }
}

/// BBC Micro model B, OS 1.20.
const MICRO: &[Mode] = &[
    micro(0, 640, 2, (80, 32), 0x3000),
    micro(1, 320, 4, (40, 32), 0x3000),
    micro(2, 160, 16, (20, 32), 0x3000),
    micro(3, 0, 2, (80, 25), 0x4000),
    micro(4, 320, 2, (40, 32), 0x5800),
    micro(5, 160, 4, (20, 32), 0x5800),
    micro(6, 0, 2, (40, 25), 0x6000),
    micro(7, 0, 8, (40, 25), 0x7c00),
];

/// Agon Light, console 8 firmware; its screen is the display processor's own.
const AGON: &[Mode] = &[
    apart(0, 640, 480, 16),
    apart(1, 640, 480, 4),
    apart(2, 640, 480, 2),
    apart(3, 640, 240, 64),
    apart(4, 640, 240, 16),
    apart(5, 640, 240, 4),
    apart(6, 640, 240, 2),
    apart(8, 320, 240, 64),
    apart(9, 320, 240, 16),
    apart(10, 320, 240, 4),
    apart(11, 320, 240, 2),
    apart(12, 320, 200, 64),
    apart(13, 320, 200, 16),
    apart(14, 320, 200, 4),
    apart(15, 320, 200, 2),
];

/// RISC OS, as Brandy has them.
const BASIC_V: &[Mode] = &[
    apart(0, 640, 256, 2),
    apart(1, 320, 256, 4),
    apart(2, 160, 256, 16),
    apart(4, 320, 256, 2),
    apart(5, 160, 256, 4),
    apart(8, 640, 256, 4),
    apart(9, 320, 256, 16),
    apart(12, 640, 256, 16),
    apart(13, 320, 256, 256),
    apart(15, 640, 256, 256),
    apart(18, 640, 512, 2),
    apart(19, 640, 512, 4),
    apart(20, 640, 512, 16),
    apart(27, 640, 480, 16),
    apart(28, 640, 480, 256),
];

fn all(dialect: Dialect) -> &'static [Mode] {
    match dialect {
        Dialect::Micro => MICRO,
        Dialect::Agon => AGON,
        Dialect::BasicV => BASIC_V,
    }
}

/// A mode by its number. The Micro takes numbers modulo 8.
pub(crate) fn find(dialect: Dialect, number: u8) -> Option<&'static Mode> {
    let number = if dialect == Dialect::Micro {
        number & 7
    } else {
        number
    };
    all(dialect).iter().find(|m| m.number == number)
}

/// The mode that the machine starts in.
pub(crate) fn first(dialect: Dialect) -> &'static Mode {
    match dialect {
        Dialect::Micro => &MICRO[7],
        Dialect::Agon => &AGON[1],
        Dialect::BasicV => &BASIC_V[0],
    }
}

/// Red, green and blue of the eight physical colours (bit 0 red, 1 green, 2 blue).
pub(crate) fn physical(colour: u8) -> [u8; 3] {
    [1, 2, 4].map(|bit| if colour & bit != 0 { 255 } else { 0 })
}

/// The physical colours that a mode starts with.
pub(crate) fn palette(inks: u16) -> Vec<[u8; 3]> {
    match inks {
        2 => vec![physical(0), physical(7)],
        4 => [0, 1, 3, 7].map(physical).to_vec(),
        // The flashing colours of 16 shown in their first state, as the machine starts.
        8 | 16 => (0..inks as u8).map(physical).collect(),
        // 6 or 8 bits of colour, two a component.
        _ => (0..inks)
            .map(|i| [0, 2, 4].map(|shift| ((i >> shift & 3) * 85) as u8))
            .collect(),
    }
}
