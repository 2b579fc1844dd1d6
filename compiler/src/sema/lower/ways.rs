//! Other ways to the same picture: what a scene asks for, found otherwise.
//!
//! `trace` and `march` are different pictures, and one never stands for the other by
//! itself; nor does a difference stand for a gradient, or a few rays for many. Whoever
//! looks for what accuracy costs may ask for it, for one program, and compares with the
//! scene as it is written.

/// A number with six places behind the point, so that ways can be compared and are
/// written as they are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Millionths(pub u32);

impl Millionths {
    /// The number.
    pub fn value(self) -> f64 {
        f64::from(self.0) / 1e6
    }
}

/// How what a ray meets in a scene is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Search {
    /// By each shape's own solution, where the scene says `march`, too.
    Trace,
    /// By sphere tracing, where the scene says `trace`, too: so many steps at most,
    /// until a surface is nearer than this.
    March {
        /// Steps at most; who runs out of them is there.
        steps: u32,
        /// What is near enough.
        near: Millionths,
    },
}

/// How many shapes that are alike are a group at least.
pub const INSTANCES: usize = 3;

/// How a scene's shapes that are alike but for numbers are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Instancing {
    /// In a table, by the cells of a view or of a grid where that takes less.
    #[default]
    Cells,
    /// The same with fewer cells, which take less memory.
    FewerCells,
    /// With few.
    FewCells,
    /// In a table, one after the other.
    Rows,
    /// In a table by rays that share a point or a direction, else each by code of its own.
    Seen,
    /// Each by code of its own.
    Separate,
}

/// What is found in another way than the scene says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Ways {
    /// How what a ray meets is found.
    pub search: Option<Search>,
    /// How far apart the differences are that stand for the gradients that normals are
    /// else made of.
    pub differences: Option<Millionths>,
    /// How many rays a pixel has at most, where the library draws it by several.
    pub samples: Option<u32>,
    /// Rays are followed from end to end, whatever is known of where shapes are.
    pub unbounded: bool,
    /// How shapes that are alike are found.
    pub instancing: Instancing,
}
