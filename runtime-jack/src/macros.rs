//! How a routine is written down, in either format of reals.

/// A real, an int or a bool from bits, and to bits, by the name of the format; `Real` is the
/// caller's.
macro_rules! from {
    (R $bits:expr) => {
        Real::from_bits($bits)
    };
    (I $bits:expr) => {
        int($bits)
    };
    (B $bits:expr) => {
        $bits != 0
    };
}
macro_rules! to {
    (R $value:expr) => {
        Real::bits($value)
    };
    (I $value:expr) => {
        int_bits(wrap($value))
    };
    (B $value:expr) => {
        u64::from($value)
    };
}

/// A routine: name, operation, formats, text, needs, domain, error, model, and
/// its cost in VM commands and words.
macro_rules! routine {
    ($name:literal $op:ident($($arg:ident),+) -> $result:ident, $form:expr, [$($need:literal),*],
     $domain:expr, $error:expr, |$($x:ident),+| $body:expr, $cycles:literal, $bytes:literal) => {
        Routine {
            name: $name,
            op: Op::$op,
            args: &[$($arg),+],
            result: $result,
            form: $form,
            needs: &[$($need),*],
            cycles: $cycles,
            bytes: $bytes,
            domain: $domain,
            error: $error,
            model: |args| {
                let mut args = args.iter().copied();
                $(let $x = from!($arg args.next().unwrap_or(0));)+
                to!($result $body)
            },
        }
    };
}

/// A part of a class: name, what else it needs, words of ROM, text, and the VM commands that
/// `init` takes for it where it calls it.
macro_rules! part {
    ($name:literal, [$($need:literal),*], $words:literal, $text:expr) => {
        part!($name, [$($need),*], $words, $text, 0)
    };
    ($name:literal, [$($need:literal),*], $words:literal, $text:expr, $starts:literal) => {
        Part {
            name: $name,
            source: Source::Text($text),
            needs: &[$($need),*],
            bytes: $words,
            starts: $starts,
        }
    };
}
