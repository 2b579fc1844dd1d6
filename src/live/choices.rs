//! What a page offers: the machines, and scenes to begin with.

use super::shown::Shown;
use crate::examples::EXAMPLES;
use serde_json::{Value, json};
use slowlight_compiler::targets::{Mode, Target, every, formats};

/// The machines, among them those that draw some scenes only: they say so of others.
pub fn machines() -> Value {
    Value::Array(every().map(machine).collect())
}

fn machine(target: &Target) -> Value {
    let formats: Vec<&str> = formats(target).map(|t| t.runtime.format).collect();
    let named = target.modes.iter().filter(|mode| !mode.name.is_empty());
    let mode = |mode: &Mode| json!({"name": mode.name, "width": mode.width, "height": mode.height, "inks": mode.inks});
    let modes: Vec<Value> = named.map(mode).collect();
    json!({"name": target.name, "about": target.about, "formats": formats, "modes": modes})
}

/// What a page by itself begins with: machines, scenes, and what is shown of nothing.
pub fn about() -> Value {
    let scene = |(name, text): &(&str, &str)| json!({"name": name, "text": text});
    let gallery = EXAMPLES.iter().map(scene).collect::<Vec<_>>();
    json!({"machines": machines(), "gallery": gallery, "blank": Shown::default()})
}
