//! DIM, which makes arrays and blocks of bytes.

use super::ast::{DimItem, Kind};
use super::code::Code;
use super::error::Error;
use super::state::State;
use super::values::{Array, Elements, Num, Value, array_index};

type Result<T> = std::result::Result<T, Error>;

impl State {
    pub(super) fn dim(&mut self, p: &Code<'_>, item: &DimItem) -> Result<()> {
        match item {
            DimItem::Block(place, e) => {
                let home = self.home(p, place)?;
                // DIM P% -1 takes nothing and gives the heap's end.
                let bytes = self.int(p, e)?.checked_add(1).ok_or(Error::DimSpace)?;
                let bytes = u16::try_from(bytes).map_err(|_| Error::BadDim)?;
                let start = self
                    .allocate(u32::from(bytes))
                    .map_err(|_| Error::DimSpace)?;
                self.store(home, Value::Num(Num::Int(start as i32)))
            }
            DimItem::Array(kind, slot, bounds) => {
                if self.array(*kind, *slot).is_ok() {
                    return Err(Error::BadDim);
                }
                let size = if *kind == Kind::Reals { 5 } else { 4 };
                let mut dims = Vec::with_capacity(bounds.len());
                let mut count = 1usize;
                for e in bounds {
                    let bound = self.int(p, e)?;
                    let n = usize::try_from(bound).map_err(|_| Error::BadDim)? + 1;
                    dims.push(n);
                    // In a word, as all that follows.
                    let fits = |n: &usize| *n * size < 0x10000;
                    count = count.checked_mul(n).filter(fits).ok_or(Error::BadDim)?;
                }
                let bytes = 1 + 2 * dims.len() + size * count;
                let lookup = self.enter(*kind, *slot)?;
                self.allocate(bytes as u32).map_err(|_| Error::DimSpace)?;
                self.cycles += 20 * bytes as u64;
                let elements = match kind {
                    Kind::Ints => Elements::Int(vec![0; count]),
                    Kind::Reals => Elements::Real(vec![Default::default(); count]),
                    _ => Elements::Str(vec![Vec::new(); count]),
                };
                let array = Array {
                    dims,
                    elements,
                    lookup,
                };
                if let Some(entry) = self.arrays[array_index(*kind)].get_mut(*slot as usize) {
                    *entry = Some(array);
                }
                Ok(())
            }
        }
    }
}
