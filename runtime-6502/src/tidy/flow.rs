//! Ways through a program: blocks of instructions, and where each goes on.

use super::code::{Line, Names, is_branch};
use super::effects::{Effects, Space};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// How a block ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// At the next.
    On,
    /// With a branch, by its line: there, or on.
    Branch(usize),
    /// With a jump.
    Jump,
    /// With a call: of this block, and on.
    Call(usize),
    Return,
    /// Nobody knows where.
    Unknown,
}

/// Lines that are carried out one after the other.
pub(super) struct Block {
    pub lines: Range<usize>,
    pub end: End,
    /// Where it goes on, behind a call included.
    pub next: Vec<usize>,
    pub before: Vec<usize>,
    /// It may be come to from where nobody knows, or is called.
    pub entered: bool,
}

/// A program as blocks.
pub(super) struct Flow {
    pub blocks: Vec<Block>,
    pub space: Space,
    /// What each line does; nothing for what is no instruction.
    pub effects: Vec<Effects>,
    /// The blocks behind calls.
    pub returns: Vec<usize>,
    /// The blocks in reverse postorder: but for loops, what comes to one stands before it.
    pub order: Vec<usize>,
}

impl Flow {
    pub fn new(lines: &[Line], names: &Names) -> Flow {
        let space = Space::of(lines.iter().filter_map(|line| match line {
            Line::Code(instruction) => Some(instruction),
            _ => None,
        }));
        let effects = (lines.iter())
            .map(|line| match line {
                Line::Code(instruction) => space.effects(instruction),
                _ => Effects::default(),
            })
            .collect();
        let starts = starts(lines, names);
        let of: BTreeMap<usize, usize> =
            starts.iter().enumerate().map(|(b, at)| (*at, b)).collect();
        let target = |label: &str| of.get(&names.line_of(label)?).copied();
        let entered = entered(lines, &target);
        let mut ends: Vec<usize> = starts.iter().skip(1).copied().collect();
        ends.push(lines.len());
        let mut blocks: Vec<Block> = (starts.iter().zip(ends).enumerate())
            .map(|(b, (&start, end))| {
                let (how, next) = ends_of(lines, start..end, b, &target);
                Block {
                    lines: start..end,
                    end: how,
                    next,
                    before: Vec::new(),
                    entered: b == 0 || entered.contains(&b),
                }
            })
            .collect();
        let edges: Vec<(usize, usize)> = (blocks.iter().enumerate())
            .flat_map(|(b, block)| block.next.iter().map(move |&n| (b, n)))
            .collect();
        let count = blocks.len();
        for block in &mut blocks {
            block.next.retain(|n| *n < count);
        }
        for (from, to) in edges {
            if let Some(block) = blocks.get_mut(to) {
                block.before.push(from);
            }
        }
        let returns = (blocks.iter())
            .filter(|block| matches!(block.end, End::Call(_)))
            .flat_map(|block| block.next.clone())
            .collect();
        Flow {
            order: reverse_postorder(&blocks),
            blocks,
            space,
            effects,
            returns,
        }
    }
}

/// The blocks, depth first from those that nothing known comes to, then from what is left.
fn reverse_postorder(blocks: &[Block]) -> Vec<usize> {
    let is_root = |block: &Block| block.entered || block.before.is_empty();
    let (roots, rest): (Vec<usize>, Vec<usize>) =
        (0..blocks.len()).partition(|b| blocks.get(*b).is_some_and(is_root));
    let mut order = Vec::with_capacity(blocks.len());
    let mut seen = vec![false; blocks.len()];
    for root in roots.into_iter().chain(rest) {
        // With how many of the ways on from each were taken.
        let mut open = vec![(root, 0)];
        while let Some((b, taken)) = open.pop() {
            let first = taken == 0;
            if first
                && seen
                    .get_mut(b)
                    .is_none_or(|seen| std::mem::replace(seen, true))
            {
                continue;
            }
            match blocks.get(b).and_then(|block| block.next.get(taken)) {
                Some(next) => open.extend([(b, taken + 1), (*next, 0)]),
                None => order.push(b),
            }
        }
    }
    order.reverse();
    order
}

/// The lines at which blocks begin: labels that are met, and what stands behind a branch, a
/// jump or data.
fn starts(lines: &[Line], names: &Names) -> BTreeSet<usize> {
    let mut starts = BTreeSet::from([0]);
    for (k, line) in lines.iter().enumerate() {
        match line {
            Line::Code(code) => {
                if is_branch(&code.name)
                    || matches!(code.name.as_str(), "jmp" | "jsr" | "rts" | "rti" | "brk")
                {
                    starts.insert(k + 1);
                    starts.extend(names.line_of(code.operand.text()));
                }
            }
            Line::Data => {
                starts.insert(k);
                starts.insert(k + 1);
            }
            // What has a name in a table or in an address may be come to by it.
            Line::Label(_) | Line::Silent => {}
        }
    }
    starts.retain(|k| *k < lines.len());
    starts
}

/// The blocks that calls and the unknown come to.
fn entered(lines: &[Line], target: &impl Fn(&str) -> Option<usize>) -> BTreeSet<usize> {
    let calls = lines.iter().filter_map(|line| match line {
        Line::Code(code) if code.name == "jsr" => target(code.operand.text()),
        _ => None,
    });
    calls.collect()
}

fn ends_of(
    lines: &[Line],
    range: Range<usize>,
    block: usize,
    target: &impl Fn(&str) -> Option<usize>,
) -> (End, Vec<usize>) {
    let last = range.clone().rev().find_map(|k| match lines.get(k)? {
        Line::Code(code) => Some((k, Some(code))),
        Line::Data => Some((k, None)),
        _ => None,
    });
    let on = block + 1;
    let Some((k, last)) = last else {
        return (End::On, vec![on]);
    };
    let Some(code) = last else {
        return (End::Unknown, Vec::new());
    };
    let there = target(code.operand.text());
    match (code.name.as_str(), there) {
        (name, Some(there)) if is_branch(name) => (End::Branch(k), vec![there, on]),
        ("jmp", Some(there)) => (End::Jump, vec![there]),
        ("jsr", Some(there)) => (End::Call(there), vec![on]),
        ("rts", _) => (End::Return, Vec::new()),
        (name, None) if is_branch(name) => (End::Unknown, Vec::new()),
        ("jmp" | "jsr" | "rti" | "brk", _) => (End::Unknown, vec![on]),
        _ => (End::On, vec![on]),
    }
}
