//! `Output`: 23 rows of 64 characters, each 8 pixels wide and 11 high, in words
//! that two characters share.
//!
//! The font is drawn for this: 5 columns and 9 rows a character, in three words of
//! three rows, the leftmost pixel of the uppermost row in the lowest bit.

pub(super) const MAKE_CURSOR: &str = "    static Array line; // the first word of the cursor's row
    static Array at; // the cursor's own
    static int column;
    static boolean right; // whether the cursor is in the right half of its word

    function void makeCursor() {
        let line = 16384;
        let at = 16384;
        let column = 0;
        let right = false;
        return;
    }
";

pub(super) const MAKE_FONT: &str = "    static Array font;
    static int filled;

    function void makeFont() {
        let font = Array.new(285);
        let filled = 0;
        do Output.glyph(0, 0, 0); // space
        do Output.glyph(4228, 132, 4); // !
        do Output.glyph(10570, 0, 0); // quote
        do Output.glyph(32074, 11242, 10); // #
        do Output.glyph(6084, 16014, 4); // $
        do Output.glyph(8819, 25668, 25); // %
        do Output.glyph(5414, 9890, 22); // &
        do Output.glyph(132, 0, 0); // '
        do Output.glyph(2184, 4162, 8); // (
        do Output.glyph(8322, 4360, 2); // )
        do Output.glyph(21632, 4782, 0); // *
        do Output.glyph(4224, 4255, 0); // +
        do Output.glyph(0, 12288, 140); // ,
        do Output.glyph(0, 31, 0); // -
        do Output.glyph(0, 12288, 12); // .
        do Output.glyph(8720, 1092, 1); // /
        do Output.glyph(26158, 18037, 14); // 0
        do Output.glyph(4292, 4228, 14); // 1
        do Output.glyph(16942, 2184, 31); // 2
        do Output.glyph(16942, 17932, 14); // 3
        do Output.glyph(10632, 9193, 8); // 4
        do Output.glyph(15423, 17936, 14); // 5
        do Output.glyph(1100, 17967, 14); // 6
        do Output.glyph(8735, 4232, 4); // 7
        do Output.glyph(17966, 17966, 14); // 8
        do Output.glyph(17966, 8734, 6); // 9
        do Output.glyph(12672, 12672, 0); // :
        do Output.glyph(12672, 12672, 68); // ;
        do Output.glyph(2184, 4161, 8); // <
        do Output.glyph(31744, 992, 0); // =
        do Output.glyph(8322, 4368, 2); // >
        do Output.glyph(16942, 136, 4); // ?
        do Output.glyph(30254, 1973, 14); // @
        do Output.glyph(17966, 17983, 17); // A
        do Output.glyph(17967, 17967, 15); // B
        do Output.glyph(1582, 17441, 14); // C
        do Output.glyph(17967, 17969, 15); // D
        do Output.glyph(1087, 1071, 31); // E
        do Output.glyph(1087, 1071, 1); // F
        do Output.glyph(1582, 17981, 14); // G
        do Output.glyph(17969, 17983, 17); // H
        do Output.glyph(4238, 4228, 14); // I
        do Output.glyph(8476, 9480, 6); // J
        do Output.glyph(5425, 9379, 17); // K
        do Output.glyph(1057, 1057, 31); // L
        do Output.glyph(22385, 17973, 17); // M
        do Output.glyph(20081, 26421, 17); // N
        do Output.glyph(17966, 17969, 14); // O
        do Output.glyph(17967, 1071, 1); // P
        do Output.glyph(17966, 9905, 22); // Q
        do Output.glyph(17967, 9391, 17); // R
        do Output.glyph(1086, 16910, 15); // S
        do Output.glyph(4255, 4228, 4); // T
        do Output.glyph(17969, 17969, 14); // U
        do Output.glyph(17969, 10577, 4); // V
        do Output.glyph(17969, 28341, 17); // W
        do Output.glyph(10801, 17732, 17); // X
        do Output.glyph(10801, 4228, 4); // Y
        do Output.glyph(8735, 1092, 31); // Z
        do Output.glyph(2126, 2114, 14); // [
        do Output.glyph(2081, 16644, 16); // backslash
        do Output.glyph(8462, 8456, 14); // ]
        do Output.glyph(17732, 0, 0); // ^
        do Output.glyph(0, 0, 992); // _
        do Output.glyph(8322, 0, 0); // `
        do Output.glyph(14336, 18384, 30); // a
        do Output.glyph(15393, 17969, 15); // b
        do Output.glyph(14336, 17441, 14); // c
        do Output.glyph(31248, 17969, 30); // d
        do Output.glyph(14336, 2033, 14); // e
        do Output.glyph(2636, 2119, 2); // f
        do Output.glyph(30720, 17969, 14878); // g
        do Output.glyph(15393, 17969, 17); // h
        do Output.glyph(6148, 4228, 14); // i
        do Output.glyph(12296, 8456, 6440); // j
        do Output.glyph(9249, 5221, 9); // k
        do Output.glyph(4230, 4228, 14); // l
        do Output.glyph(11264, 22197, 21); // m
        do Output.glyph(15360, 17969, 17); // n
        do Output.glyph(14336, 17969, 14); // o
        do Output.glyph(15360, 17969, 1071); // p
        do Output.glyph(30720, 17969, 16926); // q
        do Output.glyph(13312, 1075, 1); // r
        do Output.glyph(30720, 16833, 15); // s
        do Output.glyph(7234, 18498, 12); // t
        do Output.glyph(17408, 17969, 30); // u
        do Output.glyph(17408, 10577, 4); // v
        do Output.glyph(17408, 22193, 10); // w
        do Output.glyph(17408, 10378, 17); // x
        do Output.glyph(17408, 17969, 14878); // y
        do Output.glyph(31744, 2184, 31); // z
        do Output.glyph(4232, 4226, 8); // {
        do Output.glyph(4228, 4228, 4); // |
        do Output.glyph(4226, 4232, 2); // }
        do Output.glyph(18432, 309, 0); // ~
        return;
    }

    function void glyph(int a, int b, int c) {
        let font[filled] = a;
        let font[filled + 1] = b;
        let font[filled + 2] = c;
        let filled = filled + 3;
        return;
    }
