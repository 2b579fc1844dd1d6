//! The heap: a first-fit list of segments in the machine's own RAM.
//!
//! A segment is a word of free capacity (0 when taken), a word with the
//! address of the next segment, and the words themselves.

use super::{Memory, Os, Trap, load};
use crate::hack::vm::command::{HEAP, SCREEN};

/// Words of bookkeeping before each segment.
const HEADER: u16 = 2;

/// Which operating system's heap a machine has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heap {
    /// What is there in every VM emulator with the system built in: 14,334 words, headers
    /// included, from 2048 on. The web IDE counts them so, and joins no segments that are
    /// given back; the official emulator has two more, and joins.
    #[default]
    BuiltIn,
    /// What the official system leaves where its `.vm` files run beside the program: the
    /// first segment that `Main.main` gets is at 4872, those in a row are joined, and none
    /// may end within the last three words.
    Official,
}

impl Heap {
    /// The header of the first segment.
    const fn first(self) -> u16 {
        match self {
            Heap::BuiltIn => HEAP,
            Heap::Official => 4870,
        }
    }

    /// The first address behind it.
    const fn end(self) -> u16 {
        match self {
            Heap::BuiltIn => SCREEN - HEADER,
            Heap::Official => SCREEN,
        }
    }

    /// The greatest sum of a segment's address, its header's, and its size.
    const fn most(self) -> u16 {
        match self {
            Heap::BuiltIn => self.end() - HEADER,
            Heap::Official => 16379,
        }
    }

    /// Words that segments can take, their headers included.
    pub const fn words(self) -> u16 {
        self.most() + HEADER - self.first()
    }

    const fn joins(self) -> bool {
        matches!(self, Heap::Official)
    }
}

/// Makes the whole heap one free segment.
pub(super) fn init(memory: &mut Memory, heap: Heap) {
    let first = usize::from(heap.first());
    memory[first] = heap.end() - heap.first() - HEADER;
    memory[first + 1] = heap.end();
}

/// The address of `size` fresh words.
pub(super) fn alloc(memory: &mut Memory, os: &mut Os, size: u16) -> Result<u16, Trap> {
    if size.cast_signed() <= 0 {
        return Err(Trap::Error(5, "the size to allocate must be positive"));
    }
    let heap = os.heap;
    let mut segment = heap.first();
    // No list without a cycle has more segments than the heap has pairs of words, and each
    // is joined with the next once.
    for _ in 0..(SCREEN - HEAP) {
        if !(heap.first()..heap.end()).contains(&segment) {
            break;
        }
        os.effort += 1;
        let capacity = load(memory, segment).cast_signed();
        if capacity >= size.cast_signed() {
            if u32::from(segment) + u32::from(size) > u32::from(heap.most()) {
                break;
            }
            take(memory, os, segment, size);
            return Ok(segment + HEADER);
        }
        let next = load(memory, segment + 1);
        let may_join = heap.joins() && capacity != 0 && next < heap.end();
        if may_join && load(memory, next) != 0 {
            join(memory, os, segment);
        } else {
            segment = next;
        }
    }
    Err(Trap::Error(6, "no room left on the heap"))
}

/// Takes the first words of a free segment; the rest stays free, where it can be one.
fn take(memory: &mut Memory, os: &mut Os, segment: u16, size: u16) {
    let capacity = load(memory, segment);
    if capacity > size + HEADER {
        let rest = segment + HEADER + size;
        let next = load(memory, segment + 1);
        os.store(memory, rest, capacity - size - HEADER);
        os.store(memory, rest.wrapping_add(1), next);
        os.store(memory, segment + 1, rest);
    }
    os.store(memory, segment, 0);
}

/// Makes a segment and the next one, both free or about to be, one free segment.
fn join(memory: &mut Memory, os: &mut Os, segment: u16) {
    let next = load(memory, segment.wrapping_add(1));
    let between = next.wrapping_sub(segment);
    let more = load(memory, next);
    let after = load(memory, next.wrapping_add(1));
    os.store(memory, segment, between.wrapping_add(more));
    os.store(memory, segment.wrapping_add(1), after);
}

/// Gives the segment at `address` back.
pub(super) fn de_alloc(memory: &mut Memory, os: &mut Os, address: u16) {
    let segment = address.wrapping_sub(HEADER);
    let next = load(memory, segment.wrapping_add(1));
    if os.heap.joins() && next < os.heap.end() && load(memory, next) != 0 {
        join(memory, os, segment);
    } else {
        let room = next.wrapping_sub(address);
        os.store(memory, segment, room);
    }
}
