//! A walk on a machine: every picture and state held against the model's, which go on from the
//! machine's own states.

use super::hands::Hands;
use super::places::{Places, bits_of, looks};
use super::walk::{label, next};
use crate::draw::{Drawn, Window, model_with, native};
use crate::failure::{Failure, Outcome};
use crate::machine::{Loaded, Machine, MachineRun, complaint};
use crate::measure::{Difference, differences};
use crate::picture::Picture;
use crate::progress::{Progress, Waiting};
use crate::scene::{Precision, Scene};
use crate::trial::shown;
use crate::vcs;
use slowlight_compiler::backend::mos6502::vcs::Shape;
use slowlight_compiler::ir::graph::{Graph, Param, ParamId};
use slowlight_compiler::plan::Plan;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::planner::PlannedScene;
use slowlight_routine::{Bits, Type, Value};
use slowlight_vm::Screen;
use slowlight_vm::keys::{Keyboard, Unit};
use std::collections::{BTreeMap, BTreeSet};

/// A state in a picture.
#[derive(Clone, Debug)]
pub struct State {
    /// Its name.
    pub name: String,
    /// Its value on the machine.
    pub is: f64,
    /// What the model makes of the picture before.
    pub should: f64,
    /// Whether the two have the same bits.
    pub same: bool,
    /// What the native step makes of the machine's picture before, of an int or a bool that is
    /// another.
    pub natively: Option<f64>,
    /// Whether it is an angle.
    pub is_angle: bool,
}

impl State {
    /// A value of it in words: an angle in degrees.
    pub fn written(&self, value: f64) -> String {
        match self.is_angle {
            true => format!("{:.4}deg", value.to_degrees()),
            false => format!("{value:.6}"),
        }
    }
}

/// A picture of the walk.
pub struct Shown {
    /// The machine's.
    pub picture: Picture,
    /// Where it is unlike the model's.
    pub from_model: Vec<Difference>,
    /// Where it is unlike the native one of the same states.
    pub from_native: Vec<Difference>,
    /// The states that it was drawn with.
    pub states: Vec<State>,
}

/// A walk on a machine.
pub struct Walk {
    /// The plan.
    pub plan: PlannedScene,
    /// The machine's counts.
    pub run: MachineRun,
    /// Its cycles until each picture is there.
    pub times: Vec<u64>,
    /// Picture by picture.
    pub pictures: Vec<Shown>,
}

/// Runs so many pictures of a program, and holds them against its plan.
///
/// # Errors
/// Where the machine cannot be followed, or the program ends before.
pub fn run(
    scene: &Scene,
    plan: PlannedScene,
    (mut loaded, machine): (Loaded, Machine),
    (pictures, hands): (u32, &Hands),
    limit: u64,
) -> Outcome<Walk> {
    let followed = match machine {
        Machine::Hack(config) => !config.cpu && !config.os,
        Machine::Mos6502(_) | Machine::Bbc(_) => true,
    };
    if !followed {
        let message = "--pictures: of the Hack, only the VM with its native system is followed yet";
        return Err(Failure::Usage(message.to_owned()));
    }
    let script = hands.script().clone().filmed(u64::from(pictures));
    let keyboard = Keyboard::new(script, Unit::Calls, |_| None);
    let keyboard = keyboard.remembering().looked_at(looks(&plan));
    let (run, keyboard) = {
        let _waiting = Waiting::new("the machine");
        loaded.play(keyboard, limit, &mut |_| {})?
    };
    let name = plan.target.name;
    if let Some(wrong) = complaint(&run, limit) {
        return Err(Failure::Wrong(format!("{name}: {wrong}")));
    }
    let kept = keyboard.shots().iter().map(|(_, screen)| screen.as_ref());
    let seen: Vec<(Option<&Screen>, &Vec<i16>)> = kept.zip(keyboard.memories()).collect();
    if seen.len() != pictures as usize {
        let message = format!("{name}: the program ended after {} pictures", seen.len());
        return Err(Failure::Wrong(message));
    }
    let native_graph = scene.graph(Some(plan.mode.inks), Precision::NATIVE)?;
    let angles = scene.angles();
    let mut follow = Follow::new(&plan, native_graph, &angles);
    let progress = Progress::new("pictures", u64::from(pictures));
    let mut found = Vec::new();
    for (at, (screen, memory)) in (0..).zip(seen) {
        found.push(follow.picture(screen, memory)?);
        follow.step(hands, at);
        progress.step(1);
    }
    Ok(Walk {
        times: keyboard.times().to_vec(),
        plan,
        run,
        pictures: found,
    })
}

/// The model and the native evaluation beside a machine.
struct Follow<'p> {
    plan: &'p Plan,
    /// The same with the states as they are now.
    now: Plan,
    native: Graph,
    places: Places,
    /// How a picture of columns is shown.
    shape: Option<Shape>,
    /// What the states should be.
    should: Vec<(ParamId, Bits)>,
    /// What the native step makes of the machine's states.
    natively: BTreeMap<String, f64>,
    /// Which of them are angles.
    angles: &'p BTreeSet<String>,
}

