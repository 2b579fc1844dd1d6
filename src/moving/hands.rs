//! A player's hands by a script: what is held after each picture.

use crate::failure::{Failure, Outcome};
use crate::files;
use slowlight_compiler::ir::graph::{Button, Graph};
use slowlight_vm::keys::{Key, Script};
use std::path::Path;

/// A script of keys, a unit a picture.
#[derive(Clone, Debug)]
pub struct Hands {
    script: Script,
}

impl Hands {
    /// Of a script, or of a file of one. `fire` is the space bar.
    ///
    /// # Errors
    /// The first word that is wrong.
    pub fn of(given: &str) -> Outcome<Hands> {
        let text = match given.strip_prefix('@') {
            Some(path) => files::read_text(Path::new(path))?,
            None => given.to_owned(),
        };
        let wrong = |what: String| Failure::Usage(format!("--keys: {what}"));
        if let Some(word) = foreign(&text) {
            let known = "left, right, up, down, fire, wait and counts (docs/moving.md)";
            return Err(wrong(format!(
                "`{word}` is nothing a player holds: {known}"
            )));
        }
        let script: Script = fired(&text)
            .parse()
            .map_err(|fault| wrong(format!("{fault}")))?;
        if script.pictures().next().is_some() {
            let message = "every picture is kept, so there is no `shot`".to_owned();
            return Err(wrong(message));
        }
        Ok(Hands { script })
    }

    /// The script.
    pub fn script(&self) -> &Script {
        &self.script
    }

    /// What is held after a picture.
    pub fn held(&self, picture: u32) -> Option<Button> {
        match self.script.held(u64::from(picture))? {
            Key::Left => Some(Button::Left),
            Key::Right => Some(Button::Right),
            Key::Up => Some(Button::Up),
            Key::Down => Some(Button::Down),
            Key::Char(b' ') => Some(Button::Fire),
            _ => None,
        }
    }

    /// Gives a graph what is held after a picture.
    pub fn give(&self, picture: u32, graph: &mut Graph) {
        let held = self.held(picture);
        let buttons: Vec<_> = graph.buttons().collect();
        for (id, button) in buttons {
            if let Some(param) = graph.params.get_mut(id.0 as usize) {
                param.value = f64::from(u8::from(held == Some(button)));
            }
        }
    }
}

/// The first word that is no part of what a player holds.
fn foreign(text: &str) -> Option<&str> {
    const HELD: [&str; 7] = ["left", "right", "up", "down", "fire", "space", "wait"];
    text.split_whitespace().find(|word| {
        let (name, count) = word.split_once('*').unwrap_or((word, "1"));
        let is_count = |text: &str| text.parse::<u64>().is_ok();
        !(HELD.contains(&name) && is_count(count) || is_count(word))
    })
}

/// A script with `fire` as the key that it is.
fn fired(text: &str) -> String {
    let line = |line: &str| {
        let words = line.split(' ').map(|word| match word.strip_prefix("fire") {
            Some(rest) if rest.is_empty() || rest.starts_with('*') => format!("space{rest}"),
            _ => word.to_owned(),
        });
        words.collect::<Vec<String>>().join(" ")
    };
    text.lines().map(line).collect::<Vec<String>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_script_says_what_is_held_after_each_picture() {
        let hands = Hands::of("up*2 fire wait 1 left wait 1").expect("a script");
        let held: Vec<Option<Button>> = (0..9).map(|at| hands.held(at)).collect();
        let (up, fire, left) = (Some(Button::Up), Some(Button::Fire), Some(Button::Left));
        assert_eq!(held, [up, up, None, fire, None, None, left, None, None]);
        for wrong in ["up*", "shot a.png", "sideways", "a", "quit"] {
            assert!(
                matches!(Hands::of(wrong), Err(Failure::Usage(_))),
                "{wrong}"
            );
        }
    }
}
