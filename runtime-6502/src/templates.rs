//! Routines that are written in place. Instructions are separated by `|` or a
//! line's end; see the crate's documentation for the placeholders.
//!
//! `[ ]` holds what is done for each byte k of so many as the result has, where the text
//! begins with `~`, or as its operands need, where it begins with `=`; `[+ ]` leaves out the
//! lowest byte. All others are for numbers of four bytes.

macro_rules! add {
    () => {
        "clc [lda {0.k} | adc {1.k} | sta {r.k}]"
    };
}

pub(crate) const ADD: &str = concat!("~", add!());

macro_rules! subtract {
    () => {
        "sec [lda {0.k} | sbc {1.k} | sta {r.k}]"
    };
}

pub(crate) const SUBTRACT: &str = concat!("~", subtract!());

macro_rules! negate {
    () => {
        "sec [lda #0 | sbc {0.k} | sta {r.k}]"
    };
}

pub(crate) const NEGATE: &str = concat!("~", negate!());

/// The most negative stays as it is.
pub(crate) const ABS: &str = "
    lda {0.3} | bmi negative{n}
    sta {r.3} | lda {0.2} | sta {r.2} | lda {0.1} | sta {r.1} | lda {0.0} | jmp low{n}
    negative{n}:
    sec | lda #0 | sbc {0.0} | tax
          lda #0 | sbc {0.1} | sta {r.1}
          lda #0 | sbc {0.2} | sta {r.2}
          lda #0 | sbc {0.3} | sta {r.3} | txa
    low{n}:
    sta {r.0}";

/// Where the last addition or subtraction of a sum overflowed, its sign came
/// out wrong: the largest or most negative number in its place.
macro_rules! saturate {
    () => {
        "
    bvc fits{n} | eor #$80 | rol | lda #$7f | adc #0 | sta {r.3}
    eor #$80 | sta {r.2} | sta {r.1} | sta {r.0}
    fits{n}:"
    };
}

pub(crate) const SATURATING_ADD: &str = concat!(add!(), saturate!());
pub(crate) const SATURATING_SUBTRACT: &str = concat!(subtract!(), saturate!());
pub(crate) const SATURATING_NEGATE: &str = concat!(negate!(), saturate!());

pub(crate) const SATURATING_ABS: &str = concat!(
    "lda {0.3} | bmi negative{n}
    sta {r.3} | lda {0.2} | sta {r.2} | lda {0.1} | sta {r.1} | lda {0.0} | sta {r.0} | jmp fits{n}
    negative{n}: | ",
    negate!(),
    saturate!()
);

/// Leaves in bit 7 of the accumulator, and in N, whether argument 0 is less than argument 1.
macro_rules! less {
    ($then:literal) => {
        concat!(
            "
    lda {0.0} | cmp {1.0} [+ lda {0.k} | sbc {1.k}]
    bvc even{n} | eor #$80
    even{n}:
    ",
            $then
        )
    };
}

/// Copies argument 0 or 1; `second` is where the second begins.
macro_rules! pick {
    ($branch:literal) => {
        concat!(
            $branch,
            " second{n}
    [- lda {0.k} | sta {r.k}] | lda {0.h} | jmp high{n}
    second{n}:
    [- lda {1.k} | sta {r.k}] | lda {1.h}
    high{n}:
    sta {r.h}"
        )
    };
}

pub(crate) const MIN: &str = concat!("=", less!(""), pick!("bpl"));
pub(crate) const MAX: &str = concat!("=", less!(""), pick!("bmi"));
pub(crate) const LESS: &str = concat!("=", less!("asl"));

/// Not (b < a): the subtraction the other way round, its sign inverted.
pub(crate) const LESS_EQUAL: &str = "=
    lda {1.0} | cmp {0.0} [+ lda {1.k} | sbc {0.k}]
    bvs even{n} | eor #$80
    even{n}:
    asl";

/// Below 0: the sign alone.
pub(crate) const NEGATIVE: &str = "=lda {0.h} | asl";

/// Not below 0.
pub(crate) const NOT_NEGATIVE: &str = "=lda {1.h} | eor #$80 | asl";

