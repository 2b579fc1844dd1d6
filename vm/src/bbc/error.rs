//! BASIC II's errors: their numbers and messages, from the User Guide and the ROM itself.

use slowlight_isa::real40::RealError;

/// What can go wrong in a running program. (As wide as the parts of a number, whose place it takes
/// in a result.)
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Error {
    /// Variables, stack or program do not fit between PAGE and HIMEM.
    NoRoom,
    /// The bytes from PAGE are not a program.
    BadProgram,
    /// A STOP statement.
    Stop,
    /// A statement that cannot start as it does.
    Mistake,
    /// A comma is wanted.
    MissingComma,
    /// A number where a string is wanted or the other way round.
    TypeMismatch,
    /// `=` outside a function.
    NoFn,
    /// `$` to page zero.
    StringRange,
    /// No closing quote.
    MissingQuote,
    /// A DIM that cannot be read, or of an array that exists.
    BadDim,
    /// DIM without the memory for it.
    DimSpace,
    /// LOCAL outside a procedure or function.
    NotLocal,
    /// ENDPROC outside a procedure.
    NoProc,
    /// An array that does not exist.
    Array,
    /// A subscript below 0 or above its bound.
    Subscript,
    /// A statement that does not end where it should.
    Syntax,
    /// Division by zero.
    DivisionByZero,
    /// More than 255 characters.
    StringTooLong,
    /// A number out of range.
    TooBig,
    /// SQR of a negative number.
    NegativeRoot,
    /// LN or LOG of zero or less.
    LogRange,
    /// A trigonometric function of a huge angle.
    AccuracyLost,
    /// EXP of a large number.
    ExpRange,
    /// A mode that does not exist or does not fit.
    BadMode,
    /// A variable without a value.
    NoSuchVariable,
    /// A closing bracket is wanted.
    MissingBracket,
    /// `&` without digits.
    BadHex,
    /// A call of what is not defined.
    NoSuchFnProc,
    /// A call without a name.
    BadCall,
    /// The wrong number of arguments.
    Arguments,
    /// NEXT without FOR.
    NoFor,
    /// NEXT of a variable without a FOR.
    CantMatchFor,
    /// FOR of what is not a numeric variable.
    ForVariable,
    /// More than 10 FORs deep.
    TooManyFors,
    /// FOR without TO.
    NoTo,
    /// More than 26 GOSUBs deep.
    TooManyGosubs,
    /// RETURN without GOSUB.
    NoGosub,
    /// ON without GOTO or GOSUB.
    OnSyntax,
    /// ON with a value without a line.
    OnRange,
    /// A line number that does not exist.
    NoSuchLine,
    /// READ past the last DATA.
    OutOfData,
    /// UNTIL without REPEAT.
    NoRepeat,
    /// More than 20 REPEATs deep.
    TooManyRepeats,
    /// A file statement without `#`.
    MissingHash,
    /// The files' capacity is used up.
    DiskFull,
    /// A channel that is not open.
    Channel,
    /// Reading past the end of a file.
    Eof,
    /// An expression nested deeper than this machine follows.
    TooDeep,
    /// A star command that this machine does not know.
    BadCommand,
    /// What this machine leaves out: machine code (the assembler, CALL and USR) and CHAIN.
    NotHere,
    /// Not an error of the program: the run is being stopped (limit or watcher).
    Halt,
}

impl Error {
    /// What ERR holds and REPORT prints.
    pub fn number_and_message(self) -> (u8, &'static str) {
        match self {
            Self::NoRoom => (0, "No room"),
            Self::BadProgram => (0, "Bad program"),
            Self::Stop => (0, "STOP"),
            Self::Mistake => (4, "Mistake"),
            Self::MissingComma => (5, "Missing ,"),
            Self::TypeMismatch => (6, "Type mismatch"),
            Self::NoFn => (7, "No FN"),
            Self::StringRange => (8, "$ range"),
            Self::MissingQuote => (9, "Missing \""),
            Self::BadDim => (10, "Bad DIM"),
            Self::DimSpace => (11, "DIM space"),
            Self::NotLocal => (12, "Not LOCAL"),
            Self::NoProc => (13, "No PROC"),
            Self::Array => (14, "Array"),
            Self::Subscript => (15, "Subscript"),
            Self::Syntax => (16, "Syntax error"),
            Self::DivisionByZero => (18, "Division by zero"),
            Self::StringTooLong => (19, "String too long"),
            Self::TooBig => (20, "Too big"),
            Self::NegativeRoot => (21, "-ve root"),
            Self::LogRange => (22, "Log range"),
            Self::AccuracyLost => (23, "Accuracy lost"),
            Self::ExpRange => (24, "Exp range"),
            Self::BadMode => (25, "Bad MODE"),
            Self::NoSuchVariable => (26, "No such variable"),
            Self::MissingBracket => (27, "Missing )"),
            Self::BadHex => (28, "Bad HEX"),
            Self::NoSuchFnProc => (29, "No such FN/PROC"),
            Self::BadCall => (30, "Bad call"),
            Self::Arguments => (31, "Arguments"),
            Self::NoFor => (32, "No FOR"),
            Self::CantMatchFor => (33, "Can't match FOR"),
            Self::ForVariable => (34, "FOR variable"),
            Self::TooManyFors => (35, "Too many FORs"),
            Self::NoTo => (36, "No TO"),
            Self::TooManyGosubs => (37, "Too many GOSUBs"),
            Self::NoGosub => (38, "No GOSUB"),
            Self::OnSyntax => (39, "ON syntax"),
            Self::OnRange => (40, "ON range"),
            Self::NoSuchLine => (41, "No such line"),
            Self::OutOfData => (42, "Out of DATA"),
            Self::NoRepeat => (43, "No REPEAT"),
            Self::TooManyRepeats => (44, "Too many REPEATs"),
            Self::MissingHash => (45, "Missing #"),
            Self::DiskFull => (198, "Disk full"),
            Self::Channel => (222, "Channel"),
            Self::Eof => (223, "EOF"),
            Self::TooDeep => (0, "Expression too deep"),
            Self::BadCommand => (254, "Bad command"),
            Self::NotHere => (
                253,
                "Not in this machine: CHAIN, and the assembler, CALL and USR (machine code runs on `slowlight vm 6502:bbc`)",
            ),
            Self::Halt => (17, "Escape"),
        }
    }
}

impl From<RealError> for Error {
    fn from(e: RealError) -> Self {
        match e {
            RealError::TooBig => Self::TooBig,
            RealError::DivisionByZero => Self::DivisionByZero,
            RealError::NegativeRoot => Self::NegativeRoot,
            RealError::LogRange => Self::LogRange,
            RealError::AccuracyLost => Self::AccuracyLost,
            RealError::ExpRange => Self::ExpRange,
        }
    }
}
