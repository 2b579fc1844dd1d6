//! Statements over small trees of expressions, as a program is decoded.
//!
//! Names are resolved to slots, line numbers to lines, and the cost of a statement that does
//! not depend on values is added up, all once. What BASIC II decides only when it gets there
//! (a misspelt statement, a missing bracket) stays in the tree as an error that is raised
//! when it is reached.

use slowlight_isa::real40::Real40;

use super::error::Error;

/// Index of a variable, array or procedure in its own table.
pub(crate) type Slot = u32;

/// What a name holds: each kind has its own slots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Kind {
    Int,
    Real,
    Str,
    Ints,
    Reals,
    Strs,
    Fn,
    Proc,
}

/// Operators on two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Op2 {
    Add,
    Sub,
    Mul,
    Div,
    IntDiv,
    Mod,
    Pow,
    And,
    Or,
    Eor,
}

/// Comparisons; of numbers or of strings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Compare {
    Eq,
    Ne,
    Lt,
    Le,
    Gt,
    Ge,
}

/// Functions of one number that give a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Func1 {
    Neg,
    Plus,
    Not,
    Abs,
    Int,
    Sgn,
    Sqr,
    Sin,
    Cos,
    Tan,
    Asn,
    Acs,
    Atn,
    Exp,
    Ln,
    Log,
    Deg,
    Rad,
    Rnd,
    Inkey,
    Adval,
    Bget,
    Ext,
    Ptr,
    Eof,
    /// `?x`
    Byte,
    /// `!x`
    Word,
}

/// Functions of nothing that give a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Func0 {
    Rnd,
    Time,
    Himem,
    Lomem,
    Page,
    Top,
    Err,
    Erl,
    Count,
    Pos,
    Vpos,
    Get,
}

/// Functions with strings among their arguments or results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FuncS {
    Asc,
    Len,
    Val,
    Eval,
    Instr,
    Point,
    Openin,
    Openout,
    Openup,
    Chr,
    Str,
    StrHex,
    Left,
    Right,
    Mid,
    Strings,
    Get,
    Inkey,
    /// `$x`: the string in memory up to a carriage return.
    At,
}

impl FuncS {
    /// Is the result a string? (`None`: only known when it runs.)
    pub fn gives_string(self) -> Option<bool> {
        match self {
            Self::Eval => None,
            Self::Asc
            | Self::Len
            | Self::Val
            | Self::Instr
            | Self::Point
            | Self::Openin
            | Self::Openout
            | Self::Openup => Some(false),
            _ => Some(true),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Expr {
    Int(i32),
    Real(Real40),
    Str(Box<[u8]>),
    IntVar(Slot),
    RealVar(Slot),
    StrVar(Slot),
    /// An element of an int, real or string array, with its subscripts.
    Element(Kind, Slot, Box<[Expr]>),
    /// `base?offset`
    ByteAt(Box<(Expr, Expr)>),
    /// `base!offset`
    WordAt(Box<(Expr, Expr)>),
    F0(Func0),
    F1(Func1, Box<Expr>),
    FS(FuncS, Box<[Expr]>),
    Op2(Op2, Box<(Expr, Expr)>),
    /// `+` where a side may be a string.
    Concat(Box<(Expr, Expr)>),
    Compare(Compare, Box<(Expr, Expr)>),
    /// A comparison where a side may be a string.
    CompareAny(Compare, Box<(Expr, Expr)>),
    /// A function of the program; the last is about how many bytes of the host's stack the
    /// expression around the call takes.
    Fn(Slot, Box<[Expr]>, u32),
    /// Not an expression: raised when evaluated.
    Bad(Error),
}

impl Expr {
    /// Tells every call of a function in the tree what host stack is in use above it.
    /// (Bytes a level as measured on x86-64, rounded up.)
    pub fn note_depth(&mut self, above: u32) {
        const NUMBER: u32 = 220;
        const STRING: u32 = 320;
        const FUNCTION: u32 = 700;
        match self {
            Self::Fn(_, list, taken) => {
                *taken = above;
                for e in list {
                    e.note_depth(above + FUNCTION);
                }
            }
            Self::FS(_, list) => {
                for e in list {
                    e.note_depth(above + FUNCTION);
                }
            }
            Self::Element(_, _, list) => {
                for e in list {
                    e.note_depth(above + STRING);
                }
            }
            Self::F1(_, e) => e.note_depth(above + NUMBER),
            Self::Op2(_, ab) | Self::Compare(_, ab) | Self::ByteAt(ab) | Self::WordAt(ab) => {
                ab.0.note_depth(above + NUMBER);
                ab.1.note_depth(above + NUMBER);
            }
            Self::Concat(ab) | Self::CompareAny(_, ab) => {
                ab.0.note_depth(above + STRING);
                ab.1.note_depth(above + STRING);
            }
            _ => {}
        }
    }

    /// A string, a number, or (`None`) only known when it runs.
    pub fn is_string(&self) -> Option<bool> {
        match self {
            Self::Str(_) | Self::StrVar(_) | Self::Element(Kind::Strs, ..) => Some(true),
            Self::FS(f, _) => f.gives_string(),
            Self::Fn(..) | Self::Bad(_) => None,
            Self::Concat(ab) => ab.0.is_string().or(ab.1.is_string()),
            _ => Some(false),
        }
    }
}

/// What can be assigned to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Place {
    Int(Slot),
    Real(Slot),
    Str(Slot),
    Element(Kind, Slot, Box<[Expr]>),
    /// `?address`, or `base?offset` with both added.
    Byte(Expr),
    /// `!address`
    Word(Expr),
    /// `$address`
    Text(Expr),
}

/// An item of PRINT or INPUT.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Item {
    /// Decimal: right-justified in the field unless `;` came before.
    Value(Expr),
    /// `~`: hexadecimal from here on.
    Hex,
    /// `,`: on to the next field.
    Comma,
    /// `;`: no justification from here on.
    Semicolon,
    /// `'`
    NewLine,
    Tab(Expr),
    TabXy(Expr, Expr),
    Spc(Expr),
}

/// A part of INPUT.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Ask {
    /// Written; a variable right after it is asked for without a question mark.
    Print(Item),
    /// `,` or `;`
    Separator,
    /// Read from the line, or from a new one.
    Read(Place),
}

