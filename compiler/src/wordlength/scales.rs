//! Operand scales: at which scales operations read their operands, and how many fraction bits
//! their results can have.

use crate::analysis::points::widths::BYTE;
use crate::ir::graph::*;
use crate::wordlength::saturation::cuts_factor;
use slowlight_routine::scale::{self, FEWEST, FUNCTION, MOST, Scales, finest};
use slowlight_routine::{Op, Type};

/// Fraction bits that a result cannot have more of, given those that the operands have
/// room for, and those it has room for itself.
pub fn cap(graph: &Graph, of: (Op, [NodeId; 2]), own: (i8, u8), room: &[i8]) -> i8 {
    let finer = if own.1 > BYTE { wide(own.1) } else { 0 };
    given(graph, of, own, room, finer)
}

/// The same while it is still open what values are cut to. Where a product's cut cuts its
/// factor, how many bits it has is known only then; in a byte, which has few to lose, any
/// product may be cut.
pub fn uncut(graph: &Graph, of: (Op, [NodeId; 2]), own: (i8, u8), room: &[i8]) -> i8 {
    let (op, args) = of;
    match op == Op::Mul && (own.1 <= BYTE || cuts_factor(graph, args)) {
        true => finest(own.1),
        false => given(graph, of, own, room, 0),
    }
}

/// Those that the operands give a result, and a product so many more than their last places
/// count for where they are greatest.
fn given(
    graph: &Graph,
    (op, [a, b]): (Op, [NodeId; 2]),
    (result, bits): (i8, u8),
    room: &[i8],
    finer: i8,
) -> i8 {
    let [of_a, of_b] = [a, b].map(|id| room[id.0 as usize]);
    let long = long(bits);
    let most = match op {
        Op::Add if a == b => of_a - 1,
        Op::Add | Op::Sub | Op::Mod => of_a.min(of_b),
        // One of both: what is beyond the end of the other one's bits is, where it is read.
        Op::Min | Op::Max => of_a.max(of_b),
        Op::Neg | Op::Abs => of_a,
        // An int is whole at any scale, and saturates where it is read.
        Op::ToReal => finest(bits),
        Op::Mul => match (power(graph, a), power(graph, b)) {
            (_, Some(by)) => of_a + by,
            (Some(by), _) => of_b + by,
            // Where the product has room for less than its operands' greatest would make,
            // one of them is small, and the other one's last place counts for less.
            _ => {
                let last = of_a + of_b - long;
                (last + finer).max(of_a.min(of_b) - (long - result + 1).div_euclid(2))
            }
        },
        Op::Sqrt => (long + of_a).div_euclid(2),
        // Their tables have no more.
        Op::Tan | Op::Log => scale::sine(bits),
        // Their routines know no finer ones.
        Op::Exp | Op::Pow => MOST,
        _ => scale::given(op, bits).unwrap_or(finest(bits)),
    };
    most.clamp(FEWEST, finest(bits))
}

/// Bits of an operand of a product, without the sign: the product has so many more than
/// an operand where both have all.
fn long(bits: u8) -> i8 {
    bits as i8 - 1
}

/// The greatest magnitude in a table that is to have room. What is beyond all ints, a
/// threshold that nothing reaches, saturates above the others.
pub(super) fn greatest(graph: &Graph, table: TableId) -> f64 {
    let table = graph.tables.get(table.0 as usize);
    let entries = table.iter().flat_map(|t| &t.entries);
    let sizes: Vec<f64> = entries.map(|e| e.value().real().abs()).collect();
    let most = |sizes: &mut dyn Iterator<Item = &f64>| sizes.fold(0.0, |a, b| f64::max(a, *b));
    let all = most(&mut sizes.iter());
    let near = most(&mut sizes.iter().filter(|size| **size < BEYOND));
    match all < BEYOND || near == 0.0 {
        true => all,
        false => ABOVE * near,
    }
}

/// From where on entries of a table are beyond all ints, and how far above the others
/// they are then.
const BEYOND: f64 = 32768.0;
const ABOVE: f64 = 3.0;

/// By how many bits a product may be shorter than that all the same. Where its range leaves
/// room for them it has as many more fraction bits than its greatest operands' last places
/// count for: smaller ones count for less, a square's most of all.
///
/// In 24 bits products that are shorter by a byte are not dearer than those that have to be
/// shifted to where the upper half begins.
fn wide(bits: u8) -> i8 {
    match bits {
        24.. => 7,
        _ => 3,
    }
}

/// Which values are read as whole numbers alone.
pub(super) fn only_cut(graph: &Graph) -> Vec<bool> {
    let mut only = vec![true; graph.nodes.len()];
    let mut read = |id: NodeId| only[id.0 as usize] = false;
    for id in graph.ids() {
        let node = graph.node(id);
        if !matches!(node, Node::Apply(Op::Round | Op::Floor, _)) {
            node.operands().for_each(&mut read);
        }
    }
    graph.loops.iter().flat_map(Loop::roots).for_each(&mut read);
    graph.outputs().for_each(&mut read);
    only
}

/// The scale at which a constant is 1 or -1.
pub(super) fn power(graph: &Graph, id: NodeId) -> Option<i8> {
    let (scale, units) = least(graph, id)?;
    (units == 1.0).then_some(scale)
}

/// The fewest fraction bits with which a constant is exact, and its magnitude there.
fn least(graph: &Graph, id: NodeId) -> Option<(i8, f64)> {
    let value = graph.constant(id)?.real().abs();
    let units = |scale: i8| value * f64::from(scale).exp2();
    let whole = |scale: &i8| value > 0.0 && units(*scale).fract() == 0.0;
    let found = (FEWEST..=MOST).find(whole)?;
    Some((found, units(found)))
}

