//! Ints that are stepped along runs of columns, held against the model and the
//! native evaluation on the machines: wide pictures and cropped ones, in passes and
//! not, with runs that are cut at random.
#![allow(clippy::unwrap_used)]

use crate::bbc::{differences, run_at, text};
use crate::ramps::random::Random;
use slowlight_compiler::analysis::verify::verify;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::ir::build::Builder;
use slowlight_compiler::ir::graph::*;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::planner::plan;
use slowlight_compiler::source::Span;
use slowlight_compiler::targets::{default_mode, find};
use slowlight_routine::{Op, Value};
use slowlight_vm::Stop;
use slowlight_vm::bbc::Dialect;

const AT: Span = Span {
    file: 0,
    start: 0,
    end: 0,
    within: None,
    effect: None,
};
pub const HEIGHT: i32 = 3;

struct Scene {
    b: Builder,
    random: Random,
    width: u32,
}

impl Scene {
    fn int(&mut self, n: i32) -> NodeId {
        self.b.constant(Value::Int(n), AT)
    }

    fn apply(&mut self, op: Op, args: &[NodeId]) -> NodeId {
        self.b.apply(op, args, AT)
    }

    fn below(&mut self, n: u64) -> i32 {
        self.random.below(n) as i32
    }

    /// An int that is the same for a row, within some size.
    fn row(&mut self, size: u64) -> NodeId {
        let (n, by) = (self.below(2 * size + 1), self.below(size / 4 + 1));
        let y = self.b.axis(Axis::Y, AT);
        let [n, by] = [n - size as i32, by].map(|n| self.int(n));
        let line = self.apply(Op::IntMul, &[y, by]);
        self.apply(Op::IntAdd, &[line, n])
    }

    /// A comparison of the column with what the row knows.
    fn span(&mut self) -> NodeId {
        let width = u64::from(self.width);
        let (from, x) = (self.row(width), self.b.axis(Axis::X, AT));
        match self.below(2) {
            0 => self.apply(Op::IntLess, &[x, from]),
            _ => self.apply(Op::IntLessEqual, &[from, x]),
        }
    }

    /// A polynomial in the column, or a choice between two for each run.
    fn whole(&mut self, choices: u32) -> NodeId {
        if choices > 0 && self.below(3) > 0 {
            let cond = self.span();
            let (yes, no) = (self.whole(choices - 1), self.whole(choices - 1));
            return self.b.select(cond, yes, no, AT);
        }
        let x = self.b.axis(Axis::X, AT);
        let (slope, more) = (self.row(900), self.row(90_000));
        let mut all = self.apply(Op::IntMul, &[x, slope]);
        if self.below(2) == 0 {
            let (by, more) = (self.row(60), self.row(900));
            let by = self.apply(Op::IntMul, &[by, x]);
            let by = self.apply(Op::IntAdd, &[by, more]);
            let square = self.apply(Op::IntMul, &[by, x]);
            all = self.apply(Op::IntSub, &[square, all]);
        }
        self.apply(Op::IntAdd, &[all, more])
    }

    /// Two of an int's bits, after it went through a real sum or not.
    fn bits(&mut self, whole: NodeId, pixel: NodeId) -> NodeId {
        let (eight, three) = (self.int(8), self.int(3));
        let whole = match self.below(2) {
            0 => whole,
            _ => {
                let half = self.b.constant(Value::Real(0.5), AT);
                let [whole, pixel] = [whole, pixel].map(|id| self.apply(Op::ToReal, &[id]));
                let rest = self.apply(Op::Mul, &[pixel, half]);
                let (cond, other) = (self.span(), self.row(5_000));
                let other = self.apply(Op::ToReal, &[other]);
                let more = self.apply(Op::Add, &[rest, other]);
                let more = self.apply(Op::Add, &[whole, more]);
                let less = self.apply(Op::Sub, &[rest, whole]);
                let sum = self.apply(Op::Add, &[whole, rest]);
                let no = [less, sum][self.below(2) as usize];
                let sum = self.b.select(cond, more, no, AT);
                self.apply(Op::Floor, &[sum])
            }
        };
        let whole = self.apply(Op::IntDiv, &[whole, eight]);
        self.apply(Op::BitAnd, &[whole, three])
    }
}

