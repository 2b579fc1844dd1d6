//! Operations on logarithms that are written in place, in the notation of
//! [`crate::templates`]. `[s ]` holds what gives the result its sign, and is left out where
//! that is known; a sign that is known of an argument is a constant.

/// The sign of products and quotients.
macro_rules! unlike {
    () => {
        "[s lda {0.2} | eor {1.2} | sta {r.2}]"
    };
}

/// A result that is above 0, or below.
macro_rules! plus {
    () => {
        "[s lda #0 | sta {r.2}]"
    };
}
macro_rules! minus {
    () => {
        "[s lda #1 | sta {r.2}]"
    };
}
/// A logarithm below the least becomes that: the overflow flag tells.
macro_rules! low {
    () => {
        "| bvc fits{n} | lda #$80 | sta {r.1} | lda #0 | sta {r.0} | fits{n}: |"
    };
}

/// One above the greatest becomes that.
macro_rules! high {
    () => {
        "| bvc even{n} | lda #$7f | sta {r.1} | lda #$ff | sta {r.0} | even{n}: |"
    };
}

/// Both: where it overflows, its sign is the other one.
macro_rules! ends {
    () => {
        "| bvc fits{n} | bpl low{n} | lda #$7f | sta {r.1} | lda #$ff | bne least{n}
        low{n}: | lda #$80 | sta {r.1} | lda #0
        least{n}: | sta {r.0} | fits{n}: |"
    };
}

macro_rules! multiply {
    () => {
        "clc | lda {0.0} | adc {1.0} | sta {r.0} | lda {0.1} | adc {1.1} | sta {r.1} |"
    };
}

pub const MULTIPLY: &str = concat!(multiply!(), unlike!());
pub const LOW_MULTIPLY: &str = concat!(multiply!(), low!(), unlike!());
pub const ANY_MULTIPLY: &str = concat!(multiply!(), ends!(), unlike!());

macro_rules! square {
    () => {
        "lda {0.0} | asl | sta {r.0} | lda {0.1} | rol | sta {r.1} |"
    };
}

/// The same with the overflow flag.
macro_rules! told_square {
    () => {
        "lda {0.0} | asl | sta {r.0} | lda {0.1} | adc {0.1} | sta {r.1} |"
    };
}

const SQUARE: &str = concat!(square!(), plus!());
const LOW_SQUARE: &str = concat!(told_square!(), low!(), plus!());
const ANY_SQUARE: &str = concat!(told_square!(), ends!(), plus!());

macro_rules! divide {
    () => {
        "sec | lda {0.0} | sbc {1.0} | sta {r.0} | lda {0.1} | sbc {1.1} | sta {r.1} |"
    };
}

pub const DIVIDE: &str = concat!(divide!(), unlike!());
pub const LOW_DIVIDE: &str = concat!(divide!(), low!(), unlike!());
pub const HIGH_DIVIDE: &str = concat!(divide!(), high!(), unlike!());
pub const ANY_DIVIDE: &str = concat!(divide!(), ends!(), unlike!());

/// By how much the first logarithm is greater or less, and what the greater one grows by:
/// `look` is what [`super::look`] writes out, and adds. In the labels stands a letter more.
macro_rules! apart {
    ($l:literal, $borrow:literal, $first:literal, $second:expr, $look:literal) => {
        concat!(
            $borrow,
            " | lda {0.0} | sbc {1.0} | tay | lda {0.1} | sbc {1.1} | bvs far",
            $l,
            "{n} | bmi less",
            $l,
            "{n}
            more",
            $l,
            "{n}: |",
            $first,
            "| look ",
            $look,
            " 0 | jmp grown",
            $l,
            "{n}
            far",
            $l,
            "{n}: | bmi more",
            $l,
            "{n}
            less",
            $l,
            "{n}: | look ",
            $look,
            "_less 1 |",
            $second,
            "| grown",
            $l,
            "{n}: |"
        )
    };
}

/// Of two values of one sign.
macro_rules! sum {
    ($borrow:literal) => {
        apart!("s", $borrow, "", "", "log_sum")
    };
}

