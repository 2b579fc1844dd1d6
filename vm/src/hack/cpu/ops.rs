//! Instructions joined in advance.
//!
//! There is an operation for each address of the ROM, made of the longest run
//! of instructions from there that has one. A jump into the middle of a run
//! finds the operation that begins there.

use super::Ops;
use super::plain::halts;
use crate::hack::asm::ROM_WORDS;
use crate::hack::asm::instruction::{
    COMPUTE, DEST_A, DEST_D, DEST_M, JEQ, JGT, JLT, JMP, LARGEST, comp,
};

/// An operation, named for what it does. `D`, `A` and `M` are the computer's; an
/// operand `x`, `y`, `z` is the word at an address, `c` a constant, `to` where a
/// jump goes. Each is written as the instructions that it stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Op {
    /// Any one instruction.
    Any,
    /// `(END) @END 0;JMP`
    Ends,
    /// There is no instruction here.
    Away,
    /// `@c`, before what is not joined with it.
    Set(u16),

    /// `@x D=M`
    Load(u16),
    /// `@c D=A`
    Const(u16),
    /// `@x M=D`
    Store(u16),
    /// `@x D=D+M`, and so on
    Add(u16),
    Sub(u16),
    Rsub(u16),
    And(u16),
    Or(u16),
    /// `@c D=D+A`, and so on
    AddC(u16),
    SubC(u16),
    AndC(u16),
    /// `@x D=M+1`, and so on
    LoadInc(u16),
    LoadDec(u16),
    LoadNot(u16),
    LoadNeg(u16),
    /// `@x M=0`, and so on
    Clear(u16),
    One(u16),
    MinusOne(u16),
    /// `@x M=M+1`, and so on
    Inc(u16),
    Dec(u16),
    /// `@x M=D+M`, and so on
    AddTo(u16),
    SubTo(u16),
    /// `@x MD=M+1`, and so on
    IncD(u16),
    DecD(u16),
    AddToD(u16),
    SubToD(u16),
    /// `@x A=M`, and so on
    At(u16),
    AtInc(u16),
    AtDec(u16),
    AtAdd(u16),
    /// `@x AM=M+1`, and so on
    Push(u16),
    Pop(u16),
    /// `@to 0;JMP`, `@to D;JLT`, and so on
    Go(u16),
    IfLt(u16),
    IfLe(u16),
    IfEq(u16),
    IfNe(u16),
    IfGe(u16),
    IfGt(u16),

    /// `D=M`
    LoadM,
    /// `M=D`
    StoreM,
    /// `A=A+1`
    IncA,
    /// `A=A-1`
    DecA,
    /// `D=0`
    Zero,
    /// `A=M`
    AtM,
    /// `A=D`
    AtD,
    /// `0;JMP`
    GoA,

    /// `@x A=M D=M`
    LoadAt(u16),
    /// `@x A=M M=D`
    StoreAt(u16),
    /// `@x A=M 0;JMP`
    GoAt(u16),
    /// `@c D=A @x A=D+M D=M`
    Field(u16, u16),
    /// `@x D=M @y A=D+M D=M`
    Element(u16, u16),
    /// `@x D=M @y M=D`
    Move(u16, u16),
    /// `@c D=A @y M=D`
    Put(u16, u16),
    /// `@x M=D @y D=M`
    StoreLoad(u16, u16),
    /// `@x D=M @y D=D+M`, and so on
    Add2(u16, u16),
    Sub2(u16, u16),
    And2(u16, u16),
    /// `@x D=M @c D=D+A`, and so on
    Add2C(u16, u16),
    Sub2C(u16, u16),
    And2C(u16, u16),
    /// `@x D=M @y D=D+M @z M=D`, and so on
    Add3(u16, u16, u16),
    Sub3(u16, u16, u16),
    /// `@c D=A @to 0;JMP`: a call
    Call(u16, u16),
    /// `@x D=M @to D;JEQ`, and so on
    LoadIfLt(u16, u16),
    LoadIfEq(u16, u16),
    LoadIfNe(u16, u16),
    LoadIfGt(u16, u16),
    /// `@c D=D-A @to D;JLT`, and so on
    SubIfLt(u16, u16),
    SubIfGe(u16, u16),
    SubIfGt(u16, u16),
    SubIfEq(u16, u16),
    SubIfNe(u16, u16),
}

/// The most instructions of an operation.
pub(super) const LONGEST: u64 = 6;

const fn to(dest: u16, what: u16) -> u16 {
    COMPUTE | what << 6 | dest
}

