//! Numbers of a program's items, each of a type of its own.

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub usize);)*
    };
}

ids! {
    /// A function, dither or effect of [`super::program::Program::functions`].
    FunctionId
    /// A constant of [`super::program::Program::consts`].
    ConstId
    /// A param of [`super::program::Program::params`].
    ParamId
    /// A shape of [`super::program::Program::shapes`].
    ShapeId
    /// A scene of [`super::program::Program::scenes`].
    SceneId
    /// A record of [`super::program::Program::records`].
    RecordId
    /// A map of [`super::program::Program::maps`].
    MapId
    /// A slot of the enclosing function's frame.
    LocalId
}