";

pub(super) const DRAW: &str =
    "    /** Shows a character at the cursor; a block for what is none. */
    function void draw(char c) {
        var Array word;
        var int k, place, bits;
        let word = at;
        let k = 0;
        let place = c - 32;
        while (k < 3) {
            let bits = 32767;
            if (~((place < 0) | (place > 94))) { let bits = font[place + place + place + k]; }
            do Output.drawRows(word, bits);
            let word = word + 96;
            let k = k + 1;
        }
        do Output.drawRow(word, 0);
        do Output.drawRow(word + 32, 0);
        return;
    }

    function void drawRows(Array word, int bits) {
        var int rows, columns, bit, pixel, pixels;
        let bit = 1;
        let rows = 3;
        while (rows > 0) {
            let pixel = 2;
            if (right) { let pixel = 512; }
            let pixels = 0;
            let columns = 5;
            while (columns > 0) {
                if (~((bits & bit) = 0)) { let pixels = pixels + pixel; }
                let bit = bit + bit;
                let pixel = pixel + pixel;
                let columns = columns - 1;
            }
            do Output.drawRow(word, pixels);
            let word = word + 32;
            let rows = rows - 1;
        }
        return;
    }

    function void drawRow(Array word, int pixels) {
        if (right) { let word[0] = (word[0] & 255) | pixels; }
        else { let word[0] = (word[0] & (-256)) | pixels; }
        return;
    }
";

pub(super) const MOVE_CURSOR: &str = "    /** Moves the cursor, and clears what stands there. */
    function void moveCursor(int i, int j) {
        if ((i < 0) | (i > 22)) { do Sys.error(20); }
        if ((j < 0) | (j > 63)) { do Sys.error(20); }
        let line = 16384;
        while (i > 0) {
            let line = line + 352;
            let i = i - 1;
        }
        let at = line;
        let column = j;
        while (j > 1) {
            let at = at + 1;
            let j = j - 2;
        }
        let right = (j = 1);
        do Output.draw(32);
        return;
    }
";

pub(super) const PRINT_CHAR: &str = "    function void printChar(char c) {
        if (c = 128) { do Output.println(); return; }
        if (c = 129) { do Output.backSpace(); return; }
        do Output.draw(c);
        let column = column + 1;
        if (column = 64) { do Output.println(); return; }
        if (right) { let at = at + 1; }
        let right = ~right;
        return;
    }
";

pub(super) const PRINT_STRING: &str = "    function void printString(String s) {
        var int k, length;
        let k = 0;
        let length = s.length();
        while (k < length) {
            do Output.printChar(s.charAt(k));
            let k = k + 1;
        }
        return;
    }
";

pub(super) const PRINT_INT: &str = "    static boolean begun; // whether a digit was printed

    /** Digits are taken from a number below 0, where -32768 has room. */
    function void printInt(int i) {
        if (i < 0) { do Output.printChar(45); }
        else { let i = -i; }
        let begun = false;
        let i = Output.printDigit(i, 10000);
        let i = Output.printDigit(i, 1000);
        let i = Output.printDigit(i, 100);
        let i = Output.printDigit(i, 10);
        do Output.printChar(48 - i);
        return;
    }

    /** Prints how often the unit is in -i, but no leading 0; answers the rest. */
    function int printDigit(int i, int unit) {
        var int digit;
        let digit = 48;
        while (~((i + unit) > 0)) {
            let i = i + unit;
            let digit = digit + 1;
        }
        if (digit > 48) { let begun = true; }
        if (begun) { do Output.printChar(digit); }
        return i;
    }
";

pub(super) const PRINTLN: &str = "    /** From the last row to the first. */
    function void println() {
        let line = line + 352;
        if (line = 24480) { let line = 16384; }
        let at = line;
        let column = 0;
        let right = false;
        return;
    }
";

pub(super) const BACK_SPACE: &str =
    "    /** Clears the character before the cursor, within the row. */
    function void backSpace() {
        if (column = 0) { return; }
        let column = column - 1;
        let right = ~right;
        if (right) { let at = at - 1; }
        do Output.draw(32);
        return;
    }
";
