//! Bit operations of ints on every target: machine, model and native picture alike.

use crate::cli::{directory, json};
use rayon::prelude::*;
use slowlight_compiler::targets::TARGETS;

/// Operands that no target knows beforehand, below 0 among them, and bits of every byte that the
/// Hack has.
const SCENE: &str = "image 16 x 12 inks black, red, white, yellow;
param a: int = 21930 in -30000 .. 30000;
param b: int = -4369 in -30000 .. 30000;
param n: int = 3 in 0 .. 14;
fn low(v: int) -> int = bit_and(v, 3);
draw (x, y) = {
  let p = a - 37 * x;
  let q = b + 1001 * y;
  let both = bit_xor(bit_or(p, q), bit_and(p, shr(q, 2)));
  let row = if y mod 4 == 0 then low(bit_or(p, q))
    else if y mod 4 == 1 then low(shr(bit_xor(p, q), n))
    else if y mod 4 == 2 then low(shr(both, x mod 8))
    else low(shr(bit_or(shl(x, bit_and(n, 7)), bit_xor(y, -1)), n - 1));
  ink(row)
};";

#[test]
fn bits_are_the_same_everywhere() {
    let dir = directory(&[("bits.scn", SCENE)]);
    let path = dir.path();
    TARGETS.par_iter().for_each(|target| {
        for more in [&[][..], &["--set", "a=-1", "--set", "n=14"]] {
            let args = ["run", "bits.scn", "-t", target.name, "--json"];
            let found = json(path, &[&args[..], more].concat());
            assert_eq!(found["differs_from_model"], 0, "{} {more:?}", target.name);
            assert_eq!(found["differs_from_native"], 0, "{} {more:?}", target.name);
        }
    });
}
