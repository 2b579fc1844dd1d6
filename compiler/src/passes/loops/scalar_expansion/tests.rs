use super::*;
use crate::analysis::verify::verify;
use crate::eval::drawn::{drawn, grid};
use crate::eval::random_graphs;
use crate::ir::build::Builder;
use crate::ir::tree::{Block, Statement};
use crate::passes::simplify::fold::fold;
use crate::schedule::statements::{missing, schedule, schedule_in_segments};
use crate::source::Span;
use slowlight_routine::{Op, Type, Value};

const AT: Span = Span {
    file: 0,
    start: 0,
    end: 0,
    within: None,
    effect: None,
};

fn image() -> Image {
    let size = [7, 5];
    Image {
        width: size[0],
        height: size[1],
        palette: vec![[0; 3], [255; 3]],
        block: (1, 1),
    }
}

#[test]
fn random_graphs_draw_the_same() {
    let (mut found, mut loops) = (0, 0);
    for seed in 0..600 {
        let graph = fold(&random_graphs::graph(seed));
        let Some(columns) = columns(&graph) else {
            continue;
        };
        let places = grid(7, 5, 1);
        let plain = drawn(&graph, &schedule(&graph), &places);
        let all: BTreeSet<NodeId> = columns.all.iter().copied().collect();
        let half: BTreeSet<NodeId> = columns.all.iter().copied().step_by(2).collect();
        for chosen in [all, half, BTreeSet::new()] {
            let made = tabulated(&graph, &columns, &chosen);
            assert_eq!(verify(&made), Ok(()), "seed {seed}");
            for tree in [schedule(&made), schedule_in_segments(&made)] {
                assert_eq!(missing(&made, &tree), None, "seed {seed}:\n{tree}");
                assert_eq!(plain, drawn(&made, &tree, &places), "seed {seed}:\n{tree}");
            }
        }
        found += 1;
        loops += u32::from(!columns.made_in_loops.is_empty());
    }
    assert!(found > 150 && loops > 10, "{found}, {loops}");
}

/// An ink by whether a root of the column, found in a loop, is below the row.
fn looped() -> Graph {
    let mut b = Builder::default();
    let [x, y] = [Axis::X, Axis::Y].map(|axis| b.axis(axis, AT));
    let [x, y] = [x, y].map(|id| b.apply(Op::ToReal, &[id], AT));
    let one = b.constant(Value::Real(1.0), AT);
    let of = b.open_loop(8, &[("root".to_owned(), Type::Real, one)], AT);
    let root = b.carried(of, 0, AT);
    let part = b.apply(Op::Div, &[x, root], AT);
    let sum = b.apply(Op::Add, &[root, part], AT);
    let half = b.constant(Value::Real(0.5), AT);
    let next = b.apply(Op::Mul, &[sum, half], AT);
    let off = b.apply(Op::Sub, &[next, root], AT);
    let off = b.apply(Op::Abs, &[off], AT);
    let near = b.constant(Value::Real(0.01), AT);
    let again = b.apply(Op::Less, &[near, off], AT);
    let last = b.last(of, 0, AT);
    let [result] = b.close_loop(of, again, &[next], &[next], &[last])[..] else {
        panic!("one result");
    };
    let below = b.apply(Op::Less, &[result, y], AT);
    let [black, white] = [0, 1].map(|ink| b.constant(Value::Int(ink), AT));
    let ink = b.select(below, white, black, AT);
    b.finish(image(), ink, None)
}

#[test]
fn a_loop_over_the_column_stands_in_the_columns_block() {
    let graph = looped();
    let found = columns(&graph).expect("a root a column");
    let made = tabulated(&graph, &found, &found.all.iter().copied().collect());
    let tree = schedule(&made);
    let has_loop = |block: &Block| block.iter().any(|s| matches!(s, Statement::Loop(_)));
    assert!(has_loop(&tree.column) && !has_loop(&tree.pixel), "{tree}");
    let entries = made
        .nodes
        .iter()
        .filter(|n| matches!(n, Node::Tabulated(_)));
    assert_eq!(entries.count(), 1);
}

#[test]
fn what_hangs_on_the_row_is_not_offered() {
    let mut b = Builder::default();
    let [x, y] = [Axis::X, Axis::Y].map(|axis| b.axis(axis, AT));
    let sum = b.apply(Op::IntAdd, &[x, y], AT);
    assert!(columns(&b.finish(image(), sum, None)).is_none());
}
