//! From the program to the graph, by partial evaluation.
//!
//! Expressions are evaluated with values whose structure is known and whose
//! scalars are nodes ([`value`]). A call is its callee's body with the
//! arguments in its frame; a condition that is known chooses, another merges
//! both results scalar by scalar; a loop's body is evaluated once, with nodes
//! that stand for the carried values ([`flow`]).
//!
//! **Invariant**: whatever the program, this ends: items form no cycles (the
//! checker saw to it), and steps, depth and nodes are counted.

mod among;
mod bounds;
mod call;
mod cells;
mod claims;
mod coincide;
mod compact;
mod derive;
mod dual;
mod each;
mod expr;
mod flow;
mod grid;
mod inside;
mod instances;
mod leaving;
mod merge;
mod nearest;
mod ops;
mod params;
mod pencil;
mod polynomial;
mod projection;
mod scene;
mod shape;
mod slope;
mod spread;
mod steps;
mod tables;
mod value;
mod vanishing;
mod view;
mod ways;

#[cfg(test)]
pub(in crate::sema) use bounds::extents;
pub use each::most_shapes;
pub use params::params;
pub use ways::{INSTANCES, Instancing, Millionths, Search, Ways};

use crate::ir::build::Builder;
use crate::ir::extent::Extent;
use crate::ir::graph::{Axis, Graph, Image, NodeId};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::{Type, Value};
use value::Val;

/// Nodes at most.
const NODES: usize = 400_000;
/// Steps of evaluation at most.
const STEPS: usize = 8_000_000;
/// Expressions inside expressions at most, calls included.
const DEPTH: usize = 1200;

/// A value, or why there is none.
type Found<T> = Result<T, Box<Diagnostic>>;

/// Which params become constants.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Freeze {
    /// None: all stay changeable.
    #[default]
    Nothing,
    /// These.
    Some(Vec<String>),
    /// All.
    All,
}

/// What a graph is made for.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// How many inks the screen has; the image's where absent.
    pub inks: Option<u32>,
    /// Whether `ink(i)` is i also beyond the inks, to see what a screen cannot show.
    pub all_inks: bool,
    /// Params' values: name and scalars, angles in radians.
    pub set: Vec<(String, Vec<f64>)>,
    /// Params that become constants.
    pub freeze: Freeze,
    /// Effects that are replaced by their `else`.
    pub without: Vec<String>,
    /// The number format's self-intersection offset: a hit nearer than this is
    /// the surface that the ray leaves.
    pub offset: f64,
    /// The number format's unit roundoff: the greatest relative error of one
    /// operation, or the last place of a fixed-point format.
    pub epsilon: f64,
    /// Whether its reals have an exponent.
    pub floats: bool,
    /// Whether they have a mantissa beside it: logarithms have none.
    pub mantissas: bool,
    /// No loop of the scene's own text takes more turns; what it then comes to is its
    /// `else`.
    pub max_turns: Option<u32>,
    /// The same for the library's loops: searches for hits, marches, walks through maps.
    pub max_steps: Option<u32>,
    /// What is found in another way than the scene says.
    pub ways: Ways,
    /// A function without parameters whose result's scalars the graph reports,
    /// beside the picture.
    pub report: Option<String>,
    /// Whether the graph has the states' next values; without, it is of the first picture.
    pub moves: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            inks: None,
            all_inks: false,
            set: Vec::new(),
            freeze: Freeze::Nothing,
            without: Vec::new(),
            offset: 1e-9,
            epsilon: f64::EPSILON / 2.0,
            floats: true,
            mantissas: true,
            max_turns: None,
            max_steps: None,
            ways: Ways::default(),
            report: None,
            moves: false,
        }
    }
}

