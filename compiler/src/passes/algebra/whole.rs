//! Polynomials made whole by a number.

use super::New;
use super::form::Forms;
use super::number::{Number, common};
use super::poly::Poly;
use super::put::Put;
use crate::flow::build::Builder;
use crate::flow::graph::*;
use crate::range::Ranges;
use crate::source::Span;
use slowlight_routine::{Op, Value};

/// Values that are polynomials, multiplied by the least number that makes all of
/// them whole, with whole coefficients; by 1 where there is none that is not large.
pub struct Whole<'g> {
    forms: Forms<'g>,
    /// That number.
    pub by: f64,
}

/// What such a number stays below.
const LARGE: i128 = 100_000;

impl<'g> Whole<'g> {
    pub fn new(graph: &'g Graph, ranges: &'g Ranges, values: &[NodeId]) -> Whole<'g> {
        let forms = Forms::new(graph, ranges);
        let by = values.iter().try_fold(1i128, |by, id| {
            let d = match Self::poly(&forms, *id)?.content()? {
                Number::Exact(_, d) if d < LARGE => d,
                _ => return None,
            };
            let both = by / common(by, d) * d;
            (both < LARGE).then_some(both)
        });
        let by = by.map_or(1.0, |by| by as f64);
        Whole { forms, by }
    }

    fn poly<'f>(forms: &'f Forms<'_>, id: NodeId) -> Option<&'f Poly> {
        match forms.get(id)?.parts.as_slice() {
            [part] if part.roots.is_empty() => Some(&part.poly),
            _ => None,
        }
    }

    /// A value times the number, as whole numbers where it is.
    pub fn put(
        &self,
        builder: &mut Builder,
        new: New<'_>,
        id: NodeId,
        span: Span,
    ) -> Option<NodeId> {
        if self.by == 1.0 {
            return new(id);
        }
        let by = Number::of(self.by);
        let poly = Self::poly(&self.forms, id).map(|poly| poly.scaled(by));
        let mut put = Put {
            forms: &self.forms,
            builder,
            new,
            span,
        };
        if let Some(out) = poly.and_then(|poly| put.poly(&poly))
            && out.whole
        {
            return Some(put.real(out));
        }
        let by = builder.constant(Value::Real(self.by), span);
        Some(builder.apply(Op::Mul, &[new(id)?, by], span))
    }
}
