//! What BASIC II's work costs, in cycles of 2 MHz: the part that the text of a statement decides.
//!
//! A statement's cost is a sum over its parts: reading variables, brackets, what is written
//! (digits, spaces, long names), the statement itself, the start of its line; [`super::work`]
//! adds what depends on values when it runs. Each part is a difference between statements
//! counted on the genuine ROM with interrupts off. The interrupts of a real machine (a clock a
//! hundred times a second, a field fifty times) take a constant share, which
//! [`with_interrupts`] adds to a whole run.

use super::ast::{Expr, Func0, Func1, FuncS, Item, OnKind, Op2, Place, Stmt};
use super::names::RESIDENT;

/// Cycles with the share of interrupts: 1000 become this many (counted over long loops).
const THOUSAND: u64 = 1_041;

/// The cycles of a run on a machine whose interrupts are on.
pub(crate) fn with_interrupts(cycles: u64) -> u64 {
    let share = (cycles / 1_000 * (THOUSAND - 1_000)) + cycles % 1_000 * (THOUSAND - 1_000) / 1_000;
    cycles.saturating_add(share)
}

/// The cycles without interrupts after which a limit is reached.
pub(crate) fn without_interrupts(limit: u64) -> u64 {
    limit / THOUSAND * 1_000 + limit % THOUSAND
}

/// A new line, more than a colon.
pub(crate) const LINE: u32 = 66;
/// A colon with nothing before it.
pub(crate) const EMPTY: u32 = 172;
/// One space skipped.
pub(crate) const SPACE: u32 = 14;
/// A pair of brackets.
pub(crate) const BRACKETS: u32 = 231;
/// The second character of a real variable's name, and each one more of any name.
const SECOND_CHAR: u32 = 14;
const NAME_CHAR: u32 = 53;
/// One variable before it in the list of its first letter (added when it is looked up).
pub(crate) const PER_LINK: u32 = 43;
/// And each character of the names, after the first, that was the same.
pub(crate) const PER_SAME: u32 = 22;
/// One line passed in a search for a line number, whose high byte is another or the same.
const PER_LINE: u32 = 27;
const PER_NEAR_LINE: u32 = 44;
/// One line passed in the search for a DEF or DATA.
pub(crate) const PER_LINE_SCANNED: u32 = 47;
/// `&` and each digit after it.
pub(crate) const HEX: u32 = 223;
pub(crate) const HEX_DIGIT: u32 = 140;
/// A unary minus.
pub(crate) const NEGATE: u32 = 78;
/// THEN after a condition that is true.
pub(crate) const THEN: u32 = 79;
/// Each character passed when a condition is false.
pub(crate) const SKIPPED: u32 = 16;
/// `?` or `!` before an assignment's address, more than between two.
pub(crate) const PREFIX: u32 = 287;
/// LET.
pub(crate) const LET: u32 = 53;

/// A decimal literal as it is written: integers are quick. With a point or an exponent each
/// power of ten is a multiplication or division.
pub(crate) fn literal(text: &[u8]) -> u32 {
    let point = text.iter().position(|c| *c == b'.');
    let e = text.iter().position(|c| *c == b'E');
    if point.is_none() && e.is_none() {
        return 108 + 200 * text.len() as u32;
    }
    let end = e.unwrap_or(text.len());
    let whole = point.unwrap_or(end);
    let places = end.saturating_sub(whole + 1) as i32;
    let power: i32 = std::str::from_utf8(text.get(end + 1..).unwrap_or(&[]))
        .ok()
        .and_then(|t| t.parse().ok())
        .unwrap_or(0);
    let scale = power.saturating_sub(places).clamp(-99, 99);
    let step = match (scale < 0, e) {
        (true, None) => 878,
        (true, Some(_)) => 740,
        (false, _) => 220,
    };
    let scaling = step * scale.unsigned_abs();
    925 + 21 * whole as u32 + scaling
}

/// A variable's name, more than a name of one letter.
pub(crate) fn name(length: usize, real: bool) -> u32 {
    match (length as u32, real) {
        (0 | 1, _) => 0,
        (n, true) => SECOND_CHAR + NAME_CHAR * (n - 2),
        (n, false) => NAME_CHAR * (n - 1),
    }
}

/// A variable that is met for the first time; an FN or PROC, more.
pub(crate) const CREATE: u64 = 350;
pub(crate) const CREATE_CALL: u64 = 600;
/// TRUE, FALSE and PI.
pub(crate) const TRUE: u32 = 223;
pub(crate) const FALSE: u32 = 232;
pub(crate) const PI: u32 = 351;
/// Each character of a REM or DATA passed.
pub(crate) const REMARK: u32 = 9;

