//! Static branch and trip-count estimates: how often parts of a picture's statements run, as far
//! as that can be guessed.

use super::tree::*;

/// How likely a loop is thought to go on after a turn, and to be entered at all
/// where that is a choice: rays mostly meet what is far.
pub const ON: f64 = 0.25;

/// How likely the first of two ways is.
pub fn likely(yes: &Block, no: &Block) -> f64 {
    match (loops(yes), loops(no)) {
        (true, false) => ON,
        (false, true) => 1.0 - ON,
        _ => 0.5,
    }
}

/// A loop's blocks, with how often each runs where the loop runs once.
pub fn turns(turns: &Turns) -> [(&Block, f64); 5] {
    let all = 1.0 / (1.0 - ON);
    let often = [1.0, all, all * ON, 1.0, 0.0];
    let blocks = turns.blocks();
    std::array::from_fn(|k| (blocks[k], often[k]))
}

/// Whether a block has a loop in it.
pub fn loops(block: &Block) -> bool {
    let mut found = false;
    walk(block, &mut |s| found |= matches!(s, Statement::Loop(_)));
    found
}
