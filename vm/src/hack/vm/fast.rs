//! The fused engine: runs operations that stand for several commands each.
//!
//! It holds SP in a register; all else is in the RAM. What it leaves to the
//! plain engine it leaves before having done any of it.

use super::access::{address, get, is_far, set};
use super::command::{ARG, Binary, FRAME, LCL, Memory, SCREEN, SP, THAT, THIS};
use super::fuse::{Fused, Op};
use super::machine::{EFFORT_LIMIT, Machine};
use super::os::{self, Native, Trap};

/// Why the fused engine stopped. The state is that of the real machine.
#[derive(Debug)]
pub(super) enum Exit {
    /// It is time to look at the limit and the watcher.
    Pause,
    /// The next command is for the plain engine.
    Plain,
    /// The next command was executed, and failed.
    Trap(Trap),
}

impl Machine<'_> {
    /// Runs from operation `at` until about `pause` commands have been executed.
    pub(super) fn fast(&mut self, fused: &Fused, at: usize, pause: u64) -> Exit {
        let memory: &mut Memory = &mut self.memory;
        let os = &mut self.os;
        let cells = fused.cells.as_slice();
        let mut next = at;
        let mut count = self.count;
        let mut sp = memory[usize::from(SP)];

        macro_rules! push {
            ($value:expr) => {{
                let value = $value;
                memory[usize::from(sp)] = value;
                sp = sp.wrapping_add(1);
            }};
        }
        macro_rules! pop {
            () => {{
                sp = sp.wrapping_sub(1);
                memory[usize::from(sp)]
            }};
        }
        let exit = loop {
            let Some(cell) = cells.get(next) else {
                break Exit::Plain;
            };
            next += 1;
            count += u64::from(cell.commands);

            // Leaves this operation to the plain engine.
            macro_rules! plain {
                () => {{
                    next -= 1;
                    count -= u64::from(cell.commands);
                    break Exit::Plain;
                }};
            }
            macro_rules! jump {
                ($to:expr) => {{
                    next = $to.index();
                    if count >= pause {
                        break Exit::Pause;
                    }
                }};
            }
            // An operation on the stack, on the stack and a place, on places.
            macro_rules! zero {
                ($op:ident) => {{
                    let y = pop!();
                    let x = memory[usize::from(sp.wrapping_sub(1))];
                    memory[usize::from(sp.wrapping_sub(1))] = Binary::$op.apply(x, y);
                }};
            }
            macro_rules! one {
                ($b:ident, $op:ident) => {{
                    let y = get(memory, $b);
                    let x = memory[usize::from(sp.wrapping_sub(1))];
                    memory[usize::from(sp.wrapping_sub(1))] = Binary::$op.apply(x, y);
                }};
            }
            macro_rules! two {
                ($a:ident, $b:ident, $op:ident) => {{
                    let (x, y) = (get(memory, $a), get(memory, $b));
                    push!(Binary::$op.apply(x, y))
                }};
            }
            macro_rules! one_to {
                ($b:ident, $to:ident, $op:ident) => {{
                    let y = get(memory, $b);
                    let x = pop!();
                    set(memory, $to, Binary::$op.apply(x, y));
                }};
            }
            macro_rules! two_to {
                ($a:ident, $b:ident, $to:ident, $op:ident) => {{
                    let (x, y) = (get(memory, $a), get(memory, $b));
                    set(memory, $to, Binary::$op.apply(x, y));
                }};
            }
            macro_rules! if0 {
                ($to:ident, $op:ident, $holds:literal) => {{
                    let y = pop!();
                    let x = pop!();
                    if (Binary::$op.apply(x, y) != 0) == $holds {
                        jump!($to)
                    }
                }};
            }
            macro_rules! if1 {
                ($b:ident, $to:ident, $op:ident, $holds:literal) => {{
                    let y = get(memory, $b);
                    let x = pop!();
                    if (Binary::$op.apply(x, y) != 0) == $holds {
                        jump!($to)
                    }
                }};
            }
            macro_rules! if2 {
                ($a:ident, $b:ident, $to:ident, $op:ident, $holds:literal) => {{
                    let (x, y) = (get(memory, $a), get(memory, $b));
                    if (Binary::$op.apply(x, y) != 0) == $holds {
                        jump!($to)
                    }
                }};
            }

            match cell.op {
                Op::Plain => plain!(),
                Op::Push(a) => push!(get(memory, a)),
                Op::PushTwo(a, b) => {
                    let (a, b) = (get(memory, a), get(memory, b));
                    push!(a);
                    push!(b);
                }
                Op::PushWord(word) => push!(word),
                Op::PushField(a) => {
                    let a = address(memory, a);
                    if !is_far(a) {
                        plain!();
                    }
                    push!(memory[usize::from(a)]);
                }
                Op::Pop(to) => {
                    let value = pop!();
                    set(memory, to, value);
                }
                Op::PopField(to) => {
                    let to = address(memory, to);
                    if !is_far(to) {
                        plain!();
                    }
                    memory[usize::from(to)] = pop!();
                    if to >= SCREEN {
                        os.drew(to);
                    }
                }
                Op::Move(a, to) => {
                    let value = get(memory, a);
                    set(memory, to, value);
                }
                Op::FieldTo(a, to) => {
                    let a = address(memory, a);
                    if !is_far(a) {
                        plain!();
                    }
                    let value = memory[usize::from(a)];
                    set(memory, to, value);
                }
                Op::ToField(a, to) => {
                    let to = address(memory, to);
                    if !is_far(to) {
                        plain!();
                    }
                    memory[usize::from(to)] = get(memory, a);
                    if to >= SCREEN {
                        os.drew(to);
                    }
                }
                Op::Neg => {
                    let top = &mut memory[usize::from(sp.wrapping_sub(1))];
                    *top = top.wrapping_neg();
                }
                Op::Not => {
                    let top = &mut memory[usize::from(sp.wrapping_sub(1))];
                    *top = !*top;
                }

                Op::Add0 => zero!(Add),
                Op::Sub0 => zero!(Sub),
                Op::And0 => zero!(And),
                Op::Or0 => zero!(Or),
                Op::Eq0 => zero!(Eq),
                Op::Gt0 => zero!(Gt),
                Op::Lt0 => zero!(Lt),
                Op::Add1(b) => one!(b, Add),
                Op::Sub1(b) => one!(b, Sub),
                Op::And1(b) => one!(b, And),
                Op::Or1(b) => one!(b, Or),
                Op::Eq1(b) => one!(b, Eq),
                Op::Gt1(b) => one!(b, Gt),
                Op::Lt1(b) => one!(b, Lt),
                Op::Add2(a, b) => two!(a, b, Add),
                Op::Sub2(a, b) => two!(a, b, Sub),
                Op::And2(a, b) => two!(a, b, And),
                Op::Or2(a, b) => two!(a, b, Or),
                Op::Eq2(a, b) => two!(a, b, Eq),
                Op::Gt2(a, b) => two!(a, b, Gt),
                Op::Lt2(a, b) => two!(a, b, Lt),
                Op::Add1To(b, to) => one_to!(b, to, Add),
                Op::Sub1To(b, to) => one_to!(b, to, Sub),
                Op::And1To(b, to) => one_to!(b, to, And),
                Op::Or1To(b, to) => one_to!(b, to, Or),
                Op::Add2To(a, b, to) => two_to!(a, b, to, Add),
                Op::Sub2To(a, b, to) => two_to!(a, b, to, Sub),
                Op::And2To(a, b, to) => two_to!(a, b, to, And),
                Op::Or2To(a, b, to) => two_to!(a, b, to, Or),

                Op::Fetch0 => {
                    let y = memory[usize::from(sp.wrapping_sub(1))];
                    let x = memory[usize::from(sp.wrapping_sub(2))];
                    let a = x.wrapping_add(y);
                    if !is_far(a) {
                        plain!();
                    }
                    memory[usize::from(THAT)] = a;
                    sp = sp.wrapping_sub(1);
                    memory[usize::from(sp.wrapping_sub(1))] = memory[usize::from(a)];
                }
                Op::Fetch1(b) => {
                    let x = memory[usize::from(sp.wrapping_sub(1))];
                    let a = x.wrapping_add(get(memory, b));
                    if !is_far(a) {
                        plain!();
                    }
                    memory[usize::from(THAT)] = a;
                    memory[usize::from(sp.wrapping_sub(1))] = memory[usize::from(a)];
                }
                Op::Fetch2(a, b) => {
                    let a = get(memory, a).wrapping_add(get(memory, b));
                    if !is_far(a) {
                        plain!();
                    }
                    memory[usize::from(THAT)] = a;
                    push!(memory[usize::from(a)]);
                }
                Op::Fetch2To(a, b, to) => {
                    let a = get(memory, a).wrapping_add(get(memory, b));
                    if !is_far(a) {
                        plain!();
                    }
                    memory[usize::from(THAT)] = a;
                    let value = memory[usize::from(a)];
                    set(memory, to, value);
                }
                Op::Store(temp) => {
                    let to = memory[usize::from(sp.wrapping_sub(2))];
                    if !is_far(to) {
                        plain!();
                    }
                    let value = pop!();
                    sp = sp.wrapping_sub(1);
                    set(memory, temp, value);
                    memory[usize::from(THAT)] = to;
                    memory[usize::from(to)] = value;
                    if to >= SCREEN {
                        os.drew(to);
                    }
                }

                Op::Goto(to) => jump!(to),
                Op::If(to) => {
                    if pop!() != 0 {
                        jump!(to)
                    }
                }
                Op::IfNot(to) => {
                    if pop!() != u16::MAX {
                        jump!(to)
                    }
                }
                Op::If1(a, to) => {
                    if get(memory, a) != 0 {
                        jump!(to)
                    }
                }
                Op::IfNot1(a, to) => {
                    if get(memory, a) != u16::MAX {
                        jump!(to)
                    }
                }
                Op::IfEq0(to) => if0!(to, Eq, true),
                Op::IfNe0(to) => if0!(to, Eq, false),
                Op::IfLt0(to) => if0!(to, Lt, true),
                Op::IfGe0(to) => if0!(to, Lt, false),
                Op::IfGt0(to) => if0!(to, Gt, true),
                Op::IfLe0(to) => if0!(to, Gt, false),
                Op::IfEq1(b, to) => if1!(b, to, Eq, true),
                Op::IfNe1(b, to) => if1!(b, to, Eq, false),
                Op::IfLt1(b, to) => if1!(b, to, Lt, true),
                Op::IfGe1(b, to) => if1!(b, to, Lt, false),
                Op::IfGt1(b, to) => if1!(b, to, Gt, true),
                Op::IfLe1(b, to) => if1!(b, to, Gt, false),
                Op::IfEq2(a, b, to) => if2!(a, b, to, Eq, true),
                Op::IfNe2(a, b, to) => if2!(a, b, to, Eq, false),
                Op::IfLt2(a, b, to) => if2!(a, b, to, Lt, true),
                Op::IfGe2(a, b, to) => if2!(a, b, to, Lt, false),
                Op::IfGt2(a, b, to) => if2!(a, b, to, Gt, true),
                Op::IfLe2(a, b, to) => if2!(a, b, to, Gt, false),

                Op::Call {
                    target,
                    arguments,
                    locals,
                    room,
                    site,
                } => {
                    if sp.wrapping_add(FRAME) > room {
                        plain!();
                    }
                    let first = sp.wrapping_sub(arguments);
                    push!(site);
                    for cell in [LCL, ARG, THIS, THAT] {
                        push!(memory[usize::from(cell)]);
                    }
                    memory[usize::from(ARG)] = first;
                    memory[usize::from(LCL)] = sp;
                    for _ in 0..locals {
                        push!(0);
                    }
                    jump!(target);
                }
                Op::Return => {
                    let frame = memory[usize::from(LCL)];
                    let saved = |back| usize::from(frame.wrapping_sub(back));
                    let site = memory[saved(FRAME)];
                    let to = match fused.sites.get(usize::from(site)) {
                        Some(to) if (*to as usize) < cells.len() => *to as usize,
                        _ => plain!(),
                    };
                    let argument = memory[usize::from(ARG)];
                    memory[usize::from(argument)] = pop!();
                    memory[usize::from(THAT)] = memory[saved(1)];
                    memory[usize::from(THIS)] = memory[saved(2)];
                    memory[usize::from(ARG)] = memory[saved(3)];
                    memory[usize::from(LCL)] = memory[saved(4)];
                    sp = argument.wrapping_add(1);
                    next = to;
                    if count >= pause {
                        break Exit::Pause;
                    }
                }
                Op::Multiply => {
                    os.calls[Native::Multiply as usize] += 1;
                    let y = pop!();
                    let top = &mut memory[usize::from(sp.wrapping_sub(1))];
                    *top = top.wrapping_mul(y);
                }
                Op::Divide => {
                    let y = memory[usize::from(sp.wrapping_sub(1))];
                    let x = memory[usize::from(sp.wrapping_sub(2))];
                    let Some(quotient) = os::divide(x, y) else {
                        plain!()
                    };
                    os.calls[Native::Divide as usize] += 1;
                    sp = sp.wrapping_sub(1);
                    memory[usize::from(sp.wrapping_sub(1))] = quotient;
                }
                Op::Native(native) => {
                    memory[usize::from(SP)] = sp;
                    (os.now, os.place) = (count, next as u64);
                    match os::call(native, memory, os) {
                        Ok(result) => {
                            sp = sp.wrapping_sub(native.arguments());
                            push!(result);
                        }
                        Err(trap) => {
                            next -= 1;
                            break Exit::Trap(trap);
                        }
                    }
                    if os.odd || os.effort >= EFFORT_LIMIT {
                        break Exit::Pause;
                    }
                }
            }
        };
        memory[usize::from(SP)] = sp;
        self.count = count;
        self.at = fused.origins.get(next).copied().unwrap_or(u32::MAX);
        exit
    }
}
