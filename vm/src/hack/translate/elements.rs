//! Stores, and the ways of compilers to reach elements of arrays.

use super::expr::Expr;
use super::function::{Body, Entry};
use crate::hack::vm::command::{Binary, CONSTANTS, Command, Place, STATIC, THAT};

impl Body<'_, '_, '_> {
    /// A word of the stack to a place, in one of the ways of Jack compilers to
    /// reach elements of arrays; answers the next command.
    pub(super) fn pop_to(&mut self, at: u32, place: Place) -> u32 {
        let pointer = Place::fixed(THAT);
        let window = [self.at(at + 1), self.at(at + 2), self.at(at + 3)];
        let inside = |count| !(1..=count).any(|k| self.labels.contains_key(&(at + k)));
        let unread = |at, place: Place| !self.shared.live.is_read(at, place.offset);
        match window {
            // The address is on top: of a word to load, or to store below it to.
            [Some(Command::Push(element)), _, _]
                if place == pointer
                    && element.base == THAT
                    && inside(1)
                    && unread(at + 1, pointer) =>
            {
                let address = self.pop();
                let e = element_of(address.e, element);
                self.push(e, address.depth + 2);
                at + 2
            }
            [Some(Command::Pop(element)), _, _]
                if place == pointer
                    && element.base == THAT
                    && inside(1)
                    && unread(at + 1, pointer) =>
            {
                let address = self.pop();
                let value = self.pop();
                self.store(&element_of(address.e, element), &value.e);
                at + 2
            }
            // The word is on top, the address below it.
            [
                Some(Command::Pop(address)),
                Some(Command::Push(again)),
                Some(Command::Pop(element)),
            ] if address == pointer
                && again == place
                && place != pointer
                && place.base == CONSTANTS
                && element.base == THAT
                && inside(3)
                && unread(at + 3, pointer)
                && unread(at + 3, place)
                && place.offset < STATIC =>
            {
                let value = self.pop();
                let address = self.pop();
                self.store(&element_of(address.e, element), &value.e);
                at + 4
            }
            _ => {
                let value = self.pop();
                let is_temp = place.base == CONSTANTS;
                if !(is_temp && unread(at, place)) {
                    let to = self.place(place);
                    self.store(&to, &value.e);
                }
                at + 1
            }
        }
    }

    /// Stores a word that was popped; first whatever else it would change is read.
    pub(super) fn store(&mut self, to: &Expr, value: &Expr) {
        let store = to.as_store();
        let harmed = |entry: &Entry| entry.e.is_changed_by(store);
        if self.stack.iter().any(harmed) {
            self.flush(self.stack.len(), &|_| false);
        }
        self.eval.store(to, value);
    }
}

/// The element at an address and what the command adds.
fn element_of(address: Expr, element: Place) -> Expr {
    let offset = Expr::Const(element.offset);
    Expr::at(Expr::binary(Binary::Add, address, offset))
}
