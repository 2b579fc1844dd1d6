//! Maps from a machine's places to lines of the files that were given.

use slowlight_compiler::report::profile::Line;

/// From a machine's places to lines.
#[derive(Clone, Debug, Default)]
pub(super) enum LineMap {
    /// Not known.
    #[default]
    Unknown,
    /// The line of each place; none for what no file has.
    Places(Vec<Option<Line>>),
}

impl LineMap {
    pub fn line(&self, place: u32) -> Option<Line> {
        match self {
            LineMap::Unknown => None,
            LineMap::Places(lines) => lines.get(place as usize).copied().flatten(),
        }
    }
}
