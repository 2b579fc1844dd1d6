//! `String`: the capacity, the length, then a word a character.

pub(super) const HEAD: &str = "    field int capacity, length;
";

/// A function, not a constructor: its object is as long as asked for.
pub(super) const NEW: &str = "    function String new(int maxLength) {
        var Array string;
        if (maxLength < 0) { do Sys.error(14); }
        let string = Memory.alloc(maxLength + 2);
        let string[0] = maxLength;
        let string[1] = 0;
        return string;
    }
";

pub(super) const DISPOSE: &str = "    method void dispose() {
        do Memory.deAlloc(this);
        return;
    }
";

pub(super) const LENGTH: &str = "    method int length() {
        return length;
    }
";

pub(super) const CHAR_AT: &str = "    method char charAt(int j) {
        var Array word;
        if (j < 0) { do Sys.error(15); }
        if (~(j < length)) { do Sys.error(15); }
        let word = this;
        return word[j + 2];
    }
";

pub(super) const SET_CHAR_AT: &str = "    method void setCharAt(int j, char c) {
        var Array word;
        if (j < 0) { do Sys.error(16); }
        if (~(j < length)) { do Sys.error(16); }
        let word = this;
        let word[j + 2] = c;
        return;
    }
";

pub(super) const APPEND_CHAR: &str = "    method String appendChar(char c) {
        var Array word;
        if (length = capacity) { do Sys.error(17); }
        let word = this;
        let word[length + 2] = c;
        let length = length + 1;
        return this;
    }
";

pub(super) const ERASE_LAST_CHAR: &str = "    method void eraseLastChar() {
        if (length = 0) { do Sys.error(18); }
        let length = length - 1;
        return;
    }
";

pub(super) const INT_VALUE: &str =
    "    /** The number that it begins with, after an optional minus; 0 without one. */
    method int intValue() {
        var Array word;
        var int k, value, digit;
        var boolean minus, more;
        let word = this;
        let k = 2;
        let value = 0;
        let minus = false;
        if (length > 0) { let minus = (word[2] = 45); }
        if (minus) { let k = 3; }
        let more = true;
        while (more & (k < (length + 2))) {
            let digit = word[k] - 48;
            let k = k + 1;
            if ((digit < 0) | (digit > 9)) { let more = false; }
            else {
                let value = value + value;
                let value = value + value + value + value + value + digit;
            }
        }
        if (minus) { return -value; }
        return value;
    }
";

/// Below 0, where -32768 has room.
pub(super) const SET_INT: &str =
    "    /** Becomes the decimal number: digits are taken from a number below 0. */
    method void setInt(int value) {
        var int rest, size;
        let rest = value;
        let size = 2;
        if (~(rest < 0)) { let rest = -rest; let size = 1; }
        if (rest < (-9)) { let size = size + 1; }
        if (rest < (-99)) { let size = size + 1; }
        if (rest < (-999)) { let size = size + 1; }
        if (rest < (-9999)) { let size = size + 1; }
        if (capacity < size) { do Sys.error(19); }
        let length = 0;
        if (value < 0) { do appendChar(45); }
        let rest = takeDigit(rest, 10000, value);
        let rest = takeDigit(rest, 1000, value);
        let rest = takeDigit(rest, 100, value);
        let rest = takeDigit(rest, 10, value);
        do appendChar(48 - rest);
        return;
    }

    /** Appends how often the unit is in the rest, but no leading 0; answers what is left. */
    method int takeDigit(int rest, int unit, int value) {
        var int digit;
        let digit = 48;
        while (~((rest + unit) > 0)) {
            let rest = rest + unit;
            let digit = digit + 1;
        }
        if (digit > 48) { do appendChar(digit); return rest; }
        if (value < 0) {
            if (length > 1) { do appendChar(digit); }
        }
        else {
            if (length > 0) { do appendChar(digit); }
        }
        return rest;
    }
";

pub(super) const NEW_LINE: &str = "    function char newLine() {
        return 128;
    }
";

pub(super) const BACK_SPACE: &str = "    function char backSpace() {
        return 129;
    }
";

pub(super) const DOUBLE_QUOTE: &str = "    function char doubleQuote() {
        return 34;
    }
";