/// Small factors are multiplied by as they are.
const SMALL: f64 = 64.0;

/// The scales of an operation whose result has one; given each node's own fraction bits
/// and those it has room for in the bits that operands are read in, and whether the product of
/// operands at some scales is an int.
pub fn wanted(
    graph: &Graph,
    (op, [a, b]): (Op, [NodeId; 2]),
    (result, bits): (i8, u8),
    (own, room, read): (&[i8], &[i8], u8),
    fits: &dyn Fn([i8; 2], i8) -> bool,
) -> Scales {
    let long = long(read);
    let [of_a, of_b] = [a, b].map(|id| own[id.0 as usize]);
    let [room_a, room_b] = [a, b].map(|id| room[id.0 as usize]);
    let args = match op {
        Op::Add if a == b => [result + 1; 2],
        Op::Add | Op::Sub | Op::Min | Op::Max | Op::Mod | Op::Neg | Op::Abs | Op::ToReal => {
            [result; 2]
        }
        Op::Less | Op::LessEqual | Op::Equal | Op::Atan2 => {
            // Of an angle's legs only the ratio matters. What a constant is compared with
            // ends where the constant is read: nothing is above both.
            let fixed = |id: NodeId, of: i8, room: i8| match graph.constant(id) {
                Some(_) if op == Op::Atan2 => (FEWEST, room),
                Some(_) => (FEWEST, finest(bits)),
                None => (of, room),
            };
            let (a, b) = (fixed(a, of_a, room_a), fixed(b, of_b, room_b));
            [a.0.max(b.0).min(a.1).min(b.1); 2]
        }
        Op::Mul => match factor(graph, [a, b], result, (own, room), fits) {
            Some(args) => args,
            None => {
                let (own, room) = ([of_a, of_b], [room_a, room_b]);
                match middle(own, room, result).filter(|args| fits(*args, MIDDLE)) {
                    Some(args) => args,
                    None => product(own, room, result, long),
                }
            }
        },
        // From 0 to twice as many bits are divided out.
        Op::Div => {
            let bits = result + of_b - of_a;
            let raised = (bits - 2 * long).clamp(0, (room_a - of_a).max(0));
            let lowered = (bits - raised - 2 * long).max(0);
            [of_a + raised + bits.min(0), of_b - lowered]
        }
        // A byte's is that of half of two: no more bits count.
        Op::Sqrt if bits == BYTE => [2 * result + 1, 0],
        // Of at least one bit more.
        Op::Sqrt => {
            let most = 2 * result - 1;
            let least = (2 * result - long).min(room_a.max(of_a));
            [of_a.clamp(least.min(most), most), 0]
        }
        Op::Floor => [of_a.max(0), 0],
        Op::Round => [0, 0],
        // Half a turn fits where the point is furthest to the left.
        Op::Sin | Op::Cos | Op::Tan => {
            let least = long - 15;
            [of_a.clamp(least, (long - 2).min(FUNCTION)), 0]
        }
        // From -1 to 1.
        Op::Asin | Op::Acos => [scale::sine(bits), 0],
        // Beyond 32 every power saturates.
        Op::Exp => [of_a.clamp((long - 5).min(10), long.min(FUNCTION)), 0],
        Op::Log => [of_a.min(MOST), 0],
        Op::Pow => [of_a.min(MOST), of_b.clamp(5, long.min(FUNCTION))],
        _ => [of_a, of_b],
    };
    let result = match op.result() {
        Type::Real => result,
        _ => 0,
    };
    Scales { args, result }
}

/// A product with a constant that needs no rounding: by a power of two, or by a small
/// whole number of these.
fn factor(
    graph: &Graph,
    args: [NodeId; 2],
    result: i8,
    (own, room): (&[i8], &[i8]),
    fits: &dyn Fn([i8; 2], i8) -> bool,
) -> Option<[i8; 2]> {
    for (k, constant) in args.into_iter().enumerate() {
        let Some((scale, units)) = least(graph, constant) else {
            continue;
        };
        let other = args[1 - k].0 as usize;
        let of_other = result - scale;
        let mut scales = [of_other; 2];
        scales[k] = scale;
        let exact = (own[other]..=room[other]).contains(&of_other);
        if units == 1.0 || units <= SMALL && exact && fits(scales, 0) {
            return Some(scales);
        }
    }
    None
}

/// Where a product of few bits, a whole number's say, is rounded: the bits above a byte are
/// made at once, and operands need not be shifted further up.
const MIDDLE: i8 = 8;

/// Operands whose product is so much longer than the result, if there is room for that.
fn middle([a, b]: [i8; 2], [room_a, room_b]: [i8; 2], result: i8) -> Option<[i8; 2]> {
    let short = MIDDLE - (a + b - result);
    let up = short.clamp(0, (room_a - a).max(0));
    let rest = (short - up).clamp(0, (room_b - b).max(0));
    (short >= 0 && up + rest == short).then_some([a + up, b + rest])
}

/// Operands of all their bits, so that the product is rounded in its upper half.
fn product([mut a, mut b]: [i8; 2], [room_a, room_b]: [i8; 2], result: i8, most: i8) -> [i8; 2] {
    let short = match most - (a + b - result) {
        short if short <= wide(most as u8 + 1) => 0,
        short => short,
    };
    let up = short.clamp(0, (room_a - a).max(0));
    a += up;
    b += (short - up).clamp(0, (room_b - b).max(0));
    // No more than twice as long: what is further down counts for nothing.
    let long = (a + b - result - 2 * most - 1).max(0);
    [a - long, b]
}
