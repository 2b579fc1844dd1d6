//! From trees to a [`Program`]: names, types, arguments.
//!
//! Every item is checked, whether anything calls it or not. Two layers of
//! names: a file's hide the library's, and the library's bodies see only the
//! library. The types of constants and of scenes' tags are not written, so
//! they are found on demand ([`items`]); a cycle shows in [`cycles`].
//!
//! An error is reported once: what could not be typed has [`Ty::Error`], which
//! fits everywhere.

mod call;
mod cycles;
mod each;
mod expr;
mod flow;
mod head;
mod items;
mod literal;
mod names;
mod ops;
mod scenes;
mod scopes;
mod types;

use super::builtins::{Signature, signatures};
use super::program::*;
use super::ty::Ty;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree;
pub use names::known;
use names::{Entity, Layers};
pub(super) use ops::symbol;
use rustc_hash::FxHashMap;
use scopes::Scopes;

/// How deep expressions may nest, constants that refer to constants included.
const DEPTH: usize = 320;
/// How deep loops may nest: finding the types of carried values may take a
/// few rounds a loop, and rounds multiply.
const LOOPS: usize = 6;
/// How many expressions are checked at most, repetitions counted.
const STEPS: usize = 3_000_000;
/// How many functions of a scene may share a name: a call looks at all of them.
const SHARERS: usize = 64;
/// Errors shown at most; more would only bury the first.
const SHOWN: usize = 100;

/// A loop whose body is being checked.
struct OpenLoop {
    names: Vec<String>,
    types: Vec<Ty>,
    /// Types that hold both the start and every `next` so far.
    joined: Vec<Ty>,
}

/// What is known inside the body that is being checked.
#[derive(Default)]
struct Context {
    /// The item, for the graph of mentions.
    item: Option<Entity>,
    /// Whether it is the library's.
    library: bool,
    locals: Vec<Local>,
    scopes: Scopes,
    loops: Vec<OpenLoop>,
    /// What the `each`s around this place count, and where they say so.
    counters: Vec<(String, Span)>,
    /// How many loops enclose this place, in whatever part of them.
    nest: usize,
    /// Whether `spread` may stand here.
    dither: bool,
}

/// What is still to be checked when it is first needed.
#[derive(Clone, Copy)]
enum State<'a, T: ?Sized> {
    Todo(&'a T),
    Busy,
    Done,
}

