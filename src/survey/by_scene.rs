//! Numbers that hold for all scenes of a survey, for one, or for one on one machine.

use crate::tune::choice::Base;

/// One as it is written: `8`, `maze=12` or `maze/jack=12`.
pub type Written = (Option<String>, u64);

/// Reads one from 1 to `most`.
///
/// # Errors
/// How it is written: what it is of, with `like` for the number.
pub fn read(text: &str, most: u64, (of, like): (&str, u64)) -> Result<Written, String> {
    let (name, number) = match text.rsplit_once('=') {
        Some((name, number)) => (Some(name.to_owned()), number),
        None => (None, text),
    };
    let number = number.parse().ok().filter(|n| (1..=most).contains(n));
    let wrong = || {
        let most = match most {
            u64::MAX => String::new(),
            most => format!(", at most {most}"),
        };
        format!("write {of}{most}, as in {like}, mirrors={like}, or mirrors/jack={like}")
    };
    Ok((name, number.ok_or_else(wrong)?))
}

/// A number for each scene on each machine.
#[derive(Clone, Debug)]
pub struct ByScene {
    /// What the option is called.
    pub option: &'static str,
    all: u64,
    /// Scenes' names, or those of scenes on machines, `mirrors` or `mirrors/jack`.
    own: Vec<(String, u64)>,
}

impl ByScene {
    /// As an option was given, several times perhaps, or not.
    pub fn new(option: &'static str, usual: u64, written: &[Written]) -> ByScene {
        let own = written
            .iter()
            .filter_map(|(name, n)| Some((name.clone()?, *n)));
        let all = written.iter().rfind(|(name, _)| name.is_none());
        ByScene {
            option,
            all: all.map_or(usual, |(_, n)| *n),
            own: own.collect(),
        }
    }

    /// What holds for a scene on a machine: of several the last that is written.
    pub fn of(&self, base: &Base) -> u64 {
        let own = self.own.iter().rev().find(|(name, _)| names(name, base));
        own.map_or(self.all, |(_, n)| *n)
    }

    /// A name that is none of these scenes'.
    pub fn stranger(&self, all: &[Base]) -> Option<&str> {
        let known = |name: &str| all.iter().any(|base| names(name, base));
        let mut own = self.own.iter().map(|(name, _)| name.as_str());
        own.find(|name| !known(name))
    }

    /// The options that say the same.
    pub fn words(&self) -> impl Iterator<Item = String> {
        let all = format!("--{} {}", self.option, self.all);
        let own = (self.own.iter()).map(|(name, n)| format!("--{} {name}={n}", self.option));
        std::iter::once(all).chain(own)
    }
}

/// Whether a name is a scene's, or that of a scene on a machine.
fn names(name: &str, base: &Base) -> bool {
    let scene = base.name();
    name == scene || name == format!("{scene}/{}", base.target.name)
}
