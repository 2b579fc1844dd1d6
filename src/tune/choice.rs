//! A choice: one way to compute a scene on a machine, as options of `run` and `build`.

use crate::given::quoted;
use crate::scene::{Changes, Limits};
use crate::target_args::{Os, Refining, ScreenArgs, Tables};
use crate::trial::HACK_HERTZ;
use crate::ways::WayArgs;
use serde::{Deserialize, Serialize};
use slowlight_compiler::targets::{Target, formats};
use std::path::PathBuf;

/// What is left out of a picture for speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Setting {
    /// Columns and rows of a block; 1 and 1 for pixels.
    pub block: (u32, u32),
    /// Which pixels are traced, where not all are.
    pub refine: Option<Refining>,
    /// The most turns of the scene's loops, where they are fewer than the scene's own.
    pub max_turns: Option<u32>,
    /// The same of the library's.
    pub max_steps: Option<u32>,
    /// What is found in another way than the scene says.
    pub ways: WayArgs,
}

impl Setting {
    /// The picture as the scene has it.
    pub const WHOLE: Setting = Setting {
        block: (1, 1),
        refine: None,
        max_turns: None,
        max_steps: None,
        ways: WayArgs {
            hits: None,
            differences: None,
            samples: None,
        },
    };

    /// What of the scene is done with less, or otherwise, blocks aside.
    pub fn limits(&self) -> Limits {
        Limits {
            turns: self.max_turns,
            steps: self.max_steps,
            ways: self.ways.ways(),
        }
    }
}

/// One way to compute a scene.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Choice {
    /// What is left out.
    pub setting: Setting,
    /// How reals are held.
    pub format: String,
    /// Whether functions are looked up in tables, where there is a choice.
    pub tables: Option<Tables>,
    /// Whether all params are folded.
    pub frozen: bool,
    /// Whether it has subroutines where it would fit without.
    pub outlined: bool,
    /// How much less memory is spent on speed than may be: a step of `--thrift`.
    pub thrift: u8,
}

/// What is tuned, and what stays as the user has it.
#[derive(Clone, Debug)]
pub struct Base {
    /// The scene's file.
    pub path: PathBuf,
    /// What the user changes about it.
    pub changes: Changes,
    /// The machine in its usual format.
    pub target: &'static Target,
    /// The user's own options of the screen and the machine.
    pub screen: ScreenArgs,
}

impl Base {
    /// The scene's name, for people.
    pub fn name(&self) -> String {
        let stem = self.path.file_stem().unwrap_or(self.path.as_os_str());
        stem.to_string_lossy().into_owned()
    }

    /// Cycles of the machine a second.
    pub fn hertz(&self) -> f64 {
        match self.screen.os {
            Some(Os::Jack) => HACK_HERTZ,
            Some(Os::Native) | None => self.target.hertz,
        }
    }

    /// The options of a choice, in words of the command line.
    pub fn words(&self, choice: &Choice) -> Vec<String> {
        let mut words = Vec::new();
        let mut add = |option: &str, value: String| words.extend([option.to_owned(), value]);
        // Unless it is the only one, another may be taken unasked.
        if formats(self.target).count() > 1 {
            add("--format", choice.format.clone());
        }
        if let Some(tables) = choice.tables {
            add("--tables", tables.word().to_owned());
        }
        for value in &self.changes.set {
            add("--set", value.clone());
        }
        match choice.frozen {
            true => add("--freeze", "all".to_owned()),
            false => (self.changes.freeze.iter()).for_each(|f| add("--freeze", f.clone())),
        }
        for value in &self.changes.without {
            add("--without", value.clone());
        }
        words.extend(self.setting(&choice.setting));
        let mut add = |option: &str, value: String| words.extend([option.to_owned(), value]);
        if choice.thrift > 0 {
            add("--thrift", choice.thrift.to_string());
        }
        if let Some(mode) = &self.screen.mode {
            add("--mode", mode.clone());
        }
        if let Some(page) = self.screen.page {
            add("--page", format!("{page:X}"));
        }
        if self.screen.os == Some(Os::Jack) {
            add("--os", "jack".to_owned());
        }
        if choice.outlined {
            words.push("--outlined".to_owned());
        }
        if self.screen.undocumented {
            words.push("--undocumented".to_owned());
        }
        words
    }