/// At most 0: the sign, and where that does not tell, whether any bit is set.
pub(crate) const NOT_POSITIVE: &str = "=
    lda {0.h} | bmi yes{n} [- ora {0.k} | bne no{n}] | beq yes{n}
    no{n}: | clc | bcc told{n}
    yes{n}: | sec
    told{n}:";

/// Above 0.
pub(crate) const POSITIVE: &str = "=
    lda {1.h} | bmi no{n} [- ora {1.k} | bne yes{n}] | bne yes{n}
    no{n}: | clc | bcc told{n}
    yes{n}: | sec
    told{n}:";

/// A comparison of equals leaves the carry set.
pub(crate) const EQUAL: &str = "=
    [- lda {0.k} | cmp {1.k} | bne unlike{n}]
    lda {0.h} | cmp {1.h} | beq alike{n}
    unlike{n}: | clc
    alike{n}:";

pub(crate) const NOT: &str = "lda {0.0} | eor #1 | lsr";

/// -1, 0 or 1.
pub(crate) const SIGN: &str = "
    ldx #0 | lda {0.3} | bmi negative{n}
    ora {0.2} | ora {0.1} | ora {0.0} | beq zero{n}
    lda #1 | bne zero{n}
    negative{n}:
    dex | txa
    zero{n}:
    sta {r.0} | stx {r.1} | stx {r.2} | stx {r.3}";

/// The upper half, sign-extended.
pub(crate) const FLOOR: &str = "
    ldx #0 | lda {0.2} | sta {r.0} | lda {0.3} | sta {r.1} | bpl positive{n} | dex
    positive{n}:
    stx {r.2} | stx {r.3}";

pub(crate) const TO_REAL: &str =
    "lda #0 | sta {r.0} | sta {r.1} | lda {0.0} | sta {r.2} | lda {0.1} | sta {r.3}";

pub(crate) const AND: &str = "~[lda {0.k} | and {1.k} | sta {r.k}]";
pub(crate) const OR: &str = "~[lda {0.k} | ora {1.k} | sta {r.k}]";
pub(crate) const XOR: &str = "~[lda {0.k} | eor {1.k} | sta {r.k}]";

/// By a power of two up to 128: the bits below it.
pub(crate) const MOD_POWER: &str = "~
    sec | lda {1.0} | sbc #1 | and {0.0} | sta {r.0} | lda #0 [+ sta {r.k}]";

/// By a power of two: the bits below it, for reals of any length.
pub(crate) const REAL_MOD_POWER: &str = "~clc | [lda {1.k} | adc #$ff | and {0.k} | sta {r.k}]";

/// Argument 0 halved, towards minus infinity, into the result; the rest is left in the carry.
macro_rules! halve {
    () => {
        "
    lda {0.3} | cmp #$80 | ror | sta {r.3} | lda {0.2} | ror | sta {r.2}
    lda {0.1} | ror | sta {r.1} | lda {0.0} | ror | sta {r.0}
    "
    };
}

/// The result halved once more.
macro_rules! again {
    () => {
        "
    lda {r.3} | cmp #$80 | ror {r.3} | ror {r.2} | ror {r.1} | ror {r.0}
    "
    };
}

/// One more where the bit shifted out last was 1.
macro_rules! carry_in {
    () => {
        "
    bcc even{n} | inc {r.0} | bne even{n} | inc {r.1} | bne even{n} | inc {r.2} | bne even{n} | inc {r.3}
    even{n}:"
    };
}

pub(crate) const HALF: &str = concat!(halve!(), carry_in!());
pub(crate) const QUARTER: &str = concat!(halve!(), again!(), carry_in!());
pub(crate) const INT_HALF: &str = halve!();
pub(crate) const INT_QUARTER: &str = concat!(halve!(), again!());
pub(crate) const INT_EIGHTH: &str = concat!(halve!(), again!(), again!());
pub(crate) const INT_SIXTEENTH: &str = concat!(halve!(), again!(), again!(), again!());

/// Argument 0 doubled and a byte down; the bits that it has below that are left, the first at the
/// top, in y.
macro_rules! down_but_one {
    () => {
        "
    lda {0.0} | asl | tay | lda {0.1} | rol | sta {r.0} | lda {0.2} | rol | sta {r.1}
    lda {0.3} | rol | sta {r.2} | lda #0 | adc #$ff | eor #$ff | sta {r.3}
    "
    };
}

