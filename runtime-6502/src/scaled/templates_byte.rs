//! Routines for reals of 8 bits, as instructions, where they are not those of 16
//! ([`super::templates`]) with fewer bytes.
//!
//! A number goes to a subroutine in a, to what else there is in a and x with its sign, a second
//! one in y or `arg`; roots and quotients have operands of 16 bits. Results come back in a,
//! products in `prod` and a (high).

use super::templates::functions;

/// What does not fit has another sign; what is left at the format's end has a negative.
macro_rules! saturate {
    () => {
        "bvs over{n} | cmp #$80 | bne done{n} | beq least{n}
        over{n}:
        bpl least{n} | lda #$7f | bne done{n}
        least{n}:
        lda #$81
        done{n}:
        sta {r.0}"
    };
}

pub(crate) const SATURATING_ADD: &str = concat!("clc | lda {0.0} | adc {1.0} |", saturate!());
pub(crate) const SATURATING_SUBTRACT: &str = concat!("sec | lda {0.0} | sbc {1.0} |", saturate!());

/// Numbers whose difference fits.
pub(crate) const LESS_NEAR: &str = "sec | lda {0.0} | sbc {1.0} | asl";
pub(crate) const LESS_EQUAL_NEAR: &str = "sec | lda {1.0} | sbc {0.0} | eor #$80 | asl";

macro_rules! first {
    () => {
        "ldx #0 | lda {0.0} | bpl first{n} | dex | first{n}:"
    };
}

macro_rules! second {
    () => {
        "ldx #0 | lda {1.0} | bpl second{n} | dex | second{n}:"
    };
}

macro_rules! both {
    () => {
        concat!(second!(), "| sta arg | stx arg+1 |", first!())
    };
}

macro_rules! result {
    () => {
        "| sta {r.0}"
    };
}

/// Bits of a product to the left, and what is left below to the nearest.
macro_rules! product {
    ($($bit:literal)*) => {
        concat!(
            "ldy {1.0} | lda {0.0} | jsr product8 |",
            $("asl prod | rol |", $bit,)*
            "asl prod | adc #0 | sta {r.0}"
        )
    };
}

/// The same where the result may not fit: whether what is lost above is the sign is asked first.
macro_rules! any_product {
    ($end:literal $ends:literal $($bit:literal)*) => {
        concat!(
            "ldy {1.0} | lda {0.0} | jsr product8 | tax | clc | adc ", $end, " | cmp ", $ends,
            " | bcs large{n} | txa |",
            $("asl prod | rol |", $bit,)*
            "asl prod | adc #0 | bvs most{n} | cmp #$80 | bne done{n} | beq least{n}
            large{n}:
            txa | bmi least{n}
            most{n}:
            lda #$7f | bne done{n}
            least{n}:
            lda #$81
            done{n}:
            sta {r.0}"
        )
    };
}

pub(crate) const MULTIPLY_ANY_6: &str = any_product!("#$20" "#$40" "" "");
pub(crate) const MULTIPLY_ANY_5: &str = any_product!("#$10" "#$20" "" "" "");
pub(crate) const MULTIPLY_ANY_4: &str = any_product!("#$08" "#$10" "" "" "" "");
pub(crate) const MULTIPLY_8: &str = product!();
pub(crate) const MULTIPLY_7: &str = product!("");
pub(crate) const MULTIPLY_6: &str = product!("" "");
pub(crate) const MULTIPLY_5: &str = product!("" "" "");
pub(crate) const MULTIPLY_4: &str = product!("" "" "" "");
pub(crate) const MULTIPLY_RIGHT: &str = "
    ldy {1.0} | lda {0.0} | jsr product8 | ldy {#n-8}
    below{n}:
    cmp #$80 | ror | dey | bne below{n}
    adc #0 | sta {r.0}";
pub(crate) const MULTIPLY_DOWN: &str = "
    ldy {1.0} | lda {0.0} | jsr product8 | jsr take_product8
    ldy {#n} | jsr narrow8_right | sta {r.0}";
pub(crate) const MULTIPLY_UP: &str = "
    ldy {1.0} | lda {0.0} | jsr product8 | jsr take_product8
    ldy {#0-n} | jsr narrow8_left | sta {r.0}";

pub(crate) const DIVIDE: &str = "
    lda {0.0} | sta acc | lda {0.1} | sta acc+1 | lda {1.0} | sta arg | lda {1.1} | sta arg+1
    ldy {#n} | jsr divide8 | sta {r.0}";
pub(crate) const ROOT: &str = "lda {0.0} | sta acc | lda {0.1} | jsr root8 | sta {r.0}";

/// The upper byte of a and x, which are not below 0, rounded by the lower.
macro_rules! upper {
    () => {
        "| asl | txa | adc #0 | bpl fits{n} | lda #$7f
        fits{n}:
        sta {r.0}"
    };
}

pub(crate) const INT_ROOT: &str = concat!(
    "lda {0.0} | sta acc | lda {0.1} | sta acc+1 | lda {0.2} | sta acc+2 | lda {0.3} | sta acc+3",
    "| ldy {#247-n} | jsr int_root",
    upper!()
);
pub(crate) const RECIPROCAL_ROOT: &str = concat!(
    "ldy {#28-n/2} | lda {0.0} | ldx {0.1} | jsr reciprocal_root",
    upper!()
);
pub(crate) const ODD_RECIPROCAL_ROOT: &str = concat!(
    "ldy {#27-n/2} | lda {0.0} | ldx {0.1} | jsr reciprocal_root_odd",
    upper!()
);

pub(crate) const MODULO: &str = concat!(both!(), "| jsr modulo16", result!());
pub(crate) const MODULO_PART: &str = "modulo16";
pub(crate) const MODULO_CYCLES: u32 = 240;
/// The whole part of what is below 1.
pub(crate) const FRACTION_FLOOR: &str =
    "~ldx #0 | lda {0.0} | bpl even{n} | dex | even{n}: [stx {r.k}]";
pub(crate) const SIGN: &str = "~
    ldx #0 | lda {0.0} | bmi negative{n} | beq zero{n}
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
    "widen",
    "widen_right",
    "widen_both",
    "narrow8_right",
    "narrow8_left",
    "#10",
    "#11",
    "#12"
);
