//! Which commands are joined into which operation.
//!
//! The patterns are those of Jack compilers: an expression of two operands
//! with or without a place to put it, a comparison with its jump, an array's
//! element read or written. The longest that fits is taken.

use super::command::{Binary, CONSTANTS, Command, Place, STATIC, TEMP, THAT};
use super::fuse::{Op, Target};
use super::os::Native;
use Binary::{Add, And, Eq, Gt, Lt, Or, Sub};
use Command::{IfGoto, Neg, Not, Pop, Push};

/// The address that `pop pointer 1` stores to, and the element it selects.
const POINTER_1: Place = Place::fixed(THAT);
const THAT_0: Place = Place {
    base: THAT,
    offset: 0,
};

/// The operation for the start of `window`, whose first command is `at`, and
/// how many commands it takes. A call's target is the number of the callee.
pub(super) fn join(at: u32, window: &[Command]) -> (Op, u32) {
    branch(window)
        .or_else(|| element(window))
        .or_else(|| expression(window))
        .or_else(|| transfer(window))
        .unwrap_or_else(|| (single(at, window), 1))
}

fn is_place(place: &Place) -> bool {
    !place.is_field()
}

/// A comparison, or just a word, and the jump that depends on it.
fn branch(window: &[Command]) -> Option<(Op, u32)> {
    let places = window
        .iter()
        .take(2)
        .take_while(|command| matches!(command, Push(place) if is_place(place)))
        .count();
    // Try with as many operands from places as there are.
    for count in (0..=places).rev() {
        let (operands, rest) = window.split_at_checked(count)?;
        let (condition, to, length) = match *rest {
            [Command::Binary(op), Not, IfGoto(to), ..] => (Some((op, false)), to, 3),
            [Command::Binary(op), IfGoto(to), ..] => (Some((op, true)), to, 2),
            [Not, IfGoto(to), ..] => (None, to, 2),
            [IfGoto(to), ..] => (None, to, 1),
            _ => continue,
        };
        let (to, length) = (Target::new(to), length + count as u32);
        let op = match (condition, operands) {
            (Some((op, holds)), []) => jump0(op, holds, to),
            (Some((op, holds)), [Push(b)]) => jump1(op, holds, *b, to),
            (Some((op, holds)), [Push(a), Push(b)]) => jump2(op, holds, *a, *b, to),
            (None, []) if rest.first() == Some(&Not) => Some(Op::IfNot(to)),
            (None, []) => Some(Op::If(to)),
            (None, [Push(a)]) if rest.first() == Some(&Not) => Some(Op::IfNot1(*a, to)),
            (None, [Push(a)]) => Some(Op::If1(*a, to)),
            _ => None,
        };
        if let Some(op) = op {
            return Some((op, length));
        }
    }
    None
}

fn jump0(op: Binary, holds: bool, to: Target) -> Option<Op> {
    Some(match (op, holds) {
        (Eq, true) => Op::IfEq0(to),
        (Eq, false) => Op::IfNe0(to),
        (Lt, true) => Op::IfLt0(to),
        (Lt, false) => Op::IfGe0(to),
        (Gt, true) => Op::IfGt0(to),
        (Gt, false) => Op::IfLe0(to),
        _ => return None,
    })
}

fn jump1(op: Binary, holds: bool, b: Place, to: Target) -> Option<Op> {
    Some(match (op, holds) {
        (Eq, true) => Op::IfEq1(b, to),
        (Eq, false) => Op::IfNe1(b, to),
        (Lt, true) => Op::IfLt1(b, to),
        (Lt, false) => Op::IfGe1(b, to),
        (Gt, true) => Op::IfGt1(b, to),
        (Gt, false) => Op::IfLe1(b, to),
        _ => return None,
    })
}

fn jump2(op: Binary, holds: bool, a: Place, b: Place, to: Target) -> Option<Op> {
    Some(match (op, holds) {
        (Eq, true) => Op::IfEq2(a, b, to),
        (Eq, false) => Op::IfNe2(a, b, to),
        (Lt, true) => Op::IfLt2(a, b, to),
        (Lt, false) => Op::IfGe2(a, b, to),
        (Gt, true) => Op::IfGt2(a, b, to),
        (Gt, false) => Op::IfLe2(a, b, to),
        _ => return None,
    })
}

/// An array's element.
fn element(window: &[Command]) -> Option<(Op, u32)> {
    let add = Command::Binary(Add);
    let (operands, rest) = match window {
        [Push(a), Push(b), rest @ ..] if is_place(a) && is_place(b) => ([Some(*a), Some(*b)], rest),
        [Push(b), rest @ ..] if is_place(b) => ([None, Some(*b)], rest),
        rest => ([None, None], rest),
    };
    let fetches = matches!(rest, [first, Pop(p), Push(e), ..]
        if *first == add && *p == POINTER_1 && *e == THAT_0);
    match (operands, rest) {
        ([Some(a), Some(b)], [_, _, _, Pop(to), ..]) if fetches && is_place(to) => {
            Some((Op::Fetch2To(a, b, *to), 6))
        }
        ([Some(a), Some(b)], _) if fetches => Some((Op::Fetch2(a, b), 5)),
        ([None, Some(b)], _) if fetches => Some((Op::Fetch1(b), 4)),
        ([None, None], _) if fetches => Some((Op::Fetch0, 3)),
        (_, [Pop(temp), Pop(pointer), Push(again), Pop(e), ..])
            if operands == [None, None]
                && is_temp(*temp)
                && temp == again
                && *pointer == POINTER_1
                && *e == THAT_0 =>
        {
            Some((Op::Store(*temp), 4))
        }
        _ => None,
    }
}