/// Where GOTO goes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Target {
    /// Index of the line, and the cycles of the search for it.
    Line(u32, u32),
    Missing,
    Computed(Expr),
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum OnKind {
    Goto,
    Gosub,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum DimItem {
    Array(Kind, Slot, Box<[Expr]>),
    /// `DIM P% n`: n + 1 bytes.
    Block(Place, Expr),
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Stmt {
    LetInt(Slot, Expr),
    LetReal(Slot, Expr),
    Let(Place, Expr),
    Print(Box<[Item]>),
    /// Jumps to the op when the condition is false; the last is what finding it costs.
    If(Expr, u32, u32),
    /// ELSE reached from above, DATA, REM, a DEF walked into: on to the next line.
    EndLine,
    Goto(Target),
    Gosub(Target),
    Return,
    /// The op to go to when no target fits is the ELSE clause, or none.
    On(OnKind, Expr, Box<[Target]>, Option<u32>),
    OnError,
    OnErrorOff,
    For(Place, Box<(Expr, Expr, Option<Expr>)>),
    Next(Box<[Option<Place>]>),
    Repeat,
    Until(Expr),
    Proc(Slot, Box<[Expr]>),
    EndProc,
    Result(Expr),
    Local(Box<[Place]>),
    Dim(Box<[DimItem]>),
    Read(Box<[Place]>),
    Restore(Option<Target>),
    /// Is it INPUT LINE, which takes whole lines?
    Input(Box<[Ask]>, bool),
    Mode(Expr),
    Vdu(Box<[(Expr, bool)]>),
    Gcol(Box<(Expr, Expr)>),
    Colour(Expr),
    Plot(Box<(Expr, Expr, Expr)>),
    /// MOVE and DRAW: PLOT with this code.
    PlotAs(u8, Box<(Expr, Expr)>),
    Cls,
    Clg,
    Bput(Box<(Expr, Expr)>),
    PrintFile(Expr, Box<[Expr]>),
    InputFile(Expr, Box<[Place]>),
    Close(Expr),
    SetPtr(Box<(Expr, Expr)>),
    SetTime(Expr),
    SetHimem(Expr),
    SetLomem(Expr),
    SetPage(Expr),
    /// TRACE of the lines below a number; `None` is off.
    Trace(Option<Expr>),
    Clear,
    /// From the first line, without variables.
    Run,
    Report,
    Width(Expr),
    OsCli(Expr),
    /// Evaluated for their errors, then nothing (SOUND, ENVELOPE).
    Ignore(Box<[Expr]>),
    End,
    Stop,
    Bad(Error),
}
