//! The heap: a first-fit list of segments in the machine's own RAM.
//!
//! A segment is a word of free capacity (0 when taken), a word with the
//! address of the next segment, and the words themselves. A segment given
//! back is joined with the next one if that is free. The layout is that of
//! the official implementation, so addresses agree with it.

use super::{Memory, Os, Trap, load};
use crate::hack::vm::command::{HEAP, SCREEN};

/// Words of bookkeeping before each segment.
const HEADER: u16 = 2;

/// Makes the whole heap one free segment.
pub(super) fn init(memory: &mut Memory) {
    memory[usize::from(HEAP)] = SCREEN - HEAP - HEADER;
    memory[usize::from(HEAP) + 1] = SCREEN;
}

/// The address of `size` fresh words.
pub(super) fn alloc(memory: &mut Memory, os: &mut Os, size: u16) -> Result<u16, Trap> {
    if size.cast_signed() <= 0 {
        return Err(Trap::Error(5, "the size to allocate must be positive"));
    }
    let mut segment = HEAP;
    // No list without a cycle has more segments than the heap has pairs of words.
    for _ in 0..(SCREEN - HEAP) / HEADER {
        if !(HEAP..SCREEN).contains(&segment) {
            break;
        }
        os.effort += 1;
        let capacity = load(memory, segment).cast_signed();
        let next = load(memory, segment + 1);
        if capacity >= size.cast_signed() {
            let capacity = capacity.cast_unsigned();
            if capacity > size + HEADER {
                let rest = segment + HEADER + size;
                os.store(memory, rest, capacity - size - HEADER);
                os.store(memory, rest.wrapping_add(1), next);
                os.store(memory, segment + 1, rest);
            }
            os.store(memory, segment, 0);
            return Ok(segment + HEADER);
        }
        segment = next;
    }
    Err(Trap::Error(6, "no room left on the heap"))
}

/// Gives the segment at `address` back.
pub(super) fn de_alloc(memory: &mut Memory, os: &mut Os, address: u16) {
    let segment = address.wrapping_sub(HEADER);
    let next = load(memory, segment.wrapping_add(1));
    let between = next.wrapping_sub(segment);
    let free = if next < SCREEN { load(memory, next) } else { 0 };
    if free == 0 {
        os.store(memory, segment, between.wrapping_sub(HEADER));
    } else {
        os.store(memory, segment, between.wrapping_add(free));
        let after = load(memory, next.wrapping_add(1));
        os.store(memory, segment.wrapping_add(1), after);
    }
}