impl<'p> Follow<'p> {
    fn new(plan: &'p Plan, native: Graph, angles: &'p BTreeSet<String>) -> Follow<'p> {
        let steps = plan.graph.steps();
        let start = steps.map(|(id, _)| (id, bits_of(plan, id)));
        Follow {
            now: plan.clone(),
            native,
            places: Places::of(plan),
            shape: vcs::shape(plan),
            should: start.collect(),
            natively: BTreeMap::new(),
            angles,
            plan,
        }
    }

    /// A picture with the states that the machine has drawn it with.
    fn picture(&mut self, screen: Option<&Screen>, memory: &[i16]) -> Outcome<Shown> {
        let plan = self.plan;
        let mut states = Vec::new();
        for (id, should) in self.should.clone() {
            // What nothing reads is nowhere, and as it should be.
            let is = match self.places.held(plan, (id, should), memory) {
                Some(None) => {
                    let message = "the machine's memory does not hold the states".to_owned();
                    return Err(Failure::Wrong(message));
                }
                Some(Some(is)) => is,
                None => should,
            };
            if let Some(param) = self.now.params.get_mut(id.0 as usize) {
                param.bits = is;
            }
            let Some(param) = plan.graph.params.get(id.0 as usize) else {
                continue;
            };
            let [is_value, should_value] = [is, should].map(|bits| value(plan, id, bits));
            native_param(&mut self.native, param)
                .iter_mut()
                .for_each(|own| own.value = is_value);
            let name = label(param);
            let natively = self.natively.get(&name).copied();
            states.push(State {
                is: is_value,
                should: should_value,
                same: is == should,
                natively: natively.filter(|value| *value != is_value),
                is_angle: self.angles.contains(&param.name),
                name,
            });
        }
        let window = Window::on_screen(plan);
        let modelled = model_with(&self.now, None)?;
        let native = native(&self.native, window)?;
        let picture = match &self.shape {
            Some(shape) => vcs::picture(plan, shape, screen)?,
            None => shown(plan, screen)?,
        };
        let unlike = |other: &Drawn| differences(window.places(), &picture.inks, &other.pixels);
        Ok(Shown {
            from_model: unlike(&modelled),
            from_native: unlike(&native),
            states,
            picture,
        })
    }

    /// What the states should be in the next picture.
    fn step(&mut self, hands: &Hands, picture: u32) {
        let held = hands.held(picture);
        let plan = self.plan;
        for (id, button) in plan.graph.buttons() {
            let value = Value::Int(i32::from(held == Some(button)));
            let bits = (plan.runtime.encode)(value, plan.runtime.int);
            if let Some(param) = self.now.params.get_mut(id.0 as usize) {
                param.bits = bits;
            }
        }
        self.should = ModelRun::new(&self.now).next_states();
        hands.give(picture, &mut self.native);
        let graph = &self.native;
        let whole = next(graph).into_iter().filter_map(|(id, value)| {
            let param = graph.params.get(id.0 as usize)?;
            (param.ty != Type::Real).then(|| (label(param), value))
        });
        self.natively = whole.collect();
    }
}

fn native_param<'g>(graph: &'g mut Graph, like: &Param) -> Option<&'g mut Param> {
    let mut params = graph.params.iter_mut();
    params.find(|p| (&p.name, p.component) == (&like.name, like.component))
}

/// A state's bits as a number.
fn value(plan: &Plan, id: ParamId, bits: Bits) -> f64 {
    match (plan.runtime.decode)(bits, plan.param_format(id)) {
        Value::Real(x) => x,
        Value::Int(i) => f64::from(i),
        Value::Bool(b) => f64::from(u8::from(b)),
    }
}

impl Walk {
    /// Whether the machine did other than its model, in a picture or a state.
    pub fn differs(&self) -> bool {
        let differs = |shown: &Shown| {
            !shown.from_model.is_empty() || shown.states.iter().any(|state| !state.same)
        };
        self.pictures.iter().any(differs)
    }

    /// How many pixels are unlike the model's, and unlike the native ones.
    pub fn pixels_unlike(&self) -> (usize, usize) {
        let model = self.pictures.iter().map(|shown| shown.from_model.len());
        let native = self.pictures.iter().map(|shown| shown.from_native.len());
        (model.sum(), native.sum())
    }

    /// How many states are unlike the model's.
    pub fn states_unlike(&self) -> usize {
        let states = self.pictures.iter().flat_map(|shown| &shown.states);
        states.filter(|state| !state.same).count()
    }

    /// How many ints and bools are unlike what the native step makes of the machine's states
    /// before.
    pub fn steps_unlike(&self) -> usize {
        let states = self.pictures.iter().flat_map(|shown| &shown.states);
        states.filter(|state| state.natively.is_some()).count()
    }

    /// The machine's cycles until the first picture is there, what it makes before among them.
    pub fn first_cycles(&self) -> u64 {
        self.times.first().copied().unwrap_or(self.run.cycles)
    }

    /// The machine's cycles a picture: from the first to the last, where there are several.
    pub fn cycles_a_picture(&self) -> f64 {
        let last = self.times.last().copied().unwrap_or_default();
        match self.times.len() {
            0 | 1 => self.first_cycles() as f64,
            n => last.saturating_sub(self.first_cycles()) as f64 / (n - 1) as f64,
        }
    }

    /// Pictures a second at the machine's own speed.
    pub fn pictures_a_second(&self) -> f64 {
        self.plan.target.hertz / self.cycles_a_picture().max(1.0)
    }
}