const fn jump(what: u16, condition: u16) -> u16 {
    COMPUTE | what << 6 | condition
}

const LOAD: u16 = to(DEST_D, comp::M);
const CONST: u16 = to(DEST_D, comp::A);
const STORE: u16 = to(DEST_M, comp::D);
const ADD: u16 = to(DEST_D, comp::D_PLUS_M);
const SUB: u16 = to(DEST_D, comp::D_MINUS_M);
const RSUB: u16 = to(DEST_D, comp::M_MINUS_D);
const AND: u16 = to(DEST_D, comp::D_AND_M);
const OR: u16 = to(DEST_D, comp::D_OR_M);
const ADD_C: u16 = to(DEST_D, comp::D_PLUS_A);
const SUB_C: u16 = to(DEST_D, comp::D_MINUS_A);
const AND_C: u16 = to(DEST_D, comp::D_AND_A);
const LOAD_INC: u16 = to(DEST_D, comp::M_PLUS_1);
const LOAD_DEC: u16 = to(DEST_D, comp::M_MINUS_1);
const LOAD_NOT: u16 = to(DEST_D, comp::NOT_M);
const LOAD_NEG: u16 = to(DEST_D, comp::NEG_M);
const CLEAR: u16 = to(DEST_M, comp::ZERO);
const ONE: u16 = to(DEST_M, comp::ONE);
const MINUS_ONE: u16 = to(DEST_M, comp::MINUS_ONE);
const INC: u16 = to(DEST_M, comp::M_PLUS_1);
const DEC: u16 = to(DEST_M, comp::M_MINUS_1);
const ADD_TO: u16 = to(DEST_M, comp::D_PLUS_M);
const SUB_TO: u16 = to(DEST_M, comp::M_MINUS_D);
const BOTH: u16 = DEST_M | DEST_D;
const INC_D: u16 = to(BOTH, comp::M_PLUS_1);
const DEC_D: u16 = to(BOTH, comp::M_MINUS_1);
const ADD_TO_D: u16 = to(BOTH, comp::D_PLUS_M);
const SUB_TO_D: u16 = to(BOTH, comp::M_MINUS_D);
const AT: u16 = to(DEST_A, comp::M);
const AT_INC: u16 = to(DEST_A, comp::M_PLUS_1);
const AT_DEC: u16 = to(DEST_A, comp::M_MINUS_1);
const AT_ADD: u16 = to(DEST_A, comp::D_PLUS_M);
const AT_D: u16 = to(DEST_A, comp::D);
const PUSH: u16 = to(DEST_A | DEST_M, comp::M_PLUS_1);
const POP: u16 = to(DEST_A | DEST_M, comp::M_MINUS_1);
const INC_A: u16 = to(DEST_A, comp::A_PLUS_1);
const DEC_A: u16 = to(DEST_A, comp::A_MINUS_1);
const ZERO: u16 = to(DEST_D, comp::ZERO);
const GO: u16 = jump(comp::ZERO, JMP);
const IF_LT: u16 = jump(comp::D, JLT);
const IF_LE: u16 = jump(comp::D, JLT | JEQ);
const IF_EQ: u16 = jump(comp::D, JEQ);
const IF_NE: u16 = jump(comp::D, JLT | JGT);
const IF_GE: u16 = jump(comp::D, JGT | JEQ);
const IF_GT: u16 = jump(comp::D, JGT);

/// An operation for each address.
pub(super) fn join(rom: &[u16]) -> Box<Ops> {
    let mut ops: Box<Ops> = Box::new([Op::Away; ROM_WORDS]);
    for (at, op) in (0..).zip(ops.iter_mut().take(rom.len())) {
        // Not over the program's end, which a jump or the run before leads to.
        let most = at + LONGEST as u16;
        let end = (at + 1..most)
            .find(|next| halts(rom, *next))
            .unwrap_or(most);
        let end = usize::from(end).min(rom.len());
        let window = rom.get(usize::from(at)..end).unwrap_or(&[]);
        *op = if halts(rom, at) {
            Op::Ends
        } else {
            three(window)
                .or_else(|| two(window))
                .or_else(|| pair(window))
                .unwrap_or_else(|| one(window))
        };
    }
    ops
}

fn is_value(words: &[&u16]) -> bool {
    words.iter().all(|word| **word <= LARGEST)
}

