//! Why a plan is in its format, in words.

use crate::fit;
use slowlight_compiler::planner::PlannedScene;

/// How many times as quick a format must be for that to be said where it is within twice the
/// pixels wrong.
const QUICKER: f64 = 2.0;

/// The same where the goal is kept, for a format that leaves it by little: of so many goals.
const CLIFF: f64 = 4.0;
const GOALS: f64 = 3.0;

/// How many formats that do not fit are named.
const NAMED: usize = 2;

/// What a choice was made by.
#[derive(Clone, Debug, PartialEq)]
pub struct Why {
    /// The share of the picture's pixels that may be wrong.
    pub goal: f64,
    /// The share that is expected to be, by a sample of the plan's own.
    pub expected: f64,
    /// What the program takes without a search, for comparison with others'.
    pub unsearched: f64,
    /// What else there was.
    pub others: Others,
}

/// The formats that a choice was not for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Others {
    /// Whose programs the machine does not hold, and by how much.
    pub large: Vec<(&'static str, String)>,
    /// The others that were looked at: what they take, and their pixels wrong.
    pub seen: Vec<(&'static str, f64, f64)>,
}

impl Others {
    /// Notes a format whose program was planned and does not fit, and by how much.
    pub fn does_not_fit(&mut self, format: &'static str, by: &str) {
        self.large.push((format, by.to_owned()));
        self.seen.retain(|(seen, ..)| *seen != format);
    }
}

impl Why {
    /// The note for a plan that was taken by this.
    pub fn text(&self, plan: &PlannedScene) -> String {
        let ways = || fit::help(plan);
        let note = self.note(plan.runtime.format, plan.target.name, &ways);
        // Neither is told by pixels that are looked at one by one.
        match (&plan.graph.refinement, &plan.graph.diffusion) {
            (Some(_), _) => {
                format!("{note}; those that are not traced come on top, `run` counts all")
            }
            (None, Some(_)) => format!(
                "{note}; that is before errors are spread: a small one moves many dots after it, \
                 `run` counts them all"
            ),
            (None, None) => note,
        }
    }

    fn note(&self, format: &str, target: &str, ways: &dyn Fn() -> String) -> String {
        let (wrong, goal) = shares(self.expected, self.goal);
        if self.expected <= self.goal {
            let cliff = self.quicker(format, CLIFF, GOALS * self.goal);
            let hint = cliff.map_or(String::new(), |quick| self.hint(quick));
            return format!(
                "format {format}: about {wrong} of the pixels are wrong, and {goal} may be (--error \
                 or --goal says how many; --format takes another format){hint}"
            );
        }
        let large = self.others.large.iter();
        let large: Vec<String> = large.map(|(f, by)| format!("{f}: {by}")).collect();
        let of_those_that_fit = if large.is_empty() { "" } else { " and fits" };
        let mut said = format!(
            "format {format}: about {wrong} of the pixels are wrong, more than the {goal} that may \
             be: none that was tried{of_those_that_fit} is nearer (--error or --goal says how many \
             may be; --format takes another format)"
        );
        if let Some(quick) = self.quicker(format, QUICKER, 2.0 * self.expected) {
            said.push_str(&self.hint(quick));
        }
        if !large.is_empty() {
            let more = large.len().saturating_sub(NAMED);
            let more = match more {
                0 => String::new(),
                more => format!("\n    and {more} more"),
            };
            said.push_str(&format!(
                "\n  not held by {}, and perhaps nearer:\n    {}{more}\n  {}",
                target,
                large[..large.len().min(NAMED)].join("\n    "),
                ways()
            ));
        }
        said
    }

    /// A line on a format that is much quicker and not much worse.
    fn hint(&self, (quick, cycles, wrong): (&str, f64, f64)) -> String {
        let more = shares(wrong, self.expected).0;
        format!(
            "\n  {quick} is about {:.1} times as quick, with about {more} wrong: --format {quick}, \
             or --error {}",
            self.unsearched / cycles,
            allowing(wrong)
        )
    }

    /// The quickest of those that are so many times as quick, with so many pixels wrong at most.
    fn quicker(&self, taken: &str, times: f64, most: f64) -> Option<(&'static str, f64, f64)> {
        let much = |(format, cycles, wrong): &(&str, f64, f64)| {
            *format != taken && cycles * times <= self.unsearched && *wrong <= most
        };
        let all = self.others.seen.iter().copied().filter(much);
        all.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// Two shares in percent, with as many digits as tell them apart, and from nothing.
fn shares(a: f64, b: f64) -> (String, String) {
    let percent = |share: f64, digits: i32| {
        let scale = 10f64.powi(digits);
        format!("{}%", (share * 100.0 * scale).round() / scale)
    };
    let told = |share: f64, k: i32| share == 0.0 || percent(share, k) != "0%";
    let apart = |k: i32| a == b || percent(a, k) != percent(b, k);
    let digits = (1..6).find(|&k| apart(k) && told(a, k) && told(b, k));
    let digits = digits.unwrap_or(5);
    (percent(a, digits), percent(b, digits))
}

/// What `--error` has to be for so many pixels wrong, with room for what a sample may be off.
fn allowing(wrong: f64) -> String {
    format!("{}%", (wrong * 110.0).ceil().max(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_that_differ_read_otherwise() {
        let read = |a, b| {
            let (a, b) = shares(a, b);
            format!("{a} {b}")
        };
        assert_eq!(read(0.1634, 0.01), "16.3% 1%");
        assert_eq!(read(0.0104, 0.01), "1.04% 1%");
        assert_eq!(read(0.009_996, 0.01), "0.9996% 1%");
        assert_eq!(read(0.01, 0.01), "1% 1%");
        assert_eq!(read(0.0, 0.0001), "0% 0.01%");
        assert_eq!(read(0.000_004, 0.01), "0.0004% 1%");
        assert_eq!(allowing(0.0152), "2%");
    }

    #[test]
    fn what_does_not_fit_and_what_is_quicker_is_said() {
        let mut others = Others::default();
        others.does_not_fit(
            "fixed24",
            "mode 5: about 9,100 of 8,500 bytes, 600 too many",
        );
        let drafted = |name: &'static str| (name, "about 9 of 8 bytes, 1 too many".to_owned());
        others.large.extend([drafted("fixed32"), drafted("float")]);
        others.seen = vec![("fixed16", 4000.0, 0.16), ("log10", 1000.0, 0.2)];
        let why = Why {
            goal: 0.01,
            expected: 0.16,
            unsearched: 4000.0,
            others,
        };
        insta::assert_snapshot!(why.note("fixed16", "m", &|| "what would help: less".to_owned()), @r"
        format fixed16: about 16% of the pixels are wrong, more than the 1% that may be: none that was tried and fits is nearer (--error or --goal says how many may be; --format takes another format)
          log10 is about 4.0 times as quick, with about 20% wrong: --format log10, or --error 22%
          not held by m, and perhaps nearer:
            fixed24: mode 5: about 9,100 of 8,500 bytes, 600 too many
            fixed32: about 9 of 8 bytes, 1 too many
            and 1 more
          what would help: less
        ");
    }

    #[test]
    fn a_cliff_in_price_beside_the_goal_is_said() {
        let others = Others {
            seen: vec![("fixed16", 1000.0, 0.0105), ("log10", 500.0, 0.2)],
            ..Others::default()
        };
        let why = |unsearched| Why {
            goal: 0.01,
            expected: 0.001,
            unsearched,
            others: others.clone(),
        };
        let nothing = || String::new();
        insta::assert_snapshot!(why(13_000.0).note("real40", "m", &nothing), @r"
        format real40: about 0.1% of the pixels are wrong, and 1% may be (--error or --goal says how many; --format takes another format)
          fixed16 is about 13.0 times as quick, with about 1.1% wrong: --format fixed16, or --error 2%
        ");
        assert!(!why(3_000.0).note("real40", "m", &nothing).contains("quick"));
    }
}
