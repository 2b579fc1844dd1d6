//! Size budgets: how much memory may be spent on speed, in steps from plenty to hardly any. A
//! program that does not fit is planned again by one further on.

/// What part of the plan's cycles a statement more must save, for its memory (three entries of a
/// table take as much): from where there is plenty to where there was never enough.
const THRIFT: [f64; 7] = [0.0001, 0.0004, 0.0008, 0.0011, 0.0015, 0.0025, 0.01];

/// From what part of the cycles on a statement more is not spent on the turns of loops.
const COUNTED: f64 = 0.002;

/// How much memory counts beside cycles: more where a program did not fit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SizeBudget(usize);

impl SizeBudget {
    /// How many steps there are.
    pub const COUNT: usize = THRIFT.len();

    /// A step by its number.
    pub fn step(step: usize) -> Option<SizeBudget> {
        (step < THRIFT.len()).then_some(SizeBudget(step))
    }

    /// What part of the plan's cycles a statement more must save.
    pub fn part(self) -> f64 {
        THRIFT[self.0]
    }

    /// Whether there is memory to spare.
    pub fn is_plenty(self) -> bool {
        self.part() <= THRIFT[0]
    }

    /// Whether the turns of loops may be written down one by one, and what hangs on their
    /// counters may be in tables.
    pub fn counts(self) -> bool {
        self.part() < COUNTED
    }

    /// Whether runs of columns may be looked for, and rows drawn in passes: both take many
    /// statements a row, which hardly count by cycles.
    pub fn runs(self) -> bool {
        self.0 + 1 < THRIFT.len()
    }
}
