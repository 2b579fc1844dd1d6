//! What quotients by lengths become.

use super::tests::planned_in;
use crate::ir::tree::{Statement, walk};

/// How often a drawing of a direction takes each of some routines.
fn taken<const N: usize>(draw: &str, format: &str, names: [&str; N]) -> [usize; N] {
    let source = format!(
        "image 64 x 32 inks black, white;
         draw (x, y) = {{
           let way = ((x - 31.5) / 32, (15.5 - y) / 32, -1);
           {draw}
         }};"
    );
    let plan = planned_in(&source, format);
    let mut found = [0; N];
    for block in plan.tree.blocks() {
        walk(block, &mut |statement| {
            if let Statement::Let(id) = statement
                && let Some(routine) = plan.routine(*id)
            {
                for (times, name) in found.iter_mut().zip(names) {
                    *times += usize::from(routine.name.ends_with(name));
                }
            }
        });
    }
    found
}

/// A vector is divided by its length once, and a pixel's place by a constant never.
#[test]
fn quotients_by_one_length_are_products() {
    let names = ["div", "one_over", "reciprocal_root", "root"];
    let unit = "let v = unit(way); ink((floor(8 * v.x) + floor(8 * v.y) + floor(8 * v.z)) mod 2)";
    assert_eq!(taken(unit, "fixed16", names), [0, 0, 1, 1]);
    // Where there is no such table, a root and one over it.
    assert_eq!(taken(unit, "fixed24", names), [0, 1, 0, 1]);
    // One quotient by a root is a product too, by another length it is none.
    let one = "ink(floor(8 * way.y / length(way)) mod 2)";
    assert_eq!(taken(one, "fixed16", names), [0, 0, 1, 1]);
    let other = "ink(floor(8 * way.y / (length(way) + 1)) mod 2)";
    assert_eq!(taken(other, "fixed16", names), [1, 0, 0, 1]);
    // The root stays where it is read itself.
    let both = "let v = unit(way);
         ink((floor(8 * v.x) + floor(8 * v.y) + floor(8 * v.z) + floor(8 * length(way))) mod 2)";
    assert_eq!(taken(both, "fixed16", names), [0, 0, 1, 2]);
}
