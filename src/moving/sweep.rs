//! Params that go from one value to another over the pictures: `--set time=0..1`.

use crate::failure::{Failure, Outcome};
use crate::scene::Changes;
use slowlight_compiler::ir::graph::{Graph, Role};
use slowlight_routine::Type;

/// A param's values in the first and the last picture, part by part.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    name: String,
    from: Vec<f64>,
    to: Vec<f64>,
}

/// The changes with each such param at its first value, and with it at its last; none where no
/// param goes anywhere.
///
/// # Errors
/// Where an end is missing.
pub fn ends(changes: &Changes) -> Outcome<Option<(Changes, Changes)>> {
    let (mut first, mut last) = (changes.clone(), changes.clone());
    let mut any = false;
    let both = first.set.iter_mut().zip(&mut last.set);
    for (first, last) in both {
        let Some((name, values)) = first.split_once('=') else {
            continue;
        };
        let Some((from, to)) = values.split_once("..") else {
            continue;
        };
        if from.trim().is_empty() || to.trim().is_empty() {
            let message = format!("--set {first}: write param=first..last");
            return Err(Failure::Usage(message));
        }
        any = true;
        let name = name.to_owned();
        (*first, *last) = (format!("{name}={from}"), format!("{name}={to}"));
    }
    Ok(any.then_some((first, last)))
}

/// What goes from one graph's values to another's, of the same scene.
///
/// # Errors
/// Where it is a state, or was folded.
pub fn between(first: &Graph, last: &Graph, changes: &Changes) -> Outcome<Vec<Sweep>> {
    let mut sweeps = Vec::new();
    for text in changes.set.iter().filter(|text| text.contains("..")) {
        let name = text.split_once('=').map_or("", |(name, _)| name).trim();
        let values = |graph: &Graph| -> Vec<f64> {
            let own = graph.params.iter();
            let own = own.filter(|p| p.name == name && p.role == Role::Param);
            own.map(|p| p.value).collect()
        };
        let (from, to) = (values(first), values(last));
        if from.is_empty() {
            let message = format!("--set {text}: `{name}` is a state, or was folded by --freeze");
            return Err(Failure::Usage(message));
        }
        let name = name.to_owned();
        sweeps.push(Sweep { name, from, to });
    }
    Ok(sweeps)
}

impl Sweep {
    /// Gives a graph the param's value in a picture.
    pub fn give(&self, picture: u32, pictures: u32, graph: &mut Graph) {
        let part = f64::from(picture) / f64::from(pictures.saturating_sub(1).max(1));
        let own = graph.params.iter_mut();
        let own = own.filter(|p| p.name == self.name && p.role == Role::Param);
        for (param, (from, to)) in own.zip(self.from.iter().zip(&self.to)) {
            let value = from + (to - from) * part;
            param.value = match param.ty {
                Type::Real => value,
                Type::Int | Type::Bool => value.round(),
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ends_of_a_range_are_values() {
        let changes = Changes {
            set: vec!["a=1".to_owned(), "b=0..90deg".to_owned()],
            ..Changes::default()
        };
        let (first, last) = ends(&changes).expect("ends").expect("a range");
        assert_eq!(first.set, ["a=1", "b=0"]);
        assert_eq!(last.set, ["a=1", "b=90deg"]);
        let set = vec!["b=0..".to_owned()];
        let changes = Changes { set, ..changes };
        assert!(matches!(ends(&changes), Err(Failure::Usage(_))));
    }
}
