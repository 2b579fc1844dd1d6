//! The program as text, for `--emit program`: the scene's own items, then what
//! they use of the library. Names are resolved (`unit<vec3>` says which of
//! several), types are written, and widenings stand as `as real`.

mod each;

use super::check::symbol;
use super::program::*;
use super::ty::Ty;
use crate::ir::print::value_text;
use crate::syntax::tree::{Claim, UnaryOp};
use slowlight_routine::Value;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fmt;

/// What is mentioned and may be the library's.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Used {
    Record(usize),
    Const(usize),
    Function(usize),
    Shape(usize),
}

struct Printer<'p> {
    program: &'p Program,
    used: RefCell<BTreeSet<Used>>,
}

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let printer = Printer {
            program: self,
            used: RefCell::default(),
        };
        if let Some(image) = &self.image {
            write!(f, "image {} x {} inks", image.width, image.height)?;
            for [r, g, b] in &image.palette {
                write!(f, " #{r:02x}{g:02x}{b:02x}")?;
            }
            writeln!(f)?;
        }
        for param in &self.params {
            let value = printer.expr(&param.value, &param.value.value, 0);
            let what = match param.next {
                Some(_) => "state",
                None => "param",
            };
            write!(
                f,
                "{what} {}: {} = {value}",
                param.name,
                param.ty.show(self)
            )?;
            if let Some((lo, hi)) = &param.range {
                let lo = printer.expr(lo, &lo.value, 0);
                write!(f, " in {lo} .. {}", printer.expr(hi, &hi.value, 0))?;
            }
            if let Some(next) = &param.next {
                write!(f, " -> {}", printer.expr(next, &next.value, 0))?;
            }
            writeln!(f)?;
        }
        for map in &self.maps {
            let cells: Vec<String> = map.cells.iter().map(i32::to_string).collect();
            writeln!(
                f,
                "map {} {}x{}: {}",
                map.name,
                map.width,
                map.height,
                cells.join(" ")
            )?;
        }
        let mut done: BTreeSet<Used> = BTreeSet::new();
        for (item, library) in printer.items() {
            if !library {
                done.insert(item);
                f.write_str(&printer.item(item))?;
            }
        }
        for scene in &self.scenes {
            writeln!(f, "scene {} {{", scene.name)?;
            for member in &scene.members {
                f.write_str(&printer.member(member, 1))?;
            }
            writeln!(f, "}}")?;
        }
        if let Some(draw) = &self.draw {
            let names: Vec<&str> = draw.body.locals.iter().map(|l| l.name.as_str()).collect();
            let (x, y) = (names.first().unwrap_or(&"x"), names.get(1).unwrap_or(&"y"));
            let body = printer.expr(&draw.body, &draw.body.value, 0);
            writeln!(f, "draw ({x}, {y}) = {body}")?;
        }
        loop {
            let next = printer
                .used
                .borrow()
                .iter()
                .copied()
                .find(|u| !done.contains(u));
            let Some(next) = next else {
                return Ok(());
            };
            done.insert(next);
            f.write_str(&printer.item(next))?;
        }
    }
}

