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

macro_rules! second {
    () => {
        "lda {1.0} | ldx {1.1}"
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
/// What is eight bits shorter is there at once.
pub(crate) const MULTIPLY_8: &str = concat!(both!(), "| jsr middle16", result!());
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

/// Of ints that are not below 0.
pub(crate) const PLUS_MULTIPLY: &str = concat!(
    "~",
    both!(),
    "| jsr plus_product [lda {prod.k} | sta {r.k}]"
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
pub(crate) const RECIPROCAL_ROOT: &str = concat!(
    "ldy {#44-n/2} |",
    first!(),
    "| jsr reciprocal_root",
    result!()
);
pub(crate) const ODD_RECIPROCAL_ROOT: &str = concat!(
    "ldy {#43-n/2} |",
    first!(),
    "| jsr reciprocal_root_odd",
    result!()
);
pub(crate) const INT_ROOT: &str = concat!(
    "lda {0.0} | sta acc | lda {0.1} | sta acc+1 | lda {0.2} | sta acc+2 | lda {0.3} | sta acc+3",
    " | ldy {#255-n} | jsr int_root",
    result!()
);

/// Angles of 8 to 16 bits behind the point.
pub(crate) const SINE_16: &str = concat!("ldy {#16-n} |", first!(), "| jsr sine16", result!());
pub(crate) const COSINE_16: &str = concat!("ldy {#16-n} |", first!(), "| jsr cosine16", result!());

/// The point of the result as `exponential16` has it.
pub(crate) const EXPONENTIAL_16: &str = concat!(
    "lda {#79-r} | sta bits | ldy {#16-a} |",
    first!(),
    "| jsr exponential16",
    result!()
);

pub(crate) const MODULO: &str = concat!(both!(), "| jsr modulo16", result!());
pub(crate) const MODULO_PART: &str = "modulo16";
pub(crate) const MODULO_CYCLES: u32 = 250;
/// The whole part of what is below 1.
pub(crate) const FRACTION_FLOOR: &str =
    "~ldx #0 | lda {0.1} | bpl even{n} | dex | even{n}: [stx {r.k}]";
pub(crate) const SIGN: &str = "~
    ldx #0 | lda {0.1} | bmi negative{n} | ora {0.0} | beq zero{n}
    inx | lda #0 | beq zero{n}
    negative{n}:
    ldx #$ff | lda #$ff
    zero{n}:
    stx {r.0} [+ sta {r.k}]";

/// Functions of 16.16 with the operand's point moved to where they have it, and the result's
/// to where it is wanted: how a first and a second operand are loaded and a result is stored,
/// the subroutines, by how many bits a sine and an angle have less than 16 behind the point,
/// and the shift of an angle's legs.
macro_rules! functions {
    ($first:ident, $second:ident, $both:ident, $result:ident, $widen:literal,
     $widen_right:literal, $widen_both:literal, $narrow_right:literal, $narrow_left:literal,
     $sine:literal, $angle:literal, $legs:literal) => {
        functions!(@by $first $result $narrow_right, SINE, "{#16-n}", $widen, "sine", $sine);
        functions!(@by $first $result $narrow_right, COSINE, "{#16-n}", $widen, "cosine", $sine);
        functions!(@by $first $result $narrow_right, ARCSINE, $sine, $widen, "arcsine", $sine);
        functions!(@by $first $result $narrow_right, ARCCOSINE, $sine, $widen, "arccosine", $angle);
        functions!(@sides $first $result $widen $widen_right $narrow_right $narrow_left, TANGENT, "", "tangent");
        functions!(@sides $first $result $widen $widen_right $narrow_right $narrow_left, EXPONENTIAL, "", "exponential");
        functions!(@sides $first $result $widen $widen_right $narrow_right $narrow_left, LOGARITHM, "", "table_logarithm");
        // An exponent has at most 16 bits behind its point.
        functions!(@sides $first $result $widen $widen_right $narrow_right $narrow_left, POWER,
            concat!("ldy {#16-b} |", $second!(), "| jsr ", $widen, " | jsr second_operand |"), "power");
        pub(crate) const ARCTANGENT: &str = concat!(
            $both!(), "| ldy ", $legs, " | jsr ", $widen_both, " | jsr arctangent2 | ldy ", $angle,
            " | jsr ", $narrow_right, $result!()
        );
    };
    (@by $first:ident $result:ident $narrow:literal, $name:ident, $by:literal, $widen:literal, $function:literal, $less:literal) => {
        pub(crate) const $name: &str = concat!(
            "ldy ", $by, " |", $first!(), "| jsr ", $widen, " | jsr ", $function,
            " | ldy ", $less, " | jsr ", $narrow, $result!()
        );
    };
    (@sides $first:ident $result:ident $left:literal $right:literal $down:literal $up:literal, $name:ident, $before:expr, $function:literal) => {
        pub(crate) const $name: [&str; 4] = [
            functions!(@one $first $result $before, "{#16-a}", $left, $function, "{#16-r}", $down),
            functions!(@one $first $result $before, "{#a-16}", $right, $function, "{#16-r}", $down),
            functions!(@one $first $result $before, "{#16-a}", $left, $function, "{#r-16}", $up),
            functions!(@one $first $result $before, "{#a-16}", $right, $function, "{#r-16}", $up),
        ];
    };
    (@one $first:ident $result:ident $before:expr, $by:literal, $widen:literal, $function:literal, $less:literal, $narrow:literal) => {
        concat!(
            $before, "ldy ", $by, " |", $first!(), "| jsr ", $widen, " | jsr ", $function,
            " | ldy ", $less, " | jsr ", $narrow, $result!()
        )
    };
}
pub(crate) use functions;

functions!(
    first,
    second,
    both,
    result,
    "widen",
    "widen_right",
    "widen_both",
    "narrow_right",
    "narrow_left",
    "#2",
    "#3",
    "#12"
);

/// Which operand a routine's text only copies, if it does nothing else.
pub fn copied(text: &str) -> Option<usize> {
    match text {
        COPY => Some(0),
        COPY_SECOND => Some(1),
        _ => None,
    }
}

/// What numbers of two bytes have in fewer bytes, where that may take longer, and the part with it.
const SHORT: [(&str, &str, &str); 3] = [
    (
        SATURATING_ADD,
        "clc | lda {0.0} | adc {1.0} | tax | lda {0.1} | adc {1.1}
        | jsr saturate16 | sta {r.1} | stx {r.0}",
        "saturate16",
    ),
    (
        SATURATING_SUBTRACT,
        "sec | lda {0.0} | sbc {1.0} | tax | lda {0.1} | sbc {1.1}
        | jsr saturate16 | sta {r.1} | stx {r.0}",
        "saturate16",
    ),
    (ABS, concat!(first!(), "| jsr abs16", result!()), "abs16"),
];

/// The same for a template and so many bytes, if there is one.
pub fn short(text: &str, bytes: u8) -> Option<(&'static str, &'static str)> {
    let mut all = SHORT.iter().filter(|_| bytes == 2);
    let found = all.find(|(long, ..)| *long == text);
    found.map(|(_, short, part)| (*short, *part))
}

/// What a product of a number with itself is instead, the same bits, and the part with it.
pub fn squared(text: &'static str) -> Option<(&'static str, &'static str)> {
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
    let is = |(product, _): &&(&str, &str)| *product == text;
    if let Some((_, square)) = all.iter().find(is) {
        return Some((square, "square16"));
    }
    let found = super::templates_long::SQUARES.iter().find(is);
    found.map(|(_, square)| (*square, "square24"))
}
