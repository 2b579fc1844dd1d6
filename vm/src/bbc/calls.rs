//! FN, PROC, LOCAL and assignment.
//!
//! A call saves its parameters' old values on BASIC's stack and sets them to the arguments;
//! the end of the call puts the saved values back. Procedures run in the same loop as their
//! caller; a function is called from within an expression, so it runs in a loop of its own,
//! and the host's stack that this takes is bounded.

use super::ast::{Expr, Kind, Place, Slot};
use super::code::Code;
use super::cost;
use super::error::Error;
use super::exec::DONE;
use super::state::{HOST_STACK, State};
use super::values::{Elements, Frame, Home, Num, Saved, Value, is_numeric};
use super::work;

type Result<T> = std::result::Result<T, Error>;

/// Bytes of BASIC's stack for a call without parameters (the hardware stack's contents).
const CALL: u32 = 22;
/// Host stack for a function's loop.
const HOST_CALL: u32 = 1_000;

impl State {
    /// Works out where a place is; creates the variable, as the ROM does on sight.
    pub fn home(&mut self, p: &Code<'_>, place: &Place) -> Result<Home> {
        Ok(match place {
            Place::Int(slot) => {
                self.define_int(*slot)?;
                Home::Int(*slot)
            }
            Place::Real(slot) => {
                self.define_real(*slot)?;
                Home::Real(*slot)
            }
            Place::Str(slot) => {
                self.define_text(*slot)?;
                Home::Str(*slot)
            }
            Place::Element(kind, slot, index) => {
                Home::Element(*kind, *slot, self.subscript(p, *kind, *slot, index)?)
            }
            Place::Byte(e) => Home::Byte(self.place_address(p, e)?),
            Place::Word(e) => Home::Word(self.place_address(p, e)?),
            Place::Text(e) => {
                let address = self.address(p, e)?;
                if address < 0x100 {
                    return Err(Error::StringRange);
                }
                Home::Text(address)
            }
        })
    }

    /// The address of `?x` and `!x`. In `A?x` the ROM makes a variable A that does not exist, and
    /// then misses its `=`.
    fn place_address(&mut self, p: &Code<'_>, e: &Expr) -> Result<u16> {
        let address = self.address(p, e);
        if let (Err(Error::NoSuchVariable), Expr::Op2(_, ab)) = (&address, e) {
            match ab.0 {
                Expr::IntVar(slot) if !self.is_defined(&Place::Int(slot)) => {
                    self.define_int(slot)?;
                    return Err(Error::Mistake);
                }
                Expr::RealVar(slot) if !self.is_defined(&Place::Real(slot)) => {
                    self.define_real(slot)?;
                    return Err(Error::Mistake);
                }
                _ => {}
            }
        }
        address
    }

    /// Does a variable exist? (Memory always does, and what an array lacks is another error.)
    pub(super) fn is_defined(&self, place: &Place) -> bool {
        match place {
            Place::Int(slot) => self.ints.get(*slot as usize).is_some_and(|v| v.defined),
            Place::Real(slot) => self.reals.get(*slot as usize).is_some_and(|v| v.defined),
            Place::Str(slot) => self.texts.get(*slot as usize).is_some_and(|v| v.defined),
            _ => true,
        }
    }

    /// What a place holds now.
    pub fn load(&self, home: Home) -> Result<Value> {
        let int = |n| Value::Num(Num::Int(n));
        Ok(match home {
            Home::Int(slot) => int(self.ints.get(slot as usize).map_or(0, |v| v.value)),
            Home::Real(slot) => {
                let x = self.reals.get(slot as usize).ok_or(Error::NoSuchVariable)?;
                Value::Num(Num::Real(x.value))
            }
            Home::Str(slot) => {
                let s = self.texts.get(slot as usize).ok_or(Error::NoSuchVariable)?;
                Value::Str(s.value.clone())
            }
            Home::Element(kind, slot, at) => match &self.array(kind, slot)?.elements {
                Elements::Int(v) => int(*v.get(at).ok_or(Error::Subscript)?),
                Elements::Real(v) => Value::Num(Num::Real(*v.get(at).ok_or(Error::Subscript)?)),
                Elements::Str(v) => Value::Str(v.get(at).ok_or(Error::Subscript)?.clone()),
            },
            Home::Byte(address) => int(i32::from(self.byte(address))),
            Home::Word(address) => int(self.word(address)),
            Home::Text(address) => Value::Str(self.text_at(address)?),
        })
    }

