//! How the fused engine gets at the words of the RAM.

use super::command::{HEAP, KEYBOARD, Memory, Place};

/// The word in a place.
#[inline(always)]
pub(super) fn get(memory: &Memory, place: Place) -> u16 {
    memory[usize::from(address(memory, place))]
}

#[inline(always)]
pub(super) fn set(memory: &mut Memory, place: Place, value: u16) {
    memory[usize::from(address(memory, place))] = value;
}

#[inline(always)]
pub(super) fn address(memory: &Memory, place: Place) -> u16 {
    memory[usize::from(place.base)].wrapping_add(place.offset)
}

/// Whether an address that a program computed is in the heap or on the screen: not
/// among the pointers, the statics or the stack, not the keyboard's, where a read
/// is a look at the keys, and not where there is no memory.
#[inline(always)]
pub(super) fn is_far(address: u16) -> bool {
    address.wrapping_sub(HEAP) < KEYBOARD - HEAP
}
