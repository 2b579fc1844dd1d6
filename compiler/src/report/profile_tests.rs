#![allow(clippy::unwrap_used)]

use super::profile::*;
use crate::plan::Goal;
use crate::planner::plan;
use crate::scene::check;
use crate::sema::Options;
use crate::targets;

const SCENE: &str = "image 8 x 4 inks black, white;
param eye: vec3 = (0, 0, 3) in (-1, -1, 2) .. (1, 1, 4);
draw (x, y) = {
  let r = ray(eye, unit(((x - 3.5) / 4, (1.5 - y) / 4, -1)));
  if let h = sphere((0, 0, 0), 1).hit(r) then ink(1)
  else ink(if sin(r.dir.x * 3rad) * cos(r.dir.y * 3rad) > 0.2 then 1 else 0)
};
";

/// Every line of the programs costs its number; a routine of the last lines is called from
/// the first that has a place.
fn measured(name: &str) -> (Profile, u64, u64) {
    let scene = check("s.scn", SCENE);
    let target = targets::find(name).unwrap();
    let mode = targets::default_mode(target, 8, 4).unwrap();
    let graph = scene
        .lower(&Options {
            inks: Some(mode.inks),
            offset: target.offset,
            ..Options::default()
        })
        .unwrap();
    let goal = Goal {
        name: "s".to_owned(),
        mode,
        rows: None,
        plot: true,
    };
    let mut plan = plan(&graph, target, &goal).unwrap();
    plan.drawn = scene.program.draw.as_ref().map(|draw| draw.span);
    let documents = crate::backend::emit(&plan);
    let mut costs = Vec::new();
    let mut sizes = Vec::new();
    for (document, text) in documents.iter().enumerate() {
        for line in 0..text.lines.len() {
            let line = Line {
                document,
                line,
                statement: 0,
            };
            costs.push(Cost {
                line: Some(line),
                called: None,
                times: 1,
                cycles: line.line as u64,
            });
            sizes.push((line, 2));
        }
        // A line of BASIC may hold statements from several places.
        costs.extend(text.later.iter().map(|(line, statement, _)| Cost {
            line: Some(Line {
                document,
                line: *line,
                statement: *statement,
            }),
            called: None,
            times: 1,
            cycles: 3,
        }));
    }
    costs.push(Cost {
        line: None,
        called: None,
        times: 1,
        cycles: 1000,
    });
    let (cycles, size) = (costs.iter().map(|c| c.cycles).sum(), 2 * sizes.len() as u64);
    let measured = Measured {
        documents: &documents,
        costs: &costs,
        sizes: &sizes,
    };
    (profile(&scene, &plan, measured), cycles, size)
}

#[test]
fn every_cycle_and_every_byte_has_a_line() {
    for target in targets::in_all_formats() {
        let (found, cycles, size) = measured(target.name);
        assert_eq!(found.cycles, cycles, "{}", target.name);
        let of_lines: u64 = found.lines.iter().map(|line| line.cycles).sum();
        assert_eq!(of_lines + found.rest, cycles, "{}", target.name);
        assert_eq!(found.rest, 0, "{}", target.name);
        let sizes: u64 = found.lines.iter().map(|line| line.size).sum();
        assert_eq!(sizes + found.rest_size, size, "{}", target.name);
        for line in &found.lines {
            let parts: u64 = line.parts.iter().map(|part| part.cycles).sum();
            let within: u64 = line.within.iter().map(|part| part.cycles).sum();
            assert!(
                parts <= line.cycles && within <= line.cycles,
                "{}",
                target.name
            );
        }
    }
}

#[test]
fn lines_are_the_scenes_own() {
    for name in ["jack", "bbc:micro", "6502:plain"] {
        let (found, ..) = measured(name);
        let at = |number: usize| {
            found
                .lines
                .iter()
                .find(|line| line.line == number)
                .unwrap_or_else(|| panic!("{name}: line {number}"))
        };
        assert!(
            found
                .lines
                .iter()
                .all(|line| line.file == 0 && line.line <= 6),
            "{name}"
        );
        // The ray is computed in its line, the sphere by the library on behalf of its own.
        assert!(
            at(4).rate.contains(&"column") || at(4).rate.contains(&"row"),
            "{name}"
        );
        let within: Vec<&str> = at(5).within.iter().map(|part| part.name.as_str()).collect();
        assert!(
            within.iter().any(|name| name.contains(".scn:")),
            "{name}: {within:?}"
        );
        assert!(at(3).parts.iter().any(|part| part.name == FRAME), "{name}");
        assert!(at(1).parts.iter().any(|part| part.name == SET_UP), "{name}");
    }
}
