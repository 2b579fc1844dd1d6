//! Runs of assignments in two versions: where a few values are as small as
//! they nearly always are, no expression of the run needs a guard.
//!
//! One test stands for all. A distance along a ray may be anything as far as
//! the ranges know; below some thousands nothing that is computed from it
//! overflows. So the run is written twice, once for what passes the test and
//! once, out of the way, with function calls for the rest.

use super::Style;
use super::code::Code;
use super::expression::Expressions;
use super::lines::Lines;
use crate::analysis::range::assuming;
use crate::ir::graph::{Node, NodeId};
use crate::ir::tree::{Block, Statement};
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Range, Type, Value};
use slowlight_runtime_bbc::guards;
use std::collections::BTreeSet;

/// How large values are taken to be, the largest that helps most.
const LIMITS: [f64; 3] = [1e6, 30_000.0, 5_000.0];
/// How far from 0 divisors are taken to be: the further, the smaller are quotients.
const NEAR: [f64; 3] = [1e-6, 1e-4, 1e-2];
/// More tests, or fewer calls saved, are not worth the second version.
const TESTS: usize = 2;
const SAVED: usize = 2;

/// A run's second version.
pub struct Version {
    /// When it does not apply.
    fails: String,
    /// Between which bounds the arguments of its operations stay.
    args: FxHashMap<NodeId, [Range; 2]>,
    saved: usize,
}

/// The assignments that a block begins with.
fn run(block: &[Statement]) -> Vec<NodeId> {
    let ids = block.iter().map_while(|statement| match statement {
        Statement::Let(id) => Some(*id),
        _ => None,
    });
    ids.collect()
}

impl Expressions<'_> {
    fn guarded(&self, id: NodeId) -> Option<&'static guards::Guarded> {
        guards::guard(self.plan.routine(id)?.name)
    }

    /// The best version of a run.
    fn version(&mut self, run: &[NodeId]) -> Option<Version> {
        let mut best: Option<(Version, Vec<(NodeId, Range)>)> = None;
        let all = LIMITS
            .iter()
            .flat_map(|limit| NEAR.map(|near| (*limit, near)));
        for (limit, near) in all {
            let Some(assumed) = self.assumptions(run, limit, near) else {
                continue;
            };
            let plan = self.plan;
            let args = assuming(&plan.graph, plan.runtime, &plan.ranges, &assumed, run);
            let proved = |id: &&NodeId| {
                let (Some(guarded), Some(args)) = (self.guarded(**id), args.get(*id)) else {
                    return false;
                };
                let mut when = guarded.when.iter();
                when.all(|(k, test)| args.get(*k).is_some_and(|range| test.proved(*range)))
            };
            let saved = run.iter().filter(proved).count();
            if saved >= SAVED && best.as_ref().is_none_or(|(b, _)| b.saved < saved) {
                let fails = String::new();
                best = Some((Version { fails, args, saved }, assumed));
            }
        }
        let (mut version, assumed) = best?;
        let fails: Option<Vec<String>> = assumed
            .iter()
            .map(|(id, range)| self.beyond(*id, *range))
            .collect();
        version.fails = fails?.join(" OR ");
        Some(version)
    }

    /// What is assumed of the values that a run reads, where they may be
    /// beyond it; none where that is nothing or too much.
    fn assumptions(&self, run: &[NodeId], limit: f64, away: f64) -> Option<Vec<(NodeId, Range)>> {
        let graph = &self.plan.graph;
        let mut assumed: Vec<(NodeId, Range)> = Vec::new();
        for &id in run {
            let Node::Apply(op, args) = graph.node(id) else {
                continue;
            };
            for (k, arg) in args.into_iter().take(op.arity()).enumerate() {
                let range = self.plan.ranges.args.get(id.0 as usize)?.get(k).copied()?;
                let inner = run.contains(&arg) || graph.constant(arg).is_some();
                let again = assumed.iter().any(|(a, _)| *a == arg);
                if inner || again || graph.ty(arg) != Type::Real {
                    continue;
                }
                let divisor = k == 1 && op == Op::Div;
                let near = match range {
                    Range { lo, hi, .. } if (0.0..away).contains(&lo) => {
                        Some(Range::new(away, hi.max(away)))
                    }
                    Range { lo, hi, .. } if (0.0..away).contains(&-hi) => {
                        Some(Range::new(lo.min(-away), -away))
                    }
                    _ => None,
                };
                if !range.within(-limit, limit) {
                    assumed.push((arg, Range::new(-limit, limit)));
                } else if let (true, Some(near)) = (divisor, near) {
                    assumed.push((arg, near));
                }
            }
        }
        (1..=TESTS).contains(&assumed.len()).then_some(assumed)
    }

    /// The test that a value lies outside what is assumed of it.
    fn beyond(&mut self, id: NodeId, range: Range) -> Option<String> {
        if !self.simple(id) {
            return None;
        }
        let text = self.read(id).text;
        let mut number = |x: f64| self.constant(Value::Real(x)).text;
        Some(match range {
            Range { lo, .. } if lo > 0.0 => format!("{text}<{}", number(lo)),
            Range { hi, .. } if hi < 0.0 => format!("{text}>{}", number(hi)),
            Range { hi, .. } => format!("ABS({text})>{}", number(hi)),
        })
    }
}

impl Code<'_> {
    /// A block's statements.
    pub fn block(&mut self, block: &Block) {
        let mut rest = block.as_slice();
        while let Some((first, behind)) = rest.split_first() {
            rest = match self.in_versions(rest) {
                Some(done) => rest.get(done..).unwrap_or_default(),
                None => {
                    self.one(first);
                    behind
                }
            };
        }
    }

    /// Writes the run that a block begins with in two versions, if that helps;
    /// how many statements that were.
    fn in_versions(&mut self, block: &[Statement]) -> Option<usize> {
        let wanted = match self.values.style {
            Style::Fast => true,
            // Where it is repeated only.
            Style::Lean => self.loops > 0,
            _ => false,
        };
        if !wanted || self.values.calls {
            return None;
        }
        let mut run = run(block);
        self.values.guarded(*run.first()?)?;
        while run
            .last()
            .is_some_and(|id| self.values.guarded(*id).is_none())
        {
            run.pop();
        }
        let version = self.values.version(&run)?;
        self.assign_before();
        // What is read behind the run must be found in its variable.
        let plan = self.values.plan;
        let graph = &plan.graph;
        let inside: BTreeSet<NodeId> = run
            .iter()
            .flat_map(|id| graph.node(*id).operands())
            .collect();
        let (slow, back) = (self.labels.next(), self.labels.next());
        let span = graph.span(*run.first()?);
        self.lines
            .line(format!("IF {} THEN {slow}", version.fails), Some(span));
        let before = self.values.folds();
        self.values.assumed = version.args;
        self.assignments(&run, &inside);
        self.values.assumed.clear();
        self.lines.place(back);
        let rare = Lines::of_weight((self.lines.weight / 64).max(1));
        let usual = std::mem::replace(&mut self.lines, rare);
        self.values.set_folds(before);
        self.values.calls = true;
        self.assignments(&run, &inside);
        self.values.calls = false;
        self.lines.line(format!("GOTO {back}"), Some(span));
        let rare = std::mem::replace(&mut self.lines, usual);
        self.rare.place(slow);
        self.rare.append(rare);
        Some(run.len())
    }

    fn assignments(&mut self, run: &[NodeId], inside: &BTreeSet<NodeId>) {
        for &id in run {
            self.assignment(id, inside.contains(&id));
        }
    }
}
