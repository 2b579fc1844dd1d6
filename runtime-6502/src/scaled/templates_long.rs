//! Routines for reals of 24 bits, as instructions, where they are not those of 16
//! ([`super::templates`]) with more bytes.
//!
//! A number goes to a product in a, x and y (high), to what else there is in `acc`, a second
//! one in `arg`. Products, quotients and roots come back in `prod+3`, `prod+4` and a (high),
//! functions in `acc`.

use super::templates::functions;
pub(crate) use super::templates::{LESS_EQUAL_NEAR, LESS_NEAR};

/// As for 16 bits.
macro_rules! saturate {
    () => {
        "
    bvc fits{n} | eor #$80 | rol | lda #$7f | adc #0 | sta {r.2}
    eor #$80 | sta {r.1} | ora #1 | sta {r.0} | bne done{n}
    fits{n}:
    cmp #$80 | bne done{n} | lda {r.0} | ora {r.1} | bne done{n} | inc {r.0}
    done{n}:"
    };
}

pub(crate) const SATURATING_ADD: &str =
    concat!("clc [lda {0.k} | adc {1.k} | sta {r.k}]", saturate!());
pub(crate) const SATURATING_SUBTRACT: &str =
    concat!("sec [lda {0.k} | sbc {1.k} | sta {r.k}]", saturate!());

macro_rules! first {
    () => {
        "lda {0.0} | sta acc | lda {0.1} | sta acc+1 | lda {0.2} | sta acc+2"
    };
}

macro_rules! second {
    () => {
        "lda {1.0} | sta acc | lda {1.1} | sta acc+1 | lda {1.2} | sta acc+2"
    };
}

macro_rules! divisor {
    () => {
        "lda {1.0} | sta arg | lda {1.1} | sta arg+1 | lda {1.2} | sta arg+2"
    };
}

macro_rules! both {
    () => {
        concat!(divisor!(), "|", first!())
    };
}

/// A product's operands, and a square's.
macro_rules! factors {
    () => {
        concat!(divisor!(), "|", factor!())
    };
}

macro_rules! factor {
    () => {
        "lda {0.0} | ldx {0.1} | ldy {0.2}"
    };
}

macro_rules! result {
    () => {
        "| lda acc | sta {r.0} | lda acc+1 | sta {r.1} | lda acc+2 | sta {r.2}"
    };
}

/// Of a product, a quotient or a root.
macro_rules! made {
    () => {
        "| sta {r.2} | lda prod+4 | sta {r.1} | lda prod+3 | sta {r.0}"
    };
}

/// The upper 24 of 32 bits, rounded by the next.
macro_rules! upper {
    () => {
        concat!(
            "| ldx prod+2 | bpl rounded{n} | inc prod+3 | bne rounded{n} | inc prod+4
            bne rounded{n} | clc | adc #1
            rounded{n}:",
            made!()
        )
    };
}

/// Bits to the left, rounded by what is left below.
macro_rules! up {
    ($($bit:literal)*) => {
        concat!($("| asl prod+2 | rol prod+3 | rol prod+4 | rol ", $bit,)*)
    };
}

/// Products of which the result is so many bits shorter, of two operands or of one with
/// itself.
macro_rules! products {
    ($($name:ident $square:ident: $($more:expr),+;)+) => {
        $(
            pub(crate) const $name: &str = concat!(factors!(), "| jsr product24", $($more),+);
            const $square: &str = concat!(factor!(), "| jsr square24", $($more),+);
        )+
        /// What products of a number with itself are instead.
        pub(crate) static SQUARES: &[(&str, &str)] = &[$(($name, $square)),+];
    };
}

products! {
    MULTIPLY_24 SQUARE_24: upper!();
    MULTIPLY_23 SQUARE_23: up!(""), upper!();
    MULTIPLY_22 SQUARE_22: up!("" ""), upper!();
    MULTIPLY_21 SQUARE_21: up!("" "" ""), upper!();
    MULTIPLY_20 SQUARE_20: up!("" "" "" ""), upper!();
    MULTIPLY_ANY SQUARE_ANY: "| ldy {#24-n} | jsr up24", made!();
    MULTIPLY_RIGHT SQUARE_RIGHT: "| ldy {#n-24} | jsr lower32", made!();
}

pub(crate) const MULTIPLY_16: &str = concat!(factors!(), "| jsr whole24 | jsr round40", made!());
pub(crate) const MULTIPLY_MIDDLE: &str = concat!(
    factors!(),
    "| jsr whole24 | ldy {#n-16} | jsr round40_right",
    made!()
);

pub(crate) const MULTIPLY_DOWN: &str =
    concat!(both!(), "| ldy {#n} | jsr exact24_right", result!());
pub(crate) const MULTIPLY_UP: &str = concat!(both!(), "| ldy {#0-n} | jsr exact24_left", result!());

pub(crate) const DIVIDE: &str = concat!(both!(), "| ldy {#n} | jsr divide24", made!());
pub(crate) const ONE_OVER: &str = concat!(divisor!(), "| ldy {%} | jsr one_over24", made!());
pub(crate) const ROOT: &str = concat!("ldy {#24-n/2} |", first!(), "| jsr root24", made!());
pub(crate) const ODD_ROOT: &str = concat!("ldy {#25-n/2} |", first!(), "| jsr root24_odd", made!());

pub(crate) const MODULO: &str = concat!(both!(), "| jsr modulo24", result!());
pub(crate) const MODULO_PART: &str = "modulo24";
pub(crate) const MODULO_CYCLES: u32 = 690;
/// The whole part of what is below 1.
pub(crate) const FRACTION_FLOOR: &str =
    "~ldx #0 | lda {0.2} | bpl even{n} | dex | even{n}: [stx {r.k}]";
pub(crate) const SIGN: &str = "~
    ldx #0 | lda {0.2} | bmi negative{n} | ora {0.1} | ora {0.0} | beq zero{n}
    inx | lda #0 | beq zero{n}
    negative{n}:
    ldx #$ff | lda #$ff
    zero{n}:
    stx {r.0} [+ sta {r.k}]";

functions!(
    first,
    second,
    both,
    result,
    "widen24",
    "widen24_right",
    "widen24_both",
    "narrow24_right",
    "narrow24_left",
    "#0",
    "#0",
    "#7"
);