impl Printer<'_> {
    fn items(&self) -> Vec<(Used, bool)> {
        let p = self.program;
        let records = p.records.iter().enumerate();
        let records = records.map(|(k, r)| (Used::Record(k), r.library));
        let consts = p.consts.iter().enumerate();
        let consts = consts.map(|(k, c)| (Used::Const(k), c.library));
        let functions = p.functions.iter().enumerate();
        let functions = functions.map(|(k, f)| (Used::Function(k), f.library));
        let shapes = p.shapes.iter().enumerate();
        let shapes = shapes.map(|(k, s)| (Used::Shape(k), s.library));
        records
            .chain(consts)
            .chain(functions)
            .chain(shapes)
            .collect()
    }

    fn item(&self, item: Used) -> String {
        let p = self.program;
        let library = |yes: bool| if yes { "library " } else { "" };
        match item {
            Used::Record(k) => p.records.get(k).map_or(String::new(), |r| {
                let fields = self.params(&r.fields);
                format!("{}record {} {{ {fields} }}\n", library(r.library), r.name)
            }),
            Used::Const(k) => p.consts.get(k).map_or(String::new(), |c| {
                let ty = c.body.value.ty.show(p);
                let value = self.expr(&c.body, &c.body.value, 0);
                format!("{}const {}: {ty} = {value}\n", library(c.library), c.name)
            }),
            Used::Function(k) => p.functions.get(k).map_or(String::new(), |f| {
                let (kind, otherwise) = match &f.kind {
                    FunctionKind::Plain => ("fn", String::new()),
                    FunctionKind::Dither => ("dither", String::new()),
                    FunctionKind::Effect { otherwise } => {
                        let value = self.expr(otherwise, &otherwise.value, 0);
                        ("effect", format!(" else {value}"))
                    }
                };
                let (params, result) = (self.params(&f.params), f.result.show(p));
                let body = self.expr(&f.body, &f.body.value, 1);
                let head = format!(
                    "{}{kind} {}({params}) -> {result}",
                    library(f.library),
                    f.name
                );
                format!("{head}{otherwise} =\n  {body}\n")
            }),
            Used::Shape(k) => p.shapes.get(k).map_or(String::new(), |s| {
                let params = self.params(&s.params);
                let mut out = format!("{}shape {}({params}) {{\n", library(s.library), s.name);
                for facet in &s.facets {
                    let arg = match facet.kind {
                        FacetKind::Bound | FacetKind::Steps => String::new(),
                        _ => format!(
                            "({})",
                            facet
                                .body
                                .locals
                                .get(s.params.len())
                                .map_or("", |l| &l.name)
                        ),
                    };
                    let body = self.expr(&facet.body, &facet.body.value, 1);
                    out += &format!("  {}{arg} = {body}\n", facet.kind.name());
                }
                out + "}\n"
            }),
        }
    }

    fn params(&self, params: &[Parameter]) -> String {
        let list: Vec<String> = params
            .iter()
            .map(|p| {
                let ty = p.ty.show(self.program);
                match &p.default {
                    Some(d) => format!("{}: {ty} = {}", p.name, self.expr(d, &d.value, 0)),
                    None => format!("{}: {ty}", p.name),
                }
            })
            .collect();
        list.join(", ")
    }

    fn callee(&self, body: &Body, callee: &Callee) -> String {
        let p = self.program;
        match callee {
            Callee::Function(id) => {
                self.used.borrow_mut().insert(Used::Function(id.0));
                let Some(f) = p.functions.get(id.0) else {
                    return "?".into();
                };
                let several = p.functions.iter().filter(|g| g.name == f.name).count() > 1;
                match (several, f.params.first()) {
                    (true, Some(first)) => format!("{}<{}>", f.name, first.ty.show(p)),
                    _ => f.name.clone(),
                }
            }
            Callee::Builtin(b) => b.text(),
            Callee::Shape(id) => {
                self.used.borrow_mut().insert(Used::Shape(id.0));
                p.shapes.get(id.0).map_or("?".into(), |s| s.name.clone())
            }
            Callee::Record(id) => {
                self.used.borrow_mut().insert(Used::Record(id.0));
                p.records.get(id.0).map_or("?".into(), |r| r.name.clone())
            }
            Callee::Local(id) => self.local(body, *id),
        }
    }

    fn local(&self, body: &Body, id: LocalId) -> String {
        body.locals.get(id.0).map_or("?".into(), |l| l.name.clone())
    }

    fn list<'e>(
        &self,
        body: &Body,
        list: impl IntoIterator<Item = &'e Expr>,
        deep: usize,
    ) -> String {
        let list = list.into_iter().map(|e| self.expr(body, e, deep));
        list.collect::<Vec<_>>().join(", ")
    }

    /// An expression; what goes over several lines is indented by `deep`.
    fn expr(&self, body: &Body, e: &Expr, deep: usize) -> String {
        let p = self.program;
        let of = |e: &Expr| self.expr(body, e, deep);
        let line = |more: usize| format!("\n{}", "  ".repeat(deep + more));
        match &e.kind {
            ExprKind::Error => "?".into(),
            ExprKind::Int(i) => i.to_string(),
            ExprKind::Real(r) => {
                let text = value_text(Value::Real(*r));
                let text = match text.contains(['.', 'e']) {
                    true => text,
                    false => text + ".0",
                };
                match e.ty {
                    Ty::Angle => text + "rad",
                    _ => text,
                }
            }
            ExprKind::Bool(b) => b.to_string(),
            ExprKind::None => "none".into(),
            ExprKind::Local(id) => self.local(body, *id),
            ExprKind::Param(id) => p.params.get(id.0).map_or("?".into(), |p| p.name.clone()),
            ExprKind::Const(id) => {
                self.used.borrow_mut().insert(Used::Const(id.0));
                p.consts.get(id.0).map_or("?".into(), |c| c.name.clone())
            }
            ExprKind::Map(id) => p.maps.get(id.0).map_or("?".into(), |m| m.name.clone()),
            ExprKind::Scene(id) => p.scenes.get(id.0).map_or("?".into(), |s| s.name.clone()),
            ExprKind::Known(known) => format!("{known:?}").to_lowercase(),
            ExprKind::Function(callee) => self.callee(body, callee),
            ExprKind::Tuple(parts) => format!("({})", self.list(body, parts, deep)),
            ExprKind::Table { width, entries } => {
                let rows = entries.chunks((*width).max(1));
                let rows: Vec<String> = rows.map(|r| self.list(body, r, deep)).collect();
                format!("[{}]", rows.join("; "))
            }
            ExprKind::Convert(inner) => format!("({} as {})", of(inner), e.ty.show(p)),
            ExprKind::Unary(UnaryOp::Neg, inner) => format!("-{}", of(inner)),
            ExprKind::Unary(UnaryOp::Not, inner) => format!("(not {})", of(inner)),
            ExprKind::Binary(op, a, b) => format!("({} {} {})", of(a), symbol(*op), of(b)),
            ExprKind::Call { callee, args } => {
                let args: Vec<String> = args
                    .iter()
                    .map(|a| a.as_ref().map_or("_".into(), &of))
                    .collect();
                format!("{}({})", self.callee(body, callee), args.join(", "))
            }
            ExprKind::Part(base, k) => {
                let name = match &base.ty {
                    Ty::Ray => RAY_PARTS.get(*k).copied().unwrap_or("?").to_owned(),
                    Ty::Hit(_) => HIT_PARTS.get(*k).copied().unwrap_or("?").to_owned(),
                    Ty::Record(id) => {
                        let field = p.records.get(id.0).and_then(|r| r.fields.get(*k));
                        field.map_or("?".into(), |f| f.name.clone())
                    }
                    _ => "?".into(),
                };
                format!("{}.{name}", of(base))
            }
            ExprKind::Swizzle(base, places) => {
                let letters: String = places
                    .iter()
                    .map(|&k| ["x", "y", "z"].get(k).copied().unwrap_or("?"))
                    .collect();
                format!("{}.{letters}", of(base))
            }
            ExprKind::Index(base, indices) => {
                format!("{}[{}]", of(base), self.list(body, indices, deep))
            }
            ExprKind::If { condition, yes, no } => {
                let (then, otherwise) = (line(1) + "then ", line(1) + "else ");
                let yes = self.expr(body, yes, deep + 1);
                let no = self.expr(body, no, deep + 1);
                format!("if {}{then}{yes}{otherwise}{no}", of(condition))
            }
            ExprKind::IfLet {
                local,
                condition,
                yes,
                no,
            } => {
                let (then, otherwise) = (line(1) + "then ", line(1) + "else ");
                let name = self.local(body, *local);
                let yes = self.expr(body, yes, deep + 1);
                let no = self.expr(body, no, deep + 1);
                format!(
                    "if let {name} = {}{then}{yes}{otherwise}{no}",
                    of(condition)
                )
            }
            ExprKind::Loop {
                carried,
                max,
                body: turn,
                otherwise,
            } => {
                let carried: Vec<String> = carried
                    .iter()
                    .map(|(id, init)| {
                        let ty = body.locals.get(id.0).map_or("?".into(), |l| l.ty.show(p));
                        format!("{}: {ty} = {}", self.local(body, *id), of(init))
                    })
                    .collect();
                let head = format!("loop ({}) max {}", carried.join(", "), of(max));
                let turn = self.expr(body, turn, deep + 1);
                format!("{head}{}{turn}{}else {}", line(1), line(0), of(otherwise))
            }
            ExprKind::Each(each) => self.each(body, each, deep),
            ExprKind::Next(values) => format!("next({})", self.list(body, values, deep)),
            ExprKind::Block { statements, result } => {
                let mut out = "{".to_owned();
                for statement in statements {
                    out += &line(1);
                    match statement {
                        Statement::Let {
                            claim,
                            local,
                            value,
                        } => {
                            let claim = match claim.map(|c| c.0) {
                                None => "",
                                Some(Claim::Frame) => "frame ",
                                Some(Claim::Row) => "row ",
                                Some(Claim::Column) => "column ",
                            };
                            let ty = value.ty.show(p);
                            let name = self.local(body, *local);
                            let value = self.expr(body, value, deep + 1);
                            out += &format!("{claim}let {name}: {ty} = {value}");
                        }
                        Statement::Spread { value, to, .. } => {
                            let shares: Vec<String> = to
                                .iter()
                                .map(|(dx, dy, weight)| {
                                    let weight = self.expr(body, weight, deep + 1);
                                    format!("({dx}, {dy}): {weight}")
                                })
                                .collect();
                            let value = self.expr(body, value, deep + 1);
                            out += &format!("spread {value} to {{ {} }}", shares.join(", "));
                        }
                    }
                }
                let result = self.expr(body, result, deep + 1);
                format!("{out}{}{result}{}}}", line(1), line(0))
            }
        }
    }
}
