//! Candidate bounds: boxes around shapes, ends of rays and turns of loops, as tight as a sample
//! of the native picture lets them be.
//!
//! Nobody but the scene's writer knows that a bound holds. What is offered is one with which no
//! pixel that was looked at changes, with room to spare.

use super::number;
use super::ways::{Kind, Way, trees, within};
use crate::draw::Window;
use crate::interrupt;
use crate::scene::{Edit, Precision, Scene};
use slowlight_compiler::eval::native::{Native, Pixel};
use slowlight_compiler::source::Span;
use slowlight_compiler::syntax::tree::{Argument, Expr, ExprKind, Facet, ItemKind, Name};
use slowlight_compiler::syntax::walk;
use std::cell::Cell;

/// Rows and columns of the sample.
const GRID: u32 = 32;
/// How many operations one look at it may take, and how many looks there are.
const MOST: u64 = 20_000_000;
const LOOKS: u32 = 120;
/// How far shades may be apart where pictures are the same.
const NEAR: f64 = 1e-4;
/// Half the side of the largest box that is tried, and the greatest distance.
const FARTHEST: f64 = 256.0;
/// How much larger than it must be a box is.
const ROOM: f64 = 1.5;
/// Half the side of a box that holds no shape.
const TINY: f64 = 1e-3;
/// How often a box's side is halved towards its shape.
const HALVINGS: u32 = 5;

/// The native picture at a sample of its pixels, to be compared with those of other scenes.
struct Sample {
    places: Vec<(i32, i32)>,
    pixels: Vec<Pixel>,
    left: Cell<u32>,
}

impl Sample {
    fn of(scene: &Scene) -> Option<Sample> {
        let (width, height) = scene.size();
        let places = Window::whole(width, height).grid(GRID);
        let pixels = pixels(scene, &places)?;
        Some(Sample {
            places,
            pixels,
            left: Cell::new(LOOKS),
        })
    }

    /// Whether a scene has the same picture there, if that may be looked at yet.
    fn is_of(&self, scene: Option<Scene>) -> Option<Scene> {
        let left = self.left.get().checked_sub(1)?;
        self.left.set(left);
        let scene = scene?;
        let found = pixels(&scene, &self.places)?;
        let mut pairs = found.iter().zip(&self.pixels);
        // Steps that begin elsewhere end elsewhere within what is near enough.
        let same = |(a, b): (&Pixel, &Pixel)| a.ink == b.ink && (a.shade - b.shade).abs() <= NEAR;
        pairs.all(same).then_some(scene)
    }
}

/// Nothing where that takes too long.
fn pixels(scene: &Scene, places: &[(i32, i32)]) -> Option<Vec<Pixel>> {
    interrupt::check().ok()?;
    let mut graph = scene.graph(None, Precision::NATIVE).ok()?;
    graph.diffusion = None;
    let mut native = Native::within(&graph, MOST);
    let found = places.iter().map(|(x, y)| native.pixel(*x, *y)).collect();
    (!native.spent()).then_some(found)
}

/// Groups of ways, in each the one that claims least first.
pub fn of_bounds(scene: &Scene) -> Vec<Vec<Way>> {
    let mut groups = Vec::new();
    let Some(sample) = Sample::of(scene) else {
        return groups;
    };
    for (file, text, tree) in trees(scene) {
        for item in &tree.items {
            if let ItemKind::Shape { name, facets, .. } = &item.kind {
                let end = text.get(item.span.range()).and_then(|t| t.rfind('}'));
                let at = end.map(|end| item.span.start as usize + end);
                if let Some(at) = at.filter(|_| is_open(facets)) {
                    let at = Span::new(file, at, at);
                    groups.push(boxed(scene, &sample, name, at).into_iter().collect());
                }
            }
        }
        let mut found = Vec::new();
        walk::roots(&tree, &mut |root| visit(root, &mut found));
        for expr in found {
            groups.push(match &expr.kind {
                ExprKind::Loop { max, .. } => turns(scene, &sample, max),
                ExprKind::Method { receiver, name, .. } => {
                    let receiver = text.get(receiver.span.range()).unwrap_or("");
                    let call = format!("{receiver}.{}", name.text);
                    ended(scene, &sample, &call, expr, text)
                }
                _ => Vec::new(),
            });
        }
    }
    groups
}

/// Whether rays are followed to a shape without anything said of where it is.
fn is_open(facets: &[Facet]) -> bool {
    let has = |name: &str| facets.iter().any(|facet| facet.name.text == name);
    (has("dist") || has("f")) && !has("hit") && !has("bound")
}

