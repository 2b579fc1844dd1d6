//! Lanes: what the nodes of a graph come to in up to 64 pixels of a row.
//!
//! A node has a slot, an array with an element for each lane; reals, ints and
//! bools are kept apart, and a bool's lanes are the bits of a [`Mask`]. Lanes
//! come in chunks of eight. An operation on a full chunk is a loop of fixed
//! length without branches, which the compiler turns into vector instructions;
//! a chunk of which only some lanes are wanted goes lane by lane, and so leaves
//! the others as they were.
//!
//! What an operation means is [`Op`]'s alone: the loops here call it.

use slowlight_routine::{Op, Type, Value};

/// A set of lanes: bit k for lane k.
pub type Mask = u64;

/// Lanes that are computed together.
const CHUNK: usize = 8;

/// Lanes of a block at most.
pub const LANES: usize = Mask::BITS as usize;

type Chunk<T> = [T; CHUNK];

/// The slots of one type.
struct Slots<T> {
    chunks: Vec<Chunk<T>>,
    /// How many chunks a slot has.
    wide: usize,
}

impl<T: Copy + Default> Slots<T> {
    fn new(count: u32, wide: usize) -> Slots<T> {
        Slots {
            chunks: vec![[T::default(); CHUNK]; count as usize * wide],
            wide,
        }
    }

    fn slot(&self, at: u32) -> &[Chunk<T>] {
        &self.chunks[at as usize * self.wide..][..self.wide]
    }

    fn slot_mut(&mut self, at: u32) -> &mut [Chunk<T>] {
        &mut self.chunks[at as usize * self.wide..][..self.wide]
    }

    /// A slot to write, and those before it to read.
    fn split(&mut self, at: u32) -> (Before<'_, T>, &mut [Chunk<T>]) {
        let (before, rest) = self.chunks.split_at_mut(at as usize * self.wide);
        let wide = self.wide;
        (
            Before {
                chunks: before,
                wide,
            },
            &mut rest[..wide],
        )
    }

    fn lane(&self, at: u32, lane: usize) -> T {
        self.slot(at)[lane / CHUNK][lane % CHUNK]
    }

    fn copy(&mut self, from: u32, to: u32, mask: Mask) {
        if from < to {
            let (before, out) = self.split(to);
            map(mask, [before.slot(from); 2], out, |a, _| a);
        } else if to < from {
            let (before, source) = self.chunks.split_at_mut(from as usize * self.wide);
            let out = &mut before[to as usize * self.wide..][..self.wide];
            map(mask, [&source[..self.wide]; 2], out, |a, _| a);
        }
    }
}

/// The slots before one that is being written.
#[derive(Clone, Copy)]
struct Before<'s, T> {
    chunks: &'s [Chunk<T>],
    wide: usize,
}

impl<'s, T> Before<'s, T> {
    fn slot(self, at: u32) -> &'s [Chunk<T>] {
        &self.chunks[at as usize * self.wide..][..self.wide]
    }
}

/// `out` = `f(a, b)` in the lanes of the mask.
#[inline(always)]
fn map<A: Copy, B>(
    mask: Mask,
    [a, b]: [&[Chunk<A>]; 2],
    out: &mut [Chunk<B>],
    f: impl Fn(A, A) -> B,
) {
    let mut rest = mask;
    for ((a, b), out) in a.iter().zip(b).zip(out) {
        let mut bits = rest as u8;
        rest >>= CHUNK;
        if bits == u8::MAX {
            for k in 0..CHUNK {
                out[k] = f(a[k], b[k]);
            }
        } else {
            while bits != 0 {
                let k = bits.trailing_zeros() as usize % CHUNK;
                out[k] = f(a[k], b[k]);
                bits &= bits - 1;
            }
        }
    }
}

/// The lanes in which `f(a, b)` holds; anything outside of the mask.
#[inline(always)]
fn test<A: Copy>(mask: Mask, [a, b]: [&[Chunk<A>]; 2], f: impl Fn(A, A) -> bool) -> Mask {
    let mut found = 0;
    for (at, (a, b)) in a.iter().zip(b).enumerate() {
        let shift = at * CHUNK;
        if (mask >> shift) as u8 != 0 {
            for k in 0..CHUNK {
                found |= Mask::from(f(a[k], b[k])) << (shift + k);
            }
        }
    }
    found
}

/// Calls a loop with the operation's meaning: one compiled for each of the
/// operations named, which are quick, and one for all others.
macro_rules! compiled {
    ($op:ident, [$($name:ident)*], |$a:ident, $b:ident| $value:expr, |$f:ident| $run:expr) => {
        match $op {
            $(Op::$name => {
                let $f = |$a, $b| {
                    let $op = Op::$name;
                    $value
                };
                $run
            })*
            $op => {
                let $f = |$a, $b| $value;
                $run
            }
        }
    };
}

/// The slots of all types.
pub struct Lanes {
    reals: Slots<f64>,
    ints: Slots<i32>,
    bools: Vec<Mask>,
}

/// How many slots there are of each type.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    pub reals: u32,
    pub ints: u32,
    pub bools: u32,
}

impl Count {
    /// A new slot.
    pub fn add(&mut self, ty: Type) -> u32 {
        let count = match ty {
            Type::Real => &mut self.reals,
            Type::Int => &mut self.ints,
            Type::Bool => &mut self.bools,
        };
        *count += 1;
        *count - 1
    }
}

/// Numbers that all slots together may hold, unless a block of one chunk needs
/// more: large graphs have fewer lanes.
const NUMBERS: usize = 1 << 22;

