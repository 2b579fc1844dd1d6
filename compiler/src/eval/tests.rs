//! The evaluations held against each other on a graph made by hand: two
//! mirrors, as a front end would build it.
#![allow(clippy::unwrap_used)]

use super::arithmetic::Exact;
use super::native::Native;
use super::run::Run;
use crate::analysis::verify::verify;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::schedule::statements::schedule;
use crate::source::Span;
use slowlight_routine::{Op, Type, Value};

const AT: Span = Span {
    file: 0,
    start: 0,
    end: 0,
    within: None,
    effect: None,
};

type Vec3 = [NodeId; 3];

struct Hand(Builder);

impl Hand {
    fn real(&mut self, x: f64) -> NodeId {
        self.0.constant(Value::Real(x), AT)
    }
    fn int(&mut self, x: i32) -> NodeId {
        self.0.constant(Value::Int(x), AT)
    }
    fn op(&mut self, op: Op, args: &[NodeId]) -> NodeId {
        self.0.apply(op, args, AT)
    }
    fn each(&mut self, op: Op, a: Vec3, b: Vec3) -> Vec3 {
        [0, 1, 2].map(|k| self.op(op, &[a[k], b[k]]))
    }
    fn scale(&mut self, a: Vec3, s: NodeId) -> Vec3 {
        a.map(|c| self.op(Op::Mul, &[c, s]))
    }
    fn dot(&mut self, a: Vec3, b: Vec3) -> NodeId {
        let [x, y, z] = self.each(Op::Mul, a, b);
        let xy = self.op(Op::Add, &[x, y]);
        self.op(Op::Add, &[xy, z])
    }
    fn unit(&mut self, a: Vec3) -> Vec3 {
        let square = self.dot(a, a);
        let length = self.op(Op::Sqrt, &[square]);
        a.map(|c| self.op(Op::Div, &[c, length]))
    }

    /// Present, and t: the nearest root in front, by the perpendicular.
    fn sphere(&mut self, from: Vec3, dir: Vec3, centre: Vec3) -> (NodeId, NodeId) {
        let (offset, zero, one) = (self.real(1e-9), self.real(0.0), self.real(1.0));
        let o = self.each(Op::Sub, from, centre);
        let b = self.dot(o, dir);
        let along = self.scale(dir, b);
        let q = self.each(Op::Sub, o, along);
        let qq = self.dot(q, q);
        let d = self.op(Op::Sub, &[one, qq]);
        let miss = self.op(Op::Less, &[d, zero]);
        let s = self.op(Op::Sqrt, &[d]);
        let minus = self.op(Op::Neg, &[b]);
        let (near, far) = (self.op(Op::Sub, &[minus, s]), self.op(Op::Sub, &[s, b]));
        let near_front = self.op(Op::Less, &[offset, near]);
        let far_front = self.op(Op::Less, &[offset, far]);
        let (yes, no) = (
            self.0.constant(Value::Bool(true), AT),
            self.0.constant(Value::Bool(false), AT),
        );
        let front = self.0.select(near_front, yes, far_front, AT);
        let present = self.0.select(miss, no, front, AT);
        let t = self.0.select(near_front, near, far, AT);
        (present, t)
    }

    fn backdrop(&mut self, from: Vec3, dir: Vec3) -> NodeId {
        let zero = self.real(0.0);
        let up = self.op(Op::LessEqual, &[zero, dir[1]]);
        let two = self.real(2.0);
        let height = self.op(Op::Add, &[from[1], two]);
        let t = self.op(Op::Div, &[height, dir[1]]);
        let along = self.scale(dir, t);
        let x = self.op(Op::Sub, &[from[0], along[0]]);
        let z = self.op(Op::Add, &[from[2], along[2]]);
        let (x, z) = (self.op(Op::Floor, &[x]), self.op(Op::Floor, &[z]));
        let both = self.op(Op::IntAdd, &[x, z]);
        let int_two = self.int(2);
        let odd = self.op(Op::IntMod, &[both, int_two]);
        let half = self.op(Op::Div, &[odd, two]);
        let k = self.real(0.3);
        let bright = self.op(Op::Add, &[half, k]);
        let minus = self.op(Op::Neg, &[dir[1]]);
        let lit = self.op(Op::Mul, &[minus, bright]);
        let k = self.real(0.2);
        let tiles = self.op(Op::Add, &[lit, k]);
        self.0.select(up, dir[1], tiles, AT)
    }
}

