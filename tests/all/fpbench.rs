//! The translator of `benches/fpbench`, on cores written by hand.

#[allow(dead_code)]
#[path = "../../benches/fpbench/core.rs"]
mod core;
#[path = "../../benches/fpbench/reader.rs"]
mod reader;
#[path = "../../benches/fpbench/within.rs"]
mod within;

use slowlight_compiler::scene;
use slowlight_routine::Range;
use within::{ends, may_hold};

fn said(text: &str) -> Result<core::Core, String> {
    core::core(&reader::read(text)[0]).expect("a core").1
}

#[test]
fn cores_become_scenes() {
    let one = said(
        "; a comment (with a bracket
         (FPCore (x y*) :name \"a (core)\" :precision binary32
           :pre (and (<= 1/2 x 3) (< -1e-2 y*) (> 2 y*))
           (let ([t (* x x)] [u 2]) (let* ([t (+ t u)] [v (sin t)]) (if (< t 3) (/ v y*) (- x)))))",
    );
    let one = one.expect("it can be said");
    assert_eq!(one.name, "a (core)");
    let inputs = [
        ("x".to_owned(), [0.5, 3.0]),
        ("y*".to_owned(), [-0.01, 2.0]),
    ];
    assert_eq!(one.inputs, inputs);
    let wanted = "  let l0 = (p0 * p0);\n  let l1 = 2.0;\n  let l2 = (l0 + l1);\n  \
                  let l3 = sin(l2 * 1rad);\n  shown((if (l2 < 3.0) then (l3 / p1) else (-p0)), x, y)";
    assert!(one.scene.contains(wanted), "{}", one.scene);
    let scene = scene::check("core", &one.scene);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
}

#[test]
fn what_cannot_be_said_says_why() {
    let why = |text: &str| said(text).err();
    let pre = ":pre (<= 0 x 1)";
    let none = |what: &str| Some(what.to_owned());
    assert_eq!(why("(FPCore (x) (+ x 1))"), none("an input has no range"));
    assert_eq!(
        why("(FPCore (x) :pre (<= 0 x) x)"),
        none("an input has no range")
    );
    assert_eq!(
        why(&format!("(FPCore (x) {pre} (cbrt x))")),
        none("the operation cbrt")
    );
    let turns = format!("(FPCore (x) {pre} (while (< x 1) ([x x (+ x 1)]) x))");
    assert_eq!(why(&turns), none("a loop"));
}

#[test]
fn preconditions_leave_out_only_what_they_exclude() {
    let pre = &reader::read("(and (<= 0 a 4) (<= 0 b 4) (> (+ a b) (* 2 3)))")[0];
    assert_eq!(ends(pre, "a"), [0.0, 4.0]);
    let at = |a: [f64; 2], b: [f64; 2]| {
        let range = |[lo, hi]: [f64; 2]| Range::new(lo, hi);
        may_hold(
            pre,
            &[("a".to_owned(), range(a)), ("b".to_owned(), range(b))],
        )
    };
    assert!(at([0.0, 4.0], [0.0, 4.0]));
    assert!(at([3.5, 3.5], [3.0, 3.0]));
    assert!(!at([3.0, 3.0], [3.0, 3.0]));
    assert!(!at([0.0, 2.0], [0.0, 4.0]));
    assert!(!at([5.0, 6.0], [3.0, 4.0]));
}
