//! Primitive parts: polynomials made integral by a number.

use super::New;
use super::form::Forms;
use super::number::{Number, common};
use super::poly::Poly;
use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::emit::Put;
use crate::source::Span;
use slowlight_routine::{Op, Value};

/// Values that are polynomials, multiplied by the least number that makes all of
/// them whole, with whole coefficients; by 1 where there is none that is not large.
#[derive(Clone)]
pub struct Whole<'g> {
    forms: Forms<'g>,
    /// That number.
    pub by: f64,
}

/// What such a number stays below.
const LARGE: i128 = 100_000;

/// The least multiple of a number that makes a polynomial whole as well.
fn whole_too(by: i128, poly: &Poly) -> Option<i128> {
    let d = match poly.content()? {
        Number::Exact(_, d) if d < LARGE => d,
        _ => return None,
    };
    let both = by / common(by, d) * d;
    (both < LARGE).then_some(both)
}

impl<'g> Whole<'g> {
    pub fn new(graph: &'g Graph, ranges: &'g Ranges, values: &[NodeId]) -> Whole<'g> {
        let forms = Forms::new(graph, ranges);
        let polys = values.iter().map(|id| Self::poly(&forms, *id));
        let by = polys
            .into_iter()
            .try_fold(1, |by, poly| whole_too(by, poly?));
        let by = by.map_or(1.0, |by| by as f64);
        Whole { forms, by }
    }

    /// The same, but what the vectors divided by their length are multiplied by is
    /// made whole, too: what a ray has of the way to a centre, say. Nothing where
    /// that is so anyway, or asks for a large number.
    pub fn with_products(self, length: NodeId) -> Option<Whole<'g>> {
        let one = match self.forms.get(length)?.parts.as_slice() {
            [part] => part.roots.as_slice(),
            _ => return None,
        };
        let [(root, -1)] = one else {
            return None;
        };
        let graph = self.forms.graph;
        let reached = graph.reached();
        let all = graph.ids().filter(|id| reached[id.0 as usize]);
        let polys = all.filter_map(|id| match self.forms.get(id)?.parts.as_slice() {
            [part] if part.roots == [(*root, 1)] => Some(&part.poly),
            _ => None,
        });
        // What no such number makes whole stays what it is.
        let by = polys.fold(self.by as i128, |by, poly| {
            whole_too(by, poly).unwrap_or(by)
        }) as f64;
        (by != self.by).then_some(Whole { by, ..self })
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
