//! Functions that only answer a word need no call: a static or a constant, or a word
//! of the object that they are given, which is what a getter of a class does.

use super::expr::{Expr, fixed};
use super::function::{Body, Entry};
use crate::hack::vm::command::{ARG, Binary, CONSTANTS, Command, Place, STACK, STATIC, THIS};

impl Body<'_, '_, '_> {
    /// What a call leaves on the stack, where the function does no more than to look
    /// at a word; its arguments are then taken off.
    pub(super) fn looked_at(&mut self, callee: usize, arguments: u16) -> Option<Entry> {
        let function = self.shared.program.functions.get(callee)?;
        let commands = self.shared.program.commands.get(function.range())?;
        match (arguments, commands) {
            (
                0,
                [
                    Command::Function { .. },
                    Command::Push(place),
                    Command::Return,
                    ..,
                ],
            ) if is_fixed(*place) => Some(Entry {
                e: fixed(place.offset),
                depth: 1,
            }),
            (
                1,
                [
                    Command::Function { .. },
                    Command::Push(object),
                    Command::Pop(this),
                    Command::Push(field),
                    Command::Return,
                    ..,
                ],
            ) if is_first(*object) && *this == Place::fixed(THIS) && field.base == THIS => {
                let object = self.pop();
                let offset = Expr::Const(field.offset);
                Some(Entry {
                    e: Expr::at(Expr::binary(Binary::Add, object.e, offset)),
                    depth: object.depth + 2,
                })
            }
            _ => None,
        }
    }
}

/// A constant or a static: neither the caller's own word nor the function's.
fn is_fixed(place: Place) -> bool {
    let is_word = place.offset >= CONSTANTS || (STATIC..STACK).contains(&place.offset);
    place.base == CONSTANTS && is_word
}

fn is_first(place: Place) -> bool {
    place.base == ARG && place.offset == 0
}
