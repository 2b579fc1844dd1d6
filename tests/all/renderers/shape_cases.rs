//! Which shapes of the library are held against sixty digits, and how closely.
//!
//! The files of `tests/shapes/` say which: a line is
//!
//! ```text
//! analytic | SHAPE | FACETS | ROOT | REGION
//! combined | SHAPE | FACETS | ROOT | REGION
//! searched | SHAPE | FACETS | ROOT | REGION
//! claim | EXPRESSION
//! ```
//!
//! FACETS (`f`, `dist`) are those whose derived gradient is held against
//! central differences of the facet at a thousand random points. Hits along a
//! thousand random rays, and along tangents (pairs of rays 2^-40 apart of which
//! one hits and one misses), are where the `f` of ROOT (without one: SHAPE)
//! changes its sign, within REGION if there is one, and nowhere before: signs
//! and dips between equal steps are followed up with sixty digits. The normal
//! at each hit is the gradient. `analytic` hits are right to what rounding the
//! coefficients moves them by; so are `combined` ones, which may miss what is
//! thinner than the offset that keeps rays off surfaces. `searched` shapes are
//! found by steps, to 1e-8, and rays that meet them at less than 2 degrees may
//! miss them.
//! A claim holds at every point `p` of a grid.

use slowlight_compiler::prelude::PRELUDE;
use slowlight_compiler::syntax::parse;
use slowlight_compiler::syntax::tree::ItemKind;
use std::path::Path;

/// A line of the table.
pub(super) struct Case {
    pub(super) shape: String,
    pub(super) facets: Vec<String>,
    pub(super) root: String,
    pub(super) region: Option<String>,
    pub(super) kind: &'static Kind,
}

/// How a shape's hits are found, and so what may be asked of them.
pub(super) struct Kind {
    pub(super) name: &'static str,
    pub(super) rays: usize,
    pub(super) tangents: usize,
    /// How far off a hit may be, in terms of `f`.
    pub(super) tolerance: f64,
    /// How deep a ray may go in unseen, where it comes out again.
    pub(super) depth: f64,
    /// How slowly `f` may change where a ray that crosses it is not seen to.
    pub(super) grazing: f64,
}

const KINDS: [Kind; 3] = [
    Kind {
        name: "analytic",
        rays: 1000,
        tangents: 100,
        tolerance: 1e-12,
        depth: 1e-12,
        grazing: 0.0,
    },
    Kind {
        name: "combined",
        rays: 1000,
        tangents: 60,
        tolerance: 1e-12,
        depth: 2e-9,
        grazing: 0.0,
    },
    Kind {
        name: "searched",
        rays: 250,
        tangents: 20,
        tolerance: 1e-8,
        depth: 3e-4,
        grazing: 0.035,
    },
];

/// The lines of every file, comments left out.
pub(super) fn lines() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/shapes");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .collect();
    files.sort();
    let texts = files.iter().map(|f| std::fs::read_to_string(f).unwrap());
    let all: Vec<String> = texts
        .flat_map(|t| t.lines().map(str::to_owned).collect::<Vec<_>>())
        .collect();
    let said = |l: &String| !l.trim().is_empty() && !l.starts_with("//");
    all.into_iter().filter(said).collect()
}

/// Every shape's line.
pub(super) fn cases() -> Vec<Case> {
    let mut found = Vec::new();
    for line in lines() {
        let parts: Vec<&str> = line.split('|').map(str::trim).collect();
        if parts[0] == "claim" {
            continue;
        }
        let kind = KINDS.iter().find(|k| k.name == parts[0]);
        found.push(Case {
            shape: parts[1].to_owned(),
            facets: parts[2].split_whitespace().map(str::to_owned).collect(),
            root: parts.get(3).unwrap_or(&parts[1]).to_string(),
            region: parts.get(4).map(|r| r.to_string()),
            kind: kind.unwrap_or_else(|| panic!("{line}")),
        });
    }
    found
}

/// A shape that nobody put into the table would be held against nothing.
#[test]
fn every_shape_of_the_library_is_in_the_table() {
    let table = lines().join("\n");
    for (_, text) in PRELUDE {
        let (file, said) = parse(text, 0);
        assert!(said.is_empty(), "{said:?}");
        for item in &file.items {
            if let ItemKind::Shape { name, .. } = &item.kind {
                let call = format!(" {}(", name.text);
                assert!(table.contains(&call), "{}", name.text);
            }
        }
    }
}