const READ_RESIDENT: u32 = 324;
const READ_INT: u32 = 520;
const READ_REAL: u32 = 560;
const READ_TEXT: u32 = 604;
/// Subscripts: one, and each more.
const ELEMENT: u32 = 830;
const DIMENSION: u32 = 650;

fn element(index: &[Expr]) -> u32 {
    ELEMENT + DIMENSION * (index.len() as u32).saturating_sub(1) + all(index)
}

/// An expression, without what its text adds ([`literal`] and the like).
pub(crate) fn expr(e: &Expr) -> u32 {
    match e {
        Expr::Int(_) | Expr::Real(_) | Expr::Bad(_) => 0,
        Expr::Str(s) => 250 + 27 * s.len() as u32,
        Expr::IntVar(slot) if (*slot as usize) < RESIDENT => READ_RESIDENT,
        Expr::IntVar(_) => READ_INT,
        Expr::RealVar(_) => READ_REAL,
        Expr::StrVar(_) => READ_TEXT,
        Expr::Element(_, _, index) => element(index),
        Expr::ByteAt(ab) => expr(&ab.0) + expr(&ab.1),
        Expr::WordAt(ab) => expr(&ab.0) + expr(&ab.1) + 14,
        Expr::F0(f) => func0(*f),
        Expr::F1(f, x) => func1(*f) + expr(x),
        Expr::FS(f, list) => func_s(*f) + all(list),
        Expr::Op2(op, ab) => op2(*op) + expr(&ab.0) + expr(&ab.1),
        Expr::Concat(ab) => 150 + expr(&ab.0) + expr(&ab.1),
        Expr::Compare(_, ab) => expr(&ab.0) + expr(&ab.1),
        Expr::CompareAny(_, ab) => 130 + expr(&ab.0) + expr(&ab.1),
        Expr::Fn(_, list, _) => 1_075 + all(list),
    }
}

/// A search for a line past those with these numbers.
pub(crate) fn search(passed: impl Iterator<Item = u16>, wanted: u16) -> u32 {
    let near = |n: u16| n >> 8 == wanted >> 8;
    passed
        .map(|n| if near(n) { PER_NEAR_LINE } else { PER_LINE })
        .sum()
}

/// A parameter of a call: saving the old value, setting the new one, restoring.
pub(crate) fn parameter(place: &Place) -> u32 {
    match place {
        Place::Int(slot) if (*slot as usize) < RESIDENT => 1_385,
        Place::Int(_) => 1_585,
        Place::Str(_) => 1_260,
        _ => 1_645,
    }
}

/// A LOCAL variable.
fn local(place: &Place) -> u32 {
    match place {
        Place::Int(_) => 880,
        Place::Str(_) => 780,
        _ => 1_010,
    }
}

fn all(list: &[Expr]) -> u32 {
    list.iter().map(expr).sum()
}

fn func0(f: Func0) -> u32 {
    match f {
        Func0::Rnd => 1_672,
        Func0::Time => 435,
        Func0::Pos | Func0::Vpos => 385,
        _ => 232,
    }
}

fn func1(f: Func1) -> u32 {
    match f {
        Func1::Neg => NEGATE,
        Func1::Plus => 60,
        Func1::Abs => 105,
        Func1::Not => 154,
        Func1::Byte => 162,
        Func1::Word => 190,
        // INT and SGN of a real are added when they run.
        Func1::Int => 80,
        Func1::Sgn => 135,
        Func1::Sqr => 17_600,
        // What depends on the argument is added when they run.
        Func1::Sin => 29_900,
        Func1::Cos => 30_300,
        Func1::Tan => 80_000,
        Func1::Atn => 37_000,
        Func1::Asn | Func1::Acs => 61_000,
        Func1::Exp => 28_900,
        Func1::Ln => 30_000,
        Func1::Log => 33_000,
        Func1::Deg | Func1::Rad => 3_000,
        // RND(1); a whole number's range is a product and INT more.
        Func1::Rnd => 1_710,
        _ => 600,
    }
}

