//! The fast engine: an operation at a time, each of several instructions.

use super::ops::{LONGEST, Op};
use super::plain::{Registers, execute};
use super::{ADDRESS, Cpu};

/// Why an engine comes back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Exit {
    /// As many cycles as asked for have passed.
    Pause,
    /// The program has come to its end.
    Ended,
    /// There is no instruction.
    Away,
    /// The program waits for a key, and none is left.
    Waits,
}

impl Cpu {
    /// Runs until `pause` cycles have passed in all.
    pub(super) fn go_fast(&mut self, pause: u64) -> Exit {
        let enough = pause.saturating_sub(LONGEST - 1);
        let Cpu {
            ops, memory, rom, ..
        } = self;
        let Registers {
            mut a,
            mut d,
            mut at,
        } = self.registers;
        let mut count = self.count;

        /// The word at an address.
        macro_rules! word {
            ($address:expr) => {
                memory[usize::from($address & ADDRESS)]
            };
        }
        /// Instructions that end in `$last` in A, and so many of them.
        macro_rules! done {
            ($size:literal, $last:expr) => {{
                a = $last;
                at = at.wrapping_add($size);
                count += $size;
            }};
        }
        /// A jump behind so many instructions, A what it goes to.
        macro_rules! go {
            ($size:literal, $to:expr, $if:expr) => {{
                a = $to;
                count += $size;
                at = if $if {
                    $to & ADDRESS
                } else {
                    at.wrapping_add($size)
                };
            }};
        }
        /// A word changed where it is, and its new value.
        macro_rules! change {
            ($x:expr, |$m:ident| $value:expr) => {{
                let $m = word!($x);
                let value = $value;
                word!($x) = value;
                value
            }};
        }

        let exit = loop {
            if count >= enough {
                break Exit::Pause;
            }
            let signed = |word: u16| word.cast_signed();
            match ops[usize::from(at & ADDRESS)] {
                Op::Any => {
                    let word = rom.get(usize::from(at & ADDRESS)).copied().unwrap_or(0);
                    let mut registers = Registers { a, d, at };
                    execute(word, &mut registers, memory);
                    Registers { a, d, at } = registers;
                    count += 1;
                }
                Op::Ends => break Exit::Ended,
                Op::Away => break Exit::Away,
                Op::Set(c) => done!(1, c),

                Op::Load(x) => {
                    d = word!(x);
                    done!(2, x);
                }
                Op::Const(c) => {
                    d = c;
                    done!(2, c);
                }
                Op::Store(x) => {
                    word!(x) = d;
                    done!(2, x);
                }
                Op::Add(x) => {
                    d = d.wrapping_add(word!(x));
                    done!(2, x);
                }
                Op::Sub(x) => {
                    d = d.wrapping_sub(word!(x));
                    done!(2, x);
                }
                Op::Rsub(x) => {
                    d = word!(x).wrapping_sub(d);
                    done!(2, x);
                }
                Op::And(x) => {
                    d &= word!(x);
                    done!(2, x);
                }
                Op::Or(x) => {
                    d |= word!(x);
                    done!(2, x);
                }
                Op::AddC(c) => {
                    d = d.wrapping_add(c);
                    done!(2, c);
                }
                Op::SubC(c) => {
                    d = d.wrapping_sub(c);
                    done!(2, c);
                }
                Op::AndC(c) => {
                    d &= c;
                    done!(2, c);
                }
                Op::LoadInc(x) => {
                    d = word!(x).wrapping_add(1);
                    done!(2, x);
                }
                Op::LoadDec(x) => {
                    d = word!(x).wrapping_sub(1);
                    done!(2, x);
                }
                Op::LoadNot(x) => {
                    d = !word!(x);
                    done!(2, x);
                }
                Op::LoadNeg(x) => {
                    d = word!(x).wrapping_neg();
                    done!(2, x);
                }
                Op::Clear(x) => {
                    word!(x) = 0;
                    done!(2, x);
                }
                Op::One(x) => {
                    word!(x) = 1;
                    done!(2, x);
                }
                Op::MinusOne(x) => {
                    word!(x) = u16::MAX;
                    done!(2, x);
                }
                Op::Inc(x) => {
                    change!(x, |m| m.wrapping_add(1));
                    done!(2, x);
                }
                Op::Dec(x) => {
                    change!(x, |m| m.wrapping_sub(1));
                    done!(2, x);
                }
                Op::AddTo(x) => {
                    change!(x, |m| m.wrapping_add(d));
                    done!(2, x);
                }
                Op::SubTo(x) => {
                    change!(x, |m| m.wrapping_sub(d));
                    done!(2, x);
                }
                Op::IncD(x) => {
                    d = change!(x, |m| m.wrapping_add(1));
                    done!(2, x);
                }
                Op::DecD(x) => {
                    d = change!(x, |m| m.wrapping_sub(1));
                    done!(2, x);
                }
                Op::AddToD(x) => {
                    d = change!(x, |m| m.wrapping_add(d));
                    done!(2, x);
                }
                Op::SubToD(x) => {
                    d = change!(x, |m| m.wrapping_sub(d));
                    done!(2, x);
                }
                Op::At(x) => done!(2, word!(x)),
                Op::AtInc(x) => done!(2, word!(x).wrapping_add(1)),
                Op::AtDec(x) => done!(2, word!(x).wrapping_sub(1)),
                Op::AtAdd(x) => done!(2, word!(x).wrapping_add(d)),
                Op::Push(x) => done!(2, change!(x, |m| m.wrapping_add(1))),
                Op::Pop(x) => done!(2, change!(x, |m| m.wrapping_sub(1))),
                Op::Go(to) => go!(2, to, true),
                Op::IfLt(to) => go!(2, to, signed(d) < 0),
                Op::IfLe(to) => go!(2, to, signed(d) <= 0),
                Op::IfEq(to) => go!(2, to, d == 0),
                Op::IfNe(to) => go!(2, to, d != 0),
                Op::IfGe(to) => go!(2, to, signed(d) >= 0),
                Op::IfGt(to) => go!(2, to, signed(d) > 0),

                Op::LoadM => {
                    d = word!(a);
                    done!(1, a);
                }
                Op::StoreM => {
                    word!(a) = d;
                    done!(1, a);
                }
                Op::IncA => done!(1, a.wrapping_add(1)),
                Op::DecA => done!(1, a.wrapping_sub(1)),
                Op::Zero => {
                    d = 0;
                    done!(1, a);
                }
                Op::AtM => done!(1, word!(a)),
                Op::AtD => done!(1, d),
                Op::GoA => go!(1, a, true),

                Op::LoadAt(x) => {
                    let address = word!(x);
                    d = word!(address);
                    done!(3, address);
                }
                Op::StoreAt(x) => {
                    let address = word!(x);
                    word!(address) = d;
                    done!(3, address);
                }
                Op::GoAt(x) => {
                    let to = word!(x);
                    go!(3, to, true);
                }
                Op::Field(c, x) => {
                    let address = word!(x).wrapping_add(c);
                    d = word!(address);
                    done!(5, address);
                }
                Op::Element(x, y) => {
                    let address = word!(x).wrapping_add(word!(y));
                    d = word!(address);
                    done!(5, address);
                }
                Op::Move(x, y) => {
                    d = word!(x);
                    word!(y) = d;
                    done!(4, y);
                }
                Op::Put(c, y) => {
                    d = c;
                    word!(y) = c;
                    done!(4, y);
                }
                Op::StoreLoad(x, y) => {
                    word!(x) = d;
                    d = word!(y);
                    done!(4, y);
                }
                Op::Add2(x, y) => {
                    d = word!(x).wrapping_add(word!(y));
                    done!(4, y);
                }
                Op::Sub2(x, y) => {
                    d = word!(x).wrapping_sub(word!(y));
                    done!(4, y);
                }
                Op::And2(x, y) => {
                    d = word!(x) & word!(y);
                    done!(4, y);
                }
                Op::Add2C(x, c) => {
                    d = word!(x).wrapping_add(c);
                    done!(4, c);
                }
                Op::Sub2C(x, c) => {
                    d = word!(x).wrapping_sub(c);
                    done!(4, c);
                }
                Op::And2C(x, c) => {
                    d = word!(x) & c;
                    done!(4, c);
                }
                Op::Add3(x, y, z) => {
                    d = word!(x).wrapping_add(word!(y));
                    word!(z) = d;
                    done!(6, z);
                }
                Op::Sub3(x, y, z) => {
                    d = word!(x).wrapping_sub(word!(y));
                    word!(z) = d;
                    done!(6, z);
                }
                Op::Call(c, to) => {
                    d = c;
                    go!(4, to, true);
                }
                Op::LoadIfLt(x, to) => {
                    d = word!(x);
                    go!(4, to, signed(d) < 0);
                }
                Op::LoadIfEq(x, to) => {
                    d = word!(x);
                    go!(4, to, d == 0);
                }
                Op::LoadIfNe(x, to) => {
                    d = word!(x);
                    go!(4, to, d != 0);
                }
                Op::LoadIfGt(x, to) => {
                    d = word!(x);
                    go!(4, to, signed(d) > 0);
                }
                Op::SubIfLt(c, to) => {
                    d = d.wrapping_sub(c);
                    go!(4, to, signed(d) < 0);
                }
                Op::SubIfGe(c, to) => {
                    d = d.wrapping_sub(c);
                    go!(4, to, signed(d) >= 0);
                }
                Op::SubIfGt(c, to) => {
                    d = d.wrapping_sub(c);
                    go!(4, to, signed(d) > 0);
                }
                Op::SubIfEq(c, to) => {
                    d = d.wrapping_sub(c);
                    go!(4, to, d == 0);
                }
                Op::SubIfNe(c, to) => {
                    d = d.wrapping_sub(c);
                    go!(4, to, d != 0);
                }
            }
        };
        self.registers = Registers {
            a,
            d,
            at: at & ADDRESS,
        };
        self.count = count;
        match exit {
            Exit::Pause => self.go_plain(pause),
            exit => exit,
        }
    }
}
