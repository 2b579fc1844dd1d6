//! Params: their values, ranges and what the user sets; and the picture's shade.

use super::flow::Leaf;
use super::value::{Val, scalar};
use super::{Found, Freeze, Lower, Options};
use crate::ir::graph;
use crate::ir::graph::NodeId;
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use slowlight_routine::{Op, Range, Type, Value};

const COMPONENTS: [&str; 3] = ["x", "y", "z"];

/// The palette on a screen of `inks` inks: evenly, first and last kept.
pub(super) fn thin(palette: &[[u8; 3]], inks: Option<u32>) -> Vec<[u8; 3]> {
    let have = palette.len();
    let want = inks.map_or(have, |n| (n as usize).clamp(2, have.max(2)));
    if want >= have {
        return palette.to_vec();
    }
    let at = |k: usize| (2 * k * (have - 1) + (want - 1)) / (2 * (want - 1));
    (0..want)
        .filter_map(|k| palette.get(at(k)).copied())
        .collect()
}

impl<'a> Lower<'a> {
    /// Names in the options that the scene does not have.
    pub(super) fn check_options(&self, place: Span) -> Result<(), Vec<Diagnostic>> {
        let mut said = Vec::new();
        let params: Vec<&str> = self
            .program
            .params
            .iter()
            .map(|p| p.name.as_str())
            .collect();
        let functions = self.program.functions.iter();
        let effects: Vec<&str> = functions
            .filter(|f| matches!(f.kind, FunctionKind::Effect { .. }))
            .map(|f| f.name.as_str())
            .collect();
        let mut unknown = |what: &str, name: &str, names: &[&str]| {
            if !names.contains(&name) {
                let error = Diagnostic::error(place, format!("the scene has no {what} `{name}`"));
                said.push(match names.is_empty() {
                    true => error,
                    false => error.help(format!("it has {}", names.join(", "))),
                });
            }
        };
        let declared = self.program.declared();
        for (name, _) in &self.options.set {
            unknown(declared, name, &params);
        }
        if let Freeze::Some(names) = &self.options.freeze {
            for name in names {
                unknown(declared, name, &params);
            }
        }
        for name in &self.options.without {
            unknown("effect", name, &effects);
        }
        if said.is_empty() { Ok(()) } else { Err(said) }
    }

    /// Makes every param's node or constant.
    pub(super) fn declare_params(&mut self, said: &mut Vec<Diagnostic>) {
        let mut found = Vec::new();
        for param in &self.program.params {
            let value = self.declare_param(param).unwrap_or_else(|e| {
                said.push(*e);
                Val::Undefined
            });
            found.push(value);
        }
        self.params = found;
    }

    fn numbers(&mut self, body: &'a Body, ty: &Ty) -> Found<Vec<Value>> {
        let value = self.constant_body(body)?;
        let span = body.value.span;
        let mut nodes = Vec::new();
        self.flatten(value, ty, &mut nodes, span)?;
        let values: Option<Vec<Value>> = nodes.iter().map(|&n| self.b.value(n)).collect();
        values.ok_or_else(|| Box::new(self.error(span, "this is not constant")))
    }

    fn declare_param(&mut self, param: &'a Param) -> Found<Val> {
        let mut values = self.numbers(&param.value, &param.ty)?;
        let mut place = param.value.value.span;
        let ranges = match &param.range {
            None => vec![None; values.len()],
            Some((lo, hi)) => {
                let lows = self.numbers(lo, &param.ty)?;
                let highs = self.numbers(hi, &param.ty)?;
                let pairs = lows.iter().zip(&highs);
                let mut found = Vec::new();
                for (lo, hi) in pairs.map(|(l, h)| (l.real(), h.real())) {
                    if lo > hi {
                        let span = param.range.as_ref().map_or(place, |r| r.0.value.span);
                        let message = format!("this range is empty: {lo} is above {hi}");
                        let error = Diagnostic::error(span, message);
                        let help =
                            "a range goes from the least to the greatest, component by component";
                        return Err(Box::new(error.help(help)));
                    }
                    found.push(Some(Range::new(lo, hi)));
                }
                found
            }
        };
        let usual = values.clone();
        if let Some((_, set)) = self
            .options
            .set
            .iter()
            .rev()
            .find(|(n, _)| *n == param.name)
        {
            place = param.span;
            values = self.given(param, set, &values)?;
        }
        for (k, (value, range)) in values.iter().zip(&ranges).enumerate() {
            let value = value.real();
            if let Some(range) = range
                && !(range.lo..=range.hi).contains(&value)
            {
                let label = label(param, k);
                let written = |value: f64| match param.ty {
                    Ty::Angle => format!("{}deg", (value.to_degrees() * 1e6).round() / 1e6),
                    _ => value.to_string(),
                };
                let message = format!(
                    "`{label}` is {}, outside its range {} .. {}",
                    written(value),
                    written(range.lo),
                    written(range.hi)
                );
                let error = Diagnostic::error(place, message);
                return Err(Box::new(
                    error.help("give another value, or widen the range"),
                ));
            }
        }
        let frozen = match &self.options.freeze {
            Freeze::Nothing => false,
            Freeze::All => true,
            Freeze::Some(names) => names.contains(&param.name),
        };
        // What moves is no constant.
        let frozen = frozen && !(self.options.moves && param.next.is_some());
        let mut nodes = Vec::new();
        let values = values.into_iter().zip(usual);
        for (k, ((value, usual), range)) in values.zip(ranges).enumerate() {
            nodes.push(match frozen {
                true => self.b.constant(value, param.span),
                false => self.b.param(graph::Param {
                    name: param.name.clone(),
                    component: component(param, k),
                    role: match param.next {
                        Some(_) if self.options.moves => graph::Role::State,
                        _ => graph::Role::Param,
                    },
                    ty: value.ty(),
                    value: value.real(),
                    usual: usual.real(),
                    range,
                    span: param.span,
                }),
            });
        }
        Ok(self.unflatten(&param.ty, &mut nodes.into_iter()))
    }

