//! Options as they were given on a command line: kept as words, and read again from them.

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command, FromArgMatches};

/// Parsed options, and the words that gave them, in the order of their declaration.
#[derive(Clone, Debug, Default)]
pub struct Given<T> {
    /// The options.
    pub args: T,
    /// Each as on the command line, `--name` before its value; none that was not given.
    words: Vec<String>,
}

impl<T: Args> Given<T> {
    /// Reads options from the text that [`Given::text`] made.
    ///
    /// # Errors
    /// Where they are none of these options.
    pub fn read(text: &str) -> Result<Given<T>, String> {
        let words = shlex::split(text).ok_or("a quote is not closed")?;
        // Help is for who reads a terminal.
        let command = Command::new("options")
            .no_binary_name(true)
            .disable_help_flag(true);
        let command = T::augment_args(command);
        let matches = command.try_get_matches_from(words);
        let found = matches.and_then(|m| Given::from_arg_matches(&m));
        found.map_err(|e| {
            let said = e.to_string();
            let first = said.lines().next().unwrap_or_default();
            first.strip_prefix("error: ").unwrap_or(first).to_owned()
        })
    }
}

impl<T> Given<T> {
    /// Whether no option was given.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// The words as a shell takes them.
    pub fn text(&self) -> String {
        let words = self.words.iter().map(|word| quoted(word));
        words.collect::<Vec<String>>().join(" ")
    }
}

impl<T: Args> FromArgMatches for Given<T> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Given<T>, clap::Error> {
        let mut words = Vec::new();
        for arg in T::augment_args(Command::new("options")).get_arguments() {
            let id = arg.get_id().as_str();
            let (Some(long), Some(ValueSource::CommandLine)) =
                (arg.get_long(), matches.value_source(id))
            else {
                continue;
            };
            let option = format!("--{long}");
            if !arg.get_action().takes_values() {
                words.push(option);
                continue;
            }
            for value in matches.get_raw(id).into_iter().flatten() {
                words.extend([option.clone(), value.to_string_lossy().into_owned()]);
            }
        }
        let args = T::from_arg_matches(matches)?;
        Ok(Given { args, words })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Given::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<T: Args> Args for Given<T> {
    fn augment_args(command: Command) -> Command {
        T::augment_args(command)
    }

    fn augment_args_for_update(command: Command) -> Command {
        T::augment_args_for_update(command)
    }
}

/// A word as a shell takes it.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=,+".contains(c);
    match word.chars().all(plain) && !word.is_empty() {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Changes;

    #[test]
    fn what_was_given_is_read_again() {
        let text = "--set 'eye=1, -2' --set a=3 --freeze all --without 'it'\\''s'";
        let given: Given<Changes> = Given::read(text).expect("options");
        assert_eq!(given.text(), text);
        assert_eq!(given.args.set, ["eye=1, -2", "a=3"]);
        assert_eq!(given.args.without, ["it's"]);
        let again: Given<Changes> = Given::read(&given.text()).expect("options");
        assert_eq!(again.words, given.words);
        let none: Given<Changes> = Given::read("").expect("nothing");
        assert!(none.is_empty());
    }

    #[test]
    fn what_is_no_option_is_refused() {
        for wrong in ["--rose 1..2", "--set", "--set 'a=1", "stripes.scn"] {
            assert!(Given::<Changes>::read(wrong).is_err(), "{wrong}");
        }
    }
}