/// Of two of different signs: the result has that of the greater, of which `$second` is the
/// second operand's.
macro_rules! difference {
    ($second:literal) => {
        concat!(
            apart!(
                "d",
                "clc",
                "[s ldx {0.2} | stx {r.2}]",
                concat!("[s lda {1.2} |", $second, "| sta {r.2}]"),
                "log_difference"
            ),
            "| bvc fits{n} | none{n}: | lda #$80 | sta {r.1} | lda #0 | sta {r.0} | fits{n}: |"
        )
    };
}

pub const SUM: &str = concat!(sum!("sec"), plus!());
pub const ANY_SUM: &str = concat!(sum!("sec"), high!(), plus!());
pub const MINUS_SUM: &str = concat!(sum!("sec"), minus!());
pub const SUM_LESS: &str = difference!("");
pub const DIFFERENCE: &str = difference!("eor #1");

/// A sum or a difference, by the signs: equal ones leave the carry set. Past the sum a branch
/// just reaches where nothing is in the zero page.
macro_rules! either {
    ($unlike:literal, $borrow:literal, $second:literal, $high:expr) => {
        concat!(
            "lda {0.2} | cmp {1.2} | ",
            $unlike,
            " differ{n} | [s sta {r.2}] |",
            sum!($borrow),
            $high,
            "jmp fits{n}
            differ{n}: |",
            difference!($second)
        )
    };
}

pub const ADD: &str = either!("bne", "", "", "");
pub const SUBTRACT: &str = either!("beq", "sec", "eor #1", "");
pub const ANY_ADD: &str = either!("bne", "", "", high!());
pub const ANY_SUBTRACT: &str = either!("beq", "sec", "eor #1", high!());

macro_rules! twice {
    () => {
        "lda {0.0} | sta {r.0} | clc | lda {0.1} | adc #log_octave | sta {r.1} |"
    };
}
macro_rules! same_sign {
    () => {
        "[s lda {0.2} | sta {r.2}]"
    };
}

const TWICE: &str = concat!(twice!(), same_sign!());
const ANY_TWICE: &str = concat!(twice!(), high!(), same_sign!());

/// What is written instead where both operands are one value, if anything else is.
pub fn same(text: &str) -> Option<&'static str> {
    let made = [
        (MULTIPLY, SQUARE),
        (LOW_MULTIPLY, LOW_SQUARE),
        (ANY_MULTIPLY, ANY_SQUARE),
        (SUM, TWICE),
        (MINUS_SUM, TWICE),
        (ADD, TWICE),
        (ANY_SUM, ANY_TWICE),
        (ANY_ADD, ANY_TWICE),
    ];
    let found = made.iter().find(|(of, _)| *of == text);
    found.map(|(_, instead)| *instead)
}

macro_rules! root {
    () => {
        "lda {0.1} | cmp #$80 | ror | sta {r.1} | lda {0.0} | ror | sta {r.0} |"
    };
}

pub const ROOT: &str = concat!(root!(), plus!());
/// That of a negative is 0.
pub const ANY_ROOT: &str = concat!(
    "lda {0.2} | bne none{n} |",
    root!(),
    "jmp fits{n}
    none{n}: | lda #$80 | sta {r.1} | lda #0 | sta {r.0}
    fits{n}: |",
    plus!()
);

pub const NEGATE: &str =
    "lda {0.0} | sta {r.0} | lda {0.1} | sta {r.1} | [s lda {0.2} | eor #1 | sta {r.2}]";
pub const ABS: &str = concat!("lda {0.0} | sta {r.0} | lda {0.1} | sta {r.1} |", plus!());

/// Leaves in N whether the first logarithm is less.
macro_rules! lower {
    () => {
        "lda {0.0} | cmp {1.0} | lda {0.1} | sbc {1.1} | bvc lower{n} | eor #$80 | lower{n}: |"
    };
}
/// The same of the second.
macro_rules! upper {
    () => {
        "lda {1.0} | cmp {0.0} | lda {1.1} | sbc {0.1} | bvc upper{n} | eor #$80 | upper{n}: |"
    };
}

/// Leaves in the carry whether the first is less: the greater sign byte, else by logarithms.
macro_rules! less {
    () => {
        concat!(
            "lda {0.2} | cmp {1.2} | bne told{n} | lsr | bcs minus{n} |",
            lower!(),
            "asl | jmp told{n}
            minus{n}: |",
            upper!(),
            "asl
            told{n}: |"
        )
    };
}