/// The result doubled, with the next bit of those that are left in the accumulator.
macro_rules! up {
    () => {
        "
    asl | rol {r.0} | rol {r.1} | rol {r.2} | rol {r.3}
    "
    };
}

pub(crate) const INT_BY_32: &str = concat!(down_but_one!(), "tya |", up!(), up!());
pub(crate) const INT_BY_64: &str = concat!(down_but_one!(), "tya |", up!());
pub(crate) const INT_BY_128: &str = "
    lda {0.0} | asl | lda {0.1} | rol | sta {r.0} | lda {0.2} | rol | sta {r.1}
    lda {0.3} | rol | sta {r.2} | lda #0 | adc #$ff | eor #$ff | sta {r.3}";
pub(crate) const INT_BY_256: &str = "
    lda {0.1} | sta {r.0} | lda {0.2} | sta {r.1} | lda {0.3} | sta {r.2}
    asl | lda #0 | adc #$ff | eor #$ff | sta {r.3}";

/// The same of a byte.
macro_rules! byte_shifted {
    ($shifts:literal) => {
        concat!(
            "~[+lda #0 | sta {r.k}] lda {0.0} | ",
            $shifts,
            " | sta {r.0}"
        )
    };
}

pub(crate) const BYTE_HALF: &str = byte_shifted!("lsr");
pub(crate) const BYTE_QUARTER: &str = byte_shifted!("lsr | lsr");
pub(crate) const BYTE_EIGHTH: &str = byte_shifted!("lsr | lsr | lsr");
pub(crate) const BYTE_SIXTEENTH: &str = byte_shifted!("lsr | lsr | lsr | lsr");
pub(crate) const BYTE_BY_32: &str = byte_shifted!("lsr | lsr | lsr | lsr | lsr");
pub(crate) const BYTE_BY_64: &str = byte_shifted!("asl | rol | rol | and #3");
pub(crate) const BYTE_BY_128: &str = byte_shifted!("asl | lda #0 | rol");

/// Argument 0 doubled, wrapping.
macro_rules! double {
    () => {
        "
    lda {0.0} | asl | sta {r.0} | lda {0.1} | rol | sta {r.1}
    lda {0.2} | rol | sta {r.2} | lda {0.3} | rol | sta {r.3}
    "
    };
}

/// Of two bytes, by quarter squares.
pub(crate) const BYTE_PRODUCT: &str = "~[+lda #0 | sta {r.k}]
    lda {0.0} | sta sum_lo | sta sum_hi | eor #$ff | sta dif_lo | sta dif_hi | ldy {1.0}
    sec | lda (sum_lo),y | sbc (dif_lo),y | sta {r.0} | lda (sum_hi),y | sbc (dif_hi),y [1| sta {r.k}]";
/// The same of two bytes and one: of the first byte, and of the second that much higher.
macro_rules! word_product {
    ($word:literal, $byte:literal) => {
        concat!(
            "lda {", $byte, ".0} | sta sum_lo | sta sum_hi | eor #$ff | sta dif_lo | sta dif_hi
            ldy {", $word, ".0} | sec | lda (sum_lo),y | sbc (dif_lo),y | tax
            lda (sum_hi),y | sbc (dif_hi),y | sta low
            ldy {", $word, ".1} | sec | lda (sum_lo),y | sbc (dif_lo),y | sta carried
            lda (sum_hi),y | sbc (dif_hi),y | tay | stx {r.0}
            clc | lda carried | adc low | sta {r.1} | tya | adc #0 | sta {r.2} | lda #0 | sta {r.3}"
        )
    };
}
pub(crate) const WORD_BY_BYTE: &str = word_product!("0", "1");
pub(crate) const BYTE_BY_WORD: &str = word_product!("1", "0");
pub(crate) const TWICE: &str = double!();
pub(crate) const FOUR_TIMES: &str =
    concat!(double!(), "asl {r.0} | rol {r.1} | rol {r.2} | rol {r.3}");
