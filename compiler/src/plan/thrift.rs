//! How much memory may be spent on speed: steps from plenty to hardly any. A program
//! that does not fit is planned again by one further on.

/// What part of the plan's cycles a statement more must save, for its memory
/// (three entries of a table take as much), whether runs of columns may be
/// looked for and whether rows may be drawn in passes: both take many statements a row, which hardly count by cycles.
/// From where there is plenty to where there was never enough; the second is the first
/// with what tables hold worked out where it is needed.
const THRIFT: [(f64, bool, bool); 15] = [
    (0.0001, true, true),
    (0.0001, true, true),
    (0.0004, true, true),
    (0.0006, true, true),
    (0.0008, true, true),
    (0.0011, true, true),
    (0.0015, true, true),
    (0.0025, true, true),
    (0.0001, false, true),
    (0.0002, false, true),
    (0.0006, false, true),
    (0.001, false, true),
    (0.0025, false, true),
    (0.006, false, true),
    (0.01, false, false),
];

/// The step that follows recipes of tables even where that is slower.
const FOLLOWS: usize = 1;

/// How much memory counts beside cycles: more where a program did not fit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Thrift(usize);

impl Thrift {
    /// How many steps there are.
    pub const COUNT: usize = THRIFT.len();

    /// A step by its number.
    pub fn step(step: usize) -> Option<Thrift> {
        (step < THRIFT.len()).then_some(Thrift(step))
    }

    /// The next that spends less memory, if there is one.
    pub fn more(self) -> Option<Thrift> {
        (self.0 + 1 < THRIFT.len()).then_some(Thrift(self.0 + 1))
    }

    /// What part of the plan's cycles a statement more must save.
    pub fn part(self) -> f64 {
        THRIFT[self.0].0
    }

    /// Whether what tables hold is to be worked out where it is needed, if it can be.
    pub fn follows(self) -> bool {
        self.0 == FOLLOWS
    }

    /// Whether runs of columns may be looked for.
    pub fn runs(self) -> bool {
        THRIFT[self.0].1
    }

    /// Whether rows may be drawn in passes.
    pub fn passes(self) -> bool {
        THRIFT[self.0].2
    }
}