/// The state of a lowering.
struct Lower<'a> {
    program: &'a Program,
    options: &'a Options,
    b: Builder,
    /// The locals of the function that is being expanded.
    frame: Vec<Val>,
    locals: &'a [Local],
    /// Where the scene calls into the library, while inside it.
    place: Option<Span>,
    /// The effect that is being expanded, the innermost, by its number.
    effect: Option<u16>,
    image: Image,
    params: Vec<Val>,
    steps_on: steps::Steps,
    consts: FxHashMap<ConstId, Val>,
    scenes: FxHashMap<SceneId, Vec<std::rc::Rc<value::Shape>>>,
    placed: FxHashMap<SceneId, std::rc::Rc<[each::Placed<'a>]>>,
    members: FxHashMap<SceneId, std::rc::Rc<[instances::Member]>>,
    claims: Vec<claims::Claimed>,
    tables: tables::Made,
    /// How many loops were opened.
    loops: u32,
    /// Whether loops here go over all of a scene's shapes, whatever turns the options allow.
    all_turns: bool,
    /// What stands for the point where a facet is read as a formula.
    markers: Option<derive::Markers>,
    /// Whether normals here are of a hit, which has met its surface: a march stops before it.
    is_met: bool,
    /// The boxes of formulas, by their roots and levels.
    extents: FxHashMap<(NodeId, u64), Extent>,
    extent_work: u64,
    /// What the points of hits lie on, by their coordinates.
    surfaces: FxHashMap<Vec<NodeId>, leaving::Surface>,
    /// The coordinates of hits' normals.
    normals: FxHashSet<NodeId>,
    /// Above 0 where only constants may come out.
    constant: usize,
    /// How many conditions that only the pixel decides choose among inks here.
    choices: usize,
    depth: usize,
    steps: usize,
}

/// The graph of a program that was checked without errors.
pub fn lower(program: &Program, options: &Options) -> Result<Graph, Vec<Diagnostic>> {
    let (Some(image), Some(draw)) = (&program.image, &program.draw) else {
        let error = Diagnostic::error(Span::default(), "the scene has no `image` or no `draw`");
        return Err(vec![error]);
    };
    let mut lower = Lower::new(program, options, image);
    lower.check_options(image.span)?;
    let mut said = Vec::new();
    // A constant or scene that nothing uses leaves nothing, but its mistakes are
    // the scene's: they are looked for in a lowering that is thrown away.
    let mut trial = Lower::new(program, options, image);
    trial.evaluate_consts(&mut said);
    trial.place_scenes(&mut said);
    // What bounds are worked out from leaves nothing in the graph.
    lower.placed = std::mem::take(&mut trial.placed);
    lower.declare_params(&mut said);
    if !said.is_empty() {
        return Err(said);
    }
    let (ink, shade) = lower.picture(draw).map_err(|e| vec![*e])?;
    lower.report().map_err(|e| vec![*e])?;
    if options.moves && options.report.is_none() {
        lower.next_values().map_err(|e| vec![*e])?;
    }
    let claims = std::mem::take(&mut lower.claims);
    let graph = lower.b.finish(lower.image, ink, shade);
    let broken = claims::check(&graph, &claims);
    if broken.is_empty() {
        Ok(compact::compact(graph))
    } else {
        Err(broken)
    }
}