    /// The options of a setting.
    pub fn setting(&self, setting: &Setting) -> Vec<String> {
        let mut words = Vec::new();
        let mut add = |option: &str, value: String| words.extend([option.to_owned(), value]);
        match setting.block {
            (1, 1) => {}
            (wide, high) if wide == high => add("--block", wide.to_string()),
            (wide, high) => add("--block", format!("{wide}x{high}")),
        }
        if let Some(refine) = setting.refine {
            add("--refine", refine.to_string());
        }
        let limits = [
            ("--max-turns", setting.max_turns),
            ("--max-steps", setting.max_steps),
        ];
        for (option, most) in limits {
            if let Some(most) = most {
                add(option, most.to_string());
            }
        }
        for (option, value) in setting.ways.words() {
            add(option, value);
        }
        words
    }

    /// The command that gives a choice's figures.
    pub fn command(&self, choice: &Choice, verb: &str) -> String {
        let scene = quoted(&self.path.display().to_string());
        let mut words = vec!["slowlight".to_owned(), verb.to_owned(), scene];
        words.extend(["--target".to_owned(), self.target.name.to_owned()]);
        words.extend(self.words(choice).iter().map(|word| quoted(word)));
        words.join(" ")
    }

    /// The screen's options of a choice.
    pub fn screen(&self, choice: &Choice) -> ScreenArgs {
        ScreenArgs {
            format: Some(choice.format.clone()),
            tables: choice.tables.or(self.screen.tables),
            block: Some(choice.setting.block),
            refine: choice.setting.refine,
            max_turns: choice.setting.max_turns,
            max_steps: choice.setting.max_steps,
            ways: choice.setting.ways,
            outlined: choice.outlined,
            thrift: (choice.thrift > 0).then_some(choice.thrift),
            ..self.screen.clone()
        }
    }

    /// What a choice changes about the scene.
    pub fn changes(&self, frozen: bool) -> Changes {
        let mut changes = self.changes.clone();
        if frozen {
            changes.freeze = vec!["all".to_owned()];
        }
        changes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ways;
    use slowlight_compiler::targets::find;

    fn base() -> Base {
        Base {
            path: PathBuf::from("two mirrors.scn"),
            changes: Changes::default(),
            target: find("jack").expect("a target"),
            screen: ScreenArgs::default(),
        }
    }

    #[test]
    fn what_is_as_usual_needs_no_option() {
        let mut choice = Choice {
            setting: Setting::WHOLE,
            format: "real40".to_owned(),
            tables: None,
            frozen: false,
            outlined: false,
            thrift: 0,
        };
        let usual = |target: &str, choice: &Choice| {
            let target = find(target).expect("a target");
            Base { target, ..base() }.command(choice, "run")
        };
        let command = usual("bbc:micro", &choice);
        assert_eq!(
            command,
            "slowlight run 'two mirrors.scn' --target bbc:micro"
        );
        // Where there are others, one of those might be taken.
        choice.format = "f316".to_owned();
        let command = usual("jack", &choice);
        assert!(
            command.ends_with("--target jack --format f316"),
            "{command}"
        );
    }

    #[test]
    fn every_part_of_a_choice_is_an_option() {
        let choice = Choice {
            setting: Setting {
                block: (4, 2),
                refine: Some(Refining {
                    step: 8,
                    tolerance: 16,
                }),
                max_turns: Some(3),
                max_steps: Some(8),
                ways: WayArgs {
                    hits: ways::search("march:64:0.01").ok(),
                    differences: ways::apart("0.005").ok(),
                    samples: Some(4),
                },
            },
            format: "log10".to_owned(),
            tables: None,
            frozen: true,
            outlined: true,
            thrift: 5,
        };
        let words = base().words(&choice).join(" ");
        let wanted = "--format log10 --freeze all --block 4x2 --refine 8:0.063 \
             --max-turns 3 --max-steps 8 \
             --hits march:64:0.01 --differences 0.005 --samples 4 --thrift 5 --outlined";
        assert_eq!(words, wanted);
    }
}
