//! What is done to statements once they are written: branches that are decided, values that
//! are read once, a `not` that the other arm saves. Then long ones are divided into methods,
//! as the web IDE slows down on long subroutines.

mod copies;
mod forward;
mod minus;
mod signs;
mod thread;
mod tree;

use super::code::{Code, Method};
use super::{Line, Subroutine, line};
use copies::Copies;
use std::collections::BTreeSet;
use tree::{Counts, Item};

/// Lines that a subroutine holds at most before it is divided.
const LONG: usize = 60;

/// Tidies what draws; `making` may read what that assigns.
pub(super) fn tidied(code: &mut Code, drawing: &mut [Subroutine], making: &[Subroutine]) {
    let methods = std::mem::take(&mut code.methods);
    // Called from several places, they assign the same again and again.
    let called = Counts::of(methods.iter().flat_map(|m| &m.lines));
    let bodies = drawing.iter_mut().map(|s| std::mem::take(&mut s.body));
    let mut trees: Vec<Vec<Item>> = bodies.map(tree::parsed).collect();
    let (heads, lines): (Vec<_>, Vec<_>) = methods
        .into_iter()
        .map(|m| ((m.about, m.name), m.lines))
        .unzip();
    trees.extend(lines.into_iter().map(tree::parsed));

    let counts = counts(&trees, making);
    let made = Counts::of(making.iter().flat_map(|s| &s.body));
    let once = |name: &str| {
        let elsewhere = made.get(name) != [0, 0] || called.get(name)[1] > 0;
        counts.get(name)[1] == 1 && !elsewhere && code.known.contains(name)
    };
    let mut copies = Copies::default();
    trees.iter_mut().for_each(|tree| copies.take(tree, &once));
    trees.iter_mut().for_each(|tree| copies.put(tree));
    trees
        .iter_mut()
        .for_each(|tree| thread::threaded(tree, &counts));
    let counts = self::counts(&trees, making);
    let may = |name: &str| counts.get(name) == [1, 1] && code.known.contains(name);
    let mut gone = BTreeSet::new();
    let all = trees.iter_mut();
    all.for_each(|tree| forward::substituted(tree, &may, &mut gone));
    let signs = code.names.signs();
    let mut arrays: BTreeSet<String> = code.columns().into_iter().collect();
    arrays.extend(code.names.tables().map(|(_, name)| name.to_owned()));
    let of_array = |name: &str| {
        name.strip_suffix("_plus")
            .is_some_and(|of| arrays.contains(of))
    };
    let is_sign = |name: &str| signs.contains(name) || code.logs() && of_array(name);
    for tree in &mut trees {
        signs::simplified(tree, &is_sign);
        minus::subtracted(tree);
    }

    let mut trees = trees.into_iter();
    for (subroutine, tree) in drawing.iter_mut().zip(&mut trees) {
        let name = subroutine.head.strip_prefix("method void ");
        let name = name.and_then(|head| head.strip_suffix("()"));
        subroutine.body = match name.filter(|_| !tree::any(&tree, &has_own)) {
            Some(name) => tree::written(divided(code, tree, name)),
            None => tree::written(tree),
        };
    }
    for ((about, name), tree) in heads.into_iter().zip(trees) {
        let lines = tree::written(divided(code, tree, &name));
        code.methods.push(Method { about, name, lines });
    }
    let bodies = drawing.iter().chain(making).flat_map(|s| &s.body);
    let left = Counts::of(bodies.chain(code.methods.iter().flat_map(|m| &m.lines)));
    let is_left = |name: &str| left.get(name) != [0, 0];
    code.written
        .retain(|(name, _)| is_left(name) || !code.known.contains(name));
}

/// What a subroutine has for itself, so that it cannot be divided.
fn has_own(text: &str) -> bool {
    text.starts_with("var ") || text.starts_with("return")
}

fn counts(trees: &[Vec<Item>], making: &[Subroutine]) -> Counts {
    let lines: Vec<Line> = trees.iter().cloned().flat_map(tree::written).collect();
    Counts::of(lines.iter().chain(making.iter().flat_map(|s| &s.body)))
}

/// Statements, of which as many as make a subroutine are methods named after `name`.
fn divided(code: &mut Code, items: Vec<Item>, name: &str) -> Vec<Item> {
    let (mut whole, mut part) = (Vec::new(), Vec::new());
    let mut items = items.into_iter().peekable();
    while let Some(mut item) = items.next() {
        match &mut item {
            Item::Line(_) => {}
            Item::While { body, .. } => inner(code, body, name),
            Item::If { yes, no, .. } => {
                inner(code, yes, name);
                inner(code, no, name);
            }
        }
        part.push(item);
        // An arm in a line of its own stays with the one before.
        let goes_on = |next: &Item| matches!(next, Item::Line(l) if l.text.starts_with("else {"));
        if tree::length(&part) > LONG && !items.peek().is_some_and(goes_on) {
            whole.push(outlined(code, std::mem::take(&mut part), name));
        }
    }
    if !whole.is_empty() && tree::length(&part) > LONG / 4 {
        whole.push(outlined(code, std::mem::take(&mut part), name));
    }
    whole.extend(part);
    whole
}

/// A block inside a statement.
fn inner(code: &mut Code, block: &mut Vec<Item>, name: &str) {
    let items = divided(code, std::mem::take(block), name);
    *block = match tree::length(&items) > LONG {
        true => vec![outlined(code, items, name)],
        false => items,
    };
}

/// The call of a method that is made of statements.
fn outlined(code: &mut Code, items: Vec<Item>, name: &str) -> Item {
    let call = code.outlined(tree::written(items), name);
    Item::Line(Line {
        span: call.span,
        ..line(&call.text)
    })
}
