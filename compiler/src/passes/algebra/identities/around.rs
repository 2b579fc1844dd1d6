//! Comparisons decided by the known length of a vector (Cauchy-Schwarz).
//!
//! The square of a hit's distance from another sphere's centre is a + b·n, n the
//! normal there, whose components square up to 1: it stays within |b| of a
//! (Cauchy-Schwarz). So a point of one sphere is outside of another that stands
//! apart from it, which intervals for its components do not tell. Which three
//! values are such a vector, and which values are affine in them, is found in
//! the finite [`field`](super::field): where all agree with a + s b·n at more
//! points than a and b have numbers, s being 1 or a value whose square is 1.
//!
//! A component itself is s a + b·n where the spheres' places hang on s, and then the
//! comparison may hold for one s and fail for the other: it asks for s.

use super::field::{Field, POINTS, Print, add, fraction, inverse, mul, sub};
use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::{Forms, allowance};
use crate::passes::rewrite::rebuild::rebuild_old;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Runtime, Type, Value};
use std::collections::BTreeSet;

/// By how much a comparison must be clear, as a part of what is compared: far more
/// than roundings move it.
const CLEAR: f64 = 1e-2;

/// How many components of vectors of length 1 are looked at, and how many values
/// whose square is 1.
const COMPONENTS: usize = 18;
const SIGNS: usize = 4;

/// The graph with comparisons that are decided as constants; nothing where there
/// are none, or where the format has no relative roundings.
pub fn around(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    if allowance(runtime) < 1.0 {
        return None;
    }
    let forms = Forms::new(graph, ranges);
    let reached = graph.reached();
    let free = |id: &NodeId| reached[id.0 as usize] && forms.pixel(*id) && !forms.looped(*id);
    let asked: Vec<Asked> = graph
        .ids()
        .filter(free)
        .filter_map(|id| Asked::of(graph, id))
        .collect();
    let units = graph
        .directions
        .iter()
        .filter(|(_, length)| **length == 1.0);
    let components: Vec<NodeId> = units.map(|(id, _)| *id).filter(free).collect();
    let few = (3..=COMPONENTS).contains(&components.len());
    if asked.is_empty() || !few {
        return None;
    }
    let field = Field::new(graph, ranges, &forms);
    let prints = field.prints()?;
    let site = Site {
        graph,
        field,
        prints,
    };
    let vectors = site.vectors(&components);
    let decided = asked.iter().filter_map(|asked| {
        let mut all = vectors.iter();
        let holds = all.find_map(|vector| site.verdict(asked, vector))?;
        Some((asked.id, holds))
    });
    let decided: FxHashMap<NodeId, Verdict> = decided.collect();
    (!decided.is_empty()).then(|| {
        rebuild_old(graph, &mut |builder, made, id, span| {
            let (sign, above) = match *decided.get(&id)? {
                Verdict::Always(holds) => return Some(builder.constant(Value::Bool(holds), span)),
                Verdict::Where { sign, above } => (sign, above),
            };
            let above_0 = match graph.node(sign) {
                Node::Select { cond, yes, .. } if is(graph, yes, 1.0) => new(made, cond)?,
                Node::Select { cond, no, .. } if is(graph, no, 1.0) => {
                    builder.apply(Op::Not, &[new(made, cond)?], span)
                }
                node => {
                    let of = match node {
                        Node::Apply(Op::ToReal, [of, _]) => match graph.node(of) {
                            Node::Apply(Op::Sign, [of, _]) => of,
                            _ => sign,
                        },
                        _ => sign,
                    };
                    let zero = builder.constant(Value::Real(0.0), span);
                    builder.apply(Op::Less, &[zero, new(made, of)?], span)
                }
            };
            Some(match above {
                true => above_0,
                false => builder.apply(Op::Not, &[above_0], span),
            })
        })
    })
}

fn new(made: &[Option<NodeId>], id: NodeId) -> Option<NodeId> {
    made.get(id.0 as usize).copied().flatten()
}

