//! What BASIC II's work costs, in cycles of 2 MHz.
//!
//! A statement's cost is a sum over its parts: reading variables, operators, what is written
//! (digits, spaces, long names), and the statement itself. The parts were fitted to whole
//! statements measured on the genuine ROM with the loop around them subtracted, so sums are
//! within some per cent of the machine; what depends on values (bits of a multiplier, digits
//! printed) is an average. A real machine is about 4% slower, from interrupts.

use super::ast::{Expr, Func1, FuncS, Item, Kind, OnKind, Op2, Place, Stmt};
use super::names::RESIDENT;

/// One space skipped.
pub(crate) const SPACE: u32 = 14;
/// One more character of a variable's name.
pub(crate) const NAME_CHAR: u32 = 60;
/// One variable before it in the list of its first letter (added when it is looked up).
pub(crate) const PER_LINK: u32 = 114;
/// One line passed in a search for a line number.
pub(crate) const PER_LINE: u32 = 27;
/// `&` and each digit after it.
pub(crate) const HEX: u32 = 300;
pub(crate) const HEX_DIGIT: u32 = 120;
pub(crate) const NEGATE: u32 = 120;

/// A decimal literal as it is written: integers are quick, a point or an exponent is dear.
pub(crate) fn literal(text: &[u8]) -> u32 {
    let digits = text.len() as u32;
    match text.iter().position(|c| matches!(c, b'.' | b'E')) {
        None => 108 + 200 * digits,
        Some(point) => 1_100 + 200 * point as u32 + 820 * (digits - 1 - point as u32),
    }
}

const READ_RESIDENT: u32 = 324;
const READ_INT: u32 = 520;
const READ_REAL: u32 = 560;
const INT_TO_REAL: u32 = 264;
const REAL_TO_INT: u32 = 742;

/// Is a number held as an integer, as far as the text tells?
fn is_int(e: &Expr) -> bool {
    match e {
        Expr::Int(_)
        | Expr::IntVar(_)
        | Expr::Element(Kind::Ints, ..)
        | Expr::ByteAt(_)
        | Expr::WordAt(_)
        | Expr::F0(_)
        | Expr::Compare(..)
        | Expr::CompareAny(..) => true,
        Expr::F1(f, x) => match f {
            Func1::Neg | Func1::Plus | Func1::Abs => is_int(x),
            Func1::Not | Func1::Int | Func1::Sgn | Func1::Byte | Func1::Word => true,
            _ => false,
        },
        Expr::FS(f, _) => !matches!(f, FuncS::Val),
        Expr::Op2(op, ab) => match op {
            Op2::And | Op2::Or | Op2::Eor | Op2::IntDiv | Op2::Mod => true,
            Op2::Add | Op2::Sub | Op2::Mul => is_int(&ab.0) && is_int(&ab.1),
            Op2::Div | Op2::Pow => false,
        },
        _ => false,
    }
}

fn to_int(e: &Expr) -> u32 {
    if is_int(e) { 0 } else { REAL_TO_INT }
}

/// An expression, without what its text adds ([`literal`] and the like).
pub(crate) fn expr(e: &Expr) -> u32 {
    match e {
        Expr::Int(_) | Expr::Real(_) | Expr::Bad(_) => 0,
        Expr::Str(s) => 200 + 20 * s.len() as u32,
        Expr::IntVar(slot) if (*slot as usize) < RESIDENT => READ_RESIDENT,
        Expr::IntVar(_) => READ_INT,
        Expr::RealVar(_) => READ_REAL,
        Expr::StrVar(_) => READ_INT + 200,
        Expr::Element(_, _, index) => 870 + all(index) + index.iter().map(to_int).sum::<u32>(),
        Expr::ByteAt(ab) | Expr::WordAt(ab) => {
            expr(&ab.0) + expr(&ab.1) + to_int(&ab.0) + to_int(&ab.1)
        }
        Expr::F0(_) => 300,
        Expr::F1(f, x) => func1(*f, x) + expr(x),
        Expr::FS(_, list) => 800 + all(list),
        Expr::Op2(op, ab) => op2(*op, &ab.0, &ab.1) + expr(&ab.0) + expr(&ab.1),
        Expr::Concat(ab) => 500 + expr(&ab.0) + expr(&ab.1),
        Expr::Compare(_, ab) => compare(&ab.0, &ab.1) + expr(&ab.0) + expr(&ab.1),
        Expr::CompareAny(_, ab) => 500 + expr(&ab.0) + expr(&ab.1),
        Expr::Fn(_, list, _) => 1_075 + all(list),
    }
}

/// Each parameter of a call: saving the old value, setting the new one, restoring.
pub(crate) const PARAMETER: u32 = 1_600;

fn all(list: &[Expr]) -> u32 {
    list.iter().map(expr).sum()
}

fn func1(f: Func1, x: &Expr) -> u32 {
    let real = if is_int(x) { INT_TO_REAL } else { 0 };
    match f {
        Func1::Neg => NEGATE,
        Func1::Plus => 60,
        Func1::Abs => 120,
        Func1::Not => 150 + to_int(x),
        Func1::Byte | Func1::Word => 162 + to_int(x),
        Func1::Int if is_int(x) => 100,
        Func1::Int => 1_335,
        Func1::Sgn => 637,
        Func1::Sqr => 18_000 + real,
        Func1::Sin => 55_990 + real,
        Func1::Cos => 34_950 + real,
        Func1::Tan => 95_000 + real,
        Func1::Atn => 33_000 + real,
        Func1::Asn | Func1::Acs => 75_000 + real,
        Func1::Exp => 32_530 + real,
        Func1::Ln => 29_390 + real,
        Func1::Log => 33_000 + real,
        Func1::Deg | Func1::Rad => 4_000 + real,
        Func1::Rnd => 7_000,
        _ => 600 + to_int(x),
    }
}

