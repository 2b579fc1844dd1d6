//! Path conditions at the ends of loops: what their results stay within where another of their
//! results is known. A march that has met something has not gone farther than it was to look.

use super::Walk;
use crate::analysis::region::Fact;
use crate::ir::graph::*;
use crate::ir::tree::*;
use slowlight_routine::{Range, Type, Value};

/// What a result of a loop stays within where another one, a bool, is known.
#[derive(Clone, Copy)]
pub(super) struct Left {
    known: Fact,
    result: NodeId,
    range: Range,
}

impl Walk<'_> {
    /// What a loop that was walked just now has left where it has ended by itself, by each of
    /// its results that is a bool.
    pub(super) fn left_where(&mut self, turns: &Turns) -> Vec<Left> {
        if !self.slack.inverts() {
            return Vec::new();
        }
        let given = |statement: &Statement| match *statement {
            Statement::Set {
                place: Place::Node(result),
                from: Origin::Node(from),
            } => Some((result, from)),
            _ => None,
        };
        let results: Vec<_> = turns.done.iter().filter_map(given).collect();
        let mut all = Vec::new();
        for &(says, from) in &results {
            // That nothing was found tells little of what was; but for where it would have been
            // by then.
            let asked = match self.used_up(says) {
                _ if self.graph.ty(says) != Type::Bool => continue,
                Some(true) => [true, false].as_slice(),
                _ => [true].as_slice(),
            };
            for &holds in asked {
                let ranges = self.under((turns.again, false), |walk| {
                    walk.under((from, holds), |walk| {
                        let ranges = results.iter().map(|&(_, from)| walk.fresh(from));
                        ranges.collect::<Vec<_>>()
                    })
                });
                let others = results.iter().zip(ranges);
                all.extend(others.filter(|((id, _), _)| *id != says).map(
                    |(&(result, _), range)| Left {
                        known: (says, holds),
                        result,
                        range,
                    },
                ));
            }
        }
        all
    }

    /// The same, once what stands where no turn is left was walked, too.
    pub(super) fn or_used_up(&mut self, mut left: Vec<Left>) -> Vec<Left> {
        for left in &mut left {
            let (says, holds) = left.known;
            if self.used_up(says) != Some(!holds) {
                left.range = left.range.join(self.read(left.result));
            }
        }
        // What none of them is says that it never ends so.
        left.retain(|left| left.range.lo <= left.range.hi);
        left
    }

    /// What a result of a loop is where no turn is left, if it is the same each time.
    fn used_up(&self, id: NodeId) -> Option<bool> {
        let Node::Result { of, index } = self.graph.node(id) else {
            return None;
        };
        let otherwise = self.graph.loops[of.0 as usize].otherwise[index as usize];
        self.graph.constant(otherwise).map(Value::truth)
    }

    /// Where a loop's result is known, what the others then are.
    pub(super) fn known_result(&mut self, known: Fact) {
        let Node::Result { of, .. } = self.graph.node(known.0) else {
            return;
        };
        for k in 0..self.ended[of.0 as usize].len() {
            let left = self.ended[of.0 as usize][k];
            let at = left.result.0 as usize;
            if left.known == known && self.shared[at].is_none() {
                self.saved.push((left.result, self.now[at]));
                self.now[at] = self.now[at].meet(left.range);
            }
        }
    }
}