fn is(graph: &Graph, id: NodeId, value: f64) -> bool {
    graph.constant(id).map(Value::real) == Some(value)
}

/// When a comparison holds.
#[derive(Clone, Copy, Debug)]
enum Verdict {
    Always(bool),
    /// Where a value whose square is 1 is 1, or where it is -1.
    Where {
        sign: NodeId,
        above: bool,
    },
}

/// A comparison of a value with a constant.
struct Asked {
    id: NodeId,
    value: NodeId,
    constant: f64,
    /// Whether it holds where the value is the greater.
    greater: bool,
    /// Whether it holds where both are equal.
    equal: bool,
}

impl Asked {
    fn of(graph: &Graph, id: NodeId) -> Option<Asked> {
        let Node::Apply(op @ (Op::Less | Op::LessEqual), [a, b]) = graph.node(id) else {
            return None;
        };
        let constant = |id| graph.constant(id).map(Value::real);
        let (value, constant, greater) = match (constant(a), constant(b)) {
            (Some(c), None) => (b, c, true),
            (None, Some(c)) => (a, c, false),
            _ => return None,
        };
        Some(Asked {
            id,
            value,
            constant,
            greater,
            equal: op == Op::LessEqual,
        })
    }

    /// Whether it holds for all values as near to `middle` as `most`, or for none.
    ///
    /// One that holds up to where both are equal, at the end of what there is, holds: what
    /// roundings make of it there is no better.
    fn decided(&self, middle: f64, most: f64) -> Option<bool> {
        let clear = CLEAR * (middle.abs() + most + self.constant.abs());
        let at = if self.equal { 0.0 } else { clear };
        let (above, below) = if self.greater {
            (at, clear)
        } else {
            (clear, at)
        };
        let holds = |least: f64, clear: f64| {
            if clear > 0.0 {
                clear < least
            } else {
                0.0 <= least
            }
        };
        if holds(middle - most - self.constant, above) {
            Some(self.greater)
        } else if holds(self.constant - middle - most, below) {
            Some(!self.greater)
        } else {
            None
        }
    }
}

/// The form t a + s b·n of a value: s and t are such whose square is 1.
#[derive(Clone, Copy)]
struct Affine {
    /// s, 1 if none.
    sign: Option<NodeId>,
    /// t, 1 if none.
    moved: Option<NodeId>,
}

struct Site<'g> {
    graph: &'g Graph,
    field: Field<'g>,
    prints: Vec<Option<Print>>,
}

