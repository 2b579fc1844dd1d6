//! `Screen`: 512 x 256 pixels, 32 words a row, the leftmost pixel of a word in its
//! lowest bit, a set bit black.
//!
//! Nothing is on the heap: what has a table in other systems is counted out.

pub(super) const MAKE_BLACK: &str = "    static boolean black;

    function void makeBlack() {
        let black = true;
        return;
    }
";

pub(super) const CLEAR_SCREEN: &str = "    function void clearScreen() {
        var Array word;
        let word = 16384;
        while (word < 24576) {
            let word[0] = 0;
            let word = word + 1;
        }
        return;
    }
";

pub(super) const SET_COLOR: &str = "    function void setColor(boolean b) {
        let black = b;
        return;
    }
";

pub(super) const IS_OUTSIDE: &str = "    function boolean isOutside(int x, int y) {
        return (~((x & 511) = x)) | (~((y & 255) = y));
    }
";

pub(super) const WORD_AT: &str = "    /** The word that has the pixel. */
    function Array wordAt(int x, int y) {
        let y = y + y;
        let y = y + y;
        let y = y + y;
        let y = y + y;
        let y = y + y + 16384;
        if (x > 255) { let x = x - 256; let y = y + 16; }
        if (x > 127) { let x = x - 128; let y = y + 8; }
        if (x > 63) { let x = x - 64; let y = y + 4; }
        if (x > 31) { let x = x - 32; let y = y + 2; }
        if (x > 15) { return y + 1; }
        return y;
    }
";

pub(super) const BIT: &str = "    /** 2^k */
    function int bit(int k) {
        var int bit;
        let bit = 1;
        while (k > 0) {
            let bit = bit + bit;
            let k = k - 1;
        }
        return bit;
    }
";

pub(super) const PAINT: &str = "    /** Gives those pixels of a word the colour. */
    function void paint(Array word, int bits) {
        if (black) { let word[0] = word[0] | bits; }
        else { let word[0] = word[0] & (~bits); }
        return;
    }
";

pub(super) const DRAW_PIXEL: &str = "    function void drawPixel(int x, int y) {
        if (Screen.isOutside(x, y)) { do Sys.error(7); }
        do Screen.paint(Screen.wordAt(x, y), Screen.bit(x & 15));
        return;
    }
";

pub(super) const SPAN: &str = "    /** Paints the pixels from left to right of a row. */
    function void span(int left, int right, int y) {
        var Array word, last;
        var int from, upto;
        let word = Screen.wordAt(left, y);
        let last = Screen.wordAt(right, y);
        let from = -Screen.bit(left & 15);
        let upto = Screen.bit(right & 15);
        let upto = upto + upto - 1;
        while (word < last) {
            do Screen.paint(word, from);
            let from = -1;
            let word = word + 1;
        }
        do Screen.paint(word, from & upto);
        return;
    }
";

/// Bresenham's line along its longer side, from the lesser end; on a tie it steps
/// sideways.
pub(super) const DRAW_LINE: &str = "    function void drawLine(int x1, int y1, int x2, int y2) {
        var int wide, high, end, step, error, other;
        if (Screen.isOutside(x1, y1) | Screen.isOutside(x2, y2)) { do Sys.error(8); }
        let wide = x2 - x1;
        if (wide < 0) { let wide = -wide; }
        let high = y2 - y1;
        if (high < 0) { let high = -high; }
        if (wide < high) {
            if (y2 < y1) {
                let other = x1; let x1 = x2; let x2 = other;
                let other = y1; let y1 = y2; let y2 = other;
            }
            let step = 1;
            if (x2 < x1) { let step = -1; }
            if (x2 = x1) { let step = 0; }
            let error = wide + wide - high;
            while (~(y1 > y2)) {
                do Screen.paint(Screen.wordAt(x1, y1), Screen.bit(x1 & 15));
                if (~(error < 0)) { let x1 = x1 + step; let error = error - high - high; }
                let error = error + wide + wide;
                let y1 = y1 + 1;
            }
            return;
        }
        if (x2 < x1) {
            let other = x1; let x1 = x2; let x2 = other;
            let other = y1; let y1 = y2; let y2 = other;
        }
        let step = 1;
        if (y2 < y1) { let step = -1; }
        if (y2 = y1) { let step = 0; }
        let error = high + high - wide;
        while (~(x1 > x2)) {
            do Screen.paint(Screen.wordAt(x1, y1), Screen.bit(x1 & 15));
            if (~(error < 0)) { let y1 = y1 + step; let error = error - wide - wide; }
            let error = error + high + high;
            let x1 = x1 + 1;
        }
        return;
    }
";

pub(super) const DRAW_RECTANGLE: &str =
    "    function void drawRectangle(int x1, int y1, int x2, int y2) {
        if (Screen.isOutside(x1, y1) | Screen.isOutside(x2, y2)) { do Sys.error(9); }
        if ((x2 < x1) | (y2 < y1)) { do Sys.error(9); }
        while (~(y1 > y2)) {
            do Screen.span(x1, x2, y1);
            let y1 = y1 + 1;
        }
        return;
    }
";

pub(super) const DRAW_CIRCLE: &str =
    "    /** A filled circle by the midpoint algorithm: an octant, from the top. */
    function void drawCircle(int x, int y, int r) {
        var int across, along, error;
        if (Screen.isOutside(x, y)) { do Sys.error(12); }
        if ((r < 0) | Screen.isOutside(x - r, y - r) | Screen.isOutside(x + r, y + r)) {
            do Sys.error(13);
        }
        let across = 0;
        let along = r;
        let error = 1 - r;
        while (~(across > along)) {
            do Screen.span(x - across, x + across, y - along);
            do Screen.span(x - across, x + across, y + along);
            do Screen.span(x - along, x + along, y - across);
            do Screen.span(x - along, x + along, y + across);
            if (error < 0) { let error = error + across + across + 3; }
            else {
                let error = error + across + across - along - along + 5;
                let along = along - 1;
            }
            let across = across + 1;
        }
        return;
    }
";