fn func_s(f: FuncS) -> u32 {
    match f {
        FuncS::Asc | FuncS::Len => 10,
        FuncS::Val => 0,
        FuncS::Eval => 2_000,
        FuncS::Instr => 300,
        FuncS::Chr => 163,
        FuncS::Str => 1_000,
        FuncS::StrHex => 521,
        FuncS::Left => 370,
        FuncS::Right => 480,
        FuncS::Mid => 577,
        FuncS::Strings => 520,
        FuncS::At => 220,
        _ => 800,
    }
}

/// Logical operators; the others' costs depend on values.
fn op2(op: Op2) -> u32 {
    match op {
        Op2::And => 218,
        Op2::Or => 234,
        Op2::Eor => 241,
        _ => 0,
    }
}

fn assign(place: &Place) -> u32 {
    match place {
        Place::Int(slot) if (*slot as usize) < RESIDENT => 480,
        Place::Int(_) => 680,
        Place::Real(_) => 683,
        Place::Str(_) => 600,
        Place::Element(_, _, index) => 140 + element(index),
        Place::Byte(e) => 23 + expr(e),
        Place::Word(e) => 53 + expr(e),
        Place::Text(e) => 260 + expr(e),
    }
}

/// A whole statement, without what is only known when it runs.
pub(crate) fn stmt(s: &Stmt) -> u32 {
    match s {
        Stmt::LetInt(slot, e) => assign(&Place::Int(*slot)) + expr(e),
        Stmt::LetReal(slot, e) => assign(&Place::Real(*slot)) + expr(e),
        Stmt::Let(place, e) => assign(place) + expr(e),
        Stmt::Print(items) => 274 + items.iter().map(print_item).sum::<u32>(),
        Stmt::If(e, ..) => 116 + expr(e),
        Stmt::EndLine => 60,
        Stmt::Goto(_) => 400,
        Stmt::Gosub(_) => 500,
        Stmt::Return => 234,
        Stmt::On(kind, e, ..) => expr(e) + if *kind == OnKind::Goto { 700 } else { 900 },
        Stmt::For(place, fts) => {
            // A step that is not written is 1 without any work.
            let step = fts.2.as_ref().map_or(0, |e| 16 + expr(e));
            500 + assign(place) + expr(&fts.0) + expr(&fts.1) + step
        }
        // The rest of the loop's cost comes with the kind of its variable, when it runs.
        Stmt::Next(list) => 100 + 74 * list.iter().flatten().count() as u32,
        Stmt::Repeat => 130,
        Stmt::Until(e) => 170 + expr(e),
        Stmt::Proc(_, list) => 530 + all(list),
        Stmt::EndProc => 282,
        Stmt::Result(e) => 400 + expr(e),
        Stmt::Local(places) => 300 + places.iter().map(local).sum::<u32>(),
        Stmt::Read(places) => places.iter().map(|p| 150 + assign(p)).sum(),
        Stmt::Restore(_) => 181,
        Stmt::Vdu(items) => items.iter().map(|(e, _)| 250 + expr(e)).sum(),
        Stmt::Gcol(ab) => expr(&ab.0) + expr(&ab.1) + 300,
        Stmt::Plot(kxy) => [&kxy.0, &kxy.1, &kxy.2].map(|e| expr(e) + 100).iter().sum(),
        Stmt::PlotAs(_, xy) => expr(&xy.0) + expr(&xy.1) + 300,
        Stmt::Bput(ab) => 600 + expr(&ab.0) + expr(&ab.1),
        Stmt::Dim(_) => 700,
        _ => 300,
    }
}

fn print_item(item: &Item) -> u32 {
    match item {
        Item::Value(e) => 180 + expr(e),
        Item::Hex => 0,
        Item::Tab(e) => 400 + expr(e),
        Item::TabXy(x, y) => 900 + expr(x) + expr(y),
        _ => 30,
    }
}

/// NEXT, for each turn, by the kind of its variable (a real's addition apart).
pub(crate) fn next(int: bool) -> u64 {
    if int { 230 } else { 345 }
}

/// Plotting in the operating system, apart from BASIC's own work.
pub(crate) mod plot {
    /// PLOT 64 to 71: one point.
    pub const POINT: u64 = 2_400;
    /// GCOL.
    pub const GCOL: u64 = 560;
    /// Each point of a line.
    pub const LINE_POINT: u64 = 90;
    /// Each pixel of a filled shape.
    pub const FILL_PIXEL: u64 = 8;
    /// Reading a point.
    pub const READ: u64 = 2_200;
    /// CLG or CLS: each byte of the screen's memory written.
    pub const CLEAR_BYTE: u64 = 8;
    /// One byte through VDU.
    pub const VDU_BYTE: u64 = 180;
}
