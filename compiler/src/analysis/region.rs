//! Regions: the places that a value can be computed in, and what is known there.
//!
//! Regions form a tree: the frame holds the row, the row its passes, these their segments,
//! these the pixel, and below them stand the arms of conditions and the parts of loops. What is
//! known on entering a region (that a condition holds) may imply more.

use crate::ir::graph::*;
use rustc_hash::{FxHashMap, FxHashSet};

/// Which region; an index into [`Regions::regions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RegionId(pub u32);

/// What a region is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RegionKind {
    /// Once a picture; the outermost.
    Frame,
    /// Once a column, before the first row.
    Column,
    /// Once a row.
    Row,
    /// Once a pass over a row's columns.
    Pass,
    /// Once a run of columns in which comparisons with the row's values do not change.
    Segment,
    /// Once a pixel.
    Pixel,
    /// Where a condition holds, or does not.
    Arm { cond: NodeId, holds: bool },
    /// A loop's body, up to the decision.
    Body(LoopId),
    /// Where the loop goes on; inside its body.
    Next(LoopId),
    /// Where the loop ends by itself; inside its body.
    Done(LoopId),
    /// Where the loop has run `max` turns.
    Otherwise(LoopId),
}

/// A region and where it stands.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    /// What it is.
    pub kind: RegionKind,
    /// The region around it.
    pub parent: Option<RegionId>,
    /// How many regions are around it.
    pub depth: u32,
}

/// A condition and whether it holds.
pub type Fact = (NodeId, bool);

/// All that follows from a condition's holding or not, itself included.
pub fn implied(graph: &Graph, cond: NodeId, holds: bool) -> Vec<Fact> {
    beside(graph, Vec::new(), cond, holds)
}

/// The same where something is known already: what is new.
fn beside(graph: &Graph, before: Vec<Fact>, cond: NodeId, holds: bool) -> Vec<Fact> {
    let constant = |id| graph.constant(id).map(slowlight_routine::Value::truth);
    let choice = |&(id, is): &Fact| match graph.node(id) {
        Node::Select { cond, yes, no } => Some((cond, yes, no, is)),
        _ => None,
    };
    let held = before.len();
    let mut choices: Vec<_> = before.iter().filter_map(choice).collect();
    let mut known = Facts::new(before);
    let mut todo = vec![(cond, holds)];
    while let Some((id, holds)) = todo.pop() {
        if !known.insert((id, holds)) {
            continue;
        }
        match graph.node(id) {
            Node::Apply(slowlight_routine::Op::Not, [a, _]) => todo.push((a, !holds)),
            Node::Select { cond, yes, no } => {
                choices.push((cond, yes, no, holds));
                // The arm that would give the other answer was not taken.
                if constant(yes) == Some(!holds) {
                    todo.extend([(cond, false), (no, holds)]);
                } else if constant(no) == Some(!holds) {
                    todo.extend([(cond, true), (yes, holds)]);
                }
            }
            _ => {}
        }
        // What chooses is what it chooses.
        let chosen = choices.iter().filter_map(|&(cond, yes, no, is)| {
            if known.holds((cond, true)) {
                Some((yes, is))
            } else {
                known.holds((cond, false)).then_some((no, is))
            }
        });
        todo.extend(chosen.filter(|fact| !known.holds(*fact)));
    }
    known.list.split_off(held)
}

/// Facts in the order in which they were found, none twice. Conditions may stand inside each
/// other by the hundred: where they do, facts are looked up, not searched for.
struct Facts {
    list: Vec<Fact>,
    /// All of them, where they are many.
    set: FxHashSet<Fact>,
}

/// How many facts are searched sooner than looked up.
const FEW: usize = 16;

impl Facts {
    fn new(list: Vec<Fact>) -> Facts {
        let set = match list.len() > FEW {
            true => list.iter().copied().collect(),
            false => FxHashSet::default(),
        };
        Facts { list, set }
    }