/// Bits of polynomials, each under conditions of its run and some of its pixel.
pub fn picture(seed: u64, width: u32, passes: bool) -> Graph {
    let (b, random) = (Builder::new(), Random::new(seed));
    let mut scene = Scene { b, random, width };
    let three = scene.int(3);
    let x = scene.b.axis(Axis::X, AT);
    let square = scene.apply(Op::IntMul, &[x, x]);
    let square = scene.apply(Op::IntDiv, &[square, three]);
    let pixel = scene.apply(Op::BitAnd, &[square, three]);
    let one = scene.int(1);
    let many = scene.apply(Op::IntLess, &[one, pixel]);
    let mut ink = pixel;
    for _ in 0..2 {
        let whole = scene.whole(2);
        let bits = scene.bits(whole, pixel);
        let (cond, also) = (scene.span(), scene.whole(1));
        let also = scene.bits(also, pixel);
        let some = scene.b.select(many, also, bits, AT);
        let [some, bits] = [some, bits].map(|bits| scene.apply(Op::IntAdd, &[bits, ink]));
        let both = scene.b.select(cond, some, bits, AT);
        let cond = scene.span();
        ink = scene.b.select(cond, both, ink, AT);
    }
    if passes {
        let rest = scene.apply(Op::BitAnd, &[x, three]);
        ink = scene.apply(Op::IntAdd, &[ink, rest]);
    }
    let ink = scene.apply(Op::BitAnd, &[ink, three]);
    let image = Image {
        block: (1, 1),
        width,
        height: HEIGHT as u32,
        palette: vec![[0; 3]; 4],
    };
    scene.b.finish(image, ink, None)
}

pub const MACHINES: [(&str, Dialect); 3] = [
    ("bbc:micro", Dialect::Micro),
    ("bbc:agon", Dialect::Agon),
    ("bbc:basicv", Dialect::BasicV),
];

#[test]
fn what_is_stepped_along_runs_is_what_it_stands_for() {
    let mut stepped = [0; 3];
    for seed in 0..120 {
        // The last of these is wider than the Micro's screen, so cropped.
        let width = [320, 77, 352][seed as usize % 3];
        let graph = picture(seed, width, seed % 2 == 0);
        verify(&graph).unwrap();
        let (name, dialect) = MACHINES[(seed / 6 % 4) as usize % 3];
        let target = find(name).unwrap();
        let goal = Goal {
            name: "runs".to_owned(),
            mode: match dialect {
                Dialect::Micro => *target.modes.iter().find(|m| m.name == "1").unwrap(),
                _ => default_mode(target, width, HEIGHT as u32).unwrap(),
            },
            rows: None,
            plot: true,
        };
        let plan = plan(&graph, target, &goal).unwrap();
        verify(&plan.graph).unwrap();
        let count = |node: &&Node| matches!(node, Node::Stepped { .. });
        let found = plan.graph.nodes.iter().filter(count).count();
        stepped[(seed / 6 % 4) as usize % 3] += usize::from(found > 0);
        let text = text(&plan);
        // Plans as they come, whatever memory they take: without a disc's share.
        let run = run_at(0xE00, dialect, &text);
        assert_eq!(run.stop, Stop::Ended, "{seed}\n{text}");
        assert_eq!(differences(&plan, &run), 0, "{seed}\n{}\n{text}", plan.tree);
        // All is exact.
        let (mut native, mut model) = (Native::new(&graph), ModelRun::new(&plan));
        let mut planned = Native::new(&plan.graph);
        for y in 0..HEIGHT {
            for x in 0..width as i32 {
                let ink = native.pixel(x, y).ink;
                assert_eq!(ink, model.pixel(x, y).ink, "{seed} ({x}, {y})");
                assert_eq!(ink, planned.pixel(x, y).ink, "{seed} ({x}, {y})");
            }
        }
    }
    assert!(stepped.iter().all(|n| *n > 12), "{stepped:?}");
}