    /// Whether a place is in the screen's memory.
    pub fn is_shown(&self, home: &Home) -> bool {
        match home {
            Home::Byte(address) | Home::Word(address) | Home::Text(address) => {
                self.display.is_shown(u32::from(*address))
            }
            _ => false,
        }
    }

    /// Sets a place, converting between integers and reals.
    pub fn store(&mut self, home: Home, value: Value) -> Result<()> {
        match (home, value) {
            (Home::Int(slot), Value::Num(n)) => {
                let n = self.whole(n)?;
                let v = self
                    .ints
                    .get_mut(slot as usize)
                    .ok_or(Error::NoSuchVariable)?;
                self.cycles += u64::from(v.lookup);
                v.value = n;
            }
            (Home::Real(slot), Value::Num(n)) => {
                let x = self.real_of(n);
                let v = self
                    .reals
                    .get_mut(slot as usize)
                    .ok_or(Error::NoSuchVariable)?;
                self.cycles += u64::from(v.lookup);
                v.value = x;
            }
            (Home::Str(slot), Value::Str(s)) => {
                self.room_for_text(slot, s.len())?;
                self.cycles += work::text::STORED * s.len() as u64;
                let v = self
                    .texts
                    .get_mut(slot as usize)
                    .ok_or(Error::NoSuchVariable)?;
                self.cycles += u64::from(v.lookup);
                v.value = s;
            }
            (Home::Element(kind, slot, at), value) => self.store_element(kind, slot, at, value)?,
            (Home::Byte(address), Value::Num(n)) => {
                let byte = self.whole(n)? as u8;
                self.set_byte(address, byte);
            }
            (Home::Word(address), Value::Num(n)) => {
                let word = self.whole(n)?;
                self.set_word(address, word);
            }
            (Home::Text(address), Value::Str(s)) => {
                for (i, c) in s.iter().chain(&[13]).enumerate() {
                    self.set_byte(address.wrapping_add(i as u16), *c);
                }
            }
            _ => return Err(Error::TypeMismatch),
        }
        Ok(())
    }

    fn store_element(&mut self, kind: Kind, slot: Slot, at: usize, value: Value) -> Result<()> {
        if let Value::Str(s) = &value {
            let old = match &self.array(kind, slot)?.elements {
                Elements::Str(v) => v.get(at).ok_or(Error::Subscript)?.len(),
                _ => return Err(Error::TypeMismatch),
            };
            if s.len() > old {
                self.allocate(text_room(s.len()))?;
            }
        }
        self.cycles += match (kind, &value) {
            (Kind::Ints, Value::Num(Num::Real(x))) => u64::from(work::real_to_int(*x)),
            (Kind::Reals, Value::Num(Num::Int(n))) => u64::from(work::int_to_real(*n)),
            (_, Value::Str(s)) => work::text::STORED * s.len() as u64,
            _ => 0,
        };
        match (&mut self.array_mut(kind, slot)?.elements, value) {
            (Elements::Int(v), Value::Num(n)) => {
                *v.get_mut(at).ok_or(Error::Subscript)? = n.int()?;
            }
            (Elements::Real(v), Value::Num(n)) => {
                *v.get_mut(at).ok_or(Error::Subscript)? = n.real();
            }
            (Elements::Str(v), Value::Str(s)) => {
                *v.get_mut(at).ok_or(Error::Subscript)? = s;
            }
            _ => return Err(Error::TypeMismatch),
        }
        Ok(())
    }

    /// A longer string than before gets new memory; the old is lost, as in the machine.
    fn room_for_text(&mut self, slot: Slot, length: usize) -> Result<()> {
        let room = self.texts.get(slot as usize).map_or(0, |t| t.room);
        if length > room {
            let wanted = text_room(length);
            self.allocate(wanted)?;
            if let Some(t) = self.texts.get_mut(slot as usize) {
                t.room = wanted as usize;
            }
        }
        Ok(())
    }

    /// Saves a place's value on the stack, to be put back at the end of the call.
    fn save(&mut self, home: Home) -> Result<()> {
        // Not even the ROM puts a byte back.
        if let Home::Byte(_) = home {
            return Ok(());
        }
        let value = self.load(home)?;
        let bytes = match &value {
            Value::Str(s) => s.len() as u32 + 4,
            Value::Num(Num::Int(_)) => 7,
            Value::Num(Num::Real(_)) => 8,
        };
        self.push_stack(bytes)?;
        self.saved.push(Saved { place: home, value });
        Ok(())
    }