impl Lanes {
    /// Slots that are 0 and false.
    pub fn new(count: Count) -> Lanes {
        let slots = (count.reals + count.ints) as usize;
        let wide = (NUMBERS / CHUNK / slots.max(1)).clamp(1, LANES / CHUNK);
        Lanes {
            reals: Slots::new(count.reals, wide),
            ints: Slots::new(count.ints, wide),
            bools: vec![0; count.bools as usize],
        }
    }

    /// How many lanes there are.
    pub fn lanes(&self) -> usize {
        self.reals.wide * CHUNK
    }

    /// A value.
    pub fn get(&self, ty: Type, slot: u32, lane: usize) -> Value {
        match ty {
            Type::Real => Value::Real(self.reals.lane(slot, lane)),
            Type::Int => Value::Int(self.ints.lane(slot, lane)),
            Type::Bool => Value::Bool(self.bools[slot as usize] >> lane & 1 == 1),
        }
    }

    /// The lanes in which a bool holds.
    pub fn truth(&self, slot: u32) -> Mask {
        self.bools[slot as usize]
    }

    /// A value of one lane, as the slot's type has it.
    pub fn set(&mut self, ty: Type, slot: u32, lane: usize, value: Value) {
        let (chunk, at) = (lane / CHUNK, lane % CHUNK);
        match ty {
            Type::Real => self.reals.slot_mut(slot)[chunk][at] = value.real(),
            Type::Int => self.ints.slot_mut(slot)[chunk][at] = value.int(),
            Type::Bool => self.set_bits(slot, 1 << lane, Mask::from(value.truth()) << lane),
        }
    }

    /// One value for all lanes, as the slot's type has it.
    pub fn fill(&mut self, ty: Type, slot: u32, value: Value) {
        match ty {
            Type::Real => self.reals.slot_mut(slot).fill([value.real(); CHUNK]),
            Type::Int => self.ints.slot_mut(slot).fill([value.int(); CHUNK]),
            Type::Bool => self.bools[slot as usize] = if value.truth() { !0 } else { 0 },
        }
    }

    /// A number in each lane, from lane 0 on.
    pub fn each(&mut self, slot: u32, numbers: impl Iterator<Item = i32>) {
        let lanes = self.ints.slot_mut(slot).as_flattened_mut();
        for (value, number) in lanes.iter_mut().zip(numbers) {
            *value = number;
        }
    }

    /// Gives every lane what lane 0 has.
    pub fn spread(&mut self, ty: Type, slot: u32) {
        let value = self.get(ty, slot, 0);
        self.fill(ty, slot, value);
    }

    /// Copies lanes from one slot to another of the same type.
    pub fn copy(&mut self, ty: Type, from: u32, to: u32, mask: Mask) {
        match ty {
            Type::Real => self.reals.copy(from, to, mask),
            Type::Int => self.ints.copy(from, to, mask),
            Type::Bool => self.set_bits(to, mask, self.bools[from as usize]),
        }
    }

    fn set_bits(&mut self, slot: u32, mask: Mask, bits: Mask) {
        let bools = &mut self.bools[slot as usize];
        *bools = *bools & !mask | bits & mask;
    }

    /// An operation in the lanes of the mask. Its arguments' slots have its
    /// argument types and stand before that of its result.
    pub fn apply(&mut self, op: Op, [a, b]: [u32; 2], out: u32, mask: Mask) {
        let from = op.args().first().copied().unwrap_or(Type::Bool);
        match (from, op.result()) {
            (Type::Real, Type::Real) => {
                let (before, out) = self.reals.split(out);
                let args = [before.slot(a), before.slot(b)];
                compiled!(
                    op,
                    [Add Sub Mul Div Neg Abs Min Max Sqrt],
                    |a, b| op.eval_real(a, b).real(),
                    |f| map(mask, args, out, f)
                );
            }
            (Type::Real, Type::Int) => {
                let args = [self.reals.slot(a), self.reals.slot(b)];
                let out = self.ints.slot_mut(out);
                compiled!(
                    op,
                    [Floor Round Sign],
                    |a, b| op.eval_real(a, b).int(),
                    |f| map(mask, args, out, f)
                );
            }
            (Type::Real, Type::Bool) => {
                let args = [self.reals.slot(a), self.reals.slot(b)];
                let found = compiled!(
                    op,
                    [Less LessEqual Equal],
                    |a, b| op.eval_real(a, b).truth(),
                    |f| test(mask, args, f)
                );
                self.set_bits(out, mask, found);
            }
            (Type::Int, Type::Real) => {
                let args = [self.ints.slot(a), self.ints.slot(b)];
                let out = self.reals.slot_mut(out);
                compiled!(op, [ToReal], |a, b| op.eval_int(a, b).real(), |f| map(
                    mask, args, out, f
                ));
            }
            (Type::Int, Type::Int) => {
                let (before, out) = self.ints.split(out);
                let args = [before.slot(a), before.slot(b)];
                compiled!(
                    op,
                    [IntAdd IntSub IntMul IntNeg IntMin IntMax BitAnd BitOr BitXor],
                    |a, b| op.eval_int(a, b).int(),
                    |f| map(mask, args, out, f)
                );
            }
            (Type::Int, Type::Bool) => {
                let args = [self.ints.slot(a), self.ints.slot(b)];
                let found = compiled!(
                    op,
                    [IntLess IntLessEqual IntEqual],
                    |a, b| op.eval_int(a, b).truth(),
                    |f| test(mask, args, f)
                );
                self.set_bits(out, mask, found);
            }
            // The one operation on bools is negation.
            (Type::Bool, _) => self.set_bits(out, mask, !self.truth(a)),
        }
    }
}

#[cfg(test)]
mod tests;
