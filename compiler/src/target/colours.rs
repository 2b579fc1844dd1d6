//! A machine's own colours for a scene's inks.

/// The colours, by their numbers, that stand for a palette: near ones, and different
/// ones as long as there are enough, so that no two inks look alike. Among equally near
/// ones the brightness decides. `own` has the machine's, 255 at most.
pub fn nearest(palette: &[[u8; 3]], own: &[[u8; 3]]) -> Vec<u8> {
    let bright = |[r, g, b]: [u8; 3]| 299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b);
    let off = |a: [u8; 3], b: [u8; 3]| -> u32 {
        (0..3).map(|i| u32::from(a[i].abs_diff(b[i])).pow(2)).sum()
    };
    let mut pairs: Vec<(u32, u32, usize, u8)> = Vec::new();
    for (ink, &rgb) in palette.iter().enumerate() {
        for (colour, &near) in (0..).zip(own) {
            let darker = bright(near).abs_diff(bright(rgb));
            pairs.push((off(near, rgb), darker, ink, colour));
        }
    }
    pairs.sort_unstable();
    let mut given = vec![None; palette.len()];
    // With more inks than colours, further rounds give them out again.
    while !own.is_empty() && given.contains(&None) {
        let mut taken = vec![false; own.len()];
        for &(_, _, ink, colour) in &pairs {
            let taken = &mut taken[usize::from(colour)];
            if given[ink].is_none() && !*taken {
                given[ink] = Some(colour);
                *taken = true;
            }
        }
    }
    given.into_iter().flatten().collect()
}