fn is_temp(place: Place) -> bool {
    place.base == CONSTANTS && (TEMP..STATIC).contains(&place.offset)
}

/// An operation on two words.
fn expression(window: &[Command]) -> Option<(Op, u32)> {
    match *window {
        [Push(a), Push(b), Command::Binary(op), Pop(to), ..]
            if [a, b, to].iter().all(is_place) && two_to(op, a, b, to).is_some() =>
        {
            two_to(op, a, b, to).map(|op| (op, 4))
        }
        [Push(a), Push(b), Command::Binary(op), ..] if is_place(&a) && is_place(&b) => {
            Some((two(op, a, b), 3))
        }
        [Push(b), Command::Binary(op), Pop(to), ..]
            if is_place(&b) && is_place(&to) && one_to(op, b, to).is_some() =>
        {
            one_to(op, b, to).map(|op| (op, 3))
        }
        [Push(b), Command::Binary(op), ..] if is_place(&b) => Some((one(op, b), 2)),
        _ => None,
    }
}

fn two_to(op: Binary, a: Place, b: Place, to: Place) -> Option<Op> {
    Some(match op {
        Add => Op::Add2To(a, b, to),
        Sub => Op::Sub2To(a, b, to),
        And => Op::And2To(a, b, to),
        Or => Op::Or2To(a, b, to),
        _ => return None,
    })
}

fn one_to(op: Binary, b: Place, to: Place) -> Option<Op> {
    Some(match op {
        Add => Op::Add1To(b, to),
        Sub => Op::Sub1To(b, to),
        And => Op::And1To(b, to),
        Or => Op::Or1To(b, to),
        _ => return None,
    })
}

fn two(op: Binary, a: Place, b: Place) -> Op {
    match op {
        Add => Op::Add2(a, b),
        Sub => Op::Sub2(a, b),
        And => Op::And2(a, b),
        Or => Op::Or2(a, b),
        Eq => Op::Eq2(a, b),
        Gt => Op::Gt2(a, b),
        Lt => Op::Lt2(a, b),
    }
}

fn one(op: Binary, b: Place) -> Op {
    match op {
        Add => Op::Add1(b),
        Sub => Op::Sub1(b),
        And => Op::And1(b),
        Or => Op::Or1(b),
        Eq => Op::Eq1(b),
        Gt => Op::Gt1(b),
        Lt => Op::Lt1(b),
    }
}

/// Words moved, or pushed together.
fn transfer(window: &[Command]) -> Option<(Op, u32)> {
    match *window {
        [Push(a), Neg, ..] => a.as_constant().map(|c| (Op::PushWord(c.wrapping_neg()), 2)),
        [Push(a), Not, ..] => a.as_constant().map(|c| (Op::PushWord(!c), 2)),
        [Push(a), Pop(to), ..] if is_place(&to) => Some(if a.is_field() {
            (Op::FieldTo(a, to), 2)
        } else {
            (Op::Move(a, to), 2)
        }),
        [Push(a), Pop(to), ..] if is_place(&a) => Some((Op::ToField(a, to), 2)),
        [Push(a), Push(b), ..] if is_place(&a) && is_place(&b) => Some((Op::PushTwo(a, b), 2)),
        _ => None,
    }
}

/// One command by itself.
fn single(at: u32, window: &[Command]) -> Op {
    match window.first() {
        Some(Push(a)) if a.is_field() => Op::PushField(*a),
        Some(Push(a)) => Op::Push(*a),
        Some(Pop(to)) if to.is_field() => Op::PopField(*to),
        Some(Pop(to)) => Op::Pop(*to),
        Some(Neg) => Op::Neg,
        Some(Not) => Op::Not,
        Some(Command::Binary(op)) => match op {
            Add => Op::Add0,
            Sub => Op::Sub0,
            And => Op::And0,
            Or => Op::Or0,
            Eq => Op::Eq0,
            Gt => Op::Gt0,
            Lt => Op::Lt0,
        },
        // A jump to itself ends the run, which the plain engine does.
        Some(Command::Goto(to)) if *to != at => Op::Goto(Target::new(*to)),
        Some(IfGoto(to)) => Op::If(Target::new(*to)),
        Some(Command::Return) => Op::Return,
        Some(Command::Native(Native::Multiply)) => Op::Multiply,
        Some(Command::Native(Native::Divide)) => Op::Divide,
        Some(Command::Native(native)) => Op::Native(*native),
        Some(Command::Call {
            function,
            arguments,
            site,
        }) => Op::Call {
            target: Target::new(*function),
            arguments: *arguments,
            locals: 0,
            room: 0,
            site: *site,
        },
        _ => Op::Plain,
    }
}
