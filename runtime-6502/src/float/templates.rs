//! Operations on floats that are written in place, in the notation of [`crate::templates`]. The
//! sign is in byte 3, the exponent in byte 4.

/// All of the mantissa but its upper byte, copied.
macro_rules! low {
    ($k:literal) => {
        concat!(
            "| lda {",
            $k,
            ".0} | sta {r.0} | lda {",
            $k,
            ".1} | sta {r.1} | lda {",
            $k,
            ".2} | sta {r.2} |"
        )
    };
}

macro_rules! whole {
    ($k:literal) => {
        concat!(
            low!($k),
            " lda {",
            $k,
            ".3} | sta {r.3} | lda {",
            $k,
            ".4} | sta {r.4} |"
        )
    };
}

pub const NEGATE: &str = concat!(
    "lda {0.4} | sta {r.4} | beq none{n} | lda #$80 | none{n}: | eor {0.3} | sta {r.3}",
    low!("0")
);
pub const ABS: &str = concat!(
    "lda {0.4} | sta {r.4} | lda {0.3} | and #$7f | sta {r.3}",
    low!("0")
);

/// By a power of two below 1: small results become 0.
pub const LESSEN: &str = concat!(
    "lda {0.4} | clc | adc {1.4} | bcs far{n} | cmp #130 | bcc none{n} | sbc #129 | bcs move{n}
    far{n}: | adc #126
    move{n}: | sta {r.4} | lda {0.3} | sta {r.3}",
    low!("0"),
    "jmp done{n}
    none{n}: | lda #0 | sta {r.0} | sta {r.1} | sta {r.2} | sta {r.3} | sta {r.4}
    done{n}:"
);

/// By one above 1.
pub const GROW: &str = concat!(
    "lda {0.4} | beq none{n} | clc | adc {1.4} | sec | sbc #129
    none{n}: | sta {r.4} | lda {0.3} | sta {r.3}",
    low!("0")
);

/// Leaves in the carry whether the first magnitude is less than the second.
macro_rules! less {
    ($a:literal, $b:literal, $to:literal) => {
        concat!(
            "lda {",
            $b,
            ".4} | cmp {",
            $a,
            ".4} | bne ",
            $to,
            "{n} | clc
            | lda {",
            $b,
            ".0} | sbc {",
            $a,
            ".0} | lda {",
            $b,
            ".1} | sbc {",
            $a,
            ".1}
            | lda {",
            $b,
            ".2} | sbc {",
            $a,
            ".2} | lda {",
            $b,
            ".3} | sbc {",
            $a,
            ".3} |"
        )
    };
}

/// The same of numbers of any sign.
macro_rules! any_less {
    ($a:literal, $b:literal) => {
        concat!(
            "lda {",
            $a,
            ".3} | eor {",
            $b,
            ".3} | bmi unlike{n} | lda {",
            $a,
            ".3} | bmi minus{n} |",
            less!($a, $b, "told"),
            "jmp told{n} | minus{n}: |",
            less!($b, $a, "told"),
            "jmp told{n} | unlike{n}: | lda {",
            $a,
            ".3} | asl | told{n}: |"
        )
    };
}

macro_rules! plus_less {
    ($a:literal, $b:literal) => {
        concat!(less!($a, $b, "told"), "told{n}: |")
    };
}

/// The carry the other way round.
macro_rules! not {
    () => {
        "| lda #0 | rol | eor #1 | lsr |"
    };
}

pub const LESS: &str = any_less!("0", "1");
pub const PLUS_LESS: &str = plus_less!("0", "1");
pub const LESS_EQUAL: &str = concat!(any_less!("1", "0"), not!());
pub const PLUS_LESS_EQUAL: &str = concat!(plus_less!("1", "0"), not!());

/// The first, or the second where the carry is set.
macro_rules! pick {
    () => {
        concat!(
            "| bcs second{n} |",
            whole!("0"),
            "jmp picked{n} | second{n}: |",
            whole!("1"),
            "picked{n}:"
        )
    };
}

pub const MIN: &str = concat!(any_less!("1", "0"), pick!());
pub const PLUS_MIN: &str = concat!(plus_less!("1", "0"), pick!());
pub const MAX: &str = concat!(any_less!("0", "1"), pick!());
pub const PLUS_MAX: &str = concat!(plus_less!("0", "1"), pick!());

/// At least 0.
macro_rules! max_zero {
    ($k:literal) => {
        concat!(
            "lda {",
            $k,
            ".3} | bpl plus{n} | lda #0 | sta {r.0} | sta {r.1} | sta {r.2}
            | sta {r.3} | sta {r.4} | beq done{n} | plus{n}: | sta {r.3} | lda {",
            $k,
            ".4} | sta {r.4}",
            low!($k),
            "done{n}:"
        )
    };
}

pub const MAX_ZERO: &str = max_zero!("0");
pub const ZERO_MAX: &str = max_zero!("1");

pub const NEGATIVE: &str = "lda {0.3} | asl";
pub const NOT_NEGATIVE: &str = "lda {1.3} | eor #$80 | asl";
/// A comparison of the exponent with 1 tells whether it is none.
pub const POSITIVE: &str = "lda {1.4} | cmp #1 | lda {1.3} | bpl told{n} | clc | told{n}:";
pub const NOT_POSITIVE: &str = "lda #0 | cmp {0.4} | lda {0.3} | bpl told{n} | sec | told{n}:";
pub const IS_ZERO: &str = "lda #0 | cmp {0.4}";

/// A comparison of equals leaves the carry set.
pub const EQUAL: &str =
    "lda {0.4} | cmp {1.4} | bne unlike{n} | lda {0.3} | cmp {1.3} | bne unlike{n}
    | lda {0.2} | cmp {1.2} | bne unlike{n} | lda {0.1} | cmp {1.1} | bne unlike{n}
    | lda {0.0} | cmp {1.0} | beq alike{n}
    unlike{n}: | clc
    alike{n}:";

/// -1, 0 or 1.
pub const SIGN: &str =
    "ldx #0 | lda {0.4} | beq zero{n} | lda {0.3} | bmi negative{n} | lda #1 | bne zero{n}
    negative{n}: | dex | txa
    zero{n}: | sta {r.0} | stx {r.1} | stx {r.2} | stx {r.3}";