fn mirrors() -> Graph {
    let mut h = Hand(Builder::new());
    let eye = [("x", 0.0), ("y", -0.1), ("z", 3.0)].map(|(component, value)| {
        h.0.param(Param {
            name: "eye".to_owned(),
            component,
            role: Role::Param,
            ty: Type::Real,
            value,
            usual: value,
            range: None,
            span: AT,
        })
    });
    let (x, y) = (h.0.axis(Axis::X, AT), h.0.axis(Axis::Y, AT));
    let (cx, cy, n) = (h.real(159.5), h.real(119.5), h.real(160.0));
    let u = h.op(Op::Sub, &[x, cx]);
    let v = h.op(Op::Sub, &[cy, y]);
    let raw = [h.op(Op::Div, &[u, n]), h.op(Op::Div, &[v, n]), h.real(-1.0)];
    let dir = h.unit(raw);
    let side = h.op(Op::Sign, &[dir[0]]);
    let names = [
        "from_x", "from_y", "from_z", "dir_x", "dir_y", "dir_z", "side",
    ];
    let init: Vec<NodeId> = eye.into_iter().chain(dir).chain([side]).collect();
    let carried: Vec<_> = names
        .iter()
        .zip(&init)
        .map(|(name, &id)| ((*name).to_owned(), h.0.ty(id), id))
        .collect();
    let l = h.0.open_loop(12, &carried, AT);
    let c: Vec<NodeId> = (0..7).map(|k| h.0.carried(l, k, AT)).collect();
    let (from, d, side) = ([c[0], c[1], c[2]], [c[3], c[4], c[5]], c[6]);
    let zero = h.real(0.0);
    let wide = h.op(Op::ToReal, &[side]);
    let centre = [wide, wide, zero];
    let (present, t) = h.sphere(from, d, centre);
    let along = h.scale(d, t);
    let point = h.each(Op::Add, from, along);
    let normal = h.each(Op::Sub, point, centre);
    let cosine = h.dot(d, normal);
    let two = h.real(2.0);
    let twice = h.op(Op::Mul, &[two, cosine]);
    let bend = h.scale(normal, twice);
    let next_dir = h.each(Op::Sub, d, bend);
    let other = h.op(Op::IntNeg, &[side]);
    let next: Vec<NodeId> = point.into_iter().chain(next_dir).chain([other]).collect();
    let miss = h.backdrop(from, d);
    let shade = h.0.close_loop(l, present, &next, &[miss], &[zero])[0];
    let root = h.op(Op::Sqrt, &[shade]);
    let k = h.real(48.0);
    let scaled = h.op(Op::Mul, &[k, root]);
    let entries = [0, 24, 6, 30, 36, 12, 42, 18, 9, 33, 3, 27, 45, 21, 39, 15];
    let table = h.0.table(Table {
        name: "bayer4".to_owned(),
        width: 4,
        height: 4,
        ty: Type::Int,
        entries: entries.map(Constant::Int).to_vec(),
        seed: Vec::new(),
    });
    let (four, last) = (h.int(4), h.int(247));
    let column = h.op(Op::IntMod, &[x, four]);
    let row = h.op(Op::IntSub, &[last, y]);
    let row = h.op(Op::IntMod, &[row, four]);
    let cell = h.0.lookup(table, column, row, AT);
    let third = h.real(3.0);
    let cell = h.op(Op::Div, &[cell, third]);
    let sum = h.op(Op::Add, &[scaled, cell]);
    let whole = h.op(Op::Floor, &[sum]);
    let sixteen = h.int(16);
    let level = h.op(Op::IntDiv, &[whole, sixteen]);
    let three = h.int(3);
    let ink = h.op(Op::IntSub, &[three, level]);
    let none = h.int(0);
    let ink = h.op(Op::IntMax, &[ink, none]);
    let image = Image {
        block: (1, 1),
        width: 320,
        height: 240,
        palette: vec![[0; 3]; 4],
    };
    h.0.finish(image, ink, Some(shade))
}

#[test]
fn the_native_picture_of_two_mirrors_is_the_reference() {
    let graph = mirrors();
    verify(&graph).unwrap();
    let reference = include_bytes!("../../../tests/reference/mirrors-f64.pgm");
    let pixels = &reference[reference.len() - 320 * 240..];
    let mut native = Native::new(&graph);
    let mut different = 0;
    for y in 9..240 {
        for x in 0..320 {
            let ink = native.pixel(x, y).ink;
            different += u32::from(ink != pixels[(y * 320 + x) as usize]);
        }
    }
    assert_eq!(different, 0);
}

#[test]
fn the_schedule_draws_what_the_graph_means() {
    let graph = mirrors();
    let tree = schedule(&graph);
    let mut native = Native::new(&graph);
    let mut run = Run::new(&graph, &tree, Exact(&graph));
    for y in (0..240).step_by(7) {
        for x in 0..320 {
            assert_eq!(
                native.pixel(x, y).ink,
                run.pixel(x, y).int() as u8,
                "({x}, {y})"
            );
        }
    }
    assert_eq!(run.unset_reads(), 0);
}

#[test]
fn folding_changes_no_pixel() {
    let graph = mirrors();
    let folded = crate::passes::simplify::fold::fold(&graph);
    verify(&folded).unwrap();
    assert!(folded.nodes.len() < graph.nodes.len());
    let (mut before, mut after) = (Native::new(&graph), Native::new(&folded));
    for y in (0..240).step_by(5) {
        for x in 0..320 {
            assert_eq!(before.pixel(x, y), after.pixel(x, y), "({x}, {y})");
        }
    }
}

#[test]
fn a_printed_graph_reads_back() {
    let printed = mirrors().to_string();
    let read = crate::ir::read::read(&printed).unwrap();
    verify(&read).unwrap();
    assert_eq!(read.to_string(), printed);
    let mut native = Native::new(&read);
    assert_eq!(
        native.pixel(160, 120),
        Native::new(&mirrors()).pixel(160, 120)
    );
    for wrong in [
        "%0: int",
        "%9999999999: int = axis x",
        "%0: real = mul %1",
        "loop 0 max (",
        "nonsense",
    ] {
        assert!(crate::ir::read::read(wrong).is_err(), "{wrong}");
    }
}
