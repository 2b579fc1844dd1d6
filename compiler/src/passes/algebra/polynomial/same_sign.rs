//! Sign equivalence of polynomials: what signs and comparisons turn on: two of them that ask for
//! the sign of one polynomial, but for a factor, go together.

use super::form::scaled;
use super::form::{Form, Forms, Part};
use super::number::Number;
use super::poly::Poly;
use crate::ir::graph::*;
use rustc_hash::FxHashMap;
use slowlight_routine::Op;

/// The sign that tells how a condition or a sign goes, and whether the other way.
pub type Turns = FxHashMap<NodeId, (NodeId, bool)>;

impl Forms<'_> {
    /// The signs that are never 0, and the comparisons of what they are of with 0, by the
    /// first such sign of the graph.
    pub fn turns(&self) -> Turns {
        let reached = self.graph.reached();
        let ids = || self.graph.ids().filter(|id| reached[id.0 as usize]);
        let mut firsts: Vec<(Part, NodeId, bool)> = Vec::new();
        let mut turns = Turns::default();
        for id in ids() {
            let Node::Apply(Op::Sign | Op::IntSign, [of, _]) = self.graph.node(id) else {
                continue;
            };
            let unit = self.two(id.0).is_some_and(|two| two.low == -1);
            let Some((part, less)) = self.get(of).filter(|_| unit).and_then(primitive) else {
                continue;
            };
            match firsts.iter().find(|(known, ..)| *known == part) {
                Some((_, first, turned)) => {
                    turns.insert(id, (*first, *turned != less));
                }
                None => firsts.push((part, id, less)),
            }
        }
        if firsts.is_empty() {
            return turns;
        }
        for id in ids() {
            let Node::Apply(op, [a, b]) = self.graph.node(id) else {
                continue;
            };
            // What is never 0 is not equal to it either.
            let asks = matches!(
                op,
                Op::Less | Op::LessEqual | Op::IntLess | Op::IntLessEqual
            );
            let (Some(a), Some(b)) = (self.get(a).filter(|_| asks), self.get(b)) else {
                continue;
            };
            let difference = self.sum(b, &scaled(a, Number::whole(-1)));
            let Some((part, less)) = difference.as_ref().and_then(primitive) else {
                continue;
            };
            if let Some((_, first, turned)) = firsts.iter().find(|(known, ..)| *known == part) {
                turns.insert(id, (*first, *turned != less));
            }
        }
        turns
    }
}

/// A form of one part without its factor, and whether that is below 0.
fn primitive(form: &Form) -> Option<(Part, bool)> {
    let [part] = form.parts.as_slice() else {
        return None;
    };
    let below_0 = |poly: &Poly| matches!(poly.lead(), Number::Exact(n, _) if n < 0);
    let whole = part.poly.scaled(part.poly.content()?.inverse()?);
    let part_of = |poly| Part {
        roots: part.roots.clone(),
        poly,
    };
    let less = below_0(&part.poly);
    let part = match below_0(&whole) {
        true => part_of(whole.scaled(Number::whole(-1))),
        false => part_of(whole),
    };
    Some((part, less))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::ir::build::Builder;
    use crate::planner::context::Context;
    use crate::source::Span;
    use crate::targets::find;
    use slowlight_routine::Value;

    #[test]
    fn comparisons_go_with_the_sign_that_they_ask_for() {
        const AT: Span = Span {
            file: 0,
            start: 0,
            end: 0,
            within: None,
            effect: None,
        };
        let mut b = Builder::new();
        let x = b.axis(Axis::X, AT);
        let mut line = |factor: i32, off: i32| {
            let [factor, off] = [factor, off].map(|n| b.constant(Value::Int(n), AT));
            let product = b.apply(Op::IntMul, &[x, factor], AT);
            b.apply(Op::IntSub, &[product, off], AT)
        };
        // 10 (2 x - 31), the same by other factors, another place, and what may be 0.
        let [of, more, less, other, zero] =
            [(20, 310), (6, 93), (-4, -62), (20, 330), (2, 30)].map(|(f, o)| line(f, o));
        let nought = b.constant(Value::Int(0), AT);
        let sign = b.apply(Op::IntSign, &[of], AT);
        let also = b.apply(Op::IntSign, &[less], AT);
        let maybe = b.apply(Op::IntSign, &[zero], AT);
        let above = b.apply(Op::IntLess, &[nought, more], AT);
        let below = b.apply(Op::IntLessEqual, &[more, nought], AT);
        let there = b.apply(Op::IntLess, &[nought, other], AT);
        // None under a condition that decides another.
        let one = b.constant(Value::Int(1), AT);
        let asked = [above, below, there].map(|cond| b.select(cond, one, nought, AT));
        let all = [also, maybe].into_iter().chain(asked);
        let ink = all.fold(sign, |sum, value| b.apply(Op::IntAdd, &[sum, value], AT));
        let image = Image {
            block: (1, 1),
            width: 32,
            height: 8,
            palette: vec![[0; 3]; 4],
        };
        let graph = b.finish(image, ink, None);
        let runtime = find("6502:plain").unwrap().runtime;
        let plain = Context::new(graph.clone(), runtime).scheduled(graph.clone());
        let forms = Forms::new(&graph, &plain.ranges);
        let turns = forms.turns();
        assert_eq!(turns.get(&also), Some(&(sign, true)), "{graph}");
        assert_eq!(turns.get(&above), Some(&(sign, false)));
        assert_eq!(turns.get(&below), Some(&(sign, true)));
        assert_eq!(turns.len(), 3, "{turns:?}");
    }
}
