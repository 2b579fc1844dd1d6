//! Scenes that the binary brings along, to begin with.

/// A scene's name and its text.
type Example = (&'static str, &'static str);

macro_rules! texts {
    ($($name:literal)* moving $($moves:literal)*) => {
        &[
            $(($name, include_str!(concat!("../examples/", $name, ".scn"))),)*
            $(($moves, include_str!(concat!("../examples/moving/", $moves, ".scn"))),)*
        ]
    };
}

/// The repository's examples, by name; those that move stand last.
pub const EXAMPLES: &[Example] = texts! {
    "colours"
    "csg"
    "fifty"
    "focus"
    "fog"
    "glass"
    "masks"
    "maze"
    "mirrors"
    "primitives"
    "room"
    "shadows"
    "terrain"
    "torus"
    "torus-march"
    "torus-original"
    "twist"
    "wave"
    moving
    "bounce"
    "cartridge"
    "plasma"
    "walk"
};

/// What a new scene is where no example is asked for.
pub const STARTER: &str = include_str!("examples/starter.scn");

/// The examples' names.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    EXAMPLES.iter().map(|(name, _)| *name)
}

/// An example's text.
pub fn text(name: &str) -> Option<&'static str> {
    let found = EXAMPLES.iter().find(|(known, _)| *known == name);
    found.map(|(_, text)| *text)
}
