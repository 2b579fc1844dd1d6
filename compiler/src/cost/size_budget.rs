//! Size budgets: how much memory may be spent on speed, in steps from plenty to hardly any. A
//! program that does not fit is planned again by one further on.

/// How much memory may be spent.
struct Step {
    /// What part of the plan's cycles a statement more must save, for its memory
    /// (three entries of a table take as much).
    part: f64,
    /// How many times that for statements around pixels.
    around: f64,
    /// Whether runs of columns may be looked for, and whether rows may be drawn in
    /// passes: both take many statements a row, which hardly count by cycles.
    runs: bool,
    passes: bool,
}

const fn step(part: f64) -> Step {
    Step {
        part,
        around: 1.0,
        runs: true,
        passes: true,
    }
}

const fn without_runs(part: f64) -> Step {
    Step {
        runs: false,
        ..step(part)
    }
}

/// From where there is plenty to where there was never enough.
const THRIFT: [Step; 15] = [
    step(0.0001),
    step(0.0004),
    step(0.0006),
    step(0.0008),
    step(0.0011),
    step(0.0015),
    // What rows and passes know is worth less than what makes their pixels quick.
    Step {
        around: 4.0,
        ..step(0.0005)
    },
    step(0.0025),
    without_runs(0.0001),
    without_runs(0.0002),
    without_runs(0.0006),
    without_runs(0.001),
    without_runs(0.0025),
    without_runs(0.006),
    Step {
        passes: false,
        ..without_runs(0.01)
    },
];

/// From what part of the cycles on a statement more is not spent on the turns of loops.
const COUNTED: f64 = 0.0005;

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
        THRIFT[self.0].part
    }

    /// How many times that a statement around pixels must save.
    pub fn around(self) -> f64 {
        THRIFT[self.0].around
    }

    /// Whether there is memory to spare.
    pub fn is_plenty(self) -> bool {
        self.part() <= THRIFT[0].part
    }

    /// Whether the turns of loops may be written down one by one, and what hangs on their
    /// counters may be in tables.
    pub fn counts(self) -> bool {
        self.part() < COUNTED
    }

    /// Whether runs of columns may be looked for.
    pub fn runs(self) -> bool {
        THRIFT[self.0].runs
    }

    /// Whether rows may be drawn in passes.
    pub fn passes(self) -> bool {
        THRIFT[self.0].passes
    }
}
