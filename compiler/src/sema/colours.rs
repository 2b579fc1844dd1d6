//! Colours of the palette by name: those of the machines, and the sixteen of
//! HTML 4 (W3C, HTML 4.01 section 6.5) where the machines have none.

/// Names and red, green, blue.
pub const COLOURS: [(&str, [u8; 3]); 20] = [
    ("black", [0, 0, 0]),
    ("red", [255, 0, 0]),
    ("green", [0, 255, 0]),
    ("yellow", [255, 255, 0]),
    ("blue", [0, 0, 255]),
    ("magenta", [255, 0, 255]),
    ("cyan", [0, 255, 255]),
    ("white", [255, 255, 255]),
    ("grey", [128, 128, 128]),
    ("gray", [128, 128, 128]),
    ("silver", [192, 192, 192]),
    ("maroon", [128, 0, 0]),
    ("purple", [128, 0, 128]),
    ("lime", [0, 255, 0]),
    ("olive", [128, 128, 0]),
    ("navy", [0, 0, 128]),
    ("teal", [0, 128, 128]),
    ("orange", [255, 165, 0]),
    ("brown", [165, 42, 42]),
    ("pink", [255, 192, 203]),
];

/// The colour that a name, `#rrggbb` or `#rgb` means, of which the last has each digit twice
/// (W3C, CSS Color Module Level 4, section 5.2).
pub fn colour(text: &str) -> Option<[u8; 3]> {
    if let Some(hex) = text.strip_prefix('#') {
        if !hex.bytes().all(|b| b.is_ascii_hexdigit()) {
            return None;
        }
        let value = u32::from_str_radix(hex, 16).ok()?;
        return match hex.len() {
            6 => {
                let [_, r, g, b] = value.to_be_bytes();
                Some([r, g, b])
            }
            3 => Some([8, 4, 0].map(|at| (value >> at & 15) as u8 * 17)),
            _ => None,
        };
    }
    let found = COLOURS.iter().find(|(name, _)| *name == text);
    found.map(|&(_, rgb)| rgb)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_written_in_three_ways() {
        for (text, rgb) in [
            ("#336", [0x33, 0x33, 0x66]),
            ("#a0F", [0xAA, 0, 0xFF]),
            ("#8080a0", [0x80, 0x80, 0xA0]),
            ("orange", [255, 165, 0]),
        ] {
            assert_eq!(colour(text), Some(rgb), "{text}");
        }
        for text in [
            "#", "#12", "#1234", "#12345", "#1234567", "#ggg", "#+12", "Orange",
        ] {
            assert_eq!(colour(text), None, "{text}");
        }
    }
}