    fn holds(&self, fact: Fact) -> bool {
        match self.list.len() > FEW {
            true => self.set.contains(&fact),
            false => self.list.contains(&fact),
        }
    }

    /// Adds one; whether it is new.
    fn insert(&mut self, fact: Fact) -> bool {
        let new = !self.holds(fact);
        if new {
            self.list.push(fact);
            match self.list.len() {
                n if n == FEW + 1 => self.set.extend(&self.list),
                n if n > FEW => _ = self.set.insert(fact),
                _ => {}
            }
        }
        new
    }
}

/// Every value's region.
#[derive(Clone, Debug, Default)]
pub struct Regions {
    /// All regions; the first six are frame, row, pass, segment, pixel and column.
    pub regions: Vec<Region>,
    /// Each node's region; `None` where the ink does not need it, or where it
    /// needs no computing.
    pub of: Vec<Option<RegionId>>,
    /// Each loop's region, if it runs.
    pub loops: Vec<Option<RegionId>>,
    /// What is known on entering each region.
    pub facts: Vec<Vec<Fact>>,
    children: FxHashMap<(RegionId, RegionKind), RegionId>,
}

/// The frame's region.
pub const FRAME: RegionId = RegionId(0);
/// The row's region.
pub const ROW: RegionId = RegionId(1);
/// The pass's region.
pub const PASS: RegionId = RegionId(2);
/// The segment's region.
pub const SEGMENT: RegionId = RegionId(3);
/// The pixel's region.
pub const PIXEL: RegionId = RegionId(4);
/// The region of what is tabulated by columns: in the frame, beside the row.
pub const COLUMN: RegionId = RegionId(5);

impl Regions {
    /// The outermost regions.
    pub(crate) fn new(graph: &Graph) -> Regions {
        let region = |kind, parent, depth| Region {
            kind,
            parent,
            depth,
        };
        Regions {
            regions: vec![
                region(RegionKind::Frame, None, 0),
                region(RegionKind::Row, Some(FRAME), 1),
                region(RegionKind::Pass, Some(ROW), 2),
                region(RegionKind::Segment, Some(PASS), 3),
                region(RegionKind::Pixel, Some(SEGMENT), 4),
                region(RegionKind::Column, Some(FRAME), 1),
            ],
            of: vec![None; graph.nodes.len()],
            loops: vec![None; graph.loops.len()],
            facts: vec![Vec::new(); 6],
            children: FxHashMap::default(),
        }
    }

    /// A region.
    pub fn get(&self, id: RegionId) -> Region {
        self.regions[id.0 as usize]
    }

    /// The child of a region of some kind, if there is one.
    pub fn child(&self, parent: RegionId, kind: RegionKind) -> Option<RegionId> {
        self.children.get(&(parent, kind)).copied()
    }

    /// The child of a region of some kind, made where there is none.
    pub(crate) fn make_child(
        &mut self,
        graph: &Graph,
        parent: RegionId,
        kind: RegionKind,
    ) -> RegionId {
        if let Some(found) = self.child(parent, kind) {
            return found;
        }
        let id = RegionId(self.regions.len() as u32);
        let depth = self.get(parent).depth + 1;
        self.regions.push(Region {
            kind,
            parent: Some(parent),
            depth,
        });
        self.children.insert((parent, kind), id);
        let again = |of: LoopId, holds| {
            graph
                .loops
                .get(of.0 as usize)
                .map_or(Vec::new(), |l| implied(graph, l.again, holds))
        };
        self.facts.push(match kind {
            RegionKind::Arm { cond, holds } => {
                let known = self.facts_up_to(FRAME, parent);
                match known.contains(&(cond, holds)) {
                    true => vec![(cond, holds)],
                    false => beside(graph, known, cond, holds),
                }
            }
            RegionKind::Next(of) => again(of, true),
            RegionKind::Done(of) => again(of, false),
            _ => Vec::new(),
        });
        id
    }

