//! The library of the scene language, which is written in it.

/// A library file's name and text.
pub type Text = (&'static str, &'static str);

macro_rules! texts {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!("../prelude/", $name))),)*]
    };
}

/// The library, in a fixed order.
pub const PRELUDE: &[Text] = texts! {
    "numbers.scn"
    "vectors.scn"
    "cameras.scn"
    "shapes.scn"
    "solve.scn"
    "grid.scn"
    "instances.scn"
    "lights.scn"
    "dithers.scn"
    "noise.scn"
    "forms.scn"
    "stable.scn"
    "input.scn"
    "inside.scn"
};