/// An item whose head is known and whose body is to be checked.
enum Pending<'a> {
    Function(FunctionId, &'a tree::Function, Option<&'a tree::Expr>),
    Shape(ShapeId, &'a [tree::Binding], &'a [tree::Facet]),
    Record(RecordId, &'a [tree::Binding]),
    Param(ParamId, &'a tree::Param),
    Draw(&'a tree::Name, &'a tree::Name, &'a tree::Expr, Span),
}

/// The checker's state.
struct Checker<'a> {
    program: Program,
    diagnostics: Vec<Diagnostic>,
    layers: Layers,
    signatures: Vec<Signature>,
    cx: Context,
    consts: Vec<State<'a, tree::Expr>>,
    scenes: Vec<State<'a, [tree::Member]>>,
    pending: Vec<(bool, Pending<'a>)>,
    /// Which item mentions which, and where.
    mentions: Vec<(Entity, Entity, Span)>,
    /// What was said and mentioned while something was found on demand: a
    /// loop that is checked again must not forget it.
    settled: Vec<Diagnostic>,
    settled_mentions: Vec<(Entity, Entity, Span)>,
    /// Types of the scene's own expressions, as they are found, if somebody asks for them.
    noted: Option<FxHashMap<Span, Ty>>,
    depth: usize,
    steps: usize,
}

/// Checks the files' items together. A program comes back in any case; it may
/// be lowered only where no diagnostic is an error.
pub fn check(files: &[(tree::File, bool)]) -> (Program, Vec<Diagnostic>) {
    let (program, diagnostics, _) = check_with(files, None);
    (program, diagnostics)
}

/// The same, with the types of the scene's own expressions, those of what is wrong elsewhere
/// included: of an expression that is checked more than once the last stands.
pub fn check_noting(
    files: &[(tree::File, bool)],
) -> (Program, Vec<Diagnostic>, FxHashMap<Span, Ty>) {
    check_with(files, Some(FxHashMap::default()))
}

fn check_with(
    files: &[(tree::File, bool)],
    noted: Option<FxHashMap<Span, Ty>>,
) -> (Program, Vec<Diagnostic>, FxHashMap<Span, Ty>) {
    let mut checker = Checker {
        program: Program::default(),
        diagnostics: Vec::new(),
        layers: Layers::default(),
        signatures: signatures(),
        cx: Context::default(),
        consts: Vec::new(),
        scenes: Vec::new(),
        pending: Vec::new(),
        mentions: Vec::new(),
        settled: Vec::new(),
        settled_mentions: Vec::new(),
        noted,
        depth: 0,
        steps: 0,
    };
    checker.predefine();
    checker.heads(files);
    checker.bodies();
    checker.settle(Vec::new(), Vec::new());
    std::mem::swap(&mut checker.diagnostics, &mut checker.settled);
    std::mem::swap(&mut checker.mentions, &mut checker.settled_mentions);
    checker.cycles();
    checker.complete(files);
    let Checker {
        program,
        mut diagnostics,
        noted,
        ..
    } = checker;
    tidy(&mut diagnostics);
    (program, diagnostics, noted.unwrap_or_default())
}

/// In source order, each once, and not more than anyone reads.
pub fn tidy(diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.sort_by_key(|d| (d.span.file, d.span.start, d.span.end));
    let mut seen = std::collections::HashSet::new();
    diagnostics.retain(|d| seen.insert((d.span, d.message.clone())));
    diagnostics.truncate(SHOWN);
}

impl Checker<'_> {
    fn report(&mut self, diagnostic: Diagnostic) {
        if self.diagnostics.len() < 10 * SHOWN {
            self.diagnostics.push(diagnostic);
        }
    }

    /// Puts what was said since `diagnostics` and `mentions` were taken where
    /// nothing forgets it, and brings these back.
    fn settle(&mut self, diagnostics: Vec<Diagnostic>, mentions: Vec<(Entity, Entity, Span)>) {
        let said = std::mem::replace(&mut self.diagnostics, diagnostics);
        let mentioned = std::mem::replace(&mut self.mentions, mentions);
        self.settled.extend(said);
        self.settled_mentions.extend(mentioned);
    }

    fn error(&mut self, span: Span, message: impl Into<String>) {
        self.report(Diagnostic::error(span, message));
    }

    /// A type with its article.
    fn a(&self, ty: &Ty) -> String {
        ty.a(&self.program)
    }

    /// Runs with a fresh frame; answers the frame beside the result.
    fn within<T>(&mut self, cx: Context, work: impl FnOnce(&mut Self) -> T) -> (T, Vec<Local>) {
        let outer = std::mem::replace(&mut self.cx, cx);
        let result = work(self);
        let inner = std::mem::replace(&mut self.cx, outer);
        (result, inner.locals)
    }

    /// Declares a local of the current frame.
    fn local(&mut self, name: &str, ty: Ty) -> LocalId {
        let id = LocalId(self.cx.locals.len());
        self.cx.locals.push(Local {
            name: name.to_owned(),
            ty,
        });
        self.cx.scopes.push(name, id);
        id
    }

    /// Makes `value` a `want`, or reports at its place that it is none; `what`
    /// says what is wanted.
    fn coerce(&mut self, value: Expr, want: &Ty, what: &str) -> Expr {
        if !value.ty.fits(want) {
            let message = format!("{what} is {}; this is {}", self.a(want), self.a(&value.ty));
            let mut error = Diagnostic::error(value.span, message);
            if let Some(help) = self.conversion(&value.ty, want) {
                error = error.help(help);
            }
            self.report(error);
            return Expr::error(value.span);
        }
        widen(value, want)
    }

    /// How an author may get from one type to another.
    pub(super) fn conversion(&self, from: &Ty, to: &Ty) -> Option<String> {
        Some(match (from, to) {
            (Ty::Real, Ty::Int) => "`floor` or `round` makes a real an int".into(),
            (Ty::Int | Ty::Real, Ty::Angle) => {
                "angles carry a unit: `90deg`, `x * 1rad`, `x * 1turn`".into()
            }
            (Ty::Angle, Ty::Real | Ty::Int) => "divide the angle by `1rad` or `1turn`".into(),
            (Ty::Int | Ty::Real, Ty::Ink) => "`ink(i)` is the palette's ink number i".into(),
            (Ty::Vector(3), Ty::Ink) => {
                "`paint(c, x, y)` is an ink for a colour of red, green and blue from 0 to 1".into()
            }
            (Ty::Int | Ty::Real, Ty::Bool) => "a comparison is a bool: `a != 0`".into(),
            (Ty::Optional(_), Ty::Bool) => {
                "to ask whether it is there, write `if let v = .. then .. else ..`".into()
            }
            (Ty::Optional(inner), want) if **inner != Ty::Never && inner.fits(want) => format!(
                "take it apart: `if let v = .. then .. else ..`; `v` is {}",
                self.a(inner)
            ),
            (from, Ty::Vector(n)) if from.is_real() => {
                format!(
                    "write {n} components: `({})`",
                    vec!["v"; usize::from(*n)].join(", ")
                )
            }
            (Ty::Vector(2), Ty::Vector(3)) => "give it a third component: `(v.x, v.y, 0)`".into(),
            (Ty::Vector(3), Ty::Vector(2)) => {
                "take two of its components: `v.xy`, `v.xz` or `v.yz`".into()
            }
            (Ty::Vector(_), to) if to.is_real() => {
                "take a component, `v.x`, or its length: `length(v)`".into()
            }
            (Ty::Hit(None), Ty::Hit(Some(_))) => "hits of a bare shape have no tag".into(),
            _ => return None,
        })
    }
}

/// Makes the widening to `want`, which fits, explicit.
fn widen(value: Expr, want: &Ty) -> Expr {
    if value.ty == *want || matches!(value.ty, Ty::Error | Ty::Never) || *want == Ty::Error {
        return value;
    }
    let span = value.span;
    let kind = match (value.kind, want) {
        (ExprKind::Int(i), Ty::Real) => ExprKind::Real(f64::from(i)),
        (kind, _) => ExprKind::Convert(Box::new(Expr { kind, ..value })),
    };
    Expr {
        kind,
        ty: want.clone(),
        span,
    }
}