/// Copies argument 0 or 1: that where a branch to `second` is taken.
macro_rules! pick {
    ($branch:literal) => {
        concat!(
            $branch,
            " second{n} | lda {0.0} | sta {r.0} | [s lda {0.2} | sta {r.2}] | lda {0.1} | jmp picked{n}
            second{n}: | lda {1.0} | sta {r.0} | [s lda {1.2} | sta {r.2}] | lda {1.1}
            picked{n}: | sta {r.1}"
        )
    };
}

pub const PLUS_MIN: &str = concat!(lower!(), pick!("bpl"));
pub const PLUS_MAX: &str = concat!(lower!(), pick!("bmi"));
pub const MIN: &str = concat!(less!(), pick!("bcc"));
pub const MAX: &str = concat!(less!(), pick!("bcs"));

/// A negative becomes 0.
pub const MAX_ZERO: &str = concat!(
    "lda {0.2} | bne none{n} | lda {0.0} | sta {r.0} | lda {0.1} | jmp fits{n}
    none{n}: | lda #0 | sta {r.0} | lda #$80
    fits{n}: | sta {r.1} |",
    plus!()
);
pub const ZERO_MAX: &str = concat!(
    "lda {1.2} | bne none{n} | lda {1.0} | sta {r.0} | lda {1.1} | jmp fits{n}
    none{n}: | lda #0 | sta {r.0} | lda #$80
    fits{n}: | sta {r.1} |",
    plus!()
);

pub const SIGN: &str = "ldx #0 | lda {0.2} | beq above{n} | dex
    above{n}: | txa | ora #1 | sta {r.0} | stx {r.1} | stx {r.2} | stx {r.3}";

/// Of an int of a byte.
pub const OF_BYTE: &str = concat!(
    "ldy {0.0} | lda log_logs_low,y | sta {r.0} | lda log_logs_high,y | sta {r.1} |",
    plus!()
);

pub const LESS: &str = less!();
pub const PLUS_LESS: &str = concat!(lower!(), "asl");

/// Where one sign is known the other may tell at once.
macro_rules! told_by {
    ($sign:literal, $told:literal, $else:expr) => {
        concat!(
            "lda ",
            $sign,
            " | bne yes{n} |",
            $else,
            "asl | jmp told{n}
            yes{n}: |",
            $told,
            "
            told{n}:"
        )
    };
}

/// Of a second that is above 0, and a first.
pub const LESS_PLUS: &str = told_by!("{0.2}", "sec", lower!());
pub const PLUS_LESS_ANY: &str = told_by!("{1.2}", "clc", lower!());

pub const NEGATIVE: &str = "lda {0.2} | lsr";
pub const NOT_NEGATIVE: &str = "lda {1.2} | eor #1 | lsr";

pub const POSITIVE: &str =
    "lda {1.2} | lsr | bcs not{n} | lda {1.1} | eor #$80 | ora {1.0} | cmp #1
    bcs told{n} | not{n}: | clc | told{n}:";
pub const NOT_POSITIVE: &str = "lda {0.2} | lsr | bcs told{n} | lda {0.1} | eor #$80 | ora {0.0}
    sec | beq told{n} | clc | told{n}:";
pub const IS_ZERO: &str = "lda {0.1} | eor #$80 | ora {0.0} | sec | beq told{n} | clc | told{n}:";

pub const PLUS_LESS_EQUAL: &str = concat!(upper!(), "eor #$80 | asl");
pub const LESS_EQUAL: &str = concat!(
    "lda {0.2} | cmp {1.2} | bne told{n} | lsr | bcs minus{n} |",
    upper!(),
    "eor #$80 | asl | jmp told{n}
    minus{n}: |",
    lower!(),
    "eor #$80 | asl
    told{n}:"
);

/// A comparison of equals leaves the carry set.
pub const EQUAL: &str =
    "lda {0.0} | cmp {1.0} | bne unlike{n} | lda {0.1} | cmp {1.1} | bne unlike{n}
    lda {0.2} | cmp {1.2} | beq alike{n}
    unlike{n}: | clc
    alike{n}:";
