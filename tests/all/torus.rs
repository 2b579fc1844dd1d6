//! What it is worth to solve for hits instead of marching to them.
#![allow(clippy::unwrap_used)]

use crate::cli::{directory, json};

/// Every sixty-fourth row of torus.scn, beside the same scene by sphere tracing.
#[test]
fn a_traced_torus_costs_a_third_of_a_marched_one() {
    let dir = directory(&[
        ("trace.scn", include_str!("../../examples/torus.scn")),
        ("march.scn", include_str!("../../examples/torus-march.scn")),
    ]);
    let cycles = |scene: &str, row: u32| {
        let rows = format!("{row}..{row}");
        let args = ["run", scene, "-t", "bbc:micro", "--rows", &rows, "--json"];
        let said = json(dir.path(), &args);
        // Both draw the whole width.
        assert_eq!(
            (said["mode"].as_u64(), said["width"].as_u64()),
            (Some(0), Some(512))
        );
        assert_eq!(said["differs_from_model"], 0, "{scene} {row}");
        assert_eq!(said["differs_from_native"], 0, "{scene} {row}");
        said["cycles"].as_u64().unwrap()
    };
    let sum = |scene| {
        (32..256)
            .step_by(64)
            .map(|row| cycles(scene, row))
            .sum::<u64>()
    };
    let (traced, marched) = (sum("trace.scn"), sum("march.scn"));
    assert!(3 * traced <= marched, "{traced} of {marched} cycles");
}
