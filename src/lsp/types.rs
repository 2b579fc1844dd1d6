//! What the checker found out, by place: the type of each expression, what each call calls,
//! the types of names that are bound to an expression.

use rustc_hash::FxHashMap;
use slowlight_compiler::sema::{
    Body, Callee, Expr, ExprKind, FunctionKind, LocalId, Member, Parameter, Program, Statement, Ty,
};
use slowlight_compiler::source::Span;

/// File, first byte, end.
pub type Place = (u16, u32, u32);

/// A span as a key.
pub fn place(span: Span) -> Place {
    (span.file, span.start, span.end)
}

/// What is known by place.
#[derive(Debug, Default)]
pub struct Types {
    /// The type of an expression as it is written.
    pub of: FxHashMap<Place, Ty>,
    /// Where the name of what a call calls stands; none for what the language itself has.
    pub called: FxHashMap<Place, Option<Span>>,
    /// The type of the name that an expression's value is bound to.
    pub bound: FxHashMap<Place, Ty>,
    /// Where records' names stand, by their numbers.
    pub records: Vec<Span>,
}

impl Types {
    /// Of a program, as far as it was understood, and of expressions beside it.
    pub fn new(program: &Program, noted: &FxHashMap<Span, Ty>) -> Types {
        let mut all = Walk {
            program,
            out: Types {
                records: program.records.iter().map(|r| r.span).collect(),
                ..Types::default()
            },
        };
        for param in &program.params {
            all.body(&param.value);
            if let Some((low, high)) = &param.range {
                all.body(low);
                all.body(high);
            }
        }
        program.consts.iter().for_each(|c| all.body(&c.body));
        for function in &program.functions {
            all.defaults(&function.params);
            all.body(&function.body);
            if let FunctionKind::Effect { otherwise } = &function.kind {
                all.body(otherwise);
            }
        }
        for shape in &program.shapes {
            all.defaults(&shape.params);
            shape.facets.iter().for_each(|f| all.body(&f.body));
        }
        program.records.iter().for_each(|r| all.defaults(&r.fields));
        program.scenes.iter().for_each(|s| all.members(&s.members));
        if let Some(draw) = &program.draw {
            all.body(&draw.body);
        }
        let noted = noted.iter().map(|(span, ty)| (place(*span), ty.clone()));
        all.out.of.extend(noted);
        all.out
    }

    /// The type of an expression.
    pub fn ty(&self, span: Span) -> Option<&Ty> {
        self.of.get(&place(span)).filter(|ty| **ty != Ty::Error)
    }

    /// The smallest expression around a byte of a file.
    pub fn around(&self, file: u16, byte: usize) -> Option<(Span, &Ty)> {
        let inside = |(f, start, end): &Place| {
            *f == file && (*start as usize..*end as usize).contains(&byte)
        };
        let found = self
            .of
            .iter()
            .filter(|(at, ty)| inside(at) && **ty != Ty::Error);
        let (at, ty) = found.min_by_key(|((_, start, end), _)| (end - start, *start))?;
        Some((Span::new(at.0, at.1 as usize, at.2 as usize), ty))
    }
}

struct Walk<'p> {
    program: &'p Program,
    out: Types,
}

impl Walk<'_> {
    fn defaults(&mut self, params: &[Parameter]) {
        let defaults = params.iter().filter_map(|p| p.default.as_ref());
        defaults.for_each(|body| self.body(body));
    }

    // Members and expressions nest no deeper than the parser lets them.
    fn members(&mut self, members: &[Member]) {
        for member in members {
            match member {
                Member::One { shape, tag } => {
                    self.body(shape);
                    tag.iter().for_each(|tag| self.body(tag));
                }
                Member::Each {
                    low, high, members, ..
                } => {
                    self.body(low);
                    self.body(high);
                    self.members(members);
                }
            }
        }
    }

    fn body(&mut self, body: &Body) {
        self.expr(body, &body.value);
    }

    fn bind(&mut self, body: &Body, local: LocalId, value: &Expr) {
        if let Some(local) = body.locals.get(local.0) {
            self.out.bound.insert(place(value.span), local.ty.clone());
        }
    }

    fn callee(&mut self, callee: &Callee, span: Span) {
        let program = self.program;
        let name = match callee {
            Callee::Function(id) => program.functions.get(id.0).map(|f| f.span),
            Callee::Shape(id) => program.shapes.get(id.0).map(|s| s.span),
            Callee::Record(id) => program.records.get(id.0).map(|r| r.span),
            Callee::Builtin(_) => None,
            Callee::Local(_) => return,
        };
        self.out.called.insert(place(span), name);
    }

    fn expr(&mut self, body: &Body, expr: &Expr) {
        // What is inside of a conversion comes later and stands.
        self.out.of.insert(place(expr.span), expr.ty.clone());
        let each = |walk: &mut Self, all: &[Expr]| all.iter().for_each(|e| walk.expr(body, e));
        match &expr.kind {
            ExprKind::Error
            | ExprKind::Int(_)
            | ExprKind::Real(_)
            | ExprKind::Bool(_)
            | ExprKind::None
            | ExprKind::Local(_)
            | ExprKind::Param(_)
            | ExprKind::Const(_)
            | ExprKind::Map(_)
            | ExprKind::Scene(_)
            | ExprKind::Known(_) => {}
            ExprKind::Function(callee) => self.callee(callee, expr.span),
            ExprKind::Tuple(all) | ExprKind::Next(all) => each(self, all),
            ExprKind::Table { entries, .. } => each(self, entries),
            ExprKind::Convert(a)
            | ExprKind::Unary(_, a)
            | ExprKind::Part(a, _)
            | ExprKind::Swizzle(a, _) => self.expr(body, a),
            ExprKind::Binary(_, a, b) => {
                self.expr(body, a);
                self.expr(body, b);
            }
            ExprKind::Call { callee, args } => {
                self.callee(callee, expr.span);
                args.iter().flatten().for_each(|a| self.expr(body, a));
            }
            ExprKind::Index(a, all) => {
                self.expr(body, a);
                each(self, all);
            }
            ExprKind::If { condition, yes, no } => {
                for inner in [condition, yes, no] {
                    self.expr(body, inner);
                }
            }
            ExprKind::IfLet {
                local,
                condition,
                yes,
                no,
            } => {
                self.bind(body, *local, condition);
                for inner in [condition, yes, no] {
                    self.expr(body, inner);
                }
            }
            ExprKind::Loop {
                carried,
                max,
                body: turn,
                otherwise,
            } => {
                for (local, start) in carried {
                    self.bind(body, *local, start);
                    self.expr(body, start);
                }
                for inner in [max, turn, otherwise] {
                    self.expr(body, inner);
                }
            }
            ExprKind::Each(made) => {
                for inner in [&made.low, &made.high, &made.join, &made.body] {
                    self.expr(body, inner);
                }
            }
            ExprKind::Block { statements, result } => {
                for statement in statements {
                    match statement {
                        Statement::Let { local, value, .. } => {
                            self.bind(body, *local, value);
                            self.expr(body, value);
                        }
                        Statement::Spread { value, to, .. } => {
                            self.expr(body, value);
                            to.iter().for_each(|(_, _, weight)| self.expr(body, weight));
                        }
                    }
                }
                self.expr(body, result);
            }
        }
    }
}
