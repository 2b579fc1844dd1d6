//! Routines of fixed point with points of its own, as instructions: for numbers of so many
//! bytes as the format has (see [`crate::templates`]).
//!
//! A number of 16 bits goes to a subroutine in a and x (high), a second one in `arg`.
//! Products come back in `prod+1`, `prod+2` and a (high), all else in a and x (high).

pub(crate) const COPY: &str = "~[lda {0.k} | sta {r.k}]";
pub(crate) const COPY_SECOND: &str = "~[lda {1.k} | sta {r.k}]";
pub(crate) const NEGATE_SECOND: &str = "~sec [lda #0 | sbc {1.k} | sta {r.k}]";

/// What is left at the format's end has a negative.
macro_rules! saturate {
    () => {
        "
    bvc fits{n} | eor #$80 | rol | lda #$7f | adc #0 | sta {r.1}
    eor #$80 | ora #1 | sta {r.0} | bne done{n}
    fits{n}:
    cmp #$80 | bne done{n} | lda {r.0} | bne done{n} | inc {r.0}
    done{n}:"
    };
}

pub(crate) const SATURATING_ADD: &str =
    concat!("clc [lda {0.k} | adc {1.k} | sta {r.k}]", saturate!());
pub(crate) const SATURATING_SUBTRACT: &str =
    concat!("sec [lda {0.k} | sbc {1.k} | sta {r.k}]", saturate!());

