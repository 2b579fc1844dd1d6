//! Which results may be smaller than the format's least magnitude.

use crate::log::routines::ALL;
use slowlight_routine::log::loose::least;
use slowlight_routine::log::model::LEAST;
use slowlight_routine::{Range, Routine};

fn routine(name: &str) -> &'static Routine {
    ALL.iter().find(|r| r.name == name).expect(name)
}

#[test]
fn nothing_minds_what_the_format_holds() {
    for routine in &ALL {
        let args = [Range::ALL, Range::ALL];
        let held = least(routine, &args, &[LEAST, LEAST]);
        assert!(
            held.is_some() || routine.name.starts_with("loose"),
            "{}",
            routine.name
        );
    }
}

#[test]
fn a_small_square_may_be_added_to_what_is_not_too_large() {
    let small = [LEAST + LEAST, LEAST];
    let of = |most: f64| [Range::new(-4.0, 4.0), Range::new(0.0, most)];
    assert_eq!(least(routine("sum"), &of(60.0), &small), Some(LEAST));
    assert_eq!(least(routine("sum"), &of(70.0), &small), None);
    assert_eq!(least(routine("low_mul"), &of(1.0), &small), None);
    assert_eq!(least(routine("floor"), &of(1.0), &small[..1]), None);
    for name in ["max_zero", "zero_max"] {
        assert_eq!(least(routine(name), &of(1.0), &small), None, "{name}");
    }
    let square = least(routine("loose_mul"), &of(1.0), &[LEAST, LEAST]);
    assert_eq!(square, Some(LEAST + LEAST));
}
