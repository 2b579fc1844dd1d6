//! Where variables live: `static` and `this` for the class, `argument` and
//! `local` for the subroutine. The inner scope hides the outer one.

use super::tree::{Kind, Type, Variable};
use super::{Faults, LARGEST};
use std::collections::HashMap;

/// A variable's segment and index, and what it holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Symbol<'a> {
    pub kind: Kind,
    pub index: u16,
    pub of: Type<'a>,
}

impl Symbol<'_> {
    /// The name of the segment in VM code.
    pub(super) fn segment(&self) -> &'static str {
        match self.kind {
            Kind::Static => "static",
            Kind::Field => "this",
            Kind::Parameter => "argument",
            Kind::Local => "local",
        }
    }
}

/// The variables of one scope, a class's or a subroutine's.
#[derive(Default)]
pub(super) struct Scope<'a> {
    by_name: HashMap<&'a str, Symbol<'a>>,
}

impl<'a> Scope<'a> {
    /// Declares variables in order; the first of each kind has index 0, but
    /// the first parameter has `first_parameter` (1 where argument 0 is `this`).
    pub(super) fn of(
        variables: impl Iterator<Item = Variable<'a>>,
        first_parameter: u16,
        faults: &mut Faults,
    ) -> Self {
        let mut scope = Scope::default();
        let mut next = [0, 0, first_parameter, 0];
        for Variable { kind, of, name } in variables {
            let Some(index) = next.get_mut(kind as usize) else {
                continue;
            };
            let symbol = Symbol {
                kind,
                index: *index,
                of,
            };
            if *index >= LARGEST {
                faults.add(name.place, "more variables than a segment can number");
                break;
            }
            *index += 1;
            if scope.by_name.insert(name.text, symbol).is_some() {
                faults.add(name.place, format!("`{}` is already declared", name.text));
            }
        }
        scope
    }

    pub(super) fn get(&self, name: &str) -> Option<Symbol<'a>> {
        self.by_name.get(name).copied()
    }

    /// How many variables of a kind there are.
    pub(super) fn count(&self, kind: Kind) -> u32 {
        let of_kind = self.by_name.values().filter(|symbol| symbol.kind == kind);
        u32::try_from(of_kind.count()).unwrap_or(u32::MAX)
    }
}
