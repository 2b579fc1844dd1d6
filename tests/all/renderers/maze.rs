//! The maze without a walk: of all the walls of the map, the one whose square
//! the ray enters first.

const LEVEL: [&str; 16] = [
    "################",
    "#...#.........##",
    "#.#..###.....#.#",
    "#..............#",
    "#.#..#.#.#.#.#.#",
    "#....#....#....#",
    "#..........#...#",
    "#.##.##........#",
    "#.##.##...##...#",
    "#.........##...#",
    "#..#...........#",
    "#..#....###....#",
    "#.......#.#..#.#",
    "#.####..###....#",
    "##.............#",
    "################",
];

/// Where a line from `from` along `dir` is between `low` and `low` + 1.
fn between(from: f64, dir: f64, low: f64) -> (f64, f64) {
    let (a, b) = ((low - from) / dir, (low + 1.0 - from) / dir);
    (a.min(b), a.max(b))
}

/// The ink: 0 no wall, 1 a wall met through a border between columns, 2 rows.
pub fn ink(x: i32, y: i32, pos: [f64; 2], heading: f64) -> u8 {
    let bend = (f64::from(x) - 15.5) / 256.0;
    let turn = |turns: f64| (turns * std::f64::consts::TAU).sin_cos();
    let (sin, cos) = turn(heading + bend);
    let (mut nearest, mut side) = (f64::INFINITY, 0);
    for (row, cells) in LEVEL.iter().enumerate() {
        for (column, cell) in cells.bytes().enumerate() {
            let (left, right) = between(pos[0], cos, column as f64);
            let (top, bottom) = between(pos[1], sin, row as f64);
            let enters = left.max(top);
            let inside = 0.0 < enters && enters < right.min(bottom);
            if cell == b'#' && inside && enters < nearest {
                (nearest, side) = (enters, u8::from(top > left));
            }
        }
    }
    let tall = 16.0 / (nearest * turn(bend).1).max(0.5);
    if (f64::from(y) - 15.5).abs() < tall {
        1 + side
    } else {
        0
    }
}
