//! The colours of a PAL machine: a hue is an angle of the colour carrier, every second one going
//! the other way round, and each has eight steps of brightness.

/// How strong a colour is.
const STRENGTH: f64 = 0.19;

/// What a colour looks like; `None` of hues that are grey as well.
fn shown(colour: u8) -> Option<[f64; 3]> {
    let (hue, light) = (colour >> 4, f64::from(colour >> 1 & 7));
    let y = 255.0 * light / 7.0;
    let angle = match hue {
        0 => return Some([y; 3]),
        1 | 14 | 15 => return None,
        hue if hue % 2 == 0 => 168.0 - 28.0 * f64::from(hue / 2 - 1),
        hue => 196.0 + 28.0 * f64::from(hue / 2 - 1),
    };
    let angle = f64::to_radians(angle);
    let (u, v) = (
        255.0 * STRENGTH * angle.cos(),
        255.0 * STRENGTH * angle.sin(),
    );
    let parts = [y + 1.14 * v, y - 0.395 * u - 0.581 * v, y + 2.032 * u];
    Some(parts.map(|part| part.clamp(0.0, 255.0)))
}

/// The byte that is stored for the nearest colour.
pub(super) fn nearest(rgb: [u8; 3]) -> u8 {
    let off = |colour: u8| {
        let shown = shown(colour)?;
        let parts = shown.iter().zip(rgb);
        Some(parts.map(|(a, b)| (a - f64::from(b)).powi(2)).sum::<f64>())
    };
    let all = (0..128u8).map(|k| 2 * k);
    let all = all.filter_map(|colour| Some((off(colour)?, colour)));
    let least = all.min_by(|a, b| a.0.total_cmp(&b.0));
    least.map_or(0, |(_, colour)| colour)
}