pub(crate) const ABS: &str = "
    lda {0.h} | bmi negative{n} | sta {r.h} [- lda {0.k} | sta {r.k}] | jmp done{n}
    negative{n}:
    sec [lda #0 | sbc {0.k} | sta {r.k}]
    done{n}:";

/// Numbers whose difference fits.
pub(crate) const LESS_NEAR: &str = "lda {0.0} | cmp {1.0} [+ lda {0.k} | sbc {1.k}] | asl";
pub(crate) const LESS_EQUAL_NEAR: &str =
    "lda {1.0} | cmp {0.0} [+ lda {1.k} | sbc {0.k}] | eor #$80 | asl";

/// A number's bytes, where a subroutine wants them.
macro_rules! first {
    () => {
        "lda {0.0} | ldx {0.1}"
    };
}

macro_rules! both {
    () => {
        concat!("lda {1.0} | sta arg | lda {1.1} | sta arg+1 |", first!())
    };
}

/// Operands of a division.
macro_rules! divided {
    () => {
        "lda {0.0} | sta acc | lda {0.1} | sta acc+1 | lda {1.0} | sta arg | lda {1.1} | sta arg+1"
    };
}

/// The upper 16 of 24 bits, rounded by the next.
macro_rules! upper {
    () => {
        "| ldx prod+1 | bpl rounded{n} | inc prod+2 | bne rounded{n} | clc | adc #1
        rounded{n}:
        sta {r.1} | lda prod+2 | sta {r.0}"
    };
}

macro_rules! result {
    () => {
        "| sta {r.0} | stx {r.1}"
    };
}

/// Signed bits of `prod+1`, `prod+2` and a to the left, rounded by what is left below.
macro_rules! up {
    ($($bit:literal)*) => {
        concat!($("| asl prod+1 | rol prod+2 | rol ", $bit,)*)
    };
}

pub(crate) const MULTIPLY_16: &str = concat!(both!(), "| jsr product16", upper!());
pub(crate) const MULTIPLY_15: &str = concat!(both!(), "| jsr product16", up!(""), upper!());
pub(crate) const MULTIPLY_14: &str = concat!(both!(), "| jsr product16", up!("" ""), upper!());
pub(crate) const MULTIPLY_13: &str = concat!(both!(), "| jsr product16", up!("" "" ""), upper!());
pub(crate) const MULTIPLY_12: &str =
    concat!(both!(), "| jsr product16", up!("" "" "" ""), upper!());
/// The same bits where the result may not fit.
pub(crate) const MULTIPLY_ANY_14: &str = concat!(both!(), "| jsr product16 | jsr up14", result!());
pub(crate) const MULTIPLY_ANY_13: &str = concat!(both!(), "| jsr product16 | jsr up13", result!());
pub(crate) const MULTIPLY_ANY_12: &str = concat!(both!(), "| jsr product16 | jsr up12", result!());
pub(crate) const MULTIPLY_RIGHT: &str = concat!(
    both!(),
    "| jsr product16 | ldy {#n-16} | jsr lower24",
    result!()
);
pub(crate) const MULTIPLY_ANY: &str = concat!(
    both!(),
    "| jsr product16 | ldy {#n-8} | jsr narrow24",
    result!()
);
pub(crate) const MULTIPLY_UP: &str = concat!(
    both!(),
    "| jsr exact32 | ldy {#0-n} | jsr narrow_left",
    result!()
);
pub(crate) const MULTIPLY_DOWN: &str = concat!(
    both!(),
    "| jsr exact32 | ldy {#n} | jsr narrow_right",
    result!()
);

pub(crate) const SQUARE_16: &str = concat!(first!(), "| jsr square16", upper!());
pub(crate) const SQUARE_15: &str = concat!(first!(), "| jsr square16", up!(""), upper!());
pub(crate) const SQUARE_14: &str = concat!(first!(), "| jsr square16", up!("" ""), upper!());
pub(crate) const SQUARE_13: &str = concat!(first!(), "| jsr square16", up!("" "" ""), upper!());
pub(crate) const SQUARE_12: &str = concat!(first!(), "| jsr square16", up!("" "" "" ""), upper!());
pub(crate) const SQUARE_ANY_14: &str = concat!(first!(), "| jsr square16 | jsr up14", result!());
pub(crate) const SQUARE_ANY_13: &str = concat!(first!(), "| jsr square16 | jsr up13", result!());
pub(crate) const SQUARE_ANY_12: &str = concat!(first!(), "| jsr square16 | jsr up12", result!());
pub(crate) const SQUARE_RIGHT: &str = concat!(
    first!(),
    "| jsr square16 | ldy {#n-16} | jsr lower24",
    result!()
);
pub(crate) const SQUARE_ANY: &str = concat!(
    first!(),
    "| jsr square16 | ldy {#n-8} | jsr narrow24",
    result!()
);

pub(crate) const DIVIDE: &str = concat!(divided!(), "| ldy {#n} | jsr divide16", result!());
pub(crate) const ONE_OVER: &str = concat!(
    "lda {1.0} | sta arg | lda {1.1} | sta arg+1 | ldy {%} | jsr one_over",
    result!()
);
pub(crate) const ROOT: &str = concat!("ldy {#14-n/2} |", first!(), "| jsr root16", result!());
pub(crate) const ODD_ROOT: &str =
    concat!("ldy {#15-n/2} |", first!(), "| jsr root16_odd", result!());

pub(crate) const MODULO: &str = concat!(
    both!(),
    "| ldy #0 | jsr widen_both | jsr modulo | ldx acc+1 | lda acc",
    result!()
);
pub(crate) const SIGN: &str = "~
    ldx #0 | lda {0.1} | bmi negative{n} | ora {0.0} | beq zero{n}
    inx | lda #0 | beq zero{n}
    negative{n}:
    ldx #$ff | lda #$ff
    zero{n}:
    stx {r.0} [+ sta {r.k}]";

/// A function of 16.16: the operand's point to the right or to the left, and the result's.
macro_rules! function {
    (left, $name:literal, right) => {
        concat!(
            "ldy {#16-a} |",
            first!(),
            "| jsr widen | jsr ",
            $name,
            "| ldy {#16-r} | jsr narrow_right",
            result!()
        )
    };
    (right, $name:literal, right) => {
        concat!(
            "ldy {#a-16} |",
            first!(),
            "| jsr widen_right | jsr ",
            $name,
            "| ldy {#16-r} | jsr narrow_right",
            result!()
        )
    };
    (left, $name:literal, left) => {
        concat!(
            "ldy {#16-a} |",
            first!(),
            "| jsr widen | jsr ",
            $name,
            "| ldy {#r-16} | jsr narrow_left",
            result!()
        )
    };
    (right, $name:literal, left) => {
        concat!(
            "ldy {#a-16} |",
            first!(),
            "| jsr widen_right | jsr ",
            $name,
            "| ldy {#r-16} | jsr narrow_left",
            result!()
        )
    };
    // The scale of the operand, and so many bits that the result has less than 16.
    ($by:literal, $name:literal, $less:literal) => {
        concat!(
            "ldy ",
            $by,
            "|",
            first!(),
            "| jsr widen | jsr ",
            $name,
            "| ldy ",
            $less,
            "| jsr narrow_right",
            result!()
        )
    };
}

pub(crate) const SINE: &str = function!("{#16-n}", "sine", "#2");
pub(crate) const COSINE: &str = function!("{#16-n}", "cosine", "#2");
pub(crate) const ARCSINE: &str = function!("#2", "arcsine", "#2");
pub(crate) const ARCCOSINE: &str = function!("#2", "arccosine", "#3");
pub(crate) const TANGENT: [&str; 4] = [
    function!(left, "tangent", right),
    function!(right, "tangent", right),
    function!(left, "tangent", left),
    function!(right, "tangent", left),
];
pub(crate) const EXPONENTIAL: [&str; 4] = [
    function!(left, "exponential", right),
    function!(right, "exponential", right),
    function!(left, "exponential", left),
    function!(right, "exponential", left),
];
pub(crate) const LOGARITHM: [&str; 4] = [
    function!(left, "logarithm", right),
    function!(right, "logarithm", right),
    function!(left, "logarithm", left),
    function!(right, "logarithm", left),
];
pub(crate) const ARCTANGENT: &str = concat!(
    both!(),
    "| ldy #12 | jsr widen_both | jsr arctangent2 | ldy #3 | jsr narrow_right",
    result!()
);
/// An exponent has at most 15 bits behind its point.
macro_rules! power {
    ($widen_a:literal, $by_a:literal, $narrow:literal, $by:literal) => {
        concat!(
            "ldy {#16-b} | lda {1.0} | ldx {1.1} | jsr widen | jsr second_operand | ldy ",
            $by_a,
            "|",
            first!(),
            "| jsr ",
            $widen_a,
            " | jsr power | ldy ",
            $by,
            " | jsr ",
            $narrow,
            result!()
        )
    };
}
pub(crate) const POWER: [&str; 4] = [
    power!("widen", "{#16-a}", "narrow_right", "{#16-r}"),
    power!("widen_right", "{#a-16}", "narrow_right", "{#16-r}"),
    power!("widen", "{#16-a}", "narrow_left", "{#r-16}"),
    power!("widen_right", "{#a-16}", "narrow_left", "{#r-16}"),
];

/// Which operand a routine's text only copies, if it does nothing else.
pub fn copied(text: &str) -> Option<usize> {
    match text {
        COPY => Some(0),
        COPY_SECOND => Some(1),
        _ => None,
    }
}

/// What a product of a number with itself is instead: the same bits.
pub fn squared(text: &'static str) -> Option<&'static str> {
    let all = [
        (MULTIPLY_16, SQUARE_16),
        (MULTIPLY_15, SQUARE_15),
        (MULTIPLY_14, SQUARE_14),
        (MULTIPLY_13, SQUARE_13),
        (MULTIPLY_12, SQUARE_12),
        (MULTIPLY_ANY_14, SQUARE_ANY_14),
        (MULTIPLY_ANY_13, SQUARE_ANY_13),
        (MULTIPLY_ANY_12, SQUARE_ANY_12),
        (MULTIPLY_RIGHT, SQUARE_RIGHT),
        (MULTIPLY_ANY, SQUARE_ANY),
    ];
    let found = all.into_iter().find(|(product, _)| *product == text);
    found.map(|(_, square)| square)
}