    /// The values that `--set` gives, in the types of the param's own.
    fn given(&self, param: &Param, set: &[f64], own: &[Value]) -> Found<Vec<Value>> {
        let wrong = |message: String| Err(Box::new(Diagnostic::error(param.span, message)));
        if set.len() != own.len() {
            return wrong(format!(
                "`{}` has {}, not {}",
                param.name,
                match own.len() {
                    1 => "1 number".to_owned(),
                    n => format!("{n} numbers"),
                },
                set.len()
            ));
        }
        let mut found = Vec::new();
        for (&value, own) in set.iter().zip(own) {
            if !value.is_finite() {
                return wrong(format!("`{}` cannot be {value}", param.name));
            }
            found.push(match own.ty() {
                Type::Real => Value::Real(value),
                Type::Int if value.fract() == 0.0 && value.abs() < 2f64.powi(31) => {
                    Value::Int(value as i32)
                }
                Type::Bool if value == 0.0 || value == 1.0 => Value::Bool(value == 1.0),
                Type::Int => return wrong(format!("`{}` is an int, not {value}", param.name)),
                Type::Bool => return wrong(format!("`{}` is 0 or 1, not {value}", param.name)),
            });
        }
        Ok(found)
    }

    /// Evaluates every constant of the scene, used or not.
    pub(super) fn evaluate_consts(&mut self, said: &mut Vec<Diagnostic>) {
        for (k, item) in self.program.consts.iter().enumerate() {
            if !item.library
                && let Err(error) = self.constant_item(ConstId(k), item.span)
            {
                said.push(*error);
            }
        }
    }

    /// The picture's ink, and the shade that it is made of: the `v` of the
    /// dither that `draw` ends in, through blocks and conditions; where another
    /// branch has an ink without a dither, its ink over the greatest.
    pub(super) fn shaded(&mut self, e: &'a Expr) -> Found<(Val, Option<NodeId>)> {
        self.step(e.span)?;
        match &e.kind {
            ExprKind::Block { statements, result } => {
                for statement in statements {
                    self.statement(statement)?;
                }
                self.shaded(result)
            }
            ExprKind::If { condition, yes, no } => {
                let test = self.expr(condition)?;
                let test = self.node(test, &Ty::Bool, condition.span)?;
                if let Some(known) = self.b.value(test) {
                    return self.shaded(if known.truth() { yes } else { no });
                }
                self.choices += 1;
                let yes = self.shaded(yes)?;
                let no = self.shaded(no)?;
                self.choices -= 1;
                let shade = match (yes.1, no.1) {
                    (None, None) => None,
                    (a, b) => {
                        let a = self.shade_or_ink(a, &yes.0, e)?;
                        let b = self.shade_or_ink(b, &no.0, e)?;
                        Some(self.select(test, a, b, e.span))
                    }
                };
                Ok((self.merge(test, yes.0, no.0, e.span)?, shade))
            }
            ExprKind::Call {
                callee: Callee::Function(id),
                args,
            } => {
                let Some(function) = self.program.functions.get(id.0) else {
                    return Err(self.confused(e.span));
                };
                let values = self.arguments(&function.params, args, e.span)?;
                let first = function.params.first();
                let shade = match first {
                    Some(p) if p.name == "v" && p.ty == Ty::Real && function.result == Ty::Ink => {
                        let value = values.first().cloned().unwrap_or(Val::Undefined);
                        Some(self.node(value, &Ty::Real, e.span)?)
                    }
                    _ => None,
                };
                Ok((self.pixel_ink(function, values, e.span)?, shade))
            }
            _ => {
                let Leaf { done, .. } = self.tail(e)?;
                Ok((done, None))
            }
        }
    }

    fn shade_or_ink(&mut self, shade: Option<NodeId>, ink: &Val, e: &'a Expr) -> Found<NodeId> {
        if let Some(shade) = shade {
            return Ok(shade);
        }
        let ink = self.node(ink.clone(), &Ty::Ink, e.span)?;
        let ink = self.apply(Op::ToReal, &[ink], e.span)?;
        let last = self.real(self.image.palette.len() as f64 - 1.0, e.span);
        self.apply(Op::Div, &[ink, last], e.span)
    }
}

/// Whether the params of a program that was checked without errors are right, with the
/// values that options set.
///
/// # Errors
/// What is wrong.
pub fn params(program: &Program, options: &Options) -> Result<(), Vec<Diagnostic>> {
    let Some(image) = &program.image else {
        return Ok(());
    };
    let mut lower = Lower::new(program, options, image);
    lower.check_options(image.span)?;
    let mut said = Vec::new();
    lower.declare_params(&mut said);
    match said.is_empty() {
        true => Ok(()),
        false => Err(said),
    }
}

fn component(param: &Param, at: usize) -> &'static str {
    match scalar(&param.ty) {
        Some(_) => "",
        None => COMPONENTS.get(at).copied().unwrap_or(""),
    }
}

fn label(param: &Param, at: usize) -> String {
    match component(param, at) {
        "" => param.name.clone(),
        part => format!("{}.{part}", param.name),
    }
}
