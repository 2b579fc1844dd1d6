//! Small programs with what BASIC II prints: their files, and how those are read.

/// By subject: `== name`, the program, perhaps `-- input` and the lines for its INPUTs, then
/// `-- prints` and what it prints, each line between bars.
pub const SUBJECTS: &[(&str, &str)] = &[
    ("data", include_str!("rom/data.txt")),
    ("errors", include_str!("rom/errors.txt")),
    ("expressions", include_str!("rom/expressions.txt")),
    ("flow", include_str!("rom/flow.txt")),
    ("format", include_str!("rom/format.txt")),
    ("input", include_str!("rom/input.txt")),
    ("limits", include_str!("rom/limits.txt")),
    ("memory", include_str!("rom/memory.txt")),
    ("print", include_str!("rom/print.txt")),
    ("procedures", include_str!("rom/procedures.txt")),
    ("strings", include_str!("rom/strings.txt")),
    ("tokens", include_str!("rom/tokens.txt")),
    ("trace", include_str!("rom/trace.txt")),
];

/// A program and what it prints.
pub struct Case<'a> {
    pub name: &'a str,
    pub program: &'a str,
    pub input: Vec<&'a str>,
    pub prints: String,
}

/// The programs of a file.
pub fn cases(text: &str) -> Vec<Case<'_>> {
    let case = |block| {
        let (name, rest): (&str, &str) = str::split_once(block, '\n').expect("a name");
        let (given, prints) = rest.split_once("-- prints\n").expect("prints");
        let (program, input) = given.split_once("-- input\n").unwrap_or((given, ""));
        let line = |l| str::strip_prefix(l, '|').and_then(|l| l.strip_suffix('|'));
        let prints: Vec<&str> = prints.lines().map(|l| line(l).expect("bars")).collect();
        Case {
            name,
            program,
            input: input.lines().collect(),
            prints: prints.join("\n"),
        }
    };
    let blocks = text.strip_prefix("== ").expect("a name");
    blocks.split("\n== ").map(case).collect()
}