    /// LOCAL: saves, and sets to zero or "".
    pub fn local(&mut self, p: &Code<'_>, places: &[Place]) -> Result<()> {
        if self.frames.is_empty() {
            return Err(Error::NotLocal);
        }
        for place in places {
            let home = self.home(p, place)?;
            self.save(home)?;
            let zero = match place {
                // The ROM leaves these alone.
                Place::Text(_) | Place::Byte(_) => continue,
                place if is_numeric(place) => Value::Num(Num::Int(0)),
                _ => Value::Str(Vec::new()),
            };
            self.store(home, zero)?;
        }
        Ok(())
    }

    /// Starts a call: arguments, frame, parameters. Answers the op of the body.
    pub fn enter_call(
        &mut self,
        p: &Code<'_>,
        kind: Kind,
        slot: Slot,
        list: &[Expr],
        back: u32,
    ) -> Result<u32> {
        let function = kind == Kind::Fn;
        let (table, met) = if function { (&p.fns, 0) } else { (&p.procs, 1) };
        let def = table
            .get(slot as usize)
            .and_then(Option::as_ref)
            .ok_or(Error::NoSuchFnProc)?;
        let found = match self.met[met].get(slot as usize) {
            Some(Some(lookup)) => *lookup,
            _ => {
                // The first call searches the program for the DEF.
                let line = p.ops.get(def.op as usize).map_or(0, |op| op.line);
                self.cycles += u64::from(cost::PER_LINE_SCANNED * line) + cost::CREATE_CALL;
                let lookup = self.enter(kind, slot)?;
                if let Some(seen) = self.met[met].get_mut(slot as usize) {
                    *seen = Some(lookup);
                }
                lookup
            }
        };
        self.cycles += u64::from(found + def.cost);
        let params = def.params.as_ref().map_err(|e| *e)?;
        // A procedure that takes none runs before the ROM comes to see that it was given some.
        let excess = params.is_empty() && !list.is_empty();
        if excess && function || list.is_empty() && !params.is_empty() {
            return Err(Error::Arguments);
        }
        let stack = self.stack;
        let saved = self.saved.len();
        self.push_stack(CALL)?;
        let frame = Frame {
            function,
            back,
            saved,
            stack,
            excess,
        };
        if params.is_empty() {
            self.frames.push(frame);
            return Ok(def.op);
        }
        self.cycles += u64::from(params.iter().map(cost::parameter).sum::<u32>());
        let mut values = Vec::with_capacity(list.len());
        // ERL of what goes wrong in an argument is the DEF's line: the op before its body's.
        let caller = std::mem::replace(&mut self.op, def.op.saturating_sub(1));
        for (e, _) in list.iter().zip(params) {
            values.push(self.value(p, e)?);
        }
        self.op = caller;
        if params.len() != list.len() {
            return Err(Error::Arguments);
        }
        for (param, value) in params.iter().zip(values) {
            let home = self.home(p, param)?;
            self.save(home)?;
            self.store(home, value).map_err(|e| match e {
                Error::TypeMismatch => Error::Arguments,
                e => e,
            })?;
        }
        self.frames.push(frame);
        Ok(def.op)
    }

    /// Ends a call: puts the saved values back, last saved first.
    pub fn leave_call(&mut self, function: bool) -> Result<u32> {
        let wrong = if function { Error::NoFn } else { Error::NoProc };
        match self.frames.last() {
            Some(f) if f.function == function => {}
            _ => return Err(wrong),
        }
        let frame = self.frames.pop().ok_or(wrong)?;
        while self.saved.len() > frame.saved {
            if let Some(s) = self.saved.pop() {
                self.store(s.place, s.value)?;
            }
        }
        self.stack = frame.stack;
        if frame.excess {
            self.op = frame.back.saturating_sub(1);
            return Err(Error::Syntax);
        }
        Ok(frame.back)
    }

    /// A function call within an expression.
    pub fn call_function(
        &mut self,
        p: &Code<'_>,
        slot: Slot,
        list: &[Expr],
        around: u32,
    ) -> Result<Value> {
        let op = self.op;
        let taken = HOST_CALL + around;
        self.host += taken;
        if self.host > HOST_STACK {
            return Err(Error::NoRoom);
        }
        let start = self.enter_call(p, Kind::Fn, slot, list, DONE)?;
        self.run_ops(p, start)?;
        self.host -= taken;
        self.op = op;
        Ok(std::mem::replace(&mut self.result, Value::Num(Num::Int(0))))
    }
}

/// What the ROM sets aside for a string: eight more than its length, if it has eight or more.
fn text_room(length: usize) -> u32 {
    if length < 8 {
        length as u32
    } else {
        (length as u32 + 8).min(255)
    }
}
