//! Graphs at random, for holding evaluations against each other: operations,
//! choices, tables, ramps and loops in loops over what stands in their scope, some of
//! it the same for a whole row or picture.

use super::random::Random;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use slowlight_routine::{Op, Type, Value};

const AT: Span = Span {
    file: 0,
    start: 0,
    end: 0,
    within: None,
    effect: None,
};

struct Maker {
    random: Random,
    b: Builder,
    table: TableId,
    /// What may be used here, by type.
    scope: Vec<NodeId>,
    /// Whether loops have a counter that may end them.
    counts: bool,
}

impl Maker {
    fn below(&mut self, n: usize) -> usize {
        self.random.below(n as u64) as usize
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    fn constant(&mut self, ty: Type) -> NodeId {
        let value = match ty {
            Type::Bool => Value::Bool(self.below(2) == 0),
            Type::Int => Value::Int(self.pick(&[0, 1, -1, 3, 8, -5, i32::MAX])),
            Type::Real => Value::Real(self.pick(&[0.0, 0.5, -1.25, 3.0, 1e9, 1e-9])),
        };
        self.b.constant(value, AT)
    }

    /// Something of this type that may be used here, late nodes more likely.
    fn any(&mut self, ty: Type) -> NodeId {
        let fits: Vec<NodeId> = (self.scope.iter().copied())
            .filter(|&id| self.b.ty(id) == ty)
            .collect();
        if fits.is_empty() || self.below(8) == 0 {
            return self.constant(ty);
        }
        let (a, b) = (self.below(fits.len()), self.below(fits.len()));
        fits[a.max(b)]
    }

    /// The sum of a small part of each of several, so that much of the graph is
    /// reached and nothing is drowned.
    fn mixed(&mut self, ty: Type) -> NodeId {
        let first = self.constant(ty);
        let fifteen = self.b.constant(Value::Int(15), AT);
        (0..10).fold(first, |sum, _| {
            let other = self.any(ty);
            let (small, add) = match ty {
                Type::Real => (self.b.apply(Op::Sin, &[other], AT), Op::Add),
                _ => (self.b.apply(Op::BitAnd, &[other, fifteen], AT), Op::IntAdd),
            };
            self.b.apply(add, &[sum, small], AT)
        })
    }

    fn ty(&mut self) -> Type {
        self.pick(&[Type::Real, Type::Real, Type::Int, Type::Bool])
    }

    fn grow(&mut self, nodes: usize, depth: usize) {
        for _ in 0..nodes {
            let made = match self.below(12) {
                0 if depth > 0 => {
                    self.turns(depth - 1);
                    continue;
                }
                0..=2 => {
                    let ty = self.ty();
                    let (cond, yes, no) = (self.any(Type::Bool), self.any(ty), self.any(ty));
                    self.b.select(cond, yes, no, AT)
                }
                3 => {
                    let (column, row) = (self.any(Type::Int), self.any(Type::Int));
                    self.b.lookup(self.table, column, row, AT)
                }
                _ => {
                    let op = self.pick(Op::ALL);
                    let args: Vec<NodeId> = op.args().iter().map(|&ty| self.any(ty)).collect();
                    self.b.apply(op, &args, AT)
                }
            };
            self.scope.push(made);
        }
    }

    /// Ramps of the first to the third degree; what stands in the scope so far
    /// is the same for a whole pass, of which a row has one or more.
    fn ramps(&mut self, passes: u32) {
        for _ in 0..3 {
            let ops = [Op::IntAdd, Op::IntSub, Op::IntMul];
            let (op, a, b) = (self.pick(&ops), Type::Int, Type::Int);
            let args = [self.any(a), self.any(b)];
            let made = self.b.apply(op, &args, AT);
            self.scope.push(made);
        }
        let mut made = Vec::new();
        for degree in 1..=3 {
            let mut ramp = self.any(Type::Int);
            for _ in 0..degree {
                let first = self.any(Type::Int);
                ramp = self.b.ramp(first, ramp, passes, AT);
                made.push(ramp);
            }
        }
        self.scope.extend(made);
    }

    fn turns(&mut self, depth: usize) {
        let types: Vec<Type> = (0..1 + self.below(3)).map(|_| self.ty()).collect();
        let mut carried: Vec<_> = (types.iter())
            .map(|&ty| (String::new(), ty, self.any(ty)))
            .collect();
        let max = 1 + self.below(6) as u32;
        if self.counts {
            let first = self.b.constant(Value::Int(0), AT);
            carried.push(("k".to_owned(), Type::Int, first));
        }
        let of = self.b.open_loop(max, &carried, AT);
        let outside = self.scope.len();
        for k in 0..carried.len() as u32 {
            let carried = self.b.carried(of, k, AT);
            self.scope.push(carried);
        }
        if self.counts {
            let k = self.b.carried(of, types.len() as u32, AT);
            let real = self.b.apply(Op::ToReal, &[k], AT);
            let sine = self.b.apply(Op::Sin, &[real], AT);
            self.scope.push(sine);
        }
        let nodes = 2 + self.below(10);
        self.grow(nodes, depth);
        let mut again = self.any(Type::Bool);
        let mut next: Vec<NodeId> = types.iter().map(|&ty| self.any(ty)).collect();
        if self.counts {
            let k = self.b.carried(of, types.len() as u32, AT);
            let [one, end] = [1, self.below(6) as i32].map(|n| self.b.constant(Value::Int(n), AT));
            next.push(self.b.apply(Op::IntAdd, &[k, one], AT));
            if self.below(3) > 0 {
                again = self.b.apply(Op::IntLess, &[k, end], AT);
            }
        }
        let results: Vec<Type> = (0..1 + self.below(2)).map(|_| self.ty()).collect();
        let done: Vec<NodeId> = results.iter().map(|&ty| self.any(ty)).collect();
        self.scope.truncate(outside);
        for k in 0..types.len() as u32 {
            let last = self.b.last(of, k, AT);
            self.scope.push(last);
        }
        self.grow(2, 0);
        let otherwise: Vec<NodeId> = results.iter().map(|&ty| self.any(ty)).collect();
        self.scope.truncate(outside);
        let made = self.b.close_loop(of, again, &next, &done, &otherwise);
        self.scope.extend(made);
    }
}

/// A graph by its number; every third spreads an error.
pub fn graph(seed: u64) -> Graph {
    made(seed, false)
}

/// The same with a counter in each loop, which ends two of three.
pub fn counted(seed: u64) -> Graph {
    made(seed, true)
}

fn made(seed: u64, counts: bool) -> Graph {
    let mut b = Builder::new();
    let entries = [3, 1, 4, 1, 5, 9].map(Constant::Int).to_vec();
    let table = b.table(Table {
        name: "t".to_owned(),
        width: 3,
        height: 2,
        ty: Type::Int,
        entries,
        seed: Vec::new(),
    });
    let mut scope: Vec<NodeId> = [Type::Real, Type::Int, Type::Bool]
        .into_iter()
        .map(|ty| {
            b.param(Param {
                name: format!("p{ty:?}"),
                component: "",
                role: Role::Param,
                ty,
                value: 2.0,
                usual: 2.0,
                range: None,
                span: AT,
            })
        })
        .collect();
    let spreads = seed.is_multiple_of(3);
    let axes = [Axis::Y, Axis::X].map(|axis| b.axis(axis, AT));
    scope.push(axes[0]);
    let mut maker = Maker {
        random: Random::new(seed),
        b,
        table,
        scope,
        counts,
    };
    // Rows in one pass, or in four.
    let passes = if spreads || seed.is_multiple_of(2) {
        1
    } else {
        4
    };
    if passes > 1 {
        let pass = maker.b.axis(Axis::Pass(passes), AT);
        maker.scope.push(pass);
    }
    maker.ramps(passes);
    maker.scope.push(axes[1]);
    let reals = axes.map(|axis| maker.b.apply(Op::ToReal, &[axis], AT));
    maker.scope.extend(reals);
    if spreads {
        let received = maker.b.received(AT);
        maker.scope.push(received);
    }
    maker.grow(60, 3);
    let ink = maker.mixed(Type::Int);
    let shade = maker.mixed(Type::Real);
    if spreads {
        let node = maker.any(Type::Real);
        let half = maker.b.constant(Value::Real(0.375), AT);
        let node = maker.b.apply(Op::Mul, &[node, half], AT);
        let shares = [(1, 0), (-1, 1), (0, 2)].map(|(dx, dy)| Share { dx, dy, node });
        maker.b.spread(&shares, AT);
    }
    let image = Image {
        block: (1, 1),
        width: 71,
        height: 5,
        palette: vec![[0; 3]; 256],
    };
    maker.b.finish(image, ink, Some(shade))
}