fn op2(op: Op2, a: &Expr, b: &Expr) -> u32 {
    let ints = is_int(a) && is_int(b);
    let mixed = if is_int(a) != is_int(b) {
        INT_TO_REAL
    } else {
        0
    };
    match op {
        Op2::Add if ints => 117,
        Op2::Sub if ints => 125,
        Op2::Mul if ints => 892,
        Op2::Add => 436 + mixed,
        Op2::Sub => 558 + mixed,
        Op2::Mul => 3_219 + mixed,
        Op2::Div => 3_427 + if ints { 2 * INT_TO_REAL } else { mixed },
        Op2::IntDiv => 2_147 + to_int(a) + to_int(b),
        Op2::Mod => 2_123 + to_int(a) + to_int(b),
        Op2::And | Op2::Or | Op2::Eor => 218 + to_int(a) + to_int(b),
        Op2::Pow => match b {
            Expr::Int(2) => 6_530,
            _ => 70_770,
        },
    }
}

fn compare(a: &Expr, b: &Expr) -> u32 {
    if is_int(a) && is_int(b) {
        200
    } else if is_int(a) != is_int(b) {
        280 + INT_TO_REAL
    } else {
        280
    }
}

fn assign(place: &Place) -> u32 {
    match place {
        Place::Int(slot) if (*slot as usize) < RESIDENT => 480,
        Place::Int(_) => 680,
        Place::Real(_) => 683,
        Place::Str(_) => 900,
        Place::Element(_, _, index) => 1_000 + all(index),
        Place::Byte(e) | Place::Word(e) => 380 + expr(e) + to_int(e),
        Place::Text(e) => 700 + expr(e),
    }
}

fn convert(place: &Place, e: &Expr) -> u32 {
    let wants_int = matches!(
        place,
        Place::Int(_) | Place::Byte(_) | Place::Word(_) | Place::Element(Kind::Ints, ..)
    );
    match (wants_int, is_int(e)) {
        (true, false) => REAL_TO_INT,
        (false, true) => INT_TO_REAL,
        _ => 0,
    }
}

/// A whole statement, without what is only known when it runs.
pub(crate) fn stmt(s: &Stmt) -> u32 {
    match s {
        Stmt::LetInt(slot, e) => {
            let place = Place::Int(*slot);
            assign(&place) + convert(&place, e) + expr(e)
        }
        Stmt::LetReal(slot, e) => {
            let place = Place::Real(*slot);
            assign(&place) + convert(&place, e) + expr(e)
        }
        Stmt::Let(place, e) => assign(place) + convert(place, e) + expr(e),
        Stmt::Print(items) => 300 + items.iter().map(print_item).sum::<u32>(),
        Stmt::If(e, _) => 320 + expr(e) + to_int(e),
        Stmt::EndLine => 120,
        Stmt::Goto(_) => 400,
        Stmt::Gosub(_) => 500,
        Stmt::Return => 234,
        Stmt::On(kind, e, ..) => expr(e) + if *kind == OnKind::Goto { 700 } else { 900 },
        Stmt::For(place, fts) => {
            let step = fts.2.as_ref().map_or(0, expr);
            1_000 + assign(place) + expr(&fts.0) + expr(&fts.1) + step
        }
        // The rest of the loop's cost comes with the kind of its variable, when it runs.
        Stmt::Next(_) => 100,
        Stmt::Repeat => 200,
        Stmt::Until(e) => 300 + expr(e) + to_int(e),
        Stmt::Proc(_, list) => 700 + all(list),
        Stmt::EndProc => 282,
        Stmt::Result(e) => 400 + expr(e),
        Stmt::Local(places) => 300 + 1_114 * places.len() as u32,
        Stmt::Read(places) => 1_200 * places.len() as u32,
        Stmt::Vdu(items) => items.iter().map(|(e, _)| 250 + expr(e) + to_int(e)).sum(),
        Stmt::Gcol(ab) => expr(&ab.0) + expr(&ab.1) + to_int(&ab.0) + to_int(&ab.1) + 300,
        Stmt::Plot(kxy) => {
            let each = |e: &Expr| expr(e) + to_int(e) + 100;
            each(&kxy.0) + each(&kxy.1) + each(&kxy.2)
        }
        Stmt::PlotAs(_, xy) => expr(&xy.0) + expr(&xy.1) + to_int(&xy.0) + to_int(&xy.1) + 300,
        Stmt::Bput(ab) => 600 + expr(&ab.0) + expr(&ab.1),
        Stmt::Dim(_) => 2_000,
        _ => 300,
    }
}

fn print_item(item: &Item) -> u32 {
    match item {
        Item::Value(e) if e.is_string() == Some(true) => 500 + expr(e),
        Item::Value(e) => 12_000 + expr(e),
        Item::Hex(e) => 2_000 + expr(e),
        _ => 300,
    }
}

/// NEXT, for each turn, by the kind of its variable and whether its step is 1.
pub(crate) fn next(int: bool) -> u64 {
    if int { 243 } else { 1_000 }
}

/// Plotting in the operating system, apart from BASIC's own work.
pub(crate) mod plot {
    /// PLOT 64 to 71: one point.
    pub const POINT: u64 = 2_400;
    /// GCOL.
    pub const GCOL: u64 = 700;
    /// Each point of a line.
    pub const LINE_POINT: u64 = 90;
    /// Each pixel of a filled shape.
    pub const FILL_PIXEL: u64 = 8;
    /// Reading a point.
    pub const READ: u64 = 2_200;
    /// CLG or CLS: the screen's memory written once.
    pub const CLEAR: u64 = 160_000;
    /// One byte through VDU.
    pub const VDU_BYTE: u64 = 180;
}