/// Loops, and rays that are asked for without an end.
fn visit<'t>(expr: &'t Expr, found: &mut Vec<&'t Expr>) {
    let endless = |args: &[Argument]| args.len() < 2;
    match &expr.kind {
        ExprKind::Loop { .. } => found.push(expr),
        ExprKind::Method { name, args, .. }
            if ["trace", "blocked"].contains(&name.text.as_str()) && endless(args) =>
        {
            found.push(expr);
        }
        _ => {}
    }
    // Recursion is bounded: the parser limits nesting.
    walk::children(expr, &mut |child| visit(child, found));
}

/// A box around a shape.
fn boxed(scene: &Scene, sample: &Sample, name: &Name, at: Span) -> Option<Way> {
    let written = |low: [f64; 3], high: [f64; 3]| {
        let corner = |c: [f64; 3], up| {
            let parts = c.map(|c| number(c, up));
            format!("({})", parts.join(", "))
        };
        format!(
            "bound = box({}, {});",
            corner(low, false),
            corner(high, true)
        )
    };
    let edits = |low, high| {
        let text = format!("{} ", written(low, high));
        vec![Edit { at, text }]
    };
    let holds = |low, high| sample.is_of(scene.edited(&edits(low, high))).is_some();
    // Of a shape that is not seen nothing is known.
    if holds([-TINY; 3], [TINY; 3]) {
        return None;
    }
    let mut half = 1.0;
    while !holds([-half; 3], [half; 3]) {
        half *= 4.0;
        if half > FARTHEST {
            return None;
        }
    }
    // About the shape's own origin: what is hidden of it mirrors what is seen, as a rule.
    let mut size = [half; 3];
    for k in 0..3 {
        let mut step = half / 2.0;
        for _ in 0..HALVINGS {
            let mut closer = size;
            closer[k] -= step;
            if holds(closer.map(|half| -half), closer) {
                size = closer;
            }
            step /= 2.0;
        }
    }
    // What lies between the pixels has room, too.
    let high = size.map(|half| ROOM * half);
    let low = high.map(|half| -half);
    let edits = edits(low, high);
    Some(Way {
        kind: Kind::Bound,
        cause: format!(
            "`{}`{} has no bound and none was derived",
            name.text,
            within(scene, at.file)
        ),
        change: written(low, high),
        said: format!("`{}` in it, if all of it is inside,", written(low, high)),
        scene: sample.is_of(scene.edited(&edits))?,
        edits,
    })
}

/// Ends for rays, the farthest first.
fn ended(scene: &Scene, sample: &Sample, call: &str, expr: &Expr, text: &str) -> Vec<Way> {
    let end = text.get(expr.span.range()).and_then(|t| t.rfind(')'));
    let Some(at) = end.map(|end| expr.span.start as usize + end) else {
        return Vec::new();
    };
    let at = Span::new(expr.span.file, at, at);
    let file = within(scene, at.file);
    let mut ways = Vec::new();
    let mut far = FARTHEST;
    while far >= 1.0 {
        let said = format!("far: {far}");
        let edits = vec![Edit {
            at,
            text: format!(", {said}"),
        }];
        let Some(scene) = sample.is_of(scene.edited(&edits)) else {
            break;
        };
        ways.push(Way {
            kind: Kind::Far,
            cause: format!("`{call}`{file} has no `far`"),
            said: format!("`{said}` there, if nothing farther is to be seen,"),
            change: said,
            scene,
            edits,
        });
        far /= 2.0;
    }
    ways
}

/// Fewer turns, the most first.
fn turns(scene: &Scene, sample: &Sample, max: &Expr) -> Vec<Way> {
    let ExprKind::Int(most) = max.kind else {
        return Vec::new();
    };
    let file = within(scene, max.span.file);
    let mut ways = Vec::new();
    for part in [0.75, 0.5, 0.25, 0.125] {
        let fewer = (most * part).ceil();
        let edits = vec![Edit {
            at: max.span,
            text: format!("{fewer}"),
        }];
        let edited = (fewer < most).then(|| scene.edited(&edits)).flatten();
        let Some(scene) = sample.is_of(edited) else {
            break;
        };
        ways.push(Way {
            kind: Kind::Turns,
            cause: format!("its loop may take `max {most}` turns"),
            change: format!("max {fewer}"),
            said: format!("`max {fewer}`{file}, if so many are enough,"),
            scene,
            edits,
        });
    }
    ways
}
