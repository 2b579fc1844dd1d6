//! A low-discrepancy order of a grid's points: however few of the first are looked at, they are
//! spread over the whole of it.

/// The golden section's fraction: multiples of it spread evenly (Weyl, equidistribution).
pub const GOLDEN: f64 = 0.618_033_988_749_895;

/// All columns and rows of a grid, each once, in steps of about the golden section of them all.
/// The order of one of several choices begins elsewhere than that of the others.
pub fn scattered(
    [columns, rows]: [u32; 2],
    choice: u32,
    choices: u32,
) -> impl Iterator<Item = (u32, u32)> {
    let all = u64::from(columns) * u64::from(rows);
    let near = (all as f64 * GOLDEN) as u64;
    // Any step without a common divisor comes to all of them.
    let step = (near..=all).find(|step| greatest_common_divisor(*step, all) == 1);
    let step = step.unwrap_or(1);
    let first = u64::from(choice) * all / u64::from(choices.max(1));
    (0..all).map(move |k| {
        let at = ((first + k) * step % all) as u32;
        (at % columns, at / columns)
    })
}

fn greatest_common_divisor(a: u64, b: u64) -> u64 {
    match b {
        0 => a,
        _ => greatest_common_divisor(b, a % b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_point_has_its_turn_once() {
        for grid in [[1, 1], [1, 7], [31, 24], [101, 80], [2, 2]] {
            let all: Vec<(u32, u32)> = scattered(grid, 5, 12).collect();
            assert_eq!(all.len() as u32, grid[0] * grid[1]);
            assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len());
            assert!(all.iter().all(|(x, y)| *x < grid[0] && *y < grid[1]));
        }
    }

    /// A tenth of the points has something of each of the grid's parts, four by four.
    #[test]
    fn the_first_are_spread_over_the_whole_grid() {
        let [columns, rows] = [31, 24];
        for choice in 0..12 {
            let few = scattered([columns, rows], choice, 12).take(74);
            let parts: BTreeSet<_> = few.map(|(x, y)| (4 * x / columns, 4 * y / rows)).collect();
            assert_eq!(parts.len(), 16, "{choice}");
        }
    }
}