impl Site<'_> {
    fn print(&self, id: NodeId) -> Option<Print> {
        self.prints.get(id.0 as usize).copied().flatten()
    }

    /// Which three of the components are a vector of length 1.
    fn vectors(&self, components: &[NodeId]) -> Vec<[NodeId; 3]> {
        let mut all = Vec::new();
        for (i, u) in components.iter().enumerate() {
            for (j, v) in components.iter().enumerate().skip(i + 1) {
                for w in components.iter().skip(j + 1) {
                    if self.is_unit([*u, *v, *w]) {
                        all.push([*u, *v, *w]);
                    }
                }
            }
        }
        all
    }

    fn is_unit(&self, vector: [NodeId; 3]) -> bool {
        let [Some(u), Some(v), Some(w)] = vector.map(|id| self.print(id)) else {
            return false;
        };
        let one = |k: usize| length([u[k], v[k], w[k]]) == 1;
        (0..POINTS).all(one)
            && self
                .field
                .always(&vector, &|of| length(vector.map(of)) == 1)
    }

    /// When a comparison holds, if a vector's length decides it.
    fn verdict(&self, asked: &Asked, vector: &[NodeId; 3]) -> Option<Verdict> {
        let signs = self.signs(asked.value);
        let decided = |[middle, b @ ..]: [f64; 4]| {
            asked.decided(middle, b.iter().map(|b| b * b).sum::<f64>().sqrt())
        };
        let turned = std::iter::once(None).chain(signs.iter().copied().map(Some));
        for sign in turned {
            let form = Affine { sign, moved: None };
            if let Some(found) = self.affine(asked.value, form, vector) {
                return decided(found).map(Verdict::Always);
            }
        }
        signs.into_iter().find_map(|sign| {
            let form = Affine {
                sign: None,
                moved: Some(sign),
            };
            let [a, b @ ..] = self.affine(asked.value, form, vector)?;
            let with = |a: f64| decided([a, b[0], b[1], b[2]]);
            let (plus, minus) = (with(a)?, with(-a)?);
            Some(match plus == minus {
                true => Verdict::Always(plus),
                false => Verdict::Where { sign, above: plus },
            })
        })
    }

    /// Values whose square is 1 that one is made of.
    fn signs(&self, id: NodeId) -> Vec<NodeId> {
        let (mut seen, mut signs) = (BTreeSet::from([id]), Vec::new());
        let mut prints = Vec::new();
        while let Some(next) = seen.pop_last() {
            let real = self.graph.ty(next) == Type::Real && self.graph.constant(next).is_none();
            if let Some(print) = self.print(next).filter(|_| real)
                && print.iter().all(|x| mul(*x, *x) == 1)
            {
                if signs.len() < SIGNS && !prints.contains(&print) {
                    signs.push(next);
                    prints.push(print);
                }
                continue;
            }
            seen.extend(self.graph.node(next).operands());
        }
        signs
    }

    /// a and b where a value is t a + s b·n, always.
    fn affine(&self, value: NodeId, form: Affine, vector: &[NodeId; 3]) -> Option<[f64; 4]> {
        let print = self.print(value)?;
        let [Some(u), Some(v), Some(w)] = vector.map(|id| self.print(id)) else {
            return None;
        };
        let one = |sign: Option<NodeId>| match sign {
            Some(id) => self.print(id),
            None => Some([1; POINTS]),
        };
        let (one, moved) = (one(form.sign)?, one(form.moved)?);
        let turned = |k: usize| [u, v, w].map(|part| mul(one[k], part[k]));
        let rows = [0, 1, 2, 3].map(|k| {
            let [x, y, z] = turned(k);
            [moved[k], x, y, z, print[k]]
        });
        let found = solved(rows)?;
        let sum = |moved: u64, [x, y, z]: [u64; 3]| {
            let terms = found.into_iter().zip([moved, x, y, z]);
            terms.map(|(factor, x)| mul(factor, x)).fold(0, add)
        };
        let here = |k: usize| sum(moved[k], turned(k)) == print[k];
        let signs = form.sign.into_iter().chain(form.moved);
        let made: Vec<NodeId> = vector.iter().copied().chain([value]).chain(signs).collect();
        let always = || {
            self.field.always(&made, &|of| {
                let (one, moved) = (form.sign.map_or(1, of), form.moved.map_or(1, of));
                sum(moved, vector.map(|id| mul(one, of(id)))) == of(value)
            })
        };
        if !(4..POINTS).all(here) || !always() {
            return None;
        }
        let numbers = found.map(|x| fraction(x).map(|(n, d)| n as f64 / d as f64));
        let [Some(a), Some(b), Some(c), Some(d)] = numbers else {
            return None;
        };
        Some([a, b, c, d])
    }
}

fn length(vector: [u64; 3]) -> u64 {
    vector.into_iter().map(|x| mul(x, x)).fold(0, add)
}

/// The four numbers by which four columns sum up to the fifth, in the field, if
/// there is one such four only (Gauss and Jordan).
fn solved(mut rows: [[u64; 5]; 4]) -> Option<[u64; 4]> {
    for column in 0..4 {
        let pivot = (column..4).find(|row| rows[*row][column] != 0)?;
        rows.swap(column, pivot);
        let by = inverse(rows[column][column]);
        rows[column] = rows[column].map(|x| mul(x, by));
        for row in (0..4).filter(|row| *row != column) {
            let factor = rows[row][column];
            let top = rows[column];
            for (x, t) in rows[row].iter_mut().zip(top) {
                *x = sub(*x, mul(factor, t));
            }
        }
    }
    Some(rows.map(|row| row[4]))
}