impl<'a> Lower<'a> {
    fn new(program: &'a Program, options: &'a Options, image: &crate::sema::Image) -> Lower<'a> {
        Lower {
            program,
            options,
            b: Builder::new(),
            frame: Vec::new(),
            locals: &[],
            place: None,
            effect: None,
            image: Image {
                block: (1, 1),
                width: image.width,
                height: image.height,
                palette: params::thin(&image.palette, options.inks),
            },
            params: Vec::new(),
            steps_on: steps::Steps::default(),
            consts: FxHashMap::default(),
            scenes: FxHashMap::default(),
            placed: FxHashMap::default(),
            members: FxHashMap::default(),
            claims: Vec::new(),
            tables: tables::Made::default(),
            loops: 0,
            all_turns: false,
            markers: None,
            is_met: false,
            extents: FxHashMap::default(),
            extent_work: bounds::ALL_WORK,
            surfaces: FxHashMap::default(),
            normals: FxHashSet::default(),
            constant: 0,
            choices: 0,
            depth: 0,
            steps: 0,
        }
    }

    /// The ink and the shade of the pixel.
    fn picture(&mut self, draw: &'a Draw) -> Found<(NodeId, Option<NodeId>)> {
        let x = self.b.axis(Axis::X, draw.span);
        let y = self.b.axis(Axis::Y, draw.span);
        self.enter(&draw.body, vec![Val::Node(x), Val::Node(y)], |l| {
            let found = l.shaded(&draw.body.value)?;
            let ink = l.node(found.0, &draw.body.value.ty, draw.span)?;
            Ok((ink, found.1))
        })
    }

    /// Reports the scalars of the function that the options name. What is
    /// absent is reported as such (a bool), and its scalars as 0.
    fn report(&mut self) -> Found<()> {
        let Some(name) = &self.options.report else {
            return Ok(());
        };
        let mut all = self.program.functions.iter();
        let found = all.find(|f| f.name == *name && !f.library && f.params.is_empty());
        let Some(function) = found else {
            let message = format!("there is no function `{name}` without parameters to report");
            return Err(Box::new(Diagnostic::error(Span::default(), message)));
        };
        let span = function.span;
        let value = self.expand(function, Vec::new(), span)?;
        let (mut nodes, mut there) = (Vec::new(), None);
        match (&function.result, value) {
            (Ty::Optional(inner), Val::Optional { present, value }) => {
                self.b.report(present);
                there = Some(present);
                self.flatten((*value).clone(), inner, &mut nodes, span)?;
            }
            (ty, value) => self.flatten(value, ty, &mut nodes, span)?,
        }
        for node in nodes {
            let node = match there {
                Some(there) => {
                    let ty = self.b.ty(node);
                    let nothing = match ty {
                        Type::Real => self.real(0.0, span),
                        Type::Int => self.int(0, span),
                        Type::Bool => self.bool(false, span),
                    };
                    self.select(there, node, nothing, span)
                }
                None => node,
            };
            self.b.report(node);
        }
        Ok(())
    }

    /// Evaluates a body in a frame of its own.
    fn enter<T>(
        &mut self,
        body: &'a Body,
        args: Vec<Val>,
        work: impl FnOnce(&mut Self) -> Found<T>,
    ) -> Found<T> {
        let mut frame = args;
        frame.resize(body.locals.len(), Val::Undefined);
        let outer = (
            std::mem::replace(&mut self.frame, frame),
            std::mem::replace(&mut self.locals, &body.locals),
        );
        let result = work(self);
        (self.frame, self.locals) = outer;
        result
    }

    /// Where a node or message belongs: the scene's own line that called into
    /// the library.
    fn at(&self, span: Span) -> Span {
        let here = match self.place {
            // What is derived for a library's shape has its caller's span already.
            Some(place) if place == span => place,
            Some(place) => place.calling(span),
            None => span,
        };
        Span {
            effect: self.effect,
            ..here
        }
    }

    fn error(&self, span: Span, message: impl Into<String>) -> Diagnostic {
        let error = Diagnostic::error(self.at(span), message);
        match self.place {
            Some(place) if place != span => error.also(span, "in the library, here"),
            _ => error,
        }
    }

    /// A program that was not checked, or a mistake of the checker.
    fn confused(&self, span: Span) -> Box<Diagnostic> {
        Box::new(self.error(span, "this could not be made sense of"))
    }

    /// Counts a step of work.
    fn step(&mut self, span: Span) -> Found<()> {
        self.steps += 1;
        if self.steps > STEPS || self.b.len() > NODES {
            let error = self.error(
                span,
                "the scene grows too large when its calls are expanded",
            );
            return Err(Box::new(
                error.help("use a `loop` where calls repeat themselves"),
            ));
        }
        Ok(())
    }

    fn int(&mut self, value: i32, span: Span) -> NodeId {
        let span = self.at(span);
        self.b.constant(Value::Int(value), span)
    }

    fn real(&mut self, value: f64, span: Span) -> NodeId {
        let span = self.at(span);
        self.b.constant(Value::Real(value), span)
    }

    fn bool(&mut self, value: bool, span: Span) -> NodeId {
        let span = self.at(span);
        self.b.constant(Value::Bool(value), span)
    }
}