    /// The innermost region around both.
    fn around(&self, mut a: RegionId, mut b: RegionId) -> RegionId {
        while a != b {
            let deeper = if self.get(a).depth >= self.get(b).depth {
                &mut a
            } else {
                &mut b
            };
            match self.get(*deeper).parent {
                Some(parent) => *deeper = parent,
                None => return FRAME,
            }
        }
        a
    }

    /// The innermost region whose values both may use: around both, or an arm
    /// around one whose condition follows from where the other stands.
    pub fn common(&self, a: RegionId, b: RegionId) -> RegionId {
        let around = self.around(a, b);
        let mut region = around;
        loop {
            let step = |to: RegionId, other: RegionId| {
                let child = self.toward(region, to)?;
                let RegionKind::Arm { cond, holds } = self.get(child).kind else {
                    return None;
                };
                (self.knows(around, other, (cond, holds))).then_some(child)
            };
            match step(a, b).or_else(|| step(b, a)) {
                Some(child) => region = child,
                None => return region,
            }
        }
    }

    /// What is known in `inner` that is not known in `outer` around it.
    pub fn facts_up_to(&self, outer: RegionId, mut inner: RegionId) -> Vec<Fact> {
        let mut facts = Vec::new();
        while inner != outer {
            facts.extend(&self.facts[inner.0 as usize]);
            match self.get(inner).parent {
                Some(parent) => inner = parent,
                None => break,
            }
        }
        facts
    }

    /// Whether something is among [`Regions::facts_up_to`].
    fn knows(&self, outer: RegionId, mut inner: RegionId, fact: Fact) -> bool {
        while inner != outer {
            if self.facts[inner.0 as usize].contains(&fact) {
                return true;
            }
            match self.get(inner).parent {
                Some(parent) => inner = parent,
                None => break,
            }
        }
        false
    }

    /// The child of `outer` that holds `inner`, or `None` where `inner` is
    /// `outer` or not inside it.
    pub fn toward(&self, outer: RegionId, mut inner: RegionId) -> Option<RegionId> {
        loop {
            let parent = self.get(inner).parent?;
            if parent == outer {
                return Some(inner);
            }
            inner = parent;
        }
    }

    /// Whether `inner` is `outer` or inside it.
    pub fn holds(&self, outer: RegionId, inner: RegionId) -> bool {
        inner == outer || self.toward(outer, inner).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::build::Builder;
    use crate::source::Span;
    use slowlight_routine::{Op, Value};

    #[test]
    fn what_chooses_is_what_it_chooses() {
        let (mut b, span) = (Builder::new(), Span::default());
        let x = b.axis(Axis::X, span);
        let less = |b: &mut Builder, than: i32| {
            let than = b.constant(Value::Int(than), span);
            b.apply(Op::IntLess, &[x, than], span)
        };
        let (floor, ball) = (less(&mut b, 3), less(&mut b, 7));
        let yes = b.constant(Value::Bool(true), span);
        // Something is met: the floor, or else the ball.
        let met = b.select(floor, yes, ball, span);
        let one = b.constant(Value::Int(1), span);
        let none = b.constant(Value::Int(0), span);
        let ink = b.select(met, one, none, span);
        let image = Image {
            block: (1, 1),
            width: 8,
            height: 8,
            palette: Vec::new(),
        };
        let graph = b.finish(image, ink, None);
        let mut regions = Regions::new(&graph);
        let arm = |cond, holds| RegionKind::Arm { cond, holds };
        let inner = regions.make_child(&graph, PIXEL, arm(met, true));
        assert!(!regions.facts_up_to(PIXEL, inner).contains(&(ball, true)));
        let other = regions.make_child(&graph, inner, arm(floor, false));
        assert!(regions.facts_up_to(PIXEL, other).contains(&(ball, true)));
        let floors = regions.make_child(&graph, inner, arm(floor, true));
        let facts = regions.facts_up_to(PIXEL, floors);
        assert!(!facts.iter().any(|(of, _)| *of == ball), "{facts:?}");
    }
}