fn three(window: &[u16]) -> Option<Op> {
    match window {
        [x, LOAD, y, AT_ADD, LOAD, ..] if is_value(&[x, y]) => Some(Op::Element(*x, *y)),
        [c, CONST, x, AT_ADD, LOAD, ..] if is_value(&[c, x]) => Some(Op::Field(*c, *x)),
        [x, LOAD, y, ADD, z, STORE, ..] if is_value(&[x, y, z]) => Some(Op::Add3(*x, *y, *z)),
        [x, LOAD, y, SUB, z, STORE, ..] if is_value(&[x, y, z]) => Some(Op::Sub3(*x, *y, *z)),
        _ => None,
    }
}

fn two(window: &[u16]) -> Option<Op> {
    if let [x, AT, last, ..] = window
        && is_value(&[x])
    {
        return match *last {
            LOAD => Some(Op::LoadAt(*x)),
            STORE => Some(Op::StoreAt(*x)),
            GO => Some(Op::GoAt(*x)),
            _ => None,
        };
    }
    let [x, first, y, second, ..] = window else {
        return None;
    };
    if !is_value(&[x, y]) {
        return None;
    }
    let op = match (*first, *second) {
        (LOAD, STORE) => Op::Move,
        (CONST, STORE) => Op::Put,
        (STORE, LOAD) => Op::StoreLoad,
        (LOAD, ADD) => Op::Add2,
        (LOAD, SUB) => Op::Sub2,
        (LOAD, AND) => Op::And2,
        (LOAD, ADD_C) => Op::Add2C,
        (LOAD, SUB_C) => Op::Sub2C,
        (LOAD, AND_C) => Op::And2C,
        (CONST, GO) => Op::Call,
        (LOAD, IF_LT) => Op::LoadIfLt,
        (LOAD, IF_EQ) => Op::LoadIfEq,
        (LOAD, IF_NE) => Op::LoadIfNe,
        (LOAD, IF_GT) => Op::LoadIfGt,
        (SUB_C, IF_LT) => Op::SubIfLt,
        (SUB_C, IF_GE) => Op::SubIfGe,
        (SUB_C, IF_GT) => Op::SubIfGt,
        (SUB_C, IF_EQ) => Op::SubIfEq,
        (SUB_C, IF_NE) => Op::SubIfNe,
        _ => return None,
    };
    Some(op(*x, *y))
}

fn pair(window: &[u16]) -> Option<Op> {
    let [x, second, ..] = window else {
        return None;
    };
    if !is_value(&[x]) {
        return None;
    }
    let op = match *second {
        LOAD => Op::Load,
        CONST => Op::Const,
        STORE => Op::Store,
        ADD => Op::Add,
        SUB => Op::Sub,
        RSUB => Op::Rsub,
        AND => Op::And,
        OR => Op::Or,
        ADD_C => Op::AddC,
        SUB_C => Op::SubC,
        AND_C => Op::AndC,
        LOAD_INC => Op::LoadInc,
        LOAD_DEC => Op::LoadDec,
        LOAD_NOT => Op::LoadNot,
        LOAD_NEG => Op::LoadNeg,
        CLEAR => Op::Clear,
        ONE => Op::One,
        MINUS_ONE => Op::MinusOne,
        INC => Op::Inc,
        DEC => Op::Dec,
        ADD_TO => Op::AddTo,
        SUB_TO => Op::SubTo,
        INC_D => Op::IncD,
        DEC_D => Op::DecD,
        ADD_TO_D => Op::AddToD,
        SUB_TO_D => Op::SubToD,
        AT => Op::At,
        AT_INC => Op::AtInc,
        AT_DEC => Op::AtDec,
        AT_ADD => Op::AtAdd,
        PUSH => Op::Push,
        POP => Op::Pop,
        GO => Op::Go,
        IF_LT => Op::IfLt,
        IF_LE => Op::IfLe,
        IF_EQ => Op::IfEq,
        IF_NE => Op::IfNe,
        IF_GE => Op::IfGe,
        IF_GT => Op::IfGt,
        _ => return None,
    };
    Some(op(*x))
}

fn one(window: &[u16]) -> Op {
    match window.first() {
        Some(value @ 0..=LARGEST) => Op::Set(*value),
        Some(&LOAD) => Op::LoadM,
        Some(&STORE) => Op::StoreM,
        Some(&INC_A) => Op::IncA,
        Some(&DEC_A) => Op::DecA,
        Some(&ZERO) => Op::Zero,
        Some(&AT) => Op::AtM,
        Some(&AT_D) => Op::AtD,
        Some(&GO) => Op::GoA,
        _ => Op::Any,
    }
}
