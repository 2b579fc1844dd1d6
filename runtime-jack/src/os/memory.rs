//! `Memory` and `Array`: the heap, a first-fit list of segments.
//!
//! A segment is a word of free capacity (0 when taken), a word with the address of
//! the next segment, and the words themselves. The bundled VM's own system lays it
//! out in the same way, so addresses agree. Segments that are given back are not joined,
//! and the last two words are left alone: so it is in the web IDE.

pub(super) const PEEK: &str = "    function int peek(int address) {
        var Array word;
        let word = address;
        return word[0];
    }
";

pub(super) const POKE: &str = "    function void poke(int address, int value) {
        var Array word;
        let word = address;
        let word[0] = value;
        return;
    }
";

/// Named like what fills a class's statics, as it is called once at the start.
pub(super) const MAKE_HEAP: &str =
    "    /** One free segment of 14,334 words, its header included. */
    function void makeHeap() {
        var Array heap;
        let heap = 2048;
        let heap[0] = 14332;
        let heap[1] = 16382;
        return;
    }
";

pub(super) const ALLOC: &str =
    "    /** The first free segment that is large enough; what is left of it stays free. */
    function int alloc(int size) {
        var Array segment, rest;
        if (size < 1) { do Sys.error(5); }
        let segment = 2048;
        while (segment[0] < size) {
            let segment = segment[1];
            if (segment > 16381) { do Sys.error(6); }
        }
        if (segment[0] > (size + 2)) {
            let rest = segment + 2 + size;
            let rest[0] = segment[0] - size - 2;
            let rest[1] = segment[1];
            let segment[1] = rest;
        }
        let segment[0] = 0;
        return segment + 2;
    }
";

pub(super) const DE_ALLOC: &str = "    /** Frees a segment: its words are those up to the next. */
    function void deAlloc(Array object) {
        var Array segment;
        let segment = object - 2;
        let segment[0] = segment[1] - object;
        return;
    }
";

pub(super) const NEW: &str = "    function Array new(int size) {
        if (size < 1) { do Sys.error(2); }
        return Memory.alloc(size);
    }
";

pub(super) const DISPOSE: &str = "    method void dispose() {
        do Memory.deAlloc(this);
        return;
    }
";
