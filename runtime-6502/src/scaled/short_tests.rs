//! What is called where a program is to be short gives what is written out.
#![allow(clippy::unwrap_used)]

use super::kinds::SHORT;
use super::short;
use crate::tests::bench::Bench;
use slowlight_routine::{Form, Routine};

#[test]
fn what_is_short_gives_the_same() {
    let is_short =
        |r: &&Routine| matches!(r.form, Form::Statement(text) if short(text, 2).is_some());
    let all: Vec<&Routine> = SHORT
        .setting
        .runtime
        .routines
        .iter()
        .filter(is_short)
        .collect();
    let names: Vec<&str> = all.iter().map(|r| r.name).collect();
    for name in ["any_add", "any_sub", "abs"] {
        assert!(names.contains(&name), "{names:?}");
    }
    let edges = SHORT.edges();
    for routine in all {
        let [mut long, mut short] =
            [false, true].map(|calls| Bench::used(SHORT.setting, routine, (&[], 0), calls));
        for a in &edges {
            let seconds = match routine.args.len() {
                1 => &edges[..1],
                _ => &edges[..],
            };
            for b in seconds {
                let args = &[*a, *b][..routine.args.len()];
                let (found, expected) = (short.run(args).0, long.run(args).0);
                assert_eq!(found, expected, "{} {args:?}", routine.name);
            }
        }
    }
}
